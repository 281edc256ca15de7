//! The tools of the painter, and what they leave on a canvas.

use egui::Key;
use egui_material_icons::{MaterialIcon, icons};
use glam::{DAffine2, DVec2};

use crate::light::pattern::paint::fill::{self, Course};
use crate::light::pattern::paint::{Brush, Canvas, Mask, Rgb, Symmetry, ellipse, rectangle};

/// What the mouse does on the canvas.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) enum PaintTool {
    #[default]
    Brush,
    Eraser,
    Fill,
    Line,
    Rectangle,
    Ellipse,
    Gradient,
    Picker,
}

impl PaintTool {
    /// All tools, from top to bottom.
    pub(super) const ALL: [Self; 8] = [
        Self::Brush,
        Self::Eraser,
        Self::Fill,
        Self::Line,
        Self::Rectangle,
        Self::Ellipse,
        Self::Gradient,
        Self::Picker,
    ];

    /// What it is called.
    pub(super) fn name(self) -> &'static str {
        match self {
            Self::Brush => "Paint brush",
            Self::Eraser => "Paint eraser",
            Self::Fill => "Paint fill",
            Self::Line => "Paint line",
            Self::Rectangle => "Paint rectangle",
            Self::Ellipse => "Paint ellipse",
            Self::Gradient => "Paint gradient",
            Self::Picker => "Pick from pattern",
        }
    }

    /// The key that takes it while the pointer is over the pane.
    pub(super) fn key(self) -> Key {
        match self {
            Self::Brush => Key::B,
            Self::Eraser => Key::E,
            Self::Fill => Key::G,
            Self::Line => Key::L,
            Self::Rectangle => Key::R,
            Self::Ellipse => Key::O,
            Self::Gradient => Key::D,
            Self::Picker => Key::I,
        }
    }

    pub(super) fn icon(self) -> MaterialIcon {
        match self {
            Self::Brush => icons::ICON_BRUSH,
            Self::Eraser => icons::ICON_INK_ERASER,
            Self::Fill => icons::ICON_FORMAT_COLOR_FILL,
            Self::Line => icons::ICON_DIAGONAL_LINE,
            Self::Rectangle => icons::ICON_RECTANGLE,
            Self::Ellipse => icons::ICON_CIRCLE,
            Self::Gradient => icons::ICON_GRADIENT,
            Self::Picker => icons::ICON_COLORIZE,
        }
    }

    /// What the mouse would do with it.
    pub(super) fn hint(self) -> &'static str {
        match self {
            Self::Brush => "Drag to paint; Shift+click draws straight from the last stroke; Alt+click picks a colour",
            Self::Eraser => "Drag to erase to black; Shift+click erases straight from the last stroke",
            Self::Fill => "Click to fill what is alike and hangs together",
            Self::Line => "Drag from end to end; Shift keeps to 45°; Esc cancels",
            Self::Rectangle => "Drag from corner to corner; Shift makes a square; Esc cancels",
            Self::Ellipse => "Drag from corner to corner; Shift makes a circle; Esc cancels",
            Self::Gradient => "Drag from where the first colour is to where the second is; Esc cancels",
            Self::Picker => "Click to take the value and colour from the pattern",
        }
    }

    /// Label of its undo step.
    pub(super) fn step(self) -> &'static str {
        match self {
            Self::Brush | Self::Picker => "Brush stroke",
            Self::Eraser => "Erase",
            Self::Fill => "Fill",
            Self::Line => "Paint line",
            Self::Rectangle => "Paint rectangle",
            Self::Ellipse => "Paint ellipse",
            Self::Gradient => "Paint gradient",
        }
    }

    /// Whether it follows the mouse instead of spanning from press to release.
    pub(super) fn is_freehand(self) -> bool {
        matches!(self, Self::Brush | Self::Eraser)
    }
}

/// How often around the middle, and how.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) enum Mirrors {
    #[default]
    Off,
    X,
    Y,
    Both,
    Radial,
}

impl Mirrors {
    pub(super) const ALL: [Self; 5] = [Self::Off, Self::X, Self::Y, Self::Both, Self::Radial];

    pub(super) fn name(self) -> &'static str {
        match self {
            Self::Off => "off",
            Self::X => "left–right",
            Self::Y => "top–bottom",
            Self::Both => "both",
            Self::Radial => "radial",
        }
    }
}

/// A colour to paint with: a value, and a tint whose greatest component is 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Ink {
    pub(super) value: f32,
    pub(super) tint: Rgb,
}

impl Ink {
    pub(super) fn rgb(self) -> Rgb {
        self.tint.map(|component| component * self.value)
    }

    pub(super) fn of(rgb: Rgb) -> Self {
        let value = rgb.iter().copied().fold(0.0, f32::max);
        if value > 0.0 {
            Self { value, tint: rgb.map(|component| component / value) }
        } else {
            Self { value, tint: [1.0; 3] }
        }
    }
}

/// What is chosen for the tools.
#[derive(Clone, Debug)]
pub(super) struct Options {
    pub(super) tool: PaintTool,
    pub(super) brush: Brush,
    pub(super) opacity: f32,
    pub(super) ink: Ink,
    /// At a gradient's other end.
    pub(super) second: Ink,
    /// Shapes are filled, not outlined.
    pub(super) filled: bool,
    pub(super) tolerance: f32,
    pub(super) course: Course,
    pub(super) mirrors: Mirrors,
    /// Copies of radial symmetry.
    pub(super) copies: u32,
}

impl Default for Options {
    fn default() -> Self {
        Self {
            tool: PaintTool::default(),
            brush: Brush::new(24.0, 0.7),
            opacity: 1.0,
            ink: Ink { value: 1.0, tint: [1.0; 3] },
            second: Ink { value: 0.0, tint: [1.0; 3] },
            filled: true,
            tolerance: 0.05,
            course: Course::Linear,
            mirrors: Mirrors::Off,
            copies: 6,
        }
    }
}

impl Options {
    pub(super) fn symmetry(&self) -> Symmetry {
        match self.mirrors {
            Mirrors::Off => Symmetry::Off,
            Mirrors::X => Symmetry::X,
            Mirrors::Y => Symmetry::Y,
            Mirrors::Both => Symmetry::Both,
            Mirrors::Radial => Symmetry::Radial(self.copies),
        }
    }

    /// What the tool paints with.
    pub(super) fn paint(&self) -> Rgb {
        if self.tool == PaintTool::Eraser { [0.0; 3] } else { self.ink.rgb() }
    }

    /// The canvas after a tool that spans from press to release, or fills at a click.
    pub(super) fn spanned(&self, base: &Canvas, from: DVec2, to: DVec2) -> Canvas {
        let mut mask = Mask::new(base.size());
        let maps = self.symmetry().maps(base.size());
        match self.tool {
            PaintTool::Line => self.outline(&mut mask, &maps, &[from, to]),
            PaintTool::Rectangle => self.shape(&mut mask, &maps, rectangle(from, to)),
            PaintTool::Ellipse => self.shape(&mut mask, &maps, ellipse(from, to)),
            PaintTool::Fill => {
                for map in &maps {
                    if let Some((column, row)) = texel_at(map.transform_point2(from)) {
                        mask.add_texels(fill::alike(base, column, row, self.tolerance));
                    }
                }
            }
            PaintTool::Gradient if from == to => return base.clone(),
            PaintTool::Gradient => {
                let colors = [self.ink.rgb(), self.second.rgb()];
                return base.painted(&Mask::whole(base.size()), self.opacity, |column, row| {
                    let center = DVec2::new(column as f64 + 0.5, row as f64 + 0.5);
                    fill::gradient(self.course, [from, to], colors, center)
                });
            }
            PaintTool::Brush | PaintTool::Eraser | PaintTool::Picker => {}
        }
        let paint = self.paint();
        base.painted(&mask, self.opacity, |_, _| paint)
    }

    fn shape(&self, mask: &mut Mask, maps: &[DAffine2], mut vertices: Vec<DVec2>) {
        if self.filled {
            for map in maps {
                let image: Vec<DVec2> = vertices.iter().map(|vertex| map.transform_point2(*vertex)).collect();
                mask.add_convex(&image);
            }
        } else {
            vertices.extend(vertices.first().copied());
            self.outline(mask, maps, &vertices);
        }
    }

    fn outline(&self, mask: &mut Mask, maps: &[DAffine2], vertices: &[DVec2]) {
        for map in maps {
            for ends in vertices.windows(2) {
                mask.add_segment(&self.brush, map.transform_point2(ends[0]), map.transform_point2(ends[1]));
            }
        }
    }

    /// Where a span ends that keeps to 45°, or to a square.
    pub(super) fn constrained(&self, from: DVec2, to: DVec2) -> DVec2 {
        let way = to - from;
        match self.tool {
            PaintTool::Rectangle | PaintTool::Ellipse => from + way.abs().max_element() * way.signum(),
            _ => {
                let eighth = std::f64::consts::FRAC_PI_4;
                let angle = (way.to_angle() / eighth).round() * eighth;
                from + way.length() * DVec2::from_angle(angle)
            }
        }
    }
}

/// Column and row of the texel at a point; none left of or above the picture.
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "whole numbers that are not negative")]
pub(super) fn texel_at(point: DVec2) -> Option<(usize, usize)> {
    (point.min_element() >= 0.0).then_some((point.x as usize, point.y as usize))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn spans_keep_to_what_shift_asks_for() {
        let options = |tool| Options { tool, ..Options::default() };
        let from = DVec2::new(10.0, 10.0);
        let square = options(PaintTool::Rectangle).constrained(from, DVec2::new(30.0, 2.0));
        assert_eq!(square, DVec2::new(30.0, -10.0), "a square's corner");
        let line = options(PaintTool::Line).constrained(from, DVec2::new(30.0, 11.0));
        assert!((line.y - 10.0).abs() < 1e-12 && line.x > 29.0, "level: {line}");
    }

    #[test]
    fn an_outline_leaves_the_inside_and_a_filled_shape_does_not() {
        let base = Canvas::filled([40, 40], [0.0; 3]);
        for (filled, inside) in [(true, 1.0), (false, 0.0)] {
            let options =
                Options { tool: PaintTool::Ellipse, filled, brush: Brush::new(3.0, 1.0), ..Options::default() };
            let canvas = options.spanned(&base, DVec2::new(5.0, 5.0), DVec2::new(35.0, 35.0));
            assert_eq!(canvas.get(20, 20), Some([inside; 3]), "the middle, filled: {filled}");
            assert!(canvas.get(5, 20).is_some_and(|[r, ..]| r > 0.4), "the rim");
        }
    }

    #[test]
    fn an_ink_is_taken_from_a_texel_and_gives_it_back() {
        let rgb = [0.5, 0.25, 0.125];
        assert_eq!(Ink::of(rgb), Ink { value: 0.5, tint: [1.0, 0.5, 0.25] }, "value and tint");
        assert_eq!((Ink::of(rgb).rgb(), Ink::of([0.0; 3]).rgb()), (rgb, [0.0; 3]), "and back");
    }
}
