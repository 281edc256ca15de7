//! Lights in a frame of their own, in which all that differ by place, turn and size are the same.

use std::f64::consts::PI;
use std::sync::{Arc, Weak};

use glam::{DMat3, DVec2, DVec3};

use super::Punctual;
use crate::light::pattern::Channel;
use crate::light::photometry::Distribution;
use crate::light::{
    CapEmitter, DiskEmitter, Emitter, LineEmitter, PointEmitter, PolygonEmitter, SkyEmitter, SphereEmitter,
    TexturedEmitter, Web,
};

/// What a light is apart from where it is: lights with equal keys have the same fit.
#[derive(Clone, Debug)]
pub(super) enum Key {
    /// Corners in units of the size, about the middle, and whether both sides emit.
    Outline(Vec<DVec2>, bool),
    /// Whether both sides emit.
    Disk(bool),
    /// The very channel, which the key does not keep alive, the rectangle's sides, and whether both sides emit.
    Pattern(Weak<Channel>, DVec2, bool),
    /// Falloff, and whether it is a tube.
    Line(f64, bool),
    Sphere,
    /// Half-angle.
    Cap(f64),
    /// Uniform and cosine part.
    Sky(f64, f64),
    /// The very intensities, which the key does not keep alive.
    Web(Weak<Distribution>),
}

impl PartialEq for Key {
    fn eq(&self, other: &Self) -> bool {
        match (self, other) {
            (Self::Outline(a, both), Self::Outline(b, both_too)) => a == b && both == both_too,
            (Self::Disk(both), Self::Disk(both_too)) => both == both_too,
            (Self::Pattern(a, sides, both), Self::Pattern(b, other, both_too)) => {
                Weak::ptr_eq(a, b) && sides == other && both == both_too
            }
            (Self::Line(f, tube), Self::Line(g, tube_too)) => f == g && tube == tube_too,
            (Self::Sphere, Self::Sphere) => true,
            (Self::Cap(a), Self::Cap(b)) => a == b,
            (Self::Sky(a, b), Self::Sky(c, d)) => a == c && b == d,
            (Self::Web(a), Self::Web(b)) => Weak::ptr_eq(a, b),
            _ => false,
        }
    }
}

/// A light about the origin, emitting along +Z, in a ball of diameter 1; and how it lies in the world.
#[derive(Clone, Debug)]
pub(super) struct Canonical {
    pub(super) key: Key,
    pub(super) emitter: Emitter,
    frame: Frame,
}

#[derive(Clone, Copy, Debug)]
struct Frame {
    origin: DVec3,
    axes: DMat3,
    /// Diameter of the ball about the light, metres.
    size: f64,
    /// What intensities are multiplied by.
    gain: f64,
}

/// Lengths in units of the size are rounded to that: a light that moves has the same key, not one beside it.
const GRAIN: f64 = 1.0 / (1 << 30) as f64;

fn grained(x: f64) -> f64 {
    (x / GRAIN).round() * GRAIN
}

impl Canonical {
    /// A light that has a size, or fills directions; none of others, and where its size is no number.
    pub(super) fn new(emitter: &Emitter) -> Option<Self> {
        let canonical = match emitter {
            Emitter::Polygon(light) => Self::polygon(light)?,
            Emitter::Disk(light) => Self::disk(light),
            Emitter::Textured(light) => Self::textured(light)?,
            Emitter::Line(light) => Self::line(light)?,
            Emitter::Sphere(light) => Self {
                key: Key::Sphere,
                emitter: Emitter::Sphere(SphereEmitter { center: DVec3::ZERO, radius: 0.5 }),
                frame: Frame::flat(light.center, DMat3::IDENTITY, 2.0 * light.radius),
            },
            Emitter::Cap(light) => Self {
                key: Key::Cap(light.half_angle),
                emitter: Emitter::Cap(CapEmitter { to_center: DVec3::Z, half_angle: light.half_angle }),
                frame: Frame::far(light.to_center),
            },
            Emitter::Sky(light) => Self {
                key: Key::Sky(light.uniform, light.cosine),
                emitter: Emitter::Sky(SkyEmitter { zenith: DVec3::Z, ..*light }),
                frame: Frame::far(light.zenith),
            },
            Emitter::Point(light) => Self::web(light)?,
            Emitter::Directional(_) => return None,
        };
        let Frame { size, gain, .. } = canonical.frame;
        (size > 0.0 && size.is_finite() && gain.is_finite()).then_some(canonical)
    }

    fn polygon(light: &PolygonEmitter) -> Option<Self> {
        let [first, second, ..] = light.vertices[..] else { return None };
        let along = (second - first).try_normalize()?;
        let axes = DMat3::from_cols(along, light.normal.cross(along), light.normal);
        let flat = |vertex: &DVec3| DVec2::new((vertex - first).dot(axes.x_axis), (vertex - first).dot(axes.y_axis));
        let corners: Vec<DVec2> = light.vertices.iter().map(flat).collect();
        let low = corners.iter().copied().reduce(DVec2::min)?;
        let high = corners.iter().copied().reduce(DVec2::max)?;
        let middle = 0.5 * (low + high);
        let size = 2.0 * corners.iter().map(|corner| corner.distance(middle)).fold(0.0, f64::max);
        let outline: Vec<DVec2> =
            corners.iter().map(|corner| ((corner - middle) / size).to_array().map(grained).into()).collect();
        let emitter = PolygonEmitter {
            vertices: outline.iter().map(|corner| corner.extend(0.0)).collect(),
            normal: DVec3::Z,
            two_sided: light.two_sided,
        };
        Some(Self {
            key: Key::Outline(outline, light.two_sided),
            emitter: Emitter::Polygon(emitter),
            frame: Frame::flat(first + axes * middle.extend(0.0), axes, size),
        })
    }

    fn disk(light: &DiskEmitter) -> Self {
        let emitter = DiskEmitter { center: DVec3::ZERO, normal: DVec3::Z, radius: 0.5, two_sided: light.two_sided };
        Self {
            key: Key::Disk(light.two_sided),
            emitter: Emitter::Disk(emitter),
            frame: Frame::flat(light.center, along(light.normal), 2.0 * light.radius),
        }
    }

    fn textured(light: &TexturedEmitter) -> Option<Self> {
        let sides = DVec2::new(light.column.length(), light.row.length());
        let size = sides.length();
        let [across, down] = (sides / size).to_array().map(grained);
        let axes = DMat3::from_cols(light.column.try_normalize()?, light.row.try_normalize()?, light.normal);
        let emitter = TexturedEmitter {
            corner: DVec3::new(-0.5 * across, -0.5 * down, 0.0),
            row: down * DVec3::Y,
            column: across * DVec3::X,
            normal: DVec3::Z,
            two_sided: light.two_sided,
            pattern: Arc::clone(&light.pattern),
        };
        Some(Self {
            key: Key::Pattern(Arc::downgrade(&light.pattern), DVec2::new(across, down), light.two_sided),
            emitter: Emitter::Textured(emitter),
            frame: Frame::flat(light.point(0.5, 0.5), axes, size),
        })
    }

    /// A line along X. E of a line of falloff f and length s is s^(1−f) times that of the line of length 1, at points
    /// s times as far; of a tube, times its diameter.
    fn line(light: &LineEmitter) -> Option<Self> {
        let axis = (light.b - light.a).try_normalize()?;
        let (u, v) = axis.any_orthonormal_pair();
        let length = light.length();
        let tube = light.tube.map(|_| 0.5);
        let half = 0.5 * DVec3::X;
        let gain = length.powf(3.0 - light.falloff) * light.tube.map_or(1.0, |radius| 2.0 * radius);
        Some(Self {
            key: Key::Line(light.falloff, tube.is_some()),
            emitter: Emitter::Line(LineEmitter { a: -half, b: half, falloff: light.falloff, tube }),
            frame: Frame { origin: light.middle(), axes: DMat3::from_cols(axis, u, v), size: length, gain },
        })
    }

    /// A point of other intensities in other directions; none where they are the same.
    fn web(light: &PointEmitter) -> Option<Self> {
        let web = light.web.as_ref()?;
        let level = Web { light_from_world: DMat3::IDENTITY, ..web.clone() };
        let axes = web.light_from_world.transpose();
        Some(Self {
            key: Key::Web(Arc::downgrade(&web.distribution)),
            emitter: Emitter::Point(PointEmitter { position: DVec3::ZERO, web: Some(level) }),
            frame: Frame { origin: light.position, axes, size: 1.0, gain: 1.0 },
        })
    }

    /// A punctual light of the canonical one, as it is in the world.
    pub(super) fn placed(&self, light: &Punctual) -> Punctual {
        let Frame { origin, axes, size, gain } = self.frame;
        match *light {
            Punctual::Point { position, intensity } => {
                Punctual::Point { position: origin + axes * (size * position), intensity: gain * intensity }
            }
            Punctual::Spot { position, intensity, axis, cone } => Punctual::Spot {
                position: origin + axes * (size * position),
                intensity: gain * intensity,
                axis: axes * axis,
                cone,
            },
            Punctual::Directional { to_light, illuminance } => {
                Punctual::Directional { to_light: axes * to_light, illuminance: gain * illuminance }
            }
        }
    }

    /// Diameter of the ball about the light, metres.
    pub(super) fn size(&self) -> f64 {
        self.frame.size
    }

    /// The whole intensity of the light in the direction in which it is greatest, or its illuminance.
    pub(super) fn strength(&self) -> f64 {
        match &self.emitter {
            Emitter::Polygon(light) => light.vector_area().length(),
            Emitter::Disk(light) => light.area(),
            Emitter::Textured(light) => light.area() * light.pattern.mean(),
            Emitter::Line(light) => light.length(),
            Emitter::Sphere(light) => PI * light.radius * light.radius,
            Emitter::Cap(light) => light.illuminance(),
            Emitter::Sky(light) => light.illuminance(),
            Emitter::Point(_) | Emitter::Directional(_) => 1.0,
        }
    }
}

impl Frame {
    /// Of a light whose illuminance does not depend on its size at points as many sizes away.
    fn flat(origin: DVec3, axes: DMat3, size: f64) -> Self {
        Self { origin, axes, size, gain: size * size }
    }

    /// Of a light that fills directions.
    fn far(to_light: DVec3) -> Self {
        Self { origin: DVec3::ZERO, axes: along(to_light), size: 1.0, gain: 1.0 }
    }
}

/// A frame whose Z is a unit vector.
fn along(z: DVec3) -> DMat3 {
    let (x, y) = z.any_orthonormal_pair();
    DMat3::from_cols(x, y, z)
}
