//! A pattern's parts as the preview's exact method walks through them.

use std::sync::LazyLock;

use super::types::f32_of;
use crate::light::pattern::{Channel, Span};
use crate::math::interpolation::{CHEBYSHEV, NODES};

/// Numbers of a part in the table: its place, what follows, its flux, two unused, and the weights.
const PART: usize = 24;

/// Nodes an axis; the weights of fewer than [`crate::math::interpolation::NODES`] follow from those.
const GPU_NODES: usize = 4;

/// Parts that are not halved further; a pattern of more texels is even within each.
const MOST_LEAVES: usize = 1 << 16;

/// How far the parts of a layer are opened, one stage after the other.
///
/// The last is what the layer is held to: with it the response is within 1/1024 of the layer's peak (`tests/gpu/textured`).
pub(crate) const STAGES: [Stage; 3] = [
    Stage { opening: 1.0, negligible: 1e-2 },
    Stage { opening: 0.5, negligible: 1e-4 },
    Stage { opening: 0.3, negligible: 3e-6 },
];

/// When a part of a pattern is not opened.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Stage {
    /// Its half diagonal as a share of its distance.
    pub(crate) opening: f32,
    /// What it adds as a share of the whole.
    pub(crate) negligible: f32,
}

/// The table of a channel: each part that is not black, followed by its halves.
pub(crate) fn parts(channel: &Channel) -> Vec<f32> {
    let texels_of_leaf = (channel.texels().len() / MOST_LEAVES).max(1);
    let [columns, rows] = channel.size().map(Span::whole);
    let mut numbers = Vec::new();
    push(channel, texels_of_leaf, columns, rows, &mut numbers);
    numbers
}

fn push(channel: &Channel, texels_of_leaf: usize, columns: Span, rows: Span, numbers: &mut Vec<f32>) {
    let weights = channel.weights(&columns, &rows);
    let flux: f64 = weights.iter().flatten().sum();
    if flux <= 0.0 {
        return;
    }
    let first = numbers.len();
    numbers.extend([columns.lo, rows.lo, columns.hi, rows.hi, 0.0, flux, 0.0, 0.0].map(f32_of));
    // By columns, then by rows.
    let mut halfway = [[0.0; GPU_NODES]; NODES];
    for (sums, weights) in halfway.iter_mut().zip(&weights) {
        add_fewer(sums, weights);
    }
    let mut fewer = [[0.0; GPU_NODES]; GPU_NODES];
    for (basis, row) in BASES.iter().zip(&halfway) {
        for (sums, share) in fewer.iter_mut().zip(basis) {
            for (sum, weight) in sums.iter_mut().zip(row) {
                *sum += share * weight;
            }
        }
    }
    numbers.extend(fewer.iter().flatten().copied().map(f32_of));
    let texels = columns.texels() as usize * rows.texels() as usize;
    if texels > texels_of_leaf {
        let by_columns = columns.texels() >= rows.texels();
        let halves = if by_columns { columns.halves() } else { rows.halves() };
        for half in halves.into_iter().flatten() {
            let (columns, rows) = if by_columns { (half, rows) } else { (columns, half) };
            push(channel, texels_of_leaf, columns, rows, numbers);
        }
    }
    // Whole numbers below 2²⁴ are exact.
    numbers[first + 4] = f32_of((numbers.len() / PART) as f64);
}

/// The weights of a row on fewer nodes.
fn add_fewer(sums: &mut [f64; GPU_NODES], weights: &[f64; NODES]) {
    for (basis, weight) in BASES.iter().zip(weights) {
        for (sum, share) in sums.iter_mut().zip(basis) {
            *sum += share * weight;
        }
    }
}

/// [`basis`] at the nodes of the weights.
static BASES: LazyLock<[[f64; GPU_NODES]; NODES]> = LazyLock::new(|| CHEBYSHEV.nodes.map(basis));

/// The Lagrange polynomials of four Chebyshev nodes at x.
fn basis(x: f64) -> [f64; GPU_NODES] {
    let node = |k: usize| (std::f64::consts::PI * (k as f64 + 0.5) / GPU_NODES as f64).cos();
    std::array::from_fn(|k| (0..GPU_NODES).filter(|j| *j != k).map(|j| (x - node(j)) / (node(k) - node(j))).product())
}
