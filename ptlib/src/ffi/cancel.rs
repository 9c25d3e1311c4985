//! Requests to stop.

use super::{
    handle::{Handle, NewHandle, Opaque, give, tag, tagged},
    ptl_error, ptl_status,
};
use crate::run::Cancel;

/// A request to stop computations, which any thread can make. It is reference counted.
#[derive(Debug)]
pub struct ptl_cancel {
    _opaque: [u8; 0],
}

impl Opaque for ptl_cancel {
    type Object = Cancel;
    const TAG: u32 = tag(b'c');
    const NAME: &'static str = "ptl_cancel";
}

/// Makes a request to stop that nobody has made yet. Give it to computations in their options.
///
/// Ownership: `out` receives one reference; release it with ptl_cancel_release().
/// Threads:   any.
/// Errors:    PTL_E_INVALID_ARGUMENT. On error `*out` is NULL.
/// Since:     0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn ptl_cancel_create(
    out: *mut *mut ptl_cancel,
    error: *mut *mut ptl_error,
) -> ptl_status {
    pt_fn!(error; out: NewHandle<ptl_cancel> => {
        out.set(tagged::<ptl_cancel>(Cancel::new()));
        Ok(())
    })
}

/// Asks every computation that was given this request to stop. It stays asked. NULL is fine.
///
/// Threads: any; it takes no lock and does not wait.
/// Since:   0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn ptl_cancel_request(cancel: *mut ptl_cancel) {
    pt_fn!(else (); cancel: Handle<ptl_cancel> => cancel.request());
}

/// Whether somebody asked, 1 or 0. 0 for NULL.
///
/// Threads: any; it takes no lock.
/// Since:   0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn ptl_cancel_is_requested(cancel: *const ptl_cancel) -> i32 {
    pt_fn!(else 0; cancel: Handle<ptl_cancel> => i32::from(cancel.is_requested()))
}

/// One more reference to the same request; NULL for NULL.
///
/// Ownership: release each reference with ptl_cancel_release().
/// Threads:   any.
/// Since:     0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn ptl_cancel_retain(cancel: *mut ptl_cancel) -> *mut ptl_cancel {
    pt_fn!(else std::ptr::null_mut(); cancel: Handle<ptl_cancel> => {
        // SAFETY: handles of this type are only made by `give`.
        give(unsafe { cancel.retain() })
    })
}

/// Gives up one reference; NULL is fine. Computations that were given the request go on.
///
/// Threads: any.
/// Since:   0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn ptl_cancel_release(cancel: *mut ptl_cancel) {
    // SAFETY: the caller gives up its reference.
    pt_fn!(else (); cancel: Handle<ptl_cancel> => drop(unsafe { cancel.take() }));
}
