//! A document's structure, checked against the format's own JSON Schema.
//!
//! Serde would stop at the first error, and would read `[1.0, 2.0, 3.0, 4.0]` as a vector of three.

use std::ops::Range;

use serde_json::Value as Rule;
use toml::Spanned;
use toml::de::{DeInteger, DeTable, DeValue};

use super::nearest::{quoted, suggestion};
use super::problem::{Path, Problem};

/// All that is wrong with the structure of `document`, each with its offset in the text.
pub(super) fn check(document: &Spanned<DeTable<'_>>, schema: &Rule) -> Vec<(usize, Problem)> {
    let mut checker = Checker { definitions: &schema["$defs"], problems: Vec::new() };
    checker.table(schema, document.get_ref(), &document.span(), &Path::default());
    checker.problems
}

struct Checker<'s> {
    definitions: &'s Rule,
    problems: Vec<(usize, Problem)>,
}

impl<'s> Checker<'s> {
    fn report(&mut self, span: &Range<usize>, path: &Path, message: String) {
        self.problems.push((span.start, Problem::new(path.clone(), message)));
    }

    /// The rule itself, or the definition that it refers to.
    fn resolve(&self, rule: &'s Rule) -> &'s Rule {
        match rule["$ref"].as_str().and_then(|reference| reference.strip_prefix("#/$defs/")) {
            Some(name) => &self.definitions[name],
            None => rule,
        }
    }

    fn value(&mut self, rule: &'s Rule, value: &Spanned<DeValue<'_>>, path: &Path) {
        let rule = self.resolve(rule);
        let span = &value.span();
        match (kind(rule), value.get_ref()) {
            (Kind::Table, DeValue::Table(table)) => self.table(rule, table, span, path),
            (Kind::List, DeValue::Array(items)) => self.list(rule, items, span, path),
            (Kind::Variant, DeValue::Table(table)) => self.variant(rule, table, span, path),
            (Kind::Choice, DeValue::String(name)) => {
                let names = choices(rule);
                if !names.contains(&name.as_ref()) {
                    self.report(span, path, format!("`{name}` is not known; {}", suggestion(name, names)));
                }
            }
            (Kind::Number, DeValue::Float(float)) if is_too_large(float.as_str()) => {
                self.report(span, path, format!("must be finite, but is {}; write a smaller number", float.as_str()));
            }
            (Kind::Number | Kind::Whole, DeValue::Integer(integer)) if is_out_of_reach(integer, rule) => {
                let wrong =
                    if integer.as_str().starts_with('-') { "small; write a larger" } else { "large; write a smaller" };
                self.report(span, path, format!("{integer} is too {wrong} number"));
            }
            (Kind::Number, DeValue::Float(_) | DeValue::Integer(_))
            | (Kind::Whole, DeValue::Integer(_))
            | (Kind::Text, DeValue::String(_))
            | (Kind::Switch, DeValue::Boolean(_)) => {}
            (_, other) => {
                let message = format!("must be {}, but is {}", self.expected(rule), found(other));
                self.report(span, path, message);
            }
        }
    }

    fn table(&mut self, rule: &'s Rule, table: &DeTable<'_>, span: &Range<usize>, path: &Path) {
        let fields = rule["properties"].as_object();
        let field = |key: &str| fields.and_then(|fields| fields.get(key));
        for (key, value) in table {
            match field(key.get_ref()) {
                Some(rule) => self.value(rule, value, &path.key(key.get_ref())),
                None => {
                    let known = fields.into_iter().flat_map(|fields| fields.keys().map(String::as_str));
                    let message = format!("is not known here; {}", suggestion(key.get_ref(), known));
                    self.report(&key.span(), &path.key(key.get_ref()), message);
                }
            }
        }
        for key in rule["required"].as_array().into_iter().flatten().filter_map(Rule::as_str) {
            if let Some(rule) = field(key)
                && !table.contains_key(key)
            {
                let what = rule["description"].as_str().and_then(|text| text.lines().next()).unwrap_or_default();
                let expected = self.expected(self.resolve(rule));
                let message = format!("is missing; write {expected} ({})", what.trim_end_matches('.'));
                self.report(span, &path.key(key), message);
            }
        }
    }

    fn list(&mut self, rule: &'s Rule, items: &[Spanned<DeValue<'_>>], span: &Range<usize>, path: &Path) {
        if let Some(length) = rule["minItems"].as_u64()
            && items.len() as u64 != length
        {
            let message = format!("must be {}, but has {}", self.expected(rule), items.len());
            return self.report(span, path, message);
        }
        for (i, item) in items.iter().enumerate() {
            self.value(&rule["items"], item, &path.index(i));
        }
    }

    /// A table of one key, which says what the value is.
    fn variant(&mut self, rule: &'s Rule, table: &DeTable<'_>, span: &Range<usize>, path: &Path) {
        let mut keys = table.keys();
        match (keys.next(), keys.next()) {
            (None, _) => self.report(span, path, format!("is empty; write one of {}", quoted(&choices(rule)))),
            (Some(first), Some(second)) => {
                let message = format!("has both `{}` and `{}`; keep one of the two", first.get_ref(), second.get_ref());
                self.report(span, path, message);
            }
            (Some(key), None) => {
                let variants = rule["oneOf"].as_array().into_iter().flatten();
                match variants.into_iter().find(|variant| !variant["properties"][key.get_ref().as_ref()].is_null()) {
                    Some(variant) => self.table(variant, table, span, path),
                    None => {
                        let message = format!("is not known here; {}", suggestion(key.get_ref(), choices(rule)));
                        self.report(&key.span(), &path.key(key.get_ref()), message);
                    }
                }
            }
        }
    }

    /// What would be right, in words.
    fn expected(&self, rule: &'s Rule) -> String {
        match (kind(rule), rule["minItems"].as_u64()) {
            (Kind::Number, _) => "a number".to_owned(),
            (Kind::Whole, _) => match rule["const"].as_u64() {
                Some(only) => only.to_string(),
                None => "a whole number".to_owned(),
            },
            (Kind::Text, _) => "text in quotes".to_owned(),
            (Kind::Switch, _) => "true or false".to_owned(),
            (Kind::Table, _) => "a table".to_owned(),
            (Kind::List, Some(length)) => match kind(self.resolve(&rule["items"])) {
                Kind::List => format!("a list of {length} points"),
                _ => format!("a list of {length} numbers"),
            },
            (Kind::List, None) => match kind(self.resolve(&rule["items"])) {
                Kind::Table => "a list of tables".to_owned(),
                Kind::Text => "a list of texts in quotes".to_owned(),
                _ => "a list".to_owned(),
            },
            (Kind::Choice, _) => format!("one of {}", quoted(&choices(rule))),
            (Kind::Variant, _) => format!("a table with one of {}", quoted(&choices(rule))),
        }
    }
}

/// The kinds of value that occur in the schema.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Kind {
    Number,
    Whole,
    Text,
    Switch,
    Table,
    List,
    /// One of some strings.
    Choice,
    /// A table of one key, which says what the value is.
    Variant,
}

fn kind(rule: &Rule) -> Kind {
    // An optional array has the types `array` and `null`; TOML has no null.
    match rule["type"].as_str().or_else(|| rule["type"][0].as_str()) {
        Some("number") => Kind::Number,
        Some("integer") => Kind::Whole,
        Some("boolean") => Kind::Switch,
        Some("object") => Kind::Table,
        Some("array") => Kind::List,
        Some("string") if rule["enum"].is_null() => Kind::Text,
        Some(_) => Kind::Choice,
        None if rule["oneOf"][0]["type"] == "object" => Kind::Variant,
        None => Kind::Choice,
    }
}

/// The names that a [`Kind::Choice`] or a [`Kind::Variant`] may have.
fn choices(rule: &Rule) -> Vec<&str> {
    let list = |key: &str| rule[key].as_array().into_iter().flatten();
    let plain = list("enum").filter_map(Rule::as_str);
    let described = list("oneOf").filter_map(|choice| choice["const"].as_str().or(choice["required"][0].as_str()));
    plain.chain(described).collect()
}

/// What stands in the file, in words.
fn found(value: &DeValue<'_>) -> String {
    match value {
        DeValue::String(_) => "text".to_owned(),
        DeValue::Integer(integer) => format!("the number {integer}"),
        DeValue::Float(float) => format!("the number {float}"),
        DeValue::Boolean(boolean) => boolean.to_string(),
        DeValue::Datetime(_) => "a date".to_owned(),
        DeValue::Array(_) => "a list".to_owned(),
        DeValue::Table(_) => "a table".to_owned(),
    }
}

/// Whether digits stand for an integer that the rule's type does not hold.
fn is_out_of_reach(integer: &DeInteger<'_>, rule: &Rule) -> bool {
    match i64::from_str_radix(integer.as_str(), integer.radix()) {
        Ok(value) => rule["format"] == "uint32" && u32::try_from(value).is_err(),
        Err(_) => true,
    }
}

/// Whether digits stand for a number beyond all finite ones; `inf` itself is left to the check of values.
fn is_too_large(float: &str) -> bool {
    !float.contains("inf") && float.parse().is_ok_and(f64::is_infinite)
}
