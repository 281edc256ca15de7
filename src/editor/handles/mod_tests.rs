//! Tests of [`super`].

use super::frame::Transform;
use super::*;
use crate::editor::tools::new_light;
use crate::light;
use crate::scene::Camera;
use egui::{Rect, pos2};
use glam::dvec2;

fn projection(eye: DVec3) -> Projection {
    let camera = Camera { eye, target: DVec3::new(0.0, 0.0, 2.0), fov_deg: 40.0 };
    Projection::new(&camera, Rect::from_min_max(pos2(0.0, 0.0), pos2(800.0, 600.0)))
}

fn square() -> Subject {
    let corners = [dvec2(-1.0, -1.0), dvec2(1.0, -1.0), dvec2(1.0, 1.0), dvec2(-1.0, 1.0)];
    Subject::Light(new_light::polygon(&corners, 2.0))
}

fn of_shape(shape: light::Shape) -> Subject {
    let light = light::Light::new("light", shape);
    Subject::Light(light::Light { position: DVec3::new(0.0, 0.0, 2.0), ..light })
}

fn textured() -> light::Shape {
    let pattern = light::pattern::Pattern::unread("leaf.png");
    light::Shape::Textured(light::Textured { size: dvec2(2.0, 1.0), pattern, two_sided: false })
}

/// The handles on one thing.
fn on(subject: &Subject, tool: Tool, projection: &Projection) -> Vec<Spot> {
    let subjects = [(Item::Light(0), subject.clone())];
    let frame = Frame::new(Transform::default(), tool, &subjects).expect("a thing");
    spots(&frame, &subjects, tool, projection, &Solids::default())
}

fn handles(spots: &[Spot]) -> Vec<Handle> {
    spots.iter().map(|spot| spot.handle).collect()
}

#[test]
fn every_handle_is_hit_where_it_is_drawn() {
    let projection = projection(DVec3::new(4.0, -5.0, 6.5));
    let moves = 1 + 3 + 3;
    for (subject, own) in [
        (square(), 4 + 4 + 1),
        (of_shape(light::Shape::Disk(light::Disk { radius: 1.0, two_sided: false })), 2 + 1),
        (of_shape(textured()), 8 + 1),
        (of_shape(light::Shape::Cap(light::Cap { half_angle_deg: 20.0 })), 2),
        (of_shape(light::Shape::Sky(light::Sky::OVERCAST)), 1),
        (of_shape(light::Shape::Directional(light::Directional {})), 1),
        (of_shape(light::Shape::Point(light::Point::default())), 0),
        (of_shape(light::Shape::Line(light::Line::tube(1.0, 0.4))), 3),
    ] {
        let spots = on(&subject, Tool::Move, &projection);
        assert_eq!(spots.len(), own + moves, "{:?}", handles(&spots));
        check_hits(&spots);
    }
}

#[track_caller]
fn check_hits(spots: &[Spot]) {
    for spot in spots {
        let at = match &spot.outline {
            Outline::Dot(at) | Outline::Diamond(at) | Outline::Circle(at) | Outline::Pin([_, at]) => *at,
            Outline::Arrow([_, tip]) | Outline::Lever([_, tip]) => *tip,
            Outline::Patch([_, _, corner, _]) => *corner,
            Outline::Ring(pieces) => pieces[0][0],
        };
        assert_eq!(hit(spots, at), Some(spot.handle), "at {at:?}");
    }
    assert_eq!(hit(spots, pos2(5.0, 5.0)), None, "in the corner");
}

#[test]
fn handles_keep_their_size_on_screen() {
    let length = |distance: f64| {
        let projection = projection(DVec3::new(0.0, -distance, 2.0));
        let spots = on(&square(), Tool::Move, &projection);
        let up = spots.iter().find(|spot| spot.handle == Handle::Axis(2)).expect("the Z arrow");
        let Outline::Arrow([from, to]) = up.outline else { panic!("an arrow") };
        from.distance(to)
    };
    assert!((length(3.0) - length(30.0)).abs() < 0.01, "{} and {}", length(3.0), length(30.0));
}

#[test]
fn an_axis_that_points_at_the_eye_has_no_arrow_and_a_plane_seen_edge_on_no_square() {
    let spots = on(&square(), Tool::Move, &projection(DVec3::new(0.0, -6.0, 2.0)));
    let handles = handles(&spots);
    assert!(!handles.contains(&Handle::Axis(1)), "Y points at the eye: {handles:?}");
    assert!(!handles.contains(&Handle::Plane(2)), "XY is edge-on: {handles:?}");
    assert!(handles.contains(&Handle::Axis(0)) && handles.contains(&Handle::Plane(1)), "{handles:?}");
}

#[test]
fn a_line_can_not_be_turned_about_itself_nor_a_sphere_at_all() {
    let projection = projection(DVec3::new(3.0, -6.0, 5.0));
    let line = new_light::line([dvec2(0.0, 0.0), dvec2(1.0, 0.0)], 2.0).expect("a line");
    assert_eq!(
        handles(&on(&Subject::Light(line), Tool::Rotate, &projection)),
        [Handle::Ring(1), Handle::Ring(2), Handle::ScreenRing],
        "a line"
    );
    let sphere = new_light::sphere(dvec2(0.0, 0.0), 2.0, 0.3).expect("a sphere");
    assert_eq!(handles(&on(&Subject::Light(sphere.clone()), Tool::Rotate, &projection)), [], "a sphere");
    assert_eq!(handles(&on(&Subject::Light(sphere), Tool::Scale, &projection)), [Handle::Scale], "scaled");
}

#[test]
fn the_inside_of_a_screen_polygon_is_even_odd() {
    let l_shape = [pos2(0.0, 0.0), pos2(4.0, 0.0), pos2(4.0, 1.0), pos2(1.0, 1.0), pos2(1.0, 4.0), pos2(0.0, 4.0)];
    assert!(inside(&l_shape, pos2(0.5, 3.0)) && inside(&l_shape, pos2(3.0, 0.5)), "both arms");
    assert!(!inside(&l_shape, pos2(2.0, 2.0)), "the notch");
}

#[test]
fn every_surface_has_the_handles_of_its_shape() {
    use crate::surface::{Shape, Surface};
    let projection = projection(DVec3::new(4.0, -5.0, 6.5));
    let patch = std::array::from_fn(|i| 0.5 * DVec3::new((i % 4) as f64, (i / 4) as f64, 0.0));
    for (shape, own) in [
        (Shape::Plane {}, 0),
        (Shape::Sphere { radius: 1.2 }, 1),
        (Shape::Box { size: DVec3::splat(2.0) }, 6),
        (Shape::Square { size: dvec2(2.0, 1.0) }, 8),
        (Shape::Disk { radius: 1.2 }, 1),
        (Shape::Cylinder { radius: 1.2, height: 2.0 }, 3),
        (Shape::Cone { radius: 1.2, height: 2.0 }, 3),
        (Shape::Patch { control_points: Box::new(patch) }, 16),
    ] {
        let name = shape.name();
        let (position, scale) = (DVec3::new(0.0, 0.0, 2.0), DVec3::ONE);
        let (rotation_deg, material) = (DVec3::ZERO, "m".to_owned());
        let surface = Surface { name: name.to_owned(), material, position, rotation_deg, scale, shape };
        let spots = on(&Subject::Surface(surface), Tool::Move, &projection);
        assert_eq!(spots.iter().filter(|spot| !spot.handle.is_transform()).count(), own, "{name}");
    }
}
