//! What must hold for disks, caps and skies, over random inputs.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use glam::{DMat3, DVec3};
use softbox::light::{CapEmitter, DiskEmitter, Emitter, SkyEmitter};
use softbox::shading::disk::disk_solid_angle;
use softbox::shading::reference::reference;
use softbox::shading::sphere::Cap;
use softbox::shading::{Method, PhongLobe, Response, ShadingPoint, respond};

use super::random::{Random, property_cases};

/// A light, a point, its normal and the axis of its lobe.
#[derive(Clone, Debug)]
struct View {
    emitter: Emitter,
    p: DVec3,
    n: DVec3,
    r: DVec3,
    m: f64,
}

impl View {
    fn random(random: &mut Random) -> Self {
        let kind = random.within(0.0, 3.0);
        let emitter = if kind < 1.0 {
            let (center, normal) = (random.point(1.0), random.direction());
            Emitter::Disk(DiskEmitter { center, normal, radius: random.magnitude(1e-2, 10.0), two_sided: kind < 0.5 })
        } else if kind < 2.0 {
            let half_angle = if kind < 1.1 { FRAC_PI_2 } else { random.magnitude(1e-3, FRAC_PI_2) };
            Emitter::Cap(CapEmitter { to_center: random.direction(), half_angle })
        } else {
            let (uniform, cosine) = (random.within(0.0, 1.0), random.within(0.0, 1.0));
            Emitter::Sky(SkyEmitter { zenith: random.direction(), uniform, cosine })
        };
        let p = Self::place(&emitter, random);
        let n = Self::axis(&emitter, p, random);
        let r = if random.within(0.0, 1.0) < 0.1 { n } else { Self::axis(&emitter, p, random) };
        let m = random.magnitude(1.0, 1000.0);
        Self { emitter, p, n, r, m: if random.within(0.0, 1.0) < 0.5 { m } else { m.floor() } }
    }

    /// A point far from and near to a disk, on its axis, above its rim and close to its plane.
    fn place(emitter: &Emitter, random: &mut Random) -> DVec3 {
        let Emitter::Disk(light) = emitter else { return random.point(1.0) };
        let across = light.normal.any_orthonormal_vector();
        let height = light.radius * random.magnitude(1e-6, 1e4);
        let aside = match random.within(0.0, 4.0) {
            kind if kind < 1.0 => 0.0,
            kind if kind < 2.0 => 1.0,
            kind if kind < 3.0 => random.within(0.0, 2.0),
            _ => random.magnitude(1e-3, 1e4),
        };
        light.center + height * light.normal + aside * light.radius * across
    }

    /// Any direction, one that looks at the light, or one whose horizon touches the light's edge.
    fn axis(emitter: &Emitter, p: DVec3, random: &mut Random) -> DVec3 {
        let any = random.direction();
        let edge = match emitter {
            Emitter::Disk(light) => {
                let across = light.normal.cross(any).normalize();
                light.center + light.radius * across - p
            }
            Emitter::Cap(light) => {
                let (sin, cos) = light.half_angle.sin_cos();
                cos * light.to_center + sin * light.to_center.cross(any).normalize()
            }
            Emitter::Sky(light) => light.zenith.cross(any),
            _ => any,
        };
        let edge = edge.normalize();
        match random.within(0.0, 3.0) {
            kind if kind < 1.0 => any,
            kind if kind < 2.0 => edge,
            _ => (any - any.dot(edge) * edge).normalize(),
        }
    }

    fn at(&self) -> ShadingPoint {
        ShadingPoint { p: self.p, n: self.n, v: 2.0 * self.n.dot(self.r) * self.n - self.r }
    }

    fn respond(&self, method: Method) -> Response {
        respond(&self.emitter, method, &self.at(), &PhongLobe::new(self.m))
    }

    /// The most light there is, for E and for the specular part.
    fn bounds(&self) -> [f64; 2] {
        let (solid_angle, brightest) = match &self.emitter {
            Emitter::Disk(light) => (disk_solid_angle(light, self.p), 1.0),
            Emitter::Cap(light) => (Cap::new(light.to_center, light.half_angle).solid_angle(), 1.0),
            Emitter::Sky(light) => (TAU, light.uniform + light.cosine),
            _ => (f64::INFINITY, 1.0),
        };
        [brightest * solid_angle.min(PI), brightest * ((self.m + 1.0) / TAU * solid_angle).min(1.0)]
    }

    fn turned(&self, turn: DMat3) -> Self {
        let mut view = Self { p: turn * self.p, n: turn * self.n, r: turn * self.r, ..self.clone() };
        match &mut view.emitter {
            Emitter::Disk(light) => (light.center, light.normal) = (turn * light.center, turn * light.normal),
            Emitter::Cap(light) => light.to_center = turn * light.to_center,
            Emitter::Sky(light) => light.zenith = turn * light.zenith,
            _ => {}
        }
        view
    }
}

/// Both within `relative` of themselves and `absolute` of what there is.
#[track_caller]
fn same(what: &str, [x, y]: [Response; 2], [relative, absolute]: [f64; 2], view: &View) {
    let [irradiance, specular] = view.bounds();
    let close = |x: f64, y: f64, most: f64| (x - y).abs() <= relative * x.max(y) + absolute * most;
    let (e, s) = (close(x.irradiance, y.irradiance, irradiance), close(x.specular, y.specular, specular));
    assert!(e && s, "{what}: {x:?} and {y:?} of {irradiance:e}, {specular:e} for {view:?}");
}

/// What a rounding of the distance from the disk's plane does, relative to the answer.
fn rounding(view: &View) -> f64 {
    let Emitter::Disk(light) = &view.emitter else { return f64::EPSILON };
    let to_center = light.center - view.p;
    let reach = to_center.length() + light.radius + light.center.length() + view.p.length();
    let rim = (to_center - light.normal * light.normal.dot(to_center)).length() - light.radius;
    let height = light.normal.dot(to_center).abs();
    f64::EPSILON * reach / height.min(rim.hypot(height))
}

#[test]
fn responses_are_finite_and_not_negative_and_bounded() {
    let mut random = Random::new(61);
    for _ in 0..property_cases() {
        let view = View::random(&mut random);
        let [irradiance, specular] = view.bounds();
        let x = view.respond(Method::Exact);
        let slack = 1e-9 + rounding(&view);
        assert!((0.0..=irradiance * (1.0 + slack)).contains(&x.irradiance), "{x:?} of {irradiance} for {view:?}");
        assert!((0.0..=specular * (1.0 + slack)).contains(&x.specular), "{x:?} of {specular} for {view:?}");
    }
}

#[test]
fn turning_everything_changes_nothing() {
    let mut random = Random::new(62);
    for _ in 0..property_cases() {
        let view = View::random(&mut random);
        let turned = view.turned(DMat3::from_axis_angle(random.direction(), random.within(0.0, TAU)));
        let error = 1e-12 * view.m.max(10.0) + 100.0 * view.m * rounding(&view);
        same("turned", [&view, &turned].map(|view| view.respond(Method::Exact)), [1e-9, error], &view);
    }
}

#[test]
fn scaling_a_disk_and_its_distance_changes_nothing() {
    let mut random = Random::new(63);
    for _ in 0..property_cases() {
        let view = View::random(&mut random);
        let Emitter::Disk(light) = &view.emitter else { continue };
        let scale = random.magnitude(1e-3, 1e3);
        let light = DiskEmitter { center: scale * light.center, radius: scale * light.radius, ..*light };
        let scaled = View { emitter: Emitter::Disk(light), p: scale * view.p, ..view.clone() };
        let error = 1e-12 * view.m.max(10.0) + 100.0 * view.m * rounding(&view);
        same("scaled", [&view, &scaled].map(|view| view.respond(Method::Exact)), [1e-9, error], &view);
    }
}

#[test]
fn small_changes_make_no_jumps() {
    // Half of the views have a horizon on the light's edge, where it is cut on one side and whole on the other.
    let mut random = Random::new(64);
    for _ in 0..property_cases() {
        let view = View::random(&mut random);
        let step = random.magnitude(1e-12, 1e-7);
        let nudged = |v: DVec3, random: &mut Random| (v + step * random.direction()).normalize();
        let other = View { n: nudged(view.n, &mut random), r: nudged(view.r, &mut random), ..view.clone() };
        // E changes by no more than the sphere's half times the turn, and the specular part m+1 times as fast.
        let swept = [7.0 * step, 7.0 * (view.m + 1.0) * step];
        let [x, y] = [&view, &other].map(|view| view.respond(Method::Exact));
        let [irradiance, specular] = view.bounds();
        // Beside a disk's rim and in its plane E is known to 5e-11.
        let close = (x.irradiance - y.irradiance).abs() <= swept[0] + 5e-11 * irradiance
            && (x.specular - y.specular).abs() <= swept[1] + (1e-12 * view.m.max(10.0)) * specular;
        assert!(close, "{x:?} and {y:?} a step of {step} apart for {view:?}");
    }
}

#[test]
fn exact_answers_lie_in_the_references_band() {
    let mut random = Random::new(65);
    for _ in 0..property_cases() / 250 {
        let view = View::random(&mut random);
        let (x, band) = (view.respond(Method::Exact), reference(&view.emitter, &view.at(), &PhongLobe::new(view.m)));
        let [irradiance, specular] = view.bounds();
        let slack = 1e-12 * view.m.max(10.0) + 100.0 * view.m * rounding(&view);
        for (x, band, most) in [(x.irradiance, band.irradiance, irradiance), (x.specular, band.specular, specular)] {
            let off = (x - band.value).abs();
            assert!(off <= band.error + 1e-10 * x + slack * most, "{x:e} for {band:?}, off {off:e}: {view:?}");
        }
    }
}

#[test]
fn approximations_are_finite_and_tend_to_the_exact_answer() {
    let mut random = Random::new(66);
    for _ in 0..300 {
        let view = View { m: random.magnitude(1.0, 30.0), ..View::random(&mut random) };
        for method in [Method::Point, Method::PointCluster(16), Method::Hermite1, Method::Hermite2] {
            let x = view.respond(method);
            let finite = x.irradiance.is_finite() && x.specular.is_finite();
            assert!(finite && x.irradiance >= 0.0 && x.specular >= 0.0, "{method}: {x:?} for {view:?}");
        }
        let far = match &view.emitter {
            Emitter::Disk(light) => (view.p - light.center).dot(light.normal).abs() > 0.5 * light.radius,
            _ => true,
        };
        if far {
            let [x, y] = [Method::Exact, Method::PointCluster(4000)].map(|method| view.respond(method));
            same("a large cluster", [x, y], [0.0, 0.01], &view);
        }
    }
}
