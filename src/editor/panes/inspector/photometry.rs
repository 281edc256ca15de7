//! A photometric file: a polar diagram of its intensities, its name, and another in its place.

use egui::{Pos2, Response, Role, Sense, Stroke, StrokeKind, Ui, WidgetInfo, vec2};

use super::fields::{Fields, row_label};
use crate::analysis::axis::three_digits;
use crate::editor::commands::Command;
use crate::editor::theme;
use crate::light::photometry::{Distribution, Photometry};

/// Of the diagram, points.
const SIZE: egui::Vec2 = vec2(180.0, 150.0);
/// Around the outermost ring, for the numbers.
const MARGIN: f32 = 14.0;
/// Steps of γ along a curve.
const STEPS: u32 = 180;

/// The row of the photometric file of the light of that name.
pub(super) fn row(ui: &mut Ui, fields: &mut Fields<'_>, light: &str, photometry: &Photometry) {
    row_label(ui, "Intensities");
    ui.vertical(|ui| {
        diagram(ui, &photometry.distribution);
        ui.monospace(&photometry.file);
        let Photometry { distribution, .. } = photometry;
        let planes = match distribution.planes().len() {
            1 => "the same all around".to_owned(),
            count => format!("{} planes", count - 1),
        };
        ui.weak(format!("{planes}, {} angles, {} cd", distribution.gammas().len(), three_digits(distribution.peak())));
        ui.horizontal(|ui| {
            let button = |label: &'static str| egui::Button::new(label).min_size(vec2(62.0, 20.0));
            let replace =
                ui.add(button("Replace…")).on_hover_text("Choose another IES file; the light takes its candela");
            if replace.accessible_name("Replace IES file").clicked() {
                fields.commands.push(Command::ReplacePhotometry(light.to_owned()));
            }
            let remove = ui.add(button("Remove")).on_hover_text("Shine the same all around, without an IES file");
            if remove.accessible_name("Remove IES file").clicked() {
                fields.session.remove_photometry(light);
            }
        });
    });
    ui.end_row();
}

/// The planes C = 0 and 180 and, where they differ, 90 and 270, nadir downwards, as shares of the greatest intensity.
fn diagram(ui: &mut Ui, distribution: &Distribution) -> Response {
    let (rect, response) = ui.allocate_exact_size(SIZE, Sense::hover());
    response.widget_info(|| WidgetInfo::labeled(Role::Image, true, "Polar diagram of the intensities"));
    let visuals = ui.visuals();
    let painter = ui.painter_at(rect);
    painter.rect(rect, 2.0, visuals.extreme_bg_color, visuals.widgets.noninteractive.bg_stroke, StrokeKind::Inside);
    let dial = Dial { center: rect.center(), radius: 0.5 * rect.height() - MARGIN };
    let faint = Stroke::new(1.0, visuals.weak_text_color().gamma_multiply(0.35));
    for ring in 1_u8..=4 {
        painter.circle_stroke(dial.center, dial.radius * f32::from(ring) / 4.0, faint);
    }
    for spoke in (0_u16..360).step_by(30) {
        painter.line_segment([dial.center, dial.place(f64::from(spoke), 1.0)], faint);
    }
    let font = egui::FontId::proportional(9.0);
    for (gamma, align) in
        [(0.0, egui::Align2::CENTER_TOP), (90.0, egui::Align2::LEFT_CENTER), (180.0, egui::Align2::CENTER_BOTTOM)]
    {
        let text = format!("{gamma}°");
        painter.text(dial.place(gamma, 1.03), align, text, font.clone(), visuals.weak_text_color());
    }
    if distribution.planes().len() > 1 {
        painter.add(dial.curve(distribution, 90.0, Stroke::new(1.5, visuals.weak_text_color())));
    }
    painter.add(dial.curve(distribution, 0.0, Stroke::new(2.0, theme::accent(visuals))));
    response.on_hover_text(
        "Candela by the angle from nadir, the rings at quarters of the greatest: right C = 0 (the light’s +X), left C = \
         180; grey, where it differs, C = 90 (+Y) and 270",
    )
}

/// A diagram's place: nadir downwards.
struct Dial {
    center: Pos2,
    radius: f32,
}

impl Dial {
    /// Where a share of the greatest intensity is at degrees from nadir, to the right from 0 to 180.
    #[expect(clippy::cast_possible_truncation, reason = "of the screen")]
    fn place(&self, degrees: f64, share: f64) -> Pos2 {
        let (sine, cosine) = degrees.to_radians().sin_cos();
        self.center + self.radius * vec2((share * sine) as f32, (share * cosine) as f32)
    }

    /// The plane C, degrees, and the one across from it.
    fn curve(&self, distribution: &Distribution, c: f64, stroke: Stroke) -> egui::Shape {
        let side = |c: f64, sign: f64| {
            (0..=STEPS).map(move |i| {
                let gamma = 180.0 * f64::from(i) / f64::from(STEPS);
                self.place(sign * gamma, distribution.share_at(c.to_radians(), gamma.to_radians()))
            })
        };
        let mut points: Vec<Pos2> = side(c, 1.0).collect();
        points.extend(side(c + 180.0, -1.0).rev());
        egui::Shape::line(points, stroke)
    }
}

#[cfg(test)]
mod tests {
    use egui::{Color32, Rect, pos2};

    use super::*;

    #[test]
    fn nadir_is_down_and_c_0_to_the_right() {
        let dial = Dial { center: pos2(100.0, 100.0), radius: 50.0 };
        for (degrees, expected) in [(0.0, [100.0, 150.0]), (90.0, [150.0, 100.0]), (-90.0, [50.0, 100.0])] {
            let at = dial.place(degrees, 1.0);
            assert!(at.distance(expected.into()) < 1e-4, "{at:?} at {degrees}, not {expected:?}");
        }
        let even = dial.curve(&Distribution::isotropic(), 0.0, Stroke::new(1.0, Color32::WHITE));
        let bounds = even.visual_bounding_rect();
        let expected = Rect::from_center_size(dial.center, vec2(100.0, 100.0));
        assert!(bounds.expand(0.6).contains_rect(expected), "a circle: {bounds:?}");
    }
}
