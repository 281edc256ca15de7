//! What a light does at a point where other things may stand between.
//!
//! Visibility is a factor of its own, the same for all methods of a light: the share of the exact response that is left,
//! of its diffuse and of its specular part. Of lines and polygons it is had exactly, by shading what is seen of them; of
//! all others by rays.

mod between;
mod rays;
mod reflected;
mod sampling;
mod source;
mod texels;

pub use rays::Precision;

use std::sync::Arc;

use glam::DVec3;

use between::Between;
use rays::{Gloss, Shares, visible_shares};
use reflected::Reflected;
use source::Source;

use crate::light::{Emitter, LineEmitter, PolygonEmitter};
use crate::math::triangulate::convex_parts;
use crate::shading::{Lobe, Method, Prepared, Response, ShadingPoint, respond};
use crate::surface::Bounds;
use crate::visibility::Objects;
use crate::visibility::line::visible_segments;
use crate::visibility::polygon::{Seen, visible_pieces};

/// What casts shadows.
#[derive(Clone, Debug)]
pub(super) struct Casters {
    objects: Arc<Objects>,
    /// About all objects but planes.
    extent: Bounds,
    precision: Precision,
}

/// How a light's shadows are had, prepared once.
#[derive(Clone, Debug, Default)]
pub(super) struct Shadow {
    /// Of a light with an area, which rays may sample.
    source: Option<Source>,
    /// Of a polygon, whose shadows are cut out of its convex parts.
    convex_parts: Vec<Vec<DVec3>>,
}

/// What is seen of a light.
enum Visible {
    All,
    /// The first lights together, without the second.
    Without(Vec<Emitter>, Vec<Emitter>),
    /// These shares of the diffuse and the specular response.
    Shares([f64; 2]),
    /// What rays find.
    ByRays,
}

impl Visible {
    const NOTHING: Self = Self::Shares([0.0, 0.0]);
}

impl Shadow {
    /// Of a light.
    pub(super) fn new(emitter: &Emitter) -> Self {
        let convex_parts = match emitter {
            Emitter::Polygon(polygon) => convex_parts(&polygon.vertices),
            _ => Vec::new(),
        };
        Self { source: Source::new(emitter), convex_parts }
    }
}

impl Casters {
    /// These objects, and the precision of what comes off the screen as numbers.
    pub(super) fn new(objects: &Arc<Objects>) -> Self {
        let bounds = objects.parts().iter().filter_map(|part| part.bounds());
        Self {
            objects: Arc::clone(objects),
            extent: bounds.fold(Bounds::EMPTY, Bounds::union),
            precision: Precision::default(),
        }
    }

    /// The same to another precision.
    pub(super) fn with_precision(self, precision: Precision) -> Self {
        Self { precision, ..self }
    }

    /// The response to what is seen of a light, at unit strength. `strengths` are what diffuse and specular response are
    /// multiplied by.
    pub(super) fn response(
        &self,
        light: &Prepared,
        shadow: &Shadow,
        at: &ShadingPoint,
        lobe: &Lobe,
        strengths: [f64; 2],
    ) -> Response {
        match self.visible(light.emitter(), shadow, at) {
            Visible::All => light.respond(at, lobe),
            Visible::Shares([0.0, 0.0]) => Response::default(),
            Visible::Shares(shares) => scaled(light.respond(at, lobe), shares),
            Visible::Without(lights, hidden) => of_what_is_seen(light, at, lobe, |exact| {
                let (all, hidden) = (sum(&lights, exact, at, lobe), sum(&hidden, exact, at, lobe));
                Response {
                    irradiance: (all.irradiance - hidden.irradiance).max(0.0),
                    specular: (all.specular - hidden.specular).max(0.0),
                }
            }),
            Visible::ByRays => self.by_rays(light, shadow, at, lobe, strengths),
        }
    }

    /// The same, by rays.
    fn by_rays(
        &self,
        light: &Prepared,
        shadow: &Shadow,
        at: &ShadingPoint,
        lobe: &Lobe,
        strengths: [f64; 2],
    ) -> Response {
        let whole = light.respond(at, lobe);
        let Some(source) = shadow.source.as_ref().filter(|_| whole != Response::default()) else { return whole };
        let shares = self.shares(source, at, lobe, specular_part(&whole, strengths));
        shares.map_or(whole, |Shares { shares, .. }| scaled(whole, shares))
    }

    /// The shares of a light that are seen by rays; none where nothing is between.
    fn shares(&self, source: &Source, at: &ShadingPoint, lobe: &Lobe, importance: f64) -> Option<Shares> {
        let seen = source.seen(at);
        let between = Between::new(&self.objects, &self.extent, &seen, at.p, at.n);
        match between {
            Between::Nothing => None,
            Between::Screen => Some(Shares::NOTHING),
            Between::These(_) | Between::Anything => {
                let gloss = Gloss { reflected: Reflected::new(lobe, at), importance };
                Some(visible_shares(&self.objects, &between, &seen, at, &gloss, self.precision))
            }
        }
    }

    /// What is seen of a light.
    fn visible(&self, emitter: &Emitter, shadow: &Shadow, at: &ShadingPoint) -> Visible {
        match emitter {
            Emitter::Line(line) => {
                let segments = visible_segments(&self.objects, at.p, at.n, [line.a, line.b]);
                let Some(segments) = segments else { return Visible::All };
                match segments.parts() {
                    [] => Visible::NOTHING,
                    parts => {
                        Visible::Without(parts.iter().map(|&[from, to]| segment(line, from, to)).collect(), Vec::new())
                    }
                }
            }
            Emitter::Polygon(polygon) => self.visible_polygon(polygon, &shadow.convex_parts, at),
            Emitter::Point(point) => shut(self.objects.hides(at.p, point.position - at.p)),
            Emitter::Directional(light) => shut(self.objects.hides_direction(at.p, light.to_light)),
            Emitter::Sphere(_) | Emitter::Disk(_) | Emitter::Textured(_) | Emitter::Cap(_) | Emitter::Sky(_) => {
                Visible::ByRays
            }
        }
    }

    /// What is seen of a polygon, from what is seen of its convex parts.
    fn visible_polygon(&self, polygon: &PolygonEmitter, parts: &[Vec<DVec3>], at: &ShadingPoint) -> Visible {
        let (mut lights, mut hidden) = (Vec::new(), Vec::new());
        let mut is_all = true;
        for part in parts {
            let seen = visible_pieces(&self.objects, at.p, at.n, part);
            is_all &= seen == Seen::All;
            match seen {
                Seen::All => lights.push(part.clone()),
                Seen::Nothing => {}
                Seen::Pieces(mut pieces) => lights.append(&mut pieces),
                Seen::AllBut(mut pieces) => {
                    lights.push(part.clone());
                    hidden.append(&mut pieces);
                }
                Seen::Unknown => return Visible::ByRays,
            }
        }
        match is_all {
            true => Visible::All,
            false if lights.is_empty() => Visible::NOTHING,
            false => Visible::Without(pieces_of(polygon, lights), pieces_of(polygon, hidden)),
        }
    }
}

/// The response to what is seen of a light: by an exact method `seen`, else in its proportion.
fn of_what_is_seen(light: &Prepared, at: &ShadingPoint, lobe: &Lobe, seen: impl Fn(Method) -> Response) -> Response {
    let exact = if light.method() == Method::Reference { Method::Reference } else { Method::Exact };
    let seen = seen(exact);
    if light.method() == exact {
        return seen;
    }
    let all = respond(light.emitter(), Method::Exact, at, lobe);
    scaled(light.respond(at, lobe), [share(seen.irradiance, all.irradiance), share(seen.specular, all.specular)])
}

/// The response to lights together.
fn sum(parts: &[Emitter], method: Method, at: &ShadingPoint, lobe: &Lobe) -> Response {
    let mut sum = Response::default();
    parts.iter().for_each(|part| sum += respond(part, method, at, lobe));
    sum
}

/// The specular share of what a point sends on.
fn specular_part(response: &Response, [diffuse, specular]: [f64; 2]) -> f64 {
    share(specular * response.specular, diffuse * response.irradiance + specular * response.specular)
}

/// The share of the whole that is seen, at most 1.
fn share(seen: f64, whole: f64) -> f64 {
    if whole > 0.0 { (seen / whole).min(1.0) } else { 0.0 }
}

fn scaled(response: Response, [diffuse, specular]: [f64; 2]) -> Response {
    Response { irradiance: diffuse * response.irradiance, specular: specular * response.specular }
}

fn shut(hidden: bool) -> Visible {
    if hidden { Visible::NOTHING } else { Visible::All }
}

/// Parts of a polygon.
fn pieces_of(polygon: &PolygonEmitter, pieces: Vec<Vec<DVec3>>) -> Vec<Emitter> {
    let place =
        |vertices| Emitter::Polygon(PolygonEmitter { vertices, normal: polygon.normal, two_sided: polygon.two_sided });
    pieces.into_iter().map(place).collect()
}

/// A part of a line, from one share of its length to another.
fn segment(line: &LineEmitter, from: f64, to: f64) -> Emitter {
    let along = line.b - line.a;
    Emitter::Line(LineEmitter { a: line.a + from * along, b: line.a + to * along, ..*line })
}

#[cfg(test)]
mod tests;
