//! What changes a whole picture.

use std::ops::Range;

use super::super::code::single;
use super::{Area, Canvas};

/// 1 less each value; what is above 1 becomes 0.
///
/// **Accuracy:** twice is the identity within 6e-8, and exact for multiples of 2⁻²⁴ from 0 to 1.
pub fn inverted(canvas: &Canvas) -> Canvas {
    canvas.map(|texel| texel.map(|value| (1.0 - value).max(0.0)))
}

/// Each value times a factor.
pub fn scaled(canvas: &Canvas, factor: f32) -> Canvas {
    canvas.map(|texel| texel.map(|value| value * factor))
}

/// Left is right and right is left.
pub fn mirrored(canvas: &Canvas) -> Canvas {
    let [width, _] = canvas.size();
    moved(canvas, canvas.size(), |x, y| (width - 1 - x, y))
}

/// Upside down.
pub fn flipped(canvas: &Canvas) -> Canvas {
    let [_, height] = canvas.size();
    moved(canvas, canvas.size(), |x, y| (x, height - 1 - y))
}

/// A quarter turn clockwise.
pub fn turned(canvas: &Canvas) -> Canvas {
    let [width, height] = canvas.size();
    moved(canvas, [height, width], |x, y| (y, height - 1 - x))
}

/// A canvas whose texels are those of another, from the places that `from` gives.
fn moved(canvas: &Canvas, size: [usize; 2], from: impl Fn(usize, usize) -> (usize, usize)) -> Canvas {
    let [width, _] = canvas.size();
    Canvas::of_texels(size, |x, y| {
        let (x, y) = from(x, y);
        canvas.texels()[y * width + x]
    })
}

/// The same picture in other texels, each the mean of what it covers: the light's flux stays, and where the sides are
/// multiples of the old ones, the light itself.
pub fn resized(canvas: &Canvas, size: [usize; 2]) -> Canvas {
    let mut resized = Canvas::filled(size, [0.0; 3]);
    resize_part(canvas, &mut resized, &Area::whole(canvas.size()));
    resized
}

/// Bring the texels of `resized` up to date that have a part of an area of `canvas`.
pub fn resize_part(canvas: &Canvas, resized: &mut Canvas, area: &Area) {
    let ([width, height], [new_width, new_height]) = (canvas.size(), resized.size());
    let covered =
        |range: &Range<usize>, new: usize, count: usize| range.start * new / count..(range.end * new).div_ceil(count);
    for y in covered(&area.rows, new_height, height) {
        for x in covered(&area.columns, new_width, width) {
            let mut sum = [0.0; 3];
            for (row, height) in shares(y, new_height, height) {
                for (column, share) in shares(x, new_width, width) {
                    for (sum, value) in sum.iter_mut().zip(canvas.texels()[row * width + column]) {
                        *sum += height * share * f64::from(value);
                    }
                }
            }
            resized.put(x, y, sum.map(single));
        }
    }
}

/// Which of `count` texels the i-th of `new` texels covers, and their shares of it.
fn shares(i: usize, new: usize, count: usize) -> impl Iterator<Item = (usize, f64)> {
    // In units of 1/new of an old texel everything is whole.
    let (start, end) = (i * count, (i + 1) * count);
    (start / new..end.div_ceil(new)).map(move |old| {
        let covered = end.min((old + 1) * new) - start.max(old * new);
        (old, covered as f64 / count as f64)
    })
}

/// Means of this many boxes of the same width after each other stand for a Gaussian.
const BOXES: usize = 3;

/// Blurred as by a Gaussian of that standard deviation in texels; beyond its edges the picture goes on mirrored, so that
/// its mean stays.
///
/// **Source:** boxes with fractional ends, whose variances add up to σ², after P. Gwosdek et al., "Theoretical foundations
/// of Gaussian convolution by extended box filtering" (2011), eq. (3) to (5). **Cost:** the same for any σ.
pub fn blurred(canvas: &Canvas, sigma: f64) -> Canvas {
    let [width, height] = canvas.size();
    let kernel = Kernel::of_variance(sigma * sigma / BOXES as f64);
    let mut values: Vec<[f64; 3]> = canvas.texels().iter().map(|texel| texel.map(f64::from)).collect();
    for row in values.chunks_exact_mut(width) {
        kernel.smooth(row);
    }
    let mut column = vec![[0.0; 3]; height];
    for x in 0..width {
        for (y, value) in column.iter_mut().enumerate() {
            *value = values[y * width + x];
        }
        kernel.smooth(&mut column);
        for (y, value) in column.iter().enumerate() {
            values[y * width + x] = *value;
        }
    }
    Canvas::of_texels([width, height], |x, y| values[y * width + x].map(|value| single(value.max(0.0))))
}

/// A box of 2·reach + 1 texels, and `end` of a texel more on both sides.
struct Kernel {
    reach: usize,
    end: f64,
}

impl Kernel {
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a few texels")]
    fn of_variance(variance: f64) -> Self {
        let variance = variance.clamp(0.0, 1e8);
        let reach = (0.5 * (12.0 * variance + 1.0).sqrt() - 0.5).floor();
        let next = (reach + 1.0) * (reach + 1.0);
        let end = (2.0 * reach + 1.0) * (reach * (reach + 1.0) - 3.0 * variance) / (6.0 * (variance - next));
        Self { reach: reach as usize, end }
    }

    /// The mean over the box around each value, [`BOXES`] times.
    fn smooth(&self, line: &mut [[f64; 3]]) {
        let count = line.len();
        let margin = self.reach + 1;
        // An even picture with a period of two lines: …b a | a b c | c b…
        let folded = |i: usize| {
            let i = i % (2 * count);
            if i < count { i } else { 2 * count - 1 - i }
        };
        let shift = margin.div_ceil(2 * count) * 2 * count - margin;
        let weight = 1.0 / (2.0 * self.reach as f64 + 1.0 + 2.0 * self.end);
        for _ in 0..BOXES {
            let padded: Vec<[f64; 3]> = (0..count + 2 * margin).map(|i| line[folded(i + shift)]).collect();
            for c in 0..3 {
                let mut inner: f64 = padded[1..2 * margin].iter().map(|value| value[c]).sum();
                for (i, value) in line.iter_mut().enumerate() {
                    let [first, last] = [padded[i][c], padded[i + 2 * margin][c]];
                    value[c] = weight * (inner + self.end * (first + last));
                    inner += last - padded[i + 1][c];
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn noise(size: [usize; 2]) -> Canvas {
        let value = |i: usize| ((i * 7919) % 256) as f32 / 256.0;
        Canvas::of_texels(size, |x, y| [value(x + 37 * y), value(3 * x + y), value(x * y)])
    }

    #[track_caller]
    fn check_mean(a: &Canvas, b: &Canvas, what: &str) {
        let off = a.mean().iter().zip(b.mean()).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        assert!(off < 1e-7, "{what}: the mean is off by {off}");
    }

    #[test]
    fn two_of_a_kind_are_none() {
        let canvas = noise([24, 17]);
        assert_eq!(inverted(&inverted(&canvas)), canvas, "inverted");
        assert_eq!(mirrored(&mirrored(&canvas)), canvas, "mirrored");
        assert_eq!(flipped(&flipped(&canvas)), canvas, "flipped");
        assert_eq!(turned(&turned(&turned(&turned(&canvas)))), canvas, "turned all around");
        assert_eq!(turned(&turned(&canvas)), mirrored(&flipped(&canvas)), "a half turn");
        assert_eq!(turned(&canvas).get(16, 0), canvas.get(0, 0), "clockwise");
    }

    #[test]
    fn blurring_keeps_the_mean_and_an_even_picture() {
        for (size, sigma) in [([40, 30], 2.0), ([40, 30], 0.3), ([7, 5], 9.0), ([64, 1], 100.0)] {
            let canvas = noise(size);
            check_mean(&blurred(&canvas, sigma), &canvas, &format!("σ {sigma} on {size:?}"));
        }
        let even = Canvas::filled([20, 20], [0.5, 0.25, 1.0]);
        let still_even = blurred(&even, 4.0);
        let differences = still_even.texels().iter().flatten().zip(even.texels().iter().flatten());
        let worst = differences.map(|(a, b)| (a - b).abs()).fold(0.0, f32::max);
        assert!(worst < 1e-6, "an even picture is off by {worst}");
        assert_eq!(blurred(&even, 0.0), even, "no blur");
    }

    #[test]
    fn a_blurred_point_has_the_variance_asked_for() {
        for sigma in [0.5, 1.0, 3.7, 8.0] {
            let point = Canvas::of_texels([101, 101], |x, y| [if x == 50 && y == 50 { 1.0 } else { 0.0 }; 3]);
            let blurred = blurred(&point, sigma);
            let variance: f64 =
                (0..101 * 101).map(|i| f64::from(blurred.texels()[i][0]) * ((i % 101) as f64 - 50.0).powi(2)).sum();
            assert!((variance / (sigma * sigma) - 1.0).abs() < 1e-5, "σ {sigma}: {variance}");
        }
    }

    #[test]
    fn another_size_keeps_the_mean_and_twice_the_size_the_light() {
        let canvas = noise([24, 18]);
        for size in [[48, 36], [12, 9], [17, 31], [1, 1], [64, 64]] {
            check_mean(&resized(&canvas, size), &canvas, &format!("{size:?}"));
        }
        let twice = resized(&canvas, [48, 36]);
        assert_eq!(resized(&twice, [24, 18]), canvas, "there and back");
        assert_eq!(twice.get(47, 35), canvas.get(23, 17), "the last texel");
    }

    #[test]
    fn brightness_scales_the_mean() {
        let canvas = noise([16, 16]);
        let ratio = scaled(&canvas, 0.5).mean()[1] / canvas.mean()[1];
        assert!((ratio - 0.5).abs() < 1e-12, "{ratio}");
    }
}
