//! What tests of meshes share: samples, and blocks that take one mesh and give another.

use std::sync::Arc;

use ptlib::{
    ComputeOptions, Engine, EngineOptions, Error, Limits,
    params::ParamValue,
    value::{Mesh, Stream, StreamShape, Value, Words},
};
use ptlib_plugin::math::single;

use crate::testing::register;

/// A mesh, part by part; what is empty is left out.
#[derive(Debug, Clone)]
pub struct Sample {
    pub positions: Vec<[f32; 3]>,
    pub normals: Vec<[f32; 3]>,
    pub texcoords: Vec<[f32; 2]>,
    pub tangents: Vec<[f32; 4]>,
    pub others: Vec<Stream>,
    pub triangles: Vec<[u32; 3]>,
}

impl Default for Sample {
    /// One triangle, of whatever the first three vertices are.
    fn default() -> Self {
        Self {
            positions: vec![],
            normals: vec![],
            texcoords: vec![],
            tangents: vec![],
            others: vec![],
            triangles: vec![[0, 1, 2]],
        }
    }
}

impl Sample {
    /// A ball of radius 1 around the origin, with texture coordinates: rings of vertices from the
    /// bottom to the top, the first and the last of which are poles.
    pub fn ball(rings: u16, sides: u16) -> Self {
        let mut sample = Self { triangles: vec![], ..Self::default() };
        let ring = u32::from(sides) + 1;
        for i in 0..=rings {
            for j in 0..=sides {
                let [u, v] = [f64::from(j) / f64::from(sides), f64::from(i) / f64::from(rings)];
                let (sin, cos) = sin_cos((u - 0.5) * std::f64::consts::TAU);
                let (height, radius) = sin_cos((v - 0.5) * std::f64::consts::PI);
                sample.positions.push([sin * radius, height, cos * radius].map(single));
                sample.texcoords.push([u, v].map(single));
                if i < rings && j < sides {
                    let at = u32::from(i) * ring + u32::from(j);
                    if i > 0 {
                        sample.triangles.push([at, at + 1, at + ring + 1]);
                    }
                    if i + 1 < rings {
                        sample.triangles.push([at, at + ring + 1, at + ring]);
                    }
                }
            }
        }
        sample
    }

    /// The value of it.
    pub fn value(&self) -> Value {
        let mut streams = vec![float_stream("position", 3, self.positions.as_flattened())];
        for (id, components, numbers) in [
            ("normal", 3, self.normals.as_flattened()),
            ("texcoord", 2, self.texcoords.as_flattened()),
            ("tangent", 4, self.tangents.as_flattened()),
        ] {
            if !numbers.is_empty() {
                streams.push(float_stream(id, components, numbers));
            }
        }
        streams.extend(self.others.iter().cloned());
        let indices = Words::copy_of(self.triangles.as_flattened()).unwrap();
        let count = u32::try_from(self.positions.len()).unwrap();
        let mesh = Mesh::new(count, indices, streams, &Limits::default()).unwrap();
        Value::Mesh(Arc::new(mesh))
    }
}

/// Sine and cosine of an angle.
#[allow(clippy::disallowed_methods, reason = "no test asks for bits of what is made with it")]
pub fn sin_cos(angle: f64) -> (f64, f64) {
    angle.sin_cos()
}

/// A stream of floats; "radius" is one for all.
pub fn float_stream(id: &str, components: u32, numbers: &[f32]) -> Stream {
    let words: Vec<u32> = numbers.iter().map(|number| number.to_bits()).collect();
    let shape = StreamShape::floats(id, components);
    let shape = if id == "radius" { shape.constant() } else { shape };
    Stream::packed(shape, Words::copy_of(&words).unwrap()).unwrap()
}

/// A stream of whole numbers.
pub fn whole_stream(id: &str, components: u32, numbers: &[u32]) -> Stream {
    Stream::packed(StreamShape::whole(id, components), Words::copy_of(numbers).unwrap()).unwrap()
}

/// The elements of a stream.
pub fn floats(mesh: &Mesh, id: &str) -> Vec<Vec<f32>> {
    mesh.stream(id).unwrap().floats().all().map(<[f32]>::to_vec).collect()
}

/// What a block makes of a mesh.
pub fn compute(
    block: &str,
    mesh: Value,
    parameters: &[(&str, ParamValue)],
) -> Result<Arc<Mesh>, Error> {
    compute_on(0, block, mesh, parameters)
}

/// What a block makes of a mesh on so many threads.
pub fn compute_on(
    threads: u32,
    block: &str,
    mesh: Value,
    parameters: &[(&str, ParamValue)],
) -> Result<Arc<Mesh>, Error> {
    let engine = Engine::new(EngineOptions { threads, cache_bytes: 0, ..EngineOptions::default() });
    register(&engine);
    let mut graph = engine.new_graph();
    let input = graph.add("aging.mesh input").unwrap();
    graph.set_input(input, Some(mesh)).unwrap();
    let block = graph.add(block).unwrap();
    graph.connect(input, 0, block, 0).unwrap();
    for (name, value) in parameters {
        graph.set(block, name, value.clone()).unwrap();
    }
    match engine.compute_value(&graph, block, 0, ComputeOptions::default())? {
        Value::Mesh(mesh) => Ok(mesh),
        other => panic!("gives a {}", other.kind().name()),
    }
}
