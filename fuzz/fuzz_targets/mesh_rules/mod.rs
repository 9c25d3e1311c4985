//! The rules of meshes, which every reader keeps.

use ptlib_aging::mesh::files::{self, Alone, FileError, FileMesh, Format, Limits, Outside};

/// A reader of one format.
type Read = fn(&[u8], &dyn Outside, &Limits) -> Result<FileMesh, FileError>;

/// Reads bytes, and checks whatever comes out.
pub fn check(bytes: &[u8], format: Format, read: Read) {
    let limits = Limits { vertices: 1000, triangles: 2000, bytes: 1 << 20, ..Limits::default() };
    let found = read(bytes, &Alone, &limits);
    assert_eq!(files::read(bytes, Some(format), &Alone, &limits), found, "another result");
    match found {
        Ok(mesh) => check_mesh(&mesh, &limits),
        Err(FileError::Parse(message) | FileError::Limit(message)) => {
            assert!(!message.is_empty() && message.lines().count() == 1, "{message:?}");
        }
        Err(FileError::Stopped(_)) => {}
    }
}

fn check_mesh(mesh: &FileMesh, limits: &Limits) {
    let FileMesh { positions, normals, texcoords, triangles } = mesh;
    let count = positions.len();
    assert!(count <= limits.vertices && triangles.len() <= limits.triangles);
    assert!([0, count].contains(&normals.len()) && [0, count].contains(&texcoords.len()));
    let vectors = positions.as_flattened().iter().chain(normals.as_flattened());
    let mut numbers = vectors.chain(texcoords.as_flattened());
    assert!(numbers.all(|number| number.abs() <= 1e18));
    let mut corners = triangles.as_flattened().iter();
    assert!(corners.all(|corner| (*corner as usize) < count));
}
