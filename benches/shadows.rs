//! Exact shadows against dense ray casting, for each pair of light shape and occluder shape.
//!
//! `cargo bench --no-default-features --bench shadows [-- --points 200 --rays 1000000 --light NAME --occluder NAME]`.
//! Prints the worst difference of the shares of E and of S (Phong, m = 32) that are seen, over points around an occluder
//! of random placement, within it too. Rays are spread evenly over the light: where K edges of shadows cross it, the
//! share by rays is itself unsure by about K/rays of a line, K/√rays of an area.

use std::env;
use std::f64::consts::TAU;
use std::sync::Arc;

use glam::{DVec2, DVec3};
use rayon::prelude::*;
use softbox::light::pattern::{Channel, Image, Pattern};
use softbox::light::{
    Cap, Disk, Emitter, Light, Line, Polygon, PolygonEmitter, Shape as LightShape, Sky, Sphere, Textured,
};
use softbox::render::{Lighting, MethodChoice, Reflection};
use softbox::scene::Scene;
use softbox::shading::{
    Lobe, Method, Response, ShadingPoint,
    point::{direction_response, point_response},
};
use softbox::surface::{Bounds, Material, Shape, Surface};
use softbox::visibility::{Objects, Structure};

const EXPONENT: f64 = 32.0;

/// A highlight that is fainter than this beside E has no share that could be told from rounding.
const FAINT: f64 = 1e-6;

/// Where lights hang.
const CEILING: DVec3 = DVec3::new(0.3, -0.2, 3.0);

/// A light, and the i-th of n points spread evenly over it with what that point alone does.
struct Row {
    name: &'static str,
    shape: LightShape,
    sample: Sample,
}

type Sample = fn(&Emitter, &ShadingPoint, &Lobe, u32, u32) -> (DVec3, Response);

/// The lights that are measured. A new one is a line here and the function that spreads points over it.
fn lights() -> Vec<Row> {
    let polygon = |corners: &[[f64; 2]]| {
        LightShape::Polygon(Polygon { vertices: corners.iter().copied().map(DVec2::from).collect(), two_sided: false })
    };
    let rectangle = polygon(&[[-1.0, -0.5], [1.0, -0.5], [1.0, 0.5], [-1.0, 0.5]]);
    let arrow = polygon(&[[-1.0, -0.8], [0.2, 0.0], [-1.0, 0.8], [1.0, 0.0]]);
    let spot = |u: f64, v: f64| if (u - 0.3).hypot(v - 0.6) < 0.35 { 1.0 + 2.0 * u } else { 0.0 };
    let channel = Channel::of_shares(32, 24, spot).expect("a pattern");
    let pattern = Pattern::of_image("spot.png", Image::Grey(Arc::new(channel)));
    let size = DVec2::new(2.0, 1.5);
    vec![
        Row { name: "line", shape: LightShape::Line(Line::isotropic(4.0)), sample: on_line },
        Row { name: "rectangle", shape: rectangle, sample: on_polygon },
        Row { name: "arrow", shape: arrow, sample: on_polygon },
        Row { name: "disk", shape: LightShape::Disk(Disk { radius: 0.8, two_sided: false }), sample: on_disk },
        Row { name: "sphere", shape: LightShape::Sphere(Sphere { radius: 0.5 }), sample: on_sphere },
        Row {
            name: "textured",
            shape: LightShape::Textured(Textured { size, pattern, two_sided: false }),
            sample: on_texels,
        },
        Row { name: "cap", shape: LightShape::Cap(Cap { half_angle_deg: 15.0 }), sample: in_cap },
        Row { name: "sky", shape: LightShape::Sky(Sky::OVERCAST), sample: in_sky },
    ]
}

/// What casts shadows. A new shape is a line here.
fn occluders() -> Vec<(&'static str, Shape)> {
    vec![
        ("plane", Shape::Plane {}),
        ("square", Shape::Square { size: DVec2::new(1.4, 1.0) }),
        ("disk", Shape::Disk { radius: 0.7 }),
        ("box", Shape::Box { size: DVec3::new(1.0, 0.8, 1.2) }),
        ("sphere", Shape::Sphere { radius: 0.6 }),
        ("cylinder", Shape::Cylinder { radius: 0.5, height: 1.1 }),
        ("cone", Shape::Cone { radius: 0.6, height: 1.2 }),
        ("patch", Shape::Patch { control_points: Box::new(std::array::from_fn(bent)) }),
        ("sphereflake", Shape::Sphereflake { depth: 2 }),
        ("tetrahedron", Shape::Tetrahedron { depth: 2 }),
    ]
}

/// A control point of a patch that is bent both ways.
fn bent(i: usize) -> DVec3 {
    let at = spread(u32::try_from(i).unwrap_or_default(), 0.1);
    DVec3::new((i % 4) as f64 * 0.4 - 0.6, (i / 4) as f64 * 0.4 - 0.6, 0.8 * (at.z - 0.5))
}

fn main() {
    let points: u32 = option("--points").map_or(200, |count| count.parse().expect("a number of points"));
    let rays: u32 = option("--rays").map_or(1_000_000, |count| count.parse().expect("a number of rays"));
    let (light, occluder) = (option("--light"), option("--occluder"));
    let wanted = |filter: &Option<String>, name: &str| filter.as_deref().is_none_or(|wanted| wanted == name);
    println!("{points} points, {rays} rays a point");
    println!("{:<10} {:<12} {:>12} {:>12} {:>10}", "light", "occluder", "worst of E", "worst of S", "penumbra");
    for row in lights().iter().filter(|row| wanted(&light, row.name)) {
        for (name, shape) in occluders().into_iter().filter(|(name, _)| wanted(&occluder, name)) {
            let worst =
                (0..points).into_par_iter().map(|i| compare(row, &shape, i, rays)).reduce(Worst::default, Worst::and);
            let Worst { differences: [diffuse, specular], partly } = worst;
            println!("{:<10} {name:<12} {diffuse:>12.2e} {specular:>12.2e} {partly:>10}", row.name);
        }
    }
}

/// What follows a flag on the command line.
fn option(flag: &str) -> Option<String> {
    env::args().skip_while(|word| word != flag).nth(1)
}

/// The worst differences, and at how many points a light was seen in part.
#[derive(Clone, Copy, Default)]
struct Worst {
    differences: [f64; 2],
    partly: u32,
}

impl Worst {
    fn and(self, other: Self) -> Self {
        let [a, b] = [self.differences, other.differences];
        Self { differences: [a[0].max(b[0]), a[1].max(b[1])], partly: self.partly + other.partly }
    }
}

/// The i-th point under a light with one occluder, which is placed anew for each point.
fn compare(row: &Row, shape: &Shape, i: u32, rays: u32) -> Worst {
    let light = Light { position: CEILING, ..Light::new("light", row.shape.clone()) };
    let (at, surface) = (shading_point(i), placed(shape, i));
    let objects = Arc::new(Objects::new(std::slice::from_ref(&surface), Structure::Every));
    let exact = exact_shares(&light, &objects, &at);
    let (dense, is_faint) = dense_shares(row, &light.emitter(), &objects, &at, rays);
    let partly = u32::from(dense[0] > 0.0 && dense[0] < 1.0);
    let [diffuse, specular] = [0, 1].map(|part| (exact[part] - dense[part]).abs());
    Worst { differences: [diffuse, if is_faint { 0.0 } else { specular }], partly }
}

/// The shares of E and S that are seen, exactly.
fn exact_shares(light: &Light, objects: &Arc<Objects>, at: &ShadingPoint) -> [f64; 2] {
    let scene = Scene { lights: vec![light.clone()], ..Scene::default() };
    let open = Lighting::new(&scene, MethodChoice::Method(Method::Exact));
    let shadowed = open.clone().with_shadows(objects);
    let glossy = Material {
        name: "glossy".to_owned(),
        diffuse: DVec3::ZERO,
        specular: DVec3::ONE,
        model: Default::default(),
        exponent: EXPONENT,
    };
    let [whole, seen] = [open, shadowed].map(|lighting| lighting.outgoing(&Reflection::new(&glossy), at));
    [share(seen.irradiance.x, whole.irradiance.x), share(seen.radiance.x, whole.radiance.x)]
}

/// The same by rays, and whether S is too faint beside E to tell its share.
fn dense_shares(row: &Row, emitter: &Emitter, objects: &Objects, at: &ShadingPoint, rays: u32) -> ([f64; 2], bool) {
    let lobe = Lobe::new(EXPONENT);
    let (mut whole, mut seen) = (Response::default(), Response::default());
    for i in 0..rays {
        let (position, response) = (row.sample)(emitter, at, &lobe, i, rays);
        whole += response;
        if response.irradiance > 0.0 && !objects.hides(at.p, position - at.p) {
            seen += response;
        }
    }
    let shares = [share(seen.irradiance, whole.irradiance), share(seen.specular, whole.specular)];
    (shares, whole.specular < FAINT * whole.irradiance)
}

/// 1 of nothing.
fn share(seen: f64, whole: f64) -> f64 {
    if whole > 0.0 { seen / whole } else { 1.0 }
}

/// Middles of equal pieces of a line.
fn on_line(emitter: &Emitter, at: &ShadingPoint, lobe: &Lobe, i: u32, n: u32) -> (DVec3, Response) {
    let Emitter::Line(line) = emitter else { panic!("a line is sampled") };
    let position = line.a.lerp(line.b, (f64::from(i) + 0.5) / f64::from(n));
    (position, point_response(position - at.p, 1.0, at, lobe))
}

/// Points of a disk, each of the same area.
fn on_disk(emitter: &Emitter, at: &ShadingPoint, lobe: &Lobe, i: u32, n: u32) -> (DVec3, Response) {
    let Emitter::Disk(disk) = emitter else { panic!("a disk is sampled") };
    let [share, turn] = even(i, n);
    let (x, y) = disk.normal.any_orthonormal_pair();
    let (sin, cos) = (TAU * turn).sin_cos();
    facing(disk.center + disk.radius * share.sqrt() * (cos * x + sin * y), disk.normal, 1.0, at, lobe)
}

/// Points of a sphere, each of the same area.
fn on_sphere(emitter: &Emitter, at: &ShadingPoint, lobe: &Lobe, i: u32, n: u32) -> (DVec3, Response) {
    let Emitter::Sphere(sphere) = emitter else { panic!("a sphere is sampled") };
    let normal = about(DVec3::Z, even(i, n), 2.0);
    facing(sphere.center + sphere.radius * normal, normal, 1.0, at, lobe)
}

/// Points of a rectangle, each of the same area.
fn on_texels(emitter: &Emitter, at: &ShadingPoint, lobe: &Lobe, i: u32, n: u32) -> (DVec3, Response) {
    let Emitter::Textured(light) = emitter else { panic!("a textured light is sampled") };
    let [u, v] = even(i, n);
    facing(light.point(u, v), light.normal, light.pattern.value(u, v), at, lobe)
}

/// Directions of a cap, each of the same solid angle.
fn in_cap(emitter: &Emitter, at: &ShadingPoint, lobe: &Lobe, i: u32, n: u32) -> (DVec3, Response) {
    let Emitter::Cap(cap) = emitter else { panic!("a cap is sampled") };
    endless(about(cap.to_center, even(i, n), 1.0 - cap.half_angle.cos()), 1.0, at, lobe)
}

/// Directions of a hemisphere, each of the same solid angle.
fn in_sky(emitter: &Emitter, at: &ShadingPoint, lobe: &Lobe, i: u32, n: u32) -> (DVec3, Response) {
    let Emitter::Sky(sky) = emitter else { panic!("a sky is sampled") };
    let w = about(sky.zenith, even(i, n), 1.0);
    endless(w, sky.radiance(w), at, lobe)
}

/// What a point of a luminous surface does, all points being of the same area.
fn facing(position: DVec3, normal: DVec3, luminance: f64, at: &ShadingPoint, lobe: &Lobe) -> (DVec3, Response) {
    let to_light = position - at.p;
    let cosine = -normal.dot(to_light.normalize()).min(0.0);
    (position, point_response(to_light, luminance * cosine, at, lobe))
}

/// What comes from a direction, all directions being of the same solid angle; its light is far beyond all occluders.
fn endless(w: DVec3, luminance: f64, at: &ShadingPoint, lobe: &Lobe) -> (DVec3, Response) {
    (at.p + 1e9 * w, direction_response(w, luminance, at.n, at.mirror(), lobe))
}

/// The direction about an axis at a share of the height of its cap and of the way round.
fn about(axis: DVec3, [share, turn]: [f64; 2], height: f64) -> DVec3 {
    let (x, y) = axis.any_orthonormal_pair();
    let cos = 1.0 - height * share;
    let (sin_turn, cos_turn) = (TAU * turn).sin_cos();
    cos * axis + (1.0 - cos * cos).max(0.0).sqrt() * (cos_turn * x + sin_turn * y)
}

/// The i-th of n points spread evenly over the unit square: a lattice of the golden ratio.
fn even(i: u32, n: u32) -> [f64; 2] {
    [(f64::from(i) + 0.5) / f64::from(n), (0.5 + 0.618_033_988_749_895 * f64::from(i)).fract()]
}

/// Points of the box about a level polygon; those beside it do nothing.
fn on_polygon(emitter: &Emitter, at: &ShadingPoint, lobe: &Lobe, i: u32, n: u32) -> (DVec3, Response) {
    let Emitter::Polygon(polygon) = emitter else { panic!("a polygon is sampled") };
    let Bounds { min, max } = Bounds::about(&polygon.vertices);
    let [x, y] = even(i, n);
    let position = min + DVec3::new(x, y, 0.0) * (max - min);
    let luminance = if is_over(polygon, position) { 1.0 } else { 0.0 };
    facing(position, polygon.normal, luminance, at, lobe)
}

/// Whether a point is over a level polygon, by the parity of the edges on one side of it.
fn is_over(polygon: &PolygonEmitter, q: DVec3) -> bool {
    let next = polygon.vertices.iter().cycle().skip(1);
    let crossed = polygon.vertices.iter().zip(next).filter(|(a, b)| {
        let (a, b) = ((**a - q).truncate(), (**b - q).truncate());
        (a.y > 0.0) != (b.y > 0.0) && (a.perp_dot(b) > 0.0) == (b.y > a.y)
    });
    crossed.count() % 2 == 1
}

/// The i-th point of the R₃ sequence (M. Roberts, 2018) with an offset, in the unit cube.
fn spread(i: u32, offset: f64) -> DVec3 {
    let i = f64::from(i);
    DVec3::new(0.819_172_513, 0.671_043_607, 0.549_700_478).map(|step| (offset + step * (i + 1.0)).fract())
}

/// Of each four points three on the ground and one anywhere about the occluder, with normals tilted by up to 45°.
fn shading_point(i: u32) -> ShadingPoint {
    let mut p = 3.0 * (spread(i, 0.0) - 0.5);
    p.z = if i.is_multiple_of(4) { p.z * 0.5 + 1.0 } else { 0.0 };
    let n = (DVec3::Z + (spread(i, 0.3) - 0.5)).normalize();
    let v = (DVec3::Z + 2.0 * (spread(i, 0.7) - 0.5)).normalize();
    ShadingPoint { p, n, v }
}

/// An occluder about (0, 0, 1), turned and stretched.
fn placed(shape: &Shape, i: u32) -> Surface {
    Surface {
        name: "occluder".to_owned(),
        material: "any".to_owned(),
        position: DVec3::Z + 0.5 * (spread(i, 0.2) - 0.5),
        rotation_deg: 360.0 * spread(i, 0.4),
        scale: 0.6 + spread(i, 0.6),
        shape: shape.clone(),
    }
}
