// Point lights that stand for one light: `point` is one of them, `point-cluster` many.

struct ClusterLight {
    // Of the emitting surface; only where emission has a cosine.
    normal: vec3f,
    // ISOTROPIC, ONE_SIDED or TWO_SIDED.
    emission: u32,
    // Exponent of the distance.
    falloff: f32,
    // Points in `vertices`: position, and intensity along the normal.
    count: u32,
}

const ISOTROPIC = 0u;
const ONE_SIDED = 1u;
const TWO_SIDED = 2u;

@group(1) @binding(0) var<uniform> cluster_light: ClusterLight;

fn cluster_respond(at: Shading) -> Response {
    let m = lobes[at.lobe].exponent;
    var sum = Response(0.0, 0.0);
    for (var i = 0u; i < cluster_light.count; i++) {
        let to_light = vertices[i].xyz - at.p;
        let square = dot(to_light, to_light);
        let l = to_light * inverseSqrt(max(square, 1e-37));
        let illuminance = vertices[i].w * emission_cosine(-dot(cluster_light.normal, l))
            * select(power(square, -0.5 * cluster_light.falloff), 0.0, square == 0.0);
        sum.irradiance += illuminance * max(dot(at.n, l), 0.0);
        sum.specular += illuminance * directional_phong(l, at.n, at.r, m);
    }
    return sum;
}

fn emission_cosine(cosine: f32) -> f32 {
    if cluster_light.emission == ISOTROPIC {
        return 1.0;
    }
    return select(max(cosine, 0.0), abs(cosine), cluster_light.emission == TWO_SIDED);
}
