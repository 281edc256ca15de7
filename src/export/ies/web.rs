//! A luminaire's intensities on a table, as coarse as an error allows.

use glam::DVec3;

use super::luminaire::Luminaire;
use crate::light::photometry::Distribution;

/// What bilinear interpolation may miss, as a share of the greatest intensity, while there are finer steps.
pub(super) const SOUGHT_ERROR: f64 = 1e-3;

/// Steps of γ and of C, degrees, the coarsest first; all divide 90.
const GAMMA_STEPS: [f64; 4] = [5.0, 2.5, 1.0, 0.5];
const PLANE_STEPS: [f64; 5] = [15.0, 10.0, 5.0, 2.5, 1.0];

/// Intensities that differ by less than this share of the greatest are the same.
const SAME: f64 = 1e-9;

/// How a luminaire's planes repeat.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Symmetry {
    /// All planes are alike.
    Rotational,
    /// About the planes 0–180 and 90–270.
    Quadrant,
    /// About the plane 0–180.
    Bilateral,
    /// About the plane 90–270.
    Across,
    /// Not at all.
    None,
}

/// Candela by planes.
pub(super) struct Web {
    pub(super) symmetry: Symmetry,
    /// Increasing, degrees.
    pub(super) gammas: Vec<f64>,
    /// Increasing, degrees.
    pub(super) planes: Vec<f64>,
    /// By planes, each from the first γ to the last.
    pub(super) candela: Vec<f64>,
    /// The greatest.
    pub(super) peak: f64,
    /// What bilinear interpolation misses, as a share of the greatest intensity: measured at thirds and halves of all steps.
    pub(super) error: f64,
}

impl Web {
    /// A point's own table; of other luminaires, intensities at even steps.
    pub(super) fn of(luminaire: &Luminaire) -> Self {
        let candela = |c: f64, gamma: f64| luminaire.intensity(direction(c, gamma));
        let peak = peak(&candela);
        let symmetry = symmetry(&candela, peak);
        if let Some(web) = luminaire.table().and_then(|table| Self::of_table(table, symmetry, &candela)) {
            return web;
        }
        let range = gamma_range(&candela);
        let (mut gamma_step, mut plane_step) = (0, 0);
        loop {
            let gammas = steps(range, GAMMA_STEPS[gamma_step]);
            let planes = match symmetry.range() {
                None => vec![0.0],
                Some(range) => steps(range, PLANE_STEPS[plane_step]),
            };
            let web = Self::sampled(symmetry, gammas, planes, &candela);
            let [across, along] = [web.measured([0.5, 0.0], &candela), web.measured([0.0, 0.5], &candela)];
            let finer_planes = web.planes.len() > 1 && plane_step + 1 < PLANE_STEPS.len();
            let finer_gammas = gamma_step + 1 < GAMMA_STEPS.len();
            let missed = web.error > SOUGHT_ERROR;
            match (missed && finer_planes, missed && finer_gammas) {
                (false, false) => return web,
                (true, true) if across > along => plane_step += 1,
                (true, false) => plane_step += 1,
                (_, true) => gamma_step += 1,
            }
        }
    }

    /// The angles of a table, where they are those of a file.
    fn of_table(table: &Distribution, symmetry: Symmetry, candela: &impl Fn(f64, f64) -> f64) -> Option<Self> {
        let degrees = |angles: &[f64]| angles.iter().map(|angle| rounded(angle.to_degrees())).collect::<Vec<f64>>();
        let gammas = degrees(table.gammas());
        let ends = [*gammas.first()?, *gammas.last()?];
        let planes = degrees(table.planes());
        let planes = match symmetry.range() {
            None => vec![0.0],
            Some([first, last]) => {
                let within: Vec<f64> = planes.into_iter().filter(|c| (first..=last).contains(c)).collect();
                (within.first() == Some(&first) && within.last() == Some(&last)).then_some(within)?
            }
        };
        let web = Self::sampled(symmetry, gammas, planes, candela);
        matches!(ends, [0.0, 90.0] | [90.0, 180.0] | [0.0, 180.0]).then_some(web)
    }

    fn sampled(symmetry: Symmetry, gammas: Vec<f64>, planes: Vec<f64>, candela_of: &impl Fn(f64, f64) -> f64) -> Self {
        let candela: Vec<f64> = planes.iter().flat_map(|c| gammas.iter().map(|gamma| candela_of(*c, *gamma))).collect();
        let peak = candela.iter().copied().fold(0.0, f64::max);
        let mut web = Self { symmetry, gammas, planes, candela, peak, error: 0.0 };
        let shares = [1.0 / 3.0, 0.5, 2.0 / 3.0];
        let places = shares.into_iter().flat_map(|a| [[a, 0.0], [0.0, a]].into_iter().chain(shares.map(|b| [a, b])));
        web.error = places.map(|place| web.measured(place, candela_of)).fold(0.0, f64::max);
        web
    }

    /// The greatest error at those shares of the steps of C and γ.
    fn measured(&self, [across, along]: [f64; 2], candela_of: &impl Fn(f64, f64) -> f64) -> f64 {
        let rows = self.gammas.len();
        let at = |plane: usize, row: usize| self.candela[plane * rows + row];
        let mut greatest = 0.0_f64;
        for plane in 0..self.planes.len() {
            let next_plane = (plane + 1).min(self.planes.len() - 1);
            for row in 0..rows - 1 {
                let mix = |plane: usize| (1.0 - along) * at(plane, row) + along * at(plane, row + 1);
                let interpolated = (1.0 - across) * mix(plane) + across * mix(next_plane);
                let c = (1.0 - across) * self.planes[plane] + across * self.planes[next_plane];
                let gamma = (1.0 - along) * self.gammas[row] + along * self.gammas[row + 1];
                greatest = greatest.max((interpolated - candela_of(c, gamma)).abs());
            }
        }
        if self.peak > 0.0 { greatest / self.peak } else { 0.0 }
    }
}

impl Symmetry {
    /// The first and the last plane of a file; none where one is enough.
    pub(super) fn range(self) -> Option<[f64; 2]> {
        match self {
            Self::Rotational => None,
            Self::Quadrant => Some([0.0, 90.0]),
            Self::Bilateral => Some([0.0, 180.0]),
            Self::Across => Some([90.0, 270.0]),
            Self::None => Some([0.0, 360.0]),
        }
    }

    /// What it is, in a file.
    pub(super) fn name(self) -> &'static str {
        match self {
            Self::Rotational => "rotational",
            Self::Quadrant => "in quadrants",
            Self::Bilateral => "about the plane 0-180",
            Self::Across => "about the plane 90-270",
            Self::None => "none",
        }
    }
}

/// The unit direction at C and γ in degrees, exact at right angles.
pub(super) fn direction(c: f64, gamma: f64) -> DVec3 {
    let ([sin_c, cos_c], [sin, cos]) = (sin_cos_deg(c), sin_cos_deg(gamma));
    DVec3::new(sin * cos_c, sin * sin_c, -cos)
}

fn sin_cos_deg(angle: f64) -> [f64; 2] {
    match angle {
        90.0 => [1.0, 0.0],
        180.0 => [0.0, -1.0],
        270.0 => [-1.0, 0.0],
        360.0 => [0.0, 1.0],
        _ => angle.to_radians().sin_cos().into(),
    }
}

/// From the first to the last by even steps.
fn steps([first, last]: [f64; 2], step: f64) -> Vec<f64> {
    let mut angles: Vec<f64> = (0..).map(|i| first + f64::from(i) * step).take_while(|angle| *angle < last).collect();
    angles.push(last);
    angles
}

/// Degrees as a file gave them, before radians took their last digits.
fn rounded(degrees: f64) -> f64 {
    (degrees * 1e9).round() * 1e-9
}

/// C and γ, degrees, at which symmetries are looked for.
fn lattice() -> impl Iterator<Item = (f64, f64)> {
    (0..=180).flat_map(|c| (0..=72).map(move |gamma| (f64::from(c), 2.5 * f64::from(gamma))))
}

/// The greatest of the intensities on the lattice.
fn peak(candela: &impl Fn(f64, f64) -> f64) -> f64 {
    lattice().flat_map(|(c, gamma)| [candela(c, gamma), candela(360.0 - c, gamma)]).fold(0.0, f64::max)
}

fn symmetry(candela: &impl Fn(f64, f64) -> f64, peak: f64) -> Symmetry {
    let is_same = |a: f64, b: f64| (a - b).abs() <= SAME * peak;
    let all = |holds: &dyn Fn(f64, f64) -> bool| lattice().all(|(c, gamma)| holds(c, gamma));
    let turned = |c: f64| if c > 180.0 { 540.0 - c } else { 180.0 - c };
    let bilateral = all(&|c, gamma| is_same(candela(c, gamma), candela(360.0 - c, gamma)));
    let across =
        all(&|c, gamma| [c, 360.0 - c].into_iter().all(|c| is_same(candela(c, gamma), candela(turned(c), gamma))));
    let rotational = bilateral && all(&|c, gamma| is_same(candela(c, gamma), candela(0.0, gamma)));
    match (rotational, bilateral, across) {
        (true, ..) => Symmetry::Rotational,
        (_, true, true) => Symmetry::Quadrant,
        (_, true, false) => Symmetry::Bilateral,
        (_, false, true) => Symmetry::Across,
        (_, false, false) => Symmetry::None,
    }
}

/// Half of the range of γ where the other half is dark.
fn gamma_range(candela: &impl Fn(f64, f64) -> f64) -> [f64; 2] {
    let is_dark = |dark: &dyn Fn(f64) -> bool| {
        let mut there = lattice().filter(|(_, gamma)| dark(*gamma));
        there.all(|(c, gamma)| candela(c, gamma) == 0.0 && candela(360.0 - c, gamma) == 0.0)
    };
    match (is_dark(&|gamma| gamma < 90.0), is_dark(&|gamma| gamma > 90.0)) {
        (_, true) => [0.0, 90.0],
        (true, _) => [90.0, 180.0],
        _ => [0.0, 180.0],
    }
}
