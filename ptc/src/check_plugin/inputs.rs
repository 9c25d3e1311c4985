//! What blocks are given to work on: small values of each kind that can be made up.

use std::sync::Arc;

use ptlib::{
    BlockId, Error, Graph,
    limits::Limits,
    value::{
        Gradient, GradientStop, Kind, Mesh, Points, StrandParts, Strands, Stream, StreamShape,
        Value, Words,
    },
};

/// Vertices along a side of the mesh.
const SIDE: u16 = 9;

/// Strands, and the points of each.
const STRANDS: u16 = 12;
const POINTS: u16 = 4;

/// The output 0 of a block that gives something of that kind; another `number` gives something
/// else. `None` for texts: nobody knows the grammar that a block expects.
pub(super) fn source(graph: &mut Graph, kind: Kind, number: u32) -> Result<Option<BlockId>, Error> {
    let id = match kind {
        Kind::Image => return image(graph, number).map(Some),
        Kind::Gradient => "gradient input",
        Kind::Mesh => "mesh input",
        Kind::Points => "points input",
        Kind::Strands => "strands input",
        _ => return Ok(None),
    };
    let block = graph.add(id)?;
    graph.set_input(block, made(kind)?)?;
    Ok(Some(block))
}

fn image(graph: &mut Graph, number: u32) -> Result<BlockId, Error> {
    let noise = graph.add("perlin noise")?;
    graph.set_block_seed(noise, Some(u64::from(number) + 1))?;
    if number.is_multiple_of(2) {
        return Ok(noise);
    }
    let coloured = graph.add("adjust rgb")?;
    graph.connect(noise, 0, coloured, 0)?;
    Ok(coloured)
}

/// A value of a kind that needs no engine to be made.
pub(super) fn made(kind: Kind) -> Result<Option<Value>, Error> {
    Ok(Some(match kind {
        Kind::Text => Value::Text("some words".into()),
        Kind::Gradient => {
            let stop = |position: f32| GradientStop { position, color: [position, 0.5, 0.25] };
            Value::Gradient(Arc::new(Gradient::new(vec![stop(0.25), stop(0.75)])))
        }
        Kind::Mesh => Value::Mesh(Arc::new(mesh()?)),
        Kind::Points => Value::Points(Arc::new(points()?)),
        Kind::Strands => Value::Strands(Arc::new(strands()?)),
        _ => return Ok(None),
    }))
}

/// A sheet with a hill, and all that vertices may have.
fn mesh() -> Result<Mesh, Error> {
    let places: Vec<[f32; 2]> =
        (0..SIDE).flat_map(|y| (0..SIDE).map(move |x| [part(x, SIDE), part(y, SIDE)])).collect();
    let hill = |[x, y]: &[f32; 2]| [*x, *y, x * (1.0 - x) * y * (1.0 - y)];
    let streams = vec![
        floats("position", 3, places.iter().flat_map(hill))?,
        floats("normal", 3, places.iter().flat_map(|_| [0.0, 0.0, 1.0]))?,
        floats("tangent", 4, places.iter().flat_map(|_| [1.0, 0.0, 0.0, 1.0]))?,
        floats("texcoord", 2, places.as_flattened().iter().copied())?,
        floats("texcoord1", 2, places.as_flattened().iter().copied())?,
    ];
    let side = u32::from(SIDE);
    let cell = |x: u32, y: u32| {
        let corner = y * side + x;
        let [right, up] = [corner + 1, corner + side];
        [corner, right, up, up, right, up + 1]
    };
    let indices: Vec<u32> =
        (0..side - 1).flat_map(|y| (0..side - 1).flat_map(move |x| cell(x, y))).collect();
    Mesh::new(side * side, Words::copy_of(&indices)?, streams, &Limits::default())
}

/// Points on a line, each with a direction and what hairs have.
fn points() -> Result<Points, Error> {
    let count = STRANDS;
    let parts = || (0..count).map(move |number| part(number, count));
    let ids: Vec<u32> = (0..u32::from(count)).flat_map(|number| [number, 0]).collect();
    let streams = vec![
        floats("position", 3, parts().flat_map(|part| [part, part * part, 0.0]))?,
        floats("direction", 3, parts().flat_map(|_| [0.0, 0.0, 1.0]))?,
        floats("texcoord", 2, parts().flat_map(|part| [part, 1.0 - part]))?,
        floats("loss age", 1, parts().map(|part| 1.0 - part))?,
        floats("random", 1, parts())?,
        Stream::new(StreamShape::whole("id", 2), Words::copy_of(&ids)?, 8, usize::from(count))?,
    ];
    Points::new(count.into(), streams, &Limits::default())
}

/// Curved strands beside each other.
fn strands() -> Result<Strands, Error> {
    let positions = (0..STRANDS).flat_map(|strand| {
        (0..POINTS).flat_map(move |point| {
            let height = part(point, POINTS);
            [part(strand, STRANDS), height, height * height]
        })
    });
    let ages = (0..STRANDS).map(|strand| 1.0 - part(strand, STRANDS));
    let first: Vec<u32> = (0..=u32::from(STRANDS)).map(|i| i * u32::from(POINTS)).collect();
    let parts = StrandParts {
        point_count: u32::from(STRANDS) * u32::from(POINTS),
        first_point: Words::copy_of(&first)?,
        point_streams: vec![floats("position", 3, positions)?],
        strand_streams: vec![floats("loss age", 1, ages)?],
    };
    Strands::new(parts, &Limits::default())
}

/// Which part of the way from the first to the last of `count` a number is.
fn part(number: u16, count: u16) -> f32 {
    f32::from(number) / f32::from(count - 1)
}

fn floats(id: &str, components: u32, all: impl Iterator<Item = f32>) -> Result<Stream, Error> {
    let words: Vec<u32> = all.map(f32::to_bits).collect();
    let width = components as usize;
    let elements = words.len() / width;
    Stream::new(StreamShape::floats(id, components), Words::copy_of(&words)?, 4 * width, elements)
}
