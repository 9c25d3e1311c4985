//! Errors as C holds them.

use std::ffi::{CString, c_char};

use super::{
    fault::{Fault, c_string},
    handle::{Handle, Opaque, give, tag, tagged},
    ptl_block, ptl_fault, ptl_status,
    status::status_of,
    structs::InOut,
};
use crate::error::{Error, ErrorKind};

/// What went wrong, where, and what is allowed instead. It has one owner and any thread may read
/// it.
#[derive(Debug)]
pub struct ptl_error {
    _opaque: [u8; 0],
}

impl Opaque for ptl_error {
    type Object = ErrorObject;
    const TAG: u32 = tag(b'x');
    const NAME: &'static str = "ptl_error";
}

#[derive(Debug)]
pub(super) struct ErrorObject {
    status: ptl_status,
    block: ptl_block,
    message: CString,
    param: Option<CString>,
    faults: Vec<Fault>,
}

impl ptl_error {
    /// A new handle of `error`.
    #[expect(clippy::needless_pass_by_value, reason = "the error ends here")]
    pub(super) fn of(error: Error) -> *mut Self {
        let place = error.place();
        give(tagged::<Self>(ErrorObject {
            status: status_of(error.kind()),
            block: place.handle.unwrap_or_default(),
            message: c_string(&error.to_string()),
            param: place.parameter.as_deref().map(c_string),
            faults: Fault::all_of(&error),
        }))
    }
}

/// The status that came with the error; PTL_OK for NULL.
///
/// Threads: any.
/// Since:   0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn ptl_error_status(error: *const ptl_error) -> ptl_status {
    pt_fn!(else super::PTL_OK; error: Handle<ptl_error> => error.status)
}

/// What went wrong, in English, one line a fault: place, fact, what is allowed. NULL for NULL.
///
/// Ownership: the text lives as long as the error.
/// Threads:   any.
/// Since:     0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn ptl_error_message(error: *const ptl_error) -> *const c_char {
    pt_fn!(else std::ptr::null(); error: Handle<ptl_error> => error.message.as_ptr())
}

/// The block that the error concerns; 0 if it concerns none.
///
/// Threads: any.
/// Since:   0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn ptl_error_block(error: *const ptl_error) -> ptl_block {
    pt_fn!(else 0; error: Handle<ptl_error> => error.block)
}

/// The id of the parameter that the error concerns; NULL if it concerns none.
///
/// Ownership: the text lives as long as the error.
/// Threads:   any.
/// Since:     0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn ptl_error_param(error: *const ptl_error) -> *const c_char {
    pt_fn!(else std::ptr::null(); error: Handle<ptl_error> =>
        error.param.as_ref().map_or(std::ptr::null(), |param| param.as_ptr()))
}

/// The number of faults: a graph file may have many, other errors have one. 0 for NULL.
///
/// Threads: any.
/// Since:   0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn ptl_error_fault_count(error: *const ptl_error) -> u32 {
    pt_fn!(else 0; error: Handle<ptl_error> =>
        u32::try_from(error.faults.len()).unwrap_or(u32::MAX))
}

/// Fills in fault number `index`.
///
/// Ownership: the texts live as long as the error.
/// Threads:   any.
/// Errors:    PTL_E_INVALID_ARGUMENT, PTL_E_NOT_FOUND. On error `inout` is untouched.
/// Since:     0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn ptl_error_fault_at(
    error: *const ptl_error,
    index: u32,
    inout: *mut ptl_fault,
) -> ptl_status {
    pt_fn!(std::ptr::null_mut(); error: Handle<ptl_error>, inout: InOut<ptl_fault> => {
        inout.set(&at(&error.faults, index, "fault")?.to_c());
        Ok(())
    })
}

/// Frees an error; NULL is fine.
///
/// Threads: any.
/// Since:   0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn ptl_error_release(error: *mut ptl_error) {
    // SAFETY: the caller gives up its only reference.
    pt_fn!(else (); error: Handle<ptl_error> => drop(unsafe { error.take() }));
}

/// Element `index` of `list`.
pub(super) fn at<'a, T>(list: &'a [T], index: u32, what: &str) -> Result<&'a T, Error> {
    list.get(index as usize).ok_or_else(|| {
        let message = format!("there is no {what} {index}, but {} from 0 on", list.len());
        Error::new(ErrorKind::NotFound, message)
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::ffi::CStr;

    #[test]
    fn an_error_keeps_its_place_and_its_texts() {
        let error = Error::new(ErrorKind::OutOfRange, "is 9").at_parameter("sharpness").at_block(
            "3",
            "voronoi diagram",
            77,
        );
        let handle = ptl_error::of(error);
        // SAFETY: `handle` is alive until it is released, and not used afterwards.
        unsafe {
            assert_eq!(ptl_error_status(handle), super::super::PTL_E_OUT_OF_RANGE);
            assert_eq!(ptl_error_block(handle), 77);
            assert_eq!(CStr::from_ptr(ptl_error_param(handle)), c"sharpness");
            assert_eq!(ptl_error_fault_count(handle), 1);
            let message = CStr::from_ptr(ptl_error_message(handle)).to_str().unwrap();
            assert!(message.contains("voronoi diagram") && message.contains("is 9"), "{message}");
            ptl_error_release(handle);
        }
    }
}
