//! Which surfaces lights are linked to.

use egui::containers::menu::{MenuButton, MenuConfig};
use egui::{Button, PopupCloseBehavior, Ui};

use crate::editor::session::Session;
use crate::scene::Scene;

/// The surfaces that the lights at these places reach, in few words.
pub(super) fn text(scene: &Scene, lights: &[usize]) -> String {
    let lists: Vec<_> = lights.iter().filter_map(|i| scene.lights.get(*i)).map(|light| &light.only).collect();
    match lists.split_first() {
        Some((first, others)) if others.iter().any(|other| other != first) => "mixed".to_owned(),
        Some((Some(only), _)) => match only.as_slice() {
            [] => "no surface".to_owned(),
            [one] => format!("only {one}"),
            several => format!("only {} surfaces", several.len()),
        },
        _ => "all surfaces".to_owned(),
    }
}

/// A button that opens the list of surfaces.
pub(super) fn menu(ui: &mut Ui, session: &mut Session, lights: &[usize], text: &str, name: &str) {
    let hint = "Light only some surfaces; shadows still fall from all of them";
    let config = MenuConfig::new().close_behavior(PopupCloseBehavior::CloseOnClickOutside);
    let button = MenuButton::from_button(Button::new(text)).config(config);
    let (response, _) = button.ui(ui, |ui| boxes(ui, session, lights));
    response.on_hover_text(hint).accessible_name(name);
}

/// A box to tick for all surfaces, and one for each.
pub(super) fn boxes(ui: &mut Ui, session: &mut Session, lights: &[usize]) {
    let scene = session.scene().clone();
    let lit: Vec<_> = lights.iter().filter_map(|i| scene.lights.get(*i)).collect();
    let mut all = lit.iter().all(|light| light.only.is_none());
    if ui.checkbox(&mut all, "All surfaces").on_hover_text("Those too that are added later").changed() {
        let names: Vec<_> = scene.surfaces.iter().map(|surface| surface.name.clone()).collect();
        session.link_lights(lights, (!all).then_some(names.as_slice()));
    }
    ui.separator();
    for surface in &scene.surfaces {
        let reached = lit.iter().filter(|light| light.reaches(&surface.name)).count();
        let mut ticked = reached == lit.len();
        let some = reached > 0 && !ticked;
        let tick_box = egui::Checkbox::new(&mut ticked, &surface.name).indeterminate(some);
        if ui.add(tick_box).changed() {
            // In the scene's order, whatever the order of the clicks.
            let is_lit = |name: &str| if name == surface.name { ticked } else { lit.iter().any(|l| l.reaches(name)) };
            let names = scene.surfaces.iter().map(|surface| surface.name.clone()).filter(|name| is_lit(name));
            session.link_lights(lights, Some(&names.collect::<Vec<_>>()));
        }
    }
}
