//! Chebyshev's fits of Phong's lobe: a fit is of one exponent, so that exported functions have those of some.

use super::constants::{number, vector};
use super::items::Item;
use super::part::Part;
use crate::gpu::lobes;
use crate::scene::Scene;
use crate::shading::{Lobe, Method};
use crate::surface::ReflectionModel;

/// There is a fit of each power of two up to this one.
const OCTAVES: i32 = 10;

/// The exponents of the scene's materials, and powers of two: the nearest of any is within a factor of √2, to 1448.
pub(super) fn exponents(scene: &Scene) -> Vec<f64> {
    let of_scene = scene.materials.iter().filter(|material| matches!(material.model, ReflectionModel::Phong {}));
    let octaves = (0..=OCTAVES).map(|octave| 2.0_f64.powi(octave));
    let mut exponents: Vec<f64> = of_scene.map(|material| material.exponent).chain(octaves).collect();
    exponents.sort_by(f64::total_cmp);
    exponents.dedup();
    exponents
}

/// The fits, where a part needs them.
pub(super) fn fits(scene: &Scene, parts: &[Part]) -> Vec<Item> {
    let Some(method) = parts.iter().map(|part| part.method).find(|method| matches!(method, Method::Chebyshev { .. }))
    else {
        return Vec::new();
    };
    let fits: Vec<_> = exponents(scene).into_iter().filter_map(|exponent| fit(exponent, method)).collect();
    let count = fits.len();
    let table = format!("// By exponent.\nconst FITS = array<Fit, {count}>(\n    {},\n);\n", fits.join(",\n    "));
    let item = |name: &str, text: String| Item { name: name.to_owned(), text };
    vec![item("FITS", table), item("FIT_COUNT", format!("const FIT_COUNT = {count}u;\n"))]
}

fn fit(exponent: f64, method: Method) -> Option<String> {
    let lobe = lobes::lobe(&Lobe::new(exponent), method);
    let numbers: Option<Vec<_>> =
        [lobe.exponent, lobe.chebyshev_cut, lobe.chebyshev_tan_cut].into_iter().map(number).collect();
    let mean: Option<Vec<_>> = lobe.chebyshev_mean.iter().map(|quad| vector(quad)).collect();
    Some(format!("Fit({}, array<vec4f, 4>({}))", numbers?.join(", "), mean?.join(", ")))
}
