//! Choosing files, behind a trait so that tests choose them too.

use std::collections::VecDeque;
use std::path::{Path, PathBuf};
use std::sync::mpsc::{Receiver, TryRecvError, channel};

/// A dialog that may still be open.
#[derive(Debug)]
pub struct Answer(Receiver<Option<PathBuf>>);

/// Asks the user for files, without holding up the window.
pub trait Dialogs {
    /// Which scene to open.
    fn open_scene(&mut self, ctx: &egui::Context, folder: Option<&Path>) -> Answer;

    /// Where to save a scene that would be called `name`.
    fn save_scene(&mut self, ctx: &egui::Context, folder: Option<&Path>, name: &str) -> Answer;
}

/// The desktop's own dialogs.
#[derive(Clone, Copy, Debug, Default)]
pub struct Native;

/// Answers given beforehand, for tests; without one left, every dialog is cancelled.
#[derive(Clone, Debug, Default)]
pub struct Scripted {
    /// What the next dialogs are answered.
    pub answers: VecDeque<Option<PathBuf>>,
}

impl Answer {
    /// An answer that is already there.
    pub fn ready(path: Option<PathBuf>) -> Self {
        let (sender, receiver) = channel();
        // The receiver is alive: it is returned.
        let _ = sender.send(path);
        Self(receiver)
    }

    /// `None` while the dialog is open, then what was chosen: nothing, when it was cancelled.
    pub fn poll(&self) -> Option<Option<PathBuf>> {
        match self.0.try_recv() {
            Ok(path) => Some(path),
            Err(TryRecvError::Empty) => None,
            Err(TryRecvError::Disconnected) => Some(None),
        }
    }
}

impl Native {
    fn dialog(folder: Option<&Path>) -> rfd::AsyncFileDialog {
        let dialog = rfd::AsyncFileDialog::new().add_filter("Softbox scene", &["toml"]);
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
            let chosen = pollster::block_on(dialog).map(|file| file.path().to_path_buf());
            if sender.send(chosen).is_ok() {
                ctx.request_repaint();
            }
        });
        Answer(receiver)
    }
}

impl Dialogs for Native {
    fn open_scene(&mut self, ctx: &egui::Context, folder: Option<&Path>) -> Answer {
        Self::wait(ctx, Self::dialog(folder).set_title("Open scene").pick_file())
    }

    fn save_scene(&mut self, ctx: &egui::Context, folder: Option<&Path>, name: &str) -> Answer {
        Self::wait(ctx, Self::dialog(folder).set_title("Save scene").set_file_name(name).save_file())
    }
}

impl Dialogs for Scripted {
    fn open_scene(&mut self, _ctx: &egui::Context, _folder: Option<&Path>) -> Answer {
        Answer::ready(self.answers.pop_front().flatten())
    }

    fn save_scene(&mut self, _ctx: &egui::Context, _folder: Option<&Path>, _name: &str) -> Answer {
        Answer::ready(self.answers.pop_front().flatten())
    }
}
