//! Text of a `.usda` file: prims, their attributes, and values.

use std::fmt::Write as _;

use glam::DVec3;

pub(super) use crate::export::job::number;

/// Prims as they are written, indented.
#[derive(Debug, Default)]
pub(super) struct Text {
    text: String,
    depth: usize,
}

impl Text {
    /// Starts a prim of a type, with its metadata, one line each.
    pub(super) fn open(&mut self, kind: &str, name: &str, metadata: &[String]) {
        if metadata.is_empty() {
            self.line(&format!("def {kind} \"{name}\""));
        } else {
            self.line(&format!("def {kind} \"{name}\" ("));
            self.depth += 1;
            metadata.iter().for_each(|line| self.line(line));
            self.depth -= 1;
            self.line(")");
        }
        self.line("{");
        self.depth += 1;
    }

    /// Starts a prim, and in it a variant set, by its name and which one is chosen.
    pub(super) fn open_with_variants(&mut self, kind: &str, name: &str, [set, chosen]: [&str; 2]) {
        let selection = format!("variants = {{ string {set} = \"{chosen}\" }}");
        self.open(kind, name, &[selection, format!("prepend variantSets = \"{set}\"")]);
        self.line(&format!("variantSet \"{set}\" = {{"));
        self.depth += 1;
    }

    /// Starts a variant.
    pub(super) fn open_variant(&mut self, name: &str) {
        self.line(&format!("\"{name}\" {{"));
        self.depth += 1;
    }

    /// Ends the innermost prim, variant or set.
    pub(super) fn close(&mut self) {
        self.depth -= 1;
        self.line("}");
    }

    /// An attribute or relationship and its value.
    pub(super) fn attribute(&mut self, kind: &str, name: &str, value: &str) {
        self.line(&format!("{kind} {name} = {value}"));
    }

    /// An attribute, without a value.
    pub(super) fn declaration(&mut self, kind: &str, name: &str) {
        self.line(&format!("{kind} {name}"));
    }

    /// Where a prim is: operations, the outermost first.
    pub(super) fn transform(&mut self, operations: &[(String, String)]) {
        if operations.is_empty() {
            return;
        }
        for (name, value) in operations {
            let kind = if value.starts_with('(') { "double3" } else { "double" };
            self.attribute(kind, name, value);
        }
        let names: Vec<_> = operations.iter().map(|(name, _)| quoted(name)).collect();
        self.attribute("uniform token[]", "xformOpOrder", &format!("[{}]", names.join(", ")));
    }

    /// All of it.
    pub(super) fn finished(self) -> String {
        self.text
    }

    fn line(&mut self, line: &str) {
        let indent = 4 * self.depth;
        let _ = writeln!(self.text, "{:indent$}{line}", "");
    }
}

/// An operation that moves, turns by `rotation_deg`, then scales; what does nothing is left out.
pub(super) fn placed(position: DVec3, rotation_deg: DVec3, scale: DVec3) -> Vec<(String, String)> {
    let operations =
        [("translate", position, DVec3::ZERO), ("rotateXYZ", rotation_deg, DVec3::ZERO), ("scale", scale, DVec3::ONE)];
    let acting = operations.into_iter().filter(|(_, value, idle)| value != idle);
    acting.map(|(name, value, _)| (format!("xformOp:{name}"), triple(value))).collect()
}

/// Two numbers.
pub(super) fn pair(values: [f64; 2]) -> String {
    format!("({}, {})", number(values[0]), number(values[1]))
}

/// Three numbers.
pub(super) fn triple(v: DVec3) -> String {
    format!("({}, {}, {})", number(v.x), number(v.y), number(v.z))
}

/// A list of values.
pub(super) fn list(values: impl IntoIterator<Item = String>) -> String {
    format!("[{}]", values.into_iter().collect::<Vec<_>>().join(", "))
}

/// A string; control characters become blanks.
pub(super) fn quoted(text: &str) -> String {
    let escaped = crate::export::job::one_line(text).replace('\\', "\\\\").replace('"', "\\\"");
    format!("\"{escaped}\"")
}

/// A file beside the stage.
pub(super) fn asset(name: &str) -> String {
    let sign = if name.contains('@') { "@@@" } else { "@" };
    format!("{sign}./{name}{sign}")
}
