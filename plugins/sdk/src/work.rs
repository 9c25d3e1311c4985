//! What a block may ask of the host while it works.

use std::sync::{Mutex, PoisonError};

use crate::{BlockError, Plain, Scratch, job::Job};

/// What a block may ask of the host while it works.
#[derive(Debug, Clone, Copy)]
pub struct Work<'a> {
    pub(crate) job: Job<'a>,
}

impl<'a> Work<'a> {
    /// Goes on, or fails because the host asked to stop. Call it every millisecond of work.
    ///
    /// # Errors
    /// [`BlockError::cancelled`].
    pub fn check(&self) -> Result<(), BlockError> {
        if self.job.is_cancelled() { Err(BlockError::cancelled()) } else { Ok(()) }
    }

    /// Tells which part of the work is done, 0 to 1. Of use in blocks of shape Whole.
    pub fn report(&self, fraction: f64) {
        self.job.report(fraction);
    }

    /// Tells the user that something is not as its author meant it.
    pub fn warn(&self, message: &str) {
        self.job.warn(message);
    }

    /// Runs `task` for 0 to before `count` on all threads of the computation, in any order, and
    /// waits for all. After an error no further task starts.
    ///
    /// # Errors
    /// That of the task of the lowest number, or [`BlockError::cancelled`].
    pub fn parallel(
        &self,
        count: usize,
        task: impl Fn(usize) -> Result<(), BlockError> + Sync,
    ) -> Result<(), BlockError> {
        self.job.parallel(count, &task)
    }

    /// Runs `task` for each of `items` on all threads of the computation.
    ///
    /// # Errors
    /// As [`parallel`](Self::parallel).
    pub fn for_each<T: Send>(
        &self,
        items: impl IntoIterator<Item = T>,
        task: impl Fn(T) -> Result<(), BlockError> + Sync,
    ) -> Result<(), BlockError> {
        let items: Vec<_> = items.into_iter().map(|item| Mutex::new(Some(item))).collect();
        self.parallel(items.len(), |number| {
            // Each number is run once, so the lock is free.
            let item = items[number].lock().unwrap_or_else(PoisonError::into_inner).take();
            item.map_or(Ok(()), &task)
        })
    }

    /// Memory of zeros until the call ends, which counts against the limit of the host.
    ///
    /// # Errors
    /// If there is none, or the limit is reached.
    pub fn scratch<T: Plain>(&self, len: usize) -> Result<Scratch<'a, T>, BlockError> {
        Scratch::new(self.job, len)
    }

    /// The bytes of the file that a path parameter names. Only in blocks of shape Whole.
    ///
    /// # Errors
    /// What the host says: the file is not there, or may not be read.
    pub fn read_file(&self, path: &str) -> Result<Vec<u8>, BlockError> {
        self.job.read_file(path)
    }

    /// Writes a file below a folder that the caller opened for that. Only in blocks of shape Whole.
    ///
    /// # Errors
    /// What the host says: it may not be written, or cannot.
    pub fn write_file(&self, path: &str, bytes: &[u8]) -> Result<(), BlockError> {
        self.job.write_file(path, bytes)
    }
}
