//! What the shaders read, byte for byte; a test holds the layouts against naga's reflection of the WGSL.

use bytemuck::{Pod, Zeroable};
use glam::{DVec3, Vec3};

/// Structures that WGSL knows under the same names, with the same fields; `pad` fields are WGSL's implicit padding.
macro_rules! gpu_structs {
    ($($(#[$doc:meta])* $name:ident { $($(#[$field_doc:meta])* $field:ident: $ty:ty,)* })*) => {
        $(
            $(#[$doc])*
            #[repr(C)]
            #[derive(Clone, Copy, Debug, Default, PartialEq, Pod, Zeroable)]
            pub(crate) struct $name {
                $($(#[$field_doc])* pub(crate) $field: $ty,)*
            }
        )*

        /// Name, size and fields of every structure.
        #[cfg(test)]
        pub(crate) const LAYOUTS: &[(&str, usize, &[(&str, usize)])] =
            &[$((
                stringify!($name),
                size_of::<$name>(),
                &[$((stringify!($field), std::mem::offset_of!($name, $field))),*],
            )),*];
    };
}

gpu_structs! {
    /// The camera's axes and the picture's size.
    Camera {
        right: Vec3,
        tan_half: f32,
        up: Vec3,
        width: f32,
        back: Vec3,
        height: f32,
        jitter: [f32; 2],
        unused: [u32; 2],
    }

    /// How many there are of what rays meet.
    Occluders {
        always: u32,
        primitives: u32,
        primitive_nodes: u32,
        nodes: u32,
    }

    /// A box about an item, or about other boxes.
    Node {
        least: Vec3,
        skip: u32,
        greatest: Vec3,
        item: u32,
    }

    /// A primitive, about the eye.
    Primitive {
        local_from_world: [[f32; 4]; 3],
        world_from_local: [[f32; 4]; 3],
        eye_local: Vec3,
        material: u32,
        origin: Vec3,
        unused: u32,
        half: Vec3,
        unused_too: u32,
        quadric: [f32; 4],
    }

    /// A triangle, about the eye.
    Triangle {
        a: Vec3,
        material: u32,
        b: Vec3,
        unused_0: u32,
        c: Vec3,
        unused_1: u32,
        normal_a: Vec3,
        unused_2: u32,
        normal_b: Vec3,
        unused_3: u32,
        normal_c: Vec3,
        unused_4: u32,
    }

    /// A material's lobe.
    Lobe {
        exponent: f32,
        chebyshev_cut: f32,
        chebyshev_tan_cut: f32,
        cosine_cells: f32,
        model: u32,
        cosine_exponent: f32,
        parameters: [f32; 2],
        chebyshev_mean: [[f32; 4]; 4],
        cosine_integral: [[f32; 16]; 16],
    }

    /// A point light.
    PointLight {
        position: Vec3,
        unused: u32,
    }

    /// A point light with measured intensities.
    WebLight {
        position: Vec3,
        gammas: u32,
        x_axis: Vec3,
        planes: u32,
        y_axis: Vec3,
        unused: u32,
        z_axis: Vec3,
        unused_too: u32,
    }

    /// A directional light.
    DirectionalLight {
        to_light: Vec3,
        illuminance: f32,
    }

    /// A linear light.
    LineLight {
        a: Vec3,
        falloff: f32,
        b: Vec3,
        diameter: f32,
    }

    /// A polygonal light.
    PolygonLight {
        normal: Vec3,
        count: u32,
        two_sided: u32,
        pad: [u32; 3],
    }

    /// A spherical light.
    SphereLight {
        center: Vec3,
        radius: f32,
        count: u32,
        pad: [u32; 3],
    }

    /// A textured light.
    TexturedLight {
        corner: Vec3,
        two_sided: u32,
        row: Vec3,
        unused: u32,
        column: Vec3,
        opening: f32,
        normal: Vec3,
        negligible: f32,
    }

    /// A disk.
    DiskLight {
        center: Vec3,
        radius: f32,
        normal: Vec3,
        two_sided: u32,
    }

    /// A cap infinitely far away.
    CapLight {
        to_center: Vec3,
        sin_sigma: f32,
        cos_sigma: f32,
        count: u32,
        pad: [u32; 2],
    }

    /// A sky.
    SkyLight {
        zenith: Vec3,
        even: f32,
        cosine: f32,
        pad: [u32; 3],
    }

    /// Point lights that stand for a light.
    ClusterLight {
        normal: Vec3,
        emission: u32,
        falloff: f32,
        count: u32,
        pad: [u32; 2],
    }

    /// Punctual lights that are fitted to a light.
    FitLight {
        count: u32,
        is_far: u32,
    }

    /// A flat light for one-shot.
    OneShotLight {
        center: Vec3,
        texel: f32,
        axis_u: Vec3,
        alpha: f32,
        axis_v: Vec3,
        radius: f32,
        normal: Vec3,
        two_sided: u32,
        shares: [[f32; 4]; 2],
        is_round: u32,
        pad: [u32; 3],
    }

    /// A light as rays look for its points.
    ShadowLight {
        place: Vec3,
        size: f32,
        row: Vec3,
        part: f32,
        column: Vec3,
        two_sided: u32,
        normal: Vec3,
        count: u32,
    }

    /// Rays of one pass.
    ShadowPass {
        first: u32,
        count: u32,
        starts: u32,
        matte: u32,
    }

    /// One batch of the composite.
    Composite {
        adds: u32,
        emitter_count: u32,
        unused: [u32; 2],
        weights: [[f32; 4]; 6],
    }

    /// A material, lobe apart.
    Reflectance {
        diffuse_over_pi: Vec3,
        pad_0: u32,
        specular: Vec3,
        pad_1: u32,
    }

    /// An emitter with a visible surface.
    VisibleEmitter {
        vector: Vec3,
        radius: f32,
        radiance: Vec3,
        two_sided: u32,
        first: u32,
        count: u32,
        columns: u32,
        rows: u32,
        kind: u32,
        pad: [u32; 3],
    }

    /// Where a twin's row is.
    TwinRow {
        first_number: u32,
        first_vertex: u32,
        vertex_count: u32,
        unused: u32,
    }

    /// What a picture shows.
    Shown {
        mode: u32,
        option: u32,
        split: f32,
        end: f32,
        level_count: u32,
        pad: [u32; 3],
        levels: [[f32; 4]; 3],
    }

    /// What the tone curve needs.
    Tone {
        exposure: f32,
        share: f32,
    }
}

impl Lobe {
    /// What its density depends on.
    pub(crate) fn shape(&self) -> (f32, u32, [f32; 2]) {
        (self.exponent, self.model, self.parameters)
    }
}

/// Once rounded.
#[expect(clippy::cast_possible_truncation, reason = "f32 is born here")]
pub(crate) fn f32_of(x: f64) -> f32 {
    x as f32
}

/// Once rounded.
pub(crate) fn vec3_of(v: DVec3) -> Vec3 {
    v.as_vec3()
}

/// A column or vertex in the layout of `vec4f`.
pub(crate) fn vec4_of(v: DVec3, w: f64) -> [f32; 4] {
    v.as_vec3().extend(f32_of(w)).to_array()
}

/// A count for WGSL.
pub(crate) fn u32_of(count: usize) -> u32 {
    u32::try_from(count).unwrap_or(u32::MAX)
}
