//! What a plug-in gets to know the host by.

use std::ffi::{c_char, c_void};

use abi_stable::StableAbi;

/// The host. It lives as long as the process.
#[repr(C)]
#[derive(Debug, Clone, Copy, StableAbi)]
pub struct ptlp_host {
    /// Size of this struct in bytes.
    pub struct_size: u32,
    /// [`PTLP_ABI_MAJOR`](crate::PTLP_ABI_MAJOR) of the host.
    pub abi_major: u32,
    /// [`PTLP_ABI_MINOR`](crate::PTLP_ABI_MINOR) of the host.
    pub abi_minor: u32,
    /// 0.
    pub flags: u32,
    /// `ptlib`.
    pub name: *const c_char,
    /// Its version, such as `0.1.0`.
    pub version: *const c_char,
    /// For the host.
    pub data: *mut c_void,
    /// A table of [`services`](crate::services) by its id; NULL for an unknown one.
    pub get_extension:
        Option<unsafe extern "C" fn(host: *const ptlp_host, id: *const c_char) -> *const c_void>,
}

/// One call of `prepare` or `compute`. Its functions may be called from any thread, until the call
/// returns.
#[repr(C)]
#[derive(Debug, Clone, Copy, StableAbi)]
pub struct ptlp_job {
    /// Size of this struct in bytes.
    pub struct_size: u32,
    /// 0.
    pub flags: u32,
    /// For the host.
    pub data: *mut c_void,
    /// Whether to stop (1): nobody looks at the result any more. Ask it every millisecond of work,
    /// and return `PTLP_E_CANCELLED`.
    pub is_cancelled: Option<unsafe extern "C" fn(job: *const ptlp_job) -> i32>,
    /// Tells which part of the work is done, 0 to 1. Only of use in blocks of shape Whole.
    pub report: Option<unsafe extern "C" fn(job: *const ptlp_job, fraction: f64)>,
    /// Says what went wrong, in UTF-8, before a function returns an error. The first one counts.
    pub set_error: Option<unsafe extern "C" fn(job: *const ptlp_job, utf8: *const c_char)>,
    /// Tells the user that something is not as its author meant it, though the block goes on.
    pub warn: Option<unsafe extern "C" fn(job: *const ptlp_job, utf8: *const c_char)>,
}

// SAFETY: a host's table is made once and only read from then on.
unsafe impl Sync for ptlp_host {}
// SAFETY: the header says that a job may be used from any thread.
unsafe impl Sync for ptlp_job {}
