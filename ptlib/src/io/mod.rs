//! Files: graph files, pictures, and the policy that says which files may be touched.

mod picture;
mod policy;
mod xml;

pub use picture::{BitDepth, save_image};
pub(crate) use policy::{FileAccess, read_limited};
pub(crate) use xml::read_graph;
pub use xml::{Reading, write_graph};
