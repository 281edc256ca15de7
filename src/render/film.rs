//! A finished picture.

use glam::DVec3;

use super::Pixel;
use super::tone::encode_srgb;

/// A picture, row by row from its upper left corner.
#[derive(Clone, Debug, PartialEq)]
pub struct Film {
    size: [u32; 2],
    radiance: Vec<DVec3>,
    srgb: Vec<[u8; 3]>,
}

impl Film {
    /// A black picture.
    pub(super) fn new(size: [u32; 2]) -> Self {
        let pixels = size[0] as usize * size[1] as usize;
        Self { size, radiance: vec![DVec3::ZERO; pixels], srgb: vec![[0; 3]; pixels] }
    }

    /// A picture made elsewhere; none unless there are width times height pixels of both kinds.
    pub fn from_pixels(size: [u32; 2], radiance: Vec<DVec3>, srgb: Vec<[u8; 3]>) -> Option<Self> {
        let pixels = size[0] as usize * size[1] as usize;
        (radiance.len() == pixels && srgb.len() == pixels).then_some(Self { size, radiance, srgb })
    }

    /// Put rows of `width` pixels where the tile's upper left corner is.
    pub(super) fn put_tile(&mut self, [x, y]: [u32; 2], width: u32, pixels: &[Pixel]) {
        for (row, pixels) in pixels.chunks_exact(width as usize).enumerate() {
            let start = (y as usize + row) * self.size[0] as usize + x as usize;
            for (i, pixel) in pixels.iter().enumerate() {
                self.radiance[start + i] = pixel.radiance;
                self.srgb[start + i] = encode_srgb(pixel.display);
            }
        }
    }

    /// Width and height in pixels.
    pub fn size(&self) -> [u32; 2] {
        self.size
    }

    /// L_out in cd/m², linear Rec. 709.
    pub fn radiance(&self) -> &[DVec3] {
        &self.radiance
    }

    /// Exposed, tone-mapped and sRGB-encoded.
    pub fn srgb(&self) -> &[[u8; 3]] {
        &self.srgb
    }
}
