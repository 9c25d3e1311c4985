//! Memory of meshes, points and strands: 32-bit words, our own or somebody else's.

use std::{
    fmt,
    ops::Deref,
    sync::{Arc, Weak},
};

use super::{BufferPool, zeros::Zeros};
use crate::{
    error::{Error, ErrorKind},
    limits::Limits,
};

/// Words that do not change as long as this lives.
pub trait Memory: Send + Sync {
    /// The words.
    fn words(&self) -> &[u32];

    /// Whether they belong to somebody who waits to get them back: such values are not kept
    /// longer than they are used.
    fn is_borrowed(&self) -> bool;
}

/// Words that are shared and never change. Cloning copies none.
#[derive(Clone)]
pub struct Words(Arc<dyn Memory>);

impl Words {
    /// Words that somebody else keeps.
    #[must_use]
    pub fn new(memory: Arc<dyn Memory>) -> Self {
        Self(memory)
    }

    /// A copy of `words`.
    ///
    /// # Errors
    /// [`ErrorKind::NoMemory`].
    pub fn copy_of(words: &[u32]) -> Result<Self, Error> {
        let mut copy = WordsMut::zeroed(words.len())?;
        copy.words_mut().copy_from_slice(words);
        Ok(copy.freeze())
    }

    /// The same bits as floating-point numbers.
    #[must_use]
    pub fn floats(&self) -> &[f32] {
        bytemuck::cast_slice(self)
    }

    /// Whether the words belong to somebody who waits to get them back.
    #[must_use]
    pub fn is_borrowed(&self) -> bool {
        self.0.is_borrowed()
    }

    /// The memory in bytes.
    #[must_use]
    pub fn bytes(&self) -> u64 {
        size_of_val::<[u32]>(self) as u64
    }
}

impl Deref for Words {
    type Target = [u32];

    fn deref(&self) -> &[u32] {
        self.0.words()
    }
}

impl fmt::Debug for Words {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "Words({})", self.len())
    }
}

/// Words of our own, 64-byte aligned, while they are written.
pub struct WordsMut {
    zeros: Zeros,
    start: usize,
    len: usize,
    /// Where the memory goes afterwards.
    pool: Weak<BufferPool>,
}

/// Fewer words are not worth a pool: the heap is as fast.
const FEW: usize = 1 << 16;

impl WordsMut {
    /// `len` words of 0.
    ///
    /// # Errors
    /// [`ErrorKind::NoMemory`] if the system has no memory for them.
    pub fn zeroed(len: usize) -> Result<Self, Error> {
        Self::of_pool(len, &BufferPool::new())
    }

    /// The same with the memory of a pool, if they are many.
    ///
    /// # Errors
    /// As [`zeroed`](Self::zeroed).
    pub fn of_pool(len: usize, pool: &Arc<BufferPool>) -> Result<Self, Error> {
        let zeros = pool.zeros(len)?;
        let pool = if len < FEW { Weak::new() } else { Arc::downgrade(pool) };
        Ok(Self { start: zeros.aligned_start(), zeros, len, pool })
    }

    /// The words, to write.
    pub fn words_mut(&mut self) -> &mut [u32] {
        bytemuck::cast_slice_mut(self.floats_mut())
    }

    /// The same bits as floating-point numbers, to write.
    pub fn floats_mut(&mut self) -> &mut [f32] {
        &mut self.zeros.numbers_mut()[self.start..self.start + self.len]
    }

    /// The words, which never change from now on.
    #[must_use]
    pub fn freeze(self) -> Words {
        Words(Arc::new(self))
    }
}

impl Drop for WordsMut {
    fn drop(&mut self) {
        if let Some(pool) = self.pool.upgrade() {
            pool.give_back(std::mem::take(&mut self.zeros));
        }
    }
}

impl Memory for WordsMut {
    fn words(&self) -> &[u32] {
        bytemuck::cast_slice(&self.zeros.numbers()[self.start..self.start + self.len])
    }

    fn is_borrowed(&self) -> bool {
        false
    }
}

impl fmt::Debug for WordsMut {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "WordsMut({})", self.len)
    }
}

/// Whether `bytes` of new memory are within the limit, before any of it is allocated.
pub(crate) fn check_bytes(bytes: u64, limits: &Limits) -> Result<(), Error> {
    if bytes <= limits.memory_bytes {
        return Ok(());
    }
    let (allowed, mebibyte) = (limits.memory_bytes, 1 << 20);
    let (needed, allowed) = (bytes.div_ceil(mebibyte), allowed / mebibyte);
    let message = format!("the value takes {needed} MiB, allowed {allowed} MiB");
    Err(Error::new(ErrorKind::Limit, message))
}

#[cfg(test)]
mod tests {
    use super::{super::zeros::ALIGNMENT, *};

    #[test]
    fn new_words_are_zero_and_aligned() {
        let mut words = WordsMut::zeroed(100).unwrap();
        assert_eq!(words.words_mut(), [0; 100]);
        assert_eq!(words.words_mut().as_ptr() as usize % ALIGNMENT, 0);
        words.floats_mut()[3] = 1.0;
        let address = words.words_mut().as_ptr();
        let words = words.freeze();
        assert_eq!((words[3], words.floats()[3]), (1.0_f32.to_bits(), 1.0));
        assert_eq!(
            (words.as_ptr(), words.clone().as_ptr(), words.bytes()),
            (address, address, 400)
        );
        assert_eq!(WordsMut::zeroed(0).unwrap().freeze().len(), 0);
        // So many that they have pages of their own.
        let mut many = WordsMut::zeroed(5 << 20).unwrap();
        assert!(many.words_mut().iter().all(|word| *word == 0));
        assert_eq!(many.words_mut().as_ptr() as usize % ALIGNMENT, 0);
    }

    #[test]
    fn memory_of_a_pool_is_used_again_and_zero_again() {
        let pool = BufferPool::new();
        let mut words = WordsMut::of_pool(5 * FEW / 4, &pool).unwrap();
        words.words_mut().fill(7);
        let address = words.words_mut().as_ptr();
        drop(words.freeze());
        let mut fewer = WordsMut::of_pool(FEW + 100, &pool).unwrap();
        assert_eq!(fewer.words_mut().as_ptr(), address);
        assert!(fewer.words_mut().iter().all(|word| *word == 0));
        drop(fewer);
        assert_ne!(WordsMut::of_pool(2 * FEW, &pool).unwrap().words_mut().as_ptr(), address);
        drop(pool);
    }

    #[test]
    fn no_memory_is_an_error() {
        for len in [usize::MAX, usize::MAX / 8] {
            assert_eq!(WordsMut::zeroed(len).unwrap_err().kind(), ErrorKind::NoMemory);
        }
        let limits = Limits { memory_bytes: 1 << 20, ..Limits::default() };
        check_bytes(1 << 20, &limits).unwrap();
        let error = check_bytes((1 << 20) + 1, &limits).unwrap_err();
        assert_eq!(error.to_string(), "the value takes 2 MiB, allowed 1 MiB");
    }
}
