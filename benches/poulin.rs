//! The tables of POULIN_AMANATIDES_1990 for this program, beside the paper's own.
//!
//! `cargo bench --no-default-features --bench poulin`. Each time is of a whole CPU picture on one core, the least of
//! several rounds through all pictures of a table.

use std::time::{Duration, Instant};

use glam::{DVec2, DVec3};
use softbox::light::{Light, Line, Point, Shape as LightShape};
use softbox::render::{MethodChoice, Progress, Settings, Shadows, render};
use softbox::scene::{Camera, Scene};
use softbox::shading::Method;
use softbox::surface::{Material, ReflectionModel, Shape, Surface};
use softbox::visibility::{Structure, Structures};

fn main() {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build();
    pool.expect("a pool of one thread").install(|| {
        linear_against_points();
        light_triangle();
        linear_light_buffer();
    });
}

/// A picture that is timed.
struct Picture {
    scene: Scene,
    settings: Settings,
}

/// The least time of each picture, in seconds.
fn times(pictures: &[Picture], rounds: u32) -> Vec<f64> {
    let mut least = vec![Duration::MAX; pictures.len()];
    for _ in 0..rounds {
        for (picture, least) in pictures.iter().zip(&mut least) {
            let start = Instant::now();
            let film = render(&picture.scene, &picture.settings, &Progress::default());
            *least = start.elapsed().min(*least);
            assert!(film.is_some(), "nobody cancelled");
        }
    }
    least.iter().map(Duration::as_secs_f64).collect()
}

fn settings(size: [u32; 2], method: Method, shadows: Shadows) -> Settings {
    Settings { size, choice: MethodChoice::Method(method), samples: 1, shadows }
}

fn material(name: &str, exponent: f64) -> Material {
    Material {
        name: name.to_owned(),
        diffuse: DVec3::splat(0.5),
        specular: DVec3::splat(0.3),
        model: ReflectionModel::Phong {},
        exponent,
    }
}

fn surface(name: &str, position: DVec3, scale: f64, shape: Shape) -> Surface {
    Surface {
        name: name.to_owned(),
        material: name.to_owned(),
        position,
        rotation_deg: DVec3::ZERO,
        scale: DVec3::splat(scale),
        shape,
    }
}

fn light(position: DVec3, shape: LightShape) -> Light {
    Light { position, ..Light::new("light", shape) }
}

// Table I.

/// The paper's fixed cost, cost of a point light, and point lights that cost as much as a line.
type Fit = [f64; 3];

/// A primitive with what the paper has for it: shading only, and with shadows.
struct Row {
    name: &'static str,
    shape: Shape,
    paper: [Fit; 2],
}

/// Pixels and rounds of table I.
const SIZE_1: [u32; 2] = [160, 120];
const ROUNDS_1: u32 = 9;

/// Numbers of point lights that a straight line is fitted to.
const POINT_LIGHTS: [u32; 4] = [0, 3, 7, 12];

/// Of the linear light, and how high it lies above the primitive.
const LENGTH: f64 = 10.0;
const ABOVE: f64 = 5.0;

/// The primitives, of about equal shadows.
fn rows() -> Vec<Row> {
    let row = |name, shape, paper| Row { name, shape, paper };
    vec![
        row("Square", Shape::Square { size: DVec2::splat(1.8) }, [[0.39, 0.14, 4.36], [0.16, 0.10, 8.35]]),
        row("Cube", Shape::Box { size: DVec3::splat(1.6) }, [[0.34, 0.11, 6.00], [0.15, 0.10, 8.50]]),
        row("Sphere", Shape::Sphere { radius: 1.0 }, [[0.31, 0.11, 6.27], [0.16, 0.10, 8.40]]),
        row("Disk", Shape::Disk { radius: 1.0 }, [[0.40, 0.14, 4.29], [0.09, 0.06, 16.28]]),
        row("Patch", patch(), [[0.50, 0.08, 6.25], [0.06, 0.04, 23.50]]),
    ]
}

/// A square that is bent up in its middle.
fn patch() -> Shape {
    let along = |i: usize| i as f64 * 0.6 - 0.9;
    let point = |i: usize| {
        let (column, row) = (i % 4, i / 4);
        let middle = [column, row].iter().filter(|i| (1..=2).contains(*i)).count();
        DVec3::new(along(column), along(row), 0.25 * middle as f64)
    };
    Shape::Patch { control_points: Box::new(std::array::from_fn(point)) }
}

/// A primitive 1 m above a plane, and these lights 5 m above it.
fn above_a_plane(shape: &Shape, lights: Vec<Light>) -> Scene {
    Scene {
        camera: Camera { eye: DVec3::new(2.6, -8.4, 4.3), target: DVec3::new(0.0, 0.35, 1.35), fov_deg: 29.0 },
        materials: vec![material("plane", 32.0), material("primitive", 64.0)],
        surfaces: vec![
            surface("plane", DVec3::ZERO, 1.0, Shape::Plane {}),
            surface("primitive", DVec3::Z * (1.0 + below(shape)), 1.0, shape.clone()),
        ],
        lights,
        ..Scene::default()
    }
}

/// How far a shape reaches below its own origin.
fn below(shape: &Shape) -> f64 {
    match shape {
        Shape::Sphere { radius } => *radius,
        Shape::Box { size } => 0.5 * size.z,
        _ => 0.0,
    }
}

fn linear_against_points() {
    println!(
        "Table I: linear vs points. Shares of the picture's time with one linear light; the paper's in brackets.\n"
    );
    println!("{:8} {:9}  {:^49}  {:^49}", "", "", "Shading Only", "Shading and Shadowing");
    let columns = format!("{:^32} {:^16}", "Function", "Equivalent");
    println!("{:8} {:9}  {columns}  {columns}", "Primitive", "Line by");
    for row in rows() {
        let fits = [Shadows::None, Shadows::default()].map(|shadows| fits(&row.shape, shadows));
        for (i, method) in LINE_METHODS.iter().enumerate() {
            let name = if i == 0 { row.name } else { "" };
            let cells = [0, 1].map(|shadows| cell(fits[shadows][i], row.paper[shadows]));
            println!("{name:8} {:9}  {}  {}", method.to_string(), cells[0], cells[1]);
        }
    }
    println!();
}

/// His approximate line, and the closed form.
const LINE_METHODS: [Method; 2] = [Method::CHEBYSHEV, Method::Exact];

fn cell([fixed, each, equivalent]: Fit, paper: Fit) -> String {
    let [paper_fixed, paper_each, paper_equivalent] = paper;
    format!(
        "{fixed:.2} + {each:.2} l ({paper_fixed:.2} + {paper_each:.2} l)   {equivalent:5.2} ({paper_equivalent:5.2})"
    )
}

/// By each method of the line: what a picture costs without lights and for each point light, as shares of the time with
/// the line, and how many point lights cost as much as the line.
fn fits(shape: &Shape, shadows: Shadows) -> [Fit; 2] {
    let line = |method| Picture {
        scene: above_a_plane(shape, vec![overhead(0.0, LightShape::Line(Line::isotropic(LENGTH)))]),
        settings: settings(SIZE_1, method, shadows),
    };
    let points = |count| Picture {
        scene: above_a_plane(
            shape,
            (0..count).map(|i| overhead(place(i, count), LightShape::Point(Point::default()))).collect(),
        ),
        settings: settings(SIZE_1, Method::Exact, shadows),
    };
    let pictures: Vec<_> = LINE_METHODS.map(line).into_iter().chain(POINT_LIGHTS.map(points)).collect();
    let times = times(&pictures, ROUNDS_1);
    let (of_lines, of_points) = times.split_at(LINE_METHODS.len());
    let (fixed, each) = straight_line(&POINT_LIGHTS.map(f64::from), of_points);
    [0, 1].map(|i| [fixed / of_lines[i], each / of_lines[i], (of_lines[i] - fixed) / each])
}

fn overhead(x: f64, shape: LightShape) -> Light {
    light(DVec3::new(x, 0.0, 1.0 + 2.0 + ABOVE), shape)
}

/// The middle of the i-th of equal parts of the line.
fn place(i: u32, count: u32) -> f64 {
    LENGTH * ((f64::from(i) + 0.5) / f64::from(count) - 0.5)
}

/// Value at 0 and slope of the straight line of least squares.
fn straight_line(x: &[f64], y: &[f64]) -> (f64, f64) {
    let n = x.len() as f64;
    let (mean_x, mean_y) = (x.iter().sum::<f64>() / n, y.iter().sum::<f64>() / n);
    let along: f64 = x.iter().zip(y).map(|(x, y)| (x - mean_x) * (y - mean_y)).sum();
    let slope = along / x.iter().map(|x| (x - mean_x).powi(2)).sum::<f64>();
    (mean_y - slope * mean_x, slope)
}

// Tables II and III.

/// Pixels and rounds of tables II and III.
const SIZE_2: [u32; 2] = [240, 180];
const ROUNDS_2: u32 = 2;

const DATABASES: [&str; 2] = ["flakes", "tetrahedron"];

/// 91 spheres over a square, or 4096 triangles, below a line.
fn database(name: &str) -> Scene {
    let mut scene = Scene {
        camera: Camera { eye: DVec3::new(2.1, 1.3, 1.7), target: DVec3::ZERO, fov_deg: 45.0 },
        materials: vec![material("flakes", 64.0), material("tetrahedron", 64.0), material("square", 32.0)],
        lights: vec![light(DVec3::Z * 2.5, LightShape::Line(Line::isotropic(2.0)))],
        ..Scene::default()
    };
    if name == DATABASES[0] {
        scene.surfaces.push(surface(name, DVec3::ZERO, 1.0, Shape::Sphereflake { depth: 2 }));
        let square = Shape::Square { size: DVec2::splat(24.0) };
        scene.surfaces.push(surface("square", DVec3::Z * -0.5, 1.0, square));
    } else {
        scene.surfaces.push(surface(name, DVec3::ZERO, 2.0, Shape::Tetrahedron { depth: 5 }));
    }
    scene
}

/// The times of a database with each of these structures.
fn times_with(database_name: &str, structures: &[Structures]) -> Vec<f64> {
    let picture = |&structures| Picture {
        scene: database(database_name),
        settings: settings(SIZE_2, Method::CHEBYSHEV, Shadows::Cast(structures)),
    };
    times(&structures.iter().map(picture).collect::<Vec<_>>(), ROUNDS_2)
}

const VOXELS: [u32; 6] = [5, 10, 15, 20, 25, 50];

/// By database: light triangle inactive, active.
const PAPER_2: [[[f64; 6]; 2]; 2] = [
    [[1.0000, 0.9059, 0.9022, 0.8863, 0.8742, 0.8629], [1.2342, 0.7969, 0.9722, 0.8245, 0.8696, 1.5742]],
    [[1.0000, 0.8926, 0.8719, 0.8657, 0.8615, 0.8642], [1.2532, 0.5239, 0.2925, 0.2689, 0.2385, 0.3740]],
];

fn light_triangle() {
    println!(
        "Table II: light triangle. Times as shares of that with a grid of 5³ for rays only; the paper's in brackets.\n"
    );
    println!(
        "{:12} {:9} {}{:^17}",
        "Database",
        "Triangle",
        VOXELS.map(|n| format!("{:^17}", format!("{n}³"))).concat(),
        "hierarchy"
    );
    let structures: Vec<_> = VOXELS.map(Structure::Grid).into_iter().chain([Structure::Hierarchy]).collect();
    for (database, paper) in DATABASES.iter().zip(&PAPER_2) {
        let inactive = structures.iter().map(|&rays| Structures { rays, shadows: Structure::Every });
        let active = structures.iter().map(|&structure| Structures::from(structure));
        let times = times_with(database, &inactive.chain(active).collect::<Vec<_>>());
        let times_of_first = times[0];
        for (name, (times, paper)) in ["inactive", "active"].iter().zip(times.chunks(structures.len()).zip(paper)) {
            println!("{database:12} {name:9} {}", beside(times, times_of_first, paper));
        }
    }
    println!();
}

const BUFFER_ROWS: [u32; 7] = [1, 5, 10, 15, 20, 25, 50];
const SECTIONS: [u32; 7] = [1, 24, 36, 72, 144, 360, 720];

/// By database and grid, over sections.
const PAPER_3: [[[f64; 7]; 7]; 2] = [
    [
        [1.0000, 0.6656, 0.6291, 0.5751, 0.5505, 0.5332, 0.5281],
        [1.0270, 0.6834, 0.6449, 0.5916, 0.5678, 0.5471, 0.5497],
        [0.9304, 0.5809, 0.5446, 0.4876, 0.4676, 0.4479, 0.4466],
        [0.9266, 0.5782, 0.5392, 0.4858, 0.4644, 0.4449, 0.4411],
        [0.9103, 0.5606, 0.5229, 0.4796, 0.4481, 0.4280, 0.4258],
        [0.8979, 0.5486, 0.5112, 0.4688, 0.4347, 0.4156, 0.4130],
        [0.8863, 0.5366, 0.4974, 0.4579, 0.4212, 0.4031, 0.3990],
    ],
    [
        [1.0000, 0.9732, 0.9508, 0.9425, 0.9236, 0.9120, 0.9127],
        [0.1429, 0.0455, 0.0410, 0.0359, 0.0333, 0.0318, 0.0314],
        [0.1275, 0.0303, 0.0256, 0.0206, 0.0180, 0.0166, 0.0160],
        [0.1246, 0.0418, 0.0227, 0.0177, 0.0151, 0.0138, 0.0132],
        [0.1237, 0.0384, 0.0223, 0.0168, 0.0142, 0.0128, 0.0123],
        [0.1231, 0.0341, 0.0214, 0.0163, 0.0138, 0.0122, 0.0117],
        [0.1235, 0.0534, 0.0209, 0.0159, 0.0133, 0.0118, 0.0114],
    ],
];

fn linear_light_buffer() {
    println!(
        "Table III: linear light buffer. Times as shares of that with one section and no grid; the paper's in brackets.\n"
    );
    let sections = SECTIONS.map(|n| format!("{n:^17}")).concat();
    println!("{:12} {:9} {sections}{:^9}", "Database", "Rays by", "hierarchy");
    let rays: Vec<_> = BUFFER_ROWS.map(grid).into_iter().chain([Structure::Hierarchy]).collect();
    let shadows: Vec<_> = SECTIONS.map(Structure::LightBuffer).into_iter().chain([Structure::Hierarchy]).collect();
    for (database, paper) in DATABASES.iter().zip(&PAPER_3) {
        let all = rays.iter().flat_map(|&rays| shadows.iter().map(move |&shadows| Structures { rays, shadows }));
        let none = Structures::from(Structure::Every);
        let times = times_with(database, &all.chain([none]).collect::<Vec<_>>());
        let papers = paper.iter().map(|row| &row[..]).chain([&[][..]]);
        for ((rays, paper), times_of_row) in rays.iter().zip(papers).zip(times.chunks(shadows.len())) {
            println!("{database:12} {:9} {}", rays.to_string(), beside(times_of_row, times[0], paper));
        }
        let (every, found) = (times[times.len() - 1], &times[..times.len() - 1]);
        let least = found.iter().copied().fold(f64::INFINITY, f64::min);
        let hierarchy = found[found.len() - 1];
        let best = paper.as_flattened().iter().copied().fold(f64::INFINITY, f64::min);
        println!(
            "{database:12} of the time without any structure: hierarchy {:.4}, best {:.4} (paper {best:.4})\n",
            hierarchy / every,
            least / every
        );
    }
}

/// One voxel is no grid.
fn grid(voxels: u32) -> Structure {
    if voxels == 1 { Structure::Every } else { Structure::Grid(voxels) }
}

/// Times as shares of one, each with the paper's where it has one.
fn beside(times: &[f64], unit: f64, paper: &[f64]) -> String {
    let cell = |(i, time): (usize, &f64)| {
        let paper = paper.get(i).map(|paper| format!(" ({paper:.4})"));
        format!("{:.4}{:10} ", time / unit, paper.unwrap_or_default())
    };
    times.iter().enumerate().map(cell).collect()
}
