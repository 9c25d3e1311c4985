//! One computation that a row repeats.
//!
//! A computation must neither find its own result in the cache, nor wait for its input, nor for
//! fresh memory. Without test cards in the graph there is no cache; a result that is dropped
//! before the next run gives its memory to that one. With cards there is a cache just large
//! enough for two sets of cards and what one run keeps: runs take the sets by turns, and both
//! sets are used before each run, so that the result before the last is what the cache forgets.
//!
//! Other blocks can be kept like cards. Then a parameter is different in each run, unless the block
//! is one whose results are never kept: that is a graph which is computed again after a change.

use std::{
    env, fs,
    path::{Path, PathBuf},
    time::Duration,
};

use ptlib::{
    BlockId, Cancel, ComputeOptions, Engine, EngineOptions, Graph, Image, Limits, Precision,
    block::BlockSpec, params::ParamValue, run::OutputShape, value::Value,
};

use crate::{Result, card, change::Change, given, measure::timed};

/// What to compute, and how.
#[derive(Debug)]
pub(crate) struct Work {
    engine: Engine,
    /// The graph with the first and with the second set of cards.
    graphs: [Graph; 2],
    cards: Vec<BlockId>,
    /// What else is there before each run.
    kept: Vec<BlockId>,
    change: Option<Change>,
    runs: usize,
    pub(crate) settings: Settings,
}

/// What an engine has that others have not.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Host<'a> {
    pub(crate) plugin: Option<&'a Path>,
    /// Whether blocks may write below [`written`].
    pub(crate) writes: bool,
}

/// What to compute of a graph, and how.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Settings {
    pub(crate) block: BlockId,
    pub(crate) size: (u32, u32),
    pub(crate) threads: u32,
    pub(crate) precision: Precision,
    /// The graph's, if there is none here.
    pub(crate) supersampling: Option<u32>,
}

impl Work {
    /// The computation of a graph that an [`engine`] knows the types of.
    pub(crate) fn new(graph: Graph, settings: Settings) -> Result<Self> {
        Self::with(graph, settings, Host::default(), Vec::new(), None)
    }

    /// The same on a host with more, of which some blocks are kept and something changes.
    pub(crate) fn with(
        graph: Graph,
        settings: Settings,
        host: Host<'_>,
        kept: Vec<BlockId>,
        change: Option<Change>,
    ) -> Result<Self> {
        let is_card = |(_, block): &(_, &ptlib::graph::Block)| block.type_id() == card::ID;
        let cards: Vec<BlockId> = graph.blocks().filter(is_card).map(|(id, _)| id).collect();
        let mut other = graph.clone();
        for card in &cards {
            other.set_int(*card, "number", 1)?;
        }
        let first_cache = if kept.is_empty() { 0 } else { u64::MAX };
        let work = Self {
            engine: engine_with(settings.threads, first_cache, host)?,
            graphs: [graph, other],
            cards,
            kept,
            change,
            runs: 0,
            settings,
        };
        let cache_bytes = work.cache_bytes()?;
        Ok(Self { engine: engine_with(settings.threads, cache_bytes, host)?, ..work })
    }

    /// Two sets of cards, and one result and a half.
    fn cache_bytes(&self) -> Result<u64> {
        if !self.kept.is_empty() {
            let bytes = |block: &BlockId| Ok(self.value(&self.graphs[0], *block)?.bytes());
            let sum = |blocks: &[BlockId]| blocks.iter().map(bytes).sum::<Result<u64>>();
            return Ok(sum(&self.kept)? + sum(&self.computed())? * 3 / 2);
        }
        if self.cards.is_empty() {
            return Ok(0);
        }
        let bytes = |block| -> Result<u64> {
            let shape = self.engine.output_shape(&self.graphs[0], block, 0, &self.options())?;
            let OutputShape { width, height, planes } = shape;
            Ok(Image::bytes_of(width, height, planes))
        };
        let cards = self.cards.iter().map(|card| bytes(*card)).sum::<Result<u64>>()?;
        Ok(2 * cards + bytes(self.settings.block)? * 3 / 2)
    }

    /// The blocks that a run computes: the one that is measured, and what it needs down to those
    /// that are kept.
    fn computed(&self) -> Vec<BlockId> {
        let mut computed = vec![self.settings.block];
        let mut next = 0;
        while let Some(block) = computed.get(next).copied() {
            next += 1;
            for link in self.graphs[0].connections().filter(|link| link.target == block) {
                if !self.kept.contains(&link.source.block) && !computed.contains(&link.source.block)
                {
                    computed.push(link.source.block);
                }
            }
        }
        computed
    }

    fn options(&self) -> ComputeOptions<'static> {
        let Settings { size, threads, precision, supersampling, .. } = self.settings;
        ComputeOptions {
            size: Some(size),
            threads,
            precision: Some(precision),
            supersampling,
            ..ComputeOptions::default()
        }
    }

    /// The graph of the first set of cards, computed.
    pub(crate) fn compute(&self) -> Result<Image> {
        Ok(self.engine.compute(&self.graphs[0], self.settings.block, 0, self.options())?)
    }

    /// The right result: with something that changes, the one after the change, on an engine that
    /// has computed the graph before.
    pub(crate) fn compute_value(&self) -> Result<Value> {
        let value = self.value(&self.graphs[0], self.settings.block)?;
        let Some(change) = &self.change else { return Ok(value) };
        let mut graph = self.graphs[0].clone();
        change.finish(&mut graph)?;
        self.value(&graph, self.settings.block)
    }

    fn value(&self, graph: &Graph, block: BlockId) -> Result<Value> {
        Ok(self.engine.compute_value(graph, block, 0, self.options())?)
    }

    /// The picture that the graph of the first set of cards reads: a card, or what it was given.
    pub(crate) fn picture(&self) -> Result<Option<Image>> {
        let graph = &self.graphs[0];
        match self.cards.first() {
            Some(card) => Ok(Some(self.engine.compute(graph, *card, 0, self.options())?)),
            None => Ok(given::picture(graph).cloned()),
        }
    }

    /// Computes once more; returns how long that took.
    pub(crate) fn run(&mut self) -> Result<Duration> {
        for graph in &self.graphs {
            for block in self.cards.iter().chain(&self.kept) {
                self.value(graph, *block)?;
            }
        }
        self.runs += 1;
        let graph = &mut self.graphs[self.runs % 2];
        if let Some(change) = &self.change {
            change.apply(graph, self.runs)?;
        }
        let graph = &self.graphs[self.runs % 2];
        let (block, options) = (self.settings.block, self.options());
        timed(|| Ok(self.engine.compute_value(graph, block, 0, options).map(drop)?))
    }

    /// Gets ready for [`run_until`](Self::run_until): its inputs are in the cache afterwards.
    pub(crate) fn warm_up(&self) -> Result {
        for card in &self.cards {
            self.engine.compute(&self.graphs[0], *card, 0, self.options())?;
        }
        Ok(())
    }

    /// Computes once more, or stops on request.
    pub(crate) fn run_until(&self, cancel: Cancel) -> std::result::Result<(), ptlib::Error> {
        let options = ComputeOptions { cancel: Some(cancel), ..self.options() };
        self.engine.compute_value(&self.graphs[0], self.settings.block, 0, options).map(drop)
    }

    /// The type of the block that is computed.
    pub(crate) fn spec(&self) -> Result<&'static BlockSpec> {
        Ok(self.graphs[0].block(self.settings.block)?.spec().ok_or("a known type")?)
    }

    /// Sets a parameter of the block that is computed.
    pub(crate) fn set(&mut self, param: &str, value: &ParamValue) -> Result {
        for graph in &mut self.graphs {
            graph.set(self.settings.block, param, value.clone())?;
        }
        Ok(())
    }

    /// What the graph says about itself.
    pub(crate) fn graph(&self) -> &Graph {
        &self.graphs[0]
    }
}

/// An engine that knows test cards, without limits that a big row could reach.
pub(crate) fn engine(threads: u32, cache_bytes: u64) -> Engine {
    engine_that_writes(threads, cache_bytes, Vec::new())
}

fn engine_that_writes(threads: u32, cache_bytes: u64, write_folders: Vec<PathBuf>) -> Engine {
    let limits = Limits { memory_bytes: u64::MAX, ..Limits::default() };
    let options =
        EngineOptions { threads, cache_bytes, limits, write_folders, ..EngineOptions::default() };
    let engine = Engine::new(options);
    engine.registry().add(&card::FAMILY).expect("no built-in block is a test card");
    engine
}

/// The same with what else a host has.
pub(crate) fn engine_with(threads: u32, cache_bytes: u64, host: Host<'_>) -> Result<Engine> {
    let mut write_folders = Vec::new();
    if host.writes {
        fs::create_dir_all(written())?;
        write_folders.push(written());
    }
    let engine = engine_that_writes(threads, cache_bytes, write_folders);
    if let Some(plugin) = host.plugin {
        engine.load_plugin(plugin)?;
    }
    Ok(engine)
}

/// The folder that blocks of this process write into; it is removed at the end.
pub(crate) fn written() -> PathBuf {
    env::temp_dir().join(format!("ptlib-bench-written-{}", std::process::id()))
}

/// The hash of a file's bytes.
pub(crate) fn hash_of_file(path: &Path) -> Result<String> {
    Ok(blake3::hash(&fs::read(path)?).to_hex()[..HASH_DIGITS].to_owned())
}

/// The hash of a value: of an image's size and of the bits of its numbers, or of what else it
/// contains.
pub(crate) fn hash(value: &Value) -> String {
    match value {
        Value::Image(image) => hash_of_image(image),
        other => {
            let bytes = *other.content().as_bytes();
            bytes[..HASH_DIGITS / 2].iter().map(|byte| format!("{byte:02x}")).collect()
        }
    }
}

fn hash_of_image(image: &Image) -> String {
    let mut hasher = blake3::Hasher::new();
    hasher.update(&image.width().to_le_bytes());
    hasher.update(&image.height().to_le_bytes());
    for plane in 0..image.planes() {
        for value in image.channel(plane) {
            hasher.update(&value.to_bits().to_le_bytes());
        }
    }
    let hash = hasher.finalize().to_hex();
    hash[..HASH_DIGITS].to_owned()
}

/// How many digits of a hash are written down: enough to notice every change.
const HASH_DIGITS: usize = 32;

/// The name of a precision in definitions and records.
pub(crate) fn precision_name(precision: Precision) -> &'static str {
    match precision {
        Precision::Float => "float",
        Precision::EightBit => "8-bit",
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn inverted_card() -> Work {
        let mut graph = engine(1, 0).new_graph();
        let card = graph.add(card::ID).unwrap();
        let block = graph.add("invert").unwrap();
        graph.connect(card, 0, block, 0).unwrap();
        let (precision, supersampling) = (Precision::Float, Some(1));
        let settings = Settings { block, size: (64, 64), threads: 1, precision, supersampling };
        Work::new(graph, settings).unwrap()
    }

    /// Images of the cache share their planes with whoever got them before.
    fn place(work: &Work, graph: usize, block: BlockId) -> (Image, *const f32) {
        let image = work.engine.compute(&work.graphs[graph], block, 0, work.options()).unwrap();
        let place = image.channel(0).as_ptr();
        (image, place)
    }

    #[test]
    fn cards_are_kept_and_results_are_not() {
        let mut work = inverted_card();
        let (card, block) = (work.cards[0], work.settings.block);
        work.run().unwrap();
        let (_first_card, card_before) = place(&work, 1, card);
        let (_first, before) = place(&work, 1, block);
        assert_eq!(place(&work, 1, block).1, before, "the cache keeps the last result");
        for _ in 0..3 {
            work.run().unwrap();
        }
        work.run().unwrap();
        assert_ne!(place(&work, 1, block).1, before);
        assert_eq!(place(&work, 1, card).1, card_before);
    }

    #[test]
    fn hashes_tell_images_apart() {
        let work = inverted_card();
        let image = work.compute().unwrap();
        let image = hash(&image.into());
        assert_eq!(image, hash(&work.compute_value().unwrap()));
        let other = work.value(&work.graphs[1], work.settings.block).unwrap();
        assert_ne!(image, hash(&other));
    }
}
