//! The reference cases of `tests/data/reference`, made by high-precision quadrature of the defining integrals only.

use std::path::Path;

use glam::DVec3;
use serde_json::Value;

/// One reference case.
pub(crate) struct Case(Value);

/// All cases of a model, in the file's order.
pub(crate) fn load(model: &str) -> Vec<Case> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data/reference").join(model).with_extension("json");
    let text = std::fs::read_to_string(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
    let mut file: Value = serde_json::from_str(&text).expect("a reference file is JSON");
    let Value::Array(cases) = file["cases"].take() else { panic!("{} has no cases", path.display()) };
    cases.into_iter().map(Case).collect()
}

impl Case {
    /// The case's name.
    pub(crate) fn id(&self) -> &str {
        self.0["id"].as_str().expect("a case has an id")
    }

    /// A vector among the inputs.
    pub(crate) fn vector(&self, name: &str) -> DVec3 {
        vector(&self.0["inputs"][name])
    }

    /// A direction among the inputs, normalised.
    pub(crate) fn direction(&self, name: &str) -> DVec3 {
        self.vector(name).normalize()
    }

    /// A list of vectors among the inputs.
    pub(crate) fn vectors(&self, name: &str) -> Vec<DVec3> {
        self.0["inputs"][name].as_array().expect("a list of vectors").iter().map(vector).collect()
    }

    /// A number among the inputs.
    pub(crate) fn number(&self, name: &str) -> f64 {
        self.0["inputs"][name].as_f64().expect("a number")
    }

    /// A word among the inputs.
    pub(crate) fn text(&self, name: &str) -> &str {
        self.0["inputs"][name].as_str().expect("a word")
    }

    /// A value that stands beside the inputs, such as `expected`.
    pub(crate) fn value(&self, name: &str) -> f64 {
        self.0[name].as_f64().expect("a number")
    }

    /// Relative change of the exact answer when the inputs are rounded to binary64 about p.
    pub(crate) fn rounding(&self) -> f64 {
        self.0["f64_rounding_rel"].as_f64().unwrap_or(0.0)
    }
}

fn vector(value: &Value) -> DVec3 {
    let component = |i: usize| value[i].as_f64().expect("a component");
    DVec3::new(component(0), component(1), component(2))
}

/// The worst deviations over a file: absolute in units of the scale, and relative where the value is no trifle.
#[derive(Default)]
pub(crate) struct Worst {
    of_scale: (f64, String),
    relative: (f64, String),
}

impl Worst {
    /// Takes a case in, and holds it to |x − expected| ≤ (1e-10 + 50 δ)·expected + 1e-13·scale.
    #[track_caller]
    pub(crate) fn check(&mut self, case: &Case, x: f64, expected: f64, scale: f64) {
        let deviation = (x - expected).abs();
        let allowed = (1e-10 + 50.0 * case.rounding()) * expected.abs() + 1e-13 * scale;
        assert!(deviation <= allowed, "{}: {x:e} for {expected:e}, off by {deviation:e} > {allowed:e}", case.id());
        let beyond_rounding = (deviation - 50.0 * case.rounding() * expected.abs()).max(0.0);
        if scale > 0.0 && beyond_rounding / scale > self.of_scale.0 {
            self.of_scale = (beyond_rounding / scale, case.id().to_owned());
        }
        if expected > 1e-6 * scale && beyond_rounding / expected > self.relative.0 {
            self.relative = (beyond_rounding / expected, case.id().to_owned());
        }
    }

    /// Prints the worst cases, and holds them to the bounds that the documentation states.
    #[track_caller]
    pub(crate) fn finish(&self, what: &str, of_scale: f64, relative: f64) {
        println!(
            "{what}: of scale {:.1e} ({}), relative {:.1e} ({})",
            self.of_scale.0, self.of_scale.1, self.relative.0, self.relative.1
        );
        assert!(self.of_scale.0 <= of_scale, "{what}: {:e} of the scale in {}", self.of_scale.0, self.of_scale.1);
        assert!(self.relative.0 <= relative, "{what}: {:e} relative in {}", self.relative.0, self.relative.1);
    }
}
