//! A window to act on, without a display.

use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex};
use std::time::{Duration, Instant};

use eframe::egui_wgpu::{RendererOptions, WgpuSetup, WgpuSetupExisting};
use egui::accesskit::Role;
use egui::{Key, Modifiers, PointerButton, Pos2, vec2};
use egui_kittest::kittest::Queryable;
use egui_kittest::{Harness, Node, SnapshotOptions};
use egui_material_icons::icons::ICON_CHECK_CIRCLE;
use image::RgbaImage;
use softbox::editor::app::App;
use softbox::editor::dialogs::{Reply, Scripted};
use softbox::editor::folders::Folders;
use softbox::editor::{Item, Session};
use softbox::scene::Scene;

/// The scene that most tests open: a polygon, a line and a sphere over a floor with a ball, and two plots.
pub(crate) const SCENE: &str = include_str!("window_and_strip.toml");

/// How far a snapshot may be off: pictures differ a little between versions of a driver.
const SNAPSHOT_THRESHOLD: f32 = 1.5;
/// Pixels of a snapshot that may be further off than that.
const SNAPSHOT_FAILED_PIXELS: usize = 1500;
/// Width of the column of measured times in the plots' legend, which differ from run to run, points.
const TIMES: f32 = 56.0;

/// How long work off the UI thread may take.
const PATIENCE: Duration = Duration::from_secs(180);

/// How long a test may act on one window.
const LIFE: Duration = Duration::from_secs(900);

/// A device for one window at a time, used again by the next: what a driver compiles and keeps for each is not all given
/// back, and wgpu may panic where two threads wait for the same.
struct Device(WgpuSetup);

/// Devices that no window has.
static SPARE: Mutex<Vec<WgpuSetup>> = Mutex::new(Vec::new());

impl Device {
    fn take() -> Self {
        let spare = SPARE.lock().expect("no test holds the list for long").pop();
        Self(spare.unwrap_or_else(|| {
            let setup = egui_kittest::wgpu::default_wgpu_setup();
            let state = egui_kittest::wgpu::create_render_state(setup, RendererOptions::PREDICTABLE);
            let existing = WgpuSetupExisting {
                instance: state.instance.clone(),
                adapter: state.adapter.clone(),
                device: state.device.clone(),
                queue: state.queue.clone(),
            };
            existing.into()
        }))
    }
}

impl Drop for Device {
    fn drop(&mut self) {
        if !std::thread::panicking()
            && let Ok(mut spare) = SPARE.lock()
        {
            spare.push(self.0.clone());
        }
    }
}

/// The editor in a window of 1280 × 800 points.
pub(crate) struct Window {
    pub(crate) harness: Harness<'static, App>,
    folder: tempfile::TempDir,
    opened: Instant,
    /// Given back when the window is gone: fields are dropped in their order.
    _device: Device,
}

/// The primary button is pressed, or let go.
pub(crate) fn primary_button(pos: Pos2, pressed: bool) -> egui::Event {
    egui::Event::PointerButton { pos, button: PointerButton::Primary, pressed, modifiers: Modifiers::NONE }
}

impl Window {
    /// A window as it opens without a file.
    pub(crate) fn new() -> Self {
        Self::on(None)
    }

    /// A window on a copy of [`SCENE`].
    pub(crate) fn with_scene() -> Self {
        Self::with(SCENE)
    }

    /// A window on a scene of that text.
    pub(crate) fn with(text: &str) -> Self {
        Self::on(Some(text))
    }

    /// A window that opens after this one has come to its end without being closed.
    pub(crate) fn crash(self) -> Self {
        let Self { harness, folder, _device: device, .. } = self;
        drop((harness, device));
        Self::in_folder(folder, None)
    }

    fn on(text: Option<&str>) -> Self {
        Self::in_folder(tempfile::tempdir().expect("a folder for the test"), text)
    }

    fn in_folder(folder: tempfile::TempDir, text: Option<&str>) -> Self {
        let folders = Folders::below(folder.path());
        let path = folder.path().join("scene.toml");
        if let Some(text) = text {
            std::fs::write(&path, text).expect("the scene is written");
        }
        let open = text.map(|_| path);
        let device = Device::take();
        let harness = Harness::builder()
            .with_size(vec2(1280.0, 800.0))
            .with_max_steps(256)
            .with_step_dt(1.0 / 30.0)
            .with_options(options())
            .wgpu_setup(device.0.clone())
            .build_eframe(|cc| {
                let mut app = App::new(cc, open.as_deref(), Box::new(Scripted::default()), &folders);
                // Only what is looked at has to be smooth.
                app.session.view.refines = false;
                app
            });
        let mut window = Self { harness, folder, opened: Instant::now(), _device: device };
        window.settle();
        window
    }

    /// A path in the test's own folder.
    pub(crate) fn path(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }

    /// What the next file dialogs are answered.
    pub(crate) fn choose(&mut self, path: Option<&Path>) {
        self.reply(path.map_or(Reply::Cancelled, |path| Reply::Chosen(path.to_owned())));
    }

    /// What comes of the next file dialog.
    pub(crate) fn reply(&mut self, reply: Reply) {
        let answers = [reply].into();
        self.harness.state_mut().dialogs = Box::new(Scripted { answers });
    }

    /// Let the window run until nothing moves any more.
    #[track_caller]
    pub(crate) fn settle(&mut self) {
        assert!(self.opened.elapsed() < LIFE, "the test goes on and on");
        let start = Instant::now();
        loop {
            // A picture that refines asks for one frame after another: how many depends on the machine.
            let is_still = self.harness.run_ok().is_some();
            let busy_with = self.harness.state().busy_with();
            if is_still && busy_with.is_none() {
                return;
            }
            let work = busy_with.unwrap_or("drawing");
            assert!(start.elapsed() < PATIENCE, "the window is still busy with {work}");
            std::thread::sleep(Duration::from_millis(5));
        }
    }

    pub(crate) fn session(&self) -> &Session {
        &self.harness.state().session
    }

    pub(crate) fn scene(&self) -> Arc<Scene> {
        Arc::clone(self.session().scene())
    }

    /// The labels of what can be undone, by undoing it all.
    #[track_caller]
    pub(crate) fn steps_back(&mut self) -> Vec<String> {
        let mut labels = Vec::new();
        while let Some(label) = self.session().history.undo_label() {
            labels.push(label.to_owned());
            let before = self.scene();
            self.key(Modifiers::COMMAND, Key::Z);
            assert!(!Arc::ptr_eq(&before, &self.scene()), "{labels:?}: the last is not undone");
        }
        labels
    }

    #[track_caller]
    pub(crate) fn get<'a>(&'a self, label: &'a str) -> Node<'a> {
        self.harness.get_by_label(label)
    }

    pub(crate) fn has(&self, label: &str) -> bool {
        self.harness.query_by_label(label).is_some()
    }

    /// Whether there is at least one such label.
    pub(crate) fn has_any(&self, label: &str) -> bool {
        self.harness.query_all_by_label(label).next().is_some()
    }

    /// Whether any label contains `text`.
    pub(crate) fn says(&self, text: &str) -> bool {
        self.harness.query_all_by_label_contains(text).next().is_some()
    }

    /// Click the widget of that label.
    #[track_caller]
    pub(crate) fn click(&mut self, label: &str) {
        self.get(label).click();
        self.settle();
    }

    /// Click the button of that label, where a tab or a row has the same.
    #[track_caller]
    pub(crate) fn click_role(&mut self, role: Role, label: &str) {
        self.harness.get_by_role_and_label(role, label).click();
        self.settle();
    }

    /// Open a menu, and choose from it and its submenus.
    #[track_caller]
    pub(crate) fn menu(&mut self, path: &[&str]) {
        for (depth, label) in path.iter().enumerate() {
            // The menu bar comes first of all, and menus last, as they lie on top; submenus have an arrow in their label.
            let all = || self.harness.query_all_by_label(label);
            let exact = if depth == 0 { all().next() } else { all().last() };
            let node = exact.or_else(|| self.harness.query_all_by_label_contains(label).last());
            node.unwrap_or_else(|| panic!("the menu has no {label}")).click();
            self.settle();
        }
    }

    /// Press a key.
    pub(crate) fn key(&mut self, modifiers: Modifiers, key: Key) {
        self.harness.key_press_modifiers(modifiers, key);
        self.settle();
    }

    /// Type a number into the field of that label, and press Enter.
    #[track_caller]
    pub(crate) fn enter(&mut self, label: &str, text: &str) {
        self.click(label);
        self.harness.key_press_modifiers(Modifiers::COMMAND, Key::A);
        self.harness.event(egui::Event::Text(text.to_owned()));
        self.settle();
        self.key(Modifiers::NONE, Key::Enter);
    }

    /// Drag with the primary button through `points`, one frame each.
    pub(crate) fn drag(&mut self, points: &[Pos2]) {
        let (Some(first), Some(last)) = (points.first(), points.last()) else { return };
        self.harness.hover_at(*first);
        self.harness.step();
        self.button(*first, true);
        for point in points {
            self.harness.hover_at(*point);
            self.harness.step();
        }
        self.button(*last, false);
        self.settle();
    }

    /// Click what has that label twice, without waiting between.
    #[track_caller]
    pub(crate) fn double_click(&mut self, label: &str) {
        let pos = self.get(label).rect().center();
        self.harness.hover_at(pos);
        self.harness.step();
        for _ in 0..2 {
            self.button(pos, true);
            self.button(pos, false);
        }
        self.settle();
    }

    fn button(&mut self, pos: Pos2, pressed: bool) {
        self.harness.event(primary_button(pos, pressed));
        self.harness.step();
    }

    /// The item that is selected, by name.
    pub(crate) fn selected(&self) -> Option<(Item, String)> {
        let item = self.session().selection.primary()?;
        Some((item, item.name(self.session().scene())?.to_owned()))
    }

    /// Compare the window, its picture smoothed, with a stored picture.
    pub(crate) fn snapshot(&mut self, name: &str) {
        self.harness.remove_cursor();
        self.harness.state_mut().session.view.refines = true;
        self.settle();
        self.outwait_messages();
        let mut picture = self.harness.render().expect("the window is drawn");
        self.take_times_from(&format!("tests/snapshots/{name}.png"), &mut picture);
        egui_kittest::image_snapshot_options(&picture, name, &options());
        self.harness.state_mut().session.view.refines = false;
    }

    /// Wait until messages that something worked are gone: how long they are still shown depends on the machine.
    fn outwait_messages(&mut self) {
        let start = Instant::now();
        while self.has_any(ICON_CHECK_CIRCLE.codepoint) {
            assert!(start.elapsed() < PATIENCE, "a message stays");
            std::thread::sleep(Duration::from_millis(50));
            self.harness.step();
        }
        self.settle();
    }

    /// Take the measured times from the stored picture, so that they are the same; not when it is to be renewed.
    fn take_times_from(&self, path: &str, picture: &mut RgbaImage) {
        let Some(heading) = self.harness.query_all_by_label("cost").next() else { return };
        let heading = heading.rect();
        let rows = self.harness.query_all_by_role(Role::CheckBox).map(|row| row.rect());
        let rows = rows.filter(|row| row.top() >= heading.top() && row.x_range().contains(heading.center().x));
        let bottom = rows.map(|row| row.bottom()).fold(heading.bottom(), f32::max);
        let Some(stored) = image::open(path).ok().filter(|_| std::env::var_os("UPDATE_SNAPSHOTS").is_none()) else {
            return;
        };
        let stored = stored.into_rgba8();
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a place in the picture")]
        let within = |low: f32, high: f32| low.max(0.0) as u32..high.max(0.0) as u32;
        for y in within(heading.bottom(), bottom) {
            for x in within(heading.right() - TIMES, heading.right()) {
                if let (Some(to), Some(from)) = (picture.get_pixel_mut_checked(x, y), stored.get_pixel_checked(x, y)) {
                    *to = *from;
                }
            }
        }
    }
}

pub(crate) fn options() -> SnapshotOptions {
    SnapshotOptions::new()
        .threshold(SNAPSHOT_THRESHOLD)
        .max_failed_pixels(SNAPSHOT_FAILED_PIXELS)
        .output_path("tests/snapshots")
}
