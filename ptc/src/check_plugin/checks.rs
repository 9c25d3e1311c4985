//! What is checked. Each check gives faults, in words that a plug-in's author can act on.

use std::{
    fs,
    path::Path,
    sync::{Arc, Mutex, PoisonError, mpsc},
    thread,
    time::{Duration, Instant},
};

use super::{
    inputs,
    parameters::{drawn, word},
};
use ptlib::{
    BlockId, Cancel, ComputeOptions, Engine, EngineOptions, Error, ErrorKind, Graph, Image,
    Precision,
    block::{BlockSpec, PluginInfo, Role},
    params::{ParamKind, ParamSpec, ParamValue},
    plugin::probe,
    run::LogLevel,
    value::{Kind, Value},
};

/// Loading may take this long.
const LOADING: Duration = Duration::from_millis(100);

/// A block may go on this long after it was asked to stop.
const STOPPING: Duration = Duration::from_millis(100);

/// Computations with random parameters, for each block.
const TRIALS: u64 = 60;

/// Sizes of those computations: small and odd ones, where most faults are.
const SIZES: [(u32, u32); 6] = [(1, 1), (1, 17), (13, 7), (40, 24), (7, 64), (65, 33)];

/// A computation with random parameters is stopped after this time.
const PATIENCE: Duration = Duration::from_millis(500);

/// No more instances are made after this time.
const MOST_OF_CREATIONS: Duration = Duration::from_secs(20);

/// How often an instance is made to see whether memory grows.
const CREATIONS: u32 = 1000;

/// The memory that it may grow by, in bytes: what allocators keep.
const GROWTH: u64 = 4 << 20;

/// A check.
#[derive(Debug, Clone, Copy, PartialEq, Eq, clap::ValueEnum)]
pub(crate) enum Check {
    /// It is loaded, quickly, and its tables are what they should be.
    Load,
    /// Every block computes with its defaults, in both precisions; those that need a file, or a
    /// text of a grammar, cannot be tried.
    Defaults,
    /// Every block computes with random and extreme parameters at odd sizes.
    Parameters,
    /// Results do not depend on how the image is cut into strips.
    Strips,
    /// Results do not depend on the number of threads.
    Threads,
    /// Rectangles are written as a whole, and nothing around them.
    Rectangles,
    /// A computation that is asked to stop does so.
    Cancel,
    /// Locale and floating-point mode stay as they are.
    Environment,
    /// Memory does not grow with instances.
    Creations,
}

impl Check {
    pub(crate) const ALL: &[Self] = &[
        Self::Load,
        Self::Defaults,
        Self::Parameters,
        Self::Strips,
        Self::Threads,
        Self::Rectangles,
        Self::Cancel,
        Self::Environment,
        Self::Creations,
    ];

    pub(crate) fn name(self) -> &'static str {
        match self {
            Self::Load => "load",
            Self::Defaults => "defaults",
            Self::Parameters => "parameters",
            Self::Strips => "strips",
            Self::Threads => "threads",
            Self::Rectangles => "rectangles",
            Self::Cancel => "cancel",
            Self::Environment => "environment",
            Self::Creations => "creations",
        }
    }

    /// What holds when the check passes.
    pub(crate) fn promise(self) -> &'static str {
        match self {
            Self::Load => "it loads, and its tables are sound",
            Self::Defaults => "every block that needs no file computes with its defaults",
            Self::Parameters => "random and extreme parameters do no harm",
            Self::Strips => "the same bits for every cut into strips",
            Self::Threads => "the same bits for 1, 2, 3 and 8 threads",
            Self::Rectangles => "rectangles are written, and nothing around them",
            Self::Cancel => "a computation that is asked to stop does so",
            Self::Environment => "locale and floating-point mode stay as they are",
            Self::Creations => "memory does not grow with instances",
        }
    }
}

/// Runs a check in this process.
pub(super) fn run(check: Check, plugin: &Path) -> Vec<String> {
    let before = probe::Environment::now();
    let started = Instant::now();
    let loaded = Subject::load(plugin);
    let took = started.elapsed();
    let subject = match loaded {
        Ok(subject) => subject,
        Err(error) => return vec![error.to_string()],
    };
    let faults = match check {
        Check::Load => subject.loaded(took),
        Check::Defaults => subject.each(Specimen::defaults),
        Check::Parameters => subject.each(Specimen::parameters),
        Check::Strips => subject.each(Specimen::strips),
        Check::Threads => subject.each(Specimen::threads),
        Check::Rectangles => subject.each(Specimen::rectangles),
        Check::Cancel => subject.each(Specimen::cancel),
        Check::Environment => subject.each(|block| block.environment(&before)),
        Check::Creations => subject.each(Specimen::creations),
    };
    faults.unwrap_or_else(|error| vec![error.to_string()])
}

/// The most faults of a block that a check shows.
const SHOWN: usize = 3;

type Faults = Result<Vec<String>, Error>;

/// A loaded plug-in.
struct Subject {
    engine: Engine,
    blocks: Vec<&'static BlockSpec>,
    defects: Arc<Mutex<Vec<String>>>,
}

impl Subject {
    fn load(plugin: &Path) -> Result<Self, Error> {
        let engine = Engine::new(EngineOptions { cache_bytes: 0, ..Default::default() });
        let defects: Arc<Mutex<Vec<String>>> = Arc::default();
        let heard = Arc::clone(&defects);
        let log = move |_, message: &str| {
            heard.lock().unwrap_or_else(PoisonError::into_inner).push(message.to_owned());
        };
        // A block may warn of what it was given; what the engine logs as an error is a defect.
        engine.set_log(Some((LogLevel::Error, Arc::new(log))));
        let info = engine.load_plugin(plugin)?;
        let registry = engine.registry();
        let is_own = |spec: &&BlockSpec| {
            registry.plugin_of(spec.about.id).is_some_and(|own: &PluginInfo| own == info)
        };
        let blocks = registry.blocks().into_iter().filter(is_own).collect();
        Ok(Self { engine, blocks, defects })
    }

    fn loaded(&self, took: Duration) -> Faults {
        if took > LOADING {
            return Ok(vec![format!(
                "loading took {} ms, allowed {}: work belongs into `prepare`",
                took.as_millis(),
                LOADING.as_millis()
            )]);
        }
        let faults =
            if self.blocks.is_empty() { vec!["it has no blocks".to_owned()] } else { vec![] };
        Ok(faults)
    }

    /// What is wrong with each block, with its name before it.
    fn each<'a>(&'a self, check: impl Fn(&Specimen<'a>) -> Faults) -> Faults {
        let mut faults = Vec::new();
        for spec in &self.blocks {
            let specimen = Specimen { subject: self, spec };
            let found = check(&specimen).unwrap_or_else(|error| vec![error.to_string()]);
            let id = spec.about.id;
            let more = found.len().saturating_sub(SHOWN);
            // Errors name the block themselves.
            let named = found.into_iter().take(SHOWN).map(|fault| match fault.contains(id) {
                true => fault,
                false => format!("\"{id}\": {fault}"),
            });
            faults.extend(named);
            if more > 0 {
                faults.push(format!("\"{id}\": {more} more faults like these"));
            }
        }
        Ok(faults)
    }

    /// What was warned of since this was asked last.
    fn defects(&self) -> Vec<String> {
        std::mem::take(&mut self.defects.lock().unwrap_or_else(PoisonError::into_inner))
    }
}

/// Which of the optional inputs something is connected to.
#[derive(Debug, Clone, Copy)]
enum Given {
    All,
    /// The first of them.
    First,
    None,
}

impl Given {
    /// From the most to the fewest.
    const ALL: [Self; 3] = [Self::All, Self::First, Self::None];

    /// Whether the optional input with that number, from 1, is connected.
    fn has(self, number: u32) -> bool {
        match self {
            Self::All => true,
            Self::First => number == 1,
            Self::None => false,
        }
    }
}

/// A block that is checked.
struct Specimen<'a> {
    subject: &'a Subject,
    spec: &'static BlockSpec,
}

impl Specimen<'_> {
    fn default_values(&self) -> Vec<ParamValue> {
        self.spec.params.iter().map(ParamSpec::default_value).collect()
    }

    /// A graph with the block, and something at its inputs. `None` if one needs what cannot be made
    /// up.
    fn graph(
        &self,
        values: &[ParamValue],
        given: Given,
    ) -> Result<Option<(Graph, BlockId)>, Error> {
        let mut graph = self.subject.engine.new_graph();
        let block = graph.add(self.spec.about.id)?;
        for (spec, value) in self.spec.params.iter().zip(values) {
            graph.set(block, spec.id, value.clone())?;
        }
        let mut optional = 0;
        for (number, port) in (0..).zip(self.spec.about.inputs) {
            optional += u32::from(port.is_optional);
            if port.is_optional && !given.has(optional) {
                continue;
            }
            match inputs::source(&mut graph, port.kind, number)? {
                Some(source) => graph.connect(source, 0, block, number)?,
                None if port.is_optional => {}
                None => return Ok(None),
            }
        }
        if self.spec.about.role == Role::Input {
            for output in self.spec.about.outputs {
                match inputs::made(output.kind)? {
                    Some(value) => graph.set_input(block, Some(value))?,
                    None => return Ok(None),
                }
            }
        }
        Ok(Some((graph, block)))
    }

    /// The graph with the most inputs, and default parameters, that computes. `None` if the block
    /// needs what cannot be made up, such as a file.
    ///
    /// # Errors
    /// Why nothing computes.
    fn example(&self) -> Result<Option<(Graph, BlockId)>, Error> {
        let mut refused = None;
        for given in Given::ALL {
            let Some(graph) = self.graph(&self.default_values(), given)? else { return Ok(None) };
            match self.compute(&graph, || options((8, 8), None, 1)) {
                Ok(_) => return Ok(Some(graph)),
                Err(error) => refused = Some(error),
            }
        }
        let needs_file = |spec: &ParamSpec| {
            let is_empty = spec.default_value() == ParamValue::Text("".into());
            is_empty && matches!(spec.kind, ParamKind::Path(_))
        };
        match refused {
            Some(error) if is_defect(&error) => Err(error),
            Some(_) if self.spec.params.iter().any(needs_file) => Ok(None),
            Some(error) => Err(error),
            None => Ok(None),
        }
    }

    /// All outputs as bits, and their number.
    fn compute(
        &self,
        (graph, block): &(Graph, BlockId),
        options: impl Fn() -> ComputeOptions<'static>,
    ) -> Result<Vec<Vec<u32>>, Error> {
        let output = |number| {
            let engine = &self.subject.engine;
            engine.compute_value(graph, *block, number, options()).map(|value| bits(&value))
        };
        (0..).zip(self.spec.about.outputs).map(|(number, _)| output(number)).collect()
    }

    fn defaults(&self) -> Faults {
        let mut faults = Vec::new();
        let Some(graph) = self.example()? else { return Ok(faults) };
        for precision in [Precision::EightBit, Precision::Float] {
            self.compute(&graph, || options((64, 64), Some(precision), 0))?;
            faults.extend(self.subject.defects());
        }
        for given in Given::ALL {
            let Some(graph) = self.graph(&self.default_values(), given)? else { continue };
            // A block may want one of two inputs.
            if let Err(error) = self.compute(&graph, || options((64, 64), None, 0))
                && !matches!(error.kind(), ErrorKind::Unconnected | ErrorKind::InvalidArgument)
            {
                faults.push(error.to_string());
            }
            faults.extend(self.subject.defects());
        }
        Ok(faults)
    }

    fn parameters(&self) -> Faults {
        let mut faults = Vec::new();
        for trial in 0..TRIALS {
            let values: Vec<_> =
                (0..).zip(self.spec.params).map(|(i, p)| drawn(p, trial, i)).collect();
            let given = if trial.is_multiple_of(2) { Given::All } else { Given::None };
            let Some(graph) = self.graph(&values, given)? else { return Ok(faults) };
            let size = SIZES[usize::try_from(trial).unwrap_or_default() % SIZES.len()];
            let with = |fault: &str| {
                let named = self.spec.params.iter().zip(&values);
                let named: Vec<_> =
                    named.map(|(p, value)| format!("{} {}", p.id, word(value))).collect();
                format!("at {} × {} with {}: {fault}", size.0, size.1, named.join(", "))
            };
            // Parameters may ask for hours of work: a while shows enough.
            let cancel = Cancel::new();
            let watch = Watch::start(&cancel, PATIENCE);
            let limited =
                || ComputeOptions { cancel: Some(cancel.clone()), ..options(size, None, 0) };
            let computed = self.compute(&graph, limited);
            drop(watch);
            if let Err(error) = computed
                && is_defect(&error)
            {
                faults.push(with(&error.to_string()));
            }
            faults.extend(self.subject.defects().iter().map(|defect| with(defect)));
        }
        Ok(faults)
    }

    fn strips(&self) -> Faults {
        let cut = |rows| move || ComputeOptions { strip_rows: rows, ..options((97, 61), None, 0) };
        self.same("strips", &[1, 2, 7, 61].map(cut))
    }

    fn threads(&self) -> Faults {
        let on = |threads| move || options((257, 128), None, threads);
        self.same("threads", &[1, 2, 3, 8].map(on))
    }

    /// Whether results are the same for all of `variants`.
    fn same(&self, what: &str, variants: &[impl Fn() -> ComputeOptions<'static>]) -> Faults {
        let Some(graph) = self.example()? else { return Ok(vec![]) };
        let mut first = None;
        for (number, variant) in variants.iter().enumerate() {
            let found = self.compute(&graph, variant)?;
            let first = first.get_or_insert_with(|| found.clone());
            if *first != found {
                let fault =
                    format!("results differ between {what} (variant {number} and the first)");
                return Ok(vec![fault]);
            }
        }
        Ok(vec![])
    }

    fn rectangles(&self) -> Faults {
        let size = (37, 29);
        let mut inputs: Vec<Option<Image>> = Vec::new();
        for (number, port) in (0..).zip(self.spec.about.inputs) {
            if port.kind != Kind::Image {
                return Ok(vec![]);
            }
            let Some((graph, block)) = self.graph(&self.default_values(), Given::All)? else {
                return Ok(vec![]);
            };
            let block = graph.block(block)?;
            let source = block.inputs().get(number).copied().flatten();
            let image = source.map(|source| {
                let engine = &self.subject.engine;
                engine.compute(&graph, source.block, source.output, options(size, None, 0))
            });
            inputs.push(image.transpose()?);
        }
        probe::probe(self.spec, &self.default_values(), &inputs, size)
    }

    fn cancel(&self) -> Faults {
        let Some(graph) = self.example()? else { return Ok(vec![]) };
        let mut side = 1024;
        // Until a computation takes long enough to be asked; three tries, because machines are busy.
        let mut tries = Vec::new();
        while side <= 8192 && tries.len() < 3 {
            match self.stop(&graph, side)? {
                Some(took) if took <= STOPPING => return Ok(vec![]),
                Some(took) => tries.push(took),
                None => side *= 2,
            }
        }
        let best = tries.iter().min();
        Ok(best.map_or(vec![], |took| {
            vec![format!(
                "went on for {} ms after it was asked to stop, allowed {}: ask `is_cancelled` more \
                 often",
                took.as_millis(),
                STOPPING.as_millis()
            )]
        }))
    }

    /// How long a computation goes on after it is asked to stop; `None` if it ended before.
    fn stop(&self, graph: &(Graph, BlockId), side: u32) -> Result<Option<Duration>, Error> {
        let cancel = Cancel::new();
        let asker = {
            let cancel = cancel.clone();
            thread::spawn(move || {
                thread::sleep(Duration::from_millis(20));
                cancel.request();
                Instant::now()
            })
        };
        let options =
            || ComputeOptions { cancel: Some(cancel.clone()), ..options((side, side), None, 0) };
        let engine = &self.subject.engine;
        let ended = engine.compute_value(&graph.0, graph.1, 0, options());
        let now = Instant::now();
        let asked = asker.join().unwrap_or(now);
        match ended {
            Ok(_) => Ok((now > asked).then(|| now - asked)),
            Err(error) if error.kind() == ErrorKind::Cancelled => Ok(Some(now - asked)),
            Err(error) if error.kind() == ErrorKind::Limit => Ok(None),
            Err(error) => Err(error),
        }
    }

    fn environment(&self, before: &probe::Environment) -> Faults {
        let Some(graph) = self.example()? else { return Ok(vec![]) };
        self.compute(&graph, || options((64, 64), None, 1))?;
        let now = probe::Environment::now();
        let mut faults = Vec::new();
        if now.locale != before.locale {
            faults.push(format!("changed the locale from {} to {}", before.locale, now.locale));
        }
        if now.arithmetic != before.arithmetic {
            faults.push("changed the floating-point mode of a thread".to_owned());
        }
        Ok(faults)
    }

    fn creations(&self) -> Faults {
        let Some(graph) = self.example()? else { return Ok(vec![]) };
        let create = |times| -> Result<(), Error> {
            for _ in 0..times {
                self.compute(&graph, || options((8, 8), None, 1))?;
            }
            Ok(())
        };
        create(1)?;
        let before = resident_bytes();
        let until = Instant::now() + MOST_OF_CREATIONS;
        for _ in 0..CREATIONS {
            create(1)?;
            if Instant::now() > until {
                break;
            }
        }
        let grown = resident_bytes().zip(before).map(|(now, before)| now.saturating_sub(before));
        let grown = grown.filter(|grown| *grown > GROWTH);
        Ok(grown.map_or(vec![], |grown| {
            vec![format!("memory grew by {} KiB in at most {CREATIONS} computations", grown / 1024)]
        }))
    }
}

/// Asks a computation to stop after a while, unless it is dropped before.
struct Watch {
    done: Option<mpsc::Sender<()>>,
    thread: Option<thread::JoinHandle<()>>,
}

impl Watch {
    fn start(cancel: &Cancel, patience: Duration) -> Self {
        let (done, ended) = mpsc::channel::<()>();
        let cancel = cancel.clone();
        let thread = thread::spawn(move || {
            if ended.recv_timeout(patience) == Err(mpsc::RecvTimeoutError::Timeout) {
                cancel.request();
            }
        });
        Self { done: Some(done), thread: Some(thread) }
    }
}

impl Drop for Watch {
    fn drop(&mut self) {
        drop(self.done.take());
        if let Some(thread) = self.thread.take() {
            let _ = thread.join();
        }
    }
}

fn options(
    size: (u32, u32),
    precision: Option<Precision>,
    threads: u32,
) -> ComputeOptions<'static> {
    ComputeOptions { size: Some(size), precision, threads, ..Default::default() }
}

/// The samples of an image, or the hash of anything else.
fn bits(value: &Value) -> Vec<u32> {
    match value {
        Value::Image(image) => {
            let samples = (0..image.planes()).flat_map(|channel| image.channel(channel));
            samples.map(|sample| sample.to_bits()).collect()
        }
        other => other.content().as_bytes().iter().copied().map(u32::from).collect(),
    }
}

/// Whether an error is the block's fault, whatever its parameters are.
fn is_defect(error: &Error) -> bool {
    matches!(error.kind(), ErrorKind::PluginPanic | ErrorKind::Internal)
}

/// The memory of this process, where the system tells it.
fn resident_bytes() -> Option<u64> {
    let numbers = fs::read_to_string("/proc/self/statm").ok()?;
    let pages: u64 = numbers.split(' ').nth(1)?.parse().ok()?;
    Some(pages * 4096)
}
