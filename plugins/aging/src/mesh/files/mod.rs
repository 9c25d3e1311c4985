//! Mesh files: bytes become checked vertices and triangles, or an error that says where it is.
//!
//! The readers are pure: what they want from elsewhere, they ask an [`Outside`] for. Files are of
//! strangers, so whatever they claim is compared with a limit, and with the bytes that are there,
//! before memory is taken for it. Everything that comes out keeps the rules of meshes: numbers are
//! finite, indices lead to vertices, and each stream is complete or missing.
//!
//! A line or a face of fewer than three corners draws nothing and is passed over. Polygons become
//! fans around their first corner. The order is that of the file.

mod accessor;
#[cfg(test)]
mod example;
pub mod gltf;
pub mod obj;
pub mod ply;
mod transform;
mod uri;

use ptlib_plugin::BlockError;

/// The largest coordinate that a mesh may have.
const LARGEST: f32 = 1e18;

/// What a file contains.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct FileMesh {
    /// Where the vertices are.
    pub positions: Vec<[f32; 3]>,
    /// The direction away from the surface at each vertex, of any length; empty if the file has
    /// none. A vertex without one has zeros.
    pub normals: Vec<[f32; 3]>,
    /// The texture coordinates of each vertex, the second upwards; empty if the file has none.
    pub texcoords: Vec<[f32; 2]>,
    /// The numbers of the three vertices of each triangle.
    pub triangles: Vec<[u32; 3]>,
}

/// How much a file may contain.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Limits {
    /// Vertices, and places, normals or texture coordinates that they are made of.
    pub vertices: usize,
    /// Triangles, and faces that they are made of.
    pub triangles: usize,
    /// Bytes of all files that a file names.
    pub bytes: usize,
    /// Objects and entries of lists in a description in JSON.
    pub entries: usize,
}

impl Default for Limits {
    fn default() -> Self {
        Self { vertices: 16 << 20, triangles: 32 << 20, bytes: 1 << 30, entries: 1 << 22 }
    }
}

/// Why a file is not read.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum FileError {
    /// It does not follow its format: where, and what is allowed.
    Parse(String),
    /// It has more than is allowed.
    Limit(String),
    /// The computation stops, or another file cannot be read.
    Stopped(BlockError),
}

impl FileError {
    /// The error of a block that reads the file of that name.
    #[must_use]
    pub fn of_file(self, name: &str) -> BlockError {
        match self {
            Self::Parse(message) => BlockError::parse(format!("\"{name}\": {message}")),
            Self::Limit(message) => BlockError::limit(format!("\"{name}\": {message}")),
            Self::Stopped(error) => error,
        }
    }
}

impl From<BlockError> for FileError {
    fn from(error: BlockError) -> Self {
        Self::Stopped(error)
    }
}

/// What readers ask for while they work.
pub trait Outside {
    /// Goes on, or fails because somebody asked to stop.
    ///
    /// # Errors
    /// [`BlockError::cancelled`].
    fn check(&self) -> Result<(), BlockError>;

    /// The bytes of a file, named as in the file that is read: relative to it.
    ///
    /// # Errors
    /// If there is none, or it may not be read.
    fn read(&self, name: &str) -> Result<Vec<u8>, BlockError>;
}

/// No other files, and nobody who asks to stop.
#[derive(Debug, Clone, Copy)]
pub struct Alone;

impl Outside for Alone {
    fn check(&self) -> Result<(), BlockError> {
        Ok(())
    }

    fn read(&self, name: &str) -> Result<Vec<u8>, BlockError> {
        Err(BlockError::invalid(format!("there is no other file \"{name}\"")))
    }
}

/// What a file is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Format {
    /// Wavefront's text.
    Obj,
    /// The Stanford polygon format, as text or binary.
    Ply,
    /// Khronos' glTF, as JSON or with everything in one file (GLB).
    Gltf,
}

impl Format {
    /// What bytes are by their start. Texts that are nothing else are taken for OBJ, which has no
    /// mark.
    ///
    /// # Errors
    /// If they are nothing that is known.
    pub fn of(bytes: &[u8]) -> Result<Self, FileError> {
        let text = bytes.strip_prefix(b"\xEF\xBB\xBF").unwrap_or(bytes).trim_ascii_start();
        let is_ply = bytes.strip_prefix(b"ply").and_then(<[u8]>::first);
        if is_ply.is_some_and(u8::is_ascii_whitespace) {
            return Ok(Self::Ply);
        }
        if bytes.starts_with(b"glTF") || text.starts_with(b"{") {
            return Ok(Self::Gltf);
        }
        if text.is_empty() || text.iter().take(1024).any(|byte| *byte == 0) {
            let message = "is no mesh file; allowed are OBJ, PLY, glTF and GLB";
            return Err(FileError::Parse(message.to_owned()));
        }
        Ok(Self::Obj)
    }
}

/// Reads a file of a format, or of the one that its bytes are in.
///
/// # Errors
/// What is wrong with the file, and where.
pub fn read(
    bytes: &[u8],
    format: Option<Format>,
    outside: &dyn Outside,
    limits: &Limits,
) -> Result<FileMesh, FileError> {
    match format.map_or_else(|| Format::of(bytes), Ok)? {
        Format::Obj => obj::read(bytes, outside, limits),
        Format::Ply => ply::read(bytes, outside, limits),
        Format::Gltf => gltf::read(bytes, outside, limits),
    }
}

impl FileMesh {
    /// That a mesh keeps the rules, whatever a reader let through.
    fn check(&self) -> Result<(), FileError> {
        numbers("position", &self.positions)?;
        numbers("normal", &self.normals)?;
        numbers("texture coordinate", &self.texcoords)?;
        let count = self.positions.len();
        for (what, others) in
            [("normals", self.normals.len()), ("texture coordinates", self.texcoords.len())]
        {
            if others != 0 && others != count {
                let message = format!("{others} {what} for {count} vertices, allowed one for each");
                return Err(FileError::Parse(message));
            }
        }
        let is_wrong = |triangle: &[u32; 3]| triangle.iter().any(|i| *i as usize >= count);
        let mut wrong = self.triangles.iter().enumerate().filter(|(_, corners)| is_wrong(corners));
        let Some((first, corners)) = wrong.next() else { return Ok(()) };
        let more = wrong.count() + 1;
        Err(FileError::Parse(format!(
            "triangle {first}: vertices {corners:?}, allowed below {count}; {more} such triangles"
        )))
    }
}

/// That all numbers of elements are finite and not too large.
fn numbers<const N: usize>(what: &str, elements: &[[f32; N]]) -> Result<(), FileError> {
    let mut wrong = elements.iter().enumerate().filter(|(_, element)| !element.iter().all(is_fine));
    let Some((first, element)) = wrong.next() else { return Ok(()) };
    let more = wrong.count() + 1;
    Err(FileError::Parse(format!(
        "vertex {first}: the {what} is {element:?}, allowed are finite numbers from -1e18 to 1e18; \
         {more} such vertices"
    )))
}

/// Whether a number may stand in a mesh.
fn is_fine(number: &f32) -> bool {
    number.abs() <= LARGEST
}

/// That so many of something are allowed.
fn limit(what: &str, count: u64, allowed: usize) -> Result<(), FileError> {
    if count <= allowed as u64 {
        return Ok(());
    }
    Err(FileError::Limit(format!("{count} {what}, allowed {allowed}")))
}

/// The number of a vertex; the limits keep it below 2³².
fn index(number: usize) -> u32 {
    u32::try_from(number).unwrap_or(u32::MAX)
}

/// A message of another library, in one line of bearable length.
fn one_line(message: &str) -> String {
    // It may quote a line of a file that has no others.
    let start: String = message.chars().take(1000).collect();
    let words = start.split_whitespace().collect::<Vec<_>>().join(" ");
    let mut line: String = words.chars().take(300).collect();
    if line.len() < words.len() || start.len() < message.len() {
        line.push('…');
    }
    line
}

#[cfg(test)]
pub(crate) mod testing {
    use super::*;

    /// What a reader says about a wrong file.
    pub fn fault(bytes: &[u8]) -> String {
        match read(bytes, None, &Alone, &Limits::default()) {
            Err(FileError::Parse(message) | FileError::Limit(message)) => message,
            Err(FileError::Stopped(error)) => error.message(),
            Ok(mesh) => panic!("is read: {mesh:?}"),
        }
    }

    /// A wrong file, and what its error must contain.
    pub fn assert_fault(bytes: &[u8], expected: &str) {
        let said = fault(bytes);
        assert!(said.contains(expected), "{said:?} does not contain {expected:?}");
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn formats_are_known_by_their_start() {
        assert_eq!(Format::of(b"ply\nformat"), Ok(Format::Ply));
        assert_eq!(Format::of(b"ply\r\n"), Ok(Format::Ply));
        assert_eq!(Format::of(b"glTF\x02"), Ok(Format::Gltf));
        assert_eq!(Format::of(b"\xEF\xBB\xBF \n{}"), Ok(Format::Gltf));
        assert_eq!(Format::of(b"plywood"), Ok(Format::Obj));
        assert_eq!(Format::of(b"# made by hand"), Ok(Format::Obj));
        for nothing in [&b""[..], b"  \n", b"\x89PNG\r\n\x1a\n\0\0\0"] {
            assert!(matches!(Format::of(nothing), Err(FileError::Parse(_))));
        }
    }

    #[test]
    fn what_breaks_the_rules_is_named_and_counted() {
        let good = FileMesh {
            positions: vec![[0.0; 3]; 3],
            normals: vec![[0.0; 3]; 3],
            texcoords: vec![[0.0; 2]; 3],
            triangles: vec![[0, 1, 2]],
        };
        assert_eq!(good.check(), Ok(()));
        let said = |change: &dyn Fn(&mut FileMesh)| {
            let mut mesh = good.clone();
            change(&mut mesh);
            format!("{:?}", mesh.check().unwrap_err())
        };
        let bad = [f32::NAN, f32::INFINITY, f32::NEG_INFINITY, 1.1e18, -1.1e18];
        for number in bad {
            assert!(said(&|mesh| mesh.positions[1][2] = number).contains("vertex 1: the position"));
            assert!(said(&|mesh| mesh.normals[2][0] = number).contains("vertex 2: the normal"));
            assert!(said(&|mesh| mesh.texcoords[0][1] = number).contains("texture coordinate"));
        }
        assert!(said(&|mesh| mesh.triangles.push([0, 3, 1])).contains("triangle 1"));
        assert!(said(&|mesh| mesh.triangles = vec![[3; 3]; 2]).contains("2 such"));
        assert!(said(&|mesh| mesh.normals.truncate(2)).contains("2 normals for 3"));
    }

    #[test]
    fn long_messages_are_cut() {
        assert_eq!(one_line("a\n\tb  c"), "a b c");
        let long = one_line(&"word ".repeat(1000));
        assert!(long.ends_with('…') && long.chars().count() == 301, "{long}");
    }
}
