//! What is to be learnt from a scene: curves, their errors, and what each method costs.

pub mod chart;
mod curve;
mod error_map;
pub mod figures;
mod ground;
mod measure;
mod pen;
mod report;

pub use curve::{Curves, Series, curves, methods_for, probe};
pub use error_map::{Comparison, ErrorMap, Summary, error_map};
pub use ground::{Extent, Ground};
pub use measure::{Measured, Rectangle, measure};
pub use pen::Pen;
pub use report::{Deviation, Entry, report, subjects};
