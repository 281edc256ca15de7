//! What plots are written as.

use super::{Origin, csv, png, svg};
use crate::analysis::Sheet;

/// Points of a curve where nobody says otherwise: half a degree apart over ±90°.
pub const SAMPLES: usize = 361;

/// Pixels of a PNG a unit of its SVG, which is 1000 wide.
const PNG_SCALE: f32 = 2.0;

/// A format of plots.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PlotFormat {
    /// Numbers.
    Csv,
    /// A picture of lines.
    Svg,
    /// A picture of pixels.
    Png,
}

/// Why a plot could not be written as it should.
#[derive(Debug, thiserror::Error)]
pub enum PlotError {
    /// Not as numbers.
    #[error(transparent)]
    Csv(#[from] ::csv::Error),
    /// Not as a picture of pixels.
    #[error(transparent)]
    Png(#[from] png::DrawError),
}

impl PlotFormat {
    /// All of them.
    pub const ALL: [Self; 3] = [Self::Svg, Self::Png, Self::Csv];

    /// The extension of its files.
    pub fn extension(self) -> &'static str {
        match self {
            Self::Csv => "csv",
            Self::Svg => "svg",
            Self::Png => "png",
        }
    }

    /// Plots in this format.
    pub fn write(self, sheets: &[Sheet], origin: Origin) -> Result<Vec<u8>, PlotError> {
        Ok(match self {
            Self::Csv => csv::plots(sheets, origin)?,
            Self::Svg => svg::plots(sheets, origin).into_bytes(),
            Self::Png => png::from_svg(&svg::plots(sheets, origin), PNG_SCALE, origin)?,
        })
    }
}
