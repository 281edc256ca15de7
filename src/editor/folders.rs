//! Where the editor keeps what is not in a document: the user's presets, recovery files and pictures made before.

use std::env;
use std::path::{Path, PathBuf};

/// Folders of one user. None stands for a system that has no such place; then nothing is kept.
#[derive(Clone, Debug, Default)]
pub struct Folders {
    data: Option<PathBuf>,
    cache: Option<PathBuf>,
}

impl Folders {
    /// Those of the system's user: below the window's own storage, and the system's folder for what can be made again.
    pub fn of_user() -> Self {
        let data = eframe::storage_dir(super::APP_ID);
        let cache = env::var_os("XDG_CACHE_HOME").map(PathBuf::from).filter(|path| path.is_absolute());
        let cache = match env::home_dir() {
            _ if cfg!(windows) => None,
            Some(home) if cfg!(target_os = "macos") => Some(home.join("Library/Caches")),
            Some(home) => cache.or_else(|| Some(home.join(".cache"))),
            None => cache,
        };
        let cache = cache.map(|cache| cache.join(super::APP_ID)).or_else(|| Some(data.as_ref()?.join("cache")));
        Self { data, cache }
    }

    /// All below one folder.
    pub fn below(folder: &Path) -> Self {
        Self { data: Some(folder.join("data")), cache: Some(folder.join("cache")) }
    }

    /// The user's own light presets.
    pub fn presets(&self) -> Option<PathBuf> {
        self.data.as_ref().map(|data| data.join("presets"))
    }

    /// One folder for each window that is open or was not closed properly.
    pub fn recovery(&self) -> Option<PathBuf> {
        self.data.as_ref().map(|data| data.join("recovery"))
    }

    /// Small pictures of presets and scenes.
    pub fn thumbnails(&self) -> Option<PathBuf> {
        self.cache.as_ref().map(|cache| cache.join("thumbnails"))
    }
}
