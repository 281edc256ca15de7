//! Outlines of letters and digits, from the font that the editor is written in.
//!
//! A light is one simple polygon, so a letter with a hole, such as an O, is cut open by a narrow slit from the hole down.

use std::cmp::Ordering;

use epaint_default_fonts::UBUNTU_LIGHT;
use glam::DVec2;
use skrifa::instance::{LocationRef, Size};
use skrifa::outline::{DrawSettings, OutlinePen};
use skrifa::{FontRef, MetadataProvider};

use crate::light::Polygon;

/// Curves are cut into chords no further off than this share of a letter's height.
const FLATNESS: f64 = 0.004;
/// Width of the slit that opens a hole, as a share of the letter's height.
const SLIT: f64 = 0.004;

/// The outline of a letter of that height about a centre, counter-clockwise; or why there is none.
pub fn outline(letter: char, center: DVec2, height: f64) -> Result<Vec<DVec2>, String> {
    let contours =
        contours(letter).ok_or_else(|| format!("The font has no “{letter}”: take another letter or a digit"))?;
    let (holes, outer): (Vec<_>, Vec<_>) = contours.into_iter().partition(|contour| area(contour) < 0.0);
    let [outline] = outer.try_into().map_err(|outer: Vec<_>| match outer.len() {
        0 => format!("“{letter}” has no outline: take another letter or a digit"),
        n => format!("“{letter}” is {n} pieces, and a light is one: take another letter or a digit"),
    })?;
    let slit = SLIT * bounds_height(&outline);
    let opened = opened(outline, holes, slit).ok_or_else(|| format!("“{letter}” cannot be cut open"))?;
    // A slit may have taken the lowest point away.
    let [min, max] = bounds(&opened);
    let (middle, unit) = (min.midpoint(max), max.y - min.y);
    Ok(opened.into_iter().map(|p| center + height / unit * (p - middle)).collect())
}

/// The contours of a letter in the font's units, holes clockwise and the rest counter-clockwise.
fn contours(letter: char) -> Option<Vec<Vec<DVec2>>> {
    let font = FontRef::new(UBUNTU_LIGHT).ok()?;
    let glyph = font.outline_glyphs().get(font.charmap().map(letter)?)?;
    let height = f64::from(font.metrics(Size::unscaled(), LocationRef::default()).cap_height?);
    let mut pen = Pen { tolerance: FLATNESS * height, contours: Vec::new() };
    glyph.draw(DrawSettings::unhinted(Size::unscaled(), LocationRef::default()), &mut pen).ok()?;
    let contours = pen.contours.into_iter().filter_map(|mut contour| {
        contour.dedup();
        while contour.len() > 1 && contour.first() == contour.last() {
            contour.pop();
        }
        // TrueType's outlines run clockwise about what is filled.
        contour.reverse();
        (contour.len() >= 3).then_some(contour)
    });
    Some(contours.collect())
}

/// Takes a glyph's curves as chords.
struct Pen {
    tolerance: f64,
    contours: Vec<Vec<DVec2>>,
}

impl Pen {
    fn last(&self) -> DVec2 {
        self.contours.last().and_then(|contour| contour.last()).copied().unwrap_or_default()
    }

    fn push(&mut self, p: DVec2) {
        if let Some(contour) = self.contours.last_mut() {
            contour.push(p);
        }
    }

    /// As many chords as keep a curve whose second differences are at most `bend` within tolerance: ‖Δ²‖/(8n²) each.
    fn curve(&mut self, bend: f64, at: impl Fn(f64) -> DVec2) {
        let chords = (bend / (8.0 * self.tolerance)).sqrt().ceil().clamp(1.0, 64.0);
        let steps = std::iter::successors(Some(1.0), |i| Some(i + 1.0)).take_while(|i| *i <= chords);
        steps.for_each(|i| self.push(at(i / chords)));
    }
}

fn point(x: f32, y: f32) -> DVec2 {
    DVec2::new(x.into(), y.into())
}

impl OutlinePen for Pen {
    fn move_to(&mut self, x: f32, y: f32) {
        self.contours.push(vec![point(x, y)]);
    }

    fn line_to(&mut self, x: f32, y: f32) {
        self.push(point(x, y));
    }

    fn quad_to(&mut self, cx0: f32, cy0: f32, x: f32, y: f32) {
        let (a, b, c) = (self.last(), point(cx0, cy0), point(x, y));
        self.curve(2.0 * (a - 2.0 * b + c).length(), |t| a.lerp(b, t).lerp(b.lerp(c, t), t));
    }

    fn curve_to(&mut self, cx0: f32, cy0: f32, cx1: f32, cy1: f32, x: f32, y: f32) {
        let (a, b, c, d) = (self.last(), point(cx0, cy0), point(cx1, cy1), point(x, y));
        let bend = 6.0 * (a - 2.0 * b + c).length().max((b - 2.0 * c + d).length());
        let quad = |a: DVec2, b: DVec2, c: DVec2, t: f64| a.lerp(b, t).lerp(b.lerp(c, t), t);
        self.curve(bend, |t| quad(a, b, c, t).lerp(quad(b, c, d, t), t));
    }

    fn close(&mut self) {}
}

/// One outline with its holes opened, the lowest first, so that each finds what lies below it in one piece.
fn opened(mut outline: Vec<DVec2>, mut holes: Vec<Vec<DVec2>>, slit: f64) -> Option<Vec<DVec2>> {
    let bottom = |hole: &[DVec2]| bounds(hole)[0].y;
    holes.sort_by(|a, b| bottom(a).total_cmp(&bottom(b)));
    for hole in holes {
        let [min, max] = bounds(&hole);
        // In the middle, or beside it where the letter has something in the way.
        let places = [0.5, 0.35, 0.65, 0.2, 0.8].map(|share| min.x + share * (max.x - min.x));
        outline = places.into_iter().find_map(|x| joined(&outline, &hole, [x - 0.5 * slit, x + 0.5 * slit]))?;
    }
    Some(outline)
}

/// `outline`, counter-clockwise, and a hole in it, clockwise, joined by an upright slit from the hole's underside down to
/// the outline; `None` where that is no simple polygon.
fn joined(outline: &[DVec2], hole: &[DVec2], [left, right]: [f64; 2]) -> Option<Vec<DVec2>> {
    let lower = |a: &Crossing, b: &Crossing| a.y.total_cmp(&b.y);
    let underside = |x: f64| crossings(hole, x).min_by(lower);
    let below = |x: f64, y: f64| crossings(outline, x).filter(|crossing| crossing.y < y).max_by(lower);
    let (hole_left, hole_right) = (underside(left)?, underside(right)?);
    let (outer_left, outer_right) = (below(left, hole_left.y)?, below(right, hole_right.y)?);
    // Along the outline from right of the slit round to its left, up, round the hole, and down.
    let mut vertices = between(outline, outer_right.edge + 1, outer_left.edge);
    vertices.push(DVec2::new(left, outer_left.y));
    vertices.push(DVec2::new(left, hole_left.y));
    vertices.extend(between(hole, hole_left.edge + 1, hole_right.edge));
    vertices.push(DVec2::new(right, hole_right.y));
    vertices.push(DVec2::new(right, outer_right.y));
    let polygon = Polygon { vertices, two_sided: false };
    // Nothing but the slit may be lost.
    let material = area(outline) + area(hole);
    let whole = (polygon.signed_area() - material).abs() <= 1.5 * (right - left) * bounds_height(outline);
    (polygon.check().is_ok() && whole).then_some(polygon.vertices)
}

/// Where an upright line crosses a closed polygon: on the edge that begins at vertex `edge`, at height `y`.
#[derive(Clone, Copy, Debug)]
struct Crossing {
    edge: usize,
    y: f64,
}

fn crossings(polygon: &[DVec2], x: f64) -> impl Iterator<Item = Crossing> {
    let next = polygon.iter().cycle().skip(1);
    polygon.iter().zip(next).enumerate().filter_map(move |(edge, (a, b))| {
        let sides = (a.x.partial_cmp(&x)?, b.x.partial_cmp(&x)?);
        // A vertex on the line counts as right of it, so that it is crossed once.
        let left = |side| side == Ordering::Less;
        (left(sides.0) != left(sides.1)).then(|| Crossing { edge, y: a.y + (x - a.x) / (b.x - a.x) * (b.y - a.y) })
    })
}

/// Vertices from the one of index `first` round to the one of index `last`, both taken modulo their number.
fn between(polygon: &[DVec2], first: usize, last: usize) -> Vec<DVec2> {
    let count = polygon.len();
    let first = first % count;
    let steps = (last + count - first) % count;
    polygon.iter().cycle().skip(first).take(steps + 1).copied().collect()
}

fn area(contour: &[DVec2]) -> f64 {
    Polygon { vertices: contour.to_vec(), two_sided: false }.signed_area()
}

fn bounds(contour: &[DVec2]) -> [DVec2; 2] {
    let start = [DVec2::INFINITY, DVec2::NEG_INFINITY];
    contour.iter().fold(start, |[min, max], p| [min.min(*p), max.max(*p)])
}

fn bounds_height(contour: &[DVec2]) -> f64 {
    let [min, max] = bounds(contour);
    max.y - min.y
}

#[cfg(test)]
mod tests {
    use super::*;

    const LETTERS: &str = "ABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789";

    #[test]
    fn every_capital_and_digit_is_one_simple_polygon_of_its_height() {
        for letter in LETTERS.chars() {
            let center = DVec2::new(3.0, -1.0);
            let vertices = outline(letter, center, 2.0).unwrap_or_else(|why| panic!("{why}"));
            let polygon = Polygon { vertices, two_sided: false };
            assert_eq!(polygon.check(), Ok(()), "{letter}");
            assert!(polygon.signed_area() > 0.0, "{letter} runs clockwise");
            assert!(polygon.vertices.len() <= 200, "{letter} has {} vertices", polygon.vertices.len());
            let [min, max] = bounds(&polygon.vertices);
            assert!((max.y - min.y - 2.0).abs() < 1e-9, "{letter} is {} high", max.y - min.y);
            assert!(min.midpoint(max).distance(center) < 1e-9, "{letter} is about {}", min.midpoint(max));
        }
    }

    #[test]
    fn only_the_slit_is_lost_of_a_letter_with_holes() {
        for (letter, holes) in [('O', 1), ('A', 1), ('B', 2), ('8', 2), ('R', 1)] {
            let contours = contours(letter).expect("in the font");
            assert_eq!(contours.iter().filter(|contour| area(contour) < 0.0).count(), holes, "holes of {letter}");
            let whole: f64 = contours.iter().map(|contour| area(contour)).sum();
            let outer = contours.iter().max_by(|a, b| area(a).total_cmp(&area(b))).expect("an outline");
            let opened = area(&outline(letter, DVec2::ZERO, bounds_height(outer)).expect("it can be opened"));
            let lost = 1.0 - opened / whole;
            assert!((0.0..0.01).contains(&lost), "{letter} lost {lost} of its area");
        }
    }

    #[test]
    fn what_the_font_has_not_or_is_in_pieces_is_refused_with_the_reason() {
        for (letter, why) in [('\u{16a0}', "no “"), (' ', "no outline"), ('%', "pieces"), ('i', "2 pieces")] {
            let error = outline(letter, DVec2::ZERO, 1.0).expect_err("no single outline");
            assert!(error.contains(why), "{letter}: {error}");
        }
    }
}
