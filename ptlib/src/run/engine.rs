//! The engine: what computations share, and the calls that start one.

use std::{
    path::{Path, PathBuf},
    sync::Arc,
};

use super::{
    Bands, ComputeOptions, EngineOptions, OutputShape, PixelsMut, ProgressFn, ProgressReport,
    cache::Cache,
    execute::{Execution, Means},
    files::GraphFiles,
    log::{Log, LogFn, LogLevel},
    monitor::Monitor,
    nodes::{self, Node, Purpose},
    plan::{Handover, Plan, Sizes, Wanted},
    sink::{self, Sink},
    threads::Threads,
};
use crate::{
    block::{Files, Registry},
    error::{Error, ErrorKind},
    graph::{BlockId, Graph},
    io::{self, FileAccess, Reading},
    limits::Limits,
    math::levels::Precision,
    params::{FileUse, ParamKind, ParamValue},
    value::{BufferPool, Image, Kind, Value},
};

/// What computations share. Clones are the same engine; any thread may use it.
#[derive(Debug, Clone)]
pub struct Engine(Arc<Inner>);

#[derive(Debug)]
struct Inner {
    registry: Arc<Registry>,
    options: EngineOptions,
    threads: Threads,
    pool: Arc<BufferPool>,
    cache: Cache,
    log: Log,
}

impl Engine {
    /// An engine with the built-in block types.
    #[must_use]
    pub fn new(options: EngineOptions) -> Self {
        Self(Arc::new(Inner {
            registry: Registry::builtin(),
            threads: Threads::new(options.threads),
            pool: BufferPool::new(),
            cache: Cache::new(options.cache_bytes),
            log: Log::default(),
            options,
        }))
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

    /// Sends messages of at least `level` to `log` from now on, or nowhere.
    pub fn set_log(&self, log: Option<(LogLevel, Arc<LogFn>)>) {
        self.0.log.set(log);
    }

    /// Logs a message.
    pub(crate) fn tell(&self, level: LogLevel, message: &str) {
        self.0.log.tell(level, message);
    }

    /// An empty graph.
    #[must_use]
    pub fn new_graph(&self) -> Graph {
        Graph::new(Arc::clone(&self.0.registry))
    }

    /// Reads a graph file's contents.
    ///
    /// # Errors
    /// [`ErrorKind::Parse`] with all faults of the file, each with its
    /// line and column; [`ErrorKind::Limit`].
    pub fn read_graph(&self, xml: &[u8]) -> Result<Reading, Error> {
        io::read_graph(xml, &self.0.registry, self.limits())
    }

    /// Reads a graph file. Its blocks may read files below its folder.
    ///
    /// # Errors
    /// As [`read_graph`](Self::read_graph), and [`ErrorKind::Io`].
    pub fn open_graph(&self, path: &Path) -> Result<Reading, Error> {
        let mut reading = self.read_graph(&io::read_limited(path, self.limits().file_bytes)?)?;
        reading.graph.set_folder(path.parent().map(Path::to_path_buf));
        Ok(reading)
    }

    /// Computes one output of one block as an image of planes.
    ///
    /// # Errors
    /// What is wrong with the graph, what a block says,
    /// [`ErrorKind::Limit`] before anything is computed if it would take
    /// too much memory, [`ErrorKind::Cancelled`].
    pub fn compute(
        &self,
        graph: &Graph,
        block: BlockId,
        output: u32,
        options: ComputeOptions<'_>,
    ) -> Result<Image, Error> {
        match self.compute_value(graph, block, output, options)? {
            Value::Image(image) => Ok(image),
            other => {
                let message = format!("output {output} gives a {}", other.kind().name());
                Err(graph.at(block, Error::new(ErrorKind::TypeMismatch, message)))
            }
        }
    }

    /// Computes one output of one block as a value of any kind.
    ///
    /// # Errors
    /// As [`compute`](Self::compute).
    pub fn compute_value(
        &self,
        graph: &Graph,
        block: BlockId,
        output: u32,
        options: ComputeOptions<'_>,
    ) -> Result<Value, Error> {
        let mut values = self.0.compute(graph, &[(block, output)], options, Destination::Values)?;
        values.pop().ok_or_else(|| Error::new(ErrorKind::Internal, "the plan gave no value"))
    }

    /// Computes one output of one block into pixels of the caller.
    ///
    /// # Errors
    /// As [`compute`](Self::compute), and
    /// [`ErrorKind::BufferTooSmall`].
    pub fn compute_into(
        &self,
        graph: &Graph,
        block: BlockId,
        output: u32,
        options: ComputeOptions<'_>,
        target: PixelsMut<'_>,
    ) -> Result<(), Error> {
        let to = Destination::Pixels(target);
        self.0.compute(graph, &[(block, output)], options, to).map(drop)
    }

    /// Computes one output of one block and delivers it band by band, from the top to the bottom:
    /// an image of any size passes through a few mebibytes, if the blocks do not have to keep it.
    ///
    /// With `keep_going`, a white image stands for a block that fails from the band on in which it
    /// fails: what was delivered before stays.
    ///
    /// # Errors
    /// As [`compute`](Self::compute), and that of the function that takes the bands.
    pub fn compute_bands(
        &self,
        graph: &Graph,
        block: BlockId,
        output: u32,
        options: ComputeOptions<'_>,
        bands: Bands<'_>,
    ) -> Result<(), Error> {
        let to = Destination::Bands(bands);
        self.0.compute(graph, &[(block, output)], options, to).map(drop)
    }

    /// Computes all results of a graph (its `end` blocks, in file order), and lets its `save file`
    /// blocks write where the engine's options allow it.
    ///
    /// # Errors
    /// As [`compute`](Self::compute), and [`ErrorKind::Denied`].
    pub fn compute_all(
        &self,
        graph: &Graph,
        options: ComputeOptions<'_>,
    ) -> Result<Vec<(BlockId, Image)>, Error> {
        let writers: Vec<(BlockId, PathBuf)> = graph
            .writers()
            .map(|id| self.0.target_of(graph, id).map(|path| (id, path)))
            .collect::<Result<_, _>>()?;
        let results: Vec<BlockId> = graph.results().collect();
        let wanted: Vec<(BlockId, u32)> =
            results.iter().chain(writers.iter().map(|(id, _)| id)).map(|id| (*id, 0)).collect();
        if wanted.is_empty() {
            return graph.main_result().map(|_| Vec::new());
        }
        let values = self.0.compute(graph, &wanted, options, Destination::Values)?;
        let mut images = values.into_iter().filter_map(|value| match value {
            Value::Image(image) => Some(image),
            _ => None,
        });
        let results: Vec<_> = results.into_iter().zip(images.by_ref()).collect();
        for ((id, path), image) in writers.iter().zip(images) {
            io::save_image(&image, path, io::BitDepth::Eight).map_err(|e| graph.at(*id, e))?;
        }
        Ok(results)
    }

    /// The size and the number of planes that [`compute`](Self::compute) would give, without
    /// computing anything.
    ///
    /// # Errors
    /// What is wrong with the graph.
    pub fn output_shape(
        &self,
        graph: &Graph,
        block: BlockId,
        output: u32,
        options: &ComputeOptions<'_>,
    ) -> Result<OutputShape, Error> {
        let settings = self.0.settings(graph, options)?;
        let files = self.0.files(graph);
        let (nodes, _) = settings.resolve(graph, &[block], options.keep_going, &files)?;
        let node = nodes.last().filter(|node| node.id == block);
        match node.and_then(|node| node.outputs.get(output as usize)) {
            Some(found) => {
                let (width, height) = settings.sizes.result;
                Ok(OutputShape { width, height, planes: found.planes })
            }
            None => Err(graph.at(block, no_output(output))),
        }
    }
}

/// Where results go.
enum Destination<'a> {
    /// To the caller, as values.
    Values,
    /// The only one, into pixels of the caller.
    Pixels(PixelsMut<'a>),
    /// The only one, to a function of the caller.
    Bands(Bands<'a>),
}

/// What holds for one computation: the graph's settings with the options applied.
struct Settings {
    sizes: Sizes,
    seed: u64,
    precision: Precision,
}

impl Settings {
    fn resolve<'g>(
        &self,
        graph: &'g Graph,
        wanted: &[BlockId],
        keep_going: bool,
        files: &dyn Files,
    ) -> Result<(Vec<Node<'g>>, Vec<Error>), Error> {
        let purpose = Purpose {
            working: self.sizes.working(),
            seed: self.seed,
            precision: self.precision,
            keep_going,
            files,
        };
        nodes::resolve(graph, wanted, &purpose)
    }
}

impl Inner {
    fn settings(&self, graph: &Graph, options: &ComputeOptions<'_>) -> Result<Settings, Error> {
        let of_graph = graph.settings();
        let (width, height) = options.size.unwrap_or((of_graph.width, of_graph.height));
        let supersampling = options.supersampling.unwrap_or(of_graph.supersampling);
        let max = crate::graph::Settings::MAX_SUPERSAMPLING;
        if !(1..=max).contains(&supersampling) {
            let message = format!("supersampling is {supersampling}, allowed 1..={max}");
            return Err(Error::new(ErrorKind::OutOfRange, message));
        }
        if width == 0 || height == 0 {
            let message = format!("size {width} × {height} is empty, allowed from 1 × 1");
            return Err(Error::new(ErrorKind::OutOfRange, message));
        }
        let side = self.options.limits.image_side;
        let longest = u64::from(width.max(height)) * u64::from(supersampling);
        if longest > u64::from(side) {
            let message = format!(
                "{width} × {height} with supersampling {supersampling} has a side of {longest} \
                 pixels, allowed {side}"
            );
            return Err(Error::new(ErrorKind::Limit, message)
                .with_hint("ask for a smaller size, or raise the limit of image sides"));
        }
        Ok(Settings {
            sizes: Sizes { result: (width, height), supersampling },
            seed: options.seed.unwrap_or(of_graph.seed),
            precision: options.precision.unwrap_or(of_graph.precision),
        })
    }

    fn files(&self, graph: &Graph) -> GraphFiles {
        GraphFiles::new(FileAccess {
            folder: graph.folder().map(Path::to_path_buf),
            read_folders: self.options.read_folders.clone(),
            write_folders: self.options.write_folders.clone(),
            limits: self.options.limits,
        })
    }

    /// Where a `save file` block writes to.
    fn target_of(&self, graph: &Graph, id: BlockId) -> Result<PathBuf, Error> {
        let files = self.files(graph);
        let block = graph.block(id)?;
        let params = graph.known(id)?.params.iter().zip(block.values());
        for (spec, value) in params {
            if let (ParamKind::Path(FileUse::Write), ParamValue::Text(path)) = (&spec.kind, value) {
                let resolved = files.access().resolve_write(path);
                return resolved.map_err(|error| graph.at(id, error.at_parameter(spec.id)));
            }
        }
        Err(graph.at(id, Error::new(ErrorKind::Internal, "has no parameter that names a file")))
    }

    /// Computes the wanted outputs.
    fn compute(
        &self,
        graph: &Graph,
        wanted: &[(BlockId, u32)],
        mut options: ComputeOptions<'_>,
        to: Destination<'_>,
    ) -> Result<Vec<Value>, Error> {
        let settings = self.settings(graph, &options)?;
        let files = self.files(graph);
        let ids: Vec<BlockId> = wanted.iter().map(|(id, _)| *id).collect();
        let (nodes, failures) = settings.resolve(graph, &ids, options.keep_going, &files)?;
        let wanted = find_wanted(graph, &nodes, wanted)?;
        let handover = match to {
            Destination::Values => Handover::Value,
            Destination::Pixels(_) | Destination::Bands(_) => Handover::Rows,
        };
        let mut plan = Plan::new(nodes, wanted, settings.sizes, handover, &self.cache)?;
        if let Destination::Bands(bands) = &to {
            plan.peak_bytes += sink::band_bytes(bands, settings.sizes.result);
        }
        let memory_bytes = options.memory_bytes.unwrap_or(self.options.limits.memory_bytes);
        plan.check_memory(memory_bytes)?;
        let limits = Limits { memory_bytes, ..self.options.limits };
        let mut sinks = self.sinks(&plan, to)?;
        let first = plan.nodes[plan.wanted[0].node].id;
        // A closure of its own lets the monitor borrow it for as long as the locals live.
        let mut tell =
            options.progress.take().map(|progress| move |report: &ProgressReport| progress(report));
        let tell = tell
            .as_mut()
            .map(|tell| (tell as &mut ProgressFn<'_>, options.progress_interval, first));
        let threads = options.threads as usize;
        let monitor = Monitor::new(&self.threads, threads, options.cancel.take(), plan.units, tell);
        let means = Means {
            precision: settings.precision,
            simd: self.options.simd,
            pool: &self.pool,
            files: &files,
            cache: &self.cache,
            monitor: &monitor,
            limits: &limits,
            memory_bytes,
            log: &self.log,
            keep_going: options.keep_going,
            strip_rows: options.strip_rows,
        };
        let mut execution = Execution::new(&plan, &means, failures);
        let done = execution.run(&mut sinks);
        let values = done.and_then(|()| collect(&plan, handover, &execution, sinks));
        if let Some(collected) = options.failures.take() {
            collected.append(&mut execution.failures);
        }
        drop(execution);
        drop(plan);
        // What the cache keeps comes on top; unused memory stays for the next computation as long
        // as it is no more than the caller lets the engine keep anyway.
        self.pool.trim(self.cache.budget());
        values
    }

    /// One sink for each wanted output; those that are given as stored get none of the rows.
    fn sinks<'a>(&self, plan: &Plan<'_>, to: Destination<'a>) -> Result<Vec<Sink<'a>>, Error> {
        let (width, height) = plan.sizes.result;
        let supersampling = plan.sizes.supersampling;
        let planes = || {
            let wanted = &plan.wanted[0];
            let output = &plan.nodes[wanted.node].outputs[wanted.output];
            if output.kind != Kind::Image {
                let message = format!("the output gives a {}, not an image", output.kind.name());
                return Err(Error::new(ErrorKind::TypeMismatch, message));
            }
            Ok(output.planes)
        };
        match to {
            Destination::Values => {}
            Destination::Pixels(target) => {
                let planes = planes()?;
                target.check(width, height)?;
                let target = (target.format, target.pixels, target.stride);
                return Ok(vec![Sink::pixels(target, width, planes, supersampling)]);
            }
            Destination::Bands(bands) => {
                return Ok(vec![Sink::bands(bands, (width, height), planes()?, supersampling)?]);
            }
        }
        let sink = |wanted: &Wanted| {
            let output = &plan.nodes[wanted.node].outputs[wanted.output];
            if plan.is_given_as_stored(wanted, Handover::Value) {
                return Ok(Sink::none());
            }
            let image = Image::new(&self.pool, width, height, output.planes)?;
            Ok(Sink::image(image, supersampling))
        };
        plan.wanted.iter().map(sink).collect()
    }
}

fn no_output(output: u32) -> Error {
    Error::new(ErrorKind::NotFound, format!("has no output {output}"))
}

/// The places of the wanted outputs among the nodes.
fn find_wanted(
    graph: &Graph,
    nodes: &[Node<'_>],
    wanted: &[(BlockId, u32)],
) -> Result<Vec<Wanted>, Error> {
    let find = |(id, output): &(BlockId, u32)| {
        let node = nodes.iter().position(|node| node.id == *id);
        let place = node.zip(usize::try_from(*output).ok());
        place
            .filter(|(node, output)| *output < nodes[*node].outputs.len())
            .map(|(node, output)| Wanted { node, output })
            .ok_or_else(|| graph.at(*id, no_output(*output)))
    };
    wanted.iter().map(find).collect()
}

/// The values that were asked for; none if they went into the caller's pixels.
fn collect(
    plan: &Plan<'_>,
    handover: Handover,
    execution: &Execution<'_, '_>,
    sinks: Vec<Sink<'_>>,
) -> Result<Vec<Value>, Error> {
    if handover == Handover::Rows {
        return Ok(Vec::new());
    }
    let value = |(wanted, sink): (&Wanted, Sink<'_>)| {
        let stored = || execution.value(wanted.node, wanted.output).cloned();
        sink.into_image()
            .map(Value::Image)
            .or_else(stored)
            // Nothing like a white image stands for a gradient or a mesh.
            .ok_or_else(|| match execution.failures.first() {
                Some(failure) => failure.clone(),
                None => Error::new(ErrorKind::Internal, "a wanted value was not computed"),
            })
    };
    plan.wanted.iter().zip(sinks).map(value).collect()
}
