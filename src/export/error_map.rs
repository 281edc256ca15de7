//! Error maps in false colour, with their scale.

use super::png::{DrawError, draw, rgb};
use super::svg::{ColorScale, three_digits};
use super::{Origin, exr};
use crate::analysis::ErrorMap;
use crate::render::false_colour::{self, NOTHING};

/// Least width of a picture, pixels: the scale needs it.
const LEAST_WIDTH: u32 = 420;

const WHITE: [u8; 3] = [255; 3];

/// The map as a PNG with its scale beneath, from −`limit` to `limit` cd/m²; by default as far as the map reaches.
///
/// Pixels without a surface are grey, and outlines are dimmed. `what` says what is compared.
pub fn png(map: &ErrorMap, what: &str, limit: Option<f64>, origin: Origin) -> Result<Vec<u8>, DrawError> {
    let summary = map.summary();
    let end = limit.unwrap_or(summary.worst.abs());
    let end = if end > 0.0 { end } else { 1.0 };
    let [width, height] = map.size();
    let full = width.max(LEAST_WIDTH);
    let label = format!("{what}, luminance (cd/m²)");
    let percent = |value: f64| if summary.peak > 0.0 { 100.0 * value.abs() / summary.peak } else { 0.0 };
    let note = format!(
        "worst {} at pixel {}, {}; RMS {}; that is {} % and {} % of the peak of {}",
        three_digits(summary.worst),
        summary.at[0],
        summary.at[1],
        three_digits(summary.rms),
        three_digits(percent(summary.worst)),
        three_digits(percent(summary.rms)),
        three_digits(summary.peak),
    );
    let scale = ColorScale { span: [-end, end], color: signed, label: &label, note: &note };
    let (scale_size, scale_pixels) = draw(&scale.svg(f64::from(full)), 1.0)?;
    let margin = (full - width) as usize;
    let left = vec![WHITE; margin / 2];
    let right = vec![WHITE; margin - margin / 2];
    let color = |value: Option<f64>| value.map_or(NOTHING, |value| signed(value, [-end, end]));
    let pixels = map.luminance().map(color).zip(map.outline());
    let colors: Vec<_> = pixels.map(|(color, outlined)| if *outlined { dimmed(color) } else { color }).collect();
    let rows = colors.chunks_exact(width as usize).map(|row| [&left, row, &right].concat());
    let pixels: Vec<_> = rows.flatten().chain(scale_pixels).collect();
    Ok(rgb([full, height + scale_size[1]], &pixels, origin)?)
}

/// The signed differences as an EXR picture, cd/m² of linear Rec. 709; 0 where there is no surface.
pub fn exr(map: &ErrorMap, origin: Origin) -> Result<Vec<u8>, ::exr::error::Error> {
    let pixels: Vec<_> = map.difference().iter().map(|difference| difference.unwrap_or_default()).collect();
    exr::radiance(map.size(), &pixels, origin)
}

/// A colour half way to grey.
fn dimmed(color: [u8; 3]) -> [u8; 3] {
    let [grey, ..] = NOTHING;
    color.map(|channel| channel.midpoint(grey))
}

/// Colour of a value on a scale whose ends are equally far from zero.
fn signed(value: f64, [_, end]: [f64; 2]) -> [u8; 3] {
    false_colour::diverging(value / end)
}
