//! How curves are drawn, the same on screen and on paper: the only table of their colours.

use crate::shading::Method;

/// Colour and dashes of a curve.
///
/// Hues are Okabe and Ito's ("Color Universal Design", 2008), which colour-blind readers tell apart, and where these are
/// too few P. Tol's muted ones; variants of a method have neighbouring hues. Dashes tell all of them apart without colours.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pen {
    /// sRGB on a light ground.
    pub on_light: [u8; 3],
    /// The same hue, lighter, on a dark ground.
    pub on_dark: [u8; 3],
    /// Lengths of dashes and gaps in turn, points; empty for a line without gaps.
    pub dashes: &'static [f32],
}

impl Pen {
    /// The pen of a method.
    pub const fn of(method: Method) -> Self {
        match method {
            Method::Exact => Self::new(0x22_26_2b, 0xf4_f6_f8, &[]),
            Method::Chebyshev { .. } => Self::new(0x00_72_b2, 0x4a_a8_f0, &[9.0, 3.0]),
            Method::NearestPoint => Self::new(0x00_9e_73, 0x2e_cf_9d, &[6.0, 2.5]),
            Method::NearestPointPicott => Self::new(0x11_77_33, 0x7f_d8_8b, &[6.0, 2.5, 1.5, 2.5]),
            Method::Hermite1 => Self::new(0x56_b4_e9, 0x8f_d3_ff, &[12.0, 3.0]),
            Method::Hermite2 => Self::new(0xcc_79_a7, 0xf2_9c_cb, &[5.0, 2.5, 2.5, 2.5]),
            Method::OneShot => Self::new(0x88_22_55, 0xf0_8c_bc, &[7.0, 2.0, 1.5, 2.0]),
            Method::OneShotSquare => Self::new(0xaa_44_99, 0xe6_8f_da, &[4.0, 4.0]),
            Method::OneShotSized => Self::new(0x33_22_88, 0xb4_a8_fa, &[11.0, 2.0, 1.5, 2.0, 1.5, 2.0]),
            Method::PointCluster(_) => Self::new(0xe6_9f_00, 0xff_c2_4a, &[3.5, 2.0]),
            Method::Fit(_) => Self::new(0xc0_10_20, 0xff_86_80, &[4.0, 1.5, 1.5, 1.5, 1.5, 1.5]),
            Method::Point => Self::new(0xd5_5e_00, 0xff_7d_45, &[9.0, 2.5, 2.0, 2.5]),
            Method::Reference => Self::new(0x6b_74_80, 0x93_9b_a6, &[1.2, 2.8]),
        }
    }

    /// The pen of the pinned curve of that index: dashes of one length, in hues that no method has.
    pub const fn pinned(index: usize) -> Self {
        const DASHES: &[f32] = &[3.0, 3.0];
        match index % 4 {
            0 => Self::new(0x7a_7a_1a, 0xd9_d9_5c, DASHES),
            1 => Self::new(0x2a_8c_82, 0x6f_e0_d2, DASHES),
            2 => Self::new(0x7d_4f_2a, 0xd8_b0_8c, DASHES),
            _ => Self::new(0xb8_3b_5e, 0xff_9a_a8, DASHES),
        }
    }

    /// The pen of the line of that index in a chart of lines that are no methods; dashed as papers set one apart.
    pub const fn numbered(index: usize, dashed: bool) -> Self {
        let of = match index % 6 {
            0 => Method::CHEBYSHEV,
            1 => Method::Point,
            2 => Method::NearestPoint,
            3 => Method::Hermite2,
            4 => Method::PointCluster(1),
            _ => Method::Hermite1,
        };
        Self { dashes: if dashed { &[7.0, 4.0] } else { &[] }, ..Self::of(of) }
    }

    const fn new(on_light: u32, on_dark: u32, dashes: &'static [f32]) -> Self {
        Self { on_light: bytes(on_light), on_dark: bytes(on_dark), dashes }
    }
}

/// Red, green and blue of `0xrrggbb`.
const fn bytes(hex: u32) -> [u8; 3] {
    let [_, r, g, b] = hex.to_be_bytes();
    [r, g, b]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::light::{Cap, Disk, Light, Line, Polygon, Shape};
    use crate::scene::Scene;

    /// Contrast of two colours after WCAG 2.2, 1…21.
    fn contrast(a: [u8; 3], b: [u8; 3]) -> f64 {
        let linear = |byte: u8| {
            let share = f64::from(byte) / 255.0;
            if share <= 0.040_45 { share / 12.92 } else { ((share + 0.055) / 1.055).powf(2.4) }
        };
        let luminance = |[r, g, b]: [u8; 3]| 0.2126 * linear(r) + 0.7152 * linear(g) + 0.0722 * linear(b);
        let [low, high] = if luminance(a) < luminance(b) { [a, b] } else { [b, a] }.map(luminance);
        (high + 0.05) / (low + 0.05)
    }

    /// Every method that some light has.
    fn methods() -> Vec<Method> {
        let square = [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]].map(glam::DVec2::from_array);
        let shapes = [
            Shape::Polygon(Polygon { vertices: square.to_vec(), two_sided: false }),
            Shape::Line(Line::isotropic(1.0)),
            Shape::Disk(Disk { radius: 1.0, two_sided: false }),
            Shape::Cap(Cap { half_angle_deg: 30.0 }),
        ];
        let lights = shapes.into_iter().map(|shape| Light::new("light", shape)).collect();
        crate::analysis::methods_for(&Scene { lights, ..Scene::default() })
    }

    #[test]
    fn no_two_methods_have_the_same_colour_or_the_same_dashes() {
        let methods = methods();
        assert!(methods.len() >= 8, "{methods:?}");
        for (i, a) in methods.iter().enumerate() {
            for b in &methods[i + 1..] {
                let [p, q] = [a, b].map(|method| Pen::of(*method));
                assert_ne!(p.dashes, q.dashes, "dashes of {a} and {b}");
                assert!(p.on_light != q.on_light && p.on_dark != q.on_dark, "colours of {a} and {b}");
            }
        }
    }

    #[test]
    fn pinned_curves_are_told_from_methods_by_colour_and_by_dashes() {
        let pens: Vec<Pen> = methods().into_iter().map(Pen::of).chain((0..4).map(Pen::pinned)).collect();
        let count = methods().len();
        for i in count..pens.len() {
            for (j, other) in pens[..i].iter().enumerate() {
                assert!(
                    pens[i].on_light != other.on_light && pens[i].on_dark != other.on_dark,
                    "colours of {i} and {j}"
                );
                assert!(j >= count || pens[i].dashes != other.dashes, "dashes of {i} and {j}");
            }
        }
        assert_eq!(Pen::pinned(4), Pen::pinned(0), "then they start again");
    }

    #[test]
    fn every_curve_stands_out_from_its_ground() {
        let pinned = (0..4).map(|index| (format!("pin {index}"), Pen::pinned(index)));
        let methods = methods().into_iter().map(|method| (method.to_string(), Pen::of(method)));
        for (name, pen) in methods.chain(pinned) {
            let [light, dark] = [contrast(pen.on_light, [255; 3]), contrast(pen.on_dark, [0x14, 0x16, 0x19])];
            assert!(light >= 1.9 && dark >= 6.0, "{name} has contrast {light} on white and {dark} on black");
        }
    }
}
