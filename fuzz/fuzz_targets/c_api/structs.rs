//! Structs of other versions: with sizes that are not the library's.

use super::input::Input;

/// Bytes of the place that structs are in.
const PLACE: usize = 1024;
/// What is behind a struct.
const GUARD: u8 = 0xa5;

/// A struct of the header in a place that is larger.
#[repr(C, align(16))]
pub(crate) struct Place {
    bytes: [u8; PLACE],
}

impl Place {
    /// A struct of any size to be filled in, behind which nothing may be written.
    pub(crate) fn to_fill(input: &mut Input<'_>, own: usize) -> (Self, usize) {
        let size = size(input, own);
        let mut bytes = [GUARD; PLACE];
        write_size(&mut bytes, size);
        (Self { bytes }, size)
    }

    /// A struct that the caller filled in, as another version may have it.
    ///
    /// # Safety
    /// `T` is a struct of the header.
    pub(crate) unsafe fn filled<T: Copy>(input: &mut Input<'_>, value: &T) -> Self {
        let mut bytes = [0; PLACE];
        let own = size_of::<T>();
        // SAFETY: structs of the header have no padding, and fit.
        unsafe {
            let from = std::ptr::from_ref(value).cast::<u8>();
            from.copy_to_nonoverlapping(bytes.as_mut_ptr(), own);
        }
        let size = if input.once_in(4) { size(input, own) } else { own };
        if size > own && input.once_in(2) {
            bytes[own] = 1;
        }
        write_size(&mut bytes, size);
        Self { bytes }
    }

    pub(crate) fn as_ptr<T>(&mut self) -> *mut T {
        self.bytes.as_mut_ptr().cast()
    }

    /// Checks that no more than `size` bytes were written, and whether that is all.
    pub(crate) fn check(&self, size: usize, own: usize, is_filled: bool) {
        let behind = if is_filled { size } else { size_of::<u32>() };
        assert!(behind <= PLACE, "a struct of {size} bytes was filled in");
        assert!(self.bytes[behind..].iter().all(|byte| *byte == GUARD), "written behind a struct");
        if is_filled && own < size {
            assert!(self.bytes[own..size].iter().all(|byte| *byte == 0), "unknown fields are 0");
        }
    }
}

/// What a program may have for a struct of `own` bytes, or has if it forgot.
fn size(input: &mut Input<'_>, own: usize) -> usize {
    match input.byte() {
        0..128 => own,
        128..160 => own + 8,
        160..192 => own - 8,
        // Versions differ by whole fields, of which none crosses a multiple of 8.
        192..224 => input.below(own) / 8 * 8,
        224..248 => PLACE,
        _ => input.of(&[0, 3, 4, 5, 5000, u32::MAX as usize]),
    }
}

fn write_size(bytes: &mut [u8; PLACE], size: usize) {
    bytes[..4].copy_from_slice(&(size as u32).to_ne_bytes());
}
