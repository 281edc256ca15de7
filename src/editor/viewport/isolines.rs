//! The numbers on isolines: where on the picture each line is labelled with its lux.
//!
//! The lines themselves are drawn with the picture. Here its survey, a coarse grid of the same numbers, says where they
//! are: to a tenth of a cell, which a label hides. The labels lie along one ray from the brightest place, so that they
//! read like a scale and stay where they are while little changes.

use egui::{Align2, FontId, Painter, Pos2, Rect, Vec2, pos2, vec2};

use super::overlay::{PLATE, TEXT};
use super::scales::short;
use crate::gpu::Survey;

/// Where the labels lie from the brightest place: to the lower right, where a floor comes nearer.
const RAY: Vec2 = vec2(0.8, 0.6);
/// Where the illuminance changes so many times as much as before and behind, there is an edge.
const LEAP: f64 = 3.0;
/// A label is at least this far from the picture's edge, points.
const MARGIN: f32 = 8.0;
/// Of a label's plate beside its text, points.
const PADDING: Vec2 = vec2(3.0, 1.0);

/// A place where a line passes, as shares of the picture's sides.
type Place = Pos2;

/// The places where the illuminance passes `level` between two neighbours of the survey's grid, amid one surface.
fn crossings(survey: &Survey, level: f64) -> Vec<Place> {
    let [columns, rows] = Survey::SIDES;
    let mut places = Vec::new();
    for row in 0..rows {
        for column in 0..columns {
            for step in [[1, 0], [0, 1]] {
                if let Some(share) = crossing(survey, level, [column, row], step) {
                    let [right, down] = step.map(|step| share * step as f64);
                    places.push(place(column as f64 + right, row as f64 + down));
                }
            }
        }
    }
    places
}

/// Where between a cell and the next in a direction the illuminance passes `level`; none where it leaps, as from one
/// surface to another.
fn crossing(survey: &Survey, level: f64, [column, row]: [usize; 2], [right, down]: [usize; 2]) -> Option<f64> {
    let at = |steps: usize| {
        // From the cell before on.
        let column = (column + steps * right).checked_sub(right)?;
        survey.illuminance(column, (row + steps * down).checked_sub(down)?)
    };
    let (before, here, there, after) = (at(0)?, at(1)?, at(2)?, at(3)?);
    let leaps = (there - here).abs() > LEAP * (here - before).abs().max((after - there).abs());
    ((here < level) != (there < level) && !leaps).then(|| (level - here) / (there - here))
}

/// A place of the survey's grid as shares of the picture's sides: a number is that of its cell's middle.
#[expect(clippy::cast_possible_truncation, reason = "a place on the screen")]
fn place(column: f64, row: f64) -> Place {
    let [columns, rows] = Survey::SIDES;
    pos2(((column + 0.5) / columns as f64) as f32, ((row + 0.5) / rows as f64) as f32)
}

/// The brightest place of the survey.
fn brightest(survey: &Survey) -> Option<Place> {
    let [columns, rows] = Survey::SIDES;
    let cells = (0..rows).flat_map(|row| (0..columns).map(move |column| (column, row)));
    let lit = cells.filter_map(|(column, row)| Some((column, row, survey.illuminance(column, row)?)));
    let (column, row, _) = lit.max_by(|(.., a), (.., b)| a.total_cmp(b))?;
    Some(place(column as f64, row as f64))
}

/// Write the lux of each level on its line, once: where it is nearest to the ray, covers nothing that is `taken`, to which
/// it is added, and is as far from another label as that is large. A level that has no such place is left out.
pub fn paint(survey: &Survey, levels: &[f64], rect: Rect, taken: &mut Vec<Rect>, painter: &Painter) {
    let Some(start) = brightest(survey) else { return };
    let on_screen = |place: Place| rect.min + rect.size() * place.to_vec2();
    let start = on_screen(start);
    let mut labels: Vec<Rect> = Vec::new();
    for level in levels {
        let text = format!("{} lx", short(*level));
        let galley = painter.layout_no_wrap(text, FontId::proportional(10.5), TEXT);
        let plate = |at: Pos2| Align2::CENTER_CENTER.anchor_size(at, galley.size()).expand2(PADDING);
        let is_free = |at: &Pos2| {
            let plate = plate(*at);
            rect.shrink(MARGIN).contains_rect(plate)
                && taken.iter().all(|other| !other.intersects(plate))
                && labels.iter().all(|other| !other.intersects(plate.expand2(plate.size())))
        };
        let places = crossings(survey, *level).into_iter().map(on_screen).filter(is_free);
        let nearest = places.min_by(|a, b| off_ray(*a - start).total_cmp(&off_ray(*b - start)));
        if let Some(at) = nearest {
            painter.rect_filled(plate(at), 3.0, PLATE);
            taken.push(plate(at));
            labels.push(plate(at));
            painter.galley(plate(at).min + PADDING, galley, TEXT);
        }
    }
}

/// How far a place is from the ray; behind its start, from that.
fn off_ray(from_start: Vec2) -> f32 {
    (from_start - from_start.dot(RAY).max(0.0) * RAY).length()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Illuminance that falls by 10 lx a column from 1000, over surface but in the last columns.
    fn falling() -> Survey {
        Survey::of_illuminance(|column, _| (column < 80).then_some(1000.0 - 10.0 * column as f64))
    }

    #[test]
    fn a_line_is_found_where_the_illuminance_passes_its_level() {
        let places = crossings(&falling(), 695.0);
        assert_eq!(places.len(), Survey::SIDES[1], "one in each row: {places:?}");
        let expected = place(30.5, 0.0).x;
        assert!(places.iter().all(|place| (place.x - expected).abs() < 1e-6), "midway between 700 and 690: {places:?}");
        assert_eq!(crossings(&falling(), 1005.0), [], "brighter than anything");
        assert_eq!(crossings(&falling(), 215.0), [], "none beside what is no surface");
        let edge = Survey::of_illuminance(|column, _| Some(if column < 40 { 100.0 } else { 400.0 } + column as f64));
        assert_eq!(crossings(&edge, 300.0), [], "none where one surface ends before another");
    }

    #[test]
    fn labels_lie_along_the_ray_from_the_brightest_place() {
        assert_eq!(brightest(&falling()).map(|place| place.x), Some(place(0.0, 0.0).x), "in the first column");
        assert!(off_ray(vec2(80.0, 60.0)) < 1e-4, "on the ray");
        assert!((off_ray(vec2(-3.0, -4.0)) - 5.0).abs() < 1e-5, "behind its start");
        assert!((off_ray(vec2(-6.0, 8.0)) - 10.0).abs() < 1e-4, "beside it");
    }
}
