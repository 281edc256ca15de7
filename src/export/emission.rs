//! What renderers with areas of constant radiance ask of lights: sides, rectangles, baked patterns.

use glam::{DMat4, DVec3};

use crate::light::{Emitter, Light, PolygonEmitter, Textured};

/// The sides of a two-sided light lie so far off its plane, in metres, that neither hides the other.
pub(super) const SIDE_GAP: f64 = 1e-4;

/// A rectangle or disk that shines to one side: its middle, and its axes, half as long as it, right-handed with the lit
/// side's normal.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Side {
    pub(super) center: DVec3,
    pub(super) x: DVec3,
    pub(super) y: DVec3,
}

impl Side {
    /// The lit side of a polygon that is a rectangle within 1e-9 of its size.
    pub(super) fn of_polygon(polygon: &PolygonEmitter) -> Option<Self> {
        let [a, b, c, d] = <[DVec3; 4]>::try_from(polygon.vertices.as_slice()).ok()?;
        let (x, y) = (0.5 * (b - a), 0.5 * (d - a));
        let size = x.length() + y.length();
        let is_closed = (a + c - b - d).length() <= 1e-9 * size;
        (is_closed && x.dot(y).abs() <= 1e-9 * size * size).then(|| Self { center: 0.5 * (a + c), x, y })
    }

    /// The lit side of a disk.
    pub(super) fn of_disk(light: &Light, radius: f64) -> Self {
        let axes = light.world_from_light().matrix3;
        Self { center: light.position, x: radius * axes.x_axis, y: -radius * axes.y_axis }
    }

    /// The lit side of a textured light: its Y runs up the picture, its X along the rows, against the columns' numbers.
    pub(super) fn of_textured(light: &Light, textured: &Textured) -> Self {
        let axes = light.world_from_light().matrix3;
        let half = 0.5 * textured.size;
        Self { center: light.position, x: -half.x * axes.x_axis, y: half.y * axes.y_axis }
    }

    /// Of the lit side.
    pub(super) fn normal(&self) -> DVec3 {
        self.x.cross(self.y).normalize_or_zero()
    }

    /// Corners, counter-clockwise for who looks at the lit side.
    pub(super) fn corners(&self) -> [DVec3; 4] {
        let Self { center, x, y } = *self;
        [center - x - y, center + x - y, center + x + y, center - x + y]
    }

    /// This side; or, of a light with two, this one and the other, turned about Y, each a little off their plane.
    pub(super) fn with_other(self, two_sided: bool) -> Vec<Self> {
        let raised = |side: Self| Self { center: side.center + SIDE_GAP * side.normal(), ..side };
        if two_sided { vec![raised(self), raised(Self { x: -self.x, ..self })] } else { vec![self] }
    }

    /// Takes the square from −1 to 1 that faces +Z onto it.
    pub(super) fn world_from_square(&self) -> DMat4 {
        let Self { center, x, y } = *self;
        DMat4::from_cols(x.extend(0.0), y.extend(0.0), self.normal().extend(0.0), center.extend(1.0))
    }
}

/// The outline of a polygon's lit side; or, where it has two, of both, each a little off their plane. Counter-clockwise
/// for who looks at it.
pub(super) fn outlines(polygon: &PolygonEmitter) -> Vec<Vec<DVec3>> {
    if !polygon.two_sided {
        return vec![polygon.vertices.clone()];
    }
    let raised = |distance: f64| polygon.vertices.iter().map(move |v| v + distance * polygon.normal);
    vec![raised(SIDE_GAP).collect(), raised(-SIDE_GAP).rev().collect()]
}

/// Whether it is a thing that hides others in a renderer.
pub(super) fn has_body(emitter: &Emitter) -> bool {
    match emitter {
        Emitter::Polygon(_) | Emitter::Disk(_) | Emitter::Textured(_) | Emitter::Sphere(_) => true,
        Emitter::Line(line) => line.tube.is_some(),
        Emitter::Cap(_) | Emitter::Sky(_) | Emitter::Point(_) | Emitter::Directional(_) => false,
    }
}

/// The radiance of each texel of a pattern in cd/m², row by row, and its columns and rows.
pub(super) fn radiances(light: &Light, textured: &Textured) -> ([u32; 2], Vec<DVec3>) {
    let image = &textured.pattern.image;
    let [columns, rows] = image.channels().first().map_or([0; 2], |channel| channel.size());
    let share = |i: u32, count: u32| (f64::from(i) + 0.5) / f64::from(count);
    let texels = (0..rows).flat_map(|row| (0..columns).map(move |column| (column, row)));
    let weight = light.weight();
    let value = |(column, row)| weight * image.value(share(column, columns), share(row, rows));
    ([columns, rows], texels.map(value).collect())
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use glam::{DVec2, dvec2};

    use super::*;
    use crate::light::pattern::{Channel, Image, Pattern};
    use crate::light::{Disk, Polygon, Shape};

    fn turned(shape: Shape) -> Light {
        let (position, rotation_deg) = (DVec3::new(1.0, 2.0, 3.0), DVec3::new(20.0, 30.0, 40.0));
        Light { position, rotation_deg, ..Light::new("l", shape) }
    }

    /// A side faces as its light, and the other one the other way; both lie off the plane.
    #[track_caller]
    fn check_sides(side: Side, normal: DVec3) {
        assert!(side.normal().distance(normal) < 1e-14, "faces as the light: {side:?}");
        let [this, other] = <[Side; 2]>::try_from(side.with_other(true)).expect("two sides");
        assert!(other.normal().distance(-normal) < 1e-14, "the other side: {other:?}");
        let apart = (this.center - other.center).dot(normal);
        assert!((apart - 2.0 * SIDE_GAP).abs() < 1e-15, "{apart} apart");
        assert_eq!(side.with_other(false), [side], "one side");
    }

    #[track_caller]
    fn check(vertices: &[[f64; 2]], is_rectangle: bool) {
        let vertices = vertices.iter().map(|v| DVec2::from(*v)).collect();
        let light = turned(Shape::Polygon(Polygon { vertices, two_sided: true }));
        let Emitter::Polygon(emitter) = light.emitter() else { panic!("a polygon") };
        let side = Side::of_polygon(&emitter);
        assert_eq!(side.is_some(), is_rectangle, "{side:?}");
        if let Some(side) = side {
            check_sides(side, emitter.normal);
            for corner in side.corners() {
                assert!(emitter.vertices.iter().any(|v| v.distance(corner) < 1e-14), "{corner} is a vertex");
            }
        }
        let turn = |v: &[DVec3]| (v[1] - v[0]).cross(v[2] - v[1]).normalize();
        let [this, other] = <[Vec<DVec3>; 2]>::try_from(outlines(&emitter)).expect("two outlines");
        assert!(turn(&this).distance(emitter.normal) < 1e-12, "counter-clockwise about its normal");
        assert!(turn(&other).distance(-emitter.normal) < 1e-12, "and the other side about its own");
    }

    #[test]
    fn rectangles_are_found_whichever_way_round() {
        check(&[[0.0, 0.0], [2.0, 0.0], [2.0, 1.0], [0.0, 1.0]], true);
        check(&[[0.0, 1.0], [2.0, 1.0], [2.0, 0.0], [0.0, 0.0]], true);
        check(&[[0.0, 0.0], [1.0, 1.0], [0.0, 2.0], [-1.0, 1.0]], true);
        check(&[[0.0, 0.0], [2.0, 0.0], [2.5, 1.0], [0.5, 1.0]], false);
        check(&[[0.0, 0.0], [2.0, 0.0], [2.0, 1.0]], false);
    }

    #[test]
    fn a_disk_faces_as_its_light() {
        let light = turned(Shape::Disk(Disk { radius: 0.5, two_sided: true }));
        let Emitter::Disk(emitter) = light.emitter() else { panic!("a disk") };
        let side = Side::of_disk(&light, 0.5);
        check_sides(side, emitter.normal);
        assert!((side.x.length() - 0.5).abs() < 1e-15 && (side.y.length() - 0.5).abs() < 1e-15, "its radius: {side:?}");
    }

    #[test]
    fn a_pattern_lies_on_its_side_as_on_the_light() {
        let grey = Channel::new(2, vec![0.0, 0.25, 0.5, 1.0, 0.75, 0.125]).expect("three rows of two");
        let pattern = Pattern::of_image("grey.png", Image::Grey(Arc::new(grey)));
        let textured = Textured { size: dvec2(2.0, 1.0), pattern, two_sided: false };
        let light = turned(Shape::Textured(textured.clone()));
        let Emitter::Textured(emitter) = light.emitter() else { panic!("textured") };
        let side = Side::of_textured(&light, &textured);
        check_sides(side, emitter.normal);
        let Side { center, x, y } = side;
        assert!((center - x + y).distance(emitter.point(0.0, 0.0)) < 1e-14, "the first texel's corner");
        assert!((center + x + y).distance(emitter.point(1.0, 0.0)) < 1e-14, "the end of the first row");
        let (size, texels) = radiances(&light, &textured);
        assert_eq!((size, texels[1]), ([2, 3], 0.25 * light.weight()), "row by row");
    }
}
