//! What the tests of the view share: a head that is a sphere, wrinkles on its forehead, and hair.

use std::{f64::consts::PI, sync::Arc};

use ptlib::{
    BlockId, ComputeOptions, Engine, Error, Format, Graph, Image, Limits, Precision,
    params::ParamValue,
    value::{BufferPool, Mesh, StrandParts, Strands, Stream, StreamShape, Value, Words},
};
use ptlib_plugin::{math, noise};

/// A graph with a view of a head, and what its inputs are given.
pub struct Trial {
    pub engine: Engine,
    pub graph: Graph,
    pub view: BlockId,
    pub size: (u32, u32),
    pub threads: u32,
}

pub type Points = Vec<[f32; 3]>;

fn stream<const N: usize>(id: &str, numbers: &[[f32; N]]) -> Stream {
    let words: Vec<u32> = numbers.iter().flatten().map(|number| number.to_bits()).collect();
    let shape = StreamShape::floats(id, u32::try_from(N).unwrap());
    Stream::packed(shape, Words::copy_of(&words).unwrap()).unwrap()
}

impl Trial {
    /// A view of nothing yet.
    pub fn new(side: u32) -> Self {
        let engine = crate::testing::engine();
        let mut graph = engine.new_graph();
        graph.set_precision(Precision::Float);
        let view = graph.add("aging.head view").unwrap();
        Self { engine, graph, view, size: (side, side), threads: 1 }
    }

    /// A view of a sphere of about so many triangles.
    pub fn sphere(side: u32, triangles: u32) -> Self {
        let mut trial = Self::new(side);
        trial.give("mesh input", 0, sphere(triangles));
        trial
    }

    pub fn give(&mut self, input: &str, port: u32, value: Value) -> &mut Self {
        let input = self.graph.add(input).unwrap();
        self.graph.set_input(input, Some(value)).unwrap();
        self.graph.connect(input, 0, self.view, port).unwrap();
        self
    }

    pub fn float(&mut self, id: &str, value: f64) -> &mut Self {
        self.graph.set(self.view, id, ParamValue::Float(value)).unwrap();
        self
    }

    pub fn int(&mut self, id: &str, value: i32) -> &mut Self {
        self.graph.set(self.view, id, ParamValue::Int(value)).unwrap();
        self
    }

    pub fn choice(&mut self, id: &str, value: u32) -> &mut Self {
        self.graph.set(self.view, id, ParamValue::Choice(value)).unwrap();
        self
    }

    pub fn try_image(&self) -> Result<Image, Error> {
        let options =
            ComputeOptions { size: Some(self.size), threads: self.threads, ..Default::default() };
        self.engine.compute(&self.graph, self.view, 0, options)
    }

    pub fn image(&self) -> Image {
        self.try_image().unwrap()
    }

    /// The bits of a picture.
    pub fn bits(&self) -> Vec<u32> {
        let image = self.image();
        (0..4).flat_map(|c| image.channel(c).to_vec()).map(f32::to_bits).collect()
    }
}

/// A mesh with the streams that are given.
pub fn mesh(indices: &[u32], streams: Vec<Stream>, count: usize) -> Value {
    let count = u32::try_from(count).unwrap();
    let indices = Words::copy_of(indices).unwrap();
    let mesh = Mesh::new(count, indices, streams, &Limits::default()).unwrap();
    Value::Mesh(Arc::new(mesh))
}

pub fn bare_mesh(positions: &[[f32; 3]], indices: &[u32]) -> Value {
    mesh(indices, vec![stream("position", positions)], positions.len())
}

pub fn normal_mesh(positions: &[[f32; 3]], indices: &[u32]) -> Value {
    let normals = vec![[0.0, 0.0, 1.0]; positions.len()];
    let streams = vec![stream("position", positions), stream("normal", &normals)];
    mesh(indices, streams, positions.len())
}

pub fn plain_mesh(positions: &[[f32; 3]], indices: &[u32]) -> Value {
    let normals = vec![[0.0, 0.0, 1.0]; positions.len()];
    let uv: Vec<_> = positions.iter().map(|[x, y, _]| [*x, *y]).collect();
    let tangents = vec![[1.0, 0.0, 0.0, 1.0]; positions.len()];
    let streams = vec![
        stream("position", positions),
        stream("normal", &normals),
        stream("texcoord", &uv),
        stream("tangent", &tangents),
    ];
    mesh(indices, streams, positions.len())
}

/// A sphere of radius 1 with texture coordinates by longitude and latitude.
pub fn sphere(triangles: u32) -> Value {
    let _host = crate::testing::engine();
    let down = (1..).find(|n| 4 * n * n >= triangles).unwrap();
    let across = 2 * down;
    let (mut positions, mut uv, mut tangents) = (vec![], vec![], vec![]);
    for row in 0..=down {
        for column in 0..=across {
            let [u, v] = [f64::from(column) / f64::from(across), f64::from(row) / f64::from(down)];
            let (yaw, pitch) = ((u - 0.5) * 2.0 * PI, (v - 0.5) * PI);
            let flat = math::cos(pitch);
            let place = [math::sin(yaw) * flat, math::sin(pitch), math::cos(yaw) * flat];
            positions.push(place.map(math::single));
            uv.push([u, v].map(math::single));
            tangents.push([math::cos(yaw), 0.0, -math::sin(yaw), 1.0].map(math::single));
        }
    }
    let mut indices = vec![];
    for row in 0..down {
        for column in 0..across {
            let at = row * (across + 1) + column;
            let above = at + across + 1;
            indices.extend([at, at + 1, above + 1, at, above + 1, above]);
        }
    }
    let streams = vec![
        stream("position", &positions),
        stream("normal", &positions),
        stream("texcoord", &uv),
        stream("tangent", &tangents),
    ];
    mesh(&indices, streams, positions.len())
}

/// A picture of floats.
pub fn picture(side: u32, pixel: impl Fn(f64, f64) -> [f32; 4]) -> Value {
    let mut bytes = vec![];
    for y in 0..side {
        for x in 0..side {
            let [u, v] = [x, y].map(|place| (f64::from(place) + 0.5) / f64::from(side));
            bytes.extend(pixel(u, 1.0 - v).iter().flat_map(|number| number.to_ne_bytes()));
        }
    }
    let pixels = (&bytes[..], side as usize * 16);
    let pool = BufferPool::new();
    Image::from_pixels(&pool, (side, side), Format::RgbaF32, pixels).unwrap().into()
}

/// The height of wrinkles across a forehead.
pub fn forehead(u: f64, v: f64) -> f64 {
    let bell = |x: f64| (1.0 - x * x).max(0.0);
    let wave = 0.008 * math::sin(u * 40.0) + 0.25 * (u - 0.5) * (u - 0.5);
    let along = (v + wave - 0.60) / 0.16;
    if !(0.0..1.0).contains(&along) {
        return 0.0;
    }
    let strength = bell((u - 0.5) / 0.16) * bell(2.0 * along - 1.0).sqrt();
    strength * math::sin(PI * 5.0 * along).abs()
}

/// Normals of heights, packed as `height to normal` does it.
pub fn normals(side: u32, depth: f64, height: impl Fn(f64, f64) -> f64) -> Value {
    let step = 1.0 / f64::from(side);
    picture(side, |u, v| {
        let slope = |a: f64, b: f64| depth * (a - b) / (2.0 * step);
        let x = -slope(height(u + step, v), height(u - step, v));
        let y = -slope(height(u, v + step), height(u, v - step));
        let length = (x * x + y * y + 1.0).sqrt();
        let packed = [x / length / 2.0 + 0.5, y / length / 2.0 + 0.5, 1.0 / length, height(u, v)];
        packed.map(math::single)
    })
}

/// Strands, each of as many points.
pub fn strands(points: &[Points], colors: Option<&[[f32; 3]]>) -> Value {
    let all: Points = points.iter().flatten().copied().collect();
    let mut first = vec![0];
    for strand in points {
        first.push(first[first.len() - 1] + u32::try_from(strand.len()).unwrap());
    }
    let parts = StrandParts {
        point_count: u32::try_from(all.len()).unwrap(),
        first_point: Words::copy_of(&first).unwrap(),
        point_streams: vec![stream("position", &all)],
        strand_streams: colors.map(|colors| stream("color", colors)).into_iter().collect(),
    };
    Value::Strands(Arc::new(Strands::new(parts, &Limits::default()).unwrap()))
}

/// Hair on the upper and back part of the sphere.
pub fn hair(count: u32, segments: u32, length: f64, droop: f64) -> Value {
    let _host = crate::testing::engine();
    let strand = |i: u32| -> Option<Points> {
        let [a, b, c, d] = [0, 1, 2, 3].map(|part| f64::from(noise::uniform(7, i, part, 0)));
        let (y, yaw) = (1.0 - 1.3 * a, 2.0 * PI * b);
        let flat = (1.0 - y * y).max(0.0).sqrt();
        let root = [math::sin(yaw) * flat, y, math::cos(yaw) * flat];
        if root[2] > 0.0 && root[1] < 0.62 + 0.25 * root[0].abs() {
            return None;
        }
        let spread = [c - 0.5, 0.3 * (d - 0.5), c * d - 0.25].map(|x| 0.5 * x);
        let point = |m: u32| {
            let t = f64::from(m) / f64::from(segments);
            let fall = droop * length * t * t;
            let at = [0, 1, 2].map(|i: usize| root[i] + length * t * (root[i] + spread[i]));
            [at[0], at[1] - fall, at[2]].map(math::single)
        };
        Some((0..=segments).map(point).collect())
    };
    let points: Vec<Points> = (0..count).filter_map(strand).collect();
    strands(&points, None)
}
