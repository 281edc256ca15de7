//! CPU pictures.
