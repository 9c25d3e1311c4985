//! Inputs of a graph: blocks whose values the caller sets.

use std::sync::Arc;

use super::{BlockId, Graph};
use crate::{
    block::Role,
    error::{Error, ErrorKind},
    params::ParamValue,
    value::{ContentHash, Value},
};

/// A value that the caller set.
#[derive(Debug)]
pub(crate) struct Given {
    pub(crate) value: Value,
    /// The hash of its content, taken once.
    pub(crate) content: ContentHash,
}

/// The parameter that an input of a graph is found by.
const NAME: &str = "name";

impl Graph {
    /// Sets the value of an input of the graph: a block of role [`Role::Input`]; `None` takes it
    /// back. Snapshots keep the value that they have. It is not saved with the graph.
    ///
    /// # Errors
    /// [`ErrorKind::StaleHandle`]; [`ErrorKind::NotFound`] if the block's type is unknown;
    /// [`ErrorKind::TypeMismatch`] if the block is no input, or gives values of another kind.
    pub fn set_input(&mut self, id: BlockId, value: Option<Value>) -> Result<(), Error> {
        let about = &self.known(id)?.about;
        let mismatch =
            |message: String| Err(self.at(id, Error::new(ErrorKind::TypeMismatch, message)));
        let Some(output) = about.outputs.first().filter(|_| about.role == Role::Input) else {
            return mismatch("is no input of the graph: its value cannot be set".into());
        };
        if let Some(value) = &value
            && value.kind() != output.kind
        {
            let (given, takes) = (value.kind().name(), output.kind.name());
            return mismatch(format!(
                "takes a value of kind {takes}, but one of kind {given} is given"
            ));
        }
        let given = value.map(|value| Arc::new(Given { content: value.content(), value }));
        Arc::make_mut(&mut self.data).slots[id.index as usize].given = given;
        Ok(())
    }

    /// The value that was set for an input of the graph.
    #[must_use]
    pub fn input_value(&self, id: BlockId) -> Option<&Value> {
        self.given(id).map(|given| &given.value)
    }

    pub(crate) fn given(&self, id: BlockId) -> Option<&Given> {
        let slot = self.data.slots.get(id.index as usize)?;
        slot.given.as_deref().filter(|_| slot.generation == id.generation)
    }

    /// The inputs of the graph and their names, in file order. Some may have no name.
    pub fn inputs(&self) -> impl Iterator<Item = (BlockId, &str)> {
        self.blocks().filter(|(_, block)| block.has_role(Role::Input)).map(|(id, block)| {
            let place = block.spec().and_then(|spec| spec.param(NAME));
            let name = match place.and_then(|(place, _)| block.values().get(place)) {
                Some(ParamValue::Text(name)) => &**name,
                _ => "",
            };
            (id, name)
        })
    }

    /// The first input of the graph, in file order, of that name.
    #[must_use]
    pub fn find_input(&self, name: &str) -> Option<BlockId> {
        self.inputs().find(|(_, other)| *other == name).map(|(id, _)| id)
    }

    /// The blocks whose outputs a block reads: none where the caller set a value instead.
    pub(crate) fn sources_of(&self, id: BlockId) -> Result<impl Iterator<Item = BlockId>, Error> {
        let inputs = if self.given(id).is_some() { &[] } else { self.block(id)?.inputs() };
        Ok(inputs.iter().flatten().map(|source| source.block))
    }

    /// That nobody set a value for an input of the graph, nor connected a default.
    pub(super) fn missing_value(&self, id: BlockId) -> Option<Error> {
        let block = self.block(id).ok().filter(|block| block.has_role(Role::Input))?;
        if self.given(id).is_some() || block.inputs().iter().any(Option::is_some) {
            return None;
        }
        let error = Error::new(ErrorKind::Unconnected, "is an input of the graph and has no value")
            .with_hint(
                "set one (Graph::set_input, ptl_graph_set_input(), `ptc render --input \
                 NAME=FILE`), or connect its default",
            );
        Some(self.at(id, error))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{block::Registry, value::Gradient};

    fn text(text: &str) -> Value {
        Value::from(text.to_owned())
    }

    #[test]
    fn an_input_is_found_by_its_name() {
        let mut graph = Graph::new(Registry::builtin());
        let (first, second) = (graph.add("text input").unwrap(), graph.add("mesh input").unwrap());
        graph.add("perlin noise").unwrap();
        let names: Vec<_> = graph.inputs().map(|(_, name)| name.to_owned()).collect();
        assert_eq!(names, ["text", "mesh"]);
        graph.set_text(second, "name", "text").unwrap();
        assert_eq!(graph.find_input("text"), Some(first));
        graph.set_text(first, "name", "tree").unwrap();
        assert_eq!(graph.find_input("text"), Some(second));
        assert_eq!(graph.find_input("mesh"), None);
    }

    #[test]
    fn values_are_of_the_right_kind_and_at_inputs_only() {
        let mut graph = Graph::new(Registry::builtin());
        let input = graph.add("text input").unwrap();
        let error = graph.set_input(input, Some(Gradient::default().into())).unwrap_err();
        assert_eq!(error.kind(), ErrorKind::TypeMismatch);
        assert!(error.message().contains("kind text, but one of kind gradient"), "{error}");
        let noise = graph.add("perlin noise").unwrap();
        let error = graph.set_input(noise, None).unwrap_err();
        assert_eq!(error.kind(), ErrorKind::TypeMismatch);
        graph.remove(input).unwrap();
        let error = graph.set_input(input, Some(text("F"))).unwrap_err();
        assert_eq!(error.kind(), ErrorKind::StaleHandle);
    }

    #[test]
    fn snapshots_keep_their_values_and_removed_blocks_do_not() {
        let mut graph = Graph::new(Registry::builtin());
        let input = graph.add("text input").unwrap();
        graph.set_input(input, Some(text("F"))).unwrap();
        let snapshot = graph.clone();
        graph.set_input(input, None).unwrap();
        assert!(graph.input_value(input).is_none());
        assert!(matches!(snapshot.input_value(input), Some(Value::Text(text)) if &**text == "F"));
        graph.set_input(input, Some(text("G"))).unwrap();
        graph.remove(input).unwrap();
        let next = graph.add("text input").unwrap();
        assert!(graph.input_value(input).is_none() && graph.input_value(next).is_none());
    }

    #[test]
    fn without_a_value_it_needs_a_default() {
        let mut graph = Graph::new(Registry::builtin());
        let (input, turtle) = (graph.add("text input").unwrap(), graph.add("turtle").unwrap());
        graph.connect(input, 0, turtle, 0).unwrap();
        let error = graph.validate(turtle).unwrap_err();
        assert_eq!(error.kind(), ErrorKind::Unconnected);
        assert!(error.hint().is_some_and(|hint| hint.contains("set_input")), "{error}");
        // The default itself is broken: a value makes that meaningless.
        let default = graph.add("text input").unwrap();
        graph.connect(default, 0, input, 0).unwrap();
        assert_eq!(graph.validate(turtle).unwrap_err().place().handle, Some(default.to_raw()));
        graph.set_input(input, Some(text("F"))).unwrap();
        graph.validate(turtle).unwrap();
    }
}
