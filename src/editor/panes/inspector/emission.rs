//! What lights emit: how much, in which colour, and what it reaches.

use egui::Ui;

use super::fields::{Fields, Number, row_label};
use super::together::Lights;
use crate::editor::light_list;
use crate::editor::panes::look::{display_color, quantity_name, quantity_suffix};
use crate::editor::panes::{bars, links};
use crate::editor::units::{self, Unit};
use crate::light::{Light, Quantity, QuantityKind, Tint, temperature_color};

/// The temperature that a light gets when its tint becomes one, kelvin.
const DAYLIGHT_K: f64 = 6500.0;
/// What the slider of temperatures goes through, kelvin; numbers may be typed beyond its end.
const SLIDER_K: std::ops::RangeInclusive<f64> = 1000.0..=20_000.0;

/// How much lights emit, in which colour, and what they reach.
pub(super) fn rows(ui: &mut Ui, fields: &mut Fields<'_>, lights: &Lights) {
    quantities(ui, fields, lights);
    tint(ui, fields, lights, false);
    fields.toggle_all(ui, "Muted", &lights.each(|light| light.muted), lights.set(|light, muted| light.muted = muted));
    row_label(ui, "Lights");
    let shown = links::text(fields.scene(), lights.places());
    links::menu(ui, fields.session, lights.places(), &shown, "Surfaces that are lit");
    ui.end_row();
}

/// A row for each quantity that all the lights have; which of them stays when they are resized.
fn quantities(ui: &mut Ui, fields: &mut Fields<'_>, lights: &Lights) {
    let [first, others @ ..] = lights.all() else { return };
    let mut kinds = first.shape.quantity_kinds().to_vec();
    kinds.retain(|kind| others.iter().all(|light| light.shape.quantity_kinds().contains(kind)));
    for kind in &kinds {
        let Some(values) = lights.of_all(|light| light.in_quantity(*kind)) else { continue };
        let style = Number::amount(quantity_suffix(*kind), values[0]);
        let set = lights.set_each(|light: &mut Light, value| light.quantity = Quantity::new(*kind, value));
        fields.numbers(ui, quantity_name(*kind), &style, &values, set);
    }
    if let Some(lux) = lights.of_all(units::lux_at_metre) {
        let hint = "Illuminance of a surface 1 m before the middle of the light and facing it";
        let style = Number { hint, ..Number::amount(" lx", lux[0]) };
        let set = lights.set_each(|light: &mut Light, lux| {
            if let Some(stated) = units::stated(light, Unit::LuxAtMetre, lux) {
                *light = stated;
            }
        });
        fields.numbers(ui, "Lux at 1 m", &style, &lux, set);
    }
    if !others.is_empty() {
        let hint = "Multiplies what all of them emit, each in its own unit";
        fields.factor(ui, "Brightness", hint, |scene, factor| {
            light_list::scale_emission(scene, lights.places(), factor);
        });
    }
    if kinds.len() > 1 && lights.all().iter().all(has_size) {
        held(ui, fields, lights, &kinds);
    }
}

/// Whether a light can be resized.
fn has_size(light: &Light) -> bool {
    !light.emitter().is_one_direction()
}

/// Which of the quantities stays when the lights are resized: the one that the file states.
fn held(ui: &mut Ui, fields: &mut Fields<'_>, lights: &Lights, kinds: &[QuantityKind]) {
    row_label(ui, "Resizing keeps");
    ui.horizontal(|ui| {
        ui.spacing_mut().item_spacing.x = 2.0;
        for kind in kinds {
            let name = quantity_name(*kind).to_lowercase();
            let is_held = lights.all().iter().all(|light| light.quantity.kind() == *kind);
            let mut response = ui.selectable_label(is_held, &name).on_hover_text(held_hint(*kind));
            response = response.accessible_name(format!("Keep {name}"));
            if response.clicked() && !is_held {
                response.mark_changed();
            }
            fields.apply_now(&response, "Change what resizing keeps", |scene| {
                light_list::each(scene, lights.places(), |light| light.restate(*kind));
            });
        }
    });
    ui.end_row();
}

fn held_hint(kind: QuantityKind) -> &'static str {
    match kind {
        QuantityKind::Flux => "A larger light is dimmer and gives as much light in all: lm stay",
        QuantityKind::Illuminance => "A wider cap is dimmer and lights as much: lx stay",
        _ => "A larger light is as bright and gives more light in all",
    }
}

/// The lights' colour, as itself or as the temperature of a black body. In a popup, which holds no other, the colour's
/// picker is open.
pub(super) fn tint(ui: &mut Ui, fields: &mut Fields<'_>, lights: &Lights, in_popup: bool) {
    row_label(ui, "Tint");
    ui.horizontal(|ui| {
        ui.spacing_mut().item_spacing.x = 2.0;
        for (by_temperature, name) in [(false, "colour"), (true, "temperature")] {
            let has = |light: &Light| matches!(light.tint, Tint::TemperatureK(_)) == by_temperature;
            let is_so = lights.all().iter().all(has);
            let mut response = ui.selectable_label(is_so, name).accessible_name(format!("Tint by {name}"));
            if response.clicked() && !is_so {
                response.mark_changed();
            }
            fields.apply_now(&response, "Change tint", |scene| lights.set(set_way)(scene, by_temperature));
        }
    });
    ui.end_row();
    let color_of = |light: &Light| if let Tint::Color(color) = light.tint { Some(color) } else { None };
    if let Some(colors) = lights.of_all(color_of) {
        let set = |light: &mut Light, rgb| light.tint = Tint::Color(rgb);
        if in_popup {
            row_label(ui, "Colour");
            let mut color = colors[0];
            let response = bars::color(ui, &mut color, false);
            fields.apply(&response, "Change colour", |scene| lights.set(set)(scene, color));
            ui.end_row();
        } else {
            fields.colors(ui, "Colour", &colors, lights.set_each(set));
        }
    }
    let kelvin_of = |light: &Light| if let Tint::TemperatureK(kelvin) = light.tint { Some(kelvin) } else { None };
    if let Some(kelvins) = lights.of_all(kelvin_of) {
        let hint = "Of the black body that has this colour: 1900 a candle, 2700 a bulb, 5000 daylight, 6500 overcast";
        let style = Number { unit: " K", speed: 10.0, range: 1000.0..=40_000.0, hint };
        let set = |light: &mut Light, kelvin| light.tint = Tint::TemperatureK(kelvin);
        fields.numbers(ui, "Temperature", &style, &kelvins, lights.set_each(set));
        row_label(ui, "");
        let ratio: f64 = SLIDER_K.end() / SLIDER_K.start();
        let at = (kelvins[0] / SLIDER_K.start()).ln() / ratio.ln();
        let kelvin_at = |share: f64| SLIDER_K.start() * ratio.powf(share);
        let color_at = |share| display_color(temperature_color(kelvin_at(share)));
        let (response, share) = bars::bar(ui, "Temperature slider", at, color_at);
        let kelvin = 10.0 * (0.1 * kelvin_at(share)).round();
        let response = response.on_hover_text(hint);
        fields.apply(&response, "Change temperature", |scene| lights.set(set)(scene, kelvin));
        ui.end_row();
    }
}

/// A colour taken from a temperature keeps what is seen; its greatest component becomes 1.
fn set_way(light: &mut Light, by_temperature: bool) {
    let rgb = light.tint.rgb();
    light.tint = match (light.tint, by_temperature) {
        (Tint::Color(_), true) => Tint::TemperatureK(DAYLIGHT_K),
        (Tint::TemperatureK(_), false) => Tint::Color(rgb / rgb.max_element()),
        (tint, _) => tint,
    };
}
