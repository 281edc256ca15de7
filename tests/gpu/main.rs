//! The GPU preview: what it redoes, what its functions compute, and that it shows what the CPU computes.
//!
//! These tests need an adapter, software or not, and fail without one.

mod agreement;
#[expect(dead_code, reason = "the other tests' loader; not all of it is needed here")]
#[path = "../closed_form/cases.rs"]
mod cases;
mod displays;
mod exported;
mod exported_presets;
mod shadows;
mod textured;
mod tracking;
mod twins;
mod twins_of_disks;
mod twins_of_lines;
mod twins_of_one_shot;
mod twins_of_polygons;
mod twins_of_shadows;
mod twins_of_skies;
mod twins_of_spheres;
mod verify;

use std::sync::LazyLock;

use softbox::gpu::Context;

/// One device for all tests.
static CONTEXT: LazyLock<Context> =
    LazyLock::new(|| Context::new().unwrap_or_else(|error| panic!("these tests cannot run without one: {error}")));
