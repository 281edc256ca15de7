//! A hierarchy of bounding boxes.

use glam::DVec3;

use super::cull::{Ray, padded};
use crate::surface::{Bounds, Placed};

/// A binary tree of boxes about objects, one a leaf, in an array that is walked without a stack.
///
/// Built by the surface area heuristic over bins: I. Wald, *On fast construction of SAH-based bounding volume
/// hierarchies*, 2007. The same objects give the same tree.
#[derive(Clone, Debug, Default)]
pub struct Hierarchy {
    nodes: Vec<Node>,
    unbounded: Vec<u32>,
}

/// A box about one object or about two other nodes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Node {
    /// Holds everything below, padded against rounding.
    pub bounds: Bounds,
    /// The node to go on with where this box is missed: the one after everything below. Where it is met, that is the
    /// next.
    pub skip: u32,
    /// What a leaf holds; none in an inner node, whose first child is the next node.
    pub object: Option<u32>,
}

/// Intervals in which centres are counted, along each axis.
const BINS: usize = 16;

/// Levels below which nodes are halved whatever it costs, so that no tree is deeper than [`DEPTH`].
const CHOSEN: usize = 32;

/// Most levels: another 32 halve whatever a u32 counts.
const DEPTH: usize = CHOSEN + 32;

#[derive(Clone, Copy)]
struct Leaf {
    bounds: Bounds,
    center: DVec3,
    object: u32,
}

#[expect(clippy::cast_possible_truncation, reason = "memory ends long before 2^32 objects")]
pub(super) fn index(i: usize) -> u32 {
    i as u32
}

impl Hierarchy {
    /// Of these objects.
    pub fn new(objects: &[Placed]) -> Self {
        let mut hierarchy = Self::default();
        let mut leaves = Vec::with_capacity(objects.len());
        for (i, object) in objects.iter().enumerate() {
            match object.bounds().as_ref().and_then(padded) {
                Some(bounds) => leaves.push(Leaf { bounds, center: bounds.center(), object: index(i) }),
                None => hierarchy.unbounded.push(index(i)),
            }
        }
        hierarchy.nodes.reserve_exact((2 * leaves.len()).saturating_sub(1));
        hierarchy.grow(&mut leaves, 0);
        hierarchy
    }

    /// The tree, depth first.
    pub fn nodes(&self) -> &[Node] {
        &self.nodes
    }

    /// The objects without bounds, which must always be tested.
    pub fn unbounded(&self) -> &[u32] {
        &self.unbounded
    }

    /// Append the tree over these.
    fn grow(&mut self, leaves: &mut [Leaf], level: usize) {
        let Some(first) = leaves.first() else { return };
        let bounds = leaves.iter().fold(Bounds::EMPTY, |bounds, leaf| bounds.union(leaf.bounds));
        let node = self.nodes.len();
        let object = (leaves.len() == 1).then_some(first.object);
        self.nodes.push(Node { bounds, skip: 0, object });
        if object.is_none() {
            let middle = split(leaves, level);
            let (left, right) = leaves.split_at_mut(middle);
            self.grow(left, level + 1);
            self.grow(right, level + 1);
        }
        self.nodes[node].skip = index(self.nodes.len());
    }

    /// Every object whose box, and every box about it, passes a test; those without bounds first.
    pub(super) fn visit(&self, touches: impl Fn(&Bounds) -> bool, mut found: impl FnMut(usize)) {
        self.unbounded.iter().for_each(|&object| found(object as usize));
        let mut at = 0;
        while let Some(node) = self.nodes.get(at) {
            if touches(&node.bounds) {
                if let Some(object) = node.object {
                    found(object as usize);
                }
                at += 1;
            } else {
                at = node.skip as usize;
            }
        }
    }

    /// Every object whose box a ray meets no farther than a limit, which `visit` takes and gives, the nearer box first.
    pub(super) fn along(&self, ray: &Ray, mut limit: f64, mut visit: impl FnMut(usize, f64) -> f64) {
        for &object in &self.unbounded {
            limit = visit(object as usize, limit);
        }
        let mut waiting = [(0, 0.0); DEPTH];
        let mut count = 0;
        let enter = |node: usize, limit| Some((node, ray.enter(&self.nodes.get(node)?.bounds, limit)?));
        let mut next = enter(0, limit);
        while let Some((at, _)) = next {
            next = None;
            if let Some(object) = self.nodes[at].object {
                limit = visit(object as usize, limit);
            } else {
                let (left, right) = (at + 1, self.nodes[at + 1].skip as usize);
                next = match (enter(left, limit), enter(right, limit)) {
                    (Some(left), Some(right)) => {
                        let (near, far) = if right.1 < left.1 { (right, left) } else { (left, right) };
                        waiting[count] = far;
                        count += 1;
                        Some(near)
                    }
                    (left, right) => left.or(right),
                };
            }
            while next.is_none() && count > 0 {
                count -= 1;
                next = enter(waiting[count].0, limit);
            }
        }
    }
}

/// Put leaves in two groups, none empty; returns the length of the first.
fn split(leaves: &mut [Leaf], level: usize) -> usize {
    let half = leaves.len() / 2;
    if level >= CHOSEN || leaves.len() == 2 {
        return half;
    }
    let centers = leaves.iter().fold(Bounds::EMPTY, |bounds, leaf| Bounds {
        min: bounds.min.min(leaf.center),
        max: bounds.max.max(leaf.center),
    });
    let cuts = (0..3).filter_map(|axis| cheapest_cut(leaves, &centers, axis));
    let Some(cut) = cuts.min_by(|a, b| a.cost.total_cmp(&b.cost)) else { return half };
    // Stable, so that the tree does not depend on how a sort treats equals.
    leaves.sort_by_key(|leaf| bin(leaf, &centers, cut.axis) >= cut.bin);
    leaves.partition_point(|leaf| bin(leaf, &centers, cut.axis) < cut.bin)
}

/// Between which bins to cut.
struct Cut {
    axis: usize,
    /// The first bin of the second group.
    bin: usize,
    cost: f64,
}

/// The cut along an axis of least cost, Σ area × number, with something on either side.
fn cheapest_cut(leaves: &[Leaf], centers: &Bounds, axis: usize) -> Option<Cut> {
    let mut bins = [(Bounds::EMPTY, 0.0); BINS];
    for leaf in leaves {
        let (bounds, count) = &mut bins[bin(leaf, centers, axis)];
        *bounds = bounds.union(leaf.bounds);
        *count += 1.0;
    }
    let mut after = [0.0; BINS];
    let mut sum = (Bounds::EMPTY, 0.0);
    for bin in (1..BINS).rev() {
        sum = (sum.0.union(bins[bin].0), sum.1 + bins[bin].1);
        after[bin] = cost(sum);
    }
    let mut before = (Bounds::EMPTY, 0.0);
    let mut best: Option<Cut> = None;
    for bin in 1..BINS {
        before = (before.0.union(bins[bin - 1].0), before.1 + bins[bin - 1].1);
        let total = cost(before) + after[bin];
        let parts = before.1 > 0.0 && before.1 < leaves.len() as f64;
        if parts && best.as_ref().is_none_or(|best| total < best.cost) {
            best = Some(Cut { axis, bin, cost: total });
        }
    }
    best
}

fn cost((bounds, count): (Bounds, f64)) -> f64 {
    if count == 0.0 {
        return 0.0;
    }
    let size = bounds.max - bounds.min;
    count * (size.x * size.y + size.y * size.z + size.z * size.x)
}

fn bin(leaf: &Leaf, centers: &Bounds, axis: usize) -> usize {
    let share = (leaf.center[axis] - centers.min[axis]) / (centers.max[axis] - centers.min[axis]);
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a share from 0 to 1, or NaN for 0/0")]
    let bin = (share * BINS as f64) as usize;
    bin.min(BINS - 1)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::surface::{Shape, Surface};

    /// A row of spheres on a plane; every third in the same place as the one before.
    fn row(count: usize) -> Vec<Placed> {
        let surface = |i: usize, shape| Surface {
            name: "s".to_owned(),
            material: "m".to_owned(),
            position: DVec3::new((i - i.saturating_sub(1) % 3 / 2) as f64, 0.0, 0.0),
            rotation_deg: DVec3::ZERO,
            scale: DVec3::ONE,
            shape,
        };
        let spheres = (0..count).map(|i| surface(i, Shape::Sphere { radius: 0.4 }));
        std::iter::once(surface(0, Shape::Plane {})).chain(spheres).flat_map(|s| Placed::parts(&s)).collect()
    }

    #[test]
    fn a_tree_holds_every_object_once_in_boxes_within_boxes() {
        for count in [0, 1, 2, 3, 100, 1000] {
            let hierarchy = Hierarchy::new(&row(count));
            let nodes = hierarchy.nodes();
            assert_eq!(hierarchy.unbounded(), [0], "the plane, of {count}");
            assert_eq!(nodes.len(), (2 * count).saturating_sub(1), "nodes of {count}");
            let mut objects: Vec<_> = nodes.iter().filter_map(|node| node.object).collect();
            objects.sort_unstable();
            assert!(objects.iter().copied().eq(1..=index(count)), "leaves of {count}: {objects:?}");
            for (i, node) in nodes.iter().enumerate() {
                let below = &nodes[i..node.skip as usize];
                let bounds = below.iter().fold(Bounds::EMPTY, |bounds, node| bounds.union(node.bounds));
                assert_eq!(node.bounds, bounds, "node {i} of {count} is about what it holds");
                assert_eq!(below.len() == 1, node.object.is_some(), "node {i} of {count} is a leaf or has children");
            }
        }
    }

    #[test]
    fn a_tree_over_a_row_is_no_deeper_than_twice_its_logarithm() {
        let hierarchy = Hierarchy::new(&row(1000));
        let nodes = hierarchy.nodes();
        let above = |leaf: usize| (0..=leaf).filter(|&i| nodes[i].skip as usize > leaf).count();
        let depth = (0..nodes.len()).map(above).max();
        assert!(depth.is_some_and(|depth| depth <= 20), "1000 objects lie {depth:?} deep");
    }
}
