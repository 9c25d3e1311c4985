//! Which files a graph may read and write.

use std::{
    path::{Path, PathBuf},
    sync::Arc,
};

use crate::{
    block::Files,
    error::{Error, ErrorKind},
    value::{BufferPool, Image},
};

/// The files that one graph may read and write.
#[derive(Debug, Clone)]
pub(crate) struct FileAccess {
    /// The folder of the graph's file; paths are relative to it and files below it may be read.
    pub(crate) folder: Option<PathBuf>,
    /// Further folders below which files may be read.
    pub(crate) read_folders: Vec<PathBuf>,
    /// Folders below which files may be written.
    pub(crate) write_folders: Vec<PathBuf>,
    /// The most bytes of a file to read.
    pub(crate) read_bytes: u64,
}

impl FileAccess {
    /// Where a path parameter of a block that writes leads to.
    pub(crate) fn resolve_write(&self, _path: &str) -> Result<PathBuf, Error> {
        Err(Error::new(ErrorKind::Unsupported, "not yet"))
    }
}

impl Files for FileAccess {
    fn read(&self, _path: &str) -> Result<Arc<[u8]>, Error> {
        Err(Error::new(ErrorKind::Unsupported, "not yet"))
    }

    fn read_image(&self, _path: &str, _pool: &Arc<BufferPool>) -> Result<Image, Error> {
        Err(Error::new(ErrorKind::Unsupported, "not yet"))
    }
}

/// The bytes of a regular file of at most `limit` bytes.
pub(crate) fn read_limited(_path: &Path, _limit: u64) -> Result<Vec<u8>, Error> {
    Err(Error::new(ErrorKind::Unsupported, "not yet"))
}
