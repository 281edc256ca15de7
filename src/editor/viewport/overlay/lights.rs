//! Outlines, symbols, directions and names of lights.

use egui::{Align2, Color32, Painter, Pos2, Stroke, vec2};
use glam::DVec3;

use super::{TEXT, label, line};
use crate::editor::session::{Item, Selection};
use crate::editor::viewport::pick::{SYMBOL, Solids, closed, outline};
use crate::editor::viewport::projection::Projection;
use crate::editor::viewport::symbol::Symbol;
use crate::light::{Emitter, Light, Shape, SphereEmitter};
use crate::math::frame;
use crate::scene::Scene;

/// An outline is tested for being hidden at so many places an edge.
const TESTS: u32 = 24;
/// Opacity of what is hidden by surfaces.
const HIDDEN: f32 = 0.3;
/// Length of the arrow in the direction of emission, points.
const ARROW: f64 = 34.0;
/// Segments of a sphere's outline.
const CIRCLE: u32 = 64;

/// What to say about each light.
struct Look {
    stroke: Stroke,
    named: bool,
    selected: bool,
}

/// Draw every light: selected ones in `accent`, with the direction they emit in; `hovered` a little stronger.
///
/// Names are given to what is selected or hovered, and to all lights when there are few.
pub fn paint_lights(
    scene: &Scene,
    selection: &Selection,
    hovered: Option<Item>,
    accent: Color32,
    solids: &Solids,
    projection: &Projection,
    painter: &Painter,
) {
    let few = scene.lights.len() <= 8;
    for (i, light) in scene.lights.iter().enumerate() {
        let item = Item::Light(i);
        let (selected, hovered) = (selection.contains(item), hovered == Some(item));
        let color = if selected { accent } else { Color32::from_rgb(0xe8, 0xea, 0xee) };
        let color = if light.muted { color.gamma_multiply(0.45) } else { color };
        let stroke = match (selected, hovered) {
            (true, _) => Stroke::new(2.0, color),
            (false, true) => Stroke::new(1.75, color),
            (false, false) => Stroke::new(1.0, color.gamma_multiply(0.6)),
        };
        let look = Look { stroke, named: few || selected || hovered, selected };
        Painted { solids, projection, painter }.light(light, &look);
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
}

impl Painted<'_> {
    fn light(&self, light: &Light, look: &Look) {
        let emitter = light.emitter();
        let anchor = match &emitter {
            Emitter::Polygon(polygon) => self.flat(light, polygon.centroid(), polygon.normal, polygon.two_sided, look),
            Emitter::Disk(disk) => self.flat(light, disk.center, disk.normal, disk.two_sided, look),
            Emitter::Textured(textured) => {
                self.flat(light, textured.point(0.5, 0.5), textured.normal, textured.two_sided, look)
            }
            Emitter::Cap(_) | Emitter::Sky(_) => self.far(light, look),
            Emitter::Line(emitter) => {
                let stroke = Stroke::new(look.stroke.width + 1.0, look.stroke.color);
                self.hidden_line(emitter.a, emitter.b, stroke);
                self.highest(&[emitter.a, emitter.b])
            }
            Emitter::Sphere(sphere) => self.sphere(sphere, look.stroke),
            Emitter::Point(point) => self.point(point.position, look.stroke),
            Emitter::Directional(directional) => self.parallel(light, directional.to_light, look),
        };
        if let Some(at) = anchor.filter(|at| look.named && self.painter.clip_rect().contains(*at)) {
            let color = if look.selected { look.stroke.color } else { TEXT.gamma_multiply(0.85) };
            label(&light.name, at - vec2(0.0, 7.0), Align2::CENTER_BOTTOM, color, self.painter);
        }
    }

    /// A flat light: its outline, and from its middle the directions it emits in when it is selected.
    fn flat(&self, light: &Light, center: DVec3, normal: DVec3, two_sided: bool, look: &Look) -> Option<Pos2> {
        let outline = outline(light)?;
        closed(&outline).for_each(|[a, b]| self.hidden_line(a, b, look.stroke));
        if look.selected {
            self.direction(center, normal, look.stroke);
            if two_sided {
                self.direction(center, -normal, look.stroke);
            }
        }
        self.highest(&outline)
    }

    /// A light that fills directions: a cone of them with a sun at its end, or a dome.
    fn far(&self, light: &Light, look: &Look) -> Option<Pos2> {
        let symbol = Symbol::new(light, self.projection);
        let lines = symbol.lines(&light.shape);
        lines.iter().for_each(|[a, b]| line(*a, *b, look.stroke, self.projection, self.painter));
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
            line(at(from), at(to), Stroke::new(stroke.width, color), self.projection, self.painter);
            from = to;
        }
    }

    /// An arrow of constant size on screen.
    fn direction(&self, from: DVec3, direction: DVec3, stroke: Stroke) {
        let to = from + ARROW * self.projection.metres_per_point(from) * direction;
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

    /// The sphere's silhouette: a circle in the plane of the points where view rays touch it.
    fn sphere(&self, sphere: &SphereEmitter, stroke: Stroke) -> Option<Pos2> {
        let to_eye = self.projection.camera().eye - sphere.center;
        let distance = to_eye.length();
        if distance <= sphere.radius {
            return None;
        }
        let toward = to_eye / distance;
        let cos = sphere.radius / distance;
        let radius = sphere.radius * ((1.0 - cos) * (1.0 + cos)).sqrt();
        let center = sphere.center + sphere.radius * cos * toward;
        let (u, v) = toward.any_orthonormal_pair();
        let at = |i: u32| {
            let (sin, cos) = (std::f64::consts::TAU * f64::from(i) / f64::from(CIRCLE)).sin_cos();
            center + radius * (cos * u + sin * v)
        };
        let rim: Vec<DVec3> = (0..CIRCLE).map(at).collect();
        let eye = self.projection.camera().eye;
        for [a, b] in closed(&rim) {
            let faint = self.solids.hide(eye, a.midpoint(b));
            let color = if faint { stroke.color.gamma_multiply(HIDDEN) } else { stroke.color };
            line(a, b, Stroke::new(stroke.width, color), self.projection, self.painter);
        }
        self.highest(&rim)
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

    /// The point that is highest on screen.
    fn highest(&self, points: &[DVec3]) -> Option<Pos2> {
        points.iter().filter_map(|p| self.projection.project(*p)).min_by(|a, b| a.y.total_cmp(&b.y))
    }
}
