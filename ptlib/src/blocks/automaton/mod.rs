//! Blocks that let the pixels of a picture live: cells that change with their neighbours.

crate::family!(
    "automaton": cellular_automaton_cyclic, cellular_automaton_general, cellular_automaton_rps
);

mod neighbourhood;
mod sliding;
