//! WGSL taken apart into its declarations, to keep those that are needed and to rename them.

use std::collections::{BTreeMap, BTreeSet};

/// A function, structure, constant or variable with the comment above it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Item {
    /// Its name.
    pub(super) name: String,
    /// All of it, ending with a line break.
    pub(super) text: String,
}

impl Item {
    fn is_function(&self) -> bool {
        self.text.lines().any(|line| line.starts_with("fn "))
    }

    /// Whether a word of code means it: of a function, one that is called.
    fn is_meant_by(&self, (word, is_called): (&str, bool)) -> bool {
        word == self.name && (is_called || !self.is_function())
    }

    /// The names in its code, and whether each is called.
    fn mentions(&self) -> BTreeSet<(&str, bool)> {
        let code = self.text.lines().map(|line| code_and_comment(line).0);
        let mentioned = code.flat_map(|code| {
            words(code).map(move |word| (word, code[offset(code, word) + word.len()..].starts_with('(')))
        });
        mentioned.filter(|(word, _)| is_name(word)).collect()
    }

    /// The fields of elements of the array `name` that its code reads or writes.
    pub(super) fn fields_of(&self, name: &str) -> BTreeSet<&str> {
        let code = self.text.lines().map(|line| code_and_comment(line).0);
        let accesses = code.flat_map(|line| line.split(name).skip(1));
        let field = |after: &'_ str| -> Option<usize> {
            after.starts_with('[').then(|| after.find("].").map(|at| at + 2)).flatten()
        };
        accesses.filter_map(|after| words(&after[field(after)?..]).next()).collect()
    }

    /// Of a structure, the text with only these fields.
    pub(super) fn with_fields(&self, fields: &BTreeSet<&str>) -> String {
        let mut text = String::new();
        let mut comment = String::new();
        for line in self.text.lines().map(|line| format!("{line}\n")) {
            let name = line.trim_start().split(':').next().unwrap_or_default();
            if line.starts_with("    //") {
                comment.push_str(&line);
            } else if !line.starts_with(' ') || fields.contains(name) {
                text.push_str(&std::mem::take(&mut comment));
                text.push_str(&line);
            } else {
                comment.clear();
            }
        }
        text
    }
}

/// The declarations of a text in the way that the project's shaders are written: each begins a line, ends with `}` at the
/// beginning of one or with `;`, and has its comment right above it. What else there is, is left out.
pub(super) fn items(text: &str) -> Vec<Item> {
    let mut items = Vec::new();
    let mut comment = String::new();
    let mut lines = text.lines();
    while let Some(line) = lines.next() {
        if line.starts_with("//") {
            comment.push_str(line);
            comment.push('\n');
            continue;
        }
        let Some(name) = declared(line) else {
            comment.clear();
            continue;
        };
        let mut item = std::mem::take(&mut comment);
        let mut last = line;
        item.push_str(last);
        item.push('\n');
        while !is_end(last) {
            let Some(next) = lines.next() else { break };
            last = next;
            item.push_str(last);
            item.push('\n');
        }
        items.push(Item { name: name.to_owned(), text: item });
    }
    items
}

/// Whether a declaration ends with this line.
fn is_end(line: &str) -> bool {
    let code = code_and_comment(line).0.trim_end();
    code == "}" || !line.starts_with(' ') && (code.ends_with(';') || code.ends_with('}'))
}

/// The name that a line declares.
fn declared(line: &str) -> Option<&str> {
    let starts = |word: &&str| matches!(*word, "fn" | "struct" | "const" | "var" | "alias");
    if !line.starts_with(|c: char| c.is_ascii_alphabetic() || c == '@') {
        return None;
    }
    let mut names = words(line).skip_while(|word| !starts(word));
    let is_variable = names.next()? == "var";
    let in_space = line.contains("var<");
    names.find(|word| is_name(word) && !(is_variable && in_space && is_space(word)))
}

fn is_space(word: &str) -> bool {
    matches!(word, "uniform" | "storage" | "read" | "read_write" | "private")
}

/// The declarations that `roots` need, in their order.
pub(super) fn needed(items: &[Item], roots: &[&str]) -> Vec<Item> {
    let by_name: BTreeMap<&str, &Item> = items.iter().map(|item| (item.name.as_str(), item)).collect();
    let mut found = BTreeSet::new();
    let mut open: Vec<(&str, bool)> = roots.iter().map(|root| (*root, true)).collect();
    while let Some(mention) = open.pop() {
        if let Some(item) = by_name.get(mention.0)
            && item.is_meant_by(mention)
            && found.insert(mention.0)
        {
            open.extend(item.mentions());
        }
    }
    items.iter().filter(|item| found.contains(item.name.as_str())).cloned().collect()
}

/// A text with new names in its code, and where comments quote code in backticks.
pub(super) fn renamed(text: &str, name: impl Fn(&str) -> Option<String>) -> String {
    let mut out = String::with_capacity(text.len());
    for line in text.lines() {
        let (code, comment) = code_and_comment(line);
        push_renamed(&mut out, code, &name);
        for (i, part) in comment.split('`').enumerate() {
            out.push_str(if i > 0 { "`" } else { "" });
            // A path names something that is not in the file.
            if i % 2 == 1 && !part.contains("::") {
                push_renamed(&mut out, part, &name);
            } else {
                out.push_str(part);
            }
        }
        out.push('\n');
    }
    out
}

fn push_renamed(out: &mut String, code: &str, name: impl Fn(&str) -> Option<String>) {
    let mut rest = code;
    for word in words(code) {
        let at = offset(rest, word);
        out.push_str(&rest[..at]);
        out.push_str(&name(word).unwrap_or_else(|| word.to_owned()));
        rest = &rest[at + word.len()..];
    }
    out.push_str(rest);
}

/// A line's code, and its comment with the slashes.
fn code_and_comment(line: &str) -> (&str, &str) {
    line.split_at(line.find("//").unwrap_or(line.len()))
}

/// Where in a text a part of it begins.
fn offset(text: &str, part: &str) -> usize {
    part.as_ptr() as usize - text.as_ptr() as usize
}

/// Names and numbers.
fn words(code: &str) -> impl Iterator<Item = &str> {
    code.split(|c: char| !(c.is_ascii_alphanumeric() || c == '_')).filter(|word| !word.is_empty())
}

fn is_name(word: &str) -> bool {
    !word.starts_with(|c: char| c.is_ascii_digit())
}

#[cfg(test)]
mod tests {
    use super::*;

    const TEXT: &str = "// A file.\n\n// The half.\nconst HALF = 0.5;\nconst PAIR = array<f32, 2>(\n    HALF, // half\n    1.0,\n);\n\n\
        struct Light {\n    // Of `dead`.\n    at: vec3f,\n}\n\n@group(1) @binding(0) var<uniform> light: Light;\n\n\
        // As `dim` does, or `other::dim`, dim.\nfn lit(x: f32) -> f32 {\n    return dim(x) * light.at.x * list[0].y;\n}\n\n\
        fn dim(x: f32) -> f32 { let dead = x * HALF; return dead; }\nfn dead() {}\n";

    fn names(items: &[Item]) -> Vec<&str> {
        items.iter().map(|item| item.name.as_str()).collect()
    }

    #[test]
    fn a_text_is_taken_apart_into_its_declarations() {
        let items = items(TEXT);
        assert_eq!(names(&items), ["HALF", "PAIR", "Light", "light", "lit", "dim", "dead"], "each by its name");
        assert_eq!(items[0].text, "// The half.\nconst HALF = 0.5;\n", "with its comment, without the file's");
        assert!(items[1].text.ends_with("1.0,\n);\n"), "to its end: {}", items[1].text);
        assert_eq!(items[4].fields_of("list").into_iter().collect::<Vec<_>>(), ["y"], "an element's field");
    }

    #[test]
    fn a_structure_loses_the_fields_that_nobody_reads() {
        let text = "// S.\nstruct S {\n    // The a.\n    a: f32,\n    // The b.\n    b: array<vec4f, 4>,\n}\n";
        let text = items(text)[0].with_fields(&BTreeSet::from(["b"]));
        assert_eq!(text, "// S.\nstruct S {\n    // The b.\n    b: array<vec4f, 4>,\n}\n", "with their comments");
    }

    #[test]
    fn what_is_needed_is_what_is_mentioned_however_far() {
        let items = items(TEXT);
        assert_eq!(
            names(&needed(&items, &["lit"])),
            ["HALF", "Light", "light", "lit", "dim"],
            "without PAIR, and a function of a variable's name"
        );
        assert_eq!(names(&needed(&items, &["PAIR"])), ["HALF", "PAIR"], "comments need nothing");
    }

    #[test]
    fn code_gets_new_names_and_prose_keeps_its_words() {
        let items = items(TEXT);
        let text = renamed(&items[4].text, |name| (name == "dim").then(|| "my_dim".to_owned()));
        assert!(text.starts_with("// As `my_dim` does, or `other::dim`, dim.\n"), "{text}");
        assert!(text.contains("return my_dim(x) * light.at.x"), "{text}");
    }
}
