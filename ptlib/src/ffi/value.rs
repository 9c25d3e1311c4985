//! Values that are no pictures, and pictures from memory: made by the caller, or computed.

use std::{
    ffi::c_void,
    sync::{Arc, OnceLock},
};

use ptlib_plugin_abi::values::{
    ptl_gradient_data, ptl_image_data, ptl_mesh_data, ptl_points_data, ptl_strands_data,
    ptl_text_data,
};

use super::{
    PTL_VALUE_BORROW,
    handle::{Handle, NewHandle, Opaque, give, tag, tagged},
    ptl_error, ptl_free_fn, ptl_status,
};
use crate::{
    error::{Error, ErrorKind},
    limits::Limits,
    plugin::{
        import::{Import, Owner},
        view::{Body, View},
    },
    value::Value,
};

/// What flows on a wire: a mesh, points, strands, a text, a colour transition or an image. It is
/// reference counted, never changes, and any thread may read it.
#[derive(Debug)]
pub struct ptl_value {
    _opaque: [u8; 0],
}

impl Opaque for ptl_value {
    type Object = ValueObject;
    const TAG: u32 = tag(b'v');
    const NAME: &'static str = "ptl_value";
}

/// A value, and how C sees it once somebody asked.
#[derive(Debug)]
pub(super) struct ValueObject {
    value: Value,
    view: OnceLock<Option<View>>,
}

impl ValueObject {
    pub(super) fn new(value: Value) -> Self {
        Self { value, view: OnceLock::new() }
    }

    pub(super) fn value(&self) -> &Value {
        &self.value
    }

    /// The value as a struct; `None` for an image.
    pub(super) fn body(&self) -> Option<&Body> {
        self.view.get_or_init(|| View::of(&self.value)).as_ref().map(View::body)
    }

    /// The error of a value of another kind than `wanted`.
    pub(super) fn is_no(&self, wanted: &str) -> Error {
        let message = format!("the value is of kind {}, not {wanted}", self.value.kind().name());
        Error::new(ErrorKind::TypeMismatch, message)
    }
}

/// Tells the caller that its memory is needed no longer: once, when this is dropped.
struct Lender {
    free: ptl_free_fn,
    user_data: *mut c_void,
}

// SAFETY: `user_data` is only handed to the caller's function, which the header asks to work on
// any thread.
unsafe impl Send for Lender {}
// SAFETY: as above.
unsafe impl Sync for Lender {}

impl Drop for Lender {
    fn drop(&mut self) {
        if let Some(free) = self.free {
            // SAFETY: the caller gave this function for this pointer, and this is its only call.
            unsafe { free(self.user_data) };
        }
    }
}

fn lender(free: ptl_free_fn, user_data: *mut c_void) -> Owner {
    Arc::new(Lender { free, user_data })
}

/// Makes a value as the flags say. What the lender lent is needed no longer when the value is
/// gone, or at once if it was copied or refused.
fn make(
    lender: Owner,
    flags: u32,
    out: NewHandle<'_, ptl_value>,
    import: impl FnOnce(&Import<'_>) -> Result<Value, Error>,
) -> Result<(), Error> {
    if flags & !PTL_VALUE_BORROW != 0 {
        let message = format!("`flags` is {flags:#x}, allowed PTL_VALUE_BORROW or 0");
        return Err(Error::new(ErrorKind::Unsupported, message));
    }
    let limits = Limits::default();
    let value = if flags & PTL_VALUE_BORROW != 0 {
        import(&Import::borrowing(&limits, lender))?
    } else {
        let value = import(&Import::copying(&limits))?;
        drop(lender);
        value
    };
    out.set(tagged::<ptl_value>(ValueObject::new(value)));
    Ok(())
}

/// Makes a mesh of the caller's triangles, checked: every number is finite, every index is the
/// number of a vertex, and so on; ptlib_values.h says what streams there are. Normals of another
/// length than 1 are made so. Bounds are computed, whatever those given are.
///
/// Ownership: without PTL_VALUE_BORROW the data is copied during the call. With it the indices and
///            the data of the streams stay the caller's and must not change until `free` is
///            called; the structs are needed during the call only. `free`, which may be NULL, is
///            called exactly once with `user_data`, from any thread: when the data is needed no
///            longer, also if it was copied, and also when the call fails. `out` receives one
///            reference; release it with ptl_value_release().
/// Threads:   any.
/// Errors:    PTL_E_INVALID_ARGUMENT, PTL_E_OUT_OF_RANGE with the first wrong element and how many
///            there are, PTL_E_LIMIT, PTL_E_NO_MEMORY, PTL_E_UNSUPPORTED. On error `*out` is NULL.
/// Since:     0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn ptl_value_from_mesh(
    mesh: *const ptl_mesh_data,
    flags: u32,
    free: ptl_free_fn,
    user_data: *mut c_void,
    out: *mut *mut ptl_value,
    error: *mut *mut ptl_error,
) -> ptl_status {
    let lender = lender(free, user_data);
    // SAFETY: the caller's promise.
    pt_fn!(error; out: NewHandle<ptl_value> => make(lender, flags, out, |import| unsafe {
        import.mesh(mesh).map(Value::from)
    }))
}

/// Makes points of the caller's, checked.
///
/// Ownership: as ptl_value_from_mesh().
/// Threads:   any.
/// Errors:    as ptl_value_from_mesh(); a normal or a direction without length is one.
/// Since:     0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn ptl_value_from_points(
    points: *const ptl_points_data,
    flags: u32,
    free: ptl_free_fn,
    user_data: *mut c_void,
    out: *mut *mut ptl_value,
    error: *mut *mut ptl_error,
) -> ptl_status {
    let lender = lender(free, user_data);
    // SAFETY: the caller's promise.
    pt_fn!(error; out: NewHandle<ptl_value> => make(lender, flags, out, |import| unsafe {
        import.points(points).map(Value::from)
    }))
}

/// Makes strands of the caller's polylines, checked.
///
/// Ownership: as ptl_value_from_mesh().
/// Threads:   any.
/// Errors:    as ptl_value_from_mesh(); a normal or a direction without length is one.
/// Since:     0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn ptl_value_from_strands(
    strands: *const ptl_strands_data,
    flags: u32,
    free: ptl_free_fn,
    user_data: *mut c_void,
    out: *mut *mut ptl_value,
    error: *mut *mut ptl_error,
) -> ptl_status {
    let lender = lender(free, user_data);
    // SAFETY: the caller's promise.
    pt_fn!(error; out: NewHandle<ptl_value> => make(lender, flags, out, |import| unsafe {
        import.strands(strands).map(Value::from)
    }))
}

/// Makes a text.
///
/// Ownership: as ptl_value_from_mesh(), but the text is always copied during the call.
/// Threads:   any.
/// Errors:    PTL_E_INVALID_ARGUMENT, PTL_E_LIMIT, PTL_E_UNSUPPORTED. On error `*out` is NULL.
/// Since:     0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn ptl_value_from_text(
    text: *const ptl_text_data,
    flags: u32,
    free: ptl_free_fn,
    user_data: *mut c_void,
    out: *mut *mut ptl_value,
    error: *mut *mut ptl_error,
) -> ptl_status {
    let lender = lender(free, user_data);
    // SAFETY: the caller's promise.
    pt_fn!(error; out: NewHandle<ptl_value> => make(lender, flags, out, |import| unsafe {
        import.text(text).map(Value::from)
    }))
}

/// Makes a colour transition. Its stops may be in any order; of those at one position the first
/// counts. Without stops it is a middle grey.
///
/// Ownership: as ptl_value_from_mesh(), but the stops are always copied during the call.
/// Threads:   any.
/// Errors:    PTL_E_INVALID_ARGUMENT, PTL_E_OUT_OF_RANGE, PTL_E_LIMIT, PTL_E_UNSUPPORTED. On error
///            `*out` is NULL.
/// Since:     0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn ptl_value_from_gradient(
    gradient: *const ptl_gradient_data,
    flags: u32,
    free: ptl_free_fn,
    user_data: *mut c_void,
    out: *mut *mut ptl_value,
    error: *mut *mut ptl_error,
) -> ptl_status {
    let lender = lender(free, user_data);
    // SAFETY: the caller's promise.
    pt_fn!(error; out: NewHandle<ptl_value> => make(lender, flags, out, |import| unsafe {
        import.gradient(gradient).map(Value::from)
    }))
}

/// Makes an image of the caller's pixels, which need no alignment.
///
/// Ownership: as ptl_value_from_mesh(), but the pixels are always converted during the call.
/// Threads:   any.
/// Errors:    PTL_E_INVALID_ARGUMENT, PTL_E_OUT_OF_RANGE if a number is not finite, PTL_E_LIMIT,
///            PTL_E_NO_MEMORY, PTL_E_UNSUPPORTED. On error `*out` is NULL.
/// Since:     0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn ptl_value_from_image(
    image: *const ptl_image_data,
    flags: u32,
    free: ptl_free_fn,
    user_data: *mut c_void,
    out: *mut *mut ptl_value,
    error: *mut *mut ptl_error,
) -> ptl_status {
    let lender = lender(free, user_data);
    // SAFETY: the caller's promise.
    pt_fn!(error; out: NewHandle<ptl_value> => make(lender, flags, out, |import| unsafe {
        import.image(image).map(Value::from)
    }))
}

/// What the value is: one of PTL_KIND_...; PTL_KIND_NONE for NULL.
///
/// Threads: any.
/// Since:   0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn ptl_value_kind(value: *const ptl_value) -> u32 {
    pt_fn!(else 0; value: Handle<ptl_value> => value.value.kind() as u32)
}

/// One more reference to the same value; NULL for NULL.
///
/// Ownership: release each reference with ptl_value_release().
/// Threads:   any.
/// Since:     0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn ptl_value_retain(value: *mut ptl_value) -> *mut ptl_value {
    // SAFETY: handles of this type are only made by `give`.
    pt_fn!(else std::ptr::null_mut(); value: Handle<ptl_value> => give(unsafe { value.retain() }))
}

/// Gives up one reference; NULL is fine.
///
/// Threads: any.
/// Since:   0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn ptl_value_release(value: *mut ptl_value) {
    // SAFETY: the caller gives up its reference.
    pt_fn!(else (); value: Handle<ptl_value> => drop(unsafe { value.take() }));
}
