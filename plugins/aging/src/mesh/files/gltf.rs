//! glTF 2.0 (Khronos), as JSON or as GLB, by `gltf`.
//!
//! The library reads the description. Its own validation is not used: it panics at some wrong
//! indices, and refuses attributes of one's own. So whatever is used is looked up and checked here;
//! what lies in the buffers is read by `accessor`. All
//! primitives of triangles in the default scene become one mesh, each where its node puts it;
//! points, lines and strips are passed over, and so are materials and pictures. The second texture
//! coordinate points down in these files, so it becomes 1 minus itself. A primitive without
//! normals among others with normals has zeros, which become those of its triangles.

use gltf::{
    Gltf,
    json::{
        Index, Root,
        accessor::Accessor,
        mesh::{Mode, Primitive, Semantic},
        validation::Checked,
    },
};

use super::{
    FileError, FileMesh, Limits, Outside, accessor::Buffers, index, limit, one_line,
    transform::Transform,
};

/// Bytes of the header of a GLB.
const HEADER: usize = 12;

/// Reads a glTF or GLB file.
///
/// # Errors
/// What is wrong, and in which part of the description.
pub fn read(bytes: &[u8], outside: &dyn Outside, limits: &Limits) -> Result<FileMesh, FileError> {
    check_container(bytes, limits)?;
    let file = bytes.strip_prefix(b"\xEF\xBB\xBF").unwrap_or(bytes);
    let Gltf { document, blob } = Gltf::from_slice_without_validation(file)
        .map_err(|error| FileError::Parse(one_line(&error.to_string())))?;
    outside.check()?;
    let root = document.into_json();
    check_needs(&root)?;
    let placed = primitives(&root)?;
    let mut scene = Scene { buffers: Buffers::new(&root, blob, outside, limits), placed: &placed };
    scene.check_counts(limits)?;
    let mut mesh = FileMesh::default();
    for placed in &placed {
        outside.check()?;
        scene.add(placed, &mut mesh)?;
    }
    mesh.check()?;
    Ok(mesh)
}

/// That the container is as long as it says, and its description has a size that can be read: a
/// short object of JSON can take a hundred times its bytes in memory.
fn check_container(bytes: &[u8], limits: &Limits) -> Result<(), FileError> {
    let mut json = bytes;
    if bytes.starts_with(b"glTF") {
        let number = |place: usize| {
            let bytes = bytes.get(place..)?.first_chunk()?;
            usize::try_from(u32::from_le_bytes(*bytes)).ok()
        };
        let length = number(8).unwrap_or_default();
        if !(HEADER..=bytes.len()).contains(&length) {
            let message = format!(
                "byte 8: the container claims {length} bytes, allowed {HEADER} to {}",
                bytes.len()
            );
            return Err(FileError::Parse(message));
        }
        let start = HEADER + 8;
        let end = number(HEADER).and_then(|length| start.checked_add(length));
        json = end.and_then(|end| bytes.get(start..end)).unwrap_or_default();
    }
    let objects = json.iter().filter(|byte| **byte == b'{').count();
    let entries = json.iter().filter(|byte| matches!(byte, b'{' | b'[' | b',')).count();
    limit("objects and entries of lists in JSON", entries as u64, limits.entries)?;
    // An object takes up to four times as much as anything else.
    limit("objects in JSON", objects as u64, limits.entries / 4)
}

/// Extensions that change what a surface looks like, not where it is.
const HARMLESS: [&str; 4] = ["KHR_materials_", "KHR_lights_", "KHR_texture_", "KHR_xmp"];

/// That the file is of a version that is known, and needs nothing that is not, such as compression.
fn check_needs(root: &Root) -> Result<(), FileError> {
    let version = &root.asset.version;
    if !version.starts_with("2.") {
        let message = one_line(&format!("asset.version is \"{version}\", allowed is 2"));
        return Err(FileError::Parse(message));
    }
    let is_harmless = |name: &&String| HARMLESS.iter().any(|start| name.starts_with(start));
    let Some(other) = root.extensions_required.iter().find(|name| !is_harmless(name)) else {
        return Ok(());
    };
    let message = format!("the file requires the extension {other}, which is not known here");
    Err(FileError::Parse(one_line(&message)))
}

/// A primitive at its place.
struct Placed<'a> {
    name: String,
    primitive: &'a Primitive,
    transform: Transform,
}

/// The triangles of the default scene, in the order of its nodes.
fn primitives(root: &Root) -> Result<Vec<Placed<'_>>, FileError> {
    // A file that names no scene to start with means its first.
    let scene = root.scene.map_or(Some(0), |scene| Some(scene.value()));
    let scene = scene.and_then(|scene| root.scenes.get(scene));
    let scene = scene.ok_or_else(|| FileError::Parse("there is no scene".to_owned()))?;
    let mut placed = vec![];
    let mut is_seen = vec![false; root.nodes.len()];
    let mut nodes: Vec<_> =
        scene.nodes.iter().rev().map(|node| (*node, Transform::IDENTITY)).collect();
    while let Some((index, outer)) = nodes.pop() {
        let number = index.value();
        let missing = |what: &str, i: usize| FileError::Parse(format!("there is no {what} {i}"));
        let node = root.get(index).ok_or_else(|| missing("node", number))?;
        // Each node has one parent at most, so that there are no rings and no forests of copies.
        if std::mem::replace(&mut is_seen[number], true) {
            let message = format!("node {number} is in the scene twice, allowed once");
            return Err(FileError::Parse(message));
        }
        let transform = outer.after(&Transform::of(node));
        let children = node.children.iter().flatten().rev();
        nodes.extend(children.map(|child| (*child, transform)));
        let Some(index) = node.mesh else { continue };
        let mesh = root.get(index).ok_or_else(|| missing("mesh", index.value()))?;
        for (i, primitive) in mesh.primitives.iter().enumerate() {
            if matches!(primitive.mode, Checked::Valid(Mode::Triangles)) {
                let name = format!("mesh {}, primitive {i}", index.value());
                placed.push(Placed { name, primitive, transform });
            }
        }
    }
    if placed.is_empty() {
        return Err(FileError::Parse("the scene has no triangles".to_owned()));
    }
    Ok(placed)
}

impl Placed<'_> {
    fn wrong(&self, what: &str) -> FileError {
        FileError::Parse(format!("{}: {what}", self.name))
    }

    fn attribute(&self, semantic: Semantic) -> Option<Index<Accessor>> {
        self.primitive.attributes.get(&Checked::Valid(semantic)).copied()
    }

    fn positions(&self) -> Result<Index<Accessor>, FileError> {
        self.attribute(Semantic::Positions).ok_or_else(|| self.wrong("has no POSITION"))
    }
}

/// The primitives, and the buffers that they lie in.
struct Scene<'a> {
    buffers: Buffers<'a>,
    placed: &'a [Placed<'a>],
}

impl Scene<'_> {
    /// Counts everything before any of it is read: many primitives may share an accessor.
    fn check_counts(&self, limits: &Limits) -> Result<(), FileError> {
        let (mut vertices, mut corners) = (0_u64, 0_u64);
        for placed in self.placed {
            let count = self.buffers.count(placed.positions()?);
            vertices = vertices.saturating_add(count);
            let indices = placed.primitive.indices.map_or(count, |i| self.buffers.count(i));
            corners = corners.saturating_add(indices);
        }
        limit("vertices", vertices, limits.vertices)?;
        limit("triangles", corners / 3, limits.triangles)
    }

    /// Whether any primitive has an attribute.
    fn has(&self, semantic: &Semantic) -> bool {
        self.placed.iter().any(|placed| placed.attribute(semantic.clone()).is_some())
    }

    /// Adds a primitive to a mesh.
    fn add(&mut self, placed: &Placed<'_>, mesh: &mut FileMesh) -> Result<(), FileError> {
        let transform = &placed.transform;
        let positions: Vec<[f32; 3]> = self.buffers.floats(placed.positions()?)?;
        let (first, count) = (mesh.positions.len(), positions.len());
        let same = |what: &str, others: usize| {
            if others == count {
                return Ok(());
            }
            Err(placed.wrong(&format!("{others} {what} for {count} positions")))
        };
        mesh.positions.extend(positions.into_iter().map(|place| transform.position(place)));
        match placed.attribute(Semantic::Normals) {
            Some(accessor) => {
                let normals: Vec<[f32; 3]> = self.buffers.floats(accessor)?;
                same("normals", normals.len())?;
                mesh.normals.extend(normals.into_iter().map(|normal| transform.normal(normal)));
            }
            None if self.has(&Semantic::Normals) => mesh.normals.resize(first + count, [0.0; 3]),
            None => {}
        }
        match placed.attribute(Semantic::TexCoords(0)) {
            Some(accessor) => {
                let texcoords: Vec<[f32; 2]> = self.buffers.floats(accessor)?;
                same("texture coordinates", texcoords.len())?;
                mesh.texcoords.extend(texcoords.into_iter().map(|[u, v]| [u, 1.0 - v]));
            }
            None if self.has(&Semantic::TexCoords(0)) => {
                let message = "has no TEXCOORD_0, but others have; allowed are all or none";
                return Err(placed.wrong(message));
            }
            None => {}
        }
        self.add_triangles(placed, first, count, mesh)
    }

    /// Adds the triangles of a primitive whose vertices are `count` from `first` on.
    fn add_triangles(
        &mut self,
        placed: &Placed<'_>,
        first: usize,
        count: usize,
        mesh: &mut FileMesh,
    ) -> Result<(), FileError> {
        let corners = match placed.primitive.indices {
            Some(accessor) => self.buffers.indices(accessor)?,
            None => (0..index(count)).collect(),
        };
        if !corners.len().is_multiple_of(3) {
            let message = format!("{} corners, allowed are multiples of 3", corners.len());
            return Err(placed.wrong(&message));
        }
        if let Some(place) = corners.iter().position(|corner| *corner as usize >= count) {
            let corner = corners[place];
            return Err(placed.wrong(&format!("index {place} is {corner}, allowed below {count}")));
        }
        let offset = index(first);
        mesh.triangles.extend(corners.chunks_exact(3).map(|corners| {
            let [a, b, c] = [0, 1, 2].map(|i| corners[i] + offset);
            // A mirror turns the fronts of triangles to the back.
            if placed.transform.mirrors() { [a, c, b] } else { [a, b, c] }
        }));
        Ok(())
    }
}

#[cfg(test)]
mod tests;
