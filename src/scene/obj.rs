//! Wavefront OBJ files: the polygons in them, as triangles.
//!
//! Read are `v`, `vn` and `f`; groups, materials, texture coordinates, lines and points are passed over. Normals are used
//! where all corners of a face have one. The words are those of the format's appendix B1 in *Advanced Visualizer
//! Manual*, Wavefront Technologies, 1992.

use glam::DVec3;

use crate::math::triangulate::ears;
use crate::surface::Triangle;

/// Coordinates reach this far, metres, as in scenes.
const FARTHEST: f64 = 1e9;

/// A face has at most this many corners; how it falls into triangles is found corner by corner.
const MOST_CORNERS: usize = 1024;

/// A triangle of less height, as a share of its longest side, is left out: it has no direction.
const THINNEST: f64 = 1e-13;

/// A corner of a face: indices of its vertex and its normal.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Corner {
    vertex: usize,
    normal: Option<usize>,
}

/// A face, and the line that it stands in.
struct Face {
    line: usize,
    corners: Vec<Corner>,
}

#[derive(Default)]
struct Reader {
    vertices: Vec<DVec3>,
    normals: Vec<DVec3>,
    faces: Vec<Face>,
}

/// The triangles of an OBJ file, at most `most`, or what is wrong with it: words to stand after its name.
pub(super) fn read(bytes: &[u8], most: usize) -> Result<Vec<Triangle>, String> {
    let text = String::from_utf8_lossy(bytes);
    let mut reader = Reader::default();
    let mut whole = String::new();
    for (i, line) in text.lines().enumerate() {
        // A line that ends in a backslash goes on in the next.
        if let Some(start) = line.strip_suffix('\\') {
            whole.push_str(start);
            whole.push(' ');
            continue;
        }
        whole.push_str(line);
        reader.line(i + 1, &whole).map_err(|wrong| at_line(i + 1, &wrong))?;
        whole.clear();
    }
    let mut triangles = Vec::new();
    for face in &reader.faces {
        reader.triangulate(face, &mut triangles).map_err(|wrong| at_line(face.line, &wrong))?;
        if triangles.len() > most {
            return Err(format!(" has more than {most} triangles; simplify it"));
        }
    }
    match triangles.is_empty() {
        true if reader.faces.is_empty() => Err(" has no faces; save it as OBJ with polygons".to_owned()),
        true => Err(" has no face with an area; save it with polygons".to_owned()),
        false => Ok(triangles),
    }
}

fn at_line(line: usize, wrong: &str) -> String {
    format!(", line {line}: {wrong}")
}

impl Reader {
    fn line(&mut self, number: usize, line: &str) -> Result<(), String> {
        let mut words = line.split('#').next().unwrap_or_default().split_whitespace();
        match words.next() {
            Some("v") => self.vertices.push(vector(words, "a vertex")?),
            Some("vn") => self.normals.push(vector(words, "a normal")?.normalize_or_zero()),
            Some("f") => {
                let corners = words.map(|word| self.corner(word)).collect::<Result<Vec<_>, _>>()?;
                match corners.len() {
                    0..3 => return Err(format!("a face with {} corners; write at least 3", corners.len())),
                    3..=MOST_CORNERS => self.faces.push(Face { line: number, corners }),
                    count => return Err(format!("a face with {count} corners; write at most {MOST_CORNERS}")),
                }
            }
            _ => {}
        }
        Ok(())
    }

    /// `v`, `v/vt`, `v//vn` or `v/vt/vn`.
    fn corner(&self, word: &str) -> Result<Corner, String> {
        let mut parts = word.split('/');
        let vertex = index(parts.next().unwrap_or_default(), self.vertices.len(), word)?;
        let normal = parts.nth(1).filter(|part| !part.is_empty());
        let normal = normal.map(|part| index(part, self.normals.len(), word)).transpose()?;
        if parts.next().is_some() {
            return Err(no_corner(word));
        }
        Ok(Corner { vertex, normal })
    }

    fn triangulate(&self, face: &Face, triangles: &mut Vec<Triangle>) -> Result<(), String> {
        let missing = |kind: &str, index: usize, count: usize| {
            format!("there is no {kind} {}; the file has {count}", index.saturating_add(1))
        };
        let mut points = Vec::with_capacity(face.corners.len());
        for corner in &face.corners {
            let found = self.vertices.get(corner.vertex);
            points.push(*found.ok_or_else(|| missing("vertex", corner.vertex, self.vertices.len()))?);
            if let Some(normal) = corner.normal.filter(|normal| *normal >= self.normals.len()) {
                return Err(missing("normal", normal, self.normals.len()));
            }
        }
        let normal = |i: usize| {
            let normal = self.normals.get(face.corners[i].normal?)?;
            (*normal != DVec3::ZERO).then_some(*normal)
        };
        for [i, j, k] in ears(&points) {
            let corners = [points[i], points[j], points[k]];
            let normals = [normal(i), normal(j), normal(k)];
            let normals = if let [Some(a), Some(b), Some(c)] = normals { Some([a, b, c]) } else { None };
            let triangle = Triangle { corners, normals };
            let [a, b, c] = corners;
            let longest = a.distance_squared(b).max(b.distance_squared(c)).max(c.distance_squared(a));
            if 2.0 * triangle.area() > THINNEST * longest {
                triangles.push(triangle);
            }
        }
        Ok(())
    }
}

/// Three numbers; what follows them, a weight or a colour, is passed over.
fn vector<'a>(words: impl Iterator<Item = &'a str>, what: &str) -> Result<DVec3, String> {
    let mut vector = DVec3::ZERO;
    let mut count = 0;
    for (i, word) in words.take(3).enumerate() {
        let number: f64 = word.parse().ok().ok_or_else(|| format!("`{}` is no number", shown(word)))?;
        if !(number.is_finite() && number.abs() <= FARTHEST) {
            return Err(format!("`{}` is too large; write a number of metres up to 1e9", shown(word)));
        }
        vector[i] = number;
        count += 1;
    }
    if count == 3 { Ok(vector) } else { Err(format!("{what} of {count} numbers; write 3")) }
}

/// The index from 0 that an index from 1, or one from −1 that counts back from the last of `count`, stands for.
fn index(part: &str, count: usize, word: &str) -> Result<usize, String> {
    match part.parse::<i64>() {
        Ok(number @ 1..) => Ok(usize::try_from(number - 1).unwrap_or(usize::MAX)),
        Ok(0) => Err(format!("`{}` has the index 0; they start with 1", shown(word))),
        Ok(number) => usize::try_from(number.unsigned_abs())
            .ok()
            .and_then(|back| count.checked_sub(back))
            .ok_or_else(|| format!("`{}` counts back {number}; only {count} are before it", shown(word))),
        Err(_) => Err(no_corner(word)),
    }
}

fn no_corner(word: &str) -> String {
    format!("`{}` is no corner of a face; write indices such as 1, 1/1, 1//1 or 1/1/1", shown(word))
}

/// A word as it can stand in a message of one line.
fn shown(word: &str) -> String {
    const MOST: usize = 40;
    word.chars().take(MOST).map(|c| if c.is_control() { '\u{fffd}' } else { c }).collect()
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    #[track_caller]
    fn triangles(text: &str) -> Vec<Triangle> {
        read(text.as_bytes(), 1000).unwrap_or_else(|wrong| panic!("{wrong}"))
    }

    #[track_caller]
    fn refusal(text: &str) -> String {
        read(text.as_bytes(), 4).expect_err("it is read")
    }

    const SQUARE: &str = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvn 0 0 1\nvn 0 0 2\n";

    #[test]
    fn all_forms_of_a_corner_name_the_same_vertices() {
        let plain = triangles(&format!("{SQUARE}f 1 2 3"));
        assert_eq!(plain[0].corners, [DVec3::ZERO, DVec3::X, DVec3::new(1.0, 1.0, 0.0)], "by index");
        for face in ["f 1/1 2/2 3/3", "f -4 -3 -2", "f 1/ 2/ 3/", "f 1 2 \\\n 3", "f\t1 2 3 # a comment", "f 1//1 2 3"]
        {
            assert_eq!(triangles(&format!("{SQUARE}{face}")), plain, "{face}");
        }
        for face in ["f 1//1 2//2 3//1", "f 1/7/1 2/7/2 3/7/1", "f -4//-2 -3//-1 -2//-2"] {
            let smooth = triangles(&format!("{SQUARE}{face}"));
            assert_eq!(smooth[0].normals, Some([DVec3::Z; 3]), "{face}");
        }
    }

    #[test]
    fn what_is_no_polygon_is_passed_over() {
        let text = "mtllib a.mtl\r\no chair\r\ng leg\r\nv 0 0 0 1.0\r\nv 1 0 0 0.5 0.5 0.5\r\nv 0 1 0\r\nvt 0 0\r\ns off\r\n\
                    usemtl wood\r\nl 1 2\r\np 1\r\nf 1 2 3\r\nf 1 2 2\r\n";
        assert_eq!(triangles(text).len(), 1, "a triangle, and one without area");
    }

    #[test]
    fn what_is_wrong_is_told_with_its_line() {
        let square = |face: &str| refusal(&format!("{SQUARE}{face}\n"));
        insta::assert_snapshot!(square("f 1 2"), @", line 7: a face with 2 corners; write at least 3");
        insta::assert_snapshot!(square("f 1 2 9"), @", line 7: there is no vertex 9; the file has 4");
        insta::assert_snapshot!(square("f 1//1 2//1 3//3"), @", line 7: there is no normal 3; the file has 2");
        insta::assert_snapshot!(square("f 1 2 0"), @", line 7: `0` has the index 0; they start with 1");
        insta::assert_snapshot!(square("f 1 2 -5"), @", line 7: `-5` counts back -5; only 4 are before it");
        insta::assert_snapshot!(square("f 1 2 x"), @", line 7: `x` is no corner of a face; write indices such as 1, 1/1, 1//1 or 1/1/1");
        insta::assert_snapshot!(square("f 1 2 3/1/1/1"), @", line 7: `3/1/1/1` is no corner of a face; write indices such as 1, 1/1, 1//1 or 1/1/1");
        insta::assert_snapshot!(square("v 1 2"), @", line 7: a vertex of 2 numbers; write 3");
        insta::assert_snapshot!(square("v 1 2 nan"), @", line 7: `nan` is too large; write a number of metres up to 1e9");
        insta::assert_snapshot!(square("vn 1 two 3"), @", line 7: `two` is no number");
        insta::assert_snapshot!(square(""), @" has no faces; save it as OBJ with polygons");
        insta::assert_snapshot!(square("f 1 1 1"), @" has no face with an area; save it with polygons");
        insta::assert_snapshot!(square(&"f 1 2 3\n".repeat(5)), @" has more than 4 triangles; simplify it");
        insta::assert_snapshot!(square(&format!("f {}", "1 ".repeat(2000))), @", line 7: a face with 2000 corners; write at most 1024");
    }

    #[test]
    fn a_face_may_stand_before_its_vertices() {
        assert_eq!(triangles(&format!("f 1 2 3\n{SQUARE}")).len(), 1, "a forward reference");
    }

    proptest! {
        #[test]
        fn no_bytes_make_it_panic(text in "([vfn] [-0-9./ e]{0,20}\n){0,8}", cut in 0usize..100) {
            let bytes = &text.as_bytes()[..cut.min(text.len())];
            if let Ok(triangles) = read(bytes, 10) {
                prop_assert!(triangles.iter().all(|t| t.corners.iter().all(|p| p.is_finite())), "{text}");
            }
        }
    }
}
