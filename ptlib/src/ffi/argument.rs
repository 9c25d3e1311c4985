//! Arguments: from what C gives to what Rust can trust.
//!
//! Each kind of argument is a type here whose [`Argument::receive`] checks everything that can be
//! checked and names the argument in its error. `pt_fn!` calls it for every pointer of an
//! exported function.

use std::{
    ffi::{CStr, c_char, c_void},
    marker::PhantomData,
};

use crate::error::{Error, ErrorKind};

/// A kind of argument, made from one or two C values.
pub(super) trait Argument<Raw>: Sized {
    /// Checks the argument called `name`.
    ///
    /// # Safety
    /// `raw` is NULL, or points to what the header says for as long as the result is used.
    unsafe fn receive(raw: Raw, name: &'static str) -> Result<Self, Error>;
}

/// The error for a NULL that is not allowed.
pub(super) fn null(name: &str) -> Error {
    Error::new(ErrorKind::InvalidArgument, format!("`{name}` is NULL"))
}

fn misaligned(name: &str) -> Error {
    Error::new(ErrorKind::InvalidArgument, format!("`{name}` is not aligned for its type"))
}

impl Argument<*const c_char> for &str {
    unsafe fn receive(raw: *const c_char, name: &'static str) -> Result<Self, Error> {
        if raw.is_null() {
            return Err(null(name));
        }
        // SAFETY: not null, and NUL-terminated (the caller's promise).
        let text = unsafe { CStr::from_ptr(raw) };
        text.to_str().map_err(|error| {
            let message = format!("`{name}` is not UTF-8 from byte {}", error.valid_up_to());
            Error::new(ErrorKind::InvalidArgument, message)
        })
    }
}

impl Argument<*const c_char> for Option<&str> {
    unsafe fn receive(raw: *const c_char, name: &'static str) -> Result<Self, Error> {
        if raw.is_null() {
            return Ok(None);
        }
        // SAFETY: the same promise.
        unsafe { <&str as Argument<_>>::receive(raw, name) }.map(Some)
    }
}

/// Where a result goes.
#[derive(Debug)]
pub(super) struct Out<'a, T>(*mut T, PhantomData<&'a mut T>);

impl<T> Out<'_, T> {
    /// Writes the result.
    pub(super) fn set(mut self, value: T) {
        self.put(value);
    }

    pub(super) fn put(&mut self, value: T) {
        // SAFETY: not null and aligned (checked when received), and the caller's to write. What is
        // there may be uninitialised: it is overwritten, not dropped.
        unsafe { self.0.write(value) };
    }
}

impl<T> Argument<*mut T> for Out<'_, T> {
    unsafe fn receive(raw: *mut T, name: &'static str) -> Result<Self, Error> {
        if raw.is_null() {
            return Err(null(name));
        }
        if !raw.is_aligned() {
            return Err(misaligned(name));
        }
        Ok(Self(raw, PhantomData))
    }
}

impl<T> Argument<*mut T> for Option<Out<'_, T>> {
    unsafe fn receive(raw: *mut T, name: &'static str) -> Result<Self, Error> {
        if raw.is_null() {
            return Ok(None);
        }
        // SAFETY: the same promise.
        unsafe { <Out<'_, T> as Argument<_>>::receive(raw, name) }.map(Some)
    }
}

/// Where the size of a result goes, if the caller wants it. It is 0 until [`set`](Self::set), so
/// also after an error.
#[derive(Debug)]
pub(super) struct Size<'a>(Option<Out<'a, usize>>);

impl Size<'_> {
    /// Writes the size.
    pub(super) fn set(self, size: usize) {
        if let Some(out) = self.0 {
            out.set(size);
        }
    }
}

impl Argument<*mut usize> for Size<'_> {
    unsafe fn receive(raw: *mut usize, name: &'static str) -> Result<Self, Error> {
        // SAFETY: the same promise.
        let mut out = unsafe { <Option<Out<'_, usize>> as Argument<_>>::receive(raw, name) }?;
        if let Some(out) = &mut out {
            out.put(0);
        }
        Ok(Self(out))
    }
}

impl<T> Argument<(*const T, usize)> for &[T] {
    unsafe fn receive((raw, count): (*const T, usize), name: &'static str) -> Result<Self, Error> {
        if count == 0 {
            return Ok(&[]);
        }
        check_array(raw, count, name)?;
        // SAFETY: not null, aligned, no longer than an object can be (all checked above), and
        // `count` initialised values that nobody writes meanwhile (the caller's promise).
        Ok(unsafe { std::slice::from_raw_parts(raw, count) })
    }
}

impl<T> Argument<(*mut T, usize)> for &mut [T] {
    unsafe fn receive((raw, count): (*mut T, usize), name: &'static str) -> Result<Self, Error> {
        if count == 0 {
            return Ok(&mut []);
        }
        check_array(raw, count, name)?;
        // SAFETY: not null, aligned, no longer than an object can be (all checked above), and the
        // caller's `count` values that nobody else uses meanwhile (the caller's promise).
        Ok(unsafe { std::slice::from_raw_parts_mut(raw, count) })
    }
}

fn check_array<T>(raw: *const T, count: usize, name: &str) -> Result<(), Error> {
    if raw.is_null() {
        return Err(null(name));
    }
    if !raw.is_aligned() {
        return Err(misaligned(name));
    }
    let bytes = count.checked_mul(size_of::<T>());
    if bytes.is_none_or(|bytes| isize::try_from(bytes).is_err()) {
        let message = format!("`{name}` has {count} elements, more than memory can hold");
        return Err(Error::new(ErrorKind::InvalidArgument, message));
    }
    Ok(())
}

/// Bytes that C gives as `const void *` and a size.
impl Argument<(*const c_void, usize)> for &[u8] {
    unsafe fn receive(
        (raw, size): (*const c_void, usize),
        name: &'static str,
    ) -> Result<Self, Error> {
        // SAFETY: the same promise.
        unsafe { <Self as Argument<(*const u8, usize)>>::receive((raw.cast(), size), name) }
    }
}

/// Bytes that C gives as `void *` and a size, to be written.
impl Argument<(*mut c_void, usize)> for &mut [u8] {
    unsafe fn receive(
        (raw, size): (*mut c_void, usize),
        name: &'static str,
    ) -> Result<Self, Error> {
        // SAFETY: the same promise.
        unsafe { <Self as Argument<(*mut u8, usize)>>::receive((raw.cast(), size), name) }
    }
}

/// A list of strings.
#[derive(Debug, Default)]
pub(super) struct Texts<'a>(pub(super) Vec<&'a str>);

impl Argument<(*const *const c_char, usize)> for Texts<'_> {
    unsafe fn receive(
        raw: (*const *const c_char, usize),
        name: &'static str,
    ) -> Result<Self, Error> {
        // SAFETY: the same promise.
        let texts = unsafe { <&[*const c_char] as Argument<_>>::receive(raw, name) }?;
        let texts = texts.iter().map(|&text| {
            // SAFETY: the same promise, which holds for each string of the list.
            unsafe { <&str as Argument<_>>::receive(text, name) }
        });
        texts.collect::<Result<_, _>>().map(Self)
    }
}
