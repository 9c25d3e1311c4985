//! Blocks: what the registry, the files, the interfaces and the engine know of them.
//!
//! A block is one file in `blocks/<family>/`: an essay, its parameters, a static [`BlockSpec`] and
//! an implementation of one of three shapes:
//!
//! - [`PointBlock`]: a row of output from the same row of each input and the position. Any part of
//!   any row, in any order.
//! - [`GatherBlock`]: a row of output from whole inputs, read anywhere with wrap-around.
//! - [`WholeBlock`]: one call makes the whole output.
//!
//! Start reading at [`BlockSpec`], then [`prelude`], which is all that a block file sees.

mod context;
mod fit;
mod generations;
mod interpolation;
mod registry;
mod row;
mod shapes;
mod spec;
mod store;
mod sums;
#[cfg(test)]
pub(crate) mod testing;

pub mod prelude;

pub(crate) use context::PlaneCounts;
pub use context::{Context, Files, LogLevel, PrepareContext, Progress, RowContext, WholeContext};
pub use interpolation::Interpolation;
pub(crate) use registry::nearest;
pub use registry::{Family, PluginInfo, Registry};
pub use row::{InputRows, OutputRow, PortRow};
pub(crate) use row::{MAX_INPUTS, MAX_OUTPUT_PLANES};
pub use shapes::{GatherBlock, PointBlock, RowKernel, WholeBlock};
pub(crate) use shapes::{Implementation, RowFactory, WholeFactory};
pub use spec::{
    About, Access, BlockSpec, InputPort, OutputPort, Planes, Role, Shape, Tiling, input, output,
};
pub(crate) use store::Store;
