//! A material's numbers, and what it becomes under another model of reflection.

use egui::Ui;

use super::fields::{Fields, Number};
use super::together::Together;
use crate::surface::{Material, ReflectionModel};

/// Exponents that a scene may have.
const EXPONENTS: [f64; 2] = [1.0, 1e4];
/// Slopes that a scene may have.
const SLOPES: [f64; 2] = [0.01, 1.0];
/// The least reflectance that a material gets whose model becomes Cook and Torrance's: that of glass.
const LEAST_REFLECTANCE: f64 = 0.04;

/// The numbers of materials, edited together.
pub(super) fn show(ui: &mut Ui, fields: &mut Fields<'_>, materials: &Together<Material>) {
    let is_used = |name: &String| materials.all().iter().any(|material| material.name == *name);
    let users = fields.scene().surfaces.iter().filter(|surface| is_used(&surface.material)).count();
    let title = match materials.all() {
        [material] => format!("Material “{}”", material.name),
        several => format!("{} materials", several.len()),
    };
    fields.section(ui, &title, |ui, fields| {
        let diffuse = materials.each(|material| material.diffuse);
        fields.colors(ui, "Diffuse k_d", &diffuse, materials.set_each(|material, rgb| material.diffuse = rgb));
        let specular = materials.each(|material| material.specular);
        fields.colors(ui, "Specular k_s", &specular, materials.set_each(|material, rgb| material.specular = rgb));
        model(ui, fields, materials);
        fields.derived(ui, "Used by", &format!("{users} surface{}", if users == 1 { "" } else { "s" }));
    });
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

/// The model, and a row for each of its numbers that all of them have.
fn model(ui: &mut Ui, fields: &mut Fields<'_>, materials: &Together<Material>) {
    let choices = MODELS.map(|model| (model.name(), model.name().to_owned()));
    let set = materials.set(|material: &mut Material, name| {
        if let Some(model) = MODELS.into_iter().find(|model| model.name() == name) {
            become_model(material, model);
        }
    });
    let models = materials.each(|material| material.model);
    let is_one = models.iter().all(|model| model.name() == models[0].name());
    let names = materials.each(|material| material.model.name());
    fields.choice_of_all(ui, "Reflection", &names, &choices, if is_one { hint(models[0]) } else { "" }, set);
    let slope = Number {
        unit: "",
        speed: 0.002,
        range: SLOPES[0]..=SLOPES[1],
        hint: "Root mean square slope of the microfacets; smaller is sharper",
    };
    let share =
        Number { hint: "Fresnel reflectance at normal incidence: 0.04 is glass, 1 is a mirror", ..Number::SHARE };
    let factor = |hint| Number { unit: "", speed: 0.005, range: -1.0..=1.0, hint };
    let exponent = Number {
        unit: "",
        speed: (0.01 * materials.all()[0].exponent).max(0.1),
        range: EXPONENTS[0]..=EXPONENTS[1],
        hint: "Larger is sharper; any real number from 1",
    };
    let numbers: [(&str, Number, Part); 5] = [
        ("Exponent m", exponent, exponent_of),
        ("Roughness", slope, roughness),
        ("Reflectance", share, reflectance),
        ("Tangential", factor("Factor along the surface: −1 mirrors, 1 sends back"), tangential),
        ("Normal", factor("Factor across the surface: 1 mirrors, less is off-specular"), normal),
    ];
    for (label, style, part) in numbers {
        if let Some(values) = materials.of_all(|material| part(&mut material.clone()).map(|number| *number)) {
            let set = materials.set_each(move |material, value| {
                if let Some(number) = part(material) {
                    *number = value;
                }
            });
            fields.numbers(ui, label, &style, &values, set);
        }
    }
}

/// A number of a material's model; none where the model has it not.
type Part = fn(&mut Material) -> Option<&mut f64>;

fn exponent_of(material: &mut Material) -> Option<&mut f64> {
    let is_cook_torrance = matches!(material.model, ReflectionModel::CookTorrance { .. });
    (!is_cook_torrance).then_some(&mut material.exponent)
}

fn roughness(material: &mut Material) -> Option<&mut f64> {
    if let ReflectionModel::CookTorrance { roughness, .. } = &mut material.model { Some(roughness) } else { None }
}

fn reflectance(material: &mut Material) -> Option<&mut f64> {
    if let ReflectionModel::CookTorrance { reflectance, .. } = &mut material.model { Some(reflectance) } else { None }
}

fn tangential(material: &mut Material) -> Option<&mut f64> {
    if let ReflectionModel::Lafortune { tangential, .. } = &mut material.model { Some(tangential) } else { None }
}

fn normal(material: &mut Material) -> Option<&mut f64> {
    if let ReflectionModel::Lafortune { normal, .. } = &mut material.model { Some(normal) } else { None }
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
