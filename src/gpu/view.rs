//! How a scene is looked at, and what looking cost.

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
