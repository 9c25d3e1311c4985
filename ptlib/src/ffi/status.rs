//! Statuses: the numbers of [`ErrorKind`], and two that are no errors.

use std::ffi::c_char;

use crate::error::ErrorKind;

/// What a call came to: PTL_OK, PTL_PENDING, or an error (PTL_E_...). The numbers never change;
/// later versions may add some, so treat every unknown number as an error.
pub type ptl_status = i32;

/// Done.
pub const PTL_OK: ptl_status = 0;
/// Not done yet: only from ptl_job_poll() and ptl_job_wait().
pub const PTL_PENDING: ptl_status = 1;
/// The caller asked to stop.
pub const PTL_E_CANCELLED: ptl_status = 2;
/// An argument makes no sense; the message names it.
pub const PTL_E_INVALID_ARGUMENT: ptl_status = 3;
/// This version or build cannot do that.
pub const PTL_E_UNSUPPORTED: ptl_status = 4;
/// The system has no memory left.
pub const PTL_E_NO_MEMORY: ptl_status = 5;
/// Another thread is changing the object.
pub const PTL_E_BUSY: ptl_status = 6;
/// No block, parameter, port or type of that name.
pub const PTL_E_NOT_FOUND: ptl_status = 7;
/// The block was removed from its graph, or never was in it.
pub const PTL_E_STALE_HANDLE: ptl_status = 8;
/// A value or a connection of the wrong kind.
pub const PTL_E_TYPE_MISMATCH: ptl_status = 9;
/// The connection would make a block depend on itself.
pub const PTL_E_CYCLE: ptl_status = 10;
/// A required input is not connected.
pub const PTL_E_UNCONNECTED: ptl_status = 11;
/// A number outside its range.
pub const PTL_E_OUT_OF_RANGE: ptl_status = 12;
/// A text or file that does not follow its grammar.
pub const PTL_E_PARSE: ptl_status = 13;
/// A file could not be read or written.
pub const PTL_E_IO: ptl_status = 14;
/// More than the limits of the engine allow.
pub const PTL_E_LIMIT: ptl_status = 15;
/// The caller's buffer is too small; the message says what is needed.
pub const PTL_E_BUFFER_TOO_SMALL: ptl_status = 16;
/// The file policy forbids it; the message says how to allow it.
pub const PTL_E_DENIED: ptl_status = 17;
/// The system cannot load the file of a plug-in: it is no library, or misses another one.
pub const PTL_E_PLUGIN_LOAD: ptl_status = 20;
/// The plug-in was built for another version of the plug-in contract.
pub const PTL_E_PLUGIN_ABI: ptl_status = 21;
/// Another plug-in has block types of that id.
pub const PTL_E_PLUGIN_DUPLICATE: ptl_status = 22;
/// A block of a plug-in panicked or threw an exception.
pub const PTL_E_PLUGIN_PANIC: ptl_status = 23;
/// The tables of a Rust plug-in are laid out in another way than here.
pub const PTL_E_PLUGIN_LAYOUT: ptl_status = 24;
/// The file is a library, but no plug-in.
pub const PTL_E_PLUGIN_SYMBOL: ptl_status = 25;
/// The plug-in could not be initialised.
pub const PTL_E_PLUGIN_INIT: ptl_status = 26;
/// The plug-in describes itself wrongly; the message names the field.
pub const PTL_E_PLUGIN_DESCRIPTOR: ptl_status = 27;
/// A block of a plug-in says that it failed.
pub const PTL_E_PLUGIN_FAILED: ptl_status = 28;
/// A defect of this library or of a block. The program may go on.
pub const PTL_E_INTERNAL: ptl_status = 99;

/// The status of an error.
pub(super) fn status_of(kind: ErrorKind) -> ptl_status {
    kind as ptl_status
}

/// The name of a status, such as "PTL_E_NOT_FOUND"; "unknown status" for other numbers.
///
/// Ownership: the text is static.
/// Threads:   any.
/// Since:     0.1
#[unsafe(no_mangle)]
pub extern "C" fn ptl_status_name(status: ptl_status) -> *const c_char {
    let name = match status {
        PTL_OK => c"PTL_OK",
        PTL_PENDING => c"PTL_PENDING",
        PTL_E_CANCELLED => c"PTL_E_CANCELLED",
        PTL_E_INVALID_ARGUMENT => c"PTL_E_INVALID_ARGUMENT",
        PTL_E_UNSUPPORTED => c"PTL_E_UNSUPPORTED",
        PTL_E_NO_MEMORY => c"PTL_E_NO_MEMORY",
        PTL_E_BUSY => c"PTL_E_BUSY",
        PTL_E_NOT_FOUND => c"PTL_E_NOT_FOUND",
        PTL_E_STALE_HANDLE => c"PTL_E_STALE_HANDLE",
        PTL_E_TYPE_MISMATCH => c"PTL_E_TYPE_MISMATCH",
        PTL_E_CYCLE => c"PTL_E_CYCLE",
        PTL_E_UNCONNECTED => c"PTL_E_UNCONNECTED",
        PTL_E_OUT_OF_RANGE => c"PTL_E_OUT_OF_RANGE",
        PTL_E_PARSE => c"PTL_E_PARSE",
        PTL_E_IO => c"PTL_E_IO",
        PTL_E_LIMIT => c"PTL_E_LIMIT",
        PTL_E_BUFFER_TOO_SMALL => c"PTL_E_BUFFER_TOO_SMALL",
        PTL_E_DENIED => c"PTL_E_DENIED",
        PTL_E_PLUGIN_LOAD => c"PTL_E_PLUGIN_LOAD",
        PTL_E_PLUGIN_ABI => c"PTL_E_PLUGIN_ABI",
        PTL_E_PLUGIN_DUPLICATE => c"PTL_E_PLUGIN_DUPLICATE",
        PTL_E_PLUGIN_PANIC => c"PTL_E_PLUGIN_PANIC",
        PTL_E_PLUGIN_LAYOUT => c"PTL_E_PLUGIN_LAYOUT",
        PTL_E_PLUGIN_SYMBOL => c"PTL_E_PLUGIN_SYMBOL",
        PTL_E_PLUGIN_INIT => c"PTL_E_PLUGIN_INIT",
        PTL_E_PLUGIN_DESCRIPTOR => c"PTL_E_PLUGIN_DESCRIPTOR",
        PTL_E_PLUGIN_FAILED => c"PTL_E_PLUGIN_FAILED",
        PTL_E_INTERNAL => c"PTL_E_INTERNAL",
        _ => c"unknown status",
    };
    pt_fn!(else std::ptr::null(); => name.as_ptr())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn statuses_are_the_numbers_of_the_error_kinds() {
        let pairs = [
            (ErrorKind::Cancelled, PTL_E_CANCELLED),
            (ErrorKind::InvalidArgument, PTL_E_INVALID_ARGUMENT),
            (ErrorKind::Unsupported, PTL_E_UNSUPPORTED),
            (ErrorKind::NoMemory, PTL_E_NO_MEMORY),
            (ErrorKind::Busy, PTL_E_BUSY),
            (ErrorKind::NotFound, PTL_E_NOT_FOUND),
            (ErrorKind::StaleHandle, PTL_E_STALE_HANDLE),
            (ErrorKind::TypeMismatch, PTL_E_TYPE_MISMATCH),
            (ErrorKind::Cycle, PTL_E_CYCLE),
            (ErrorKind::Unconnected, PTL_E_UNCONNECTED),
            (ErrorKind::OutOfRange, PTL_E_OUT_OF_RANGE),
            (ErrorKind::Parse, PTL_E_PARSE),
            (ErrorKind::Io, PTL_E_IO),
            (ErrorKind::Limit, PTL_E_LIMIT),
            (ErrorKind::BufferTooSmall, PTL_E_BUFFER_TOO_SMALL),
            (ErrorKind::Denied, PTL_E_DENIED),
            (ErrorKind::PluginLoad, PTL_E_PLUGIN_LOAD),
            (ErrorKind::PluginAbi, PTL_E_PLUGIN_ABI),
            (ErrorKind::PluginDuplicate, PTL_E_PLUGIN_DUPLICATE),
            (ErrorKind::PluginPanic, PTL_E_PLUGIN_PANIC),
            (ErrorKind::PluginLayout, PTL_E_PLUGIN_LAYOUT),
            (ErrorKind::PluginSymbol, PTL_E_PLUGIN_SYMBOL),
            (ErrorKind::PluginInit, PTL_E_PLUGIN_INIT),
            (ErrorKind::PluginDescriptor, PTL_E_PLUGIN_DESCRIPTOR),
            (ErrorKind::PluginFailed, PTL_E_PLUGIN_FAILED),
            (ErrorKind::Internal, PTL_E_INTERNAL),
        ];
        for (kind, status) in pairs {
            assert_eq!(status_of(kind), status, "{kind:?}");
        }
    }
}
