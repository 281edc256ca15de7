//! What one step changed: enough to go back, and then forth again.

use std::fmt::Debug;
use std::sync::Arc;

use super::retouch::Retouch;
use crate::light::pattern::{Image, Pattern};
use crate::light::photometry::Photometry;
use crate::light::{Light, Point, Shape};
use crate::scene::{Camera, Display, Plot, Scene, Variant};
use crate::surface::{self, Material, Surface};

/// What a scene was before a step, where the step changed it.
///
/// [`Self::swap`] exchanges it with what the scene is, so that the same value undoes the step and then does it again.
#[derive(Clone, Debug)]
pub(super) struct Change {
    head: Option<Box<Head>>,
    materials: Splice<Material>,
    surfaces: Splice<Surface>,
    lights: Splice<Light>,
    /// For each light of the splice: what of its picture differs, where that is less than the picture.
    retouches: Vec<Option<Retouch>>,
    plots: Splice<Plot>,
    variants: Splice<Variant>,
}

/// What a scene has only one of.
#[derive(Clone, Debug, PartialEq)]
struct Head {
    name: String,
    tags: Vec<String>,
    camera: Camera,
    display: Display,
    active_variant: Option<String>,
}

impl Change {
    /// What leads from `new` back to `old`.
    pub(super) fn between(old: &Scene, new: &Scene) -> Self {
        let Scene { materials, surfaces, lights, plots, variants, .. } = old;
        let head = Head::of(old);
        let mut change = Self {
            head: (!same(&head, &Head::of(new))).then(|| Box::new(head)),
            materials: Splice::between(materials, &new.materials),
            surfaces: Splice::between(surfaces, &new.surfaces),
            lights: Splice::between(lights, &new.lights),
            retouches: Vec::new(),
            plots: Splice::between(plots, &new.plots),
            variants: Splice::between(variants, &new.variants),
        };
        let now = change.lights.now(&new.lights);
        if now.len() == change.lights.old.len() {
            change.retouches = change.lights.old.iter_mut().zip(now).map(|(old, new)| lighten(old, new)).collect();
        }
        change
    }

    /// Exchange what the scene is with what it was.
    pub(super) fn swap(&mut self, scene: &mut Scene) {
        if let Some(head) = &mut self.head {
            let now = Head::of(scene);
            std::mem::replace(&mut **head, now).put_into(scene);
        }
        self.materials.swap(&mut scene.materials);
        self.surfaces.swap(&mut scene.surfaces);
        self.plots.swap(&mut scene.plots);
        self.variants.swap(&mut scene.variants);
        self.lights.swap(&mut scene.lights);
        let restored = scene.lights.iter_mut().skip(self.lights.start);
        let retouched = self.retouches.iter_mut().zip(self.lights.old.iter_mut().zip(restored));
        for (retouch, (old, restored)) in retouched.filter_map(|(retouch, pair)| Some((retouch.as_mut()?, pair))) {
            if let (Some(old), Some(restored)) = (pattern_mut(old), pattern_mut(restored)) {
                restored.image = retouch.swap(&old.image);
                old.image = Image::white();
            }
        }
    }

    /// Memory that it takes beyond what `scene`, the one that it was made from, has too.
    pub(super) fn bytes(&self, scene: &Scene) -> usize {
        let head = self.head.as_ref().map_or(0, |head| size_of::<Head>() + head.name.len());
        let others: Vec<&Light> = scene.all_lights().collect();
        let light_bytes = |light: &Light| light.name.len() + shape_bytes(&light.shape, &others);
        let lights = self.lights.bytes(light_bytes);
        let variants = self.variants.bytes(|variant| {
            let own = variant.lights.iter().map(|light| size_of::<Light>() + light_bytes(light));
            variant.name.len() + own.sum::<usize>()
        });
        let surfaces = self.surfaces.bytes(|surface| {
            surface.name.len() + surface.material.len() + solid_bytes(&surface.shape, &scene.surfaces)
        });
        let retouches: usize = self.retouches.iter().flatten().map(Retouch::bytes).sum();
        size_of::<Self>()
            + head
            + lights
            + variants
            + surfaces
            + retouches
            + self.materials.bytes(|material| material.name.len())
            + self.plots.bytes(|plot| plot.name.len())
    }
}

impl Head {
    fn of(scene: &Scene) -> Self {
        // Taken apart whole, so that a new field cannot be forgotten; the lists are compared one by one.
        let Scene {
            name,
            tags,
            camera,
            display,
            active_variant,
            materials: _,
            surfaces: _,
            lights: _,
            plots: _,
            variants: _,
        } = scene;
        Self {
            name: name.clone(),
            tags: tags.clone(),
            camera: *camera,
            display: *display,
            active_variant: active_variant.clone(),
        }
    }

    fn put_into(self, scene: &mut Scene) {
        let Self { name, tags, camera, display, active_variant } = self;
        scene.name = name;
        scene.tags = tags;
        scene.camera = camera;
        scene.display = display;
        scene.active_variant = active_variant;
    }
}

/// The part of a list that a step changed, as it was.
#[derive(Clone, Debug)]
struct Splice<T> {
    start: usize,
    old: Vec<T>,
    /// How many entries stand in its place now.
    count: usize,
}

impl<T: Clone + PartialEq + Debug> Splice<T> {
    fn between(old: &[T], new: &[T]) -> Self {
        let start = old.iter().zip(new).take_while(|(a, b)| same(*a, *b)).count();
        let (old, new) = (&old[start..], &new[start..]);
        let end = old.iter().rev().zip(new.iter().rev()).take_while(|(a, b)| same(*a, *b)).count();
        Self { start, old: old[..old.len() - end].to_vec(), count: new.len() - end }
    }

    /// What stands in its place in `list`.
    fn now<'l>(&self, list: &'l [T]) -> &'l [T] {
        &list[self.start..][..self.count]
    }

    fn swap(&mut self, list: &mut Vec<T>) {
        let count = self.old.len();
        let old = std::mem::take(&mut self.old);
        self.old = list.splice(self.start..self.start + self.count, old).collect();
        self.count = count;
    }

    fn bytes(&self, heap: impl Fn(&T) -> usize) -> usize {
        self.old.iter().map(|entry| size_of::<T>() + heap(entry)).sum()
    }
}

/// Whether two things are the same to the last bit; for `==` 0 and −0 are.
fn same<T: PartialEq + Debug>(a: &T, b: &T) -> bool {
    a == b && format!("{a:?}") == format!("{b:?}")
}

/// Keep of a light's picture only what differs from `new`'s; nothing where that would not be less.
fn lighten(old: &mut Light, new: &Light) -> Option<Retouch> {
    let (old, new) = (pattern_mut(old)?, pattern(new)?);
    let retouch = Retouch::between(&old.image, &new.image)?;
    old.image = Image::white();
    Some(retouch)
}

fn pattern(light: &Light) -> Option<&Pattern> {
    if let Shape::Textured(textured) = &light.shape { Some(&textured.pattern) } else { None }
}

fn pattern_mut(light: &mut Light) -> Option<&mut Pattern> {
    if let Shape::Textured(textured) = &mut light.shape { Some(&mut textured.pattern) } else { None }
}

/// What a light's shape keeps outside of itself, without what one of `others` shares.
fn shape_bytes(shape: &Shape, others: &[&Light]) -> usize {
    let patterns = || others.iter().filter_map(|light| pattern(light));
    match shape {
        Shape::Polygon(polygon) => size_of_val(polygon.vertices.as_slice()),
        Shape::Textured(textured) => {
            let Pattern { file, image, contents } = &textured.pattern;
            let shares_image = |other: &Pattern| Arc::ptr_eq(&other.image.channels()[0], &image.channels()[0]);
            let shares_contents = |other: &Pattern| Arc::ptr_eq(&other.contents.0, &contents.0);
            let texels = image.channels().iter().map(|channel| size_of_val(channel.texels())).sum();
            file.len()
                + unless(patterns().any(shares_image), texels)
                + unless(patterns().any(shares_contents), contents.0.len())
        }
        Shape::Point(Point { ies: Some(Photometry { file, distribution, contents }) }) => {
            let shares = |other: &&Light| match &other.shape {
                Shape::Point(Point { ies: Some(other) }) => Arc::ptr_eq(&other.distribution, distribution),
                _ => false,
            };
            let own = size_of_val(distribution.shares()) + contents.0.len();
            file.len() + unless(others.iter().any(shares), own)
        }
        _ => 0,
    }
}

/// As [`shape_bytes`], of a surface's shape.
fn solid_bytes(shape: &surface::Shape, others: &[Surface]) -> usize {
    match shape {
        surface::Shape::Patch { control_points } => size_of_val(control_points.as_slice()),
        surface::Shape::Mesh(mesh) => {
            let shares = |other: &Surface| match &other.shape {
                surface::Shape::Mesh(other) => Arc::ptr_eq(&other.triangles, &mesh.triangles),
                _ => false,
            };
            let own = size_of_val(&*mesh.triangles) + mesh.contents.0.len();
            mesh.file.len() + unless(others.iter().any(shares), own)
        }
        _ => 0,
    }
}

fn unless(is_shared: bool, bytes: usize) -> usize {
    if is_shared { 0 } else { bytes }
}
