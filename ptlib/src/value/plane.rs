//! One channel of an image, and the pool that recycles the memory of values.

use std::{
    fmt,
    sync::{Arc, Mutex, PoisonError, Weak},
};

use super::zeros::Zeros;
use crate::error::{Error, ErrorKind};

/// W × H numbers, row by row, 64-byte aligned. Its memory returns to the pool it came from.
pub struct Plane {
    buffer: Zeros,
    start: usize,
    len: usize,
    pool: Weak<BufferPool>,
}

impl Plane {
    /// All numbers, row by row from the top.
    #[inline]
    #[must_use]
    pub fn data(&self) -> &[f32] {
        &self.buffer.numbers()[self.start..self.start + self.len]
    }

    /// All numbers, to write.
    #[inline]
    pub fn data_mut(&mut self) -> &mut [f32] {
        &mut self.buffer.numbers_mut()[self.start..self.start + self.len]
    }
}

impl Drop for Plane {
    fn drop(&mut self) {
        if let Some(pool) = self.pool.upgrade() {
            pool.give_back(std::mem::take(&mut self.buffer));
        }
    }
}

impl fmt::Debug for Plane {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "Plane({} values)", self.len)
    }
}

/// Memory of values that are no longer used, kept for the next ones: fresh memory costs more than
/// most blocks cost.
#[derive(Debug, Default)]
pub struct BufferPool {
    free: Mutex<Vec<Zeros>>,
}

impl BufferPool {
    /// An empty pool.
    #[must_use]
    pub fn new() -> Arc<Self> {
        Arc::default()
    }

    /// A plane of `len` numbers. **Its contents are unspecified**: whoever takes it writes all of
    /// it. (Debug builds fill it with NaN, so that the laws notice when one does not.)
    ///
    /// # Errors
    /// [`ErrorKind::NoMemory`] if the system has no memory for it.
    pub fn plane(self: &Arc<Self>, len: usize) -> Result<Plane, Error> {
        let wanted = Zeros::wanted(len);
        let buffer = match self.take(wanted, wanted) {
            Some(buffer) => buffer,
            None => fresh(wanted)?,
        };
        let start = buffer.aligned_start();
        let mut plane = Plane { buffer, start, len, pool: Arc::downgrade(self) };
        if cfg!(debug_assertions) {
            plane.data_mut().fill(f32::NAN);
        }
        Ok(plane)
    }

    /// Memory for `len` numbers that are 0, from an aligned start on. There may be a quarter more.
    pub(super) fn zeros(&self, len: usize) -> Result<Zeros, Error> {
        let wanted = Zeros::wanted(len);
        let Some(mut buffer) = self.take(wanted, wanted.saturating_add(wanted / 4)) else {
            return fresh(wanted);
        };
        let start = buffer.aligned_start();
        buffer.numbers_mut()[start..start + len].fill(0.0);
        Ok(buffer)
    }

    /// The smallest memory that is free, of so many numbers at least and at most.
    fn take(&self, least: usize, most: usize) -> Option<Zeros> {
        let mut free = self.free.lock().unwrap_or_else(PoisonError::into_inner);
        let sizes = free.iter().map(|buffer| buffer.numbers().len()).enumerate();
        let fitting = sizes.filter(|(_, size)| (least..=most).contains(size));
        let (smallest, _) = fitting.min_by_key(|(_, size)| *size)?;
        Some(free.swap_remove(smallest))
    }

    /// Frees memory until at most `bytes` are kept.
    pub fn trim(&self, bytes: u64) {
        let mut free = self.free.lock().unwrap_or_else(PoisonError::into_inner);
        let mut kept = 0;
        free.retain(|buffer| {
            kept += size_of_val(buffer.numbers()) as u64;
            kept <= bytes
        });
    }

    pub(super) fn give_back(&self, buffer: Zeros) {
        self.free.lock().unwrap_or_else(PoisonError::into_inner).push(buffer);
    }
}

/// Zeros from the system.
fn fresh(wanted: usize) -> Result<Zeros, Error> {
    Zeros::new(wanted).ok_or_else(|| {
        let bytes = (wanted as u64).saturating_mul(size_of::<f32>() as u64);
        Error::new(ErrorKind::NoMemory, format!("the system has no {bytes} bytes left"))
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::value::zeros::ALIGNMENT;

    #[test]
    fn planes_are_aligned_and_recycled() {
        // The heap, and pages of their own.
        for len in [1000, 3 << 20] {
            let pool = BufferPool::new();
            let mut plane = pool.plane(len).unwrap();
            plane.data_mut().fill(1.0);
            assert_eq!(plane.data().len(), len);
            assert_eq!(plane.data().as_ptr() as usize % ALIGNMENT, 0);
            let address = plane.data().as_ptr();
            drop(plane);
            assert_eq!(pool.plane(len).unwrap().data().as_ptr(), address);
            pool.trim(0);
            assert!(pool.free.lock().unwrap().is_empty());
        }
    }

    #[test]
    fn planes_outlive_their_pool() {
        let pool = BufferPool::new();
        let plane = pool.plane(10).unwrap();
        drop(pool);
        assert_eq!(plane.data().len(), 10);
    }

    #[test]
    fn no_memory_is_an_error() {
        let error = BufferPool::new().plane(usize::MAX / 8).unwrap_err();
        assert_eq!(error.kind(), ErrorKind::NoMemory);
    }
}
