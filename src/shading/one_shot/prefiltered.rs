//! What one-shot needs of a pattern, computed once and shared by all lights that have it.

use std::fmt;
use std::sync::{Arc, Mutex, OnceLock, PoisonError, Weak};

use glam::DVec2;

use super::fit::{Component, Samples, fit};
use super::grid::{Frame, Grid, index};
use super::kernel::{DiskTable, Lines};
use super::mipmap::Mipmap;
use crate::light::Emitter;
use crate::light::pattern::Channel;

/// The neighbourhood whose light counts as the point light's.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Kernel {
    /// A disk of that radius, from the paper's table.
    Disk,
    /// A square of that half side, from a mipmap.
    Square,
}

/// A pattern on the common grid, filtered and fitted. Each part is made when it is first needed.
pub struct Prefiltered {
    grid: Grid,
    centroid: DVec2,
    radius: f64,
    mipmap: Mipmap,
    lines: Lines,
    disks: OnceLock<DiskTable>,
    fits: [Fits; 2],
}

/// The factors of a kernel.
#[derive(Debug, Default)]
struct Fits {
    alpha: OnceLock<f64>,
    /// r/|pt| at the exponents of [`knot`].
    specular: [OnceLock<f64>; KNOTS],
}

/// Exponents at which the specular radius is fitted: 3/16, 3/4, 3, 12, 48 and 192.
pub const KNOTS: usize = 6;

/// The exponent of a knot.
fn knot(i: usize) -> f64 {
    3.0 * (2.0 * i as f64 - 4.0).exp2()
}

impl fmt::Debug for Prefiltered {
    /// What is told in a line; the texels and tables are 600,000 numbers.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { centroid, radius, .. } = self;
        f.debug_struct("Prefiltered").field("centroid", centroid).field("radius", radius).finish_non_exhaustive()
    }
}

impl Prefiltered {
    /// The pattern of a grid.
    pub fn new(grid: Grid) -> Self {
        Self {
            centroid: grid.centroid(),
            radius: grid.radius(),
            mipmap: Mipmap::new(&grid),
            lines: Lines::new(&grid),
            grid,
            disks: OnceLock::new(),
            fits: Default::default(),
        }
    }

    /// A light's pattern and where it is; none for lights that are not flat, and for flat lights of no size.
    ///
    /// Patterns are kept for the lights that used them last: a light that moves, turns or is scaled keeps its pattern.
    pub fn of(emitter: &Emitter) -> Option<(Frame, Arc<Self>)> {
        match emitter {
            Emitter::Textured(light) => {
                let (frame, sides) = Frame::of_textured(light)?;
                let key = Key::Channel(Arc::downgrade(&light.pattern), sides);
                Some((frame, remembered(key, || Grid::of_channel(&light.pattern, sides))))
            }
            Emitter::Polygon(light) => {
                let (frame, outline) = Frame::of_polygon(light)?;
                Some((frame, remembered(Key::Outline(outline.clone()), || Grid::of_outline(&outline))))
            }
            Emitter::Disk(light) => Some((Frame::of_disk(light), remembered(Key::Disk, Grid::of_disk))),
            _ => None,
        }
    }

    /// The luminances.
    pub fn grid(&self) -> &Grid {
        &self.grid
    }

    /// The centroid of the light, in texels from the grid's centre.
    pub fn centroid(&self) -> DVec2 {
        self.centroid
    }

    /// The light's own radius in texels: see [`Grid::radius`].
    pub fn radius(&self) -> f64 {
        self.radius
    }

    /// The square kernel's means.
    pub fn mipmap(&self) -> &Mipmap {
        &self.mipmap
    }

    /// The disk kernel's table.
    pub fn disks(&self) -> &DiskTable {
        self.disks.get_or_init(|| DiskTable::new(&self.grid))
    }

    /// ∫ L dA over the kernel of a radius about a point of the plane, in texels².
    pub fn sum(&self, kernel: Kernel, at: DVec2, radius: f64) -> f64 {
        match kernel {
            Kernel::Disk => self.disks().sum(at, radius),
            Kernel::Square => self.mipmap.sum(at, radius),
        }
    }

    /// As [`Self::sum`], not from a table or a mipmap: what these are approximations of.
    pub fn true_sum(&self, kernel: Kernel, at: DVec2, radius: f64) -> f64 {
        self.lines.kernel_sum(kernel, at, radius)
    }

    /// α: the diffuse radius over |pt|.
    pub fn alpha(&self, kernel: Kernel) -> f64 {
        *self.fits(kernel).alpha.get_or_init(|| fit(self, kernel, Component::Diffuse, Samples::FEW).mean)
    }

    /// β/n: the specular radius over |pt|, at the exponent of a knot.
    pub fn specular_knot(&self, kernel: Kernel, i: usize) -> f64 {
        let fitted = || (fit(self, kernel, Component::Specular(knot(i)), Samples::FEW).mean / knot(i)).max(LEAST_SHARE);
        *self.fits(kernel).specular[i].get_or_init(fitted)
    }

    /// β/n for any exponent: its logarithm is linear in that of the exponent between knots. Beyond the last it falls as
    /// 1/√n, which it tends to: β/n·√n of a uniform disk is 1.37 for n = 64, 1.40 for 1024.
    pub fn specular_share(&self, kernel: Kernel, n: f64) -> f64 {
        let last = (KNOTS - 1) as f64;
        let place = 0.5 * (n / 3.0).log2() + 2.0;
        let first = index(place.clamp(0.0, last).floor()).min(KNOTS - 2);
        let share = place.clamp(0.0, last) - first as f64;
        let ends = [first, first + 1].map(|i| self.specular_knot(kernel, i).log2());
        ((1.0 - share) * ends[0] + share * ends[1] - (place - last).max(0.0)).exp2()
    }

    fn fits(&self, kernel: Kernel) -> &Fits {
        &self.fits[usize::from(kernel == Kernel::Square)]
    }
}

/// The least radius over |pt|, which a pattern without light has.
const LEAST_SHARE: f64 = 1e-6;

/// What patterns are known by.
#[derive(Debug)]
enum Key {
    /// The very channel, which the key does not keep alive, and the sides of its rectangle in texels.
    Channel(Weak<Channel>, DVec2),
    /// Corners in texels.
    Outline(Vec<DVec2>),
    Disk,
}

/// Corners that are so near, in texels, are the same: what rounding does to a light that moves.
const SAME: f64 = 1e-6;

impl Key {
    fn is_like(&self, other: &Self) -> bool {
        match (self, other) {
            (Self::Channel(a, a_sides), Self::Channel(b, b_sides)) => {
                Weak::ptr_eq(a, b) && a_sides.abs_diff_eq(*b_sides, SAME)
            }
            (Self::Outline(a), Self::Outline(b)) => {
                a.len() == b.len() && a.iter().zip(b).all(|(a, b)| a.abs_diff_eq(*b, SAME))
            }
            (Self::Disk, Self::Disk) => true,
            _ => false,
        }
    }
}

/// Patterns that are kept.
const REMEMBERED: usize = 16;

/// The pattern of a key, from the last ones or made now.
fn remembered(key: Key, grid: impl FnOnce() -> Grid) -> Arc<Prefiltered> {
    static PATTERNS: Mutex<Vec<(Key, Arc<Prefiltered>)>> = Mutex::new(Vec::new());
    let mut patterns = PATTERNS.lock().unwrap_or_else(PoisonError::into_inner);
    let found = patterns.iter().position(|(known, _)| known.is_like(&key));
    let entry = match found {
        Some(i) => patterns.remove(i),
        None => (key, Arc::new(Prefiltered::new(grid()))),
    };
    let pattern = Arc::clone(&entry.1);
    patterns.push(entry);
    let excess = patterns.len().saturating_sub(REMEMBERED);
    patterns.drain(..excess);
    pattern
}
