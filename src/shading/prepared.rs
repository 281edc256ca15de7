//! A light prepared for one method.

use std::sync::OnceLock;
use std::sync::atomic::{AtomicBool, Ordering};

use super::fit::Fit;
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
    /// Made when it is first needed.
    fit: OnceLock<Fit>,
    sought: Sought<'static>,
}

impl Prepared {
    /// The light as `method` needs it; see [`respond`](super::respond) for methods that the light does not have.
    pub fn new(emitter: &Emitter, method: Method) -> Self {
        Self {
            emitter: emitter.clone(),
            method,
            one_shot: OneShot::new(emitter, method),
            fit: OnceLock::new(),
            sought: Sought::default(),
        }
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
        self.respond_seeking(at, lobe, self.sought).unwrap_or_default()
    }

    /// [`Self::respond`], with the reference's bounds, none for other methods; given up when `cancel` is set while it is at
    /// work, as quadrature over a large pattern takes seconds.
    pub fn respond_unless(&self, at: &ShadingPoint, lobe: &PhongLobe, cancel: &AtomicBool) -> Option<BoundedResponse> {
        if self.method == Method::Reference {
            return reference_unless(&self.emitter, at, lobe, cancel);
        }
        let response = self.respond_seeking(at, lobe, Sought { cancel: Some(cancel), ..self.sought })?;
        (!cancel.load(Ordering::Relaxed)).then(|| response.into())
    }

    /// The response; none when cancelled before there was one.
    fn respond_seeking(&self, at: &ShadingPoint, lobe: &PhongLobe, sought: Sought<'_>) -> Option<Response> {
        if let Some(one_shot) = &self.one_shot {
            return Some(one_shot.respond(at, lobe));
        }
        if let Method::Fit(count) = self.method {
            return Some(self.fit(count, sought.cancel)?.respond(at, lobe));
        }
        Some(answer(&self.emitter, self.method, at, lobe, sought))
    }

    /// The fit of so many lights; none when cancelled.
    fn fit(&self, count: u32, cancel: Option<&AtomicBool>) -> Option<&Fit> {
        match self.fit.get() {
            Some(fit) => Some(fit),
            None => {
                let fit = Fit::new(&self.emitter, count, cancel)?;
                Some(self.fit.get_or_init(|| fit))
            }
        }
    }
}
