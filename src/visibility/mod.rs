//! What comes between a point and a light.
