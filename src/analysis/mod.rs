//! What is to be learnt from a scene: curves, their errors, and what each method costs.

pub mod axis;
pub mod chart;
mod curve;
mod dial;
mod error_map;
pub mod figures;
mod ground;
mod look;
mod measure;
mod pen;
mod report;

pub use curve::{Curves, Sampling, Series, curves, methods_for, probe};
pub use dial::{Dial, MARGIN as DIAL_MARGIN};
pub use error_map::{Comparison, ErrorMap, Summary, error_map};
pub use ground::{Extent, Ground};
pub use look::{Look, Pin, Sheet, Trace, abscissa, interpolated, turns, unit};
pub use measure::{Measured, Rectangle, measure};
pub use pen::Pen;
pub use report::{Deviation, Entry, report, subjects};
