//! What tests of hair share: points, meshes, and graphs that begin with them.

use std::sync::Arc;

use ptlib::{
    BlockId, ComputeOptions, Engine, Error, Graph, Image, Limits, Precision,
    value::{BufferPool, Mesh, Points, Stream, StreamShape, Value, Words},
};

use crate::testing;

fn stream(shape: StreamShape, numbers: &[f32]) -> Stream {
    let words: Vec<u32> = numbers.iter().map(|number| number.to_bits()).collect();
    Stream::packed(shape, Words::copy_of(&words).unwrap()).unwrap()
}

fn whole(number: usize) -> f32 {
    f32::from(u16::try_from(number).unwrap())
}

/// Points at x = 0, 1, … with all that hair has, and a stream that nobody knows.
pub fn points(ages: &[f32]) -> Value {
    let count = ages.len();
    let each = |numbers: &dyn Fn(f32) -> Vec<f32>| -> Vec<f32> {
        (0..count).flat_map(|i| numbers(whole(i))).collect()
    };
    let ids: Vec<u32> = (0..u32::try_from(count).unwrap()).flat_map(|i| [i, i % 7]).collect();
    let streams = vec![
        stream(StreamShape::floats("position", 3), &each(&|i| vec![i, 0.0, 0.0])),
        stream(StreamShape::floats("direction", 3), &each(&|_| vec![0.0, 0.0, 1.0])),
        stream(StreamShape::floats("texcoord", 2), &each(&|i| vec![i / 8.0, 0.5])),
        stream(StreamShape::floats("loss age", 1), ages),
        stream(StreamShape::floats("random", 1), &each(&|i| vec![i / 65_536.0])),
        Stream::packed(StreamShape::whole("id", 2), Words::copy_of(&ids).unwrap()).unwrap(),
        stream(StreamShape::floats("curl", 1), &each(&|i| vec![i * 3.0])),
    ];
    let count = u32::try_from(count).unwrap();
    Value::Points(Arc::new(Points::new(count, streams, &Limits::default()).unwrap()))
}

/// Points that all have one age of loss and one radius.
pub fn equal_points(count: u16, age: f32) -> Value {
    let positions: Vec<f32> = (0..count).flat_map(|i| [f32::from(i), 0.0, 0.0]).collect();
    let randoms: Vec<f32> = (0..count).map(|i| f32::from(i) / 65_536.0).collect();
    let streams = vec![
        stream(StreamShape::floats("position", 3), &positions),
        stream(StreamShape::floats("random", 1), &randoms),
        stream(StreamShape::floats("loss age", 1).constant(), &[age]),
        stream(StreamShape::floats("radius", 1).constant(), &[0.5]),
    ];
    let points = Points::new(u32::from(count), streams, &Limits::default()).unwrap();
    Value::Points(Arc::new(points))
}

/// Points that only have positions.
pub fn bare_points(count: u16) -> Value {
    let positions: Vec<f32> = (0..count).flat_map(|i| [f32::from(i), 0.0, 0.0]).collect();
    let streams = vec![stream(StreamShape::floats("position", 3), &positions)];
    let points = Points::new(u32::from(count), streams, &Limits::default()).unwrap();
    Value::Points(Arc::new(points))
}

/// A mesh of corners with texture coordinates.
pub fn mesh(corners: &[([f32; 3], [f32; 2])], triangles: &[[u32; 3]]) -> Value {
    let positions: Vec<f32> = corners.iter().flat_map(|(position, _)| *position).collect();
    let texcoords: Vec<f32> = corners.iter().flat_map(|(_, texcoord)| *texcoord).collect();
    let streams = vec![
        stream(StreamShape::floats("position", 3), &positions),
        stream(StreamShape::floats("texcoord", 2), &texcoords),
    ];
    mesh_of(corners.len(), streams, triangles)
}

fn mesh_of(count: usize, streams: Vec<Stream>, triangles: &[[u32; 3]]) -> Value {
    let indices = Words::copy_of(triangles.as_flattened()).unwrap();
    let count = u32::try_from(count).unwrap();
    Value::Mesh(Arc::new(Mesh::new(count, indices, streams, &Limits::default()).unwrap()))
}

/// A triangle without texture coordinates.
pub fn bare_mesh() -> Value {
    let corners = [0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0];
    mesh_of(3, vec![stream(StreamShape::floats("position", 3), &corners)], &[[0, 1, 2]])
}

/// A square of `side`² cells of two triangles each, bent into a bowl if it is `deep`, with normals.
pub fn field(side: u32, deep: f32) -> Value {
    let part =
        |i: u32| f32::from(u16::try_from(i).unwrap()) / f32::from(u16::try_from(side).unwrap());
    let mut positions = vec![];
    let (mut normals, mut texcoords) = (vec![], vec![]);
    for (y, x) in (0..=side).flat_map(|y| (0..=side).map(move |x| (y, x))) {
        let [u, v] = [part(x), part(y)];
        let [a, b] = [u - 0.5, v - 0.5];
        positions.extend([u, v, deep * (a * a + b * b)]);
        let normal = [-2.0 * deep * a, -2.0 * deep * b, 1.0];
        let length = normal.iter().map(|x| x * x).sum::<f32>().sqrt();
        normals.extend(normal.map(|x| x / length));
        texcoords.extend([u, v]);
    }
    let corner = |x: u32, y: u32| y * (side + 1) + x;
    let cell = |y: u32, x: u32| {
        [
            [corner(x, y), corner(x + 1, y), corner(x + 1, y + 1)],
            [corner(x, y), corner(x + 1, y + 1), corner(x, y + 1)],
        ]
    };
    let triangles: Vec<[u32; 3]> =
        (0..side).flat_map(|y| (0..side).flat_map(move |x| cell(y, x))).collect();
    let streams = vec![
        stream(StreamShape::floats("position", 3), &positions),
        stream(StreamShape::floats("normal", 3), &normals),
        stream(StreamShape::floats("texcoord", 2), &texcoords),
    ];
    mesh_of(positions.len() / 3, streams, &triangles)
}

/// The same mesh, with vertices of 8 numbers: position, texture coordinates, normal.
pub fn interleaved(mesh: &Value) -> Value {
    let Value::Mesh(mesh) = mesh else { panic!("a mesh") };
    let ids = [("position", 3, 0), ("texcoord", 2, 3), ("normal", 3, 5)];
    let count = mesh.vertex_count() as usize;
    let words: Vec<u32> = (0..count)
        .flat_map(|i| ids.map(|(id, ..)| mesh.stream(id).unwrap().words().at(i)).concat())
        .collect();
    let streams = ids.map(|(id, components, first)| {
        let words = Words::copy_of(&words[first..]).unwrap();
        Stream::new(StreamShape::floats(id, components), words, 32, count).unwrap()
    });
    let triangles: Vec<[u32; 3]> =
        mesh.indices().chunks_exact(3).map(|corners| corners.try_into().unwrap()).collect();
    mesh_of(count, streams.to_vec(), &triangles)
}

/// A grey image of a function of the pixel.
pub fn image(side: u32, level: impl Fn(u32, u32) -> f32) -> Value {
    let mut image = Image::new(&BufferPool::new(), side, side, 1).unwrap();
    for plane in image.planes_mut() {
        for (i, pixel) in (0..).zip(plane.iter_mut()) {
            *pixel = level(i % side, i / side);
        }
    }
    Value::Image(image)
}

/// The elements of a stream of points, or of strands.
pub fn floats(value: &Value, id: &str) -> Vec<Vec<f32>> {
    let Value::Points(points) = value else { panic!("gives a {}", value.kind().name()) };
    points.stream(id).unwrap().floats().all().map(<[f32]>::to_vec).collect()
}

/// The ids of points.
pub fn ids(value: &Value) -> Vec<[u32; 2]> {
    let Value::Points(points) = value else { panic!("gives a {}", value.kind().name()) };
    points.stream("id").unwrap().words().all().map(|id| id.try_into().unwrap()).collect()
}

/// A graph whose first block gives a value of the test.
pub struct Scene {
    pub engine: Engine,
    pub graph: Graph,
    pub source: BlockId,
}

impl Scene {
    fn of(engine: Engine, input: &str, value: Value) -> Self {
        let mut graph = engine.new_graph();
        graph.set_precision(Precision::Float);
        let source = graph.add(input).unwrap();
        graph.set_input(source, Some(value)).unwrap();
        Self { engine, graph, source }
    }

    pub fn of_points(points: Value) -> Self {
        Self::of(testing::engine(), "points input", points)
    }

    /// A mesh, and `scatter hair` behind it, where an image of ages lies.
    pub fn of_mesh(engine: Engine, mesh: Value, ages: Value) -> (Self, BlockId) {
        let mut scene = Self::of(engine, "mesh input", mesh);
        let scatter = scene.behind("aging.scatter hair", scene.source);
        scene.image(scatter, 1, ages);
        (scene, scatter)
    }

    /// Connects an image to an input.
    pub fn image(&mut self, block: BlockId, port: u32, image: Value) {
        let input = self.graph.add("image input").unwrap();
        self.graph.set_input(input, Some(image)).unwrap();
        self.graph.connect(input, 0, block, port).unwrap();
    }

    /// A block behind another.
    pub fn behind(&mut self, block: &str, source: BlockId) -> BlockId {
        let block = self.graph.add(block).unwrap();
        self.graph.connect(source, 0, block, 0).unwrap();
        block
    }

    pub fn value(&self, block: BlockId) -> Result<Value, Error> {
        self.value_on(block, 0)
    }

    pub fn value_on(&self, block: BlockId, threads: u32) -> Result<Value, Error> {
        self.sized(block, threads, 64)
    }

    /// On so many threads, with images of that size.
    pub fn sized(&self, block: BlockId, threads: u32, side: u32) -> Result<Value, Error> {
        let size = Some((side, side));
        let options = ComputeOptions { threads, size, ..ComputeOptions::default() };
        self.engine.compute_value(&self.graph, block, 0, options)
    }
}
