//! A head that the caller of the graph gives: its triangles are read where they lie.
//!
//! The library has a block of the same kind, `mesh input`; this one makes the family complete, and
//! a program that runs its graphs finds the head by its own name.

use ptlib_plugin::prelude::*;

params! {
    /// Parameters of [`MeshInput`].
    Params {
        /// What the caller finds this input by. Of several of one name the first counts.
        name: text = "head";
    }
}

/// A mesh that the caller of the graph gives.
#[derive(Debug)]
pub struct MeshInput;

impl GraphInput for MeshInput {
    type Params = Params;

    const ABOUT: About = About {
        id: c"aging.mesh input",
        name: c"Head",
        category: c"mesh",
        summary: c"A mesh that the caller of the graph gives.",
        inputs: &[&input(c"default", Kind::Mesh)
            .optional()
            .doc(c"What stands in for the mesh until the caller sets one.")],
        outputs: &[&output(c"mesh", Planes::Grey)
            .of_kind(Kind::Mesh)
            .doc(c"The mesh of the caller, not copied.")],
        ..About::DEFAULT
    };
}

#[cfg(test)]
mod tests {
    use ptlib::{ComputeOptions, value::Value};

    use crate::{mesh::testing::Sample, testing};

    #[test]
    fn the_value_of_the_caller_comes_out() {
        let engine = testing::engine();
        let mut graph = engine.new_graph();
        let [input, default] = [0, 1].map(|_| graph.add("aging.mesh input").unwrap());
        let compute =
            |graph: &ptlib::Graph| engine.compute_value(graph, input, 0, ComputeOptions::default());
        let error = compute(&graph).unwrap_err();
        assert!(error.hint().is_some_and(|hint| hint.contains("set_input")), "{error:?}");
        graph.connect(default, 0, input, 0).unwrap();
        let [first, second] = [1.0, 2.0]
            .map(|x| Sample { positions: vec![[x, 0.0, 0.0]; 3], ..Sample::default() }.value());
        graph.set_input(default, Some(first.clone())).unwrap();
        assert_eq!(compute(&graph).unwrap().content(), first.content());
        graph.set_input(input, Some(second.clone())).unwrap();
        let (Value::Mesh(found), Value::Mesh(given)) = (compute(&graph).unwrap(), second) else {
            panic!("another kind")
        };
        assert!(std::sync::Arc::ptr_eq(&found, &given));
    }
}
