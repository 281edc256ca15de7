//! The window.

pub mod session;

pub use session::{Item, Session, Tool};
