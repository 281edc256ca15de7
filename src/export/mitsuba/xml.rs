//! Elements of XML, indented.

use std::fmt::Write as _;

use crate::export::job::one_line;

/// A document being written.
#[derive(Debug, Default)]
pub(super) struct Xml {
    text: String,
    open: Vec<&'static str>,
}

impl Xml {
    /// A comment of many lines.
    pub(super) fn comment(&mut self, lines: &str) {
        let _ = writeln!(self.text, "<!--\n{}-->", lines.replace("--", "- -").replace("--", "- -"));
    }

    /// A comment of one line.
    pub(super) fn note(&mut self, text: &str) {
        let text = one_line(text).replace("--", "- -").replace("--", "- -");
        let _ = writeln!(self.text, "{}<!-- {text} -->", self.indent());
    }

    /// Begins an element; [`Self::close`] ends it.
    pub(super) fn open(&mut self, tag: &'static str, attributes: &[(&str, &str)]) {
        self.start(tag, attributes);
        self.text.push_str(">\n");
        self.open.push(tag);
    }

    /// Ends the element begun last.
    pub(super) fn close(&mut self) {
        if let Some(tag) = self.open.pop() {
            let _ = writeln!(self.text, "{}</{tag}>", self.indent());
        }
    }

    /// An element without others in it.
    pub(super) fn element(&mut self, tag: &'static str, attributes: &[(&str, &str)]) {
        self.start(tag, attributes);
        self.text.push_str("/>\n");
    }

    /// A value under a name: `<float name="fov" value="40"/>`.
    pub(super) fn value(&mut self, kind: &'static str, name: &str, value: &str) {
        self.element(kind, &[("name", name), ("value", value)]);
    }

    /// The text of a document whose elements have all ended.
    pub(super) fn text(self) -> String {
        self.text
    }

    fn indent(&self) -> String {
        "    ".repeat(self.open.len())
    }

    fn start(&mut self, tag: &str, attributes: &[(&str, &str)]) {
        let _ = write!(self.text, "{}<{tag}", self.indent());
        for (name, value) in attributes {
            let _ = write!(self.text, " {name}=\"{}\"", escaped(value));
        }
    }
}

/// Text as it may stand in an attribute.
fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('"', "&quot;")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn elements_nest_and_texts_are_escaped() {
        let mut xml = Xml::default();
        xml.comment("a --- b\n");
        xml.open("scene", &[("version", "3.0.0")]);
        xml.value("string", "name", "<\"a\" & b>");
        xml.close();
        let expected = "<!--\na - - - b\n-->\n<scene version=\"3.0.0\">\n    \
            <string name=\"name\" value=\"&lt;&quot;a&quot; &amp; b>\"/>\n</scene>\n";
        assert_eq!(xml.text(), expected, "escaped and indented");
    }
}
