//! What a graph holds.

use std::{
    fmt,
    path::{Path, PathBuf},
    sync::Arc,
};

use super::Given;
use crate::{
    block::{BlockSpec, Registry, Role},
    error::{Error, ErrorKind},
    math::levels::Precision,
    params::ParamValue,
};

/// A block of a graph, for as long as it is in it. The handle of a removed block is recognised as
/// stale, also after its place was taken by another.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct BlockId {
    pub(super) index: u32,
    pub(super) generation: u32,
}

impl BlockId {
    /// The handle as the number that the C ABI uses; never 0.
    #[must_use]
    pub fn to_raw(self) -> u64 {
        u64::from(self.generation) << 32 | u64::from(self.index)
    }

    /// The handle of a number. Any number is accepted: one that names no block is stale.
    #[must_use]
    pub fn from_raw(raw: u64) -> Self {
        let low = raw & u64::from(u32::MAX);
        Self {
            index: u32::try_from(low).expect("32 bits were kept"),
            generation: u32::try_from(raw >> 32).expect("32 bits are left"),
        }
    }
}

/// An output of a block: what an input is connected to.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct Source {
    /// The block.
    pub block: BlockId,
    /// Which of its outputs.
    pub output: u32,
}

/// A connection from an output to an input.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Connection {
    /// Where it comes from.
    pub source: Source,
    /// The block that it leads to.
    pub target: BlockId,
    /// Which of its inputs.
    pub input: u32,
}

/// A parameter as a file gave it, kept because the block's type does not know it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct RawParameter {
    /// Its name.
    pub name: String,
    /// The word in its `type` attribute.
    pub kind: String,
    /// Its value.
    pub value: String,
}

/// The plug-in that a block's type comes from, as a file names it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Origin {
    /// Its id.
    pub plugin: String,
    /// Its version when the file was written.
    pub version: String,
}

/// One block of a graph.
#[derive(Debug, Clone)]
pub struct Block {
    pub(crate) id: String,
    pub(crate) type_id: Arc<str>,
    pub(crate) spec: Option<&'static BlockSpec>,
    pub(crate) origin: Option<Origin>,
    pub(crate) seed: Option<u64>,
    pub(crate) values: Vec<ParamValue>,
    pub(crate) inputs: Vec<Option<Source>>,
    pub(crate) extra_attributes: Vec<(String, String)>,
    pub(crate) extra_parameters: Vec<RawParameter>,
}

impl Block {
    /// Its id in the graph's file: a whole number in files of PT Designer.
    #[must_use]
    pub fn id(&self) -> &str {
        &self.id
    }

    /// The id of its type, such as `perlin noise`.
    #[must_use]
    pub fn type_id(&self) -> &str {
        &self.type_id
    }

    /// Its type; `None` if that is unknown (its plug-in is missing).
    #[must_use]
    pub fn spec(&self) -> Option<&'static BlockSpec> {
        self.spec
    }

    /// The plug-in that its file says its type comes from.
    #[must_use]
    pub fn origin(&self) -> Option<&Origin> {
        self.origin.as_ref()
    }

    /// The seed that it has instead of the graph's.
    #[must_use]
    pub fn seed(&self) -> Option<u64> {
        self.seed
    }

    /// The values of its parameters, in the order of their declarations.
    #[must_use]
    pub fn values(&self) -> &[ParamValue] {
        &self.values
    }

    /// What its inputs are connected to, in the order of their ports.
    #[must_use]
    pub fn inputs(&self) -> &[Option<Source>] {
        &self.inputs
    }

    /// What its file said and its type does not know: attributes of the block.
    #[must_use]
    pub fn extra_attributes(&self) -> &[(String, String)] {
        &self.extra_attributes
    }

    /// What its file said and its type does not know: parameters.
    #[must_use]
    pub fn extra_parameters(&self) -> &[RawParameter] {
        &self.extra_parameters
    }

    pub(crate) fn has_role(&self, role: Role) -> bool {
        self.spec.is_some_and(|spec| spec.about.role == role)
    }
}

/// What holds for a graph as a whole.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Settings {
    /// Width of its results in pixels, at least 1.
    pub width: u32,
    /// Height of its results in pixels, at least 1.
    pub height: u32,
    /// The seed of all blocks that have none of their own.
    pub seed: u64,
    /// Each result pixel is the mean of this many times this many: 1 to 6.
    pub supersampling: u32,
    /// What values are computed in.
    pub precision: Precision,
}

impl Settings {
    /// The most supersampling.
    pub const MAX_SUPERSAMPLING: u32 = 6;

    /// The version of the file format that this library writes, and the newest that it reads.
    pub const FILE_VERSION: u32 = 1;
}

impl Default for Settings {
    fn default() -> Self {
        Self { width: 256, height: 256, seed: 0, supersampling: 1, precision: Precision::Float }
    }
}

/// A texture: blocks and their connections. See the [module](super).
#[derive(Clone)]
pub struct Graph {
    pub(super) registry: Arc<Registry>,
    pub(super) data: Arc<Data>,
}

#[derive(Clone)]
pub(super) struct Data {
    /// The version of the file format that it was read from; `None` for a file of PT Designer.
    pub(super) file_version: Option<u32>,
    pub(super) settings: Settings,
    pub(super) extra_attributes: Vec<(String, String)>,
    pub(super) folder: Option<PathBuf>,
    pub(super) slots: Vec<Slot>,
    /// Indices of the blocks in file order.
    pub(super) order: Vec<u32>,
}

impl Default for Data {
    fn default() -> Self {
        Self {
            file_version: Some(Settings::FILE_VERSION),
            settings: Settings::default(),
            extra_attributes: Vec::new(),
            folder: None,
            slots: Vec::new(),
            order: Vec::new(),
        }
    }
}

#[derive(Clone)]
pub(super) struct Slot {
    /// Odd while a block is here; counts up at each insertion and removal.
    pub(super) generation: u32,
    pub(super) block: Option<Arc<Block>>,
    /// What the caller set for this block, if it is an input of the graph.
    pub(super) given: Option<Arc<Given>>,
}

impl Graph {
    /// An empty graph whose blocks are of the types in `registry`.
    #[must_use]
    pub fn new(registry: Arc<Registry>) -> Self {
        Self { registry, data: Arc::default() }
    }

    /// The types that its blocks may have.
    #[must_use]
    pub fn registry(&self) -> &Arc<Registry> {
        &self.registry
    }

    /// What holds for the graph as a whole.
    #[must_use]
    pub fn settings(&self) -> &Settings {
        &self.data.settings
    }

    /// The folder of its file: paths in its parameters are relative to it, and its blocks may read
    /// files below it.
    #[must_use]
    pub fn folder(&self) -> Option<&Path> {
        self.data.folder.as_deref()
    }

    /// The version of the file format that it was read from; `None` for a file of PT Designer,
    /// [`Settings::FILE_VERSION`] for a new graph.
    #[must_use]
    pub fn file_version(&self) -> Option<u32> {
        self.data.file_version
    }

    /// Attributes that its file gave the graph and this version does not know.
    #[must_use]
    pub fn extra_attributes(&self) -> &[(String, String)] {
        &self.data.extra_attributes
    }

    /// All blocks, in file order.
    pub fn blocks(&self) -> impl ExactSizeIterator<Item = (BlockId, &Block)> + DoubleEndedIterator {
        self.data.order.iter().map(|&index| {
            let slot = &self.data.slots[index as usize];
            let block = slot.block.as_deref().expect("the order lists living blocks");
            (BlockId { index, generation: slot.generation }, block)
        })
    }

    /// The block of that handle.
    ///
    /// # Errors
    /// [`ErrorKind::StaleHandle`] if it was removed or never was.
    pub fn block(&self, id: BlockId) -> Result<&Block, Error> {
        self.data
            .slots
            .get(id.index as usize)
            .filter(|slot| slot.generation == id.generation)
            .and_then(|slot| slot.block.as_deref())
            .ok_or_else(|| stale(id))
    }

    /// The first block, in file order, whose file id is `id`.
    #[must_use]
    pub fn find(&self, id: &str) -> Option<BlockId> {
        self.blocks().find(|(_, block)| block.id == id).map(|(handle, _)| handle)
    }

    /// The results of the graph: its `end` blocks, in file order.
    pub fn results(&self) -> impl DoubleEndedIterator<Item = BlockId> {
        self.blocks().filter(|(_, block)| block.has_role(Role::Result)).map(|(id, _)| id)
    }

    /// The blocks that write files, in file order.
    pub fn writers(&self) -> impl Iterator<Item = BlockId> {
        self.blocks().filter(|(_, block)| block.has_role(Role::Writer)).map(|(id, _)| id)
    }

    /// The result that tools take which need one: the last `end` in file order.
    ///
    /// # Errors
    /// [`ErrorKind::NotFound`] if the graph has none.
    pub fn main_result(&self) -> Result<BlockId, Error> {
        self.results().next_back().ok_or_else(|| {
            Error::new(ErrorKind::NotFound, "the graph has no block of type \"end\"")
                .with_hint("add one, or name the block whose output you want")
        })
    }

    /// All connections, by the file order of the blocks that they lead to.
    pub fn connections(&self) -> impl Iterator<Item = Connection> {
        self.blocks().flat_map(|(target, block)| {
            (0..).zip(&block.inputs).filter_map(move |(input, source)| {
                source.map(|source| Connection { source, target, input })
            })
        })
    }

    /// `error`, with the place of the block added.
    pub(crate) fn at(&self, id: BlockId, error: Error) -> Error {
        match self.block(id) {
            Ok(block) => error.at_block(&block.id, &block.type_id, id.to_raw()),
            Err(_) => error,
        }
    }
}

impl fmt::Debug for Graph {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Graph")
            .field("settings", self.settings())
            .field("blocks", &self.blocks().map(|(_, block)| block).collect::<Vec<_>>())
            .finish()
    }
}

pub(super) fn stale(id: BlockId) -> Error {
    let message = format!("handle {:#x} names no block of this graph", id.to_raw());
    Error::new(ErrorKind::StaleHandle, message).with_hint("was the block removed?")
}
