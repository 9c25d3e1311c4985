//! The files of one computation, each read once.

use std::{
    collections::BTreeMap,
    sync::{Arc, Mutex, PoisonError},
};

use crate::{
    block::Files,
    error::Error,
    io::FileAccess,
    value::{BufferPool, Image},
};

/// The files that a computation reads. Each is read once, so that the key of a result and the
/// result come from the same bytes even while somebody writes the file.
pub(super) struct GraphFiles {
    access: FileAccess,
    read: Mutex<BTreeMap<String, Arc<[u8]>>>,
}

impl GraphFiles {
    pub(super) fn new(access: FileAccess) -> Self {
        Self { access, read: Mutex::default() }
    }

    /// Which files may be touched.
    pub(super) fn access(&self) -> &FileAccess {
        &self.access
    }
}

impl Files for GraphFiles {
    fn read(&self, path: &str) -> Result<Arc<[u8]>, Error> {
        let mut read = self.read.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(bytes) = read.get(path) {
            return Ok(Arc::clone(bytes));
        }
        let bytes = self.access.read(path)?;
        read.insert(path.to_owned(), Arc::clone(&bytes));
        Ok(bytes)
    }

    fn read_image(&self, path: &str, pool: &Arc<BufferPool>) -> Result<Image, Error> {
        self.access.decode(path, &self.read(path)?, pool)
    }

    fn write(&self, path: &str, bytes: &[u8]) -> Result<(), Error> {
        self.access.write(path, bytes)
    }
}
