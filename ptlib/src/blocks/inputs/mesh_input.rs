//! A mesh that the caller of the graph gives.
//!
//! A program passes on the triangles that the texture is for: they are read where they lie, not
//! copied, if the program asks for that. Until the caller sets a value, that of the input `default`
//! counts; it is not computed when there is one. A value is not stored in the graph's file, the
//! name is.

use crate::block::prelude::*;

const DEFAULT: usize = 0;

params! {
    /// Parameters of [`BLOCK`].
    Params {
        /// What the caller finds this input by. Of several of one name the first counts.
        name: text = "mesh";
    }
}

/// The block as everybody else sees it.
pub static BLOCK: BlockSpec = BlockSpec::whole::<MeshInput>(About {
    id: "mesh input",
    summary: "A mesh that the caller of the graph gives.",
    inputs: &[input("default", Kind::Mesh).optional()],
    outputs: &[output("mesh", Planes::Grey).of_kind(Kind::Mesh)],
    role: Role::Input,
    ..About::DEFAULT
});

struct MeshInput;

impl WholeBlock for MeshInput {
    type Params = Params;

    fn compute<L: Levels>(_: &Params, cx: &WholeContext<'_>) -> Result<Vec<Value>, Error> {
        Ok(vec![cx.given_or(DEFAULT)?.clone()])
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::block::testing::{self, Trial};

    #[test]
    fn gives_the_value_itself() {
        let [given, default] = [1.0, 2.0].map(testing::mesh);
        let trial = Trial::of(&BLOCK).input(DEFAULT, default.clone());
        let content = |trial: &Trial| trial.compute().unwrap()[0].content();
        assert_eq!(content(&trial), default.content());
        let trial = trial.given(given.clone());
        let (Value::Mesh(found), Value::Mesh(given)) =
            (trial.compute().unwrap().swap_remove(0), given)
        else {
            panic!("gives another kind")
        };
        assert!(Arc::ptr_eq(&found, &given));
    }
}
