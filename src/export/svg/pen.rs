//! How the curve of a method is drawn.

use crate::shading::Method;

/// Colour and dashes of a curve.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Pen {
    /// As `#rrggbb`.
    pub(super) color: &'static str,
    /// Lengths of dashes and gaps in turn; empty for a line without gaps.
    pub(super) dashes: &'static str,
}

impl Pen {
    /// The pen of a method.
    ///
    /// The approximations have Okabe and Ito's colours, which colour-blind readers tell apart ("Color Universal
    /// Design", 2008); dashes tell them apart without colours.
    pub(super) const fn of(method: Method) -> Self {
        let (color, dashes) = match method {
            Method::Exact => ("#22262b", ""),
            Method::Chebyshev => ("#0072b2", "9 3"),
            Method::NearestPoint => ("#009e73", "6 2.5"),
            Method::Hermite1 => ("#56b4e9", "12 3"),
            Method::Hermite2 => ("#cc79a7", "5 2.5 2.5 2.5"),
            Method::PointCluster(_) => ("#e69f00", "3.5 2"),
            Method::Point => ("#d55e00", "9 2.5 2 2.5"),
            Method::Reference => ("#6b7480", "1.2 2.8"),
        };
        Self { color, dashes }
    }
}
