//! The bytes of a file that a scene names.

use std::fmt;
use std::sync::Arc;

/// What a file holds, to be saved beside another scene; empty for what came from no file. Copies share it.
#[derive(Clone, Default, PartialEq, Eq)]
pub struct Contents(pub Arc<[u8]>);

impl fmt::Debug for Contents {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} bytes", self.0.len())
    }
}
