//! What a light is: its shape, its place, its photometric quantity and its colour.
//!
//! A [`Light`] is what a scene file says. Placing it gives an [`Emitter`]: the same light in world space at unit
//! strength, which is what `shading` works on. One file a shape.

#[macro_use]
mod written;

mod cap;
mod color;
mod directional;
mod disk;
mod far_field;
mod line;
pub mod pattern;
pub mod photometry;
mod point;
mod polygon;
mod quantity;
mod sky;
mod sphere;
mod textured;

pub use cap::{Cap, CapEmitter};
pub use color::{Tint, luminance_of, temperature_color};
pub use directional::{Directional, DirectionalEmitter};
pub use disk::{Disk, DiskEmitter};
pub use far_field::{Extent, FarField};
pub use line::{Line, LineEmission, LineEmitter};
pub use point::{Point, PointEmitter, Web};
pub use polygon::{Polygon, PolygonEmitter, PolygonError};
pub use quantity::{Quantity, QuantityKind};
pub use sky::{Sky, SkyEmitter};
pub use sphere::{Sphere, SphereEmitter};
pub use textured::{Textured, TexturedEmitter};

use glam::{DAffine3, DVec3};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::math::frame;

/// A light as a scene file states it.
#[derive(Clone, Debug, PartialEq)]
pub struct Light {
    /// Unique among the lights of a scene.
    pub name: String,
    /// Origin of the light's own frame, metres.
    pub position: DVec3,
    /// Rotation of the light's own frame, R = Rz·Ry·Rx, degrees.
    pub rotation_deg: DVec3,
    /// Colour only; its luminance does not matter.
    pub tint: Tint,
    /// The stated photometric quantity; the others follow from it and the shape.
    pub quantity: Quantity,
    /// A muted light contributes nothing.
    pub muted: bool,
    /// The group that it is listed in.
    pub group: Option<String>,
    /// Names of the surfaces that it lights; all of them where there is no list.
    pub only: Option<Vec<String>>,
    /// Shape, in the light's own frame.
    pub shape: Shape,
}

/// The shape of a light in its own frame, where it emits along −Z.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum Shape {
    /// A planar polygon in the XY plane.
    Polygon(Polygon),
    /// A straight line along X, centred.
    Line(Line),
    /// A sphere about the origin.
    Sphere(Sphere),
    /// A flat disk in the XY plane.
    Disk(Disk),
    /// A rectangle with a pattern in the XY plane.
    Textured(Textured),
    /// A cap of directions about +Z, infinitely far.
    Cap(Cap),
    /// The hemisphere of directions about +Z, infinitely far.
    Sky(Sky),
    /// All of the light at the origin.
    Point(Point),
    /// Parallel light travelling along −Z.
    Directional(Directional),
}

/// A light placed in the world, at unit strength: luminance 1, or intensity per metre 1, or intensity 1, or
/// illuminance 1, by shape (see [`Shape::strength_kind`]).
#[derive(Clone, Debug, PartialEq)]
pub enum Emitter {
    /// See [`PolygonEmitter`].
    Polygon(PolygonEmitter),
    /// See [`LineEmitter`].
    Line(LineEmitter),
    /// See [`SphereEmitter`].
    Sphere(SphereEmitter),
    /// See [`DiskEmitter`].
    Disk(DiskEmitter),
    /// See [`TexturedEmitter`].
    Textured(TexturedEmitter),
    /// See [`CapEmitter`].
    Cap(CapEmitter),
    /// See [`SkyEmitter`].
    Sky(SkyEmitter),
    /// See [`PointEmitter`].
    Point(PointEmitter),
    /// See [`DirectionalEmitter`].
    Directional(DirectionalEmitter),
}

impl Light {
    /// A white light of that shape at the origin, of an everyday strength.
    pub fn new(name: impl Into<String>, shape: Shape) -> Self {
        Self {
            name: name.into(),
            position: DVec3::ZERO,
            rotation_deg: DVec3::ZERO,
            tint: Tint::default(),
            quantity: shape.everyday_quantity(),
            muted: false,
            group: None,
            only: None,
            shape,
        }
    }

    /// Whether it lights the surface of that name.
    pub fn reaches(&self, surface: &str) -> bool {
        self.only.as_ref().is_none_or(|only| only.iter().any(|name| name == surface))
    }

    /// The light's emission in another quantity; none where the shape does not have it.
    pub fn in_quantity(&self, kind: QuantityKind) -> Option<f64> {
        if kind == self.quantity.kind() {
            return Some(self.quantity.value());
        }
        let strength_per = self.shape.strength_per(kind);
        (strength_per > 0.0).then(|| self.strength() / strength_per)
    }

    /// State the same emission in another quantity, which then stays when the light is resized. Does nothing where
    /// the shape does not have it.
    pub fn restate(&mut self, kind: QuantityKind) {
        if let Some(value) = self.in_quantity(kind) {
            self.quantity = Quantity::new(kind, value);
        }
    }

    /// Makes a line isotropic or a tube of the same flux. Does nothing to other lights.
    pub fn set_line_emission(&mut self, emission: LineEmission) {
        let stated_as_flux = self.quantity.kind() == QuantityKind::Flux;
        let flux = self.in_quantity(QuantityKind::Flux);
        let Shape::Line(line) = &mut self.shape else { return };
        line.emission = emission;
        line.radius = (emission == LineEmission::Tube).then(|| line.radius.unwrap_or(Line::EVERYDAY_RADIUS));
        if let Some(flux) = flux {
            self.quantity = Quantity::new(QuantityKind::Flux, flux);
        }
        if !stated_as_flux {
            self.restate(self.shape.strength_kind());
        }
    }

    /// The transform from the light's own frame to the world.
    pub fn world_from_light(&self) -> DAffine3 {
        frame::world_from_local(self.position, self.rotation_deg)
    }

    /// What shines: each part placed in the world at unit strength, and its weight. A light of one colour is one part, a
    /// coloured pattern three.
    pub fn parts(&self) -> Vec<(Emitter, DVec3)> {
        if let Shape::Textured(textured) = &self.shape
            && let channels @ [_, _, _] = textured.pattern.image.channels()
        {
            let world_from_light = self.world_from_light();
            let place = |channel| Emitter::Textured(textured.place(&world_from_light, channel));
            return channels.iter().map(place).zip(DVec3::AXES.map(|axis| axis * self.weight())).collect();
        }
        vec![(self.emitter(), self.weight())]
    }

    /// The light placed in the world at unit strength; the first of its [`Self::parts`].
    pub fn emitter(&self) -> Emitter {
        let world_from_light = self.world_from_light();
        match &self.shape {
            Shape::Polygon(polygon) => Emitter::Polygon(polygon.place(&world_from_light)),
            Shape::Line(line) => Emitter::Line(line.place(&world_from_light)),
            Shape::Sphere(sphere) => Emitter::Sphere(sphere.place(&world_from_light)),
            Shape::Disk(disk) => Emitter::Disk(disk.place(&world_from_light)),
            Shape::Textured(textured) => {
                Emitter::Textured(textured.place(&world_from_light, &textured.pattern.image.channels()[0]))
            }
            Shape::Cap(cap) => Emitter::Cap(cap.place(&world_from_light)),
            Shape::Sky(sky) => Emitter::Sky(sky.place(&world_from_light)),
            Shape::Point(point) => Emitter::Point(point.place(&world_from_light)),
            Shape::Directional(_) => {
                Emitter::Directional(DirectionalEmitter { to_light: world_from_light.matrix3.z_axis })
            }
        }
    }

    /// What the emitter's unit-strength response is multiplied by, in the unit of [`Shape::strength_kind`].
    pub fn strength(&self) -> f64 {
        self.quantity.value() * self.shape.strength_per(self.quantity.kind())
    }

    /// Strength times tint, 0 when muted: the weight of the light's layer.
    pub fn weight(&self) -> DVec3 {
        if self.muted { DVec3::ZERO } else { self.strength() * self.tint.rgb() }
    }
}

impl Emitter {
    /// Whether a point sees all of it in one direction.
    pub fn is_one_direction(&self) -> bool {
        matches!(self, Self::Point(_) | Self::Directional(_))
    }
}

impl Shape {
    /// The name of the shape in files and on screen.
    pub fn name(&self) -> &'static str {
        match self {
            Self::Polygon(_) => "polygon",
            Self::Line(_) => "line",
            Self::Sphere(_) => "sphere",
            Self::Disk(_) => "disk",
            Self::Textured(_) => "textured",
            Self::Cap(_) => "cap",
            Self::Sky(_) => "sky",
            Self::Point(_) => "point",
            Self::Directional(_) => "directional",
        }
    }

    /// The quantity that scales the emitter's unit response.
    pub fn strength_kind(&self) -> QuantityKind {
        match self {
            Self::Polygon(_) | Self::Sphere(_) | Self::Disk(_) | Self::Textured(_) | Self::Cap(_) | Self::Sky(_) => {
                QuantityKind::Luminance
            }
            Self::Line(line) => match line.emission {
                LineEmission::Isotropic => QuantityKind::IntensityPerMetre,
                LineEmission::Tube => QuantityKind::Luminance,
            },
            Self::Point(_) => QuantityKind::Intensity,
            Self::Directional(_) => QuantityKind::Illuminance,
        }
    }

    /// The quantities in which this shape's emission may be stated.
    pub fn quantity_kinds(&self) -> &'static [QuantityKind] {
        match self {
            Self::Polygon(_) | Self::Sphere(_) | Self::Disk(_) | Self::Textured(_) => {
                &[QuantityKind::Luminance, QuantityKind::Flux]
            }
            Self::Cap(_) => &[QuantityKind::Luminance, QuantityKind::Illuminance],
            Self::Sky(_) => &[QuantityKind::Luminance],
            Self::Line(line) => match line.emission {
                LineEmission::Isotropic => &[QuantityKind::IntensityPerMetre, QuantityKind::Flux],
                LineEmission::Tube => &[QuantityKind::Luminance, QuantityKind::Flux],
            },
            Self::Point(_) => &[QuantityKind::Intensity, QuantityKind::Flux],
            Self::Directional(_) => &[QuantityKind::Illuminance],
        }
    }

    /// What a new light of this shape emits: as bright as a window on a dull day, a fluorescent tube, a bulb, an
    /// office.
    fn everyday_quantity(&self) -> Quantity {
        let kind = self.strength_kind();
        let value = match self {
            Self::Polygon(_) | Self::Sphere(_) | Self::Disk(_) | Self::Textured(_) | Self::Cap(_) => 1000.0,
            Self::Sky(_) => 200.0,
            Self::Line(line) => match line.emission {
                LineEmission::Isotropic => 200.0,
                LineEmission::Tube => 10_000.0,
            },
            Self::Point(point) => point.ies.as_ref().map_or(100.0, |photometry| photometry.distribution.peak()),
            Self::Directional(_) => 500.0,
        };
        Quantity::new(kind, value)
    }

    /// Strength per unit of `kind`; 0 where the shape cannot be stated so.
    pub fn strength_per(&self, kind: QuantityKind) -> f64 {
        if kind == self.strength_kind() {
            return 1.0;
        }
        let (other_kind, per_strength) = match self {
            Self::Polygon(polygon) => (QuantityKind::Flux, polygon.flux_per_luminance()),
            Self::Line(line) => (QuantityKind::Flux, line.flux_per_strength()),
            Self::Sphere(sphere) => (QuantityKind::Flux, sphere.flux_per_luminance()),
            Self::Disk(disk) => (QuantityKind::Flux, disk.flux_per_luminance()),
            Self::Textured(textured) => (QuantityKind::Flux, textured.flux_per_luminance()),
            Self::Cap(cap) => (QuantityKind::Illuminance, cap.illuminance_per_luminance()),
            Self::Point(point) => (QuantityKind::Flux, point.flux_per_intensity()),
            Self::Sky(_) | Self::Directional(_) => return 0.0,
        };
        if kind == other_kind && per_strength > 0.0 { per_strength.recip() } else { 0.0 }
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::{PI, TAU};

    use std::sync::Arc;

    use glam::{DVec2, dvec2};

    use super::pattern::{Channel, Image, Pattern};

    use super::*;

    fn rectangle(two_sided: bool) -> Shape {
        let vertices = vec![dvec2(-1.0, -0.5), dvec2(1.0, -0.5), dvec2(1.0, 0.5), dvec2(-1.0, 0.5)];
        Shape::Polygon(Polygon { vertices, two_sided })
    }

    #[track_caller]
    fn check(shape: Shape, kind: QuantityKind, expected: f64) {
        let light = Light::new("light", shape);
        let unit = light.quantity.value();
        let value = light.in_quantity(kind).expect("the shape has this quantity");
        assert!((value / (unit * expected) - 1.0).abs() < 1e-15, "{kind:?} is {value}, not {unit} times {expected}");
    }

    #[test]
    fn flux_follows_from_the_quantity_of_each_shape() {
        check(rectangle(false), QuantityKind::Flux, PI * 2.0);
        check(rectangle(true), QuantityKind::Flux, 2.0 * PI * 2.0);
        check(Shape::Sphere(Sphere { radius: 0.3 }), QuantityKind::Flux, 4.0 * PI * PI * 0.09);
        let line = Line::isotropic(1.5);
        check(Shape::Line(line), QuantityKind::Flux, 4.0 * PI * 1.5);
        check(Shape::Line(Line::tube(1.5, 0.01)), QuantityKind::Flux, PI * TAU * 0.01 * 1.5);
        check(Shape::Point(Point::default()), QuantityKind::Flux, 4.0 * PI);
        check(Shape::Disk(Disk { radius: 0.5, two_sided: false }), QuantityKind::Flux, PI * PI * 0.25);
        check(Shape::Cap(Cap { half_angle_deg: 30.0 }), QuantityKind::Illuminance, PI * 0.25);
        check(textured(), QuantityKind::Flux, PI * 2.0 * 0.75);
    }

    fn textured() -> Shape {
        let grey = Channel::new(2, vec![0.0, 1.0, 1.0, 1.0]).expect("two rows of two");
        let pattern = Pattern::of_image("grey.png", Image::Grey(Arc::new(grey)));
        Shape::Textured(Textured { size: dvec2(2.0, 1.0), pattern, two_sided: false })
    }

    #[test]
    fn a_coloured_pattern_is_three_parts_of_one_colour_each() {
        let channel = |value| Arc::new(Channel::new(1, vec![value]).expect("one texel"));
        let image = Image::Color([channel(1.0), channel(0.5), channel(0.25)]);
        let pattern = Pattern::of_image("red.png", image);
        let shape = Shape::Textured(Textured { size: DVec2::ONE, pattern, two_sided: false });
        let light = Light { tint: Tint::TemperatureK(3000.0), ..Light::new("light", shape) };
        let parts = light.parts();
        let sum: DVec3 = parts.iter().map(|(_, weight)| *weight).sum();
        assert_eq!((parts.len(), sum), (3, light.weight()), "the light's weight, taken apart");
        for (i, (part, weight)) in parts.iter().enumerate() {
            let Emitter::Textured(emitter) = part else { panic!("a textured part") };
            assert_eq!(emitter.pattern.mean(), [1.0, 0.5, 0.25][i], "channel {i}");
            assert_eq!(*weight, DVec3::AXES[i] * light.weight(), "weight {i}");
        }
    }

    #[test]
    fn an_image_stands_upright_for_who_looks_at_the_lit_side() {
        let Emitter::Textured(emitter) = Light::new("light", textured()).emitter() else { panic!("textured") };
        assert_eq!(emitter.point(0.0, 0.0), DVec3::new(1.0, 0.5, 0.0), "row 0 at +Y, column 0 at +X");
        assert_eq!(emitter.point(1.0, 1.0), DVec3::new(-1.0, -0.5, 0.0), "the last at the other corner");
        assert_eq!(emitter.column.cross(emitter.row).normalize(), emitter.normal, "corners turn about the lit side");
    }

    #[test]
    fn a_shape_has_the_quantities_that_it_names_and_no_others() {
        let line = Line::isotropic(1.5);
        let shapes = [
            rectangle(false),
            Shape::Line(line),
            Shape::Line(Line::tube(1.5, 0.01)),
            Shape::Sphere(Sphere { radius: 0.3 }),
            Shape::Point(Point::default()),
            Shape::Directional(Directional {}),
            Shape::Disk(Disk { radius: 0.5, two_sided: false }),
            Shape::Cap(Cap { half_angle_deg: 30.0 }),
            Shape::Sky(Sky::OVERCAST),
            textured(),
        ];
        for shape in shapes {
            let light = Light::new("light", shape);
            for kind in QuantityKind::ALL {
                let has = light.shape.quantity_kinds().contains(&kind);
                assert_eq!(light.in_quantity(kind).is_some(), has, "{kind:?} of a {}", light.shape.name());
            }
        }
    }

    #[test]
    fn a_line_that_becomes_a_tube_keeps_its_flux() {
        let mut light = Light::new("light", Shape::Line(Line::isotropic(1.5)));
        let flux = light.in_quantity(QuantityKind::Flux).expect("a line has a flux");
        light.set_line_emission(LineEmission::Tube);
        assert_eq!(light.quantity.kind(), QuantityKind::Luminance, "stated as a tube is");
        let now = light.in_quantity(QuantityKind::Flux).expect("a tube has a flux");
        assert!((now / flux - 1.0).abs() < 1e-15, "{now} was {flux}");
        light.set_line_emission(LineEmission::Isotropic);
        assert_eq!(light.shape, Shape::Line(Line::isotropic(1.5)), "as it was");
    }

    #[test]
    fn restating_keeps_the_emission_and_decides_what_stays_when_resized() {
        let mut light = Light::new("light", rectangle(false));
        let strength = light.strength();
        light.restate(QuantityKind::Flux);
        assert_eq!(light.quantity.kind(), QuantityKind::Flux, "now stated as flux");
        assert!((light.strength() / strength - 1.0).abs() < 1e-15, "{} was {strength}", light.strength());
        light.restate(QuantityKind::Intensity);
        assert_eq!(light.quantity.kind(), QuantityKind::Flux, "a polygon has no intensity to state");

        let Shape::Polygon(polygon) = &mut light.shape else { unreachable!("it is a polygon") };
        polygon.vertices.iter_mut().for_each(|vertex| *vertex *= 2.0);
        assert!((light.strength() / (0.25 * strength) - 1.0).abs() < 1e-15, "the same flux from four times the area");
    }
}
