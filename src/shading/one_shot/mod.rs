//! One-shot: a flat light as one point light a shading component, placed and weighed for the point that is shaded.
//!
//! The point light stands where the component finds the light's plane brightest, and has the light of a neighbourhood
//! whose radius is a share of its distance. Its cost does not depend on the pattern.
//!
//! **Source:** [`crate::refs::ONE_SHOT`].

mod brightest;
mod fit;
mod grid;
mod kernel;
mod mipmap;
mod prefiltered;

pub use brightest::{Axis, FARTHEST, Spot, View, brightest_step};
pub use fit::{Component, Fit, Sample, Samples, error_at, fit};
pub use grid::{Frame, Grid, SIDE};
pub use kernel::{DiskTable, LEVELS, REACH, TABLE_SIDE};
pub use mipmap::Mipmap;
pub use prefiltered::{KNOTS, Kernel, Prefiltered};

use std::sync::Arc;

use glam::{DVec2, DVec3};

use super::{Lobe, Method, Response, ShadingPoint};
use crate::light::Emitter;

/// How the radius of the neighbourhood follows from the point light's distance.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Radius {
    /// α|pt| and β|pt|/n, fitted to the light for that kernel.
    Fitted(Kernel),
    /// [`sized_radius`], by the light's own radius; the kernel is a disk.
    Sized,
}

/// A flat light, ready for one-shot.
#[derive(Clone, Debug)]
pub struct OneShot {
    frame: Frame,
    pattern: Arc<Prefiltered>,
    radius: Radius,
}

impl Radius {
    /// The rule of a method that is one-shot.
    pub fn of(method: Method) -> Option<Self> {
        match method {
            Method::OneShot => Some(Self::Fitted(Kernel::Disk)),
            Method::OneShotSquare => Some(Self::Fitted(Kernel::Square)),
            Method::OneShotSized => Some(Self::Sized),
            _ => None,
        }
    }

    /// The kernel that it is the radius of.
    pub fn kernel(self) -> Kernel {
        match self {
            Self::Fitted(kernel) => kernel,
            Self::Sized => Kernel::Disk,
        }
    }
}

/// r = a·d/√(1 + (c·d/R)²), the radius about a point at distance d of a light of radius R, all in one unit.
///
/// For an eye that faces a uniform disk the intensity sought is ∫ cosⁿ dω·d² = 2π/(n+1)·(1 − (1 + R²/d²)^(−(n+1)/2))·d².
/// With a = c = √(2/(n+1)) r has the limits of its root over π: a·d close by, and R far away; for n = 1 they agree at
/// all distances. Of a specular lobe c is 6a/7: with it the mean error over a uniform disk is a tenth less for n = 3,
/// a quarter for n = 31.
///
/// **Source:** derived here.
pub fn sized_radius(distance: f64, radius: f64, component: Component) -> f64 {
    let (n, far) = match component {
        Component::Diffuse => (1.0, radius),
        Component::Specular(n) => (n, radius * 7.0 / 6.0),
    };
    let near = distance * (2.0 / (n + 1.0)).sqrt();
    near * far / far.hypot(near)
}

impl OneShot {
    /// A light for a method; none where the method is another, or the light is not flat or has no size.
    pub fn new(emitter: &Emitter, method: Method) -> Option<Self> {
        let radius = Radius::of(method)?;
        let (frame, pattern) = Prefiltered::of(emitter)?;
        Some(Self { frame, pattern, radius })
    }

    /// Where the light is.
    pub fn frame(&self) -> &Frame {
        &self.frame
    }

    /// Its pattern.
    pub fn pattern(&self) -> &Arc<Prefiltered> {
        &self.pattern
    }

    /// Its rule for the radius.
    pub fn radius(&self) -> Radius {
        self.radius
    }

    /// Response of the light of unit luminance.
    ///
    /// E = V·cosθ_l·cosθ/d² at the point light of the diffuse component, S = V·cosθ_l·ρ(ω)/d² at that of the specular
    /// one, V = ∫ L dA over their neighbourhoods. The specular point light is that of a cosine lobe about the mirror
    /// direction: of [`Lobe::cosine_exponent`], where the lobe is another. Below the surface's horizon it adds nothing.
    ///
    /// **Accuracy:** of the method, see `closed_form::one_shot`.
    pub fn respond(&self, at: &ShadingPoint, lobe: &Lobe) -> Response {
        let Some((view, ahead)) = self.view(at.p) else { return Response::default() };
        let axis = |v: DVec3| Axis::new(self.frame.flat(v) * self.frame.texel, -v.dot(ahead));
        let irradiance = view
            .brightest(&axis(at.n), 1.0)
            .map_or(0.0, |spot| spot.falloff * spot.cosine.max(0.0) * self.intensity(&spot, Component::Diffuse));
        let (seen, factor) = lobe.seen(at);
        let (r, n) = (seen.mirror(), lobe.cosine_exponent());
        let specular = view.brightest(&axis(r), n).map_or(0.0, |spot| {
            let Frame { axis_u, axis_v, .. } = self.frame;
            let w = (spot.step.x * axis_u + spot.step.y * axis_v + view.height * ahead) / spot.distance;
            if at.n.dot(w) <= 0.0 {
                return 0.0;
            }
            factor * spot.falloff * lobe.density(at.n, r, w) * self.intensity(&spot, Component::Specular(n))
        });
        Response { irradiance, specular }
    }

    /// The point as the light's plane sees it, and the unit direction from it to the plane; none behind the light and
    /// in its plane.
    fn view(&self, p: DVec3) -> Option<(View, DVec3)> {
        let Frame { center, normal, two_sided, texel, .. } = self.frame;
        let from_center = p - center;
        let height = from_center.dot(normal);
        let foot = self.frame.flat(from_center);
        let lit = height > 0.0 || (two_sided && height < 0.0);
        let height_texels = height.abs() / texel;
        let clear = height_texels > IN_PLANE * (foot.length() + SIDE as f64);
        (lit && clear).then(|| (View { foot, height: height_texels }, -normal * height.signum()))
    }

    /// ∫ L dA over the neighbourhood of a component's spot, in texels².
    fn intensity(&self, spot: &Spot, component: Component) -> f64 {
        let radius = match (self.radius, component) {
            (Radius::Sized, _) => sized_radius(spot.distance, self.pattern.radius(), component),
            (Radius::Fitted(kernel), Component::Diffuse) => self.pattern.alpha(kernel) * spot.distance,
            (Radius::Fitted(kernel), Component::Specular(n)) => self.pattern.specular_share(kernel, n) * spot.distance,
        };
        // Along a round pattern's first axis, so that it is round by its table too.
        let place = if self.frame.is_round { DVec2::new(spot.place.length(), 0.0) } else { spot.place };
        self.pattern.sum(self.radius.kernel(), place, radius)
    }
}

/// Heights over the light's plane that are below this share of the distance are rounding.
const IN_PLANE: f64 = 1e-14;
