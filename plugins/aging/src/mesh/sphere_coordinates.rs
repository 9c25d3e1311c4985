//! Second texture coordinates by inverse spherical mapping, for fine wrinkles.
//!
//! Seen from the centre, u goes around the y axis, ½ where z is, and v from the bottom to the top.
//! Where u jumps from 1 to 0 a triangle would be mapped across the whole texture, so each corner
//! takes the u that is nearest to that of the first, and vertices whose triangles want different
//! ones are duplicated. A corner on the axis has no u; it takes the mean of the other two, for each
//! triangle of its own.
//!
//! The duplicates are appended in the order of the triangles that need them; a vertex keeps its
//! number and its u of 0 to 1. On the axis the first triangle uses the vertex itself.

use ptlib_plugin::{AnyStream, Scratch, prelude::*, stream::TEXCOORD1};

params! {
    /// Parameters of [`SphereCoordinates`].
    Params {
        /// How often the texture repeats around the mesh.
        repeat_x "repeat x": int [hard 1..=1024 soft 1..=64] = 1;
        /// How often the texture repeats from the bottom to the top.
        repeat_y "repeat y": int [hard 1..=1024 soft 1..=64] = 1;
        /// Whether the mesh is seen from the middle of its bounds. Otherwise from the centre below.
        automatic_centre "automatic centre": bool = true;
        /// Where the mesh is seen from, along x, in its own units.
        centre_x "centre x": float [hard -1000000.0..=1000000.0 soft -10.0..=10.0] = 0.0;
        /// Where the mesh is seen from, along y, in its own units.
        centre_y "centre y": float [hard -1000000.0..=1000000.0 soft -10.0..=10.0] = 0.0;
        /// Where the mesh is seen from, along z, in its own units.
        centre_z "centre z": float [hard -1000000.0..=1000000.0 soft -10.0..=10.0] = 0.0;
    }
}

/// The block, prepared.
#[derive(Debug)]
pub struct SphereCoordinates(Params);

const MESH: usize = 0;

/// A full turn.
const TURN: f64 = std::f64::consts::TAU;

/// How far a position may be from the axis, as a part of its distance from the centre, to be on it.
/// The poles of balls that programs make are not exact.
const ON_AXIS: f64 = 1e-6;

/// Vertices of one task.
const TASK: usize = 4096;

/// Triangles between two questions whether to stop.
const PASS: usize = 1 << 16;

impl Block for SphereCoordinates {
    type Params = Params;

    const ABOUT: About = About {
        id: c"aging.sphere coordinates",
        name: c"Sphere coordinates",
        category: c"mesh",
        summary: c"Gives a mesh second texture coordinates, as if its texture lay on a sphere.",
        inputs: &[&input(c"mesh", Kind::Mesh).doc(c"The mesh, y upwards, looking along z.")],
        outputs: &[&output(c"mesh", Planes::Grey).of_kind(Kind::Mesh).doc(
            c"The mesh with the stream texcoord1; vertices along the seam behind are duplicated.",
        )],
        shape: Shape::Whole,
        ..About::DEFAULT
    };

    fn prepare(params: &Params, _: &Setup<'_>) -> Result<Self, BlockError> {
        Ok(Self(params.clone()))
    }

    fn compute(&self, call: &mut Call<'_>) -> Result<(), BlockError> {
        let (mesh, work) = (call.mesh(MESH)?, call.work());
        let mut places = work.scratch::<[f64; 2]>(mesh.vertex_count())?;
        self.project(&mesh, &mut places, work)?;
        work.report(0.5);
        let seam = Seam::cut(&mesh, &places, work)?;
        work.report(0.7);
        self.give(call, &mesh, &places, &seam)
    }
}

impl SphereCoordinates {
    /// Where the mesh is seen from.
    fn centre(&self, mesh: &Mesh<'_>) -> [f64; 3] {
        let Params { automatic_centre, centre_x, centre_y, centre_z, .. } = self.0;
        if !automatic_centre {
            return [centre_x, centre_y, centre_z];
        }
        let [least, most] = mesh.bounds();
        std::array::from_fn(|axis| f64::from(least[axis]).midpoint(f64::from(most[axis])))
    }

    /// u and v of each vertex; those on the axis have no u.
    fn project(
        &self,
        mesh: &Mesh<'_>,
        places: &mut [[f64; 2]],
        work: Work<'_>,
    ) -> Result<(), BlockError> {
        let (positions, centre) = (mesh.positions()?, self.centre(mesh));
        let tasks = places.chunks_mut(TASK).enumerate();
        work.for_each(tasks, |(task, places)| {
            for (i, place) in places.iter_mut().enumerate() {
                let position = positions.get(task * TASK + i);
                *place = project([0, 1, 2].map(|axis| f64::from(position[axis]) - centre[axis]));
            }
            Ok(())
        })
    }

    /// Gives the mesh with its coordinates.
    fn give(
        &self,
        call: &Call<'_>,
        mesh: &Mesh<'_>,
        places: &[[f64; 2]],
        seam: &Seam<'_>,
    ) -> Result<(), BlockError> {
        let repeats = [self.0.repeat_x, self.0.repeat_y].map(f64::from);
        let old = mesh.vertex_count();
        let source = |vertex: usize| match vertex.checked_sub(old) {
            None => (vertex, seam.cuts.shifts[vertex]),
            Some(copy) => seam.cuts.copies[copy],
        };
        // A stream of one element serves the duplicates too.
        let is_shared = |stream: &AnyStream<'_>| seam.triangles.is_none() || stream.is_constant();
        let others = mesh.streams().iter().filter(|stream| stream.id() != c"texcoord1");
        let (shared, copied): (Vec<_>, Vec<_>) = others.partition(is_shared);
        let news: Vec<_> = copied.iter().map(|stream| stream.like()).collect();
        let triangles = match &seam.triangles {
            Some(triangles) => Triangles::New(triangles.len()),
            None => Triangles::Of(*mesh),
        };
        let count = old + seam.cuts.copies.len();
        let mut out = call.new_mesh(0, count, triangles, (shared, news, TEXCOORD1))?;
        if let Some(triangles) = &seam.triangles {
            out.triangles().copy_from_slice(triangles);
        }
        out.fill(|first, (_, news, coordinates)| {
            for (stream, mut bits) in copied.iter().zip(news) {
                for i in 0..bits.count() {
                    bits.element(i).copy_from_slice(stream.bits(source(first + i).0));
                }
            }
            for (i, out) in coordinates.iter_mut().enumerate() {
                let (vertex, shift) = source(first + i);
                let [u, v] = places[vertex];
                let u = if u.is_nan() { shift } else { u + shift };
                *out = [math::single(u * repeats[0]), math::single(v * repeats[1])];
            }
            Ok(())
        })?;
        out.finish()
    }
}

/// u and v of a position seen from the centre; on the axis u is no number.
fn project([x, y, z]: [f64; 3]) -> [f64; 2] {
    let across = x * x + z * z;
    let all = across + y * y;
    if all == 0.0 {
        return [f64::NAN, 0.5];
    }
    let v = 0.5 + math::asin((y / all.sqrt()).clamp(-1.0, 1.0)) / (0.5 * TURN);
    let is_on_axis = across <= ON_AXIS * ON_AXIS * all;
    let u = if is_on_axis { f64::NAN } else { 0.5 + math::atan2(x, z) / TURN };
    [u, v]
}

/// The mesh, cut along the seam.
struct Seam<'a> {
    /// The triangles with their new corners; none if nothing changes.
    triangles: Option<Scratch<'a, [u32; 3]>>,
    cuts: Cuts<'a>,
}

/// What becomes of the vertices.
struct Cuts<'a> {
    /// What the u of each vertex is shifted by: 0, but on the axis, where it is all of u.
    shifts: Scratch<'a, f64>,
    /// The duplicates of each vertex that are shifted to the left and to the right; 0 for none. On
    /// the axis the first number says whether the vertex itself is used.
    known: Scratch<'a, [u32; 2]>,
    /// For each duplicate the vertex, and what its u is shifted by.
    copies: Vec<(usize, f64)>,
}

impl<'a> Seam<'a> {
    /// Cuts: the only part that goes through the triangles in order.
    fn cut(mesh: &Mesh<'_>, places: &[[f64; 2]], work: Work<'a>) -> Result<Self, BlockError> {
        let old = mesh.triangles();
        let mut triangles = work.scratch::<[u32; 3]>(old.len())?;
        let mut cuts = Cuts {
            shifts: work.scratch(places.len())?,
            known: work.scratch(places.len())?,
            copies: vec![],
        };
        for (shift, [u, _]) in cuts.shifts.iter_mut().zip(places) {
            *shift = if u.is_nan() { 0.5 } else { 0.0 };
        }
        for (pass, out) in old.chunks(PASS).zip(triangles.chunks_mut(PASS)) {
            work.check()?;
            for (corners, out) in pass.iter().zip(out) {
                let us = corners.map(|vertex| places[vertex as usize][0]);
                let near = nearest(us);
                for i in 0..3 {
                    out[i] = cuts.corner(corners[i], us[i], near[i])?;
                }
            }
        }
        let triangles = (!cuts.copies.is_empty()).then_some(triangles);
        Ok(Self { triangles, cuts })
    }
}

impl Cuts<'_> {
    /// The vertex that has a u which a corner wants: it, or a duplicate.
    fn corner(&mut self, vertex: u32, u: f64, near: f64) -> Result<u32, BlockError> {
        let place = vertex as usize;
        let number = self.shifts.len() + self.copies.len();
        let next = || {
            let message = "the seam makes more vertices than can be counted";
            u32::try_from(number).map_err(|_| BlockError::limit(message))
        };
        let known = &mut self.known[place];
        if u.is_nan() {
            if known[0] == 0 {
                known[0] = 1;
                self.shifts[place] = near;
                return Ok(vertex);
            }
            self.copies.push((place, near));
            return next();
        }
        let shift = near - u;
        // Whole but for rounding.
        if shift.abs() < 0.5 {
            return Ok(vertex);
        }
        let known = &mut known[usize::from(shift > 0.0)];
        if *known == 0 {
            *known = next()?;
            self.copies.push((place, shift.round()));
        }
        Ok(*known)
    }
}

/// The u of the corners of a triangle: nearest to that of the first that has one, and means for
/// those that have none. A triangle without any has the middle.
fn nearest(us: [f64; 3]) -> [f64; 3] {
    let Some(first) = us.into_iter().find(|u| !u.is_nan()) else { return [0.5; 3] };
    let near = us.map(|u| if u.is_nan() { u } else { u - (u - first + 0.5).floor() });
    let known = || near.into_iter().filter(|u| !u.is_nan());
    let count = known().fold(0.0, |count, _| count + 1.0);
    let mean = known().fold(0.0, |sum, u| sum + u) / count;
    near.map(|u| if u.is_nan() { mean } else { u })
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use ptlib::{
        params::ParamValue,
        value::{Mesh, Value},
    };

    use super::*;
    use crate::mesh::testing::{
        Sample, compute, compute_on, float_stream, floats, sin_cos, whole_stream,
    };

    const BLOCK: &str = "aging.sphere coordinates";

    fn at_origin(sample: &Sample) -> Arc<Mesh> {
        compute(BLOCK, sample.value(), &[("automatic centre", ParamValue::Bool(false))]).unwrap()
    }

    fn near(found: &[f32], expected: [f32; 2]) -> bool {
        found.iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-6)
    }

    #[test]
    fn directions_of_the_specification() {
        let cases = [
            ([0.0, 0.0, 1.0], [0.5, 0.5]),
            ([1.0, 0.0, 0.0], [0.75, 0.5]),
            ([-1.0, 0.0, 0.0], [0.25, 0.5]),
            ([0.0, 0.0, -1.0], [1.0, 0.5]),
            ([0.0, 1.0, 0.0], [0.5, 1.0]),
            ([0.0, -7.0, 0.0], [0.5, 0.0]),
            ([0.0, 0.0, 0.0], [0.5, 0.5]),
            ([1.0, 1.0, 1.0], [0.625, 0.695_913]),
        ];
        let positions = cases.iter().map(|(position, _)| *position).collect();
        let mesh = at_origin(&Sample { positions, triangles: vec![], ..Sample::default() });
        for (found, (position, expected)) in floats(&mesh, "texcoord1").iter().zip(cases) {
            assert!(near(found, expected), "{position:?}: {found:?}");
        }
    }

    #[test]
    fn corners_take_the_nearest_u() {
        let is_near = |us: [f64; 3], expected: [f64; 3]| {
            nearest(us).iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-12)
        };
        assert!(is_near([0.98, 0.97, 0.02], [0.98, 0.97, 1.02]));
        assert!(is_near([0.02, 0.98, 0.97], [0.02, -0.02, -0.03]));
        assert!(is_near([f64::NAN, 0.98, 0.02], [1.0, 0.98, 1.02]));
        assert!(is_near([0.1, f64::NAN, 0.2], [0.1, 0.15, 0.2]));
        assert!(is_near([f64::NAN, 0.3, f64::NAN], [0.3; 3]));
        assert!(is_near([f64::NAN; 3], [0.5; 3]));
    }

    /// Where the texture would stand at an angle in turns behind the head.
    fn behind(turns: f64) -> [f32; 3] {
        let (sin, cos) = sin_cos(turns * TURN);
        [single(sin), 0.0, single(-cos)]
    }

    fn single(x: f64) -> f32 {
        math::single(x)
    }

    #[test]
    fn vertices_on_the_seam_are_duplicated_with_all_their_streams() {
        // u is .98, .97, .02 (and .03, with the seam behind them).
        let places = [0.02, 0.03, -0.02, -0.03].map(behind);
        let mut sample = Sample {
            positions: places.to_vec(),
            triangles: vec![[0, 1, 2], [2, 0, 1], [2, 3, 0], [1, 0, 2]],
            texcoords: vec![[0.0, 0.1], [0.2, 0.3], [0.4, 0.5], [0.6, 0.7]],
            ..Sample::default()
        };
        sample.others.push(whole_stream("id", 2, &[1, 2, 3, 4, 5, 6, 7, 8]));
        sample.others.push(float_stream("curl", 1, &[0.1, 0.2, 0.3, 0.4]));
        sample.others.push(float_stream("texcoord1", 2, &[9.0; 8]));
        let us = |mesh: &Mesh| -> Vec<f32> {
            floats(mesh, "texcoord1").iter().map(|place| place[0]).collect()
        };
        let mesh = at_origin(&sample);
        // Behind is u = 0 or 1, and x to the right of it less.
        let found = us(&mesh);
        assert_eq!(mesh.vertex_count(), 7, "{found:?}");
        let expected = [0.98, 0.97, 0.02, 0.03, 1.02, -0.02, -0.03];
        let is_near = found.iter().zip(expected).all(|(a, b): (&f32, f32)| (a - b).abs() < 1e-6);
        assert!(is_near, "{found:?}");
        assert_eq!(&mesh.indices()[..], [0, 1, 4, 2, 5, 6, 2, 3, 5, 1, 0, 4]);
        for (copy, original) in [(4, 2), (5, 0), (6, 1)] {
            for id in ["position", "texcoord", "curl"] {
                assert_eq!(floats(&mesh, id)[copy], floats(&mesh, id)[original], "{id}");
            }
            let ids = mesh.stream("id").unwrap().words();
            assert_eq!(ids.at(copy), ids.at(original));
        }
    }

    #[test]
    fn constant_streams_serve_the_duplicates_too() {
        let mut sample =
            Sample { positions: [0.02, 0.03, -0.02].map(behind).to_vec(), ..Sample::default() };
        sample.others.push(float_stream("radius", 1, &[0.5]));
        let mesh = at_origin(&sample);
        assert_eq!(mesh.vertex_count(), 4);
        assert!(mesh.stream("radius").unwrap().shape().is_constant);
        assert_eq!(mesh.stream("radius").unwrap().floats().at(3), [0.5]);
    }

    #[test]
    fn a_ball_has_no_triangle_across_the_texture() {
        let mut sample = Sample::ball(20, 24);
        // One vertex for each pole, and for both ends of a ring.
        for vertex in sample.triangles.as_flattened_mut() {
            *vertex = match (*vertex / 25, *vertex % 25) {
                (ring @ (0 | 20), _) | (ring, 24) => ring * 25,
                _ => *vertex,
            };
        }
        let mesh = compute(BLOCK, sample.value(), &[]).unwrap();
        let places = floats(&mesh, "texcoord1");
        for triangle in mesh.indices().chunks(3) {
            let us = [0, 1, 2].map(|i| places[triangle[i] as usize][0]);
            let most = us.iter().fold(f32::MIN, |a, b| a.max(*b));
            let least = us.iter().fold(f32::MAX, |a, b| a.min(*b));
            assert!(most - least < 1.01 / 24.0, "{us:?}");
        }
        // 19 vertices on the seam, one beside it whose triangle at the pole starts on the seam, and
        // one for each triangle at a pole but the first.
        let copies = mesh.vertex_count() as usize - sample.positions.len();
        assert_eq!(copies, 19 + 1 + 2 * 23);
    }

    #[test]
    fn repeats_multiply_and_the_centre_is_the_middle_of_the_bounds() {
        let sample = Sample {
            positions: vec![[11.0, 5.0, 3.0], [9.0, 5.0, 3.0], [10.0, 5.0, 4.0], [10.0, 5.0, 2.0]],
            triangles: vec![[0, 2, 1]],
            ..Sample::default()
        };
        let repeats = [("repeat x", ParamValue::Int(4)), ("repeat y", ParamValue::Int(10))];
        let mesh = compute(BLOCK, sample.value(), &repeats).unwrap();
        let places = floats(&mesh, "texcoord1");
        let expected = [[3.0, 5.0], [1.0, 5.0], [2.0, 5.0], [4.0, 5.0]];
        assert!(places.iter().zip(expected).all(|(a, b)| near(a, b)), "{places:?}");
        let centre = [
            ("automatic centre", ParamValue::Bool(false)),
            ("centre x", ParamValue::Float(10.0)),
            ("centre y", ParamValue::Float(5.0)),
            ("centre z", ParamValue::Float(3.0)),
        ];
        let mesh = compute(BLOCK, sample.value(), &centre).unwrap();
        assert!(near(&floats(&mesh, "texcoord1")[0], [0.75, 0.5]));
    }

    #[test]
    fn coordinates_are_the_same_on_any_number_of_threads() {
        let sample = Sample::ball(70, 90);
        let of = |threads| {
            Value::Mesh(compute_on(threads, BLOCK, sample.value(), &[]).unwrap()).content()
        };
        assert!([2, 3, 8].into_iter().all(|threads| of(threads) == of(1)));
    }

    #[test]
    fn fans_around_the_axis_cost_one_vertex_each() {
        let count = 30_000_u32;
        let mut positions = vec![[0.0, 1.0, 0.0]];
        positions.extend((0..count).map(|i| {
            let [x, _, z] = behind(f64::from(i) / f64::from(count));
            [x, 0.0, z]
        }));
        let triangles = (0..count).map(|i| [0, i + 1, (i + 1) % count + 1]).collect();
        let mesh = at_origin(&Sample { positions, triangles, ..Sample::default() });
        assert!((2 * count..2 * count + 3).contains(&mesh.vertex_count()));
    }
}
