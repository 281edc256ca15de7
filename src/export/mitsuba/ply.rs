//! Triangles as PLY in ASCII.

use std::collections::HashMap;
use std::fmt::Write as _;

use glam::DVec3;

use crate::export::Origin;
use crate::surface::Triangle;

/// The file of these triangles; corners that agree in place and normal are one vertex.
pub(super) fn ply(triangles: &[Triangle], origin: Origin) -> String {
    let has_normals = triangles.iter().all(|triangle| triangle.normals.is_some());
    let mut known: HashMap<[u64; 6], usize> = HashMap::new();
    let (mut vertices, mut faces) = (String::new(), String::new());
    for triangle in triangles {
        let normals = triangle.normals.filter(|_| has_normals).unwrap_or_default();
        let corners = [0, 1, 2].map(|i| {
            let (p, n) = (triangle.corners[i], normals[i]);
            let count = known.len();
            *known.entry(key(p, n)).or_insert_with(|| {
                let _ = write!(vertices, "{} {} {}", p.x, p.y, p.z);
                let _ = if has_normals { writeln!(vertices, " {} {} {}", n.x, n.y, n.z) } else { writeln!(vertices) };
                count
            })
        });
        let [a, b, c] = corners;
        let _ = writeln!(faces, "3 {a} {b} {c}");
    }
    let normals = if has_normals { "property float nx\nproperty float ny\nproperty float nz\n" } else { "" };
    format!(
        "ply\nformat ascii 1.0\ncomment {}\nelement vertex {}\nproperty float x\nproperty float y\nproperty float z\n{normals}\
         element face {}\nproperty list uchar int vertex_indices\nend_header\n{vertices}{faces}",
        origin.line(),
        known.len(),
        triangles.len()
    )
}

/// The bits of a vertex.
fn key(p: DVec3, n: DVec3) -> [u64; 6] {
    [p.x, p.y, p.z, n.x, n.y, n.z].map(f64::to_bits)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn corners_are_shared() {
        let triangle = |corners| Triangle { corners, normals: None };
        let triangles = [
            triangle([DVec3::ZERO, DVec3::X, DVec3::ONE]),
            triangle([DVec3::ZERO, DVec3::ONE, DVec3::new(0.0, 1.5, 0.0)]),
        ];
        let origin = Origin { scene: "two.toml" };
        let text = ply(&triangles, origin);
        let head = format!("ply\nformat ascii 1.0\ncomment {}\n", origin.line());
        let expected = "element vertex 4\nproperty float x\nproperty float y\nproperty float z\n\
            element face 2\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n1 1 1\n0 1.5 0\n\
            3 0 1 2\n3 0 2 3\n";
        assert_eq!(text, head + expected, "two triangles of four vertices");
    }
}
