//! Points of low discrepancy on the unit square, and maps from it to disks, cones and lobes.

use std::f64::consts::{FRAC_PI_2, FRAC_PI_4};

use glam::{DVec2, DVec3};
use sobol_burley::sample;

/// Two dimensions of an Owen-scrambled Sobol sequence: every 2^k points that start at a multiple of 2^k are a net.
///
/// **Source:** [`crate::refs::BURLEY_2020`]; each coordinate has 24 bits.
#[derive(Clone, Copy, Debug)]
pub(super) struct Sequence(u32);

/// The points that a [`Sequence`] has.
pub(super) const LONGEST: u32 = 1 << 16;

impl Sequence {
    /// One scramble of its own for every point p and every `purpose`, the same in every run.
    pub(super) fn at(p: DVec3, purpose: u64) -> Self {
        let bits = p.to_array().map(f64::to_bits);
        let hash = bits.into_iter().fold(purpose, |hash, bits| mixed(hash ^ bits));
        Self(u32::from_le_bytes([0, 1, 2, 3].map(|i: usize| hash.to_le_bytes()[i])))
    }

    /// The point of an index below [`LONGEST`].
    pub(super) fn point(self, index: u32) -> DVec2 {
        DVec2::new(f64::from(sample(index, 0, self.0)), f64::from(sample(index, 1, self.0)))
    }
}

/// The finalizer of the generator `splitmix64`, a permutation that leaves no structure.
fn mixed(x: u64) -> u64 {
    let x = x.wrapping_add(0x9e37_79b9_7f4a_7c15);
    let x = (x ^ (x >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    let x = (x ^ (x >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    x ^ (x >> 31)
}

/// The unit square onto the unit disk: areas keep their ratios, and neighbours stay neighbours.
///
/// **Source:** [`crate::refs::SHIRLEY_CHIU_1997`].
pub(super) fn on_disk(square: DVec2) -> DVec2 {
    let [a, b] = (2.0 * square - 1.0).to_array();
    let (radius, angle) = if a.abs() > b.abs() {
        (a, FRAC_PI_4 * b / a)
    } else if b != 0.0 {
        (b, FRAC_PI_2 - FRAC_PI_4 * a / b)
    } else {
        (0.0, 0.0)
    };
    radius * DVec2::from_angle(angle)
}

/// An axis and two directions across it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Frame {
    pub(super) axis: DVec3,
    across: [DVec3; 2],
}

impl Frame {
    /// About a unit axis.
    pub(super) fn about(axis: DVec3) -> Self {
        let (x, y) = axis.any_orthonormal_pair();
        Self { axis, across: [x, y] }
    }

    /// At an angle of that cosine and sine from the axis, on the side where a point of the unit disk is.
    pub(super) fn direction(&self, disk: DVec2, [cos, sin]: [f64; 2]) -> DVec3 {
        let side = disk.normalize_or(DVec2::X);
        cos * self.axis + sin * (side.x * self.across[0] + side.y * self.across[1])
    }

    /// Of a cone, its directions being as likely; `height` is 1 − cos of its half-angle.
    pub(super) fn in_cone(&self, disk: DVec2, height: f64) -> DVec3 {
        let below = disk.length_squared() * height;
        self.direction(disk, [1.0 - below, (below * (2.0 - below)).max(0.0).sqrt()])
    }

    /// Of the hemisphere, likely as its cosine: density cos/π.
    pub(super) fn by_cosine(&self, disk: DVec2) -> DVec3 {
        let square = disk.length_squared().min(1.0);
        self.direction(disk, [(1.0 - square).sqrt(), square.sqrt()])
    }

    /// Of the hemisphere, likely as a power m of its cosine: density (m+1)/(2π) cosᵐ.
    pub(super) fn by_power(&self, disk: DVec2, m: f64) -> DVec3 {
        let log = left_of(disk).ln() / (m + 1.0);
        self.direction(disk, [log.exp(), (-(2.0 * log).exp_m1()).sqrt()])
    }

    /// Of the hemisphere, likely as Beckmann's facets of RMS slope s face it: density exp(−tan²θ/s²)/(πs²cos³θ).
    pub(super) fn by_slope(&self, disk: DVec2, slope: f64) -> DVec3 {
        let tan_squared = -slope * slope * left_of(disk).ln();
        let cos = (1.0 + tan_squared).sqrt().recip();
        self.direction(disk, [cos, cos * tan_squared.sqrt()])
    }

    /// A point on the rim of a disk about the axis, at a share of the way round.
    pub(super) fn rim(&self, share: f64) -> DVec3 {
        let side = DVec2::from_angle(std::f64::consts::TAU * share);
        side.x * self.across[0] + side.y * self.across[1]
    }
}

/// The share of the disk's area that is farther out, never 0.
fn left_of(disk: DVec2) -> f64 {
    (1.0 - disk.length_squared()).max(1e-9)
}
