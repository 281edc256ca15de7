//! Changes to the document that are more than a number: add, duplicate, delete, rename, insert.

use std::collections::BTreeSet;
use std::path::Path;
use std::sync::LazyLock;

use glam::{DVec2, DVec3};

use super::session::{Item, Session};
use crate::light::pattern::{Image, Pattern};
use crate::light::photometry::Photometry;
use crate::light::{Light, Point, Polygon, Shape, Textured};
use crate::scene::{self, Plot, PlotKind, PlotQuantity, Scene};
use crate::surface::{self, Material, Mesh, ReflectionModel, Surface};

/// How far a copy is put from its original, metres.
const COPY_OFFSET: DVec3 = DVec3::new(0.25, 0.25, 0.0);

impl Session {
    /// Add a light called after what it is, select it, and say so in the undo menu.
    pub fn add_light(&mut self, mut light: Light) {
        let label = format!("Add {}", light.name);
        light.name = unique_name(self.scene().lights.iter().map(|other| &other.name), &light.name);
        scene::keep_apart(&mut light, self.scene().all_lights());
        let index = self.scene().lights.len();
        self.edit(&label, |scene| scene.lights.push(light));
        self.selection.set([Item::Light(index)]);
    }

    /// Give the light of that name another pattern.
    pub fn replace_pattern(&mut self, name: &str, pattern: Pattern) {
        let Some(index) = self.scene().lights.iter().position(|light| light.name == name) else { return };
        let mut light = self.scene().lights[index].clone();
        let Shape::Textured(textured) = &mut light.shape else { return };
        textured.pattern = pattern;
        let replaced = &self.scene().lights[index];
        scene::keep_apart(&mut light, self.scene().all_lights().filter(|other| !std::ptr::eq(*other, replaced)));
        self.edit("Replace pattern", |scene| scene.lights[index] = light);
    }

    /// Give the point light of that name the intensities of another file, as bright as the file says.
    pub fn replace_photometry(&mut self, name: &str, photometry: Photometry) {
        let Some(index) = self.scene().lights.iter().position(|light| light.name == name) else { return };
        let old = &self.scene().lights[index];
        let Light { quantity, shape, .. } = measured(photometry);
        let mut light = Light { quantity, shape, ..old.clone() };
        scene::keep_apart(&mut light, self.scene().all_lights().filter(|other| !std::ptr::eq(*other, old)));
        self.edit("Replace IES file", |scene| scene.lights[index] = light);
    }

    /// Let the point light of that name shine the same all around; its brightness stays.
    pub fn remove_photometry(&mut self, name: &str) {
        let Some(index) = self.scene().lights.iter().position(|light| light.name == name) else { return };
        self.edit("Remove IES file", |scene| scene.lights[index].shape = Shape::Point(Point { ies: None }));
    }

    /// Give a light what was painted over its pattern.
    pub fn repaint_pattern(&mut self, index: usize, image: Image, step: &str) {
        let Some(mut light) = self.scene().lights.get(index).cloned() else { return };
        let Shape::Textured(textured) = &mut light.shape else { return };
        textured.pattern = scene::painted_pattern(image, &textured.pattern, self.path.as_deref());
        let others = self.scene().all_lights().enumerate().filter(|(i, _)| *i != index);
        let others: Vec<Light> = others.map(|(_, other)| other.clone()).collect();
        scene::keep_apart(&mut light, &others);
        self.edit(step, |scene| scene.lights[index] = light);
    }

    /// Add a square light of a generated image.
    pub fn add_painted_light(&mut self, image: Image) {
        let pattern = scene::painted_pattern(image, &Pattern::unread("pattern.png"), self.path.as_deref());
        self.add_light(textured(pattern));
    }

    /// Give the surface of that name another mesh.
    pub fn replace_mesh(&mut self, name: &str, mesh: Mesh) {
        let Some(index) = self.scene().surfaces.iter().position(|surface| surface.name == name) else { return };
        let mut surface = Surface { shape: surface::Shape::Mesh(mesh), ..self.scene().surfaces[index].clone() };
        let others: Vec<Surface> = self.scene().surfaces.iter().filter(|other| other.name != name).cloned().collect();
        scene::keep_mesh_apart(&mut surface, &others);
        self.edit("Replace mesh", |scene| scene.surfaces[index] = surface);
    }

    /// Add a surface, with a material where the scene has none, and select it.
    pub fn add_surface(&mut self, shape: surface::Shape) {
        let base = match &shape {
            surface::Shape::Mesh(mesh) => stem(&mesh.file),
            _ => shape.name().to_owned(),
        };
        let label = format!("Add {}", shape.name());
        let mut surface = Surface {
            name: unique_name(self.scene().surfaces.iter().map(|other| &other.name), &base),
            material: String::new(),
            position: resting_position(&shape),
            rotation_deg: DVec3::ZERO,
            scale: DVec3::ONE,
            shape,
        };
        scene::keep_mesh_apart(&mut surface, &self.scene().surfaces);
        let index = self.scene().surfaces.len();
        self.edit(&label, |scene| {
            if scene.materials.is_empty() {
                scene.materials.push(new_material("material".to_owned()));
            }
            surface.material.clone_from(&scene.materials[0].name);
            scene.surfaces.push(surface);
        });
        self.selection.set([Item::Surface(index)]);
    }

    /// Add a material and select it.
    pub fn add_material(&mut self) {
        let name = unique_name(self.scene().materials.iter().map(|other| &other.name), "material");
        let index = self.scene().materials.len();
        self.edit("Add material", |scene| scene.materials.push(new_material(name)));
        self.selection.set([Item::Material(index)]);
    }

    /// Add a plot, select it and bring it to the front.
    pub fn add_plot(&mut self, kind: PlotKind) {
        let name = unique_name(self.scene().plots.iter().map(|other| &other.name), kind_name(kind));
        let index = self.scene().plots.len();
        self.edit("Add plot", |scene| scene.plots.push(new_plot(name, kind)));
        self.selection.set([Item::Plot(index)]);
        self.plots.active = index;
    }

    /// Copy what is selected, next to itself, and select the copies.
    pub fn duplicate_selection(&mut self) {
        let items = self.selection.items().to_vec();
        let mut copies = Vec::new();
        self.edit("Duplicate", |scene| copies = items.iter().filter_map(|item| duplicate(scene, *item)).collect());
        self.selection.set(copies);
    }

    /// Delete the chosen corner of a polygon, else what is selected; a material that a surface or a plot uses stays, and the user is told.
    pub fn delete_selection(&mut self) {
        if self.corner().is_some() {
            return self.delete_corner();
        }
        let mut items = self.selection.items().to_vec();
        let used = |item: &Item| matches!(item, Item::Material(_)) && is_used(self.scene(), *item, &items);
        let kept: Vec<Item> = items.iter().filter(|item| used(item)).copied().collect();
        for item in &kept {
            let name = item.name(self.scene()).unwrap_or_default().to_owned();
            self.failed(format!("“{name}” is in use: give its surfaces and plots another material first"));
        }
        items.retain(|item| !kept.contains(item));
        match items.as_slice() {
            [] => {}
            [item] => self.undoable(format!("Deleted {}", item.name(self.scene()).unwrap_or_default())),
            several => self.undoable(format!("Deleted {} things", several.len())),
        }
        // From the end of each list, so that what is left keeps its place until it is its turn.
        items.sort_unstable();
        self.edit("Delete", |scene| {
            for item in items.iter().rev() {
                remove(scene, *item);
            }
        });
        self.selection.clear();
    }

    /// Whether a property holds for all selected lights.
    pub fn all_selected(&self, has: impl Fn(&Self, usize) -> bool) -> bool {
        let lights = selected_lights(self);
        !lights.is_empty() && lights.into_iter().all(|index| has(self, index))
    }

    /// Mute the selected lights, or unmute them where all are muted.
    pub fn toggle_mute_selection(&mut self) {
        let lights = selected_lights(self);
        let muted = !self.all_selected(|session, index| session.scene().lights[index].muted);
        self.edit(if muted { "Mute" } else { "Unmute" }, |scene| {
            for index in lights {
                scene.lights[index].muted = muted;
            }
        });
    }

    /// Solo the selected lights, or no more where all are soloed.
    pub fn toggle_solo_selection(&mut self) {
        let solo = !self.all_selected(|session, index| session.is_solo(&session.scene().lights[index].name));
        for index in selected_lights(self) {
            let name = self.scene().lights[index].name.clone();
            if self.is_solo(&name) != solo {
                self.toggle_solo(&name);
            }
        }
    }

    /// Give `item` another name; one that is empty or taken is refused, and the user is told.
    pub fn rename(&mut self, item: Item, name: &str) {
        let name = name.trim();
        let Some(old) = item.name(self.scene()).map(str::to_owned) else { return };
        if name == old {
            return;
        }
        if name.is_empty() {
            self.failed("A name must not be empty");
        } else if item.siblings(self.scene()).any(|other| other == name) {
            self.failed(format!("“{name}” is taken: choose another name"));
        } else {
            let soloed = matches!(item, Item::Light(_)) && self.is_solo(&old);
            self.edit("Rename", |scene| set_name(scene, item, &old, name));
            if soloed {
                self.toggle_solo(name);
            }
        }
    }

    /// Add the lights of a preset and select them.
    pub fn insert_lights(&mut self, label: &str, preset: &Scene) {
        let first = self.scene().lights.len();
        self.edit(label, |scene| {
            for light in &preset.lights {
                let name = unique_name(scene.lights.iter().map(|other| &other.name), &light.name);
                let mut light = Light { name, ..light.clone() };
                scene::keep_apart(&mut light, scene.all_lights());
                // A preset's links are to surfaces of its own.
                let is_known = |only: &Vec<String>| only.iter().all(|name| has_surface(scene, name));
                light.only = light.only.filter(is_known);
                scene.lights.push(light);
            }
        });
        self.selection.set((first..self.scene().lights.len()).map(Item::Light));
    }
}

impl Item {
    /// The names in its list.
    fn siblings(self, scene: &Scene) -> Box<dyn Iterator<Item = &str> + '_> {
        match self {
            Self::Light(_) => Box::new(scene.lights.iter().map(|light| light.name.as_str())),
            Self::Surface(_) => Box::new(scene.surfaces.iter().map(|surface| surface.name.as_str())),
            Self::Material(_) => Box::new(scene.materials.iter().map(|material| material.name.as_str())),
            Self::Plot(_) => Box::new(scene.plots.iter().map(|plot| plot.name.as_str())),
        }
    }
}

/// The selected lights, by their places.
fn selected_lights(session: &Session) -> Vec<usize> {
    let lights = session.selection.items().iter().filter_map(|item| match item {
        Item::Light(index) => Some(*index),
        _ => None,
    });
    lights.filter(|index| *index < session.scene().lights.len()).collect()
}

/// A light of that shape above the origin, of an everyday strength.
pub(super) fn new_light(shape: Shape) -> Light {
    Light { position: DVec3::new(0.0, 0.0, 2.0), ..Light::new(shape.name(), shape) }
}

/// A light with a pattern, its longer side 1 m, called after the pattern's file.
pub(super) fn textured(pattern: Pattern) -> Light {
    let name = stem(&pattern.file);
    let channel = &pattern.image.channels()[0];
    let texels = DVec2::new(channel.width() as f64, channel.height() as f64);
    let size = texels / texels.max_element();
    let light = new_light(Shape::Textured(Textured { size, pattern, two_sided: false }));
    Light { name, ..light }
}

/// A point light with the intensities of a file, as bright as the file says, called after the file.
pub(super) fn measured(photometry: Photometry) -> Light {
    let name = stem(&photometry.file);
    Light { name, ..new_light(Shape::Point(Point { ies: Some(photometry) })) }
}

/// The pattern of a new textured light: bright in the middle and darker towards the rim, as a softbox is. Like one that
/// was painted, it gets its file when the scene is saved.
pub(super) fn softbox_pattern() -> Pattern {
    static PATTERN: LazyLock<Pattern> = LazyLock::new(|| {
        const SIDE: u32 = 64;
        let falloff = image::GrayImage::from_fn(SIDE, SIDE, |column, row| {
            let share = |i: u32| (f64::from(i) + 0.5) / f64::from(SIDE);
            let edge = |share: f64| 4.0 * share * (1.0 - share);
            image::Luma([code_of(0.35 + 0.65 * edge(share(column)) * edge(share(row)))])
        });
        let mut bytes = std::io::Cursor::new(Vec::new());
        falloff.write_to(&mut bytes, image::ImageFormat::Png).expect("grey bytes are a PNG picture");
        let file = "softbox-falloff.png";
        let read = scene::pattern_of_bytes(file, bytes.into_inner()).expect("what was just written is a picture");
        scene::painted_pattern(read.image, &Pattern::unread(file), None)
    });
    PATTERN.clone()
}

/// A linear share as an sRGB code of 8 bits (IEC 61966-2-1).
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "from 0 to 255")]
fn code_of(share: f64) -> u8 {
    let code = if share <= 0.003_130_8 { 12.92 * share } else { 1.055 * share.powf(1.0 / 2.4) - 0.055 };
    (255.0 * code).round().clamp(0.0, 255.0) as u8
}

/// A file's own name without its extension.
fn stem(file: &str) -> String {
    Path::new(file).file_stem().unwrap_or_default().to_string_lossy().into_owned()
}

/// The control points of a sheet of 1.2 m, spread between two high and two low corners.
pub(super) fn sail() -> [DVec3; 16] {
    std::array::from_fn(|k| {
        // Sixths of the width, so that the numbers are short.
        let (x, y) = ((k % 4) as f64 * 2.0 - 3.0, (k / 4) as f64 * 2.0 - 3.0);
        DVec3::new(x / 5.0, y / 5.0, x * y / 25.0)
    })
}

/// A rectangle about the origin.
pub(super) fn rectangle(width: f64, depth: f64) -> Polygon {
    let (x, y) = (0.5 * width, 0.5 * depth);
    let vertices = vec![DVec2::new(-x, -y), DVec2::new(x, -y), DVec2::new(x, y), DVec2::new(-x, y)];
    Polygon { vertices, two_sided: false }
}

/// The name of a plot kind on screen.
pub(super) fn kind_name(kind: PlotKind) -> &'static str {
    match kind {
        PlotKind::Tilt => "tilt",
        PlotKind::View => "view",
        PlotKind::Line => "line",
        PlotKind::Distance => "distance",
    }
}

/// The range a plot of that kind starts with.
pub(super) fn default_range(kind: PlotKind) -> [f64; 2] {
    match kind {
        PlotKind::Tilt | PlotKind::View => [-90.0, 90.0],
        PlotKind::Line => [-3.0, 3.0],
        PlotKind::Distance => [0.1, 10.0],
    }
}

/// `base`, or `base 2`, `base 3`, … where it is taken.
fn unique_name<'a>(taken: impl Iterator<Item = &'a String>, base: &str) -> String {
    let taken: BTreeSet<&str> = taken.map(String::as_str).collect();
    if !taken.contains(base) {
        return base.to_owned();
    }
    let stem = base.rsplit_once(' ').filter(|(_, n)| n.parse::<u32>().is_ok()).map_or(base, |(stem, _)| stem);
    let numbered = |n: usize| format!("{stem} {n}");
    (2..=taken.len() + 2).map(numbered).find(|name| !taken.contains(name.as_str())).unwrap_or_else(|| base.to_owned())
}

/// Where a new surface stands on the ground.
fn resting_position(shape: &surface::Shape) -> DVec3 {
    use surface::Shape::{Disk, Patch, Plane, Square};
    match shape {
        Plane {} => DVec3::ZERO,
        Square { .. } | Disk { .. } | Patch { .. } => DVec3::Z,
        _ => -shape.bounds().map_or(0.0, |bounds| bounds.min.z) * DVec3::Z,
    }
}

fn new_material(name: String) -> Material {
    Material {
        name,
        diffuse: DVec3::splat(0.5),
        specular: DVec3::splat(0.2),
        model: ReflectionModel::default(),
        exponent: 32.0,
    }
}

fn new_plot(name: String, kind: PlotKind) -> Plot {
    Plot {
        name,
        kind,
        quantity: PlotQuantity::Irradiance,
        position: DVec3::ZERO,
        normal: DVec3::Z,
        view: None,
        axis: if kind == PlotKind::Distance { DVec3::NEG_Z } else { DVec3::Y },
        range: default_range(kind),
        material: None,
        normalise: false,
    }
}

fn duplicate(scene: &mut Scene, item: Item) -> Option<Item> {
    let name = unique_name(item.siblings(scene).map(str::to_owned).collect::<Vec<_>>().iter(), item.name(scene)?);
    Some(match item {
        Item::Light(i) => {
            let original = scene.lights[i].clone();
            scene.lights.push(Light { name, position: original.position + COPY_OFFSET, ..original });
            Item::Light(scene.lights.len() - 1)
        }
        Item::Surface(i) => {
            let original = scene.surfaces[i].clone();
            for only in scene.all_lights_mut().filter_map(|light| light.only.as_mut()) {
                if only.contains(&original.name) {
                    only.push(name.clone());
                }
            }
            scene.surfaces.push(Surface { name, position: original.position + COPY_OFFSET, ..original });
            Item::Surface(scene.surfaces.len() - 1)
        }
        Item::Material(i) => {
            let original = scene.materials[i].clone();
            scene.materials.push(Material { name, ..original });
            Item::Material(scene.materials.len() - 1)
        }
        Item::Plot(i) => {
            let original = scene.plots[i].clone();
            scene.plots.push(Plot { name, ..original });
            Item::Plot(scene.plots.len() - 1)
        }
    })
}

/// Whether a surface or plot that is not among `leaving` uses the material.
fn is_used(scene: &Scene, material: Item, leaving: &[Item]) -> bool {
    let name = material.name(scene);
    let surfaces = scene.surfaces.iter().enumerate();
    let plots = scene.plots.iter().enumerate();
    surfaces.into_iter().any(|(i, s)| Some(s.material.as_str()) == name && !leaving.contains(&Item::Surface(i)))
        || plots
            .into_iter()
            .any(|(i, p)| p.material.is_some() && p.material.as_deref() == name && !leaving.contains(&Item::Plot(i)))
}

fn has_surface(scene: &Scene, name: &str) -> bool {
    scene.surfaces.iter().any(|surface| surface.name == name)
}

fn remove(scene: &mut Scene, item: Item) {
    if !item.exists(scene) {
        return;
    }
    match item {
        Item::Light(i) => drop(scene.lights.remove(i)),
        Item::Surface(i) => {
            let gone = scene.surfaces.remove(i).name;
            for only in scene.all_lights_mut().filter_map(|light| light.only.as_mut()) {
                only.retain(|name| *name != gone);
            }
        }
        Item::Material(i) => drop(scene.materials.remove(i)),
        Item::Plot(i) => drop(scene.plots.remove(i)),
    }
}

/// Rename, and let what refers to it follow.
fn set_name(scene: &mut Scene, item: Item, old: &str, new: &str) {
    match item {
        Item::Light(i) => scene.lights[i].name = new.to_owned(),
        Item::Surface(i) => {
            scene.surfaces[i].name = new.to_owned();
            let lists = scene.all_lights_mut().filter_map(|light| light.only.as_mut());
            for name in lists.flatten().filter(|name| *name == old) {
                new.clone_into(name);
            }
        }
        Item::Plot(i) => scene.plots[i].name = new.to_owned(),
        Item::Material(i) => {
            scene.materials[i].name = new.to_owned();
            for surface in scene.surfaces.iter_mut().filter(|surface| surface.material == old) {
                surface.material = new.to_owned();
            }
            for plot in scene.plots.iter_mut().filter(|plot| plot.material.as_deref() == Some(old)) {
                plot.material = Some(new.to_owned());
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn session() -> Session {
        let mut session = Session::new(Scene::default(), None);
        session.add_surface(surface::Shape::Sphere { radius: 0.5 });
        session.add_light(new_light(Shape::Polygon(rectangle(1.0, 1.0))));
        session
    }

    fn light_names(session: &Session) -> Vec<&str> {
        session.scene().lights.iter().map(|light| light.name.as_str()).collect()
    }

    #[test]
    fn copies_get_names_of_their_own_and_are_selected() {
        let mut session = session();
        session.duplicate_selection();
        session.duplicate_selection();
        assert_eq!(light_names(&session), ["polygon", "polygon 2", "polygon 3"], "names");
        assert_eq!(session.selection.items(), [Item::Light(2)], "the copy is selected");
    }

    #[test]
    fn a_material_in_use_is_not_deleted_but_goes_with_its_surface() {
        let mut session = session();
        session.selection.set([Item::Material(0)]);
        session.delete_selection();
        assert_eq!((session.scene().materials.len(), session.notices.len()), (1, 1), "kept, and said so");
        session.selection.set([Item::Material(0), Item::Surface(0)]);
        session.delete_selection();
        assert_eq!((session.scene().materials.len(), session.scene().surfaces.len()), (0, 0), "both gone");
    }

    #[test]
    fn renaming_a_material_takes_its_surfaces_along() {
        let mut session = session();
        session.rename(Item::Material(0), " plaster ");
        assert_eq!(session.scene().surfaces[0].material, "plaster", "the surface follows");
        assert_eq!(session.history.undo_label(), Some("Rename"), "one step");
    }

    #[test]
    fn a_taken_or_empty_name_is_refused_and_the_user_is_told() {
        let mut session = session();
        session.duplicate_selection();
        session.rename(Item::Light(1), "polygon");
        session.rename(Item::Light(1), "  ");
        assert_eq!(light_names(&session), ["polygon", "polygon 2"], "unchanged");
        assert_eq!(session.notices.len(), 2, "told twice");
    }

    #[test]
    fn deleting_is_one_step_back() {
        let mut session = session();
        session.duplicate_selection();
        session.selection.set([Item::Light(0), Item::Light(1), Item::Surface(0)]);
        session.delete_selection();
        assert_eq!((session.scene().lights.len(), session.scene().surfaces.len()), (0, 0), "all gone");
        session.undo();
        assert_eq!((session.scene().lights.len(), session.scene().surfaces.len()), (2, 1), "all back");
    }
}
