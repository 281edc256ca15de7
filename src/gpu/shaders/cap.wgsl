// A cap infinitely far away: the directions within σ ≤ π/2 of a centre.

struct CapLight {
    to_center: vec3f,
    sin_sigma: f32,
    cos_sigma: f32,
    // Directions of a cluster.
    count: u32,
}

@group(1) @binding(0) var<uniform> cap_light: CapLight;

fn cap_respond_exact(at: Shading) -> Response {
    let cap = cap_of_light();
    return Response(cap_irradiance(cap, at.n), cap_specular(cap, at));
}

fn cap_respond_hermite_1(at: Shading) -> Response {
    let cap = cap_of_light();
    return Response(cap_irradiance_hermite(cap, at.n, false), cap_specular(cap, at));
}

fn cap_respond_hermite_2(at: Shading) -> Response {
    let cap = cap_of_light();
    return Response(cap_irradiance_hermite(cap, at.n, true), cap_specular(cap, at));
}

fn cap_respond_cluster(at: Shading) -> Response {
    return cap_cluster(cap_of_light(), cap_light.count, at.n, at.r, at.lobe);
}

fn cap_of_light() -> Cap {
    return Cap(cap_light.to_center, cap_light.sin_sigma, cap_light.cos_sigma);
}

fn cap_specular(cap: Cap, at: Shading) -> f32 {
    return cap_phong(cap, at.n, at.r, lobes[at.lobe].exponent);
}
