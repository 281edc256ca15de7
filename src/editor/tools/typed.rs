//! Dimensions typed while drawing.

/// What was typed; lengths in metres, angles in degrees.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Typed {
    /// A length along the direction that is pointed to, or a radius.
    Length(f64),
    /// A length and its direction, counter-clockwise from the plane's first axis.
    Polar(f64, f64),
    /// Width and height.
    Size(f64, f64),
}

/// Units of length and how many metres each has, those that end others last.
const UNITS: [(&str, f64); 5] = [("mm", 1e-3), ("cm", 1e-2), ("in", 0.0254), ("ft", 0.3048), ("m", 1.0)];

/// Characters with which a dimension may begin.
pub fn begins(c: char) -> bool {
    c.is_ascii_digit() || matches!(c, '.' | ',' | '-' | '<')
}

impl Typed {
    /// Read `1.5`, `1.5<30` or `1.2x0.8`, with or without units: mm, cm, m, in, ft. A comma is a decimal point.
    pub fn parse(text: &str) -> Option<Self> {
        let text = text.trim().to_lowercase().replace(',', ".");
        if let Some((length, angle)) = text.split_once('<') {
            let angle = number(angle.trim_end().trim_end_matches('°'))?;
            return Some(Self::Polar(self::length(length)?, angle));
        }
        if let Some((width, height)) = text.split_once(['x', '×', '*']) {
            return Some(Self::Size(self::length(width)?, self::length(height)?));
        }
        self::length(&text).map(Self::Length)
    }
}

fn length(text: &str) -> Option<f64> {
    let text = text.trim();
    let unit = UNITS.iter().find_map(|(name, metres)| Some((text.strip_suffix(name)?, *metres)));
    let (text, metres) = unit.unwrap_or((text, 1.0));
    number(text).map(|number| number * metres)
}

/// A finite number in plain decimals.
fn number(text: &str) -> Option<f64> {
    let text = text.trim();
    let plain = text.chars().all(|c| c.is_ascii_digit() || matches!(c, '.' | '-' | '+'));
    text.parse().ok().filter(|number: &f64| plain && number.is_finite())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lengths_directions_and_sizes_are_read() {
        for (text, typed) in [
            ("1.5", Typed::Length(1.5)),
            (" 1,5 ", Typed::Length(1.5)),
            ("-.5m", Typed::Length(-0.5)),
            ("80 cm", Typed::Length(0.8)),
            ("250mm", Typed::Length(0.25)),
            ("10in", Typed::Length(0.254)),
            ("1.5<30", Typed::Polar(1.5, 30.0)),
            ("2 m < -45°", Typed::Polar(2.0, -45.0)),
            ("1.2x0.8", Typed::Size(1.2, 0.8)),
            ("120cm × 80cm", Typed::Size(1.2, 0.8)),
        ] {
            let close = |a: f64, b: f64| (a - b).abs() < 1e-15;
            let same = match (Typed::parse(text), typed) {
                (Some(Typed::Length(a)), Typed::Length(b)) => close(a, b),
                (Some(Typed::Polar(a, b)), Typed::Polar(c, d)) | (Some(Typed::Size(a, b)), Typed::Size(c, d)) => {
                    close(a, c) && close(b, d)
                }
                _ => false,
            };
            assert!(same, "{text} is {:?}", Typed::parse(text));
        }
    }

    #[test]
    fn anything_else_is_not() {
        for text in ["", "x", "1.2x", "<30", "1e9", "nan", "inf", "1.2.3", "1 2", "2 km"] {
            assert_eq!(Typed::parse(text), None, "{text}");
        }
    }
}
