//! A contact sheet: small pictures of scenes and presets with their names.

use std::fmt::Write as _;

use super::Origin;
use super::png::{DrawError, draw, rgb};
use super::svg::escaped;

/// Around and between the pictures, pixels.
const GAP: u32 = 12;

/// Height of a name beneath its picture, pixels.
const CAPTION: u32 = 22;

/// Mean width of a letter of a name, pixels.
const LETTER: u32 = 7;

/// A picture and its name.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Entry {
    /// The name.
    pub name: String,
    /// Pixels, sRGB, row by row.
    pub picture: Vec<[u8; 3]>,
}

/// The entries row by row, `columns` in each, all of one size, as a PNG.
///
/// # Errors
///
/// Where the sheet has no pixels or too many.
pub fn png(entries: &[Entry], size: [u32; 2], columns: u32, origin: Origin) -> Result<Vec<u8>, DrawError> {
    let count = u32::try_from(entries.len()).unwrap_or(u32::MAX);
    let columns = columns.clamp(1, count.max(1));
    let cell = [size[0] + GAP, size[1] + CAPTION + GAP];
    let places: Vec<[u32; 2]> =
        (0..count).map(|i| [GAP + i % columns * cell[0], GAP + i / columns * cell[1]]).collect();
    let whole = [GAP + columns * cell[0], GAP + count.div_ceil(columns) * cell[1]];
    let (whole, mut pixels) = draw(&captions(entries, &places, size, whole), 1.0)?;
    for (entry, [left, top]) in entries.iter().zip(places) {
        for (row, line) in entry.picture.chunks_exact(size[0] as usize).enumerate() {
            let start = (top as usize + row) * whole[0] as usize + left as usize;
            pixels[start..][..line.len()].copy_from_slice(line);
        }
    }
    Ok(rgb(whole, &pixels, origin)?)
}

/// The names where they belong, on an empty sheet.
fn captions(entries: &[Entry], places: &[[u32; 2]], size: [u32; 2], [width, height]: [u32; 2]) -> String {
    let mut svg = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width}\" height=\"{height}\" \
         font-family=\"Ubuntu, Helvetica, Arial, sans-serif\" font-size=\"13\" fill=\"#d8dce2\">\n\
         <rect width=\"{width}\" height=\"{height}\" fill=\"#1b1e23\"/>\n"
    );
    for (entry, [left, top]) in entries.iter().zip(places) {
        let name = shortened(&entry.name, (size[0] / LETTER) as usize);
        let _ = writeln!(svg, "<text x=\"{left}\" y=\"{}\">{}</text>", top + size[1] + 16, escaped(&name));
    }
    svg.push_str("</svg>\n");
    svg
}

/// A name of at most that many letters.
fn shortened(name: &str, most: usize) -> String {
    if name.chars().count() <= most {
        return name.to_owned();
    }
    let start: String = name.chars().take(most.saturating_sub(1)).collect();
    format!("{}…", start.trim_end())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_picture_stands_in_its_cell_above_its_name() {
        let size = [60, 40];
        let entry = |i: u8| Entry { name: format!("Lamp {i}"), picture: vec![[200, i, 0]; 60 * 40] };
        let entries: Vec<_> = (0..5).map(entry).collect();
        let sheet = png(&entries, size, 3, Origin { scene: "lamps" }).expect("a sheet");
        let sheet = image::load_from_memory(&sheet).expect("a picture").into_rgb8();
        assert_eq!([sheet.width(), sheet.height()], [12 + 3 * 72, 12 + 2 * 74], "two rows of three");
        for i in 0..5_u8 {
            let (x, y) = (12 + u32::from(i % 3) * 72, 12 + u32::from(i / 3) * 74);
            for (dx, dy) in [(0, 0), (59, 39)] {
                assert_eq!(sheet.get_pixel(x + dx, y + dy).0, [200, i, 0], "a corner of picture {i}");
            }
            let below = (y + 42..y + 60).flat_map(|y| (x..x + 60).map(move |x| (x, y)));
            let bright = below.filter(|(x, y)| sheet.get_pixel(*x, *y).0[0] > 120).count();
            assert!(bright > 20, "the name of picture {i} has {bright} bright pixels");
        }
    }

    #[test]
    fn long_names_are_cut() {
        assert_eq!(shortened("a long name", 7), "a long…", "no blank before the sign");
        assert_eq!(shortened("short", 7), "short", "as it is");
    }
}
