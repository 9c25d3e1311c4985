//! Memory for the time of a call, which the host counts against its limit.

use std::{
    marker::PhantomData,
    ops::{Deref, DerefMut},
    ptr::NonNull,
};

use ptlib_plugin_abi::services::{PTLP_SCRATCH, ptlp_scratch};

use crate::{BlockError, host, job::Job};

/// Numbers, and arrays of them: what memory of zeros can be.
///
/// # Safety
/// All bits make sense for it, it owns nothing, and it asks for no more than 64-byte alignment.
pub unsafe trait Plain: Copy + Send + Sync + 'static {}

// SAFETY: a number.
unsafe impl Plain for u8 {}
// SAFETY: a number.
unsafe impl Plain for u16 {}
// SAFETY: a number.
unsafe impl Plain for u32 {}
// SAFETY: a number.
unsafe impl Plain for u64 {}
// SAFETY: a number.
unsafe impl Plain for i32 {}
// SAFETY: a number.
unsafe impl Plain for i64 {}
// SAFETY: a number.
unsafe impl Plain for usize {}
// SAFETY: a number.
unsafe impl Plain for f32 {}
// SAFETY: a number.
unsafe impl Plain for f64 {}
// SAFETY: numbers.
unsafe impl<T: Plain, const N: usize> Plain for [T; N] {}

/// Memory for the time of a call: a slice that the host counts and frees.
#[derive(Debug)]
pub struct Scratch<'a, T: Plain> {
    job: Job<'a>,
    start: NonNull<T>,
    len: usize,
    elements: PhantomData<T>,
}

// SAFETY: it owns its memory, as a box does.
unsafe impl<T: Plain> Send for Scratch<'_, T> {}
// SAFETY: as above.
unsafe impl<T: Plain> Sync for Scratch<'_, T> {}

impl<'a, T: Plain> Scratch<'a, T> {
    pub(crate) fn new(job: Job<'a>, len: usize) -> Result<Self, BlockError> {
        let none = || BlockError::no_memory(format!("there is no memory for {len} numbers"));
        let bytes = len.checked_mul(size_of::<T>()).ok_or_else(none)?;
        let (start, len) = if bytes == 0 {
            (NonNull::dangling(), len)
        } else {
            let allocate = host::service::<ptlp_scratch>(PTLP_SCRATCH)
                .and_then(|table| table.allocate)
                .ok_or_else(|| BlockError::from("the host gives no memory"))?;
            // SAFETY: the contract.
            let start = unsafe { allocate(job.as_ptr(), bytes) };
            (NonNull::new(start.cast()).ok_or_else(none)?, len)
        };
        Ok(Self { job, start, len, elements: PhantomData })
    }
}

impl<T: Plain> Deref for Scratch<'_, T> {
    type Target = [T];

    fn deref(&self) -> &[T] {
        // SAFETY: that many elements, zeros at first, of this object alone.
        unsafe { std::slice::from_raw_parts(self.start.as_ptr(), self.len) }
    }
}

impl<T: Plain> DerefMut for Scratch<'_, T> {
    fn deref_mut(&mut self) -> &mut [T] {
        // SAFETY: as above, and `self` is borrowed by nobody else.
        unsafe { std::slice::from_raw_parts_mut(self.start.as_ptr(), self.len) }
    }
}

impl<T: Plain> Drop for Scratch<'_, T> {
    fn drop(&mut self) {
        let release = host::service::<ptlp_scratch>(PTLP_SCRATCH).and_then(|table| table.release);
        if let Some(release) = release
            && self.len * size_of::<T>() > 0
        {
            // SAFETY: `allocate` gave it, once.
            unsafe { release(self.job.as_ptr(), self.start.as_ptr().cast()) };
        }
    }
}
