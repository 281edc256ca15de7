//! The command palette: anything that can be done, by a few letters of its name.

use egui::{Align2, Button, Id, Key, Modifiers, Ui, vec2};

use crate::editor::commands::Command;
use crate::editor::fuzzy;
use crate::editor::presets;
use crate::editor::session::{Item, Session};
use crate::scene::Scene;

/// How many lines are shown at most.
const MOST_LINES: usize = 12;

/// The command palette.
#[derive(Debug, Default)]
pub struct Palette {
    query: String,
    /// Which of the lines Enter takes.
    line: usize,
    focused: bool,
}

/// What came of a frame of the palette.
#[derive(Debug)]
pub enum Outcome {
    /// It stays.
    Open,
    /// It is closed without a choice.
    Closed,
    /// That was chosen.
    Chosen(Command),
}

/// A line: what it does, under which heading, and its name.
struct Line {
    command: Command,
    heading: &'static str,
    name: String,
}

impl Palette {
    /// Show it.
    pub fn show(&mut self, ctx: &egui::Context, session: &Session) -> Outcome {
        let key = |key| ctx.input_mut(|input| input.consume_key(Modifiers::NONE, key));
        if key(Key::Escape) {
            return Outcome::Closed;
        }
        let (down, up, enter) = (key(Key::ArrowDown), key(Key::ArrowUp), key(Key::Enter));
        let lines = found(&self.query, session);
        let last = lines.len().saturating_sub(1);
        self.line = match (down, up) {
            (true, false) => self.line + 1,
            (false, true) => self.line.saturating_sub(1),
            _ => self.line,
        }
        .min(last);
        let mut chosen = enter.then_some(self.line);
        let area = egui::Area::new(Id::unique("palette")).order(egui::Order::Foreground);
        let shown = area.anchor(Align2::CENTER_TOP, vec2(0.0, 64.0)).show(ctx, |ui| {
            egui::Frame::popup(ui.style()).inner_margin(8).show(ui, |ui| {
                ui.set_width(460.0);
                self.field(ui);
                ui.add_space(4.0);
                if lines.is_empty() {
                    ui.weak("Nothing is called so.");
                }
                for (index, line) in lines.iter().enumerate() {
                    if entry(ui, line, index == self.line, session) {
                        chosen = Some(index);
                    }
                }
            });
        });
        if let Some(line) = chosen.and_then(|index| lines.into_iter().nth(index)) {
            return if line.command.enabled(session) { Outcome::Chosen(line.command) } else { Outcome::Open };
        }
        if shown.response.clicked_elsewhere() && self.focused { Outcome::Closed } else { Outcome::Open }
    }

    fn field(&mut self, ui: &mut Ui) {
        let hint = "Type a command, a preset or a thing in the scene";
        let field = egui::TextEdit::singleline(&mut self.query).hint_text(hint).desired_width(f32::INFINITY);
        let response = ui.add(field).accessible_name("Command");
        if response.changed() {
            self.line = 0;
        }
        if !std::mem::replace(&mut self.focused, true) {
            response.request_focus();
        }
    }
}

/// One line; whether it was clicked.
fn entry(ui: &mut Ui, line: &Line, chosen: bool, session: &Session) -> bool {
    let key = line.command.shortcut().map(|shortcut| ui.ctx().format_shortcut(&shortcut)).unwrap_or_default();
    let heading = egui::RichText::new(format!("{:<8}", line.heading)).weak().monospace();
    let button = Button::selectable(chosen, (heading, line.name.as_str()))
        .right_text(egui::RichText::new(key).weak())
        .min_size(vec2(ui.available_width(), 22.0));
    let mut response = ui.add_enabled(line.command.enabled(session), button).accessible_name(&line.name);
    if let Some(hint) = line.command.hint() {
        response = response.on_hover_text(hint);
    }
    response.clicked()
}

/// What fits the query, the best first.
fn found(query: &str, session: &Session) -> Vec<Line> {
    let mut scored: Vec<(i32, Line)> = all(session)
        .filter_map(|line| {
            let score = fuzzy::score(query, &line.name)?;
            // What cannot be done now comes after what can.
            let penalty = if line.command.enabled(session) { 0 } else { 1000 };
            Some((score - penalty, line))
        })
        .collect();
    if query.trim().is_empty() {
        // Nothing typed: in the order of the menus.
        scored.iter_mut().for_each(|(score, line)| *score = -i32::from(!line.command.enabled(session)));
    }
    scored.sort_by_key(|(score, _)| std::cmp::Reverse(*score));
    scored.into_iter().take(MOST_LINES).map(|(_, line)| line).collect()
}

/// All that can be asked for.
fn all(session: &Session) -> impl Iterator<Item = Line> {
    let line = |command: Command| Line { heading: command.category().label(), name: named(&command, session), command };
    let scene = session.scene();
    let items = items(scene).map(Command::Select);
    let examples = presets::SCENES.iter().map(|preset| Command::OpenExample(*preset));
    let lights = presets::LIGHTS.iter().map(|preset| Command::InsertPreset(*preset));
    let commands: Vec<Command> = Command::all(session).into_iter().chain(items).chain(lights).chain(examples).collect();
    commands.into_iter().map(line)
}

/// The name of a command where no menu says what it is about.
fn named(command: &Command, session: &Session) -> String {
    let label = command.label(session);
    let lower = || label.to_lowercase();
    match command {
        Command::OpenExample(_) => format!("Open example {label}"),
        Command::InsertPreset(_) => format!("Insert {label}"),
        Command::AddLight(_) => format!("Add light: {}", lower()),
        Command::AddSurface(_) => format!("Add surface: {}", lower()),
        Command::AddMaterial => "Add material".to_owned(),
        Command::AddPlot(_) => format!("Add plot: {}", lower()),
        Command::Outline(_) => format!("Draw outline: {}", lower()),
        Command::Pivot(_) => format!("Pivot: {}", lower()),
        Command::ViewMode(_) => format!("View: {}", lower()),
        Command::Method(_) => format!("Shade by {label}"),
        _ => label,
    }
}

fn items(scene: &Scene) -> impl Iterator<Item = Item> {
    let lights = (0..scene.lights.len()).map(Item::Light);
    let surfaces = (0..scene.surfaces.len()).map(Item::Surface);
    let materials = (0..scene.materials.len()).map(Item::Material);
    lights.chain(surfaces).chain(materials).chain((0..scene.plots.len()).map(Item::Plot))
}
