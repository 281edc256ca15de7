//! Saving over a file that people wrote: what did not change keeps its comments, its order and its form.
//!
//! Three documents are walked together: the file's, and those that [`to_toml`] writes of the scene before (*base*) and
//! after (*new*). Only where the latter two differ is the file's touched, so that a default that someone wrote out
//! stays. A comment belongs to what it stands above or beside, and goes with it; but one that an empty line parts from
//! what follows is a heading, and stays when that is removed.

use std::collections::HashMap;

use toml_edit::{Array, ArrayOfTables, Decor, DocumentMut, Item, KeyMut, RawString, Table, TableLike, Value};

use super::{Scene, beside, load, to_toml};

/// The text of a scene's file, as close to an old `text` of that file as can be.
///
/// It loads as exactly `scene`: wherever a merge would not, it is [`to_toml`]'s text. An unchanged scene leaves the text
/// byte for byte as it was; so does what Softbox wrote and nobody edited: then it is [`to_toml`]'s, whatever changed.
pub fn merge(text: &str, scene: &Scene) -> String {
    let scene = &beside::unread(scene);
    let is_right = |text: &String| load::parse_unread(text).is_ok_and(|loaded| loaded == *scene);
    match load::parse_unread(text) {
        Ok(base) if base == *scene => text.to_owned(),
        // A default that was written out may contradict what is new: white as a color, beside a temperature.
        Ok(base) => [true, false]
            .into_iter()
            .filter_map(|keep_defaults| merge_text(text, &base, scene, &Merge { keep_defaults }))
            .find(is_right)
            .unwrap_or_else(|| to_toml(scene)),
        Err(_) => to_toml(scene),
    }
}

/// Merge whole documents. The lines end as the text's first one does.
fn merge_text(text: &str, base: &Scene, new: &Scene, merge: &Merge) -> Option<String> {
    let parse = |text: &str| text.parse::<DocumentMut>().ok();
    let mut document = parse(&text.replace("\r\n", "\n"))?;
    let left =
        merge.table(document.as_table_mut(), parse(&to_toml(base))?.as_table(), parse(&to_toml(new))?.as_table());
    let trailing = left + raw(Some(document.trailing()));
    document.set_trailing(trailing);
    let merged = document.to_string();
    Some(if text.lines().next()?.len() < text.find('\n')? { merged.replace('\n', "\r\n") } else { merged })
}

/// Each method merges what changed from `base` to `new` into `old`, and returns the headings that have lost their place.
struct Merge {
    /// Whether a default that is written out in the file, but not by [`to_toml`], stays.
    keep_defaults: bool,
}

impl Merge {
    fn table(&self, old: &mut dyn TableLike, base: &dyn TableLike, new: &dyn TableLike) -> String {
        let mut left = String::new();
        let keys: Vec<_> = old.iter().map(|(key, _)| key.to_owned()).collect();
        for key in keys {
            let Some((mut place, item)) = old.get_key_value_mut(&key) else { continue };
            let (before, after) = (base.get(&key), new.get(&key));
            if after.is_none() && (before.is_some() || !self.keep_defaults) {
                left += &headings(&mut place, item);
                old.remove(&key);
                continue;
            }
            let from_above = std::mem::take(&mut left);
            if let Some(after) = after
                && !same(before, after)
            {
                left = self.item(item, before, after);
            }
            put_above(decor(&mut place, item), &from_above);
        }
        insert_missing(old, base, new);
        left
    }

    fn item(&self, old: &mut Item, base: Option<&Item>, new: &Item) -> String {
        match (&mut *old, base, new) {
            (Item::ArrayOfTables(old), Some(Item::ArrayOfTables(base)), Item::ArrayOfTables(new)) => {
                return self.array_of_tables(old, base, new);
            }
            (Item::Table(old), Some(base), new) => {
                if let (Some(base), Some(new)) = (base.as_table_like(), new.as_table_like()) {
                    return self.table(old, base, new);
                }
            }
            (Item::Value(old), base, new) => {
                let value = |item: &Item| item.clone().into_value().ok();
                if let Some(new) = value(new) {
                    self.value(old, base.and_then(value).as_ref(), &new);
                }
            }
            _ => {} // The kinds are the schema's, so that this is not met; if it were, the result would be refused.
        }
        String::new()
    }

    fn value(&self, old: &mut Value, base: Option<&Value>, new: &Value) {
        match (&mut *old, base, new) {
            (Value::InlineTable(old), Some(Value::InlineTable(base)), Value::InlineTable(new)) => {
                let keys = |table: &dyn TableLike| table.iter().map(|(key, _)| key.to_owned()).collect::<Vec<_>>();
                let keys_before = keys(old);
                self.table(old, base, new);
                if keys(old) != keys_before {
                    old.fmt();
                }
            }
            (Value::Array(old), Some(Value::Array(base)), Value::Array(new))
                if old.len() == base.len() && base.len() == new.len() =>
            {
                for ((old, base), new) in old.iter_mut().zip(base).zip(new) {
                    if !is_same_value(base, new) {
                        self.value(old, Some(base), new);
                    }
                }
            }
            _ => {
                let mut value = new.clone();
                if let (Value::Array(old), Value::Array(value)) = (&*old, &mut value) {
                    lay_out(value, old);
                }
                *value.decor_mut() = old.decor().clone();
                *old = value;
            }
        }
    }

    fn array_of_tables(&self, old: &mut ArrayOfTables, base: &ArrayOfTables, new: &ArrayOfTables) -> String {
        let partners = partners(base, new);
        let mut tables: Vec<_> = old.iter().cloned().collect();
        let first = tables.first_mut().map(|first| take_heading(first.decor_mut())).unwrap_or_default();
        let mut left = String::new();
        let mut stays = vec![false; tables.len()];
        partners.iter().flatten().for_each(|i| stays[*i] = true);
        for (table, stays) in tables.iter_mut().zip(stays) {
            if stays {
                put_above(table.decor_mut(), &std::mem::take(&mut left));
            } else {
                left += &take_heading(table.decor_mut());
            }
        }
        let mut merged: Vec<_> = new
            .iter()
            .zip(partners)
            .map(|(new, partner)| {
                let Some((mut table, base)) = partner.and_then(|i| Some((tables.get(i)?.clone(), base.get(i)?))) else {
                    return unplaced(new.clone());
                };
                left += &self.table(&mut table, base, new);
                table
            })
            .collect();
        if !merged.iter().filter_map(Table::position).is_sorted() {
            let start = merged.iter().filter_map(Table::position).min();
            merged = merged.into_iter().map(unplaced).collect();
            merged[0].set_position(start);
        }
        if let Some(table) = merged.first_mut() {
            put_above(table.decor_mut(), &first);
        }
        *old = merged.into_iter().collect();
        left
    }
}

/// Insert what is new, each after what stands before it in `new`.
fn insert_missing(old: &mut dyn TableLike, base: &dyn TableLike, new: &dyn TableLike) {
    let mut entries: Vec<_> =
        old.iter().filter_map(|(key, item)| Some((old.key(key)?.clone(), item.clone()))).collect();
    let mut at = 0;
    for (name, item) in new.iter() {
        if let Some(i) = entries.iter().position(|(key, _)| key.get() == name) {
            at = i + 1;
        } else if let Some(key) = new.key(name)
            && !same(base.get(name), item)
        {
            let item = match item.clone() {
                Item::Table(table) => Item::Table(unplaced(table)),
                Item::ArrayOfTables(tables) => Item::ArrayOfTables(tables.into_iter().map(unplaced).collect()),
                other => other,
            };
            entries.insert(at, (key.clone(), item));
            at += 1;
        }
    }
    if entries.len() > old.len() {
        old.clear();
        for (key, item) in entries {
            old.entry_format(&key).or_insert(item);
        }
    }
}

/// Which table of `base` each of `new` was: the one of that name or, renamed, the one in its place that is much like it.
fn partners(base: &ArrayOfTables, new: &ArrayOfTables) -> Vec<Option<usize>> {
    let name = |table: &Table| table.get("name").map(text_of);
    let by_name: HashMap<_, _> = base.iter().enumerate().map(|(i, table)| (name(table), i)).collect();
    let named: Vec<_> = new.iter().map(|table| by_name.get(&name(table)).copied()).collect();
    let mut is_taken = vec![false; base.len()];
    named.iter().flatten().for_each(|i| is_taken[*i] = true);
    let renamed = |i: usize, table: &Table| {
        let old = base.get(i)?;
        let unchanged = table.iter().filter(|(key, item)| same(old.get(key), item)).count();
        (!is_taken[i] && 2 * unchanged >= table.len()).then_some(i)
    };
    new.iter().zip(named).enumerate().map(|(i, (table, found))| found.or_else(|| renamed(i, table))).collect()
}

/// Give a new list an old one's lines: one an item, if that had them.
fn lay_out(new: &mut Array, old: &Array) {
    let indent = |space: &str| space.rfind('\n').map(|start| space[start..].to_owned());
    if let Some(indent_of_item) = old.get(0).and_then(|item| indent(raw(item.decor().prefix())))
        && let Some(indent_of_end) = indent(raw(Some(old.trailing())))
    {
        new.iter_mut().for_each(|item| item.decor_mut().set_prefix(indent_of_item.as_str()));
        new.set_trailing(indent_of_end);
        new.set_trailing_comma(old.trailing_comma());
    }
}

/// A table that follows the one before it, wherever that is in the file; so do the tables in it.
fn unplaced(mut table: Table) -> Table {
    table.set_position(None);
    for (_, item) in table.iter_mut() {
        match item {
            Item::Table(inner) => *inner = unplaced(std::mem::take(inner)),
            Item::ArrayOfTables(inner) => *inner = std::mem::take(inner).into_iter().map(unplaced).collect(),
            _ => {}
        }
    }
    table
}

/// Whether [`to_toml`] wrote the same.
fn same(base: Option<&Item>, new: &Item) -> bool {
    base.is_some_and(|base| text_of(base) == text_of(new))
}

fn is_same_value(base: &Value, new: &Value) -> bool {
    base.to_string().trim() == new.to_string().trim()
}

fn text_of(item: &Item) -> String {
    item.to_string().trim().to_owned()
}

/// What stands around an entry: its header, where it has one, or its key.
fn decor<'a>(key: &'a mut KeyMut<'_>, item: &'a mut Item) -> &'a mut Decor {
    match item {
        Item::Table(table) if !table.is_dotted() => table.decor_mut(),
        Item::ArrayOfTables(tables) if !tables.is_empty() => tables.get_mut(0).expect("it is not empty").decor_mut(),
        _ => key.leaf_decor_mut(),
    }
}

/// All headings of an entry that is removed.
fn headings(key: &mut KeyMut<'_>, item: &mut Item) -> String {
    match item {
        Item::ArrayOfTables(tables) => tables.iter_mut().map(|table| take_heading(table.decor_mut())).collect(),
        other => take_heading(decor(key, other)),
    }
}

/// Take away the comments above that an empty line parts from the rest.
fn take_heading(decor: &mut Decor) -> String {
    let above = raw(decor.prefix()).to_owned();
    match above.rfind("\n\n") {
        Some(end) if above[..end].contains('#') => {
            decor.set_prefix(&above[end + 1..]);
            above[..=end].to_owned()
        }
        _ => String::new(),
    }
}

fn put_above(decor: &mut Decor, heading: &str) {
    if !heading.is_empty() {
        let above = heading.to_owned() + raw(decor.prefix());
        decor.set_prefix(above);
    }
}

fn raw(text: Option<&RawString>) -> &str {
    text.and_then(RawString::as_str).unwrap_or_default()
}
