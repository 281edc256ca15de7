//! What intervals leave of [0, 1].
//!
//! Ends are only compared and copied, never computed: what is left does not depend on the order of what was taken.

use smallvec::{SmallVec, smallvec};

/// Disjoint parts of [0, 1], ascending.
#[derive(Clone, Debug, PartialEq)]
pub struct Segments {
    parts: SmallVec<[[f64; 2]; 4]>,
}

/// Parts no longer than this are left by rounding, between what hides side by side.
const SLIVER: f64 = 1e-13;

impl Segments {
    /// All of it.
    pub fn whole() -> Self {
        Self { parts: smallvec![[0.0, 1.0]] }
    }

    /// Nothing.
    pub fn nothing() -> Self {
        Self { parts: SmallVec::new() }
    }

    /// The parts that are left.
    pub fn parts(&self) -> &[[f64; 2]] {
        &self.parts
    }

    /// Whether nothing is left.
    pub fn is_empty(&self) -> bool {
        self.parts.is_empty()
    }

    /// Whether nothing was taken.
    pub fn is_whole(&self) -> bool {
        self.parts[..] == [[0.0, 1.0]]
    }

    /// Takes an interval away; an empty one, or one that is no number, takes nothing.
    pub fn hide(&mut self, from: f64, to: f64) {
        if from.is_nan() || to.is_nan() || from >= to {
            return;
        }
        let mut i = 0;
        while let Some(&[start, end]) = self.parts.get(i) {
            if to <= start || from >= end {
                i += 1;
                continue;
            }
            match (start < from, to < end) {
                (true, true) => {
                    self.parts[i] = [start, from];
                    self.parts.insert(i + 1, [to, end]);
                    return;
                }
                (true, false) => {
                    self.parts[i] = [start, from];
                    i += 1;
                }
                (false, true) => {
                    self.parts[i] = [to, end];
                    i += 1;
                }
                (false, false) => {
                    self.parts.remove(i);
                }
            }
        }
    }

    /// The same parts of [from, to], without those that rounding left.
    pub(super) fn within(mut self, from: f64, to: f64) -> Self {
        self.parts.retain(|[start, end]| *end - *start > SLIVER);
        for t in self.parts.iter_mut().flatten() {
            *t = from * (1.0 - *t) + to * *t;
        }
        self.parts.retain(|[start, end]| start < end);
        self
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    #[track_caller]
    fn check(hidden: &[[f64; 2]], left: &[[f64; 2]]) {
        let mut segments = Segments::whole();
        for &[from, to] in hidden {
            segments.hide(from, to);
        }
        assert_eq!(segments.parts(), left, "after {hidden:?}");
    }

    #[test]
    fn what_is_left_is_the_complement_of_the_union() {
        check(&[], &[[0.0, 1.0]]);
        check(&[[0.25, 0.5]], &[[0.0, 0.25], [0.5, 1.0]]);
        check(&[[0.25, 0.5], [0.5, 0.75]], &[[0.0, 0.25], [0.75, 1.0]]);
        check(&[[0.25, 0.5], [0.0, 0.3], [0.6, 2.0]], &[[0.5, 0.6]]);
        check(&[[-1.0, 0.6], [0.5, 1.0]], &[]);
        check(&[[0.1, 0.2], [0.3, 0.4], [0.15, 0.35]], &[[0.0, 0.1], [0.4, 1.0]]);
    }

    #[test]
    fn empty_intervals_and_no_numbers_take_nothing() {
        check(&[[0.5, 0.5], [0.7, 0.2], [f64::NAN, 1.0], [0.0, f64::NAN], [2.0, 3.0]], &[[0.0, 1.0]]);
    }

    proptest! {
        #[test]
        fn parts_are_ascending_and_disjoint_and_do_not_depend_on_the_order(
            hidden in proptest::collection::vec([-0.2..1.2_f64, 0.0..0.4_f64], 0..12), probe in 0.0..1.0_f64,
        ) {
            let (mut forth, mut back) = (Segments::whole(), Segments::whole());
            for &[from, length] in &hidden {
                forth.hide(from, from + length);
            }
            for &[from, length] in hidden.iter().rev() {
                back.hide(from, from + length);
            }
            prop_assert_eq!(&forth, &back);
            let ends: Vec<f64> = forth.parts().iter().flatten().copied().collect();
            prop_assert!(ends.is_sorted_by(|a, b| a < b), "{ends:?}");
            prop_assert!(ends.iter().all(|t| (0.0..=1.0).contains(t)), "{ends:?}");
            let covered = hidden.iter().any(|&[from, length]| from < probe && probe < from + length);
            let left = forth.parts().iter().any(|&[from, to]| from < probe && probe < to);
            prop_assert!(covered != left, "{probe} in {ends:?}");
        }
    }
}
