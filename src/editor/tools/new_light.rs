//! Lights as the drawing tools make them, called after their shapes.

use glam::{DAffine3, DVec2, DVec3};

use super::polygon::is_simple;
use super::work_plane::Canvas;
use crate::editor::edits::softbox_pattern;
use crate::light::{Disk, Light, Line, Polygon, Quantity, QuantityKind, Shape, Sphere, Textured};

/// Luminance of a new polygon or sphere, cd/m²: ten times the white of a picture at exposure 0.
const LUMINANCE: f64 = 1000.0;
/// Intensity of a new line, cd/m: a tube 10 cm across of luminance 5000 cd/m² seen from the side.
const INTENSITY_PER_METRE: f64 = 500.0;
/// What is smaller than this, metres, was a slip of the hand.
pub const LEAST_SIZE: f64 = 1e-3;

/// A polygon, its origin at its centre of area. A number for the canvas is the height of a level one.
pub fn polygon(vertices: &[DVec2], on: impl Into<Canvas>) -> Light {
    let canvas = on.into();
    let center = centroid(vertices);
    let local: Vec<DVec2> = vertices.iter().map(|v| canvas.local(*v - center)).collect();
    let per_metre = per_metre(&local);
    let short: Vec<DVec2> = local.iter().map(|v| rounded(*v, per_metre)).collect();
    let vertices = if is_simple(&short) { short } else { local };
    let shape = Shape::Polygon(Polygon { vertices, two_sided: false });
    flat(center, &canvas, shape)
}

/// A disk; `None` without radius.
pub fn disk(center: DVec2, on: impl Into<Canvas>, radius: f64) -> Option<Light> {
    let shape = Shape::Disk(Disk { radius, two_sided: false });
    (radius >= LEAST_SIZE).then(|| flat(center, &on.into(), shape))
}

/// A rectangle between two corners, with the pattern of a softbox; `None` without area.
pub fn textured(corners: [DVec2; 2], on: impl Into<Canvas>) -> Option<Light> {
    let size = rounded((corners[1] - corners[0]).abs(), 1e6);
    let shape = Shape::Textured(Textured { size, pattern: softbox_pattern(), two_sided: false });
    (size.min_element() >= LEAST_SIZE).then(|| flat(corners[0].midpoint(corners[1]), &on.into(), shape))
}

/// A line between two points; `None` when they coincide.
pub fn line(ends: [DVec2; 2], on: impl Into<Canvas>) -> Option<Light> {
    let frame = on.into().frame;
    let (middle, rotation_deg, length) = line_placement(frame.point(ends[0]), frame.point(ends[1]))?;
    let shape = Shape::Line(Line::isotropic(length));
    let quantity = Quantity::new(QuantityKind::IntensityPerMetre, INTENSITY_PER_METRE);
    Some(light(middle, rotation_deg, quantity, shape))
}

/// A sphere; `None` without radius.
pub fn sphere(center: DVec2, on: impl Into<Canvas>, radius: f64) -> Option<Light> {
    (radius >= LEAST_SIZE).then(|| {
        let quantity = Quantity::new(QuantityKind::Luminance, LUMINANCE);
        light(on.into().frame.point(center), DVec3::ZERO, quantity, Shape::Sphere(Sphere { radius }))
    })
}

/// Position, rotation and length that put a line's ends at `a` and `b`, without roll; `None` when they coincide.
///
/// R = Rz·Ry takes X to (cos rz cos ry, sin rz cos ry, −sin ry).
pub fn line_placement(a: DVec3, b: DVec3) -> Option<(DVec3, DVec3, f64)> {
    let along = b - a;
    let length = along.length();
    if length.is_nan() || length < LEAST_SIZE {
        return None;
    }
    let ry = (-along.z).atan2(along.x.hypot(along.y));
    let rz = along.y.atan2(along.x);
    // An upright line's turn about Z means nothing.
    let rz = if along.truncate().length() < 1e-12 * length { 0.0 } else { rz };
    Some((a.midpoint(b), DVec3::new(0.0, ry.to_degrees(), rz.to_degrees()), length))
}

/// A flat light about a point of the canvas.
fn flat(center: DVec2, canvas: &Canvas, shape: Shape) -> Light {
    let quantity = Quantity::new(QuantityKind::Luminance, LUMINANCE);
    light(canvas.frame.point(center), canvas.rotation_deg(), quantity, shape)
}

fn light(position: DVec3, rotation_deg: DVec3, quantity: Quantity, shape: Shape) -> Light {
    let light = Light::new(shape.name(), shape);
    Light { position, rotation_deg, quantity, ..light }
}

/// Centre of area of a simple polygon, to a millimetre, so that files stay readable.
fn centroid(vertices: &[DVec2]) -> DVec2 {
    let polygon = Polygon { vertices: vertices.to_vec(), two_sided: false };
    rounded(polygon.place(&DAffine3::IDENTITY).centroid().truncate(), 1e3)
}

/// Parts of a metre to which an outline is rounded so that its numbers are short: a ten-thousandth of its size or less.
fn per_metre(vertices: &[DVec2]) -> f64 {
    let size = vertices.iter().map(|v| v.abs().max_element()).fold(LEAST_SIZE, f64::max);
    10.0_f64.powf(4.0 - size.log10().floor())
}

/// Rounded to one part in `per_metre` of a metre; zeros are positive.
fn rounded(p: DVec2, per_metre: f64) -> DVec2 {
    (p * per_metre).round() / per_metre + DVec2::ZERO
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::editor::tools::work_plane::Frame;
    use crate::light::Emitter;
    use crate::math::frame;
    use glam::dvec2;

    #[test]
    fn a_polygon_keeps_its_corners_faces_down_and_turns_about_its_centre() {
        let corners = [dvec2(1.0, 1.0), dvec2(3.0, 1.0), dvec2(3.0, 2.0), dvec2(1.0, 2.0)];
        let light = polygon(&corners, 2.5);
        assert_eq!(light.position, DVec3::new(2.0, 1.5, 2.5), "origin at the centroid");
        let Emitter::Polygon(emitter) = light.emitter() else { panic!("a polygon") };
        assert_eq!(emitter.normal, DVec3::NEG_Z, "lights what is below");
        for corner in corners {
            let found = emitter.vertices.iter().any(|v| v.distance(corner.extend(2.5)) < 1e-12);
            assert!(found, "{corner} in {:?}", emitter.vertices);
        }
    }

    #[test]
    fn a_polygon_about_the_axes_has_no_negative_zeros_in_its_file() {
        let corners = [dvec2(-0.5, -0.3), dvec2(0.5, -0.3), dvec2(0.4, 0.2), dvec2(-0.4, 0.2)];
        let position = polygon(&corners, 2.0).position;
        assert!(position.x == 0.0 && position.x.is_sign_positive(), "{position}");
        assert_eq!(position.y, rounded(position.truncate(), 1e3).y, "whole millimetres");
    }

    #[test]
    fn a_line_ends_where_it_was_drawn_whatever_its_direction() {
        for (a, b) in [
            (DVec3::new(0.0, 0.0, 1.0), DVec3::new(2.0, -3.0, 1.0)),
            (DVec3::new(1.0, 2.0, 0.0), DVec3::new(1.0, 2.0, 3.0)),
            (DVec3::new(-1.0, 0.5, 2.0), DVec3::new(-2.0, 0.5, 0.5)),
        ] {
            let (position, rotation_deg, length) = line_placement(a, b).expect("apart");
            let x = frame::rotation_from_deg(rotation_deg).x_axis;
            assert!((position - 0.5 * length * x).distance(a) < 1e-12, "{a} {b}: first end");
            assert!((position + 0.5 * length * x).distance(b) < 1e-12, "{a} {b}: second end");
        }
        assert_eq!(line_placement(DVec3::ONE, DVec3::ONE), None, "no length");
    }

    #[test]
    fn on_an_upright_plane_and_on_its_other_side_corners_stay_where_they_were_drawn() {
        let corners = [dvec2(0.2, 0.5), dvec2(1.4, 0.6), dvec2(0.3, 1.9)];
        let frame = Frame { origin: DVec3::new(0.0, 2.0, 0.0), u: DVec3::X, v: DVec3::Z };
        for forward in [true, false] {
            let canvas = Canvas { frame, forward };
            let Emitter::Polygon(emitter) = polygon(&corners, canvas).emitter() else { panic!("a polygon") };
            assert!(emitter.normal.distance(canvas.lit()) < 1e-12, "shines along {}", emitter.normal);
            for corner in corners {
                let found = emitter.vertices.iter().any(|v| v.distance(frame.point(corner)) < 1e-9);
                assert!(found, "{corner} in {:?}", emitter.vertices);
            }
        }
    }

    #[test]
    fn numbers_of_an_outline_are_short_however_large_it_is() {
        for size in [0.004, 0.7, 3.0, 250.0] {
            let third = size / 3.0;
            let light = polygon(&[dvec2(0.0, 0.0), dvec2(third, 0.0), dvec2(0.0, third)], 2.0);
            let Shape::Polygon(polygon) = &light.shape else { panic!("a polygon") };
            let off = (polygon.vertices[1].x - polygon.vertices[0].x - third).abs();
            assert!(off <= 2e-4 * size, "{size}: moved by {off}");
            let digits = format!("{}", polygon.vertices[1].x).trim_start_matches(['-', '0', '.']).len();
            assert!(digits <= 6, "{size}: {}", polygon.vertices[1].x);
        }
    }

    #[test]
    fn a_textured_rectangle_lies_between_its_corners_whichever_comes_first() {
        for corners in [[dvec2(0.5, 1.0), dvec2(2.0, 0.25)], [dvec2(2.0, 0.25), dvec2(0.5, 1.0)]] {
            let light = textured(corners, 2.0).expect("it has an area");
            let Shape::Textured(textured) = &light.shape else { panic!("textured") };
            assert_eq!(
                (textured.size, light.position),
                (dvec2(1.5, 0.75), DVec3::new(1.25, 0.625, 2.0)),
                "{corners:?}"
            );
        }
        assert_eq!(textured([DVec2::ZERO, dvec2(1.0, 0.0)], 2.0), None, "no area");
    }

    #[test]
    fn without_radius_there_is_no_sphere_and_no_disk() {
        assert_eq!(sphere(DVec2::ZERO, 1.0, 0.0), None, "a click without drag");
        assert_eq!(disk(DVec2::ZERO, 1.0, 0.0), None, "likewise");
    }
}
