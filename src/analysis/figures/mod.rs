//! What the papers' curves and tables show, computed anew. Their pictures are scenes in `presets/figures/`.

mod snyder;

pub use snyder::{hermite_errors, snyder_2, snyder_3, snyder_4, snyder_5, snyder_6};
