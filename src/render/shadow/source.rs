//! Lights as rays sample them: which directions from a point meet a light, how bright it is there and how far.

use std::f64::consts::{FRAC_1_PI, PI, TAU};
use std::sync::Arc;

use glam::{DVec2, DVec3};

use super::sampling::{Frame, on_disk};
use super::texels::Texels;
use crate::light::pattern::Channel;
use crate::light::{CapEmitter, DiskEmitter, Emitter, PolygonEmitter, SkyEmitter, SphereEmitter, TexturedEmitter};
use crate::shading::ShadingPoint;
use crate::shading::point::CONTACT;

/// A light that rays sample, with what is prepared once.
#[derive(Clone, Debug)]
pub(super) enum Source {
    Sphere(SphereEmitter),
    Cap(CapEmitter),
    Sky(SkyEmitter),
    Flat(Flat),
}

/// A light in a plane, within the rectangle that a corner and two sides span.
#[derive(Clone, Debug)]
pub(super) struct Flat {
    corner: DVec3,
    sides: [DVec3; 2],
    /// Unit normal of the plane.
    normal: DVec3,
    outline: Outline,
    /// Corners of a polygon about it.
    corners: Vec<DVec3>,
}

/// What shines of the rectangle, by shares u and v of its sides.
#[derive(Clone, Debug)]
enum Outline {
    /// The ellipse that touches the sides.
    Ellipse,
    /// Polygon.
    Polygon(Vec<DVec2>),
    Pattern(Arc<Channel>, Texels),
}

/// A light as a point sees it.
pub(super) enum Seen<'a> {
    Cone(Cone),
    /// The inside of a sphere about the vector to its centre, of that radius: everything above a surface.
    Inside(DVec3, f64, Frame),
    /// Above a surface.
    Sky(SkyEmitter, Frame),
    /// With the vector to its corner.
    Flat(&'a Flat, DVec3),
}

/// A cone of directions.
pub(super) struct Cone {
    frame: Frame,
    /// Sine and cosine of the half-angle.
    sin: f64,
    cos: f64,
    /// The vector to the centre of the sphere that fills it, and its radius; none for light infinitely far away.
    sphere: Option<(DVec3, f64)>,
}

/// What a direction meets of a light.
pub(super) struct Met {
    /// How far it is; infinite for skies and caps.
    pub(super) distance: f64,
    pub(super) radiance: f64,
    /// The density with which [`Seen::sample`] gives this direction, 1/sr.
    pub(super) density: f64,
}

/// A polygon about all that is seen of a light: every ray to the light passes through it, or would if it went on.
pub(super) struct Hull {
    /// Corners as vectors from the point.
    pub(super) corners: Vec<DVec3>,
    /// The light ends within the polygon that is this many times as far; infinite for caps.
    pub(super) depth: f64,
}

/// Corners of a polygon about a circle.
const CORNERS: u32 = 8;

/// A cone whose half-angle's cosine is below this is too wide for a [`Hull`].
const WIDEST: f64 = 0.25;

impl Source {
    /// The light, if rays sample it.
    pub(super) fn new(emitter: &Emitter) -> Option<Self> {
        Some(match emitter {
            Emitter::Sphere(light) => Self::Sphere(*light),
            Emitter::Cap(light) => Self::Cap(*light),
            Emitter::Sky(light) => Self::Sky(*light),
            Emitter::Disk(light) => Self::Flat(Flat::of_disk(light)),
            Emitter::Textured(light) => Self::Flat(Flat::of_pattern(light)),
            Emitter::Polygon(light) => Self::Flat(Flat::of_polygon(light)?),
            Emitter::Line(_) | Emitter::Point(_) | Emitter::Directional(_) => return None,
        })
    }

    /// The light as it is seen from a point that it shines on.
    pub(super) fn seen(&self, at: &ShadingPoint) -> Seen<'_> {
        match self {
            Self::Sphere(light) => {
                let to_center = light.center - at.p;
                let distance = to_center.length();
                if distance <= light.radius || distance < CONTACT {
                    return Seen::Inside(to_center, light.radius, Frame::about(at.n));
                }
                let cos = ((distance - light.radius) * (distance + light.radius)).sqrt() / distance;
                let frame = Frame::about(to_center / distance);
                Seen::Cone(Cone { frame, sin: light.radius / distance, cos, sphere: Some((to_center, light.radius)) })
            }
            Self::Cap(light) => {
                let (sin, cos) = light.half_angle.sin_cos();
                Seen::Cone(Cone { frame: Frame::about(light.to_center), sin, cos: cos.max(0.0), sphere: None })
            }
            Self::Sky(light) => Seen::Sky(*light, Frame::about(at.n)),
            Self::Flat(light) => Seen::Flat(light, light.corner - at.p),
        }
    }
}

impl Flat {
    fn of_disk(light: &DiskEmitter) -> Self {
        let frame = Frame::about(light.normal);
        let [x, y] = [0.0, 0.25].map(|share| light.radius * frame.rim(share));
        let corners = about_circle(&frame, light.radius).map(|corner| light.center + corner).collect();
        let (corner, sides) = (light.center - x - y, [2.0 * x, 2.0 * y]);
        Self { corner, sides, normal: light.normal, outline: Outline::Ellipse, corners }
    }

    fn of_pattern(light: &TexturedEmitter) -> Self {
        Self {
            corner: light.corner,
            sides: [light.row, light.column],
            normal: light.normal,
            outline: Outline::Pattern(Arc::clone(&light.pattern), Texels::new(&light.pattern)),
            corners: light.corners().to_vec(),
        }
    }

    /// The rectangle about a polygon has a side along the polygon's first.
    fn of_polygon(light: &PolygonEmitter) -> Option<Self> {
        let [first, second, ..] = light.vertices[..] else { return None };
        let x = (second - first).try_normalize()?;
        let y = light.normal.cross(x);
        let flat: Vec<_> = light.vertices.iter().map(|&v| DVec2::new(x.dot(v - first), y.dot(v - first))).collect();
        let least = flat.iter().copied().fold(DVec2::INFINITY, DVec2::min);
        let size = flat.iter().copied().fold(DVec2::NEG_INFINITY, DVec2::max) - least;
        Some(Self {
            corner: first + least.x * x + least.y * y,
            sides: [size.x * x, size.y * y],
            normal: light.normal,
            outline: Outline::Polygon(flat.iter().map(|&v| (v - least) / size).collect()),
            corners: light.vertices.clone(),
        })
    }

    fn area(&self) -> f64 {
        self.sides[0].length() * self.sides[1].length()
    }

    /// The vector to the rectangle's middle.
    fn to_middle(&self, to_corner: DVec3) -> DVec3 {
        to_corner + 0.5 * (self.sides[0] + self.sides[1])
    }

    /// The share of the plane's rectangle that a direction meets, and how far that is.
    fn crossing(&self, to_corner: DVec3, w: DVec3) -> Option<(DVec2, f64)> {
        let distance = to_corner.dot(self.normal) / w.dot(self.normal);
        let x = distance * w - to_corner;
        let shares = DVec2::from_array(self.sides.map(|side| x.dot(side) / side.length_squared()));
        (distance > 0.0 && shares.cmpge(DVec2::ZERO).all() && shares.cmple(DVec2::ONE).all())
            .then_some((shares, distance))
    }
}

impl Outline {
    fn sample(&self, square: DVec2) -> DVec2 {
        match self {
            Self::Ellipse => 0.5 + 0.5 * on_disk(square),
            Self::Polygon(_) => square,
            Self::Pattern(_, texels) => texels.point(square),
        }
    }

    /// Luminance there, and the density of [`Self::sample`] over the unit square.
    fn level(&self, shares: DVec2) -> Option<(f64, f64)> {
        match self {
            Self::Ellipse => ((2.0 * shares - 1.0).length_squared() <= 1.0).then_some((1.0, 4.0 * FRAC_1_PI)),
            Self::Polygon(vertices) => is_inside(vertices, shares).then_some((1.0, 1.0)),
            Self::Pattern(channel, _) => {
                let level = channel.value(shares.x, shares.y);
                (level > 0.0).then(|| (level, level / channel.mean()))
            }
        }
    }
}

/// Whether a ray from a point crosses a polygon's edges an odd number of times.
fn is_inside(vertices: &[DVec2], at: DVec2) -> bool {
    let edges = vertices.iter().zip(vertices.iter().cycle().skip(1));
    let crossed =
        edges.filter(|(a, b)| (a.y > at.y) != (b.y > at.y) && at.x < a.x + (at.y - a.y) / (b.y - a.y) * (b.x - a.x));
    crossed.count() % 2 == 1
}

/// The corners of a polygon about a circle about the axis.
fn about_circle(frame: &Frame, radius: f64) -> impl Iterator<Item = DVec3> {
    let reach = radius / (PI / f64::from(CORNERS)).cos();
    (0..CORNERS).map(move |i| reach * frame.rim(f64::from(i) / f64::from(CORNERS)))
}

impl Cone {
    /// 1 − cos of the half-angle.
    fn height(&self) -> f64 {
        self.sin * self.sin / (1.0 + self.cos)
    }

    /// The distance at which a direction within the cone meets the sphere.
    fn distance(&self, w: DVec3) -> f64 {
        self.sphere.map_or(f64::INFINITY, |(to_center, radius)| {
            let along = w.dot(to_center);
            let across = (to_center - along * w).length();
            (along - ((radius - across) * (radius + across)).max(0.0).sqrt()).max(0.0)
        })
    }
}

impl Seen<'_> {
    /// A direction in which the light may be, from a point of the unit square.
    pub(super) fn sample(&self, square: DVec2) -> DVec3 {
        match self {
            Self::Cone(cone) => cone.frame.in_cone(on_disk(square), cone.height()),
            Self::Inside(_, _, frame) | Self::Sky(_, frame) => frame.by_cosine(on_disk(square)),
            Self::Flat(light, to_corner) => {
                let shares = light.outline.sample(square);
                (to_corner + shares.x * light.sides[0] + shares.y * light.sides[1]).normalize_or_zero()
            }
        }
    }

    /// What a unit direction above the surface meets of the light.
    pub(super) fn meet(&self, w: DVec3) -> Option<Met> {
        match self {
            Self::Cone(cone) => {
                let height = cone.height();
                let below = 0.5 * (w - cone.frame.axis).length_squared();
                let density = (TAU * height).recip();
                // Directions are good to rounding of 1.
                (below <= height + 4.0 * f64::EPSILON * height.sqrt()).then(|| Met {
                    distance: cone.distance(w),
                    radiance: 1.0,
                    density,
                })
            }
            Self::Inside(to_center, radius, frame) => {
                let along = w.dot(*to_center);
                let across = (to_center - along * w).length();
                let distance = along + ((radius - across) * (radius + across)).max(0.0).sqrt();
                Some(Met { distance, radiance: 1.0, density: FRAC_1_PI * w.dot(frame.axis) })
            }
            Self::Sky(light, frame) => {
                let met = Met {
                    distance: f64::INFINITY,
                    radiance: light.radiance(w),
                    density: FRAC_1_PI * w.dot(frame.axis),
                };
                (met.radiance > 0.0).then_some(met)
            }
            Self::Flat(light, to_corner) => {
                let (shares, distance) = light.crossing(*to_corner, w)?;
                let (radiance, density) = light.outline.level(shares)?;
                let density = density / light.area() * distance * distance / w.dot(light.normal).abs();
                Some(Met { distance, radiance, density })
            }
        }
    }

    /// The solid angle of the light, at most; sr.
    pub(super) fn solid_angle(&self) -> f64 {
        match self {
            Self::Cone(cone) => TAU * cone.height(),
            Self::Inside(..) | Self::Sky(..) => TAU,
            Self::Flat(light, to_corner) => {
                let nearest = to_corner.dot(light.normal).abs();
                let farther = light.to_middle(*to_corner).length();
                TAU.min(light.area() * nearest / farther.powi(3).max(f64::MIN_POSITIVE))
            }
        }
    }

    /// Whether a flat light is so near that its points' directions are far from equally likely.
    pub(super) fn is_near(&self) -> bool {
        let Self::Flat(light, to_corner) = self else { return false };
        let longest = light.sides[0].length().max(light.sides[1].length());
        light.to_middle(*to_corner).length() < longest && to_corner.dot(light.normal).abs() < NEAR * longest
    }

    /// The polygon about the light; none where it is too wide for one.
    pub(super) fn hull(&self) -> Option<Hull> {
        match self {
            Self::Cone(cone) => {
                let near = cone.sphere.map_or(1.0, |(to_center, radius)| to_center.length() - radius);
                let far = cone.sphere.map_or(f64::INFINITY, |(to_center, _)| to_center.length() * cone.cos * cone.cos);
                if cone.cos < WIDEST {
                    return None;
                }
                let rim = about_circle(&cone.frame, near * cone.sin / cone.cos);
                let corners = rim.map(|rim| near * cone.frame.axis + rim).collect();
                Some(Hull { corners, depth: far / near })
            }
            Self::Flat(light, to_corner) => {
                let corners = light.corners.iter().map(|corner| corner - light.corner + to_corner).collect();
                Some(Hull { corners, depth: 1.0 })
            }
            Self::Inside(..) | Self::Sky(..) => None,
        }
    }

    /// Normals of horizons above which all is that is seen of the light and counts on a surface of normal n.
    pub(super) fn horizons(&self, n: DVec3) -> impl Iterator<Item = DVec3> {
        let own = match self {
            Self::Cone(cone) => Some(cone.frame.axis),
            Self::Sky(light, _) => Some(light.zenith),
            Self::Inside(..) | Self::Flat(..) => None,
        };
        std::iter::once(n).chain(own)
    }

    /// The least height of the light above the point along a unit direction: below 0, of infinite ones, without end.
    pub(super) fn least_height(&self, n: DVec3) -> f64 {
        let endless = |above: bool| if above { 0.0 } else { f64::NEG_INFINITY };
        match self {
            Self::Cone(Cone { sphere: Some((to_center, radius)), .. }) | Self::Inside(to_center, radius, _) => {
                n.dot(*to_center) - radius
            }
            Self::Cone(cone) => endless(n.dot(cone.frame.axis) >= cone.sin * ABOVE),
            Self::Sky(light, frame) => endless(
                [light.zenith, frame.axis]
                    .iter()
                    .any(|axis| axis.cross(n).length() <= 1.0 - ABOVE && n.dot(*axis) > 0.0),
            ),
            Self::Flat(light, to_corner) => {
                let heights = light.corners.iter().map(|corner| n.dot(corner - light.corner + to_corner));
                heights.fold(f64::INFINITY, f64::min)
            }
        }
    }
}

/// Of a flat light, the distance from its plane in longest sides below which it is near.
const NEAR: f64 = 0.5;

/// What is above a horizon but for a share of this is above it.
const ABOVE: f64 = 1.0 - 1e-12;
