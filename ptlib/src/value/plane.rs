//! One channel of an image, and the pool that recycles the memory of planes.

use std::{
    fmt,
    sync::{Arc, Mutex, PoisonError, Weak},
};

use crate::error::{Error, ErrorKind};

/// Planes start at multiples of this many bytes: a cache line, and the widest SIMD register.
const ALIGNMENT: usize = 64;

/// Extra elements of an allocation, so that an aligned start is always inside.
const PADDING: usize = ALIGNMENT / size_of::<f32>() - 1;

/// W × H numbers, row by row, 64-byte aligned. Its memory returns to the pool it came from.
pub struct Plane {
    buffer: Memory,
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

/// What a plane lies in.
#[derive(Debug)]
enum Memory {
    Heap(Box<[f32]>),
    /// Pages of their own, which may be large ones. Fresh memory costs a page fault per page:
    /// with pages of 4 KiB that is a third of the time that a graph takes when it is computed for
    /// the first time.
    #[cfg(target_os = "linux")]
    Pages(memmap2::MmapMut),
}

/// The least bytes for which large pages, of 2 MiB, are worth while.
#[cfg(target_os = "linux")]
const LARGE: usize = 4 << 20;

impl Memory {
    /// Zeros; `None` if the system has no memory for them.
    fn zeros(len: usize) -> Option<Self> {
        #[cfg(target_os = "linux")]
        if let Some(bytes) = len.checked_mul(size_of::<f32>()).filter(|bytes| *bytes >= LARGE) {
            let pages = memmap2::MmapMut::map_anon(bytes).ok()?;
            // A system without large pages refuses; then they are small ones.
            let _ = pages.advise(memmap2::Advice::HugePage);
            return Some(Self::Pages(pages));
        }
        bytemuck::try_zeroed_slice_box(len).ok().map(Self::Heap)
    }

    #[inline]
    fn numbers(&self) -> &[f32] {
        match self {
            Self::Heap(numbers) => numbers,
            #[cfg(target_os = "linux")]
            Self::Pages(pages) => bytemuck::cast_slice(pages),
        }
    }

    #[inline]
    fn numbers_mut(&mut self) -> &mut [f32] {
        match self {
            Self::Heap(numbers) => numbers,
            #[cfg(target_os = "linux")]
            Self::Pages(pages) => bytemuck::cast_slice_mut(pages),
        }
    }
}

impl Default for Memory {
    fn default() -> Self {
        Self::Heap(Box::default())
    }
}

/// Memory of planes that are no longer used, kept for the next ones: fresh memory costs more than
/// most blocks cost.
#[derive(Debug, Default)]
pub struct BufferPool {
    free: Mutex<Vec<Memory>>,
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
        let wanted = len + PADDING;
        let recycled = {
            let mut free = self.free.lock().unwrap_or_else(PoisonError::into_inner);
            free.iter()
                .position(|buffer| buffer.numbers().len() == wanted)
                .map(|i| free.swap_remove(i))
        };
        let buffer = match recycled {
            Some(buffer) => buffer,
            None => Memory::zeros(wanted).ok_or_else(|| {
                let bytes = wanted as u64 * size_of::<f32>() as u64;
                Error::new(ErrorKind::NoMemory, format!("the system has no {bytes} bytes left"))
            })?,
        };
        let start = buffer.numbers().as_ptr().align_offset(ALIGNMENT);
        let mut plane = Plane { buffer, start, len, pool: Arc::downgrade(self) };
        if cfg!(debug_assertions) {
            plane.data_mut().fill(f32::NAN);
        }
        Ok(plane)
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

    fn give_back(&self, buffer: Memory) {
        self.free.lock().unwrap_or_else(PoisonError::into_inner).push(buffer);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

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
