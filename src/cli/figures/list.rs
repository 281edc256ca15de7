//! Which figures there are.

use crate::analysis::chart::{Chart, Table};
use crate::analysis::figures;
use crate::render::{MethodChoice, Progress};
use crate::scene::Scene;
use crate::shading::Method;

/// A figure or a table.
pub(super) struct Figure {
    /// Name of its files, without extension.
    pub(super) name: &'static str,
    /// What it shows.
    pub(super) shows: &'static str,
    /// How it is made.
    pub(super) content: Content,
}

/// A table of the lights of scenes, each with its name.
type LightsTable = fn(&[(&str, &Scene)], &Progress) -> Option<Table>;

/// How a figure is made.
pub(super) enum Content {
    /// A picture of a scene of that file name.
    Picture {
        /// In the folder of the figures' scenes.
        scene: &'static str,
        /// How its lights are shaded.
        choice: MethodChoice,
    },
    /// A chart; none when cancelled.
    Chart(fn(&Progress) -> Option<Chart>),
    /// A table; none when cancelled.
    Table(fn(&Progress) -> Option<Table>),
    /// A table of the lights of scenes; none when cancelled.
    Lights {
        /// In the folder of the figures' scenes.
        scenes: &'static [&'static str],
        /// What is said of them.
        table: LightsTable,
    },
}

impl Content {
    /// File names of the scenes that are shown.
    pub(super) fn scenes(&self) -> &[&'static str] {
        match self {
            Self::Picture { scene, .. } => std::slice::from_ref(scene),
            Self::Lights { scenes, .. } => scenes,
            Self::Chart(_) | Self::Table(_) => &[],
        }
    }
}

const fn picture(name: &'static str, shows: &'static str, scene: &'static str, method: Method) -> Figure {
    Figure { name, shows, content: Content::Picture { scene, choice: MethodChoice::Method(method) } }
}

const fn chart(name: &'static str, shows: &'static str, chart: fn(&Progress) -> Option<Chart>) -> Figure {
    Figure { name, shows, content: Content::Chart(chart) }
}

const fn table(name: &'static str, shows: &'static str, table: fn(&Progress) -> Option<Table>) -> Figure {
    Figure { name, shows, content: Content::Table(table) }
}

/// The scenes of ONE_SHOT's figures 1, 7, 8 and 9.
const ONE_SHOT: &[&str] = &[
    "one-shot-disk.toml",
    "one-shot-checkerboard.toml",
    "one-shot-window.toml",
    "one-shot-leaf.toml",
    "one-shot-letter.toml",
    "one-shot-rose.toml",
    "one-shot-snowflake.toml",
];

/// All figures, by paper.
pub(super) const FIGURES: &[Figure] = &[
    picture("one-shot-1a", "a window's light", "one-shot-window.toml", Method::OneShot),
    picture("one-shot-1b", "a leaf's light", "one-shot-leaf.toml", Method::OneShot),
    picture("one-shot-1c", "a letter's light", "one-shot-letter.toml", Method::OneShot),
    chart("one-shot-4", "α of a uniform disk, and the diffuse error", figures::one_shot_4),
    chart("one-shot-6", "β of a uniform disk for n = 3, and the specular error", figures::one_shot_6),
    picture("one-shot-7a", "uniform disk, one-shot", "one-shot-disk.toml", Method::OneShot),
    picture("one-shot-7b", "uniform disk, exact", "one-shot-disk.toml", Method::Exact),
    picture("one-shot-8a", "checkerboard, one-shot", "one-shot-checkerboard.toml", Method::OneShot),
    picture("one-shot-8b", "the checkerboard as 32 squares, exact", "one-shot-squares.toml", Method::Exact),
    picture("one-shot-9a", "a rose window's light", "one-shot-rose.toml", Method::OneShot),
    picture("one-shot-9b", "a snowflake's light", "one-shot-snowflake.toml", Method::OneShot),
    table("one-shot-disk", "factors of a uniform disk and their errors", figures::one_shot_disk),
    Figure {
        name: "one-shot-lights",
        shows: "α and β of the lights of figures 1, 7, 8 and 9",
        content: Content::Lights { scenes: ONE_SHOT, table: figures::one_shot_lights },
    },
    picture("picott-1a", "bowling lane, point lights in place of spots", "picott-lane-points.toml", Method::Exact),
    picture("picott-1b", "bowling lane, linear lights", "picott-lane-lines.toml", Method::NearestPoint),
    picture("picott-1c", "bowling lane, area lights", "picott-lane-areas.toml", Method::NearestPoint),
    picture("picott-2a", "studio, point lights in place of spots", "picott-studio-points.toml", Method::Exact),
    picture("picott-2b", "studio, linear lights", "picott-studio-lines.toml", Method::NearestPoint),
    picture("picott-2c", "studio, area lights", "picott-studio-areas.toml", Method::NearestPoint),
    picture("poulin-1", "sphere under 7 point lights", "poulin-sphere-points.toml", Method::Exact),
    picture("poulin-2", "the same sphere under a linear light", "poulin-sphere.toml", Method::CHEBYSHEV),
    picture("poulin-3", "cafeteria with 12 linear lights", "poulin-cafeteria.toml", Method::CHEBYSHEV),
    picture("poulin-4", "desk under a linear light", "poulin-desk.toml", Method::CHEBYSHEV),
    table("chebyshev-degrees", "what POULIN's degree 6 is worth, and what finer levels need", |_| {
        Some(figures::chebyshev_degrees())
    }),
    chart("snyder-2", "illuminance from caps of 30, 60 and 90 degrees", |_| Some(figures::snyder_2())),
    chart("snyder-3", "two Hermite segments beside exact", |_| Some(figures::snyder_3())),
    chart("snyder-4", "Phong reflection of skies", |_| Some(figures::snyder_4())),
    chart("snyder-5", "Phong reflection of caps", |_| Some(figures::snyder_5())),
    chart("snyder-6", "Phong reflection of caps, normalised", |_| Some(figures::snyder_6())),
    picture("snyder-7a", "directional light", "snyder-directional.toml", Method::Exact),
    picture("snyder-7b", "point light", "snyder-positional.toml", Method::Exact),
    picture("snyder-7c", "overcast sky", "snyder-sky.toml", Method::Exact),
    picture("snyder-7d", "spherical light", "snyder-sphere.toml", Method::Exact),
    picture("snyder-7e", "polygonal light", "snyder-polygon.toml", Method::Exact),
    table("hermite-errors", "greatest errors of the Hermite curves over the half-angle", |_| {
        Some(figures::hermite_errors())
    }),
];
