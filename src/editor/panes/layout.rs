//! How the panes share the window: kept between starts, and at the sides as wide as they were when the window is resized.

use egui::Ui;
use egui_tiles::{Container, Linear, LinearDir, Tile, TileId, Tiles, Tree};

use super::{Pane, Panes};

/// Between panes, points.
pub(super) const GAP: f32 = 3.0;
/// The window that the first layout is made for is so wide, points.
const WIDTH: f32 = 1280.0;
/// The view does not become narrower than this while the panes beside it can, points.
const LEAST_VIEW: f32 = 320.0;

/// The arrangement of the panes.
#[derive(Debug, serde::Serialize, serde::Deserialize)]
pub struct Layout {
    tree: Tree<Pane>,
    /// Of all panes, when they were shown last.
    width: f32,
}

impl Default for Layout {
    /// Outliner over variants, viewport over plots, inspector.
    fn default() -> Self {
        let mut tiles = Tiles::default();
        let tab = |tiles: &mut Tiles<Pane>, panes: &[Pane]| {
            let children = panes.iter().map(|pane| tiles.insert_pane(*pane)).collect();
            tiles.insert_tab_tile(children)
        };
        let outliner = tab(&mut tiles, &[Pane::Outliner]);
        let variants = tab(&mut tiles, &[Pane::Variants]);
        let viewport = tab(&mut tiles, &[Pane::Viewport]);
        let below = tab(&mut tiles, &[Pane::Plots, Pane::Painter, Pane::Library, Pane::Problems]);
        let inspector = tab(&mut tiles, &[Pane::Inspector]);
        let middle = insert(&mut tiles, LinearDir::Vertical, &[(viewport, 0.6), (below, 0.4)]);
        let left = insert(&mut tiles, LinearDir::Vertical, &[(outliner, 0.75), (variants, 0.25)]);
        let root = insert(&mut tiles, LinearDir::Horizontal, &[(left, 0.225), (middle, 0.535), (inspector, 0.24)]);
        Self { tree: Tree::new(egui::Id::unique("panes"), root, tiles), width: WIDTH }
    }
}

fn insert(tiles: &mut Tiles<Pane>, dir: LinearDir, shares: &[(TileId, f32)]) -> TileId {
    let mut linear = Linear::new(dir, shares.iter().map(|(tile, _)| *tile).collect());
    for (tile, share) in shares {
        linear.shares.set_share(*tile, *share);
    }
    tiles.insert_container(Container::Linear(linear))
}

impl Layout {
    /// Fill the rest of `ui` with the panes.
    pub fn show(&mut self, panes: &mut Panes<'_>, ui: &mut Ui) {
        let width = ui.available_width();
        if width != self.width {
            self.resize(width);
        }
        self.tree.ui(panes, ui);
    }

    /// Bring a pane to the front; one that is nowhere comes beside the plots.
    pub fn reveal(&mut self, pane: Pane) {
        let Self { tree, .. } = self;
        if tree.tiles.find_pane(&pane).is_none() {
            let beside = tree.tiles.find_pane(&Pane::Plots).and_then(|plots| tree.tiles.parent_of(plots));
            let tile = tree.tiles.insert_pane(pane);
            if let Some(beside) = beside.or(tree.root) {
                tree.move_tile_to_container(tile, beside, usize::MAX, false);
            }
        }
        tree.make_active(|_, tile| matches!(tile, Tile::Pane(other) if *other == pane));
    }

    /// Give the view what the window has become wider by, and take from it what it has become narrower by.
    fn resize(&mut self, width: f32) {
        let tiles = &mut self.tree.tiles;
        let Some(root) = self.tree.root else { return };
        let view = std::iter::successors(tiles.find_pane(&Pane::Viewport), |tile| tiles.parent_of(*tile));
        let Some(view) = view.take_while(|tile| *tile != root).last() else { return };
        let Some(Tile::Container(Container::Linear(row))) = tiles.get_mut(root) else { return };
        if row.dir != LinearDir::Horizontal {
            return;
        }
        let gaps: f32 = row.children.iter().skip(1).map(|_| GAP).sum();
        let mut widths = row.shares.split(&row.children, self.width - gaps);
        let Some(place) = row.children.iter().position(|tile| *tile == view) else { return };
        let sides = widths.iter().sum::<f32>() - widths[place];
        widths[place] = (width - gaps - sides).max(LEAST_VIEW.min(widths[place]));
        // In a window too narrow for that, all are drawn narrower in proportion, and as wide as before when there is room.
        self.width = widths.iter().sum::<f32>() + gaps;
        for (tile, width) in row.children.iter().zip(widths) {
            row.shares.set_share(*tile, width);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The width of each pane in a window, left to right, points.
    fn widths(layout: &mut Layout, window: f32) -> Vec<f32> {
        layout.resize(window);
        let root = layout.tree.root.expect("there are panes");
        let Some(Tile::Container(Container::Linear(row))) = layout.tree.tiles.get(root) else { panic!("a row") };
        row.shares.split(&row.children, window - 2.0 * GAP)
    }

    fn assert_near(widths: &[f32], expected: [f32; 3]) {
        let is_near = widths.iter().zip(expected).all(|(width, expected)| (width - expected).abs() < 0.05);
        assert!(widths.len() == 3 && is_near, "{widths:?}, not {expected:?}");
    }

    #[test]
    fn the_view_takes_what_the_window_gains_and_the_sides_keep_their_widths() {
        let mut layout = Layout::default();
        let [left, view, right] = [0.225, 0.535, 0.24].map(|share| share * 1274.0);
        for window in [1280.0, 1920.0, 1024.0, 3840.0, 1280.0] {
            assert_near(&widths(&mut layout, window), [left, view + window - 1280.0, right]);
        }
    }

    #[test]
    fn in_a_narrow_window_all_panes_give_until_there_is_room_again() {
        let mut layout = Layout::default();
        let at_first = widths(&mut layout, 1280.0);
        for _ in 0..3 {
            let narrow = widths(&mut layout, 600.0);
            assert!(narrow.iter().all(|width| *width > 150.0), "{narrow:?}");
            let sum: f32 = narrow.iter().sum();
            assert!((sum - 594.0).abs() < 0.05, "{narrow:?} fill the window");
        }
        assert_near(&widths(&mut layout, 1280.0), [at_first[0], at_first[1], at_first[2]]);
    }
}
