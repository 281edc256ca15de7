//! Lights as UsdLux prims.

use std::f64::consts::PI;

use glam::{DVec2, DVec3};

use super::surfaces::faces;
use super::text::{asset, list, number, placed, quoted, triple};
use super::{Named, Stage};
use crate::export::emission::SIDE_GAP;
use crate::export::job::Identifiers;
use crate::export::{ExportError, Fate, Remark, exr, texture};
use crate::light::photometry::Photometry;
use crate::light::{Light, Line, Point, Polygon, Shape, Sky, Textured, Tint};
use crate::math::quadrature::GaussLegendre;
use crate::math::triangulate::ears;

/// Radius of what has none, in metres.
const THIN: f64 = 1e-3;

/// Balls that stand for a line that shines evenly: at Gauss and Legendre's nodes, right within 1e-4 from a tenth of its
/// length away.
const ROW: usize = 32;

/// Rows of a sky's picture; twice as many columns.
const SKY_ROWS: u32 = 256;

/// Least sine between the sides of a rectangle, and what their ends may be off each other as a share of their lengths.
const SQUARE: f64 = 1e-9;

/// A prim that shines.
#[derive(Clone)]
struct Prim {
    kind: &'static str,
    /// The luminance in nits; of a distant light without width, the illuminance in lux.
    intensity: f64,
    /// What only its type has: attribute types, names and values.
    attributes: Vec<(&'static str, &'static str, String)>,
    /// From the light's own frame to the prim's: operations, the outermost first.
    operations: Vec<(String, String)>,
    /// What it is besides.
    schema: Option<&'static str>,
    /// Of a mesh, counter-clockwise for who looks at the lit side, in the prim's own frame.
    outline: Vec<DVec3>,
}

/// The prims of a light.
struct Form {
    /// Its only one, its two sides, or its row.
    prims: Vec<Prim>,
    /// Of a row, what is said of it where its prims are one: attribute types, names and values.
    row: Vec<(&'static str, &'static str, String)>,
    /// What is not as it was.
    notes: Vec<String>,
}

impl Prim {
    fn new(kind: &'static str, intensity: f64, attributes: &[(&'static str, &'static str, f64)]) -> Self {
        let attributes = attributes.iter().map(|(kind, name, value)| (*kind, *name, number(*value))).collect();
        Self { kind, intensity, attributes, operations: Vec::new(), schema: None, outline: Vec::new() }
    }

    /// One whose file is the asset of that name.
    fn with_texture(mut self, file: &str) -> Self {
        self.attributes.push(("asset", "inputs:texture:file", asset(file)));
        self
    }

    /// Turned half about X, to shine to where it had its back.
    fn turned(mut self) -> Self {
        self.operations.push(("xformOp:rotateX:back".to_owned(), number(180.0)));
        let mirrored = self.outline.iter().rev().map(|p| DVec3::new(p.x, -p.y, p.z));
        self.outline = mirrored.collect();
        self
    }

    /// A little off the light's plane, to where it shines, so that the two sides do not hide each other.
    fn raised(mut self) -> Self {
        let operation = ("xformOp:translate:side".to_owned(), triple(DVec3::new(0.0, 0.0, -SIDE_GAP)));
        self.operations.push(operation);
        self
    }
}

impl Form {
    fn of(front: Prim, note: Option<String>) -> Self {
        Self { prims: vec![front], row: Vec::new(), notes: note.into_iter().collect() }
    }

    /// With a second side, where the light has one; `back` is that side as if it were the front.
    fn with_back(self, two_sided: bool, back: impl FnOnce() -> Prim) -> Self {
        if !two_sided {
            return self;
        }
        let notes = self.notes.into_iter().chain(["is two lights, one a side".to_owned()]).collect();
        let prims = self.prims.into_iter().chain([back().turned()]).map(Prim::raised).collect();
        Self { prims, notes, ..self }
    }
}

impl Stage<'_> {
    /// A light, and what becomes of it.
    pub(super) fn light(&mut self, light: &Light, names: &mut Identifiers) -> Result<(), ExportError> {
        let name = names.of(&light.name);
        let Form { prims, row, mut notes } = match self.form(light, &name)? {
            Ok(form) => form,
            Err(reason) => {
                self.remark(Remark::light(light, Fate::Lost, reason));
                return Ok(());
            }
        };
        if let Tint::TemperatureK(kelvin) = light.tint {
            notes.push(format!("its {kelvin} K is written as a colour"));
        }
        let kind = prims.first().map_or("", |prim| prim.kind);
        if row.is_empty() {
            for (prim, side) in prims.iter().zip([None, Some("back")]) {
                let name = side.map_or_else(|| name.clone(), |side| names.of(&format!("{name}_{side}")));
                self.prim(light, prim, &name, true);
            }
        } else {
            self.text.open("Xform", &name, &[format!("displayName = {}", quoted(&light.name))]);
            for (kind, name, value) in &row {
                self.text.attribute(kind, name, value);
            }
            self.own_attributes(light);
            self.text.transform(&placed(light.position, light.rotation_deg, DVec3::ONE));
            for (i, prim) in prims.iter().enumerate() {
                self.prim(light, prim, &format!("part_{}", i + 1), false);
            }
            self.text.close();
        }
        let fate = if notes.is_empty() { Fate::Kept } else { Fate::Changed };
        let what = if notes.is_empty() { format!("as it is, a {kind}") } else { notes.join("; ") };
        self.remark(Remark::light(light, fate, what));
        Ok(())
    }

    /// What a light is here; or why it is nothing.
    fn form(&mut self, light: &Light, name: &str) -> Result<Result<Form, String>, ExportError> {
        let strength = light.strength();
        let prim = |kind, attributes: &[_]| Prim::new(kind, strength, attributes);
        Ok(Ok(match &light.shape {
            Shape::Polygon(polygon) => {
                let (front, note) = polygon_prim(polygon, strength);
                Form::of(front.clone(), note).with_back(polygon.two_sided, || front)
            }
            Shape::Disk(disk) => {
                let front = prim("DiskLight", &[("float", "inputs:radius", disk.radius)]);
                Form::of(front.clone(), None).with_back(disk.two_sided, || front)
            }
            Shape::Sphere(sphere) => Form::of(prim("SphereLight", &[("float", "inputs:radius", sphere.radius)]), None),
            Shape::Line(line) => return Ok(line_form(line, strength)),
            Shape::Textured(textured) => self.textured(textured, strength, name)?,
            Shape::Cap(cap) => {
                Form::of(prim("DistantLight", &[("float", "inputs:angle", 2.0 * cap.half_angle_deg)]), None)
            }
            Shape::Sky(sky) => {
                let note = format!("is a picture of {SKY_ROWS} rows, black below its horizon");
                Form::of(self.dome(*sky, strength, name)?, Some(note))
            }
            Shape::Point(point) => self.point(point, strength, name),
            Shape::Directional(_) => Form::of(prim("DistantLight", &[("float", "inputs:angle", 0.0)]), None),
        }))
    }

    /// A rectangle whose picture is a file beside the stage. Its first texel is at +X and +Y, as on the light.
    fn textured(&mut self, textured: &Textured, luminance: f64, name: &str) -> Result<Form, ExportError> {
        let Textured { size, pattern, two_sided } = textured;
        let attributes = [("float", "inputs:width", size.x), ("float", "inputs:height", size.y)];
        let prim = Prim::new("RectLight", luminance, &attributes);
        let mut picture = |name: &str, upside_down| -> Result<Prim, ExportError> {
            let file = self.put(name, "exr", texture::picture(pattern, upside_down, self.job.origin())?);
            let prim = prim.clone().with_texture(&file);
            Ok(prim)
        };
        let front = picture(name, false)?;
        // Turned about X, what was the first row is the last.
        let back = if *two_sided { Some(picture(&format!("{name}_back"), true)?) } else { None };
        let repeats = texture::repeats(&pattern.image);
        let note = (repeats > 1).then(|| format!("each texel is a square of {repeats}, as other programs blend them"));
        let form = Form::of(front, note);
        Ok(match back {
            Some(back) => form.with_back(true, || back),
            None => form,
        })
    }

    /// A small ball; one with measured intensities shines by its photometric file, which holds candelas.
    fn point(&mut self, point: &Point, intensity: f64, name: &str) -> Form {
        let Some(Photometry { distribution, contents, .. }) = &point.ies else {
            return Form::of(
                ball_prim(intensity),
                Some("is a ball of 1 mm radius, to be treated as a point".to_owned()),
            );
        };
        let peak = distribution.peak();
        let file = self.put(name, "ies", contents.0.to_vec());
        let mut prim = ball_prim(if peak > 0.0 { intensity / peak } else { 0.0 });
        prim.schema = Some("ShapingAPI");
        prim.attributes.push(("asset", "inputs:shaping:ies:file", asset(&file)));
        let note =
            "is a ball of 1 mm radius with its photometric file; where the half-plane C = 0 lies is up to the reader";
        Form::of(prim, Some(note.to_owned()))
    }

    /// A dome whose upper half is the sky. A dome's pole is +Y, on every stage, and the sky's is +Z.
    fn dome(&mut self, sky: Sky, luminance: f64, name: &str) -> Result<Prim, ExportError> {
        let size = [2 * SKY_ROWS, SKY_ROWS];
        let radiance = |row: u32| {
            let cosine = (PI * (f64::from(row) + 0.5) / f64::from(SKY_ROWS)).cos();
            if cosine > 0.0 { sky.uniform + sky.cosine * cosine } else { 0.0 }
        };
        let texels: Vec<_> = (0..size[1]).flat_map(|row| vec![DVec3::splat(radiance(row)); size[0] as usize]).collect();
        let bytes = exr::radiance(size, &texels, self.job.origin())
            .map_err(|cause| ExportError::Encode { what: "the sky's picture".to_owned(), cause: Box::new(cause) })?;
        let file = self.put(name, "exr", bytes);
        let mut prim = Prim::new("DomeLight", luminance, &[]).with_texture(&file);
        prim.attributes.push(("token", "inputs:texture:format", "\"latlong\"".to_owned()));
        prim.operations.push(("xformOp:rotateX:pole".to_owned(), number(90.0)));
        Ok(prim)
    }

    /// One prim of a light; where it is not alone, its row says what the light is called and where it is.
    fn prim(&mut self, light: &Light, prim: &Prim, name: &str, is_alone: bool) {
        let mut metadata = Vec::new();
        if is_alone {
            metadata.push(format!("displayName = {}", quoted(&light.name)));
        }
        if let Some(schema) = prim.schema {
            metadata.push(format!("prepend apiSchemas = [\"{schema}\"]"));
        }
        let linked = light.only.as_ref().map(|only| {
            let paths = only.iter().filter_map(|surface| self.path(&Named::Surface(surface.clone())));
            list(paths.map(|path| format!("<{path}>")))
        });
        let text = &mut self.text;
        text.open(prim.kind, name, &metadata);
        if let Some(paths) = linked {
            text.attribute("uniform bool", "collection:lightLink:includeRoot", "0");
            text.attribute("rel", "collection:lightLink:includes", &paths);
        }
        text.attribute("color3f", "inputs:color", &triple(light.tint.rgb()));
        text.attribute("float", "inputs:intensity", &number(prim.intensity));
        text.attribute("bool", "inputs:normalize", "0");
        for (kind, name, value) in &prim.attributes {
            text.attribute(kind, name, value);
        }
        if !prim.outline.is_empty() {
            let triangles = ears(&prim.outline);
            let indices = triangles.iter().flatten().map(usize::to_string).collect();
            faces(text, &prim.outline, vec!["3".to_owned(); triangles.len()], indices);
            text.attribute("uniform token", "light:materialSyncMode", "\"noMaterialResponse\"");
        }
        text.attribute("custom int", "omni:rtx:usdluxVersion", "2505");
        let mut operations = Vec::new();
        if is_alone {
            self.own_attributes(light);
            operations = placed(light.position, light.rotation_deg, DVec3::ONE);
        }
        operations.extend(prim.operations.iter().cloned());
        self.text.transform(&operations);
        self.text.close();
    }

    /// What only Softbox reads.
    fn own_attributes(&mut self, light: &Light) {
        if let Some(group) = &light.group {
            self.text.attribute("custom string", "softbox:group", &quoted(group));
        }
    }
}

/// A rectangle as a RectLight, any other polygon as a mesh.
fn polygon_prim(polygon: &Polygon, luminance: f64) -> (Prim, Option<String>) {
    if let Some((middle, turn, size)) = rectangle(&polygon.vertices) {
        let attributes = [("float", "inputs:width", size.x), ("float", "inputs:height", size.y)];
        let mut prim = Prim::new("RectLight", luminance, &attributes);
        if middle != DVec2::ZERO {
            prim.operations.push(("xformOp:translate:middle".to_owned(), triple(middle.extend(0.0))));
        }
        if turn != 0.0 {
            prim.operations.push(("xformOp:rotateZ:turn".to_owned(), number(turn.to_degrees())));
        }
        return (prim, None);
    }
    let corners = polygon.vertices.iter().map(|v| v.extend(0.0));
    // The lit side is −Z.
    let outline = if polygon.signed_area() > 0.0 { corners.rev().collect() } else { corners.collect() };
    let note = "is a mesh light, whose normals point to where it shines; what has no mesh lights shows a dark mesh";
    (Prim { outline, schema: Some("MeshLightAPI"), ..Prim::new("Mesh", luminance, &[]) }, Some(note.to_owned()))
}

/// Middle, angle from +X and size of four corners that are a rectangle's.
fn rectangle(vertices: &[DVec2]) -> Option<(DVec2, f64, DVec2)> {
    let [a, b, c, d] = <[DVec2; 4]>::try_from(vertices).ok()?;
    let [x, y] = [b - a, d - a];
    let scale = x.length().max(y.length());
    let is_closed = (a + c - b - d).length() <= SQUARE * scale;
    if !is_closed || x.dot(y).abs() > SQUARE * x.length() * y.length() {
        return None;
    }
    // The side nearer to the X axis is the width, so that an upright rectangle is not turned.
    let (width, height) = if x.x.abs() >= x.y.abs() { (x, y) } else { (y, x) };
    let width_right = if width.x < 0.0 { -width } else { width };
    let turn = width_right.y.atan2(width_right.x);
    Some((0.5 * (a + c), turn, DVec2::new(width.length(), height.length())))
}

/// A tube as a cylinder, whose ends are dark; a line that shines evenly as a row of balls, as no cylinder does; or why a
/// line is nothing.
fn line_form(line: &Line, strength: f64) -> Result<Form, String> {
    if line.falloff != 2.0 {
        return Err(format!("falls off as 1/r^{}, and UsdLux has 1/r² only; set its falloff to 2", line.falloff));
    }
    if let Some(radius) = line.tube_radius() {
        let attributes = [("float", "inputs:length", line.length), ("float", "inputs:radius", radius)];
        let note = "is a cylinder as thick as it is, not thin";
        return Ok(Form::of(Prim::new("CylinderLight", strength, &attributes), Some(note.to_owned())));
    }
    let rule = GaussLegendre::new(ROW);
    let half = 0.5 * line.length;
    let ball = |(x, weight): &(f64, f64)| {
        let mut prim = ball_prim(strength * half * weight);
        prim.operations.push(("xformOp:translate".to_owned(), triple(half * x * DVec3::X)));
        prim
    };
    let row = vec![
        ("custom double", "softbox:line:length", number(line.length)),
        ("custom double", "softbox:line:intensityPerMetre", number(strength)),
    ];
    let note =
        format!("is {ROW} balls of 1 mm in a row; the same light from a tenth of its length away; shadows have steps");
    Ok(Form { prims: rule.nodes().iter().map(ball).collect(), row, notes: vec![note] })
}

/// A point of that intensity.
fn ball_prim(intensity: f64) -> Prim {
    let attributes = [("float", "inputs:radius", THIN), ("bool", "treatAsPoint", 1.0)];
    Prim::new("SphereLight", intensity / (PI * THIN * THIN), &attributes)
}
