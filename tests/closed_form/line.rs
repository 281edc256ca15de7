//! Linear lights.

use softbox::light::LineEmitter;
use softbox::shading::line::{line_irradiance, line_phong, line_phong_lobe_only};

use super::cases::{Case, Worst, load};

fn light(case: &Case, falloff: f64) -> LineEmitter {
    LineEmitter { a: case.vector("A"), b: case.vector("B"), falloff }
}

/// |B−A|/dᶠ, d the least distance from p.
fn scale(case: &Case, falloff: f64) -> f64 {
    let (a, b) = (case.vector("A") - case.vector("p"), case.vector("B") - case.vector("p"));
    let along = b - a;
    let t = (-a.dot(along) / along.length_squared()).clamp(0.0, 1.0);
    along.length() / (a + t * along).length().powf(falloff)
}

#[test]
fn line_irradiance_matches_the_reference() {
    let mut worst = Worst::default();
    for case in load("linear_diffuse") {
        let falloff = case.number("decay");
        let x = line_irradiance(&light(&case, falloff), case.vector("p"), case.direction("N"));
        worst.check(&case, x, case.value("expected"), scale(&case, falloff));
    }
    worst.finish("line irradiance", 2e-15, 5e-14);
}

#[test]
fn line_phong_matches_the_reference() {
    let [mut lobe_only, mut clipped] = [Worst::default(), Worst::default()];
    for case in load("linear_phong") {
        let (light, m, scale) = (light(&case, 2.0), case.number("n"), scale(&case, 2.0));
        let (p, n, r) = (case.vector("p"), case.direction("N"), case.direction("R"));
        lobe_only.check(&case, line_phong_lobe_only(&light, p, r, m), case.value("expected"), scale);
        clipped.check(&case, line_phong(&light, p, n, r, m), case.value("expected_nclip"), scale);
    }
    lobe_only.finish("line phong, lobe only", 1e-14, 2e-12);
    clipped.finish("line phong", 1e-14, 2e-12);
}
