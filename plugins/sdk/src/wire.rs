//! What is at an input.

use ptlib_plugin_abi::{values::*, *};

use crate::{Gradient, Image, Mesh, Points, Strands};

/// # Safety
/// `first` is NULL, or leads to `count` values for as long as `'a`.
pub(crate) unsafe fn slice<'a, T>(first: *const T, count: usize) -> &'a [T] {
    if first.is_null() || count == 0 {
        return &[];
    }
    // SAFETY: the caller's promise.
    unsafe { std::slice::from_raw_parts(first, count) }
}

/// The value of a wire, if it is of that kind.
///
/// # Safety
/// `T` is what the contract says about wires of that kind.
unsafe fn value<T>(wire: &ptlp_wire, kind: u32) -> Option<&T> {
    if wire.kind != kind {
        return None;
    }
    // SAFETY: the contract: NULL, or a value that lives as long as the wire.
    unsafe { wire.value.cast::<T>().as_ref() }
}

pub(crate) fn is_connected(wire: &ptlp_wire) -> bool {
    wire.kind != PTL_KIND_NONE
}

pub(crate) fn image(wire: &ptlp_wire) -> Option<Image<'_>> {
    // SAFETY: the contract.
    unsafe { value::<ptlp_tile>(wire, PTL_KIND_IMAGE).map(|tile| Image::new(tile)) }
}

pub(crate) fn text(wire: &ptlp_wire) -> Option<&str> {
    // SAFETY: the contract.
    let bytes = unsafe {
        let text = value::<ptl_text_data>(wire, PTL_KIND_TEXT)?;
        slice(text.text.cast::<u8>(), text.size)
    };
    std::str::from_utf8(bytes).ok()
}

pub(crate) fn gradient(wire: &ptlp_wire) -> Option<Gradient<'_>> {
    // SAFETY: the contract.
    unsafe { value::<ptl_gradient_data>(wire, PTL_KIND_GRADIENT).map(|data| Gradient::new(data)) }
}

pub(crate) fn mesh(wire: &ptlp_wire) -> Option<Mesh<'_>> {
    // SAFETY: the contract.
    unsafe { value::<ptl_mesh_data>(wire, PTL_KIND_MESH).map(Mesh) }
}

pub(crate) fn points(wire: &ptlp_wire) -> Option<Points<'_>> {
    // SAFETY: the contract.
    unsafe { value::<ptl_points_data>(wire, PTL_KIND_POINTS).map(Points) }
}

pub(crate) fn strands(wire: &ptlp_wire) -> Option<Strands<'_>> {
    // SAFETY: the contract.
    unsafe { value::<ptl_strands_data>(wire, PTL_KIND_STRANDS).map(Strands) }
}
