// Point lights that stand for one light: `point` is one of them, `point-cluster` many.

struct ClusterLight {
    // Of the emitting surface, where emission has a cosine; the axis of a tube.
    normal: vec3f,
    // ISOTROPIC, ONE_SIDED, TWO_SIDED, TUBE or DIRECTIONS.
    emission: u32,
    // Exponent of the distance.
    falloff: f32,
    // Points in `vertices`: position, and intensity along the normal; or directions, and illuminances.
    count: u32,
}

const ISOTROPIC = 0u;
const ONE_SIDED = 1u;
const TWO_SIDED = 2u;
const TUBE = 3u;
const DIRECTIONS = 4u;

@group(1) @binding(0) var<uniform> cluster_light: ClusterLight;

fn cluster_respond(at: Shading) -> Response {
    var sum = Response(0.0, 0.0);
    for (var i = 0u; i < cluster_light.count; i++) {
        let to_light = light_vertex(i).xyz - select(at.p, vec3f(), cluster_light.emission == DIRECTIONS);
        let intensity = light_vertex(i).w * emission_cosine(to_light);
        let response = falloff_response(to_light, intensity, cluster_light.falloff, at.n, at.r, at.lobe);
        sum.irradiance += response.irradiance;
        sum.specular += response.specular;
    }
    return sum;
}

fn emission_cosine(to_light: vec3f) -> f32 {
    if cluster_light.emission == ISOTROPIC || cluster_light.emission == DIRECTIONS {
        return 1.0;
    }
    let w = normalize(to_light + vec3f(0.0, 0.0, 1e-37));
    if cluster_light.emission == TUBE {
        return length(cross(cluster_light.normal, w));
    }
    let cosine = -dot(cluster_light.normal, w);
    return select(max(cosine, 0.0), abs(cosine), cluster_light.emission == TWO_SIDED);
}
