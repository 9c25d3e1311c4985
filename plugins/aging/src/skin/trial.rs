//! What tests of the image blocks share: pictures from formulas, and one block computed on them.

use ptlib::{
    BlockId, ComputeOptions, Engine, Error, Graph, Image,
    params::ParamValue,
    value::{BufferPool, Value},
};

use crate::testing;

/// A picture whose numbers come from plane, column and row.
pub fn picture(
    (width, height): (u32, u32),
    planes: usize,
    value: impl Fn(usize, u32, u32) -> f32,
) -> Image {
    let mut image = Image::new(&BufferPool::new(), width, height, planes).unwrap();
    for (plane, numbers) in image.planes_mut().enumerate() {
        let places = (0..height).flat_map(|y| (0..width).map(move |x| (x, y)));
        for (number, (x, y)) in numbers.iter_mut().zip(places) {
            *number = value(plane, x, y);
        }
    }
    image
}

/// A picture of one colour or tone.
pub fn plain(size: (u32, u32), colour: &[f32]) -> Image {
    picture(size, colour.len(), |plane, _, _| colour[plane])
}

/// Noise of a place, 0..1.
pub fn grain(x: u32, y: u32) -> f32 {
    let mixed = x.wrapping_mul(0x9e37_79b1) ^ y.wrapping_mul(0x85eb_ca77);
    ((mixed ^ (mixed >> 15)).wrapping_mul(0x2c1b_3c6d) >> 16) as f32 / 65_535.0
}

/// A smooth wave of period 1, 0..1.
pub fn wave(place: f32) -> f32 {
    let t = place.fract();
    16.0 * t * t * (1.0 - t) * (1.0 - t)
}

/// A graph with one block, and pictures at its inputs.
pub fn graph(
    engine: &Engine,
    block: &str,
    inputs: &[Option<&Image>],
    params: &[(&str, ParamValue)],
) -> (Graph, BlockId) {
    let mut graph = engine.new_graph();
    let block = graph.add(block).unwrap();
    for (slot, image) in (0..).zip(inputs) {
        if let Some(image) = image {
            let input = graph.add("image input").unwrap();
            graph.set_input(input, Some(Value::Image((*image).clone()))).unwrap();
            graph.connect(input, 0, block, slot).unwrap();
        }
    }
    for (id, value) in params {
        graph.set(block, id, value.clone()).unwrap();
    }
    (graph, block)
}

/// What a block makes of pictures, at the size of the first.
pub fn tried(
    block: &str,
    inputs: &[Option<&Image>],
    params: &[(&str, ParamValue)],
    options: ComputeOptions<'_>,
) -> Result<Image, Error> {
    let engine = testing::engine();
    let (graph, block) = graph(&engine, block, inputs, params);
    let size = inputs[0].map(|image| (image.width(), image.height()));
    engine.compute(&graph, block, 0, ComputeOptions { size, ..options })
}

/// The same, with usual options and no error.
pub fn made(block: &str, inputs: &[Option<&Image>], params: &[(&str, ParamValue)]) -> Image {
    tried(block, inputs, params, ComputeOptions::default()).unwrap()
}

/// The bits of all planes.
pub fn bits(image: &Image) -> Vec<u32> {
    (0..image.planes()).flat_map(|c| image.channel(c)).map(|sample| sample.to_bits()).collect()
}

/// Fails unless threads and strips leave the bits as they are, and unless all numbers are in 0..1.
pub fn same_on_all_threads(block: &str, inputs: &[Option<&Image>], params: &[(&str, ParamValue)]) {
    let on = |threads, strip_rows| {
        let options = ComputeOptions { threads, strip_rows, ..Default::default() };
        tried(block, inputs, params, options).unwrap()
    };
    let first = on(1, 0);
    for channel in 0..first.planes() {
        assert!(first.channel(channel).iter().all(|value| (0.0..=1.0).contains(value)), "{block}");
    }
    for (threads, strip_rows) in [(1, 1), (2, 0), (2, 3), (3, 7), (8, 1), (8, 0)] {
        assert!(bits(&first) == bits(&on(threads, strip_rows)), "{block}: {threads}, {strip_rows}");
    }
}

/// The greatest difference between neighbours: across the edges, and inside.
pub fn steps(image: &Image) -> [f32; 2] {
    let (width, height) = (image.width(), image.height());
    let mut steps = [0.0_f32; 2];
    for channel in 0..image.planes() {
        let at = |x: u32, y: u32| image.row(channel, y % height)[(x % width) as usize];
        for y in 0..height {
            for x in 0..width {
                let [down, right] = [usize::from(y + 1 < height), usize::from(x + 1 < width)];
                steps[down] = steps[down].max((at(x, y + 1) - at(x, y)).abs());
                steps[right] = steps[right].max((at(x + 1, y) - at(x, y)).abs());
            }
        }
    }
    steps
}

/// Sizes that are small, thin, and prime.
pub const SIZES: [(u32, u32); 7] = [(1, 1), (1, 7), (13, 1), (2, 2), (2, 3), (31, 17), (67, 61)];
