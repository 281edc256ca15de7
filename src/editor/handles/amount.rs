//! Moving, turning and scaling things.

use glam::{DMat3, DVec3, dvec2};

use super::subject::{Subject, tidied};
use crate::editor::tools::polygon::is_simple;
use crate::light::Shape;

/// Nothing is scaled to less than this share at once.
const LEAST_FACTOR: f64 = 0.01;
/// No length becomes less than this, metres, nor any scale of a surface.
pub const LEAST: f64 = 1e-3;

/// By how much, and which way.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Amount {
    /// By a vector, metres.
    Move(DVec3),
    /// About an axis, counter-clockwise seen from its tip.
    Turn {
        /// Unit.
        axis: DVec3,
        /// Radians.
        angle: f64,
    },
    /// Along axes.
    Scale {
        /// Unit.
        axes: DMat3,
        /// One an axis.
        factors: DVec3,
    },
}

impl Amount {
    /// `subject` after it, about `pivot` or, where there is none, about its own origin.
    pub fn applied(&self, subject: &Subject, pivot: Option<DVec3>) -> Subject {
        let position = subject.position();
        let about = pivot.unwrap_or(position);
        match *self {
            Self::Move(by) => subject.clone().at(position + by),
            Self::Turn { angle: 0.0, .. } | Self::Scale { factors: DVec3::ONE, .. } => subject.clone(),
            Self::Turn { axis, angle } => {
                let turn = DMat3::from_axis_angle(axis, angle);
                subject.clone().turned_by(turn).at(moved(position, about, turn))
            }
            Self::Scale { axes, factors } => {
                let factors = factors.max(DVec3::splat(LEAST_FACTOR));
                let scaling = axes * DMat3::from_diagonal(factors) * axes.transpose();
                scaled(subject.clone(), scaling).at(moved(position, about, scaling))
            }
        }
    }
}

/// `p` after a linear map about a point; unchanged where that is the point itself.
fn moved(p: DVec3, about: DVec3, map: DMat3) -> DVec3 {
    if p == about { p } else { about + map * (p - about) }
}

/// Each of a thing's own axes is stretched by as much as `scaling` stretches a vector along it; what is round keeps its
/// shape and has its area or volume scaled.
///
/// Where own axes are along the scaling's that is the scaling itself; where they lie across, a shape that stays one.
fn scaled(mut subject: Subject, scaling: DMat3) -> Subject {
    let own = subject.rotation();
    let factors = DVec3::from_array([0, 1, 2].map(|axis| (scaling * own.col(axis)).length()));
    let of_plane = (scaling * own.x_axis).cross(scaling * own.y_axis).length().sqrt();
    let of_space = scaling.determinant().cbrt();
    let length = |length: f64, factor: f64| tidied(DVec3::splat(length * factor)).x.max(LEAST);
    match &mut subject {
        Subject::Light(light) => match &mut light.shape {
            Shape::Polygon(polygon) => {
                let by = factors.truncate();
                let vertices: Vec<_> =
                    polygon.vertices.iter().map(|v| tidied((*v * by).extend(0.0)).truncate()).collect();
                // As small as a micrometre, its corners would fall on each other.
                if is_simple(&vertices) {
                    polygon.vertices = vertices;
                }
            }
            Shape::Line(line) => line.length = length(line.length, factors.x),
            Shape::Sphere(sphere) => sphere.radius = length(sphere.radius, of_space),
            Shape::Disk(disk) => disk.radius = length(disk.radius, of_plane),
            Shape::Textured(textured) => {
                textured.size = dvec2(length(textured.size.x, factors.x), length(textured.size.y, factors.y));
            }
            Shape::Cap(_) | Shape::Sky(_) | Shape::Point(_) | Shape::Directional(_) => {}
        },
        Subject::Surface(surface) => {
            let scale = tidied(surface.scale * factors);
            surface.scale = DVec3::select(scale.abs().cmplt(DVec3::splat(LEAST)), surface.scale, scale);
        }
        Subject::Probe(_) => {}
    }
    subject
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::light::{Disk, Light, Line, Sphere};
    use crate::math::frame;

    fn light(shape: Shape, position: DVec3, rotation_deg: DVec3) -> Subject {
        Subject::Light(Light { position, rotation_deg, ..Light::new("light", shape) })
    }

    fn line(position: DVec3, rotation_deg: DVec3) -> Subject {
        light(Shape::Line(Line::isotropic(1.2)), position, rotation_deg)
    }

    #[test]
    fn a_turn_about_another_point_moves_and_turns() {
        let turn = Amount::Turn { axis: DVec3::Z, angle: 0.5 * std::f64::consts::PI };
        let start = line(DVec3::new(3.0, 0.0, 1.0), DVec3::ZERO);
        let turned = turn.applied(&start, Some(DVec3::new(1.0, 0.0, 0.0)));
        assert_eq!(turned.position(), DVec3::new(1.0, 2.0, 1.0), "moved about the pivot");
        assert!(turned.rotation().x_axis.distance(DVec3::Y) < 1e-7, "and turned with it");
        assert_eq!(turn.applied(&start, None).position(), start.position(), "about itself it stays");
    }

    #[test]
    fn a_whole_turn_in_steps_of_15_degrees_is_written_as_one_would_type_it() {
        let turn = Amount::Turn { axis: DVec3::Z, angle: 15.0_f64.to_radians() };
        let mut subject = line(DVec3::ZERO, DVec3::ZERO);
        for step in 1..=6 {
            subject = turn.applied(&subject, None);
            let Subject::Light(light) = &subject else { panic!("a light") };
            assert_eq!(light.rotation_deg, DVec3::new(0.0, 0.0, 15.0 * f64::from(step)), "step {step}");
        }
    }

    #[test]
    fn what_does_nothing_changes_nothing() {
        let odd = line(DVec3::new(0.123_456_789_01, 0.1 + 0.2, -3.3), DVec3::new(10.000_000_123, 20.5, -7.25));
        for nothing in [
            Amount::Move(DVec3::ZERO),
            Amount::Turn { axis: DVec3::X, angle: 0.0 },
            Amount::Scale { axes: DMat3::IDENTITY, factors: DVec3::ONE },
        ] {
            assert_eq!(nothing.applied(&odd, None), odd, "{nothing:?}");
        }
    }

    #[test]
    fn scaling_along_own_axes_is_exact_and_of_round_things_the_mean() {
        let axes = frame::rotation_from_deg(DVec3::new(0.0, 0.0, 30.0));
        let scale = Amount::Scale { axes, factors: DVec3::new(2.0, 1.0, 1.0) };
        let Subject::Light(long) = scale.applied(&line(DVec3::ZERO, DVec3::new(0.0, 0.0, 30.0)), None) else {
            panic!("a light")
        };
        assert_eq!(long.shape, Shape::Line(Line::isotropic(2.4)), "along itself");
        let Subject::Light(same) = scale.applied(&line(DVec3::ZERO, DVec3::new(0.0, 0.0, 120.0)), None) else {
            panic!("a light")
        };
        assert_eq!(same.shape, Shape::Line(Line::isotropic(1.2)), "across itself");
        let disk = light(Shape::Disk(Disk { radius: 0.5, two_sided: false }), DVec3::ZERO, DVec3::ZERO);
        let whole = Amount::Scale { axes, factors: DVec3::splat(3.0) };
        let Subject::Light(disk) = whole.applied(&disk, None) else { panic!("a light") };
        assert_eq!(disk.shape, Shape::Disk(Disk { radius: 1.5, two_sided: false }), "as a whole");
        let sphere = light(Shape::Sphere(Sphere { radius: 1.0 }), DVec3::X, DVec3::ZERO);
        let Subject::Light(sphere) = scale.applied(&sphere, Some(DVec3::ZERO)) else { panic!("a light") };
        let Shape::Sphere(Sphere { radius }) = sphere.shape else { panic!("a sphere") };
        assert!((radius - 2.0_f64.cbrt()).abs() < 1e-6, "a sphere keeps its shape: {radius}");
        assert!(sphere.position.x > 1.5, "and moves away from the pivot: {}", sphere.position);
    }
}
