//! What a light does at a point where other things may stand between.
//!
//! Visibility is a factor of its own, the same for all methods of a light: the share of the exact response that is left,
//! of its diffuse and of its specular part. Of lines and polygons it is had exactly, by shading what is seen of them; of
//! all others by rays.

mod rays;

use glam::DVec3;

use crate::light::{Emitter, LineEmitter, PolygonEmitter};
use crate::shading::{Lobe, Method, Prepared, Response, ShadingPoint, respond};
use crate::visibility::Objects;
use crate::visibility::line::visible_segments;
use crate::visibility::polygon::{Seen, visible_pieces};

/// What is seen of a light.
enum Visible {
    All,
    /// These lights, together.
    Parts(Vec<Emitter>),
    /// All but these lights.
    AllBut(Vec<Emitter>),
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
        Visible::Parts(parts) => of_what_is_seen(light, at, lobe, |exact| sum(&parts, exact, at, lobe)),
        Visible::AllBut(parts) => of_what_is_seen(light, at, lobe, |exact| {
            let (all, hidden) = (respond(light.emitter(), exact, at, lobe), sum(&parts, exact, at, lobe));
            Response {
                irradiance: (all.irradiance - hidden.irradiance).max(0.0),
                specular: (all.specular - hidden.specular).max(0.0),
            }
        }),
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

fn sum(parts: &[Emitter], method: Method, at: &ShadingPoint, lobe: &Lobe) -> Response {
    let responses = parts.iter().map(|part| respond(part, method, at, lobe));
    responses.fold(Response::default(), |a, b| Response {
        irradiance: a.irradiance + b.irradiance,
        specular: a.specular + b.specular,
    })
}

/// The share of the whole that is seen, at most 1.
fn share(seen: f64, whole: f64) -> f64 {
    if whole > 0.0 { (seen / whole).min(1.0) } else { 0.0 }
}

fn scaled(response: Response, [diffuse, specular]: [f64; 2]) -> Response {
    Response { irradiance: diffuse * response.irradiance, specular: specular * response.specular }
}

fn visible(objects: &Objects, light: &Prepared, at: &ShadingPoint, lobe: &Lobe) -> Visible {
    let by_rays = || rays::visible_shares(objects, light.emitter(), at, lobe).map_or(Visible::All, Visible::Shares);
    match light.emitter() {
        Emitter::Line(line) => {
            let Some(segments) = visible_segments(objects, at.p, at.n, [line.a, line.b]) else { return Visible::All };
            match segments.parts() {
                [] => Visible::NOTHING,
                parts => Visible::Parts(parts.iter().map(|&[from, to]| segment(line, from, to)).collect()),
            }
        }
        Emitter::Polygon(polygon) => match visible_pieces(objects, at.p, at.n, &polygon.vertices) {
            Seen::All => Visible::All,
            Seen::Nothing => Visible::NOTHING,
            Seen::Pieces(pieces) => Visible::Parts(pieces_of(polygon, pieces)),
            Seen::AllBut(pieces) => Visible::AllBut(pieces_of(polygon, pieces)),
            Seen::Unknown => by_rays(),
        },
        Emitter::Point(point) => shut(objects.hides(at.p, point.position - at.p)),
        Emitter::Directional(light) => shut(objects.hides_direction(at.p, light.to_light)),
        _ => by_rays(),
    }
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
