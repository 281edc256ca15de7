//! The units in which what a light emits is typed and read: its own quantities, and lux at 1 m.

use glam::DVec3;

use crate::light::{Emitter, Light, Quantity, QuantityKind, luminance_of};
use crate::shading::{Lobe, Method, ShadingPoint, respond};

/// A unit of what lights emit.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Unit {
    /// That of a quantity.
    Of(QuantityKind),
    /// lx on a surface that faces the light, 1 m before its middle.
    LuxAtMetre,
}

/// How units are typed; those that end with another come before it.
const TYPED: [(&str, Unit); 14] = [
    ("lx at 1 m", Unit::LuxAtMetre),
    ("lx at 1m", Unit::LuxAtMetre),
    ("lx@1m", Unit::LuxAtMetre),
    ("lux at 1 m", Unit::LuxAtMetre),
    ("lux", Unit::Of(QuantityKind::Illuminance)),
    ("lx", Unit::Of(QuantityKind::Illuminance)),
    ("lm", Unit::Of(QuantityKind::Flux)),
    ("cd/m²", Unit::Of(QuantityKind::Luminance)),
    ("cd/m2", Unit::Of(QuantityKind::Luminance)),
    ("nits", Unit::Of(QuantityKind::Luminance)),
    ("nit", Unit::Of(QuantityKind::Luminance)),
    ("nt", Unit::Of(QuantityKind::Luminance)),
    ("cd/m", Unit::Of(QuantityKind::IntensityPerMetre)),
    ("cd", Unit::Of(QuantityKind::Intensity)),
];

/// A number as it is typed, and its unit where one is: `800`, `800 lm`, `1.2 klm`, `120 lx at 1 m`.
pub fn parse(text: &str) -> Option<(f64, Option<Unit>)> {
    let text = text.trim().to_lowercase();
    let unit = TYPED.iter().find_map(|(name, unit)| Some((text.strip_suffix(name)?, *unit)));
    let (number, unit) = unit.map_or((text.as_str(), None), |(number, unit)| (number, Some(unit)));
    let (number, factor) = match number.trim().strip_suffix('k').filter(|_| unit.is_some()) {
        Some(thousands) => (thousands.trim(), 1000.0),
        None => (number.trim(), 1.0),
    };
    let number: f64 = number.parse().ok()?;
    (number.is_finite()).then_some((factor * number, unit))
}

/// The light emitting `value` of that unit; none where it cannot be stated so. Lux at 1 m leave what is stated.
pub fn stated(light: &Light, unit: Unit, value: f64) -> Option<Light> {
    let kinds = light.shape.quantity_kinds();
    let quantity = match unit {
        Unit::Of(kind) if kinds.contains(&kind) => Quantity::new(kind, value),
        Unit::Of(QuantityKind::Illuminance) | Unit::LuxAtMetre => {
            let kind = light.quantity.kind();
            let one = Light { quantity: Quantity::new(kind, 1.0), ..light.clone() };
            Quantity::new(kind, value / lux_at_metre(&one).filter(|lux| *lux > 0.0)?)
        }
        Unit::Of(_) => return None,
    };
    Some(Light { quantity, ..light.clone() })
}

/// Illuminance in lx of a surface 1 m before the middle of a light and facing it, by the exact method, muted or not.
///
/// None for what is infinitely far away, and for a sphere or tube that reaches so far.
pub fn lux_at_metre(light: &Light) -> Option<f64> {
    let light = Light { muted: false, ..light.clone() };
    let middle = match light.emitter() {
        Emitter::Polygon(polygon) => polygon.centroid(),
        Emitter::Textured(textured) => textured.point(0.5, 0.5),
        Emitter::Line(line) if line.tube.is_none_or(|radius| radius < 1.0) => light.position,
        Emitter::Sphere(sphere) if sphere.radius < 1.0 => light.position,
        Emitter::Disk(_) | Emitter::Point(_) => light.position,
        Emitter::Line(_) | Emitter::Sphere(_) | Emitter::Cap(_) | Emitter::Sky(_) | Emitter::Directional(_) => {
            return None;
        }
    };
    let n = light.world_from_light().transform_vector3(DVec3::Z).normalize();
    let at = ShadingPoint { p: middle - n, n, v: n };
    let lux = |(emitter, weight): (Emitter, DVec3)| {
        luminance_of(weight) * respond(&emitter, Method::Exact, &at, &Lobe::new(1.0)).irradiance
    };
    Some(light.parts().into_iter().map(lux).sum())
}

#[cfg(test)]
mod tests {
    use std::f64::consts::PI;

    use super::*;
    use crate::light::{Directional, Line, Point, Shape, Sphere};

    #[test]
    fn numbers_are_typed_with_and_without_units() {
        let luminance = Some(Unit::Of(QuantityKind::Luminance));
        for (text, expected) in [
            ("800", Some((800.0, None))),
            ("1e3", Some((1000.0, None))),
            ("800 lm", Some((800.0, Some(Unit::Of(QuantityKind::Flux))))),
            ("1.2 klm", Some((1200.0, Some(Unit::Of(QuantityKind::Flux))))),
            ("5kcd/m²", Some((5000.0, luminance))),
            ("300 nit", Some((300.0, luminance))),
            ("40 cd/m", Some((40.0, Some(Unit::Of(QuantityKind::IntensityPerMetre))))),
            ("120 lx at 1 m", Some((120.0, Some(Unit::LuxAtMetre)))),
            ("lm", None),
            ("12 foot", None),
            ("inf", None),
        ] {
            assert_eq!(parse(text), expected, "{text}");
        }
    }

    #[test]
    fn lux_at_a_metre_are_those_of_the_whole_light() {
        let radius = 0.4;
        let sphere = Light::new("sphere", Shape::Sphere(Sphere { radius }));
        let expected = PI * radius * radius * sphere.strength();
        let found = lux_at_metre(&sphere).expect("it has some");
        assert!((found / expected - 1.0).abs() < 1e-12, "π r² L: {found}, not {expected}");
        let point = Light::new("point", Shape::Point(Point::default()));
        assert_eq!(lux_at_metre(&point), Some(point.strength()), "as many as candelas");
        assert_eq!(lux_at_metre(&Light::new("sun", Shape::Directional(Directional {}))), None, "no distance");
        assert_eq!(lux_at_metre(&Light::new("huge", Shape::Sphere(Sphere { radius: 1.5 }))), None, "within it");
    }

    #[test]
    fn a_light_is_stated_in_units_that_it_has_and_in_lux_at_a_metre() {
        let mut line = Light::new("line", Shape::Line(Line::isotropic(1.5)));
        line.muted = true;
        let stated_so = |unit, value| stated(&line, unit, value);
        let lit = stated_so(Unit::LuxAtMetre, 150.0).expect("a line has lux at a metre");
        assert!((lux_at_metre(&lit).expect("it has") - 150.0).abs() < 1e-9, "{:?}", lit.quantity);
        assert_eq!(lit.quantity.kind(), line.quantity.kind(), "what is stated stays");
        assert_eq!(stated_so(Unit::Of(QuantityKind::Illuminance), 150.0), Some(lit), "lx alone mean the same");
        let flux = stated_so(Unit::Of(QuantityKind::Flux), 900.0).expect("a line has a flux");
        assert_eq!(flux.quantity, Quantity::new(QuantityKind::Flux, 900.0), "in lumens");
        assert_eq!(stated_so(Unit::Of(QuantityKind::Luminance), 5.0), None, "an isotropic line has no luminance");
    }
}
