//! Which method shades each light.

use std::fmt;
use std::str::FromStr;

use crate::light::Shape;
use crate::shading::{Method, UnknownMethod};

/// One method for all lights, or for each light its first approximation.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MethodChoice {
    /// This method where a light has it, else exact.
    Method(Method),
    /// Each light's first approximation: `approx`.
    Approx,
}

impl MethodChoice {
    /// The method for a light of this shape.
    pub fn for_shape(self, shape: &Shape) -> Method {
        match self {
            Self::Method(method) => method.for_shape(shape),
            Self::Approx => Method::first_approximation(shape),
        }
    }
}

impl Default for MethodChoice {
    fn default() -> Self {
        Self::Method(Method::default())
    }
}

impl fmt::Display for MethodChoice {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Method(method) => method.fmt(f),
            Self::Approx => f.pad("approx"),
        }
    }
}

impl FromStr for MethodChoice {
    type Err = UnknownMethod;

    fn from_str(name: &str) -> Result<Self, UnknownMethod> {
        if name == "approx" { Ok(Self::Approx) } else { name.parse().map(Self::Method) }
    }
}
