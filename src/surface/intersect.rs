//! Rays against the shapes in their own frames.
//!
//! A solid is the common part of a few convex regions: slabs, a round cylinder, one nap of a cone, a ball. A ray is
//! inside each between two crossings, and inside all of them from the last entry to the first exit.
//!
//! An origin within [`ON_SURFACE`] of a face counts as lying on it, and a hit nearer than that is none: rays that
//! leave a surface do not meet it where they start, however they graze it.

use glam::{DVec2, DVec3};

use super::{Hit, Primitive};

/// Distance below which a point counts as on a surface, relative to the sizes involved.
pub(crate) const ON_SURFACE: f64 = 1e-10;

/// A hit in the shape's own frame; the normal has any length.
pub(super) struct LocalHit {
    pub(super) t: f64,
    pub(super) p: DVec3,
    pub(super) n: DVec3,
}

/// Which face of a solid is crossed.
#[derive(Clone, Copy)]
enum Face {
    /// The face at ±half of a coordinate axis.
    Flat { axis: usize, at: f64 },
    /// The curved face.
    Round,
}

#[derive(Clone, Copy)]
struct Crossing {
    t: f64,
    face: Face,
}

/// The part of a ray inside a convex region.
#[derive(Clone, Copy)]
struct Inside {
    enter: Crossing,
    exit: Crossing,
}

/// The nearest hit of a ray on a primitive in its own frame; `d` has any length.
pub(super) fn intersect(primitive: &Primitive, o: DVec3, d: DVec3) -> Option<LocalHit> {
    match *primitive {
        Primitive::Plane => flat(o, d, |_| true),
        Primitive::Square { size } => flat(o, d, |p| p.abs().cmple(0.5 * size).all()),
        Primitive::Disk { radius } => flat(o, d, |p| p.length() <= radius),
        Primitive::Sphere { radius } => {
            let crossing = nearest(ball(o, d, radius)?, o, d, radius)?;
            let p = (o + crossing.t * d).normalize_or(DVec3::Z) * radius;
            Some(LocalHit { t: crossing.t, p, n: p })
        }
        Primitive::Box { size } => {
            let half = 0.5 * size;
            let inside = slab(o, d, half, 0)?.and(slab(o, d, half, 1)?)?.and(slab(o, d, half, 2)?)?;
            solid(inside, o, d, half.max_element(), |p| (p, p))
        }
        Primitive::Cylinder { radius, height } => {
            let half = DVec3::new(radius, radius, 0.5 * height);
            let inside = tube(o, d, radius)?.and(slab(o, d, half, 2)?)?;
            solid(inside, o, d, half.max_element(), |p| {
                let across = p.truncate().normalize_or(DVec2::X);
                ((across * radius).extend(p.z), across.extend(0.0))
            })
        }
        Primitive::Cone { radius, height } => {
            let half = DVec3::new(radius, radius, 0.5 * height);
            let inside = nap(o, d, radius, height)?.and(slab(o, d, half, 2)?)?;
            let slope = radius / height;
            solid(inside, o, d, half.max_element(), |p| {
                let across = p.truncate().normalize_or_zero();
                ((across * (slope * (half.z - p.z))).extend(p.z), across.extend(slope))
            })
        }
        Primitive::Triangle(ref triangle) => triangle.intersect(o, d).map(|Hit { t, p, n }| LocalHit { t, p, n }),
        Primitive::Patch(ref patch) => patch.hit(o, d),
    }
}

impl Inside {
    /// The common part; none when empty.
    fn and(self, other: Self) -> Option<Self> {
        let enter = if self.enter.t > other.enter.t { self.enter } else { other.enter };
        let exit = if self.exit.t < other.exit.t { self.exit } else { other.exit };
        (enter.t < exit.t).then_some(Self { enter, exit })
    }
}

/// A hit on the plane z = 0 where `within` holds.
fn flat(o: DVec3, d: DVec3, within: impl Fn(DVec2) -> bool) -> Option<LocalHit> {
    if o.z.abs() <= ON_SURFACE * o.length() {
        return None;
    }
    let t = -o.z / d.z;
    let p = (o + t * d).truncate();
    (t > 0.0 && t.is_finite() && within(p)).then(|| LocalHit { t, p: p.extend(0.0), n: DVec3::Z })
}

/// The hit on a solid with flat faces; `round` gives point and normal on its curved face.
fn solid(inside: Inside, o: DVec3, d: DVec3, size: f64, round: impl Fn(DVec3) -> (DVec3, DVec3)) -> Option<LocalHit> {
    let Crossing { t, face } = nearest(inside, o, d, size)?;
    let mut p = o + t * d;
    let n = match face {
        Face::Flat { axis, at } => {
            p[axis] = at;
            at.signum() * DVec3::AXES[axis]
        }
        Face::Round => {
            let (on_face, n) = round(p);
            p = on_face;
            n
        }
    };
    Some(LocalHit { t, p, n })
}

/// The entry when it lies ahead, else the exit when that does.
fn nearest(inside: Inside, o: DVec3, d: DVec3, size: f64) -> Option<Crossing> {
    let least = ON_SURFACE * o.length().max(size) / d.length();
    [inside.enter, inside.exit].into_iter().find(|crossing| crossing.t > least && crossing.t.is_finite())
}

/// Inside |x| ≤ half along one axis.
fn slab(o: DVec3, d: DVec3, half: DVec3, axis: usize) -> Option<Inside> {
    let (h, d) = (half[axis], d[axis]);
    let on_face = (o[axis].abs() - h).abs() <= ON_SURFACE * half.max_element();
    let o = if on_face { h.copysign(o[axis]) } else { o[axis] };
    if d == 0.0 {
        let always = |t: f64| Crossing { t, face: Face::Flat { axis, at: h } };
        return (o.abs() < h).then(|| Inside { enter: always(f64::NEG_INFINITY), exit: always(f64::INFINITY) });
    }
    let at = h.copysign(d);
    Some(Inside {
        enter: Crossing { t: (-at - o) / d, face: Face::Flat { axis, at: -at } },
        exit: Crossing { t: (at - o) / d, face: Face::Flat { axis, at } },
    })
}

/// Inside the ball about the origin.
///
/// The discriminant comes from the point of the ray nearest the centre: E. Haines and others, *Precision improvements
/// for ray/sphere intersection*, Ray Tracing Gems, 2019, chapter 7.
fn ball(o: DVec3, d: DVec3, radius: f64) -> Option<Inside> {
    let a = d.length_squared();
    let b = o.dot(d);
    let nearest = o - b / a * d;
    let excess = (radius - nearest.length()) * (radius + nearest.length());
    round(a, b, (o.length() - radius) * (o.length() + radius), excess, radius)
}

/// Inside the infinite cylinder about Z.
fn tube(o: DVec3, d: DVec3, radius: f64) -> Option<Inside> {
    let (o, d) = (o.truncate(), d.truncate());
    let a = d.length_squared();
    let away = (o.length() - radius) * (o.length() + radius);
    if a == 0.0 {
        let always = |t: f64| Crossing { t, face: Face::Round };
        return (away < 0.0).then(|| Inside { enter: always(f64::NEG_INFINITY), exit: always(f64::INFINITY) });
    }
    let distance = o.perp_dot(d).abs() / a.sqrt();
    round(a, o.dot(d), away, (radius - distance) * (radius + distance), radius)
}

/// Inside between the roots of a·t² + 2b·t + c, a > 0, where a·`excess` = b² − a·c; c is snapped to 0 on the face.
fn round(a: f64, b: f64, c: f64, excess: f64, radius: f64) -> Option<Inside> {
    let c = if c.abs() <= ON_SURFACE * radius * radius { 0.0 } else { c };
    let root = if c == 0.0 { b.abs() } else { (a * excess).sqrt() };
    let [t0, t1] = roots(a, b, c, root);
    (t0 < t1)
        .then_some(Inside { enter: Crossing { t: t0, face: Face::Round }, exit: Crossing { t: t1, face: Face::Round } })
}

/// The roots of a·t² + 2b·t + c, `root` = √(b² − a·c), without cancellation; the lesser first when a > 0.
fn roots(a: f64, b: f64, c: f64, root: f64) -> [f64; 2] {
    if b > 0.0 {
        let q = -(b + root);
        [q / a, c / q]
    } else {
        let q = root - b;
        [c / q, q / a]
    }
}

/// Inside the lower nap of the cone about Z with its apex at +height/2.
///
/// x² + y² = k²(apex − z)², k = radius/height: a·t² + 2b·t + c with a < 0 for a ray steeper than the cone, which
/// crosses either nap once.
fn nap(o: DVec3, d: DVec3, radius: f64, height: f64) -> Option<Inside> {
    let slope = radius / height;
    let below = 0.5 * height - o.z;
    let (o_across, d_across) = (o.truncate(), d.truncate());
    let (cone, rise) = (slope * below, slope * d.z);
    let a = (d_across.length() - rise.abs()) * (d_across.length() + rise.abs());
    let b = o_across.dot(d_across) + cone * rise;
    let away = (o_across.length() - cone.abs()) * (o_across.length() + cone.abs());
    let on_face = away.abs() <= ON_SURFACE * radius * radius;
    let c = if on_face { 0.0 } else { away };
    let root = if on_face { b.abs() } else { nap_discriminant(o_across, d_across, cone, rise).sqrt() };
    let [t0, t1] = roots(a, b, c, root);
    let crossing = |t: f64| Crossing { t, face: Face::Round };
    if a > 0.0 {
        return (t0 < t1).then(|| Inside { enter: crossing(t0), exit: crossing(t1) });
    }
    // One crossing a nap: of the two, the one below the apex.
    let t = if below - t0 * d.z >= 0.0 { t0 } else { t1 };
    Some(if d.z < 0.0 {
        Inside { enter: crossing(t), exit: crossing(f64::INFINITY) }
    } else {
        Inside { enter: crossing(f64::NEG_INFINITY), exit: crossing(t) }
    })
}

/// b² − a·c of the cone as (cone·d + rise·o)² − (o × d)², in 2D: Lagrange's identity takes out the squares that cancel.
fn nap_discriminant(o: DVec2, d: DVec2, cone: f64, rise: f64) -> f64 {
    let along = (cone * d + rise * o).length();
    let across = o.perp_dot(d).abs();
    (along - across) * (along + across)
}
