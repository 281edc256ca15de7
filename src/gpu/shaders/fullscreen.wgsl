// One triangle that covers the picture.

// The first three are half of a viewport of twice the picture's size; the next three reach beyond one of its own size.
@vertex
fn fullscreen(@builtin(vertex_index) index: u32) -> @builtin(position) vec4f {
    let far = select(1.0, 3.0, index >= 3u);
    return vec4f(select(-1.0, far, index % 3u == 1u), select(1.0, 1.0 - (far + 1.0), index % 3u == 2u), 0.0, 1.0);
}
