//! Drawing new lights: what each tool has drawn so far, and what a click, a typed dimension or a key does to it.
//!
//! A [`Pen`] says what is drawn and on which plane, a [`Draft`] what has been drawn so far. `drawing.rs` joins them to
//! mouse and keyboard, `options.rs` is the bar of their settings.

pub mod drawing;
pub mod letter;
pub mod new_light;
pub mod options;
pub mod outline;
pub mod polygon;
pub mod snap;
pub mod typed;
pub mod work_plane;

use glam::DVec2;

use self::outline::{Outline, OutlineKind};
use self::polygon::{Click, Fault, PolygonDraft};
use self::typed::Typed;
use self::work_plane::Canvas;
use super::session::Tool;
use crate::light::Light;

/// What is drawn, and where.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pen {
    /// The tool.
    pub tool: Tool,
    /// What the outline tool makes.
    pub outline: Outline,
    /// The plane, and to which side lights shine.
    pub canvas: Canvas,
}

/// What is being drawn.
#[derive(Clone, Debug, Default, PartialEq)]
pub enum Draft {
    /// Nothing yet.
    #[default]
    Nothing,
    /// A polygon, by its vertices.
    Polygon(PolygonDraft),
    /// What takes two points, by the first: a line, a sphere, a rectangle, an outline.
    Span(DVec2),
}

/// What an input did to a draft.
#[derive(Clone, Debug, PartialEq)]
pub enum Outcome {
    /// It goes on.
    Drawing,
    /// The input was refused, and why.
    Refused(String),
    /// It is done: the light to add, called after its shape.
    Done(Box<Light>),
}

impl Pen {
    /// The light that lies between two points, or why there is none.
    pub fn span(&self, from: DVec2, to: DVec2) -> Result<Light, String> {
        let radius = from.distance(to);
        let (light, why) = match self.tool {
            Tool::Line => (new_light::line([from, to], self.canvas), "A line needs a length"),
            Tool::Sphere => (new_light::sphere(from, self.canvas, radius), "A sphere needs a radius: drag further"),
            Tool::Textured => (new_light::textured([from, to], self.canvas), "A rectangle needs two corners apart"),
            Tool::Outline => return self.outlined(from, to),
            _ => (None, "This tool draws nothing"),
        };
        light.ok_or_else(|| why.to_owned())
    }

    fn outlined(&self, from: DVec2, to: DVec2) -> Result<Light, String> {
        let vertices = self.outline.vertices(from, to)?;
        let light = match self.outline.kind {
            OutlineKind::Disk => new_light::disk(from, self.canvas, from.distance(to)),
            _ => Some(new_light::polygon(&vertices, self.canvas)),
        };
        let name = self.outline.light_name();
        light.map(|light| Light { name, ..light }).ok_or_else(|| "A disk needs a radius: drag further".to_owned())
    }

    /// Whether what lies between two points is a rectangle between them, not something about the first.
    pub fn is_by_corners(&self) -> bool {
        self.tool == Tool::Textured || self.tool == Tool::Outline && self.outline.kind.is_by_corners()
    }

    fn is_letter(&self) -> bool {
        self.tool == Tool::Outline && self.outline.kind == OutlineKind::Letter
    }
}

impl Draft {
    /// Whether anything has been drawn.
    pub fn is_empty(&self) -> bool {
        *self == Self::Nothing
    }

    /// The point from which the next one is measured.
    pub fn last(&self) -> Option<DVec2> {
        match self {
            Self::Nothing => None,
            Self::Polygon(draft) => draft.vertices().last().copied(),
            Self::Span(from) => Some(*from),
        }
    }

    /// A click at `p`; `on_first` when that is on a polygon's first vertex.
    pub fn click(&mut self, pen: &Pen, p: DVec2, on_first: bool) -> Outcome {
        match (pen.tool, &mut *self) {
            (Tool::Polygon, Self::Polygon(draft)) => match draft.click(p, on_first) {
                Click::Added => Outcome::Drawing,
                Click::Refused(fault) => refused(fault),
                Click::Closed(vertices) => self.done(new_light::polygon(&vertices, pen.canvas)),
            },
            (Tool::Polygon, _) => {
                let mut draft = PolygonDraft::default();
                draft.click(p, false);
                *self = Self::Polygon(draft);
                Outcome::Drawing
            }
            (_, Self::Span(from)) => match pen.span(*from, p) {
                Ok(light) => self.done(light),
                Err(why) => Outcome::Refused(why),
            },
            (tool, _) => {
                if tool.draws() {
                    *self = Self::Span(p);
                }
                Outcome::Drawing
            }
        }
    }

    /// Enter, or a double click: close the polygon.
    pub fn finish(&mut self, pen: &Pen) -> Outcome {
        let Self::Polygon(draft) = self else { return Outcome::Drawing };
        match draft.close() {
            Ok(vertices) => self.done(new_light::polygon(&vertices, pen.canvas)),
            Err(fault) => refused(fault),
        }
    }

    /// Where a typed dimension puts the next point, when `toward` is pointed to; or why nowhere.
    pub fn typed(&self, pen: &Pen, text: &str, toward: DVec2) -> Result<DVec2, String> {
        let by_corners = pen.is_by_corners();
        let example = if by_corners { "1.2x0.8" } else { "1.5 or 1.5<30" };
        let wrong = || format!("“{text}” is no dimension: type such as {example}");
        let from = self.last().ok_or_else(wrong)?;
        let along = toward - from;
        let size = |width: f64, height: f64| from + DVec2::new(width.copysign(along.x), height.copysign(along.y));
        match Typed::parse(text).ok_or_else(wrong)? {
            Typed::Size(width, height) if by_corners => Ok(size(width, height)),
            Typed::Length(side) if by_corners => Ok(size(side, side)),
            // A letter is measured by its height, and drawn from its centre.
            Typed::Length(height) if pen.is_letter() => {
                Ok(from + 0.5 * height * along.try_normalize().unwrap_or(DVec2::X))
            }
            Typed::Length(length) => Ok(from + length * along.try_normalize().unwrap_or(DVec2::X)),
            Typed::Polar(length, angle_deg) if !by_corners => Ok(from + length * snap::direction(angle_deg)),
            _ => Err(wrong()),
        }
    }

    /// Backspace: take back the last point.
    pub fn take_back(&mut self) {
        let rest = match self {
            Self::Polygon(draft) => draft.take_back() && !draft.vertices().is_empty(),
            Self::Nothing | Self::Span(_) => false,
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

fn refused(fault: Fault) -> Outcome {
    Outcome::Refused(fault.to_string())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::light::Shape;
    use glam::dvec2;

    fn pen(tool: Tool) -> Pen {
        Pen { tool, outline: Outline::default(), canvas: 2.0.into() }
    }

    fn click(draft: &mut Draft, tool: Tool, x: f64, y: f64) -> Outcome {
        draft.click(&pen(tool), dvec2(x, y), false)
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
        let light = light(draft.finish(&pen(Tool::Polygon)));
        assert!(matches!(light.shape, Shape::Polygon(ref polygon) if polygon.vertices.len() == 3), "{light:?}");
        assert!(draft.is_empty(), "{draft:?}");
    }

    #[test]
    fn two_corners_do_not_finish_and_backspace_to_nothing_empties_the_draft() {
        let mut draft = Draft::default();
        click(&mut draft, Tool::Polygon, 0.0, 0.0);
        click(&mut draft, Tool::Polygon, 1.0, 0.0);
        assert!(matches!(draft.finish(&pen(Tool::Polygon)), Outcome::Refused(_)), "two corners");
        draft.take_back();
        assert!(matches!(&draft, Draft::Polygon(polygon) if polygon.vertices().len() == 1), "{draft:?}");
        draft.take_back();
        assert!(draft.is_empty(), "{draft:?}");
    }

    #[test]
    fn what_takes_two_points_is_refused_without_size_and_goes_on() {
        for (tool, name) in
            [(Tool::Line, "line"), (Tool::Sphere, "sphere"), (Tool::Textured, "textured"), (Tool::Outline, "rectangle")]
        {
            let mut draft = Draft::default();
            click(&mut draft, tool, 1.0, 1.0);
            assert!(matches!(click(&mut draft, tool, 1.0, 1.0), Outcome::Refused(_)), "{tool:?} without size");
            let light = light(click(&mut draft, tool, 1.5, 1.4));
            assert_eq!(light.name, name, "{tool:?}");
            assert!(draft.is_empty(), "{draft:?}");
        }
    }

    #[test]
    fn typed_dimensions_go_where_is_pointed_to() {
        let from = Draft::Span(dvec2(1.0, 1.0));
        let typed = |tool, text, toward| from.typed(&pen(tool), text, toward);
        assert_eq!(typed(Tool::Line, "2", dvec2(1.0, 0.5)), Ok(dvec2(1.0, -1.0)), "a length");
        assert_eq!(typed(Tool::Line, "2<180", dvec2(1.0, 0.5)), Ok(dvec2(-1.0, 1.0)), "with its direction");
        assert_eq!(typed(Tool::Textured, "2x0.5", dvec2(0.0, 3.0)), Ok(dvec2(-1.0, 1.5)), "width and height");
        assert_eq!(typed(Tool::Outline, "3", dvec2(2.0, 0.0)), Ok(dvec2(4.0, -2.0)), "a square");
        let letter = Outline { kind: OutlineKind::Letter, ..Outline::default() };
        let letter = Pen { outline: letter, ..pen(Tool::Outline) };
        assert_eq!(from.typed(&letter, "3", dvec2(1.0, 2.0)), Ok(dvec2(1.0, 2.5)), "half of a letter’s height");
        for (tool, text) in [(Tool::Line, "2x1"), (Tool::Textured, "2<30"), (Tool::Sphere, "wide")] {
            assert!(typed(tool, text, DVec2::ZERO).is_err(), "{tool:?}: {text}");
        }
    }
}
