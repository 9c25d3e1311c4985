//! Rows from the registry: every block at its defaults, alone. None is left out: blocks that give
//! no image have a row as well, though the number of pixels says little about them.

use std::{fs, path::PathBuf};

use ptlib::{
    BlockId, Engine, Graph, Precision,
    block::{BlockSpec, Role},
    io,
    params::{FileUse, ParamKind},
    value::Kind,
};

use crate::{
    Result, card, given,
    measure::Times,
    options::is_wanted,
    report::{Row, Subject},
    work::{self, Settings, Work, precision_name},
};

/// A block with everything that it needs.
pub(crate) struct Entry {
    pub(crate) name: String,
    pub(crate) work: Work,
}

impl Entry {
    pub(crate) fn measure(mut self, runs: usize) -> Result<Row> {
        let times = Times::of(runs, || self.work.run())
            .map_err(|error| format!("{}: {error}", self.name))?;
        let Settings { size, threads, precision, .. } = self.work.settings;
        let precision = precision_name(precision);
        Ok(Row::new(Subject { name: self.name, size, threads, precision }, &times))
    }
}

/// An entry for each wanted block, in both precisions if its first output is an image. Inputs get
/// the cheapest source that gives what they take.
pub(crate) fn entries(size: (u32, u32), filters: &[String]) -> Result<Vec<Entry>> {
    let mut entries = Vec::new();
    let engine = work::engine(1, 0);
    for spec in engine.registry().blocks() {
        let id = spec.about.id;
        let is_image = spec.about.outputs.first().is_some_and(|output| output.kind == Kind::Image);
        if id == card::ID || !is_wanted(id, filters) {
            continue;
        }
        let precisions = [Precision::Float, Precision::EightBit];
        for precision in precisions.into_iter().take(if is_image { 2 } else { 1 }) {
            let (graph, block) = alone(&engine, spec)?;
            let supersampling = Some(1);
            let settings = Settings { block, size, threads: 1, precision, supersampling };
            let work = Work::new(graph, settings)?;
            entries.push(Entry { name: id.to_owned(), work });
        }
    }
    Ok(entries)
}

/// A graph of one block and the sources of its required inputs.
fn alone(engine: &Engine, spec: &'static BlockSpec) -> Result<(Graph, BlockId)> {
    let mut graph = engine.new_graph();
    let block = graph.add(spec.about.id)?;
    if spec.about.role == Role::Input
        && let Kind::Points | Kind::Mesh | Kind::Strands = spec.about.outputs[0].kind
    {
        graph.set_input(block, Some(given::shape(spec.about.outputs[0].kind)?))?;
        return Ok((graph, block));
    }
    for (number, port) in (0..).zip(spec.about.inputs) {
        if port.is_optional && spec.about.role != Role::Input {
            continue;
        }
        let source = match port.kind {
            Kind::Image => card::ID,
            kind => source_of(engine, kind)?,
        };
        let source = graph.add(source)?;
        graph.connect(source, 0, block, number)?;
    }
    name_samples(&mut graph)?;
    Ok((graph, block))
}

/// Gives every block that reads a file one that it can read.
fn name_samples(graph: &mut Graph) -> Result {
    let blocks: Vec<_> = graph.blocks().map(|(id, block)| (id, block.spec())).collect();
    for (id, spec) in blocks {
        let Some(spec) = spec else { continue };
        for param in spec.params {
            if param.kind == ParamKind::Path(FileUse::Read) {
                let gives_text = spec.about.outputs[0].kind == Kind::Text;
                graph.set_folder(Some(samples()?));
                graph.set_text(id, param.id, if gives_text { GRAMMAR } else { PICTURE })?;
            }
        }
    }
    Ok(())
}

/// A block that gives a value of that kind and takes nothing.
fn source_of(engine: &Engine, kind: Kind) -> Result<&'static str> {
    let gives = |spec: &&BlockSpec| {
        let takes_nothing = spec.about.inputs.iter().all(|port| port.is_optional);
        takes_nothing && spec.about.outputs.first().is_some_and(|output| output.kind == kind)
    };
    let blocks = engine.registry().blocks();
    let spec = blocks.into_iter().find(gives);
    Ok(spec.ok_or_else(|| format!("no block gives a value of kind {}", kind.name()))?.about.id)
}

const PICTURE: &str = "card.png";
const GRAMMAR: &str = "tree.txt";

/// A tree of 2¹⁰ twigs.
const TREE: &str = "B(180)s(0)\ns(x) [x < 10] -> DP(80)[L(25)s(x + 1)][R(25)s(x + 1)]\n";

/// A folder with a picture and a grammar for the blocks that read one.
fn samples() -> Result<PathBuf> {
    let folder = std::env::temp_dir().join("ptlib-bench");
    fs::create_dir_all(&folder)?;
    fs::write(folder.join(GRAMMAR), TREE)?;
    let path = folder.join(PICTURE);
    if !path.exists() {
        let mut graph = work::engine(1, 0).new_graph();
        let block = graph.add(card::ID)?;
        let (size, precision) = ((256, 256), Precision::EightBit);
        let settings = Settings { block, size, threads: 1, precision, supersampling: Some(1) };
        let card = Work::new(graph, settings)?.compute()?;
        io::save_image(&card, &path, io::BitDepth::Eight)?;
    }
    Ok(folder)
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    use super::*;

    #[test]
    fn every_block_of_the_registry_has_a_row() {
        let engine = work::engine(1, 0);
        let blocks = engine.registry().blocks().into_iter().map(|spec| spec.about.id.to_owned());
        let blocks: BTreeSet<String> = blocks.filter(|id| id != card::ID).collect();
        let mut rows = BTreeSet::new();
        for entry in entries((32, 32), &[]).unwrap() {
            let row = entry.measure(1).unwrap_or_else(|error| panic!("{error}"));
            assert_eq!((row.width, row.threads), (32, 1));
            rows.insert(row.name);
        }
        assert_eq!(rows, blocks);
    }
}
