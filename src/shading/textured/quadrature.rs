//! Adaptive quadrature over a rectangle with a pattern, with an error bound.

use std::f64::consts::{PI, TAU};
use std::sync::atomic::{AtomicBool, Ordering};

use glam::{DVec2, DVec3};

use crate::light::TexturedEmitter;
use crate::light::pattern::{Channel, Span};
use crate::math::interpolation::{CHEBYSHEV, Grid, NODES, even_weights};
use crate::math::quadrature::Estimate;
use crate::math::spherical::triangle_solid_angle;

/// How luminance is spread over a rectangle, by shares u along its rows and v along its columns.
pub trait Distribution {
    /// The whole rectangle: its columns and its rows.
    fn whole(&self) -> [Span; 2];

    /// ∫ L ℓ_k ℓ_l du dv over a part, ℓ the polynomials of [`crate::math::interpolation`]. Indexed by row, then column.
    fn weights(&self, columns: &Span, rows: &Span) -> Grid;

    /// ∫ L du dv over a part: the sum of its weights.
    fn flux(&self, columns: &Span, rows: &Span) -> f64 {
        self.weights(columns, rows).iter().flatten().sum()
    }

    /// Whether L is smooth within a part.
    fn is_smooth(&self, columns: &Span, rows: &Span) -> bool;

    /// L at a point.
    fn value(&self, u: f64, v: f64) -> f64;
}

impl Distribution for Channel {
    fn whole(&self) -> [Span; 2] {
        self.size().map(Span::whole)
    }

    fn weights(&self, columns: &Span, rows: &Span) -> Grid {
        self.weights(columns, rows)
    }

    fn flux(&self, columns: &Span, rows: &Span) -> f64 {
        self.flux(columns, rows)
    }

    fn is_smooth(&self, columns: &Span, rows: &Span) -> bool {
        columns.is_within_texel() && rows.is_within_texel()
    }

    fn value(&self, u: f64, v: f64) -> f64 {
        self.value(u, v)
    }
}

/// What light is weighed with: a density over the directions, above two horizons.
#[derive(Clone, Copy, Debug)]
pub struct Weighing<F> {
    /// The density in a unit direction; smooth on a scale of [`Self::width`], across the horizons too.
    pub density: F,
    /// No density is above this.
    pub greatest: f64,
    /// Unit direction about which it is great.
    pub peak: DVec3,
    /// The angle about the peak in which it falls by the factor √e, radians.
    pub width: f64,
    /// At an angle θ from the peak it is at most exp(−½(θ/fall)²) times [`Self::greatest`]; infinite where nothing is known.
    pub fall: f64,
    /// Unit normals; directions below count nothing.
    pub horizons: [DVec3; 2],
}

/// The error sought.
#[derive(Clone, Copy, Debug)]
pub struct Sought<'a> {
    /// Relative to the integral.
    pub relative: f64,
    /// Relative to the greatest density times the solid angle of the rectangle or of the density, if that is smaller.
    pub absolute: f64,
    /// Parts that may be looked at.
    pub parts: usize,
    /// Set when the integral is not wanted any more; it is then whatever it has come to.
    pub cancel: Option<&'a AtomicBool>,
}

impl Sought<'_> {
    /// For pictures, which show no more: 1e-4 of what the light does, or 1e-5 of the most that it could.
    pub const PICTURE: Self = Self { relative: 1e-4, absolute: 1e-5, parts: 1 << 16, cancel: None };

    fn is_cancelled(&self) -> bool {
        self.cancel.is_some_and(|cancel| cancel.load(Ordering::Relaxed))
    }
}

impl Default for Sought<'_> {
    fn default() -> Self {
        Self { relative: 5e-7, absolute: 1e-10, parts: 1 << 20, cancel: None }
    }
}

/// The error of a polynomial on a rectangle is taken to be that many times its last coefficients.
const CAUTION: f64 = 4.0;

/// As [`CAUTION`], on a triangle: they need not fall fast where a horizon ends it and the density is a broken power there.
const CAUTION_AT_HORIZON: f64 = 16.0;

/// Parts that give less than this share of the error that is always small enough are not looked into.
const NEGLIGIBLE: f64 = 1.0 / 256.0;

/// A part is small enough where its half diagonal is below this share of its distance.
const NEAREST: f64 = 0.6;

/// A part is small enough where the angle to its corners is below this many widths of the density; farther than five
/// widths from the peak, where the density falls ever more steeply, that much less.
const WIDEST: f64 = 1.5;

/// ∫ L(ω) density(ω) dω over what a rectangle's lit side sends to p, L by `pattern`.
///
/// The rectangle is halved, part by part, until the sum of the parts' errors is as sought. On a part that no horizon
/// crosses, and that is small beside its distance and the density's width, density·dω/du dv is replaced by the
/// polynomial through its values at 8 × 8 Chebyshev nodes, whose products with L are known from
/// [`Distribution::weights`]: the cost depends on what the density does, not on how many texels there are. The error is
/// the polynomial's, estimated by its last coefficients, times ∫ L. A texel that a horizon crosses is cut there, and
/// what is above goes on as triangles. The integral over any other part is somewhere from 0 to what the greatest density
/// would give.
///
/// **Source:** derived here. **Domain:** any p; 0 in the rectangle's plane and behind it.
/// **Accuracy:** the bound, which is as sought unless the parts are used up.
pub fn integrate<F: Fn(DVec3) -> f64>(
    light: &TexturedEmitter,
    pattern: &impl Distribution,
    p: DVec3,
    weighing: &Weighing<F>,
    sought: Sought<'_>,
) -> Estimate {
    let Some(mut view) = View::new(light, pattern, p, weighing) else { return Estimate::default() };
    let absolute = sought.absolute * weighing.greatest * view.solid_angle().min(TAU * weighing.width.powi(2));
    view.negligible = NEGLIGIBLE * absolute;
    let [columns, rows] = pattern.whole();
    let mut parts = Vec::with_capacity(64);
    view.rectangle(columns, rows, &mut parts);
    let mut looked_at = parts.len();
    loop {
        let (mut total, mut worst) = (Estimate::default(), 0.0_f64);
        for part in &parts {
            total = total + part.estimate;
            worst = worst.max(part.estimate.error);
        }
        let enough = absolute.max(sought.relative * total.value);
        let mut is_done = true;
        if total.error > enough && looked_at < sought.parts {
            // Parts below their share of what is enough, or far below the worst, stay as they are for now.
            let threshold = (enough / parts.len() as f64).max(worst / 64.0);
            let mut next = Vec::with_capacity(2 * parts.len());
            for part in parts.drain(..) {
                if part.estimate.error > threshold && !sought.is_cancelled() && view.halve(&part, &mut next) {
                    is_done = false;
                    looked_at += 2;
                } else {
                    next.push(part);
                }
            }
            parts = next;
        }
        if is_done {
            let rounding = 16.0 * f64::EPSILON * view.conditioning() * total.value;
            return Estimate { error: total.error + rounding, ..total };
        }
    }
}

/// A part of the rectangle.
#[derive(Clone, Copy, Debug)]
enum Region {
    /// Columns and rows.
    Rectangle(Span, Span),
    /// Corners (u, v) of a part that no horizon crosses, in which the pattern is smooth.
    Triangle([DVec2; 3]),
}

/// A part, what comes from it, and where to halve it.
#[derive(Clone, Copy, Debug)]
struct Part {
    region: Region,
    estimate: Estimate,
    /// Between columns rather than rows; only for rectangles.
    across: bool,
}

/// The rectangle seen from p, at the origin.
struct View<'a, P, F> {
    pattern: &'a P,
    weighing: &'a Weighing<F>,
    corner: DVec3,
    row: DVec3,
    column: DVec3,
    area: f64,
    /// Distance of p from the plane.
    height: f64,
    /// Distance of the farthest corner.
    extent: f64,
    /// Parts that cannot give more are not looked into.
    negligible: f64,
}

impl<'a, P: Distribution, F: Fn(DVec3) -> f64> View<'a, P, F> {
    /// `None` where the rectangle does not shine on p.
    fn new(light: &TexturedEmitter, pattern: &'a P, p: DVec3, weighing: &'a Weighing<F>) -> Option<Self> {
        let corners = light.corners().map(|corner| corner - p);
        let nearest = corners.into_iter().min_by(|a, b| a.length().total_cmp(&b.length()))?;
        let extent = corners.iter().map(|corner| corner.length()).fold(0.0, f64::max);
        let depth = -light.normal.dot(nearest);
        let height = if light.two_sided { depth.abs() } else { depth };
        let (corner, row, column) = (corners[0], light.row, light.column);
        let view = Self { pattern, weighing, corner, row, column, area: light.area(), height, extent, negligible: 0.0 };
        (height > 1e-14 * extent && view.area > 0.0).then_some(view)
    }

    fn point(&self, u: f64, v: f64) -> DVec3 {
        self.corner + u * self.row + v * self.column
    }

    fn solid_angle(&self) -> f64 {
        let [a, b, c, d] = [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)].map(|(u, v)| self.point(u, v));
        (triangle_solid_angle(a, b, c) + triangle_solid_angle(a, c, d)).abs()
    }

    /// By how much the rounding of the inputs about p may grow.
    fn conditioning(&self) -> f64 {
        1.0 + self.extent / self.height + self.extent / self.row.length().min(self.column.length())
    }

    /// The integrand at a point of the rectangle: density × dω/dA.
    fn integrand(&self, x: DVec3) -> f64 {
        let distance = x.length();
        (self.weighing.density)(x / distance) * self.height / distance.powi(3)
    }

    /// What is known of the integrand within a distance of a point of the rectangle, in a part of that flux.
    fn bound(&self, centre: DVec3, radius: f64, flux: f64) -> Bound {
        let distance = centre.length();
        let Weighing { greatest, peak, width, fall, .. } = *self.weighing;
        let nearest = (distance - radius).max(self.height);
        let sine = radius / distance;
        let angular_radius = if sine < 1.0 { sine.asin() } else { PI };
        let from_peak = peak.cross(centre).length().atan2(peak.dot(centre));
        let falls = (-0.5 * ((from_peak - angular_radius).max(0.0) / fall).powi(2)).exp();
        let most = greatest * falls * self.height / nearest.powi(3);
        if flux * most <= self.negligible {
            return Bound::UpTo(most);
        }
        let steepness = (0.2 * (from_peak + angular_radius).min(10.0 * fall) / width).max(1.0);
        if sine <= NEAREST && angular_radius * steepness <= WIDEST * width { Bound::Smooth } else { Bound::UpTo(most) }
    }

    /// Adds what comes from a rectangle, in as many parts as the horizons make of it.
    fn rectangle(&self, columns: Span, rows: Span, parts: &mut Vec<Part>) {
        let corners = [(columns.lo, rows.lo), (columns.hi, rows.lo), (columns.hi, rows.hi), (columns.lo, rows.hi)];
        let corners = corners.map(|(u, v)| DVec2::new(u, v));
        let mut is_crossed = false;
        for normal in self.weighing.horizons {
            let heights = corners.map(|corner| self.above(normal, corner));
            if heights.iter().all(|height| *height <= 0.0) {
                return;
            }
            is_crossed |= heights.iter().any(|height| *height < 0.0);
        }
        let (u, v) = (columns.at(0.0), rows.at(0.0));
        if is_crossed && self.pattern.is_smooth(&columns, &rows) {
            return self.clipped(&corners, parts);
        }
        let flux = self.area * self.pattern.flux(&columns, &rows);
        if flux <= 0.0 {
            return;
        }
        let extent = DVec2::new(columns.length() * self.row.length(), rows.length() * self.column.length());
        let (estimate, across) = match self.bound(self.point(u, v), 0.5 * extent.length(), flux) {
            Bound::UpTo(greatest) => (up_to(flux * greatest), extent.x > extent.y),
            Bound::Smooth => {
                let values = self.values(&columns, &rows);
                let tails = tails(&values);
                let across = tails[0] > tails[1];
                if is_crossed {
                    let greatest = values.iter().flatten().fold(0.0, |greatest: f64, value| greatest.max(value.abs()));
                    (up_to(flux * (2.0 * greatest + tails[0] + tails[1])), extent.x > extent.y)
                } else {
                    let weights = self.pattern.weights(&columns, &rows);
                    let error = CAUTION * flux * (tails[0] + tails[1]);
                    (Estimate { value: self.area * product(&weights, &values), error }, across)
                }
            }
        };
        parts.push(Part { region: Region::Rectangle(columns, rows), estimate, across });
    }

    /// The integrand at the nodes of a rectangle.
    fn values(&self, columns: &Span, rows: &Span) -> Grid {
        let nodes = &CHEBYSHEV.nodes;
        let mut values = Grid::default();
        for (row, y) in values.iter_mut().zip(nodes) {
            let start = self.corner + rows.at(*y) * self.column;
            for (value, x) in row.iter_mut().zip(nodes) {
                *value = self.integrand(start + columns.at(*x) * self.row);
            }
        }
        values
    }

    /// How far a point is above a horizon, which rounding cannot put on its other side.
    fn above(&self, normal: DVec3, corner: DVec2) -> f64 {
        let above = normal.dot(self.point(corner.x, corner.y));
        if above.abs() <= 1e-14 * self.extent { 0.0 } else { above }
    }

    /// Adds what comes from a convex polygon in which the pattern is smooth, as far as it is above the horizons.
    fn clipped(&self, corners: &[DVec2], parts: &mut Vec<Part>) {
        let mut corners = corners.to_vec();
        for normal in self.weighing.horizons {
            corners = clip(&corners, |corner| self.above(normal, corner));
        }
        let Some((first, rest)) = corners.split_first() else { return };
        parts.extend(rest.windows(2).filter_map(|pair| self.triangle([*first, pair[0], pair[1]])));
    }

    /// What comes from a triangle: a square, of which one side is drawn together in the first corner.
    fn triangle(&self, corners: [DVec2; 3]) -> Option<Part> {
        let [a, b, c] = corners;
        let double_area = self.area * (b - a).perp_dot(c - a).abs();
        if double_area <= 0.0 {
            return None;
        }
        let centre = (a + b + c) / 3.0;
        let points = corners.map(|corner| self.point(corner.x, corner.y));
        let middle = self.point(centre.x, centre.y);
        let radius = points.iter().map(|point| point.distance(middle)).fold(0.0, f64::max);
        let level = |at: DVec2| self.pattern.value(at.x, at.y);
        // Not at the corners themselves, which other texels share.
        let levels = corners.map(|corner| level(centre.lerp(corner, 0.999)));
        let greatest_level = levels.into_iter().fold(level(centre), f64::max);
        let estimate = match self.bound(middle, radius, 0.5 * double_area * greatest_level) {
            Bound::UpTo(greatest) => up_to(0.5 * double_area * greatest * greatest_level),
            Bound::Smooth => {
                let values = CHEBYSHEV.nodes.map(|y| {
                    let across = b.lerp(c, 0.5 + 0.5 * y);
                    CHEBYSHEV.nodes.map(|x| {
                        let share = 0.5 + 0.5 * x;
                        let at = a.lerp(across, share);
                        share * level(at) * self.integrand(self.point(at.x, at.y))
                    })
                });
                let tails = tails(&values);
                let value = product(&even_weights(0.25 * double_area), &values);
                Estimate { value, error: CAUTION_AT_HORIZON * double_area * (tails[0] + tails[1]) }
            }
        };
        Some(Part { region: Region::Triangle(corners), estimate, across: false })
    }

    /// Adds the halves of a part; `false` where numbers cannot tell them apart.
    fn halve(&self, part: &Part, parts: &mut Vec<Part>) -> bool {
        match part.region {
            Region::Rectangle(columns, rows) => {
                let [of_columns, of_rows] = [columns.halves(), rows.halves()];
                let halves = match (of_columns, of_rows) {
                    (Some(halves), of_rows) if part.across || of_rows.is_none() => halves.map(|half| (half, rows)),
                    (_, Some(halves)) => halves.map(|half| (columns, half)),
                    (_, None) => return false,
                };
                halves.into_iter().for_each(|(columns, rows)| self.rectangle(columns, rows, parts));
                true
            }
            Region::Triangle([a, b, c]) => {
                let length = |from: DVec2, to: DVec2| self.point(from.x, from.y).distance(self.point(to.x, to.y));
                let turned = [[a, b, c], [b, c, a], [c, a, b]];
                let longest = |x: &&[DVec2; 3], y: &&[DVec2; 3]| length(x[0], x[1]).total_cmp(&length(y[0], y[1]));
                let [a, b, c] = *turned.iter().max_by(longest).unwrap_or(&[a, b, c]);
                let middle = 0.5 * (a + b);
                let is_done = middle == a || middle == b;
                if !is_done {
                    parts.extend([[a, middle, c], [middle, b, c]].into_iter().filter_map(|half| self.triangle(half)));
                }
                !is_done
            }
        }
    }
}

/// What is known of the integrand in a part.
enum Bound {
    /// It is between 0 and this.
    UpTo(f64),
    /// It is smooth enough for a polynomial.
    Smooth,
}

/// Somewhere between 0 and `greatest`.
fn up_to(greatest: f64) -> Estimate {
    Estimate { value: 0.5 * greatest, error: 0.5 * greatest }
}

/// Σ w_kl f_kl.
fn product(weights: &Grid, values: &Grid) -> f64 {
    weights.iter().flatten().zip(values.iter().flatten()).map(|(weight, value)| weight * value).sum()
}

/// The greatest tail of the polynomials along the rows, and of those along the columns.
fn tails(values: &Grid) -> [f64; 2] {
    let greatest = |tail: &dyn Fn(usize) -> f64| (0..NODES).map(tail).fold(0.0, f64::max);
    [greatest(&|l| CHEBYSHEV.tail(|k| values[l][k])), greatest(&|k| CHEBYSHEV.tail(|l| values[l][k]))]
}

/// The part of a convex polygon at whose corners and between which a linear function is not negative.
fn clip(corners: &[DVec2], above: impl Fn(DVec2) -> f64) -> Vec<DVec2> {
    let mut clipped = Vec::with_capacity(corners.len() + 1);
    for (a, b) in corners.iter().zip(corners.iter().cycle().skip(1)) {
        let (above_a, above_b) = (above(*a), above(*b));
        if above_a >= 0.0 {
            clipped.push(*a);
        }
        if (above_a > 0.0 && above_b < 0.0) || (above_a < 0.0 && above_b > 0.0) {
            clipped.push(a.lerp(*b, above_a / (above_a - above_b)));
        }
    }
    clipped
}
