//! Every WGSL shading function against its f64 twin on the same rounded inputs.

use glam::DVec3;
use softbox::gpu::twin::cases::Case;
use softbox::gpu::twin::{self, Function, Row, Twin, rounded, rounded_number, share_of_bound};
use softbox::shading::fit::{Cone, Punctual};
use softbox::shading::point::falloff_response;
use softbox::shading::{PhongLobe, ShadingPoint};

use crate::CONTEXT;

/// All cases are within the bound, and with `error` planted in the WGSL, as (from, to), some are not.
#[track_caller]
pub(crate) fn check(function: &Function, error: (&str, &str), cases: &[Case]) {
    let (share, worst) = worst(&Twin::new(&CONTEXT, function), cases);
    let Case { row, expected, scale } = &cases[worst];
    println!(
        "{}: {} rows, worst {share:.3} of the bound: {row} → {expected:e}, scale {scale:e}",
        function.name,
        cases.len()
    );
    assert!(share <= 1.0, "{}: {share} of the bound on {row} → {expected:e}, scale {scale:e}", function.name);

    let (from, to) = error;
    let broken = Twin::with_error(&CONTEXT, function, from, to).expect("the text to plant an error in is there");
    let (share, _) = self::worst(&broken, cases);
    assert!(share > 1.0, "{} with `{to}` for `{from}` passes too: {share} of the bound", function.name);
}

/// The greatest share of the bound, and its row.
fn worst(twin: &Twin, cases: &[Case]) -> (f64, usize) {
    let rows: Vec<_> = cases.iter().map(|case| case.row.clone()).collect();
    let results = twin.run(&rows).expect("the device answers");
    let shares = results.iter().zip(cases).map(|(x, case)| share_of_bound(*x, case.expected, case.scale));
    shares.zip(0..).max_by(|a, b| a.0.total_cmp(&b.0)).expect("there are cases")
}

/// SplitMix64 (G. Steele, D. Lea and C. Flood, OOPSLA 2014).
pub(crate) struct Random(pub(crate) u64);

impl Random {
    pub(crate) fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    pub(crate) fn within(&mut self, from: f64, to: f64) -> f64 {
        rounded_number(from + (to - from) * (self.bits() >> 11) as f64 / (1_u64 << 53) as f64)
    }

    /// Uniform in the logarithm.
    pub(crate) fn magnitude(&mut self, from: f64, to: f64) -> f64 {
        rounded_number(self.within(from.ln(), to.ln()).exp())
    }

    pub(crate) fn point(&mut self, extent: f64) -> DVec3 {
        DVec3::from_array([(); 3].map(|()| self.within(-extent, extent)))
    }

    pub(crate) fn direction(&mut self) -> DVec3 {
        loop {
            let v = self.point(1.0);
            if v.length_squared() > 1e-4 && v.length_squared() < 1.0 {
                return rounded(v.normalize());
            }
        }
    }

    /// Any real exponent from 1 to 1000.
    pub(crate) fn exponent(&mut self) -> f64 {
        self.magnitude(1.0, 1000.0)
    }
}

#[test]
fn arctangent_matches_in_all_quadrants_and_at_all_ratios() {
    let mut random = Random(1);
    let mut cases = Vec::new();
    for _ in 0..4000 {
        let size = random.magnitude(1e-15, 1e15);
        let sign = |bit| if bit { size } else { -size };
        let y = rounded_number(sign(random.bits() & 1 == 0) * random.magnitude(1e-6, 1.0));
        let x = rounded_number(sign(random.bits() & 1 == 0) * random.magnitude(1e-6, 1.0));
        cases.push(Case { row: Row::default().number(y).number(x), expected: y.atan2(x), scale: 0.0 });
    }
    for (y, x) in [(0.0, 0.0), (0.0, 1.0), (1.0, 0.0), (-1.0, 0.0), (0.0, -1.0), (1.0, 1.0), (1.0, -1.0)] {
        let row = Row::default().number(y).number(x);
        cases.push(Case { row, expected: y.atan2(x), scale: 1.0 });
    }
    check(&twin::ARCTANGENT, ("0.39269908169872415481", "0.3928"), &cases);
}

/// Rows of [`twin::FALLOFF_IRRADIANCE`] and [`twin::FALLOFF_SPECULAR`].
fn falloff_cases(seed: u64, specular: bool) -> Vec<Case> {
    let mut random = Random(seed);
    let case = |_| {
        let to_light = random.point(3.0);
        let intensity = random.magnitude(1e-3, 1e3);
        let falloff = if random.bits() & 1 == 0 { 2.0 } else { random.within(0.0, 3.0) };
        let (n, r) = (random.direction(), random.direction());
        let m = random.exponent();
        let row = Row::default().vector(to_light).number(intensity).number(falloff).vector(n).vector(r);
        let row = row.lobe(PhongLobe::new(m));
        let response = falloff_response(to_light, intensity, falloff, n, r, &PhongLobe::new(m));
        let scale = intensity / to_light.length().powf(falloff);
        if specular {
            Case { row, expected: response.specular, scale: scale * PhongLobe::new(m).normalisation() }
        } else {
            Case { row, expected: response.irradiance, scale }
        }
    };
    (0..4000).map(case).collect()
}

#[test]
fn irradiance_of_a_point_light_matches() {
    check(&twin::FALLOFF_IRRADIANCE, ("inverse * inverse", "inverse * inverse * 1.001"), &falloff_cases(2, false));
}

#[test]
fn specular_response_to_a_point_light_matches() {
    check(&twin::FALLOFF_SPECULAR, ("(m + 1.0)", "(m + 1.01)"), &falloff_cases(3, true));
}

#[test]
fn density_of_every_lobe_matches() {
    let mut random = Random(4);
    let case = |i: u32| {
        let m = random.exponent();
        let lobe = match i % 4 {
            0 => PhongLobe::new(m),
            1 => PhongLobe::blinn(m),
            2 => PhongLobe::cook_torrance(random.magnitude(0.02, 1.0), random.within(0.0, 1.0)),
            _ => PhongLobe::lafortune(m, random.within(-1.0, 1.0), random.within(0.1, 1.0)),
        };
        let n = random.direction();
        // Half of the directions are near the mirror direction, where narrow lobes are.
        let r = above(n, random.direction());
        let near = (r + 0.2 * random.direction()).normalize();
        let w = above(n, rounded(if random.bits() & 1 == 0 { near } else { random.direction() }));
        let row = Row::default().vector(n).vector(r).vector(w).lobe(lobe.clone());
        let expected = lobe.density(n.normalize(), r.normalize(), w.normalize());
        Case { row, expected, scale: (lobe.cosine_exponent() + 1.0) / std::f64::consts::TAU }
    };
    let cases: Vec<_> = (0..8000).map(case).collect();
    check(&twin::LOBE_DENSITY, ("0.25 * distribution", "0.251 * distribution"), &cases);
}

/// The direction or its opposite, whichever is above the surface.
fn above(n: DVec3, direction: DVec3) -> DVec3 {
    if n.dot(direction) > 0.0 { direction } else { -direction }
}

#[test]
fn spots_match_in_and_out_of_their_cones() {
    let mut random = Random(7);
    let mut cases = Vec::new();
    for _ in 0..2000 {
        let (to_light, n, v) = (random.point(4.0), random.direction(), random.direction());
        let axis = rounded((-to_light.normalize() + random.point(1.5)).normalize());
        let cos_outer = random.within(0.0, 0.9);
        let cone = Cone { cos_inner: random.within(cos_outer + 0.02, 1.0), cos_outer };
        let [scale, offset] = cone.ramp();
        let (intensity, m) = (random.magnitude(0.1, 10.0), random.magnitude(1.0, 100.0));
        let at = ShadingPoint { p: -to_light, n, v };
        let lobe = PhongLobe::new(m);
        let spot = Punctual::Spot { position: DVec3::ZERO, intensity, axis, cone };
        let row = Row::default().vector(to_light).number(intensity).vector(scale * axis).number(offset);
        let row = row.vector(n).vector(rounded(at.mirror())).lobe(lobe.clone());
        let scale_of_case = intensity / to_light.length_squared() * (m + 1.0);
        cases.push(Case { row, expected: spot.respond(&at, &lobe).specular, scale: scale_of_case * (1.0 + scale) });
    }
    assert!(cases.iter().filter(|case| case.expected > 0.0).count() > 200, "some are lit");
    check(&twin::SPOT_RESPONSE, ("share * share", "share"), &cases);
}
