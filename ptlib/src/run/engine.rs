//! The engine: what computations share, and the calls that start one.

use std::{
    path::{Path, PathBuf},
    sync::Arc,
    time::Duration,
};

use super::Cancel;
use crate::{
    block::Registry,
    error::Error,
    graph::{BlockId, Graph},
    io::{self, Reading},
    limits::Limits,
    math::{levels::Precision, simd::SimdLevel},
    value::{Format, Image, Value},
};

/// How an [`Engine`] is made.
#[derive(Debug, Clone)]
pub struct EngineOptions {
    /// The most threads that one computation uses, the caller's included; 0 for one per processor.
    pub threads: u32,
    /// How much memory the results kept for later computations may take, in bytes; 0 keeps none.
    pub cache_bytes: u64,
    /// What graph files may ask for.
    pub limits: Limits,
    /// The SIMD level; results do not depend on it.
    pub simd: SimdLevel,
    /// Folders below which every graph may read files, besides the graph's own folder.
    pub read_folders: Vec<PathBuf>,
    /// Folders below which `save file` may write.
    pub write_folders: Vec<PathBuf>,
}

impl Default for EngineOptions {
    fn default() -> Self {
        Self {
            threads: 0,
            cache_bytes: 256 << 20,
            limits: Limits::default(),
            simd: SimdLevel::best(),
            read_folders: Vec::new(),
            write_folders: Vec::new(),
        }
    }
}

/// How far a computation is.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ProgressReport {
    /// Units of work that are done.
    pub units_done: u64,
    /// All units of work.
    pub units_total: u64,
    /// The stage that runs, from 0.
    pub stage: u32,
    /// The block whose output the stage makes.
    pub block: BlockId,
}

impl ProgressReport {
    /// What is done, 0..1.
    #[must_use]
    pub fn fraction(&self) -> f64 {
        #[expect(clippy::cast_precision_loss, reason = "for display")]
        if self.units_total == 0 {
            1.0
        } else {
            self.units_done as f64 / self.units_total as f64
        }
    }
}

/// Called with how far a computation is; returning `false` cancels it.
pub type ProgressFn<'a> = dyn FnMut(&ProgressReport) -> bool + Send + 'a;

/// How a computation differs from what the graph and the engine say.
pub struct ComputeOptions<'a> {
    /// The size of the result in pixels, instead of the graph's.
    pub size: Option<(u32, u32)>,
    /// The seed, instead of the graph's; blocks with their own keep it.
    pub seed: Option<u64>,
    /// The supersampling, instead of the graph's.
    pub supersampling: Option<u32>,
    /// The precision, instead of the graph's.
    pub precision: Option<Precision>,
    /// The most threads, the caller's included; 0 for the engine's.
    pub threads: u32,
    /// The most memory at the peak in bytes, instead of the engine's limit.
    pub memory_bytes: Option<u64>,
    /// Go on with a white image where a block fails, as PT Designer did.
    pub keep_going: bool,
    /// A request to stop.
    pub cancel: Option<Cancel>,
    /// Called on the calling thread only.
    pub progress: Option<&'a mut ProgressFn<'a>>,
    /// The least time between two calls of `progress`.
    pub progress_interval: Duration,
}

impl Default for ComputeOptions<'_> {
    fn default() -> Self {
        Self {
            size: None,
            seed: None,
            supersampling: None,
            precision: None,
            threads: 0,
            memory_bytes: None,
            keep_going: false,
            cancel: None,
            progress: None,
            progress_interval: Duration::from_millis(50),
        }
    }
}

/// The size of an image that is not computed yet.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct OutputShape {
    /// Width in pixels.
    pub width: u32,
    /// Height in pixels.
    pub height: u32,
    /// 1, 3 or 4.
    pub planes: usize,
}

/// What computations share. Clones are the same engine; any thread may use it.
#[derive(Debug, Clone)]
pub struct Engine(Arc<Inner>);

#[derive(Debug)]
struct Inner {
    registry: Arc<Registry>,
    options: EngineOptions,
}

impl Engine {
    /// An engine with the built-in block types.
    #[must_use]
    pub fn new(options: EngineOptions) -> Self {
        Self(Arc::new(Inner { registry: Registry::builtin(), options }))
    }

    /// The block types that its graphs may use.
    #[must_use]
    pub fn registry(&self) -> &Arc<Registry> {
        &self.0.registry
    }

    /// What graph files may ask for.
    #[must_use]
    pub fn limits(&self) -> &Limits {
        &self.0.options.limits
    }

    /// An empty graph.
    #[must_use]
    pub fn new_graph(&self) -> Graph {
        Graph::new(Arc::clone(&self.0.registry))
    }

    /// Reads a graph file's contents.
    ///
    /// # Errors
    /// [`ErrorKind::Parse`](crate::ErrorKind::Parse) with all faults of the file, each with its
    /// line and column; [`ErrorKind::Limit`](crate::ErrorKind::Limit).
    pub fn read_graph(&self, xml: &[u8]) -> Result<Reading, Error> {
        io::read_graph(xml, &self.0.registry, self.limits())
    }

    /// Reads a graph file. Its blocks may read files below its folder.
    ///
    /// # Errors
    /// As [`read_graph`](Self::read_graph), and [`ErrorKind::Io`](crate::ErrorKind::Io).
    pub fn open_graph(&self, path: &Path) -> Result<Reading, Error> {
        let mut reading = self.read_graph(&io::read_limited(path, self.limits().file_bytes)?)?;
        reading.graph.set_folder(path.parent().map(Path::to_path_buf));
        Ok(reading)
    }

    /// Computes one output of one block as an image.
    ///
    /// # Errors
    /// What is wrong with the graph, what a block says,
    /// [`ErrorKind::Limit`](crate::ErrorKind::Limit) before anything is computed if it would take
    /// too much memory, [`ErrorKind::Cancelled`](crate::ErrorKind::Cancelled).
    pub fn compute(
        &self,
        _graph: &Graph,
        _block: BlockId,
        _output: u32,
        _options: ComputeOptions<'_>,
    ) -> Result<Image, Error> {
        Err(Error::new(crate::ErrorKind::Unsupported, "not yet"))
    }

    /// Computes one output of one block as a value of any kind.
    ///
    /// # Errors
    /// As [`compute`](Self::compute).
    pub fn compute_value(
        &self,
        _graph: &Graph,
        _block: BlockId,
        _output: u32,
        _options: ComputeOptions<'_>,
    ) -> Result<Value, Error> {
        Err(Error::new(crate::ErrorKind::Unsupported, "not yet"))
    }

    /// Computes one output of one block into pixels of the caller: rows of `stride` bytes.
    ///
    /// # Errors
    /// As [`compute`](Self::compute), and
    /// [`ErrorKind::BufferTooSmall`](crate::ErrorKind::BufferTooSmall).
    #[expect(clippy::too_many_arguments, reason = "what, how, and the buffer")]
    pub fn compute_into(
        &self,
        _graph: &Graph,
        _block: BlockId,
        _output: u32,
        _options: ComputeOptions<'_>,
        _format: Format,
        _pixels: &mut [u8],
        _stride: usize,
    ) -> Result<(), Error> {
        Err(Error::new(crate::ErrorKind::Unsupported, "not yet"))
    }

    /// Computes all results of a graph (its `end` blocks), and lets its `save file` blocks write
    /// where the engine's options allow it.
    ///
    /// # Errors
    /// As [`compute`](Self::compute), and [`ErrorKind::Denied`](crate::ErrorKind::Denied).
    pub fn compute_all(
        &self,
        _graph: &Graph,
        _options: ComputeOptions<'_>,
    ) -> Result<Vec<(BlockId, Image)>, Error> {
        Err(Error::new(crate::ErrorKind::Unsupported, "not yet"))
    }

    /// The size and the number of planes that [`compute`](Self::compute) would give, without
    /// computing anything.
    ///
    /// # Errors
    /// What is wrong with the graph.
    pub fn output_shape(
        &self,
        _graph: &Graph,
        _block: BlockId,
        _output: u32,
        _options: &ComputeOptions<'_>,
    ) -> Result<OutputShape, Error> {
        Err(Error::new(crate::ErrorKind::Unsupported, "not yet"))
    }
}
