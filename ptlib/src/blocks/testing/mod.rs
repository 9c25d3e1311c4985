//! Blocks that have one of everything, or misbehave on purpose: for the tests of programs that
//! embed the library. No shipped build has them: they need the feature `test-blocks`.

crate::family!("testing": panicking, parameters, slow);
