//! Where in the editor a place of the document is.

use crate::editor::session::Item;
use crate::scene::{Path, Scene, Segment};

/// The thing that a path of the document leads into; none for the scene as a whole.
pub(super) fn item(path: &Path) -> Option<Item> {
    let [Segment::Key(list), Segment::Index(index), ..] = path.segments() else { return None };
    match list.as_str() {
        "light" => Some(Item::Light(*index)),
        "surface" => Some(Item::Surface(*index)),
        "material" => Some(Item::Material(*index)),
        "plot" => Some(Item::Plot(*index)),
        _ => None,
    }
}

/// The label of the inspector's row for the value that a path leads to, where it has one.
pub(super) fn field(path: &Path) -> Option<&'static str> {
    let keys = path.segments().iter().rev().filter_map(|segment| match segment {
        Segment::Key(key) => Some(key.as_str()),
        Segment::Index(_) => None,
    });
    keys.into_iter().find_map(label)
}

/// The inspector's label of a key of the document.
pub(super) fn label(key: &str) -> Option<&'static str> {
    LABELS.iter().find_map(|(known, label)| (*known == key).then_some(*label))
}

const LABELS: &[(&str, &str)] = &[
    ("axis", "Turns about"),
    ("color", "Colour"),
    ("cosine", "Cosine"),
    ("depth", "Depth"),
    ("diffuse", "Diffuse k_d"),
    ("emission", "Emits as"),
    ("exponent", "Exponent m"),
    ("exposure_ev", "Exposure"),
    ("eye", "Eye"),
    ("falloff", "Falloff n"),
    ("file", "Mesh"),
    ("fov_deg", "Field of view"),
    ("half_angle_deg", "Half-angle"),
    ("height", "Height"),
    ("illuminance", "Illuminance"),
    ("intensity", "Intensity"),
    ("intensity_per_metre", "Intensity/m"),
    ("flux", "Flux"),
    ("length", "Length"),
    ("luminance", "Luminance"),
    ("material", "Material"),
    ("name", "Name"),
    ("normal", "Normal"),
    ("pattern", "Pattern"),
    ("position", "Position"),
    ("radius", "Radius"),
    ("range", "From"),
    ("reflectance", "Reflectance"),
    ("rotation_deg", "Rotation"),
    ("roughness", "Roughness"),
    ("scale", "Scale"),
    ("size", "Size"),
    ("specular", "Specular k_s"),
    ("target", "Target"),
    ("temperature_k", "Temperature"),
    ("uniform", "Uniform"),
    ("vertices", "1"),
    ("view", "Seen from"),
];

/// What a thing is called in the list.
pub(super) fn name(item: Item, scene: &Scene) -> String {
    let kind = match item {
        Item::Light(_) => "light",
        Item::Surface(_) => "surface",
        Item::Material(_) => "material",
        Item::Plot(_) => "plot",
    };
    format!("{kind} {}", item.name(scene).unwrap_or_default())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[track_caller]
    fn check(path: &Path, expected: (Option<Item>, Option<&str>)) {
        assert_eq!((item(path), field(path)), expected, "{path}");
    }

    #[test]
    fn a_path_leads_to_a_thing_and_its_field() {
        let root = Path::default();
        let light = root.key("light").index(2);
        check(&light.key("position").index(1), (Some(Item::Light(2)), Some("Position")));
        let vertices = light.key("shape").key("polygon").key("vertices");
        check(&vertices.index(3).index(0), (Some(Item::Light(2)), Some("1")));
        check(&root.key("material").index(0).key("exponent"), (Some(Item::Material(0)), Some("Exponent m")));
        check(&root.key("display").key("exposure_ev"), (None, Some("Exposure")));
        check(&root.key("unheard_of"), (None, None));
    }
}
