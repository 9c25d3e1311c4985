//! What a plug-in may ask of the host: tables found by id at
//! [`get_extension`](crate::ptlp_host::get_extension). A table of an id never changes.
//!
//! They are behind a `void` pointer, where `abi_stable` cannot follow: the id stands for the layout.

use std::ffi::{CStr, c_char, c_void};

use crate::{
    ptlp_host, ptlp_job, ptlp_status,
    values::{ptl_gradient_stop, ptl_mesh_data, ptl_points_data, ptl_strands_data},
};

/// The id of [`ptlp_log`].
pub const PTLP_LOG: &CStr = c"ptl.log/1";
/// The id of [`ptlp_parallel`].
pub const PTLP_PARALLEL: &CStr = c"ptl.parallel/1";
/// The id of [`ptlp_scratch`].
pub const PTLP_SCRATCH: &CStr = c"ptl.scratch/1";
/// The id of [`ptlp_noise`].
pub const PTLP_NOISE: &CStr = c"ptl.noise/1";
/// The id of [`ptlp_math`].
pub const PTLP_MATH: &CStr = c"ptl.math/1";
/// The id of [`ptlp_values`].
pub const PTLP_VALUES: &CStr = c"ptl.values/1";
/// The id of [`ptlp_file`].
pub const PTLP_FILE: &CStr = c"ptl.file/1";

/// Details for whoever looks for a fault.
pub const PTLP_LOG_DEBUG: i32 = 1;
/// What goes on.
pub const PTLP_LOG_INFO: i32 = 2;
/// What works, but probably not as meant.
pub const PTLP_LOG_WARNING: i32 = 3;
/// What failed.
pub const PTLP_LOG_ERROR: i32 = 4;

/// Messages for the log. Plug-ins never write to the standard output.
#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct ptlp_log {
    /// Size of this struct in bytes.
    pub struct_size: u32,
    /// 0.
    pub reserved0: u32,
    /// Writes a line; `level` is one of `PTLP_LOG_…`. `job` may be NULL outside of a call.
    pub write: Option<
        unsafe extern "C" fn(
            host: *const ptlp_host,
            job: *const ptlp_job,
            level: i32,
            utf8: *const c_char,
        ),
    >,
}

/// One part of parallel work.
pub type ptlp_task_fn =
    Option<unsafe extern "C" fn(user_data: *mut c_void, index: u32) -> ptlp_status>;

/// Work on all threads of the computation.
#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct ptlp_parallel {
    /// Size of this struct in bytes.
    pub struct_size: u32,
    /// 0.
    pub reserved0: u32,
    /// Runs `task` for 0 to before `count`, in any order, and waits for all. After an error, or
    /// when the computation is cancelled, no further task starts. Returns the error of the task of
    /// the lowest number.
    pub run: Option<
        unsafe extern "C" fn(
            job: *const ptlp_job,
            count: u32,
            task: ptlp_task_fn,
            user_data: *mut c_void,
        ) -> ptlp_status,
    >,
}

/// Memory for the time of a call.
#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct ptlp_scratch {
    /// Size of this struct in bytes.
    pub struct_size: u32,
    /// 0.
    pub reserved0: u32,
    /// Memory of `size` bytes, zeroed, 64-byte aligned; NULL if there is none or the limit is
    /// reached. It is freed when the call of `prepare` or `compute` returns.
    pub allocate: Option<unsafe extern "C" fn(job: *const ptlp_job, size: usize) -> *mut c_void>,
    /// Frees it before that. NULL is fine.
    pub release: Option<unsafe extern "C" fn(job: *const ptlp_job, memory: *mut c_void)>,
}

/// The engine's random numbers, so that plug-ins agree with it bit for bit.
#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct ptlp_noise {
    /// Size of this struct in bytes.
    pub struct_size: u32,
    /// 0.
    pub reserved0: u32,
    /// 32 random bits of a seed and three numbers, such as an item, a part of it and a channel.
    pub hash: Option<unsafe extern "C" fn(seed: u64, item: u32, part: u32, channel: u32) -> u32>,
    /// A number of [0, 1): the upper 24 bits of [`hash`](Self::hash).
    pub uniform: Option<unsafe extern "C" fn(seed: u64, item: u32, part: u32, channel: u32) -> f32>,
    /// The noise that the blocks of PT Designer draw from, uniform on (-1, 1].
    pub elias: Option<unsafe extern "C" fn(index: i32) -> f64>,
}

/// A function of one number.
pub type ptlp_function = Option<unsafe extern "C" fn(x: f64) -> f64>;

/// A function of two numbers.
pub type ptlp_function2 = Option<unsafe extern "C" fn(x: f64, y: f64) -> f64>;

/// The engine's transcendental functions: the same bits on every platform.
#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct ptlp_math {
    /// Size of this struct in bytes.
    pub struct_size: u32,
    /// 0.
    pub reserved0: u32,
    /// Sine of an angle in radians.
    pub sin: ptlp_function,
    /// Cosine of an angle in radians.
    pub cos: ptlp_function,
    /// Tangent of an angle in radians.
    pub tan: ptlp_function,
    /// Angle whose sine is `x`.
    pub asin: ptlp_function,
    /// Angle whose cosine is `x`.
    pub acos: ptlp_function,
    /// Angle whose tangent is `x`.
    pub atan: ptlp_function,
    /// Angle of the point (`y`, `x`), in this order.
    pub atan2: ptlp_function2,
    /// e to the power of `x`.
    pub exp: ptlp_function,
    /// 2 to the power of `x`.
    pub exp2: ptlp_function,
    /// Natural logarithm.
    pub log: ptlp_function,
    /// Logarithm of base 2.
    pub log2: ptlp_function,
    /// `x` to the power of `y`.
    pub pow: ptlp_function2,
    /// Hyperbolic tangent.
    pub tanh: ptlp_function,
    /// Cube root.
    pub cbrt: ptlp_function,
}

/// Values for outputs that are no images. Only for blocks of shape Whole, in `compute`.
///
/// `…_begin` takes counts and streams (type, components, flags, id) in its struct, and gives the
/// same struct with memory of the host in it: zeroed, 64-byte aligned, to be written until
/// `finish`. A stream whose `data` is not NULL must be one of an input of this call: its first
/// elements, as many as are needed, are shared, not copied. So are `indices` and `first_point`,
/// which must be whole.
#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct ptlp_values {
    /// Size of this struct in bytes.
    pub struct_size: u32,
    /// 0.
    pub reserved0: u32,
    /// Begins a mesh for output `output`.
    pub mesh_begin: Option<
        unsafe extern "C" fn(
            job: *const ptlp_job,
            output: u32,
            mesh: *mut ptl_mesh_data,
        ) -> ptlp_status,
    >,
    /// Begins points for output `output`.
    pub points_begin: Option<
        unsafe extern "C" fn(
            job: *const ptlp_job,
            output: u32,
            points: *mut ptl_points_data,
        ) -> ptlp_status,
    >,
    /// Begins strands for output `output`.
    pub strands_begin: Option<
        unsafe extern "C" fn(
            job: *const ptlp_job,
            output: u32,
            strands: *mut ptl_strands_data,
        ) -> ptlp_status,
    >,
    /// Checks what was begun for an output, and freezes it. After an error, which says what is
    /// wrong, the value is gone.
    pub finish: Option<unsafe extern "C" fn(job: *const ptlp_job, output: u32) -> ptlp_status>,
    /// Gives an output a text of `size` bytes in UTF-8, which is copied.
    pub text: Option<
        unsafe extern "C" fn(
            job: *const ptlp_job,
            output: u32,
            utf8: *const c_char,
            size: usize,
        ) -> ptlp_status,
    >,
    /// Gives an output a colour transition of `count` stops, which are copied.
    pub gradient: Option<
        unsafe extern "C" fn(
            job: *const ptlp_job,
            output: u32,
            stops: *const ptl_gradient_stop,
            count: u32,
        ) -> ptlp_status,
    >,
    /// Gives an output the value of an input of the same kind, without a copy.
    pub pass:
        Option<unsafe extern "C" fn(job: *const ptlp_job, output: u32, input: u32) -> ptlp_status>,
}

/// Files that parameters name, as the caller's policy lets them be read.
#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct ptlp_file {
    /// Size of this struct in bytes.
    pub struct_size: u32,
    /// 0.
    pub reserved0: u32,
    /// The bytes of the file at a path that a parameter has; they live until the call returns.
    pub read: Option<
        unsafe extern "C" fn(
            job: *const ptlp_job,
            path: *const c_char,
            data: *mut *const c_void,
            size: *mut usize,
        ) -> ptlp_status,
    >,
    /// Writes a whole file below a folder that the caller opened for writing. An existing file is
    /// replaced.
    pub write: Option<
        unsafe extern "C" fn(
            job: *const ptlp_job,
            path: *const c_char,
            data: *const c_void,
            size: usize,
        ) -> ptlp_status,
    >,
}
