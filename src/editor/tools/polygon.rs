//! Drawing a polygon, vertex by vertex.

use glam::DVec2;
use robust::{Coord, orient2d};

/// A polygon being drawn on a horizontal plane: a chain of vertices that never crosses itself.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PolygonDraft {
    vertices: Vec<DVec2>,
}

/// What a click did.
#[derive(Clone, Debug, PartialEq)]
pub enum Click {
    /// A vertex was added.
    Added,
    /// The edge would cross or touch another, or have no length: nothing was added.
    Refused,
    /// The polygon is complete: these are its vertices.
    Closed(Vec<DVec2>),
}

impl PolygonDraft {
    /// The vertices so far, in the order drawn.
    pub fn vertices(&self) -> &[DVec2] {
        &self.vertices
    }

    /// Click at `p`; `on_first` when that is on the first vertex.
    pub fn click(&mut self, p: DVec2, on_first: bool) -> Click {
        if on_first && self.vertices.len() >= 3 {
            return self.close().map_or(Click::Refused, Click::Closed);
        }
        if !self.accepts(p) {
            return Click::Refused;
        }
        self.vertices.push(p);
        Click::Added
    }

    /// The vertices, when the polygon can be closed as it is.
    pub fn close(&self) -> Option<Vec<DVec2>> {
        self.closes().then(|| self.vertices.clone())
    }

    /// Take back the last vertex; whether there was one.
    pub fn take_back(&mut self) -> bool {
        self.vertices.pop().is_some()
    }

    /// Whether an edge from the last vertex to `p` crosses and touches nothing.
    pub fn accepts(&self, p: DVec2) -> bool {
        let Some((&last, before)) = self.vertices.split_last() else { return true };
        if p == last {
            return false;
        }
        let Some(&previous) = before.last() else { return true };
        !folds_back(previous, last, p) && self.chain_edges().all(|edge| edge[1] == last || !meet(edge, [last, p]))
    }

    /// Whether the closing edge crosses and touches nothing and the polygon has an area.
    pub fn closes(&self) -> bool {
        let (first, second, previous, last) = match self.vertices[..] {
            [a, b, c] => (a, b, b, c),
            [a, b, .., c, d] => (a, b, c, d),
            _ => return false,
        };
        let closing = [last, first];
        let clear =
            self.chain_edges().filter(|edge| edge[0] != first && edge[1] != last).all(|edge| !meet(edge, closing));
        clear
            && !folds_back(previous, last, first)
            && !folds_back(last, first, second)
            && self.chain_edges().any(|edge| side(edge[0], edge[1], first) != 0.0)
    }

    fn chain_edges(&self) -> impl Iterator<Item = [DVec2; 2]> {
        self.vertices.windows(2).map(|edge| [edge[0], edge[1]])
    }
}

/// Whether the closed polygon neither crosses nor touches itself and has an area.
pub fn is_simple(vertices: &[DVec2]) -> bool {
    let mut draft = PolygonDraft::default();
    vertices.iter().all(|v| draft.click(*v, false) == Click::Added) && draft.closes()
}

/// Twice the signed area of the triangle `a` `b` `c`: exactly 0 only when they lie on one line.
fn side(a: DVec2, b: DVec2, c: DVec2) -> f64 {
    let coord = |p: DVec2| Coord { x: p.x, y: p.y };
    orient2d(coord(a), coord(b), coord(c))
}

/// Whether the edge from `b` to `c` runs back over the edge from `a` to `b`.
fn folds_back(a: DVec2, b: DVec2, c: DVec2) -> bool {
    side(a, b, c) == 0.0 && (b - a).dot(c - b) < 0.0
}

/// Whether two closed segments share a point.
fn meet([a, b]: [DVec2; 2], [c, d]: [DVec2; 2]) -> bool {
    let (abc, abd, cda, cdb) = (side(a, b, c), side(a, b, d), side(c, d, a), side(c, d, b));
    let apart = |u: f64, v: f64| (u > 0.0 && v > 0.0) || (u < 0.0 && v < 0.0);
    if apart(abc, abd) || apart(cda, cdb) {
        return false;
    }
    // Either they cross, or an end touches, or all lie on one line: then it is the boxes that decide.
    let overlap = |a: f64, b: f64, c: f64, d: f64| a.min(b) <= c.max(d) && c.min(d) <= a.max(b);
    overlap(a.x, b.x, c.x, d.x) && overlap(a.y, b.y, c.y, d.y)
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::dvec2;

    fn drawn(vertices: &[[f64; 2]]) -> PolygonDraft {
        let mut draft = PolygonDraft::default();
        for v in vertices {
            assert_eq!(draft.click(DVec2::from(*v), false), Click::Added, "vertex {v:?}");
        }
        draft
    }

    #[test]
    fn a_click_on_the_first_vertex_closes() {
        let mut draft = drawn(&[[0.0, 0.0], [2.0, 0.0], [2.0, 1.0], [0.0, 1.0]]);
        let Click::Closed(vertices) = draft.click(dvec2(0.0, 0.0), true) else { panic!("a rectangle closes") };
        assert_eq!(vertices.len(), 4, "the first vertex is not repeated");
    }

    #[test]
    fn an_edge_that_would_cross_or_touch_is_refused() {
        let mut draft = drawn(&[[0.0, 0.0], [2.0, 0.0], [2.0, 1.0], [1.0, 1.0]]);
        for (p, why) in [([1.0, -1.0], "crosses"), ([1.0, 0.0], "touches"), ([0.0, 0.0], "meets the first vertex")] {
            assert_eq!(draft.click(DVec2::from(p), false), Click::Refused, "{why}");
        }
        assert_eq!(draft.vertices().len(), 4, "nothing was added");
        assert_eq!(draft.click(dvec2(0.5, 0.5), false), Click::Added, "inside is fine");
    }

    #[test]
    fn an_edge_back_over_the_last_one_is_refused_but_straight_on_is_fine() {
        let mut draft = drawn(&[[0.0, 0.0], [2.0, 0.0]]);
        assert_eq!(draft.click(dvec2(1.0, 0.0), false), Click::Refused, "back");
        assert_eq!(draft.click(dvec2(2.0, 0.0), false), Click::Refused, "no length");
        assert_eq!(draft.click(dvec2(3.0, 0.0), false), Click::Added, "straight on");
    }

    #[test]
    fn a_closing_edge_that_would_cross_or_an_area_of_nothing_does_not_close() {
        let crossing = drawn(&[[0.0, 0.0], [3.0, 0.0], [3.0, 3.0], [-1.0, 3.0], [-1.0, 1.0], [2.0, 1.0], [2.0, 2.0]]);
        assert!(!crossing.closes(), "the closing edge crosses");
        assert!(!drawn(&[[0.0, 0.0], [1.0, 0.0], [3.0, 0.0]]).closes(), "flat");
        assert!(!drawn(&[[0.0, 0.0], [1.0, 0.0]]).closes(), "two vertices");
    }

    #[test]
    fn vertices_are_taken_back_one_by_one() {
        let mut draft = drawn(&[[0.0, 0.0], [1.0, 0.0]]);
        assert!(draft.take_back() && draft.take_back(), "two to take back");
        assert!(!draft.take_back(), "none left");
    }

    #[test]
    fn three_vertices_close_to_a_triangle() {
        assert_eq!(drawn(&[[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]]).close().map(|v| v.len()), Some(3), "a triangle");
    }
}
