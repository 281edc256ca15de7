//! What both benches share: the lights that they measure, and the table that they print.

use std::f64::consts::TAU;
use std::sync::Arc;
use std::time::Duration;

use criterion::Criterion;
use glam::DVec2;
use softbox::light::pattern::{Channel, Image, Pattern};
use softbox::light::{Cap, Directional, Disk, Line, Point, Polygon, Shape, Sky, Sphere, Textured};
use softbox::shading::Method;

/// The lights that are measured, each by every method that it has. A new one is a line here.
pub(crate) fn lights() -> Vec<(&'static str, Shape)> {
    vec![
        ("directional", Shape::Directional(Directional {})),
        ("line", line(2.0)),
        ("line n=1", line(1.0)),
        ("line n=2.5", line(2.5)),
        ("tube", Shape::Line(Line::tube(1.0, 0.01))),
        ("4-gon", ring(4)),
        ("8-gon", ring(8)),
        ("sphere", Shape::Sphere(Sphere { radius: 0.3 })),
        ("cap", Shape::Cap(Cap { half_angle_deg: 15.0 })),
        ("sky", Shape::Sky(Sky::OVERCAST)),
        ("disk", Shape::Disk(Disk { radius: 0.5, two_sided: false })),
        ("textured 16²", textured(16)),
        ("textured 2048²", textured(2048)),
    ]
}

/// A pattern of that many texels a side.
fn textured(side: usize) -> Shape {
    let texels = (0..side * side).map(|i| if (i / side + i).is_multiple_of(3) { 1.0 } else { 0.25 }).collect();
    let channel = Channel::new(side, texels).expect("a square of texels");
    let pattern = Pattern::of_image("checks.png", Image::Grey(Arc::new(channel)));
    Shape::Textured(Textured { size: DVec2::ONE, pattern, two_sided: false })
}

/// What the others are multiples of.
pub(crate) fn point() -> Shape {
    Shape::Point(Point::default())
}

/// The methods that are measured: not those that integrate adaptively, which take milliseconds a point.
pub(crate) fn methods(shape: &Shape) -> impl Iterator<Item = Method> {
    let adaptive = matches!(shape, Shape::Textured(_));
    let slow = move |method: Method| method == Method::Reference || adaptive && method == Method::Exact;
    Method::of(shape).iter().copied().filter(move |method| !slow(*method))
}

fn line(falloff: f64) -> Shape {
    Shape::Line(Line { falloff, ..Line::isotropic(1.0) })
}

fn ring(vertices: u32) -> Shape {
    let corner = |i| DVec2::from_angle(-TAU * f64::from(i) / f64::from(vertices)) * 0.7;
    Shape::Polygon(Polygon { vertices: (0..vertices).map(corner).collect(), two_sided: false })
}

/// The least time so far of one light, and of the point light that it is a multiple of, taken in turn.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Times {
    /// Of the light.
    pub(crate) light: Duration,
    /// Of the point light.
    pub(crate) point: Duration,
}

/// Runs measurements through criterion, and prints the least times as multiples of the point light's.
pub(crate) struct Bench {
    criterion: Criterion,
    rows: Vec<([String; 3], Times)>,
}

impl Bench {
    /// Set to a short run.
    pub(crate) fn new() -> Self {
        let criterion = Criterion::default()
            .sample_size(10)
            .warm_up_time(Duration::from_millis(20))
            .measurement_time(Duration::from_millis(200));
        Self { criterion: criterion.configure_from_args(), rows: Vec::new() }
    }

    /// Measures light, part and method by `once`, which takes both times and answers the least of each so far.
    pub(crate) fn measure(&mut self, name: [&str; 3], mut once: impl FnMut() -> Times) {
        let mut least = None;
        self.criterion.bench_function(&name.join("/"), |bencher| {
            bencher.iter_custom(|repetitions| (0..repetitions).map(|_| least.insert(once()).light).sum());
        });
        self.rows.extend(least.map(|times| (name.map(str::to_owned), times)));
    }

    /// Prints the table. `unit` is the name of a nanosecond over `count`.
    pub(crate) fn finish(self, unit: &str, count: f64) {
        println!("{:<14} {:<14} {:<20} {unit:>10} {:>13}", "light", "part", "method", "point lights");
        for ([light, part, method], times) in &self.rows {
            let ns = 1e9 * times.light.as_secs_f64() / count;
            let ratio = times.light.as_secs_f64() / times.point.as_secs_f64();
            println!("{light:<14} {part:<14} {method:<20} {ns:>10.1} {ratio:>13.2}");
        }
        self.criterion.final_summary();
    }
}
