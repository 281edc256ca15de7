//! The texels of a channel gathered on few nodes, for every dyadic part of it.

use std::borrow::Cow;
use std::sync::LazyLock;

use super::Channel;
use crate::math::interpolation::{CHEBYSHEV, Grid, NODES};

/// Parts of an axis down to so many texels have their weights kept; those of smaller parts are summed when asked for.
const KEPT: u32 = 16;

/// As [`KEPT`], for what is known of parts without their weights: their flux.
const SUMMED: u32 = 4;

/// A part of an axis: a run of texels, halved again and again, and at last parts of a texel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Span {
    /// Where it starts and ends, as shares of the whole axis.
    pub lo: f64,
    /// See [`Self::lo`].
    pub hi: f64,
    /// The first texel that it has a part of.
    first: u32,
    /// How many it has a part of; parts of a texel have 1.
    count: u32,
    /// Texels of the whole axis.
    total: u32,
    /// 1 for the whole axis; the halves of a part i are 2i and 2i + 1.
    index: u32,
}

impl Span {
    /// A whole axis of that many texels.
    pub fn whole(total: u32) -> Self {
        Self { lo: 0.0, hi: 1.0, first: 0, count: total, total, index: 1 }
    }

    /// Its length, as a share of the whole axis.
    pub fn length(&self) -> f64 {
        self.hi - self.lo
    }

    /// Where a coordinate on [−1, 1] lies.
    pub fn at(&self, x: f64) -> f64 {
        0.5 * (self.lo + self.hi) + 0.5 * self.length() * x
    }

    /// How many texels it has a part of.
    pub fn texels(&self) -> u32 {
        self.count
    }

    /// Whether it lies in a single texel.
    pub fn is_within_texel(&self) -> bool {
        self.count == 1
    }

    /// Its halves, which meet between two texels unless there is only one; `None` where no number lies between its ends.
    pub fn halves(&self) -> Option<[Self; 2]> {
        let left = self.count / 2;
        let middle = match left {
            0 => 0.5 * (self.lo + self.hi),
            _ => f64::from(self.first + left) / f64::from(self.total),
        };
        if !(self.lo < middle && middle < self.hi) {
            return None;
        }
        let index = self.index.saturating_mul(2);
        Some([
            Self { hi: middle, count: left.max(1), index, ..*self },
            Self {
                lo: middle,
                first: self.first + left,
                count: self.count - left,
                index: index.saturating_add(1),
                ..*self
            },
        ])
    }
}

/// The weights of all parts of a channel that are not small.
///
/// ∫ L f over a part is Σ w_kl f(x_k, y_l) for every polynomial f of degree below [`NODES`] in each coordinate: the
/// texels stand gathered at Chebyshev's nodes, with w_kl = ∫ L ℓ_k ℓ_l.
#[derive(Clone, Debug)]
pub(super) struct Spread {
    /// Halvings of the columns and of the rows whose weights are kept.
    depths: [u32; 2],
    /// Columns first.
    weights: Vec<Grid>,
}

/// The flux of all parts of a channel that are not small.
#[derive(Clone, Debug)]
pub(super) struct Fluxes {
    /// Halvings of the columns and of the rows whose parts are kept.
    depths: [u32; 2],
    /// ∫ L du dv, columns first.
    fluxes: Vec<f64>,
}

/// ∫ ℓ_k over each of n equal parts of [−1, 1], for every n below twice [`KEPT`].
static BASES: LazyLock<Vec<Vec<[f64; NODES]>>> = LazyLock::new(|| (0..2 * KEPT).map(bases).collect());

fn bases(n: u32) -> Vec<[f64; NODES]> {
    let end = |i: u32| 2.0 * f64::from(i) / f64::from(n) - 1.0;
    (0..n).map(|i| CHEBYSHEV.basis_integrals(end(i), end(i + 1))).collect()
}

/// ∫ ℓ_k over each texel of a part, its ends taken as −1 and 1.
fn equal_parts(span: &Span) -> Cow<'static, [[f64; NODES]]> {
    match BASES.get(span.count as usize) {
        Some(bases) => Cow::Borrowed(bases),
        None => Cow::Owned(bases(span.count)),
    }
}

/// How often an axis of `total` texels is halved before its parts have fewer than `kept`.
fn depth(total: u32, kept: u32) -> u32 {
    (total / kept).max(1).ilog2()
}

/// Whether the halves of the part at i, counted from 0, are not kept.
fn is_leaf(i: usize, depth: u32) -> bool {
    i + 1 >= 1 << depth
}

impl Fluxes {
    /// The flux of a channel's parts.
    pub(super) fn new(channel: &Channel) -> Self {
        let totals = channel.size();
        let depths = totals.map(|total| depth(total, SUMMED));
        let [columns, rows] = [0, 1].map(|axis| parts(totals[axis], depths[axis]));
        let width = columns.len();
        let mut fluxes = vec![0.0; width * rows.len()];
        for j in (0..rows.len()).rev() {
            for i in (0..width).rev() {
                fluxes[j * width + i] = match (is_leaf(i, depths[0]), is_leaf(j, depths[1])) {
                    (true, true) => summed(channel, &columns[i], &rows[j]),
                    (false, true) => fluxes[j * width + 2 * i + 1] + fluxes[j * width + 2 * i + 2],
                    (_, false) => fluxes[(2 * j + 1) * width + i] + fluxes[(2 * j + 2) * width + i],
                };
            }
        }
        Self { depths, fluxes }
    }

    /// ∫ L du dv over a part.
    pub(super) fn flux(&self, channel: &Channel, columns: &Span, rows: &Span) -> f64 {
        if columns.index < 2 << self.depths[0] && rows.index < 2 << self.depths[1] {
            self.fluxes[(rows.index as usize - 1) * ((2 << self.depths[0]) - 1) + columns.index as usize - 1]
        } else {
            summed(channel, columns, rows)
        }
    }
}

/// The flux of a part, from its texels.
fn summed(channel: &Channel, columns: &Span, rows: &Span) -> f64 {
    let mut sum = 0.0;
    for row in rows.first..rows.first + rows.count {
        for texel in channel.row(row as usize, columns.first as usize, columns.count as usize) {
            sum += f64::from(*texel);
        }
    }
    sum * columns.length() * rows.length() / (f64::from(columns.count) * f64::from(rows.count))
}

impl Spread {
    /// The weights of a channel's parts.
    pub(super) fn new(channel: &Channel) -> Self {
        let totals = channel.size();
        let depths = totals.map(|total| depth(total, KEPT));
        let [columns, rows] = [0, 1].map(|axis| parts(totals[axis], depths[axis]));
        let mut spread = Self { depths, weights: vec![Grid::default(); columns.len() * rows.len()] };
        for j in (0..rows.len()).rev().filter(|j| is_leaf(*j, depths[1])) {
            for i in (0..columns.len()).rev() {
                let at = spread.slot(i, j);
                spread.weights[at] = if is_leaf(i, depths[0]) {
                    gather(channel, &columns[i], &rows[j])
                } else {
                    let halves = [2 * i + 1, 2 * i + 2].map(|half| spread.weights[spread.slot(half, j)]);
                    join(halves, &columns[i])
                };
            }
        }
        for j in (0..rows.len()).rev().filter(|j| !is_leaf(*j, depths[1])) {
            for i in 0..columns.len() {
                let halves = [2 * j + 1, 2 * j + 2].map(|half| transposed(&spread.weights[spread.slot(i, half)]));
                let at = spread.slot(i, j);
                spread.weights[at] = transposed(&join(halves, &rows[j]));
            }
        }
        spread
    }

    fn slot(&self, column: usize, row: usize) -> usize {
        row * ((2 << self.depths[0]) - 1) + column
    }

    /// The weights of a part: Σ w = ∫ L du dv over it. Indexed by row, then column.
    pub(super) fn weights(&self, channel: &Channel, columns: &Span, rows: &Span) -> Grid {
        let is_kept = |span: &Span, axis: usize| span.index < 2 << self.depths[axis];
        if is_kept(columns, 0) && is_kept(rows, 1) {
            self.weights[self.slot(columns.index as usize - 1, rows.index as usize - 1)]
        } else {
            gather(channel, columns, rows)
        }
    }
}

/// All parts of an axis down to `depth` halvings, each at its index − 1.
fn parts(total: u32, depth: u32) -> Vec<Span> {
    let mut parts = vec![Span::whole(total)];
    for i in 0..(1 << depth) - 1 {
        parts.extend(parts[i].halves().expect("a part that is halved has texels"));
    }
    parts
}

/// The weights of a part, from its texels.
fn gather(channel: &Channel, columns: &Span, rows: &Span) -> Grid {
    let [of_columns, of_rows] = [columns, rows].map(equal_parts);
    let mut grid = Grid::default();
    for (row, of_row) in of_rows.iter().enumerate() {
        let texels = channel.row(rows.first as usize + row, columns.first as usize, columns.count as usize);
        let mut gathered = [0.0; NODES];
        for (texel, of_column) in texels.iter().zip(of_columns.iter()) {
            let texel = f64::from(*texel);
            for (sum, share) in gathered.iter_mut().zip(of_column) {
                *sum += texel * share;
            }
        }
        for (sums, share) in grid.iter_mut().zip(of_row) {
            for (sum, value) in sums.iter_mut().zip(gathered) {
                *sum += share * value;
            }
        }
    }
    let area = 0.25 * columns.length() * rows.length();
    grid.map(|row| row.map(|weight| area * weight))
}

/// The weights of a part of the columns, from those of its halves.
fn join(halves: [Grid; 2], span: &Span) -> Grid {
    let mut joined = Grid::default();
    let Some(parts) = span.halves() else { return joined };
    for (half, part) in halves.iter().zip(parts) {
        for (k, node) in CHEBYSHEV.nodes.iter().enumerate() {
            let basis = CHEBYSHEV.basis((2.0 * part.at(*node) - span.lo - span.hi) / span.length());
            for (sums, of_half) in joined.iter_mut().zip(half) {
                for (sum, share) in sums.iter_mut().zip(basis) {
                    *sum += share * of_half[k];
                }
            }
        }
    }
    joined
}

fn transposed(grid: &Grid) -> Grid {
    std::array::from_fn(|i| std::array::from_fn(|j| grid[j][i]))
}
