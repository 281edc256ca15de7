//! What a light's shader reads, as WGSL constants.

use super::items::Item;

/// The most elements that WGSL lets an array's constructor have.
pub(super) const MOST_ELEMENTS: usize = 2047;

/// A number that comes back to the last bit; none where it is not finite.
pub(super) fn number(x: f32) -> Option<String> {
    let shortest = format!("{x:?}");
    // WGSL reads it as f64 first.
    let comes_back = shortest.parse::<f64>().is_ok_and(|read| crate::gpu::types::f32_of(read).to_bits() == x.to_bits());
    x.is_finite().then(|| if comes_back { shortest } else { format!("{:?}", f64::from(x)) })
}

/// `vec3f(…)` or `vec4f(…)`.
pub(super) fn vector(components: &[f32]) -> Option<String> {
    let numbers: Option<Vec<_>> = components.iter().map(|x| number(*x)).collect();
    Some(format!("vec{}f({})", components.len(), numbers?.join(", ")))
}

/// The value of a structure whose bytes are laid out as WGSL lays out uniforms.
pub(super) fn structure(declaration: &Item, bytes: &[u8]) -> Option<String> {
    let mut offset = 0;
    let mut values = Vec::new();
    for ty in declaration.text.lines().filter_map(field_type) {
        let (align, size) = layout(ty)?;
        offset = usize::next_multiple_of(offset, align);
        values.push(value(ty, bytes.get(offset..offset + size)?)?);
        offset += size;
    }
    Some(format!("{}({})", declaration.name, values.join(", ")))
}

/// The type in a line of a structure.
fn field_type(line: &str) -> Option<&str> {
    let (name, ty) = line.strip_prefix("    ")?.split_once(": ")?;
    (!name.starts_with("//")).then(|| ty.trim_end_matches(','))
}

/// Alignment and size in bytes.
fn layout(ty: &str) -> Option<(usize, usize)> {
    Some(match ty {
        "f32" | "u32" => (4, 4),
        "vec2f" => (8, 8),
        "vec3f" => (16, 12),
        "vec4f" => (16, 16),
        _ => (16, 16 * vectors(ty)?),
    })
}

/// How many vectors of four an array holds.
fn vectors(ty: &str) -> Option<usize> {
    ty.strip_prefix("array<vec4f, ")?.strip_suffix('>')?.parse().ok()
}

fn value(ty: &str, bytes: &[u8]) -> Option<String> {
    let floats: Vec<f32> = bytemuck::pod_collect_to_vec(bytes);
    match ty {
        "f32" => number(floats[0]),
        "u32" => Some(format!("{}u", floats[0].to_bits())),
        "vec2f" | "vec3f" | "vec4f" => vector(&floats),
        _ => {
            let parts: Option<Vec<_>> = floats.chunks(4).map(vector).collect();
            Some(format!("array<vec4f, {}>({})", floats.len() / 4, parts?.join(", ")))
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_come_back_to_the_last_bit() {
        for bits in (0..u32::MAX).step_by(9973) {
            let x = f32::from_bits(bits);
            let Some(text) = number(x) else {
                assert!(!x.is_finite(), "{x} has no text");
                continue;
            };
            let back = crate::gpu::types::f32_of(text.parse().expect("a number"));
            assert_eq!(back.to_bits(), bits, "{x:e} as {text}");
        }
    }

    #[test]
    fn a_structure_is_read_as_wgsl_lays_it_out() {
        let text = "struct S {\n    a: vec3f,\n    // Of: it.\n    b: f32,\n    c: u32,\n    d: vec2f,\n    e: array<vec4f, 1>,\n}\n";
        let item = Item { name: "S".to_owned(), text: text.to_owned() };
        let mut words = [1.0, 2.0, 3.0, 4.0_f32].map(f32::to_bits).to_vec();
        words.extend([7, 0]);
        words.extend([5.0, 6.0, 0.1, 0.2, 0.3, 0.4_f32].map(f32::to_bits));
        let value = structure(&item, bytemuck::cast_slice(&words));
        let expected = "S(vec3f(1.0, 2.0, 3.0), 4.0, 7u, vec2f(5.0, 6.0), array<vec4f, 1>(vec4f(0.1, 0.2, 0.3, 0.4)))";
        assert_eq!(value.as_deref(), Some(expected), "each field at its offset");
    }
}
