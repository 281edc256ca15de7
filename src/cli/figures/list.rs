//! Which figures there are.

use crate::analysis::chart::{Chart, Table};
use crate::analysis::figures;
use crate::render::{MethodChoice, Progress};
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

/// All figures, by paper.
pub(super) const FIGURES: &[Figure] = &[
    picture("picott-1a", "bowling lane, point lights in place of spots", "picott-lane-points.toml", Method::Exact),
    picture("picott-1b", "bowling lane, linear lights", "picott-lane-lines.toml", Method::NearestPoint),
    picture("picott-1c", "bowling lane, area lights", "picott-lane-areas.toml", Method::NearestPoint),
    picture("picott-2a", "studio, point lights in place of spots", "picott-studio-points.toml", Method::Exact),
    picture("picott-2b", "studio, linear lights", "picott-studio-lines.toml", Method::NearestPoint),
    picture("picott-2c", "studio, area lights", "picott-studio-areas.toml", Method::NearestPoint),
    picture("poulin-1", "sphere under 7 point lights", "poulin-sphere.toml", Method::PointCluster(7)),
    picture("poulin-2", "the same sphere under a linear light", "poulin-sphere.toml", Method::Chebyshev),
    picture("poulin-3", "cafeteria with 12 linear lights", "poulin-cafeteria.toml", Method::Chebyshev),
    picture("poulin-4", "desk under a linear light", "poulin-desk.toml", Method::Chebyshev),
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
