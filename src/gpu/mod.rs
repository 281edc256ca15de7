//! The live preview, in layers.
