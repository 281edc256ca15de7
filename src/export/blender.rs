//! Blender scripts.
//!
//! Blender counts in watts; the numbers are those of photometry, so that what it renders is in cd/m². An area lamp shines
//! π·A·L, a ball 4π²r²·L, a sun its illuminance. Both faces of a mesh that emits do, so that its material says which.

mod surfaces;

use std::f64::consts::PI;
use std::fmt::Write as _;

use glam::{DMat3, DMat4, DVec3};

use super::emission::{Side, radiances};
use super::exr;
use super::intensities::Intensities;
use super::job::{Identifiers, number};
use super::preflight::without_variants;
use super::{ExportError, Exported, Fate, File, Job, Remark};
use crate::light::photometry::Photometry;
use crate::light::{Cap, Light, LineEmitter, Point, PolygonEmitter, Shape, Textured};
use crate::math::triangulate::ears;
use crate::render::Progress;
use crate::scene::Camera;

/// What the script defines before it builds the scene.
const PRELUDE: &str = include_str!("blender/prelude.py");

/// The radius of the cylinder that stands for a line, in metres.
const THIN: f64 = 1e-3;

/// The scene as a script, with patterns as OpenEXR beside it.
pub(super) fn write(job: &Job, _progress: &Progress) -> Result<Exported, ExportError> {
    let (scene, remarks) = job.chosen_scene()?;
    let mut writer = Writer { job, text: String::new(), names: Identifiers::default(), files: Vec::new(), remarks };
    let name = if scene.name.is_empty() { job.scene_name } else { &scene.name };
    let _ = writeln!(writer.text, "scene = start({}, {})", text(name), number(scene.display.exposure_ev));
    writer.camera(&scene.camera);
    writer.surfaces(&scene);
    for light in &scene.lights {
        let remark = writer.light(light)?;
        writer.remarks.push(remark);
    }
    writer.text.push_str("link_lights()\n");
    writer
        .remarks
        .push(Remark::scene(Fate::Kept, "camera, exposure and tone curve; rendered by Cycles, direct light only"));
    writer.remarks.extend(without_variants(job.scene));
    let Writer { text, files, remarks, .. } = writer;
    let head = job.header(&remarks, "#");
    let units =
        "#\n# blender --python FILE, or Scripting > Run Script. Z is up, in metres. A watt stands for a lumen.\n\n";
    let files = [job.main_file(format!("{head}{units}{PRELUDE}\n\n{text}"))].into_iter().chain(files).collect();
    Ok(Exported { files, remarks })
}

struct Writer<'a> {
    job: &'a Job<'a>,
    text: String,
    names: Identifiers,
    files: Vec<File>,
    remarks: Vec<Remark>,
}

impl Writer<'_> {
    /// A call of one of the script's functions.
    fn call(&mut self, function: &str, arguments: &[String]) {
        let _ = writeln!(self.text, "{function}({})", arguments.join(", "));
    }

    fn camera(&mut self, camera: &Camera) {
        let [right, up, back] = camera.axes();
        let frame = frame(DMat3::from_cols(right, up, back), camera.eye);
        let [width, height] = self.job.options.size;
        self.call("camera", &[frame, number(camera.fov_deg.to_radians()), width.to_string(), height.to_string()]);
    }

    /// A light, and what becomes of it.
    fn light(&mut self, light: &Light) -> Result<Remark, ExportError> {
        let kept = |what: &str| Ok(Remark::light(light, Fate::Kept, what));
        let changed = |what: &str| Ok(Remark::light(light, Fate::Changed, what));
        let world = light.world_from_light();
        let weight = light.weight();
        let in_place = frame(world.matrix3, world.translation);
        match &light.shape {
            Shape::Polygon(polygon) => {
                let polygon = polygon.place(&world);
                match Side::of_polygon(&polygon) {
                    Some(side) if !polygon.two_sided => {
                        self.area_lamp(light, &side, "RECTANGLE", 4.0 * side.x.length() * side.y.length());
                        kept("an area lamp")
                    }
                    _ => {
                        self.polygon(light, &polygon);
                        kept("a mesh that emits")
                    }
                }
            }
            Shape::Disk(disk) if disk.two_sided => {
                let side = Side::of_disk(light, disk.radius);
                let mesh = format!("disk({}, {})", text(&light.name), number(disk.radius));
                self.emitter(light, &mesh, &side_frame(&side), &[("two_sided", "True")]);
                changed("a mesh of 256 sides that emits")
            }
            Shape::Disk(disk) => {
                let side = Side::of_disk(light, disk.radius);
                self.area_lamp(light, &side, "DISK", PI * disk.radius * disk.radius);
                kept("an area lamp")
            }
            Shape::Textured(textured) => {
                let file = self.textured(light, textured)?;
                kept(&format!("a mesh that emits {file}"))
            }
            Shape::Sphere(sphere) => {
                let power = 4.0 * PI * PI * sphere.radius * sphere.radius * weight;
                let radius = ("shadow_soft_size", number(sphere.radius));
                self.lamp(light, "POINT", &in_place, power, &[radius, ("use_soft_falloff", "False".to_owned())]);
                kept("a point lamp of its radius")
            }
            Shape::Line(line) => {
                self.line(light, &line.place(&world), &in_place);
                changed(&match line.tube_radius() {
                    Some(_) => "a cylinder of 64 sides that emits".to_owned(),
                    None => format!("a cylinder with a radius of {} mm that emits alike in all directions", 1e3 * THIN),
                })
            }
            Shape::Cap(cap) => {
                self.sun(light, cap);
                kept("a sun lamp of its angle")
            }
            Shape::Sky(sky) => {
                let zenith = world.matrix3.z_axis;
                self.call("sky", &[tuple(zenith), tuple(weight), number(sky.uniform), number(sky.cosine)]);
                kept("in the world's shader")
            }
            Shape::Point(Point { ies: Some(photometry) }) => {
                let file = self.web(light, photometry, &in_place);
                changed(&format!("a point lamp with {file}, its intensities by even steps, as Blender blends them"))
            }
            Shape::Point(Point { ies: None }) => {
                self.lamp(light, "POINT", &in_place, 4.0 * PI * weight, &[("shadow_soft_size", "0.0".to_owned())]);
                kept("a point lamp")
            }
            Shape::Directional(_) => {
                self.lamp(light, "SUN", &in_place, weight, &[("angle", "0.0".to_owned())]);
                kept("a sun lamp without an angle")
            }
        }
    }

    fn area_lamp(&mut self, light: &Light, side: &Side, shape: &str, area: f64) {
        let (x, y) = (2.0 * side.x.length(), 2.0 * side.y.length());
        let properties = [("shape", text(shape)), ("size", number(x)), ("size_y", number(y))];
        self.lamp(light, "AREA", &lamp_frame(side), PI * area * light.weight(), &properties);
    }

    /// A cap: a sun's strength is its illuminance.
    fn sun(&mut self, light: &Light, cap: &Cap) {
        let cap = cap.place(&light.world_from_light());
        let (x, y) = cap.to_center.any_orthonormal_pair();
        let frame = frame(DMat3::from_cols(x, y, cap.to_center), light.position);
        let power = cap.illuminance() * light.weight();
        self.lamp(light, "SUN", &frame, power, &[("angle", number(2.0 * cap.half_angle))]);
    }

    fn lamp(&mut self, light: &Light, kind: &str, frame: &str, power: DVec3, properties: &[(&str, String)]) {
        let mut arguments = vec![text(&light.name), text(kind), frame.to_owned(), linked(light), tuple(power)];
        arguments.extend(properties.iter().map(|(key, value)| format!("{key}={value}")));
        self.call("lamp", &arguments);
    }

    /// A polygon in the world: triangles, as its outline need not be convex.
    fn polygon(&mut self, light: &Light, polygon: &PolygonEmitter) {
        let points: Vec<_> = polygon.vertices.iter().map(|vertex| tuple(*vertex)).collect();
        let ears: Vec<_> = ears(&polygon.vertices).iter().map(|[a, b, c]| format!("({a}, {b}, {c})")).collect();
        let mesh = format!("polygons({}, [{}], [{}])", text(&light.name), points.join(", "), ears.join(", "));
        let identity = frame(DMat3::IDENTITY, DVec3::ZERO);
        self.emitter(light, &mesh, &identity, &[("two_sided", python(polygon.two_sided))]);
    }

    /// A pattern as a picture of its radiance, on its rectangle. Gives the picture's name.
    fn textured(&mut self, light: &Light, textured: &Textured) -> Result<String, ExportError> {
        let (size, texels) = radiances(light, textured);
        let wrong =
            |cause| ExportError::Encode { what: format!("the picture of {}", light.name), cause: Box::new(cause) };
        let bytes = exr::radiance(size, &texels, self.job.origin()).map_err(wrong)?;
        let file = self.job.file_beside(&self.names.of(&light.name), "exr", bytes);
        let name = file.name.clone();
        self.files.push(file);
        let side = Side::of_textured(light, textured);
        let extent = format!("({}, {})", number(textured.size.x), number(textured.size.y));
        let mesh = format!("rectangle({}, {extent})", text(&light.name));
        let picture = text(&name);
        self.emitter(
            light,
            &mesh,
            &side_frame(&side),
            &[("two_sided", python(textured.two_sided)), ("picture", &picture)],
        );
        Ok(name)
    }

    /// A line: a thin cylinder along X.
    fn line(&mut self, light: &Light, line: &LineEmitter, in_place: &str) {
        let radius = line.tube.unwrap_or(THIN);
        let mesh = format!("cylinder({}, {}, {})", text(&light.name), number(line.length()), number(radius));
        let falloff = number(line.falloff);
        let axis = tuple((line.b - line.a).normalize_or_zero());
        let mut properties = vec![("falloff", falloff.as_str())];
        if line.tube.is_none() {
            properties.push(("axis", &axis));
        }
        // An isotropic line's intensity per metre is 2r times the radiance across it.
        let per_strength = if line.tube.is_some() { 1.0 } else { 0.5 / THIN };
        self.emitter_of(light, per_strength * light.weight(), &mesh, in_place, &properties);
    }

    /// A point lamp with an IES file of shares of the greatest intensity. Gives the file's name.
    fn web(&mut self, light: &Light, photometry: &Photometry, in_place: &str) -> String {
        let Intensities { gammas, planes, shares } = Intensities::of(&photometry.distribution);
        let line = |numbers: &[f64]| numbers.iter().map(|x| number(*x)).collect::<Vec<_>>().join("\r\n") + "\r\n";
        let counts = format!("1 -1 1 {} {} 1 2 0 0 0", gammas.len(), planes.len());
        let head = format!("IESNA:LM-63-2002\r\n[OTHER] {}\r\nTILT=NONE\r\n", self.job.origin().line());
        let table: String = [&gammas, &planes, &shares].map(|numbers| line(numbers)).concat();
        let bytes = format!("{head}{counts}\r\n1 1 0\r\n{table}");
        let file = self.job.file_beside(&self.names.of(&light.name), "ies", bytes);
        let name = file.name.clone();
        self.files.push(file);
        let arguments = [text(&light.name), in_place.to_owned(), linked(light), tuple(light.weight()), text(&name)];
        self.call("web", &arguments);
        name
    }

    fn emitter(&mut self, light: &Light, mesh: &str, frame: &str, properties: &[(&str, &str)]) {
        self.emitter_of(light, light.weight(), mesh, frame, properties);
    }

    fn emitter_of(&mut self, light: &Light, radiance: DVec3, mesh: &str, frame: &str, properties: &[(&str, &str)]) {
        let mut arguments = vec![text(&light.name), mesh.to_owned(), frame.to_owned(), linked(light), tuple(radiance)];
        arguments.extend(properties.iter().map(|(key, value)| format!("{key}={value}")));
        self.call("emitter", &arguments);
    }
}

/// The surfaces that a light is linked to; all where there is no list.
fn linked(light: &Light) -> String {
    light.only.as_ref().map_or("None".to_owned(), |names| {
        format!("[{}]", names.iter().map(|name| text(name)).collect::<Vec<_>>().join(", "))
    })
}

/// A frame whose +Z is a side's normal.
fn side_frame(side: &Side) -> String {
    let (x, y) = (side.x.normalize_or_zero(), side.y.normalize_or_zero());
    frame(DMat3::from_cols(x, y, side.normal()), side.center)
}

/// A frame whose −Z is a side's normal.
fn lamp_frame(side: &Side) -> String {
    let (x, y) = (side.x.normalize_or_zero(), side.y.normalize_or_zero());
    frame(DMat3::from_cols(x, -y, -side.normal()), side.center)
}

/// A matrix, row by row.
fn frame(axes: DMat3, origin: DVec3) -> String {
    let rows = DMat4::from_mat3_translation(axes, origin).transpose();
    let row = |v: glam::DVec4| format!("({})", v.to_array().map(number).join(", "));
    format!("({}, {}, {}, {})", row(rows.x_axis), row(rows.y_axis), row(rows.z_axis), row(rows.w_axis))
}

fn tuple(v: DVec3) -> String {
    format!("({})", v.to_array().map(number).join(", "))
}

/// A text as Python reads it.
fn text(text: &str) -> String {
    serde_json::Value::from(text).to_string()
}

fn python(truth: bool) -> &'static str {
    if truth { "True" } else { "False" }
}
