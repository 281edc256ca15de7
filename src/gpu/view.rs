//! How a scene is looked at, and what looking cost.

use crate::render::false_colour::Scale;
use crate::scene::Camera;
use crate::shading::Method;

/// How a scene is looked at.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct View {
    /// From where.
    pub camera: Camera,
    /// Size in pixels; at least 1.
    pub size: [u32; 2],
    /// By which method; a shape that does not have it, and [`Method::Reference`], answer as [`Method::Exact`].
    pub method: Method,
    /// Exposure: at 0, 100 cd/m² is white.
    pub exposure_ev: f64,
    /// Draw polygons and spheres of light themselves.
    pub show_emitters: bool,
    /// Surfaces cast shadows.
    pub shadows: bool,
    /// While nothing changes, each call adds a sample a pixel until the picture has converged.
    pub refine: bool,
    /// What the picture shows.
    pub display: Display,
}

/// What a picture shows of radiance and illuminance.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Display {
    /// What the camera sees.
    #[default]
    Picture,
    /// The same, beside it by another method.
    Split {
        /// The other method.
        against: Method,
        /// Where it begins, as a share of the width.
        at: f64,
    },
    /// Luminance less that by another method, in the colours of [`diverging`](crate::render::false_colour::diverging).
    Difference {
        /// The other method.
        against: Method,
        /// As a share of the other method's luminance; else in cd/m².
        relative: bool,
        /// Where the colours end, above 0.
        end: f64,
    },
    /// Illuminance, lx, in the colours of [`sequential`](crate::render::false_colour::sequential).
    Illuminance {
        /// What the colours stand for.
        scale: Scale,
        /// With lines at the scale's levels.
        isolines: bool,
    },
    /// Within which of [`TOLERANCES`](crate::render::false_colour::TOLERANCES) of another method, in the colours of
    /// [`bands`](crate::render::false_colour::bands).
    Bands {
        /// The other method.
        against: Method,
        /// Of illuminance; else of luminance.
        illuminance: bool,
    },
}

impl Display {
    /// The method that the view's is compared with.
    pub fn against(&self) -> Option<Method> {
        match self {
            Self::Picture | Self::Illuminance { .. } => None,
            Self::Split { against, .. } | Self::Difference { against, .. } | Self::Bands { against, .. } => {
                Some(*against)
            }
        }
    }
}

/// How often each step was done since the preview was made.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Stats {
    /// Passes that found what the camera sees.
    pub g_buffers: u64,
    /// Passes that shaded one light.
    pub layers: u64,
    /// Passes that cast rays at one light.
    pub shadows: u64,
    /// Sums of the layers, exposed and tone-mapped.
    pub composites: u64,
}

impl std::ops::Add for Stats {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        Self {
            g_buffers: self.g_buffers + other.g_buffers,
            layers: self.layers + other.layers,
            shadows: self.shadows + other.shadows,
            composites: self.composites + other.composites,
        }
    }
}
