//! Fills: of what is alike, and from one colour to another.

use glam::DVec2;

use super::super::code::single;
use super::{Canvas, Rgb};

/// The texels around a place that differ from its own value by no more than `tolerance` in any channel and hang together
/// by their sides; as indices, row by row. None outside of the picture.
pub fn alike(canvas: &Canvas, column: usize, row: usize, tolerance: f32) -> Vec<usize> {
    let [width, height] = canvas.size();
    let Some(value) = canvas.get(column, row) else { return Vec::new() };
    let is_alike = |i: usize| canvas.texels()[i].iter().zip(value).all(|(a, b)| (a - b).abs() <= tolerance);
    let mut known = vec![false; width * height];
    let mut found = vec![row * width + column];
    known[found[0]] = true;
    let mut next = 0;
    while let Some(i) = found.get(next).copied() {
        next += 1;
        let (x, y) = (i % width, i / width);
        let neighbours = [
            (x > 0).then(|| i - 1),
            (x + 1 < width).then_some(i + 1),
            (y > 0).then(|| i - width),
            (y + 1 < height).then_some(i + width),
        ];
        for neighbour in neighbours.into_iter().flatten() {
            if !known[neighbour] && is_alike(neighbour) {
                known[neighbour] = true;
                found.push(neighbour);
            }
        }
    }
    found.sort_unstable();
    found
}

/// How a gradient goes from its first colour to its second.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Course {
    /// Along the way between its ends, the same across.
    Linear,
    /// With the distance from its first end.
    Radial,
}

/// A gradient's colour at a point, with its first colour at a and its second at b; even beyond them.
pub fn gradient(course: Course, [a, b]: [DVec2; 2], [first, second]: [Rgb; 2], at: DVec2) -> Rgb {
    let way = b - a;
    let share = match course {
        _ if way == DVec2::ZERO => 1.0,
        Course::Linear => (at - a).dot(way) / way.length_squared(),
        Course::Radial => (at - a).length() / way.length(),
    };
    let share = share.clamp(0.0, 1.0);
    std::array::from_fn(|c| single((1.0 - share) * f64::from(first[c]) + share * f64::from(second[c])))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A frame of a texel's width around a dark inside with one bright texel.
    fn frame() -> Canvas {
        Canvas::of_texels([8, 6], |x, y| match (x, y) {
            (0 | 7, _) | (_, 0 | 5) => [1.0; 3],
            (3, 3) => [0.5; 3],
            _ => [0.1; 3],
        })
    }

    #[test]
    fn a_fill_ends_at_what_differs() {
        let canvas = frame();
        assert_eq!(alike(&canvas, 1, 1, 0.0).len(), 6 * 4 - 1, "the inside but for one");
        assert_eq!(alike(&canvas, 0, 0, 0.0).len(), 48 - 24, "the frame");
        assert_eq!(alike(&canvas, 1, 1, 0.4).len(), 24, "a tolerance takes that one in");
        assert_eq!(alike(&canvas, 4, 4, 1.0).len(), 48, "or everything");
        assert_eq!(alike(&canvas, 3, 3, 0.0), [3 * 8 + 3], "a texel alone");
        assert!(alike(&canvas, 8, 0, 1.0).is_empty(), "outside");
    }

    #[test]
    fn texels_that_touch_at_corners_only_do_not_hang_together() {
        let checks = Canvas::of_texels([6, 6], |x, y| [((x + y) % 2) as f32; 3]);
        assert_eq!(alike(&checks, 2, 2, 0.0).len(), 1, "one square");
    }

    #[test]
    fn gradients_have_their_values_along_the_way() {
        let ends = [DVec2::new(2.0, 3.0), DVec2::new(10.0, 3.0)];
        let colors = [[0.0, 1.0, 0.5], [1.0, 0.0, 0.5]];
        for (course, at, share) in [
            (Course::Linear, DVec2::new(4.0, 90.0), 0.25),
            (Course::Linear, DVec2::new(-7.0, 0.0), 0.0),
            (Course::Linear, DVec2::new(12.0, 0.0), 1.0),
            (Course::Radial, DVec2::new(2.0, 7.0), 0.5),
            (Course::Radial, DVec2::new(2.0, 3.0), 0.0),
            (Course::Radial, DVec2::new(-30.0, 3.0), 1.0),
        ] {
            let expected = [share, 1.0 - share, 0.5].map(single);
            assert_eq!(gradient(course, ends, colors, at), expected, "{course:?} at {at}");
        }
        assert_eq!(gradient(Course::Linear, [ends[0]; 2], colors, ends[1]), colors[1], "of no length");
    }
}
