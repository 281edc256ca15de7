//! What the papers' curves and tables show, computed anew. Their pictures are scenes in `presets/figures/`.

mod one_shot;
mod poulin;
mod snyder;

pub use one_shot::{one_shot_4, one_shot_6, one_shot_disk, one_shot_lights};
pub use poulin::chebyshev_degrees;
pub use snyder::{hermite_errors, snyder_2, snyder_3, snyder_4, snyder_5, snyder_6};
