//! How colours and quantities of lights look in lists and fields.

use egui::Color32;
use glam::DVec3;

use crate::light::QuantityKind;

/// A tint at full brightness, as sRGB.
pub(super) fn display_color(rgb: DVec3) -> Color32 {
    plain_color(rgb / rgb.max_element().max(1e-12))
}

/// Linear Rec. 709, as sRGB.
pub(super) fn plain_color(rgb: DVec3) -> Color32 {
    let [r, g, b] = rgb.clamp(DVec3::ZERO, DVec3::ONE).as_vec3().to_array();
    egui::Rgba::from_rgb(r, g, b).into()
}

/// The name of a quantity on screen.
pub(super) fn quantity_name(kind: QuantityKind) -> &'static str {
    match kind {
        QuantityKind::Luminance => "Luminance",
        QuantityKind::Flux => "Flux",
        QuantityKind::Intensity => "Intensity",
        QuantityKind::IntensityPerMetre => "Intensity/m",
        QuantityKind::Illuminance => "Illuminance",
    }
}

/// Its unit behind a number.
pub(super) fn quantity_suffix(kind: QuantityKind) -> &'static str {
    match kind {
        QuantityKind::Luminance => " cd/m²",
        QuantityKind::Flux => " lm",
        QuantityKind::Intensity => " cd",
        QuantityKind::IntensityPerMetre => " cd/m",
        QuantityKind::Illuminance => " lx",
    }
}
