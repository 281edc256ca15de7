//! Sizes of pictures.

use std::str::FromStr;

/// Largest picture, pixels.
const MAX_PIXELS: u64 = 1 << 26;

/// Longest side of a picture, pixels.
const MAX_SIDE: u32 = 1 << 15;

/// A picture's width and height.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Size(pub(super) [u32; 2]);

impl FromStr for Size {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let number = |text: &str| text.parse::<u32>().ok().filter(|side| (1..=MAX_SIDE).contains(side));
        let sides = text.split_once('x').and_then(|(width, height)| Some([number(width)?, number(height)?]));
        sides
            .filter(|[width, height]| u64::from(*width) * u64::from(*height) <= MAX_PIXELS)
            .map(Self)
            .ok_or_else(|| format!("use WIDTHxHEIGHT, each 1 to {MAX_SIDE}, together at most {MAX_PIXELS} pixels"))
    }
}
