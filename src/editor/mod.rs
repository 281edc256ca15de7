//! The window.
//!
//! [`app::App`] puts it together. The document and all that is selected and shown is a [`Session`]; menu, keys and
//! toolbar share one list of [`commands`]; files are chosen through [`dialogs`]. [`views`] has how viewports look at the
//! scene, [`library`] what can be inserted and opened; [`recovery`] keeps unsaved work.

pub mod app;
pub mod commands;
pub mod dialogs;
pub mod exporting;
pub mod files;
pub mod folders;
pub mod fuzzy;
pub mod handles;
pub mod jobs;
pub mod library;
pub mod light_list;
pub mod panes;
pub mod plotting;
pub mod presets;
pub mod recovery;
pub mod selection;
pub mod session;
pub mod theme;
pub mod tools;
pub mod units;
pub mod variants;
pub mod viewport;
pub mod views;

mod drops;
mod edits;

pub use session::{Item, Session, Tool};

use std::path::PathBuf;

use eframe::egui_wgpu;
use egui::ViewportBuilder;

/// Why the editor did not open.
#[derive(Debug, thiserror::Error)]
pub enum EditorError {
    /// There is nowhere to show a window.
    #[error("no display to open the editor on; these work without one: softbox {HEADLESS}")]
    NoDisplay,
    /// There is nothing to draw with.
    #[error("no graphics adapter to draw the editor with; these work without one: softbox {HEADLESS}")]
    NoAdapter,
    /// The window system said no.
    #[error("the editor could not open: {0}; these work without it: softbox {HEADLESS}")]
    Window(eframe::Error),
}

/// What the system calls the program, in the names of windows and folders.
const APP_ID: &str = "softbox";

/// The commands that need neither display nor adapter.
const HEADLESS: &str = "render, plot, probe, check, verify, schema";

/// Open the editor on the scene at `path`, or on a new one, and come back when it is closed.
pub fn run(path: Option<PathBuf>) -> Result<(), EditorError> {
    if !has_display() {
        return Err(EditorError::NoDisplay);
    }
    if !has_adapter() {
        return Err(EditorError::NoAdapter);
    }
    let options = eframe::NativeOptions {
        viewport: ViewportBuilder::default()
            .with_app_id(APP_ID)
            .with_title("Softbox")
            .with_inner_size([1280.0, 760.0])
            .with_min_inner_size([900.0, 560.0]),
        renderer: eframe::Renderer::Wgpu,
        system_font_fallback: false,
        ..eframe::NativeOptions::default()
    };
    let create: eframe::AppCreator<'_> = Box::new(move |cc| {
        Ok(Box::new(app::App::new(cc, path.as_deref(), Box::new(dialogs::Native), &folders::Folders::of_user())))
    });
    eframe::run_native("softbox", options, create).map_err(|error| match error {
        eframe::Error::WinitEventLoop(_) | eframe::Error::Winit(_) => EditorError::NoDisplay,
        eframe::Error::Wgpu(egui_wgpu::WgpuError::RequestAdapterError(_)) => EditorError::NoAdapter,
        other => EditorError::Window(other),
    })
}

/// Whether the environment names a display; only X11 and Wayland can be without one.
fn has_display() -> bool {
    let named = |name| std::env::var_os(name).is_some_and(|value| !value.is_empty());
    !cfg!(target_os = "linux") || named("DISPLAY") || named("WAYLAND_DISPLAY") || named("WAYLAND_SOCKET")
}

/// Whether there is any adapter at all.
fn has_adapter() -> bool {
    let instance = wgpu::Instance::new(wgpu::InstanceDescriptor::new_without_display_handle());
    !pollster::block_on(instance.enumerate_adapters(wgpu::Backends::all())).is_empty()
}
