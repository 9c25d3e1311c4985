//! A parameter that is another one in each run: what an editor does while somebody moves a slider.

use ptlib::{BlockId, Graph};
use serde::Deserialize;

use crate::Result;

/// A change, as a file of definitions has it.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Change {
    /// The ids of the blocks that have the parameter.
    blocks: Vec<String>,
    /// A parameter that is a real number.
    param: String,
    /// Its least value.
    from: f64,
    /// Its greatest value: what the hash is for.
    to: f64,
}

impl Change {
    /// Sets the parameter for a run. No value comes twice, so no result of an earlier run serves.
    pub(crate) fn apply(&self, graph: &mut Graph, run: usize) -> Result {
        // Parts of the golden section lie evenly, however many there are.
        const STEP: f64 = 0.618_033_988_749_894_9;
        let part = f64::from(u32::try_from(run)?) * STEP % 1.0;
        self.set(graph, self.from + (self.to - self.from) * part)
    }

    /// Sets the parameter to its greatest value.
    pub(crate) fn finish(&self, graph: &mut Graph) -> Result {
        self.set(graph, self.to)
    }

    fn set(&self, graph: &mut Graph, value: f64) -> Result {
        for id in &self.blocks {
            let block = find(graph, id)?;
            graph.set_float(block, &self.param, value)?;
        }
        Ok(())
    }
}

/// The block of that id.
pub(crate) fn find(graph: &Graph, id: &str) -> Result<BlockId> {
    Ok(graph.find(id).ok_or_else(|| format!("the graph has no block {id}"))?)
}
