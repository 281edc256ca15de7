//! The stage on which a light preset is shown in its thumbnail.

use glam::DVec3;

use crate::light::Shape;
use crate::math::frame::{deg_from_rotation, facing};
use crate::render::Film;
use crate::render::bounds::{Ball, light_points};
use crate::scene::{Camera, Scene};
use crate::surface::{self, Material, ReflectionModel, Surface};

/// The brightness that three quarters of what is lit in a thumbnail stay below, as a share of white.
const KEY: f64 = 0.5;
/// Where the light hangs, for a light of radius 1 m.
const LIGHT: DVec3 = DVec3::new(-1.9, 0.7, 2.3);
/// Where the ball lies then; its radius is its height.
const BALL: DVec3 = DVec3::new(0.3, 0.0, 0.75);

/// What is rendered for a scene's thumbnail: the scene itself, or a preset's lights over a floor with a ball.
pub(super) fn staged(scene: &Scene) -> Scene {
    if !scene.surfaces.is_empty() {
        return scene.clone();
    }
    let mut staged = Scene { lights: scene.lights.clone(), ..Scene::default() };
    staged.materials = vec![material("floor", 0.45, 0.05), material("ball", 0.5, 0.2)];
    let is_near = |shape: &Shape| !matches!(shape, Shape::Sky(_) | Shape::Cap(_) | Shape::Directional(_));
    let near = scene.lights.iter().filter(|light| is_near(&light.shape));
    let size = match Ball::around(near.flat_map(light_points)) {
        None => 0.5,
        Some(ball) => {
            // Near lights move together, to hang to the left of the ball, a little behind it, and face it.
            let size = ball.radius.clamp(0.08, 2.0);
            let by = size * LIGHT - ball.center;
            for light in staged.lights.iter_mut().filter(|light| is_near(&light.shape)) {
                light.position += by;
                if scene.lights.len() == 1 {
                    light.rotation_deg = deg_from_rotation(facing((LIGHT - BALL).normalize()));
                }
            }
            size
        }
    };
    staged.surfaces = vec![
        surface("floor", DVec3::ZERO, surface::Shape::Plane {}),
        surface("ball", size * BALL, surface::Shape::Sphere { radius: size * BALL.z }),
    ];
    staged.camera =
        Camera { eye: size * DVec3::new(0.5, -6.6, 2.4), target: size * DVec3::new(-0.55, 0.0, 1.25), fov_deg: 40.0 };
    staged
}

/// Steps of exposure that bring what is lit below white, but for the light itself and what is next to it.
pub(super) fn exposure(film: &Film) -> f64 {
    let mut lit: Vec<f64> =
        film.radiance().iter().map(|radiance| radiance.max_element()).filter(|value| *value > 0.0).collect();
    lit.sort_by(f64::total_cmp);
    let bright = lit.get(lit.len() * 3 / 4).or(lit.last()).copied().unwrap_or(100.0);
    // What leaves a surface at 100 cd/m² is white at exposure 0.
    (100.0 * KEY / bright).log2()
}

fn material(name: &str, diffuse: f64, specular: f64) -> Material {
    Material {
        name: name.to_owned(),
        diffuse: DVec3::splat(diffuse),
        specular: DVec3::splat(specular),
        model: ReflectionModel::default(),
        exponent: 60.0,
    }
}

fn surface(name: &str, position: DVec3, shape: surface::Shape) -> Surface {
    Surface {
        name: name.to_owned(),
        material: name.to_owned(),
        position,
        rotation_deg: DVec3::ZERO,
        scale: DVec3::ONE,
        shape,
    }
}
