//! The mesh files of a scene's surfaces: read and refused.

use std::io;
use std::path::Path;

use super::beside::{self, Imported};
use super::{Problem, obj};
use crate::contents::Contents;
use crate::surface::{Mesh, Surface};

/// The meshes of a scene have together at most this many triangles, each counted as often as it is used.
pub const MOST_TRIANGLES: usize = 1_000_000;

/// Read the meshes of surfaces, each file once; `read` gives the bytes of the file of a name. What is wrong with them is
/// returned.
pub(super) fn read_all(surfaces: &mut [Surface], mut read: impl FnMut(&str) -> io::Result<Vec<u8>>) -> Vec<Problem> {
    let meshes = surfaces.iter_mut().enumerate();
    let meshes = meshes.filter_map(|(i, surface)| Some((beside::mesh_path(i), beside::mesh_mut(surface)?)));
    let mut problems = beside::read_each(meshes, |mesh| &mesh.file, |name| read_mesh(name, &mut read));
    problems.extend(too_many(surfaces));
    problems
}

/// The first mesh that is too much.
fn too_many(surfaces: &mut [Surface]) -> Option<Problem> {
    let mut left = MOST_TRIANGLES;
    surfaces.iter_mut().enumerate().find_map(|(i, surface)| {
        let count = beside::mesh_mut(surface)?.triangles.len();
        let enough = left.checked_sub(count);
        left = enough.unwrap_or(left);
        let message = format!("is too much: a scene's meshes have at most {MOST_TRIANGLES} triangles; simplify some");
        enough.is_none().then(|| Problem::new(beside::mesh_path(i), message))
    })
}

fn read_mesh(name: &str, read: &mut impl FnMut(&str) -> io::Result<Vec<u8>>) -> Result<Mesh, String> {
    let bytes = read(name).map_err(|cause| {
        format!("`{name}` cannot be read: {cause}; write the name of an OBJ file in the scene's folder")
    })?;
    let triangles = obj::read(&bytes, MOST_TRIANGLES).map_err(|wrong| format!("`{name}`{wrong}"))?;
    Ok(Mesh { file: name.to_owned(), triangles: triangles.into(), contents: Contents(bytes.into()) })
}

/// Read an OBJ file from anywhere as a mesh for the scene whose file is `scene`, if it has one.
///
/// A file below the scene's folder keeps its place; any other is called `meshes/` and its own name, numbered where the
/// folder has another file of that name, and is put there when the scene is saved. What is wrong with it is one line.
pub fn import_mesh(path: &Path, scene: Option<&Path>) -> Result<Mesh, String> {
    let imported = Imported::read(path)?;
    let triangles =
        obj::read(&imported.bytes, MOST_TRIANGLES).map_err(|wrong| format!("`{}`{wrong}", imported.own_name))?;
    let file = imported.name(path, scene, "meshes");
    Ok(Mesh { file, triangles: triangles.into(), contents: Contents(imported.bytes.into()) })
}
