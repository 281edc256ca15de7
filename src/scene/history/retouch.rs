//! What a step changed in a light's picture.

use std::ops::Range;
use std::sync::Arc;

use crate::light::pattern::pack::{pack, unpack};
use crate::light::pattern::{Channel, Image};

/// The texels of a picture where it differs from another of its size.
///
/// A stroke of a brush touches few of a picture's texels, so that a thousand strokes take less than a thousand pictures.
#[derive(Clone, Debug)]
pub(super) struct Retouch {
    channels: Vec<Patch>,
}

/// Some texels of a channel.
#[derive(Clone, Debug)]
struct Patch {
    /// Where they are among the channel's texels, in order.
    runs: Vec<Range<usize>>,
    /// All of them, packed.
    texels: Box<[u8]>,
}

/// Texels between two that differ that are kept too, because another run would take more.
const LEAST_GAP: usize = 16;

impl Retouch {
    /// What `old` has where it differs from `new`; none of pictures that are of different sizes or the same.
    pub(super) fn between(old: &Image, new: &Image) -> Option<Self> {
        let (old, new) = (old.channels(), new.channels());
        let size = |channel: &Arc<Channel>| channel.size();
        if !old.iter().map(size).eq(new.iter().map(size)) {
            return None;
        }
        let channels: Vec<Patch> = old.iter().zip(new).map(|(old, new)| Patch::between(old, new)).collect();
        channels.iter().any(|patch| !patch.runs.is_empty()).then_some(Self { channels })
    }

    /// The other picture: `image` with these texels, which then are the ones that `image` had.
    pub(super) fn swap(&mut self, image: &Image) -> Image {
        let mut channels = image.channels().iter().zip(&mut self.channels).map(|(channel, patch)| {
            let texels = patch.swap(channel.texels());
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
        self.channels.iter().map(|patch| size_of_val(patch.runs.as_slice()) + patch.texels.len()).sum()
    }
}

impl Patch {
    /// The texels of `old` that differ from `new`'s.
    fn between(old: &Arc<Channel>, new: &Arc<Channel>) -> Self {
        if Arc::ptr_eq(old, new) {
            return Self { runs: Vec::new(), texels: pack(&[]) };
        }
        let mut runs: Vec<Range<usize>> = Vec::new();
        for (i, (a, b)) in old.texels().iter().zip(new.texels()).enumerate() {
            if a.to_bits() != b.to_bits() {
                match runs.last_mut() {
                    Some(run) if i < run.end + LEAST_GAP => run.end = i + 1,
                    _ => runs.push(i..i + 1),
                }
            }
        }
        runs.shrink_to_fit();
        let texels = pack(&gathered(&runs, old.texels()));
        Self { runs, texels }
    }

    /// `texels` with these, which then are the ones that were there.
    fn swap(&mut self, texels: &[f32]) -> Vec<f32> {
        let count = self.runs.iter().map(Range::len).sum();
        let kept = unpack(&self.texels, count);
        self.texels = pack(&gathered(&self.runs, texels));
        let mut texels = texels.to_vec();
        let mut rest = kept.as_slice();
        for run in &self.runs {
            let (these, others) = rest.split_at(run.len());
            texels[run.clone()].copy_from_slice(these);
            rest = others;
        }
        texels
    }
}

/// The texels of runs, one after the other.
fn gathered(runs: &[Range<usize>], texels: &[f32]) -> Vec<f32> {
    runs.iter().flat_map(|run| texels[run.clone()].iter().copied()).collect()
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
        assert_eq!(retouch.channels[0].runs.first(), Some(&(5..12)), "what lies between is kept too");
        assert_eq!(retouch.channels[0].runs.len(), 1, "in one run");
        assert_eq!(retouch.swap(&new), old, "back");
        assert_eq!(retouch.swap(&old), new, "forth");
    }

    #[test]
    fn a_channel_that_is_the_same_has_nothing_to_exchange() {
        let channel = Arc::new(Channel::new(4, vec![0.5; 8]).expect("a picture"));
        let mut patch = Patch::between(&channel, &channel);
        assert!(patch.runs.is_empty(), "the same");
        assert_eq!(patch.swap(channel.texels()), channel.texels(), "nothing to exchange");
    }

    #[test]
    fn pictures_that_are_the_same_or_another_size_are_kept_whole() {
        let black = grey(vec![0.0; 16]);
        assert!(Retouch::between(&black, &black.clone()).is_none(), "the same");
        assert!(Retouch::between(&black, &grey(vec![0.0; 12])).is_none(), "another size");
    }
}
