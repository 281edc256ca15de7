//! Numbers typed while something is dragged.

use egui::{Event, Key, Modifiers, Ui};

/// What has been typed.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Typed {
    text: String,
}

/// Longer than any number that is meant.
const MOST: usize = 24;

impl Typed {
    /// Take this frame's keys; whether Enter was among them.
    pub fn take(&mut self, ui: &Ui) -> bool {
        ui.input_mut(|input| {
            for event in &input.events {
                if let Event::Text(text) = event {
                    text.chars().for_each(|c| self.push(c));
                }
            }
            if input.consume_key(Modifiers::NONE, Key::Backspace) {
                self.text.pop();
            }
            input.consume_key(Modifiers::NONE, Key::Enter)
        })
    }

    /// One more character; what is no part of a number is left out.
    fn push(&mut self, c: char) {
        if self.text.len() < MOST && (c.is_ascii_digit() || matches!(c, '.' | ',' | '-' | 'x')) {
            self.text.push(c);
        }
    }

    /// The text as typed.
    pub fn text(&self) -> &str {
        &self.text
    }

    /// The numbers, parted as in `1.2x0.8`; none while one of them is no number yet. A comma is a decimal point.
    pub fn numbers(&self) -> Vec<f64> {
        let text = self.text.replace(',', ".");
        let numbers: Option<Vec<f64>> =
            text.split('x').map(|number| number.parse().ok().filter(|n: &f64| n.is_finite())).collect();
        numbers.unwrap_or_default()
    }
}

#[cfg(test)]
impl Typed {
    /// As if `text` had been typed.
    pub(super) fn of(text: &str) -> Self {
        let mut typed = Self::default();
        text.chars().for_each(|c| typed.push(c));
        typed
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn numbers(text: &str) -> Vec<f64> {
        Typed::of(text).numbers()
    }

    #[test]
    fn what_is_typed_becomes_numbers_once_it_is_one() {
        assert_eq!(numbers("1.5"), [1.5], "one");
        assert_eq!(numbers("-.25x2"), [-0.25, 2.0], "two");
        assert_eq!(numbers("1e,5m"), [1.5], "letters are left out");
        for unfinished in ["", "-", "1x", ".", "1-2"] {
            assert_eq!(numbers(unfinished), [0.0; 0], "{unfinished}");
        }
    }
}
