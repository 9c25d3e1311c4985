//! Bytes that the library made: saved graphs, texts.

use std::ffi::c_void;

use super::{
    argument::Size,
    handle::{Handle, Opaque, tag},
};

/// Bytes that the library made. They have one owner and any thread may read them.
#[derive(Debug)]
pub struct ptl_bytes {
    _opaque: [u8; 0],
}

impl Opaque for ptl_bytes {
    type Object = BytesObject;
    const TAG: u32 = tag(b'b');
    const NAME: &'static str = "ptl_bytes";
}

/// The bytes of a text and a NUL, so that C can take them as a string.
#[derive(Debug)]
pub(super) struct BytesObject(Vec<u8>);

impl BytesObject {
    pub(super) fn of(text: &str) -> Self {
        Self(text.bytes().chain([0]).collect())
    }
}

/// The bytes. They are followed by a NUL that does not count. `size` may be NULL. NULL and
/// size 0 for NULL.
///
/// Ownership: they live as long as `bytes`.
/// Threads:   any.
/// Since:     0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn ptl_bytes_data(
    bytes: *const ptl_bytes,
    size: *mut usize,
) -> *const c_void {
    pt_fn!(else std::ptr::null(); bytes: Handle<ptl_bytes>, size: Size => {
        size.set(bytes.0.len().saturating_sub(1));
        bytes.0.as_ptr().cast()
    })
}

/// Frees bytes; NULL is fine.
///
/// Threads: any.
/// Since:   0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn ptl_bytes_release(bytes: *mut ptl_bytes) {
    // SAFETY: the caller gives up its only reference.
    pt_fn!(else (); bytes: Handle<ptl_bytes> => drop(unsafe { bytes.take() }));
}
