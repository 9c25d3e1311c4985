//! Every block of the registry in a graph of its own, for tests that walk the registry.

use ptlib::{
    BlockId, Engine, EngineOptions, Graph, Limits, Precision,
    block::{BlockSpec, Role},
    params::{FileUse, ParamKind, ParamValue},
    value::{Draft, Kind, StreamPlan, StreamShape, Value, WordsPlan},
};

use crate::picture::folder;

/// A block with something at each of its inputs.
pub struct Specimen {
    pub graph: Graph,
    pub block: BlockId,
}

/// An engine without a cache, so that everything is computed.
pub fn engine() -> Engine {
    Engine::new(EngineOptions { threads: 8, cache_bytes: 0, ..EngineOptions::default() })
}

impl Specimen {
    /// The block type in a graph of `width` × `height` pixels. The first image input gets a colour
    /// picture, the second a grey one, and so on in turn; all of them tile.
    pub fn new(engine: &Engine, spec: &'static BlockSpec, width: u32, height: u32) -> Self {
        let mut graph = engine.new_graph();
        graph.set_size(width, height).expect("sizes of tests are not empty");
        graph.set_folder(Some(folder("conformance")));
        let block = graph.add(spec.about.id).expect("the type comes from the registry");
        for (param, kind) in spec.params.iter().map(|param| (param.id, param.kind)) {
            if let ParamKind::Path(FileUse::Read) = kind {
                let gives_text = spec.about.outputs[0].kind == Kind::Text;
                let path = if gives_text { "in/tree.txt" } else { "in/colour.png" };
                let path = ParamValue::Text(path.into());
                graph.set(block, param, path).expect("a path takes any text");
            }
        }
        if spec.about.role == Role::Input
            && let Some(value) = value_of(spec.about.outputs[0].kind)
        {
            graph.set_input(block, Some(value)).expect("a value of its kind");
        }
        for (port, input) in (0..).zip(spec.about.inputs) {
            let source = match input.kind {
                Kind::Image if port % 2 == 0 => colour(&mut graph, u64::from(port)),
                Kind::Image => grey(&mut graph, u64::from(port)),
                Kind::Gradient => gradient(&mut graph),
                // A text would replace what the block makes by itself.
                Kind::Text if input.is_optional => continue,
                Kind::Text => text(&mut graph),
                kind => given(&mut graph, kind),
            };
            graph.connect(source, 0, block, port).expect("the kinds agree");
        }
        Self { graph, block }
    }

    /// The specimen with its input images moved: the lattices of the noises in them meet at the
    /// edges, and there alone all of them have a crease at the same place.
    pub fn with_moved_inputs(mut self) -> Self {
        let inputs = self.graph.block(self.block).expect("added above").inputs().to_vec();
        for (port, source) in (0..).zip(inputs) {
            let Some(source) = source else { continue };
            let move_it = self.graph.add("geometric transform").expect("built in");
            if self.graph.connect(source.block, source.output, move_it, 0).is_err() {
                self.graph.remove(move_it).expect("just added");
                continue;
            }
            for (param, share) in [("shift x", 0.37), ("shift y", 0.23)] {
                let share = ParamValue::Float(share);
                self.graph.set(move_it, param, share).expect("the block has it");
            }
            self.graph.connect(move_it, 0, self.block, port).expect("images");
        }
        self
    }

    /// The specimen in that precision.
    pub fn precision(mut self, precision: Precision) -> Self {
        self.graph.set_precision(precision);
        self
    }
}

/// The inputs without which the block works: not the default of an input of the graph, whose value
/// nobody sets here.
pub fn dispensable_inputs(spec: &BlockSpec) -> Vec<u32> {
    let inputs = (0..).zip(spec.about.inputs).filter(|(_, input)| input.is_optional);
    inputs.filter(|_| spec.about.role != Role::Input).map(|(port, _)| port).collect()
}

fn grey(graph: &mut Graph, seed: u64) -> BlockId {
    let noise = graph.add("perlin noise").expect("built in");
    graph.set_block_seed(noise, Some(seed)).expect("just added");
    noise
}

fn gradient(graph: &mut Graph) -> BlockId {
    let gradient = graph.add("color transition").expect("built in");
    let stops = "0 10 0 60;90 200 40 20;160 240 200 60;255 250 255 255";
    graph.set_text(gradient, "data", stops).expect("a text");
    gradient
}

/// An input of the graph with a value of that kind.
fn given(graph: &mut Graph, kind: Kind) -> BlockId {
    let input = graph.add(&format!("{} input", kind.name())).expect("built in");
    let value = value_of(kind).unwrap_or_else(|| panic!("no specimen of kind {}", kind.name()));
    graph.set_input(input, Some(value)).expect("a value of its kind");
    input
}

/// Something of a kind that no block makes out of nothing.
fn value_of(kind: Kind) -> Option<Value> {
    let limits = Limits::default();
    let streams = || {
        vec![
            StreamPlan::New(StreamShape::floats("position", 3)),
            StreamPlan::New(StreamShape::floats("texcoord", 2)),
        ]
    };
    let draft = match kind {
        Kind::Text => return Some(Value::from("D(0.1)R(60)D(0.2)".to_owned())),
        Kind::Points => Draft::points(4, streams(), &limits),
        Kind::Mesh => Draft::mesh(4, WordsPlan::New(6), streams(), &limits),
        Kind::Strands => Draft::strands(4, WordsPlan::New(2), streams(), vec![], &limits),
        _ => return None,
    };
    let mut draft = draft.expect("within the limits");
    if let Some(numbers) = draft.numbers_mut() {
        let square = [0, 1, 2, 2, 1, 3];
        let strand = [0, 4];
        numbers.copy_from_slice(if kind == Kind::Mesh { &square } else { &strand });
    }
    let corners = [[0.0_f32, 0.0], [1.0, 0.0], [0.0, 1.0], [1.0, 1.0]];
    for (place, components) in [(0, 3), (1, 2)] {
        let numbers = draft.stream_mut(place).expect("new").chunks_exact_mut(components);
        for (element, corner) in numbers.zip(corners) {
            (element[0], element[1]) = (corner[0].to_bits(), corner[1].to_bits());
        }
    }
    Some(draft.finish(&limits).expect("a right value"))
}

fn text(graph: &mut Graph) -> BlockId {
    let text = graph.add("l-system").expect("built in");
    graph.set_text(text, "path", "in/tree.txt").expect("a path takes any text");
    text
}

fn colour(graph: &mut Graph, seed: u64) -> BlockId {
    let (noise, gradient) = (grey(graph, seed), gradient(graph));
    let map = graph.add("map transition").expect("built in");
    graph.connect(noise, 0, map, 0).expect("images");
    graph.connect(gradient, 0, map, 1).expect("gradients");
    map
}
