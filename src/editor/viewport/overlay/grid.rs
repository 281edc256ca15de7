//! The grid on the ground, and the one on the work plane while drawing.

use std::ops::RangeInclusive;

use egui::{Color32, Painter, Pos2, Rect, Stroke};
use glam::DVec2;

use crate::editor::handles::AXIS_COLORS;
use crate::editor::tools::work_plane::{Frame, PlaneKind, WorkPlane};
use crate::editor::viewport::pick::Solids;
use crate::editor::viewport::projection::Projection;
use crate::scene::Camera;
use crate::surface::Surface;

/// Grid lines to each side of the middle.
const LINES: i32 = 20;
/// Cells between two tests of whether a line is hidden.
const TESTS_PER_CELL: i32 = 2;
/// Every so many lines one is drawn stronger.
const MAJOR: i32 = 10;
/// Distance from the middle at which the grid starts to fade, as a share of its reach.
const FADE_FROM: f64 = 0.25;

/// A piece of a grid line on screen, with its colour.
type Piece = ([Pos2; 2], Color32);

/// The ground grid as last laid out; laid out again only when camera, pane or surfaces change.
#[derive(Debug, Default)]
pub struct Grid {
    key: Option<(Camera, Rect, Vec<Surface>)>,
    pieces: Vec<Piece>,
}

impl Grid {
    /// Draw the ground grid, where no surface hides it.
    pub fn paint(&mut self, projection: &Projection, solids: &Solids, painter: &Painter) {
        let fits = self.key.as_ref().is_some_and(|(camera, rect, surfaces)| {
            camera == projection.camera() && *rect == projection.rect() && surfaces == solids.source()
        });
        if !fits {
            self.pieces = ground_pieces(projection, solids);
            self.key = Some((*projection.camera(), projection.rect(), solids.source().to_vec()));
        }
        for (segment, color) in &self.pieces {
            painter.line_segment(*segment, Stroke::new(1.0, *color));
        }
    }
}

/// Grid spacing that suits a camera at `distance` from what it looks at: a power of ten of metres.
fn spacing(distance: f64) -> f64 {
    10.0_f64.powf((distance / 5.0).max(1e-3).log10().round())
}

fn ground_pieces(projection: &Projection, solids: &Solids) -> Vec<Piece> {
    let camera = projection.camera();
    let step = spacing(camera.eye.distance(camera.target));
    let middle = (camera.target.truncate() / step).round();
    let reach = f64::from(LINES) * step;
    let mut pieces = Vec::new();
    for along in 0..2 {
        for line in -LINES..=LINES {
            let index = middle[1 - along] + f64::from(line);
            let color = ground_color(along, index);
            let corner = |cell: i32| {
                let mut at = DVec2::ZERO;
                at[along] = (middle[along] + f64::from(cell) / f64::from(TESTS_PER_CELL)) * step;
                at[1 - along] = index * step;
                at.extend(0.0)
            };
            for cell in (-LINES * TESTS_PER_CELL)..(LINES * TESTS_PER_CELL) {
                let (a, b) = (corner(cell), corner(cell + 1));
                let at = a.midpoint(b);
                let fade = fade(at.truncate().distance(middle * step) / reach);
                let Some(segment) = (fade > 0.02).then(|| projection.segment(a, b)).flatten() else { continue };
                if !solids.hide(camera.eye, at) {
                    pieces.push((segment, color.gamma_multiply(fade)));
                }
            }
        }
    }
    pieces
}

/// The world's axes in their colours, the rest in faint white.
fn ground_color(along: usize, index: f64) -> Color32 {
    if index == 0.0 {
        AXIS_COLORS[along].gamma_multiply(0.55)
    } else if index.rem_euclid(f64::from(MAJOR)) == 0.0 {
        Color32::from_white_alpha(40)
    } else {
        Color32::from_white_alpha(20)
    }
}

/// Opacity at a share of the grid's reach.
#[expect(clippy::cast_possible_truncation, reason = "an opacity")]
fn fade(share: f64) -> f32 {
    let linear = ((1.0 - share) / (1.0 - FADE_FROM)).clamp(0.0, 1.0);
    (linear * linear) as f32
}

/// Draw the work plane's grid around `at`, fading, in the colour of its kind.
pub fn paint_work_plane(plane: &WorkPlane, frame: &Frame, at: DVec2, projection: &Projection, painter: &Painter) {
    // Lines closer than 8 points would be a blur: take every second, fifth, tenth, …
    let least = 8.0 * projection.metres_per_point(frame.point(at));
    let step = [1.0, 2.0, 5.0, 10.0, 20.0, 50.0, 100.0].map(|n| n * plane.grid).into_iter().find(|step| *step >= least);
    let Some(step) = step.filter(|step| *step > 0.0) else { return };
    let middle = (at / step).round();
    let color = plane_color(plane.kind);
    let cells: RangeInclusive<i32> = -LINES..=LINES;
    for along in 0..2 {
        for line in cells.clone() {
            let corner = |cell: i32| {
                let mut p = DVec2::ZERO;
                p[along] = (middle[along] + f64::from(cell)) * step;
                p[1 - along] = (middle[1 - along] + f64::from(line)) * step;
                p
            };
            for cell in -LINES..LINES {
                let (a, b) = (corner(cell), corner(cell + 1));
                let fade = fade(a.midpoint(b).distance(at) / (f64::from(LINES) * step));
                let segment = (fade > 0.02).then(|| projection.segment(frame.point(a), frame.point(b))).flatten();
                if let Some(segment) = segment {
                    painter.line_segment(segment, Stroke::new(1.0, color.gamma_multiply(0.28 * fade)));
                }
            }
        }
    }
}

/// The colour of a work plane's grid: that of the axis to which it is perpendicular, where there is one.
fn plane_color(kind: PlaneKind) -> Color32 {
    let light = |axis: usize| AXIS_COLORS[axis].lerp_to_gamma(Color32::WHITE, 0.3);
    match kind {
        PlaneKind::Side => light(0),
        PlaneKind::Front => light(1),
        PlaneKind::Level => light(2),
        PlaneKind::Facing => Color32::from_rgb(0xd9, 0x9b, 0xff),
        PlaneKind::Surface => Color32::from_rgb(0x5f, 0xe3, 0xd0),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::DVec3;

    #[test]
    fn the_grid_is_a_power_of_ten_that_grows_with_distance() {
        assert_eq!(spacing(6.0), 1.0, "a room");
        assert!((spacing(0.6) - 0.1).abs() < 1e-12, "a table: {}", spacing(0.6));
        assert_eq!(spacing(80.0), 10.0, "a yard");
    }

    #[test]
    fn the_grid_fades_to_nothing_at_its_reach() {
        assert_eq!(fade(0.0), 1.0, "in the middle");
        assert_eq!(fade(1.0), 0.0, "at the rim");
        assert!(fade(0.5) > fade(0.8), "in between");
    }

    #[test]
    fn the_ground_under_a_surface_shows_no_grid() {
        let projection = Projection::new(
            &Camera { eye: DVec3::new(0.0, -1.0, 8.0), target: DVec3::ZERO, fov_deg: 40.0 },
            Rect::from_min_size(Pos2::ZERO, egui::vec2(400.0, 300.0)),
        );
        let mut solids = Solids::default();
        let open = ground_pieces(&projection, &solids).len();
        solids.update(&[Surface {
            name: "box".to_owned(),
            material: String::new(),
            position: DVec3::new(0.0, 0.0, 0.5),
            rotation_deg: DVec3::ZERO,
            scale: DVec3::ONE,
            shape: crate::surface::Shape::Box { size: DVec3::new(4.0, 4.0, 1.0) },
        }]);
        let covered = ground_pieces(&projection, &solids).len();
        assert!(0 < covered && covered < open, "{covered} of {open} pieces are seen");
    }
}
