//! Points of a pattern, likely as it is bright there.

use glam::DVec2;

use crate::light::pattern::Channel;

/// The running sums of a channel's texels, along its rows and over them.
#[derive(Clone, Debug)]
pub(super) struct Texels {
    width: usize,
    /// Of each row, its texels' sums up to and with each, as shares of the row's.
    along: Vec<f32>,
    /// Of the rows, as shares of the whole.
    rows: Vec<f64>,
}

impl Texels {
    pub(super) fn new(channel: &Channel) -> Self {
        let width = channel.width();
        let mut along = Vec::with_capacity(channel.texels().len());
        let mut rows = Vec::with_capacity(channel.height());
        let mut whole = 0.0;
        for row in channel.texels().chunks(width) {
            let sum: f64 = row.iter().map(|texel| f64::from(*texel)).sum();
            let mut up_to = 0.0;
            along.extend(row.iter().map(|texel| {
                up_to += f64::from(*texel);
                single(up_to / sum.max(f64::MIN_POSITIVE))
            }));
            whole += sum;
            rows.push(whole);
        }
        rows.iter_mut().for_each(|up_to| *up_to /= whole.max(f64::MIN_POSITIVE));
        Self { width, along, rows }
    }

    /// Shares u of a row and v of a column of the point that a point of the unit square is taken to.
    pub(super) fn point(&self, square: DVec2) -> DVec2 {
        let (row, v) = inverted(&self.rows, square.y, |up_to| up_to);
        let texels = &self.along[row * self.width..][..self.width];
        let (_, u) = inverted(texels, square.x, f64::from);
        DVec2::new(u, v)
    }
}

/// Where running sums reach `x`: the index, and the share of the way along them all.
fn inverted<T: Copy>(sums: &[T], x: f64, value: impl Fn(T) -> f64) -> (usize, f64) {
    let index = sums.partition_point(|sum| value(*sum) <= x).min(sums.len() - 1);
    let before = if index == 0 { 0.0 } else { value(sums[index - 1]) };
    let step = value(sums[index]) - before;
    let within = if step > 0.0 { ((x - before) / step).clamp(0.0, 1.0) } else { 0.5 };
    (index, (index as f64 + within) / sums.len() as f64)
}

#[expect(clippy::cast_possible_truncation, reason = "kept in single precision, as texels are")]
fn single(value: f64) -> f32 {
    value as f32
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn points_fall_on_texels_as_often_as_these_are_bright() {
        let channel = Channel::new(3, vec![0.0, 1.0, 3.0, 0.0, 0.0, 0.0, 2.0, 0.0, 2.0]).expect("three rows of three");
        let texels = Texels::new(&channel);
        let mut counts = [0.0_f64; 9];
        for i in 0..128_u32 {
            for j in 0..128_u32 {
                let square = (DVec2::new(f64::from(i), f64::from(j)) + 0.5) / 128.0;
                let [column, row] = (3.0 * texels.point(square)).floor().to_array();
                let at = (0..9_u32).position(|k| f64::from(k) == 3.0 * row + column).expect("within the pattern");
                counts[at] += 8.0 / (128.0 * 128.0);
            }
        }
        let worst = counts.iter().zip(channel.texels()).map(|(a, b)| (a - f64::from(*b)).abs()).fold(0.0, f64::max);
        assert!(worst < 0.05, "{counts:?}");
    }
}
