//! What is wrong with the scene, or likely not meant.

use egui::{RichText, Ui};
use egui_material_icons::icons;

use crate::editor::session::{Item, Session};
use crate::scene::{Scene, validate};
use crate::surface::{Material, ReflectionModel};

/// Show the pane.
pub(super) fn show(ui: &mut Ui, session: &mut Session) {
    let problems = validate(session.scene());
    let oddities = oddities(session.scene());
    egui::ScrollArea::vertical().auto_shrink(false).show(ui, |ui| {
        egui::Frame::new().inner_margin(10).show(ui, |ui| {
            if problems.is_empty() && oddities.is_empty() {
                ui.weak("No problems.");
            }
            for problem in problems {
                let text = format!("{} {problem}", icons::ICON_ERROR.codepoint);
                ui.label(RichText::new(text).color(ui.visuals().error_fg_color));
            }
            for (item, text) in oddities {
                let text = format!("{} {text}", icons::ICON_WARNING.codepoint);
                if ui.selectable_label(session.selection.contains(item), text).clicked() {
                    session.selection.set([item]);
                }
            }
        });
    });
}

/// What is allowed but likely not meant.
fn oddities(scene: &Scene) -> Vec<(Item, String)> {
    let dark = scene.lights.iter().enumerate().filter(|(_, light)| light.strength() <= 0.0);
    let dark = dark.map(|(i, light)| (Item::Light(i), format!("“{}” emits nothing", light.name)));
    let bright = scene.materials.iter().enumerate().filter(|(_, material)| reflected(material) > 1.0);
    let bright = bright.map(|(i, material)| {
        (Item::Material(i), format!("“{}” reflects more than it receives: k_d + k_s is above 1", material.name))
    });
    dark.chain(bright).collect()
}

/// Greatest component of what a material reflects at normal incidence.
fn reflected(material: &Material) -> f64 {
    let fresnel = match material.model {
        ReflectionModel::CookTorrance { reflectance, .. } => reflectance,
        _ => 1.0,
    };
    (material.diffuse + fresnel * material.specular).max_element()
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::DVec3;

    #[test]
    fn a_material_that_gains_energy_is_pointed_out() {
        let material = |diffuse: f64| Material {
            name: "m".to_owned(),
            diffuse: DVec3::splat(diffuse),
            specular: DVec3::splat(0.3),
            model: ReflectionModel::default(),
            exponent: 8.0,
        };
        let scene = Scene { materials: vec![material(0.5), material(0.8)], ..Scene::default() };
        let items: Vec<Item> = oddities(&scene).into_iter().map(|(item, _)| item).collect();
        assert_eq!(items, [Item::Material(1)], "only the second");
    }
}
