//! Choosing files, behind a trait so that tests choose them too.

use std::collections::VecDeque;
use std::path::{Path, PathBuf};
use std::sync::mpsc::{Receiver, TryRecvError, channel};
use std::time::{Duration, Instant};

/// What came of a dialog.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Reply {
    /// This file was chosen.
    Chosen(PathBuf),
    /// The user changed their mind.
    Cancelled,
    /// No dialog was shown: the desktop has none.
    Unavailable,
}

/// A dialog that may still be open.
#[derive(Debug)]
pub struct Answer(Receiver<Reply>);

/// A dialog that comes back without a file in less time than this was not shown: nobody cancels so fast.
const LEAST_TIME: Duration = Duration::from_millis(150);

/// Asks the user for files, without holding up the window.
pub trait Dialogs {
    /// Which scene to open.
    fn open_scene(&mut self, ctx: &egui::Context, folder: Option<&Path>) -> Answer;

    /// Where to save a scene that would be called `name`.
    fn save_scene(&mut self, ctx: &egui::Context, folder: Option<&Path>, name: &str) -> Answer;

    /// Which picture to use as a pattern.
    fn open_picture(&mut self, ctx: &egui::Context, folder: Option<&Path>) -> Answer;

    /// Which OBJ file to use as a mesh.
    fn open_mesh(&mut self, ctx: &egui::Context, folder: Option<&Path>) -> Answer;

    /// Which IES file to use for a point light.
    fn open_photometry(&mut self, ctx: &egui::Context, folder: Option<&Path>) -> Answer;

    /// Where to write what would be called `name`, which ends in the extension of its kind.
    fn export(&mut self, ctx: &egui::Context, folder: Option<&Path>, name: &str) -> Answer;
}

/// The desktop's own dialogs.
#[derive(Clone, Copy, Debug, Default)]
pub struct Native;

/// Answers given beforehand, for tests; without one left, every dialog is cancelled.
#[derive(Clone, Debug, Default)]
pub struct Scripted {
    /// What the next dialogs are answered.
    pub answers: VecDeque<Reply>,
}

impl Answer {
    /// An answer that is already there.
    pub fn ready(reply: Reply) -> Self {
        let (sender, receiver) = channel();
        // The receiver is alive: it is returned.
        let _ = sender.send(reply);
        Self(receiver)
    }

    /// `None` while the dialog is open, then what came of it.
    pub fn poll(&self) -> Option<Reply> {
        match self.0.try_recv() {
            Ok(reply) => Some(reply),
            Err(TryRecvError::Empty) => None,
            Err(TryRecvError::Disconnected) => Some(Reply::Unavailable),
        }
    }
}

impl Native {
    fn scenes(folder: Option<&Path>) -> rfd::AsyncFileDialog {
        Self::start(rfd::AsyncFileDialog::new().add_filter("Softbox scene", &["toml"]), folder)
    }

    fn start(dialog: rfd::AsyncFileDialog, folder: Option<&Path>) -> rfd::AsyncFileDialog {
        match folder {
            Some(folder) => dialog.set_directory(folder),
            None => dialog,
        }
    }

    /// Wait for the dialog on a thread of its own, and wake the window when it is done.
    fn wait(ctx: &egui::Context, dialog: impl Future<Output = Option<rfd::FileHandle>> + Send + 'static) -> Answer {
        let (sender, receiver) = channel();
        let ctx = ctx.clone();
        std::thread::spawn(move || {
            let shown = Instant::now();
            let reply = match pollster::block_on(dialog) {
                Some(file) => Reply::Chosen(file.path().to_path_buf()),
                None if shown.elapsed() < LEAST_TIME => Reply::Unavailable,
                None => Reply::Cancelled,
            };
            if sender.send(reply).is_ok() {
                ctx.request_repaint();
            }
        });
        Answer(receiver)
    }
}

impl Dialogs for Native {
    fn open_scene(&mut self, ctx: &egui::Context, folder: Option<&Path>) -> Answer {
        Self::wait(ctx, Self::scenes(folder).set_title("Open scene").pick_file())
    }

    fn save_scene(&mut self, ctx: &egui::Context, folder: Option<&Path>, name: &str) -> Answer {
        Self::wait(ctx, Self::scenes(folder).set_title("Save scene").set_file_name(name).save_file())
    }

    fn open_picture(&mut self, ctx: &egui::Context, folder: Option<&Path>) -> Answer {
        let pictures = rfd::AsyncFileDialog::new().add_filter("Picture", &["png", "jpg", "jpeg", "exr", "hdr"]);
        Self::wait(ctx, Self::start(pictures, folder).set_title("Choose a pattern").pick_file())
    }

    fn open_mesh(&mut self, ctx: &egui::Context, folder: Option<&Path>) -> Answer {
        let meshes = rfd::AsyncFileDialog::new().add_filter("Wavefront OBJ", &["obj"]);
        Self::wait(ctx, Self::start(meshes, folder).set_title("Choose a mesh").pick_file())
    }

    fn open_photometry(&mut self, ctx: &egui::Context, folder: Option<&Path>) -> Answer {
        let files = rfd::AsyncFileDialog::new().add_filter("IES (LM-63)", &["ies", "IES"]);
        Self::wait(ctx, Self::start(files, folder).set_title("Choose an IES file").pick_file())
    }

    fn export(&mut self, ctx: &egui::Context, folder: Option<&Path>, name: &str) -> Answer {
        let extension = Path::new(name).extension().unwrap_or_default().to_string_lossy();
        let files = rfd::AsyncFileDialog::new().add_filter(extension.to_uppercase(), &[&*extension]);
        Self::wait(ctx, Self::start(files, folder).set_title("Export").set_file_name(name).save_file())
    }
}

impl Scripted {
    fn next(&mut self) -> Answer {
        Answer::ready(self.answers.pop_front().unwrap_or(Reply::Cancelled))
    }
}

impl Dialogs for Scripted {
    fn open_scene(&mut self, _ctx: &egui::Context, _folder: Option<&Path>) -> Answer {
        self.next()
    }

    fn save_scene(&mut self, _ctx: &egui::Context, _folder: Option<&Path>, _name: &str) -> Answer {
        self.next()
    }

    fn open_picture(&mut self, _ctx: &egui::Context, _folder: Option<&Path>) -> Answer {
        self.next()
    }

    fn open_mesh(&mut self, _ctx: &egui::Context, _folder: Option<&Path>) -> Answer {
        self.next()
    }
    fn open_photometry(&mut self, _ctx: &egui::Context, _folder: Option<&Path>) -> Answer {
        self.next()
    }

    fn export(&mut self, _ctx: &egui::Context, _folder: Option<&Path>, _name: &str) -> Answer {
        self.next()
    }
}
