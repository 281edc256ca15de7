//! Outlines, symbols, directions and names of lights.

use egui::{Color32, Painter, Pos2, Rect, Stroke, vec2};
use glam::DVec3;

use super::{TEXT, label_beside, line};
use crate::editor::session::{Item, Selection};
use crate::editor::viewport::pick::{SYMBOL, Solids, closed, outline};
use crate::editor::viewport::projection::Projection;
use crate::editor::viewport::symbol::Symbol;
use crate::light::{Emitter, Light, LineEmitter, PointEmitter, Shape, SphereEmitter};
use crate::math::frame;
use crate::scene::Scene;

/// An outline is tested for being hidden at so many places an edge.
const TESTS: u32 = 24;
/// Opacity of what is hidden by surfaces.
const HIDDEN: f32 = 0.3;
/// Length of the arrow in the direction of emission, points.
const ARROW: f64 = 34.0;
/// The same on a light that is not selected.
const SHORT_ARROW: f64 = 18.0;
/// Segments of a sphere's outline.
const CIRCLE: u32 = 64;
/// Opacity of lines on a rounded light, within its outline.
const WITHIN: f32 = 0.45;

/// Opacity of the dark edge beside a line that has none itself.
const EDGE: f32 = 0.7;

/// What to say about each light.
struct Look {
    stroke: Stroke,
    selected: bool,
}

/// A light's name, and where it belongs.
struct Name<'a> {
    text: &'a str,
    at: Pos2,
    color: Color32,
    /// Names of what is hovered have the best places, then of what is selected.
    rank: u8,
}

/// What is marked among the lights, and how.
#[derive(Clone, Copy, Debug)]
pub struct Marks<'a> {
    /// What is selected.
    pub selection: &'a Selection,
    /// What is under the pointer.
    pub hovered: Option<Item>,
    /// Colour of what is selected.
    pub accent: Color32,
    /// The picture may be white, where lines need dark edges.
    pub on_bright: bool,
}

/// Draw every light: selected ones in the accent, the hovered one a little stronger; from the middle of flat ones an arrow
/// to the lit side.
///
/// Names are given to what is selected or hovered, and to all lights when there are few. They cover neither each other nor
/// what is `taken`, to which they are added; those that there is no room for are left out.
pub fn paint_lights(
    scene: &Scene,
    marks: &Marks<'_>,
    solids: &Solids,
    projection: &Projection,
    taken: &mut Vec<Rect>,
    painter: &Painter,
) {
    let Marks { selection, accent, on_bright, .. } = *marks;
    let few = scene.lights.len() <= 8;
    let mut names = Vec::new();
    for (i, light) in scene.lights.iter().enumerate() {
        let item = Item::Light(i);
        let (selected, hovered) = (selection.contains(item), marks.hovered == Some(item));
        let color = if selected { accent } else { Color32::from_rgb(0xe8, 0xea, 0xee) };
        let color = if light.muted { color.gamma_multiply(0.45) } else { color };
        let stroke = match (selected, hovered) {
            (true, _) => Stroke::new(2.0, color),
            (false, true) => Stroke::new(1.75, color),
            (false, false) => Stroke::new(1.0, color.gamma_multiply(0.6)),
        };
        let anchor = Painted { solids, projection, painter, on_bright }.light(light, &Look { stroke, selected });
        let rank = match (hovered, selected) {
            (true, _) => 0,
            (false, true) => 1,
            (false, false) => 2,
        };
        if let Some(at) = anchor.filter(|at| (few || rank < 2) && painter.clip_rect().contains(*at)) {
            let color = if selected { color } else { TEXT.gamma_multiply(if light.muted { 0.5 } else { 0.85 }) };
            names.push(Name { text: &light.name, at, color, rank });
        }
    }
    names.sort_by_key(|name| name.rank);
    for name in names {
        label_beside(name.text, name.at, name.color, taken, painter);
    }
}

/// Draw a polygon's outline in one colour.
pub fn paint_outline(light: &Light, stroke: Stroke, projection: &Projection, painter: &Painter) {
    if let Some(outline) = outline(light) {
        closed(&outline).for_each(|[a, b]| line(a, b, stroke, projection, painter));
    }
}

struct Painted<'a> {
    solids: &'a Solids,
    projection: &'a Projection,
    painter: &'a Painter,
    on_bright: bool,
}

impl Painted<'_> {
    /// Draws a light; where its name belongs, if it is in sight.
    fn light(&self, light: &Light, look: &Look) -> Option<Pos2> {
        match &light.emitter() {
            Emitter::Polygon(polygon) => self.flat(light, polygon.centroid(), polygon.normal, polygon.two_sided, look),
            Emitter::Disk(disk) => self.flat(light, disk.center, disk.normal, disk.two_sided, look),
            Emitter::Textured(textured) => {
                self.flat(light, textured.point(0.5, 0.5), textured.normal, textured.two_sided, look)
            }
            Emitter::Cap(_) | Emitter::Sky(_) => self.far(light, look),
            Emitter::Line(line) => self.line(line, look.stroke),
            Emitter::Sphere(sphere) => self.sphere(sphere, look.stroke),
            Emitter::Point(point) => {
                self.web(point, look.stroke);
                self.point(point.position, look.stroke)
            }
            Emitter::Directional(directional) => self.parallel(light, directional.to_light, look),
        }
    }

    /// A line, and the ends of a tube.
    fn line(&self, emitter: &LineEmitter, stroke: Stroke) -> Option<Pos2> {
        let thick = Stroke::new(stroke.width + 1.0, stroke.color);
        self.hidden_line(emitter.a, emitter.b, thick);
        if let (Some(radius), Some(axis)) = (emitter.tube, (emitter.b - emitter.a).try_normalize()) {
            let (u, v) = axis.any_orthonormal_pair();
            for end in [emitter.a, emitter.b] {
                self.rim(&circle(end, radius, [u, v]), stroke);
            }
        }
        self.highest(&[emitter.a, emitter.b])
    }

    /// A flat light: its outline, and from its middle the directions it emits in.
    fn flat(&self, light: &Light, center: DVec3, normal: DVec3, two_sided: bool, look: &Look) -> Option<Pos2> {
        let outline = outline(light)?;
        closed(&outline).for_each(|[a, b]| self.hidden_line(a, b, look.stroke));
        let length = if look.selected { ARROW } else { SHORT_ARROW };
        self.arrow(center, normal, length, look.stroke);
        if two_sided {
            self.arrow(center, -normal, length, look.stroke);
        }
        self.highest(&outline)
    }

    /// A light that fills directions: a cone of them with a sun at its end, or a dome.
    fn far(&self, light: &Light, look: &Look) -> Option<Pos2> {
        let symbol = Symbol::new(light, self.projection);
        let lines = symbol.lines(&light.shape);
        lines.iter().for_each(|[a, b]| self.straight(*a, *b, look.stroke));
        if matches!(light.shape, Shape::Cap(_)) {
            self.point(symbol.tip(), look.stroke);
            self.direction(symbol.tip(), (light.position - symbol.tip()).normalize_or(DVec3::NEG_Z), look.stroke);
        }
        let top = self.highest(&lines.concat())?;
        Some(self.projection.project(symbol.tip()).map_or(top, |tip| if tip.y - SYMBOL < top.y { tip } else { top }))
    }

    /// Parallel light: a small sun with arrows away from the light.
    fn parallel(&self, light: &Light, to_light: DVec3, look: &Look) -> Option<Pos2> {
        let anchor = self.point(light.position, look.stroke);
        let axes = frame::rotation_from_deg(light.rotation_deg);
        let side = 7.0 * self.projection.metres_per_point(light.position);
        for (x, y) in [(-1.0, -1.0), (1.0, -1.0), (0.0, 1.2)] {
            let from = light.position + side * (x * axes.x_axis + y * axes.y_axis);
            self.direction(from, -to_light, look.stroke);
        }
        anchor
    }

    /// A line of the world, faint where surfaces hide it.
    fn hidden_line(&self, a: DVec3, b: DVec3, stroke: Stroke) {
        let eye = self.projection.camera().eye;
        let at = |i: u32| a.lerp(b, f64::from(i) / f64::from(TESTS));
        let hidden = |i: u32| self.solids.hide(eye, at(i).midpoint(at(i + 1)));
        let mut from = 0;
        while from < TESTS {
            let faint = hidden(from);
            let to = (from + 1..TESTS).find(|i| hidden(*i) != faint).unwrap_or(TESTS);
            let color = if faint { stroke.color.gamma_multiply(HIDDEN) } else { stroke.color };
            self.straight(at(from), at(to), Stroke::new(stroke.width, color));
            from = to;
        }
    }

    /// An arrow of the usual size.
    fn direction(&self, from: DVec3, direction: DVec3, stroke: Stroke) {
        self.arrow(from, direction, ARROW, stroke);
    }

    /// An arrow of constant size on screen.
    fn arrow(&self, from: DVec3, direction: DVec3, length: f64, stroke: Stroke) {
        let to = from + length * self.projection.metres_per_point(from) * direction;
        let [Some(a), Some(b)] = [from, to].map(|p| self.projection.project(p)) else { return };
        if a.distance(b) < 6.0 {
            return;
        }
        let stroke = Stroke::new(1.5, stroke.color);
        let along = (b - a).normalized();
        self.painter.line_segment([a, b - 6.0 * along], stroke);
        let across = 3.5 * along.rot90();
        let head = vec![b, b - 8.0 * along + across, b - 8.0 * along - across];
        self.painter.add(egui::Shape::convex_polygon(head, stroke.color, Stroke::NONE));
    }

    /// The sphere's silhouette, which is a circle in the plane of the points where view rays touch it; its equator and two
    /// meridians.
    fn sphere(&self, sphere: &SphereEmitter, stroke: Stroke) -> Option<Pos2> {
        let to_eye = self.projection.camera().eye - sphere.center;
        let distance = to_eye.length();
        if distance <= sphere.radius {
            return None;
        }
        let toward = to_eye / distance;
        let cos = sphere.radius / distance;
        let radius = sphere.radius * ((1.0 - cos) * (1.0 + cos)).sqrt();
        let (u, v) = toward.any_orthonormal_pair();
        let rim = circle(sphere.center + sphere.radius * cos * toward, radius, [u, v]);
        let within = Stroke::new(1.0, stroke.color.gamma_multiply(WITHIN));
        for axes in [[DVec3::X, DVec3::Y], [DVec3::Y, DVec3::Z], [DVec3::Z, DVec3::X]] {
            self.rim(&circle(sphere.center, sphere.radius, axes), within);
        }
        self.rim(&rim, stroke);
        self.highest(&rim)
    }

    /// A closed line, faint where surfaces hide it.
    fn rim(&self, points: &[DVec3], stroke: Stroke) {
        let eye = self.projection.camera().eye;
        for [a, b] in closed(points) {
            let faint = self.solids.hide(eye, a.midpoint(b));
            let color = if faint { stroke.color.gamma_multiply(HIDDEN) } else { stroke.color };
            self.straight(a, b, Stroke::new(stroke.width, color));
        }
    }

    /// A straight line of the world, with a dark edge where the picture may be white.
    fn straight(&self, a: DVec3, b: DVec3, stroke: Stroke) {
        if self.on_bright {
            let edge = Color32::BLACK.gamma_multiply(EDGE * f32::from(stroke.color.a()) / 255.0);
            line(a, b, Stroke::new(stroke.width + 2.0, edge), self.projection, self.painter);
        }
        line(a, b, stroke, self.projection, self.painter);
    }

    /// A small sun.
    fn point(&self, position: DVec3, stroke: Stroke) -> Option<Pos2> {
        let at = self.projection.project(position)?;
        self.painter.circle_filled(at, 4.0, stroke.color);
        for ray in 0_u8..8 {
            let direction = egui::Vec2::angled(f32::from(ray) * std::f32::consts::FRAC_PI_4);
            self.painter.line_segment([at + 6.5 * direction, at + (SYMBOL - 1.5) * direction], stroke);
        }
        Some(at - vec2(0.0, SYMBOL))
    }

    /// Measured intensities, as curves in the planes C = 0 and 90 about the point, of one size on screen.
    fn web(&self, point: &PointEmitter, stroke: Stroke) {
        const SIZE: f64 = 64.0;
        const STEPS: u32 = 72;
        let Some(web) = &point.web else { return };
        let size = SIZE * self.projection.metres_per_point(point.position);
        let axes = web.light_from_world.transpose();
        let thin = Stroke::new(1.0, stroke.color.gamma_multiply(0.7));
        for side in [axes.x_axis, axes.y_axis] {
            let place = |i: u32| {
                let (sine, cosine) = (std::f64::consts::TAU * f64::from(i) / f64::from(STEPS)).sin_cos();
                let direction = sine * side - cosine * axes.z_axis;
                point.position + size * point.intensity(direction) * direction
            };
            for i in 0..STEPS {
                line(place(i), place(i + 1), thin, self.projection, self.painter);
            }
        }
    }

    /// The point that is highest on screen.
    fn highest(&self, points: &[DVec3]) -> Option<Pos2> {
        points.iter().filter_map(|p| self.projection.project(*p)).min_by(|a, b| a.y.total_cmp(&b.y))
    }
}

/// A circle in the plane of two axes.
fn circle(center: DVec3, radius: f64, [u, v]: [DVec3; 2]) -> Vec<DVec3> {
    let at = |i: u32| {
        let (sin, cos) = (std::f64::consts::TAU * f64::from(i) / f64::from(CIRCLE)).sin_cos();
        center + radius * (cos * u + sin * v)
    };
    (0..CIRCLE).map(at).collect()
}
