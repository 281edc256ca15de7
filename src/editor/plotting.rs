//! What the plot pane shows: which plot, which curves, how, and what is pinned. The editor's own; not saved.

use std::collections::{BTreeMap, BTreeSet};

use crate::analysis::{Look, Pin};
use crate::light::{Light, Shape};
use crate::scene::{Plot, Scene};

/// See the [module](self).
#[derive(Clone, Debug, Default)]
pub struct PlotState {
    /// Index of the plot in front.
    pub active: usize,
    /// Methods switched off in the legend.
    pub hidden: BTreeSet<String>,
    /// Curves kept to compare later states with.
    pub pins: Vec<Pinned>,
    /// The abscissa under the pointer.
    pub cursor: Option<f64>,
    looks: BTreeMap<String, Look>,
}

/// A pinned curve on show.
#[derive(Clone, Debug, PartialEq)]
pub struct Pinned {
    /// The curve.
    pub pin: Pin,
    /// Its place in the order of pens.
    pub pen: usize,
    /// Whether it is switched off.
    pub hidden: bool,
}

impl PlotState {
    /// How a plot is drawn.
    pub fn look(&self, plot: &Plot) -> Look {
        self.looks.get(&plot.name).copied().unwrap_or_else(|| Look::of(plot.kind))
    }

    /// Draw a plot so from now on.
    pub fn set_look(&mut self, plot: &Plot, look: Look) {
        self.looks.insert(plot.name.clone(), look);
    }

    /// Keep a curve, by the first pen that is free.
    pub fn pin(&mut self, pin: Pin) {
        let is_taken = |pen: usize| self.pins.iter().any(|pinned| pinned.pen == pen);
        let pen = (0..=self.pins.len()).find(|pen| !is_taken(*pen)).unwrap_or_default();
        self.pins.push(Pinned { pin, pen, hidden: false });
    }
}

/// What a curve that is pinned now is called: after the light that is selected, or the first that shines.
pub fn pin_name(scene: &Scene, selected: Option<usize>) -> String {
    let light = selected.and_then(|index| scene.lights.get(index));
    let light = light.or_else(|| scene.lights.iter().find(|light| !light.muted));
    light.map_or_else(|| "before".to_owned(), |light| format!("before: {}", described(light)))
}

/// A light and its size.
fn described(light: &Light) -> String {
    let sides = |width: f64, height: f64| format!(" {}×{} m", round(width), round(height));
    let size = match &light.shape {
        Shape::Polygon(polygon) => {
            let start = (glam::DVec2::INFINITY, glam::DVec2::NEG_INFINITY);
            let bounds = |(min, max): (glam::DVec2, glam::DVec2), v: &glam::DVec2| (min.min(*v), max.max(*v));
            let (min, max) = polygon.vertices.iter().fold(start, bounds);
            sides(max.x - min.x, max.y - min.y)
        }
        Shape::Textured(textured) => sides(textured.size.x, textured.size.y),
        Shape::Line(line) => format!(" {} m", round(line.length)),
        Shape::Disk(disk) => format!(" ⌀ {} m", round(2.0 * disk.radius)),
        Shape::Sphere(sphere) => format!(" ⌀ {} m", round(2.0 * sphere.radius)),
        Shape::Cap(cap) => format!(" {}°", round(cap.half_angle_deg)),
        Shape::Sky(_) | Shape::Point(_) | Shape::Directional(_) => String::new(),
    };
    format!("{}{size}", light.name)
}

/// A size to the centimetre.
fn round(value: f64) -> f64 {
    (100.0 * value).round() / 100.0
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::light::{Point, Sphere};

    fn pin(name: &str) -> Pin {
        Pin { name: name.to_owned(), labels: Default::default(), x: Vec::new(), y: Vec::new() }
    }

    #[test]
    fn a_pin_keeps_its_pen_when_others_go_and_a_free_one_is_used_again() {
        let mut state = PlotState::default();
        for name in ["a", "b", "c"] {
            state.pin(pin(name));
        }
        state.pins.remove(1);
        state.pin(pin("d"));
        let pens: Vec<_> = state.pins.iter().map(|pinned| (pinned.pin.name.as_str(), pinned.pen)).collect();
        assert_eq!(pens, [("a", 0), ("c", 2), ("d", 1)], "pens");
    }

    #[test]
    fn a_pin_is_called_after_what_was_there() {
        let globe = Light::new("globe", Shape::Sphere(Sphere { radius: 0.1234 }));
        let lamp = Light { muted: true, ..Light::new("lamp", Shape::Point(Point::default())) };
        let scene = Scene { lights: vec![lamp, globe], ..Scene::default() };
        let names = [None, Some(0), Some(7)].map(|selected| pin_name(&scene, selected));
        assert_eq!(names, ["before: globe ⌀ 0.25 m", "before: lamp", "before: globe ⌀ 0.25 m"], "names");
        assert_eq!(pin_name(&Scene::default(), None), "before", "nothing shines");
    }
}
