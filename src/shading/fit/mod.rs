//! `fit-N`: a light as the N punctual lights that come nearest to its exact illuminance.
//!
//! Most programs have no light but points, spots and parallel light. What they can show of a light at best is such a
//! fit: its strengths, places and cones are those of least squared error over a region about the light, found once a
//! shape. A flat light becomes spots in its own outline, whose cones together stand for its cosine; a line becomes
//! points, a tube points and spots, a sphere one point, which is exact; caps and skies become parallel lights, and a point
//! of measured intensities becomes spots and points in its place.
//!
//! **Region.** All places in the directions in which the light shines, from 7/8 of its size to eight times that, with
//! surfaces of every normal that sees the whole light; the size is the diameter of the ball about the light, and distances
//! are from its middle. Of caps and skies it is all normals, of points all directions. Errors are shares of the greatest illuminance at the same
//! distance.

mod canonical;
mod model;
mod punctual;
mod region;

pub use punctual::{Cone, Punctual};
pub use region::REACH;

use std::ops::RangeInclusive;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, OnceLock, PoisonError};

use canonical::{Canonical, Key};
use model::{Search, Start, residual, starts};
use region::{Receiver, Sampling, receivers};

use super::textured::quadrature::Sought;
use super::{Lobe, Response, ShadingPoint};
use crate::light::Emitter;
use crate::math::least_squares::least_squares;

/// How many lights a fit may have.
pub const COUNTS: RangeInclusive<u32> = 1..=32;

/// Punctual lights that stand for a light of unit strength.
#[derive(Clone, Debug)]
pub struct Fit {
    lights: Vec<Punctual>,
    /// Diameter of the ball about the light; none of points and of what is infinitely far away.
    size: Option<f64>,
    solution: Arc<Solution>,
    canonical: Option<Box<Canonical>>,
}

/// How far a fit is off over its region, in shares of the greatest illuminance at the same distance.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Deviation {
    /// Root of the mean squared error.
    pub rms: f64,
    /// The greatest error.
    pub worst: f64,
}

/// How many lights to take.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Budget {
    /// At most that many.
    Count(u32),
    /// As few as keep the worst error at most at that share, of [`COUNTS`] at most.
    Worst(f64),
}

impl Default for Budget {
    fn default() -> Self {
        Self::Count(4)
    }
}

/// A fit of a canonical light.
#[derive(Debug, Default)]
struct Solution {
    lights: Vec<Punctual>,
    deviation: OnceLock<Deviation>,
}

/// Steps from every start, and on from the best of them.
const STEPS: [u32; 2] = [12, 80];

/// Of so many starts the search goes on.
const CONTINUED: usize = 3;

/// Lights below this share of the strongest are left out.
const NEGLIGIBLE: f64 = 1e-9;

impl Fit {
    /// At most `count` lights for a light; none when cancelled. The result depends on nothing but the light.
    ///
    /// Fits are kept for the lights that used them last: one that moves, turns or is scaled keeps its fit.
    pub fn new(emitter: &Emitter, count: u32, cancel: Option<&AtomicBool>) -> Option<Self> {
        let count = count.clamp(*COUNTS.start(), *COUNTS.end());
        let Some(canonical) = Canonical::new(emitter) else { return Some(Self::of_itself(emitter)) };
        let solution = remembered(&canonical, count, cancel)?;
        let lights = solution.lights.iter().map(|light| canonical.placed(light)).collect();
        let has_size = !matches!(emitter, Emitter::Cap(_) | Emitter::Sky(_) | Emitter::Point(_));
        let size = has_size.then(|| canonical.size());
        Some(Self { lights, size, solution, canonical: Some(Box::new(canonical)) })
    }

    /// The fit of a budget; none when cancelled. Where no number of lights has so small an error, the best of them.
    pub fn within(emitter: &Emitter, budget: Budget, cancel: Option<&AtomicBool>) -> Option<Self> {
        let bound = match budget {
            Budget::Count(count) => return Self::new(emitter, count, cancel),
            Budget::Worst(bound) => bound,
        };
        let mut best: Option<(f64, Self)> = None;
        for count in [1, 2, 3, 4, 6, 8, 12, 16, 24, 32] {
            let fit = Self::new(emitter, count, cancel)?;
            let worst = fit.deviation(cancel)?.worst;
            if worst <= bound {
                return Some(fit);
            }
            if best.as_ref().is_none_or(|(least, _)| worst < *least) {
                best = Some((worst, fit));
            }
        }
        best.map(|(_, fit)| fit)
    }

    /// A light that is punctual already; nothing for one of no size.
    fn of_itself(emitter: &Emitter) -> Self {
        let lights = match emitter {
            Emitter::Point(light) => vec![Punctual::Point { position: light.position, intensity: 1.0 }],
            Emitter::Directional(light) => {
                vec![Punctual::Directional { to_light: light.to_light, illuminance: 1.0 }]
            }
            _ => Vec::new(),
        };
        Self { lights, size: None, solution: Arc::default(), canonical: None }
    }

    /// The lights, at unit strength.
    pub fn lights(&self) -> &[Punctual] {
        &self.lights
    }

    /// From where to where the region reaches, metres from the light's middle; none where it is all normals, or all directions.
    pub fn region(&self) -> Option<[f64; 2]> {
        self.size.map(|size| REACH.map(|distance| distance * size))
    }

    /// How far it is off over the region, at other places than those that it was made for; none when cancelled.
    pub fn deviation(&self, cancel: Option<&AtomicBool>) -> Option<Deviation> {
        let Some(canonical) = &self.canonical else { return Some(Deviation::default()) };
        if let Some(deviation) = self.solution.deviation.get() {
            return Some(*deviation);
        }
        let receivers = receivers(&canonical.emitter, &Sampling::JUDGE, Sought { cancel, ..Sought::PICTURE })?;
        Some(*self.solution.deviation.get_or_init(|| deviation(&receivers, &self.solution.lights)))
    }

    /// Response of all the lights.
    pub fn respond(&self, at: &ShadingPoint, lobe: &Lobe) -> Response {
        let (seen, factor) = lobe.seen(at);
        let mut sum = Response::default();
        for light in &self.lights {
            sum += light.respond(&seen, lobe);
        }
        Response { specular: factor * sum.specular, ..sum }
    }
}

fn deviation(receivers: &[Receiver], lights: &[Punctual]) -> Deviation {
    let lit = receivers.iter().filter(|receiver| receiver.is_lit());
    let squares: Vec<f64> =
        lit.map(|receiver| residual(receiver, lights).iter().map(|part| part * part).sum()).collect();
    let mean = squares.iter().sum::<f64>() / squares.len().max(1) as f64;
    Deviation { rms: mean.sqrt(), worst: squares.iter().copied().fold(0.0, f64::max).sqrt() }
}

/// Fits that are kept.
const REMEMBERED: usize = 64;

/// A fit that is kept.
struct Remembered {
    key: Key,
    count: u32,
    solution: Arc<Solution>,
}

/// The fit of a canonical light, from the last ones or made now; none when cancelled. Nobody waits for another's fit.
fn remembered(canonical: &Canonical, count: u32, cancel: Option<&AtomicBool>) -> Option<Arc<Solution>> {
    static FITS: Mutex<Vec<Remembered>> = Mutex::new(Vec::new());
    let fits = || FITS.lock().unwrap_or_else(PoisonError::into_inner);
    if let Some(solution) = recalled(&mut fits(), canonical, count) {
        return Some(solution);
    }
    let lights = solve(canonical, count, cancel)?;
    let mut fits = fits();
    if let Some(solution) = recalled(&mut fits, canonical, count) {
        return Some(solution);
    }
    let solution = Arc::new(Solution { lights, ..Solution::default() });
    fits.push(Remembered { key: canonical.key.clone(), count, solution: Arc::clone(&solution) });
    let excess = fits.len().saturating_sub(REMEMBERED);
    fits.drain(..excess);
    Some(solution)
}

/// The fit of a canonical light, if it is known; it is then the last that was used.
fn recalled(fits: &mut Vec<Remembered>, canonical: &Canonical, count: u32) -> Option<Arc<Solution>> {
    let found = fits.iter().position(|known| known.count == count && known.key == canonical.key)?;
    let known = fits.remove(found);
    let solution = Arc::clone(&known.solution);
    fits.push(known);
    Some(solution)
}

/// The lights of least squared error; none when cancelled.
fn solve(canonical: &Canonical, count: u32, cancel: Option<&AtomicBool>) -> Option<Vec<Punctual>> {
    let mut receivers = receivers(&canonical.emitter, &Sampling::FIT, Sought { cancel, ..Sought::PICTURE })?;
    receivers.retain(Receiver::is_lit);
    let is_cancelled = || cancel.is_some_and(|cancel| cancel.load(Ordering::Relaxed));
    let improved = |start: &Start, mut x: Vec<f64>, steps: u32| {
        let search = Search { start, receivers: &receivers };
        least_squares(&search, &mut x, &start.bounds, steps, is_cancelled).map(|sum| (sum, x))
    };
    let mut found = Vec::new();
    for start in starts(canonical, count) {
        let (sum, x) = improved(&start, start.parameters.clone(), STEPS[0])?;
        found.push((sum, x, start));
    }
    found.sort_by(|(a, ..), (b, ..)| a.total_cmp(b));
    let mut best: Option<(f64, Vec<f64>, Start)> = None;
    for (_, x, start) in found.into_iter().take(CONTINUED) {
        let (sum, x) = improved(&start, x, STEPS[1])?;
        if best.as_ref().is_none_or(|(least, ..)| sum < *least) {
            best = Some((sum, x, start));
        }
    }
    let Some((_, x, start)) = best else { return Some(Vec::new()) };
    let mut lights = start.lights(&x);
    let strongest = lights.iter().map(Punctual::strength).fold(0.0, f64::max);
    lights.retain(|light| light.strength() > NEGLIGIBLE * strongest);
    Some(lights)
}
