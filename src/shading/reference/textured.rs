//! Rectangles with patterns by nested quadrature in longitude and latitude about an axis in their plane.

use std::f64::consts::FRAC_PI_2;
use std::sync::LazyLock;

use glam::DVec3;

use super::{Kernel, split};
use crate::light::TexturedEmitter;
use crate::math::quadrature::{Estimate, GaussLegendre, adaptive, adaptive_graded};

/// A texel of less than this half diagonal, as a share of its distance, and of the lobe's width, is far away.
const FAR: f64 = 0.05;

/// Luminance over a rectangle, by shares u along its rows and v along its columns.
pub trait Luminance {
    /// At a point.
    fn at(&self, u: f64, v: f64) -> f64;

    /// Where along the row at v it is not smooth.
    fn breaks_along(&self, v: f64) -> Vec<f64>;

    /// At which rows the breaks are not smooth.
    fn breaks_across(&self) -> Vec<f64>;
}

/// A constant luminance.
struct Even(f64);

impl Luminance for Even {
    fn at(&self, _: f64, _: f64) -> f64 {
        self.0
    }

    fn breaks_along(&self, _: f64) -> Vec<f64> {
        Vec::new()
    }

    fn breaks_across(&self) -> Vec<f64> {
        Vec::new()
    }
}

/// ∫ L weight(ω) dω over a textured light seen from p, texel by texel.
///
/// A texel that is far away, and that no horizon crosses, is integrated by 3 × 3 Gauss–Legendre nodes, with ten times the
/// distance from 2 × 2 as error; any other as a [`rectangle_reference`] of its own. Cancelled, it is whatever it has come to.
pub fn textured_reference(light: &TexturedEmitter, p: DVec3, kernel: &Kernel) -> Estimate {
    let [columns, rows] = light.pattern.size();
    let (row, column) = (light.row / f64::from(columns), light.column / f64::from(rows));
    let texels = light.pattern.texels().chunks_exact(light.pattern.width());
    let mut sum = Estimate::default();
    for (j, texels) in (0..rows).zip(texels) {
        for (i, texel) in (0..columns).zip(texels).filter(|(_, texel)| **texel > 0.0) {
            if kernel.is_cancelled() {
                return sum;
            }
            let corner = light.corner + f64::from(i) * row + f64::from(j) * column;
            let part = Rectangle { corner: corner - p, row, column, normal: light.normal, two_sided: light.two_sided };
            let level = f64::from(*texel);
            sum = sum + part.far(kernel).unwrap_or_else(|| part.near(kernel, &Even(1.0))) * level;
        }
    }
    sum
}

/// ∫ L weight(ω) dω over a light's rectangle seen from p, its pattern replaced by `luminance`.
///
/// With y across the rows and x along them, both from the foot of p, β = atan(y/h) and φ = atan(x/√(h² + y²)) are
/// longitude and latitude, dω = cos φ dφ dβ: a row is an arc of constant β.
pub fn rectangle_reference(light: &TexturedEmitter, p: DVec3, kernel: &Kernel, luminance: &impl Luminance) -> Estimate {
    let TexturedEmitter { corner, row, column, normal, two_sided, .. } = *light;
    Rectangle { corner: corner - p, row, column, normal, two_sided }.near(kernel, luminance)
}

/// A rectangle seen from the origin.
struct Rectangle {
    corner: DVec3,
    row: DVec3,
    column: DVec3,
    normal: DVec3,
    two_sided: bool,
}

/// Gauss–Legendre rules of 2 and 3 nodes.
static RULES: LazyLock<[GaussLegendre; 2]> = LazyLock::new(|| [2, 3].map(GaussLegendre::new));

impl Rectangle {
    fn corners(&self) -> [DVec3; 4] {
        let Self { corner, row, column, .. } = *self;
        [corner, corner + row, corner + column, corner + row + column]
    }

    /// Signed distance of the plane, positive on the lit side; none where it does not shine.
    fn height(&self) -> Option<f64> {
        let nearest = self.corners().into_iter().min_by(|a, b| a.length().total_cmp(&b.length()))?;
        let height = -self.normal.dot(nearest);
        let lit = height > 0.0 || self.two_sided;
        (lit && height.abs() > 1e-14 * nearest.length().max(self.row.length())).then_some(height)
    }

    /// The integral by a few nodes; `None` where that would not do.
    fn far(&self, kernel: &Kernel) -> Option<Estimate> {
        let Some(height) = self.height() else { return Some(Estimate::default()) };
        let Self { corner, row, column, .. } = *self;
        let center = corner + 0.5 * (row + column);
        let radius = 0.5 * row.length().hypot(column.length());
        let spread = radius / center.length();
        if spread * kernel.exponent.sqrt() > FAR {
            return None;
        }
        for normal in kernel.horizons() {
            let above = normal.dot(center);
            if above < -radius {
                return Some(Estimate::default());
            } else if above < radius {
                return None;
            }
        }
        let area = row.cross(column).length();
        let by = |rule: &GaussLegendre| {
            rule.integrate(0.0, 1.0, |v| {
                rule.integrate(0.0, 1.0, |u| {
                    let x = corner + u * row + v * column;
                    let distance = x.length();
                    kernel.weight(x / distance).value * height.abs() / distance.powi(3)
                })
            })
        };
        let [coarse, fine] = [&RULES[0], &RULES[1]].map(|rule| area * by(rule));
        let rounding = 8.0 * f64::EPSILON * (kernel.exponent + center.length() / height.abs()) * fine;
        Some(Estimate { value: fine, error: 10.0 * (fine - coarse).abs() * spread * kernel.exponent.sqrt() + rounding })
    }

    fn near(&self, kernel: &Kernel, luminance: &impl Luminance) -> Estimate {
        let Some(view) = View::new(self) else { return Estimate::default() };
        let [bottom, top] = [view.bottom, view.bottom + view.depth];
        let crossings = kernel.horizons().flat_map(|normal| view.crossings(normal));
        let (peak, spread) = view.longitude_of(kernel.axis);
        let peaks = kernel.peak_offsets().map(|offset| peak + spread * offset);
        let meeting = kernel.horizon.map(|normal| normal.cross(kernel.axis));
        let meetings = meeting.into_iter().flat_map(|at| [view.longitude_of(at).0, view.longitude_of(-at).0]);
        let across = luminance.breaks_across().into_iter().map(|v| view.longitude(view.bottom + v * view.depth));
        let breaks = crossings.chain(peaks).chain(meetings).chain(across);
        let breaks = split(view.longitude(bottom), view.longitude(top), breaks);
        let estimate = adaptive_graded(&breaks, kernel.outer(), |beta| view.row(beta, kernel, luminance));
        let width = (view.longitude(top) - view.longitude(bottom)).max(f64::MIN_POSITIVE);
        let reach = self.corners().into_iter().map(|corner| corner.length()).fold(0.0, f64::max);
        let conditioning = width.recip() + reach / view.height + reach / view.width.min(view.depth);
        Estimate { error: estimate.error + 8.0 * f64::EPSILON * conditioning * estimate.value, ..estimate }
    }
}

/// A rectangle in the coordinates of its own plane about the foot of p.
struct View {
    /// Where its rows start and its columns start, from the foot.
    left: f64,
    bottom: f64,
    width: f64,
    depth: f64,
    height: f64,
    /// Unit directions along the rows, along the columns, and to the plane.
    axes: [DVec3; 3],
}

impl View {
    fn new(rectangle: &Rectangle) -> Option<Self> {
        let height = rectangle.height()?;
        let [along, across] = [rectangle.row, rectangle.column].map(|side| side.try_normalize());
        let (along, across, ahead) = (along?, across?, -height.signum() * rectangle.normal);
        Some(Self {
            left: rectangle.corner.dot(along),
            bottom: rectangle.corner.dot(across),
            width: rectangle.row.length(),
            depth: rectangle.column.length(),
            height: height.abs(),
            axes: [along, across, ahead],
        })
    }

    fn longitude(&self, y: f64) -> f64 {
        y.atan2(self.height)
    }

    /// The longitude of a direction, and how much wider an angle about it looks in longitude.
    fn longitude_of(&self, direction: DVec3) -> (f64, f64) {
        let [_, across, ahead] = self.axes;
        let (y, z) = (direction.dot(across), direction.dot(ahead));
        (y.atan2(z), y.hypot(z).max(0.05).recip())
    }

    /// Longitudes at which the horizon of `normal` meets the columns at both sides.
    fn crossings(&self, normal: DVec3) -> impl Iterator<Item = f64> {
        let [along, across, ahead] = self.axes.map(|axis| axis.dot(normal));
        [self.left, self.left + self.width]
            .into_iter()
            .map(move |x| self.longitude(-(x * along + self.height * ahead) / across))
            .filter(|beta| beta.is_finite())
    }

    /// ∫ L weight cos φ dφ over the row at longitude β.
    fn row(&self, beta: f64, kernel: &Kernel, luminance: &impl Luminance) -> Estimate {
        let (sine, cosine) = beta.sin_cos();
        let (y, distance) = (self.height * sine / cosine, self.height / cosine);
        let v = (y - self.bottom) / self.depth;
        let latitude = |x: f64| x.atan2(distance);
        let [along, across, ahead] = self.axes;
        let outward = sine * across + cosine * ahead;
        let direction = |phi: f64| phi.cos() * outward + phi.sin() * along;
        let nearest_to = |normal: DVec3| normal.dot(along).atan2(normal.dot(outward));
        let peak = nearest_to(kernel.axis);
        let horizon_ends = kernel.horizons().map(nearest_to).flat_map(|at| [at - FRAC_PI_2, at + FRAC_PI_2]);
        let peaks = kernel.peak_offsets().map(|offset| peak + offset);
        let along_row = luminance.breaks_along(v).into_iter().map(|u| latitude(self.left + u * self.width));
        let ends = [self.left, self.left + self.width].map(latitude);
        let breaks = split(ends[0], ends[1], horizon_ends.chain(peaks).chain(along_row));
        let visible = breaks.windows(2).filter(|ends| kernel.sees(direction(0.5 * (ends[0] + ends[1]))));
        adaptive(visible.map(|ends| (ends[0], ends[1])), kernel.inner(), |phi| {
            let u = (distance * phi.tan() - self.left) / self.width;
            kernel.weight(direction(phi)) * (luminance.at(u, v) * phi.cos())
        })
    }
}
