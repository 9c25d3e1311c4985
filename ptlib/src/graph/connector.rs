//! Many connections in a row.
//!
//! Whether one connection closes a cycle takes a search through the graph. A file with 50,000
//! connections in a malicious order would make 50,000 of them slow, so this keeps a level for each
//! block that never falls along a connection, and searches only where levels leave the question
//! open: at most √m steps backwards per connection, and forwards only where levels rise (Bender,
//! Fineman, Gilbert, Tarjan, "A New Approach to Incremental Cycle Detection and Related Problems",
//! ACM Transactions on Algorithms 12(2), 2015, section 2).

use super::{BlockId, Graph, Source};
use crate::error::Error;

/// Connects blocks of a graph without a look at the kinds, quickly also when there are many
/// connections. The same rules as [`Graph::connect_unchecked_kinds`].
pub(crate) struct Connector<'g> {
    graph: &'g mut Graph,
    nodes: Vec<Node>,
    /// The most steps of a search backwards: the root of the expected number of connections.
    steps: usize,
    /// Counts searches; a node is marked by the number of the search that found it.
    search: u64,
}

#[derive(Default, Clone)]
struct Node {
    level: u32,
    found: u64,
    /// Blocks that read it, by slot. May name some that do not any more.
    readers: Vec<usize>,
}

impl<'g> Connector<'g> {
    /// For about `count` connections, to blocks that are in the graph already.
    pub(crate) fn new(graph: &'g mut Graph, count: usize) -> Self {
        let nodes = vec![Node::default(); graph.data.slots.len()];
        let existing: Vec<_> = graph.connections().collect();
        let steps = (count + existing.len()).isqrt().max(8);
        let mut connector = Self { graph, nodes, steps, search: 0 };
        for connection in existing {
            connector.admit(slot(connection.source.block), slot(connection.target));
        }
        connector
    }

    /// The graph with the connections made so far.
    pub(crate) fn graph(&self) -> &Graph {
        self.graph
    }

    /// Connects a source to an input; what was connected there before is replaced.
    pub(crate) fn connect(
        &mut self,
        source: Source,
        target: BlockId,
        input: u32,
    ) -> Result<(), Error> {
        self.graph.check_source(source, target)?;
        if !self.admit(slot(source.block), slot(target)) {
            return Err(self.graph.cycle(source, target, input));
        }
        self.graph.put_source(source, target, input)
    }

    /// Makes levels fit a new connection; `false` if it would close a cycle.
    fn admit(&mut self, source: usize, target: usize) -> bool {
        if source == target {
            return false;
        }
        let (level, target_level) = (self.nodes[source].level, self.nodes[target].level);
        if level >= target_level {
            self.search += 1;
            let is_complete = self.mark_ancestors(source);
            if self.is_marked(target) {
                return false;
            }
            let level = if is_complete { level } else { level + 1 };
            if target_level < level && !self.raise(target, level) {
                return false;
            }
        }
        self.nodes[source].readers.push(target);
        true
    }

    /// Marks the nodes of one level that lead to `node` without leaving it. Gives up after some
    /// steps; then the answer is `false`, and only some are marked.
    fn mark_ancestors(&mut self, node: usize) -> bool {
        let level = self.nodes[node].level;
        let mut steps = 0;
        let mut waiting = vec![node];
        self.nodes[node].found = self.search;
        while let Some(node) = waiting.pop() {
            for source in sources(self.graph, node) {
                if self.nodes[source].level != level {
                    continue;
                }
                steps += 1;
                if steps > self.steps {
                    return false;
                }
                if std::mem::replace(&mut self.nodes[source].found, self.search) != self.search {
                    waiting.push(source);
                }
            }
        }
        true
    }

    fn is_marked(&self, node: usize) -> bool {
        self.nodes[node].found == self.search
    }

    /// Raises a node and all that depend on it to `level` at least. If one of them is marked, it
    /// leaves all levels as they were and the answer is `false`.
    fn raise(&mut self, node: usize, level: u32) -> bool {
        let mut raised = vec![(node, self.nodes[node].level)];
        self.nodes[node].level = level;
        let mut next = 0;
        while let Some(&(node, _)) = raised.get(next) {
            next += 1;
            let mut readers = std::mem::take(&mut self.nodes[node].readers);
            readers.retain(|&reader| sources(self.graph, reader).any(|source| source == node));
            let closes_cycle = readers.iter().any(|&reader| self.is_marked(reader));
            for &reader in readers.iter().filter(|_| !closes_cycle) {
                let reader_level = &mut self.nodes[reader].level;
                if *reader_level < level {
                    raised.push((reader, std::mem::replace(reader_level, level)));
                }
            }
            self.nodes[node].readers = readers;
            if closes_cycle {
                for (node, level) in raised {
                    self.nodes[node].level = level;
                }
                return false;
            }
        }
        true
    }
}

fn slot(id: BlockId) -> usize {
    id.index as usize
}

/// The slots of the blocks that a block reads.
fn sources(graph: &Graph, slot: usize) -> impl Iterator<Item = usize> {
    let block = graph.data.slots[slot].block.as_deref();
    let inputs = block.map(|block| block.inputs.as_slice()).unwrap_or_default();
    inputs.iter().flatten().map(|source| source.block.index as usize)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{
        block::Registry,
        error::ErrorKind,
        graph::Block,
        math::{convert::truncate64, elias::Draws},
    };

    /// A graph of blocks of an unknown type, which take any number of inputs.
    fn graph(count: usize) -> (Graph, Vec<BlockId>) {
        let mut graph = Graph::new(Registry::builtin());
        let blocks = (0..count).map(|number| {
            graph.insert(Block {
                id: number.to_string(),
                type_id: "unknown".into(),
                spec: None,
                origin: None,
                seed: None,
                values: Vec::new(),
                inputs: Vec::new(),
                extra_attributes: Vec::new(),
                extra_parameters: Vec::new(),
            })
        });
        let blocks = blocks.collect();
        (graph, blocks)
    }

    fn source(block: BlockId) -> Source {
        Source { block, output: 0 }
    }

    #[test]
    fn agrees_with_connecting_one_by_one() {
        for round in 0..40 {
            let (mut one_by_one, blocks) = graph(14);
            let (mut at_once, _) = graph(14);
            let mut connector = Connector::new(&mut at_once, 9);
            let mut draws = Draws::from_index(round * 1000);
            let mut pick = |count: f64| {
                usize::try_from(truncate64(draws.next_noise().abs() * count)).unwrap().min(13)
            };
            for _ in 0..120 {
                let (from, to) = (blocks[pick(14.0)], blocks[pick(14.0)]);
                let input = u32::try_from(pick(3.0)).unwrap();
                let expected = one_by_one.connect_unchecked_kinds(source(from), to, input);
                assert_eq!(connector.connect(source(from), to, input), expected);
            }
            let connections = |graph: &Graph| graph.connections().collect::<Vec<_>>();
            assert_eq!(connections(connector.graph()), connections(&one_by_one));
        }
    }

    #[test]
    fn existing_connections_count() {
        let (mut graph, blocks) = graph(3);
        graph.connect_unchecked_kinds(source(blocks[0]), blocks[1], 0).unwrap();
        graph.connect_unchecked_kinds(source(blocks[1]), blocks[2], 0).unwrap();
        let mut connector = Connector::new(&mut graph, 1);
        let error = connector.connect(source(blocks[2]), blocks[0], 0).unwrap_err();
        assert_eq!(error.kind(), ErrorKind::Cycle);
        let error = connector.connect(source(blocks[1]), blocks[1], 0).unwrap_err();
        assert_eq!(error.kind(), ErrorKind::Cycle);
    }

    #[test]
    fn a_long_chain_made_from_its_end_is_no_cycle_until_it_is_closed() {
        let (mut graph, blocks) = graph(3000);
        let mut connector = Connector::new(&mut graph, 3000);
        for pair in blocks.windows(2).rev() {
            connector.connect(source(pair[0]), pair[1], 0).unwrap();
        }
        let (first, last) = (blocks[0], *blocks.last().unwrap());
        assert!(connector.connect(source(last), first, 0).is_err());
        connector.connect(source(first), last, 1).unwrap();
    }
}
