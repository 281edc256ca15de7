//! The ways in which a light answers a shading point.

use std::fmt;
use std::ops::RangeInclusive;
use std::str::FromStr;

use super::fit;
use crate::light::Shape;

/// How a light's contribution is computed. The names are the ones in files, on the command line, in plots and on
/// screen.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Method {
    /// Closed form, accurate to rounding.
    #[default]
    Exact,
    /// Lobe along a line replaced by a Chebyshev polynomial ([`crate::refs::POULIN_AMANATIDES_1990`], §4.1).
    Chebyshev {
        /// Of the polynomial.
        degree: u32,
        /// The lobe is cut where it is below one of so many grey levels.
        levels: u32,
    },
    /// Specular from the light's point of least angle to the mirror direction ([`crate::refs::PICOTT_1992`], §2.2, §3.2).
    NearestPoint,
    /// As [`Method::NearestPoint`] of a polygon, by [`crate::refs::PICOTT_1992`]'s own rule for its edges (§3.2).
    NearestPointPicott,
    /// Cubic Hermite fit with one segment ([`crate::refs::SNYDER_1996`], §2.2).
    Hermite1,
    /// Cubic Hermite fit with two segments ([`crate::refs::SNYDER_1996`], §2.2).
    Hermite2,
    /// A point light a component with the light of a disk about it ([`crate::refs::ONE_SHOT`]).
    OneShot,
    /// As [`Method::OneShot`], of a square.
    OneShotSquare,
    /// As [`Method::OneShot`], of a disk whose radius knows the light's size.
    OneShotSized,
    /// That many point lights spread over the light.
    PointCluster(u32),
    /// At most that many punctual lights, fitted to the light ([`super::fit`]).
    Fit(u32),
    /// One point light of the light's whole intensity at its middle.
    Point,
    /// Adaptive quadrature of the defining integral, with an error bound.
    Reference,
}

/// Points in `point-cluster` when no number is given.
const DEFAULT_CLUSTER: u32 = 16;

/// Lights in `fit` when no number is given.
const DEFAULT_FIT: u32 = 4;

/// A method name that is none.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error(
    "unknown method `{0}`: use exact, chebyshev[-DEGREE[-LEVELS]], nearest-point, nearest-point-picott, hermite-1, hermite-2, one-shot, one-shot-square, one-shot-sized, point-cluster[-N], fit-N, point or reference"
)]
pub struct UnknownMethod(String);

impl Method {
    /// The paper's own degree and levels.
    pub const CHEBYSHEV: Self = Self::Chebyshev { degree: 6, levels: 256 };

    /// Degrees of Chebyshev fits; the preview's lobes have room for the coefficients of the last.
    const DEGREES: RangeInclusive<u32> = 1..=15;

    /// Grey levels at which lobes are cut, up to what f32 tells apart.
    const LEVELS: RangeInclusive<u32> = 2..=1 << 24;

    /// The methods of a light shape, `exact` first, then its approximations, `point` and `reference`.
    pub fn of(shape: &Shape) -> &'static [Self] {
        const CLUSTER: Method = Method::PointCluster(DEFAULT_CLUSTER);
        const FIT: Method = Method::Fit(DEFAULT_FIT);
        match shape {
            Shape::Polygon(_) => &[
                Self::Exact,
                Self::NearestPoint,
                Self::NearestPointPicott,
                Self::OneShot,
                Self::OneShotSquare,
                Self::OneShotSized,
                CLUSTER,
                FIT,
                Self::Point,
                Self::Reference,
            ],
            Shape::Line(_) => {
                &[Self::Exact, Self::CHEBYSHEV, Self::NearestPoint, CLUSTER, FIT, Self::Point, Self::Reference]
            }
            Shape::Sphere(_) => {
                &[Self::Exact, Self::Hermite1, Self::Hermite2, CLUSTER, FIT, Self::Point, Self::Reference]
            }
            Shape::Cap(_) => &[Self::Exact, Self::Hermite1, Self::Hermite2, CLUSTER, FIT, Self::Point, Self::Reference],
            Shape::Disk(_) | Shape::Textured(_) => &[
                Self::Exact,
                Self::OneShot,
                Self::OneShotSquare,
                Self::OneShotSized,
                CLUSTER,
                FIT,
                Self::Point,
                Self::Reference,
            ],
            Shape::Sky(_) => &[Self::Exact, FIT, Self::Point, Self::Reference],
            Shape::Point(point) if point.ies.is_some() => &[Self::Exact, FIT],
            Shape::Point(_) | Shape::Directional(_) => &[Self::Exact],
        }
    }

    /// This method where the shape has it, else [`Method::Exact`].
    pub fn for_shape(self, shape: &Shape) -> Self {
        let has = Self::of(shape).iter().any(|method| std::mem::discriminant(method) == std::mem::discriminant(&self));
        if has { self } else { Self::Exact }
    }

    /// Whether it looks at the light from few directions, in which any lobe can be evaluated.
    pub fn takes_any_lobe(self) -> bool {
        matches!(
            self,
            Self::OneShot
                | Self::OneShotSquare
                | Self::OneShotSized
                | Self::PointCluster(_)
                | Self::Fit(_)
                | Self::Point
        )
    }

    /// The shape's first approximation, which the command line calls `approx`.
    pub fn first_approximation(shape: &Shape) -> Self {
        match shape {
            Shape::Polygon(_) => Self::NearestPoint,
            Shape::Line(_) => Self::CHEBYSHEV,
            Shape::Sphere(_) | Shape::Cap(_) => Self::Hermite1,
            Shape::Disk(_) | Shape::Textured(_) => Self::OneShot,
            Shape::Sky(_) | Shape::Point(_) | Shape::Directional(_) => Self::Exact,
        }
    }
}

/// The method of a name that has numbers in it.
fn with_numbers(name: &str) -> Option<Method> {
    if let Some(numbers) = name.strip_prefix("chebyshev-") {
        let (degree, levels) = numbers.split_once('-').unwrap_or((numbers, "256"));
        let (degree, levels) = (degree.parse().ok()?, levels.parse().ok()?);
        let fits = Method::DEGREES.contains(&degree) && Method::LEVELS.contains(&levels);
        return fits.then_some(Method::Chebyshev { degree, levels });
    }
    if let Some(number) = name.strip_prefix("fit-") {
        return number.parse().ok().filter(|count| fit::COUNTS.contains(count)).map(Method::Fit);
    }
    let points = name.strip_prefix("point-cluster-")?.parse().ok()?;
    (points > 0).then_some(Method::PointCluster(points))
}

impl fmt::Display for Method {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match *self {
            Self::Exact => f.pad("exact"),
            Self::CHEBYSHEV => f.pad("chebyshev"),
            Self::Chebyshev { degree, levels: 256 } => f.pad(&format!("chebyshev-{degree}")),
            Self::Chebyshev { degree, levels } => f.pad(&format!("chebyshev-{degree}-{levels}")),
            Self::NearestPoint => f.pad("nearest-point"),
            Self::NearestPointPicott => f.pad("nearest-point-picott"),
            Self::Hermite1 => f.pad("hermite-1"),
            Self::Hermite2 => f.pad("hermite-2"),
            Self::OneShot => f.pad("one-shot"),
            Self::OneShotSquare => f.pad("one-shot-square"),
            Self::OneShotSized => f.pad("one-shot-sized"),
            Self::PointCluster(DEFAULT_CLUSTER) => f.pad("point-cluster"),
            Self::PointCluster(points) => f.pad(&format!("point-cluster-{points}")),
            Self::Fit(lights) => f.pad(&format!("fit-{lights}")),
            Self::Point => f.pad("point"),
            Self::Reference => f.pad("reference"),
        }
    }
}

impl FromStr for Method {
    type Err = UnknownMethod;

    fn from_str(name: &str) -> Result<Self, UnknownMethod> {
        Ok(match name {
            "exact" => Self::Exact,
            "chebyshev" => Self::CHEBYSHEV,
            "nearest-point" => Self::NearestPoint,
            "nearest-point-picott" => Self::NearestPointPicott,
            "hermite-1" => Self::Hermite1,
            "hermite-2" => Self::Hermite2,
            "one-shot" => Self::OneShot,
            "one-shot-square" => Self::OneShotSquare,
            "one-shot-sized" => Self::OneShotSized,
            "point-cluster" => Self::PointCluster(DEFAULT_CLUSTER),
            "fit" => Self::Fit(DEFAULT_FIT),
            "point" => Self::Point,
            "reference" => Self::Reference,
            _ => with_numbers(name).ok_or_else(|| UnknownMethod(name.to_owned()))?,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_with_numbers_are_read_as_they_are_written() {
        for name in
            ["chebyshev", "chebyshev-8", "chebyshev-12-65536", "point-cluster", "point-cluster-3", "fit-1", "fit-32"]
        {
            let method: Method = name.parse().expect("a method");
            assert_eq!(method.to_string(), name, "as it was written");
        }
        assert_eq!("chebyshev-6-256".parse(), Ok(Method::CHEBYSHEV), "the usual one");
        for name in [
            "chebyshev-0",
            "chebyshev-16",
            "chebyshev-6-1",
            "chebyshev--6",
            "chebyshev-6-",
            "point-cluster-0",
            "fit-0",
            "fit-33",
            "fit-",
        ] {
            assert!(name.parse::<Method>().is_err(), "{name} is none");
        }
    }
}
