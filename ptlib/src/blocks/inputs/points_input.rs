//! Points that the caller of the graph gives.
//!
//! A program passes on where it put its instances, each with more data in streams. Until the caller
//! sets a value, that of the input `default` counts; it is not computed when there is one. A value
//! is not stored in the graph's file, the name is.

use crate::block::prelude::*;

const DEFAULT: usize = 0;

params! {
    /// Parameters of [`BLOCK`].
    Params {
        /// What the caller finds this input by. Of several of one name the first counts.
        name: text = "points";
    }
}

/// The block as everybody else sees it.
pub static BLOCK: BlockSpec = BlockSpec::whole::<PointsInput>(About {
    id: "points input",
    summary: "Points that the caller of the graph gives.",
    inputs: &[input("default", Kind::Points).optional()],
    outputs: &[output("points", Planes::Grey).of_kind(Kind::Points)],
    role: Role::Input,
    ..About::DEFAULT
});

struct PointsInput;

impl WholeBlock for PointsInput {
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
        let [given, default] = [1.0, 2.0].map(testing::points);
        let trial = Trial::of(&BLOCK).input(DEFAULT, default.clone());
        let content = |trial: &Trial| trial.compute().unwrap()[0].content();
        assert_eq!(content(&trial), default.content());
        let trial = trial.given(given.clone());
        let (Value::Points(found), Value::Points(given)) =
            (trial.compute().unwrap().swap_remove(0), given)
        else {
            panic!("gives another kind")
        };
        assert!(Arc::ptr_eq(&found, &given));
    }
}
