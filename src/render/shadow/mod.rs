//! What a light does at a point where other things may stand between.
//!
//! Visibility is a factor of its own, the same for all methods of a light: the share of the exact response that is left,
//! of its diffuse and of its specular part. Of lines and polygons it is had exactly, by shading what is seen of them; of
//! all others by rays.

mod rays;

use crate::light::{Emitter, LineEmitter, PolygonEmitter};
use crate::shading::{Lobe, Method, Prepared, Response, ShadingPoint, respond};
use crate::visibility::Objects;
use crate::visibility::line::visible_segments;
use crate::visibility::polygon::visible_pieces;

/// What is seen of a light.
enum Visible {
    All,
    /// These lights, together.
    Parts(Vec<Emitter>),
    /// These shares of the diffuse and the specular response.
    Shares([f64; 2]),
}

impl Visible {
    const NOTHING: Self = Self::Shares([0.0, 0.0]);
}

/// The response to what is seen of a light, at unit strength.
pub(super) fn shadowed_response(objects: &Objects, light: &Prepared, at: &ShadingPoint, lobe: &Lobe) -> Response {
    match visible(objects, light, at, lobe) {
        Visible::All => light.respond(at, lobe),
        Visible::Shares([0.0, 0.0]) => Response::default(),
        Visible::Shares(shares) => scaled(light.respond(at, lobe), shares),
        Visible::Parts(parts) => {
            let exact = if light.method() == Method::Reference { Method::Reference } else { Method::Exact };
            let seen = parts.iter().map(|part| respond(part, exact, at, lobe));
            let seen = seen.fold(Response::default(), |a, b| Response {
                irradiance: a.irradiance + b.irradiance,
                specular: a.specular + b.specular,
            });
            if light.method() == exact {
                return seen;
            }
            let whole = respond(light.emitter(), Method::Exact, at, lobe);
            scaled(
                light.respond(at, lobe),
                [share(seen.irradiance, whole.irradiance), share(seen.specular, whole.specular)],
            )
        }
    }
}

/// The share of the whole that is seen, at most 1.
fn share(seen: f64, whole: f64) -> f64 {
    if whole > 0.0 { (seen / whole).min(1.0) } else { 0.0 }
}

fn scaled(response: Response, [diffuse, specular]: [f64; 2]) -> Response {
    Response { irradiance: diffuse * response.irradiance, specular: specular * response.specular }
}

fn visible(objects: &Objects, light: &Prepared, at: &ShadingPoint, lobe: &Lobe) -> Visible {
    match light.emitter() {
        Emitter::Line(line) => {
            let Some(segments) = visible_segments(objects, at.p, at.n, [line.a, line.b]) else { return Visible::All };
            match segments.parts() {
                [] => Visible::NOTHING,
                parts => Visible::Parts(parts.iter().map(|&[from, to]| segment(line, from, to)).collect()),
            }
        }
        Emitter::Polygon(polygon) => match visible_pieces(objects, at.p, &polygon.vertices) {
            None => Visible::All,
            Some(pieces) if pieces.is_empty() => Visible::NOTHING,
            Some(pieces) => {
                let piece = |vertices| Emitter::Polygon(PolygonEmitter { vertices, ..polygon.clone() });
                Visible::Parts(pieces.into_iter().map(piece).collect())
            }
        },
        Emitter::Point(point) => shut(objects.hides(at.p, point.position - at.p)),
        Emitter::Directional(light) => shut(objects.hides_direction(at.p, light.to_light)),
        emitter => rays::visible_shares(objects, emitter, at, lobe).map_or(Visible::All, Visible::Shares),
    }
}

fn shut(hidden: bool) -> Visible {
    if hidden { Visible::NOTHING } else { Visible::All }
}

/// A part of a line, from one share of its length to another.
fn segment(line: &LineEmitter, from: f64, to: f64) -> Emitter {
    let along = line.b - line.a;
    Emitter::Line(LineEmitter { a: line.a + from * along, b: line.a + to * along, ..*line })
}
