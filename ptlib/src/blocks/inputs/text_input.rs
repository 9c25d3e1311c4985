//! A text that the caller of the graph gives.
//!
//! A program passes on what its user typed: the string of an L-system for `turtle`, for example.
//! Until the caller sets a value, that of the input `default` counts; it is not computed when there
//! is one. A value is not stored in the graph's file, the name is.

use crate::block::prelude::*;

const DEFAULT: usize = 0;

params! {
    /// Parameters of [`BLOCK`].
    Params {
        /// What the caller finds this input by. Of several of one name the first counts.
        name: text = "text";
    }
}

/// The block as everybody else sees it.
pub static BLOCK: BlockSpec = BlockSpec::whole::<TextInput>(About {
    id: "text input",
    summary: "A text that the caller of the graph gives.",
    inputs: &[input("default", Kind::Text).optional()],
    outputs: &[output("text", Planes::Grey).of_kind(Kind::Text)],
    role: Role::Input,
    ..About::DEFAULT
});

struct TextInput;

impl WholeBlock for TextInput {
    type Params = Params;

    fn compute<L: Levels>(_: &Params, cx: &WholeContext<'_>) -> Result<Vec<Value>, Error> {
        Ok(vec![cx.given_or(DEFAULT)?.clone()])
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::block::testing::Trial;

    #[test]
    fn gives_what_the_caller_set_or_else_the_default() {
        let trial = Trial::of(&BLOCK).input(DEFAULT, "D(10)".to_owned());
        assert_eq!(trial.text_and_warnings().unwrap().0, "D(10)");
        let trial = trial.given("R(90)".to_owned());
        assert_eq!(trial.text_and_warnings().unwrap().0, "R(90)");
        let error = Trial::of(&BLOCK).compute().unwrap_err();
        assert_eq!(error.kind(), ErrorKind::Unconnected);
    }
}
