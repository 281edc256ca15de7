//! The WGSL of one-shot against `shading::one_shot`.

use std::sync::Arc;

use glam::{DVec2, DVec3};
use softbox::gpu::twin::cases::Case;
use softbox::gpu::twin::{self, Row, rounded_number};
use softbox::light::{Emitter, PolygonEmitter};
use softbox::shading::one_shot::{FARTHEST, Kernel, Prefiltered, brightest_step};

use crate::twins::{Random, check};

#[test]
fn brightest_step_matches() {
    let mut random = Random(41);
    let mut cases = Vec::new();
    for i in 0..4000 {
        let tilt = random.within(0.0, std::f64::consts::PI);
        let tangential = if i % 8 == 0 { random.magnitude(1e-12, 1.0) } else { rounded_number(tilt.sin()) };
        let (away, m) = (rounded_number(tilt.cos()), random.magnitude(0.1, 5000.0));
        let row = Row::default().number(tangential).number(away).number(m);
        let expected = brightest_step(tangential, away, m);
        // Where it is cut off, f32 and f64 may disagree on whether it is.
        if expected < 0.99 * FARTHEST {
            cases.push(Case { row, expected, scale: 1.0 });
        }
    }
    check(&twin::BRIGHTEST_STEP, ("2.0 * m * tangential", "2.001 * m * tangential"), &cases);
}

/// A star: convex nowhere, and not in the middle of its grid.
fn star() -> Arc<Prefiltered> {
    let corner = |i: i32| {
        let distance = if i % 2 == 0 { 1.0 } else { 0.4 };
        DVec2::from_angle(0.7 * f64::from(i)).extend(0.0) * distance
    };
    let light = PolygonEmitter { vertices: (0..9).map(corner).collect(), normal: DVec3::Z, two_sided: false };
    Prefiltered::of(&Emitter::Polygon(light)).expect("a star is flat").1
}

fn sum_cases(seed: u64, kernel: Kernel) -> Vec<Case> {
    let pattern = star();
    let mut random = Random(seed);
    let case = |i: u32| {
        let extent = if i.is_multiple_of(4) { random.magnitude(60.0, 2e4) } else { 70.0 };
        let [x, y] = [(); 2].map(|()| random.within(-extent, extent));
        let radius = random.magnitude(0.05, 4.0 * extent);
        let row = Row::default().number(x).number(y).number(radius).pattern(&pattern, kernel);
        let expected = pattern.sum(kernel, DVec2::new(x, y), radius);
        Case { row, expected, scale: pattern.grid().total() }
    };
    (0..8000).map(case).collect()
}

#[test]
fn sums_over_disks_match() {
    check(&twin::DISK_SUM, ("(3.0 * below)", "(3.01 * below)"), &sum_cases(42, Kernel::Disk));
}

#[test]
fn sums_over_squares_match() {
    check(&twin::SQUARE_SUM, ("(3.0 * below)", "(3.01 * below)"), &sum_cases(43, Kernel::Square));
}
