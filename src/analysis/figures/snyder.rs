//! The curves of [`crate::refs::SNYDER_1996`]: distant sources over the angle ω to their middle.
//!
//! Illuminances are divided by π and specular values have SNYDER's factor (m+1)/(2π), so that a whole hemisphere of
//! luminance 1 about the normal or the mirror direction gives 1. The mirror direction is the normal here, so that the
//! lobe's own horizon is the only one, as in SNYDER.

use std::f64::consts::{FRAC_1_PI, FRAC_PI_2, PI};

use glam::DVec3;

use crate::analysis::chart::{Body, Chart, Line, Panel, Table};
use crate::light::{CapEmitter, Emitter, SkyEmitter};
use crate::shading::{Lobe, Method, ShadingPoint, respond};

/// Points of a curve: a degree apart.
const SAMPLES: usize = 181;

/// ω, degrees.
const RANGE: [f64; 2] = [0.0, 180.0];

/// σ of the table of Hermite errors, radians.
const SIGMAS: [f64; 5] = [PI / 16.0, PI / 6.0, PI / 4.0, PI / 3.0, FRAC_PI_2];

/// Figure 2: illuminance from caps of half-angle σ, normalised to 1 at ω = 0.
pub fn snyder_2() -> Chart {
    let caps = [PI / 6.0, PI / 3.0, FRAC_PI_2].map(|sigma| {
        Line::of(format!("σ = {}°", degrees(sigma)), RANGE, SAMPLES, |omega| normalised(Method::Exact, sigma, omega))
    });
    let point = Line::of("point light", RANGE, SAMPLES, |omega| omega.to_radians().cos().max(0.0)).dashed();
    Chart {
        title: "Illuminance from a cap of half-angle σ (Snyder 1996, figure 2)".to_owned(),
        panels: vec![panel("", "E / π sin²σ", caps.into_iter().chain([point]).collect())],
    }
}

/// Figure 3: the Hermite curve of two segments beside what it stands for.
pub fn snyder_3() -> Chart {
    let panels = [FRAC_PI_2, PI / 4.0, PI / 8.0].map(|sigma| {
        let line = |name: &str, method| Line::of(name, RANGE, SAMPLES, |omega| normalised(method, sigma, omega));
        let title = format!("σ = {}°, off by up to {:.4}", degrees(sigma), hermite_error(Method::Hermite2, sigma));
        panel(&title, "E / π sin²σ", vec![line("hermite-2", Method::Hermite2), line("exact", Method::Exact).dashed()])
    });
    Chart {
        title: "Two Hermite segments in place of the exact curve (Snyder 1996, figure 3)".to_owned(),
        panels: panels.into(),
    }
}

/// Figure 4: Phong reflection of a sky, uniform and cosine-weighted.
pub fn snyder_4() -> Chart {
    let panels = [("uniform sky", [1.0, 0.0]), ("cosine-weighted sky", [0.0, 1.0])].map(|(name, [uniform, cosine])| {
        let lines = [1.0, 4.0, 16.0, 64.0].map(|m| {
            let sky = |zenith| Emitter::Sky(SkyEmitter { zenith, uniform, cosine });
            dashed_if(m == 1.0, Line::of(exponent(m), RANGE, SAMPLES, |omega| specular(&sky(towards(omega)), m)))
        });
        panel(name, "S / L", lines.into())
    });
    Chart { title: "Phong reflection of a sky (Snyder 1996, figure 4)".to_owned(), panels: panels.into() }
}

/// Figure 5: Phong reflection of a cap.
pub fn snyder_5() -> Chart {
    let panels = [PI / 6.0, PI / 3.0].map(|sigma| {
        let lines = [1.0, 3.0, 15.0, 63.0].map(|m| {
            dashed_if(m == 1.0, Line::of(exponent(m), RANGE, SAMPLES, |omega| specular(&cap(sigma, omega), m)))
        });
        panel(&format!("σ = {}°", degrees(sigma)), "S / L", lines.into())
    });
    Chart { title: "Phong reflection of a cap (Snyder 1996, figure 5)".to_owned(), panels: panels.into() }
}

/// Figure 6: Phong reflection of caps, normalised to 1 at ω = 0.
pub fn snyder_6() -> Chart {
    let panels = [1.0, 3.0, 15.0, 63.0].map(|m| {
        let lines = [5.0, 4.0, 3.0, 2.0, 1.0].map(|tenths| {
            let sigma = 0.1 * tenths * PI;
            let unit = specular(&cap(sigma, 0.0), m);
            let line = Line::of(format!("σ = {}°", degrees(sigma)), RANGE, SAMPLES, |omega| {
                specular(&cap(sigma, omega), m) / unit
            });
            dashed_if(tenths == 5.0, line)
        });
        panel(&exponent(m), "S / S(ω = 0)", lines.into())
    });
    Chart { title: "Phong reflection of a cap, normalised (Snyder 1996, figure 6)".to_owned(), panels: panels.into() }
}

/// The greatest error of each Hermite curve as a share of sin²σ, by σ.
pub fn hermite_errors() -> Table {
    let row = |sigma: f64| {
        let errors = [Method::Hermite1, Method::Hermite2].map(|method| format!("{:.5}", hermite_error(method, sigma)));
        [degrees(sigma)].into_iter().chain(errors).collect()
    };
    Table {
        heading: ["sigma_deg", "hermite_1", "hermite_2"].map(String::from).into(),
        rows: SIGMAS.into_iter().map(row).collect(),
    }
}

/// The greatest |E − exact|/π sin²σ over ω.
fn hermite_error(method: Method, sigma: f64) -> f64 {
    let error = |omega: f64| (normalised(method, sigma, omega) - normalised(Method::Exact, sigma, omega)).abs();
    (0..=1800).map(|tenths| error(0.1 * f64::from(tenths))).fold(0.0, f64::max)
}

/// E/(π sin²σ) of a cap of luminance 1, ω in degrees.
fn normalised(method: Method, sigma: f64, omega: f64) -> f64 {
    let response = respond(&cap(sigma, omega), method, &AT, &Lobe::new(1.0));
    FRAC_1_PI * response.irradiance / sigma.sin().powi(2)
}

/// The specular response to an emitter of luminance 1 where the mirror direction is the normal.
fn specular(emitter: &Emitter, m: f64) -> f64 {
    respond(emitter, Method::Exact, &AT, &Lobe::new(m)).specular
}

/// Seen along its normal.
const AT: ShadingPoint = ShadingPoint { p: DVec3::ZERO, n: DVec3::Z, v: DVec3::Z };

fn cap(sigma: f64, omega: f64) -> Emitter {
    Emitter::Cap(CapEmitter { to_center: towards(omega), half_angle: sigma })
}

/// The unit direction at ω degrees from the normal.
fn towards(omega: f64) -> DVec3 {
    let (sin, cos) = omega.to_radians().sin_cos();
    DVec3::new(sin, 0.0, cos)
}

fn panel(title: &str, y_label: &str, lines: Vec<Line>) -> Panel {
    let x_label = "ω (°)".to_owned();
    Panel { title: title.to_owned(), x_label, y_label: y_label.to_owned(), body: Body::Lines(lines) }
}

fn dashed_if(dashed: bool, line: Line) -> Line {
    Line { dashed, ..line }
}

fn exponent(m: f64) -> String {
    format!("m = {m}")
}

fn degrees(angle: f64) -> String {
    format!("{}", (1e6 * angle.to_degrees()).round() / 1e6)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn lines(chart: &Chart, panel: usize) -> &[Line] {
        let Body::Lines(lines) = &chart.panels[panel].body else { panic!("{} has curves", chart.title) };
        lines
    }

    #[track_caller]
    fn check(line: &Line, expected: impl Fn(f64) -> f64, tolerance: f64) {
        for (x, y) in line.x.iter().zip(&line.y) {
            let expected = expected(x.to_radians());
            assert!((y - expected).abs() <= tolerance, "{} at {x}°: {y} is not {expected}", line.label);
        }
    }

    #[test]
    fn a_hemisphere_gives_half_of_one_plus_cosine() {
        // SNYDER eq. 3, and eq. 14 for n = 1.
        let hemisphere = |omega: f64| 0.5 * (1.0 + omega.cos());
        check(&lines(&snyder_2(), 0)[2], hemisphere, 1e-14);
        check(&lines(&snyder_3(), 0)[1], hemisphere, 1e-14);
        check(&lines(&snyder_4(), 0)[0], hemisphere, 1e-12);
        check(&lines(&snyder_6(), 0)[0], hemisphere, 1e-12);
    }

    #[test]
    fn a_cap_above_the_horizon_gives_the_cosine_and_one_below_nothing() {
        for (line, sigma) in lines(&snyder_2(), 0).iter().zip([PI / 6.0, PI / 3.0]) {
            for (x, y) in line.x.iter().zip(&line.y) {
                let omega = x.to_radians();
                if omega < FRAC_PI_2 - sigma {
                    assert!((y - omega.cos()).abs() < 1e-14, "{} at {x}°: {y}", line.label);
                } else if omega > FRAC_PI_2 + sigma {
                    assert_eq!(*y, 0.0, "{} at {x}°", line.label);
                }
            }
        }
    }

    #[test]
    fn a_lobe_along_a_caps_axis_gives_one_less_a_power_of_its_cosine() {
        // SNYDER §3.2: 1 − cosⁿ⁺¹σ.
        let chart = snyder_5();
        for (panel, sigma) in [PI / 6.0, PI / 3.0].into_iter().enumerate() {
            for (line, m) in lines(&chart, panel).iter().zip([1.0, 3.0, 15.0, 63.0]) {
                let expected = 1.0 - sigma.cos().powf(m + 1.0);
                assert!((line.y[0] - expected).abs() < 1e-12, "σ = {sigma}, m = {m}: {}", line.y[0]);
            }
        }
    }

    #[test]
    fn a_lobe_along_the_zenith_of_a_cosine_weighted_sky_gives_m_plus_1_over_m_plus_2() {
        let chart = snyder_4();
        for (line, m) in lines(&chart, 1).iter().zip([1.0, 4.0, 16.0, 64.0]) {
            let expected = (m + 1.0) / (m + 2.0);
            assert!((line.y[0] - expected).abs() < 1e-12, "m = {m}: {} is not {expected}", line.y[0]);
        }
    }

    #[test]
    fn normalised_curves_begin_at_one_and_fall() {
        let chart = snyder_6();
        assert_eq!(chart.panels.len(), 4, "a panel an exponent");
        for line in (0..4).flat_map(|panel| lines(&chart, panel)) {
            assert_eq!(line.y[0], 1.0, "{}", line.label);
            assert!(line.y.windows(2).all(|pair| pair[1] <= pair[0] + 1e-12), "{} falls", line.label);
        }
    }

    #[test]
    fn hermite_errors_are_those_of_an_independent_computation() {
        // By high-precision quadrature: σ = 0.196, 0.524, 0.785, 1.047, π/2.
        let expected = [[0.0075, 0.0007], [0.021, 0.0022], [0.033, 0.0037], [0.042, 0.0055], [0.010, 0.0054]];
        for (row, expected) in hermite_errors().rows.iter().zip(expected) {
            for (cell, expected) in row[1..].iter().zip(expected) {
                let found: f64 = cell.parse().unwrap();
                assert!((found - expected).abs() <= 0.0006, "{row:?}: {found} is not {expected}");
            }
        }
    }
}
