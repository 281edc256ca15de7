//! What a step changed in a light's picture.

use std::sync::Arc;

use crate::light::pattern::{Channel, Image};

/// The texels of a picture where it differs from another of its size.
///
/// A stroke of a brush touches few of a picture's texels, so that a thousand strokes take less than a thousand pictures.
#[derive(Clone, Debug)]
pub(super) struct Retouch {
    /// For each channel, at most one run a row, in order.
    channels: Vec<Vec<Run>>,
}

/// Some texels in a row.
#[derive(Clone, Debug)]
struct Run {
    /// Place of the first among the channel's texels.
    start: usize,
    texels: Box<[f32]>,
}

impl Retouch {
    /// What `old` has where it differs from `new`; none of pictures that are of different sizes, the same, or different
    /// all over.
    pub(super) fn between(old: &Image, new: &Image) -> Option<Self> {
        let (old, new) = (old.channels(), new.channels());
        let size = |channel: &Arc<Channel>| channel.size();
        if !old.iter().map(size).eq(new.iter().map(size)) {
            return None;
        }
        let retouch = Self { channels: old.iter().zip(new).map(|(old, new)| runs(old, new)).collect() };
        let kept: usize = retouch.runs().map(|run| run.texels.len()).sum();
        let all: usize = old.iter().map(|channel| channel.texels().len()).sum();
        (kept > 0 && 2 * kept < all).then_some(retouch)
    }

    /// The other picture: `image` with these texels, which then are the ones that `image` had.
    pub(super) fn swap(&mut self, image: &Image) -> Image {
        let mut channels = image.channels().iter().zip(&mut self.channels).map(|(channel, runs)| {
            let mut texels = channel.texels().to_vec();
            for run in runs.iter_mut() {
                texels[run.start..][..run.texels.len()].swap_with_slice(&mut run.texels);
            }
            Arc::new(Channel::new(channel.width(), texels).expect("texels of pictures that were sound"))
        });
        let mut next = || channels.next().expect("as many channels as the picture has");
        match image {
            Image::Grey(_) => Image::Grey(next()),
            Image::Color(_) => Image::Color([next(), next(), next()]),
        }
    }

    /// Memory that it takes.
    pub(super) fn bytes(&self) -> usize {
        self.runs().map(|run| size_of::<Run>() + size_of_val(&*run.texels)).sum()
    }

    fn runs(&self) -> impl Iterator<Item = &Run> {
        self.channels.iter().flatten()
    }
}

/// The texels of `old`, from the first to the last in each row that differ from `new`'s.
fn runs(old: &Arc<Channel>, new: &Arc<Channel>) -> Vec<Run> {
    if Arc::ptr_eq(old, new) {
        return Vec::new();
    }
    let width = old.width();
    let rows = old.texels().chunks(width).zip(new.texels().chunks(width)).enumerate();
    let differs = |(a, b): (&f32, &f32)| a.to_bits() != b.to_bits();
    rows.filter_map(|(row, (old, new))| {
        let first = old.iter().zip(new).position(differs)?;
        let last = old.iter().zip(new).rposition(differs)?;
        Some(Run { start: row * width + first, texels: old[first..=last].into() })
    })
    .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn grey(texels: Vec<f32>) -> Image {
        Image::Grey(Arc::new(Channel::new(4, texels).expect("a picture")))
    }

    #[test]
    fn a_few_texels_lead_from_one_picture_to_the_other_and_back() {
        let old = grey(vec![0.0; 16]);
        let mut texels = vec![0.0; 16];
        (texels[5], texels[6], texels[11]) = (0.5, 1.0, 0.25);
        let new = grey(texels);
        let mut retouch = Retouch::between(&old, &new).expect("they differ a little");
        assert_eq!(retouch.runs().map(|run| run.texels.len()).sum::<usize>(), 3, "three texels are kept");
        assert_eq!(retouch.swap(&new), old, "back");
        assert_eq!(retouch.swap(&old), new, "forth");
    }

    #[test]
    fn pictures_that_are_the_same_or_another_size_or_all_different_are_kept_whole() {
        let black = grey(vec![0.0; 16]);
        assert!(Retouch::between(&black, &black.clone()).is_none(), "the same");
        assert!(Retouch::between(&black, &grey(vec![0.0; 12])).is_none(), "another size");
        assert!(Retouch::between(&black, &grey(vec![1.0; 16])).is_none(), "different all over");
    }
}
