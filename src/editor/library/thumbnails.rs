//! Small pictures of presets and scenes, rendered aside and kept on the disk.

use std::collections::HashMap;
use std::fs;
use std::hash::{DefaultHasher, Hash, Hasher};
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::mpsc::{Receiver, Sender, channel};

use egui::{ColorImage, Context, TextureHandle, TextureOptions};

use super::Source;
use crate::light::Shape;
use crate::render::Progress;
use crate::render::thumbnail::thumbnail;
use crate::scene::{self, Scene};

/// Width and height, pixels.
pub const SIZE: [u32; 2] = [128, 80];
/// Another number wherever thumbnails come to look different, so that old ones are not used.
const VERSION: u32 = 2;
/// Most rays a pixel.
const SAMPLES: u32 = 4;

/// Thumbnails, each made when it is first asked for; see the [module](self).
#[derive(Default)]
pub struct Thumbnails {
    cache: Option<PathBuf>,
    known: HashMap<Source, Option<TextureHandle>>,
    worker: Option<Worker>,
    waiting: usize,
}

/// A thread that makes them one by one.
struct Worker {
    requests: Sender<Source>,
    answers: Receiver<(Source, Option<Picture>)>,
    progress: Arc<Progress>,
}

/// Pixels, sRGB, row by row.
type Picture = Vec<[u8; 3]>;

impl Thumbnails {
    /// Thumbnails that are kept in the folder `cache`, if there is one.
    pub fn new(cache: Option<PathBuf>) -> Self {
        Self { cache, ..Self::default() }
    }

    /// The thumbnail, if it is there yet; if not, it will be, and the window wakes then.
    pub fn get(&mut self, ctx: &Context, source: &Source) -> Option<&TextureHandle> {
        self.poll(ctx);
        if !self.known.contains_key(source) {
            self.known.insert(source.clone(), None);
            let cache = self.cache.clone();
            let worker = self.worker.get_or_insert_with(|| Worker::spawn(ctx.clone(), cache));
            if worker.requests.send(source.clone()).is_ok() {
                self.waiting += 1;
            }
        }
        self.known.get(source)?.as_ref()
    }

    /// Whether some are being made.
    pub fn is_busy(&self) -> bool {
        self.waiting > 0
    }

    fn poll(&mut self, ctx: &Context) {
        let Some(worker) = &self.worker else { return };
        while let Ok((source, picture)) = worker.answers.try_recv() {
            self.waiting = self.waiting.saturating_sub(1);
            let texture = picture.map(|picture| {
                let size = SIZE.map(|side| side as usize);
                let image = ColorImage::from_rgb(size, picture.as_flattened());
                ctx.load_texture("thumbnail", image, TextureOptions::LINEAR)
            });
            self.known.insert(source, texture);
        }
    }
}

impl Drop for Worker {
    fn drop(&mut self) {
        self.progress.cancel();
    }
}

impl Worker {
    fn spawn(ctx: Context, cache: Option<PathBuf>) -> Self {
        let (requests, inbox) = channel::<Source>();
        let (outbox, answers) = channel();
        let progress = Arc::new(Progress::default());
        let cancelled = Arc::clone(&progress);
        let work = move || {
            for source in inbox {
                let picture = source.load().ok().and_then(|scene| picture(&scene, cache.as_deref(), &cancelled));
                if cancelled.is_cancelled() || outbox.send((source, picture)).is_err() {
                    return;
                }
                ctx.request_repaint();
            }
        };
        // Without a thread there are no answers, and no thumbnails.
        let _ = std::thread::Builder::new().name("thumbnails".to_owned()).spawn(work);
        Self { requests, answers, progress }
    }
}

/// A scene's thumbnail: the one that the disk has, or a new one, which is then put there.
fn picture(scene: &Scene, cache: Option<&Path>, progress: &Progress) -> Option<Picture> {
    let file = cache.map(|cache| cache.join(format!("{:016x}.png", digest(scene))));
    if let Some(picture) = file.as_deref().and_then(read) {
        return Some(picture);
    }
    let picture = render(scene, progress)?;
    if let Some(file) = file {
        // One that cannot be kept is rendered again another time.
        let _ = write(&file, &picture);
    }
    Some(picture)
}

/// A number that is the same only for scenes that look the same.
fn digest(scene: &Scene) -> u64 {
    let mut hasher = DefaultHasher::new();
    (VERSION, SIZE, SAMPLES, scene::to_toml(scene)).hash(&mut hasher);
    for light in &scene.lights {
        if let Shape::Textured(textured) = &light.shape {
            textured.pattern.contents.0.hash(&mut hasher);
        }
        if let Shape::Point(point) = &light.shape
            && let Some(photometry) = &point.ies
        {
            photometry.contents.0.hash(&mut hasher);
        }
    }
    for surface in &scene.surfaces {
        if let crate::surface::Shape::Mesh(mesh) = &surface.shape {
            mesh.contents.0.hash(&mut hasher);
        }
    }
    hasher.finish()
}

/// Render on one thread, so that the window keeps the others.
fn render(scene: &Scene, progress: &Progress) -> Option<Picture> {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build().ok()?;
    pool.install(|| thumbnail(scene, SIZE, SAMPLES, progress))
}

fn read(file: &Path) -> Option<Picture> {
    let image = image::open(file).ok()?.into_rgb8();
    ([image.width(), image.height()] == SIZE).then(|| image.pixels().map(|pixel| pixel.0).collect())
}

fn write(file: &Path, picture: &Picture) -> Option<()> {
    fs::create_dir_all(file.parent()?).ok()?;
    let image = image::RgbImage::from_raw(SIZE[0], SIZE[1], picture.as_flattened().to_vec())?;
    let mut bytes = std::io::Cursor::new(Vec::new());
    image.write_to(&mut bytes, image::ImageFormat::Png).ok()?;
    scene::replace_file(file, &bytes.into_inner()).ok()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::editor::presets::LIGHTS;

    #[test]
    fn a_thumbnail_is_rendered_once_and_then_read_from_the_disk() {
        let folder = tempfile::tempdir().expect("a folder");
        let cache = folder.path().join("thumbnails");
        let scene = LIGHTS[1].load().expect("a preset");
        let rendered = picture(&scene, Some(&cache), &Progress::default()).expect("a picture");
        let (dark, bright) =
            (rendered.iter().filter(|p| p[1] < 40).count(), rendered.iter().filter(|p| p[1] > 150).count());
        assert!(bright > 300 && dark > 300, "{bright} bright and {dark} dark pixels");
        let progress = Progress::default();
        assert_eq!(picture(&scene, Some(&cache), &progress).as_ref(), Some(&rendered), "the same from the disk");
        assert_eq!(progress.done(), 0, "not rendered again");
        let other = Scene { name: "other".to_owned(), ..scene.clone() };
        assert_ne!(digest(&other), digest(&scene), "another scene is another picture");
    }
}
