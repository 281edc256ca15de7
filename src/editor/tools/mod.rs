//! Drawing new lights: what each tool has drawn so far, and what a click, a drag or a key does to it.

pub mod drawing;
pub mod new_light;
pub mod polygon;
pub mod work_plane;

use glam::DVec2;

use self::polygon::{Click, PolygonDraft};
use super::session::Tool;
use crate::light::Light;

/// What is being drawn.
#[derive(Clone, Debug, Default, PartialEq)]
pub enum Draft {
    /// Nothing yet.
    #[default]
    Nothing,
    /// A polygon, by its vertices.
    Polygon(PolygonDraft),
    /// A line, by its first end.
    Line(DVec2),
    /// A sphere, by its centre and the point dragged to.
    Sphere(DVec2, DVec2),
}

/// What an input did to a draft.
#[derive(Clone, Debug, PartialEq)]
pub enum Outcome {
    /// It goes on.
    Drawing,
    /// The input was refused, and why.
    Refused(&'static str),
    /// It is done: the light to add, called after its shape.
    Done(Box<Light>),
}

/// Why an edge is refused.
const CROSSING: &str = "Edges may not cross";
/// Why a polygon is not closed.
const NOT_CLOSED: &str = "A polygon needs three corners and edges that do not cross";

impl Draft {
    /// Whether anything has been drawn.
    pub fn is_empty(&self) -> bool {
        *self == Self::Nothing
    }

    /// A click at `p` on the work plane at `height`; `on_first` when that is on a polygon's first vertex.
    pub fn click(&mut self, tool: Tool, p: DVec2, on_first: bool, height: f64) -> Outcome {
        match (tool, &mut *self) {
            (Tool::Polygon, Self::Polygon(draft)) => match draft.click(p, on_first) {
                Click::Added => Outcome::Drawing,
                Click::Refused => Outcome::Refused(CROSSING),
                Click::Closed(vertices) => self.done(new_light::polygon(&vertices, height)),
            },
            (Tool::Polygon, _) => {
                let mut draft = PolygonDraft::default();
                draft.click(p, false);
                *self = Self::Polygon(draft);
                Outcome::Drawing
            }
            (Tool::Line, Self::Line(start)) => match new_light::line([*start, p], height) {
                Some(light) => self.done(light),
                None => Outcome::Refused("A line needs a length"),
            },
            (Tool::Line, _) => {
                *self = Self::Line(p);
                Outcome::Drawing
            }
            _ => Outcome::Drawing,
        }
    }

    /// The pointer, held down since `pressed`, has been dragged to `p`.
    pub fn drag(&mut self, tool: Tool, pressed: DVec2, p: DVec2) {
        if tool == Tool::Sphere {
            *self = Self::Sphere(pressed, p);
        }
    }

    /// The pointer was released after a drag.
    pub fn release(&mut self, height: f64) -> Outcome {
        let Self::Sphere(center, p) = *self else { return Outcome::Drawing };
        match new_light::sphere(center, height, center.distance(p)) {
            Some(light) => self.done(light),
            None => {
                self.cancel();
                Outcome::Refused("Drag to give the sphere a radius")
            }
        }
    }

    /// Enter, or a double click: close the polygon.
    pub fn finish(&mut self, height: f64) -> Outcome {
        let Self::Polygon(draft) = self else { return Outcome::Drawing };
        match draft.close() {
            Some(vertices) => self.done(new_light::polygon(&vertices, height)),
            None => Outcome::Refused(NOT_CLOSED),
        }
    }

    /// Backspace: take back the last point.
    pub fn take_back(&mut self) {
        let rest = match self {
            Self::Polygon(draft) => draft.take_back() && !draft.vertices().is_empty(),
            _ => false,
        };
        if !rest {
            self.cancel();
        }
    }

    /// Esc: forget what was drawn.
    pub fn cancel(&mut self) {
        *self = Self::Nothing;
    }

    fn done(&mut self, light: Light) -> Outcome {
        self.cancel();
        Outcome::Done(Box::new(light))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::light::Shape;
    use glam::dvec2;

    fn click(draft: &mut Draft, tool: Tool, x: f64, y: f64) -> Outcome {
        draft.click(tool, dvec2(x, y), false, 2.0)
    }

    fn light(outcome: Outcome) -> Light {
        let Outcome::Done(light) = outcome else { panic!("done, not {outcome:?}") };
        *light
    }

    #[test]
    fn a_polygon_is_finished_by_enter_and_the_draft_is_empty_again() {
        let mut draft = Draft::default();
        for (x, y) in [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0)] {
            assert_eq!(click(&mut draft, Tool::Polygon, x, y), Outcome::Drawing, "({x}, {y})");
        }
        let light = light(draft.finish(2.0));
        assert!(matches!(light.shape, Shape::Polygon(ref polygon) if polygon.vertices.len() == 3), "{light:?}");
        assert!(draft.is_empty(), "{draft:?}");
    }

    #[test]
    fn two_corners_do_not_finish() {
        let mut draft = Draft::default();
        click(&mut draft, Tool::Polygon, 0.0, 0.0);
        click(&mut draft, Tool::Polygon, 1.0, 0.0);
        assert_eq!(draft.finish(2.0), Outcome::Refused(NOT_CLOSED), "two corners");
        assert!(!draft.is_empty(), "drawing goes on");
    }

    #[test]
    fn backspace_to_nothing_empties_the_draft() {
        let mut draft = Draft::default();
        click(&mut draft, Tool::Polygon, 0.0, 0.0);
        click(&mut draft, Tool::Polygon, 1.0, 0.0);
        draft.take_back();
        assert!(matches!(&draft, Draft::Polygon(polygon) if polygon.vertices().len() == 1), "{draft:?}");
        draft.take_back();
        assert!(draft.is_empty(), "{draft:?}");
    }

    #[test]
    fn a_line_takes_two_clicks_apart() {
        let mut draft = Draft::default();
        click(&mut draft, Tool::Line, 0.0, 0.0);
        assert!(matches!(click(&mut draft, Tool::Line, 0.0, 0.0), Outcome::Refused(_)), "no length");
        let light = light(click(&mut draft, Tool::Line, 0.0, 2.0));
        assert!(matches!(light.shape, Shape::Line(ref line) if line.length == 2.0), "{light:?}");
    }

    #[test]
    fn a_sphere_takes_a_press_and_a_drag() {
        let mut draft = Draft::default();
        draft.drag(Tool::Sphere, dvec2(1.0, 1.0), dvec2(1.0, 1.4));
        let light = light(draft.release(2.0));
        assert!(matches!(light.shape, Shape::Sphere(ref sphere) if (sphere.radius - 0.4).abs() < 1e-12), "{light:?}");
        draft.drag(Tool::Sphere, dvec2(1.0, 1.0), dvec2(1.0, 1.0));
        assert!(matches!(draft.release(2.0), Outcome::Refused(_)), "no radius");
        assert!(draft.is_empty(), "and nothing is left");
    }
}
