//! What is wrong with a graph.

use super::{BlockId, Graph, Origin, edit::name};
use crate::{
    block::BlockSpec,
    error::{Error, ErrorKind},
    value::Kind,
};

impl Graph {
    /// Whether `block` can be computed, as far as the graph alone tells: every type that it needs
    /// is known, every required input is connected, every connection is of the right kind.
    ///
    /// # Errors
    /// All faults in one error.
    pub fn validate(&self, block: BlockId) -> Result<(), Error> {
        self.block(block)?;
        let needed = self.needed_for(block);
        let faults = self
            .blocks()
            .filter(|(id, _)| needed[id.index as usize])
            .flat_map(|(id, _)| self.faults_of(id))
            .collect();
        Error::from_faults(faults).map_or(Ok(()), Err)
    }

    /// Per slot: whether computing `block` needs the block there. One walk: files of strangers
    /// hold thousands of blocks.
    fn needed_for(&self, block: BlockId) -> Vec<bool> {
        let mut needed = vec![false; self.data.slots.len()];
        let mut waiting = vec![block];
        while let Some(id) = waiting.pop() {
            if !std::mem::replace(&mut needed[id.index as usize], true)
                && let Ok(sources) = self.sources_of(id)
            {
                waiting.extend(sources);
            }
        }
        needed
    }

    /// What is wrong with a block and its inputs.
    pub(crate) fn faults_of(&self, id: BlockId) -> Vec<Error> {
        let spec = match self.known(id) {
            Ok(spec) => spec,
            Err(error) => return vec![error],
        };
        let Ok(block) = self.block(id) else { return vec![] };
        if self.given(id).is_some() {
            return vec![];
        }
        let mut faults: Vec<Error> = self.missing_value(id).into_iter().collect();
        for (number, (port, source)) in (0..).zip(spec.about.inputs.iter().zip(&block.inputs)) {
            match source {
                // A source of unknown type tells that itself; those who go on in spite of it read
                // one white image there.
                Some(source)
                    if self.known(source.block).is_err()
                        && (source.output, port.kind) == (0, Kind::Image) => {}
                Some(source) => {
                    faults.extend(self.check_kinds(source.block, source.output, id, number).err());
                }
                None if !port.is_optional => {
                    let message = format!("input {number} (\"{}\") is not connected", port.id);
                    faults.push(self.at(id, Error::new(ErrorKind::Unconnected, message)));
                }
                None => {}
            }
        }
        faults
    }

    /// The type of a block.
    ///
    /// # Errors
    /// [`ErrorKind::StaleHandle`]; [`ErrorKind::NotFound`] if its type is unknown.
    pub fn known(&self, id: BlockId) -> Result<&'static BlockSpec, Error> {
        let block = self.block(id)?;
        match block.spec {
            Some(spec) => Ok(spec),
            None => {
                let known = self.registry.get(&block.type_id);
                let error = match (known, &block.origin) {
                    (Ok(_), _) => {
                        Error::new(ErrorKind::NotFound, "its type came after the graph was read")
                            .with_hint("read the graph again")
                    }
                    (Err(_), Some(origin)) => missing(origin),
                    (Err(error), None) => error,
                };
                Err(self.at(id, error))
            }
        }
    }

    /// Whether an output exists, an input exists, and they are of one kind.
    pub(super) fn check_kinds(
        &self,
        source: BlockId,
        output: u32,
        target: BlockId,
        input: u32,
    ) -> Result<(), Error> {
        let (from, to) = (self.known(source)?, self.known(target)?);
        let Some(gives) = from.about.outputs.get(output as usize) else {
            let count = from.about.outputs.len();
            let message = format!("has no output {output}, but {count} from 0 on");
            return Err(self.at(source, Error::new(ErrorKind::NotFound, message)));
        };
        let Some(takes) = to.about.inputs.get(input as usize) else {
            let count = to.about.inputs.len();
            let message = format!("has no input {input}, but {count} from 0 on");
            return Err(self.at(target, Error::new(ErrorKind::NotFound, message)));
        };
        if gives.kind != takes.kind {
            let message = format!(
                "input {input} (\"{}\") takes a value of kind {}, but {} gives one of kind {}",
                takes.id,
                takes.kind.name(),
                name(self.block(source)?),
                gives.kind.name()
            );
            return Err(self.at(target, Error::new(ErrorKind::TypeMismatch, message)));
        }
        Ok(())
    }
}

/// The error of a block whose plug-in is not there.
fn missing(origin: &Origin) -> Error {
    let message = format!(
        "its type comes from plug-in \"{}\" (version {}), which is not loaded",
        origin.plugin, origin.version
    );
    Error::new(ErrorKind::NotFound, message)
        .with_hint("`ptc plugins` shows where plug-ins are looked for")
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use super::*;
    use crate::{
        block::Registry,
        graph::{Block, Source},
    };

    #[test]
    fn a_block_of_unknown_type_is_named_once_and_only_where_it_is_needed() {
        let mut graph = Graph::new(Registry::builtin());
        let unknown = graph.insert(Block {
            id: "5".to_owned(),
            type_id: Arc::from("no such type"),
            spec: None,
            origin: None,
            seed: None,
            values: vec![],
            inputs: vec![],
            extra_attributes: vec![],
            extra_parameters: vec![],
        });
        let (invert, end) = (graph.add("invert").unwrap(), graph.add("end").unwrap());
        let source = Source { block: unknown, output: 0 };
        graph.connect_unchecked_kinds(source, invert, 0).unwrap();
        graph.connect(invert, 0, end, 0).unwrap();
        let other = graph.add("end").unwrap();
        let fault = graph.validate(end).unwrap_err();
        assert_eq!(fault.faults().count(), 1, "{fault}");
        assert_eq!(fault.place().block.as_deref(), Some("5"));
        assert_eq!(graph.validate(other).unwrap_err().kind(), ErrorKind::Unconnected);
    }
}
