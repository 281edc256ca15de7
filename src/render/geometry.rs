//! What of a scene a ray meets first.

use std::sync::Arc;

use glam::DVec3;

use super::emitters::{PlacedEmitter, distant_luminance, intersect_emitter};
use crate::light::Emitter;
use crate::scene::Scene;
use crate::shading::ShadingPoint;
use crate::visibility::{Objects, Structures};

/// The surfaces of a scene and its visible emitters, prepared for rays.
#[derive(Clone, Debug)]
pub struct Geometry {
    objects: Arc<Objects>,
    /// Of each surface.
    materials: Vec<Option<usize>>,
    emitters: Vec<(usize, PlacedEmitter, DVec3)>,
    /// Caps and skies, with their weights.
    distant: Vec<(Emitter, DVec3)>,
}

/// The nearest thing along a ray.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Seen {
    /// Distance from the origin, in lengths of the direction.
    pub t: f64,
    /// The point.
    pub p: DVec3,
    /// Unit normal: outward on a surface, towards the eye on an emitter.
    pub n: DVec3,
    /// What is seen.
    pub thing: Thing,
}

/// What a ray meets.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Thing {
    /// The surface of that index in the scene.
    Surface(usize),
    /// The light of that index in the scene.
    Light(usize),
}

impl Seen {
    /// The point as one to shade, met by a ray of unit direction: its normal is turned towards the ray's origin.
    pub fn shading_point(&self, direction: DVec3) -> ShadingPoint {
        let v = -direction;
        ShadingPoint { p: self.p, n: if self.n.dot(v) < 0.0 { -self.n } else { self.n }, v }
    }
}

impl Geometry {
    /// All surfaces of the scene, and those of its lights that have an area and are not muted.
    pub fn new(scene: &Scene) -> Self {
        Self::with_structures(scene, Structures::default())
    }

    /// The same, found by these structures.
    pub fn with_structures(scene: &Scene, structures: Structures) -> Self {
        let material = |name: &String| scene.materials.iter().position(|material| material.name == *name);
        let emitters = scene.lights.iter().enumerate().filter(|(_, light)| !light.muted);
        let lines = scene.lights.iter().filter_map(|light| match light.emitter() {
            Emitter::Line(line) => Some([line.a, line.b]),
            _ => None,
        });
        let distant = emitters.clone().map(|(_, light)| (light.emitter(), light.weight()));
        Self {
            objects: Arc::new(Objects::new(&scene.surfaces, structures).for_lines(lines)),
            materials: scene.surfaces.iter().map(|surface| material(&surface.material)).collect(),
            emitters: emitters
                .filter_map(|(i, light)| Some((i, PlacedEmitter::of_light(light)?, light.weight())))
                .collect(),
            distant: distant.filter(|(emitter, _)| matches!(emitter, Emitter::Cap(_) | Emitter::Sky(_))).collect(),
        }
    }

    /// Index of the material of a surface.
    pub fn material(&self, surface: usize) -> Option<usize> {
        *self.materials.get(surface)?
    }

    /// The surfaces, as what casts shadows.
    pub fn objects(&self) -> &Arc<Objects> {
        &self.objects
    }

    /// Radiance of a point of a light's own surface, cd/m².
    pub fn emitted(&self, light: usize, p: DVec3) -> DVec3 {
        let placed = self.emitters.iter().find(|(i, _, _)| *i == light);
        placed.map_or(DVec3::ZERO, |(_, emitter, weight)| emitter.luminance(p) * *weight)
    }

    /// Radiance of caps and skies in a direction, cd/m².
    pub fn background(&self, direction: DVec3) -> DVec3 {
        self.distant.iter().map(|(emitter, weight)| distant_luminance(emitter, direction) * weight).sum()
    }

    /// The nearest thing in front of `origin`; of things equally near, a surface, then the first.
    pub fn nearest(&self, origin: DVec3, direction: DVec3) -> Option<Seen> {
        let mut nearest = self.objects.nearest(origin, direction).map(|(object, hit)| {
            let thing = Thing::Surface(self.objects.surface_of(object));
            Seen { t: hit.t, p: hit.p, n: hit.n, thing }
        });
        for (i, emitter, _) in &self.emitters {
            if let Some(t) = intersect_emitter(emitter, origin, direction)
                && nearest.is_none_or(|seen| t < seen.t)
            {
                let thing = Thing::Light(*i);
                nearest = Some(Seen { t, p: origin + t * direction, n: -direction.normalize_or_zero(), thing });
            }
        }
        nearest
    }
}
