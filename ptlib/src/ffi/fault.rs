//! Faults as C reads them: errors and warnings with their texts as C strings.

use std::ffi::CString;

use super::{ptl_fault, status::status_of};
use crate::error::Error;

/// One fault of an error, without the others.
#[derive(Debug)]
pub(super) struct Fault {
    status: i32,
    position: (u32, u32),
    block: u64,
    param: Option<CString>,
    message: CString,
}

impl Fault {
    /// Every fault of `error`.
    pub(super) fn all_of(error: &Error) -> Vec<Self> {
        error.faults().map(Self::of).collect()
    }

    fn of(error: &Error) -> Self {
        let place = error.place();
        // The text of a fault that carries others would end with theirs.
        let text = error.to_string();
        let own = if error.faults().count() > 1 { one_line(error) } else { text };
        Self {
            status: status_of(error.kind()),
            position: place.position.unwrap_or_default(),
            block: place.handle.unwrap_or_default(),
            param: place.parameter.as_deref().map(c_string),
            message: c_string(&own),
        }
    }

    /// The fault as a struct that borrows from this one.
    pub(super) fn to_c(&self) -> ptl_fault {
        ptl_fault {
            struct_size: 0,
            status: self.status,
            line: self.position.0,
            column: self.position.1,
            block: self.block,
            param: self.param.as_ref().map_or(std::ptr::null(), |param| param.as_ptr()),
            message: self.message.as_ptr(),
        }
    }
}

/// The text of the first fault of `error`.
fn one_line(error: &Error) -> String {
    let all = error.to_string();
    let others: usize = error.faults().skip(1).map(|other| other.to_string().len() + 1).sum();
    all.get(..all.len().saturating_sub(others)).unwrap_or(&all).to_owned()
}

/// `text` for C, which ends texts at a NUL: one inside becomes a blank.
pub(super) fn c_string(text: &str) -> CString {
    CString::new(text.replace('\0', " ")).unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::error::ErrorKind;

    #[test]
    fn each_fault_has_its_own_text() {
        let first = Error::new(ErrorKind::Parse, "a\nb").at_position(3, 4);
        let second = Error::new(ErrorKind::Limit, "c\0d").at_parameter("p");
        let faults = Fault::all_of(&Error::from_faults(vec![first, second]).unwrap());
        let [first, second] = &*faults else { panic!("two faults") };
        assert_eq!(first.message.to_str().unwrap(), "line 3, column 4: a\nb");
        assert_eq!((first.to_c().line, first.to_c().column), (3, 4));
        assert_eq!(second.message.to_str().unwrap(), "parameter \"p\": c d");
        assert_eq!(second.param.as_deref(), Some(c"p"));
        assert!(first.to_c().param.is_null());
    }
}
