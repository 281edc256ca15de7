//! What is to be learnt from a scene: curves, their errors, and what each method costs.

mod curve;

pub use curve::{Curves, Series, curves, methods_for, probe};
