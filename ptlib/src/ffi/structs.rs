//! Structs of other versions: every struct of the header starts with the size that its program was
//! built with, and grows at its end only.
//!
//! A program that is older than the library gives a smaller struct: the missing fields are 0,
//! which means "as before" for each of them. A newer program gives a larger one: that works as
//! long as it does not use what this library does not know.

use std::{ffi::c_void, marker::PhantomData, mem::MaybeUninit};

use super::argument::{Argument, null};
use crate::error::{Error, ErrorKind};

/// Larger sizes are taken for uninitialised memory.
const MAX_STRUCT_SIZE: usize = 4096;

/// The field that every struct starts with.
const SIZE_FIELD: usize = size_of::<u32>();

/// A struct of the header.
///
/// # Safety
/// It is `repr(C)`, starts with `struct_size: u32`, has no padding, and all zeros are a value of
/// it.
pub(super) unsafe trait CStruct: Copy {
    /// The struct's name in messages.
    const NAME: &'static str;
}

fn zeroed<T: CStruct>() -> T {
    // SAFETY: all zeros are a value of a `CStruct`.
    unsafe { MaybeUninit::zeroed().assume_init() }
}

/// The caller's `struct_size`, checked.
///
/// # Safety
/// `raw` is NULL or points to a struct of the size in its first field.
unsafe fn struct_size<T: CStruct>(raw: *const T, name: &str) -> Result<usize, Error> {
    let first = raw.cast::<u32>();
    if first.is_null() {
        return Err(null(name));
    }
    if !first.is_aligned() {
        let message = format!("`{name}` is not aligned for its type");
        return Err(Error::new(ErrorKind::InvalidArgument, message));
    }
    // SAFETY: not null, aligned, and every struct starts with this field.
    let size = unsafe { first.read() } as usize;
    if !(SIZE_FIELD..=MAX_STRUCT_SIZE).contains(&size) {
        let (wanted, t) = (size_of::<T>(), T::NAME);
        let message = format!("`{name}` has struct_size {size}, but a {t} has {wanted}");
        return Err(Error::new(ErrorKind::InvalidArgument, message)
            .with_hint("was it initialised with its _init function?"));
    }
    Ok(size)
}

/// A struct that the caller gives; NULL is one of zeros.
#[derive(Debug)]
pub(super) struct In<T>(pub(super) T);

impl<T: CStruct> Argument<*const T> for In<T> {
    unsafe fn receive(raw: *const T, name: &'static str) -> Result<Self, Error> {
        let mut known = zeroed::<T>();
        if raw.is_null() {
            return Ok(Self(known));
        }
        // SAFETY: the same promise.
        let size = unsafe { struct_size(raw, name) }?;
        let shared = size.min(size_of::<T>());
        // SAFETY: both have `shared` bytes, and `known` is ours, so they do not overlap. Every
        // prefix of the caller's values followed by zeros is a value of a `CStruct`.
        unsafe { raw.cast::<u8>().copy_to_nonoverlapping((&raw mut known).cast::<u8>(), shared) };
        for place in shared..size {
            // SAFETY: inside the caller's struct, which has `size` bytes.
            let byte = unsafe { raw.cast::<u8>().add(place).read() };
            if byte != 0 {
                let message = format!(
                    "`{name}` has struct_size {size} and uses what this version does not know: \
                     byte {place} is not 0"
                );
                return Err(Error::new(ErrorKind::Unsupported, message)
                    .with_hint("the program was built for a newer version of ptlib"));
            }
        }
        Ok(Self(known))
    }
}

/// A struct of the caller to be filled in: as much of it as both sides know.
#[derive(Debug)]
pub(super) struct InOut<'a, T> {
    raw: *mut T,
    size: usize,
    caller: PhantomData<&'a mut T>,
}

impl<T: CStruct> InOut<'_, T> {
    /// Fills the struct in; its `struct_size` stays, what this version does not know becomes 0.
    pub(super) fn set(self, value: &T) {
        let from = std::ptr::from_ref(value).cast::<u8>();
        let to = self.raw.cast::<u8>();
        let shared = self.size.min(size_of::<T>());
        // SAFETY: inside both structs, as `shared` is at least the size field; `value` is ours, so
        // they do not overlap.
        unsafe {
            from.add(SIZE_FIELD).copy_to_nonoverlapping(to.add(SIZE_FIELD), shared - SIZE_FIELD);
        }
        // SAFETY: the rest of the caller's struct, which has `size` bytes.
        unsafe { to.add(shared).write_bytes(0, self.size - shared) };
    }
}

impl<T: CStruct> Argument<*mut T> for InOut<'_, T> {
    unsafe fn receive(raw: *mut T, name: &'static str) -> Result<Self, Error> {
        // SAFETY: the same promise.
        let size = unsafe { struct_size(raw.cast_const(), name) }?;
        Ok(Self { raw, size, caller: PhantomData })
    }
}

impl<T: CStruct> Argument<*mut T> for Option<InOut<'_, T>> {
    unsafe fn receive(raw: *mut T, name: &'static str) -> Result<Self, Error> {
        if raw.is_null() {
            return Ok(None);
        }
        // SAFETY: the same promise.
        unsafe { <InOut<'_, T> as Argument<_>>::receive(raw, name) }.map(Some)
    }
}

/// A struct to be initialised, of the size that the caller's program was built with.
#[derive(Debug)]
pub(super) struct Uninitialised<'a>(&'a mut [MaybeUninit<u8>]);

impl<T: CStruct> Argument<(*mut T, usize)> for Uninitialised<'_> {
    unsafe fn receive((raw, size): (*mut T, usize), name: &'static str) -> Result<Self, Error> {
        if !(SIZE_FIELD..=MAX_STRUCT_SIZE).contains(&size) {
            let message = format!("`{name}` cannot have {size} bytes");
            return Err(Error::new(ErrorKind::InvalidArgument, message));
        }
        // SAFETY: the caller promises `size` bytes to write; they need not be initialised.
        let bytes = unsafe {
            <&mut [MaybeUninit<u8>] as Argument<(*mut MaybeUninit<u8>, usize)>>::receive(
                (raw.cast::<c_void>().cast(), size),
                name,
            )
        }?;
        Ok(Self(bytes))
    }
}

impl Uninitialised<'_> {
    /// Makes all fields 0 and `struct_size` right.
    pub(super) fn init(self) {
        let size = u32::try_from(self.0.len()).unwrap_or_default().to_ne_bytes();
        let bytes = size.into_iter().chain(std::iter::repeat(0));
        for (target, byte) in self.0.iter_mut().zip(bytes) {
            target.write(byte);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[repr(C)]
    #[derive(Debug, Clone, Copy, PartialEq)]
    struct Old {
        struct_size: u32,
        a: u32,
    }

    #[repr(C)]
    #[derive(Debug, Clone, Copy, PartialEq)]
    struct New {
        struct_size: u32,
        a: u32,
        b: u64,
    }

    // SAFETY: `repr(C)`, two numbers of one size, the first is the size.
    unsafe impl CStruct for Old {
        const NAME: &'static str = "Old";
    }

    // SAFETY: `repr(C)`, the numbers fill 16 bytes, the first is the size.
    unsafe impl CStruct for New {
        const NAME: &'static str = "New";
    }

    fn read<T: CStruct, U>(given: &U) -> Result<T, Error> {
        // SAFETY: both are structs that start with their size.
        unsafe { In::receive(std::ptr::from_ref(given).cast::<T>(), "options") }.map(|In(t)| t)
    }

    #[test]
    fn an_older_struct_has_zeros_behind_it() {
        let new: New = read(&Old { struct_size: 8, a: 5 }).unwrap();
        assert_eq!((new.a, new.b), (5, 0));
    }

    #[test]
    fn a_newer_struct_may_not_use_what_is_unknown() {
        let clean = New { struct_size: 16, a: 5, b: 0 };
        assert_eq!(read::<Old, _>(&clean).unwrap().a, 5);
        let error = read::<Old, _>(&New { b: 1 << 40, ..clean }).unwrap_err();
        assert_eq!(error.kind(), ErrorKind::Unsupported);
        assert!(error.message().contains("`options`"), "{error}");
    }

    #[test]
    fn an_uninitialised_struct_is_refused() {
        for struct_size in [0, 3, 0xffff_ffff] {
            let error = read::<Old, _>(&Old { struct_size, a: 0 }).unwrap_err();
            assert_eq!(error.kind(), ErrorKind::InvalidArgument, "{struct_size}");
        }
    }

    #[test]
    fn nothing_is_written_behind_an_older_struct() {
        let mut given = New { struct_size: 8, a: 0, b: 77 };
        // SAFETY: `given` is a struct that starts with its size.
        let out = unsafe { InOut::<New>::receive(&raw mut given, "info") }.unwrap();
        out.set(&New { struct_size: 0, a: 5, b: 6 });
        assert_eq!(given, New { struct_size: 8, a: 5, b: 77 });
    }

    #[test]
    fn a_newer_struct_is_filled_up_with_zeros() {
        let mut given = New { struct_size: 16, a: 1, b: 77 };
        // SAFETY: `given` is a struct that starts with its size.
        let out = unsafe { InOut::<Old>::receive((&raw mut given).cast(), "info") }.unwrap();
        out.set(&Old { struct_size: 0, a: 5 });
        assert_eq!(given, New { struct_size: 16, a: 5, b: 0 });
    }

    #[test]
    fn initialising_writes_as_much_as_the_caller_has() {
        let mut given = MaybeUninit::<[u8; 16]>::new([9; 16]);
        // SAFETY: `given` has 8 bytes and more.
        let out = unsafe { Uninitialised::receive((given.as_mut_ptr().cast::<New>(), 8), "x") };
        out.unwrap().init();
        // SAFETY: it was initialised as a whole, partly again.
        let bytes = unsafe { given.assume_init() };
        assert_eq!(bytes[..4], 8u32.to_ne_bytes());
        assert_eq!(bytes[4..], [0, 0, 0, 0, 9, 9, 9, 9, 9, 9, 9, 9]);
    }
}
