//! The host, as plug-ins know it: one for the whole process.

use std::{
    ffi::{CStr, c_char, c_void},
    panic::{AssertUnwindSafe, catch_unwind},
    ptr,
};

use ptlib_plugin_abi::{PTLP_ABI_MAJOR, PTLP_ABI_MINOR, ptlp_host};

use super::services;
use crate::math::convert::count;

/// The host.
pub(super) fn host() -> *const ptlp_host {
    static HOST: Host = Host(ptlp_host {
        struct_size: count(size_of::<ptlp_host>()),
        abi_major: PTLP_ABI_MAJOR,
        abi_minor: PTLP_ABI_MINOR,
        flags: 0,
        name: c"ptlib".as_ptr(),
        version: concat!(env!("CARGO_PKG_VERSION"), "\0").as_ptr().cast::<c_char>(),
        data: ptr::null_mut(),
        get_extension: Some(get_extension),
    });
    &raw const HOST.0
}

struct Host(ptlp_host);

// SAFETY: nobody changes it, and its texts are constants.
unsafe impl Sync for Host {}

unsafe extern "C" fn get_extension(_: *const ptlp_host, id: *const c_char) -> *const c_void {
    if id.is_null() {
        return ptr::null();
    }
    // SAFETY: not NULL, and a text of the contract ends with NUL.
    services::find(unsafe { CStr::from_ptr(id) })
}

/// Runs what a plug-in asked for. A panic in it must not reach the plug-in: then `default` is the
/// answer.
pub(super) fn guarded<T>(default: T, run: impl FnOnce() -> T) -> T {
    catch_unwind(AssertUnwindSafe(run)).unwrap_or(default)
}
