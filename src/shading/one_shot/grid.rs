//! Patterns on a common grid, and where the grid is in the world.

use glam::{DVec2, DVec3};

use super::kernel::coverage;
use crate::light::pattern::Channel;
use crate::light::{DiskEmitter, PolygonEmitter, TexturedEmitter};

/// Texels along a side of the grid ([`crate::refs::ONE_SHOT`], §4).
pub const SIDE: usize = 128;
/// Texels from the grid's centre to its sides.
pub(super) const HALF: f64 = 0.5 * SIDE as f64;

/// Rows that a texel is cut into where an outline's share of it is measured.
const SUBROWS: usize = 8;

/// The luminance of a pattern on SIDE × SIDE square texels, zero where the pattern is not.
///
/// Positions are in texels from the grid's centre: texel (column i, row j) is centred at (i + ½ − 64, j + ½ − 64).
#[derive(Clone, Debug, PartialEq)]
pub struct Grid {
    texels: Vec<f64>,
}

/// A plane pattern in the world.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Frame {
    /// The grid's centre.
    pub center: DVec3,
    /// Unit direction of the grid's rows.
    pub axis_u: DVec3,
    /// Unit direction of the grid's columns.
    pub axis_v: DVec3,
    /// Unit normal of the lit side.
    pub normal: DVec3,
    /// Emits to both sides.
    pub two_sided: bool,
    /// Side of a texel in metres.
    pub texel: f64,
    /// The pattern is the same all round its centre.
    pub is_round: bool,
}

impl Grid {
    /// A channel that fills a rectangle of those sides, in texels, about the centre, resampled by area.
    ///
    /// **Accuracy:** no light is lost or moved by more than a texel's half diagonal, 0.6 % of the longest side.
    pub fn of_channel(channel: &Channel, sides: DVec2) -> Self {
        let columns = shares(channel.width(), sides.x);
        let rows = shares(channel.height(), sides.y);
        let mut texels = vec![0.0; SIDE * SIDE];
        for (row, values) in rows.iter().zip(channel.texels().chunks_exact(channel.width())) {
            let mut line = [0.0; SIDE];
            for (column, value) in columns.iter().zip(values) {
                for (i, share) in column.targets() {
                    line[i] += share * f64::from(*value);
                }
            }
            for (j, share) in row.targets() {
                for (texel, value) in texels[j * SIDE..][..SIDE].iter_mut().zip(line) {
                    *texel += share * value;
                }
            }
        }
        Self { texels }
    }

    /// The inside of an outline, by the even-odd rule.
    ///
    /// **Accuracy:** a texel's share is exact along rows, and the mean over 8 rows of it across.
    pub fn of_outline(outline: &[DVec2]) -> Self {
        let mut texels = vec![0.0; SIDE * SIDE];
        for (j, line) in texels.chunks_exact_mut(SIDE).enumerate() {
            for k in 0..SUBROWS {
                let y = j as f64 + (k as f64 + 0.5) / SUBROWS as f64 - HALF;
                for [from, to] in chords(outline, y) {
                    add_span(line, from + HALF, to + HALF, 1.0 / SUBROWS as f64);
                }
            }
        }
        Self { texels }
    }

    /// The disk that touches the grid's sides.
    pub fn of_disk() -> Self {
        let place = |i: usize| i as f64 + 0.5 - HALF;
        let rows = (0..SIDE).flat_map(|j| (0..SIDE).map(move |i| coverage(place(i), place(j), HALF)));
        Self { texels: rows.collect() }
    }

    /// The texels, row by row.
    pub fn texels(&self) -> &[f64] {
        &self.texels
    }

    /// ∫ L dA in texels².
    pub fn total(&self) -> f64 {
        self.texels.iter().sum()
    }

    /// Position, in texels from the centre, and luminance of each texel.
    pub(super) fn placed(&self) -> impl Iterator<Item = (DVec2, f64)> {
        let place = |i: usize| (i as f64) + 0.5 - HALF;
        self.texels.iter().enumerate().map(move |(i, l)| (DVec2::new(place(i % SIDE), place(i / SIDE)), *l))
    }

    /// The centroid of the light; the grid's centre where there is none.
    pub fn centroid(&self) -> DVec2 {
        let sum: DVec2 = self.placed().map(|(at, l)| at * l).sum();
        let total = self.total();
        if total > 0.0 { sum / total } else { DVec2::ZERO }
    }

    /// The radius of the uniform disk that is spread as widely about its centroid: √(2·mean square distance).
    pub fn radius(&self) -> f64 {
        let (centroid, total) = (self.centroid(), self.total());
        let sum: f64 = self.placed().map(|(at, l)| at.distance_squared(centroid) * l).sum();
        if total > 0.0 { (2.0 * sum / total).sqrt() } else { 0.0 }
    }
}

/// The texels of a line of the grid on which a source texel falls.
struct Share {
    from: f64,
    to: f64,
}

impl Share {
    /// Index of each texel, and how much of it is covered.
    fn targets(&self) -> impl Iterator<Item = (usize, f64)> {
        let (from, to) = (self.from, self.to);
        let first = index(from.floor());
        (first..SIDE)
            .map(move |i| (i, (to.min(i as f64 + 1.0) - from.max(i as f64)).max(0.0)))
            .take_while(move |(i, _)| (*i as f64) < to)
    }
}

/// Where `count` equal source texels fall that fill `side` texels about the middle of a line.
fn shares(count: usize, side: f64) -> Vec<Share> {
    let edge = |k: usize| (HALF + side * (k as f64 / count as f64 - 0.5)).clamp(0.0, SIDE as f64);
    (0..count).map(|k| Share { from: edge(k), to: edge(k + 1) }).collect()
}

/// An index on a line of the grid.
pub(super) fn index(place: f64) -> usize {
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a whole number of 0…SIDE")]
    let index = place.clamp(0.0, SIDE as f64) as usize;
    index
}

/// Adds `amount` times its covered share to each texel of a line between two places.
fn add_span(line: &mut [f64], from: f64, to: f64, amount: f64) {
    let span = Share { from: from.clamp(0.0, SIDE as f64), to: to.clamp(0.0, SIDE as f64) };
    for (i, share) in span.targets() {
        line[i] += amount * share;
    }
}

/// The parts of the row at height `y` inside an outline, left to right.
fn chords(outline: &[DVec2], y: f64) -> Vec<[f64; 2]> {
    let next = outline.iter().cycle().skip(1);
    let mut crossings: Vec<f64> = outline
        .iter()
        .zip(next)
        .filter(|(a, b)| (a.y > y) != (b.y > y))
        .map(|(a, b)| a.x + (y - a.y) / (b.y - a.y) * (b.x - a.x))
        .collect();
    crossings.sort_by(f64::total_cmp);
    crossings.chunks_exact(2).map(|pair| [pair[0], pair[1]]).collect()
}

impl Frame {
    /// A textured light's grid: its rows are the image's. With it, the rectangle's sides in texels.
    pub(super) fn of_textured(light: &TexturedEmitter) -> Option<(Self, DVec2)> {
        let sides = DVec2::new(light.row.length(), light.column.length());
        let texel = sides.max_element() / SIDE as f64;
        let frame = Self {
            center: light.point(0.5, 0.5),
            axis_u: light.row.try_normalize()?,
            axis_v: light.column.try_normalize()?,
            normal: light.normal,
            two_sided: light.two_sided,
            texel,
            is_round: false,
        };
        Some((frame, sides / texel))
    }

    /// A polygon's grid: about its bounding box along its first edge. With it, the corners in texels.
    pub(super) fn of_polygon(light: &PolygonEmitter) -> Option<(Self, Vec<DVec2>)> {
        let [first, second, ..] = light.vertices[..] else { return None };
        let axis_u = (second - first).try_normalize()?;
        let axis_v = light.normal.cross(axis_u);
        let flat = |vertex: &DVec3| DVec2::new((vertex - first).dot(axis_u), (vertex - first).dot(axis_v));
        let corners: Vec<DVec2> = light.vertices.iter().map(flat).collect();
        let low = corners.iter().copied().reduce(DVec2::min)?;
        let high = corners.iter().copied().reduce(DVec2::max)?;
        let (middle, texel) = (0.5 * (low + high), (high - low).max_element() / SIDE as f64);
        let center = first + middle.x * axis_u + middle.y * axis_v;
        let (normal, two_sided) = (light.normal, light.two_sided);
        let frame = Self { center, axis_u, axis_v, normal, two_sided, texel, is_round: false };
        (texel > 0.0).then(|| (frame, corners.iter().map(|corner| (corner - middle) / texel).collect()))
    }

    /// A disk's grid; its rows run any way.
    pub(super) fn of_disk(light: &DiskEmitter) -> Self {
        let (axis_u, axis_v) = light.normal.any_orthonormal_pair();
        let texel = light.radius / HALF;
        let DiskEmitter { center, normal, two_sided, .. } = *light;
        Self { center, axis_u, axis_v, normal, two_sided, texel, is_round: true }
    }

    /// A vector of the world in texels along the grid's axes.
    pub(super) fn flat(&self, v: DVec3) -> DVec2 {
        DVec2::new(v.dot(self.axis_u), v.dot(self.axis_v)) / self.texel
    }
}
