//! Mathematics that knows nothing of lights: angles, frames, spherical clipping, triangulation, quadrature, least squares, special functions.

pub mod angle;
pub mod chebyshev;
pub mod frame;
pub mod interpolation;
pub mod least_squares;
pub mod quadrature;
pub mod special;
pub mod spherical;
pub mod triangulate;
