// Points that cover a square evenly: each run of 2ᵏ, from a multiple of 2ᵏ on, has one in each of 2ᵏ boxes of every shape.

// [SOBOL_1967]'s first two coordinates, scrambled as [OWEN_1995] does by the hash of [LAINE_KARRAS_2011].
fn scrambled_point(index: u32, seed: vec2u) -> vec2f {
    let bits = vec2u(scramble(index, seed.x), scramble(second_coordinate(index), seed.y));
    return vec2f(reverseBits(bits) >> vec2u(8u)) * exp2(-24.0);
}

// The second coordinate's digits, the first the lowest bit: Pascal's triangle modulo 2 times the index.
fn second_coordinate(index: u32) -> u32 {
    var x = index;
    x ^= (x >> 1u) & 0x55555555u;
    x ^= (x >> 2u) & 0x33333333u;
    x ^= (x >> 4u) & 0x0f0f0f0fu;
    x ^= (x >> 8u) & 0x00ff00ffu;
    return x ^ ((x >> 16u) & 0x0000ffffu);
}

// Each bit turned over or not by a hash of those below it. The constants are Vegdahl's, by way of [BURLEY_2020].
fn scramble(bits: u32, seed: u32) -> u32 {
    var x = bits ^ (bits * 0x3d20adeau);
    x += seed;
    x *= (seed >> 16u) | 1u;
    x ^= x * 0x05526c56u;
    return x ^ (x * 0x53a22864u);
}

// Three numbers that have nothing to do with one another, of three: PCG in three dimensions, [JARZYNSKI_OLANO_2020].
fn hash(numbers: vec3u) -> vec3u {
    var v = numbers * 1664525u + 1013904223u;
    v.x += v.y * v.z;
    v.y += v.z * v.x;
    v.z += v.x * v.y;
    v ^= v >> vec3u(16u);
    v.x += v.y * v.z;
    v.y += v.z * v.x;
    v.z += v.x * v.y;
    return v;
}
