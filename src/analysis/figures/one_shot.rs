//! The maps and tables of [`crate::refs::ONE_SHOT`]: the factors α and β of a light, and how far one-shot is off.

use std::f64::consts::{FRAC_PI_2, TAU};

use crate::analysis::chart::{Body, Chart, Map, Panel, Table};
use crate::render::Progress;
use crate::scene::Scene;
use crate::shading::one_shot::{
    Component, Fit, Grid, Kernel, Prefiltered, Sample, Samples, error_at, fit, sized_radius,
};

/// Points of view of the maps.
const VIEWS: Samples = Samples { heights: 30, tilts: 19, azimuths: 1 };

/// Points of view of the tables that face the light.
const FACING: Samples = Samples { heights: 120, tilts: 1, azimuths: 1 };

/// The exponent of the paper's figure 6.
const EXPONENT: f64 = 3.0;

/// Figure 4: α of a uniform disk, and the error of its mean. None when cancelled.
pub fn one_shot_4(progress: &Progress) -> Option<Chart> {
    maps(Component::Diffuse, "α", "One-shot's diffuse part of a uniform disk (One-Shot, figure 4)", progress)
}

/// Figure 6: β of a uniform disk, and the error of its mean. None when cancelled.
pub fn one_shot_6(progress: &Progress) -> Option<Chart> {
    let component = Component::Specular(EXPONENT);
    maps(component, "β", "One-shot's specular part of a uniform disk, n = 3 (One-Shot, figure 6)", progress)
}

/// The factors of a uniform disk and their errors: of the paper, of all its points of view, of those that face the
/// light, and of the radius that knows the light's size. None when cancelled.
pub fn one_shot_disk(progress: &Progress) -> Option<Table> {
    let pattern = Prefiltered::new(Grid::of_disk());
    let diffuse = of_component(&pattern, Component::Diffuse, 0.30, progress)?;
    let specular = of_component(&pattern, Component::Specular(EXPONENT), 0.57, progress)?;
    let facing = |component: Component| {
        let (mean, fit) = (component, fit(&pattern, Kernel::Disk, component, FACING));
        row(mean, "facing only", Some(fit.mean), &errors(mean, fit.samples.iter().map(|sample| sample.error)))
    };
    let facing = [Component::Diffuse, Component::Specular(EXPONENT), Component::Specular(2.0)].map(facing);
    Some(Table {
        heading: ["component", "radius", "factor", "mean_error", "worst_error"].map(String::from).into(),
        rows: diffuse.into_iter().chain(specular).chain(facing).collect(),
    })
}

/// α and β of the lights of scenes, by name: those of the disk kernel. None when cancelled.
pub fn one_shot_lights(scenes: &[(&str, &Scene)], progress: &Progress) -> Option<Table> {
    let mut rows = Vec::new();
    for (name, scene) in scenes {
        for (i, (emitter, _)) in scene.lights.iter().flat_map(crate::light::Light::parts).enumerate() {
            if progress.is_cancelled() {
                return None;
            }
            let Some((_, pattern)) = Prefiltered::of(&emitter) else { continue };
            let beta = EXPONENT * pattern.specular_share(Kernel::Disk, EXPONENT);
            let factors = [pattern.alpha(Kernel::Disk), beta].map(|factor| format!("{factor:.3}"));
            rows.push([(*name).to_owned(), i.to_string()].into_iter().chain(factors).collect());
        }
    }
    Some(Table { heading: ["scene", "part", "alpha", "beta_of_3"].map(String::from).into(), rows })
}

/// The factor over height and tilt, and the error of its mean.
fn maps(component: Component, symbol: &str, title: &str, progress: &Progress) -> Option<Chart> {
    if progress.is_cancelled() {
        return None;
    }
    let fit = fit(&Prefiltered::new(Grid::of_disk()), Kernel::Disk, component, VIEWS);
    let unit = whole(component);
    let [mean, worst] = errors(component, fit.samples.iter().map(|sample| sample.error));
    let factor = format!("{symbol}; mean {:.3}", fit.mean);
    let error = format!("error with {symbol} = {:.3}; mean {mean:.3}, worst {worst:.3}", fit.mean);
    let panels = vec![
        panel(&factor, &fit, symbol, |sample| sample.factor),
        panel(&error, &fit, "|error| as a share of a light that fills all that is seen", |sample| {
            sample.error.abs() / unit
        }),
    ];
    (!progress.is_cancelled()).then(|| Chart { title: title.to_owned(), panels })
}

fn panel(title: &str, fit: &Fit, label: &str, value: impl Fn(&Sample) -> f64) -> Panel {
    let columns = VIEWS.tilts as usize;
    let half_cell = 0.5 * FRAC_PI_2.to_degrees() / (columns - 1) as f64;
    Panel {
        title: title.to_owned(),
        x_label: "angle from facing the light (°)".to_owned(),
        y_label: "distance (diameters)".to_owned(),
        body: Body::Map(Map {
            x: [-half_cell, 90.0 + half_cell],
            y: [0.0, 5.0],
            columns,
            values: fit.samples.iter().map(value).collect(),
            label: label.to_owned(),
        }),
    }
}

/// The rows of a component over all points of view.
fn of_component(
    pattern: &Prefiltered,
    component: Component,
    papers: f64,
    progress: &Progress,
) -> Option<[Vec<String>; 3]> {
    if progress.is_cancelled() {
        return None;
    }
    let fit = fit(pattern, Kernel::Disk, component, VIEWS);
    let with = |radius: &dyn Fn(f64) -> f64| {
        let error = |sample| error_at(pattern, Kernel::Disk, component, sample, radius);
        errors(component, fit.samples.iter().map(error))
    };
    let unit = if let Component::Specular(n) = component { n } else { 1.0 };
    Some([
        row(component, "the paper's", Some(papers), &with(&|distance| papers / unit * distance)),
        row(component, "fitted", Some(fit.mean), &with(&|distance| fit.mean / unit * distance)),
        row(
            component,
            "by the light's size",
            None,
            &with(&|distance| sized_radius(distance, pattern.radius(), component)),
        ),
    ])
}

/// Mean and greatest |error| as shares of a light that fills all that is seen.
fn errors(component: Component, errors: impl ExactSizeIterator<Item = f64>) -> [f64; 2] {
    let count = errors.len().max(1) as f64;
    let (sum, worst) = errors.fold((0.0, 0.0_f64), |(sum, worst), error| (sum + error.abs(), worst.max(error.abs())));
    [sum / count, worst].map(|error| error / whole(component))
}

/// ∫ cosⁿ dω over the hemisphere.
fn whole(component: Component) -> f64 {
    TAU / (component.exponent() + 1.0)
}

fn row(component: Component, radius: &str, factor: Option<f64>, errors: &[f64; 2]) -> Vec<String> {
    let component = match component {
        Component::Diffuse => "diffuse".to_owned(),
        Component::Specular(n) => format!("specular, n = {n}"),
    };
    let factor = factor.map_or_else(String::new, |factor| format!("{factor:.3}"));
    let errors = errors.map(|error| format!("{error:.3}"));
    [component, radius.to_owned(), factor].into_iter().chain(errors).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The number in a column of the rows that begin with a component and a radius.
    fn cell(table: &Table, component: &str, radius: &str, column: usize) -> f64 {
        let row = table.rows.iter().find(|row| row[0] == component && row[1] == radius).unwrap();
        row[column].parse().unwrap()
    }

    #[test]
    fn the_papers_factors_are_those_of_facing_points_of_view() {
        let table = one_shot_disk(&Progress::default()).unwrap();
        // Facing, r is α|pt| where πr²/h² = π/(1 + 4h²), h in diameters: the mean of α over 0…5 is asinh(10)/10.
        let alpha = 10_f64.asinh() / 10.0;
        assert!((cell(&table, "diffuse", "facing only", 2) - alpha).abs() < 2e-3, "{table:?}");
        // Of n = 2 by quadrature of √(2/3·(1 − (1 + 1/(4h²))^(−3/2)))·2 over 0…5.
        assert!((cell(&table, "specular, n = 2", "facing only", 2) - 0.5684).abs() < 2e-3, "{table:?}");
    }

    #[test]
    fn the_fitted_factor_is_better_than_the_papers_and_the_lights_size_better_still() {
        let table = one_shot_disk(&Progress::default()).unwrap();
        for component in ["diffuse", "specular, n = 3"] {
            for column in [3, 4] {
                let [size, fitted, papers] = ["by the light's size", "fitted", "the paper's"]
                    .map(|radius| cell(&table, component, radius, column));
                assert!(size < fitted && fitted < papers, "{component}: {table:?}");
            }
        }
    }

    #[test]
    fn maps_have_a_value_for_every_point_of_view() {
        for chart in [one_shot_4(&Progress::default()), one_shot_6(&Progress::default())] {
            for panel in chart.unwrap().panels {
                let Body::Map(map) = panel.body else { panic!("{} is a map", panel.title) };
                assert_eq!([map.columns, map.rows()], [19, 30], "{}", panel.title);
                assert!(map.values.iter().all(|value| value.is_finite() && *value >= 0.0), "{}", panel.title);
            }
        }
    }

    #[test]
    fn a_lights_factors_are_those_of_its_own_pattern() {
        let mut scene = crate::scene::first_light();
        let disk = crate::light::Shape::Disk(crate::light::Disk { radius: 0.5, two_sided: false });
        scene.lights = vec![crate::light::Light::new("disk", disk)];
        let table = one_shot_lights(&[("a disk", &scene)], &Progress::default()).unwrap();
        assert_eq!(table.rows.len(), 1, "{table:?}");
        let alpha: f64 = table.rows[0][2].parse().unwrap();
        assert!(table.rows[0][0] == "a disk" && (0.37..0.43).contains(&alpha), "{table:?}");
    }

    #[test]
    fn cancelled_work_gives_nothing() {
        let progress = Progress::default();
        progress.cancel();
        assert_eq!((one_shot_4(&progress), one_shot_disk(&progress)), (None, None), "cancelled");
    }
}
