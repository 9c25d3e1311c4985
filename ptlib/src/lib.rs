//! ptlib: an engine for procedural textures that lives inside other programs.
//!
//! A texture is a [`Graph`] of blocks (noise, Voronoi, lighting, filters …), saved as a text file
//! of a few KB, and computed at any size when it is needed. An [`Engine`] computes it: on several
//! threads, with a cache, and with the same bits on every machine.
//!
//! The layers, each seeing only those before it: [`math`] → [`value`] → [`mod@params`] → [`block`]
//! → `blocks`; [`graph`] → [`run`]; `io`; [`plugin`]; [`ffi`] (the C ABI, on the public interface
//! of this crate only). `ARCHITECTURE.md` in the repository is the map.

pub mod block;
mod blocks;
pub mod error;
pub mod ffi;
pub mod graph;
pub mod io;
pub mod limits;
pub mod math;
pub mod params;
pub mod plugin;
pub mod run;
pub mod value;

pub use error::{Error, ErrorKind};
pub use graph::{BlockId, Graph};
pub use io::Reading;
pub use limits::Limits;
pub use math::levels::Precision;
pub use run::{Band, Bands, Cancel, ComputeOptions, Engine, EngineOptions, PixelsMut};
pub use value::{Format, Image, Pixels};
