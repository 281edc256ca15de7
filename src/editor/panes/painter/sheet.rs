//! The pattern on the easel: what the light has, what is being painted over it, and both as a texture.

use egui::{Color32, ColorImage, Context, Rgba, TextureHandle, TextureOptions};
use glam::DVec2;

use super::tools::{Options, PaintTool};
use crate::light::pattern::Image;
use crate::light::pattern::paint::{self, Area, Canvas, Rgb, adjust};

/// The longer side of what the light shows while something is painted, texels: the flux is the same as of all texels,
/// and what the light needs of so few is computed within a frame.
const LIVE_SIDE: usize = 64;

/// Texels stay sharp when they are large.
const FILTER: TextureOptions = TextureOptions {
    magnification: egui::TextureFilter::Nearest,
    minification: egui::TextureFilter::Linear,
    wrap_mode: egui::TextureWrapMode::ClampToEdge,
    mipmap_mode: None,
};

/// See the [module](self).
pub(super) struct Sheet {
    /// The light's name.
    pub(super) light: String,
    /// What the light had when last looked at.
    pub(super) image: Image,
    /// What strokes start from: the image's texels, or a canvas that is black all over, which no light may have.
    base: Canvas,
    /// With the stroke under way.
    shown: Canvas,
    /// What is shown in few texels, for the light.
    small: Canvas,
    stroke: Option<Stroke>,
    /// Where the last stroke ended.
    last: Option<DVec2>,
    texture: Option<TextureHandle>,
    /// Texels that the texture does not show yet.
    stale: Area,
}

/// What is under way.
enum Stroke {
    Freehand(paint::Stroke),
    Span {
        from: DVec2,
        to: DVec2,
    },
    /// A whole picture, to be taken or not.
    Proposed,
}

impl Sheet {
    pub(super) fn new(light: &str, image: &Image) -> Self {
        let base = Canvas::of_image(image);
        let small = reduced(&base);
        Self {
            light: light.to_owned(),
            image: image.clone(),
            stale: Area::whole(base.size()),
            shown: base.clone(),
            base,
            small,
            stroke: None,
            last: None,
            texture: None,
        }
    }

    pub(super) fn base(&self) -> &Canvas {
        &self.base
    }

    pub(super) fn shown(&self) -> &Canvas {
        &self.shown
    }

    pub(super) fn size(&self) -> [usize; 2] {
        self.shown.size()
    }

    /// Whether the canvas is black all over, and so not what the light has.
    pub(super) fn is_black(&self) -> bool {
        self.stroke.is_none() && self.base.is_black()
    }

    /// Whether another picture is shown that is not taken yet.
    pub(super) fn is_proposed(&self) -> bool {
        matches!(self.stroke, Some(Stroke::Proposed))
    }

    pub(super) fn is_busy(&self) -> bool {
        self.stroke.is_some()
    }

    /// The press of a tool at a point; `on` starts where the last stroke ended.
    pub(super) fn press(&mut self, options: &Options, at: DVec2, on: bool) {
        if options.tool.is_freehand() {
            let mut stroke = paint::Stroke::new(options.brush, options.symmetry(), self.size());
            if let Some(last) = self.last.filter(|_| on) {
                stroke.to(last);
            }
            self.stroke = Some(Stroke::Freehand(stroke));
            self.lead(options, at);
        } else if options.tool != PaintTool::Picker {
            self.stroke = Some(Stroke::Span { from: at, to: at });
            self.span_to(options, at, at);
        }
    }

    /// The tool held at a point; whether that changes anything.
    pub(super) fn lead(&mut self, options: &Options, at: DVec2) -> bool {
        match &mut self.stroke {
            Some(Stroke::Freehand(stroke)) if stroke.last() != Some(at) => {
                let changed = stroke.to(at);
                let paint = options.paint();
                self.shown.paint(&self.base, stroke.mask(), options.opacity, &changed, |_, _| paint);
                self.last = Some(at);
                self.touch(&changed);
                true
            }
            // A fill is done at the press.
            Some(Stroke::Span { from, to }) if *to != at && options.tool != PaintTool::Fill => {
                let from = *from;
                *to = at;
                self.span_to(options, from, at);
                true
            }
            _ => false,
        }
    }

    fn span_to(&mut self, options: &Options, from: DVec2, to: DVec2) {
        self.shown = options.spanned(&self.base, from, to);
        self.touch(&Area::whole(self.base.size()));
    }

    /// Where a span under way started, and where it ends.
    pub(super) fn span(&self) -> Option<[DVec2; 2]> {
        if let Some(Stroke::Span { from, to }) = self.stroke { Some([from, to]) } else { None }
    }

    /// Show another picture, to be taken by [`Self::release`] or not.
    pub(super) fn propose(&mut self, canvas: Canvas) {
        self.stroke = Some(Stroke::Proposed);
        self.shown = canvas;
        self.small = reduced(&self.shown);
        self.stale = Area::whole(self.shown.size());
    }

    /// End the stroke; the light's new image, if it has one.
    pub(super) fn release(&mut self) -> Option<Image> {
        self.stroke = None;
        self.shown.settle(&self.base);
        if self.shown == self.base {
            return None;
        }
        self.base = self.shown.clone();
        self.image = self.base.image()?;
        Some(self.image.clone())
    }

    /// Take the stroke back.
    pub(super) fn cancel(&mut self) {
        if self.stroke.take().is_some() {
            self.shown = self.base.clone();
            self.small = reduced(&self.shown);
            self.stale = Area::whole(self.shown.size());
        }
    }

    /// What the light shows meanwhile.
    pub(super) fn live(&self) -> Option<Image> {
        self.stroke.as_ref().and_then(|_| self.small.image())
    }

    /// Bring the texture and the small picture up to date in an area.
    fn touch(&mut self, area: &Area) {
        self.stale = self.stale.union(area);
        adjust::resize_part(&self.shown, &mut self.small, area);
    }

    /// The canvas as a texture.
    pub(super) fn texture(&mut self, ctx: &Context) -> &TextureHandle {
        let size = self.shown.size();
        let stale = std::mem::take(&mut self.stale);
        let texture = self.texture.get_or_insert_with(|| {
            ctx.load_texture("pattern canvas", picture(&self.shown, &Area::whole(size)), FILTER)
        });
        if texture.size() != size {
            texture.set(picture(&self.shown, &Area::whole(size)), FILTER);
        } else if !stale.is_empty() {
            texture.set_partial([stale.columns.start, stale.rows.start], picture(&self.shown, &stale), FILTER);
        }
        texture
    }
}

/// A canvas in few texels.
fn reduced(canvas: &Canvas) -> Canvas {
    let [width, height] = canvas.size();
    let longer = width.max(height).max(LIVE_SIDE);
    adjust::resized(canvas, [width, height].map(|side| (side * LIVE_SIDE).div_ceil(longer)))
}

/// An area of a canvas as it looks; what is above 1 is white.
fn picture(canvas: &Canvas, area: &Area) -> ColorImage {
    let color = |[r, g, b]: Rgb| Color32::from(Rgba::from_rgb(r.min(1.0), g.min(1.0), b.min(1.0)));
    ColorImage::new([area.columns.len(), area.rows.len()], canvas.part(area).map(color).collect())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::light::pattern::paint::Brush;

    fn sheet() -> Sheet {
        let image = Canvas::filled([200, 100], [0.25; 3]).image().expect("it shines");
        Sheet::new("screen", &image)
    }

    #[test]
    fn what_the_light_shows_meanwhile_has_few_texels_and_the_same_mean() {
        let mut sheet = sheet();
        assert!(sheet.live().is_none(), "nothing is under way");
        let options = Options { brush: Brush::new(30.0, 0.5), ..Options::default() };
        sheet.press(&options, DVec2::new(20.0, 20.0), false);
        sheet.lead(&options, DVec2::new(150.0, 70.0));
        let live = sheet.live().expect("a stroke is under way");
        let channel = &live.channels()[0];
        assert_eq!(channel.size(), [64, 32], "few texels");
        assert!((channel.mean() - sheet.shown().mean()[0]).abs() < 1e-6, "the mean: {}", channel.mean());
        assert!(channel.mean() > 0.3, "brighter than before");
    }

    #[test]
    fn a_stroke_that_is_taken_back_leaves_nothing_and_one_that_is_kept_a_new_image() {
        let mut sheet = sheet();
        let options = Options::default();
        sheet.press(&options, DVec2::new(20.0, 20.0), false);
        sheet.cancel();
        assert!(sheet.release().is_none(), "no new image");
        assert_eq!(*sheet.shown(), Canvas::filled([200, 100], [0.25; 3]), "taken back");
    }

    #[test]
    fn a_black_canvas_is_no_image_until_something_shines() {
        let mut sheet = sheet();
        sheet.propose(Canvas::filled([32, 32], [0.0; 3]));
        assert!(sheet.release().is_none() && sheet.is_black(), "the light keeps what it has");
        let options = Options::default();
        sheet.press(&options, DVec2::new(16.0, 16.0), false);
        let image = sheet.release().expect("something shines");
        assert_eq!(image.channels()[0].size(), [32, 32], "the new size");
    }
}
