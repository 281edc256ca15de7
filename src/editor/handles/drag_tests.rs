//! Tests of [`super`].

use super::*;
use crate::editor::tools::new_light;
use crate::light::pattern::Pattern;
use crate::light::{Cap, Textured};
use crate::scene::{Camera, Plot, PlotKind, PlotQuantity};
use egui::{Rect, pos2};
use glam::dvec2;

fn projection() -> Projection {
    let camera = Camera { eye: DVec3::new(3.0, -6.0, 5.0), target: DVec3::new(0.0, 0.0, 2.0), fov_deg: 40.0 };
    Projection::new(&camera, Rect::from_min_max(pos2(0.0, 0.0), pos2(800.0, 600.0)))
}

fn square() -> Subject {
    let corners = [dvec2(-1.0, -1.0), dvec2(1.0, -1.0), dvec2(1.0, 1.0), dvec2(-1.0, 1.0)];
    Subject::Light(new_light::polygon(&corners, 2.0))
}

fn on_screen(p: DVec3) -> Pos2 {
    projection().project(p).expect("in sight")
}

/// `handle` of `subject` dragged from where `from` appears to where `to` does.
fn dragged(subject: Subject, handle: Handle, from: DVec3, to: DVec3, snap: Option<f64>) -> Option<Change> {
    let mut drag = Drag::new(handle, subject, on_screen(from));
    drag.pull(on_screen(to) - on_screen(from), false);
    drag.change(&projection(), snap, |_| None)
}

fn light(change: Option<Change>) -> crate::light::Light {
    match change {
        Some(Change::To(Subject::Light(light))) => light,
        other => panic!("a changed light, not {other:?}"),
    }
}

fn vertices(light: &crate::light::Light) -> Vec<DVec2> {
    let Shape::Polygon(polygon) = &light.shape else { panic!("a polygon") };
    polygon.vertices.clone()
}

#[test]
fn an_axis_handle_moves_along_its_axis_and_nowhere_else() {
    for axis in 0..3 {
        let start = DVec3::new(0.0, 0.0, 2.0);
        let tip = start + 0.5 * DVec3::AXES[axis];
        // Sideways motion on screen beside the motion along the axis.
        let to = tip + 0.7 * DVec3::AXES[axis];
        let moved = light(dragged(square(), Handle::Axis(axis), tip, to, None)).position - start;
        assert!((moved - 0.7 * DVec3::AXES[axis]).length() < 1e-4, "axis {axis}: moved by {moved}");
    }
}

#[test]
fn a_plane_handle_moves_in_its_plane_and_snaps_to_the_grid() {
    let from = DVec3::new(0.2, 0.2, 2.0);
    let free = light(dragged(square(), Handle::Plane(2), from, from + DVec3::new(0.43, -0.28, 0.0), None));
    assert!((free.position - DVec3::new(0.43, -0.28, 2.0)).length() < 1e-4, "free: {}", free.position);
    let snapped = light(dragged(square(), Handle::Plane(2), from, from + DVec3::new(0.43, -0.28, 0.0), Some(0.1)));
    assert_eq!(snapped.position, DVec3::new(0.4, -0.3, 2.0), "on the grid");
}

#[test]
fn a_fine_drag_moves_a_tenth() {
    let subject = square();
    let mut drag = Drag::new(Handle::Plane(1), subject, pos2(400.0, 300.0));
    let coarse = {
        let mut drag = drag.clone();
        drag.pull(Vec2::new(10.0, 0.0), false);
        light(drag.change(&projection(), None, |_| None)).position.x
    };
    drag.pull(Vec2::new(100.0, 0.0), true);
    let fine = light(drag.change(&projection(), None, |_| None)).position.x;
    assert!((fine - coarse).abs() < 1e-5 && fine != 0.0, "{fine} and {coarse}");
}

#[test]
fn a_vertex_follows_the_pointer_in_the_lights_plane() {
    let to = DVec3::new(1.6, 1.3, 2.0);
    let moved = light(dragged(square(), Handle::Vertex(2), DVec3::new(1.0, 1.0, 2.0), to, None));
    assert!(vertices(&moved)[2].distance(dvec2(1.6, 1.3)) < 1e-4, "{:?}", vertices(&moved));
    assert_eq!(vertices(&moved)[0], dvec2(-1.0, -1.0), "the others stay");
}

#[test]
fn a_vertex_that_would_cross_an_edge_is_refused() {
    let change = dragged(square(), Handle::Vertex(2), DVec3::new(1.0, 1.0, 2.0), DVec3::new(-1.5, -0.2, 2.0), None);
    assert!(matches!(change, Some(Change::Refused(_))), "{change:?}");
}

#[test]
fn an_edge_moves_along_its_normal_with_both_its_vertices() {
    let from = DVec3::new(1.0, 0.0, 2.0);
    let moved = light(dragged(square(), Handle::Edge(1), from, from + DVec3::new(0.52, 0.4, 0.0), Some(0.1)));
    let vertices = vertices(&moved);
    assert!(vertices[1].distance(dvec2(1.5, -1.0)) < 1e-9, "{vertices:?}");
    assert!(vertices[2].distance(dvec2(1.5, 1.0)) < 1e-9, "{vertices:?}");
}

#[test]
fn an_end_of_a_line_moves_and_the_other_stays() {
    let line = new_light::line([dvec2(-1.0, 0.0), dvec2(1.0, 0.0)], 2.0).expect("a line");
    let to = DVec3::new(1.0, 1.0, 2.0);
    let moved = light(dragged(Subject::Light(line), Handle::End(1), DVec3::new(1.0, 0.0, 2.0), to, None));
    let crate::light::Emitter::Line(line) = moved.emitter() else { panic!("a line") };
    assert!(line.a.distance(DVec3::new(-1.0, 0.0, 2.0)) < 1e-9, "stays: {}", line.a);
    assert!(line.b.distance(to) < 1e-4, "follows: {}", line.b);
}

#[test]
fn a_radius_follows_the_pointer_and_stays_above_zero() {
    let sphere = new_light::sphere(dvec2(0.0, 0.0), 2.0, 0.5).expect("a sphere");
    let [right, _] = projection().right_up();
    let center = DVec3::new(0.0, 0.0, 2.0);
    let rim = center + 0.5 * right;
    let radius = |to| {
        let Shape::Sphere(sphere) = light(dragged(Subject::Light(sphere.clone()), Handle::Radius, rim, to, None)).shape
        else {
            panic!("a sphere")
        };
        sphere.radius
    };
    assert!((radius(center + 0.8 * right) - 0.8).abs() < 1e-4, "{}", radius(center + 0.8 * right));
    assert_eq!(radius(center), LEAST, "not less");
}

#[test]
fn a_ring_turns_by_the_angle_dragged_and_snaps() {
    let center = DVec3::new(0.0, 0.0, 2.0);
    let at = |deg: f64| center + 0.8 * DVec3::new(deg.to_radians().cos(), deg.to_radians().sin(), 0.0);
    let free = light(dragged(square(), Handle::Ring(2), at(10.0), at(50.0), None));
    assert!((free.rotation_deg.z - 40.0).abs() < 1e-2, "free: {}", free.rotation_deg);
    let snapped = light(dragged(square(), Handle::Ring(2), at(10.0), at(51.0), Some(0.1)));
    assert!((snapped.rotation_deg.z - 45.0).abs() < 1e-9, "snapped: {}", snapped.rotation_deg);
}

#[test]
fn scaling_along_an_axis_is_in_the_ratio_of_the_points_held() {
    let center = DVec3::new(0.0, 0.0, 2.0);
    let change = dragged(square(), Handle::Stretch(0), center + 0.6 * DVec3::X, center + 0.9 * DVec3::X, None);
    let vertices = vertices(&light(change));
    assert!((vertices[2] - dvec2(1.5, 1.0)).length() < 1e-4, "{vertices:?}");
}

#[test]
fn a_drag_past_the_horizon_says_nothing() {
    let mut drag = Drag::new(Handle::Plane(2), square(), on_screen(DVec3::new(0.2, 0.2, 2.0)));
    drag.pull(Vec2::new(0.0, -5000.0), false);
    assert_eq!(drag.change(&projection(), None, |_| None), None, "pointing at the sky");
}

#[test]
fn a_probe_takes_place_and_normal_of_the_surface_under_the_pointer() {
    let plot = Plot {
        name: "plot".to_owned(),
        kind: PlotKind::Tilt,
        quantity: PlotQuantity::default(),
        position: DVec3::ZERO,
        normal: DVec3::Z,
        view: None,
        axis: DVec3::Y,
        range: [-90.0, 90.0],
        material: None,
        normalise: false,
    };
    let drag = Drag::new(Handle::Probe, Subject::Probe(plot), pos2(400.0, 300.0));
    let p = DVec3::new(0.3, -0.2, 0.5);
    let change = drag.change(&projection(), None, |_| Some(Hit { t: 1.0, p, n: DVec3::NEG_Y }));
    let Some(Change::To(Subject::Probe(moved))) = change else { panic!("a moved probe, not {change:?}") };
    assert_eq!((moved.position, moved.normal), (p, DVec3::NEG_Y), "on the surface");
}

fn of_shape(shape: Shape) -> Subject {
    let light = crate::light::Light::new("light", shape);
    Subject::Light(crate::light::Light { position: DVec3::new(0.0, 0.0, 2.0), ..light })
}

#[test]
fn a_rectangles_side_and_corner_move_and_the_opposite_ones_stay() {
    let rectangle = || {
        of_shape(Shape::Textured(Textured {
            size: dvec2(2.0, 1.0),
            pattern: Pattern::unread("leaf.png"),
            two_sided: false,
        }))
    };
    for (signs, from, to, size, center) in [
        ([1, 0], dvec2(1.0, 0.0), dvec2(1.4, 0.3), dvec2(2.4, 1.0), dvec2(0.2, 0.0)),
        ([0, -1], dvec2(0.0, -0.5), dvec2(0.3, -0.9), dvec2(2.0, 1.4), dvec2(0.0, -0.2)),
        ([-1, 1], dvec2(-1.0, 0.5), dvec2(-1.2, 0.9), dvec2(2.2, 1.4), dvec2(-0.1, 0.2)),
        // Pulled over the opposite side, it stops at the least size.
        ([1, 0], dvec2(1.0, 0.0), dvec2(-3.0, 0.0), dvec2(LEAST, 1.0), dvec2(-1.0 + 0.5 * LEAST, 0.0)),
    ] {
        let changed = light(dragged(rectangle(), Handle::Frame(signs), from.extend(2.0), to.extend(2.0), None));
        let Shape::Textured(textured) = &changed.shape else { panic!("a rectangle") };
        assert!(textured.size.distance(size) < 1e-4, "{signs:?}: size {}", textured.size);
        assert!(changed.position.distance(center.extend(2.0)) < 1e-4, "{signs:?}: centre {}", changed.position);
    }
}

#[test]
fn a_disks_rim_is_pulled_anywhere_to_another_radius() {
    let disk = || of_shape(Shape::Disk(Disk { radius: 0.5, two_sided: false }));
    for turn in [0.0, 1.0, 2.5, 4.0] {
        let direction = DVec2::from_angle(turn).extend(0.0);
        let at = |radius: f64| DVec3::new(0.0, 0.0, 2.0) + radius * direction;
        let changed = light(dragged(disk(), Handle::Radius, at(0.5), at(0.8), None));
        let Shape::Disk(Disk { radius, .. }) = changed.shape else { panic!("a disk") };
        assert!((radius - 0.8).abs() < 1e-4, "at {turn}: radius {radius}");
    }
}

#[test]
fn a_caps_rim_is_pulled_to_another_half_angle() {
    let Subject::Light(cap) = of_shape(Shape::Cap(Cap { half_angle_deg: 20.0 })) else { panic!("a light") };
    let symbol = Symbol::new(&cap, &projection());
    let at = |angle_deg: f64| symbol.point(angle_deg.to_radians(), 0.0);
    for (to, snap, expected) in [(35.0, None, 35.0), (33.0, Some(0.1), 35.0), (-20.0, None, 20.0)] {
        let pulled = dragged(Subject::Light(cap.clone()), Handle::HalfAngle, at(20.0), at(to), snap);
        let Shape::Cap(Cap { half_angle_deg }) = light(pulled).shape else { panic!("a cap") };
        assert!((half_angle_deg - expected).abs() < 0.05, "to {to}: {half_angle_deg}");
    }
}

#[test]
fn a_far_light_is_aimed_by_its_pin_on_either_side_of_its_symbol() {
    let center = DVec3::new(0.0, 0.0, 2.0);
    let reach = aim_reach(center, &projection());
    for (start, to) in [(DVec3::Z, DVec3::new(0.3, -0.4, 0.9)), (DVec3::new(-0.3, 0.8, 0.5), DVec3::new(0.0, 0.9, 0.2))]
    {
        let [start, to] = [start.normalize(), to.normalize()];
        let rotation = DMat3::from_quat(DQuat::from_rotation_arc(DVec3::Z, start));
        let sky = of_shape(Shape::Sky(crate::light::Sky::OVERCAST)).turned(rotation);
        let aimed = light(dragged(sky, Handle::Aim, center + reach * start, center + reach * to, None));
        let axis = aimed.world_from_light().matrix3.z_axis;
        assert!(axis.distance(to) < 1e-3, "from {start}: {axis}, not {to}");
        assert_eq!(aimed.position, center, "it stays where it is");
    }
    let snapped = light(dragged(
        of_shape(Shape::Directional(crate::light::Directional {})),
        Handle::Aim,
        center + reach * DVec3::Z,
        center + reach * DVec3::new(0.2, -0.25, 0.92).normalize(),
        Some(0.1),
    ));
    let axis = snapped.world_from_light().matrix3.z_axis;
    let theta = axis.truncate().length().atan2(axis.z).to_degrees();
    assert!((theta - 15.0).abs() < 1e-6, "snapped to {theta}");
}
