//! The painter: the pattern of the selected textured light as a canvas, with tools beside it.
//!
//! [`sheet`] holds the pattern and what is painted over it, [`tools`] what the mouse does, [`menus`] what changes all of
//! it, [`options`] what the tools paint with, and [`view`] how the canvas lies in the pane. While something is painted the
//! light shows it in few texels ([`Session::live`]); the document changes when the mouse is released, one step a stroke.

mod menus;
mod options;
mod sheet;
mod tools;
mod view;

use egui::{
    CentralPanel, Color32, CursorIcon, Frame, Key, Margin, Modifiers, Panel, PointerButton, Rect, Response, Sense, Ui,
    WidgetInfo,
};
use egui_material_icons::icons;
use glam::DVec2;

use self::menus::{Done, Menus};
use self::sheet::Sheet;
use self::tools::{Ink, Options, PaintTool, texel_at};
use self::view::{Placed, View};
use super::icon_button;
use crate::editor::commands::Command;
use crate::editor::session::{Item, LivePattern, Session};
use crate::editor::theme;
use crate::light::pattern::Image;
use crate::light::pattern::paint::{Canvas, Preset};
use crate::light::{Shape, Textured};

/// Width of the column of tools, points.
const TOOLS_WIDTH: f32 = 36.0;
/// Width of the column of what is chosen for them, points.
const OPTIONS_WIDTH: f32 = 178.0;
/// Zoom for each point scrolled, as a logarithm.
const ZOOM_PER_POINT: f32 = 0.004;
/// A step of the brush's size by its keys.
const SIZE_STEP: f64 = 1.25;
/// A step of the brush's hardness by its keys.
const HARDNESS_STEP: f64 = 0.1;
/// Texels of a new light's pattern along a side.
const NEW_SIDE: usize = 256;

/// The pane's own state.
#[derive(Default)]
pub struct Painter {
    options: Options,
    menus: Menus,
    view: View,
    sheet: Option<Sheet>,
    /// In this frame.
    is_shown: bool,
}

/// What the mouse is over.
struct Under {
    place: DVec2,
    /// Inside the picture.
    texel: Option<[f32; 3]>,
}

impl Painter {
    /// Show the pane; the commands that were asked for.
    pub fn show(&mut self, ui: &mut Ui, session: &mut Session) -> Vec<Command> {
        self.is_shown = true;
        let mut commands = Vec::new();
        let Some((index, textured)) = selected(session) else {
            self.sheet = None;
            session.live = None;
            no_pattern(ui, session);
            return commands;
        };
        self.follow(session, index, &textured);
        self.end_stroke(ui, session, index);
        let bar = |x: i8, y: i8| Frame::new().inner_margin(Margin::symmetric(x, y));
        Panel::top("painter menus").frame(bar(8, 4)).show(ui, |ui| {
            ui.horizontal(|ui| self.header(ui, session, index, &textured, &mut commands));
        });
        let side = |id: &'static str, width: f32| Panel::left(id).resizable(false).exact_size(width);
        side("painter tools", TOOLS_WIDTH).frame(bar(4, 4)).show(ui, |ui| self.tools(ui));
        side("painter options", OPTIONS_WIDTH).frame(bar(8, 6)).show(ui, |ui| {
            egui::ScrollArea::vertical().auto_shrink(false).show(ui, |ui| options::show(ui, &mut self.options));
        });
        CentralPanel::default().frame(Frame::new()).show(ui, |ui| self.canvas(ui, session, index, &textured));
        commands
    }

    /// At the end of a frame: what is proposed in a pane that is hidden is given up. Whether anything was.
    pub fn end_frame(&mut self, session: &mut Session) -> bool {
        !std::mem::take(&mut self.is_shown) && session.live.take().is_some()
    }

    /// Whether something is being painted.
    pub fn is_busy(&self) -> bool {
        self.sheet.as_ref().is_some_and(Sheet::is_busy)
    }

    /// Take up another light's pattern, or what came into this one from elsewhere.
    fn follow(&mut self, session: &mut Session, index: usize, textured: &Textured) {
        let name = &session.scene().lights[index].name;
        let image = &textured.pattern.image;
        if self.sheet.as_ref().is_none_or(|sheet| sheet.light != *name || !sheet.image.is_same(image)) {
            if self.sheet.as_ref().is_none_or(|sheet| sheet.light != *name) {
                self.view = View::default();
            }
            self.sheet = Some(Sheet::new(name, image));
            session.live = None;
        }
    }

    /// Keep a stroke once the button is up: before a menu answers to a press that came in the same frame.
    fn end_stroke(&mut self, ui: &Ui, session: &mut Session, index: usize) {
        let is_up = ui.input(|input| input.pointer.primary_released() || !input.pointer.primary_down());
        if is_up && self.sheet.as_ref().is_some_and(|sheet| sheet.is_busy() && !sheet.is_proposed()) {
            self.keep(session, index, self.options.tool.step());
        }
    }

    /// The menus, and what is painted on.
    fn header(
        &mut self,
        ui: &mut Ui,
        session: &mut Session,
        index: usize,
        textured: &Textured,
        commands: &mut Vec<Command>,
    ) {
        let Some(sheet) = &mut self.sheet else { return };
        let aspect = textured.size.x / textured.size.y;
        match self.menus.show(ui, sheet, aspect) {
            Some(Done::Kept(step)) => self.keep(session, index, step),
            Some(Done::Proposed) => self.show_live(ui, session, index),
            Some(Done::GivenUp) => self.give_up(ui, session),
            None => {}
        }
        let load = ui.button("Load…").on_hover_text("Another PNG, JPEG, EXR or HDR picture in its place");
        if load.accessible_name("Load pattern picture").clicked() {
            commands.push(Command::ReplacePattern(session.scene().lights[index].name.clone()));
        }
        ui.separator();
        let color = ui.visuals().text_color();
        if icon_button(ui, icons::ICON_FIT_SCREEN, color, "Fit pattern in pane").clicked() {
            self.view = View::default();
        }
        ui.weak(format!("{:.0} %", self.view.percent()));
        ui.separator();
        options::symmetry(ui, &mut self.options);
        let Some(sheet) = &self.sheet else { return };
        let [width, height] = sheet.size();
        ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| {
            let text = format!("{} · {width} × {height} tx", session.scene().lights[index].name);
            ui.add(egui::Label::new(egui::RichText::new(text).weak()).truncate());
        });
    }

    fn tools(&mut self, ui: &mut Ui) {
        ui.spacing_mut().item_spacing.y = 2.0;
        for tool in PaintTool::ALL {
            let on = self.options.tool == tool;
            let icon = tool.icon().rich_text().size(16.0);
            let icon = if on { icon.color(theme::accent(ui.visuals())) } else { icon };
            let button = egui::Button::selectable(on, icon).min_size(egui::vec2(28.0, 25.0));
            let hover = format!("{}  ({})", tool.name(), tool.key().name());
            if ui.add(button).on_hover_text(hover).accessible_name(tool.name()).clicked() {
                self.options.tool = tool;
            }
        }
    }

    /// The canvas, and what the mouse does on it.
    fn canvas(&mut self, ui: &mut Ui, session: &mut Session, index: usize, textured: &Textured) {
        let pane = ui.available_rect_before_wrap();
        let response = ui.allocate_rect(pane, Sense::click_and_drag());
        response.widget_info(|| WidgetInfo::labeled(egui::Role::Canvas, true, "Pattern canvas"));
        let Some(size) = self.sheet.as_ref().map(Sheet::size) else { return };
        self.navigate(ui, &response, pane, size, textured.size);
        let placed = self.view.place(pane, size, textured.size);
        session.pane_keys |= response.contains_pointer();
        if response.contains_pointer() && !ui.ctx().text_edit_focused() {
            self.keys(ui, session);
        }
        let under = response.hover_pos().or_else(|| response.interact_pointer_pos()).map(|at| self.under(&placed, at));
        self.work(ui, &response, session, index, under.as_ref());
        let (ground, line) = (ui.visuals().extreme_bg_color, ui.visuals().weak_text_color());
        let painter = ui.painter_at(pane);
        view::paint_ground(pane, placed.rect, ground, line, &painter);
        if let Some(sheet) = &mut self.sheet {
            let texture = sheet.texture(ui.ctx()).id();
            painter.image(texture, placed.rect, view::whole(), Color32::WHITE);
        }
        placed.paint_grid(&painter);
        self.paint_cursor(&placed, under.as_ref(), &painter);
        self.paint_read_out(ui, pane, under.as_ref(), &painter);
        orientation(ui, pane);
    }

    fn under(&self, placed: &Placed, at: egui::Pos2) -> Under {
        let place = placed.texels(at);
        let shown = self.sheet.as_ref().map(Sheet::shown);
        let texel = texel_at(place).and_then(|(column, row)| shown?.get(column, row));
        Under { place, texel }
    }

    /// Wheel, middle button and Space.
    fn navigate(&mut self, ui: &Ui, response: &Response, pane: Rect, size: [usize; 2], sides: DVec2) {
        let (scroll, pinch) = ui.input(|input| (input.smooth_scroll_delta().y, input.zoom_delta()));
        let factor = (ZOOM_PER_POINT * scroll).exp() * pinch;
        if let Some(at) = response.hover_pos()
            && factor != 1.0
        {
            self.view.zoom_at(pane, at, factor);
        }
        let by_space = ui.input(|input| input.key_down(Key::Space)) && response.dragged();
        if response.dragged_by(PointerButton::Middle) || by_space {
            ui.ctx().set_cursor_icon(CursorIcon::Grabbing);
            let placed = self.view.place(pane, size, sides);
            self.view.pan_by(response.drag_delta(), pane, &placed);
        }
    }

    /// The keys that the pane has while the pointer is over it.
    fn keys(&mut self, ui: &Ui, session: &mut Session) {
        let pressed = |key| ui.input_mut(|input| input.consume_key(Modifiers::NONE, key));
        let shifted = |key| ui.input_mut(|input| input.consume_key(Modifiers::SHIFT, key));
        for tool in PaintTool::ALL {
            if pressed(tool.key()) {
                self.options.tool = tool;
            }
        }
        let brush = &mut self.options.brush;
        for (key, shifted_key, sign) in
            [(Key::OpenBracket, Key::OpenCurlyBracket, -1), (Key::CloseBracket, Key::CloseCurlyBracket, 1)]
        {
            if shifted(key) || shifted(shifted_key) {
                brush.hardness = (brush.hardness + f64::from(sign) * HARDNESS_STEP).clamp(0.0, 1.0);
            } else if pressed(key) {
                brush.size = (brush.size * SIZE_STEP.powi(sign)).clamp(*options::SIZES.start(), *options::SIZES.end());
            }
        }
        if pressed(Key::X) {
            std::mem::swap(&mut self.options.ink, &mut self.options.second);
        }
        if pressed(Key::F) {
            self.view = View::default();
        }
        if self.is_busy() && pressed(Key::Escape) {
            self.give_up(ui, session);
        }
    }

    /// Paint, fill, span or pick.
    fn work(&mut self, ui: &Ui, response: &Response, session: &mut Session, index: usize, under: Option<&Under>) {
        let (modifiers, press, space) =
            ui.input(|input| (input.modifiers, input.pointer.primary_pressed(), input.key_down(Key::Space)));
        if response.contains_pointer() {
            session.hint = self.hint();
            if !space {
                ui.ctx().set_cursor_icon(CursorIcon::Crosshair);
            }
        }
        let (Some(sheet), Some(under)) = (&mut self.sheet, under) else { return };
        let picks = modifiers.alt || self.options.tool == PaintTool::Picker;
        if picks && !sheet.is_busy() {
            let held = press && response.contains_pointer() || response.dragged_by(PointerButton::Primary);
            if let Some(texel) = under.texel.filter(|_| held) {
                self.options.ink = Ink::of(texel);
            }
            return;
        }
        if press && response.contains_pointer() && !space && !sheet.is_proposed() {
            sheet.press(&self.options, under.place, modifiers.shift);
            self.show_live(ui, session, index);
        } else if sheet.is_busy() && !sheet.is_proposed() {
            let to = match sheet.span() {
                Some([from, _]) if modifiers.shift => self.options.constrained(from, under.place),
                _ => under.place,
            };
            if sheet.lead(&self.options, to) {
                self.show_live(ui, session, index);
            }
        }
    }

    fn hint(&self) -> String {
        match &self.sheet {
            Some(sheet) if sheet.is_black() => {
                "The canvas is black: the light keeps its last pattern until something is painted".to_owned()
            }
            _ => self.options.tool.hint().to_owned(),
        }
    }

    /// Let the light show what is being painted.
    fn show_live(&self, ui: &Ui, session: &mut Session, index: usize) {
        let image = self.sheet.as_ref().and_then(Sheet::live);
        let light = session.scene().lights[index].name.clone();
        session.live = image.map(|image| LivePattern { light, image });
        // The viewport comes before this pane.
        ui.ctx().request_repaint();
    }

    /// Make what is shown the light's pattern.
    fn keep(&mut self, session: &mut Session, index: usize, step: &str) {
        session.live = None;
        if let Some(image) = self.sheet.as_mut().and_then(Sheet::release) {
            session.repaint_pattern(index, image, step);
        }
    }

    fn give_up(&mut self, ui: &Ui, session: &mut Session) {
        session.live = None;
        if let Some(sheet) = &mut self.sheet {
            sheet.cancel();
        }
        ui.ctx().request_repaint();
    }

    /// The brush's rim under the pointer, and where else it paints.
    fn paint_cursor(&self, placed: &Placed, under: Option<&Under>, painter: &egui::Painter) {
        let (Some(under), Some(sheet)) = (under, &self.sheet) else { return };
        let outlines = matches!(self.options.tool, PaintTool::Rectangle | PaintTool::Ellipse) && !self.options.filled;
        if !(self.options.tool.is_freehand() || self.options.tool == PaintTool::Line || outlines) {
            return;
        }
        for (i, map) in self.options.symmetry().maps(sheet.size()).iter().enumerate() {
            let strength = if i == 0 { 230 } else { 90 };
            placed.paint_ring(map.transform_point2(under.place), self.options.brush.size, strength, painter);
        }
    }

    /// Place and value under the pointer, and the mean, in the lower left corner.
    fn paint_read_out(&self, ui: &Ui, pane: Rect, under: Option<&Under>, painter: &egui::Painter) {
        let Some(sheet) = &self.sheet else { return };
        let text = match under {
            Some(Under { place, texel: Some([r, g, b]) }) => {
                let value = if r == g && g == b { format!("{r:.4}") } else { format!("{r:.4}  {g:.4}  {b:.4}") };
                format!("{:.0}, {:.0}   {value}", place.x.floor(), place.y.floor())
            }
            _ if sheet.is_black() => "black: paint something that shines".to_owned(),
            _ => return,
        };
        let font = egui::TextStyle::Monospace.resolve(ui.style());
        let galley = painter.layout_no_wrap(text, font, Color32::from_gray(0xe4));
        let rect = egui::Align2::LEFT_BOTTOM
            .anchor_size(pane.left_bottom() + egui::vec2(8.0, -8.0), galley.size() + egui::vec2(8.0, 4.0));
        painter.rect_filled(rect, 3.0, Color32::from_black_alpha(170));
        painter.galley(rect.min + egui::vec2(4.0, 2.0), galley, Color32::WHITE);
    }
}

/// How the canvas lies on the light, in the lower right corner.
fn orientation(ui: &mut Ui, pane: Rect) {
    let size = egui::vec2(76.0, 18.0).min(pane.size());
    let rect = egui::Align2::RIGHT_BOTTOM.anchor_size(pane.right_bottom() - egui::vec2(8.0, 8.0), size);
    let response = ui.put(rect, egui::Label::new(egui::RichText::new("lit side").weak()).selectable(false));
    response.on_hover_text(
        "As somebody sees it who looks at the side that shines: the light’s own X points left, its Y up",
    );
}

/// The textured light that is selected last.
fn selected(session: &Session) -> Option<(usize, Textured)> {
    let Item::Light(index) = session.selection.primary()? else { return None };
    match &session.scene().lights.get(index)?.shape {
        Shape::Textured(textured) => Some((index, textured.clone())),
        _ => None,
    }
}

/// What the pane shows where there is nothing to paint on.
fn no_pattern(ui: &mut Ui, session: &mut Session) {
    ui.vertical_centered(|ui| {
        ui.add_space(24.0);
        ui.weak("Select a textured light to paint its pattern.");
        ui.add_space(6.0);
        let response = ui.button("New light to paint").on_hover_text("A square light with a softbox’s falloff");
        if response.clicked()
            && let Some(image) = softbox()
        {
            session.add_painted_light(image);
        }
    });
}

fn softbox() -> Option<Image> {
    let mut canvas = Preset::Softbox.canvas([NEW_SIDE; 2], 1.0, &[]);
    canvas.settle(&Canvas::filled([1, 1], [0.0; 3]));
    canvas.image()
}
