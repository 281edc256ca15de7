//! A pattern: its picture, its file and its size, and another in its place.

use egui::{Color32, ColorImage, Rgba, TextureHandle, TextureOptions, Ui, vec2};

use super::fields::{Fields, row_label};
use crate::editor::commands::Command;
use crate::light::pattern::{Image, Pattern};

/// The longer side of a thumbnail, pixels.
const SIDE: usize = 96;
/// A pixel of a thumbnail is the mean of so many texels in each direction.
const SAMPLES: usize = 4;

/// A pattern's picture as a texture.
pub(super) struct Thumbnail {
    image: Image,
    texture: TextureHandle,
}

/// The row of the pattern of the light of that name.
pub(super) fn row(ui: &mut Ui, fields: &mut Fields<'_>, light: &str, pattern: &Pattern) {
    row_label(ui, "Pattern");
    ui.vertical(|ui| {
        if fields.thumbnail.as_ref().is_none_or(|shown| !shown.image.is_same(&pattern.image)) {
            let texture = ui.ctx().load_texture("pattern", picture(&pattern.image), TextureOptions::LINEAR);
            *fields.thumbnail = Some(Thumbnail { image: pattern.image.clone(), texture });
        }
        if let Some(Thumbnail { texture, .. }) = fields.thumbnail {
            let shown = egui::Image::from_texture((texture.id(), texture.size_vec2()));
            ui.add(shown.corner_radius(2.0).alt_text("Pattern picture")).on_hover_text("As seen from the lit side");
        }
        let channel = &pattern.image.channels()[0];
        let kind = if pattern.image.channels().len() == 1 { "grey" } else { "colour" };
        ui.monospace(&pattern.file);
        ui.weak(format!("{} × {}, {kind}", channel.width(), channel.height()));
        ui.horizontal(|ui| {
            let button = |text: &'static str| egui::Button::new(text).min_size(vec2(62.0, 20.0));
            let response = ui.add(button("Paint…")).on_hover_text("Paint on it with brushes and shapes");
            if response.accessible_name("Edit pattern").clicked() {
                fields.commands.push(Command::EditPattern);
            }
            let response = ui.add(button("Replace…")).on_hover_text("Choose another PNG, JPEG, EXR or HDR picture");
            if response.accessible_name("Replace pattern").clicked() {
                fields.commands.push(Command::ReplacePattern(light.to_owned()));
            }
        });
    });
    ui.end_row();
}

/// A small picture of a pattern; where a texel is above 1, the brightest is white.
fn picture(image: &Image) -> ColorImage {
    let channels = image.channels();
    let [width, height] = [channels[0].width(), channels[0].height()];
    let longer = width.max(height);
    let size = [width, height].map(|side| (side * SIDE).div_ceil(longer));
    let peak = channels.iter().flat_map(|channel| channel.texels()).copied().fold(1.0_f32, f32::max);
    let pixels = (0..size[0] * size[1]).map(|i| {
        let [columns, rows] = [places(i % size[0], size[0], width), places(i / size[0], size[1], height)];
        let mean = |channel: usize| {
            let texels = channels[channel.min(channels.len() - 1)].texels();
            let sum: f32 = rows.iter().flat_map(|y| columns.iter().map(move |x| texels[y * width + x])).sum();
            sum / (peak * (rows.len() * columns.len()) as f32)
        };
        Color32::from(Rgba::from_rgb(mean(0), mean(1), mean(2)))
    });
    ColorImage::new(size, pixels.collect())
}

/// Places spread over what one of `of` pixels covers of `texels`.
fn places(pixel: usize, of: usize, texels: usize) -> [usize; SAMPLES] {
    std::array::from_fn(|i| (pixel * SAMPLES + i) * texels / (of * SAMPLES))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::light::pattern::Channel;
    use std::sync::Arc;

    fn channel(width: usize, texels: Vec<f32>) -> Arc<Channel> {
        Arc::new(Channel::new(width, texels).expect("whole rows"))
    }

    #[test]
    fn a_large_pattern_is_shrunk_and_keeps_its_sides() {
        let halves = (0..400 * 200).map(|i| if i % 400 < 200 { 1.0 } else { 0.0 }).collect();
        let small = picture(&Image::Grey(channel(400, halves)));
        assert_eq!(small.size, [SIDE, SIDE / 2], "two to one");
        assert_eq!((small[(0, 0)], small[(SIDE - 1, 0)]), (Color32::WHITE, Color32::BLACK), "left and right");
    }

    #[test]
    fn what_is_brighter_than_1_is_white_and_colours_stay() {
        let image = Image::Color([channel(1, vec![4.0]), channel(1, vec![0.0]), channel(1, vec![4.0])]);
        assert_eq!(picture(&image)[(0, 0)], Color32::from_rgb(255, 0, 255), "magenta");
    }
}
