//! The scale of a false-colour picture.

use std::fmt::Write as _;

use super::{INK, WEAK, escaped, number};
use crate::analysis::axis::{Axis, Steps};

/// Height of the bar of colours.
const BAR: f64 = 14.0;

/// Steps of colour in the bar.
const COLORS: u32 = 120;

/// Space at the bar's ends, for half a number.
const MARGIN: f64 = 26.0;

/// What the colours of a picture mean.
#[derive(Clone, Copy, Debug)]
pub struct ColorScale<'a> {
    /// The values at the scale's ends.
    pub span: [f64; 2],
    /// Colour of a value.
    pub color: fn(f64, [f64; 2]) -> [u8; 3],
    /// What is shown, with its unit.
    pub label: &'a str,
    /// What else is to be said, beneath.
    pub note: &'a str,
}

impl ColorScale<'_> {
    /// Height of the picture that [`Self::svg`] gives.
    pub const HEIGHT: f64 = 74.0;

    /// The scale as a picture of its own, on white.
    pub fn svg(&self, width: f64) -> String {
        let height = Self::HEIGHT;
        let mut svg = format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width}\" height=\"{height}\" \
             viewBox=\"0 0 {width} {height}\" font-family=\"Ubuntu, Helvetica, Arial, sans-serif\" \
             font-size=\"11\" fill=\"{INK}\">\n<rect width=\"{width}\" height=\"{height}\" fill=\"#ffffff\"/>\n"
        );
        let middle = 0.5 * width;
        let text = |svg: &mut String, y: f64, style: &str, text: &str| {
            let _ =
                writeln!(svg, "<text x=\"{middle}\" y=\"{y}\" text-anchor=\"middle\" {style}>{}</text>", escaped(text));
        };
        text(&mut svg, 14.0, "font-size=\"12\"", self.label);
        self.bar(&mut svg, [MARGIN, width - MARGIN], 21.0);
        text(&mut svg, 67.0, &format!("fill=\"{WEAK}\""), self.note);
        svg.push_str("</svg>\n");
        svg
    }

    /// The colours from side to side, with numbers beneath.
    pub(super) fn bar(&self, svg: &mut String, [left, right]: [f64; 2], top: f64) {
        let [low, high] = self.span;
        let step = (right - left) / f64::from(COLORS);
        for i in 0..COLORS {
            let value = low + (high - low) * (f64::from(i) + 0.5) / f64::from(COLORS);
            let (x, color) = (left + f64::from(i) * step, hex((self.color)(value, self.span)));
            // Each reaches under the next, so that none shows the ground between.
            let wide = if i + 1 < COLORS { 1.5 * step } else { step };
            let _ =
                writeln!(svg, "<rect x=\"{x:.2}\" y=\"{top}\" width=\"{wide:.2}\" height=\"{BAR}\" fill=\"{color}\"/>");
        }
        let axis = Axis::new(self.span, [left, right], Steps::Decimal);
        for tick in axis.ticks((right - left) / 70.0) {
            let Some(x) = axis.at(tick.value) else { continue };
            let (foot, baseline) = (top + BAR + 4.0, top + BAR + 16.0);
            let _ = writeln!(svg, "<path d=\"M{x:.2} {top}V{foot}\" stroke=\"{INK}\" stroke-width=\"0.7\"/>");
            let _ = writeln!(
                svg,
                "<text x=\"{x:.2}\" y=\"{baseline}\" text-anchor=\"middle\">{}</text>",
                number(&tick.label)
            );
        }
    }
}

/// A colour as SVG writes it.
pub(super) fn hex([r, g, b]: [u8; 3]) -> String {
    format!("#{r:02x}{g:02x}{b:02x}")
}
