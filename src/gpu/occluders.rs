//! What rays meet, as the shaders read it: primitives, triangles, and boxes about them.

use std::sync::Arc;

use glam::{DMat3, DVec3, Vec3};

use super::pass::{self, Binding};
use super::types::{Node, Occluders as Counts, Primitive, Triangle, f32_of, u32_of, vec3_of, vec4_of};
use crate::scene::Scene;
use crate::surface::{self, Bounds, Placed, Surface};
use crate::visibility::{self, Hierarchy};

/// Half the thickness of a slab that is none.
const UNBOUNDED: f64 = 1e15;

/// Primitives, at most, that are tested sooner than boxes about them.
const FEW: usize = 3;

/// Bindings of what rays meet, in `primitives.wgsl`.
pub(crate) const BINDINGS: [Binding; 4] = [Binding::Uniform, Binding::Storage, Binding::Storage, Binding::Storage];

/// The surfaces of a scene about an eye, on a device.
#[derive(Debug)]
pub(crate) struct Occluders {
    items: Arc<Items>,
    /// Of each surface.
    materials: Vec<u32>,
    eye: DVec3,
    group: wgpu::BindGroup,
    /// Of each item.
    surfaces: wgpu::Buffer,
}

impl Occluders {
    /// Those of a scene; `old` where it is the same.
    pub(crate) fn of_scene(
        device: &wgpu::Device,
        layout: &wgpu::BindGroupLayout,
        (scene, eye): (&Scene, DVec3),
        old: Option<&Arc<Self>>,
    ) -> Arc<Self> {
        let material = |surface: &Surface| {
            let index = scene.materials.iter().position(|material| material.name == surface.material);
            u32_of(index.unwrap_or(scene.materials.len()))
        };
        let materials: Vec<_> = scene.surfaces.iter().map(material).collect();
        let items = match old {
            Some(old) if old.items.surfaces == scene.surfaces => {
                if old.eye == eye && old.materials == materials {
                    return Arc::clone(old);
                }
                Arc::clone(&old.items)
            }
            _ => Arc::new(Items::new(&scene.surfaces)),
        };
        let group = items.about(eye, &materials).group(device, layout);
        let surfaces = match old {
            Some(old) if Arc::ptr_eq(&old.items, &items) => old.surfaces.clone(),
            _ => pass::storage(device, &items.surfaces_of_items()),
        };
        Arc::new(Self { items, materials, eye, group, surfaces })
    }

    /// The surface of each item, by the numbers that the G-buffer has less 1.
    pub(crate) fn surfaces(&self) -> &wgpu::Buffer {
        &self.surfaces
    }

    /// What shaders read them by, as group 2.
    pub(crate) fn group(&self) -> &wgpu::BindGroup {
        &self.group
    }
}

/// A part of a surface, and the surface's number.
#[derive(Clone, Debug)]
struct Item {
    placed: Placed,
    surface: usize,
}

/// What rays meet: primitives, those without bounds first, then triangles; each in the order of its boxes.
#[derive(Clone, Debug)]
pub(crate) struct Items {
    surfaces: Vec<Surface>,
    primitives: Vec<Item>,
    triangles: Vec<Item>,
    /// Primitives that are in no box.
    always: u32,
    primitive_nodes: Vec<BoxNode>,
    triangle_nodes: Vec<BoxNode>,
}

/// A node; of a leaf, `item` is a place among the primitives or triangles.
#[derive(Clone, Copy, Debug)]
struct BoxNode {
    bounds: Bounds,
    skip: u32,
    item: Option<u32>,
}

/// Items in the order in which a hierarchy's boxes are walked, after those that it has no boxes for, their number, and
/// its nodes.
fn in_boxes(items: Vec<Item>) -> (Vec<Item>, u32, Vec<BoxNode>) {
    let placed: Vec<_> = items.iter().map(|item| item.placed.clone()).collect();
    let hierarchy = Hierarchy::new(&placed);
    let always = u32_of(hierarchy.unbounded().len());
    let mut order = hierarchy.unbounded().to_vec();
    let mut number = |object: u32| {
        order.push(object);
        u32_of(order.len() - 1)
    };
    let node =
        |node: &visibility::Node| BoxNode { bounds: node.bounds, skip: node.skip, item: node.object.map(&mut number) };
    let nodes = hierarchy.nodes().iter().map(node).collect();
    let items = order.iter().filter_map(|&object| items.get(object as usize).cloned()).collect();
    (items, always, nodes)
}

/// How far the triangles that stand for a patch may be from it, as a share of its size.
const PATCH_ERROR: f64 = 1e-4;

impl Items {
    /// The parts of surfaces. Those of no thickness at all are left out: no ray meets them.
    pub(crate) fn new(surfaces: &[Surface]) -> Self {
        let items = surfaces.iter().enumerate().flat_map(|(surface, stated)| {
            let parts = Placed::parts(stated).into_iter().flat_map(|part| part.in_triangles(PATCH_ERROR));
            parts.map(move |placed| Item { placed, surface })
        });
        let items = items.filter(|item| item.placed.local_from_world().is_finite());
        let (triangles, primitives): (Vec<_>, Vec<_>) =
            items.partition(|item| matches!(item.placed.primitive(), surface::Primitive::Triangle(_)));
        let (primitives, mut always, mut primitive_nodes) = in_boxes(primitives);
        if primitive_nodes.len() < 2 * FEW {
            always = u32_of(primitives.len());
            primitive_nodes.clear();
        }
        let (triangles, _, triangle_nodes) = in_boxes(triangles);
        Self { surfaces: surfaces.to_vec(), primitives, triangles, always, primitive_nodes, triangle_nodes }
    }

    /// The surface of each item: of primitives, then of triangles.
    fn surfaces_of_items(&self) -> Vec<u32> {
        self.primitives.iter().chain(&self.triangles).map(|item| u32_of(item.surface)).collect()
    }

    /// All that the shaders read, about an eye.
    pub(crate) fn about(&self, eye: DVec3, materials: &[u32]) -> Data {
        let material = |item: &Item| materials.get(item.surface).copied().unwrap_or_default();
        let first_triangle = self.primitives.len();
        let nodes =
            self.primitive_nodes.iter().map(|node| node.about(eye, 0, 0)).chain(
                self.triangle_nodes.iter().map(|node| node.about(eye, self.primitive_nodes.len(), first_triangle)),
            );
        let nodes: Vec<_> = nodes.collect();
        Data {
            counts: Counts {
                always: self.always,
                primitives: u32_of(self.primitives.len()),
                primitive_nodes: u32_of(self.primitive_nodes.len()),
                nodes: u32_of(nodes.len()),
            },
            nodes,
            primitives: self.primitives.iter().map(|item| primitive(&item.placed, material(item), eye)).collect(),
            triangles: self.triangles.iter().filter_map(|item| triangle(&item.placed, material(item), eye)).collect(),
        }
    }
}

impl BoxNode {
    /// Once rounded; `first_node` and `first_item` are where its list begins.
    fn about(&self, eye: DVec3, first_node: usize, first_item: usize) -> Node {
        let (least, greatest) = (self.bounds.min - eye, self.bounds.max - eye);
        // What the rounding of a primitive's own place may take.
        let reach = 1e-6 * least.abs().max(greatest.abs());
        Node {
            least: vec3_of(least - reach),
            skip: self.skip.saturating_add(u32_of(first_node)),
            greatest: vec3_of(greatest + reach),
            item: self.item.map_or(0, |item| item + u32_of(first_item) + 1),
        }
    }
}

/// What the shaders read, in the layout of `primitives.wgsl`.
#[derive(Clone, Debug)]
pub(crate) struct Data {
    counts: Counts,
    nodes: Vec<Node>,
    primitives: Vec<Primitive>,
    triangles: Vec<Triangle>,
}

impl Data {
    /// On a device.
    pub(crate) fn group(&self, device: &wgpu::Device, layout: &wgpu::BindGroupLayout) -> wgpu::BindGroup {
        let counts = pass::uniform(device, &self.counts);
        let nodes = pass::storage(device, &self.nodes);
        let primitives = pass::storage(device, &self.primitives);
        let triangles = pass::storage(device, &self.triangles);
        let buffers = [&counts, &nodes, &primitives, &triangles];
        pass::bind_group(device, layout, &buffers.map(wgpu::Buffer::as_entire_binding))
    }
}

/// A primitive about the eye. The inverse is taken in f64: a far or flat one costs no digits.
fn primitive(placed: &Placed, material: u32, eye: DVec3) -> Primitive {
    let (half, quadric) = slabs_and_quadric(placed.primitive());
    Primitive {
        local_from_world: columns(&placed.local_from_world().matrix3),
        world_from_local: columns(&placed.world_from_local().matrix3),
        eye_local: vec3_of(placed.local_from_world().transform_point3(eye)),
        material,
        origin: vec3_of(placed.world_from_local().translation - eye),
        unused: 0,
        half: vec3_of(half),
        unused_too: 0,
        quadric: quadric.map(f32_of),
    }
}

fn columns(matrix: &DMat3) -> [[f32; 4]; 3] {
    [matrix.x_axis, matrix.y_axis, matrix.z_axis].map(|column| vec4_of(column, 0.0))
}

/// Half the thickness of three slabs, and ρ, α, γ, z₀ of the quadric ρ(x² + y²) + α(z − z₀)² + γ ≤ 0, that the primitive
/// is the common part of.
fn slabs_and_quadric(primitive: &surface::Primitive) -> (DVec3, [f64; 4]) {
    const EVERYWHERE: [f64; 4] = [0.0, 0.0, -1.0, 0.0];
    let across = |half| DVec3::new(UNBOUNDED, UNBOUNDED, half);
    let around = |radius: f64| [1.0, 0.0, -radius * radius, 0.0];
    match *primitive {
        surface::Primitive::Plane => (across(0.0), EVERYWHERE),
        surface::Primitive::Square { size } => (0.5 * size.extend(0.0), EVERYWHERE),
        surface::Primitive::Box { size } => (0.5 * size, EVERYWHERE),
        surface::Primitive::Sphere { radius } => (DVec3::splat(UNBOUNDED), [1.0, 1.0, -radius * radius, 0.0]),
        surface::Primitive::Disk { radius } => (across(0.0), around(radius)),
        surface::Primitive::Cylinder { radius, height } => (across(0.5 * height), around(radius)),
        surface::Primitive::Cone { radius, height } => {
            let slope = radius / height;
            (across(0.5 * height), [1.0, -slope * slope, 0.0, 0.5 * height])
        }
        // Met as triangles.
        surface::Primitive::Triangle(_) | surface::Primitive::Patch(_) => (DVec3::ZERO, [0.0, 0.0, 1.0, 0.0]),
    }
}

/// A triangle about the eye.
fn triangle(placed: &Placed, material: u32, eye: DVec3) -> Option<Triangle> {
    let surface::Primitive::Triangle(triangle) = placed.primitive() else { return None };
    let [a, b, c] = triangle.corners;
    let flat = (b - a).cross(c - a).normalize_or(DVec3::Z);
    let [normal_a, normal_b, normal_c]: [Vec3; 3] = triangle.normals.unwrap_or([flat; 3]).map(vec3_of);
    let [a, b, c] = [a, b, c].map(|corner| vec3_of(corner - eye));
    Some(Triangle { a, material, b, c, normal_a, normal_b, normal_c, ..Triangle::default() })
}
