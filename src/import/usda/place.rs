//! Where prims are: `xformOp`s.

use glam::{DAffine3, DMat3, DMat4, DQuat, DVec3, DVec4};

use super::prim::{Prim, Value};

/// A prim's own transform.
pub(super) struct Local {
    pub(super) transform: DAffine3,
    /// Whether those of the prims above it do not count.
    pub(super) resets: bool,
}

/// The transform that a prim's `xformOpOrder` gives, and notes with their lines on what is not understood.
pub(super) fn local_transform(prim: &Prim) -> (Local, Vec<(usize, String)>) {
    let mut local = Local { transform: DAffine3::IDENTITY, resets: false };
    let mut notes = Vec::new();
    let Some(order) = prim.property("xformOpOrder") else {
        if let Some(property) = prim.properties.iter().find(|property| property.name.starts_with("xformOp:")) {
            notes.push((property.line, "has operations, but no xformOpOrder, so that they do nothing".to_owned()));
        }
        return (local, notes);
    };
    for name in order.value.list().unwrap_or_default().iter().filter_map(Value::text) {
        if name == "!resetXformStack!" {
            local = Local { transform: DAffine3::IDENTITY, resets: true };
            continue;
        }
        let (plain, inverted) = name.strip_prefix("!invert!").map_or((name, false), |plain| (plain, true));
        let Some(property) = prim.property(plain) else {
            notes.push((order.line, format!("has no {plain}, which its xformOpOrder names")));
            continue;
        };
        if let Value::Samples(_) = property.value {
            notes.push((property.line, format!("has an animated {plain}; its first sample counts")));
        }
        match operation(plain, &property.value) {
            Some(operation) => {
                let operation = if inverted { operation.inverse() } else { operation };
                local.transform *= operation;
            }
            None => notes.push((property.line, format!("has a {plain} that is not understood"))),
        }
    }
    (local, notes)
}

/// The transform of an operation.
fn operation(name: &str, value: &Value) -> Option<DAffine3> {
    let kind = name.strip_prefix("xformOp:")?.split(':').next()?;
    let along = |axis: DVec3| value.number().map(|number| axis * number);
    let linear = |matrix| Some(DAffine3::from_mat3(matrix));
    match kind {
        "translate" => value.vector().map(DAffine3::from_translation),
        "translateX" => along(DVec3::X).map(DAffine3::from_translation),
        "translateY" => along(DVec3::Y).map(DAffine3::from_translation),
        "translateZ" => along(DVec3::Z).map(DAffine3::from_translation),
        "scale" => linear(DMat3::from_diagonal(value.vector()?)),
        "scaleX" => linear(DMat3::from_diagonal(DVec3::new(value.number()?, 1.0, 1.0))),
        "scaleY" => linear(DMat3::from_diagonal(DVec3::new(1.0, value.number()?, 1.0))),
        "scaleZ" => linear(DMat3::from_diagonal(DVec3::new(1.0, 1.0, value.number()?))),
        "orient" => {
            // The real part stands first.
            let [w, x, y, z] = value.numbers()?;
            let quaternion = DQuat::from_xyzw(x, y, z, w);
            (quaternion.length() > 0.0).then(|| DAffine3::from_quat(quaternion.normalize()))
        }
        "transform" => matrix(value),
        _ => linear(rotation(kind.strip_prefix("rotate")?, value)?),
    }
}

/// A rotation about axes in their order, the first one innermost; in degrees.
fn rotation(axes: &str, value: &Value) -> Option<DMat3> {
    let about = |axis: char, degrees: f64| {
        let radians = degrees.to_radians();
        match axis {
            'X' => Some(DMat3::from_rotation_x(radians)),
            'Y' => Some(DMat3::from_rotation_y(radians)),
            'Z' => Some(DMat3::from_rotation_z(radians)),
            _ => None,
        }
    };
    let mut axes = axes.chars();
    let (first, rest) = (axes.next()?, axes.as_str());
    if rest.is_empty() {
        return about(first, value.number()?);
    }
    // The angles stand in the order of the axes' names, not in that of their turns.
    let angles = value.vector()?;
    let angle = |axis| match axis {
        'X' => angles.x,
        'Y' => angles.y,
        _ => angles.z,
    };
    let turns = std::iter::once(first).chain(rest.chars());
    turns.map(|axis| about(axis, angle(axis))).try_fold(DMat3::IDENTITY, |done, turn| Some(turn? * done))
}

/// A matrix whose rows act on row vectors, as all of OpenUSD's.
fn matrix(value: &Value) -> Option<DAffine3> {
    let rows: Option<Vec<[f64; 4]>> = value.list()?.iter().map(Value::numbers).collect();
    let rows: [[f64; 4]; 4] = rows?.try_into().ok()?;
    let matrix = DMat4::from_cols_array_2d(&rows);
    (matrix.row(3) == DVec4::W).then(|| DAffine3::from_mat4(matrix))
}
