//! Looking at values: where their data is.

use ptlib_plugin_abi::values::{
    ptl_gradient_data, ptl_mesh_data, ptl_points_data, ptl_strands_data, ptl_text_data,
};

use super::{
    compute::format_of,
    handle::{Handle, NewHandle, tagged},
    image::ImageObject,
    ptl_error, ptl_format, ptl_image, ptl_status, ptl_value,
    structs::{CStruct, InOut},
};
use crate::{
    plugin::view::Body,
    value::{Format, Value},
};

/// Fills in where the data of a mesh is: nothing is copied.
///
/// Ownership: everything that it points to lives as long as the value, and nobody may change it.
/// Threads:   any.
/// Errors:    PTL_E_INVALID_ARGUMENT, PTL_E_TYPE_MISMATCH if it is no mesh. On error `inout` is
///            untouched.
/// Since:     0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn ptl_value_mesh(
    value: *const ptl_value,
    inout: *mut ptl_mesh_data,
    error: *mut *mut ptl_error,
) -> ptl_status {
    pt_fn!(error; value: Handle<ptl_value>, inout: InOut<ptl_mesh_data> => match value.body() {
        Some(Body::Mesh(data)) => {
            inout.set(data);
            Ok(())
        }
        _ => Err(value.is_no("mesh")),
    })
}

/// Fills in where the data of points is: nothing is copied.
///
/// Ownership: everything that it points to lives as long as the value, and nobody may change it.
/// Threads:   any.
/// Errors:    PTL_E_INVALID_ARGUMENT, PTL_E_TYPE_MISMATCH. On error `inout` is untouched.
/// Since:     0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn ptl_value_points(
    value: *const ptl_value,
    inout: *mut ptl_points_data,
    error: *mut *mut ptl_error,
) -> ptl_status {
    pt_fn!(error; value: Handle<ptl_value>, inout: InOut<ptl_points_data> => match value.body() {
        Some(Body::Points(data)) => {
            inout.set(data);
            Ok(())
        }
        _ => Err(value.is_no("points")),
    })
}

/// Fills in where the data of strands is: nothing is copied.
///
/// Ownership: everything that it points to lives as long as the value, and nobody may change it.
/// Threads:   any.
/// Errors:    PTL_E_INVALID_ARGUMENT, PTL_E_TYPE_MISMATCH. On error `inout` is untouched.
/// Since:     0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn ptl_value_strands(
    value: *const ptl_value,
    inout: *mut ptl_strands_data,
    error: *mut *mut ptl_error,
) -> ptl_status {
    pt_fn!(error; value: Handle<ptl_value>, inout: InOut<ptl_strands_data> => match value.body() {
        Some(Body::Strands(data)) => {
            inout.set(data);
            Ok(())
        }
        _ => Err(value.is_no("strands")),
    })
}

/// Fills in where a text is; it has a NUL behind it that does not count.
///
/// Ownership: it lives as long as the value.
/// Threads:   any.
/// Errors:    PTL_E_INVALID_ARGUMENT, PTL_E_TYPE_MISMATCH. On error `inout` is untouched.
/// Since:     0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn ptl_value_text(
    value: *const ptl_value,
    inout: *mut ptl_text_data,
    error: *mut *mut ptl_error,
) -> ptl_status {
    pt_fn!(error; value: Handle<ptl_value>, inout: InOut<ptl_text_data> => match value.body() {
        Some(Body::Text(data)) => {
            inout.set(data);
            Ok(())
        }
        _ => Err(value.is_no("text")),
    })
}

/// Fills in where the stops of a colour transition are, by rising position.
///
/// Ownership: they live as long as the value.
/// Threads:   any.
/// Errors:    PTL_E_INVALID_ARGUMENT, PTL_E_TYPE_MISMATCH. On error `inout` is untouched.
/// Since:     0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn ptl_value_gradient(
    value: *const ptl_value,
    inout: *mut ptl_gradient_data,
    error: *mut *mut ptl_error,
) -> ptl_status {
    pt_fn!(error; value: Handle<ptl_value>, inout: InOut<ptl_gradient_data> => match value.body() {
        Some(Body::Gradient(data)) => {
            inout.set(data);
            Ok(())
        }
        _ => Err(value.is_no("gradient")),
    })
}

/// The image of a value, in any format (PTL_FORMAT_AUTO: floats, as many channels as it has).
///
/// Ownership: `out` receives one reference; release it with ptl_image_release(). It does not need
///            the value any more.
/// Threads:   any.
/// Errors:    PTL_E_INVALID_ARGUMENT, PTL_E_TYPE_MISMATCH, PTL_E_NO_MEMORY. On error `*out` is
///            NULL.
/// Since:     0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn ptl_value_image(
    value: *const ptl_value,
    format: ptl_format,
    out: *mut *mut ptl_image,
    error: *mut *mut ptl_error,
) -> ptl_status {
    pt_fn!(error; value: Handle<ptl_value>, out: NewHandle<ptl_image> => {
        let Value::Image(image) = value.value() else { return Err(value.is_no("image")) };
        let format = format_of(format)?.unwrap_or(match image.planes() {
            1 => Format::GreyF32,
            3 => Format::RgbF32,
            _ => Format::RgbaF32,
        });
        out.set(tagged::<ptl_image>(ImageObject::new(image.clone(), format)?));
        Ok(())
    })
}

// SAFETY: `repr(C)`, starts with its size, no padding, zeros are a value (see ptlib_values.h).
unsafe impl CStruct for ptl_mesh_data {
    const NAME: &'static str = "ptl_mesh_data";
}

// SAFETY: as above.
unsafe impl CStruct for ptl_points_data {
    const NAME: &'static str = "ptl_points_data";
}

// SAFETY: as above.
unsafe impl CStruct for ptl_strands_data {
    const NAME: &'static str = "ptl_strands_data";
}

// SAFETY: as above.
unsafe impl CStruct for ptl_text_data {
    const NAME: &'static str = "ptl_text_data";
}

// SAFETY: as above.
unsafe impl CStruct for ptl_gradient_data {
    const NAME: &'static str = "ptl_gradient_data";
}
