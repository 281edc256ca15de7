//! A material's numbers, and what it becomes under another model of reflection.

use egui::Ui;

use super::fields::{Fields, Number};
use crate::scene::Scene;
use crate::surface::{Material, ReflectionModel};

/// Exponents that a scene may have.
const EXPONENTS: [f64; 2] = [1.0, 1e4];
/// Slopes that a scene may have.
const SLOPES: [f64; 2] = [0.01, 1.0];
/// The least reflectance that a material gets whose model becomes Cook and Torrance's: that of glass.
const LEAST_REFLECTANCE: f64 = 0.04;

pub(super) fn show(ui: &mut Ui, fields: &mut Fields<'_>, index: usize) {
    let Some(material) = fields.scene().materials.get(index).cloned() else { return };
    let users = fields.scene().surfaces.iter().filter(|surface| surface.material == material.name).count();
    fields.section(ui, &format!("Material “{}”", material.name), |ui, fields| {
        fields.color(ui, "Diffuse k_d", material.diffuse, at(index, |m, rgb| m.diffuse = rgb));
        fields.color(ui, "Specular k_s", material.specular, at(index, |m, rgb| m.specular = rgb));
        model(ui, fields, index, &material);
        fields.derived(ui, "Used by", &format!("{users} surface{}", if users == 1 { "" } else { "s" }));
    });
}

fn at<T>(index: usize, set: impl Fn(&mut Material, T)) -> impl Fn(&mut Scene, T) {
    move |scene, value| {
        if let Some(material) = scene.materials.get_mut(index) {
            set(material, value);
        }
    }
}

/// The models, those of one lobe about the mirror direction first.
const MODELS: [ReflectionModel; 4] = [
    ReflectionModel::Phong {},
    ReflectionModel::Blinn {},
    ReflectionModel::CookTorrance { roughness: 0.0, reflectance: 0.0 },
    ReflectionModel::Lafortune { tangential: -1.0, normal: 1.0 },
];

fn hint(model: ReflectionModel) -> &'static str {
    match model {
        ReflectionModel::Phong {} => "(m+1)/(2π)·(ω·r)ᵐ: a lobe about the mirror direction",
        ReflectionModel::Blinn {} => "(n·h)ᵐ: a lobe of the half-vector, which grows long at grazing views",
        ReflectionModel::CookTorrance { .. } => "Microfacets: Beckmann’s slopes, V-groove shadowing, Schlick’s Fresnel",
        ReflectionModel::Lafortune { .. } => "Phong’s lobe about a mirror direction stretched by two factors",
    }
}

fn model(ui: &mut Ui, fields: &mut Fields<'_>, index: usize, material: &Material) {
    let choices = MODELS.map(|model| (model.name(), model.name().to_owned()));
    let set = at(index, |material: &mut Material, name| {
        if let Some(model) = MODELS.into_iter().find(|model| model.name() == name) {
            become_model(material, model);
        }
    });
    fields.choice_explained(ui, "Reflection", &material.model.name(), &choices, hint(material.model), set);
    let exponent = Number {
        unit: "",
        speed: (0.01 * material.exponent).max(0.1),
        range: EXPONENTS[0]..=EXPONENTS[1],
        hint: "Larger is sharper; any real number from 1",
    };
    let set_exponent = at(index, |material: &mut Material, exponent| material.exponent = exponent);
    match material.model {
        ReflectionModel::Phong {} | ReflectionModel::Blinn {} => {
            fields.number(ui, "Exponent m", &exponent, material.exponent, set_exponent);
        }
        ReflectionModel::CookTorrance { roughness, reflectance } => {
            let slope = Number {
                unit: "",
                speed: 0.002,
                range: SLOPES[0]..=SLOPES[1],
                hint: "Root mean square slope of the microfacets; smaller is sharper",
            };
            let set = at(index, |material: &mut Material, roughness| {
                material.model = ReflectionModel::CookTorrance { roughness, reflectance };
            });
            fields.number(ui, "Roughness", &slope, roughness, set);
            let share = Number {
                hint: "Fresnel reflectance at normal incidence: 0.04 is glass, 1 is a mirror",
                ..Number::SHARE
            };
            let set = at(index, |material: &mut Material, reflectance| {
                material.model = ReflectionModel::CookTorrance { roughness, reflectance };
            });
            fields.number(ui, "Reflectance", &share, reflectance, set);
        }
        ReflectionModel::Lafortune { tangential, normal } => {
            fields.number(ui, "Exponent m", &exponent, material.exponent, set_exponent);
            let factor = |hint| Number { unit: "", speed: 0.005, range: -1.0..=1.0, hint };
            let set = at(index, |material: &mut Material, tangential| {
                material.model = ReflectionModel::Lafortune { tangential, normal };
            });
            fields.number(
                ui,
                "Tangential",
                &factor("Factor along the surface: −1 mirrors, 1 sends back"),
                tangential,
                set,
            );
            let set = at(index, |material: &mut Material, normal| {
                material.model = ReflectionModel::Lafortune { tangential, normal };
            });
            fields.number(
                ui,
                "Normal",
                &factor("Factor across the surface: 1 mirrors, less is off-specular"),
                normal,
                set,
            );
        }
    }
}

/// Give a material another model, and that the numbers with which its highlight keeps its width and strength.
///
/// About its peak, a Phong lobe of exponent m is as wide as Blinn's of 4m and as Beckmann's of slope s = 1/√(2m). Where
/// Cook and Torrance's reflectance comes in, k_s is divided by it, so that their product is as before.
fn become_model(material: &mut Material, model: ReflectionModel) {
    if material.model.name() == model.name() {
        return;
    }
    let phong_exponent = match material.model {
        ReflectionModel::Phong {} | ReflectionModel::Lafortune { .. } => material.exponent,
        ReflectionModel::Blinn {} => 0.25 * material.exponent,
        ReflectionModel::CookTorrance { roughness, reflectance } => {
            material.specular *= reflectance;
            0.5 / (roughness * roughness)
        }
    };
    let exponent = |m: f64| m.clamp(EXPONENTS[0], EXPONENTS[1]);
    material.model = model;
    match &mut material.model {
        ReflectionModel::Phong {} | ReflectionModel::Lafortune { .. } => material.exponent = exponent(phong_exponent),
        ReflectionModel::Blinn {} => material.exponent = exponent(4.0 * phong_exponent),
        ReflectionModel::CookTorrance { roughness, reflectance } => {
            *roughness = (0.5 / phong_exponent).sqrt().clamp(SLOPES[0], SLOPES[1]);
            *reflectance = material.specular.max_element().clamp(LEAST_REFLECTANCE, 1.0);
            material.specular /= *reflectance;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::DVec3;

    fn material(model: ReflectionModel, exponent: f64) -> Material {
        Material {
            name: "m".to_owned(),
            diffuse: DVec3::splat(0.4),
            specular: DVec3::new(0.3, 0.2, 0.1),
            model,
            exponent,
        }
    }

    #[test]
    fn there_and_back_through_any_model_changes_nothing() {
        for there in MODELS {
            for exponent in [2.0, 32.0, 700.0] {
                let start = material(ReflectionModel::Phong {}, exponent);
                let mut changed = start.clone();
                become_model(&mut changed, there);
                become_model(&mut changed, ReflectionModel::Phong {});
                assert!((changed.exponent / exponent - 1.0).abs() < 1e-12, "{}: {}", there.name(), changed.exponent);
                assert!(changed.specular.distance(start.specular) < 1e-15, "{}: {}", there.name(), changed.specular);
            }
        }
    }

    /// Radiance of the lobe in a direction turned from the mirror direction by `angle`, seen along the normal.
    fn seen(material: &Material, angle: f64) -> f64 {
        let lobe = crate::render::lobe_of(material);
        material.specular.x * lobe.density(DVec3::Z, DVec3::Z, DVec3::new(angle.sin(), 0.0, angle.cos()))
    }

    #[test]
    fn a_sharp_highlight_looks_alike_under_every_model() {
        let start = material(ReflectionModel::Phong {}, 400.0);
        for model in MODELS {
            let mut changed = start.clone();
            become_model(&mut changed, model);
            for angle in [0.0, 0.03, 0.06] {
                let (now, before) = (seen(&changed, angle), seen(&start, angle));
                assert!((now / before - 1.0).abs() < 0.02, "{} at {angle}: {now}, before {before}", model.name());
            }
        }
    }
}
