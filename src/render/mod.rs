//! CPU pictures: what each ray of a camera sees, over all cores.
//!
//! Radiance is linear, in cd/m² of linear Rec. 709 RGB. The same scene and settings give the same picture, whatever
//! the number of cores.

pub mod bounds;
mod choice;
mod emitters;
pub mod false_colour;
mod film;
mod geometry;
mod lighting;
mod shadow;
pub mod thumbnail;
mod tone;

pub use choice::MethodChoice;
pub use emitters::{PlacedEmitter, intersect_emitter};
pub use film::Film;
pub use geometry::{Geometry, Seen, Thing};
pub use lighting::{Lighting, Outgoing, Reflection, lobe_of};
pub use shadow::Precision;
pub use tone::{encode_srgb, expose, pbr_neutral};

use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};

use glam::{DVec2, DVec3};
use rayon::prelude::*;

use crate::scene::{Camera, Scene};
use crate::visibility::Structures;

/// Edge of the square of pixels that is one piece of work.
const TILE: u32 = 32;

/// Rays that first look at a pixel.
const SCOUTS: usize = 4;

/// How far in sRGB steps a pixel's first rays may differ from the first of them and be enough.
const SAME_LOOK: u8 = 1;

/// How to render.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Settings {
    /// Width and height in pixels.
    pub size: [u32; 2],
    /// How lights are shaded.
    pub choice: MethodChoice,
    /// Most rays a pixel, at least 1; a single one goes through the pixel's centre. Where nothing changes across a
    /// pixel, four are used.
    pub samples: u32,
    /// Whether surfaces cast shadows, and how what casts them is found.
    pub shadows: Shadows,
}

/// Whether surfaces cast shadows.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Shadows {
    /// Every light reaches everything.
    None,
    /// They do; what casts them is found by these structures.
    Cast(Structures),
}

impl Default for Shadows {
    fn default() -> Self {
        Self::Cast(Structures::default())
    }
}

/// How far the work is, and whether to stop; shared between threads.
#[derive(Debug, Default)]
pub struct Progress {
    done: AtomicU64,
    cancelled: AtomicBool,
}

impl Progress {
    /// Steps finished: pixels, where the work is a picture.
    pub fn done(&self) -> u64 {
        self.done.load(Ordering::Relaxed)
    }

    /// Count steps as finished.
    pub fn advance(&self, steps: u64) {
        self.done.fetch_add(steps, Ordering::Relaxed);
    }

    /// What turns true when an early end is asked for.
    pub fn cancelled(&self) -> &AtomicBool {
        &self.cancelled
    }

    /// Ask for an early end.
    pub fn cancel(&self) {
        self.cancelled.store(true, Ordering::Relaxed);
    }

    /// Whether an early end was asked for.
    pub fn is_cancelled(&self) -> bool {
        self.cancelled.load(Ordering::Relaxed)
    }
}

/// The picture of a scene; none when cancelled.
pub fn render(scene: &Scene, settings: &Settings, progress: &Progress) -> Option<Film> {
    let (geometry, lighting) = prepare(scene, settings.choice, settings.shadows);
    let view = View {
        geometry,
        lighting: lighting.for_pictures(),
        reflections: scene.materials.iter().map(Reflection::new).collect(),
        camera: scene.camera,
        size: DVec2::from(settings.size.map(f64::from)),
        offsets: pixel_offsets(settings.samples),
        exposure_ev: scene.display.exposure_ev,
    };
    let [width, height] = settings.size;
    let columns = width.div_ceil(TILE);
    let tiles: Option<Vec<_>> = (0..columns * height.div_ceil(TILE))
        .into_par_iter()
        .map(|tile| {
            let (x, y) = (tile % columns * TILE, tile / columns * TILE);
            let pixels = view.tile(x..(x + TILE).min(width), y..(y + TILE).min(height), progress)?;
            Some((x, y, pixels))
        })
        .collect();
    let mut film = Film::new(settings.size);
    for (x, y, pixels) in tiles? {
        film.put_tile([x, y], TILE.min(width - x), &pixels);
    }
    Some(film)
}

/// A scene's surfaces and lights, prepared for rays and shading.
pub fn prepare(scene: &Scene, choice: MethodChoice, shadows: Shadows) -> (Geometry, Lighting) {
    let lighting = Lighting::new(scene, choice);
    match shadows {
        Shadows::None => (Geometry::new(scene), lighting),
        Shadows::Cast(structures) => {
            let geometry = Geometry::with_structures(scene, structures);
            let lighting = lighting.with_shadows(geometry.objects());
            (geometry, lighting)
        }
    }
}

/// One pixel: radiance, and what a display shows of it.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
struct Pixel {
    radiance: DVec3,
    display: DVec3,
}

impl Pixel {
    fn add(&mut self, other: Self) {
        self.radiance += other.radiance;
        self.display += other.display;
    }

    fn mean(self, rays: usize) -> Self {
        let share = (rays as f64).recip();
        Self { radiance: share * self.radiance, display: share * self.display }
    }
}

/// What a ray shows, as an eye would tell it from another.
#[derive(Clone, Copy)]
struct Look {
    thing: Option<Thing>,
    srgb: [u8; 3],
}

impl Look {
    /// Whether both show the same thing, within [`SAME_LOOK`].
    fn resembles(&self, other: &Self) -> bool {
        self.thing == other.thing && self.srgb.iter().zip(other.srgb).all(|(a, b)| a.abs_diff(b) <= SAME_LOOK)
    }
}

/// Everything that a ray needs to know.
struct View {
    geometry: Geometry,
    lighting: Lighting,
    reflections: Vec<Reflection>,
    camera: Camera,
    size: DVec2,
    offsets: Vec<DVec2>,
    exposure_ev: f64,
}

impl View {
    fn tile(&self, xs: std::ops::Range<u32>, ys: std::ops::Range<u32>, progress: &Progress) -> Option<Vec<Pixel>> {
        let mut pixels = Vec::with_capacity(xs.len() * ys.len());
        for y in ys {
            for x in xs.clone() {
                if progress.is_cancelled() {
                    return None;
                }
                pixels.push(self.pixel(DVec2::new(f64::from(x), f64::from(y))));
            }
        }
        progress.advance(pixels.len() as u64);
        Some(pixels)
    }

    /// The mean over a pixel's rays. Each is exposed and tone-mapped before it is averaged, so that the edge of
    /// something far brighter than white stays smooth.
    ///
    /// Where the first few rays meet the same thing and look the same, they are enough.
    fn pixel(&self, corner: DVec2) -> Pixel {
        let (scouts, others) = self.offsets.split_at(SCOUTS.min(self.offsets.len()));
        let mut sum = Pixel::default();
        let mut looks: Option<Look> = None;
        let mut differ = false;
        for &offset in scouts {
            let (pixel, thing) = self.ray(corner + offset);
            let look = Look { thing, srgb: encode_srgb(pixel.display) };
            differ |= !looks.get_or_insert(look).resembles(&look);
            sum.add(pixel);
        }
        if !differ {
            return sum.mean(scouts.len());
        }
        others.iter().for_each(|&offset| sum.add(self.ray(corner + offset).0));
        sum.mean(self.offsets.len())
    }

    /// What one ray shows, and what it meets.
    fn ray(&self, at: DVec2) -> (Pixel, Option<Thing>) {
        let direction = self.camera.ray_direction(at.x, at.y, self.size.x, self.size.y);
        let seen = self.geometry.nearest(self.camera.eye, direction);
        let radiance = seen.map_or_else(|| self.geometry.background(direction), |seen| self.radiance(&seen, direction));
        (Pixel { radiance, display: pbr_neutral(expose(radiance, self.exposure_ev)) }, seen.map(|seen| seen.thing))
    }

    /// L_out of what a ray meets, towards its origin, cd/m².
    fn radiance(&self, seen: &Seen, direction: DVec3) -> DVec3 {
        match seen.thing {
            Thing::Light(light) => self.geometry.emitted(light, seen.p),
            Thing::Surface(surface) => {
                let Some(reflection) = self.geometry.material(surface).and_then(|m| self.reflections.get(m)) else {
                    return DVec3::ZERO;
                };
                self.lighting.outgoing_on(surface, reflection, &seen.shading_point(direction)).radiance
            }
        }
    }
}

/// Where in a pixel its rays go: the Hammersley set, one in each of `samples` columns and, for powers of two, rows. The
/// scouts come first, spread over it.
pub fn pixel_offsets(samples: u32) -> Vec<DVec2> {
    let samples = samples.max(1);
    let half = 0.5 / f64::from(samples);
    let mut offsets: Vec<_> = (0..samples)
        .map(|i| {
            let column = f64::from(i) / f64::from(samples);
            // The radical inverse in base 2 lies on multiples of 1/samples when that is a power of two.
            let row = f64::from(i.reverse_bits()) / 2.0_f64.powi(32);
            DVec2::new(column + half, row + half)
        })
        .collect();
    if offsets.len() > SCOUTS {
        // Of 16 points, the 0th, 5th, 10th and 15th lie in different quarters both ways.
        for scout in 0..SCOUTS {
            offsets.swap(scout, scout * (samples as usize - 1) / (SCOUTS - 1));
        }
    }
    offsets
}

#[cfg(test)]
mod tests;
