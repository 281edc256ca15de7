//! A light prepared for one method.

use std::sync::atomic::{AtomicBool, Ordering};

use super::one_shot::OneShot;
use super::reference::{BoundedResponse, reference_unless};
use super::textured::quadrature::Sought;
use super::{Method, PhongLobe, Response, ShadingPoint, answer};
use crate::light::Emitter;

/// A light, and what a method computes of it once.
#[derive(Clone, Debug)]
pub struct Prepared {
    emitter: Emitter,
    method: Method,
    one_shot: Option<OneShot>,
    sought: Sought<'static>,
}

impl Prepared {
    /// The light as `method` needs it; see [`respond`](super::respond) for methods that the light does not have.
    pub fn new(emitter: &Emitter, method: Method) -> Self {
        Self { emitter: emitter.clone(), method, one_shot: OneShot::new(emitter, method), sought: Sought::default() }
    }

    /// The same for pictures: what is had by adaptive quadrature only, a textured light's exact response, need be no
    /// surer than [`Sought::PICTURE`].
    pub fn for_pictures(self) -> Self {
        Self { sought: Sought::PICTURE, ..self }
    }

    /// The light.
    pub fn emitter(&self) -> &Emitter {
        &self.emitter
    }

    /// The method.
    pub fn method(&self) -> Method {
        self.method
    }

    /// The unit-strength response at a point.
    pub fn respond(&self, at: &ShadingPoint, lobe: &PhongLobe) -> Response {
        match &self.one_shot {
            Some(one_shot) => one_shot.respond(at, lobe),
            None => answer(&self.emitter, self.method, at, lobe, self.sought),
        }
    }

    /// [`Self::respond`], with the reference's bounds, none for other methods; given up when `cancel` is set while it is at
    /// work, as quadrature over a large pattern takes seconds.
    pub fn respond_unless(&self, at: &ShadingPoint, lobe: &PhongLobe, cancel: &AtomicBool) -> Option<BoundedResponse> {
        if self.method == Method::Reference {
            return reference_unless(&self.emitter, at, lobe, cancel);
        }
        let sought = Sought { cancel: Some(cancel), ..self.sought };
        let response = match &self.one_shot {
            Some(one_shot) => one_shot.respond(at, lobe),
            None => answer(&self.emitter, self.method, at, lobe, sought),
        };
        (!cancel.load(Ordering::Relaxed)).then(|| response.into())
    }
}
