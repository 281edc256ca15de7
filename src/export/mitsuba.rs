//! Mitsuba 3 scenes, as XML.
//!
//! Mitsuba takes radiance; the numbers are those of photometry, so that what it computes is in cd/m² and lx. Its
//! rectangle and disk face +Z, its cylinder has no caps, and a picture's first row lies at v = 0.

mod ply;
mod sky;
mod surfaces;
mod web;
mod xml;

use std::collections::BTreeSet;
use std::f64::consts::PI;

use glam::{DMat3, DMat4, DVec3};

use self::xml::Xml;
use super::emission::{SIDE_GAP, Side, has_body, outlines, radiances};
use super::exr;
use super::job::{Identifiers, number};
use super::preflight::without_variants;
use super::{ExportError, Exported, Fate, File, Job, Remark};
use crate::light::photometry::Distribution;
use crate::light::{Cap, Light, LineEmitter, Point, PolygonEmitter, Shape, Textured};
use crate::math::quadrature::GaussLegendre;
use crate::math::triangulate::ears;
use crate::render::Progress;
use crate::scene::{Camera, Scene};
use crate::surface::Triangle;

/// What the file says before the scene.
const UNITS: &str = "\n  Z is up, in metres. Radiance is in cd/m², irradiance in lx, intensity in cd.\n  \
    Softbox shows direct light only, as max_depth = 2 does; mitsuba -D max_depth=-1 adds what surfaces pass on.\n";

/// How far away the disk of a light is that is infinitely far away, metres.
const FAR: f64 = 1e5;

/// The widest cap that is a disk, half its angle in degrees.
const WIDEST_DISK_DEG: f64 = 75.0;

/// So many points stand for a line that emits the same in all directions.
const LINE_POINTS: usize = 64;

/// The scene as XML, with patterns as OpenEXR and meshes as PLY beside it.
pub(super) fn write(job: &Job, _progress: &Progress) -> Result<Exported, ExportError> {
    let (scene, remarks) = job.chosen_scene()?;
    let mut writer = Writer { job, xml: Xml::default(), files: Vec::new(), names: Identifiers::default(), remarks };
    writer.xml.open("scene", &[("version", "3.0.0")]);
    writer.frame(&scene);
    writer.lights(&scene.lights)?;
    writer.surfaces(&scene);
    writer.xml.close();
    writer.remarks.extend(without_variants(job.scene));
    let Writer { xml, files, remarks, .. } = writer;
    let mut head = Xml::default();
    head.comment(&format!("{}{UNITS}", job.header(&remarks, " ")));
    let text = head.text() + &xml.text();
    let files = [job.main_file(text)].into_iter().chain(files).collect();
    Ok(Exported { files, remarks })
}

struct Writer<'a> {
    job: &'a Job<'a>,
    xml: Xml,
    files: Vec<File>,
    names: Identifiers,
    remarks: Vec<Remark>,
}

impl Writer<'_> {
    /// How the scene is rendered and from where.
    fn frame(&mut self, scene: &Scene) {
        let [width, height] = self.job.options.size;
        self.xml.element("default", &[("name", "max_depth"), ("value", "2")]);
        self.xml.element("default", &[("name", "samples"), ("value", "256")]);
        self.xml.open("integrator", &[("type", "path")]);
        self.xml.value("integer", "max_depth", "$max_depth");
        self.xml.close();
        self.xml.open("sensor", &[("type", "perspective")]);
        self.camera(&scene.camera);
        self.xml.open("film", &[("type", "hdrfilm")]);
        self.xml.value("integer", "width", &width.to_string());
        self.xml.value("integer", "height", &height.to_string());
        self.xml.close();
        self.xml.open("sampler", &[("type", "multijitter")]);
        self.xml.value("integer", "sample_count", "$samples");
        self.xml.close();
        self.xml.close();
        let exposure = scene.display.exposure_ev;
        let what = format!("no exposure in Mitsuba: divide by 100 cd/m² and multiply by 2^{exposure} to see Softbox's");
        self.remarks.push(Remark::scene(Fate::Changed, what));
    }

    fn camera(&mut self, camera: &Camera) {
        let [_, up, _] = camera.axes();
        self.xml.value("string", "fov_axis", "y");
        self.xml.value("float", "fov", &number(camera.fov_deg));
        self.xml.open("transform", &[("name", "to_world")]);
        let [origin, target, up] = [camera.eye, camera.target, up].map(rgb);
        self.xml.element("lookat", &[("origin", &origin), ("target", &target), ("up", &up)]);
        self.xml.close();
    }

    fn surfaces(&mut self, scene: &Scene) {
        let used: BTreeSet<_> = scene.surfaces.iter().map(|surface| surface.material.as_str()).collect();
        for material in scene.materials.iter().filter(|material| used.contains(material.name.as_str())) {
            self.material(material);
        }
        for surface in &scene.surfaces {
            if let Some(material) = scene.material(&surface.material) {
                self.surface(surface, material);
            }
        }
    }

    fn lights(&mut self, lights: &[Light]) -> Result<(), ExportError> {
        for light in lights {
            if light.only.is_some() {
                let what = "lights every surface: Mitsuba does not link lights to surfaces";
                self.remarks.push(Remark::light(light, Fate::Changed, what));
            }
            self.xml.note(&format!("light: {}", light.name));
            let remark = self.light(light)?;
            self.remarks.push(remark);
        }
        let distant: Vec<_> = lights.iter().filter(|light| is_in_map(light)).collect();
        if !distant.is_empty() {
            self.xml.note("the surroundings");
            self.map(&distant)?;
        }
        let bodies = lights.iter().filter(|light| has_body(&light.emitter())).count();
        if bodies > 0 && lights.len() > 1 {
            let what = "areas and tubes of light cast shadows of other lights in Mitsuba; in Softbox they do not";
            self.remarks.push(Remark::scene(Fate::Changed, what));
        }
        Ok(())
    }

    /// A light, and what becomes of it.
    fn light(&mut self, light: &Light) -> Result<Remark, ExportError> {
        let kept = |what: &str| Remark::light(light, Fate::Kept, what);
        let changed = |what: &str| Remark::light(light, Fate::Changed, what);
        let by_sides = |two_sided: bool, what: &str| match two_sided {
            true => changed(&format!("{what}, twice, back to back and {} mm apart, for its two sides", 2e3 * SIDE_GAP)),
            false => kept(what),
        };
        Ok(match &light.shape {
            Shape::Polygon(polygon) => {
                let what = self.polygon(light, &polygon.place(&light.world_from_light()));
                by_sides(polygon.two_sided, &what)
            }
            Shape::Disk(disk) => {
                for side in Side::of_disk(light, disk.radius).with_other(disk.two_sided) {
                    self.flat("disk", light, &side);
                }
                by_sides(disk.two_sided, "a disk")
            }
            Shape::Textured(textured) => {
                let file = self.textured(light, textured)?;
                by_sides(textured.two_sided, &format!("a rectangle with its radiance in {file}"))
            }
            Shape::Sphere(sphere) => {
                self.xml.open("shape", &[("type", "sphere")]);
                self.ball(light.position, sphere.radius);
                self.emission(light.weight());
                self.xml.close();
                kept("a sphere")
            }
            Shape::Line(line) => self.line(light, &line.place(&light.world_from_light())),
            Shape::Cap(cap) if cap.half_angle_deg <= WIDEST_DISK_DEG => {
                self.far_disk(light, cap);
                changed(&format!("a disk {} km away, of the same angle", FAR / 1e3))
            }
            Shape::Cap(_) | Shape::Sky(_) => {
                let width = 360.0 / f64::from(sky::MAP_SIZE[0]);
                changed(&format!("in a picture of the surroundings with texels of {width}°"))
            }
            Shape::Point(Point { ies: Some(photometry) }) => {
                let count = self.projectors(light, &photometry.distribution)?;
                let texels = web::TEXELS;
                changed(&format!(
                    "{count} projectors in its place, of {texels}² intensities each, a third of a degree apart"
                ))
            }
            Shape::Point(Point { ies: None }) => {
                self.xml.open("emitter", &[("type", "point")]);
                self.xyz("point", "position", light.position);
                self.xml.value("rgb", "intensity", &rgb(light.weight()));
                self.xml.close();
                kept("a point")
            }
            Shape::Directional(_) => {
                self.xml.open("emitter", &[("type", "directional")]);
                self.xyz("vector", "direction", -light.world_from_light().matrix3.z_axis);
                self.xml.value("rgb", "irradiance", &rgb(light.weight()));
                self.xml.close();
                kept("parallel light")
            }
        })
    }

    /// A polygon: a rectangle, or a mesh beside the file. Says which.
    fn polygon(&mut self, light: &Light, polygon: &PolygonEmitter) -> String {
        if let Some(side) = Side::of_polygon(polygon) {
            for side in side.with_other(polygon.two_sided) {
                self.flat("rectangle", light, &side);
            }
            return "a rectangle".to_owned();
        }
        let triangles: Vec<_> = outlines(polygon)
            .iter()
            .flat_map(|outline| ears(outline).into_iter().map(|ear| ear.map(|corner| outline[corner])))
            .map(|corners| Triangle { corners, normals: None })
            .collect();
        let file = self.mesh_file(&light.name, &triangles);
        self.mesh(&file, false, |writer| writer.emission(light.weight()));
        format!("a mesh in {file}")
    }

    /// A line: a cylinder if it is a tube, points if not.
    fn line(&mut self, light: &Light, line: &LineEmitter) -> Remark {
        if line.falloff != 2.0 {
            let what =
                format!("falls as 1/r^{}, which no renderer of light does; give it a falloff of 2", line.falloff);
            return Remark::light(light, Fate::Lost, what);
        }
        if let Some(radius) = line.tube {
            self.xml.open("shape", &[("type", "cylinder")]);
            self.cylinder(line.a, line.b, radius);
            self.emission(light.weight());
            self.xml.close();
            return Remark::light(light, Fate::Changed, "a cylinder of its radius, which ends hide as a body does");
        }
        for (position, share) in line_points(line) {
            self.xml.open("emitter", &[("type", "point")]);
            self.xyz("point", "position", position);
            self.xml.value("rgb", "intensity", &rgb(share * light.weight()));
            self.xml.close();
        }
        let what =
            format!("{LINE_POINTS} points, within 0.1 % from a twentieth of its length away; shadows have steps");
        Remark::light(light, Fate::Changed, what)
    }

    /// A cap as a disk far away from the world's origin.
    fn far_disk(&mut self, light: &Light, cap: &Cap) {
        let emitter = cap.place(&light.world_from_light());
        let (x, y) = (-emitter.to_center).any_orthonormal_pair();
        let radius = FAR * emitter.half_angle.tan();
        self.flat("disk", light, &Side { center: FAR * emitter.to_center, x: radius * x, y: radius * y });
    }

    /// A pattern as a picture of its radiance, on its rectangle. Gives the picture's name.
    fn textured(&mut self, light: &Light, textured: &Textured) -> Result<String, ExportError> {
        let (size, texels) = radiances(light, textured);
        let file = self.picture(&light.name, size, &texels)?;
        // A turned side has its rows the other way round; v counts from the picture's foot.
        let sides = Side::of_textured(light, textured).with_other(textured.two_sided);
        for (side, along_row) in sides.iter().zip(["1", "-1"]) {
            self.xml.open("shape", &[("type", "rectangle")]);
            self.transform(&side.world_from_square());
            self.black();
            self.xml.open("emitter", &[("type", "area")]);
            self.xml.open("texture", &[("name", "radiance"), ("type", "bitmap")]);
            self.xml.value("string", "filename", &file);
            self.xml.value("string", "filter_type", "nearest");
            self.xml.open("transform", &[("name", "to_uv")]);
            self.xml.element("scale", &[("x", along_row), ("y", "-1")]);
            self.xml.close();
            self.xml.close();
            self.xml.close();
            self.xml.close();
        }
        Ok(file)
    }

    /// A point of measured intensities: projectors for the sides of a cube about it that get light. Gives their number.
    ///
    /// A projector's picture is its illuminance at a distance of 1 divided by π (as Mitsuba 3.9.1 was seen to take it).
    fn projectors(&mut self, light: &Light, distribution: &Distribution) -> Result<usize, ExportError> {
        let lit = |side: DMat3| (side, web::irradiance(distribution, &side));
        let sides = web::sides().map(lit).into_iter().filter(|(_, irradiance)| irradiance.iter().any(|x| *x > 0.0));
        let world_from_light = light.world_from_light();
        let mut count = 0;
        for (side, irradiance) in sides {
            count += 1;
            let texels: Vec<_> = irradiance.iter().map(|share| *share / PI * light.weight()).collect();
            let file = self.picture(&format!("{} {count}", light.name), [web::TEXELS; 2], &texels)?;
            self.xml.open("emitter", &[("type", "projector")]);
            let axes = world_from_light.matrix3 * side;
            self.transform(&DMat4::from_mat3_translation(axes, world_from_light.translation));
            self.xml.value("float", "fov", "90");
            self.xml.open("texture", &[("name", "irradiance"), ("type", "bitmap")]);
            self.xml.value("string", "filename", &file);
            self.xml.value("string", "wrap_mode", "clamp");
            self.xml.close();
            self.xml.close();
        }
        Ok(count)
    }

    /// Skies and wide caps, all in one picture: Mitsuba has but one.
    fn map(&mut self, lights: &[&Light]) -> Result<(), ExportError> {
        let file = self.picture("surroundings", sky::MAP_SIZE, &sky::map(lights))?;
        self.xml.open("emitter", &[("type", "envmap")]);
        self.xml.value("string", "filename", &file);
        self.transform(&sky::world_from_map());
        self.xml.close();
        Ok(())
    }

    /// A rectangle or disk of the light's radiance.
    fn flat(&mut self, kind: &str, light: &Light, side: &Side) {
        self.xml.open("shape", &[("type", kind)]);
        self.transform(&side.world_from_square());
        self.emission(light.weight());
        self.xml.close();
    }

    /// The current shape emits, and reflects nothing.
    fn emission(&mut self, radiance: DVec3) {
        self.black();
        self.xml.open("emitter", &[("type", "area")]);
        self.xml.value("rgb", "radiance", &rgb(radiance));
        self.xml.close();
    }

    fn black(&mut self) {
        self.xml.open("bsdf", &[("type", "diffuse")]);
        self.xml.value("rgb", "reflectance", "0");
        self.xml.close();
    }

    fn ball(&mut self, center: DVec3, radius: f64) {
        self.xyz("point", "center", center);
        self.xml.value("float", "radius", &number(radius));
    }

    fn cylinder(&mut self, from: DVec3, to: DVec3, radius: f64) {
        self.xyz("point", "p0", from);
        self.xyz("point", "p1", to);
        self.xml.value("float", "radius", &number(radius));
    }

    fn xyz(&mut self, kind: &'static str, name: &str, v: DVec3) {
        let [x, y, z] = v.to_array().map(number);
        self.xml.element(kind, &[("name", name), ("x", &x), ("y", &y), ("z", &z)]);
    }

    fn transform(&mut self, world_from_shape: &DMat4) {
        let rows = world_from_shape.transpose().to_cols_array().map(number).join(" ");
        self.xml.open("transform", &[("name", "to_world")]);
        self.xml.element("matrix", &[("value", &rows)]);
        self.xml.close();
    }

    /// A mesh of a file; flat unless it has normals.
    fn mesh(&mut self, file: &str, has_normals: bool, look: impl FnOnce(&mut Self)) {
        self.xml.open("shape", &[("type", "ply")]);
        self.xml.value("string", "filename", file);
        self.xml.value("boolean", "face_normals", if has_normals { "false" } else { "true" });
        look(self);
        self.xml.close();
    }

    /// Puts triangles beside the main file; gives the file's name.
    fn mesh_file(&mut self, name: &str, triangles: &[Triangle]) -> String {
        let identifier = self.names.of(name);
        self.put(self.job.file_beside(&identifier, "ply", ply::ply(triangles, self.job.origin())))
    }

    /// Puts a picture beside the main file; gives the file's name.
    fn picture(&mut self, name: &str, size: [u32; 2], texels: &[DVec3]) -> Result<String, ExportError> {
        let wrong = |cause| ExportError::Encode { what: format!("the picture of {name}"), cause: Box::new(cause) };
        let bytes = exr::radiance(size, texels, self.job.origin()).map_err(wrong)?;
        let identifier = self.names.of(name);
        Ok(self.put(self.job.file_beside(&identifier, "exr", bytes)))
    }

    fn put(&mut self, file: File) -> String {
        let name = file.name.clone();
        self.files.push(file);
        name
    }
}

/// Whether a light goes into the picture of the surroundings.
fn is_in_map(light: &Light) -> bool {
    match light.shape {
        Shape::Sky(_) => true,
        Shape::Cap(cap) => cap.half_angle_deg > WIDEST_DISK_DEG,
        _ => false,
    }
}

/// The points that stand for a line, and the length that each stands for: Gauss and Legendre's.
fn line_points(line: &LineEmitter) -> Vec<(DVec3, f64)> {
    let half = 0.5 * line.length();
    let rule = GaussLegendre::new(LINE_POINTS);
    rule.nodes().iter().map(|(x, weight)| (line.a.lerp(line.b, 0.5 * (x + 1.0)), half * weight)).collect()
}

/// A colour or a vector as a list of its three numbers.
fn rgb(v: DVec3) -> String {
    v.to_array().map(number).join(", ")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::light::Line;

    #[test]
    fn points_stand_for_a_line_from_a_twentieth_of_its_length() {
        let light = Light::new("line", Shape::Line(Line::isotropic(2.0)));
        let Shape::Line(line) = &light.shape else { panic!("a line") };
        let line = line.place(&light.world_from_light());
        for i in 0..=40 {
            let p = DVec3::new(0.06 * f64::from(i), 0.1, 0.0);
            let falloff = |position: DVec3| 0.1 / (position - p).length().powi(3);
            let sum: f64 = line_points(&line).iter().map(|(position, share)| share * falloff(*position)).sum();
            let end = |x: f64| (x - p.x) / (x - p.x).hypot(0.1) / 0.1;
            let exact = end(1.0) - end(-1.0);
            assert!((sum / exact - 1.0).abs() < 1e-3, "{sum} instead of {exact} at {p}");
        }
    }
}
