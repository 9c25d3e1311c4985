//! The host and its services.

use std::{
    ffi::{CStr, CString},
    ptr,
    sync::atomic::{AtomicPtr, Ordering},
};

use ptlib_plugin_abi::{
    ptlp_host,
    services::{PTLP_LOG, ptlp_log},
};

/// The host, from the first call on. There is one in a process.
static HOST: AtomicPtr<ptlp_host> = AtomicPtr::new(ptr::null_mut());

/// Notes the host.
pub(crate) fn set(host: *const ptlp_host) {
    HOST.store(host.cast_mut(), Ordering::Release);
}

/// A service by its id; `None` if the host does not have it, or is not there yet.
pub(crate) fn service<T>(id: &CStr) -> Option<&'static T> {
    let host = HOST.load(Ordering::Acquire);
    // SAFETY: NULL, or the host, which lives as long as the process.
    let get_extension = unsafe { host.as_ref() }?.get_extension?;
    // SAFETY: the contract: the table of that id is a `T`, and lives as long as the process.
    unsafe { get_extension(host, id.as_ptr()).cast::<T>().as_ref() }
}

/// How much a message matters.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Level {
    /// For whoever looks for a fault.
    Debug = 1,
    /// What goes on.
    Info = 2,
    /// What works, but probably not as meant.
    Warning = 3,
    /// What failed.
    Error = 4,
}

/// Writes a line to the log of the host, outside of a call. (Inside: `warn`.)
pub fn log(level: Level, message: &str) {
    let message = CString::new(message.replace('\0', " ")).unwrap_or_default();
    if let Some(write) = service::<ptlp_log>(PTLP_LOG).and_then(|table| table.write) {
        let host = HOST.load(Ordering::Acquire);
        // SAFETY: the contract.
        unsafe { write(host, ptr::null(), level as i32, message.as_ptr()) };
    }
}
