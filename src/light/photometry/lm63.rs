//! IES files: the intensities in them.
//!
//! Read are ANSI/IESNA LM-63 of 1986, 1991, 1995, 2002 and 2019. Types A and B become type C. The factors of TILT=INCLUDE
//! are for lamps whose output depends on how the luminaire hangs: that of a luminaire that hangs level is taken, however the
//! light is turned. `TILT=<file>` is refused.
//!
//! **Source:** [`crate::refs::LM_63`].

mod sphere;

use std::str::{FromStr, Split};

use self::sphere::{Sphere, Type, TypeC};
use super::Distribution;
use super::distribution::{mixed, place};

/// A file has at most this many intensities.
pub const MOST_INTENSITIES: usize = 1_000_000;

/// What the file says of itself in its first line.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Version {
    /// 1986 and 1991: the second factor after the opening is the ballast-lamp photometric factor.
    WithPhotometricFactor,
    /// 1995 and later: it is kept for future use.
    Later,
}

/// The intensities of an IES file, or what is wrong with it: words to stand after its name.
///
/// Candela are as the file means them: times the multiplier and the ballast's factors.
pub fn read(bytes: &[u8]) -> Result<Distribution, String> {
    let text = String::from_utf8_lossy(bytes);
    let text = text.trim_start_matches('\u{feff}').trim_end_matches(['\u{1a}', '\0']);
    let lines: Vec<&str> = text.split('\n').collect();
    let version = version_of(lines[0].trim())?;
    let is_tilt = |line: &&str| line.trim_start().starts_with("TILT") && line.contains('=');
    let Some(tilt) = lines.iter().position(is_tilt) else {
        return Err(" has no line TILT=; save it as an IES file (LM-63)".to_owned());
    };
    let mut numbers = Numbers::new(&lines, tilt + 1);
    let level = match lines[tilt].trim().trim_start_matches("TILT").trim_start_matches(['=', ' ']).trim() {
        "NONE" => 1.0,
        "INCLUDE" => read_tilt(&mut numbers)?,
        file => {
            let wrong = format!("TILT={file} names another file; write TILT=INCLUDE and its lines, or TILT=NONE");
            return Err(at_line(tilt, &wrong));
        }
    };
    read_table(&mut numbers, version, level)
}

/// The version by a file's first line; a file of 1986 has any.
fn version_of(first: &str) -> Result<Version, String> {
    match first.to_ascii_uppercase().trim_start_matches("IESNA:") {
        "LM-63-1995" | "LM-63-2002" | "LM-63-2019" | "IES:LM-63-2019" => Ok(Version::Later),
        other if other.starts_with("LM-63") && !matches!(other, "LM-63-1986" | "LM-63-1991") => {
            let known = "1986, 1991, 1995, 2002 and 2019 are known";
            Err(at_line(0, &format!("`{first}` is no version of LM-63 that is read; {known}")))
        }
        _ => Ok(Version::WithPhotometricFactor),
    }
}

fn at_line(line: usize, wrong: &str) -> String {
    format!(", line {}: {wrong}", line + 1)
}

/// The lamp's geometry, and pairs of an angle and a factor: the factor at 0.
fn read_tilt(numbers: &mut Numbers<'_>) -> Result<f64, String> {
    numbers.next("the lamp-to-luminaire geometry")?;
    let pairs = numbers.count("the number of tilt angles", 1000)?;
    let angles = numbers.angles("tilt angles", pairs)?;
    let factors = numbers.several("tilt factors", pairs)?;
    let (i, share) = place(&angles, 0.0);
    let level = mixed(factors[i], factors[(i + 1).min(pairs - 1)], share);
    (level > 0.0).then_some(level).ok_or_else(|| numbers.wrong("the tilt factor at 0 is 0"))
}

/// All that follows the tilt, whose factor is `level`.
fn read_table(numbers: &mut Numbers<'_>, version: Version, level: f64) -> Result<Distribution, String> {
    numbers.next("the number of lamps")?;
    numbers.next("the lumens of a lamp")?;
    let multiplier = numbers.factor("the candela multiplier")?;
    let gamma_count = numbers.count("the number of vertical angles", MOST_INTENSITIES)?;
    let plane_count = numbers.count("the number of horizontal angles", MOST_INTENSITIES)?;
    if gamma_count < 2 {
        return Err(numbers.wrong("there is one vertical angle; at least 2 are needed"));
    }
    if gamma_count.saturating_mul(plane_count) > MOST_INTENSITIES {
        return Err(numbers.wrong(&format!("more than {MOST_INTENSITIES} intensities; write fewer angles")));
    }
    let kind = match numbers.count("the photometric type", 3)? {
        1 => None,
        2 => Some(Type::B),
        _ => Some(Type::A),
    };
    for what in ["the units", "the opening's width", "the opening's length", "the opening's height"] {
        numbers.next(what)?;
    }
    let ballast = numbers.factor("the ballast factor")?;
    let photometric = match version {
        Version::WithPhotometricFactor => numbers.factor("the ballast-lamp photometric factor")?,
        Version::Later => numbers.next("the number for future use").map(|_| 1.0)?,
    };
    numbers.next("the watts")?;
    let factor = multiplier * ballast * photometric * level;
    let counts = [gamma_count, plane_count];
    let (gammas, planes, candela) = match kind {
        None => read_type_c(numbers, counts, factor)?,
        Some(kind) => read_sphere(numbers, counts, kind, factor)?.type_c(),
    };
    Distribution::of_table(&gammas, &planes, &candela).ok_or_else(|| " gives no light: all candela are 0".to_owned())
}

/// Angles γ, those of a whole turn of half-planes, and the intensities.
fn read_type_c(
    numbers: &mut Numbers<'_>,
    [gamma_count, plane_count]: [usize; 2],
    factor: f64,
) -> Result<TypeC, String> {
    let gammas = numbers.angles("vertical angles", gamma_count)?;
    if gammas[0] < 0.0 || gammas[gamma_count - 1] > 180.0 {
        return Err(numbers.wrong("vertical angles of type C are from 0 to 180"));
    }
    let planes = numbers.angles("horizontal angles", plane_count)?;
    let round = Round::of(&planes).map_err(|wrong| numbers.wrong(&wrong))?;
    let candela = numbers.candela(gamma_count * plane_count, factor)?;
    let (planes, candela) = round.table(&candela, gamma_count);
    Ok((gammas, planes, candela))
}

/// A table of type A or B.
fn read_sphere(numbers: &mut Numbers<'_>, [v, h]: [usize; 2], kind: Type, factor: f64) -> Result<Sphere, String> {
    let mut angles = |what: &str, count: usize| {
        let angles = numbers.angles(what, count)?;
        let is_within = angles[0] >= -90.0 && angles[count - 1] <= 90.0;
        match is_within && count > 1 {
            true => Ok(angles),
            false => Err(numbers.wrong(&format!("{what} of type {kind:?} are two or more from -90 to 90"))),
        }
    };
    let (vertical, horizontal) = (angles("vertical angles", v)?, angles("horizontal angles", h)?);
    Ok(Sphere { kind, vertical, horizontal, candela: numbers.candela(v * h, factor)? })
}

/// The planes of a whole turn, each by its place in the file.
struct Round(Vec<(f64, usize)>);

impl Round {
    /// By the symmetry that a file's first and last horizontal angle tell.
    fn of(planes: &[f64]) -> Result<Self, String> {
        let places = || planes.iter().copied().zip(0..);
        let [first, last] = [planes[0], planes[planes.len() - 1]];
        let step = if planes.len() > 1 { last - planes[planes.len() - 2] } else { 0.0 };
        let mut round: Vec<(f64, usize)> = places().collect();
        match (first, last) {
            _ if planes.len() == 1 => return Ok(Self(vec![(0.0, 0)])),
            (0.0, 90.0) => {
                round.extend(places().map(|(c, i)| (180.0 - c, i)));
                round.extend(places().map(|(c, i)| (180.0 + c, i)));
                round.extend(places().map(|(c, i)| (360.0 - c, i)));
            }
            (0.0, 180.0) => round.extend(places().map(|(c, i)| (360.0 - c, i))),
            (90.0, 270.0) => {
                round.extend(places().map(|(c, i)| (if c > 180.0 { 540.0 - c } else { 180.0 - c }, i)));
            }
            (0.0, 360.0) => {}
            (0.0, last) if (last + step - 360.0).abs() < 1e-6 => round.push((360.0, 0)),
            _ => {
                let wrong = format!("horizontal angles from {first} to {last}; write 0 alone, or 0 to 90, 180 or 360");
                return Err(wrong);
            }
        }
        round.sort_by(|a, b| a.0.total_cmp(&b.0));
        round.dedup_by(|a, b| a.0 == b.0);
        Ok(Self(round))
    }

    /// The table of a whole turn, from 0 to 360, of one that has `count` values a plane.
    fn table(&self, values: &[f64], count: usize) -> (Vec<f64>, Vec<f64>) {
        let plane = |i: usize| &values[i * count..][..count];
        let mut angles: Vec<f64> = self.0.iter().map(|(c, _)| *c).collect();
        let mut table: Vec<f64> = self.0.iter().flat_map(|(_, i)| plane(*i)).copied().collect();
        if angles.len() == 1 {
            return (angles, table);
        }
        let [(first, first_plane), .., (last, last_plane)] = self.0[..] else { return (angles, table) };
        if first > 0.0 {
            // Neither end is at 0: what is there lies between them.
            let share = (360.0 - last) / (360.0 - last + first);
            let between = plane(last_plane).iter().zip(plane(first_plane)).map(|(a, b)| a + share * (b - a));
            let seam: Vec<f64> = between.collect();
            angles.insert(0, 0.0);
            table.splice(0..0, seam.iter().copied());
            angles.push(360.0);
            table.extend(seam);
        } else if last < 360.0 {
            angles.push(360.0);
            table.extend_from_slice(plane(first_plane));
        }
        (angles, table)
    }
}

/// The numbers of a file, one by one, with the line that each stands in.
struct Numbers<'t> {
    lines: &'t [&'t str],
    line: usize,
    words: Split<'t, fn(char) -> bool>,
}

impl<'t> Numbers<'t> {
    fn new(lines: &'t [&'t str], line: usize) -> Self {
        Self { lines, line, words: words(lines.get(line).unwrap_or(&"")) }
    }

    /// What is wrong in the line that was read last.
    fn wrong(&self, wrong: &str) -> String {
        at_line(self.line.min(self.lines.len().saturating_sub(1)), wrong)
    }

    fn word(&mut self) -> Option<&'t str> {
        loop {
            match self.words.next() {
                Some("") => {}
                Some(word) => return Some(word),
                None => {
                    let line = self.lines.get(self.line + 1)?;
                    self.line += 1;
                    self.words = words(line);
                }
            }
        }
    }

    fn next(&mut self, what: &str) -> Result<f64, String> {
        let word = self.word().ok_or_else(|| self.wrong(&format!("the file ends before {what}")))?;
        let number = f64::from_str(word).ok().filter(|number| number.is_finite());
        number.ok_or_else(|| {
            let word: String = word.chars().take(40).map(|c| if c.is_control() { ' ' } else { c }).collect();
            self.wrong(&format!("`{word}` is no number; here stands {what}"))
        })
    }

    /// A factor greater than 0.
    fn factor(&mut self, what: &str) -> Result<f64, String> {
        let factor = self.next(what)?;
        (factor > 0.0).then_some(factor).ok_or_else(|| self.wrong(&format!("{what} is {factor}; write 1")))
    }

    /// A whole number from 1 to `most`.
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a whole number within the range")]
    fn count(&mut self, what: &str, most: usize) -> Result<usize, String> {
        let count = self.next(what)?;
        let fits = count.fract() == 0.0 && count >= 1.0 && count <= most as f64;
        fits.then_some(count as usize).ok_or_else(|| self.wrong(&format!("{what} is {count}; it is from 1 to {most}")))
    }

    /// Numbers of 0 or more.
    fn several(&mut self, what: &str, count: usize) -> Result<Vec<f64>, String> {
        (0..count)
            .map(|i| {
                let what = format!("{what} {} of {count}", i + 1);
                let value = self.next(&what)?;
                if value < 0.0 {
                    return Err(self.wrong(&format!("{what} is {value}; it is 0 or more")));
                }
                Ok(value)
            })
            .collect()
    }

    /// The intensities times a factor, and nothing behind them.
    fn candela(&mut self, count: usize, factor: f64) -> Result<Vec<f64>, String> {
        let candela = self.several("candela", count)?;
        self.end()?;
        Ok(candela.into_iter().map(|value| factor * value).collect())
    }

    /// Increasing angles, degrees.
    fn angles(&mut self, what: &str, count: usize) -> Result<Vec<f64>, String> {
        let angles: Vec<f64> =
            (0..count).map(|i| self.next(&format!("{what} {} of {count}", i + 1))).collect::<Result<_, _>>()?;
        match angles.windows(2).find(|pair| pair[0] >= pair[1]) {
            Some(pair) => Err(self.wrong(&format!("{what} must increase, but {} follows {}", pair[1], pair[0]))),
            None => Ok(angles),
        }
    }

    /// That nothing follows.
    fn end(&mut self) -> Result<(), String> {
        match self.word() {
            None => Ok(()),
            Some(_) => Err(self.wrong("more than the angles ask for; check their numbers")),
        }
    }
}

/// A line taken apart at commas and blanks.
fn words(line: &str) -> Split<'_, fn(char) -> bool> {
    line.split(is_delimiter)
}

fn is_delimiter(c: char) -> bool {
    c == ',' || c.is_whitespace()
}

#[cfg(test)]
mod tests;
