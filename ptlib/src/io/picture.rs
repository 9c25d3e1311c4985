//! Pictures: PNG and the other formats of the `image` crate.

use std::path::Path;

use crate::{
    error::{Error, ErrorKind},
    value::Image,
};

/// How many bits a channel of a saved picture has.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum BitDepth {
    /// 8 bits.
    #[default]
    Eight,
    /// 16 bits, where the format has them.
    Sixteen,
}

/// Saves a picture in the format that the file's name tells.
///
/// # Errors
/// [`ErrorKind::Unsupported`] for a format that this build has not, [`ErrorKind::Io`].
pub fn save_image(_image: &Image, _path: &Path, _depth: BitDepth) -> Result<(), Error> {
    Err(Error::new(ErrorKind::Unsupported, "not yet"))
}
