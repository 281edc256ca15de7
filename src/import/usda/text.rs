//! From the text of a layer to its prims.

use super::UsdaError;
use super::prim::{Layer, Prim, Property, Value};
use super::token::{Token, Tokens, unexpected};

/// Prims and values nested deeper than this are refused.
const MOST_DEPTH: usize = 128;

/// The layer of a text.
pub(super) fn layer(text: &str) -> Result<Layer, UsdaError> {
    let mut parser = Parser { tokens: Tokens::new(text), depth: 0 };
    let metadata = parser.metadata()?;
    let mut root = Prim::default();
    while *parser.tokens.peek()? != Token::End {
        parser.member(&mut root)?;
    }
    Ok(Layer { metadata, prims: root.children })
}

struct Parser<'t> {
    tokens: Tokens<'t>,
    depth: usize,
}

impl Parser<'_> {
    /// What a prim, layer or property says of itself, where it does.
    fn metadata(&mut self) -> Result<Vec<Property>, UsdaError> {
        let mut metadata = Vec::new();
        if !self.tokens.take('(')? {
            return Ok(metadata);
        }
        while !self.tokens.take(')')? {
            let line = self.tokens.line()?;
            match self.tokens.next()? {
                (Token::Sign(';' | ','), _) => {}
                // A text alone is a comment.
                (Token::Text(_), _) => {}
                (Token::Word(word), _) => {
                    let is_edit = matches!(word.as_str(), "prepend" | "append" | "delete" | "add" | "reorder");
                    let name = if is_edit { self.word("a name")? } else { word.clone() };
                    self.tokens.expect('=')?;
                    let value = self.value()?;
                    if word != "delete" {
                        metadata.push(Property { line, name, value });
                    }
                }
                (token, line) => return Err(unexpected(&token, line, "a name or `)`")),
            }
        }
        Ok(metadata)
    }

    /// One thing in a prim's body, or in the layer.
    fn member(&mut self, prim: &mut Prim) -> Result<(), UsdaError> {
        let line = self.tokens.line()?;
        let word = match self.tokens.next()? {
            (Token::Sign(';'), _) => return Ok(()),
            (Token::Word(word), _) => word,
            (token, line) => return Err(unexpected(&token, line, "a prim or a property")),
        };
        match word.as_str() {
            "def" | "over" | "class" => prim.children.push(self.prim(word, line)?),
            "variantSet" => {
                let variants = self.variant_set()?;
                prim.variant_sets.push(variants);
            }
            "reorder" => {
                self.word("what is reordered")?;
                self.tokens.expect('=')?;
                self.value()?;
            }
            _ => {
                let property = self.property(word, line)?;
                prim.properties.extend(property);
            }
        }
        Ok(())
    }

    fn prim(&mut self, specifier: String, line: usize) -> Result<Prim, UsdaError> {
        let kind = if let Token::Word(_) = self.tokens.peek()? { self.word("a type")? } else { String::new() };
        let name = match self.tokens.next()? {
            (Token::Text(name), _) => name,
            (token, line) => return Err(unexpected(&token, line, "a prim's name in quotes")),
        };
        let metadata = self.metadata()?;
        let mut prim = Prim { line, specifier, kind, name, metadata, ..Prim::default() };
        self.body(&mut prim)?;
        Ok(prim)
    }

    fn body(&mut self, prim: &mut Prim) -> Result<(), UsdaError> {
        self.tokens.expect('{')?;
        self.deeper()?;
        while !self.tokens.take('}')? {
            self.member(prim)?;
        }
        self.depth -= 1;
        Ok(())
    }

    fn variant_set(&mut self) -> Result<(String, Vec<(String, Prim)>), UsdaError> {
        let name = self.quoted("the name of a variant set")?;
        self.tokens.expect('=')?;
        self.tokens.expect('{')?;
        let mut variants = Vec::new();
        while !self.tokens.take('}')? {
            let line = self.tokens.line()?;
            let name = self.quoted("the name of a variant")?;
            let metadata = self.metadata()?;
            let mut prim = Prim { line, metadata, ..Prim::default() };
            self.body(&mut prim)?;
            variants.push((name, prim));
        }
        Ok((name, variants))
    }

    /// A property that starts with `word`; none where there is only its declaration.
    fn property(&mut self, word: String, line: usize) -> Result<Option<Property>, UsdaError> {
        let mut last = word;
        // What is only declared ends with its line.
        while self.tokens.line()? == line {
            match self.tokens.peek()? {
                Token::Word(_) => last = self.word("a name")?,
                // An array's type.
                Token::Sign('[') => {
                    self.tokens.next()?;
                    self.tokens.expect(']')?;
                }
                _ => break,
            }
        }
        let value = match self.tokens.take('=')? {
            true if last.ends_with(".spline") => {
                self.skip_braces()?;
                None
            }
            true => Some(self.value()?),
            false => None,
        };
        self.metadata()?;
        let name = match last.strip_suffix(".timeSamples") {
            Some(name) => name.to_owned(),
            None => last,
        };
        Ok(value.map(|value| Property { line, name, value }))
    }

    fn value(&mut self) -> Result<Value, UsdaError> {
        Ok(match self.tokens.next()? {
            (Token::Number(number), _) => Value::Number(number),
            (Token::Text(text), _) => Value::Text(text),
            // A reference's path in the other layer, and how its time runs, may follow.
            (Token::Asset(file), _) => {
                if let Token::Path(_) = self.tokens.peek()? {
                    self.tokens.next()?;
                }
                self.metadata()?;
                Value::Asset(file)
            }
            (Token::Path(path), _) => {
                self.metadata()?;
                Value::Path(path)
            }
            (Token::Word(word), _) => match word.as_str() {
                "None" => Value::None,
                "inf" => Value::Number(f64::INFINITY),
                "nan" => Value::Number(f64::NAN),
                _ => Value::Text(word),
            },
            (Token::Sign('['), _) => self.list(']')?,
            (Token::Sign('('), _) => self.list(')')?,
            (Token::Sign('{'), _) => self.braced()?,
            (token, line) => return Err(unexpected(&token, line, "a value")),
        })
    }

    fn list(&mut self, close: char) -> Result<Value, UsdaError> {
        self.deeper()?;
        let mut values = Vec::new();
        while !self.tokens.take(close)? {
            values.push(self.value()?);
            if !self.tokens.take(',')? {
                self.tokens.expect(close)?;
                break;
            }
        }
        self.depth -= 1;
        Ok(Value::List(values))
    }

    /// A dictionary, or the samples of an animated attribute.
    fn braced(&mut self) -> Result<Value, UsdaError> {
        self.deeper()?;
        let mut samples = Vec::new();
        let mut entries = Vec::new();
        while !self.tokens.take('}')? {
            match self.tokens.next()? {
                (Token::Sign(',' | ';'), _) => {}
                (Token::Number(_), _) => {
                    self.tokens.expect(':')?;
                    samples.push(self.value()?);
                }
                // From where to where something is moved.
                (Token::Path(_), _) => {
                    self.tokens.expect(':')?;
                    self.value()?;
                }
                (Token::Word(_) | Token::Text(_), _) => {
                    let name = self.key()?;
                    entries.push((name, self.value()?));
                }
                (token, line) => return Err(unexpected(&token, line, "a key, a time or `}`")),
            }
        }
        self.depth -= 1;
        Ok(if samples.is_empty() { Value::Dictionary(entries) } else { Value::Samples(samples) })
    }

    /// Passes over what stands between braces.
    fn skip_braces(&mut self) -> Result<(), UsdaError> {
        self.tokens.expect('{')?;
        let mut open = 1;
        while open > 0 {
            match self.tokens.next()? {
                (Token::Sign('{'), _) => open += 1,
                (Token::Sign('}'), _) => open -= 1,
                (token @ Token::End, line) => return Err(unexpected(&token, line, "`}`")),
                _ => {}
            }
        }
        Ok(())
    }

    /// The last word before `=`: the key behind its type.
    fn key(&mut self) -> Result<String, UsdaError> {
        let mut last = String::new();
        while !self.tokens.take('=')? {
            match self.tokens.next()? {
                (Token::Word(word) | Token::Text(word), _) => last = word,
                (Token::Sign('[' | ']'), _) => {}
                (token, line) => return Err(unexpected(&token, line, "a key or `=`")),
            }
        }
        Ok(last)
    }

    fn word(&mut self, wanted: &str) -> Result<String, UsdaError> {
        match self.tokens.next()? {
            (Token::Word(word), _) => Ok(word),
            (token, line) => Err(unexpected(&token, line, wanted)),
        }
    }

    fn quoted(&mut self, wanted: &str) -> Result<String, UsdaError> {
        match self.tokens.next()? {
            (Token::Text(text), _) => Ok(text),
            (token, line) => Err(unexpected(&token, line, wanted)),
        }
    }

    fn deeper(&mut self) -> Result<(), UsdaError> {
        self.depth += 1;
        if self.depth <= MOST_DEPTH {
            return Ok(());
        }
        let line = self.tokens.line()?;
        Err(UsdaError::Syntax { line, what: format!("is nested more than {MOST_DEPTH} deep") })
    }
}
