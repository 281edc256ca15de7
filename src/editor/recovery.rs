//! Unsaved work is written aside every half minute, and offered when the program starts after it was not closed properly.
//!
//! Each window has a folder of its own, held by a lock for as long as the window lives: another window offers only what
//! nobody holds. In it, a numbered folder has the scene, the files that it names, and, written last, a note of where it
//! belongs. A newer one is complete before the older goes, so that at any moment there is one that can be recovered.

use std::fs::{self, File};
use std::io;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicU32, Ordering};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::{Duration, SystemTime};

use serde::{Deserialize, Serialize};

use super::jobs::Latest;
use super::library::Source;
use super::session::Session;
use crate::scene::{self, LoadError, Scene};

/// How long a change may stay unwritten, seconds.
pub const AUTOSAVE_SECONDS: f64 = 30.0;

const LOCK: &str = "lock";
const SCENE: &str = "scene.toml";
const NOTE: &str = "recovery.json";

/// Where recovered work belongs.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
struct Note {
    /// The document's name for people.
    title: String,
    /// The document's file, if it had one.
    path: Option<PathBuf>,
}

/// Writes unsaved work aside; see the [module](self).
#[derive(Debug)]
pub struct Recovery {
    place: Option<Arc<Place>>,
    writer: Option<Latest<Work, String>>,
    /// What was written last, or asked to be.
    written: Option<Arc<Scene>>,
    /// When the changes since then have to be written, by the window's clock.
    due: Option<f64>,
}

/// Something to write.
#[derive(Debug)]
struct Work {
    scene: Arc<Scene>,
    note: Note,
}

/// The folder of this window.
#[derive(Debug)]
struct Place {
    folder: PathBuf,
    /// Held while the window lives; none once its folder is gone.
    lock: Mutex<Option<File>>,
    count: AtomicU32,
}

/// Work that was not saved when the program ended.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Offer {
    /// The folder of the window that it was open in.
    folder: PathBuf,
    /// The scene in it.
    scene: PathBuf,
    /// The document's name for people.
    pub title: String,
    /// The document's file, if it had one.
    pub path: Option<PathBuf>,
    /// When it was written.
    pub time: SystemTime,
}

impl Recovery {
    /// Recovery below `folder`, and what earlier windows left there.
    pub fn new(folder: Option<PathBuf>) -> (Self, Vec<Offer>) {
        let offers = folder.as_deref().map(offers).unwrap_or_default();
        let place = folder.and_then(|folder| Place::new(&folder).ok()).map(Arc::new);
        (Self { place, writer: None, written: None, due: None }, offers)
    }

    /// Write what is due, and have the window wake when something will be. Without unsaved changes nothing is done.
    ///
    /// What went wrong is returned.
    pub fn update(&mut self, ctx: &egui::Context, session: &Session) -> Option<String> {
        let failure = self.writer.as_mut().and_then(Latest::poll);
        if self.place.is_none() {
            return failure;
        }
        if !session.history.is_modified() {
            self.forget();
            return failure;
        }
        if self.written.as_ref().is_some_and(|written| Arc::ptr_eq(written, session.scene())) {
            self.due = None;
            return failure;
        }
        let now = ctx.input(|input| input.time);
        let due = *self.due.get_or_insert(now + AUTOSAVE_SECONDS);
        if now < due {
            ctx.request_repaint_after(Duration::from_secs_f64(due - now));
        } else if !session.history.in_gesture() {
            self.due = None;
            self.write(session);
        }
        failure
    }

    /// Write the document now, off this thread.
    fn write(&mut self, session: &Session) {
        let Some(place) = &self.place else { return };
        if self.writer.is_none() {
            let place = Arc::clone(place);
            let work = move |work: Work, _: &_, answer: &mut dyn FnMut(String)| {
                if let Err(error) = place.write(&work) {
                    answer(format!("Unsaved work could not be written aside: {error}"));
                }
            };
            self.writer = Latest::spawn("recovery", || (), work);
        }
        self.written = Some(Arc::clone(session.scene()));
        if let Some(writer) = &mut self.writer {
            writer.submit(Work { scene: Arc::clone(session.scene()), note: Note::of(session) });
        }
    }

    /// Write recovered work aside anew, and then delete what it was recovered from.
    pub fn adopt(&mut self, offer: &Offer, session: &Session) {
        let Some(place) = &self.place else { return };
        let work = Work { scene: Arc::clone(session.scene()), note: Note::of(session) };
        if place.write(&work).is_ok() {
            self.written = Some(work.scene);
            offer.discard();
        }
    }

    /// The document is saved or gone: nothing is to be recovered.
    pub fn forget(&mut self) {
        self.due = None;
        if self.written.take().is_some()
            && let Some(place) = &self.place
        {
            place.clear();
        }
    }

    /// The window closes: leave nothing behind.
    pub fn close(&mut self) {
        if let Some(place) = self.place.take() {
            place.close();
        }
        self.writer = None;
    }

    /// Whether a file is being written.
    pub fn is_busy(&self) -> bool {
        self.writer.as_ref().is_some_and(Latest::is_busy)
    }
}

impl Note {
    fn of(session: &Session) -> Self {
        Self { title: session.title(), path: session.path.clone() }
    }
}

impl Place {
    fn new(folder: &Path) -> io::Result<Self> {
        fs::create_dir_all(folder)?;
        // A process has one window, but tests have many.
        static WINDOWS: AtomicU32 = AtomicU32::new(0);
        let window = WINDOWS.fetch_add(1, Ordering::Relaxed);
        let since = SystemTime::now().duration_since(SystemTime::UNIX_EPOCH).unwrap_or_default();
        let folder = folder.join(format!("{}-{}-{window}", since.as_millis(), std::process::id()));
        fs::create_dir(&folder)?;
        let lock = File::create(folder.join(LOCK))?;
        lock.try_lock().map_err(io::Error::from)?;
        Ok(Self { folder, lock: Mutex::new(Some(lock)), count: AtomicU32::new(0) })
    }

    fn write(&self, work: &Work) -> Result<(), String> {
        let lock = self.lock.lock().unwrap_or_else(PoisonError::into_inner);
        if lock.is_none() {
            return Ok(());
        }
        let number = self.count.fetch_add(1, Ordering::Relaxed);
        let folder = self.folder.join(number.to_string());
        fs::create_dir_all(&folder).map_err(|error| error.to_string())?;
        let source = work.note.path.clone().unwrap_or_else(|| folder.join(SCENE));
        scene::save_as(&work.scene, folder.join(SCENE), source).map_err(|error| error.to_string())?;
        let note = serde_json::to_vec(&work.note).map_err(|error| error.to_string())?;
        scene::replace_file(&folder.join(NOTE), &note).map_err(|error| error.to_string())?;
        for older in numbered(&self.folder).into_iter().filter(|(other, _)| *other < number) {
            // What cannot be deleted now is gone when the window closes.
            let _ = fs::remove_dir_all(older.1);
        }
        Ok(())
    }

    /// Delete what was written, but stay.
    fn clear(&self) {
        let _lock = self.lock.lock().unwrap_or_else(PoisonError::into_inner);
        for (_, folder) in numbered(&self.folder) {
            let _ = fs::remove_dir_all(folder);
        }
    }

    /// Delete everything, after what is being written now.
    fn close(&self) {
        let mut lock = self.lock.lock().unwrap_or_else(PoisonError::into_inner);
        *lock = None;
        // At worst an empty folder stays, which the next start deletes.
        let _ = fs::remove_dir_all(&self.folder);
    }
}

impl Offer {
    /// Where its scene is.
    pub fn source(&self) -> Source {
        Source::file(&self.scene)
    }

    /// The scene that was not saved.
    pub fn load(&self) -> Result<Scene, LoadError> {
        scene::load(&self.scene)
    }

    /// Delete it.
    pub fn discard(&self) {
        let _ = fs::remove_dir_all(&self.folder);
    }
}

/// What windows that are no more have left below `folder`, the latest first; folders without anything are deleted.
fn offers(folder: &Path) -> Vec<Offer> {
    let Ok(entries) = fs::read_dir(folder) else { return Vec::new() };
    let mut offers: Vec<Offer> = entries
        .filter_map(|entry| {
            let folder = entry.ok()?.path();
            if !is_orphan(&folder) {
                return None;
            }
            let offer = numbered(&folder).into_iter().rev().find_map(|(_, saved)| offer(&folder, &saved));
            if offer.is_none() {
                let _ = fs::remove_dir_all(&folder);
            }
            offer
        })
        .collect();
    offers.sort_by_key(|offer| std::cmp::Reverse(offer.time));
    offers
}

/// Whether nobody holds the folder.
fn is_orphan(folder: &Path) -> bool {
    folder.is_dir() && File::open(folder.join(LOCK)).is_ok_and(|lock| lock.try_lock().is_ok())
}

fn offer(folder: &Path, saved: &Path) -> Option<Offer> {
    let note = saved.join(NOTE);
    let time = fs::metadata(&note).and_then(|metadata| metadata.modified()).ok()?;
    let Note { title, path } = serde_json::from_slice(&fs::read(&note).ok()?).ok()?;
    Some(Offer { folder: folder.to_owned(), scene: saved.join(SCENE), title, path, time })
}

/// The numbered folders in a window's folder, in order.
fn numbered(folder: &Path) -> Vec<(u32, PathBuf)> {
    let entries = fs::read_dir(folder).into_iter().flatten().flatten();
    let mut folders: Vec<_> =
        entries.filter_map(|entry| Some((entry.file_name().to_str()?.parse().ok()?, entry.path()))).collect();
    folders.sort();
    folders
}

/// How long ago something was, in words.
pub fn age(time: SystemTime) -> String {
    let minutes = time.elapsed().unwrap_or_default().as_secs() / 60;
    let count = |n: u64, what: &str| format!("{n} {what}{} ago", if n == 1 { "" } else { "s" });
    match minutes {
        0 => "just now".to_owned(),
        1..60 => count(minutes, "minute"),
        60..1440 => count(minutes / 60, "hour"),
        _ => count(minutes / 1440, "day"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn work(name: &str) -> Work {
        let scene = Arc::new(Scene { name: name.to_owned(), ..scene::first_light() });
        Work { scene, note: Note { title: name.to_owned(), path: Some(PathBuf::from("/a/b.toml")) } }
    }

    #[test]
    fn what_a_window_left_is_offered_once_it_is_gone_and_the_latest_of_it() {
        let folder = tempfile::tempdir().expect("a folder");
        let place = Place::new(folder.path()).expect("a window's folder");
        place.write(&work("one")).expect("written");
        place.write(&work("two")).expect("written again");
        assert_eq!(offers(folder.path()), [], "the window is still open");
        drop(place);
        let found = offers(folder.path());
        assert_eq!(found.len(), 1, "one window");
        assert_eq!(found[0].title, "two", "the latest");
        assert_eq!(found[0].path.as_deref(), Some(Path::new("/a/b.toml")), "and where it belongs");
        assert_eq!(found[0].load().expect("it opens").name, "two", "the scene");
        found[0].discard();
        assert_eq!(offers(folder.path()), [], "discarded");
    }

    #[test]
    fn what_was_not_finished_is_not_offered_but_what_was_before_it() {
        let folder = tempfile::tempdir().expect("a folder");
        let place = Place::new(folder.path()).expect("a window's folder");
        place.write(&work("whole")).expect("written");
        // The program ended while the next was being written.
        let torn = place.folder.join("7");
        fs::create_dir(&torn).expect("a folder");
        fs::write(torn.join(SCENE), "format = ").expect("half a scene");
        drop(place);
        assert_eq!(offers(folder.path())[0].title, "whole", "the complete one");
    }

    #[test]
    fn a_window_that_closes_leaves_nothing_and_writes_nothing_more() {
        let folder = tempfile::tempdir().expect("a folder");
        let place = Place::new(folder.path()).expect("a window's folder");
        place.write(&work("one")).expect("written");
        place.close();
        place.write(&work("late")).expect("nothing to do");
        drop(place);
        assert_eq!(fs::read_dir(folder.path()).expect("the folder").count(), 0, "empty");
    }

    #[test]
    fn ages_are_told_in_words() {
        let ago = |seconds| age(SystemTime::now() - Duration::from_secs(seconds));
        let words = [ago(5), ago(61), ago(600), ago(7300), ago(90_000)];
        assert_eq!(words, ["just now", "1 minute ago", "10 minutes ago", "2 hours ago", "1 day ago"], "ages");
    }
}
