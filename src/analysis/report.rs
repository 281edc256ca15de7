//! For each light and method: how far off it is over the ground, and what it costs.

use std::hint::black_box;
use std::sync::Arc;
use std::time::{Duration, Instant};

use glam::DVec3;
use rayon::prelude::*;

use super::Ground;
use crate::light::{Light, Point, Shape, luminance_of};
use crate::render::{Lighting, MethodChoice, Outgoing, Progress, Reflection, Shadows};
use crate::scene::Scene;
use crate::shading::{Method, ShadingPoint};
use crate::surface::Material;
use crate::visibility::Objects;

/// Points whose cost is measured.
const TIMED_POINTS: usize = 256;

/// Runs of which the fastest counts.
const RUNS: usize = 9;

/// A method that has taken this long is not run again.
const TIMED_ENOUGH: Duration = Duration::from_millis(150);

/// One light by one method.
#[derive(Clone, Debug, PartialEq)]
pub struct Entry {
    /// Name of the light.
    pub light: String,
    /// Its shape.
    pub shape: &'static str,
    /// The method.
    pub method: Method,
    /// E, lx.
    pub diffuse: Deviation,
    /// The specular part of L_out for k_s = 1, cd/m².
    pub specular: Deviation,
    /// Cost of a point, diffuse and specular together, on one thread, ns: the fastest of several runs.
    pub cost_ns: f64,
    /// That cost as a multiple of a point light's, measured in the same runs.
    pub cost_in_point_lights: f64,
}

/// How far a quantity is from the exact one.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Deviation {
    /// The greatest exact value.
    pub peak: f64,
    /// Root of the mean squared error.
    pub rms: f64,
    /// The error of greatest magnitude, with its sign.
    pub worst: f64,
    /// Where that is.
    pub at: DVec3,
}

impl Deviation {
    /// RMS and worst error as shares of the peak; 0 where the peak is.
    pub fn relative(&self) -> [f64; 2] {
        [self.rms, self.worst].map(|error| if self.peak > 0.0 { error / self.peak } else { 0.0 })
    }
}

/// The lights of a scene that shine, and the methods of each.
pub fn subjects(scene: &Scene) -> Vec<(&Light, Vec<Method>)> {
    let lights = scene.lights.iter().filter(|light| !light.muted);
    lights.map(|light| (light, Method::of(&light.shape).to_vec())).collect()
}

/// Every light by every method that it has; none when cancelled. Each of these is one step of progress.
///
/// Lights are measured alone, at their strength and in white, with the shadows of the scene's surfaces.
pub fn report(scene: &Scene, ground: &Ground, shadows: Shadows, progress: &Progress) -> Option<Vec<Entry>> {
    let objects = match shadows {
        Shadows::None => None,
        Shadows::Cast(structure) => Some(Arc::new(Objects::new(&scene.surfaces, structure))),
    };
    let mut entries = Vec::new();
    for (light, methods) in subjects(scene) {
        let subject = Subject::new(light, ground, objects.clone());
        let exact = subject.sweep(Method::Exact, progress)?;
        let mut deviations = Vec::new();
        for &method in &methods {
            let values = if method == Method::Exact { exact.clone() } else { subject.sweep(method, progress)? };
            deviations.push(subject.deviations(&values, &exact));
            progress.advance(1);
        }
        let costs = subject.costs(&methods, progress)?;
        let measured = methods.into_iter().zip(deviations).zip(costs);
        entries.extend(measured.map(|((method, [diffuse, specular]), (cost_ns, cost_in_point_lights))| Entry {
            light: light.name.clone(),
            shape: light.shape.name(),
            method,
            diffuse,
            specular,
            cost_ns,
            cost_in_point_lights,
        }));
    }
    Some(entries)
}

/// One light over the ground.
struct Subject<'a> {
    light: &'a Light,
    reflection: Reflection,
    points: &'a [ShadingPoint],
    /// What casts shadows.
    objects: Option<Arc<Objects>>,
}

impl<'a> Subject<'a> {
    fn new(light: &'a Light, ground: &'a Ground, objects: Option<Arc<Objects>>) -> Self {
        let material = Material { diffuse: DVec3::ZERO, specular: DVec3::ONE, ..ground.material.clone() };
        Self { light, reflection: Reflection::new(&material), points: &ground.points, objects }
    }

    /// E and S at every point by a method; none when cancelled.
    fn sweep(&self, method: Method, progress: &Progress) -> Option<Vec<[f64; 2]>> {
        let lighting = self.alone(self.light.clone(), method);
        let values = self.points.par_iter().map(|at| {
            let Outgoing { irradiance, radiance } = lighting.outgoing(&self.reflection, at);
            (!progress.is_cancelled()).then(|| [irradiance, radiance].map(luminance_of))
        });
        values.collect()
    }

    /// How far E and S are off.
    fn deviations(&self, values: &[[f64; 2]], exact: &[[f64; 2]]) -> [Deviation; 2] {
        [0, 1].map(|quantity| {
            let mut deviation = Deviation::default();
            let mut squares = 0.0;
            for ((value, exact), at) in values.iter().zip(exact).zip(self.points) {
                let error = value[quantity] - exact[quantity];
                squares += error * error;
                deviation.peak = deviation.peak.max(exact[quantity]);
                if error.abs() > deviation.worst.abs() {
                    (deviation.worst, deviation.at) = (error, at.p);
                }
            }
            deviation.rms = (squares / values.len().max(1) as f64).sqrt();
            deviation
        })
    }

    /// Cost of a point by each method, in ns and in point lights; none when cancelled.
    ///
    /// The runs of all methods and of the point light alternate, so that a busy spell of the machine hits all alike.
    fn costs(&self, methods: &[Method], progress: &Progress) -> Option<Vec<(f64, f64)>> {
        let bulb = Light { position: self.light.position, ..Light::new("", Shape::Point(Point::default())) };
        let step = self.points.len().div_ceil(TIMED_POINTS).max(1);
        let points: Vec<_> = self.points.iter().step_by(step).copied().collect();
        let subjects = methods.iter().map(|&method| self.alone(self.light.clone(), method));
        let lightings: Vec<_> = std::iter::once(self.alone(bulb, Method::Exact)).chain(subjects).collect();
        let mut fastest = vec![Duration::MAX; lightings.len()];
        let mut spent = vec![Duration::ZERO; lightings.len()];
        for _ in 0..RUNS {
            for (i, lighting) in lightings.iter().enumerate() {
                if progress.is_cancelled() {
                    return None;
                }
                if spent[i] >= TIMED_ENOUGH {
                    continue;
                }
                let start = Instant::now();
                for at in &points {
                    black_box(lighting.outgoing(black_box(&self.reflection), black_box(at)));
                }
                let taken = start.elapsed();
                fastest[i] = fastest[i].min(taken);
                spent[i] += taken;
            }
        }
        let ns = |taken: &Duration| 1e9 * taken.as_secs_f64() / points.len().max(1) as f64;
        let (bulb, methods) = fastest.split_first()?;
        Some(methods.iter().map(|taken| (ns(taken), ns(taken) / ns(bulb).max(f64::MIN_POSITIVE))).collect())
    }

    /// A light on its own, by a method.
    fn alone(&self, light: Light, method: Method) -> Lighting {
        let scene = Scene { lights: vec![light], ..Scene::default() };
        let lighting = Lighting::new(&scene, MethodChoice::Method(method));
        match &self.objects {
            Some(objects) => lighting.with_shadows(objects),
            None => lighting,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn entries() -> (Scene, Ground, Vec<Entry>) {
        let scene = crate::scene::first_light();
        let ground = Ground::new(&scene, 150).unwrap();
        let entries = report(&scene, &ground, Shadows::None, &Progress::default()).unwrap();
        (scene, ground, entries)
    }

    #[test]
    fn every_light_has_a_row_for_each_of_its_methods() {
        let (scene, _, entries) = entries();
        let expected: usize = subjects(&scene).iter().map(|(_, methods)| methods.len()).sum();
        assert_eq!(entries.len(), expected, "{entries:?}");
        assert!(entries.iter().all(|entry| entry.cost_ns > 0.0 && entry.cost_in_point_lights > 0.0), "{entries:?}");
    }

    #[test]
    fn exact_has_no_error_and_a_point_light_has_the_error_that_its_values_show() {
        let (scene, ground, entries) = entries();
        let of = |method| entries.iter().find(|entry| entry.method == method).unwrap();
        let exact = of(Method::Exact);
        assert_eq!([exact.diffuse.rms, exact.specular.worst], [0.0; 2], "{exact:?}");
        assert!(exact.diffuse.peak > 0.0 && exact.specular.peak > 0.0, "{exact:?}");
        let point = of(Method::Point);
        let light = &scene.lights[0];
        let values = |method| {
            let reflection = Reflection::new(&ground.material);
            let alone = Scene { lights: vec![light.clone()], ..Scene::default() };
            let lighting = Lighting::new(&alone, MethodChoice::Method(method));
            ground.points.iter().map(move |at| luminance_of(lighting.outgoing(&reflection, at).irradiance))
        };
        let errors: Vec<f64> = values(Method::Point).zip(values(Method::Exact)).map(|(a, b)| a - b).collect();
        let worst = errors.iter().copied().fold(0.0, |worst: f64, x| if x.abs() > worst.abs() { x } else { worst });
        let rms = (errors.iter().map(|x| x * x).sum::<f64>() / errors.len() as f64).sqrt();
        assert!((point.diffuse.worst - worst).abs() <= 1e-9 * worst.abs(), "{point:?} is not {worst}");
        assert!((point.diffuse.rms - rms).abs() <= 1e-9 * rms, "{point:?} is not {rms}");
        let place = errors.iter().position(|error| *error == worst).unwrap();
        assert_eq!(point.diffuse.at, ground.points[place].p, "where the worst is");
    }

    #[test]
    fn relative_errors_are_of_the_peak() {
        let deviation = Deviation { peak: 50.0, rms: 1.0, worst: -5.0, at: DVec3::ZERO };
        assert_eq!(deviation.relative(), [0.02, -0.1], "shares");
        assert_eq!(Deviation::default().relative(), [0.0; 2], "in the dark");
    }

    #[test]
    fn a_cancelled_report_is_none() {
        let (scene, ground, _) = entries();
        let progress = Progress::default();
        progress.cancel();
        assert_eq!(report(&scene, &ground, Shadows::default(), &progress), None, "cancelled");
    }
}
