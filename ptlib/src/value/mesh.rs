//! Triangles.

use std::sync::OnceLock;

use super::{
    Bounds, ContentHash, Stream, Words,
    check::{self, unit_of},
    content::Content,
};
use crate::{
    error::{Error, ErrorKind},
    limits::Limits,
};

/// Triangles: three numbers of vertices for each, and the streams of the vertices.
///
/// A mesh that exists keeps these rules: it has a stream `position`; every number is finite and in
/// the range that its stream asks for; normals have length 1; every index is the number of a
/// vertex. A triangle may be degenerate, and a mesh may be empty.
#[derive(Debug)]
pub struct Mesh {
    vertex_count: u32,
    indices: Words,
    streams: Vec<Stream>,
    bounds: Bounds,
    /// Taken when somebody asks: most values are never compared.
    content: OnceLock<ContentHash>,
}

impl Mesh {
    /// A mesh, checked. Streams that break a rule which can be repaired (normals of another
    /// length) are copied and repaired, the others are used where they are.
    ///
    /// # Errors
    /// [`ErrorKind::Limit`], [`ErrorKind::InvalidArgument`], [`ErrorKind::OutOfRange`] with the
    /// first offender and how many there are, [`ErrorKind::NoMemory`].
    pub fn new(
        vertex_count: u32,
        indices: Words,
        mut streams: Vec<Stream>,
        limits: &Limits,
    ) -> Result<Self, Error> {
        Self::check_counts(vertex_count, indices.len(), streams.len(), limits)?;
        check::list(&streams, vertex_count)?;
        check::indices(&indices, vertex_count)?;
        let recompute = |positions: &Stream| area_normals(positions, &indices, vertex_count);
        check::numbers(&mut streams, Some(&recompute))?;
        let bounds = check::bounds(&streams, vertex_count)?;
        Ok(Self { vertex_count, indices, streams, bounds, content: OnceLock::new() })
    }

    /// Whether a mesh may be of that size.
    ///
    /// # Errors
    /// [`ErrorKind::Limit`]; [`ErrorKind::InvalidArgument`] if the indices are no triangles.
    pub fn check_counts(
        vertices: u32,
        indices: usize,
        streams: usize,
        limits: &Limits,
    ) -> Result<(), Error> {
        check::stream_count(streams, limits)?;
        check::count("vertices", vertices.into(), limits.mesh_vertices)?;
        check::count("triangles", indices.div_ceil(3) as u64, limits.mesh_triangles)?;
        if !indices.is_multiple_of(3) {
            let message = format!("{indices} indices are given, allowed are multiples of 3");
            return Err(Error::new(ErrorKind::InvalidArgument, message));
        }
        Ok(())
    }

    /// How many vertices.
    #[must_use]
    pub fn vertex_count(&self) -> u32 {
        self.vertex_count
    }

    /// Numbers of vertices, three for each triangle.
    #[must_use]
    pub fn indices(&self) -> &Words {
        &self.indices
    }

    /// The data of the vertices.
    #[must_use]
    pub fn streams(&self) -> &[Stream] {
        &self.streams
    }

    /// The stream of that id.
    #[must_use]
    pub fn stream(&self, id: &str) -> Option<&Stream> {
        self.streams.iter().find(|stream| stream.id() == id)
    }

    /// The smallest and the largest coordinates.
    #[must_use]
    pub fn bounds(&self) -> Bounds {
        self.bounds
    }

    /// The hash of the content. The first call takes it, which needs a look at everything.
    #[must_use]
    pub fn content(&self) -> &ContentHash {
        self.content.get_or_init(|| {
            let mut content = Content::new("mesh");
            content.number(u64::from(self.vertex_count));
            content.words(&self.indices);
            content.streams(&self.streams);
            content.finish()
        })
    }

    /// All memory of the mesh.
    pub(super) fn memory(&self) -> impl Iterator<Item = &Words> {
        std::iter::once(&self.indices).chain(self.streams.iter().map(Stream::data))
    }
}

/// The normal of each vertex: that of its triangles, each by its area. A vertex without any area
/// looks along z.
fn area_normals(positions: &Stream, indices: &[u32], vertex_count: u32) -> Vec<[f64; 3]> {
    let positions = positions.floats();
    let mut normals = vec![[0.0; 3]; vertex_count as usize];
    for triangle in indices.chunks_exact(3) {
        let corner = |i: usize| {
            let position = positions.at(triangle[i] as usize);
            [position[0], position[1], position[2]].map(f64::from)
        };
        let (a, b, c) = (corner(0), corner(1), corner(2));
        let (p, q) = (difference(b, a), difference(c, a));
        let area =
            [p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0]];
        for vertex in triangle {
            let normal = &mut normals[*vertex as usize];
            *normal = std::array::from_fn(|axis| normal[axis] + area[axis]);
        }
    }
    normals.into_iter().map(|normal| unit_of(normal).unwrap_or([0.0, 0.0, 1.0])).collect()
}

fn difference(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    std::array::from_fn(|axis| a[axis] - b[axis])
}

#[cfg(test)]
mod tests {
    use super::{super::StreamShape, *};

    fn words(numbers: &[f32]) -> Words {
        Words::copy_of(bytemuck::cast_slice(numbers)).unwrap()
    }

    fn stream(shape: StreamShape, numbers: &[f32]) -> Stream {
        Stream::packed(shape, words(numbers)).unwrap()
    }

    fn positions() -> Stream {
        let numbers = [0.0, 0.0, 0.0, 2.0, 0.0, 0.0, 0.0, 3.0, -1.0];
        stream(StreamShape::floats("position", 3), &numbers)
    }

    fn mesh(indices: &[u32], streams: Vec<Stream>) -> Result<Mesh, Error> {
        Mesh::new(3, Words::copy_of(indices).unwrap(), streams, &Limits::default())
    }

    fn message(indices: &[u32], streams: Vec<Stream>) -> String {
        mesh(indices, streams).unwrap_err().to_string()
    }

    #[test]
    fn what_is_right_stays_where_it_is() {
        let (positions, normals) =
            (positions(), stream(StreamShape::floats("normal", 3), &[0.0, 0.6, 0.8].repeat(3)));
        let addresses = [positions.data().as_ptr(), normals.data().as_ptr()];
        let mesh = mesh(&[0, 1, 2, 2, 2, 2], vec![positions, normals]).unwrap();
        assert_eq!(mesh.bounds(), Bounds { min: [0.0, 0.0, -1.0], max: [2.0, 3.0, 0.0] });
        assert_eq!([0, 1].map(|i| mesh.streams()[i].data().as_ptr()), addresses);
        assert_eq!((mesh.vertex_count(), mesh.indices().len()), (3, 6));
        assert!(mesh.stream("texcoord").is_none());
    }

    #[test]
    fn an_empty_mesh_is_legal() {
        let streams = vec![stream(StreamShape::floats("position", 3), &[])];
        let mesh = Mesh::new(0, Words::copy_of(&[]).unwrap(), streams, &Limits::default());
        assert_eq!(mesh.unwrap().bounds(), Bounds::default());
    }

    #[test]
    fn indices_name_vertices_three_by_three() {
        assert_eq!(
            message(&[0, 1, 99, 3, 1, 2], vec![positions()]),
            "the indices: index 2 of 6 is 99, allowed below 3; 2 such indices"
        );
        assert!(message(&[0, 1], vec![positions()]).contains("2 indices are given"));
    }

    #[test]
    fn numbers_are_finite_and_in_their_ranges() {
        let mut numbers = [0.0; 9];
        (numbers[4], numbers[7]) = (f32::NAN, 1.5e18);
        let position = || StreamShape::floats("position", 3);
        assert_eq!(
            message(&[], vec![stream(position(), &numbers)]),
            "stream \"position\": element 1 of 3 is NaN, allowed finite numbers from -1e18 to \
             1e18; 2 such elements"
        );
        numbers[4] = f32::NEG_INFINITY;
        assert!(message(&[], vec![stream(position(), &numbers)]).contains("is -inf"));
        for (id, components) in [("loss age", 1), ("random", 1), ("color", 4)] {
            let mut numbers = vec![0.5; 3 * components as usize];
            *numbers.last_mut().unwrap() = 1.25;
            let bad = stream(StreamShape::floats(id, components), &numbers);
            let said = message(&[], vec![positions(), bad]);
            let expected = "element 2 of 3 is 1.25, allowed 0 to 1; 1 such element";
            assert!(said.ends_with(expected), "{said}");
        }
    }

    #[test]
    fn streams_are_complete_and_unique() {
        assert!(message(&[], vec![]).contains("no stream \"position\""));
        let twice = message(&[], vec![positions(), positions()]);
        assert_eq!(twice, "stream \"position\" is given twice, allowed once");
        let short = stream(StreamShape::floats("radius", 1), &[1.0, 2.0]);
        assert!(message(&[], vec![positions(), short]).contains("2 elements, 3 are needed"));
    }

    #[test]
    fn counts_have_limits() {
        let limits = Limits { mesh_vertices: 2, ..Limits::default() };
        let error = Mesh::new(3, words(&[]), vec![positions()], &limits).unwrap_err();
        assert_eq!(error.kind(), ErrorKind::Limit);
        assert_eq!(error.to_string(), "3 vertices are given, allowed 2");
        let limits = Limits { mesh_triangles: 1, ..Limits::default() };
        assert!(Mesh::check_counts(3, 6, 1, &limits).is_err());
        let limits = Limits { streams: 0, ..Limits::default() };
        assert!(Mesh::check_counts(3, 6, 1, &limits).is_err());
    }

    #[test]
    fn normals_are_made_unit_and_recomputed_where_they_have_no_direction() {
        let normals = [0.0, 0.0, 4.0, 0.0, 0.0, 0.0, 1e-7, 0.0, 0.0];
        let normals = stream(StreamShape::floats("normal", 3), &normals);
        let mesh = mesh(&[0, 1, 2], vec![positions(), normals]).unwrap();
        let found = mesh.stream("normal").unwrap().floats();
        assert_eq!(found.at(0), [0.0, 0.0, 1.0]);
        // (2,0,0) × (0,3,-1) = (0,2,6)
        let expected = [0.0, 0.316_227_77, 0.948_683_3];
        assert_eq!((found.at(1), found.at(2)), (&expected[..], &expected[..]));
    }

    #[test]
    fn a_normal_of_a_vertex_without_area_looks_along_z() {
        let normals = stream(StreamShape::floats("normal", 3), &[0.0; 9]);
        let mesh = mesh(&[1, 1, 1], vec![positions(), normals]).unwrap();
        assert_eq!(mesh.stream("normal").unwrap().floats().at(1), [0.0, 0.0, 1.0]);
    }

    #[test]
    fn tangents_have_signs_and_directions_must_have_one() {
        let tangents = [1.0, 0.0, 0.0, -0.5, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 1.0];
        let tangents = stream(StreamShape::floats("tangent", 4), &tangents);
        let made = mesh(&[], vec![positions(), tangents]).unwrap();
        let found = made.stream("tangent").unwrap().floats();
        assert_eq!([0, 1, 2].map(|i| found.at(i)[3]), [-1.0, 1.0, 1.0]);
        let directions = stream(StreamShape::floats("direction", 3), &[0.0; 9]);
        assert_eq!(
            message(&[], vec![positions(), directions]),
            "stream \"direction\" (length): element 0 of 3 is 0, allowed from 1e-6 on; 3 such \
             elements"
        );
    }

    #[test]
    fn equal_meshes_have_equal_contents_whatever_their_layout() {
        let interleaved = [0.0, 0.0, 0.0, 9.0, 2.0, 0.0, 0.0, 9.0, 0.0, 3.0, -1.0];
        let shape = StreamShape::floats("position", 3);
        let wide = Stream::new(shape, words(&interleaved), 16, 3).unwrap();
        let content = |stream| *mesh(&[0, 1, 2], vec![stream]).unwrap().content();
        assert_eq!(content(wide), content(positions()));
        let other = *mesh(&[0, 2, 1], vec![positions()]).unwrap().content();
        assert_ne!(content(positions()), other);
    }
}
