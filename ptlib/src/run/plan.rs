//! From a graph and wanted outputs to stages, before anything is computed.
//!
//! 1. The needed blocks in topological order, each with its inputs resolved, the planes of its
//!    outputs and its key ([`nodes`](super::nodes)).
//! 2. What the cache has is taken from it; what only that needed is dropped.
//! 3. Placement. An output is **stored** as a whole image if a block reads it anywhere, if blocks
//!    of different stages read it, if the cache shall keep it, or if it is wanted as it is.
//!    Everything else is **fused**: its rows live in small buffers while the stage runs.
//! 4. Stages: each stored or wanted output with all blocks fused into it, in topological order.
//! 5. The peak of memory over all stages.

use super::{
    cache::Cache,
    nodes::{Node, Work},
};
use crate::{
    block::Access,
    error::{Error, ErrorKind},
    value::{Image, Kind, Value},
};

/// How a wanted output is handed over.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Handover {
    /// As a value: an image as planes.
    Value,
    /// Row by row into pixels of the caller.
    Rows,
}

/// A wanted output.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Wanted {
    pub(super) node: usize,
    pub(super) output: usize,
}

/// Sizes of a computation.
#[derive(Debug, Clone, Copy)]
pub(super) struct Sizes {
    /// Width and height of a result.
    pub(super) result: (u32, u32),
    /// Result pixels are means of this many times this many.
    pub(super) supersampling: u32,
}

impl Sizes {
    /// Width and height of the images that blocks make.
    pub(super) fn working(&self) -> (u32, u32) {
        (self.result.0 * self.supersampling, self.result.1 * self.supersampling)
    }
}

/// One pass over all rows, or one call of a block of shape Whole.
#[derive(Debug, Default)]
pub(super) struct Stage {
    /// The block whose output it makes or hands over.
    pub(super) root: usize,
    /// The blocks that it computes, in topological order, the root last. Empty if it only hands
    /// over what is stored.
    pub(super) members: Vec<usize>,
    /// The wanted outputs that it hands over row by row, as places in [`Plan::wanted`].
    pub(super) handed_over: Vec<usize>,
    /// The nodes whose values nobody reads after it.
    pub(super) freed: Vec<usize>,
    /// Its part of all work.
    pub(super) units: u64,
}

/// What to compute, in which order, and how much memory that takes.
#[derive(Debug)]
pub(super) struct Plan<'g> {
    pub(super) nodes: Vec<Node<'g>>,
    pub(super) wanted: Vec<Wanted>,
    pub(super) stages: Vec<Stage>,
    pub(super) sizes: Sizes,
    /// The most bytes that images take at one time.
    pub(super) peak_bytes: u64,
    pub(super) units: u64,
}

impl<'g> Plan<'g> {
    /// Plans the wanted outputs of `nodes`, which are in topological order.
    pub(super) fn new(
        nodes: Vec<Node<'g>>,
        wanted: Vec<Wanted>,
        sizes: Sizes,
        handover: Handover,
        cache: &Cache,
    ) -> Result<Self, Error> {
        let mut plan = Self { nodes, wanted, stages: vec![], sizes, peak_bytes: 0, units: 0 };
        plan.take_from_cache(cache);
        plan.drop_unneeded();
        let roots = plan.place(handover, cache.is_on());
        plan.make_stages(&roots, handover);
        plan.free_early(handover);
        plan.peak_bytes = plan.find_peak(handover)?;
        plan.units = plan.stages.iter().map(|stage| stage.units).sum();
        Ok(plan)
    }

    /// The error of a plan that takes more than `limit` bytes.
    pub(super) fn check_memory(&self, limit: u64) -> Result<(), Error> {
        if self.peak_bytes <= limit {
            return Ok(());
        }
        let ((width, height), mebibyte) = (self.sizes.working(), 1 << 20);
        let message = format!(
            "computing at {width} × {height} takes {} MiB at its peak, allowed {} MiB",
            self.peak_bytes.div_ceil(mebibyte),
            limit / mebibyte
        );
        Err(Error::new(ErrorKind::Limit, message)
            .with_hint("ask for a smaller size, or allow more memory (`ptc render --memory SIZE`)"))
    }

    fn take_from_cache(&mut self, cache: &Cache) {
        for node in &mut self.nodes {
            let kept: Option<Vec<Value>> = (0..node.outputs.len())
                .map(|output| cache.get(&node.key.of_output(output, 1)))
                .collect();
            if let Some(values) = kept.filter(|values| !values.is_empty()) {
                node.work = Work::Kept(values);
            }
        }
    }

    fn drop_unneeded(&mut self) {
        let mut is_needed = vec![false; self.nodes.len()];
        for wanted in &self.wanted {
            is_needed[wanted.node] = true;
        }
        for i in (0..self.nodes.len()).rev() {
            self.nodes[i].is_needed = is_needed[i];
            if is_needed[i] && !matches!(self.nodes[i].work, Work::Kept(_)) {
                for link in self.nodes[i].inputs.iter().flatten() {
                    is_needed[link.node] = true;
                }
            }
        }
    }

    /// Decides what is stored. Returns for each node the root of the stage that computes it.
    fn place(&mut self, handover: Handover, cache_is_on: bool) -> Vec<usize> {
        let mut readers: Vec<Vec<(usize, Access)>> = vec![Vec::new(); self.nodes.len()];
        let mut roots = vec![usize::MAX; self.nodes.len()];
        for i in (0..self.nodes.len()).rev() {
            let node = &self.nodes[i];
            if !node.is_needed {
                continue;
            }
            let is_wanted = self.wanted.iter().any(|wanted| wanted.node == i);
            let by_value = is_wanted && handover == Handover::Value;
            let mut reading = readers[i].iter().map(|(reader, _)| roots[*reader]);
            let first = reading.next();
            let is_shared = first.is_some_and(|first| reading.any(|root| root != first));
            let is_stored = !matches!(node.work, Work::Rows(_) | Work::White)
                || readers[i].iter().any(|(_, access)| *access == Access::Anywhere)
                || is_shared
                || (is_wanted && first.is_some())
                || (by_value && self.sizes.supersampling == 1)
                || (cache_is_on && node.is_worth_keeping());
            roots[i] = if is_stored || is_wanted { i } else { first.unwrap_or(i) };
            for (port, link) in (0..).zip(&node.inputs) {
                if let Some(link) = link
                    && !matches!(node.work, Work::Kept(_))
                {
                    readers[link.node].push((i, node.access(port)));
                }
            }
            self.nodes[i].is_stored = is_stored;
        }
        roots
    }

    fn make_stages(&mut self, roots: &[usize], handover: Handover) {
        let mut stage_of = vec![usize::MAX; self.nodes.len()];
        for (i, node) in self.nodes.iter().enumerate() {
            if node.is_needed && roots[i] == i && !matches!(node.work, Work::Kept(_)) {
                stage_of[i] = self.stages.len();
                self.stages.push(Stage { root: i, ..Stage::default() });
            }
        }
        for (i, node) in self.nodes.iter().enumerate() {
            if node.is_needed && !matches!(node.work, Work::Kept(_)) {
                self.stages[stage_of[roots[i]]].members.push(i);
            }
        }
        for (place, wanted) in self.wanted.iter().enumerate() {
            if self.is_given_as_stored(wanted, handover) {
                continue;
            }
            if matches!(self.nodes[wanted.node].work, Work::Rows(_) | Work::White) {
                self.stages[stage_of[wanted.node]].handed_over.push(place);
            } else {
                let handed_over = vec![place];
                self.stages.push(Stage { root: wanted.node, handed_over, ..Stage::default() });
            }
        }
        let height = u64::from(self.sizes.working().1);
        for stage in &mut self.stages {
            let is_whole = matches!(self.nodes[stage.root].work, Work::Whole(_));
            stage.units = match stage.members.len() {
                0 => height,
                // A guess: such a block takes about as long as a few others.
                _ if is_whole => 4 * height,
                members => members as u64 * height,
            };
        }
    }

    /// Whether a wanted output is the stored value itself, neither reduced nor converted.
    pub(super) fn is_given_as_stored(&self, wanted: &Wanted, handover: Handover) -> bool {
        let kind = self.nodes[wanted.node].outputs[wanted.output].kind;
        kind != Kind::Image || (handover == Handover::Value && self.sizes.supersampling == 1)
    }

    /// Tells each stage whose values are read for the last time by it.
    fn free_early(&mut self, handover: Handover) {
        let mut last = vec![usize::MAX; self.nodes.len()];
        for (number, stage) in self.stages.iter().enumerate() {
            last[stage.root] = number;
            for member in &stage.members {
                for link in self.nodes[*member].inputs.iter().flatten() {
                    last[link.node] = number;
                }
            }
        }
        for wanted in &self.wanted {
            if self.is_given_as_stored(wanted, handover) {
                last[wanted.node] = usize::MAX;
            }
        }
        for (node, stage) in last.into_iter().enumerate() {
            if let Some(stage) = self.stages.get_mut(stage) {
                stage.freed.push(node);
            }
        }
    }

    fn find_peak(&self, handover: Handover) -> Result<u64, Error> {
        let mut now = 0;
        let mut peak = 0;
        for stage in &self.stages {
            let root = &self.nodes[stage.root];
            if root.is_stored && !stage.members.is_empty() {
                now += self.bytes_of(stage.root);
            }
            if handover == Handover::Value {
                let (width, height) = self.sizes.result;
                for place in &stage.handed_over {
                    let output = &root.outputs[self.wanted[*place].output];
                    now += Image::bytes_of(width, height, output.planes);
                }
            }
            let mut scratch = 0;
            for member in &stage.members {
                scratch += self.nodes[*member].scratch_bytes(self.sizes.working())?;
            }
            peak = peak.max(now + scratch);
            for node in &stage.freed {
                if self.nodes[*node].is_stored && !matches!(self.nodes[*node].work, Work::Kept(_)) {
                    now -= self.bytes_of(*node);
                }
            }
        }
        Ok(peak)
    }

    /// The memory of a node's images.
    fn bytes_of(&self, node: usize) -> u64 {
        let (width, height) = self.sizes.working();
        let outputs = self.nodes[node].outputs.iter();
        let images = outputs.filter(|output| output.kind == Kind::Image);
        images.map(|output| Image::bytes_of(width, height, output.planes)).sum()
    }
}
