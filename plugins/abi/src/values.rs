//! What flows on wires besides the engine's own images: `ptlib_values.h`.
//!
//! Meshes, points and strands are counts and *streams*. A stream is found by its id, so that new
//! data needs no new struct: `position` (3 floats, mandatory), `normal`, `direction` (3), `texcoord`,
//! `texcoord1` (2), `tangent` (4, the last ±1), `color` (3 or 4), `radius`, `random`, `loss age`
//! (1), `id` (2 whole numbers). Others pass through untouched.

use std::ffi::{c_char, c_void};

use abi_stable::StableAbi;

/// No value: the input is not connected.
pub const PTL_KIND_NONE: u32 = 0;
/// An image.
pub const PTL_KIND_IMAGE: u32 = 1;
/// A colour transition: [`ptl_gradient_data`].
pub const PTL_KIND_GRADIENT: u32 = 2;
/// A text of any meaning: [`ptl_text_data`].
pub const PTL_KIND_TEXT: u32 = 3;
/// Points, each perhaps with more data: [`ptl_points_data`].
pub const PTL_KIND_POINTS: u32 = 4;
/// Triangles: [`ptl_mesh_data`].
pub const PTL_KIND_MESH: u32 = 5;
/// Polylines, such as hairs: [`ptl_strands_data`].
pub const PTL_KIND_STRANDS: u32 = 6;
/// Reserved.
pub const PTL_KIND_VOLUME: u32 = 7;

/// The stream holds 32-bit floating-point numbers.
pub const PTL_STREAM_F32: u32 = 1;
/// The stream holds unsigned 32-bit whole numbers.
pub const PTL_STREAM_U32: u32 = 2;

/// Flag of a stream: one element serves all.
pub const PTL_STREAM_CONSTANT: u32 = 1;

/// One kind of data of each element.
#[repr(C)]
#[derive(Debug, Clone, Copy, StableAbi)]
pub struct ptl_stream {
    /// Size of this struct in bytes.
    pub struct_size: u32,
    /// `PTL_STREAM_F32` or `PTL_STREAM_U32`.
    pub r#type: u32,
    /// Numbers of an element, 1 to 4.
    pub components: u32,
    /// `PTL_STREAM_CONSTANT` or 0.
    pub flags: u32,
    /// What it means: ASCII.
    pub id: *const c_char,
    /// Element `i` lies at `(const char *)data + i * stride`.
    pub data: *const c_void,
    /// Bytes from one element to the next: a multiple of 4.
    pub stride: usize,
}

/// Triangles.
#[repr(C)]
#[derive(Debug, Clone, Copy, StableAbi)]
pub struct ptl_mesh_data {
    /// Size of this struct in bytes.
    pub struct_size: u32,
    /// 0.
    pub flags: u32,
    /// Elements of each stream.
    pub vertex_count: u32,
    /// Three for each triangle.
    pub index_count: u32,
    /// Numbers of vertices, three for each triangle.
    pub indices: *const u32,
    /// Data of the vertices.
    pub streams: *const *const ptl_stream,
    /// How many streams.
    pub stream_count: u32,
    /// 0.
    pub reserved0: u32,
    /// The smallest coordinates; computed by the library.
    pub bounds_min: [f32; 3],
    /// The largest coordinates; computed by the library.
    pub bounds_max: [f32; 3],
}

/// Points.
#[repr(C)]
#[derive(Debug, Clone, Copy, StableAbi)]
pub struct ptl_points_data {
    /// Size of this struct in bytes.
    pub struct_size: u32,
    /// 0.
    pub flags: u32,
    /// Elements of each stream.
    pub point_count: u32,
    /// How many streams.
    pub stream_count: u32,
    /// Data of the points.
    pub streams: *const *const ptl_stream,
    /// The smallest coordinates; computed by the library.
    pub bounds_min: [f32; 3],
    /// The largest coordinates; computed by the library.
    pub bounds_max: [f32; 3],
}

/// Polylines.
#[repr(C)]
#[derive(Debug, Clone, Copy, StableAbi)]
pub struct ptl_strands_data {
    /// Size of this struct in bytes.
    pub struct_size: u32,
    /// 0.
    pub flags: u32,
    /// How many strands.
    pub strand_count: u32,
    /// Points of all strands together.
    pub point_count: u32,
    /// Strand `i` has the points from `first_point[i]` to before `first_point[i + 1]`: one entry
    /// more than strands.
    pub first_point: *const u32,
    /// Data of the points.
    pub point_streams: *const *const ptl_stream,
    /// Data of the strands.
    pub strand_streams: *const *const ptl_stream,
    /// How many streams of points.
    pub point_stream_count: u32,
    /// How many streams of strands.
    pub strand_stream_count: u32,
    /// The smallest coordinates; computed by the library.
    pub bounds_min: [f32; 3],
    /// The largest coordinates; computed by the library.
    pub bounds_max: [f32; 3],
}

/// A colour at a position of a colour transition.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, StableAbi)]
pub struct ptl_gradient_stop {
    /// Where, 0 to 1.
    pub position: f32,
    /// Red, green, blue, each 0 to 1.
    pub color: [f32; 3],
}

/// A colour transition.
#[repr(C)]
#[derive(Debug, Clone, Copy, StableAbi)]
pub struct ptl_gradient_data {
    /// Size of this struct in bytes.
    pub struct_size: u32,
    /// How many stops.
    pub stop_count: u32,
    /// The stops.
    pub stops: *const ptl_gradient_stop,
}

/// A text.
#[repr(C)]
#[derive(Debug, Clone, Copy, StableAbi)]
pub struct ptl_text_data {
    /// Size of this struct in bytes.
    pub struct_size: u32,
    /// 0.
    pub flags: u32,
    /// UTF-8. Texts that the library gives have a NUL behind them.
    pub text: *const c_char,
    /// Bytes, without a NUL.
    pub size: usize,
}

/// Pixels of a caller.
#[repr(C)]
#[derive(Debug, Clone, Copy, StableAbi)]
pub struct ptl_image_data {
    /// Size of this struct in bytes.
    pub struct_size: u32,
    /// One of `PTL_FORMAT_…`, not AUTO.
    pub format: u32,
    /// Width in pixels.
    pub width: u32,
    /// Height in pixels.
    pub height: u32,
    /// Rows from the top.
    pub pixels: *const c_void,
    /// Bytes from one row to the next; 0 for rows without gaps.
    pub row_stride: usize,
}
