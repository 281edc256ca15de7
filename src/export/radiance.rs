//! Radiance scenes.
//!
//! Radiance counts in W/(sr·m²) and takes a watt for 179 lm: luminances are divided by that, so that its own tools show
//! cd/m² and lx. Its direct calculation aims at rectangles, disks, spheres and cylinders; other outlines are `glow`, which
//! interreflection finds. Both shine to the side of their normal only.

mod picture;
mod surfaces;

use std::f64::consts::{PI, TAU};
use std::fmt::Write as _;

use glam::{DMat3, DVec3};

use super::emission::{SIDE_GAP, Side, has_body, outlines, radiances};
use super::job::{Identifiers, number};
use super::preflight::without_variants;
use super::{ExportError, Exported, Fate, File, Job, Remark};
use crate::light::{Cap, CapEmitter, Light, LineEmitter, PolygonEmitter, Shape, SkyEmitter, Textured, Web};
use crate::render::Progress;
use crate::scene::Scene;

/// Lumens that Radiance takes a watt for.
const EFFICACY: f64 = 179.0;

/// The radius of the cylinder that stands for a line, and of the ball that stands for a point, in metres.
const THIN: f64 = 1e-3;

/// Half the angle of a source that stands for parallel light, in degrees.
const PARALLEL_DEG: f64 = 0.005;

/// The widest source that Radiance's direct calculation aims at, half its angle in degrees: its illuminance is then right
/// within 0.05 %.
const WIDEST_AIMED_DEG: f64 = 2.5;

/// Steps of a table of intensities, about nadir and from it.
const WEB_STEPS: [u32; 2] = [144, 180];

const FUNCTIONS: &str = include_str!("radiance/functions.cal");

/// The scene, with functions, a view and pictures beside it.
pub(super) fn write(job: &Job, _progress: &Progress) -> Result<Exported, ExportError> {
    let (scene, remarks) = job.chosen_scene()?;
    let origin = job.origin().line();
    // Braces end comments of functions.
    let functions = format!("{{ {} }}\n{FUNCTIONS}", origin.replace(['{', '}'], " "));
    let functions = job.file_beside("functions", "cal", functions);
    let view = job.file_beside("view", "vf", format!("# {origin}\n{}", view(&scene)));
    let mut writer = Writer {
        job,
        text: String::new(),
        functions: quoted(&functions.name),
        names: Identifiers::default(),
        files: vec![functions, view],
        remarks,
    };
    writer.lights(&scene.lights);
    writer.surfaces(&scene);
    writer.remarks.extend(without_variants(job.scene));
    let Writer { text, files, remarks, .. } = writer;
    let head = job.header(&remarks, "#");
    let units = "#\n# Z is up, in metres; W/(sr.m2) of 179 lm, so that luminance -1 and falsecolor show cd/m2, and\n\
        # rtrace -I times 179 is lx. Softbox shows direct light only: -ab 0, or -ab 1 where something glows.\n";
    let files = [job.main_file(head + units + &text)].into_iter().chain(files).collect();
    Ok(Exported { files, remarks })
}

/// The camera as a view file.
fn view(scene: &Scene) -> String {
    let camera = &scene.camera;
    let [_, up, _] = camera.axes();
    // A picture of 4 to 3 is as wide as this.
    let across = 2.0 * (4.0 / 3.0 * (0.5 * camera.fov_deg.to_radians()).tan()).atan().to_degrees();
    let [eye, along, up] = [camera.eye, camera.target - camera.eye, up].map(xyz);
    format!("rvu -vtv -vp {eye} -vd {along} -vu {up} -vh {} -vv {}\n", number(across), number(camera.fov_deg))
}

struct Writer<'a> {
    job: &'a Job<'a>,
    text: String,
    /// The name of the file of functions, as arguments give it.
    functions: String,
    names: Identifiers,
    files: Vec<File>,
    remarks: Vec<Remark>,
}

/// How Radiance finds a light.
#[derive(Clone, Copy)]
enum Kind {
    /// Its direct calculation aims at it.
    Aimed,
    /// Rays of its interreflection find it.
    Found,
}

impl Writer<'_> {
    fn lights(&mut self, lights: &[Light]) {
        for light in lights {
            if light.only.is_some() {
                let what = "lights every surface: Radiance does not link lights to surfaces";
                self.remarks.push(Remark::light(light, Fate::Changed, what));
            }
            let seen = picture::seen_luminance(light.weight());
            if (seen - 1.0).abs() >= 5e-4 {
                let what =
                    format!("its colour is kept; Radiance's own weights see a luminance of {seen:.3} times its own");
                self.remarks.push(Remark::light(light, Fate::Changed, what));
            }
            let remark = self.light(light);
            self.remarks.push(remark);
        }
        if lights.len() > 1 && lights.iter().any(|light| has_body(&light.emitter())) {
            let what = "areas and tubes of light cast shadows of other lights in Radiance; in Softbox they do not";
            self.remarks.push(Remark::scene(Fate::Changed, what));
        }
    }

    /// A light, and what becomes of it.
    fn light(&mut self, light: &Light) -> Remark {
        let kept = |what: &str| Remark::light(light, Fate::Kept, what);
        let changed = |what: &str| Remark::light(light, Fate::Changed, what);
        let by_sides = |two_sided: bool, what: &str| match two_sided {
            true => changed(&format!("{what}, twice, back to back and {} mm apart, for its two sides", 2e3 * SIDE_GAP)),
            false => kept(what),
        };
        let name = self.names.of(&light.name);
        let _ = writeln!(self.text, "\n# light: {}", super::job::one_line(&light.name));
        let world_from_light = light.world_from_light();
        let z_axis = world_from_light.matrix3.z_axis;
        match &light.shape {
            Shape::Polygon(polygon) => self.polygon(light, &name, &polygon.place(&world_from_light)),
            Shape::Disk(disk) => {
                let material = self.emission(&name, "void", Kind::Aimed, light.weight());
                for side in Side::of_disk(light, disk.radius).with_other(disk.two_sided) {
                    let shape = format!("{} {} 0 {}", xyz(side.center), xyz(side.normal()), number(disk.radius));
                    self.primitive(&material, "ring", &name, &[], &shape);
                }
                by_sides(disk.two_sided, "a ring without a hole")
            }
            Shape::Textured(textured) => {
                let file = self.textured(light, &name, textured);
                by_sides(textured.two_sided, &format!("a rectangle with {file}, whose texels are right within 0.4 %"))
            }
            Shape::Sphere(sphere) => {
                let material = self.emission(&name, "void", Kind::Aimed, light.weight());
                let shape = format!("{} {}", xyz(light.position), number(sphere.radius));
                self.primitive(&material, "sphere", &name, &[], &shape);
                changed("a sphere; its shadows are hard unless rtrace or rpict has -dj 0.5 to 1")
            }
            Shape::Line(line) => self.line(light, &name, &line.place(&world_from_light)),
            Shape::Cap(cap) => {
                let CapEmitter { to_center, .. } = cap.place(&world_from_light);
                self.cap(light, &name, cap, to_center)
            }
            Shape::Sky(sky) => {
                let SkyEmitter { zenith, uniform, cosine } = sky.place(&world_from_light);
                let arguments = format!("{} {} {}", xyz(zenith), number(uniform), number(cosine));
                let pattern = self.pattern(&name, "brightfunc", &["sky_light"], &arguments);
                let material = self.emission(&name, &pattern, Kind::Found, light.weight());
                self.primitive(&material, "source", &name, &[], &format!("{} 180", xyz(zenith)));
                kept("a glowing source, which interreflection finds: -ab 1 or more")
            }
            Shape::Point(point) => {
                let web = point.place(&world_from_light).web;
                let pattern = web.as_ref().map(|web| self.web(&name, web, &world_from_light.matrix3));
                let radiance = light.weight() / (PI * THIN * THIN);
                let material = self.emission(&name, pattern.as_deref().unwrap_or("void"), Kind::Aimed, radiance);
                self.primitive(&material, "sphere", &name, &[], &format!("{} {}", xyz(light.position), number(THIN)));
                let table = if web.is_some() { ", from a table of 1° by 2.5°" } else { "" };
                changed(&format!("a ball with a radius of {} mm, of its intensity{table}", 1e3 * THIN))
            }
            Shape::Directional(_) => {
                let sin = PARALLEL_DEG.to_radians().sin();
                let material = self.emission(&name, "void", Kind::Aimed, light.weight() / (PI * sin * sin));
                let shape = format!("{} {}", xyz(z_axis), number(2.0 * PARALLEL_DEG));
                self.primitive(&material, "source", &name, &[], &shape);
                changed(&format!("a source {}° wide, of its illuminance", 2.0 * PARALLEL_DEG))
            }
        }
    }

    fn polygon(&mut self, light: &Light, name: &str, polygon: &PolygonEmitter) -> Remark {
        let is_rectangle = Side::of_polygon(polygon).is_some();
        let kind = if is_rectangle { Kind::Aimed } else { Kind::Found };
        let material = self.emission(name, "void", kind, light.weight());
        for outline in outlines(polygon) {
            self.face(&material, name, &outline);
        }
        let mut what =
            if is_rectangle { "a rectangle" } else { "a glowing polygon, which interreflection finds: -ab 1 or more" }
                .to_owned();
        if polygon.two_sided {
            let _ = write!(what, "; twice, back to back and {} mm apart, for its two sides", 2e3 * SIDE_GAP);
        }
        let is_kept = is_rectangle && !polygon.two_sided;
        Remark::light(light, if is_kept { Fate::Kept } else { Fate::Changed }, what)
    }

    /// A pattern on its rectangle. Gives the picture's name.
    fn textured(&mut self, light: &Light, name: &str, textured: &Textured) -> String {
        let (size, texels) = radiances(light, textured);
        let picture::Picture { bytes, size: [columns, rows], gain } =
            picture::picture(size, &texels, self.job.origin());
        let file = self.job.file_beside(name, "hdr", bytes);
        let file_name = file.name.clone();
        self.files.push(file);
        let side = Side::of_textured(light, textured);
        let [foot, along_row, up] = [side.center - side.x - side.y, 2.0 * side.x, 2.0 * side.y];
        let per_length = |edge: DVec3| xyz(edge / edge.length_squared());
        let arguments = format!("{} {} {} {columns} {rows}", xyz(foot), per_length(along_row), per_length(up));
        let functions = self.functions.clone();
        let pattern = format!("{name}_pattern");
        let strings = ["red", "green", "blue", &quoted(&file_name), &functions, "texel_u", "texel_v"];
        self.primitive("void", "colorpict", &pattern, &strings, &arguments);
        let material = self.emission(name, &pattern, Kind::Aimed, gain);
        for side in side.with_other(textured.two_sided) {
            self.face(&material, name, &side.corners());
        }
        file_name
    }

    fn line(&mut self, light: &Light, name: &str, line: &LineEmitter) -> Remark {
        let axis = (line.b - line.a).normalize_or_zero();
        let falloff = number(line.falloff);
        let physical = line.falloff == 2.0;
        let (radius, radiance, pattern, what) = match line.tube {
            Some(radius) if physical => (radius, 1.0, None, "a cylinder of its radius".to_owned()),
            Some(_) => {
                let what =
                    format!("a tube that falls as 1/r^{falloff}, which Radiance cannot hold; give it a falloff of 2");
                return Remark::light(light, Fate::Lost, what);
            }
            None => {
                let what =
                    format!("a cylinder with a radius of {} mm, its radiance by direction as the line's", 1e3 * THIN);
                (THIN, 0.5 / THIN, Some(format!("{} {falloff}", xyz(axis))), what)
            }
        };
        let pattern = pattern
            .map_or("void".to_owned(), |arguments| self.pattern(name, "brightfunc", &["line_light"], &arguments));
        let material = self.emission(name, &pattern, Kind::Aimed, radiance * light.weight());
        let shape = format!("{} {} {}", xyz(line.a), xyz(line.b), number(radius));
        self.primitive(&material, "cylinder", name, &[], &shape);
        Remark::light(light, Fate::Changed, what)
    }

    fn cap(&mut self, light: &Light, name: &str, cap: &Cap, to_center: DVec3) -> Remark {
        let is_aimed = cap.half_angle_deg <= WIDEST_AIMED_DEG;
        let kind = if is_aimed { Kind::Aimed } else { Kind::Found };
        let material = self.emission(name, "void", kind, light.weight());
        let shape = format!("{} {}", xyz(to_center), number(2.0 * cap.half_angle_deg));
        self.primitive(&material, "source", name, &[], &shape);
        let what = if is_aimed {
            "a source; its shadows are hard unless rtrace or rpict has -dj 0.5 to 1"
        } else {
            "a glowing source, which interreflection finds: -ab 1 or more"
        };
        Remark::light(light, if is_aimed { Fate::Changed } else { Fate::Kept }, what)
    }

    /// A pattern of intensities, as shares of the greatest: a table by the angle from nadir and the one about it, from +X.
    /// Gives its name.
    fn web(&mut self, name: &str, web: &Web, axes: &DMat3) -> String {
        let [turns, tilts] = WEB_STEPS;
        let mut table = format!("# {}\n2\n0 360 {}\n0 180 {}\n", self.job.origin().line(), turns + 1, tilts + 1);
        for turn in 0..=turns {
            let (sin, cos) = (TAU * f64::from(turn % turns) / f64::from(turns)).sin_cos();
            for tilt in 0..=tilts {
                let (across, down) = (PI * f64::from(tilt) / f64::from(tilts)).sin_cos();
                let share = web.distribution.share(DVec3::new(across * cos, across * sin, -down));
                let _ = writeln!(table, "{}", number(share));
            }
        }
        let file = self.job.file_beside(name, "dat", table);
        let pattern = format!("{name}_pattern");
        let (data, functions) = (quoted(&file.name), self.functions.clone());
        self.files.push(file);
        let words = ["same", &data, &functions, "web_turn", "web_tilt"];
        let [x, y, z] = [axes.x_axis, axes.y_axis, axes.z_axis].map(xyz);
        self.primitive("void", "brightdata", &pattern, &words, &format!("{x} {y} {z}"));
        pattern
    }

    /// A material that shines with a luminance, in cd/m², times a pattern. Gives its name.
    fn emission(&mut self, name: &str, pattern: &str, kind: Kind, luminance: DVec3) -> String {
        let material = format!("{name}_light");
        let rgb = xyz(luminance / EFFICACY);
        match kind {
            Kind::Aimed => self.primitive(pattern, "light", &material, &[], &rgb),
            Kind::Found => self.primitive(pattern, "glow", &material, &[], &format!("{rgb} 0")),
        }
        material
    }

    /// A pattern by one of the functions. Gives its name.
    fn pattern(&mut self, name: &str, kind: &str, functions: &[&str], arguments: &str) -> String {
        let pattern = format!("{name}_pattern");
        let file = self.functions.clone();
        let strings: Vec<_> = functions.iter().copied().chain([file.as_str()]).collect();
        self.primitive("void", kind, &pattern, &strings, arguments);
        pattern
    }

    /// A polygon, counter-clockwise for who looks at its front.
    fn face(&mut self, material: &str, name: &str, corners: &[DVec3]) {
        let numbers: Vec<_> = corners.iter().map(|corner| xyz(*corner)).collect();
        self.primitive(material, "polygon", name, &[], &numbers.join("  "));
    }

    /// A primitive of Radiance's, with its arguments of words and of numbers.
    fn primitive(&mut self, modifier: &str, kind: &str, name: &str, words: &[&str], numbers: &str) {
        let count = numbers.split_whitespace().count();
        let words: String = words.iter().map(|word| format!(" {word}")).collect();
        let word_count = words.split_whitespace().count();
        let _ = writeln!(self.text, "{modifier} {kind} {name}\n{word_count}{words}\n0\n{count} {numbers}");
    }
}

/// Three numbers, apart by spaces.
fn xyz(v: DVec3) -> String {
    v.to_array().map(number).join(" ")
}

/// A word as arguments give it.
fn quoted(word: &str) -> String {
    if word.contains(char::is_whitespace) { format!("\"{word}\"") } else { word.to_owned() }
}
