//! Values that no block makes out of nothing: graphs are given them.

use ptlib::{
    Graph, Image, Limits, Precision,
    params::ParamValue,
    value::{Draft, Kind, StreamPlan, StreamShape, Value, WordsPlan},
};

use crate::{
    Result, card,
    work::{self, Settings, Work},
};

/// A grey test card of that size.
pub(crate) fn card(size: (u32, u32)) -> Result<Image> {
    let mut graph = work::engine(1, 0).new_graph();
    let block = graph.add(card::ID)?;
    graph.set(block, "colour", ParamValue::Bool(false))?;
    let (precision, supersampling) = (Precision::Float, Some(1));
    let settings = Settings { block, size, threads: 1, precision, supersampling };
    Work::new(graph, settings)?.compute()
}

/// Gives a picture to the graph's input of pictures.
pub(crate) fn give(graph: &mut Graph, picture: Image) -> Result {
    let input = graph.blocks().find(|(_, block)| block.type_id() == "image input");
    let input = input.map(|(id, _)| id).ok_or("the graph has no image input")?;
    Ok(graph.set_input(input, Some(Value::Image(picture)))?)
}

/// The picture that was given to the graph, if one was.
pub(crate) fn picture(graph: &Graph) -> Option<&Image> {
    graph.blocks().find_map(|(id, _)| match graph.input_value(id) {
        Some(Value::Image(image)) => Some(image),
        _ => None,
    })
}

/// A square of two triangles, its corners, or the line through them: the smallest value of a kind
/// that blocks take as it is.
pub(crate) fn shape(kind: Kind) -> Result<Value> {
    let limits = Limits::default();
    let streams = vec![StreamPlan::New(StreamShape::floats("position", 3))];
    let mut draft = match kind {
        Kind::Points => Draft::points(4, streams, &limits)?,
        Kind::Mesh => Draft::mesh(4, WordsPlan::New(6), streams, &limits)?,
        Kind::Strands => Draft::strands(4, WordsPlan::New(2), streams, vec![], &limits)?,
        _ => return Err(format!("there is no shape of kind {}", kind.name()).into()),
    };
    if let Some(numbers) = draft.numbers_mut() {
        let (triangles, strand) = ([0, 1, 2, 2, 1, 3], [0, 4]);
        numbers.copy_from_slice(if kind == Kind::Mesh { &triangles } else { &strand });
    }
    let corners = [[0.0_f32, 0.0], [1.0, 0.0], [0.0, 1.0], [1.0, 1.0]];
    let positions = draft.stream_mut(0).ok_or("a new stream can be written")?;
    for (position, [x, y]) in positions.chunks_exact_mut(3).zip(corners) {
        position.copy_from_slice(&[x.to_bits(), y.to_bits(), 0]);
    }
    Ok(draft.finish(&limits)?)
}
