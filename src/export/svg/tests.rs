use glam::DVec3;

use super::*;
use crate::scene::PlotQuantity;

fn plot(name: &str) -> Plot {
    Plot {
        name: name.to_owned(),
        kind: PlotKind::Tilt,
        quantity: PlotQuantity::Irradiance,
        position: DVec3::ZERO,
        normal: DVec3::Z,
        view: None,
        axis: DVec3::Y,
        range: [-90.0, 90.0],
        material: None,
        normalise: false,
    }
}

fn curves(y: &[f64], logarithmic_x: bool) -> Curves {
    let x: Vec<f64> = (1..=y.len()).map(|i| i as f64).collect();
    let series = [Method::Exact, Method::Point, Method::Reference].map(|method| Series {
        method,
        y: y.to_vec(),
        band: (method == Method::Reference).then(|| vec![0.1; y.len()]),
        error: vec![0.0; y.len()],
        max_error: 0.0,
        rms_error: 0.0,
        cost_ns: 50.0,
    });
    Curves {
        x,
        x_label: "Tilt (°)".to_owned(),
        y_label: "Illuminance (lx)".to_owned(),
        logarithmic_x,
        exact: y.to_vec(),
        series: series.into(),
    }
}

/// The picture is XML, and one that draws.
#[track_caller]
fn check(svg: &str) {
    if let Err(error) = crate::export::png::from_svg(svg, 0.25) {
        panic!("{error}:\n{svg}");
    }
    assert!(!svg.contains("NaN") && !svg.contains("inf"), "{svg}");
}

#[test]
fn every_plot_has_a_panel_with_its_name_as_text() {
    let curves = curves(&[1.0, 3.0, 2.0], false);
    let svg = plots(&[(&plot("a < b & \"c\""), curves.clone()), (&plot("\u{1}second"), curves)]);
    check(&svg);
    assert!(svg.contains("a &lt; b &amp; &quot;c&quot;") && svg.contains(" second"), "{svg}");
}

#[test]
fn a_plot_names_its_methods_and_units() {
    let svg = plots(&[(&plot("p"), curves(&[1.0, 3.0, 2.0], false))]);
    for expected in [">exact<", ">point<", ">reference<", "Illuminance (lx)", "Error (lx)", "Tilt (°)", ">lx<"] {
        assert!(svg.contains(expected), "no {expected} in:\n{svg}");
    }
}

#[test]
fn odd_curves_still_draw() {
    for y in [
        &[0.0, 0.0][..],
        &[f64::NAN, 1.0],
        &[f64::INFINITY, 1.0, 2.0],
        &[1e-300, 1e300],
        &[-5.0, 5.0],
        &[1e-30, 2e-30],
        &[7.0, 7.0],
    ] {
        for logarithmic_x in [false, true] {
            check(&plots(&[(&plot("odd"), curves(y, logarithmic_x))]));
        }
    }
}
