//! What is seen of a polygonal light.

use glam::DVec3;

use super::Objects;

/// The pieces of a polygon that are seen from p; none where all of it is.
pub fn visible_pieces(_objects: &Objects, _p: DVec3, _polygon: &[DVec3]) -> Option<Vec<Vec<DVec3>>> {
    None
}
