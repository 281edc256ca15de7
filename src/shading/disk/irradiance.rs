//! Irradiance of a disk, exactly.

use std::f64::consts::{PI, TAU};

use glam::DVec3;

use super::cone::{Chord, Cone, Cut};
use crate::light::DiskEmitter;

/// Irradiance at p from a disk of luminance 1 that may lie anywhere about the horizon of the unit normal n.
///
/// E = ½ ∮ (x × dx)·n/|x|² over the rim above the horizon and the chord along it. In the axes of the disk's cone
/// (X/tan α)² + (Y/tan β)² < Z² all of the disk gives E = π n_z sin α sin β; cut by the horizon, with e² = sin²β − sin²α,
///
/// 2E = Θ + sin α sin β n_z Δ − (sin β cos²α nₓ/e) atan u − (sin α cos²β n_y/e) artanh w
///
/// Θ the angle that the chord subtends and Δ, u, w rational in the chord's ends.
///
/// **Source:** derived here from Lambert's contour integral, [`crate::refs::SNYDER_1996`], eq. (8) for a curved edge.
/// **Domain:** unit `n`; either side of the disk; 0 for p in its plane. **Units:** lx per cd·m⁻².
/// **Accuracy:** 5e-14 of the smaller of π and the solid angle, relative 1e-13 (`closed_form::disk`).
/// **Twin:** `shaders/disk.wgsl`.
pub fn disk_irradiance(light: &DiskEmitter, p: DVec3, n: DVec3) -> f64 {
    let Some(cone) = Cone::new(light, p) else { return 0.0 };
    let n = cone.local(n);
    match cone.cut(n) {
        Cut::Above => PI * cone.sin_a * cone.sin_b * n.z,
        Cut::Below => 0.0,
        Cut::Across(chord) => clipped(&cone, n, &chord).max(0.0),
    }
}

/// The least e that is told from 0: u and w are proportional to it.
const ROUND: f64 = 1e-60;

/// E of a disk that the horizon cuts.
///
/// The terms of the documented form are of the size of tan β, E is of the size of tan α tan²β: for small cones they
/// cancel. Two forms are the same in other terms. In a round and small cone, tan²β < tan α, what is linear in u, w and
/// tan Θ is summed in closed form, and what is left of atan and artanh is of third order. Else the cone is large or
/// narrow, and Θ and atan u, which are nearly the same in a narrow one, are one arctangent of their difference.
fn clipped(cone: &Cone, n: DVec3, chord: &Chord) -> f64 {
    let Cone { sin_a, cos_a, sin_b, cos_b, .. } = *cone;
    let [cos_tau, sin_tau] = chord.axis.map(f64::abs);
    let (sin, cos) = (chord.sin, chord.cos);
    // By what of sine and cosine is the smaller, and so the one that differs.
    let e_squared = if cos_a < sin_a { (cos_a - cos_b) * (cos_a + cos_b) } else { (sin_b - sin_a) * (sin_b + sin_a) };
    let e = e_squared.max(0.0).sqrt().max(ROUND);
    let (wide, narrow) = (sin_b * cos_a, sin_a * cos_b);
    let cosines = cos_a * cos_b;
    // |x|² at the foot of the chord on the rim, times cos²α cos²β; and less the parts that its length takes.
    let foot = cosines * cosines + (narrow * cos_tau).powi(2) + (wide * sin_tau).powi(2);
    let square = sin * sin;
    let chord_dot = foot - (narrow * narrow + wide * wide) * square;
    let (u_dot, w_dot) = (foot - e_squared * square, foot + e_squared * square);

    let delta = (2.0 * cosines * sin * cos).atan2(foot - (cos_a * cos_a + cos_b * cos_b) * square);
    let swept = sin_a * sin_b * n.z * if delta < 0.0 { delta + TAU } else { delta };

    // sin α sin β/amplitude times cos²α cos²β.
    let chord_cross = sin_a * sin_b * cosines * cosines / chord.amplitude;
    let u_cross = 2.0 * e * cos_b * cos_tau * sin;
    let w = (2.0 * e * cos_a * sin_tau * sin / w_dot).min(1.0 - f64::EPSILON);
    let u_factor = wide * cos_a * n.x.abs() / e;
    let w_factor = narrow * cos_b * n.y.abs() / e;

    if sin_b * wide < narrow * cos_b {
        let cubic =
            cos * cos + 2.0 * square * cosines * cosines * (cos_tau * cos_tau / u_dot + sin_tau * sin_tau / w_dot);
        let linear = 2.0 * sin_a * sin_b * chord.amplitude * sin * cubic / chord_dot;
        let excess = u_factor * atan_deficit(u_cross / u_dot) - atan_deficit(2.0 * chord_cross * sin / chord_dot);
        return 0.5 * (linear + swept + excess - w_factor * artanh_excess(w));
    }
    let apart = narrow * narrow * (cosines * cosines + wide * wide * cos * cos - e_squared * cos_tau * cos_tau)
        / (chord_cross + e * cos_b * cos_tau);
    let numerator = 2.0 * sin * (2.0 * chord_cross * narrow * narrow * square + chord_dot * apart);
    let difference = numerator.atan2(chord_dot * u_dot + 2.0 * chord_cross * sin * u_cross);
    let e_chord = e * sin_a * sin_b / chord.amplitude;
    let q = wide * wide * (wide - cos_b) * (wide + cos_b) * cos_tau * cos_tau
        + e_squared * ((cos_b * sin_tau).powi(2) + (sin_b * cos).powi(2));
    let rest = sin_a * sin_a * q / (cos_a * cos_a * cos_b * e_chord * (e_chord * cos_b + wide * wide * cos_tau));
    0.5 * (difference + rest * u_cross.atan2(u_dot) + swept - w_factor * w.atanh())
}

/// x − atan x.
fn atan_deficit(x: f64) -> f64 {
    if x.abs() > 0.2 { x - x.atan() } else { cubic_series(x, -x * x) }
}

/// artanh x − x.
fn artanh_excess(x: f64) -> f64 {
    if x.abs() > 0.2 { x.atanh() - x } else { cubic_series(x, x * x) }
}

/// ±x³(1/3 + s/5 + s²/7 + …) with s = ±x²; for |s| ≤ 0.04 truncated below 1e-17 of itself.
fn cubic_series(x: f64, s: f64) -> f64 {
    let nested = (1..=12).rev().fold(0.0, |sum, k| sum * s + f64::from(2 * k + 1).recip());
    x * x * x * nested
}
