//! The blocks that a computation needs, resolved: what each reads, gives and depends on.

use std::collections::BTreeMap;

use super::key::Key;
use crate::{
    block::{Access, Files, Implementation, Planes, RowFactory, WholeFactory},
    error::{Error, ErrorKind},
    graph::{Block, BlockId, Given, Graph},
    math::levels::Precision,
    params::{FileUse, ParamKind, ParamValue},
    value::{Kind, Value},
};

/// One block to compute.
#[derive(Debug)]
pub(super) struct Node<'g> {
    pub(super) id: BlockId,
    pub(super) block: &'g Block,
    pub(super) work: Work,
    /// What the caller set for an input of the graph.
    pub(super) given: Option<&'g Given>,
    pub(super) seed: u64,
    /// What each input is connected to; a connection of the wrong kind counts as none.
    pub(super) inputs: Vec<Option<Link>>,
    pub(super) outputs: Vec<Output>,
    pub(super) key: Key,
    /// The number of planes of the first input, for the memory that the block asks for.
    first_planes: usize,
    pub(super) is_needed: bool,
    /// Whether its outputs exist as whole values.
    pub(super) is_stored: bool,
}

/// An output of another node.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Link {
    pub(super) node: usize,
    pub(super) output: usize,
}

/// What an output is.
#[derive(Debug, Clone, Copy)]
pub(super) struct Output {
    pub(super) kind: Kind,
    /// The number of planes of an image, 0 for other kinds.
    pub(super) planes: usize,
    pub(super) is_free: bool,
}

/// How a node gets its values.
pub(super) enum Work {
    /// Row by row.
    Rows(&'static dyn RowFactory),
    /// In one call.
    Whole(&'static dyn WholeFactory),
    /// It cannot: a white image stands for it, because the caller wants to go on.
    White,
    /// The cache had them.
    Kept(Vec<Value>),
}

impl std::fmt::Debug for Work {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(match self {
            Self::Rows(_) => "Rows",
            Self::Whole(_) => "Whole",
            Self::White => "White",
            Self::Kept(_) => "Kept",
        })
    }
}

impl Node<'_> {
    /// How the node reads its input `port`.
    pub(super) fn access(&self, port: usize) -> Access {
        match (&self.work, self.block.spec()) {
            (Work::Rows(_), Some(spec)) => spec.access(port),
            _ => Access::Anywhere,
        }
    }

    /// Whether the cache shall keep the output: it is dear to compute and few values. What only
    /// changes the values of another image is cheaper to compute again than to store.
    pub(super) fn is_worth_keeping(&self) -> bool {
        let is_generator = self.inputs.iter().all(Option::is_none);
        matches!(self.work, Work::Rows(_)) && (is_generator || self.reads_anywhere())
    }

    /// Whether a row of it needs more than the same row of its inputs.
    pub(super) fn reads_anywhere(&self) -> bool {
        (0..self.inputs.len()).any(|port| self.access(port) == Access::Anywhere)
    }

    /// The place of an output's first plane among the planes of all outputs.
    pub(super) fn first_plane(&self, output: usize) -> usize {
        self.outputs[..output].iter().map(|output| output.planes).sum()
    }

    /// The memory that the block takes besides its outputs.
    pub(super) fn scratch_bytes(&self, (width, height): (u32, u32)) -> Result<u64, Error> {
        let implementation = match self.work {
            Work::Rows(factory) => Implementation::Rows(factory),
            Work::Whole(factory) => Implementation::Whole(factory),
            Work::White | Work::Kept(_) => return Ok(0),
        };
        implementation.scratch_bytes(self.block.values(), width, height, self.first_planes)
    }

    /// `error`, with the place of the block added.
    pub(super) fn at(&self, error: Error) -> Error {
        error.at_block(self.block.id(), self.block.type_id(), self.id.to_raw())
    }
}

/// What nodes are made for.
pub(super) struct Purpose<'a> {
    /// Width and height of the images that blocks make.
    pub(super) working: (u32, u32),
    /// The seed of blocks that have none of their own.
    pub(super) seed: u64,
    pub(super) precision: Precision,
    /// Whether a block that cannot be computed becomes a white image.
    pub(super) keep_going: bool,
    pub(super) files: &'a dyn Files,
}

/// All blocks that `wanted` need, in topological order, and what is wrong with those that became
/// white images.
pub(super) fn resolve<'g>(
    graph: &'g Graph,
    wanted: &[BlockId],
    purpose: &Purpose<'_>,
) -> Result<(Vec<Node<'g>>, Vec<Error>), Error> {
    let order = topological_order(graph, wanted)?;
    let places: BTreeMap<BlockId, usize> = order.iter().copied().zip(0..).collect();
    let mut nodes: Vec<Node<'g>> = Vec::with_capacity(order.len());
    let mut failures = Vec::new();
    for id in order {
        let node = resolve_one(graph, id, &nodes, &places, purpose, &mut failures)?;
        nodes.push(node);
    }
    if !purpose.keep_going
        && let Some(error) = Error::from_faults(std::mem::take(&mut failures))
    {
        return Err(error);
    }
    Ok((nodes, failures))
}

fn resolve_one<'g>(
    graph: &'g Graph,
    id: BlockId,
    nodes: &[Node<'g>],
    places: &BTreeMap<BlockId, usize>,
    purpose: &Purpose<'_>,
    failures: &mut Vec<Error>,
) -> Result<Node<'g>, Error> {
    let block = graph.block(id)?;
    let mut faults = graph.faults_of(id);
    let mut node = Node {
        id,
        block,
        work: Work::White,
        given: graph.given(id),
        seed: block.seed().unwrap_or(purpose.seed),
        inputs: match graph.given(id) {
            Some(_) => vec![None; block.inputs().len()],
            None => links(block, nodes, places),
        },
        outputs: vec![Output { kind: Kind::Image, planes: 1, is_free: false }],
        key: Key::of_failure(id.to_raw()),
        first_planes: 1,
        is_needed: false,
        is_stored: false,
    };
    if let Some(spec) = block.spec() {
        let planes: Vec<usize> = node
            .inputs
            .iter()
            .map(|link| link.map_or(0, |link| nodes[link.node].outputs[link.output].planes))
            .collect();
        node.first_planes = planes.first().copied().unwrap_or(0).max(1);
        let is_grey = spec.implementation.is_grey(block.values()).map_err(|e| node.at(e))?;
        node.outputs = spec
            .about
            .outputs
            .iter()
            .map(|port| Output {
                kind: port.kind,
                planes: match port.kind {
                    Kind::Image => match node.given.map(|given| &given.value) {
                        Some(Value::Image(image)) => image.planes(),
                        _ => count_planes(port.planes, &planes, is_grey),
                    },
                    _ => 0,
                },
                is_free: port.is_free,
            })
            .collect();
        match key(&node, spec, nodes, purpose) {
            Ok(key) => node.key = key,
            Err(error) => faults.push(node.at(error)),
        }
        if faults.is_empty() {
            node.work = match spec.implementation {
                Implementation::Rows(factory) => Work::Rows(factory),
                Implementation::Whole(factory) => Work::Whole(factory),
            };
        }
    }
    if !faults.is_empty() {
        failures.append(&mut faults);
        node.inputs.clear();
        node.key = Key::of_failure(id.to_raw());
    }
    Ok(node)
}

/// What the inputs of a block are connected to, without connections of the wrong kind.
fn links(
    block: &Block,
    nodes: &[Node<'_>],
    places: &BTreeMap<BlockId, usize>,
) -> Vec<Option<Link>> {
    let Some(spec) = block.spec() else { return Vec::new() };
    let link = |(port, source): (usize, &Option<crate::graph::Source>)| {
        let source = source.as_ref()?;
        let link = Link {
            node: *places.get(&source.block)?,
            output: usize::try_from(source.output).ok()?,
        };
        let gives = nodes.get(link.node)?.outputs.get(link.output)?.kind;
        (gives == spec.about.inputs.get(port)?.kind).then_some(link)
    };
    block.inputs().iter().enumerate().map(link).collect()
}

fn count_planes(rule: Planes, inputs: &[usize], is_grey: bool) -> usize {
    let at = |port: usize| inputs.get(port).copied().unwrap_or(0);
    let planes = match rule {
        Planes::Grey => 1,
        Planes::As(port) => at(port),
        Planes::Most(ports) => ports.iter().map(|port| at(*port)).max().unwrap_or(0),
        Planes::ByParameters if is_grey => 1,
        Planes::Colour | Planes::ByParameters => 3,
        Planes::ColourAlpha => 4,
    };
    planes.max(1)
}

fn key(
    node: &Node<'_>,
    spec: &'static crate::block::BlockSpec,
    nodes: &[Node<'_>],
    purpose: &Purpose<'_>,
) -> Result<Key, Error> {
    let values = node.block.values();
    let mut key = Key::of_block(spec, values, node.seed, purpose.working, purpose.precision);
    if !spec.about.is_deterministic {
        key.never_again();
    }
    for (spec, value) in spec.params.iter().zip(values) {
        // An empty path names no file: what that means is for the block to say.
        if let (ParamKind::Path(FileUse::Read), ParamValue::Text(path)) = (&spec.kind, value)
            && !path.is_empty()
        {
            let bytes = purpose.files.read(path).map_err(|error| error.at_parameter(spec.id))?;
            key.bytes(&bytes);
        }
    }
    if let Some(given) = node.given {
        key.bytes(given.content.as_bytes());
    }
    for link in &node.inputs {
        let input = link.map(|link| nodes[link.node].key.of_output(link.output, 1));
        key.key(input.as_ref());
    }
    Ok(key.finish())
}

/// The needed blocks, each behind all that it reads. Without recursion: a graph may be a chain of
/// ten thousand blocks.
fn topological_order(graph: &Graph, wanted: &[BlockId]) -> Result<Vec<BlockId>, Error> {
    let mut order = Vec::new();
    let mut is_done: BTreeMap<BlockId, bool> = BTreeMap::new();
    for id in wanted {
        let mut waiting = vec![*id];
        while let Some(&id) = waiting.last() {
            match is_done.get(&id) {
                Some(true) => {
                    waiting.pop();
                }
                Some(false) => {
                    waiting.pop();
                    is_done.insert(id, true);
                    order.push(id);
                }
                None => {
                    is_done.insert(id, false);
                    let sources = graph.sources_of(id)?;
                    waiting.extend(sources.filter(|source| !is_done.contains_key(source)));
                }
            }
        }
    }
    debug_assert!(order.len() <= graph.blocks().len(), "no block is needed twice");
    if order.is_empty() {
        return Err(Error::new(ErrorKind::InvalidArgument, "nothing is wanted"));
    }
    Ok(order)
}
