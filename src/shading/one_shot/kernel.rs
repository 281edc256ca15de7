//! The pattern convolved with disks: the paper's compact table.

use std::iter;
use std::sync::{Arc, OnceLock};

use glam::DVec2;
use rayon::prelude::*;
use realfft::num_complex::Complex;
use realfft::{RealFftPlanner, RealToComplex};

use super::grid::{Grid, HALF, SIDE, index};
use super::prefiltered::Kernel;

/// Samples along a side of the table: the grid's texels, and as many in the margins on both sides together.
pub const TABLE_SIDE: usize = 2 * SIDE;
/// Radii at each sample.
pub const LEVELS: usize = 9;
/// Samples in a margin.
const MARGIN: usize = SIDE / 2;
/// How far from the centre the outermost samples are, in texels: 64 + 64².
pub const REACH: f64 = HALF + (MARGIN * MARGIN) as f64;

/// ∫ L dA over disks about sampled points, in texels².
///
/// Along each axis the central samples are the texels' centres; those of the margins are 64 + j² texels from the centre,
/// j = 1…64. The radii at a sample are 2ⁱ·max(1, j², k²) texels, i = 0…8.
///
/// **Source:** [`crate::refs::ONE_SHOT`], §4. **Deviations:** between radii the sum is linear in r², which is exact for a
/// uniform surrounding, where a line in log r is up to 26 % too high; under a texel it goes on to 0 so, as πr²L does;
/// beyond the outermost samples point and radius shrink together, by which a light that looks small keeps its answer.
#[derive(Clone, Debug, PartialEq)]
pub struct DiskTable {
    /// Level by level for each sample, sample by sample for each row.
    sums: Vec<f64>,
}

impl DiskTable {
    /// The table of a pattern.
    pub fn new(grid: &Grid) -> Self {
        let convolved = convolve(grid);
        let (lines, total) = (Lines::new(grid), grid.total());
        let rows = (0..TABLE_SIDE).into_par_iter().flat_map_iter(|row| {
            let (convolved, lines) = (&convolved, &lines);
            (0..TABLE_SIDE).flat_map(move |column| {
                let central = central(column).zip(central(row));
                let (at, scale) = sample(column, row);
                (0..LEVELS).map(move |level| match central {
                    Some((i, j)) => convolved[level][j * TABLE_SIDE + i].max(0.0),
                    None => disk_sum(lines, total, at, scale * radius(level)),
                })
            })
        });
        Self { sums: rows.collect() }
    }

    /// The sums, level by level for each sample, sample by sample for each row.
    pub fn sums(&self) -> &[f64] {
        &self.sums
    }

    /// ∫ L dA over the disk of a radius about a point, both in texels.
    ///
    /// **Accuracy:** against the convolution, see `closed_form::one_shot`.
    pub fn sum(&self, at: DVec2, radius: f64) -> f64 {
        let shrink = (REACH / at.abs().max_element()).min(1.0);
        let (at, radius) = (at * shrink, radius * shrink);
        let ((column, x), (row, y)) = (cell(at.x), cell(at.y));
        let square = radius * radius;
        let near = (1.0 - x) * self.level(column, row, square) + x * self.level(column + 1, row, square);
        let far = (1.0 - x) * self.level(column, row + 1, square) + x * self.level(column + 1, row + 1, square);
        (1.0 - y) * near + y * far
    }

    /// The sum at a sample for a squared radius.
    fn level(&self, column: usize, row: usize, square: f64) -> f64 {
        let sums = &self.sums[(row * TABLE_SIDE + column) * LEVELS..][..LEVELS];
        let scale = scale(column).max(scale(row));
        let square = square / (scale * scale);
        if square < 1.0 {
            return square * sums[0];
        }
        // ⌊log₄ square⌋, from the exponent of the number itself.
        let level = usize::try_from(((square.to_bits() >> 52) - 1023) >> 1).unwrap_or(LEVELS);
        if level + 1 >= LEVELS {
            return sums[LEVELS - 1];
        }
        let below = radius(level) * radius(level);
        let share = (square - below) / (3.0 * below);
        (1.0 - share) * sums[level] + share * sums[level + 1]
    }
}

/// 2ⁱ.
fn radius(level: usize) -> f64 {
    (level as f64).exp2()
}

/// The texel of a sample that is not in a margin.
fn central(sample: usize) -> Option<usize> {
    sample.checked_sub(MARGIN).filter(|texel| *texel < SIDE)
}

/// How many samples into a margin, 0 for the central ones.
fn depth(sample: usize) -> f64 {
    (MARGIN.saturating_sub(sample)).max(sample.saturating_sub(MARGIN + SIDE - 1)) as f64
}

/// What the radii of a sample are multiplied by, along one axis.
fn scale(sample: usize) -> f64 {
    let depth = depth(sample);
    (depth * depth).max(1.0)
}

/// Where a sample is along an axis, in texels from the centre.
fn place(sample: usize) -> f64 {
    let from_centre = sample as f64 + 0.5 - SIDE as f64;
    let depth = depth(sample);
    if depth > 0.0 { (HALF + depth * depth).copysign(from_centre) } else { from_centre }
}

/// Where a sample is, and the factor of its radii.
fn sample(column: usize, row: usize) -> (DVec2, f64) {
    (DVec2::new(place(column), place(row)), scale(column).max(scale(row)))
}

/// The sample at or before a place along an axis, and how far on the way to the next it is, 0…1.
fn cell(x: f64) -> (usize, f64) {
    let inner = HALF - 0.5;
    if x.abs() <= inner {
        let from_first = x + inner;
        let first = index(from_first.floor()).min(SIDE - 2);
        return (MARGIN + first, from_first - first as f64);
    }
    // Between depths j and j + 1, the last texel being depth 0.
    let outside = x.abs() - HALF;
    let j = if outside < 1.0 { 0 } else { index(outside.sqrt().floor()).min(MARGIN - 1) };
    let (near, far) = (place(MARGIN + SIDE - 1 + j), place(MARGIN + SIDE + j));
    let share = ((x.abs() - near) / (far - near)).clamp(0.0, 1.0);
    if x > 0.0 { (MARGIN + SIDE - 1 + j, share) } else { (MARGIN - 1 - j, 1.0 - share) }
}

/// Chords across which a texel's covered area is measured.
const CHORDS: usize = 16;

/// The area of the unit square about (x, y) inside the disk of a radius about the origin: within 1e-3.
pub(super) fn coverage(x: f64, y: f64, radius: f64) -> f64 {
    let (distance, half_diagonal) = (x.hypot(y), 0.5_f64.hypot(0.5));
    if distance + half_diagonal <= radius {
        return 1.0;
    }
    if distance - half_diagonal >= radius {
        return 0.0;
    }
    let chord = |k: usize| {
        let across = x.abs() - 0.5 + (k as f64 + 0.5) / CHORDS as f64;
        let half = (radius * radius - across * across).max(0.0).sqrt();
        ((y + 0.5).min(half) - (y - 0.5).max(-half)).max(0.0)
    };
    (0..CHORDS).map(chord).sum::<f64>() / CHORDS as f64
}

/// Numbers in a padded image: as much padding as pattern, so that nothing wraps into it.
const PADDED: usize = TABLE_SIDE * TABLE_SIDE;

/// The spectra of the disks of each level, and the transform that made them.
struct Disks {
    transform: Arc<dyn RealToComplex<f64>>,
    spectra: Vec<Vec<Complex<f64>>>,
}

/// The disks, which are the same for all patterns.
///
/// With rows that follow each other and are padded to twice their length, the two-dimensional convolution is a
/// one-dimensional one: what leaves a row at an end falls into padding.
fn disks() -> &'static Disks {
    static DISKS: OnceLock<Disks> = OnceLock::new();
    DISKS.get_or_init(|| {
        let transform = RealFftPlanner::new().plan_fft_forward(PADDED);
        let offset = |i: usize| if i < SIDE { i as f64 } else { i as f64 - TABLE_SIDE as f64 };
        let spectrum = |level: usize| {
            let rows = (0..TABLE_SIDE).flat_map(|j| (0..TABLE_SIDE).map(move |i| (offset(i), offset(j))));
            let disk = rows.map(|(x, y)| coverage(x, y, radius(level))).collect();
            spectrum(&transform, disk)
        };
        let spectra = (0..LEVELS).into_par_iter().map(spectrum).collect();
        Disks { transform, spectra }
    })
}

fn spectrum(transform: &Arc<dyn RealToComplex<f64>>, mut image: Vec<f64>) -> Vec<Complex<f64>> {
    let mut spectrum = transform.make_output_vec();
    transform.process(&mut image, &mut spectrum).expect("both have the transform's own lengths");
    spectrum
}

/// The pattern convolved with the disk of each level, in padded images.
fn convolve(grid: &Grid) -> Vec<Vec<f64>> {
    let disks = disks();
    let padding = [0.0; SIDE];
    let rows = grid.texels().chunks_exact(SIDE).flat_map(|row| row.iter().chain(&padding).copied());
    let mut image: Vec<f64> = rows.collect();
    image.resize(PADDED, 0.0);
    let pattern = spectrum(&disks.transform, image);
    let back = RealFftPlanner::new().plan_fft_inverse(PADDED);
    let level = |disk: &Vec<Complex<f64>>| {
        let scale = (PADDED as f64).recip();
        let mut product: Vec<Complex<f64>> = pattern.iter().zip(disk).map(|(a, b)| a * b * scale).collect();
        // Real by construction, which rounding spoils.
        for end in [0, PADDED / 2] {
            product[end].im = 0.0;
        }
        let mut image = back.make_output_vec();
        back.process(&mut product, &mut image).expect("both have the transform's own lengths");
        image
    };
    disks.spectra.par_iter().map(level).collect()
}

/// ∫ L dA over a disk about a point; `total` over all of the pattern.
fn disk_sum(lines: &Lines, total: f64, at: DVec2, radius: f64) -> f64 {
    if (at.abs() - HALF).max(DVec2::ZERO).length() >= radius {
        return 0.0;
    }
    if (at.abs() + HALF).length() <= radius {
        return total;
    }
    lines.sum(at, radius, |y| (radius * radius - y * y).max(0.0).sqrt())
}

/// Sums from the start of each row of a grid.
#[derive(Clone, Debug)]
pub(super) struct Lines(Vec<f64>);

/// Neighbourhoods smaller than this, in texels, are cut into more than one chord a row.
const SMALL: f64 = 32.0;

impl Lines {
    pub(super) fn new(grid: &Grid) -> Self {
        let lines = grid.texels().chunks_exact(SIDE).flat_map(|line| {
            iter::once(0.0).chain(line.iter().scan(0.0, |sum, texel| {
                *sum += texel;
                Some(*sum)
            }))
        });
        Self(lines.collect())
    }

    /// ∫ L dA over the kernel of a radius about a point, not from a table.
    pub(super) fn kernel_sum(&self, kernel: Kernel, at: DVec2, radius: f64) -> f64 {
        match kernel {
            Kernel::Disk => self.sum(at, radius, |y| (radius * radius - y * y).max(0.0).sqrt()),
            Kernel::Square => self.sum(at, radius, |_| radius),
        }
    }

    /// ∫ L dA over what is within half a chord of a point; `half_chord` is a function of the row's distance from it, up
    /// to `radius`. Exact along rows, by one or four chords across a row.
    fn sum(&self, at: DVec2, radius: f64, half_chord: impl Fn(f64) -> f64) -> f64 {
        let cuts = if radius < SMALL { 4 } else { 1 };
        let first = index((at.y - radius + HALF).floor());
        let last = index((at.y + radius + HALF).ceil());
        let mut sum = 0.0;
        for (j, line) in self.0.chunks_exact(SIDE + 1).enumerate().take(last).skip(first) {
            for k in 0..cuts {
                let y = j as f64 + (f64::from(k) + 0.5) / f64::from(cuts) - HALF - at.y;
                if y.abs() < radius {
                    let half = half_chord(y);
                    sum += running(line, at.x + half) - running(line, at.x - half);
                }
            }
        }
        // Rounding may leave less than nothing of a chord that holds none.
        (sum / f64::from(cuts)).max(0.0)
    }
}

/// The running sum of a line up to a place, in texels from the centre.
fn running(line: &[f64], x: f64) -> f64 {
    let place = (x + HALF).clamp(0.0, SIDE as f64);
    let i = index(place.floor()).min(SIDE - 1);
    let share = place - i as f64;
    (1.0 - share) * line[i] + share * line[i + 1]
}
