//! Domes as skies.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use glam::{DMat3, DVec3};

use super::light::tidy;
use super::prim::Prim;
use super::stage::{Found, Reader};
use crate::light::pattern::Image;
use crate::light::{Light, Quantity, QuantityKind, Shape, Sky, Tint, luminance_of};
use crate::math::frame::deg_from_rotation;
use crate::scene::pattern_of_bytes;

/// Steps of the polar angle in which a dome is looked at; four times as many around.
const STEPS: u32 = 90;

/// Light from below the horizon that is taken for none, as a share of that from above.
const DARK: f64 = 1e-6;

/// What is seen of a hemisphere: its mean luminance at each polar angle, and its colour.
struct Seen {
    levels: Vec<(f64, f64)>,
    color: DVec3,
}

impl Reader<'_> {
    /// A dome as the sky u + c·cos θ that is nearest to its upper half.
    pub(super) fn dome(&mut self, found: &Found<'_>, rotation: DMat3, strength: f64, tint: Tint) -> Option<Light> {
        let prim = found.prim;
        let pole = rotation * self.pole(prim);
        let image = self.dome_image(prim);
        let sees = |direction: DVec3| match &image {
            Some(image) => {
                let (u, v) = lat_long(rotation.transpose() * direction, self.pole(prim));
                image.value(u, v)
            }
            None => DVec3::ONE,
        };
        // A dome that is dark below its own horizon is a sky about its pole; any other is cut at the stage's.
        let below = mean(&look(&sees, -pole));
        let above = mean(&look(&sees, pole));
        let is_half = image.is_some() && below <= DARK * above;
        let zenith = if is_half { pole } else { DVec3::Z };
        let Seen { levels, color } = look(&sees, zenith);
        if !is_half {
            self.remark_on(prim, prim.line, "loses what is below the horizon: a sky is a hemisphere");
        }
        let (sky, off) = fitted(&levels);
        if image.is_some() {
            let percent = 100.0 * off;
            self.remark_on(
                prim,
                prim.line,
                &format!("is a sky that is even around its zenith, within {percent:.2} % RMS"),
            );
        }
        let total = sky.uniform + sky.cosine;
        if total <= 0.0 {
            self.remark_on(prim, prim.line, "is dark, and left out");
            return None;
        }
        let shape = Shape::Sky(Sky { uniform: sky.uniform / total, cosine: sky.cosine / total });
        let tint = match tint {
            Tint::TemperatureK(_) if image.is_none() || color == DVec3::splat(color.x) => tint,
            _ if luminance_of(color) > 0.0 => Tint::Color(tint.rgb() * color / luminance_of(color)),
            _ => tint,
        };
        let mut light = Light::new("", shape);
        light.rotation_deg = tidy(deg_from_rotation(about(zenith, rotation)));
        (light.quantity, light.tint) = (Quantity::new(QuantityKind::Luminance, strength * total), tint);
        light.group = prim.group();
        self.remark_on_extras(prim);
        Some(light)
    }

    /// Where a dome's picture has its top, in its own frame: +Y, or what a newer dome says.
    fn pole(&self, prim: &Prim) -> DVec3 {
        let axis = prim.property("poleAxis").and_then(|property| property.value.text()).unwrap_or("scene");
        match (prim.kind.as_str(), axis) {
            ("DomeLight_1", "Z") => DVec3::Z,
            ("DomeLight_1", "scene") => self.up,
            _ => DVec3::Y,
        }
    }

    fn dome_image(&mut self, prim: &Prim) -> Option<Image> {
        let property = prim.input("texture:file")?;
        let file = property.value.text().filter(|file| !file.is_empty())?;
        let name = file.strip_prefix("./").unwrap_or(file);
        let image = (self.read)(name)
            .map_err(|cause| format!("`{name}` cannot be read: {cause}"))
            .and_then(|bytes| pattern_of_bytes(name, bytes));
        let format = prim.input("texture:format").and_then(|format| format.value.text()).unwrap_or("automatic");
        match image {
            Ok(_) if !matches!(format, "automatic" | "latlong") => {
                self.remark_on(prim, property.line, &format!("has a picture of the form {format}, which is not read"));
                None
            }
            Ok(pattern) => Some(pattern.image),
            Err(cause) => {
                self.remark_on(prim, property.line, &format!("loses its picture: {cause}"));
                None
            }
        }
    }
}

/// Where in a picture by latitude and longitude a direction of the dome's frame is: the top is the pole, and the middle
/// is +Z of a dome whose pole is +Y.
fn lat_long(direction: DVec3, pole: DVec3) -> (f64, f64) {
    let up = direction.dot(pole);
    let (ahead, aside) = if pole == DVec3::Z { (-direction.y, direction.x) } else { (direction.z, direction.x) };
    let around = aside.atan2(ahead);
    let polar = (direction - up * pole).length().atan2(up);
    (0.5 - around / TAU, polar / PI)
}

/// What a hemisphere shows, ring by ring.
fn look(sees: &impl Fn(DVec3) -> DVec3, zenith: DVec3) -> Seen {
    let (x, y) = zenith.any_orthonormal_pair();
    let mut color = DVec3::ZERO;
    let rings = (0..STEPS).map(|ring| {
        let polar = FRAC_PI_2 * (f64::from(ring) + 0.5) / f64::from(STEPS);
        let (sin, cos) = polar.sin_cos();
        let around = 4 * STEPS;
        let sum: DVec3 = (0..around)
            .map(|i| {
                let (aside, ahead) = (TAU * (f64::from(i) + 0.5) / f64::from(around)).sin_cos();
                sees(sin * (ahead * x + aside * y) + cos * zenith)
            })
            .sum();
        let level = sum / f64::from(around);
        color += level * sin * cos;
        (cos, luminance_of(level))
    });
    let levels = rings.collect();
    Seen { levels, color }
}

/// Mean of the rings by their part in the illuminance.
fn mean(seen: &Seen) -> f64 {
    seen.levels.iter().map(|(cos, level)| level * cos * (1.0 - cos * cos).sqrt()).sum()
}

/// The least squares of u + c·cos θ over a hemisphere by each ring's part in the illuminance, neither below 0; and the
/// root of the mean squared rest as a share of the mean.
fn fitted(levels: &[(f64, f64)]) -> (Sky, f64) {
    let weight = |cos: f64| cos * (1.0 - cos * cos).max(0.0).sqrt();
    let sum =
        |of: &dyn Fn(f64, f64) -> f64| levels.iter().map(|(cos, level)| weight(*cos) * of(*cos, *level)).sum::<f64>();
    let (one, x, xx) = (sum(&|_, _| 1.0), sum(&|c, _| c), sum(&|c, _| c * c));
    let (y, xy) = (sum(&|_, l| l), sum(&|c, l| c * l));
    let determinant = one * xx - x * x;
    let (uniform, cosine) = ((y * xx - x * xy) / determinant, (one * xy - x * y) / determinant);
    let sky = match (uniform < 0.0, cosine < 0.0) {
        (_, true) => Sky { uniform: y / one, cosine: 0.0 },
        (true, _) => Sky { uniform: 0.0, cosine: xy / xx },
        _ => Sky { uniform, cosine },
    };
    let rest = sum(&|c, l| (sky.uniform + sky.cosine * c - l).powi(2));
    let mean = y / one;
    (sky, if mean > 0.0 { (rest / one).sqrt() / mean } else { 0.0 })
}

/// A frame whose +Z is that direction, otherwise like `near`.
fn about(zenith: DVec3, near: DMat3) -> DMat3 {
    let x = near.x_axis.reject_from_normalized(zenith).normalize_or(zenith.any_orthonormal_vector());
    DMat3::from_cols(x, zenith.cross(x), zenith)
}
