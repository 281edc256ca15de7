//! One-shot: its fits, its table, its errors.

use std::f64::consts::{PI, TAU};
use std::sync::Arc;

use glam::{DMat3, DVec2, DVec3};
use softbox::light::pattern::Channel;
use softbox::light::{DiskEmitter, Emitter, PolygonEmitter, TexturedEmitter};
use softbox::shading::one_shot::{Component, Fit, Kernel, Prefiltered, Samples, error_at, fit, sized_radius};
use softbox::shading::{Lobe, Method, Prepared, Response, ShadingPoint, respond};

use super::random::Random;

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

/// Black and white squares, 8 a side.
fn checkerboard() -> Emitter {
    let texels = (0..64).map(|i| if (i + i / 8) % 2 == 0 { 1.0 } else { 0.0 }).collect();
    textured(8, texels, DVec3::X, DVec3::Y)
}

/// A pattern of those texels on a rectangle of those sides.
fn textured(width: usize, texels: Vec<f32>, row: DVec3, column: DVec3) -> Emitter {
    let pattern = Arc::new(Channel::new(width, texels).expect("whole rows"));
    let corner = -0.5 * (row + column);
    let normal = row.cross(column).normalize();
    Emitter::Textured(TexturedEmitter { corner, row, column, normal, two_sided: false, pattern })
}

fn pattern_of(emitter: &Emitter) -> Arc<Prefiltered> {
    Prefiltered::of(emitter).expect("a flat light").1
}

#[test]
fn factors_of_a_checkerboard() {
    let pattern = pattern_of(&checkerboard());
    let [alpha, beta] = [Component::Diffuse, Component::Specular(3.0)]
        .map(|component| fit(&pattern, Kernel::Disk, component, DESCRIBED).mean);
    println!("checkerboard: α {alpha}, β {beta}");
    check("α", alpha, [0.41, 0.42]);
    check("β", beta, [1.31, 1.325]);
}

/// Mean and greatest error of the prefiltered sums, of the most that the neighbourhood could hold.
fn table_errors(pattern: &Prefiltered, kernel: Kernel, extent: [f64; 2]) -> [f64; 2] {
    let mut random = Random::new(61);
    let (mut sum, mut worst) = (0.0, 0.0_f64);
    const POINTS: u32 = 4000;
    for _ in 0..POINTS {
        let distance = random.within(extent[0], extent[1]);
        let at = distance * DVec2::from_angle(random.within(0.0, TAU));
        let radius =
            if extent[1] > 64.0 { at.length() * random.within(0.3, 1.5) } else { random.magnitude(1.0, 128.0) };
        let most = (PI * radius * radius).min(pattern.grid().total());
        let error = (pattern.sum(kernel, at, radius) - pattern.true_sum(kernel, at, radius)).abs() / most;
        sum += error;
        worst = worst.max(error);
    }
    [sum / f64::from(POINTS), worst]
}

#[test]
fn interpolation_errors_of_the_tables_are_as_measured() {
    // Mean and greatest, inside and outside the light; outside the disks' radii are few and far between.
    let measured = [(Kernel::Disk, [0.045, 0.3], [0.14, 0.9]), (Kernel::Square, [0.11, 0.6], [0.03, 0.35])];
    for (name, emitter) in [("disk", uniform_disk()), ("checkerboard", checkerboard())] {
        let pattern = pattern_of(&emitter);
        for (kernel, inside, outside) in measured {
            for (where_, extent, most) in [("inside", [0.0, 64.0], inside), ("outside", [65.0, 600.0], outside)] {
                let errors = table_errors(&pattern, kernel, extent);
                println!("{name}, {kernel:?}, {where_}: {errors:.4?}");
                check(&format!("{name}, {kernel:?}, {where_}, mean"), errors[0], [0.0, most[0]]);
                check(&format!("{name}, {kernel:?}, {where_}, greatest"), errors[1], [0.0, most[1]]);
            }
        }
    }
}

#[test]
fn sums_are_exact_where_nothing_varies() {
    let pattern = pattern_of(&textured(1, vec![1.0], DVec3::X, DVec3::Y));
    for (at, radius) in [(DVec2::ZERO, 0.3), (DVec2::new(7.0, -3.2), 1.5), (DVec2::new(20.4, 10.1), 12.9)] {
        for (kernel, area) in [(Kernel::Disk, PI * radius * radius), (Kernel::Square, 4.0 * radius * radius)] {
            let sum = pattern.sum(kernel, at, radius);
            // The disk is drawn with 16 chords a texel.
            assert!((sum / area - 1.0).abs() < 2e-3, "{kernel:?} at {at} of {radius}: {sum} for {area}");
        }
    }
    let total = pattern.grid().total();
    assert!((total - 16384.0).abs() < 1e-6, "the light fills the grid: {total}");
    for at in [DVec2::ZERO, DVec2::new(50.0, -200.0), DVec2::new(3e3, 1e4)] {
        for kernel in [Kernel::Disk, Kernel::Square] {
            let sum = pattern.sum(kernel, at, 2.0 * at.length() + 200.0);
            assert!((sum / total - 1.0).abs() < 1e-9, "{kernel:?} at {at}: {sum} of {total}");
        }
    }
}

const METHODS: [Method; 3] = [Method::OneShot, Method::OneShotSquare, Method::OneShotSized];

/// A light about the origin, turned, moved and scaled.
fn placed(emitter: &Emitter, turn: DMat3, scale: f64, to: DVec3) -> Emitter {
    let point = |x: DVec3| to + scale * (turn * x);
    match emitter {
        Emitter::Textured(light) => Emitter::Textured(TexturedEmitter {
            corner: point(light.corner),
            row: scale * (turn * light.row),
            column: scale * (turn * light.column),
            normal: turn * light.normal,
            ..light.clone()
        }),
        Emitter::Polygon(light) => Emitter::Polygon(PolygonEmitter {
            vertices: light.vertices.iter().map(|vertex| point(*vertex)).collect(),
            normal: turn * light.normal,
            two_sided: light.two_sided,
        }),
        Emitter::Disk(light) => Emitter::Disk(DiskEmitter {
            center: point(light.center),
            normal: turn * light.normal,
            radius: scale * light.radius,
            two_sided: light.two_sided,
        }),
        other => other.clone(),
    }
}

fn letter_l() -> Emitter {
    let corners = [(0.0, 0.0), (1.0, 0.0), (1.0, 0.3), (0.3, 0.3), (0.3, 1.2), (0.0, 1.2)];
    let vertices = corners.map(|(x, y)| DVec3::new(x - 0.4, y - 0.5, 0.0)).to_vec();
    Emitter::Polygon(PolygonEmitter { vertices, normal: DVec3::Z, two_sided: true })
}

fn uniform_disk() -> Emitter {
    Emitter::Disk(DiskEmitter { center: DVec3::ZERO, normal: DVec3::Z, radius: 0.5, two_sided: true })
}

fn lights() -> [Emitter; 4] {
    let stripe = vec![0.0, 1.0, 0.2, 3.0, 0.0, 0.7];
    [uniform_disk(), letter_l(), checkerboard(), textured(3, stripe, 0.4 * DVec3::X, 1.3 * DVec3::Y)]
}

/// A point near or far, with an eye above its surface.
fn random_point(random: &mut Random) -> ShadingPoint {
    let (n, v) = (random.direction(), random.direction());
    let v = if v.dot(n) < 0.0 { -v } else { v };
    ShadingPoint { p: random.direction() * random.magnitude(1e-3, 1e3), n, v }
}

#[test]
fn a_light_that_moves_keeps_its_pattern() {
    let mut random = Random::new(62);
    for emitter in lights() {
        let pattern = pattern_of(&emitter);
        for _ in 0..20 {
            let turn = DMat3::from_axis_angle(random.direction(), random.within(0.0, TAU));
            let moved = placed(&emitter, turn, random.magnitude(0.1, 10.0), random.point(5.0));
            assert!(Arc::ptr_eq(&pattern, &pattern_of(&moved)), "made anew for {moved:?}");
        }
    }
}

#[test]
fn one_shot_is_finite_and_not_negative() {
    let mut random = Random::new(63);
    let lights: Vec<_> = lights().iter().flat_map(|light| METHODS.map(|method| Prepared::new(light, method))).collect();
    for i in 0..100_000 {
        let light = &lights[i % lights.len()];
        let mut at = random_point(&mut random);
        match i % 7 {
            0 => at.p.z = 0.0,
            1 => at.p.z = random.magnitude(1e-18, 1e-6),
            2 => at.n = DVec3::new(1e-9, 0.0, at.p.z.signum()).normalize(),
            3 => at.p *= 1e9,
            _ => {}
        }
        let m = random.magnitude(1.0, 1000.0);
        let x = light.respond(&at, &Lobe::new(m));
        let most = light_bound(light.emitter(), at.p);
        assert!(x.irradiance.is_finite() && x.irradiance >= 0.0, "{x:?} for {at:?} of {light:?}");
        assert!(x.specular.is_finite() && x.specular >= 0.0, "{x:?} for {at:?}, {m} of {light:?}");
        assert!(x.irradiance <= most, "{x:?} is above {most} for {at:?} of {light:?}");
    }
}

/// What no point light of all of the light at the nearest place of its plane exceeds.
fn light_bound(emitter: &Emitter, p: DVec3) -> f64 {
    let (frame, pattern) = Prefiltered::of(emitter).expect("flat");
    let height = (p - frame.center).dot(frame.normal);
    pattern.grid().total() * frame.texel * frame.texel / (height * height).max(1e-300)
}

#[test]
fn turning_moving_and_scaling_everything_changes_nothing() {
    let mut random = Random::new(64);
    for emitter in lights() {
        for _ in 0..500 {
            let mut at = random_point(&mut random);
            at.p = at.p.clamp_length(0.05, 10.0);
            let turn = DMat3::from_axis_angle(random.direction(), random.within(0.0, TAU));
            let (scale, to) = (random.magnitude(0.1, 10.0), random.point(3.0));
            let moved = placed(&emitter, turn, scale, to);
            let at_moved = ShadingPoint { p: to + scale * (turn * at.p), n: turn * at.n, v: turn * at.v };
            let lobe = Lobe::new(random.magnitude(1.0, 100.0));
            for method in METHODS {
                let (x, y) = (respond(&emitter, method, &at, &lobe), respond(&moved, method, &at_moved, &lobe));
                let close = |x: f64, y: f64, scale: f64| (x - y).abs() <= 1e-6 * (x.max(y) + 0.05 * scale);
                assert!(
                    close(x.irradiance, y.irradiance, 1.0) && close(x.specular, y.specular, lobe.normalisation()),
                    "{method}: {x:?} and {y:?} for {at:?} of {emitter:?}"
                );
            }
        }
    }
}

#[test]
fn a_far_light_that_is_faced_is_a_point_light() {
    for emitter in lights() {
        let (frame, pattern) = Prefiltered::of(&emitter).expect("flat");
        let centroid =
            frame.center + frame.texel * (pattern.centroid().x * frame.axis_u + pattern.centroid().y * frame.axis_v);
        let at = ShadingPoint { p: centroid + 3e3 * frame.normal, n: -frame.normal, v: -frame.normal };
        let lobe = Lobe::new(20.0);
        let flux = pattern.grid().total() * (frame.texel / 3e3).powi(2);
        for method in METHODS {
            let x = respond(&emitter, method, &at, &lobe);
            // The sized radius ends at the light's own, which the light may reach beyond.
            let least = if method == Method::OneShotSized { 0.75 } else { 1.0 - 1e-4 };
            let shares = [x.irradiance / flux, x.specular / (flux * lobe.normalisation())];
            assert!(
                shares.iter().all(|share| (least..=1.0 + 1e-4).contains(share)),
                "{method}: {shares:?} of {emitter:?}"
            );
        }
    }
}

#[test]
fn nothing_comes_from_behind_a_light_or_below_a_surface() {
    let Emitter::Disk(light) = uniform_disk() else { unreachable!("it is a disk") };
    let light = Emitter::Disk(DiskEmitter { two_sided: false, ..light });
    let lobe = Lobe::new(5.0);
    let facing = |z: f64, n: DVec3| ShadingPoint { p: DVec3::new(0.1, 0.2, z), n, v: n };
    for method in METHODS {
        let [lit, behind, away] = [facing(1.0, -DVec3::Z), facing(-1.0, DVec3::Z), facing(1.0, DVec3::Z)]
            .map(|at| respond(&light, method, &at, &lobe));
        assert!(lit.irradiance > 0.0 && lit.specular > 0.0, "{method}: {lit:?} in front");
        assert_eq!((behind, away), (Response::default(), Response::default()), "{method}: behind, and facing away");
    }
}
