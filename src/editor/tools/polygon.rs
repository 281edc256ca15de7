//! Drawing a polygon, vertex by vertex.

use glam::DVec2;
use robust::{Coord, orient2d};

use crate::light::Polygon;

/// A polygon being drawn on the work plane: a chain of vertices that never crosses itself.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PolygonDraft {
    vertices: Vec<DVec2>,
}

/// What a click did.
#[derive(Clone, Debug, PartialEq)]
pub enum Click {
    /// A vertex was added.
    Added,
    /// Nothing was added, and why.
    Refused(Fault),
    /// The polygon is complete: these are its vertices.
    Closed(Vec<DVec2>),
}

/// Why an edge may not be drawn; edges are numbered from 1, as drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum Fault {
    /// It has no length.
    #[error("An edge needs a length")]
    NoLength,
    /// It runs back over the edge before.
    #[error("This edge would run back over the last one")]
    Back,
    /// It crosses or touches an edge.
    #[error("This edge would meet edge {0}: edges may not cross or touch")]
    Meets(usize),
    /// The edge that closes the polygon crosses or touches an edge.
    #[error("The closing edge would meet edge {0}: edges may not cross or touch")]
    ClosingMeets(usize),
    /// The edge that closes the polygon runs back over one of its neighbours.
    #[error("The closing edge would run back over its neighbour")]
    ClosingBack,
    /// There are too few corners.
    #[error("A polygon needs at least three corners")]
    TooFew,
    /// All corners lie on a line.
    #[error("All corners lie on one line: a polygon needs an area")]
    Flat,
}

impl PolygonDraft {
    /// The vertices so far, in the order drawn.
    pub fn vertices(&self) -> &[DVec2] {
        &self.vertices
    }

    /// Click at `p`; `on_first` when that is on the first vertex.
    pub fn click(&mut self, p: DVec2, on_first: bool) -> Click {
        if on_first && self.vertices.len() >= 3 {
            return self.close().map_or_else(Click::Refused, Click::Closed);
        }
        if let Some(fault) = self.edge_fault(p) {
            return Click::Refused(fault);
        }
        self.vertices.push(p);
        Click::Added
    }

    /// The vertices, when the polygon can be closed as it is.
    pub fn close(&self) -> Result<Vec<DVec2>, Fault> {
        self.closing_fault().map_or_else(|| Ok(self.vertices.clone()), Err)
    }

    /// Take back the last vertex; whether there was one.
    pub fn take_back(&mut self) -> bool {
        self.vertices.pop().is_some()
    }

    /// Why there may be no edge from the last vertex to `p`.
    pub fn edge_fault(&self, p: DVec2) -> Option<Fault> {
        let (&last, before) = self.vertices.split_last()?;
        if p == last {
            return Some(Fault::NoLength);
        }
        let &previous = before.last()?;
        if folds_back(previous, last, p) {
            return Some(Fault::Back);
        }
        let met = self.chain_edges().position(|edge| edge[1] != last && meet(edge, [last, p]))?;
        Some(Fault::Meets(met + 1))
    }

    /// Why the polygon may not be closed as it is.
    pub fn closing_fault(&self) -> Option<Fault> {
        let (first, second, previous, last) = match self.vertices[..] {
            [a, b, c] => (a, b, b, c),
            [a, b, .., c, d] => (a, b, c, d),
            _ => return Some(Fault::TooFew),
        };
        if self.chain_edges().all(|edge| side(edge[0], edge[1], first) == 0.0) {
            return Some(Fault::Flat);
        }
        let apart = |edge: &[DVec2; 2]| edge[0] != first && edge[1] != last;
        if let Some(met) = self.chain_edges().position(|edge| apart(&edge) && meet(edge, [last, first])) {
            return Some(Fault::ClosingMeets(met + 1));
        }
        (folds_back(previous, last, first) || folds_back(last, first, second)).then_some(Fault::ClosingBack)
    }

    /// Area of the polygon that a further vertex at `p` would make, m².
    pub fn area_with(&self, p: DVec2) -> f64 {
        let vertices = self.vertices.iter().copied().chain([p]).collect();
        Polygon { vertices, two_sided: false }.area()
    }

    fn chain_edges(&self) -> impl Iterator<Item = [DVec2; 2]> {
        self.vertices.windows(2).map(|edge| [edge[0], edge[1]])
    }
}

/// Whether the closed polygon neither crosses nor touches itself and has an area.
pub fn is_simple(vertices: &[DVec2]) -> bool {
    let mut draft = PolygonDraft::default();
    vertices.iter().all(|v| draft.click(*v, false) == Click::Added) && draft.closing_fault().is_none()
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
            assert_eq!(draft.click(DVec2::from(p), false), Click::Refused(Fault::Meets(1)), "{why}");
        }
        assert_eq!(draft.vertices().len(), 4, "nothing was added");
        assert_eq!(draft.click(dvec2(0.5, 0.5), false), Click::Added, "inside is fine");
    }

    #[test]
    fn an_edge_back_over_the_last_one_is_refused_but_straight_on_is_fine() {
        let mut draft = drawn(&[[0.0, 0.0], [2.0, 0.0]]);
        assert_eq!(draft.click(dvec2(1.0, 0.0), false), Click::Refused(Fault::Back), "back");
        assert_eq!(draft.click(dvec2(2.0, 0.0), false), Click::Refused(Fault::NoLength), "no length");
        assert_eq!(draft.click(dvec2(3.0, 0.0), false), Click::Added, "straight on");
    }

    #[test]
    fn a_closing_edge_that_would_cross_or_an_area_of_nothing_does_not_close() {
        let crossing = drawn(&[[0.0, 0.0], [3.0, 0.0], [3.0, 3.0], [-1.0, 3.0], [-1.0, 1.0], [2.0, 1.0], [2.0, 2.0]]);
        assert_eq!(crossing.close(), Err(Fault::ClosingMeets(5)), "the closing edge crosses");
        assert_eq!(drawn(&[[0.0, 0.0], [1.0, 0.0], [3.0, 0.0]]).close(), Err(Fault::Flat), "flat");
        assert_eq!(drawn(&[[0.0, 0.0], [1.0, 0.0]]).close(), Err(Fault::TooFew), "two vertices");
        let back = drawn(&[[0.0, 0.0], [2.0, 0.0], [2.0, 1.0], [3.0, 0.0]]);
        assert!(back.close().is_err(), "over the first edge");
    }

    #[test]
    fn vertices_are_taken_back_one_by_one() {
        let mut draft = drawn(&[[0.0, 0.0], [1.0, 0.0]]);
        assert!(draft.take_back() && draft.take_back(), "two to take back");
        assert!(!draft.take_back(), "none left");
    }

    #[test]
    fn three_vertices_close_to_a_triangle() {
        assert_eq!(drawn(&[[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]]).close().map(|v| v.len()), Ok(3), "a triangle");
    }
}
