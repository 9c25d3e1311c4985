//! Versions, and what this build has.

use std::ffi::c_char;

use ptlib_plugin_abi::values;

use super::types::*;

/// The version of the header's functions and structs. A library serves every program that was
/// built for the same number; within it, functions and fields are only added. It is also the
/// number at the end of the shared library's name.
pub const PTL_ABI_VERSION: u32 = 0;

/// The version of the library as one number: major * 1000000 + minor * 1000 + patch.
///
/// Threads: any.
/// Since:   0.1
#[unsafe(no_mangle)]
pub extern "C" fn ptl_version_number() -> u32 {
    pt_fn!(else 0; => {
        let parts = [
            env!("CARGO_PKG_VERSION_MAJOR"),
            env!("CARGO_PKG_VERSION_MINOR"),
            env!("CARGO_PKG_VERSION_PATCH"),
        ];
        parts.iter().fold(0, |number, part| number * 1000 + part.parse().unwrap_or(0))
    })
}

/// The version of the library as a text, such as "0.1.0".
///
/// Ownership: the text is static.
/// Threads:   any.
/// Since:     0.1
#[unsafe(no_mangle)]
pub extern "C" fn ptl_version_string() -> *const c_char {
    const VERSION: &str = concat!(env!("CARGO_PKG_VERSION"), "\0");
    pt_fn!(else std::ptr::null(); => VERSION.as_ptr().cast())
}

/// The library's PTL_ABI_VERSION. Programs that load the library at run time compare it with the
/// one that they were built with.
///
/// Threads: any.
/// Since:   0.1
#[unsafe(no_mangle)]
pub extern "C" fn ptl_abi_version() -> u32 {
    pt_fn!(else 0; => PTL_ABI_VERSION)
}

/// Whether this build has a feature, 1 or 0: "formats" (ptl_image_save() writes other files than
/// PNG: all that there are), or one of them: "png", "exr", "tiff", "jpeg", "webp", "bmp", "tga",
/// "qoi", "pnm". Unknown names are 0.
///
/// Threads: any.
/// Since:   0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn ptl_has_feature(name: *const c_char) -> i32 {
    pt_fn!(else 0; name: &str => i32::from(has_feature(name)))
}

fn has_feature(name: &str) -> bool {
    let features = [
        ("formats", cfg!(feature = "formats")),
        ("png", cfg!(feature = "png")),
        ("exr", cfg!(feature = "exr")),
        ("tiff", cfg!(feature = "tiff")),
        ("jpeg", cfg!(feature = "jpeg")),
        ("webp", cfg!(feature = "webp")),
        ("bmp", cfg!(feature = "bmp")),
        ("tga", cfg!(feature = "tga")),
        ("qoi", cfg!(feature = "qoi")),
        ("pnm", cfg!(feature = "pnm")),
    ];
    features.contains(&(name, true))
}

/// The size in bytes that the library has for a struct (PTL_STRUCT_...); 0 for unknown ones. For
/// the tests of bindings.
///
/// Threads: any.
/// Since:   0.1
#[unsafe(no_mangle)]
pub extern "C" fn ptl_abi_sizeof(struct_id: u32) -> usize {
    pt_fn!(else 0; => match struct_id {
        PTL_STRUCT_PROGRESS => size_of::<ptl_progress>(),
        PTL_STRUCT_ENGINE_OPTIONS => size_of::<ptl_engine_options>(),
        PTL_STRUCT_COMPUTE_OPTIONS => size_of::<ptl_compute_options>(),
        PTL_STRUCT_IMAGE_INFO => size_of::<ptl_image_info>(),
        PTL_STRUCT_GRAPH_INFO => size_of::<ptl_graph_info>(),
        PTL_STRUCT_PARAM_INFO => size_of::<ptl_param_info>(),
        PTL_STRUCT_PORT_INFO => size_of::<ptl_port_info>(),
        PTL_STRUCT_FAULT => size_of::<ptl_fault>(),
        PTL_STRUCT_STREAM => size_of::<values::ptl_stream>(),
        PTL_STRUCT_MESH_DATA => size_of::<values::ptl_mesh_data>(),
        PTL_STRUCT_POINTS_DATA => size_of::<values::ptl_points_data>(),
        PTL_STRUCT_STRANDS_DATA => size_of::<values::ptl_strands_data>(),
        PTL_STRUCT_GRADIENT_DATA => size_of::<values::ptl_gradient_data>(),
        PTL_STRUCT_TEXT_DATA => size_of::<values::ptl_text_data>(),
        PTL_STRUCT_IMAGE_DATA => size_of::<values::ptl_image_data>(),
        PTL_STRUCT_SCAN_REPORT => size_of::<ptl_scan_report>(),
        PTL_STRUCT_BAND => size_of::<ptl_band>(),
        _ => 0,
    })
}
