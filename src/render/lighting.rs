//! The lights of a scene, prepared for shading, and what a material makes of them.

use std::f64::consts::FRAC_1_PI;

use std::sync::Arc;

use glam::DVec3;

use super::MethodChoice;
use super::shadow::{Casters, Precision, Shadow};
use crate::scene::Scene;
use crate::shading::{Lobe, Prepared, Response, ShadingPoint};
use crate::surface::{Material, ReflectionModel};
use crate::visibility::Objects;

/// The parts of a scene's lights, each with its method and weight.
#[derive(Clone, Debug)]
pub struct Lighting {
    lights: Vec<Lit>,
    /// What casts shadows.
    casters: Option<Casters>,
}

#[derive(Clone, Debug)]
struct Lit {
    light: Prepared,
    weight: DVec3,
    shadow: Shadow,
    /// Of each surface of the scene, whether it is lit; of all of them where there is no list.
    reaches: Option<Arc<[bool]>>,
}

/// A material prepared for shading.
#[derive(Clone, Debug, PartialEq)]
pub struct Reflection {
    diffuse: DVec3,
    specular: DVec3,
    lobe: Lobe,
}

/// What leaves a point towards the eye, and what reaches it.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Outgoing {
    /// E, lx.
    pub irradiance: DVec3,
    /// L_out, cd/m².
    pub radiance: DVec3,
}

impl Lighting {
    /// All lights of the scene, in its order, without shadows.
    pub fn new(scene: &Scene, choice: MethodChoice) -> Self {
        let lit = scene.lights.iter().flat_map(|light| {
            let method = choice.for_shape(&light.shape);
            let parts = light.parts().into_iter();
            let reached = || scene.surfaces.iter().map(|surface| light.reaches(&surface.name)).collect();
            let reaches: Option<Arc<[bool]>> = light.only.is_some().then(reached);
            parts.map(move |(emitter, weight)| Lit {
                light: Prepared::new(&emitter, method),
                weight,
                shadow: Shadow::default(),
                reaches: reaches.clone(),
            })
        });
        Self { lights: lit.collect(), casters: None }
    }

    /// The same with the shadows that objects cast.
    pub fn with_shadows(self, objects: &Arc<Objects>) -> Self {
        let prepared = |lit: Lit| Lit { shadow: Shadow::new(lit.light.emitter()), ..lit };
        Self { lights: self.lights.into_iter().map(prepared).collect(), casters: Some(Casters::new(objects)) }
    }

    /// The same for pictures; see [`Prepared::for_pictures`] and [`Precision::PICTURE`].
    pub fn for_pictures(self) -> Self {
        let Self { lights, casters } = self;
        let lights = lights.into_iter().map(|lit| Lit { light: lit.light.for_pictures(), ..lit });
        let casters = casters.map(|casters| casters.with_precision(Precision::PICTURE));
        Self { lights: lights.collect(), casters }
    }

    /// L_out = Σ weight·(k_d/π·E + k_s·S) over the lights, with their unit responses E and S, at a point that is on no
    /// surface of the scene: all lights reach it.
    pub fn outgoing(&self, reflection: &Reflection, at: &ShadingPoint) -> Outgoing {
        self.sum(reflection, at, |_| true)
    }

    /// [`Self::outgoing`] at a point of the surface of that index in the scene, by the lights that are linked to it.
    pub fn outgoing_on(&self, surface: usize, reflection: &Reflection, at: &ShadingPoint) -> Outgoing {
        let is_lit = |reaches: &Arc<[bool]>| reaches.get(surface) == Some(&true);
        self.sum(reflection, at, |lit| lit.reaches.as_ref().is_none_or(is_lit))
    }

    fn sum(&self, reflection: &Reflection, at: &ShadingPoint, is_lit: impl Fn(&Lit) -> bool) -> Outgoing {
        let mut sum = Outgoing::default();
        let strengths = [FRAC_1_PI * reflection.diffuse.max_element(), reflection.specular.max_element()];
        let lit = self.lights.iter().filter(|lit| lit.weight != DVec3::ZERO && is_lit(lit));
        for Lit { light, weight, shadow, .. } in lit {
            let Response { irradiance, specular } = match &self.casters {
                Some(casters) => casters.response(light, shadow, at, &reflection.lobe, strengths),
                None => light.respond(at, &reflection.lobe),
            };
            sum.irradiance += irradiance * weight;
            sum.radiance += weight * (FRAC_1_PI * irradiance * reflection.diffuse + specular * reflection.specular);
        }
        sum
    }
}

impl Reflection {
    /// A material prepared for shading.
    pub fn new(material: &Material) -> Self {
        Self { diffuse: material.diffuse, specular: material.specular, lobe: lobe_of(material) }
    }
}

/// A material's specular lobe.
pub fn lobe_of(material: &Material) -> Lobe {
    match material.model {
        ReflectionModel::Phong {} => Lobe::new(material.exponent),
        ReflectionModel::Blinn {} => Lobe::blinn(material.exponent),
        ReflectionModel::CookTorrance { roughness, reflectance } => Lobe::cook_torrance(roughness, reflectance),
        ReflectionModel::Lafortune { tangential, normal } => Lobe::lafortune(material.exponent, tangential, normal),
    }
}
