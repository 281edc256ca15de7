//! What leaves the program: one file a format. Every writer gives bytes; putting them in a file is up to the caller.

pub mod csv;
pub mod error_map;
pub mod exr;
pub mod plot;
pub mod png;
pub mod svg;
