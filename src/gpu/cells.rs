//! A pattern as shadow rays draw its points.

use super::types::{f32_of, u32_of};
use crate::light::pattern::Channel;

/// Cells along a side of a pattern, at most, by which rays to it are drawn.
const MOST_CELLS: usize = 32;
/// Texels along a side of a pattern, at most; larger patterns are averaged.
const MOST_TEXELS: usize = 1024;

/// The table of a pattern: see `textured_share` in `shadow_lights.wgsl`.
pub(crate) fn cells(channel: &Channel) -> Vec<f32> {
    let texels = averaged(channel, [channel.width(), channel.height()].map(|side| side.min(MOST_TEXELS)));
    let [columns, rows] = [channel.width(), channel.height()].map(|side| side.min(MOST_CELLS));
    let weights = averaged(channel, [columns, rows]);
    let total: f64 = weights.iter().sum();
    let mut numbers: Vec<_> = [columns, rows, channel.width().min(MOST_TEXELS), channel.height().min(MOST_TEXELS)]
        .map(|count| f32_of(f64::from(u32_of(count))))
        .to_vec();
    let mut above = 0.0;
    for row in weights.chunks_exact(columns) {
        let sum: f64 = row.iter().sum();
        above += sum;
        numbers.push(f32_of(above / total.max(f64::MIN_POSITIVE)));
        let mut before = 0.0;
        numbers.extend(row.iter().map(|weight| {
            before += weight;
            f32_of(before / sum.max(f64::MIN_POSITIVE))
        }));
    }
    numbers.extend(texels.into_iter().map(f32_of));
    numbers
}

/// The means over the texels that each part of a coarser grid touches: above 0 where any of them is.
fn averaged(channel: &Channel, [columns, rows]: [usize; 2]) -> Vec<f64> {
    let touched = |i: usize, count: usize, size: usize| i * size / count..((i + 1) * size).div_ceil(count);
    let mean = |i: usize| {
        let (row, column) = (i / columns, i % columns);
        let rows = touched(row, rows, channel.height());
        let columns = touched(column, columns, channel.width());
        let count = rows.len() * columns.len();
        let texels = rows.flat_map(|row| &channel.texels()[row * channel.width()..][columns.clone()]);
        texels.map(|texel| f64::from(*texel)).sum::<f64>() / f64::from(u32_of(count))
    };
    (0..columns * rows).map(mean).collect()
}
