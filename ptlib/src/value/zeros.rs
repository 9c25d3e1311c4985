//! Memory of zeros that costs little until it is used.

/// Large memory starts at multiples of this many bytes: a cache line, and the widest SIMD register.
pub(crate) const ALIGNMENT: usize = 64;

/// Extra numbers, so that an aligned start is always inside.
const PADDING: usize = ALIGNMENT / size_of::<f32>() - 1;

/// Numbers that are 0 at first.
#[derive(Debug)]
pub(crate) enum Zeros {
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

impl Zeros {
    /// How many numbers to ask for, if `len` of them have to start at a multiple of
    /// [`ALIGNMENT`].
    pub(crate) fn wanted(len: usize) -> usize {
        len.saturating_add(PADDING)
    }

    /// So many zeros; `None` if the system has no memory for them.
    pub(crate) fn new(len: usize) -> Option<Self> {
        #[cfg(target_os = "linux")]
        if let Some(bytes) = len.checked_mul(size_of::<f32>()).filter(|bytes| *bytes >= LARGE) {
            let pages = memmap2::MmapMut::map_anon(bytes).ok()?;
            // A system without large pages refuses; then they are small ones.
            let _ = pages.advise(memmap2::Advice::HugePage);
            return Some(Self::Pages(pages));
        }
        bytemuck::try_zeroed_slice_box(len).ok().map(Self::Heap)
    }

    /// The number of the first one that lies at a multiple of [`ALIGNMENT`].
    pub(crate) fn aligned_start(&self) -> usize {
        self.numbers().as_ptr().align_offset(ALIGNMENT)
    }

    #[inline]
    pub(crate) fn numbers(&self) -> &[f32] {
        match self {
            Self::Heap(numbers) => numbers,
            #[cfg(target_os = "linux")]
            Self::Pages(pages) => bytemuck::cast_slice(pages),
        }
    }

    #[inline]
    pub(crate) fn numbers_mut(&mut self) -> &mut [f32] {
        match self {
            Self::Heap(numbers) => numbers,
            #[cfg(target_os = "linux")]
            Self::Pages(pages) => bytemuck::cast_slice_mut(pages),
        }
    }
}

impl Default for Zeros {
    fn default() -> Self {
        Self::Heap(Box::default())
    }
}
