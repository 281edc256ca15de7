//! A preset carried from the library into the view.

use std::sync::Arc;

use egui::{Response, Ui};

use super::{place, resting};
use crate::editor::session::Session;
use crate::editor::viewport::pick::Solids;
use crate::editor::viewport::projection::Projection;
use crate::scene::Scene;

/// What is being carried.
#[derive(Clone, Debug)]
pub struct Carried {
    /// What the preset is called.
    pub title: String,
    /// The preset.
    pub scene: Arc<Scene>,
}

/// Let a preset be dropped on the view that `response` is of.
pub fn receive(ui: &Ui, response: &Response, projection: &Projection, solids: &Solids, session: &mut Session) {
    let Some(carried) = response.dnd_hover_payload::<Carried>() else { return };
    let Some(pos) = ui.input(|input| input.pointer.latest_pos()) else { return };
    let ray = projection.ray(pos);
    let surface = solids.nearest(&ray).map(|(index, hit)| (index, hit.p, hit.n));
    let over = surface.and_then(|(index, ..)| session.scene().surfaces.get(index));
    let over = over.map_or_else(|| "over the origin".to_owned(), |surface| format!("on {}", surface.name));
    session.hint = format!("Release to put {} {over}; Esc cancels", carried.title);
    if let Some(carried) = response.dnd_release_payload::<Carried>() {
        // A surface is met from its front: the side that the eye sees.
        let (p, n) =
            surface.map_or_else(|| resting(0.0), |(_, p, n)| (p, if n.dot(ray.direction) > 0.0 { -n } else { n }));
        let lights = place(&carried.scene, p, n);
        let preset = Scene { lights, ..Scene::clone(&carried.scene) };
        session.insert_lights(&format!("Insert {}", carried.title), &preset);
    }
}
