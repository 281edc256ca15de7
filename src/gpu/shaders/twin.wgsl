// One shading function over a table of rows. `evaluate` is chosen when the shader is joined.

struct TwinRow {
    first_number: u32,
    first_vertex: u32,
    vertex_count: u32,
    unused: u32,
}

@group(3) @binding(0) var<storage, read> twin_rows: array<TwinRow>;
@group(3) @binding(1) var<storage, read> twin_numbers: array<f32>;
@group(3) @binding(2) var<storage, read_write> twin_results: array<f32>;

var<private> row: TwinRow;
// The row's entry in `lobes`.
var<private> lobe: u32;

// Number i of the row.
fn f(i: u32) -> f32 {
    return twin_numbers[row.first_number + i];
}

// The vector that begins at number i of the row.
fn v(i: u32) -> vec3f {
    return vec3f(f(i), f(i + 1u), f(i + 2u));
}

@compute @workgroup_size(64)
fn twin(@builtin(global_invocation_id) id: vec3u) {
    if id.x >= arrayLength(&twin_rows) {
        return;
    }
    row = twin_rows[id.x];
    lobe = id.x;
    twin_results[id.x] = evaluate();
}
