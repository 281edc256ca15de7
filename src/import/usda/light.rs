//! One light of a stage.

use std::f64::consts::{PI, TAU};

use glam::{DAffine3, DMat3, DVec2, DVec3, dvec2};

use super::prim::{Prim, Value};
use super::stage::{Found, Reader, has_light_api};
use crate::light::photometry::Photometry;
use crate::light::{
    Cap, Directional, Disk, Light, Line, LineEmission, Point, Polygon, Quantity, QuantityKind, Shape, Sphere, Textured,
    Tint, luminance_of, temperature_color,
};
use crate::math::frame::deg_from_rotation;
use crate::scene::{pattern_of_bytes, photometry_of_bytes};

/// Corners of an ellipse.
const ELLIPSE: u32 = 64;

/// How much lengths may differ and count as the same.
const SAME: f64 = 1e-6;

/// What shapes are made of: attributes in the stage's units, and how they are scaled in metres and in the stage.
pub(super) struct Sizes {
    /// Metres along each axis of a unit of the light's.
    pub(super) metres: DVec3,
    /// The stage's units along each axis of a unit of the light's.
    stage: DVec3,
}

/// A shape, and its area in the stage's units where it has one.
struct Shaped {
    shape: Shape,
    area: Option<f64>,
    /// What the luminance is multiplied by to be the quantity.
    kind: QuantityKind,
    factor: f64,
}

impl Shaped {
    fn area(shape: Shape, area: f64) -> Self {
        Self { shape, area: Some(area), kind: QuantityKind::Luminance, factor: 1.0 }
    }
}

impl Reader<'_> {
    /// The light of a prim; none where there is none like it here, with a remark.
    pub(super) fn light(&mut self, found: &Found<'_>) -> Option<Light> {
        let prim = found.prim;
        let world_from_light = self.world_from_stage() * found.stage_from_light;
        let (rotation, metres) = taken_apart(&world_from_light.matrix3);
        let (_, stage) = taken_apart(&found.stage_from_light.matrix3);
        if !world_from_light.is_finite() || metres.min_element() <= 0.0 {
            self.remark_on(prim, prim.line, "has no place in space, and is left out");
            return None;
        }
        if is_sheared(&world_from_light.matrix3) {
            self.remark_on(prim, prim.line, "is sheared; its axes are taken at right angles");
        }
        let sizes = Sizes { metres, stage };
        if prim.kind.starts_with("DomeLight") {
            return self.dome(found, rotation, self.strength(prim), self.tint(prim));
        }
        let position = tidy(world_from_light.translation);
        if prim.kind == "Mesh" {
            return self.mesh_light(found, &world_from_light);
        }
        let mut light = if prim.property("softbox:line:length").is_some() {
            self.row(prim, &sizes)?
        } else {
            let shaped = self.shape(prim, &sizes)?;
            let luminance = self.normalized(prim, self.strength(prim), shaped.area);
            let quantity = Quantity::new(shaped.kind, luminance * shaped.factor);
            Light { quantity, tint: self.tint(prim), ..Light::new("", shaped.shape) }
        };
        (light.position, light.rotation_deg) = (position, tidy(deg_from_rotation(rotation)));
        light.group = prim.group();
        self.remark_on_extras(prim);
        Some(light)
    }

    /// The shape of a prim that is no mesh and no dome.
    fn shape(&mut self, prim: &Prim, sizes: &Sizes) -> Option<Shaped> {
        let [x, y, z] = sizes.metres.to_array();
        let stage = sizes.stage;
        let number = |name: &str, default: f64| prim.number(name).unwrap_or(default).abs();
        match prim.kind.as_str() {
            "RectLight" => {
                let size = dvec2(number("width", 1.0), number("height", 1.0));
                let area = size.x * stage.x * size.y * stage.y;
                let in_metres = dvec2(length(size.x * x), length(size.y * y));
                if in_metres.min_element() <= 0.0 {
                    self.remark_on(prim, prim.line, "has no area, and is left out");
                    return None;
                }
                Some(Shaped::area(self.rectangle(prim, in_metres), area))
            }
            "DiskLight" => {
                let radius = number("radius", 0.5);
                let area = PI * radius * radius * stage.x * stage.y;
                if radius <= 0.0 {
                    self.remark_on(prim, prim.line, "has no area, and is left out");
                    return None;
                }
                let shape = if are_same(x, y) {
                    Shape::Disk(Disk { radius: length(radius * x), two_sided: false })
                } else {
                    self.remark_on(prim, prim.line, &format!("is an ellipse, here a polygon of {ELLIPSE} corners"));
                    ellipse(radius * dvec2(x, y))
                };
                Some(Shaped::area(shape, area))
            }
            "SphereLight" => {
                let radius = number("radius", 0.5);
                let is_point = prim.is_on("treatAsPoint");
                if radius <= 0.0 {
                    self.remark_on(prim, prim.line, "has a radius of 0 and so no area to shine; it is left out");
                    return None;
                }
                if !are_same(x, y) || !are_same(x, z) {
                    self.remark_on(prim, prim.line, "is an ellipsoid, here a sphere of its mean radius");
                }
                let mean = |scale: DVec3| radius * scale.element_sum() / 3.0;
                let (in_metres, in_stage) = (mean(sizes.metres), mean(stage));
                let area = 4.0 * PI * in_stage * in_stage;
                if is_point {
                    let ies = self.photometry(prim);
                    let peak = ies.as_ref().map_or(1.0, |photometry| photometry.distribution.peak());
                    let factor = PI * in_metres * in_metres * peak;
                    let shape = Shape::Point(Point { ies });
                    return Some(Shaped { shape, area: Some(area), kind: QuantityKind::Intensity, factor });
                }
                Some(Shaped::area(Shape::Sphere(Sphere { radius: length(in_metres) }), area))
            }
            "CylinderLight" => self.cylinder(prim, sizes),
            "DistantLight" => Some(self.distant(prim)),
            kind => {
                let what = if has_light_api(prim) || kind == "GeometryLight" {
                    "shines as a kind of geometry that is no light here; it is left out"
                } else {
                    "is no kind of light that is known here; it is left out"
                };
                self.remark_on(prim, prim.line, what);
                None
            }
        }
    }

    /// A rectangle, with its picture where it has one that can be read.
    fn rectangle(&mut self, prim: &Prim, size: DVec2) -> Shape {
        if let Some(property) = prim.input("texture:file")
            && let Some(file) = property.value.text().filter(|file| !file.is_empty())
        {
            let name = file.strip_prefix("./").unwrap_or(file);
            let own_name = name.rsplit('/').next().unwrap_or(name);
            let pattern = (self.read)(name)
                .map_err(|cause| format!("`{name}` cannot be read: {cause}"))
                .and_then(|bytes| pattern_of_bytes(&format!("textures/{own_name}"), bytes));
            match pattern {
                Ok(pattern) => return Shape::Textured(Textured { size, pattern, two_sided: false }),
                Err(cause) => self.remark_on(prim, property.line, &format!("loses its picture: {cause}")),
            }
        }
        let corner = |x: f64, y: f64| 0.5 * size * dvec2(x, y);
        let vertices = vec![corner(-1.0, -1.0), corner(1.0, -1.0), corner(1.0, 1.0), corner(-1.0, 1.0)];
        Shape::Polygon(Polygon { vertices, two_sided: false })
    }

    /// The photometric file of a point, where it has one that can be read.
    fn photometry(&mut self, prim: &Prim) -> Option<Photometry> {
        let property = prim.input("shaping:ies:file")?;
        let file = property.value.text().filter(|file| !file.is_empty())?;
        let name = file.strip_prefix("./").unwrap_or(file);
        let own_name = name.rsplit('/').next().unwrap_or(name);
        let photometry = (self.read)(name)
            .map_err(|cause| format!("`{name}` cannot be read: {cause}"))
            .and_then(|bytes| photometry_of_bytes(&format!("photometry/{own_name}"), bytes));
        if prim.is_on("shaping:ies:normalize")
            || prim.number("shaping:ies:angleScale").is_some_and(|scale| scale != 0.0)
        {
            self.remark_on(prim, property.line, "has its IES profile scaled, which is left out");
        }
        photometry.map_err(|cause| self.remark_on(prim, property.line, &format!("loses its IES profile: {cause}"))).ok()
    }

    /// A line that Softbox wrote as a row of balls; none where it does not say all of it.
    fn row(&mut self, prim: &Prim, sizes: &Sizes) -> Option<Light> {
        let number = |name: &str| prim.property(name).and_then(|property| property.value.number());
        let length = number("softbox:line:length").filter(|length| *length > 0.0)? * sizes.metres.x;
        let intensity = number("softbox:line:intensityPerMetre")?.max(0.0);
        let mut light = Light::new("", Shape::Line(Line::isotropic(self::length(length))));
        light.quantity = Quantity::new(QuantityKind::IntensityPerMetre, intensity);
        light.tint = self.tint(prim.children.first()?);
        Some(light)
    }

    /// A cylinder along X as a tube.
    fn cylinder(&mut self, prim: &Prim, sizes: &Sizes) -> Option<Shaped> {
        let number = |name: &str, default: f64| prim.number(name).unwrap_or(default).abs();
        let (length, radius) = (number("length", 1.0), number("radius", 0.5));
        let [x, y, z] = sizes.metres.to_array();
        let across = 0.5 * (y + z);
        let stage_across = 0.5 * (sizes.stage.y + sizes.stage.z);
        if length <= 0.0 || radius <= 0.0 {
            self.remark_on(prim, prim.line, "has no area, and is left out");
            return None;
        }
        let area = TAU * radius * stage_across * length * sizes.stage.x;
        if radius * across > 0.05 * length * x {
            self.remark_on(prim, prim.line, "is a thick cylinder, here a tube that is thin beside its distance");
        }
        let line = Line {
            emission: LineEmission::Tube,
            ..Line::tube(self::length(length * x), self::length(radius * across))
        };
        Some(Shaped::area(Shape::Line(line), area))
    }

    /// A distant light: directional without an angle, else a cap. `normalize` makes its intensity the illuminance.
    fn distant(&mut self, prim: &Prim) -> Shaped {
        let half_angle_deg = 0.5 * prim.number("angle").unwrap_or(0.53).abs();
        if half_angle_deg == 0.0 {
            let shape = Shape::Directional(Directional {});
            return Shaped { shape, area: None, kind: QuantityKind::Illuminance, factor: 1.0 };
        }
        if half_angle_deg > 90.0 {
            self.remark_on(prim, prim.line, "is wider than a hemisphere, to which it is cut here");
        }
        let cap = Cap { half_angle_deg: half_angle_deg.min(90.0) };
        let sine = half_angle_deg.min(180.0).to_radians().sin().powi(2);
        let size = if half_angle_deg <= 90.0 { sine * PI } else { (2.0 - sine) * PI };
        Shaped::area(Shape::Cap(cap), size)
    }

    /// intensity·2^exposure times the luminance of its colour.
    pub(super) fn strength(&self, prim: &Prim) -> f64 {
        let default = if prim.kind == "DistantLight" { 50_000.0 } else { 1.0 };
        let intensity = prim.number("intensity").unwrap_or(default).max(0.0);
        let strength = intensity * prim.number("exposure").unwrap_or(0.0).exp2() * luminance_of(color(prim));
        if strength.is_finite() { strength } else { 0.0 }
    }

    /// Divided by the area, where the light says so.
    pub(super) fn normalized(&self, prim: &Prim, luminance: f64, area: Option<f64>) -> f64 {
        match area {
            Some(area) if prim.is_on("normalize") && area > 0.0 => luminance / area,
            _ => luminance,
        }
    }

    /// The colour: a temperature where that is all.
    pub(super) fn tint(&self, prim: &Prim) -> Tint {
        let own = prim.input("color").and_then(|property| property.value.vector()).unwrap_or(DVec3::ONE);
        match temperature(prim) {
            Some(kelvin) if own == DVec3::splat(own.x) && own.x > 0.0 => Tint::TemperatureK(kelvin),
            _ if luminance_of(color(prim)) > 0.0 => Tint::Color(color(prim)),
            _ => Tint::default(),
        }
    }

    /// What a light says besides, and is not read.
    pub(super) fn remark_on_extras(&mut self, prim: &Prim) {
        for property in &prim.properties {
            let name = property.name.strip_prefix("inputs:").unwrap_or(&property.name);
            let is = |plain: f64| property.value.number().is_none_or(|value| value == plain);
            let what = match name {
                "shaping:cone:angle" if property.value.number().is_none_or(|angle| angle < 180.0) => "a cone",
                "shaping:focus" if !is(0.0) => "a focus",
                "shaping:ies:file" if !prim.is_on("treatAsPoint") => "an IES profile on what is no point",
                "shadow:enable" if !is(1.0) => "shadows switched off",
                "diffuse" | "specular" if !is(1.0) => "another strength for one kind of reflection",
                "light:filters" => "filters",
                "collection:lightLink:includes" | "collection:lightLink:excludes" => "links to surfaces",
                _ if name.ends_with(".connect") => "a connected input",
                _ if matches!(property.value, Value::Samples(_)) => {
                    self.remark_on(prim, property.line, "has an animated value, of which the first counts");
                    continue;
                }
                _ => continue,
            };
            self.remark_on(prim, property.line, &format!("has {what}, which is left out"));
        }
    }
}

/// The temperature of a light that has one.
fn temperature(prim: &Prim) -> Option<f64> {
    let kelvin = prim.number("colorTemperature").unwrap_or(6500.0).clamp(1000.0, 10_000.0);
    prim.is_on("enableColorTemperature").then_some(kelvin)
}

/// The light's colour with that of its temperature, whose luminance is 1.
fn color(prim: &Prim) -> DVec3 {
    let own = prim.input("color").and_then(|property| property.value.vector()).unwrap_or(DVec3::ONE).max(DVec3::ZERO);
    let warmth = temperature(prim).map_or(DVec3::ONE, |kelvin| Tint::Color(temperature_color(kelvin)).rgb());
    own * warmth
}

/// The rotation nearest to a matrix whose axes are at right angles, and the lengths of its axes. A mirror image is turned
/// about: lights are the same on both sides of their YZ plane.
fn taken_apart(matrix: &DMat3) -> (DMat3, DVec3) {
    let scale = DVec3::new(matrix.x_axis.length(), matrix.y_axis.length(), matrix.z_axis.length());
    let z = matrix.z_axis.normalize_or(DVec3::Z);
    let y = matrix.y_axis.reject_from_normalized(z).normalize_or(z.any_orthonormal_vector());
    (DMat3::from_cols(y.cross(z), y, z), scale)
}

/// Whether axes are not at right angles.
fn is_sheared(matrix: &DMat3) -> bool {
    let [x, y, z] = [matrix.x_axis, matrix.y_axis, matrix.z_axis].map(DVec3::normalize_or_zero);
    x.dot(y).abs().max(y.dot(z).abs()).max(z.dot(x).abs()) > SAME
}

/// Degrees or metres without the rounding of what they were computed from: to 1e-12.
pub(super) fn tidy(v: DVec3) -> DVec3 {
    (v * 1e12).round() / 1e12 + 0.0
}

/// A length in metres as [`tidy`] has it; one that is not longer than its rounding stays.
fn length(metres: f64) -> f64 {
    let rounded = (metres * 1e12).round() / 1e12;
    if rounded > 0.0 { rounded } else { metres }
}

fn are_same(a: f64, b: f64) -> bool {
    (a - b).abs() <= SAME * a.max(b)
}

/// An ellipse of the same area as a polygon.
fn ellipse(radii: DVec2) -> Shape {
    let step = TAU / f64::from(ELLIPSE);
    let scale = (PI / (0.5 * f64::from(ELLIPSE) * step.sin())).sqrt();
    let corner = |i: u32| scale * radii * DVec2::from_angle(step * f64::from(i));
    Shape::Polygon(Polygon { vertices: (0..ELLIPSE).map(corner).collect(), two_sided: false })
}

/// A frame's axes in metres, as a transform without scale.
pub(super) fn rigid(world_from_light: &DAffine3) -> (DMat3, DVec3) {
    taken_apart(&world_from_light.matrix3)
}
