//! One computation that a row repeats.
//!
//! A computation must neither find its own result in the cache, nor wait for its input, nor for
//! fresh memory. Without test cards in the graph there is no cache; a result that is dropped
//! before the next run gives its memory to that one. With cards there is a cache just large
//! enough for two sets of cards and what one run keeps: runs take the sets by turns, and both
//! sets are used before each run, so that the result before the last is what the cache forgets.

use std::{path::Path, time::Duration};

use ptlib::{
    BlockId, Cancel, ComputeOptions, Engine, EngineOptions, Graph, Image, Limits, Precision,
    block::BlockSpec, params::ParamValue, run::OutputShape,
};

use crate::{Result, card, given, measure::timed};

/// What to compute, and how.
#[derive(Debug)]
pub(crate) struct Work {
    engine: Engine,
    /// The graph with the first and with the second set of cards.
    graphs: [Graph; 2],
    cards: Vec<BlockId>,
    runs: usize,
    pub(crate) settings: Settings,
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
        Self::with_plugin(graph, settings, None)
    }

    /// The same for a graph with blocks of a plug-in.
    pub(crate) fn with_plugin(
        graph: Graph,
        settings: Settings,
        plugin: Option<&Path>,
    ) -> Result<Self> {
        let is_card = |(_, block): &(_, &ptlib::graph::Block)| block.type_id() == card::ID;
        let cards: Vec<BlockId> = graph.blocks().filter(is_card).map(|(id, _)| id).collect();
        let mut other = graph.clone();
        for card in &cards {
            other.set_int(*card, "number", 1)?;
        }
        let work = Self {
            engine: engine_with(settings.threads, 0, plugin)?,
            graphs: [graph, other],
            cards,
            runs: 0,
            settings,
        };
        let cache_bytes = work.cache_bytes()?;
        Ok(Self { engine: engine_with(settings.threads, cache_bytes, plugin)?, ..work })
    }

    /// Two sets of cards, and one result and a half.
    fn cache_bytes(&self) -> Result<u64> {
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
            for card in &self.cards {
                self.engine.compute(graph, *card, 0, self.options())?;
            }
        }
        self.runs += 1;
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
    let limits = Limits { memory_bytes: u64::MAX, ..Limits::default() };
    let options = EngineOptions { threads, cache_bytes, limits, ..EngineOptions::default() };
    let engine = Engine::new(options);
    engine.registry().add(&card::FAMILY).expect("no built-in block is a test card");
    engine
}

/// The same with the blocks of a plug-in, if there is one.
pub(crate) fn engine_with(threads: u32, cache_bytes: u64, plugin: Option<&Path>) -> Result<Engine> {
    let engine = engine(threads, cache_bytes);
    if let Some(plugin) = plugin {
        engine.load_plugin(plugin)?;
    }
    Ok(engine)
}

/// The hash of an image's size and of the bits of its numbers.
pub(crate) fn hash(image: &Image) -> String {
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
        assert_eq!(hash(&image), hash(&work.compute().unwrap()));
        let other = work.engine.compute(&work.graphs[1], work.settings.block, 0, work.options());
        assert_ne!(hash(&image), hash(&other.unwrap()));
    }
}
