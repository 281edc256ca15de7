//! Texels in a fraction of their size, to be kept for later.

use miniz_oxide::deflate::compress_to_vec;
use miniz_oxide::inflate::decompress_to_vec;

use super::code;

/// How hard to try, of 0 to 10: more than this takes longer and saves little.
const EFFORT: u8 = 1;

// What texels are packed as; the first byte.
/// One value for all of them.
const EVEN: u8 = 0;
/// Codes of 16 bits, which all painted texels have.
const CODES: u8 = 2;
/// Values of 32 bits.
const VALUES: u8 = 4;

/// Texels as bytes: each number less the one before it, byte by byte, deflated. They [`unpack`] to the same bits.
pub fn pack(texels: &[f32]) -> Box<[u8]> {
    let first = texels.first().copied().unwrap_or_default();
    if texels.iter().all(|texel| texel.to_bits() == first.to_bits()) {
        return [&[EVEN][..], &first.to_bits().to_le_bytes()].concat().into();
    }
    let codes: Option<Vec<u32>> = texels.iter().map(|texel| code::code_of(*texel).map(u32::from)).collect();
    let (kind, numbers) = match codes {
        Some(codes) => (CODES, codes),
        None => (VALUES, texels.iter().map(|texel| texel.to_bits()).collect()),
    };
    let before = std::iter::once(0).chain(numbers.iter().copied());
    let steps: Vec<[u8; 4]> =
        numbers.iter().zip(before).map(|(number, before)| number.wrapping_sub(before).to_le_bytes()).collect();
    let planes: Vec<u8> = (0..usize::from(kind)).flat_map(|byte| steps.iter().map(move |step| step[byte])).collect();
    [vec![kind], compress_to_vec(&planes, EFFORT)].concat().into()
}

/// The `count` texels of [`pack`].
pub fn unpack(bytes: &[u8], count: usize) -> Vec<f32> {
    let (kind, rest) = (bytes[0], &bytes[1..]);
    if kind == EVEN {
        return vec![f32::from_bits(u32::from_le_bytes(rest.try_into().expect("packed above"))); count];
    }
    let planes = decompress_to_vec(rest).expect("packed above");
    let mut number = 0_u32;
    let step = |i: usize| {
        let byte = |plane: u8| if plane < kind { planes[usize::from(plane) * count + i] } else { 0 };
        number = number.wrapping_add(u32::from_le_bytes([byte(0), byte(1), byte(2), byte(3)]));
        if kind == CODES {
            // Steps of codes are modulo 2¹⁶.
            let [low, high, ..] = number.to_le_bytes();
            code::value_of(u16::from_le_bytes([low, high]))
        } else {
            f32::from_bits(number)
        }
    };
    (0..count).map(step).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Packed and unpacked they are the same to the last bit, in at most that many bytes.
    #[track_caller]
    fn check(texels: &[f32], most: usize) {
        let packed = pack(texels);
        let unpacked = unpack(&packed, texels.len());
        let same = texels.iter().zip(&unpacked).all(|(a, b)| a.to_bits() == b.to_bits());
        assert!(same && texels.len() == unpacked.len(), "{} texels", texels.len());
        assert!(packed.len() <= most, "{} bytes for {} texels", packed.len(), texels.len());
    }

    #[test]
    fn what_is_packed_unpacks_to_the_same_bits() {
        check(&[], 5);
        check(&[0.7; 4096], 5);
        let ramp: Vec<f32> = (0..4096_u16).map(|i| code::value_of(16 * i)).collect();
        check(&ramp, 200);
        let noise: Vec<f32> = (0..4096_u16).map(|i| code::value_of(i.wrapping_mul(40_503))).collect();
        check(&noise, 2 * 4096 + 100);
        let values: Vec<f32> = (0..4096_u16).map(|i| (f32::from(i) * 0.61).fract() * 3.0).collect();
        check(&values, 4 * 4096 + 100);
        check(&[0.0, -0.0, 1.5, 0.0], 40);
    }
}
