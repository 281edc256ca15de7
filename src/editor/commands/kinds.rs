//! The shapes of lights and surfaces that commands add.

use super::upper_first;
use crate::editor::edits;
use crate::light::{self, Cap, Directional, Disk, Line, Point, Sky, Sphere};
use crate::surface;

/// A shape of light that can be added.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LightKind {
    /// A square.
    Polygon,
    /// A rectangle with a pattern.
    Textured,
    /// A line.
    Line,
    /// A disk.
    Disk,
    /// A sphere.
    Sphere,
    /// A cap of directions.
    Cap,
    /// A sky.
    Sky,
    /// A point.
    Point,
    /// A point with the intensities of an IES file.
    Measured,
    /// Parallel light.
    Directional,
}

/// A surface that can be added.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SurfaceKind {
    /// The ground.
    Plane,
    /// A ball.
    Sphere,
    /// A box.
    Box,
    /// A square.
    Square,
    /// A disk.
    Disk,
    /// A cylinder.
    Cylinder,
    /// A cone.
    Cone,
    /// Balls on balls.
    Sphereflake,
    /// A tetrahedron of tetrahedra.
    Tetrahedron,
    /// A curved sheet.
    Patch,
    /// Triangles from a file.
    Mesh,
}

impl LightKind {
    /// All of them, in menu order.
    pub const ALL: [Self; 10] = [
        Self::Polygon,
        Self::Disk,
        Self::Textured,
        Self::Line,
        Self::Sphere,
        Self::Sky,
        Self::Cap,
        Self::Point,
        Self::Measured,
        Self::Directional,
    ];

    /// The kind of a light's shape.
    pub fn of(shape: &light::Shape) -> Self {
        match shape {
            light::Shape::Polygon(_) => Self::Polygon,
            light::Shape::Disk(_) => Self::Disk,
            light::Shape::Textured(_) => Self::Textured,
            light::Shape::Line(_) => Self::Line,
            light::Shape::Sphere(_) => Self::Sphere,
            light::Shape::Sky(_) => Self::Sky,
            light::Shape::Cap(_) => Self::Cap,
            light::Shape::Point(Point { ies: None }) => Self::Point,
            light::Shape::Point(_) => Self::Measured,
            light::Shape::Directional(_) => Self::Directional,
        }
    }

    pub(super) fn label(self) -> &'static str {
        match self {
            Self::Polygon => "Polygon",
            Self::Disk => "Disk",
            Self::Textured => "Textured…",
            Self::Line => "Line",
            Self::Sphere => "Sphere",
            Self::Sky => "Sky",
            Self::Cap => "Cap",
            Self::Point => "Point",
            Self::Measured => "Point from IES…",
            Self::Directional => "Directional",
        }
    }

    /// What it is, for who does not know it by its name.
    pub fn hint(self) -> &'static str {
        match self {
            Self::Polygon => "A flat light of any outline, such as a window or a softbox",
            Self::Disk => "A flat round light, such as a downlight or a porthole",
            Self::Textured => "A rectangle with a picture as its pattern: any outline, any distribution",
            Self::Line => "A linear light, such as a fluorescent tube",
            Self::Sphere => "A ball of light, such as a globe lamp",
            Self::Sky => "A hemisphere of light infinitely far away: uniform, cosine or overcast",
            Self::Cap => "A round patch of the sky infinitely far away, such as the sun behind haze",
            Self::Point => "All of the light at one point",
            Self::Measured => "A luminaire far away: a point with the candela of an IES file (LM-63)",
            Self::Directional => "Parallel light, such as a clear sun’s",
        }
    }

    /// The shape that a new light of this kind has; none where a file has to be chosen first.
    pub(super) fn shape(self) -> Option<light::Shape> {
        Some(match self {
            Self::Textured | Self::Measured => return None,
            Self::Polygon => light::Shape::Polygon(edits::rectangle(1.0, 1.0)),
            Self::Disk => light::Shape::Disk(Disk { radius: 0.4, two_sided: false }),
            Self::Cap => light::Shape::Cap(Cap { half_angle_deg: 15.0 }),
            Self::Sky => light::Shape::Sky(Sky::OVERCAST),
            Self::Line => light::Shape::Line(Line::isotropic(1.2)),
            Self::Sphere => light::Shape::Sphere(Sphere { radius: 0.2 }),
            Self::Point => light::Shape::Point(Point::default()),
            Self::Directional => light::Shape::Directional(Directional {}),
        })
    }
}

impl SurfaceKind {
    /// All of them, in menu order.
    pub const ALL: [Self; 11] = [
        Self::Plane,
        Self::Sphere,
        Self::Box,
        Self::Square,
        Self::Disk,
        Self::Cylinder,
        Self::Cone,
        Self::Patch,
        Self::Mesh,
        Self::Sphereflake,
        Self::Tetrahedron,
    ];

    pub(super) fn label(self) -> String {
        self.shape().map_or_else(|| "Mesh…".to_owned(), |shape| upper_first(shape.name()))
    }

    /// What it is, where its name does not say all.
    pub(super) fn hint(self) -> Option<&'static str> {
        match self {
            Self::Patch => Some("A curved sheet, such as a sail: a bicubic Bézier patch"),
            Self::Mesh => Some("Triangles from an OBJ file"),
            Self::Sphereflake => Some("Balls on balls, to try shadows of many spheres"),
            Self::Tetrahedron => Some("Thousands of triangles, to try shadows of many"),
            _ => None,
        }
    }

    /// The shape that a new surface of this kind has; none where a file has to be chosen first.
    pub(super) fn shape(self) -> Option<surface::Shape> {
        Some(match self {
            Self::Mesh => return None,
            Self::Patch => surface::Shape::Patch { control_points: Box::new(edits::sail()) },
            Self::Plane => surface::Shape::Plane {},
            Self::Sphere => surface::Shape::Sphere { radius: 0.5 },
            Self::Box => surface::Shape::Box { size: glam::DVec3::ONE },
            Self::Square => surface::Shape::Square { size: glam::DVec2::ONE },
            Self::Disk => surface::Shape::Disk { radius: 0.5 },
            Self::Cylinder => surface::Shape::Cylinder { radius: 0.5, height: 1.0 },
            Self::Cone => surface::Shape::Cone { radius: 0.5, height: 1.0 },
            Self::Sphereflake => surface::Shape::Sphereflake { depth: 2 },
            Self::Tetrahedron => surface::Shape::Tetrahedron { depth: 5 },
        })
    }
}
