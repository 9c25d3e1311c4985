//! Strands that the caller of the graph gives.
//!
//! A program passes on polylines such as hairs, each with more data in streams. Until the caller
//! sets a value, that of the input `default` counts; it is not computed when there is one. A value
//! is not stored in the graph's file, the name is.

use crate::block::prelude::*;

const DEFAULT: usize = 0;

params! {
    /// Parameters of [`BLOCK`].
    Params {
        /// What the caller finds this input by. Of several of one name the first counts.
        name: text = "strands";
    }
}

/// The block as everybody else sees it.
pub static BLOCK: BlockSpec = BlockSpec::whole::<StrandsInput>(About {
    id: "strands input",
    summary: "Strands that the caller of the graph gives.",
    inputs: &[input("default", Kind::Strands).optional()],
    outputs: &[output("strands", Planes::Grey).of_kind(Kind::Strands)],
    role: Role::Input,
    ..About::DEFAULT
});

struct StrandsInput;

impl WholeBlock for StrandsInput {
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
        let [given, default] = [1.0, 2.0].map(testing::strands);
        let trial = Trial::of(&BLOCK).input(DEFAULT, default.clone());
        let content = |trial: &Trial| trial.compute().unwrap()[0].content();
        assert_eq!(content(&trial), default.content());
        let trial = trial.given(given.clone());
        let (Value::Strands(found), Value::Strands(given)) =
            (trial.compute().unwrap().swap_remove(0), given)
        else {
            panic!("gives another kind")
        };
        assert!(Arc::ptr_eq(&found, &given));
    }
}
