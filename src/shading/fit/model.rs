//! What is free in a fit: lights of given kinds, and where a search for the best of them may start.

use std::f64::consts::{FRAC_PI_2, TAU};

use glam::DVec3;

use super::canonical::Canonical;
use super::region::{PARTS, Receiver};
use super::{Cone, Punctual};
use crate::light::{DiskEmitter, Emitter, LineEmitter, PointEmitter, PolygonEmitter};
use crate::math::least_squares::Residuals;
use crate::shading::cluster::{cap_directions, disk_points, line_points, polygon_points};
use crate::shading::sphere::Cap;
use crate::shading::textured::{as_polygon, textured_points};

/// A light whose strength, place or direction, and cone are free. Its parameters are the strength, the ways along
/// `spans`, and of a spot the cosine of its inner angle and what share of that the outer one's is.
#[derive(Clone, Debug)]
pub(super) struct Model {
    kind: Kind,
    base: DVec3,
    spans: Vec<DVec3>,
}

#[derive(Clone, Copy, Debug)]
enum Kind {
    Point,
    /// Along that axis.
    Spot(DVec3),
    /// In the origin; the spans turn it.
    Aimed,
    Directional,
}

/// Lights to be fitted, the parameters that a search starts from, and their bounds.
#[derive(Clone, Debug, Default)]
pub(super) struct Start {
    pub(super) models: Vec<Model>,
    pub(super) parameters: Vec<f64>,
    pub(super) bounds: Vec<[f64; 2]>,
}

/// No light of a fit is stronger than that; a light of luminance 1 in a ball of diameter 1 is weaker than π.
const STRONGEST: f64 = 100.0;

/// The ring on which a disk's lights may start, as a share of its radius.
const RING: f64 = 0.7;

/// How far the direction of a parallel light may move, as a tangent.
const ASIDE: f64 = 0.5;

impl Model {
    fn count(&self) -> usize {
        1 + self.spans.len() + if self.kind.has_cone() { 2 } else { 0 }
    }

    fn light(&self, x: &[f64]) -> Punctual {
        let (strength, rest) = (x[0], &x[1..]);
        let position = self.base + self.spans.iter().zip(rest).map(|(span, way)| *way * *span).sum::<DVec3>();
        match self.kind {
            Kind::Point => Punctual::Point { position, intensity: strength },
            Kind::Directional => {
                Punctual::Directional { to_light: position.normalize_or(self.base), illuminance: strength }
            }
            Kind::Spot(axis) => {
                Punctual::Spot { position, intensity: strength, axis, cone: cone(&rest[self.spans.len()..]) }
            }
            Kind::Aimed => {
                let axis = position.normalize_or(self.base);
                let cone = cone(&rest[self.spans.len()..]);
                Punctual::Spot { position: DVec3::ZERO, intensity: strength, axis, cone }
            }
        }
    }
}

/// The cone of the cosine of its inner angle, and of the share of that which the outer one's is.
fn cone(x: &[f64]) -> Cone {
    Cone { cos_inner: x[0], cos_outer: x[1] * (x[0] - Cone::LEAST_EDGE) }
}

impl Kind {
    fn has_cone(self) -> bool {
        matches!(self, Self::Spot(_) | Self::Aimed)
    }
}

impl Start {
    /// Adds a light; along each span it may move between the two `ways`. Of a spot, `cos_inner` is where its cone starts.
    fn push(&mut self, model: Model, strength: f64, ways: &[[f64; 2]], cos_inner: f64) {
        self.parameters.push(strength);
        self.bounds.push([0.0, STRONGEST]);
        self.parameters.extend(ways.iter().map(|_| 0.0));
        self.bounds.extend(ways);
        if model.kind.has_cone() {
            self.parameters.extend([cos_inner, 0.0]);
            self.bounds.extend([[2.0 * Cone::LEAST_EDGE, 1.0], [0.0, 1.0]]);
        }
        self.models.push(model);
    }

    fn append(&mut self, mut other: Self) {
        self.models.append(&mut other.models);
        self.parameters.append(&mut other.parameters);
        self.bounds.append(&mut other.bounds);
    }

    /// The lights of those parameters.
    pub(super) fn lights(&self, x: &[f64]) -> Vec<Punctual> {
        let mut rest = x;
        self.models
            .iter()
            .map(|model| {
                let (own, others) = rest.split_at(model.count());
                rest = others;
                model.light(own)
            })
            .collect()
    }
}

/// From where to look for the best `count` lights that stand for a canonical one: from several starts, as no search
/// finds its way from every one to the best.
pub(super) fn starts(canonical: &Canonical, count: u32) -> Vec<Start> {
    let strength = canonical.strength() / f64::from(count);
    match &canonical.emitter {
        Emitter::Sphere(_) => vec![spread(&[DVec3::ZERO], (1, canonical.strength()), &[], |_| (Kind::Point, 0.0))],
        Emitter::Line(light) => line(light, (count, strength)),
        Emitter::Polygon(light) => flat(light.two_sided, &polygon_extent(light), (count, strength), |places| {
            polygon_points(light, places).iter().map(|point| point.position).collect()
        }),
        Emitter::Disk(light) => {
            let half_sides = [DVec3::X, DVec3::Y].map(|axis| light.radius * axis);
            let spiral = |places| disk_points(light, places).map(|point| point.position).collect();
            let mut starts = flat(light.two_sided, &half_sides, (count, strength), spiral);
            let narrower = DiskEmitter { radius: RING * light.radius, ..*light };
            starts.extend(flat(light.two_sided, &half_sides, (count, strength), |places| match places {
                1 => vec![light.center],
                _ => narrower.rim(places).collect(),
            }));
            starts
        }
        Emitter::Textured(light) => {
            flat(light.two_sided, &polygon_extent(&as_polygon(light)), (count, strength), |places| {
                textured_points(light, places).iter().map(|point| point.position).collect()
            })
        }
        Emitter::Cap(light) => far(light.half_angle, (count, strength)),
        Emitter::Sky(_) => far(FRAC_PI_2, (count, strength)),
        Emitter::Point(light) => aimed(light, (count, strength)),
        Emitter::Directional(_) => Vec::new(),
    }
}

/// Spots in the place of a point, aimed where it is brightest, or all around; with a point among them, and without.
fn aimed(light: &PointEmitter, (count, strength): (u32, f64)) -> Vec<Start> {
    let half: Vec<_> = cap_directions(&Cap::new(DVec3::Z, FRAC_PI_2), count.max(16)).collect();
    let mut around: Vec<_> = half.iter().copied().chain(half.iter().map(|direction| -*direction)).collect();
    around.sort_by(|a, b| light.intensity(*b).total_cmp(&light.intensity(*a)));
    let brightest = around[0];
    let mut starts = Vec::new();
    for points in [0, 1] {
        for spread_out in [false, true] {
            let mut start = Start::default();
            for i in 0..count {
                let share = f64::from(i + 1) / f64::from(count);
                if i < points {
                    let model = Model { kind: Kind::Point, base: DVec3::ZERO, spans: Vec::new() };
                    start.push(model, strength, &[], 0.0);
                    continue;
                }
                let base = if spread_out { around[i as usize] } else { brightest };
                let (u, v) = base.any_orthonormal_pair();
                let model = Model { kind: Kind::Aimed, base, spans: vec![u, v] };
                start.push(model, strength, &[[-1.0, 1.0]; 2], 0.95 * share);
            }
            starts.push(start);
        }
    }
    starts
}

/// Points along a line; of a tube also sets of four spots about the axis, which have sin² ψ together, and points.
fn line(light: &LineEmitter, lights @ (count, strength): (u32, f64)) -> Vec<Start> {
    let half = [0.5 * (light.b - light.a)];
    let places = |places: u32| line_points(light, places).collect::<Vec<_>>();
    let mut starts = vec![spread(&places(count), lights, &half, |_| (Kind::Point, 0.0))];
    let about = [DVec3::Y, DVec3::Z, DVec3::NEG_Y, DVec3::NEG_Z];
    for sets in [count / 5, count / 4].into_iter().filter(|sets| light.tube.is_some() && *sets > 0) {
        let mut start = spread(&places(sets), (4 * sets, strength), &half, |turn| (Kind::Spot(about[turn % 4]), 1.0));
        let rest = count - 4 * sets;
        if rest > 0 {
            start.append(spread(&places(rest), (rest, strength), &half, |_| (Kind::Point, 0.0)));
        }
        starts.push(start);
    }
    starts
}

/// Half the sides of the box about a polygon in the plane z = 0.
fn polygon_extent(light: &PolygonEmitter) -> [DVec3; 2] {
    let half = light.vertices.iter().fold(DVec3::ZERO, |half, vertex| half.max(vertex.abs()));
    [half.x * DVec3::X, half.y * DVec3::Y]
}

/// Spots on a flat light. The cosine of its emission takes several spots of different cones, and its extent several
/// places: one start a way to share the spots out. What shines to both sides may also be points.
fn flat(
    two_sided: bool,
    half_sides: &[DVec3; 2],
    lights @ (count, _): (u32, f64),
    places: impl Fn(u32) -> Vec<DVec3>,
) -> Vec<Start> {
    let sides: &[DVec3] = if two_sided { &[DVec3::Z, DVec3::NEG_Z] } else { &[DVec3::Z] };
    let mut starts = Vec::new();
    if two_sided {
        starts.push(spread(&places(count), lights, half_sides, |_| (Kind::Point, 0.0)));
    }
    for cones in [1, 2, 3, 4, 6, 8] {
        let rounds = cones * sides.len();
        let Some(each) = u32::try_from(rounds).ok().filter(|rounds| *rounds <= count) else { break };
        // A single cone comes nearest to a cosine with its inner angle at 45°.
        let inner = |cone: usize| if cones == 1 { 0.7 } else { 0.95 * (cone + 1) as f64 / cones as f64 };
        let kind = |turn: usize| (Kind::Spot(sides[turn % sides.len()]), inner(turn / sides.len() % cones));
        starts.push(spread(&places(count.div_ceil(each)), lights, half_sides, kind));
    }
    starts
}

/// So many lights of that strength over places, to be moved within `half_sides` of the origin: one at each place, then one
/// more at each, and so on; `kind` says which kind and cone in which turn.
fn spread(
    places: &[DVec3],
    (count, strength): (u32, f64),
    half_sides: &[DVec3],
    kind: impl Fn(usize) -> (Kind, f64),
) -> Start {
    let mut start = Start::default();
    let turns = (0..).flat_map(|turn| places.iter().map(move |place| (turn, *place)));
    for (turn, base) in turns.take(if places.is_empty() { 0 } else { count as usize }) {
        let way = |half: &DVec3| {
            let now = base.dot(*half) / half.length_squared();
            [(-1.0 - now).min(0.0), (1.0 - now).max(0.0)]
        };
        let ways: Vec<_> = half_sides.iter().map(way).collect();
        let (kind, cos_inner) = kind(turn);
        start.push(Model { kind, base, spans: half_sides.to_vec() }, strength, &ways, cos_inner);
    }
    start
}

/// Parallel lights for what fills the directions within an angle of Z: on a spiral, or on a ring about one at Z.
fn far(half_angle: f64, (count, strength): (u32, f64)) -> Vec<Start> {
    if count == 1 {
        return vec![parallel(&[DVec3::Z], strength)];
    }
    let spiral: Vec<_> = cap_directions(&Cap::new(DVec3::Z, half_angle), count).collect();
    let (sin_polar, cos_polar) = (0.7 * half_angle).sin_cos();
    let around = (1..count).map(|i| {
        let (sin, cos) = (TAU * f64::from(i) / f64::from(count - 1)).sin_cos();
        DVec3::new(sin_polar * cos, sin_polar * sin, cos_polar)
    });
    let ring: Vec<_> = std::iter::once(DVec3::Z).chain(around).collect();
    vec![parallel(&spiral, strength), parallel(&ring, strength)]
}

fn parallel(directions: &[DVec3], strength: f64) -> Start {
    let mut start = Start::default();
    for direction in directions {
        let (u, v) = direction.any_orthonormal_pair();
        let model = Model { kind: Kind::Directional, base: *direction, spans: vec![u, v] };
        start.push(model, strength, &[[-ASIDE, ASIDE]; 2], 0.0);
    }
    start
}

/// Lights against receivers.
pub(super) struct Search<'a> {
    pub(super) start: &'a Start,
    pub(super) receivers: &'a [Receiver],
}

/// Step of the differences that stand for derivatives, which are good to a millionth so.
const STEP: f64 = 1e-6;

impl Residuals for Search<'_> {
    fn residuals(&self, x: &[f64]) -> Vec<f64> {
        let lights = self.start.lights(x);
        self.receivers.iter().flat_map(|receiver| residual(receiver, &lights)).collect()
    }

    fn jacobian(&self, x: &[f64]) -> Vec<Vec<f64>> {
        let mut columns = Vec::with_capacity(x.len());
        let mut first = 0;
        for model in &self.start.models {
            let own = &x[first..first + model.count()];
            let shares = |light: &Punctual| -> Vec<f64> {
                self.receivers.iter().flat_map(|receiver| receiver.share(light)).collect()
            };
            let here = shares(&model.light(own));
            for (i, now) in own.iter().enumerate() {
                let mut moved = own.to_vec();
                let step = if now + STEP > self.start.bounds[first + i][1] { -STEP } else { STEP };
                moved[i] += step;
                let there = shares(&model.light(&moved));
                columns.push(there.iter().zip(&here).map(|(there, here)| (there - here) / step).collect());
            }
            first += model.count();
        }
        columns
    }
}

/// What lights do to a receiver less what is exact.
pub(super) fn residual(receiver: &Receiver, lights: &[Punctual]) -> [f64; PARTS] {
    let mut residual = receiver.exact().map(|exact| -exact);
    for light in lights {
        residual.iter_mut().zip(receiver.share(light)).for_each(|(residual, share)| *residual += share);
    }
    residual
}
