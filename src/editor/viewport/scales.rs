//! From numbers to colours: what a viewport's state and its picture's numbers make of the picture, and the bar that
//! says what the colours mean.

use egui::{Align2, Color32, CornerRadius, FontId, Painter, Popup, PopupCloseBehavior, Rect, Sense, Stroke, Ui};
use egui::{WidgetInfo, pos2, vec2};

use super::overlay::PLATE;
use crate::editor::session::{Session, ViewMode, ViewState};
use crate::gpu::{Display, Survey, quantile};
use crate::render::false_colour::{Scale, TOLERANCES, bands, diverging, round_end, sequential};

/// A scale that follows the picture holds this share of its pixels.
const HELD: f64 = 0.99;
/// The darkest pixels, as a share of the brightest, have no say in how far methods differ as a share.
const DARK: f64 = 0.01;
/// Width of the bar's plate, points.
const WIDTH: f32 = 74.0;
/// Of the bar itself.
const BAR: f32 = 12.0;
/// Heights of the bar, points: what lies between suits the pane.
const HEIGHTS: [f32; 2] = [60.0, 190.0];
/// Ticks are at least this far apart, points.
const APART: f32 = 14.0;
/// Pieces that the bar is painted in.
const PIECES: u16 = 48;

/// What the picture shows.
pub fn display(view: &ViewState, survey: &Survey) -> Display {
    let against = if view.against_variant.is_some() { view.method } else { view.against };
    match view.mode {
        ViewMode::Picture => Display::Picture,
        ViewMode::Split => Display::Split { against, at: view.split },
        ViewMode::Difference => {
            Display::Difference { against, relative: view.relative, end: difference_end(view, survey) }
        }
        ViewMode::Illuminance => {
            Display::Illuminance { scale: illuminance_scale(view, survey), isolines: view.isolines }
        }
        ViewMode::Bands => Display::Bands { against, illuminance: view.bands_of_illuminance },
    }
}

/// Whether something that is shown follows the picture's numbers: the scale, or what is written on isolines.
pub fn follows_picture(view: &ViewState) -> bool {
    match view.mode {
        ViewMode::Difference => view.difference_ends[usize::from(view.relative)].is_none(),
        ViewMode::Illuminance => view.illuminance_end.is_none() || view.isolines,
        ViewMode::Picture | ViewMode::Split | ViewMode::Bands => false,
    }
}

fn difference_end(view: &ViewState, survey: &Survey) -> f64 {
    let fixed = view.difference_ends[usize::from(view.relative)];
    fixed.unwrap_or_else(|| {
        let pairs = || survey.compared_luminances();
        let dark = DARK * pairs().map(|[_, other]| other).fold(0.0, f64::max);
        let differences = pairs().filter_map(|[mine, other]| match view.relative {
            true => (other > dark).then(|| (mine - other).abs() / other),
            false => Some((mine - other).abs()),
        });
        round_end(quantile(differences, HELD).unwrap_or_default())
    })
}

fn illuminance_scale(view: &ViewState, survey: &Survey) -> Scale {
    let found = || round_end(quantile(survey.illuminances(), HELD).unwrap_or_default());
    Scale { end: view.illuminance_end.unwrap_or_else(found), logarithmic: view.logarithmic }
}

/// The exposure at which all but the brightest hundredth of the picture stays below the tone curve's shoulder; none in
/// the dark.
pub fn auto_exposure(survey: &Survey) -> Option<f64> {
    let bright = quantile(survey.luminances(), HELD).filter(|luminance| *luminance > 0.0)?;
    Some((10.0 * (0.8 * WHITE / bright).log2()).round() / 10.0)
}

/// Luminance that is white at exposure 0, cd/m².
pub const WHITE: f64 = 100.0;

/// The bar at the right of a viewport, where what is shown has one and there is room; a click on it sets the scale. What
/// it covers.
pub fn show(ui: &mut Ui, rect: Rect, session: &mut Session, display: &Display, name: &str) -> Option<Rect> {
    let room = rect.height() - 60.0;
    if room < HEIGHTS[0] + 40.0 || rect.width() < 2.5 * WIDTH {
        return None;
    }
    let rows = if session.view.mode == ViewMode::Bands { 84.0 } else { (room - 40.0).min(HEIGHTS[1]) + 30.0 };
    let plate = Rect::from_min_size(pos2(rect.right() - WIDTH - 8.0, rect.top() + 40.0), vec2(WIDTH, rows));
    let bar = Bar::new(&session.view, display)?;
    let response =
        ui.interact(plate, ui.scope_id().with("scale"), Sense::click()).on_hover_text("Click to set the scale");
    response.widget_info(|| WidgetInfo::labeled(egui::Role::Button, true, format!("Scale{name}: {}", bar.told)));
    let painter = ui.painter_at(rect);
    let fill = if response.hovered() { Color32::from_black_alpha(210) } else { PLATE };
    painter.rect_filled(plate, 4.0, fill);
    bar.paint(plate, &painter);
    Popup::menu(&response).close_behavior(PopupCloseBehavior::CloseOnClickOutside).show(|ui| {
        ui.set_min_width(190.0);
        settings(ui, session, display);
    });
    Some(plate)
}

/// The settings of what is shown: unit, end and kind of scale.
pub fn settings(ui: &mut Ui, session: &mut Session, display: &Display) {
    let view = &mut session.view;
    match *display {
        Display::Difference { end, .. } => {
            ui.horizontal(|ui| {
                ui.radio_value(&mut view.relative, false, "cd/m²").on_hover_text("Difference of luminance");
                ui.radio_value(&mut view.relative, true, "%").on_hover_text("As a share of the second method");
            });
            let percent = if view.relative { 100.0 } else { 1.0 };
            let suffix = if view.relative { " %" } else { " cd/m²" };
            end_of_scale(ui, view.difference_end(), end, percent, suffix);
        }
        Display::Illuminance { scale, .. } => {
            end_of_scale(ui, &mut view.illuminance_end, scale.end, 1.0, " lx");
            ui.checkbox(&mut view.logarithmic, "Logarithmic").on_hover_text("Three decades up to the end");
            ui.checkbox(&mut view.isolines, "Isolines").on_hover_text("Lines at the values beside the bar");
        }
        Display::Bands { .. } => {
            ui.radio_value(&mut view.bands_of_illuminance, true, "Illuminance")
                .on_hover_text("What reaches a surface, whatever its material");
            ui.radio_value(&mut view.bands_of_illuminance, false, "Luminance")
                .on_hover_text("What is seen, highlights and all");
        }
        Display::Picture | Display::Split { .. } => {}
    }
}

/// Where a scale ends: as the picture has it, or a number.
fn end_of_scale(ui: &mut Ui, end: &mut Option<f64>, now: f64, factor: f64, suffix: &str) {
    let mut auto = end.is_none();
    if ui.checkbox(&mut auto, "Auto scale").on_hover_text("99 % of the picture are on the scale").changed() {
        *end = (!auto).then_some(now);
    }
    ui.horizontal(|ui| {
        let label = ui.label("Scale end");
        let mut number = factor * now;
        let drag = egui::DragValue::new(&mut number)
            .range(1e-6..=1e9)
            .speed(0.01 * factor * now)
            .suffix(suffix)
            .max_decimals(4);
        if ui.add(drag).labelled_by(label.id).on_hover_text("Where the colours end").changed() {
            *end = Some(number / factor);
        }
    });
}

/// What the bar says.
struct Bar {
    title: &'static str,
    kind: Kind,
    /// Places from the bottom, and texts.
    ticks: Vec<(f64, String)>,
    /// In words.
    told: String,
}

enum Kind {
    /// From −1 or 0 at the bottom to 1.
    Continuous(fn(f64) -> [u8; 3], f64),
    Bands,
}

impl Bar {
    fn new(view: &ViewState, display: &Display) -> Option<Self> {
        Some(match *display {
            Display::Picture | Display::Split { .. } => return None,
            Display::Difference { relative, end, .. } => {
                let (title, factor) = if relative { ("%", 100.0) } else { ("cd/m²", 1.0) };
                let shares = [-1.0, -0.5, 0.0, 0.5, 1.0];
                let sign = |share: f64| if share > 0.0 { "+" } else { "" };
                let text = |share: f64| format!("{}{}", sign(share), short(share * factor * end));
                Self {
                    title,
                    kind: Kind::Continuous(diverging, -1.0),
                    ticks: shares.iter().map(|share| (0.5 + 0.5 * share, text(*share))).collect(),
                    told: match view.against_variant {
                        Some(_) => format!("lights − variant, ±{} {title}", short(factor * end)),
                        None => format!("{} − {}, ±{} {title}", view.method, view.against, short(factor * end)),
                    },
                }
            }
            Display::Illuminance { scale, .. } => {
                let mut ticks: Vec<_> =
                    scale.levels().into_iter().map(|level| (scale.share(level), short(level))).collect();
                if !scale.logarithmic {
                    ticks.insert(0, (0.0, "0".to_owned()));
                }
                Self {
                    title: "lx",
                    kind: Kind::Continuous(sequential, 0.0),
                    ticks,
                    told: format!("to {} lx", short(scale.end)),
                }
            }
            Display::Bands { illuminance, .. } => {
                let within = TOLERANCES.iter().rev().map(|share| format!("≤ {} %", short(100.0 * share)));
                let texts = std::iter::once("beyond".to_owned()).chain(within);
                Self {
                    title: if illuminance { "E" } else { "L" },
                    kind: Kind::Bands,
                    ticks: (0_u8..).map(f64::from).zip(texts).collect(),
                    told: format!("{} within 1, 5, 10 % of {}", view.method, view.against),
                }
            }
        })
    }

    fn paint(&self, plate: Rect, painter: &Painter) {
        let font = FontId::proportional(11.0);
        painter.text(plate.min + vec2(8.0, 4.0), Align2::LEFT_TOP, self.title, font.clone(), TEXT);
        let inner = Rect::from_min_max(plate.min + vec2(8.0, 22.0), plate.max - vec2(8.0, 8.0));
        let text = |y: f32, text: &str| {
            painter.text(pos2(inner.left() + BAR + 6.0, y), Align2::LEFT_CENTER, text, font.clone(), TEXT);
        };
        match self.kind {
            Kind::Bands => {
                for ((row, name), color) in self.ticks.iter().zip(bands().into_iter().rev()) {
                    let top = inner.bottom() - points(row + 1.0) * APART;
                    let swatch = Rect::from_min_size(pos2(inner.left(), top), vec2(BAR, APART - 2.0));
                    painter.rect_filled(swatch, CornerRadius::same(2), rgb(color));
                    text(swatch.center().y, name);
                }
            }
            Kind::Continuous(color, least) => {
                let bar = inner.with_max_x(inner.left() + BAR);
                let at = |share: f64| bar.bottom() - points(share) * bar.height();
                for piece in 0..PIECES {
                    let share = |i: u16| f64::from(i) / f64::from(PIECES);
                    let middle = (f64::from(piece) + 0.5) / f64::from(PIECES);
                    let [top, bottom] = [at(share(piece + 1)), at(share(piece))];
                    let rect = Rect::from_min_max(pos2(bar.left(), top), pos2(bar.right(), bottom + 0.5));
                    painter.rect_filled(rect, 0.0, rgb(color(least + (1.0 - least) * middle)));
                }
                let mut last = f32::MAX;
                for (share, name) in &self.ticks {
                    let y = at(*share);
                    painter.line_segment([pos2(bar.right(), y), pos2(bar.right() + 3.0, y)], Stroke::new(1.0, TEXT));
                    if last - y >= APART {
                        text(y, name);
                        last = y;
                    }
                }
            }
        }
    }
}

const TEXT: Color32 = Color32::from_rgb(0xe6, 0xe9, 0xec);

fn rgb([r, g, b]: [u8; 3]) -> Color32 {
    Color32::from_rgb(r, g, b)
}

#[expect(clippy::cast_possible_truncation, reason = "egui's screen coordinates are f32")]
fn points(x: f64) -> f32 {
    x as f32
}

/// A number with three digits or so.
pub fn short(value: f64) -> String {
    let size = value.abs();
    if size > 0.0 && !(1e-3..1e6).contains(&size) {
        return format!("{value:.1e}");
    }
    let text = match size {
        100.0.. => return format!("{value:.0}"),
        10.0.. => format!("{value:.1}"),
        1.0.. => format!("{value:.2}"),
        0.1.. => format!("{value:.3}"),
        _ => format!("{value:.4}"),
    };
    text.trim_end_matches('0').trim_end_matches('.').to_owned()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::Camera;

    #[test]
    fn numbers_are_short() {
        for (value, text) in [
            (0.0, "0"),
            (1234.4, "1234"),
            (50.0, "50"),
            (0.25, "0.25"),
            (-2.5, "-2.5"),
            (0.012, "0.012"),
            (1e-5, "1.0e-5"),
        ] {
            assert_eq!(short(value), text, "{value}");
        }
    }

    #[test]
    fn a_scale_that_was_typed_stays_and_another_unit_has_its_own() {
        let mut view = ViewState::new(Camera::default());
        view.set_mode(ViewMode::Difference);
        assert!(follows_picture(&view), "at first it follows the picture");
        *view.difference_end() = Some(12.0);
        let end = |view: &ViewState| match display(view, &Survey::default()) {
            Display::Difference { end, .. } => end,
            other => panic!("{other:?}"),
        };
        assert_eq!((end(&view), follows_picture(&view)), (12.0, false), "typed");
        view.relative = true;
        assert!(follows_picture(&view), "the other unit follows the picture");
        assert!(end(&view) > 0.0, "whatever there is to see");
    }
}
