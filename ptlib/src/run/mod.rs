//! Computing graphs.
//!
//! [`Engine`] owns what computations share: the block types, the threads, the cache, recycled
//! memory, the file policy.

mod cancel;
mod engine;

pub use cancel::Cancel;
pub use engine::{ComputeOptions, Engine, EngineOptions, OutputShape, ProgressFn, ProgressReport};
