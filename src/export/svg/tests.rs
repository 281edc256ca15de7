use glam::DVec3;

use super::*;
use crate::analysis::{Curves, Pin, Series};
use crate::scene::{Plot, PlotKind, PlotQuantity};
use crate::shading::Method;

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
        unit: 1.0,
        exact: y.to_vec(),
        series: series.into(),
    }
}

/// What the plots are of.
const ORIGIN: Origin = Origin { scene: "a <b>.toml" };

fn drawn(sheets: &[Sheet]) -> String {
    plots(sheets, ORIGIN)
}

/// The picture is XML, and one that draws.
#[track_caller]
fn check(svg: &str) {
    if let Err(error) = crate::export::png::from_svg(svg, 0.25, ORIGIN) {
        panic!("{error}:\n{svg}");
    }
    assert!(!svg.contains("NaN") && !svg.contains("inf"), "{svg}");
}

#[test]
fn every_plot_has_a_panel_with_its_name_as_text() {
    let curves = curves(&[1.0, 3.0, 2.0], false);
    let svg = drawn(&[Sheet::new(&plot("a < b & \"c\""), curves.clone()), Sheet::new(&plot("\u{1}second"), curves)]);
    check(&svg);
    assert!(svg.contains("a &lt; b &amp; &quot;c&quot;") && svg.contains(" second"), "{svg}");
    let maker = format!("<desc>{}</desc>", escaped(&ORIGIN.line()));
    assert!(maker.contains("a &lt;b&gt;.toml") && svg.contains(&maker), "who drew it, and of what: {svg}");
}

#[test]
fn a_plot_names_its_methods_and_units() {
    let svg = drawn(&[Sheet::new(&plot("p"), curves(&[1.0, 3.0, 2.0], false))]);
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
        for bits in 0..32 {
            let choice = |bit: u32| bits >> bit & 1 == 1;
            let look = Look {
                polar: choice(0),
                logarithmic: choice(1),
                relative_error: choice(2),
                logarithmic_error: choice(3),
            };
            check(&drawn(&[Sheet { look, ..Sheet::new(&plot("odd"), curves(y, choice(4))) }]));
        }
    }
}

#[test]
fn a_polar_plot_has_rings_rays_and_pinned_curves() {
    let mut sheet = Sheet::new(&plot("p"), curves(&[1.0, 3.0, 2.0], false));
    let labels = [&sheet.curves.x_label, &sheet.curves.y_label].map(Clone::clone);
    let pin = Pin { name: "before <it>".to_owned(), labels, x: vec![1.0, 3.0], y: vec![1.0, 2.0] };
    sheet.pins.push((1, pin));
    sheet.look.polar = true;
    let svg = drawn(&[sheet]);
    check(&svg);
    for expected in ["before &lt;it&gt;", "45°", "\u{2212}90°", "A", ">3<"] {
        assert!(svg.contains(expected), "no {expected} in:\n{svg}");
    }
}
