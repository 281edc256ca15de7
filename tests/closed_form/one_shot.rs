//! One-shot: its fits, its table, its errors.

use std::sync::Arc;

use glam::DVec3;
use softbox::light::{DiskEmitter, Emitter};
use softbox::shading::one_shot::{Component, Fit, Kernel, Prefiltered, Samples, error_at, fit, sized_radius};

/// A uniform disk.
fn disk() -> Arc<Prefiltered> {
    let light = DiskEmitter { center: DVec3::ZERO, normal: -DVec3::Z, radius: 1.0, two_sided: false };
    Prefiltered::of(&Emitter::Disk(light)).expect("a disk is flat").1
}

/// The paper's description, finely.
const DESCRIBED: Samples = Samples { heights: 50, tilts: 31, azimuths: 1 };
/// Of it the points of view that face the light.
const FACING: Samples = Samples { tilts: 1, ..DESCRIBED };

#[track_caller]
fn check(what: &str, x: f64, [least, most]: [f64; 2]) {
    assert!((least..=most).contains(&x), "{what} is {x}, not {least} to {most}");
}

#[test]
fn factors_of_a_uniform_disk_are_those_of_the_described_points_of_view() {
    let disk = disk();
    let of = |component, samples| fit(&disk, Kernel::Disk, component, samples);
    let alpha = of(Component::Diffuse, DESCRIBED);
    check("α", alpha.mean, [0.39, 0.40]);
    let (least, most) =
        alpha.samples.iter().fold((1.0_f64, 0.0_f64), |(a, b), sample| (a.min(sample.factor), b.max(sample.factor)));
    check("the least α", least, [0.10, 0.11]);
    check("the greatest α", most, [0.97, 1.01]);
    check("β for n = 3", of(Component::Specular(3.0), DESCRIBED).mean, [1.28, 1.30]);
    // The paper's own figures are those of facing normals only; asinh(10)/10 = 0.29982 is the first in closed form.
    check("α facing", of(Component::Diffuse, FACING).mean, [0.2995, 0.3]);
    check("β facing for n = 2", of(Component::Specular(2.0), FACING).mean, [0.5675, 0.569]);
    check("α of lights' own fits", disk.alpha(Kernel::Disk), [0.385, 0.40]);
    check("β of lights' own fits for n = 3", 3.0 * disk.specular_share(Kernel::Disk, 3.0), [1.25, 1.30]);
}

#[test]
fn the_square_kernel_has_its_own_factors() {
    let disk = disk();
    for (component, share) in [(Component::Diffuse, 0.93), (Component::Specular(3.0), 0.95)] {
        let [round, square] =
            [Kernel::Disk, Kernel::Square].map(|kernel| fit(&disk, kernel, component, DESCRIBED).mean);
        check(&format!("{component:?}: square over disk"), square / round, [share - 0.01, share + 0.01]);
    }
}

/// Mean and greatest error of a rule for the radius, in texels, over the fit's points of view.
fn errors(disk: &Prefiltered, component: Component, fit: &Fit, radius: impl Fn(f64) -> f64) -> [f64; 2] {
    let sizes = fit.samples.iter().map(|sample| error_at(disk, Kernel::Disk, component, sample, &radius).abs());
    let sizes: Vec<f64> = sizes.collect();
    [sizes.iter().sum::<f64>() / sizes.len() as f64, sizes.iter().copied().fold(0.0, f64::max)]
}

#[test]
fn errors_over_a_uniform_disk_are_as_measured() {
    let disk = disk();
    // Mean and greatest error of the fitted and of the sized radius, of luminance 1; the truth is at most π.
    let measured = [
        (Component::Diffuse, [0.175, 2.60], [0.041, 0.35]),
        (Component::Specular(3.0), [0.075, 1.02], [0.031, 0.36]),
        (Component::Specular(31.0), [0.0115, 0.059], [0.0105, 0.035]),
    ];
    for (component, fitted, sized) in measured {
        let fit = fit(&disk, Kernel::Disk, component, DESCRIBED);
        let of_sized = errors(&disk, component, &fit, |distance| sized_radius(distance, disk.radius(), component));
        let of_fitted = [fit.errors().0, fit.errors().1];
        for (what, errors, most) in [("fitted", of_fitted, fitted), ("sized", of_sized, sized)] {
            for i in 0..2 {
                check(
                    &format!("{component:?}, {what}, {}", ["mean", "greatest"][i]),
                    errors[i],
                    [0.9 * most[i], most[i]],
                );
            }
        }
    }
}
