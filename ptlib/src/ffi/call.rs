//! The two ways in which an exported function runs: see `pt_fn!`.

use std::{
    any::Any,
    panic::{AssertUnwindSafe, catch_unwind},
};

use super::{PTL_OK, ptl_error, ptl_status, status::status_of};
use crate::error::{Error, ErrorKind};

/// What the body of a fallible function gives.
pub(super) trait Outcome {
    /// The status that says so.
    fn status(self) -> ptl_status;
}

impl Outcome for () {
    fn status(self) -> ptl_status {
        PTL_OK
    }
}

impl Outcome for ptl_status {
    fn status(self) -> ptl_status {
        self
    }
}

/// Runs `body`, writes the error or NULL to `*error`, and returns the status.
///
/// # Safety
/// `error` is NULL or points to where a pointer may be written.
pub(super) unsafe fn fallible<T: Outcome>(
    error: *mut *mut ptl_error,
    body: impl FnOnce() -> Result<T, Error>,
) -> ptl_status {
    let (status, fault) = match caught(body) {
        Ok(outcome) => (outcome.status(), None),
        Err(fault) => (status_of(fault.kind()), Some(fault)),
    };
    if !error.is_null() && error.is_aligned() {
        let handle = fault.map_or(std::ptr::null_mut(), ptl_error::of);
        // SAFETY: not null, aligned, and the caller's to write.
        unsafe { error.write(handle) };
    }
    status
}

/// Runs `body`; `default` stands for every error.
pub(super) fn infallible<T>(default: T, body: impl FnOnce() -> Result<T, Error>) -> T {
    caught(body).unwrap_or(default)
}

/// Runs `body`; a panic in it becomes an error.
pub(super) fn caught<T>(body: impl FnOnce() -> Result<T, Error>) -> Result<T, Error> {
    // Unwind safety: objects that a panic may leave half-changed are behind locks that remember
    // it (see `GraphObject`).
    catch_unwind(AssertUnwindSafe(body)).unwrap_or_else(|panic| Err(defect(&*panic)))
}

fn defect(panic: &(dyn Any + Send)) -> Error {
    let text = match (panic.downcast_ref::<&str>(), panic.downcast_ref::<String>()) {
        (Some(text), _) => text,
        (_, Some(text)) => text.as_str(),
        _ => "without a message",
    };
    Error::new(ErrorKind::Internal, format!("a defect of ptlib or of a block: {text}"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_panic_becomes_an_error_with_its_message() {
        let error = caught::<()>(|| panic!("seven of {}", 9)).unwrap_err();
        assert_eq!(error.kind(), ErrorKind::Internal);
        assert!(error.message().ends_with("seven of 9"));
        assert_eq!(infallible(3, || panic!("no")), 3);
    }

    #[test]
    fn the_error_argument_is_always_written() {
        let mut error = std::ptr::dangling_mut();
        // SAFETY: `error` is a place for a pointer.
        let status = unsafe { fallible(&raw mut error, || Ok(())) };
        assert_eq!((status, error.is_null()), (PTL_OK, true));
    }
}
