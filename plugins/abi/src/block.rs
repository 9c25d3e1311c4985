//! Block types: what they take, give and do.

use std::ffi::{c_char, c_void};

use abi_stable::StableAbi;

use crate::{ptlp_host, ptlp_job, ptlp_status};

/// Shape: a part of a row from the same part of each input and the position.
pub const PTLP_SHAPE_POINT: u32 = 1;
/// Shape: a row from whole inputs.
pub const PTLP_SHAPE_GATHER: u32 = 2;
/// Shape: everything in one call.
pub const PTLP_SHAPE_WHOLE: u32 = 3;

/// Threads: `compute` of one instance runs on several threads at a time.
pub const PTLP_THREADS_TILES: u32 = 1;
/// Threads: each instance is used by one thread at a time; the host makes several.
pub const PTLP_THREADS_INSTANCE: u32 = 2;
/// Threads: one function of this block type runs at a time, in the whole process.
pub const PTLP_THREADS_GLOBAL: u32 = 3;

/// Flag of a block: another seed gives another result.
pub const PTLP_BLOCK_USES_SEED: u32 = 1;
/// Flag of a block: the caller of a graph sets its one output; it has no functions.
pub const PTLP_BLOCK_GRAPH_INPUT: u32 = 2;
/// Flag of a block: with the same inputs and parameters it may give something else; its results
/// are not kept.
pub const PTLP_BLOCK_NOT_DETERMINISTIC: u32 = 4;

/// Flag of an input: the block works without it.
pub const PTLP_PORT_OPTIONAL: u32 = 1;
/// Flag of an image input: it is read anywhere, not only at the place that is written.
pub const PTLP_PORT_ANYWHERE: u32 = 2;
/// Flag of an image output: its numbers are any finite ones, not 0 to 1.
pub const PTLP_PORT_FREE_RANGE: u32 = 4;

/// Planes of an image output: one.
pub const PTLP_PLANES_GREY: u32 = 1;
/// Planes of an image output: red, green, blue.
pub const PTLP_PLANES_COLOUR: u32 = 3;
/// Planes of an image output: red, green, blue, alpha.
pub const PTLP_PLANES_COLOUR_ALPHA: u32 = 4;
/// Planes of an image output: those of the input that `planes_input` numbers.
pub const PTLP_PLANES_AS_INPUT: u32 = 16;
/// Planes of an image output: those of the image input that has the most.
pub const PTLP_PLANES_MOST: u32 = 17;

/// A whole number.
pub const PTLP_PARAM_INT: u32 = 1;
/// A finite number.
pub const PTLP_PARAM_FLOAT: u32 = 2;
/// Yes (1) or no (0).
pub const PTLP_PARAM_FLAG: u32 = 3;
/// One of several alternatives, by number from 0.
pub const PTLP_PARAM_CHOICE: u32 = 4;
/// A text.
pub const PTLP_PARAM_TEXT: u32 = 5;
/// The path of a file.
pub const PTLP_PARAM_PATH: u32 = 6;

/// Flag of a path: the block reads that file (through `ptl.file/1`).
pub const PTLP_PARAM_READS_FILE: u32 = 1;

/// In 8-bit precision the host truncates what is stored to multiples of 1/255.
pub const PTLP_PRECISION_8BIT: u32 = 1;
/// Real numbers.
pub const PTLP_PRECISION_FLOAT: u32 = 2;

/// An input or an output.
#[repr(C)]
#[derive(Debug, Clone, Copy, StableAbi)]
pub struct ptlp_port {
    /// Size of this struct in bytes.
    pub struct_size: u32,
    /// One of `PTL_KIND_…`.
    pub kind: u32,
    /// `PTLP_PORT_…`.
    pub flags: u32,
    /// Of an image output: one of `PTLP_PLANES_…`. Otherwise 0.
    pub planes: u32,
    /// For `PTLP_PLANES_AS_INPUT`: which input. Otherwise 0.
    pub planes_input: u32,
    /// 0.
    pub reserved0: u32,
    /// Its id: lower-case words separated by single blanks, for ever.
    pub id: *const c_char,
    /// What it is, in one sentence; may be NULL.
    pub doc: *const c_char,
}

/// A parameter.
#[repr(C)]
#[derive(Debug, Clone, Copy, StableAbi)]
pub struct ptlp_param {
    /// Size of this struct in bytes.
    pub struct_size: u32,
    /// One of `PTLP_PARAM_…`.
    pub r#type: u32,
    /// `PTLP_PARAM_READS_FILE` or 0.
    pub flags: u32,
    /// How many alternatives a choice has.
    pub choice_count: u32,
    /// The smallest number that the block computes with.
    pub min: f64,
    /// The largest number that the block computes with.
    pub max: f64,
    /// Where an editor's slider starts.
    pub soft_min: f64,
    /// Where an editor's slider ends.
    pub soft_max: f64,
    /// The number, flag (0 or 1) or alternative that it has unless somebody says otherwise.
    pub default_value: f64,
    /// Its id: lower-case words separated by single blanks, for ever.
    pub id: *const c_char,
    /// What it does, in sentences.
    pub doc: *const c_char,
    /// What its number counts, such as `px`; NULL or empty for a plain number.
    pub unit: *const c_char,
    /// The same for a text or a path; NULL is the empty text.
    pub default_text: *const c_char,
    /// The ids of a choice's alternatives, for ever; the list only grows at its end.
    pub choice_ids: *const *const c_char,
    /// What each alternative means, one line; NULL if nothing is said.
    pub choice_docs: *const *const c_char,
}

/// The value of a parameter, in its range.
#[repr(C)]
#[derive(Debug, Clone, Copy, StableAbi)]
pub struct ptlp_value {
    /// One of `PTLP_PARAM_…`.
    pub r#type: u32,
    /// 0.
    pub reserved0: u32,
    /// A whole number, a flag or an alternative.
    pub integer: i64,
    /// A number; of the types above, the same as `integer`.
    pub number: f64,
    /// A text or a path, UTF-8; otherwise NULL.
    pub text: *const c_char,
    /// NULL.
    pub reserved1: *const c_void,
}

/// A rectangle of an image: planes of floats.
///
/// Sample (x, y) of the rectangle in channel c is `planes[c][y * row_stride + x]`. A grey image
/// has its one plane as red, green and blue; `planes[3]` is NULL if there is no alpha.
#[repr(C)]
#[derive(Debug, Clone, Copy, StableAbi)]
pub struct ptlp_tile {
    /// Size of this struct in bytes.
    pub struct_size: u32,
    /// Planes: 1, 3 or 4.
    pub channels: u32,
    /// Column of its left edge in the image.
    pub x: u32,
    /// Row of its top edge in the image.
    pub y: u32,
    /// Width in pixels.
    pub width: u32,
    /// Height in pixels.
    pub height: u32,
    /// Width of the whole image.
    pub image_width: u32,
    /// Height of the whole image.
    pub image_height: u32,
    /// Floats from one row to the next.
    pub row_stride: usize,
    /// Red, green, blue, alpha. Those of inputs are only to be read.
    pub planes: [*mut f32; 4],
}

/// What is at an input or an output.
#[repr(C)]
#[derive(Debug, Clone, Copy, StableAbi)]
pub struct ptlp_wire {
    /// Size of this struct in bytes.
    pub struct_size: u32,
    /// One of `PTL_KIND_…`; `PTL_KIND_NONE` if the input is not connected.
    pub kind: u32,
    /// A [`ptlp_tile`], or one of the structs of [`values`](crate::values), by the kind. NULL at
    /// an output that is no image: its value is made with `ptl.values/1`.
    pub value: *const c_void,
}

/// What an instance prepares itself from.
#[repr(C)]
#[derive(Debug, Clone, Copy, StableAbi)]
pub struct ptlp_setup {
    /// Size of this struct in bytes.
    pub struct_size: u32,
    /// 0.
    pub flags: u32,
    /// Width of the images to make in pixels, supersampling included.
    pub width: u32,
    /// Height of the images to make in pixels, supersampling included.
    pub height: u32,
    /// `PTLP_PRECISION_8BIT` or `PTLP_PRECISION_FLOAT`.
    pub precision: u32,
    /// How many parameters.
    pub value_count: u32,
    /// How many inputs.
    pub input_count: u32,
    /// 0.
    pub reserved0: u32,
    /// The seed of the block in its graph.
    pub seed: u64,
    /// The values of the parameters, in the order of their declarations.
    pub values: *const *const ptlp_value,
    /// The inputs. An image that only comes row by row has its channels here, but no planes.
    pub inputs: *const *const ptlp_wire,
}

/// A block type.
#[repr(C)]
#[derive(Debug, Clone, Copy, StableAbi)]
pub struct ptlp_block {
    /// Size of this struct in bytes.
    pub struct_size: u32,
    /// The version of the block type: counts up whenever its results change.
    pub version: u32,
    /// One of `PTLP_SHAPE_…`.
    pub shape: u32,
    /// One of `PTLP_THREADS_…`.
    pub thread_mode: u32,
    /// `PTLP_BLOCK_…`.
    pub flags: u32,
    /// How many inputs.
    pub input_count: u32,
    /// How many outputs, at least 1.
    pub output_count: u32,
    /// How many parameters.
    pub param_count: u32,
    /// `vendor.name`, lower-case words separated by single blanks, for ever. `ptl.` is reserved.
    pub id: *const c_char,
    /// What people call it; NULL: what stands behind the point of its id.
    pub name: *const c_char,
    /// The family that it is listed with, such as `noise`.
    pub category: *const c_char,
    /// What it makes, in one sentence.
    pub doc: *const c_char,
    /// Why its output need not tile although its inputs do; NULL if it always tiles.
    pub tiling_exception: *const c_char,
    /// Which of its lengths count pixels, so that the picture depends on the resolution; NULL if
    /// none does.
    pub in_pixels: *const c_char,
    /// The inputs.
    pub inputs: *const *const ptlp_port,
    /// The outputs.
    pub outputs: *const *const ptlp_port,
    /// The parameters.
    pub params: *const *const ptlp_param,
    /// For the plug-in.
    pub user_data: *mut c_void,
    /// Makes an instance. NULL: the block has no state, and its instance is NULL.
    pub create: Option<
        unsafe extern "C" fn(
            block: *const ptlp_block,
            host: *const ptlp_host,
            instance: *mut *mut c_void,
        ) -> ptlp_status,
    >,
    /// Ends an instance; also after `prepare` or `compute` failed. NULL if there is nothing to do.
    pub destroy: Option<unsafe extern "C" fn(instance: *mut c_void)>,
    /// Prepares an instance, once, for one computation. NULL if there is nothing to do.
    pub prepare: Option<
        unsafe extern "C" fn(
            instance: *mut c_void,
            job: *const ptlp_job,
            setup: *const ptlp_setup,
        ) -> ptlp_status,
    >,
    /// Writes all of each output.
    pub compute: Option<
        unsafe extern "C" fn(
            instance: *mut c_void,
            job: *const ptlp_job,
            inputs: *const *const ptlp_wire,
            outputs: *const *const ptlp_wire,
        ) -> ptlp_status,
    >,
    /// The most memory in bytes that an instance takes, besides its outputs and what it takes from
    /// `ptl.scratch/1`. Its setup has no inputs. NULL: little.
    pub memory:
        Option<unsafe extern "C" fn(block: *const ptlp_block, setup: *const ptlp_setup) -> u64>,
}

// SAFETY: tables are made once, by a plug-in, and only read from then on.
unsafe impl Sync for ptlp_port {}
// SAFETY: as above.
unsafe impl Sync for ptlp_param {}
// SAFETY: as above; `user_data` is for functions that may be called from any thread.
unsafe impl Sync for ptlp_block {}
