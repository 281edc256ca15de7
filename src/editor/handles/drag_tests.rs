//! Tests of [`super`].

use super::*;
use crate::editor::handles::amount::LEAST;
use crate::editor::handles::frame::{Axes, Pivot, Transform};
use crate::editor::session::Tool;
use crate::editor::tools::new_light;
use crate::editor::viewport::symbol::Symbol;
use crate::light::pattern::Pattern;
use crate::light::{Cap, Disk, Emitter, Line, Shape, Textured};
use crate::scene::{Camera, Plot, PlotKind, PlotQuantity};
use crate::surface::Surface;
use egui::{Rect, pos2};
use glam::{DMat3, DQuat, DVec2, DVec3, dvec2};

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

/// A drag of `handle` of one thing, held at `pos`.
fn held(subject: Subject, handle: Handle, pos: Pos2) -> Drag {
    let tool = if matches!(handle, Handle::Stretch(_)) { Tool::Scale } else { Tool::Move };
    let start = vec![(Item::Light(0), subject)];
    let frame = Frame::new(Transform::default(), tool, &start).expect("a thing");
    Drag::new(handle, frame, start, pos)
}

/// `handle` of `subject` dragged from where `from` appears to where `to` does.
fn dragged(subject: Subject, handle: Handle, from: DVec3, to: DVec3, snap: Option<f64>) -> Option<Outcome> {
    dragged_and_typed(subject, handle, from, to, snap, "")
}

/// As [`dragged`], with a number typed meanwhile.
fn dragged_and_typed(
    subject: Subject,
    handle: Handle,
    from: DVec3,
    to: DVec3,
    snap: Option<f64>,
    text: &str,
) -> Option<Outcome> {
    let mut drag = held(subject, handle, on_screen(from));
    drag.pull(on_screen(to) - on_screen(from), false);
    drag.typed = Typed::of(text);
    drag.change(&projection(), &Solids::default(), snap)
}

fn only(outcome: Option<Outcome>) -> Subject {
    let outcome = outcome.expect("the pointer says something");
    assert_eq!(outcome.refused, None, "it is allowed");
    let [(_, subject)] = outcome.now.try_into().expect("one thing");
    subject
}

fn light(outcome: Option<Outcome>) -> crate::light::Light {
    match only(outcome) {
        Subject::Light(light) => light,
        other => panic!("a light, not {other:?}"),
    }
}

fn surface(outcome: Option<Outcome>) -> Surface {
    match only(outcome) {
        Subject::Surface(surface) => surface,
        other => panic!("a surface, not {other:?}"),
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
    let mut drag = held(subject, Handle::Plane(1), pos2(400.0, 300.0));
    let coarse = {
        let mut drag = drag.clone();
        drag.pull(Vec2::new(10.0, 0.0), false);
        light(drag.change(&projection(), &Solids::default(), None)).position.x
    };
    drag.pull(Vec2::new(100.0, 0.0), true);
    let fine = light(drag.change(&projection(), &Solids::default(), None)).position.x;
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
fn a_vertex_and_an_end_stick_to_corners_before_the_grid() {
    let corner = DVec3::new(1.63, 1.28, 2.0);
    let stuck = |subject: Subject, handle, from: DVec3, beside: f64| {
        let to = corner + DVec3::new(beside, 0.0, 0.0);
        let mut drag = held(subject, handle, on_screen(from)).among(vec![corner]);
        drag.pull(on_screen(to) - on_screen(from), false);
        light(drag.change(&projection(), &Solids::default(), Some(0.1)))
    };
    let vertex = |beside| vertices(&stuck(square(), Handle::Vertex(2), DVec3::new(1.0, 1.0, 2.0), beside))[2];
    assert!(vertex(0.02).distance(corner.truncate()) < 1e-9, "the corner: {}", vertex(0.02));
    assert_eq!(vertex(0.34), dvec2(2.0, 1.3), "else the grid");
    let line = new_light::line([dvec2(-1.0, 0.0), dvec2(1.0, 0.0)], 2.0).expect("a line");
    let line = stuck(Subject::Light(line), Handle::End(1), DVec3::new(1.0, 0.0, 2.0), 0.02);
    let Emitter::Line(line) = line.emitter() else { panic!("a line") };
    assert!(line.b.distance(corner) < 1e-6, "the end: {}", line.b);
}

#[test]
fn a_vertex_that_would_cross_an_edge_is_refused() {
    let change = dragged(square(), Handle::Vertex(2), DVec3::new(1.0, 1.0, 2.0), DVec3::new(-1.5, -0.2, 2.0), None);
    assert!(change.as_ref().is_some_and(|change| change.refused.is_some() && change.now.is_empty()), "{change:?}");
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
    assert!(line.a.distance(DVec3::new(-1.0, 0.0, 2.0)) < 1e-6, "stays: {}", line.a);
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
    assert!(radius(center) < 0.01 && radius(center) >= LEAST, "not less: {}", radius(center));
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
    let mut drag = held(square(), Handle::Plane(2), on_screen(DVec3::new(0.2, 0.2, 2.0)));
    drag.pull(Vec2::new(0.0, -5000.0), false);
    assert_eq!(drag.change(&projection(), &Solids::default(), None), None, "pointing at the sky");
}

fn plot(position: DVec3) -> Plot {
    Plot {
        name: "plot".to_owned(),
        kind: PlotKind::Tilt,
        quantity: PlotQuantity::default(),
        position,
        normal: DVec3::Z,
        view: None,
        axis: DVec3::Y,
        range: [-90.0, 90.0],
        material: None,
        normalise: false,
    }
}

fn probe(outcome: Option<Outcome>) -> Plot {
    match only(outcome) {
        Subject::Probe(plot) => plot,
        other => panic!("a probe, not {other:?}"),
    }
}

#[test]
fn a_probe_takes_place_and_normal_of_the_surface_under_the_pointer_and_keeps_its_normal_with_ctrl() {
    let mut solids = Solids::default();
    solids.update(&[solid(crate::surface::Shape::Sphere { radius: 0.5 })]);
    let (center, out) = (DVec3::new(0.0, 0.0, 2.0), DVec3::new(0.3, -0.8, 0.5).normalize());
    let from = on_screen(DVec3::new(1.0, 0.0, 2.0));
    let mut drag = held(Subject::Probe(plot(DVec3::new(1.0, 0.0, 2.0))), Handle::Probe, from);
    drag.pull(on_screen(center + 0.5 * out) - from, false);
    let moved = probe(drag.change(&projection(), &solids, None));
    assert!(moved.position.distance(center + 0.5 * out) < 1e-4, "on the ball: {}", moved.position);
    assert!(moved.normal.distance(out) < 1e-3, "with its normal: {}", moved.normal);
    let kept = probe(drag.change(&projection(), &solids, Some(0.1)));
    assert_eq!((kept.position, kept.normal), (moved.position, DVec3::Z), "its own normal");
}

#[test]
fn a_probe_beside_all_surfaces_is_dragged_across_the_screen() {
    let start = DVec3::new(1.0, 0.0, 2.0);
    let [right, up] = projection().right_up();
    let to = start + 0.4 * right - 0.3 * up;
    let moved = probe(dragged(Subject::Probe(plot(start)), Handle::Probe, start, to, None));
    assert!(moved.position.distance(to) < 1e-4, "in the air: {}", moved.position);
    assert_eq!(moved.normal, DVec3::Z, "with its normal");
}

#[test]
fn a_probes_normal_follows_the_pointer_and_snaps() {
    let start = DVec3::new(0.0, 0.0, 2.0);
    let reach = crate::editor::viewport::overlay::PROBE_NORMAL * projection().metres_per_point(start);
    let to = DVec3::new(0.5, -0.4, 0.7).normalize();
    let turn = |snap| {
        probe(dragged(Subject::Probe(plot(start)), Handle::Normal, start + reach * DVec3::Z, start + reach * to, snap))
    };
    assert!(turn(None).normal.distance(to) < 1e-3, "follows: {}", turn(None).normal);
    assert_eq!(turn(None).position, start, "where it is");
    let snapped = turn(Some(0.1)).normal;
    let theta = snapped.truncate().length().atan2(snapped.z).to_degrees();
    assert!((theta - 45.0).abs() < 1e-3, "snapped to {theta}°");
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
        ([1, 0, 0], dvec2(1.0, 0.0), dvec2(1.4, 0.3), dvec2(2.4, 1.0), dvec2(0.2, 0.0)),
        ([0, -1, 0], dvec2(0.0, -0.5), dvec2(0.3, -0.9), dvec2(2.0, 1.4), dvec2(0.0, -0.2)),
        ([-1, 1, 0], dvec2(-1.0, 0.5), dvec2(-1.2, 0.9), dvec2(2.2, 1.4), dvec2(-0.1, 0.2)),
        // Pulled over the opposite side, it stops at the least size.
        ([1, 0, 0], dvec2(1.0, 0.0), dvec2(-3.0, 0.0), dvec2(LEAST, 1.0), dvec2(-1.0 + 0.5 * LEAST, 0.0)),
    ] {
        let changed = light(dragged(rectangle(), Handle::Side(signs), from.extend(2.0), to.extend(2.0), None));
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
    let reach = super::aim::reach(center, &projection());
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

/// A surface at a height of 2 m.
fn solid(shape: crate::surface::Shape) -> Surface {
    Surface {
        name: "solid".to_owned(),
        material: "m".to_owned(),
        position: DVec3::new(0.0, 0.0, 2.0),
        rotation_deg: DVec3::ZERO,
        scale: DVec3::ONE,
        shape,
    }
}

#[test]
fn a_typed_number_is_the_amount_whatever_the_pointer_does() {
    let center = DVec3::new(0.0, 0.0, 2.0);
    let (from, to) = (center + 0.6 * DVec3::X, center + 0.93 * DVec3::X);
    let typed = |handle, text| light(dragged_and_typed(square(), handle, from, to, None, text));
    assert_eq!(typed(Handle::Axis(0), "1.5").position, DVec3::new(1.5, 0.0, 2.0), "metres along the axis");
    assert_eq!(typed(Handle::Plane(2), "0.5x-2").position, DVec3::new(0.5, -2.0, 2.0), "along both axes");
    assert_eq!(typed(Handle::Ring(2), "30").rotation_deg, DVec3::new(0.0, 0.0, 30.0), "degrees");
    assert_eq!(vertices(&typed(Handle::Stretch(0), "2"))[2], dvec2(2.0, 1.0), "a factor");
    let disk = of_shape(Shape::Disk(Disk { radius: 0.6, two_sided: false }));
    let disk = light(dragged_and_typed(disk, Handle::Radius, from, to, None, ".35"));
    assert_eq!(disk.shape, Shape::Disk(Disk { radius: 0.35, two_sided: false }), "a radius");
    let line = of_shape(Shape::Line(Line::isotropic(1.2)));
    let line = light(dragged_and_typed(line, Handle::End(1), from, to, None, "2"));
    assert!(matches!(&line.shape, Shape::Line(line) if line.length == 2.0), "a length: {:?}", line.shape);
    assert!(line.position.distance(DVec3::new(0.4, 0.0, 2.0)) < 1e-3, "from the other end: {}", line.position);
}

#[test]
fn a_drag_acts_on_all_that_is_selected_about_the_pivot_in_the_chosen_axes() {
    let at = |x: f64, turn: f64| {
        let light = crate::light::Light::new("light", Shape::Line(Line::isotropic(1.0)));
        let position = DVec3::new(x, 0.0, 2.0);
        Subject::Light(crate::light::Light { position, rotation_deg: DVec3::new(0.0, 0.0, turn), ..light })
    };
    let start = vec![(Item::Light(0), at(-1.0, 0.0)), (Item::Light(1), at(1.0, 90.0))];
    let after = |transform, handle, text| {
        let frame = Frame::new(transform, Tool::Move, &start).expect("two things");
        let mut drag = Drag::new(handle, frame, start.clone(), pos2(400.0, 300.0));
        drag.pull(Vec2::new(3.0, 2.0), false);
        drag.typed = Typed::of(text);
        let now = drag.change(&projection(), &Solids::default(), None).expect("a change").now;
        now.into_iter().map(|(_, subject)| subject.position()).collect::<Vec<_>>()
    };
    let (center, own) = (Pivot::Center, Pivot::Own);
    let places = after(Transform { axes: Axes::World, pivot: center }, Handle::Ring(2), "90");
    assert_eq!(places, [DVec3::new(0.0, -1.0, 2.0), DVec3::new(0.0, 1.0, 2.0)], "about the middle");
    let places = after(Transform { axes: Axes::World, pivot: own }, Handle::Ring(2), "90");
    assert_eq!(places, [DVec3::new(-1.0, 0.0, 2.0), DVec3::new(1.0, 0.0, 2.0)], "each about itself");
    let places = after(Transform { axes: Axes::Local, pivot: own }, Handle::Axis(0), "2");
    assert_eq!(
        places,
        [DVec3::new(-1.0, 2.0, 2.0), DVec3::new(1.0, 2.0, 2.0)],
        "along the X of what was selected last"
    );
    let places = after(Transform { axes: Axes::World, pivot: Pivot::Primary }, Handle::Scale, "2");
    assert_eq!(places, [DVec3::new(-3.0, 0.0, 2.0), DVec3::new(1.0, 0.0, 2.0)], "away from what was selected last");
}

#[test]
fn a_drag_from_the_middle_moves_across_the_screen() {
    let start = DVec3::new(0.0, 0.0, 2.0);
    let [right, up] = projection().right_up();
    let to = start + 0.5 * right + 0.25 * up;
    let moved = light(dragged(square(), Handle::Screen, start, to, None));
    assert!(moved.position.distance(to) < 1e-4, "{} is not {to}", moved.position);
}

#[test]
fn a_ring_about_the_line_of_sight_turns_counter_clockwise_as_it_is_seen() {
    let center = DVec3::new(0.0, 0.0, 2.0);
    let [right, up] = projection().right_up();
    let turned = light(dragged(square(), Handle::ScreenRing, center + right, center + up, None));
    let before = crate::math::frame::rotation_from_deg(square_rotation());
    let x = crate::math::frame::rotation_from_deg(turned.rotation_deg) * before.transpose() * right;
    assert!(x.distance(up) < 1e-3, "right is turned to {x}, not up {up}");
}

fn square_rotation() -> DVec3 {
    let Subject::Light(light) = square() else { panic!("a light") };
    light.rotation_deg
}

#[test]
fn a_face_of_a_box_moves_and_the_opposite_one_stays() {
    use crate::surface::Shape::{Box as Cuboid, Cone, Cylinder};
    let cuboid =
        || Subject::Surface(Surface { scale: DVec3::new(1.0, 1.0, 0.5), ..solid(Cuboid { size: DVec3::ONE }) });
    let top = DVec3::new(0.0, 0.0, 2.25);
    let taller = surface(dragged(cuboid(), Handle::Side([0, 0, 1]), top, top + 0.5 * DVec3::Z, None));
    let Cuboid { size } = taller.shape else { panic!("a box") };
    assert!(size.distance(DVec3::new(1.0, 1.0, 2.0)) < 1e-3, "in its own frame: {size}");
    assert!((taller.position.z - 2.25).abs() < 1e-3, "the bottom stays at 1.75: {}", taller.position);

    for shape in [Cylinder { radius: 0.3, height: 1.0 }, Cone { radius: 0.3, height: 1.0 }] {
        let bottom = DVec3::new(0.0, 0.0, 1.5);
        let start = Subject::Surface(solid(shape));
        let changed = surface(dragged_and_typed(start, Handle::Side([0, 0, -1]), bottom, bottom, None, "1.4"));
        let (Cylinder { radius, height } | Cone { radius, height }) = changed.shape else { panic!("round") };
        assert_eq!((radius, height), (0.3, 1.4), "its height");
        assert!((changed.position.z - 1.8).abs() < 1e-9, "the top stays at 2.5: {}", changed.position);
    }
}

#[test]
fn the_radius_of_a_surface_is_pulled_and_stays_round_in_its_own_frame() {
    use crate::surface::Shape::{Cone, Cylinder, Disk, Sphere};
    for (shape, scale) in [
        (Sphere { radius: 0.5 }, DVec3::new(2.0, 1.0, 0.5)),
        (Disk { radius: 0.5 }, DVec3::new(1.0, 2.0, 1.0)),
        (Cylinder { radius: 0.5, height: 1.0 }, DVec3::ONE),
        (Cone { radius: 0.5, height: 1.0 }, DVec3::ONE),
    ] {
        let start = Subject::Surface(Surface { scale, ..solid(shape.clone()) });
        let [center, point] = super::super::shapes::rim(&start, &projection()).expect("it has a rim");
        let changed = surface(dragged(start, Handle::Radius, point, center + 1.5 * (point - center), None));
        let (Sphere { radius } | Disk { radius } | Cylinder { radius, .. } | Cone { radius, .. }) = changed.shape
        else {
            panic!("round")
        };
        assert!((radius - 0.75).abs() < 1e-3, "{shape:?}: {radius}");
        assert_eq!(changed.position, DVec3::new(0.0, 0.0, 2.0), "about its middle");
    }
}

#[test]
fn a_control_point_of_a_patch_follows_the_pointer() {
    let flat: Vec<DVec3> = (0..16).map(|i| DVec3::new(f64::from(i % 4), f64::from(i / 4), 0.0) * 0.3).collect();
    let control_points = Box::new(<[DVec3; 16]>::try_from(flat).expect("sixteen"));
    let start = Subject::Surface(solid(crate::surface::Shape::Patch { control_points: control_points.clone() }));
    let from = DVec3::new(0.3, 0.3, 2.0);
    let [right, up] = projection().right_up();
    let changed = surface(dragged(start, Handle::Control(5), from, from + 0.2 * up - 0.1 * right, None));
    let crate::surface::Shape::Patch { control_points: now } = &changed.shape else { panic!("a patch") };
    assert!((now[5] - control_points[5]).distance(0.2 * up - 0.1 * right) < 1e-3, "{}", now[5]);
    assert_eq!(now[4], control_points[4], "the others stay");
}

#[test]
fn a_light_is_turned_to_the_surface_under_the_pointer_by_its_target() {
    let mut solids = Solids::default();
    solids.update(&[Surface { position: DVec3::ZERO, ..solid(crate::surface::Shape::Plane {}) }]);
    let Subject::Light(start) = square() else { panic!("a light") };
    let target = aim::target(&start, &projection(), &solids);
    assert!(target.distance(DVec3::ZERO) < 1e-9, "it faces the floor under it: {target}");
    let mut drag = held(Subject::Light(start), Handle::Target, on_screen(target));
    let to = DVec3::new(0.7, 0.9, 0.0);
    drag.pull(on_screen(to) - on_screen(target), false);
    let aimed = light(drag.change(&projection(), &solids, None));
    let axis = -aimed.world_from_light().matrix3.z_axis;
    assert!(axis.distance((to - aimed.position).normalize()) < 1e-4, "{axis}");
    assert_eq!(aimed.position, DVec3::new(0.0, 0.0, 2.0), "from where it is");
}
