//! The text of an IES file.
//!
//! **Source:** [`crate::refs::LM_63`]. Lines end in CR LF, are ASCII, and have at most 132 characters, as the older
//! versions ask for.

use super::field::Field;
use super::luminaire::Luminaire;
use super::web::Web;
use super::{Job, Remark};
use crate::export::origin::PROGRAM;
use crate::export::preflight;
use crate::light::Light;

/// Characters of a line, without its end.
const WIDTH: usize = 130;

/// Digits of the greatest number of a kind; the others have as many behind the point.
const DIGITS: i32 = 7;

/// The file.
pub(super) fn file(
    job: &Job,
    lights: &[Light],
    luminaire: &Luminaire,
    web: &Web,
    field: &Field,
    remarks: &[Remark],
) -> String {
    let mut text = Lines(String::new());
    text.line("IESNA:LM-63-2002");
    text.keyword("TEST", &format!("computed by {PROGRAM}"));
    text.keyword("TESTLAB", "none: computed, not measured");
    text.keyword("ISSUEDATE", "undated");
    text.keyword("MANUFAC", PROGRAM);
    let names: Vec<&str> = lights.iter().map(|light| light.name.as_str()).collect();
    text.keyword("LUMINAIRE", &names.join(", "));
    text.keyword("OTHER", &format!("scene {}", job.scene_name));
    text.keyword("_WITHIN_1_PERCENT", &format!("{} m", rounded_up(field.within_1)));
    text.keyword("_WITHIN_5_PERCENT", &format!("{} m", rounded_up(field.within_5)));
    let percent = rounded_up(100.0 * web.error);
    text.keyword("_INTERPOLATION", &format!("between the angles at most {percent} % of the greatest candela off"));
    text.keyword("_SYMMETRY", web.symmetry.name());
    let middle = luminaire.middle_of_opening();
    if middle.length() > 1e-9 * luminaire.radius() {
        let [x, y, z] = middle.to_array().map(short);
        let what =
            format!("the photometric centre is the middle of the flux; the opening's is at ({x}, {y}, {z}) m from it");
        text.keyword("_OPENING", &what);
    }
    for line in preflight::lines(remarks) {
        text.keyword("_REMARK", &line);
    }
    text.line("TILT=NONE");
    let [width, length, height] = luminaire.opening().map(short);
    let counts = format!("{} {}", web.gammas.len(), web.planes.len());
    text.line(&format!("1 {} 1 {counts} 1 2 {width} {length} {height}", short(luminaire.flux)));
    text.line("1 1 0");
    let angle = |angle: &f64| digits(*angle, 9);
    text.numbers(web.gammas.iter().map(angle));
    text.numbers(web.planes.iter().map(angle));
    let places = places_of(web.peak);
    for plane in web.candela.chunks(web.gammas.len()) {
        text.numbers(plane.iter().map(|candela| digits(*candela, places)));
    }
    text.0
}

/// A number of seven digits, without zeros at its end.
pub(super) fn short(value: f64) -> String {
    digits(value, places_of(value))
}

/// A bound of three digits, not below the value.
pub(super) fn rounded_up(value: f64) -> String {
    if !value.is_finite() {
        return "no distance".to_owned();
    }
    // A value of three digits already is not to become the next.
    let unit = 10.0_f64.powf((value.max(1e-12) * (1.0 - 1e-9)).log10().floor() - 2.0);
    short((value / unit * (1.0 - 1e-9)).ceil() * unit)
}

/// Decimal places of a number of seven digits.
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "from 0 to 30")]
fn places_of(value: f64) -> usize {
    let magnitude = if value == 0.0 { 0.0 } else { value.abs().log10().floor() };
    (f64::from(DIGITS) - 1.0 - magnitude).clamp(0.0, 30.0) as usize
}

/// A number with at most so many decimal places.
fn digits(value: f64, places: usize) -> String {
    let text = format!("{value:.places$}");
    let text = if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.') } else { &text };
    if text == "-0" { "0".to_owned() } else { text.to_owned() }
}

struct Lines(String);

impl Lines {
    fn line(&mut self, line: &str) {
        self.0.push_str(line);
        self.0.push_str("\r\n");
    }

    /// A keyword and its text, which goes on after [MORE] where it is long.
    fn keyword(&mut self, keyword: &str, text: &str) {
        let mut line = format!("[{keyword}]");
        for word in ascii(text).split(' ').filter(|word| !word.is_empty()) {
            if line.len() + 1 + word.len() > WIDTH {
                self.line(&line);
                "[MORE]".clone_into(&mut line);
            }
            line.push(' ');
            line.extend(word.chars().take(WIDTH - "[MORE] ".len()));
        }
        self.line(&line);
    }

    /// Numbers, on as many lines as they need.
    fn numbers(&mut self, numbers: impl Iterator<Item = String>) {
        let mut line = String::new();
        for number in numbers {
            if !line.is_empty() {
                if line.len() + 1 + number.len() > WIDTH {
                    self.line(&line);
                    line.clear();
                } else {
                    line.push(' ');
                }
            }
            line.push_str(&number);
        }
        self.line(&line);
    }
}

/// The text in printable ASCII; what has no such form is a question mark.
fn ascii(text: &str) -> String {
    let plain = |c: char| match c {
        ' '..='~' => Some(c),
        '−' | '–' => Some('-'),
        '²' => Some('2'),
        '·' => Some('*'),
        '°' => None,
        _ => Some('?'),
    };
    text.chars().flat_map(|c| plain(c).map_or_else(|| " deg".chars().collect(), |c| vec![c])).collect()
}
