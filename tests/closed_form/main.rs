//! Closed forms against reference data, quadrature, limits and properties. One module a light shape.

mod cases;
mod disk;
mod disks_caps_and_skies;
mod fit;
mod line;
mod line_shadows;
mod lobes;
mod one_shot;
mod polygon;
mod polygon_properties;
mod polygon_shadows;
mod properties;
mod random;
mod reference;
mod sky;
mod sphere;
mod textured;
mod verify;
