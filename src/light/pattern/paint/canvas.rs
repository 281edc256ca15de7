//! A picture to paint on.

use std::ops::Range;
use std::sync::Arc;

use super::super::{Channel, Image, code};
use super::Mask;

/// A linear Rec. 709 colour of a texel.
pub type Rgb = [f32; 3];

/// A picture of linear values; texel 0 is upper left for somebody who looks at the lit side.
#[derive(Clone, Debug, PartialEq)]
pub struct Canvas {
    width: usize,
    height: usize,
    texels: Vec<Rgb>,
}

/// A rectangle of texels.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Area {
    /// Its columns.
    pub columns: Range<usize>,
    /// Its rows.
    pub rows: Range<usize>,
}

impl Area {
    /// All texels of a picture of that size.
    pub fn whole([width, height]: [usize; 2]) -> Self {
        Self { columns: 0..width, rows: 0..height }
    }

    /// Whether it has no texel.
    pub fn is_empty(&self) -> bool {
        self.columns.is_empty() || self.rows.is_empty()
    }

    /// The least area with the texels of both.
    pub fn union(&self, other: &Self) -> Self {
        let both = |a: &Range<usize>, b: &Range<usize>| a.start.min(b.start)..a.end.max(b.end);
        match (self.is_empty(), other.is_empty()) {
            (true, _) => other.clone(),
            (_, true) => self.clone(),
            _ => Self { columns: both(&self.columns, &other.columns), rows: both(&self.rows, &other.rows) },
        }
    }
}

impl Canvas {
    /// A canvas of one value; a side of no texel becomes one.
    pub fn filled(size: [usize; 2], value: Rgb) -> Self {
        let [width, height] = size.map(|side| side.max(1));
        Self { width, height, texels: vec![value; width * height] }
    }

    /// A canvas whose texels are a function of column and row.
    pub fn of_texels(size: [usize; 2], value: impl Fn(usize, usize) -> Rgb) -> Self {
        let [width, height] = size.map(|side| side.max(1));
        let texels = (0..width * height).map(|i| value(i % width, i / width)).collect();
        Self { width, height, texels }
    }

    /// The texels of an image.
    pub fn of_image(image: &Image) -> Self {
        let channels = image.channels();
        let [width, height] = [channels[0].width(), channels[0].height()];
        let texels = match channels {
            [red, green, blue] => {
                let greens_blues = green.texels().iter().zip(blue.texels());
                red.texels().iter().zip(greens_blues).map(|(r, (g, b))| [*r, *g, *b]).collect()
            }
            grey => grey[0].texels().iter().map(|value| [*value; 3]).collect(),
        };
        Self { width, height, texels }
    }

    /// The image with these texels: grey where all of them are. `None` where it is black all over, or not all texels
    /// are finite.
    pub fn image(&self) -> Option<Image> {
        if self.is_black() {
            return None;
        }
        let channel = |i: usize| Channel::new(self.width, self.texels.iter().map(|texel| texel[i]).collect());
        let red = Arc::new(channel(0)?);
        if self.texels.iter().all(|[r, g, b]| r == g && g == b) {
            return Some(Image::Grey(red));
        }
        Some(Image::Color([red, Arc::new(channel(1)?), Arc::new(channel(2)?)]))
    }

    /// Whether no texel shines.
    pub fn is_black(&self) -> bool {
        self.texels.iter().flatten().all(|value| *value <= 0.0)
    }

    /// Columns and rows.
    pub fn size(&self) -> [usize; 2] {
        [self.width, self.height]
    }

    /// The texels, row by row.
    pub fn texels(&self) -> &[Rgb] {
        &self.texels
    }

    /// A texel; `None` outside.
    pub fn get(&self, column: usize, row: usize) -> Option<Rgb> {
        let inside = column < self.width && row < self.height;
        inside.then(|| self.texels[row * self.width + column])
    }

    /// Give a texel inside the picture another value.
    pub fn put(&mut self, column: usize, row: usize, value: Rgb) {
        self.texels[row * self.width + column] = value;
    }

    /// The texels of an area, row by row.
    pub fn part(&self, area: &Area) -> impl Iterator<Item = Rgb> {
        area.rows.clone().flat_map(move |row| self.texels[row * self.width..][area.columns.clone()].iter().copied())
    }

    /// The mean of the texels.
    pub fn mean(&self) -> [f64; 3] {
        let mut sums = [0.0; 3];
        for texel in &self.texels {
            for (sum, value) in sums.iter_mut().zip(texel) {
                *sum += f64::from(*value);
            }
        }
        sums.map(|sum| sum / self.texels.len() as f64)
    }

    /// Every texel by itself.
    pub fn map(&self, value: impl Fn(Rgb) -> Rgb) -> Self {
        Self { texels: self.texels.iter().map(|texel| value(*texel)).collect(), ..*self }
    }

    /// Lay a colour through a mask over `base`, in an area: base + opacity·cover·(paint − base). The paint is a function
    /// of column and row.
    pub fn paint(&mut self, base: &Self, mask: &Mask, opacity: f32, area: &Area, paint: impl Fn(usize, usize) -> Rgb) {
        for row in area.rows.clone() {
            for column in area.columns.clone() {
                let i = row * self.width + column;
                let (share, color) = (opacity * mask.cover(column, row), paint(column, row));
                self.texels[i] = std::array::from_fn(|c| mixed(base.texels[i][c], color[c], share));
            }
        }
    }

    /// This canvas with a colour laid through a mask.
    pub fn painted(&self, mask: &Mask, opacity: f32, paint: impl Fn(usize, usize) -> Rgb) -> Self {
        let mut painted = self.clone();
        painted.paint(self, mask, opacity, &mask.area(), paint);
        painted
    }

    /// What has changed since `before` is moved to the nearest value that pictures of 16 bits have, so that what is
    /// painted can be saved as such; what is above 1 stays.
    pub fn settle(&mut self, before: &Self) {
        let same_size = self.size() == before.size();
        for (i, texel) in self.texels.iter_mut().enumerate() {
            if !same_size || before.texels[i] != *texel {
                *texel = texel.map(code::nearest);
            }
        }
    }
}

/// From `from` to `to`; exact at both ends.
fn mixed(from: f32, to: f32, share: f32) -> f32 {
    if share >= 1.0 { to } else { from + share * (to - from) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_image_comes_back_as_it_was_and_grey_stays_grey() {
        let grey = Canvas::of_texels([3, 2], |x, y| [(x + 3 * y) as f32 * 0.1; 3]);
        let image = grey.image().expect("it shines");
        assert_eq!((image.channels().len(), Canvas::of_image(&image)), (1, grey), "grey");
        let color = Canvas::of_texels([3, 2], |x, y| [x as f32, y as f32, 0.5]);
        let image = color.image().expect("it shines");
        assert_eq!((image.channels().len(), Canvas::of_image(&image)), (3, color), "colour");
    }

    #[test]
    fn a_black_canvas_and_one_that_is_not_finite_are_no_image() {
        assert!(Canvas::filled([4, 4], [0.0; 3]).image().is_none(), "black");
        assert!(Canvas::filled([4, 4], [f32::NAN, 1.0, 1.0]).image().is_none(), "not a number");
    }

    #[test]
    fn only_what_is_painted_settles() {
        let before = Canvas::filled([2, 1], [0.123_456_7; 3]);
        let mut after = Canvas::of_texels([2, 1], |x, _| [[0.123_456_7; 3], [0.4; 3]][x]);
        after.settle(&before);
        assert_eq!(after.get(0, 0), before.get(0, 0), "untouched");
        assert_eq!(after.get(1, 0), Some([code::nearest(0.4); 3]), "painted");
    }
}
