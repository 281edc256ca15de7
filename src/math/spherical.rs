//! Great-circle arcs seen from the origin: azimuths, clipping to a horizon.

use glam::DVec3;

/// The angle from `u` to `v` about the unit `axis`, −π…π; 0 where one of them is on the axis.
///
/// atan2(axis·(u × v), (axis × u)·(axis × v)), for vectors of any length.
pub fn azimuth_between(axis: DVec3, u: DVec3, v: DVec3) -> f64 {
    axis.dot(u.cross(v)).atan2(axis.cross(u).dot(axis.cross(v)))
}

/// The signed solid angle of the triangle of three directions of any length, −2π…2π.
///
/// tan(Ω/2) = u·(v × w)/(|u||v||w| + |u|(v·w) + |v|(w·u) + |w|(u·v)), after van Oosterom and Strackee (1983).
pub fn triangle_solid_angle(u: DVec3, v: DVec3, w: DVec3) -> f64 {
    let (length_u, length_v, length_w) = (u.length(), v.length(), w.length());
    let cosines = length_u * v.dot(w) + length_v * w.dot(u) + length_w * u.dot(v);
    2.0 * u.dot((v - u).cross(w - u)).atan2(length_u * length_v * length_w + cosines)
}

/// A directed segment that subtends an arc at the origin.
pub type Edge = (DVec3, DVec3);

/// Clips the edges of closed loops to the half-space n·x ≥ 0, one edge at a time, without a list of vertices.
///
/// The loops must be planar and in one plane: then all crossings lie on one line, and the pieces of the horizon that
/// close the clipped loops may be given from any fixed point of that line, because what is doubly covered cancels
/// in every integral along edges.
#[derive(Clone, Copy, Debug)]
pub struct HorizonClip {
    n: DVec3,
    first_crossing: Option<DVec3>,
}

impl HorizonClip {
    /// For the horizon of `n`.
    pub fn new(n: DVec3) -> Self {
        Self { n, first_crossing: None }
    }

    /// The part of an edge in the half-space, and the edge along the horizon that its crossing, if any, adds.
    pub fn clip(&mut self, (a, b): Edge) -> [Option<Edge>; 2] {
        let (above_a, above_b) = (self.n.dot(a), self.n.dot(b));
        match (above_a >= 0.0, above_b >= 0.0) {
            (true, true) => [Some((a, b)), None],
            (false, false) => [None, None],
            (leaves, _) => {
                let x = a + above_a / (above_a - above_b) * (b - a);
                let start = *self.first_crossing.get_or_insert(x);
                if leaves { [Some((a, x)), Some((x, start))] } else { [Some((x, b)), Some((start, x))] }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Twice the area of what is left of loops in the plane z = 1.
    fn clipped_area(vertices: &[DVec3], n: DVec3) -> f64 {
        let mut clip = HorizonClip::new(n);
        (0..vertices.len())
            .flat_map(|i| clip.clip((vertices[i], vertices[(i + 1) % vertices.len()])))
            .flatten()
            .map(|(a, b)| a.truncate().perp_dot(b.truncate()))
            .sum()
    }

    #[test]
    fn clipped_comb_keeps_the_area_of_its_teeth() {
        // Three teeth of 1 × 1 below a back; the half-space y ≤ 3/4 keeps most of the teeth.
        let comb = [(0, 0), (1, 0), (1, 1), (2, 1), (2, 0), (3, 0), (3, 1), (4, 1), (4, 0), (5, 0), (5, 2), (0, 2)]
            .map(|(x, y)| DVec3::new(f64::from(x), f64::from(y), 1.0));
        let area = clipped_area(&comb, DVec3::new(0.0, -1.0, 0.75));
        assert!((area - 2.0 * 3.0 * 0.75).abs() < 1e-14, "{area}");
    }

    #[test]
    fn azimuth_is_that_of_the_projections_and_zero_on_the_axis() {
        let azimuth = azimuth_between(DVec3::Z, DVec3::new(2.0, 0.0, 5.0), DVec3::new(0.0, 3.0, -1.0));
        assert!((azimuth - std::f64::consts::FRAC_PI_2).abs() < 1e-15, "{azimuth}");
        assert_eq!(azimuth_between(DVec3::Z, DVec3::Z, DVec3::X), 0.0, "on the axis");
    }
}
