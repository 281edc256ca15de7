//! Finding things by a few of their letters.

/// What a query that starts a word, letter by letter, is worth: more than the starts of ten words.
const WHOLE: i32 = 100;

/// How well `query` fits `text`, whatever the case; none where its letters do not all occur in this order.
///
/// All in one piece where a word starts is best of all. Otherwise letters at the start of a word count most, then letters
/// that follow each other; a short text is better than a long one. Spaces in the query do not matter.
pub fn score(query: &str, text: &str) -> Option<i32> {
    let words = text.to_lowercase();
    let whole = query.trim().to_lowercase();
    let is_whole = !whole.is_empty() && (words.starts_with(&whole) || words.contains(&format!(" {whole}")));
    let text: Vec<char> = words.chars().collect();
    let mut score = if is_whole { WHOLE } else { 0 };
    let mut from = 0;
    let mut last = None;
    for letter in query.to_lowercase().chars().filter(|c| !c.is_whitespace()) {
        let starts_word = |i: usize| i == 0 || !text[i - 1].is_alphanumeric();
        let places = || (from..text.len()).filter(|i| text[*i] == letter);
        let follows = last.map(|last: usize| last + 1);
        // What follows the letter before, else the next word that starts so, else the next such letter.
        let at =
            places().find(|i| Some(*i) == follows).or_else(|| places().find(|i| starts_word(*i))).or(places().next())?;
        score += match (starts_word(at), Some(at) == follows) {
            (true, _) => 8,
            (_, true) => 6,
            _ => 1,
        };
        from = at + 1;
        last = Some(at);
    }
    let length = i32::try_from(text.len()).unwrap_or(i32::MAX);
    Some(16 * score - length.min(200))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Of `texts`, the one that fits best.
    fn best<'t>(query: &str, texts: &[&'t str]) -> Option<&'t str> {
        let scored = texts.iter().filter_map(|text| Some((score(query, text)?, *text)));
        scored.max_by_key(|(score, _)| *score).map(|(_, text)| text)
    }

    #[test]
    fn starts_of_words_and_runs_win() {
        let texts = [
            "Reset layout",
            "Draw line",
            "Redo add light",
            "Select ball",
            "Save selection as preset…",
            "Show all",
            "Auto exposure",
            "Open example Patio",
        ];
        for (query, found) in [
            ("rl", "Reset layout"),
            ("line", "Draw line"),
            ("ball", "Select ball"),
            ("ssp", "Save selection as preset…"),
            ("SHOW A", "Show all"),
            ("exp", "Auto exposure"),
        ] {
            assert_eq!(best(query, &texts), Some(found), "{query}");
        }
    }

    #[test]
    fn letters_that_are_not_there_in_this_order_find_nothing() {
        assert_eq!(best("enil", &["Draw line"]), None, "backwards");
        assert_eq!(best("lines", &["Draw line"]), None, "too many");
        assert!(score("", "anything").is_some(), "nothing typed fits all");
    }
}
