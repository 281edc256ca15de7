//! What somebody may have meant by a name that does not exist.

/// "did you mean …?" where a known name is near, else a list of the known names.
pub fn suggestion<'a>(name: &str, known: impl IntoIterator<Item = &'a str>) -> String {
    let known: Vec<_> = known.into_iter().collect();
    let nearest = known.iter().map(|candidate| (edit_distance(name, candidate), candidate)).min();
    match nearest {
        Some((distance, candidate)) if distance <= (candidate.chars().count() / 3).max(1) => {
            format!("did you mean `{candidate}`?")
        }
        Some((_, only)) if known.len() == 1 => format!("only `{only}` is"),
        Some(_) => format!("known are {}", quoted(&known)),
        None => "there are none".to_owned(),
    }
}

/// The names in backquotes, with commas.
pub(super) fn quoted(names: &[&str]) -> String {
    names.iter().map(|name| format!("`{name}`")).collect::<Vec<_>>().join(", ")
}

/// Levenshtein's distance: insertions, deletions and replacements of one character.
fn edit_distance(a: &str, b: &str) -> usize {
    let b: Vec<char> = b.chars().collect();
    let mut row: Vec<usize> = (0..=b.len()).collect();
    for (i, from) in a.chars().enumerate() {
        let mut diagonal = row[0];
        row[0] = i + 1;
        for (j, to) in b.iter().enumerate() {
            let replaced = diagonal + usize::from(from != *to);
            diagonal = row[j + 1];
            row[j + 1] = replaced.min(row[j] + 1).min(diagonal + 1);
        }
    }
    row[b.len()]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn edit_distance_counts_single_changes() {
        for (a, b, distance) in
            [("", "abc", 3), ("radius", "radius", 0), ("radus", "radius", 1), ("colour", "color", 1)]
        {
            assert_eq!(edit_distance(a, b), distance, "{a} to {b}");
            assert_eq!(edit_distance(b, a), distance, "{b} to {a}");
        }
    }

    #[test]
    fn far_names_get_the_list() {
        assert_eq!(suggestion("size", ["radius", "height"]), "known are `radius`, `height`");
        assert_eq!(suggestion("hieght", ["radius", "height"]), "did you mean `height`?");
    }
}
