//! The structs, constants and callbacks of the header.
//!
//! Structs are `repr(C)`, start with their size, have natural alignment and no padding; new fields
//! go to their ends. Zero is a value of every field, and means "as if it were not there".

use std::ffi::{c_char, c_void};

use super::{ptl_cancel, ptl_status, structs::CStruct};

/// A block of a graph; 0 is none. The handle of a removed block stays invalid, also when another
/// block takes its place. It means nothing in other graphs, except in clones of its own.
pub type ptl_block = u64;

/// How pixels are laid out: interleaved channels, rows from the top. Channels in the low byte,
/// bytes per channel in the next, then 1 if channels are floating-point numbers.
pub type ptl_format = u32;

/// As many channels as the output has; 8 bits each if values are computed in 8 bits, 32-bit
/// floating-point numbers otherwise. It loses nothing.
pub const PTL_FORMAT_AUTO: ptl_format = 0;
/// One byte a pixel.
pub const PTL_FORMAT_GREY8: ptl_format = 0x0101;
/// Red, green, blue: a byte each.
pub const PTL_FORMAT_RGB8: ptl_format = 0x0103;
/// Red, green, blue, alpha: a byte each.
pub const PTL_FORMAT_RGBA8: ptl_format = 0x0104;
/// One 16-bit number in the machine's byte order.
pub const PTL_FORMAT_GREY16: ptl_format = 0x0201;
/// Three 16-bit numbers.
pub const PTL_FORMAT_RGB16: ptl_format = 0x0203;
/// Four 16-bit numbers.
pub const PTL_FORMAT_RGBA16: ptl_format = 0x0204;
/// One float.
pub const PTL_FORMAT_GREY_F32: ptl_format = 0x0001_0401;
/// Three floats.
pub const PTL_FORMAT_RGB_F32: ptl_format = 0x0001_0403;
/// Four floats.
pub const PTL_FORMAT_RGBA_F32: ptl_format = 0x0001_0404;

/// The graph's precision: in compute options.
pub const PTL_PRECISION_DEFAULT: u32 = 0;
/// Values are multiples of 1/255, as PT Designer computes.
pub const PTL_PRECISION_8BIT: u32 = 1;
/// Values are 32-bit floating-point numbers.
pub const PTL_PRECISION_FLOAT: u32 = 2;

/// Values are sRGB-encoded, as the user sees them.
pub const PTL_COLOR_SPACE_SRGB: u32 = 1;
/// The first row is the top one.
pub const PTL_ORIGIN_TOP_LEFT: u32 = 1;

/// A whole number.
pub const PTL_PARAM_INT: u32 = 1;
/// A number.
pub const PTL_PARAM_FLOAT: u32 = 2;
/// Yes (1) or no (0).
pub const PTL_PARAM_FLAG: u32 = 3;
/// One of several alternatives: by number, or by id as a text.
pub const PTL_PARAM_CHOICE: u32 = 4;
/// A text.
pub const PTL_PARAM_TEXT: u32 = 5;
/// The path of a file.
pub const PTL_PARAM_PATH: u32 = 6;

/// In ptl_param_info: the block reads the file of this path.
pub const PTL_PARAM_READS_FILE: u32 = 1;
/// In ptl_param_info: the block writes the file of this path.
pub const PTL_PARAM_WRITES_FILE: u32 = 2;

/// In ptl_port_info: the block works without this input.
pub const PTL_PORT_OPTIONAL: u32 = 1;
/// In ptl_port_info: this output gives any finite numbers (heights, distances), not only 0 to 1.
pub const PTL_PORT_FREE_RANGE: u32 = 2;

/// Of a block type: its output is a result of the graph.
pub const PTL_BLOCK_IS_RESULT: u32 = 1;
/// Of a block type: it writes a file.
pub const PTL_BLOCK_WRITES_FILE: u32 = 2;
/// Of a block type: another seed gives another picture.
pub const PTL_BLOCK_USES_SEED: u32 = 4;
/// Of a block type: its output always tiles when its inputs do.
pub const PTL_BLOCK_TILES: u32 = 8;
/// Of a block type: its value is set by ptl_graph_set_input().
pub const PTL_BLOCK_IS_INPUT: u32 = 16;

/// In engine options: results are not kept for later computations.
pub const PTL_ENGINE_NO_CACHE: u32 = 1;

/// For ptl_value_from_mesh() and its kin: the data stays the caller's.
pub const PTL_VALUE_BORROW: u32 = 1;

/// In compute options: `seed` counts, also if it is 0.
pub const PTL_COMPUTE_SEED: u32 = 1;
/// In compute options: where a block fails, go on with a white image in its place.
pub const PTL_COMPUTE_KEEP_GOING: u32 = 2;

/// Details for whoever looks for a fault.
pub const PTL_LOG_DEBUG: i32 = 1;
/// What goes on.
pub const PTL_LOG_INFO: i32 = 2;
/// What works, but probably not as meant.
pub const PTL_LOG_WARNING: i32 = 3;
/// What failed.
pub const PTL_LOG_ERROR: i32 = 4;

/// How far a computation is.
#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct ptl_progress {
    /// Size of this struct in bytes.
    pub struct_size: u32,
    /// The stage that runs, from 0.
    pub stage: u32,
    /// Units of work that are done.
    pub units_done: u64,
    /// All units of work.
    pub units_total: u64,
    /// What is done, 0 to 1.
    pub fraction: f64,
    /// The block whose output the stage makes.
    pub block: ptl_block,
}

/// Called with how far a computation is; a nonzero result cancels it.
///
/// It is called only on the thread that is inside ptl_graph_compute(), ptl_graph_compute_into(),
/// ptl_graph_compute_bands(), ptl_graph_write_files() or ptl_job_wait(), at most every
/// progress_interval_ms and once at the end. It may call any function of this library. `progress`
/// is valid during the call. No C++ or other exception may leave it.
pub type ptl_progress_fn =
    Option<unsafe extern "C" fn(progress: *const ptl_progress, user_data: *mut c_void) -> i32>;

/// Rows of a result that are done: see ptl_graph_compute_bands().
#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct ptl_band {
    /// Size of this struct in bytes.
    pub struct_size: u32,
    /// The number of the first row in the result, from the top.
    pub first_row: u32,
    /// How many rows there are.
    pub rows: u32,
    /// Pixels of a row.
    pub width: u32,
    /// One of PTL_FORMAT_..., never PTL_FORMAT_AUTO.
    pub format: ptl_format,
    /// 0.
    pub reserved0: u32,
    /// Bytes from one row to the next.
    pub row_stride: usize,
    /// The pixels: rows * row_stride bytes, rows without gaps.
    pub pixels: *const c_void,
}

/// Called with one band of a result after the other, from the top to the bottom; a nonzero result
/// cancels the computation.
///
/// It is called only on the thread that is inside ptl_graph_compute_bands(). It may call any
/// function of this library. `band` and its pixels are valid during the call. No C++ or other
/// exception may leave it.
pub type ptl_band_fn =
    Option<unsafe extern "C" fn(band: *const ptl_band, user_data: *mut c_void) -> i32>;

/// Called with messages for the log: see ptl_engine_set_log(). `level` is one of PTL_LOG_...,
/// `message` is UTF-8 and valid during the call. No C++ or other exception may leave it.
pub type ptl_log_fn =
    Option<unsafe extern "C" fn(level: i32, message: *const c_char, user_data: *mut c_void)>;

/// Called when the library needs `user_data` no longer.
pub type ptl_free_fn = Option<unsafe extern "C" fn(user_data: *mut c_void)>;

/// What became of a file in which ptl_engine_scan_plugins() looked for a plug-in.
#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct ptl_scan_report {
    /// Size of this struct in bytes.
    pub struct_size: u32,
    /// PTL_OK if its block types can be used now; else why not.
    pub status: ptl_status,
    /// The file, or a folder that cannot be read.
    pub path: *const c_char,
    /// The id of the plug-in; empty after an error.
    pub plugin_id: *const c_char,
    /// Its version; empty after an error.
    pub plugin_version: *const c_char,
    /// The compiler that built it; empty if it does not say so, and after an error.
    pub built_with: *const c_char,
    /// What is wrong, and what to do; empty if nothing is.
    pub message: *const c_char,
    /// How many block types it has; 0 after an error.
    pub block_count: u32,
    /// 0.
    pub reserved0: u32,
}

/// Called for each file in which ptl_engine_scan_plugins() looked for a plug-in, on the thread that
/// called that. A nonzero result ends the search. `report` is valid during the call. No C++ or other
/// exception may leave it.
pub type ptl_scan_fn =
    Option<unsafe extern "C" fn(report: *const ptl_scan_report, user_data: *mut c_void) -> i32>;

/// How an engine is made. Every field that is 0 or NULL means: as usual.
#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct ptl_engine_options {
    /// Size of this struct in bytes.
    pub struct_size: u32,
    /// PTL_ENGINE_... flags.
    pub flags: u32,
    /// The most threads of one computation, the caller's included; usually one per processor.
    pub threads: u32,
    /// Must be 0.
    pub reserved0: u32,
    /// Bytes that results kept for later computations may take; usually 256 MiB.
    pub cache_bytes: u64,
    /// Limit: bytes that one computation may take at its peak.
    pub max_memory_bytes: u64,
    /// Limit: bytes of a graph file.
    pub max_file_bytes: u64,
    /// Limit: bytes of a file that a block reads.
    pub max_read_bytes: u64,
    /// Limit: blocks of a graph file.
    pub max_blocks: u32,
    /// Limit: connections of a graph file.
    pub max_connections: u32,
    /// Limit: bytes of one text parameter in a graph file.
    pub max_text_bytes: u32,
    /// Limit: symbols of the string of an L-system.
    pub max_text_symbols: u32,
    /// Limit: width and height of an image, supersampling included.
    pub max_image_side: u32,
    /// Limit: faults that are collected from one graph file.
    pub max_faults: u32,
    /// Number of `read_folders`.
    pub read_folder_count: u32,
    /// Number of `write_folders`.
    pub write_folder_count: u32,
    /// Folders (UTF-8) below which every graph may read files, besides its own folder.
    pub read_folders: *const *const c_char,
    /// Folders (UTF-8) below which graphs may write files; usually they may not.
    pub write_folders: *const *const c_char,
}

/// How a computation differs from what the graph and the engine say. Every field that is 0 or NULL
/// means: as they say.
#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct ptl_compute_options {
    /// Size of this struct in bytes.
    pub struct_size: u32,
    /// PTL_COMPUTE_... flags.
    pub flags: u32,
    /// Width of the result in pixels; give both or neither.
    pub width: u32,
    /// Height of the result in pixels.
    pub height: u32,
    /// One of PTL_FORMAT_...
    pub format: ptl_format,
    /// The most threads, the caller's included.
    pub threads: u32,
    /// The seed of blocks without their own, with the flag PTL_COMPUTE_SEED.
    pub seed: u64,
    /// The most bytes to take at the peak.
    pub memory_limit: u64,
    /// Must be 0.
    pub region: [f64; 4],
    /// The least time between two calls of `progress`; 0 for 50 ms.
    pub progress_interval_ms: u32,
    /// Each pixel is the mean of this many times this many, 1 to 6.
    pub supersampling: u32,
    /// One of PTL_PRECISION_...
    pub precision: u32,
    /// Must be 0.
    pub reserved0: u32,
    /// A request to stop; kept as long as the computation runs.
    pub cancel: *mut ptl_cancel,
    /// Called with how far the computation is.
    pub progress: ptl_progress_fn,
    /// Given to `progress`. It must stay valid until the call returns, or the job is released.
    pub user_data: *mut c_void,
    /// Must be NULL.
    pub reserved1: *mut c_void,
}

/// What an image is.
#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct ptl_image_info {
    /// Size of this struct in bytes.
    pub struct_size: u32,
    /// One of PTL_FORMAT_..., never PTL_FORMAT_AUTO.
    pub format: ptl_format,
    /// Width in pixels.
    pub width: u32,
    /// Height in pixels.
    pub height: u32,
    /// 1 (grey), 3 (red, green, blue) or 4 (and alpha).
    pub channels: u32,
    /// 1, 2 or 4.
    pub bytes_per_channel: u32,
    /// PTL_COLOR_SPACE_SRGB.
    pub color_space: u32,
    /// PTL_ORIGIN_TOP_LEFT.
    pub origin: u32,
    /// Bytes from one row to the next; rows have no gaps.
    pub row_stride: usize,
    /// Bytes of all pixels.
    pub size_bytes: usize,
}

/// What holds for a graph as a whole.
#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct ptl_graph_info {
    /// Size of this struct in bytes.
    pub struct_size: u32,
    /// Width of its results in pixels.
    pub width: u32,
    /// Height of its results in pixels.
    pub height: u32,
    /// Each pixel is the mean of this many times this many.
    pub supersampling: u32,
    /// PTL_PRECISION_8BIT or PTL_PRECISION_FLOAT.
    pub precision: u32,
    /// Number of its blocks.
    pub block_count: u32,
    /// The seed of all blocks that have none of their own.
    pub seed: u64,
}

/// A parameter of a block type. All texts are UTF-8 and live as long as the engine.
#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct ptl_param_info {
    /// Size of this struct in bytes.
    pub struct_size: u32,
    /// One of PTL_PARAM_...
    pub r#type: u32,
    /// PTL_PARAM_READS_FILE or PTL_PARAM_WRITES_FILE of a path.
    pub flags: u32,
    /// How many numbers it holds: 1, or 0 for texts and paths.
    pub components: u32,
    /// Its id in files and in this interface.
    pub id: *const c_char,
    /// Its name for a user interface.
    pub name: *const c_char,
    /// What it does, in sentences.
    pub doc: *const c_char,
    /// What its number counts, such as "px"; empty for a plain number.
    pub unit: *const c_char,
    /// The smallest value allowed.
    pub min: f64,
    /// The largest value allowed.
    pub max: f64,
    /// The smallest usual value: where a slider starts.
    pub soft_min: f64,
    /// The largest usual value: where a slider ends.
    pub soft_max: f64,
    /// Distance of neighbouring values: 1 for whole numbers, 0 for any.
    pub step: f64,
    /// What it holds unless somebody says otherwise, if that is a number.
    pub default_value: [f64; 4],
    /// The same as a text, for every type.
    pub default_text: *const c_char,
    /// Alternatives of a choice: their ids, in the order of their numbers.
    pub enum_ids: *const *const c_char,
    /// Alternatives of a choice: what they mean.
    pub enum_docs: *const *const c_char,
    /// Number of alternatives.
    pub enum_count: u32,
    /// Always 0.
    pub reserved0: u32,
}

/// An input or an output of a block type. All texts are UTF-8 and live as long as the engine.
#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct ptl_port_info {
    /// Size of this struct in bytes.
    pub struct_size: u32,
    /// One of PTL_KIND_...
    pub kind: u32,
    /// PTL_PORT_... flags.
    pub flags: u32,
    /// Channels of an output image: 1 or 3; 0 if that depends on inputs or parameters.
    pub channels: u32,
    /// Its id.
    pub id: *const c_char,
    /// Its name for a user interface.
    pub name: *const c_char,
}

/// One fault: of an error, or a warning of a graph file that was read. All texts are UTF-8 and live
/// as long as the error or the graph.
#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct ptl_fault {
    /// Size of this struct in bytes.
    pub struct_size: u32,
    /// What went wrong.
    pub status: ptl_status,
    /// Line in the file, from 1; 0 if it concerns no place of a file.
    pub line: u32,
    /// Column in characters, from 1; 0 if it concerns no place of a file.
    pub column: u32,
    /// The block that it concerns, or 0.
    pub block: ptl_block,
    /// The parameter that it concerns, or NULL.
    pub param: *const c_char,
    /// The whole message: place, fact, what is allowed, and a hint.
    pub message: *const c_char,
}

/// For ptl_abi_sizeof(): ptl_progress.
pub const PTL_STRUCT_PROGRESS: u32 = 1;
/// For ptl_abi_sizeof(): ptl_engine_options.
pub const PTL_STRUCT_ENGINE_OPTIONS: u32 = 2;
/// For ptl_abi_sizeof(): ptl_compute_options.
pub const PTL_STRUCT_COMPUTE_OPTIONS: u32 = 3;
/// For ptl_abi_sizeof(): ptl_image_info.
pub const PTL_STRUCT_IMAGE_INFO: u32 = 4;
/// For ptl_abi_sizeof(): ptl_graph_info.
pub const PTL_STRUCT_GRAPH_INFO: u32 = 5;
/// For ptl_abi_sizeof(): ptl_param_info.
pub const PTL_STRUCT_PARAM_INFO: u32 = 6;
/// For ptl_abi_sizeof(): ptl_port_info.
pub const PTL_STRUCT_PORT_INFO: u32 = 7;
/// For ptl_abi_sizeof(): ptl_fault.
pub const PTL_STRUCT_FAULT: u32 = 8;
/// For ptl_abi_sizeof(): ptl_stream.
pub const PTL_STRUCT_STREAM: u32 = 9;
/// For ptl_abi_sizeof(): ptl_mesh_data.
pub const PTL_STRUCT_MESH_DATA: u32 = 10;
/// For ptl_abi_sizeof(): ptl_points_data.
pub const PTL_STRUCT_POINTS_DATA: u32 = 11;
/// For ptl_abi_sizeof(): ptl_strands_data.
pub const PTL_STRUCT_STRANDS_DATA: u32 = 12;
/// For ptl_abi_sizeof(): ptl_gradient_data.
pub const PTL_STRUCT_GRADIENT_DATA: u32 = 13;
/// For ptl_abi_sizeof(): ptl_text_data.
pub const PTL_STRUCT_TEXT_DATA: u32 = 14;
/// For ptl_abi_sizeof(): ptl_image_data.
pub const PTL_STRUCT_IMAGE_DATA: u32 = 15;
/// For ptl_abi_sizeof(): ptl_scan_report.
pub const PTL_STRUCT_SCAN_REPORT: u32 = 16;
/// For ptl_abi_sizeof(): ptl_band.
pub const PTL_STRUCT_BAND: u32 = 17;

// SAFETY: as the head of this file says; `abi_sizes_are_stable` adds up the fields.
unsafe impl CStruct for ptl_progress {
    const NAME: &'static str = "ptl_progress";
}

// SAFETY: as the head of this file says; `abi_sizes_are_stable` adds up the fields.
unsafe impl CStruct for ptl_engine_options {
    const NAME: &'static str = "ptl_engine_options";
}

// SAFETY: as the head of this file says; `abi_sizes_are_stable` adds up the fields.
unsafe impl CStruct for ptl_compute_options {
    const NAME: &'static str = "ptl_compute_options";
}

// SAFETY: as the head of this file says; `abi_sizes_are_stable` adds up the fields.
unsafe impl CStruct for ptl_image_info {
    const NAME: &'static str = "ptl_image_info";
}

// SAFETY: as the head of this file says; `abi_sizes_are_stable` adds up the fields.
unsafe impl CStruct for ptl_graph_info {
    const NAME: &'static str = "ptl_graph_info";
}

// SAFETY: as the head of this file says; `abi_sizes_are_stable` adds up the fields.
unsafe impl CStruct for ptl_param_info {
    const NAME: &'static str = "ptl_param_info";
}

// SAFETY: as the head of this file says; `abi_sizes_are_stable` adds up the fields.
unsafe impl CStruct for ptl_port_info {
    const NAME: &'static str = "ptl_port_info";
}

// SAFETY: as the head of this file says; `abi_sizes_are_stable` adds up the fields.
unsafe impl CStruct for ptl_fault {
    const NAME: &'static str = "ptl_fault";
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::value::Format;

    #[test]
    fn formats_are_those_of_the_library() {
        let formats = [
            PTL_FORMAT_GREY8,
            PTL_FORMAT_RGB8,
            PTL_FORMAT_RGBA8,
            PTL_FORMAT_GREY16,
            PTL_FORMAT_RGB16,
            PTL_FORMAT_RGBA16,
            PTL_FORMAT_GREY_F32,
            PTL_FORMAT_RGB_F32,
            PTL_FORMAT_RGBA_F32,
        ];
        assert_eq!(formats, Format::ALL.map(|format| format as u32));
    }

    #[cfg(target_pointer_width = "64")]
    #[test]
    fn abi_sizes_are_stable() {
        assert_eq!(size_of::<ptl_progress>(), 8 + 4 * 8);
        assert_eq!(size_of::<ptl_engine_options>(), 4 * 4 + 4 * 8 + 8 * 4 + 2 * 8);
        assert_eq!(size_of::<ptl_compute_options>(), 6 * 4 + 2 * 8 + 4 * 8 + 4 * 4 + 4 * 8);
        assert_eq!(size_of::<ptl_image_info>(), 8 * 4 + 2 * 8);
        assert_eq!(size_of::<ptl_graph_info>(), 6 * 4 + 8);
        assert_eq!(size_of::<ptl_param_info>(), 4 * 4 + 4 * 8 + 9 * 8 + 3 * 8 + 2 * 4);
        assert_eq!(size_of::<ptl_port_info>(), 4 * 4 + 2 * 8);
        assert_eq!(size_of::<ptl_fault>(), 4 * 4 + 8 + 2 * 8);
        assert_eq!(size_of::<ptl_scan_report>(), 2 * 4 + 5 * 8 + 2 * 4);
    }
}
