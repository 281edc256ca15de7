//! The Phong lobe over a disk, exactly.

use std::f64::consts::{FRAC_PI_2, TAU};
use std::sync::LazyLock;

use glam::DVec3;

use super::cone::{Chord, Cone, Cut};
use crate::light::DiskEmitter;
use crate::math::quadrature::GaussLegendre;
use crate::math::special::{GAUSS_24, NEGLIGIBLE_LN};

/// (m+1)/(2π) ∫ (r·ω)ᵐ dω over a disk of luminance 1 where r·ω > 0 and n·ω > 0.
///
/// By Stokes' theorem in polar coordinates (z, ψ) about r, for any constant c: I = (1/2π) ∮ (c − zᵐ⁺¹) dψ over the boundary
/// of that region, plus 1 − c where r is inside it. c = 1 removes the singularity of dψ for r near the boundary; far from it
/// c = z₀ᵐ⁺¹, z₀ in the middle, removes the cancellation. Four kinds of arc occur: of the rim, of n's horizon, of r's
/// horizon, where the integrand is c, and those where zᵐ⁺¹ is negligible, c Δψ. The rest takes 24 Gauss–Legendre nodes
/// in panels over which z changes by no more than these resolve: of 8.8/√(m+1) radians at most, and about the points of
/// the rim farthest from the cone's axis, where it bends within κ = cos β/cos α, in asinh(δ/κ). The rim of a narrow
/// cone runs to and fro with nearly the same z: there zᵐ is integrated over the disk's area instead.
///
/// **Source:** derived here, after [`crate::refs::SNYDER_1996`], §3.2 and eq. (9). **Domain:** unit `n`, `r`; any real m ≥ 1;
/// either side of the disk; 0 for p in its plane. **Units:** 1 per cd·m⁻².
/// **Accuracy:** 5e-13 of the smaller of 1 and (m+1)/(2π)·Ω, relative 2e-11 for more than a millionth of that
/// (`closed_form::disk`). **Twin:** `shaders/disk.wgsl`.
pub fn disk_phong(light: &DiskEmitter, p: DVec3, n: DVec3, r: DVec3, m: f64) -> f64 {
    Cone::new(light, p).map_or(0.0, |cone| phong(&cone, Some(n), r, m))
}

/// [`disk_phong`] over r·ω > 0 only, which is [`crate::refs::SNYDER_1996`], eq. (9), as printed.
pub fn disk_phong_lobe_only(light: &DiskEmitter, p: DVec3, r: DVec3, m: f64) -> f64 {
    Cone::new(light, p).map_or(0.0, |cone| phong(&cone, None, r, m))
}

/// The solid angle that a disk fills as seen from p.
pub fn disk_solid_angle(light: &DiskEmitter, p: DVec3) -> f64 {
    Cone::new(light, p).map_or(0.0, |cone| TAU * phong(&cone, None, cone.axes[2], 0.0))
}

fn phong(cone: &Cone, n: Option<DVec3>, r: DVec3, m: f64) -> f64 {
    let r = cone.local(r);
    let n = n.map(|n| cone.local(n));
    let lobe_cut = cone.cut(r);
    // A second horizon that is the first takes nothing off.
    let n = n.filter(|n| n.cross(r) != DVec3::ZERO || n.dot(r) <= 0.0);
    let surface_cut = n.map_or(Cut::Above, |n| cone.cut(n));
    if matches!(lobe_cut, Cut::Below) || matches!(surface_cut, Cut::Below) {
        return 0.0;
    }
    let surface = n.unwrap_or(r);
    if cone.sin_a < 0.02 * cone.sin_b && (m + 1.0) * cone.sin_a * cone.sin_b < 0.04 {
        let horizons = [(r, lobe_cut), (surface, surface_cut)];
        return (m + 1.0) / TAU * area_integral(cone, &horizons, m, |direction| r.dot(direction).max(0.0).powf(m));
    }
    (Contour::new(cone, r, m).integral(lobe_cut, surface, surface_cut) / TAU).max(0.0)
}

/// The constant c of [`disk_phong`].
#[derive(Clone, Copy, Debug)]
enum Offset {
    /// c = 1.
    One,
    /// c = z₀ᵐ⁺¹, z₀ on the cone's axis; holds c.
    Middle(f64),
    /// c = 0.
    Zero,
}

/// The boundary of what a lobe sees of a disk, in the cone's axes.
struct Contour<'a> {
    cone: &'a Cone,
    r: DVec3,
    power: f64,
    offset: Offset,
    /// zᵐ⁺¹ is negligible where z is below this.
    z_cut: f64,
    /// Longest panel, radians.
    longest: f64,
}

/// A point of a curve: its unit direction less the cone's axis, and ω × dω/du.
struct Node {
    offset: DVec3,
    turning: DVec3,
}

/// A piece of a curve: how many panels it needs at least, and its points.
struct Piece<F> {
    from: f64,
    to: f64,
    /// No panel is wider than this.
    width: f64,
    /// No greater than the length of dω/du anywhere.
    speed: f64,
    node: F,
}

impl<'a> Contour<'a> {
    fn new(cone: &'a Cone, r: DVec3, m: f64) -> Self {
        let power = m + 1.0;
        let sin_omega = r.truncate().length();
        // The cone lies within β of its axis.
        let offset = if cone.sin_b >= 0.5 * sin_omega && r.z > -cone.sin_b {
            Offset::One
        } else if r.z > cone.sin_b {
            Offset::Middle(r.z.powf(power))
        } else {
            Offset::Zero
        };
        let inside = sin_omega <= cone.sin_b && r.z > 0.0;
        let highest = if inside { 1.0 } else { cone.cos_b * r.z + cone.sin_b * sin_omega };
        Self { cone, r, power, offset, z_cut: highest * (-NEGLIGIBLE_LN / power).exp(), longest: 8.8 / power.sqrt() }
    }

    /// 2π I.
    fn integral(&self, lobe_cut: Cut, n: DVec3, surface_cut: Cut) -> f64 {
        let mut sum = match (lobe_cut, surface_cut) {
            (Cut::Above, Cut::Above) => self.rim(0.0, TAU),
            _ => self.rim_above(self.cone.rim_above(lobe_cut), self.cone.rim_above(surface_cut)),
        };
        // The chords of horizons that are nearly one are halved by one and the same vector, so that they add up.
        let both = n.cross(self.r);
        let crossed = matches!((lobe_cut, surface_cut), (Cut::Across(_), Cut::Across(_)));
        if let Cut::Across(chord) = surface_cut {
            let arc = GreatArc::new(self.cone, &chord, n);
            let above = if crossed { arc.above(both.cross(n)) } else { Some([-arc.half, arc.half]) };
            sum += above.map_or(0.0, |above| self.surface_horizon(&arc, above));
        }
        if let Cut::Across(chord) = lobe_cut {
            let arc = GreatArc::new(self.cone, &chord, self.r);
            let above = if crossed { arc.above(self.r.cross(both)) } else { Some([-arc.half, arc.half]) };
            sum += self.constant() * above.map_or(0.0, |[from, to]| to - from);
        }
        sum
    }

    /// The parts of the rim in two intervals of t, of which at most one is the whole rim.
    fn rim_above(&self, one: [f64; 2], other: [f64; 2]) -> f64 {
        let turned = [-TAU, 0.0, TAU].map(|turn| [one[0].max(other[0] + turn), one[1].min(other[1] + turn)]);
        turned.into_iter().filter(|[from, to]| from < to).map(|[from, to]| self.rim(from, to)).sum()
    }

    /// c.
    fn constant(&self) -> f64 {
        match self.offset {
            Offset::One => 1.0,
            Offset::Middle(power) => power,
            Offset::Zero => 0.0,
        }
    }

    /// c − zᵐ⁺¹ from ρ² = 1 − z² and z − z₀.
    fn weight(&self, rho_squared: f64, above_middle: f64) -> f64 {
        let middle = self.r.z;
        match self.offset {
            Offset::One => -(0.5 * self.power * (-rho_squared.min(1.0)).ln_1p()).exp_m1(),
            Offset::Middle(power) => -power * (self.power * (above_middle / middle).max(-1.0).ln_1p()).exp_m1(),
            Offset::Zero => -(middle + above_middle).max(0.0).powf(self.power),
        }
    }

    /// (c − zᵐ⁺¹) dψ/du.
    fn integrand(&self, node: &Node) -> f64 {
        let direction = node.offset + DVec3::Z;
        let rho_squared = self.r.cross(direction).length_squared();
        let weight = self.weight(rho_squared, self.r.dot(node.offset));
        weight * self.r.dot(node.turning) / rho_squared.max(f64::MIN_POSITIVE)
    }

    /// ∫ (c − zᵐ⁺¹) dψ over a piece.
    fn piece(&self, piece: &Piece<impl Fn(f64) -> Node>) -> f64 {
        let Piece { from, to, width, speed, ref node } = *piece;
        let count = ((to - from) / width.min(self.longest / speed)).ceil().max(1.0);
        let step = (to - from) / count;
        let graded = self.power < 24.0 && self.power.fract() != 0.0;
        let mut sum = 0.0;
        let mut i = 0.0;
        while i < count {
            let (lo, hi) = (from + i * step, if i + 1.0 < count { from + (i + 1.0) * step } else { to });
            let middle = node(0.5 * (lo + hi));
            let height = self.r.dot(middle.offset + DVec3::Z);
            // No more than half of the panel's length above the middle.
            let reach = 0.5 * step * speed;
            let (sin, cos) = reach.min(FRAC_PI_2).sin_cos();
            let highest =
                if height >= cos { 1.0 } else { height * cos + (1.0 - height * height).max(0.0).sqrt() * sin };
            sum += if highest <= self.z_cut {
                self.constant() * self.azimuth(&node(lo), &node(hi))
            } else if graded {
                // t²(3 − 2t) makes both ends, which may lie on r's horizon, smooth for low real m.
                let width = hi - lo;
                let graded = |t: f64| 6.0 * t * (1.0 - t) * self.integrand(&node(lo + width * t * t * (3.0 - 2.0 * t)));
                width * GAUSS_24.integrate(0.0, 1.0, graded)
            } else {
                GAUSS_24.integrate(lo, hi, |u| self.integrand(&node(u)))
            };
            i += 1.0;
        }
        sum
    }

    /// The change of ψ between points less than a half turn apart.
    fn azimuth(&self, from: &Node, to: &Node) -> f64 {
        let (u, v) = (from.offset + DVec3::Z, to.offset + DVec3::Z);
        self.r.dot(u.cross(v)).atan2(self.r.cross(u).dot(self.r.cross(v)))
    }

    /// The rim from t = `from` to `to`, quarter by quarter.
    fn rim(&self, from: f64, to: f64) -> f64 {
        let Cone { sin_a, cos_a, sin_b, cos_b, .. } = *self.cone;
        let bend = cos_b / cos_a;
        let mut sum = 0.0;
        let mut quarter = (from / FRAC_PI_2).floor();
        while quarter * FRAC_PI_2 < to {
            let (lo, hi) = (from.max(quarter * FRAC_PI_2), to.min((quarter + 1.0) * FRAC_PI_2));
            // The rim bends at t = ±π/2, the start of odd quarters and the end of even ones.
            let odd = quarter.rem_euclid(2.0) > 0.5;
            let (corner, side) = if odd { (quarter, 1.0) } else { (quarter + 1.0, -1.0) };
            let up = if corner.rem_euclid(4.0) < 2.0 { 1.0 } else { -1.0 };
            let corner = corner * FRAC_PI_2;
            let ends = [lo, hi].map(|t| side * ((t - corner).abs() / bend).asinh());
            let node = |u: f64| {
                // δ from the corner, so that t = corner + δ.
                let delta = bend * u.sinh();
                let (sin, cos) = delta.sin_cos();
                let (cos_t, sin_t) = (-up * sin, up * cos);
                let (x, y) = (sin_a * cos_t, sin_b * sin_t);
                let z = (cos_a * cos_t).hypot(cos_b * sin_t);
                let turning =
                    DVec3::new(-sin_b * cos_a * cos_a * cos_t / z, -sin_a * cos_b * cos_b * sin_t / z, sin_a * sin_b);
                Node { offset: below_pole(DVec3::new(x, y, z)), turning: turning * bend * u.cosh() }
            };
            sum += self.piece(&Piece { from: ends[0], to: ends[1], width: 3.2, speed: 1.9 * sin_b, node });
            quarter += 1.0;
        }
        sum
    }

    /// The part of n's horizon within the disk and above r's.
    fn surface_horizon(&self, arc: &GreatArc, [from, to]: [f64; 2]) -> f64 {
        let turning = arc.middle.cross(arc.along);
        let node = |u: f64| {
            let (sin, cos) = u.sin_cos();
            let direction = cos * arc.middle + sin * arc.along;
            Node { offset: below_pole(direction), turning }
        };
        self.piece(&Piece { from, to, width: 1.6, speed: 1.0, node })
    }
}

/// ω − Z without cancellation for ω near Z.
fn below_pole(direction: DVec3) -> DVec3 {
    let DVec3 { x, y, z } = direction;
    DVec3::new(x, y, if z > 0.0 { -(x * x + y * y) / (1.0 + z) } else { z - 1.0 })
}

/// The arc that a horizon cuts out of the disk, counter-clockwise about its part above the horizon.
struct GreatArc {
    middle: DVec3,
    along: DVec3,
    /// Half of its angle.
    half: f64,
}

impl GreatArc {
    fn new(cone: &Cone, chord: &Chord, n: DVec3) -> Self {
        let [end, start] = chord.ends().map(|at| cone.direction(at));
        let (sum, difference) = (start + end, end - start);
        let (length, width) = (sum.length(), difference.length());
        let along = difference.try_normalize().unwrap_or_else(|| start.any_orthonormal_vector());
        // The sum loses its direction where the ends are nearly opposite.
        let middle = if length > 0.1 { sum / length } else { along.cross(n) };
        Self { middle, along, half: width.atan2(length) }
    }

    /// The part within a quarter turn of a direction, in angles from the middle.
    fn above(&self, normal: DVec3) -> Option<[f64; 2]> {
        let highest = normal.dot(self.along).atan2(normal.dot(self.middle));
        let (from, to) = ((highest - FRAC_PI_2).max(-self.half), (highest + FRAC_PI_2).min(self.half));
        (from < to).then_some([from, to])
    }
}

/// ∫ f dω over a narrow cone above horizons.
///
/// Rows are great circles through the cone's X axis, at an angle y from Z up to β; a row reaches to
/// tan x = tan α √(sin(β−y) sin(β+y))/sin β either side. 8 nodes a row; between the rows where a horizon enters or leaves
/// the rim, 24 nodes a panel with both ends graded.
fn area_integral(cone: &Cone, horizons: &[(DVec3, Cut); 2], m: f64, f: impl Fn(DVec3) -> f64) -> f64 {
    let beta = cone.sin_b.atan2(cone.cos_b);
    let mut breaks = vec![-beta, beta];
    for (_, cut) in horizons {
        if let Cut::Across(chord) = cut {
            breaks.extend(chord.ends().map(|[_, sin]| (sin * cone.sin_b).atan2(cone.cos_b)));
        }
    }
    let both = horizons[0].0.cross(horizons[1].0);
    breaks.extend([both.y.atan2(both.z), (-both.y).atan2(-both.z)].into_iter().filter(|y| y.abs() < beta));
    breaks.sort_by(f64::total_cmp);
    let row = |y: f64| {
        let (sin_y, cos_y) = y.sin_cos();
        let reach = ((beta - y).sin() * (beta + y).sin()).max(0.0).sqrt() * cone.sin_a / (cone.cos_a * cone.sin_b);
        let reach = reach.atan();
        let (mut from, mut to) = (-reach, reach);
        for (normal, _) in horizons {
            let highest = normal.x.atan2(normal.y * sin_y + normal.z * cos_y);
            from = from.max(highest - FRAC_PI_2);
            to = to.min(highest + FRAC_PI_2);
        }
        if from >= to {
            return 0.0;
        }
        ROW.integrate(from, to, |x| {
            let (sin_x, cos_x) = x.sin_cos();
            cos_x * f(DVec3::new(sin_x, cos_x * sin_y, cos_x * cos_y))
        })
    };
    let width = 8.8 / (m + 1.0).sqrt();
    let panel = |lo: f64, hi: f64| {
        let graded = |t: f64| 6.0 * t * (1.0 - t) * row(lo + (hi - lo) * t * t * (3.0 - 2.0 * t));
        (hi - lo) * GAUSS_24.integrate(0.0, 1.0, graded)
    };
    let mut sum = 0.0;
    for ends in breaks.windows(2) {
        let count = ((ends[1] - ends[0]) / width).ceil();
        let step = (ends[1] - ends[0]) / count;
        let mut i = 0.0;
        while i < count {
            sum += panel(ends[0] + i * step, ends[0] + (i + 1.0) * step);
            i += 1.0;
        }
    }
    sum
}

static ROW: LazyLock<GaussLegendre> = LazyLock::new(|| GaussLegendre::new(8));
