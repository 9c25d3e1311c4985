//! Blocks that draw: words of a grammar, the turtle that follows them, particles.

crate::family!("drawing": l_system, particles, turtle);

mod canvas;
mod grammar;
mod swarm;
pub(in crate::blocks) mod walk;
