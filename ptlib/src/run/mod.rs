//! Computing graphs.
//!
//! [`Engine`] owns what computations share: the block types, the threads, the cache, recycled
//! memory, the file policy. What callers say to it is in `options`. A computation takes this way:
//!
//! 1. `nodes`: the blocks that the wanted outputs need, resolved.
//! 2. `plan`: what is stored, what is fused, in which order, and how much memory that takes.
//! 3. `execute`: stage after stage; `rows` runs a stage strip by strip, the store (`block::Store`)
//!    is at the end of each block, `sink` takes what is wanted.
//! 4. `monitor`: progress and cancelling; `threads`: the pool; `cache` and `key`: what is kept.

mod cache;
mod cancel;
mod engine;
mod execute;
mod files;
mod key;
mod log;
mod monitor;
mod nodes;
mod options;
mod plan;
mod rows;
mod sink;
#[cfg(test)]
mod tests;
mod threads;

pub use cancel::Cancel;
pub use engine::Engine;
pub use log::{LogFn, LogLevel};
pub use options::{
    Band, BandFn, Bands, ComputeOptions, EngineOptions, OutputShape, PixelsMut, ProgressFn,
    ProgressReport,
};
