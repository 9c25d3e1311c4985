//! Gives each vertex a frame: its normal, and the direction in which the texture grows.
//!
//! A missing normal is the sum of Q1×Q2 over the triangles around the vertex, so that large ones
//! count more. Tangents are sums too, of sign(det)·(v2·Q1 - v1·Q2) (and the like for the other
//! direction), where (u1, v1), (u2, v2) are the differences of texture coordinates along the edges
//! Q1, Q2, and det = u1·v2 - u2·v1. Lengyel's formula divides by det; without that, triangles count
//! by their area again, and one whose texture has none counts nothing. What is left of the sum
//! across the normal is the tangent; its fourth number is the side of the other direction.
//!
//! Sums are in double precision and in the order of triangles, gathered by each vertex.

use ptlib_plugin::{
    Element, Plain, Scratch, Stream,
    prelude::*,
    stream::{NORMAL, TANGENT},
};

use super::around::Around;

params! {
    /// Parameters of [`MeshFrames`].
    Params {
        /// Whether normals and tangents that the mesh has already are made anew. Otherwise they
        /// stay, and only missing ones are made.
        replace: bool = false;
    }
}

/// The block, prepared.
#[derive(Debug)]
pub struct MeshFrames {
    replace: bool,
}

const MESH: usize = 0;

impl Block for MeshFrames {
    type Params = Params;

    const ABOUT: About = About {
        id: c"aging.mesh frames",
        name: c"Mesh frames",
        category: c"mesh",
        summary: c"Gives the vertices of a mesh normals and tangents, if they have none.",
        inputs: &[&input(c"mesh", Kind::Mesh)
            .doc(c"The mesh. Without texture coordinates it gets normals, but no tangents.")],
        outputs: &[&output(c"mesh", Planes::Grey)
            .of_kind(Kind::Mesh)
            .doc(c"The mesh with all its data, and with normals and tangents.")],
        shape: Shape::Whole,
        ..About::DEFAULT
    };

    fn prepare(params: &Params, _: &Setup<'_>) -> Result<Self, BlockError> {
        Ok(Self { replace: params.replace })
    }

    fn compute(&self, call: &mut Call<'_>) -> Result<(), BlockError> {
        let (mesh, work) = (call.mesh(MESH)?, call.work());
        let normals = mesh.normals().filter(|_| !self.replace);
        let has_tangents = mesh.streams().get(TANGENT).is_some() && !self.replace;
        let texcoords = mesh.texcoords().filter(|_| !has_tangents);
        if normals.is_some() && texcoords.is_none() {
            return call.pass(0, 0);
        }
        let makes_normals = normals.is_none();
        let is_made =
            |id| id == c"normal" && makes_normals || id == c"tangent" && texcoords.is_some();
        let kept: Vec<_> = mesh.streams().iter().filter(|stream| !is_made(stream.id())).collect();
        let positions = Packed::new(mesh.positions()?, work)?;
        let coordinates = texcoords.map(|stream| Packed::new(stream, work)).transpose()?;
        let surface = Surface {
            positions: positions.slice(),
            texcoords: coordinates.as_ref().map(Packed::slice),
            triangles: mesh.triangles(),
            around: Around::new(&mesh, work)?,
        };
        work.report(0.2);
        let made = (makes_normals.then_some(NORMAL), texcoords.map(|_| TANGENT));
        let count = mesh.vertex_count();
        let mut out = call.new_mesh(0, count, Triangles::Of(mesh), (kept, made))?;
        out.fill(|first, (_, (mut out_normals, mut out_tangents))| {
            let made = out_normals.as_ref().map_or(0, |slice| slice.len());
            for i in 0..out_tangents.as_ref().map_or(made, |slice| slice.len()) {
                let vertex = first + i;
                let sums = surface.sums(vertex);
                let given = normals.map(|normals| normals.get(vertex).map(f64::from));
                let normal = unit(given.unwrap_or(sums.area)).unwrap_or(UP);
                if let Some(out) = &mut out_normals {
                    out[i] = normal.map(math::single);
                }
                if let Some(out) = &mut out_tangents {
                    out[i] = sums.tangent(normal);
                }
            }
            Ok(())
        })?;
        out.finish()
    }
}

/// The normal of a vertex that no triangle gives one, as the library has it.
const UP: [f64; 3] = [0.0, 0.0, 1.0];

/// Elements of one task.
const TASK: usize = 4096;

/// What is left of a tangent across the normal, as a part of its length, if it lies along it.
const NOTHING: f64 = 1e-12;

/// A stream whose elements lie one after the other: itself, or a copy.
enum Packed<'a, T: Plain> {
    Itself(&'a [T]),
    Copy(Scratch<'a, T>),
}

impl<'a, T: Plain + Element> Packed<'a, T> {
    fn new(stream: Stream<'a, T>, work: Work<'a>) -> Result<Self, BlockError> {
        if let Some(slice) = stream.as_slice() {
            return Ok(Self::Itself(slice));
        }
        let mut copy = work.scratch(stream.len())?;
        work.for_each(copy.chunks_mut(TASK).enumerate(), |(task, copy)| {
            for (i, element) in copy.iter_mut().enumerate() {
                *element = stream.get(task * TASK + i);
            }
            Ok(())
        })?;
        Ok(Self::Copy(copy))
    }

    fn slice(&self) -> &[T] {
        match self {
            Self::Itself(slice) => slice,
            Self::Copy(copy) => copy,
        }
    }
}

/// Triangles, and those around each vertex.
struct Surface<'a> {
    positions: &'a [[f32; 3]],
    texcoords: Option<&'a [[f32; 2]]>,
    triangles: &'a [[u32; 3]],
    around: Around<'a>,
}

/// Sums over the triangles around a vertex.
#[derive(Default)]
struct Sums {
    /// The areas, as vectors.
    area: [f64; 3],
    /// Where the first and the second texture coordinate grow.
    along: [f64; 3],
    other: [f64; 3],
}

impl Surface<'_> {
    fn sums(&self, vertex: usize) -> Sums {
        let mut sums = Sums::default();
        for triangle in self.around.of(vertex) {
            let corners = self.triangles[*triangle as usize].map(|corner| corner as usize);
            let [start, second, third] =
                corners.map(|corner| self.positions[corner].map(f64::from));
            let (q1, q2) = (difference(second, start), difference(third, start));
            let area = cross(q1, q2);
            sums.area = std::array::from_fn(|axis| sums.area[axis] + area[axis]);
            let Some(texcoords) = self.texcoords else { continue };
            let [start, second, third] = corners.map(|corner| texcoords[corner].map(f64::from));
            let [u1, v1] = [0, 1].map(|i| second[i] - start[i]);
            let [u2, v2] = [0, 1].map(|i| third[i] - start[i]);
            let det = u1 * v2 - u2 * v1;
            // A triangle whose texture has no area counts nothing.
            let sign = if det == 0.0 { 0.0 } else { 1.0_f64.copysign(det) };
            for axis in 0..3 {
                sums.along[axis] += sign * (v2 * q1[axis] - v1 * q2[axis]);
                sums.other[axis] += sign * (u1 * q2[axis] - u2 * q1[axis]);
            }
        }
        sums
    }
}

impl Sums {
    /// The tangent of a vertex whose normal has length 1.
    fn tangent(&self, n: [f64; 3]) -> [f32; 4] {
        let left = across(self.along, n);
        let is_left = dot(left, left) > NOTHING * NOTHING * dot(self.along, self.along);
        let tangent = unit(left).filter(|_| is_left).unwrap_or_else(|| any_across(n));
        let side = if dot(cross(n, tangent), self.other) < 0.0 { -1.0 } else { 1.0 };
        let [x, y, z] = tangent.map(math::single);
        [x, y, z, side]
    }
}

fn difference(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    std::array::from_fn(|axis| a[axis] - b[axis])
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

/// The vector of length 1, if there is one. It is scaled first, so that the squares of numbers of
/// any size are numbers.
fn unit(vector: [f64; 3]) -> Option<[f64; 3]> {
    let largest = vector.iter().fold(0.0, |largest: f64, x| largest.max(x.abs()));
    if largest == 0.0 {
        return None;
    }
    let scaled = vector.map(|x| x / largest);
    let length = dot(scaled, scaled).sqrt();
    Some(scaled.map(|x| x / length))
}

/// What is left of a vector across a direction.
fn across(vector: [f64; 3], n: [f64; 3]) -> [f64; 3] {
    let along = dot(n, vector);
    std::array::from_fn(|axis| vector[axis] - n[axis] * along)
}

/// A direction across another: that of the axis from which the other is furthest.
fn any_across(n: [f64; 3]) -> [f64; 3] {
    let [x, y, z] = n.map(f64::abs);
    let axis = if x <= y && x <= z {
        [1.0, 0.0, 0.0]
    } else if y <= z {
        [0.0, 1.0, 0.0]
    } else {
        [0.0, 0.0, 1.0]
    };
    unit(across(axis, n)).unwrap_or([1.0, 0.0, 0.0])
}

#[cfg(test)]
mod tests {
    use ptlib::{
        Limits,
        params::ParamValue,
        value::{Mesh, Stream, StreamShape, Value, Words},
    };

    use crate::mesh::testing::{Sample, compute, compute_on, floats};

    fn frames(sample: &Sample) -> std::sync::Arc<Mesh> {
        compute("aging.mesh frames", sample.value(), &[]).unwrap()
    }

    fn replaced(sample: &Sample) -> std::sync::Arc<Mesh> {
        compute("aging.mesh frames", sample.value(), &[("replace", ParamValue::Bool(true))])
            .unwrap()
    }

    fn near(found: &[f32], expected: &[f32]) -> bool {
        found.len() == expected.len()
            && found.iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-6)
    }

    fn triangle() -> Sample {
        Sample {
            positions: vec![[0.0, 0.0, 0.0], [2.0, 0.0, 0.0], [0.0, 2.0, 1.0]],
            texcoords: vec![[0.0, 0.0], [0.5, 0.0], [0.0, 0.25]],
            ..Sample::default()
        }
    }

    #[test]
    fn a_triangle_of_the_specification() {
        let mesh = frames(&triangle());
        for vertex in 0..3 {
            assert!(near(&floats(&mesh, "normal")[vertex], &[0.0, -0.447_213_6, 0.894_427_2]));
            assert!(near(&floats(&mesh, "tangent")[vertex], &[1.0, 0.0, 0.0, 1.0]));
        }
        assert_eq!(&mesh.indices()[..], [0, 1, 2]);
    }

    #[test]
    fn a_mirrored_texture_has_the_other_side() {
        let mut sample = triangle();
        sample.texcoords = vec![[0.0, 0.0], [-0.5, 0.0], [0.0, 0.25]];
        let mesh = frames(&sample);
        assert!(near(&floats(&mesh, "tangent")[0], &[-1.0, 0.0, 0.0, -1.0]));
    }

    #[test]
    fn large_triangles_count_more() {
        // Around the first vertex: area vectors (0,0,4) and (1,0,0).
        let sample = Sample {
            positions: vec![
                [0.0; 3],
                [2.0, 0.0, 0.0],
                [0.0, 2.0, 0.0],
                [0.0, 1.0, 0.0],
                [0.0, 0.0, 1.0],
            ],
            triangles: vec![[0, 1, 2], [0, 3, 4]],
            ..Sample::default()
        };
        let mesh = frames(&sample);
        let length = 17.0_f32.sqrt();
        assert!(near(&floats(&mesh, "normal")[0], &[1.0 / length, 0.0, 4.0 / length]));
        assert!(near(&floats(&mesh, "normal")[4], &[1.0, 0.0, 0.0]));
        assert!(mesh.stream("tangent").is_none());
    }

    #[test]
    fn a_texture_without_area_gives_the_axis_furthest_from_the_normal() {
        let mut sample = triangle();
        sample.texcoords = vec![[0.5, 0.5]; 3];
        assert!(near(&floats(&frames(&sample), "tangent")[0], &[1.0, 0.0, 0.0, 1.0]));
        sample.normals = vec![[1.0, 0.0, 0.0], [0.8, 0.6, 0.0], [0.0, 1.0, 0.0]];
        let mesh = frames(&sample);
        let tangents = floats(&mesh, "tangent");
        assert_eq!(tangents, [[0.0, 1.0, 0.0, 1.0], [0.0, 0.0, 1.0, 1.0], [1.0, 0.0, 0.0, 1.0]]);
        // The texture grows along the normal.
        let mut sample = triangle();
        sample.normals = vec![[1.0, 0.0, 0.0]; 3];
        assert!(near(&floats(&frames(&sample), "tangent")[0], &[0.0, 1.0, 0.0, 1.0]));
    }

    #[test]
    fn a_mesh_without_area_has_frames_all_the_same() {
        let flat = Sample { positions: vec![[1.0; 3]; 3], ..triangle() };
        let mesh = frames(&flat);
        assert_eq!(floats(&mesh, "normal"), [[0.0, 0.0, 1.0]; 3]);
        assert_eq!(floats(&mesh, "tangent"), [[1.0, 0.0, 0.0, 1.0]; 3]);
        let empty = Sample { positions: vec![], triangles: vec![], ..Sample::default() };
        assert_eq!(frames(&empty).vertex_count(), 0);
    }

    #[test]
    fn huge_and_tiny_triangles_have_normals() {
        for size in [1e18, 1e-30, 1e-44] {
            let mut sample = triangle();
            sample.positions =
                sample.positions.iter().map(|place| place.map(|x| x * size * 0.5)).collect();
            let mesh = frames(&sample);
            let [x, y, z] = floats(&mesh, "normal")[0][..] else { panic!("three numbers") };
            assert!((x * x + y * y + z * z - 1.0).abs() < 1e-5, "{size}: {x} {y} {z}");
            assert!(near(&floats(&mesh, "tangent")[0], &[1.0, 0.0, 0.0, 1.0]), "{size}");
        }
    }

    #[test]
    fn what_is_there_stays_unless_it_is_replaced() {
        let mut sample = triangle();
        sample.normals = vec![[0.0, 0.0, 1.0]; 3];
        sample.tangents = vec![[0.0, 1.0, 0.0, -1.0]; 3];
        let value = sample.value();
        let kept = compute("aging.mesh frames", value.clone(), &[]).unwrap();
        assert_eq!(Value::Mesh(kept).content(), value.content());
        let mesh = replaced(&sample);
        assert!(near(&floats(&mesh, "normal")[0], &[0.0, -0.447_213_6, 0.894_427_2]));
        assert!(near(&floats(&mesh, "tangent")[0], &[1.0, 0.0, 0.0, 1.0]));
        sample.tangents.clear();
        let mesh = frames(&sample);
        assert_eq!(floats(&mesh, "normal")[0], [0.0, 0.0, 1.0]);
        assert!(near(&floats(&mesh, "tangent")[0], &[1.0, 0.0, 0.0, 1.0]));
    }

    #[test]
    fn interleaved_vertices_are_read_where_they_lie() {
        let sample = triangle();
        let plain = frames(&sample);
        let rows = sample.positions.iter().zip(&sample.texcoords);
        let rows = rows.flat_map(|([x, y, z], [u, v])| [*u, *v, *x, *y, *z]);
        let words: Vec<u32> = rows.map(f32::to_bits).collect();
        let stream = |id, components, from: usize| {
            let words = Words::copy_of(&words[from..]).unwrap();
            Stream::new(StreamShape::floats(id, components), words, 20, 3).unwrap()
        };
        let streams = vec![stream("position", 3, 2), stream("texcoord", 2, 0)];
        let indices = Words::copy_of(&[0, 1, 2]).unwrap();
        let mesh = Mesh::new(3, indices, streams, &Limits::default()).unwrap();
        let mesh = compute("aging.mesh frames", Value::Mesh(mesh.into()), &[]).unwrap();
        for id in ["normal", "tangent"] {
            assert_eq!(floats(&mesh, id), floats(&plain, id));
        }
    }

    #[test]
    fn frames_are_the_same_on_any_number_of_threads() {
        let sample = Sample::ball(60, 80);
        let contents: Vec<_> = [1, 2, 3, 8]
            .into_iter()
            .map(|threads| {
                let mesh = compute_on(threads, "aging.mesh frames", sample.value(), &[]).unwrap();
                assert_eq!(mesh.streams().len(), 4);
                Value::Mesh(mesh).content()
            })
            .collect();
        assert!(contents.iter().all(|content| *content == contents[0]));
    }

    #[test]
    fn normals_of_a_ball_point_outwards_and_tangents_across_them() {
        let sample = Sample::ball(60, 80);
        let mesh = frames(&sample);
        let (normals, tangents) = (floats(&mesh, "normal"), floats(&mesh, "tangent"));
        for ((normal, tangent), place) in normals.iter().zip(&tangents).zip(&sample.positions) {
            // Not every vertex at a pole has a triangle.
            if place[1].abs() > 0.999_99 {
                continue;
            }
            let dot = |a: &[f32], b: &[f32]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f32>();
            assert!(dot(normal, place) > 0.99, "{normal:?} at {place:?}");
            assert!(dot(normal, &tangent[..3]).abs() < 1e-6);
            assert!((dot(&tangent[..3], &tangent[..3]) - 1.0).abs() < 1e-6);
            assert_eq!(tangent[3].to_bits(), 1.0_f32.to_bits());
        }
    }
}
