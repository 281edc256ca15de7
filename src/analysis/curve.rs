//! A quantity at a probe that moves: exact, every approximation, point and reference on the same abscissa.

use std::f64::consts::FRAC_1_PI;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Instant;

use glam::{DQuat, DVec3};
use rayon::prelude::*;

use crate::light::{Emitter, Shape, luminance_of};
use crate::math::quadrature::Estimate;
use crate::render::lobe_of;
use crate::scene::{Plot, PlotKind, PlotQuantity, Scene};
use crate::shading::{BoundedResponse, Lobe, Method, Prepared, ShadingPoint};

/// Points that are shaded between two looks at the clock.
const BATCH: usize = 8;

/// The curves of one plot.
#[derive(Clone, Debug, PartialEq)]
pub struct Curves {
    /// Abscissae, in degrees or metres.
    pub x: Vec<f64>,
    /// What the abscissa is, with its unit.
    pub x_label: String,
    /// What the ordinate is, with its unit.
    pub y_label: String,
    /// Whether the abscissa is logarithmic.
    pub logarithmic_x: bool,
    /// What all values are divided by: 1 unless the plot is normalised.
    pub unit: f64,
    /// The exact values.
    pub exact: Vec<f64>,
    /// One a method asked for, in that order.
    pub series: Vec<Series>,
}

/// One method's curve.
#[derive(Clone, Debug, PartialEq)]
pub struct Series {
    /// The method; a light that does not have it is shaded exactly.
    pub method: Method,
    /// Values.
    pub y: Vec<f64>,
    /// The reference's error bound, ±; none for other methods.
    pub band: Option<Vec<f64>>,
    /// `y` − exact.
    pub error: Vec<f64>,
    /// Greatest |error|.
    pub max_error: f64,
    /// Root of the mean squared error.
    pub rms_error: f64,
    /// Measured cost of one point with all lights, ns: the median over batches. Not a number where nobody wants it.
    pub cost_ns: f64,
}

/// The methods that a plot of this scene shows: exact, the approximations that any of its lights has, point, reference.
///
/// Muted lights do not count, and what every light answers exactly is left out.
pub fn methods_for(scene: &Scene) -> Vec<Method> {
    let mut methods = vec![Method::Exact];
    for light in scene.lights.iter().filter(|light| !light.muted) {
        for &method in Method::of(&light.shape) {
            if !methods.contains(&method) {
                methods.push(method);
            }
        }
    }
    methods.sort_by_key(|method| match method {
        Method::Exact => 0,
        Method::Point => 2,
        Method::Reference => 3,
        _ => 1,
    });
    methods
}

/// The probe of a plot at an abscissa: where it is, how it is turned, from where it is seen.
pub fn probe(plot: &Plot, x: f64) -> ShadingPoint {
    let unit = |v: DVec3, otherwise| v.try_normalize().unwrap_or(otherwise);
    let axis = unit(plot.axis, DVec3::Y);
    let normal = unit(plot.normal, DVec3::Z);
    let turned = || DQuat::from_axis_angle(axis, x.to_radians()) * normal;
    let seen_from = |n: DVec3| plot.view.map_or(n, |view| unit(view, n));
    match plot.kind {
        PlotKind::Tilt => {
            let n = turned();
            ShadingPoint { p: plot.position, n, v: seen_from(n) }
        }
        PlotKind::View => ShadingPoint { p: plot.position, n: normal, v: turned() },
        PlotKind::Line | PlotKind::Distance => {
            ShadingPoint { p: plot.position + x * axis, n: normal, v: seen_from(normal) }
        }
    }
}

/// The curves of a plot at `samples` abscissae, at least 2; none when cancelled.
pub fn curves(scene: &Scene, plot: &Plot, methods: &[Method], samples: usize, cancel: &AtomicBool) -> Option<Curves> {
    let sampling = Sampling::new(scene, plot, samples);
    let mut curves = sampling.exact(cancel)?;
    let exact = std::mem::take(&mut curves.series);
    for &method in methods {
        match method {
            Method::Exact => curves.series.extend(exact.iter().cloned()),
            _ => curves.series.push(sampling.series(method, &curves, cancel)?),
        }
    }
    Some(curves)
}

/// A plot whose curves are computed one by one.
#[derive(Debug)]
pub struct Sampling {
    x: Vec<f64>,
    logarithmic_x: bool,
    points: Vec<ShadingPoint>,
    subject: Subject,
    plot: Plot,
}

impl Sampling {
    /// The plot at `samples` abscissae, at least 2.
    pub fn new(scene: &Scene, plot: &Plot, samples: usize) -> Self {
        let logarithmic_x = plot.kind == PlotKind::Distance && plot.range.iter().all(|x| *x > 0.0);
        let x = abscissae(plot.range, samples.max(2), logarithmic_x);
        let points = x.iter().map(|&x| probe(plot, x)).collect();
        Self { x, logarithmic_x, points, subject: Subject::new(scene, plot), plot: plot.clone() }
    }

    /// The same for a first look: see [`Prepared::for_pictures`].
    pub fn coarse(mut self) -> Self {
        self.subject.for_pictures = true;
        self
    }

    /// The exact curve, the only series for now; none when cancelled.
    pub fn exact(&self, cancel: &AtomicBool) -> Option<Curves> {
        let sweep = self.subject.sweep(Method::Exact, &self.points, cancel)?;
        let unit = if self.plot.normalise { greatest(&sweep.y) } else { 1.0 };
        let exact: Vec<f64> = sweep.y.iter().map(|y| y / unit).collect();
        Some(Curves {
            x: self.x.clone(),
            x_label: x_label(self.plot.kind).to_owned(),
            y_label: y_label(&self.plot).to_owned(),
            logarithmic_x: self.logarithmic_x,
            unit,
            series: vec![sweep.compare(Method::Exact, &exact, unit)],
            exact,
        })
    }

    /// The curve of a method beside the exact one of [`Self::exact`]; none when cancelled.
    pub fn series(&self, method: Method, beside: &Curves, cancel: &AtomicBool) -> Option<Series> {
        Some(self.subject.sweep(method, &self.points, cancel)?.compare(method, &beside.exact, beside.unit))
    }
}

/// Equal steps, or equal ratios, from the first to the last of a range.
fn abscissae([first, last]: [f64; 2], samples: usize, logarithmic: bool) -> Vec<f64> {
    let steps = (samples - 1) as f64;
    let at = |i: usize| match (i, i as f64 / steps) {
        (0, _) => first,
        (i, _) if i + 1 == samples => last,
        (_, share) if logarithmic => first * (last / first).powf(share),
        (_, share) => first + share * (last - first),
    };
    (0..samples).map(at).collect()
}

fn greatest(values: &[f64]) -> f64 {
    let greatest = values.iter().copied().fold(0.0, f64::max);
    if greatest > 0.0 { greatest } else { 1.0 }
}

fn x_label(kind: PlotKind) -> &'static str {
    match kind {
        PlotKind::Tilt => "Tilt of the normal (°)",
        PlotKind::View => "Eye from the normal (°)",
        PlotKind::Line => "Position along the axis (m)",
        PlotKind::Distance => "Distance along the axis (m)",
    }
}

fn y_label(plot: &Plot) -> &'static str {
    match (plot.quantity, plot.normalise) {
        (PlotQuantity::Irradiance, false) => "Illuminance (lx)",
        (PlotQuantity::Specular, false) => "Specular luminance, k_s = 1 (cd/m²)",
        (PlotQuantity::Radiance, false) => "Luminance (cd/m²)",
        (PlotQuantity::Irradiance, true) => "Illuminance / greatest exact",
        (PlotQuantity::Specular, true) => "Specular luminance / greatest exact",
        (PlotQuantity::Radiance, true) => "Luminance / greatest exact",
    }
}

/// What is measured: the lights, and how a response becomes the quantity.
#[derive(Debug)]
struct Subject {
    lights: Vec<(Emitter, Shape, f64)>,
    lobe: Lobe,
    per_irradiance: f64,
    per_specular: f64,
    for_pictures: bool,
}

/// One method's values, before they are compared.
struct Sweep {
    y: Vec<f64>,
    bound: Vec<f64>,
    cost_ns: f64,
}

impl Subject {
    fn new(scene: &Scene, plot: &Plot) -> Self {
        let named = plot.material.as_deref().and_then(|name| scene.material(name));
        let material = named.or_else(|| scene.materials.first());
        let (per_irradiance, per_specular) = match plot.quantity {
            PlotQuantity::Irradiance => (1.0, 0.0),
            PlotQuantity::Specular => (0.0, 1.0),
            PlotQuantity::Radiance => material.map_or((0.0, 0.0), |material| {
                (FRAC_1_PI * luminance_of(material.diffuse), luminance_of(material.specular))
            }),
        };
        let lights = scene.lights.iter().filter(|light| !light.muted);
        Self {
            lights: lights
                .flat_map(|light| {
                    let parts = light.parts().into_iter();
                    parts.map(|(emitter, weight)| (emitter, light.shape.clone(), luminance_of(weight)))
                })
                .collect(),
            lobe: material.map_or_else(|| Lobe::new(1.0), lobe_of),
            per_irradiance,
            per_specular,
            for_pictures: false,
        }
    }

    /// The quantity at one point, with the reference's own bound; other methods state none. None when cancelled.
    fn value(&self, lights: &[(Prepared, f64)], at: &ShadingPoint, cancel: &AtomicBool) -> Option<Estimate> {
        let mut sum = Estimate::default();
        for (light, strength) in lights {
            let BoundedResponse { irradiance, specular } = light.respond_unless(at, &self.lobe, cancel)?;
            sum = sum + (irradiance * self.per_irradiance + specular * self.per_specular) * *strength;
        }
        Some(sum)
    }

    /// One method at every point; none when cancelled.
    fn sweep(&self, method: Method, points: &[ShadingPoint], cancel: &AtomicBool) -> Option<Sweep> {
        let prepare = |(emitter, shape, strength): &(Emitter, Shape, f64)| {
            let light = Prepared::new(emitter, method.for_shape(shape));
            (if self.for_pictures { light.for_pictures() } else { light }, *strength)
        };
        if cancel.load(Ordering::Relaxed) {
            return None;
        }
        let lights: Vec<_> = self.lights.iter().map(prepare).collect();
        let batch = |batch: &[ShadingPoint]| {
            let start = Instant::now();
            let values: Option<Vec<Estimate>> = batch.iter().map(|at| self.value(&lights, at, cancel)).collect();
            Some((values?, 1e9 * start.elapsed().as_secs_f64() / batch.len() as f64))
        };
        let batches: Option<Vec<_>> = points.par_chunks(BATCH).map(batch).collect();
        let (values, costs): (Vec<_>, Vec<_>) = batches?.into_iter().unzip();
        let (y, bound) = values.concat().iter().map(|estimate| (estimate.value, estimate.error)).unzip();
        Some(Sweep { y, bound, cost_ns: median(costs) })
    }
}

impl Sweep {
    /// The curve in multiples of `unit`, and its errors against `exact`, which is in these already.
    fn compare(self, method: Method, exact: &[f64], unit: f64) -> Series {
        let y: Vec<f64> = self.y.iter().map(|y| y / unit).collect();
        let error: Vec<f64> = y.iter().zip(exact).map(|(y, exact)| y - exact).collect();
        let squares: f64 = error.iter().map(|error| error * error).sum();
        Series {
            method,
            band: (method == Method::Reference).then(|| self.bound.iter().map(|bound| bound / unit).collect()),
            max_error: error.iter().fold(0.0, |greatest, error| error.abs().max(greatest)),
            rms_error: (squares / error.len() as f64).sqrt(),
            cost_ns: self.cost_ns,
            y,
            error,
        }
    }
}

fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    values.get(values.len() / 2).copied().unwrap_or(0.0)
}

#[cfg(test)]
#[path = "curve_tests.rs"]
mod tests;
