//! How the window looks: colours, spacing, type, and the pens of methods.

use egui::style::WidgetVisuals;
use egui::{Color32, CornerRadius, FontFamily, FontId, Margin, Shadow, Stroke, TextStyle, Theme, Visuals, vec2};

use crate::analysis::Pen;

/// Width of the inspector's label column, points.
pub const LABEL_WIDTH: f32 = 92.0;

/// The colours that differ between dark and light.
struct Palette {
    panel: Color32,
    /// Behind text fields, plots and lists.
    sunken: Color32,
    button: Color32,
    hovered: Color32,
    pressed: Color32,
    line: Color32,
    text: Color32,
    strong: Color32,
    weak: Color32,
    accent: Color32,
    /// Fill of what is selected.
    selected: Color32,
}

const DARK: Palette = Palette {
    panel: Color32::from_rgb(0x1d, 0x20, 0x24),
    sunken: Color32::from_rgb(0x14, 0x16, 0x19),
    button: Color32::from_rgb(0x2b, 0x30, 0x36),
    hovered: Color32::from_rgb(0x37, 0x3d, 0x45),
    pressed: Color32::from_rgb(0x44, 0x4b, 0x55),
    line: Color32::from_rgb(0x33, 0x38, 0x3f),
    text: Color32::from_rgb(0xcf, 0xd4, 0xda),
    strong: Color32::from_rgb(0xf4, 0xf6, 0xf8),
    weak: Color32::from_rgb(0x93, 0x9b, 0xa6),
    accent: Color32::from_rgb(0xff, 0xb8, 0x4d),
    selected: Color32::from_rgb(0x5a, 0x43, 0x1c),
};

const LIGHT: Palette = Palette {
    panel: Color32::from_rgb(0xf1, 0xf2, 0xf4),
    sunken: Color32::from_rgb(0xff, 0xff, 0xff),
    button: Color32::from_rgb(0xe0, 0xe3, 0xe7),
    hovered: Color32::from_rgb(0xd3, 0xd7, 0xdd),
    pressed: Color32::from_rgb(0xc3, 0xc9, 0xd1),
    line: Color32::from_rgb(0xcc, 0xd0, 0xd6),
    text: Color32::from_rgb(0x2c, 0x31, 0x38),
    strong: Color32::from_rgb(0x0c, 0x0e, 0x11),
    weak: Color32::from_rgb(0x5d, 0x66, 0x72),
    accent: Color32::from_rgb(0x9a, 0x5b, 0x00),
    selected: Color32::from_rgb(0xff, 0xdd, 0xa6),
};

/// Install fonts and both themes.
pub fn install(ctx: &egui::Context) {
    egui_material_icons::initialize(ctx);
    for (theme, palette) in [(Theme::Dark, &DARK), (Theme::Light, &LIGHT)] {
        ctx.style_mut_of(theme, |style| {
            style.visuals = visuals(theme, palette);
            style.text_styles = text_styles();
            style.drag_value_text_style = TextStyle::Monospace;
            style.animation_time = 0.08;
            let spacing = &mut style.spacing;
            spacing.item_spacing = vec2(6.0, 4.0);
            spacing.button_padding = vec2(6.0, 2.0);
            spacing.interact_size = vec2(24.0, 20.0);
            spacing.indent = 14.0;
            spacing.menu_margin = Margin::same(6);
            spacing.combo_width = 60.0;
            spacing.slider_width = 120.0;
        });
    }
}

/// The accent colour of the theme in use.
pub fn accent(visuals: &Visuals) -> Color32 {
    palette(visuals).accent
}

/// The accent colour over a picture, which is dark or gaudy in either theme.
pub const ACCENT_OVER_PICTURE: Color32 = DARK.accent;

/// The colour of a curve.
pub fn pen_color(pen: &Pen, visuals: &Visuals) -> Color32 {
    let [r, g, b] = if visuals.dark_mode { pen.on_dark } else { pen.on_light };
    Color32::from_rgb(r, g, b)
}

fn palette(visuals: &Visuals) -> &'static Palette {
    if visuals.dark_mode { &DARK } else { &LIGHT }
}

fn text_styles() -> std::collections::BTreeMap<TextStyle, FontId> {
    use FontFamily::{Monospace, Proportional};
    [
        (TextStyle::Small, FontId::new(11.0, Proportional)),
        (TextStyle::Body, FontId::new(13.0, Proportional)),
        (TextStyle::Button, FontId::new(13.0, Proportional)),
        (TextStyle::Heading, FontId::new(15.0, Proportional)),
        (TextStyle::Monospace, FontId::new(12.0, Monospace)),
    ]
    .into()
}

fn visuals(theme: Theme, palette: &Palette) -> Visuals {
    let mut visuals = theme.default_visuals();
    visuals.panel_fill = palette.panel;
    visuals.window_fill = palette.panel;
    visuals.extreme_bg_color = palette.sunken;
    visuals.text_edit_bg_color = Some(palette.sunken);
    visuals.faint_bg_color = palette.panel.lerp_to_gamma(palette.button, 0.35);
    visuals.code_bg_color = palette.button;
    visuals.window_stroke = Stroke::new(1.0, palette.line);
    visuals.window_corner_radius = CornerRadius::same(6);
    visuals.menu_corner_radius = CornerRadius::same(5);
    visuals.window_shadow = Shadow { offset: [0, 6], blur: 18, spread: 0, color: Color32::from_black_alpha(110) };
    visuals.popup_shadow = Shadow { offset: [0, 4], blur: 10, spread: 0, color: Color32::from_black_alpha(90) };
    visuals.hyperlink_color = palette.accent;
    visuals.weak_text_color = Some(palette.weak);
    visuals.selection.bg_fill = palette.selected;
    visuals.selection.stroke = Stroke::new(1.0, palette.strong);
    visuals.slider_trailing_fill = true;

    let widget = |fill: Color32, outline: Color32, text: Color32| WidgetVisuals {
        bg_fill: fill,
        weak_bg_fill: fill,
        bg_stroke: Stroke::new(1.0, outline),
        fg_stroke: Stroke::new(1.0, text),
        corner_radius: CornerRadius::same(4),
        expansion: 0.0,
    };
    visuals.widgets.noninteractive = widget(palette.panel, palette.line, palette.text);
    visuals.widgets.inactive = widget(palette.button, palette.line, palette.text);
    visuals.widgets.hovered = widget(palette.hovered, palette.line, palette.strong);
    visuals.widgets.active = widget(palette.pressed, palette.accent, palette.strong);
    visuals.widgets.open = widget(palette.pressed, palette.line, palette.strong);
    visuals
}
