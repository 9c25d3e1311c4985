//! Calls the C ABI as a careless but lawful program would: any functions in any order, with live
//! handles of the wrong type, NULLs, stale blocks, strange numbers, texts, sizes and strides.
//!
//! Nothing here does what the header forbids: every handle is one reference in a table, gone from
//! it before it is released, and every pointer has the bytes that the call is told of. So each
//! crash, each answer that contradicts the header and each byte written elsewhere is a find.
#![no_main]

mod c_api {
    pub(crate) mod canvas;
    pub(crate) mod computing;
    pub(crate) mod editing;
    pub(crate) mod engines;
    pub(crate) mod input;
    pub(crate) mod looking;
    pub(crate) mod structs;
    pub(crate) mod tables;
}

use c_api::{input::Input, tables::Session};
use libfuzzer_sys::fuzz_target;

/// The most calls of one run: enough for every pair of them to meet, few enough to be fast.
const MAX_CALLS: usize = 200;

fuzz_target!(|bytes: &[u8]| {
    let mut session = Session::new(Input::new(bytes));
    session.create_engine();
    session.create_graph();
    for _ in 0..MAX_CALLS {
        if session.input.is_empty() {
            break;
        }
        match session.input.below(8) {
            0 => session.own(),
            1 | 2 => session.edit_blocks(),
            3 => session.edit_parameters(),
            4 => session.edit_settings(),
            5 => session.look(),
            6 => session.compute(),
            _ => session.use_results(),
        }
    }
});
