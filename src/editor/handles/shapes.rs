//! Handles on the shapes of lights and surfaces: where they are.

use glam::{DAffine3, DVec2, DVec3};

use super::subject::Subject;
use super::{Handle, Outline, Spot, aim, circle, dot, probe, vertices};
use crate::editor::viewport::pick::Solids;
use crate::editor::viewport::projection::Projection;
use crate::editor::viewport::symbol::Symbol;
use crate::light::{self, Light};
use crate::surface::{self, Surface};

/// Sides and corners of a rectangle.
const RECTANGLE: [[i8; 3]; 8] =
    [[1, 1, 0], [-1, 1, 0], [-1, -1, 0], [1, -1, 0], [1, 0, 0], [0, 1, 0], [-1, 0, 0], [0, -1, 0]];
/// Faces of a box.
const FACES: [[i8; 3]; 6] = [[1, 0, 0], [-1, 0, 0], [0, 1, 0], [0, -1, 0], [0, 0, 1], [0, 0, -1]];
/// The ends of a solid of revolution.
const ENDS: [[i8; 3]; 2] = [[0, 0, 1], [0, 0, -1]];

/// The handles on the shape of `subject`, those that win where they overlap first.
pub(super) fn spots(subject: &Subject, projection: &Projection, solids: &Solids) -> Vec<Spot> {
    let mut spots = Vec::new();
    match subject {
        Subject::Light(light) => light_spots(light, projection, solids, &mut spots),
        Subject::Surface(surface) => surface_spots(surface, projection, &mut spots),
        Subject::Probe(plot) => spots.extend(probe::spots(plot, projection)),
    }
    if let Some([_, point]) = rim(subject, projection) {
        spots.extend(dot(Handle::Radius, point, projection));
    }
    let sides: &[[i8; 3]] = match subject {
        Subject::Light(Light { shape: light::Shape::Textured(_), .. })
        | Subject::Surface(Surface { shape: surface::Shape::Square { .. }, .. }) => &RECTANGLE,
        Subject::Surface(Surface { shape: surface::Shape::Box { .. }, .. }) => &FACES,
        Subject::Surface(Surface { shape: surface::Shape::Cylinder { .. } | surface::Shape::Cone { .. }, .. }) => &ENDS,
        _ => &[],
    };
    if let Some((size, world_from_own)) = extent(subject) {
        spots.extend(sides.iter().filter_map(|signs| {
            let at = projection.project(world_from_own.transform_point3(0.5 * vector(*signs) * size))?;
            let corner = signs.iter().filter(|sign| **sign != 0).count() == 2;
            let outline = if corner { Outline::Dot(at) } else { Outline::Diamond(at) };
            Some(Spot { handle: Handle::Side(*signs), outline })
        }));
    }
    spots
}

/// Signs as a vector.
pub(super) fn vector(signs: [i8; 3]) -> DVec3 {
    DVec3::from_array(signs.map(f64::from))
}

fn light_spots(light: &Light, projection: &Projection, solids: &Solids, spots: &mut Vec<Spot>) {
    let world_from_light = light.world_from_light();
    match &light.shape {
        light::Shape::Polygon(polygon) => vertices::spots(polygon, &world_from_light, projection, spots),
        light::Shape::Line(line) => {
            let half = 0.5 * line.length * DVec3::X;
            let ends = [-half, half].map(|p| world_from_light.transform_point3(p));
            spots.extend(ends.iter().enumerate().filter_map(|(i, p)| dot(Handle::End(i), *p, projection)));
        }
        light::Shape::Disk(disk) => {
            let [right, up] = [world_from_light.matrix3.x_axis, world_from_light.matrix3.y_axis];
            let pieces = circle(light.position, disk.radius * right, disk.radius * up, projection);
            spots.push(Spot { handle: Handle::Radius, outline: Outline::Ring(pieces) });
        }
        light::Shape::Cap(cap) => {
            let rim = Symbol::new(light, projection).point(cap.half_angle_deg.to_radians(), 0.0);
            spots.extend(dot(Handle::HalfAngle, rim, projection));
        }
        _ => {}
    }
    spots.extend(aim::spot(light, projection, solids));
}

fn surface_spots(surface: &Surface, projection: &Projection, spots: &mut Vec<Spot>) {
    if let surface::Shape::Patch { control_points } = &surface.shape {
        let world_from_surface = surface.world_from_surface();
        let points = control_points.iter().map(|p| world_from_surface.transform_point3(*p)).enumerate();
        spots.extend(points.filter_map(|(i, p)| dot(Handle::Control(i), p, projection)));
    }
}

/// Width, depth and height of what has them, in its own frame, and that frame.
pub(super) fn extent(subject: &Subject) -> Option<(DVec3, DAffine3)> {
    match subject {
        Subject::Light(light) => match &light.shape {
            light::Shape::Textured(textured) => Some((textured.size.extend(0.0), light.world_from_light())),
            _ => None,
        },
        Subject::Surface(surface) => {
            let size = match surface.shape {
                surface::Shape::Square { size } => size.extend(0.0),
                surface::Shape::Box { size } => size,
                surface::Shape::Cylinder { radius, height } | surface::Shape::Cone { radius, height } => {
                    DVec3::new(2.0 * radius, 2.0 * radius, height)
                }
                _ => return None,
            };
            Some((size, surface.world_from_surface()))
        }
        Subject::Probe(_) => None,
    }
}

/// From the middle of what is round to the point of its rim where the handle on its radius is: to the right where it can be.
pub(super) fn rim(subject: &Subject, projection: &Projection) -> Option<[DVec3; 2]> {
    let [right, _] = projection.right_up();
    match subject {
        Subject::Light(light) => {
            let center = light.position;
            let to_rim = match &light.shape {
                light::Shape::Sphere(sphere) => sphere.radius * right,
                light::Shape::Disk(disk) => disk.radius * light.world_from_light().matrix3.x_axis,
                light::Shape::Line(line) => {
                    let along = light.world_from_light().matrix3.x_axis;
                    line.radius? * along.cross(projection.camera().eye - center).normalize_or(right)
                }
                _ => return None,
            };
            Some([center, center + to_rim])
        }
        Subject::Surface(surface) => {
            let world_from_surface = surface.world_from_surface();
            // The point of an ellipsoid, or of an ellipse, that is farthest to the right.
            let own_right = world_from_surface.matrix3.transpose() * right;
            let across = own_right.truncate().normalize_or(DVec2::X).extend(0.0);
            let (center, to_rim) = match surface.shape {
                surface::Shape::Sphere { radius } => (DVec3::ZERO, radius * own_right.normalize_or(DVec3::X)),
                surface::Shape::Disk { radius } => (DVec3::ZERO, radius * across),
                surface::Shape::Cylinder { radius, .. } => (DVec3::ZERO, radius * across),
                surface::Shape::Cone { radius, height } => (-0.5 * height * DVec3::Z, radius * across),
                _ => return None,
            };
            Some([center, center + to_rim].map(|p| world_from_surface.transform_point3(p)))
        }
        Subject::Probe(_) => None,
    }
}
