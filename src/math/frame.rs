//! Rotations and orthonormal frames.

use glam::{DAffine3, DMat3, DVec3};

/// The rotation R = Rz·Ry·Rx (X first) from angles in degrees, as scene files write it.
pub fn rotation_from_deg(rotation_deg: DVec3) -> DMat3 {
    let r = DVec3::new(rotation_deg.x.to_radians(), rotation_deg.y.to_radians(), rotation_deg.z.to_radians());
    DMat3::from_rotation_z(r.z) * DMat3::from_rotation_y(r.y) * DMat3::from_rotation_x(r.x)
}

/// Inverse of [`rotation_from_deg`]: angles in degrees, with `ry` in [−90°, 90°].
///
/// At `ry` = ±90° only a sum of the other two is determined; `rx` is then 0.
pub fn deg_from_rotation(rotation: DMat3) -> DVec3 {
    // R = Rz·Ry·Rx has −sin ry at row 2, column 0.
    let sin_ry = -rotation.x_axis.z;
    let cos_ry = rotation.x_axis.x.hypot(rotation.x_axis.y);
    let ry = sin_ry.atan2(cos_ry);
    let (rx, rz) = if cos_ry > 1e-12 {
        (rotation.y_axis.z.atan2(rotation.z_axis.z), rotation.x_axis.y.atan2(rotation.x_axis.x))
    } else {
        (0.0, (-rotation.y_axis.x).atan2(rotation.y_axis.y))
    };
    // Adding 0 takes the sign from −0, which looks odd where it is written or shown.
    DVec3::new(rx.to_degrees(), ry.to_degrees(), rz.to_degrees()) + DVec3::ZERO
}

/// The rotation without roll that turns a light, which emits along −Z, against `n`: its Z becomes n.
///
/// Rz·Rx takes Z to (sin rz sin rx, −cos rz sin rx, cos rx).
pub fn facing(n: DVec3) -> DMat3 {
    let across = n.x.hypot(n.y);
    let rz = if across < 1e-9 { 0.0 } else { n.x.atan2(-n.y) };
    DMat3::from_rotation_z(rz) * DMat3::from_rotation_x(across.atan2(n.z))
}

/// The transform of a thing placed by `position` and `rotation_deg`, without scale.
pub fn world_from_local(position: DVec3, rotation_deg: DVec3) -> DAffine3 {
    DAffine3::from_mat3_translation(rotation_from_deg(rotation_deg), position)
}
