//! Prims as they stand in a layer.

use glam::DVec3;

/// A layer: what it says of itself, and its prims.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Layer {
    pub(super) metadata: Vec<Property>,
    pub(super) prims: Vec<Prim>,
}

/// A prim.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Prim {
    pub(super) line: usize,
    /// `def`, `over` or `class`.
    pub(super) specifier: String,
    pub(super) kind: String,
    pub(super) name: String,
    pub(super) metadata: Vec<Property>,
    pub(super) properties: Vec<Property>,
    pub(super) children: Vec<Prim>,
    pub(super) variant_sets: Vec<(String, Vec<(String, Prim)>)>,
}

/// An attribute, a relationship, or something that a prim or layer says of itself.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Property {
    pub(super) line: usize,
    pub(super) name: String,
    pub(super) value: Value,
}

/// A value.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Value {
    None,
    Number(f64),
    /// A string or token.
    Text(String),
    Asset(String),
    Path(String),
    /// A tuple or a list.
    List(Vec<Value>),
    Dictionary(Vec<(String, Value)>),
    /// Times and values.
    Samples(Vec<Value>),
}

impl Value {
    /// Itself, or of an animated one its first sample.
    fn still(&self) -> &Self {
        match self {
            Self::Samples(samples) => samples.first().unwrap_or(&Self::None),
            value => value,
        }
    }

    pub(super) fn number(&self) -> Option<f64> {
        match self.still() {
            Self::Number(number) => Some(*number).filter(|number| number.is_finite()),
            Self::Text(text) if text == "true" => Some(1.0),
            Self::Text(text) if text == "false" => Some(0.0),
            _ => None,
        }
    }

    pub(super) fn text(&self) -> Option<&str> {
        match self.still() {
            Self::Text(text) | Self::Asset(text) | Self::Path(text) => Some(text),
            _ => None,
        }
    }

    pub(super) fn list(&self) -> Option<&[Self]> {
        match self.still() {
            Self::List(values) => Some(values),
            _ => None,
        }
    }

    /// A tuple of `N` numbers.
    pub(super) fn numbers<const N: usize>(&self) -> Option<[f64; N]> {
        let numbers: Option<Vec<f64>> = self.list()?.iter().map(Self::number).collect();
        numbers?.try_into().ok()
    }

    pub(super) fn vector(&self) -> Option<DVec3> {
        self.numbers().map(DVec3::from_array)
    }
}

/// The property of that name: the last one, but a value rather than none.
pub(super) fn find<'a>(properties: &'a [Property], name: &str) -> Option<&'a Property> {
    let mut named = properties.iter().rev().filter(|property| property.name == name);
    named.clone().find(|property| property.value != Value::None).or_else(|| named.next())
}

impl Prim {
    pub(super) fn property(&self, name: &str) -> Option<&Property> {
        find(&self.properties, name)
    }

    /// An attribute of a light: with `inputs:`, or as before OpenUSD 21.02 without.
    pub(super) fn input(&self, name: &str) -> Option<&Property> {
        self.property(&format!("inputs:{name}")).or_else(|| self.property(name))
    }

    pub(super) fn number(&self, name: &str) -> Option<f64> {
        self.input(name)?.value.number()
    }

    pub(super) fn is_on(&self, name: &str) -> bool {
        self.number(name).is_some_and(|value| value != 0.0)
    }

    /// The group that Softbox listed it in.
    pub(super) fn group(&self) -> Option<String> {
        self.property("softbox:group")?.value.text().map(str::to_owned)
    }

    /// Whether that API schema is applied to it.
    pub(super) fn has_api(&self, schema: &str) -> bool {
        let schemas = self.metadata.iter().filter(|property| property.name == "apiSchemas");
        let mut schemas = schemas.filter_map(|property| property.value.list()).flatten();
        schemas.any(|name| name.text() == Some(schema))
    }
}
