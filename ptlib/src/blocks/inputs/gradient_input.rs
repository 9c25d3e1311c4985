//! A colour transition that the caller of the graph gives.
//!
//! A program offers its user a choice of colours for one graph, or animates them. Until the caller
//! sets a value, that of the input `default` counts; it is not computed when there is one. A value
//! is not stored in the graph's file, the name is.

use crate::block::prelude::*;

const DEFAULT: usize = 0;

params! {
    /// Parameters of [`BLOCK`].
    Params {
        /// What the caller finds this input by. Of several of one name the first counts.
        name: text = "gradient";
    }
}

/// The block as everybody else sees it.
pub static BLOCK: BlockSpec = BlockSpec::whole::<GradientInput>(About {
    id: "gradient input",
    summary: "A colour transition that the caller of the graph gives.",
    inputs: &[input("default", Kind::Gradient).optional()],
    outputs: &[output("gradient", Planes::Grey).of_kind(Kind::Gradient)],
    role: Role::Input,
    ..About::DEFAULT
});

struct GradientInput;

impl WholeBlock for GradientInput {
    type Params = Params;

    fn compute<L: Levels>(_: &Params, cx: &WholeContext<'_>) -> Result<Vec<Value>, Error> {
        Ok(vec![cx.given_or(DEFAULT)?.clone()])
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::block::testing::Trial;

    fn stop(grey: f32) -> Gradient {
        Gradient::new(vec![GradientStop { position: 0.5, color: [grey; 3] }])
    }

    #[test]
    fn gives_what_the_caller_set_or_else_the_default() {
        let trial = Trial::of(&BLOCK).input(DEFAULT, stop(0.25));
        let grey = |trial: &Trial| match trial.compute().unwrap().swap_remove(0) {
            Value::Gradient(gradient) => gradient.stops()[0].color[0],
            other => panic!("gives a {}", other.kind().name()),
        };
        assert_eq!(grey(&trial), 0.25);
        assert_eq!(grey(&trial.given(stop(0.75))), 0.75);
    }
}
