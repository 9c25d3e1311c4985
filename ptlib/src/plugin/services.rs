//! What plug-ins may ask of the host: the tables of `ptlib_plugin_abi::services`.

use std::{
    cell::RefCell,
    ffi::{CStr, c_char, c_void},
    ptr,
};

use ptlib_plugin_abi::{services::*, *};

use super::{
    call::{Call, call_of, said},
    host::guarded,
    making::VALUES,
};
use crate::{
    block::LogLevel,
    error::{Error, ErrorKind},
    math::{convert::count, elementary, elias, hash},
};

/// A service: its id and its table.
struct Service(&'static CStr, *const c_void);

// SAFETY: the tables are constants.
unsafe impl Sync for Service {}

/// All services.
static SERVICES: [Service; 7] = [
    Service(PTLP_LOG, (&raw const LOG).cast()),
    Service(PTLP_PARALLEL, (&raw const PARALLEL).cast()),
    Service(PTLP_SCRATCH, (&raw const SCRATCH).cast()),
    Service(PTLP_NOISE, (&raw const NOISE).cast()),
    Service(PTLP_MATH, (&raw const MATH).cast()),
    Service(PTLP_VALUES, (&raw const VALUES).cast()),
    Service(PTLP_FILE, (&raw const FILE).cast()),
];

/// The table of a service; NULL for an unknown one.
pub(super) fn find(id: &CStr) -> *const c_void {
    SERVICES.iter().find(|service| service.0 == id).map_or(ptr::null(), |service| service.1)
}

static LOG: ptlp_log =
    ptlp_log { struct_size: count(size_of::<ptlp_log>()), reserved0: 0, write: Some(log_write) };

static PARALLEL: ptlp_parallel = ptlp_parallel {
    struct_size: count(size_of::<ptlp_parallel>()),
    reserved0: 0,
    run: Some(parallel_run),
};

static SCRATCH: ptlp_scratch = ptlp_scratch {
    struct_size: count(size_of::<ptlp_scratch>()),
    reserved0: 0,
    allocate: Some(scratch_allocate),
    release: Some(scratch_release),
};

static NOISE: ptlp_noise = ptlp_noise {
    struct_size: count(size_of::<ptlp_noise>()),
    reserved0: 0,
    hash: Some(noise_hash),
    uniform: Some(noise_uniform),
    elias: Some(noise_elias),
};

static FILE: ptlp_file = ptlp_file {
    struct_size: count(size_of::<ptlp_file>()),
    reserved0: 0,
    read: Some(file_read),
    write: Some(file_write),
};

static MATH: ptlp_math = ptlp_math {
    struct_size: count(size_of::<ptlp_math>()),
    reserved0: 0,
    sin: Some(math_sin),
    cos: Some(math_cos),
    tan: Some(math_tan),
    asin: Some(math_asin),
    acos: Some(math_acos),
    atan: Some(math_atan),
    atan2: Some(math_atan2),
    exp: Some(math_exp),
    exp2: Some(math_exp2),
    log: Some(math_log),
    log2: Some(math_log2),
    pow: Some(math_pow),
    tanh: Some(math_tanh),
    cbrt: Some(math_cbrt),
};

unsafe extern "C" fn math_sin(x: f64) -> f64 {
    elementary::sin64(x)
}

unsafe extern "C" fn math_cos(x: f64) -> f64 {
    elementary::cos64(x)
}

unsafe extern "C" fn math_tan(x: f64) -> f64 {
    elementary::tan64(x)
}

unsafe extern "C" fn math_asin(x: f64) -> f64 {
    elementary::asin64(x)
}

unsafe extern "C" fn math_acos(x: f64) -> f64 {
    elementary::acos64(x)
}

unsafe extern "C" fn math_atan(x: f64) -> f64 {
    elementary::atan64(x)
}

unsafe extern "C" fn math_atan2(y: f64, x: f64) -> f64 {
    elementary::atan2_64(y, x)
}

unsafe extern "C" fn math_exp(x: f64) -> f64 {
    elementary::exp64(x)
}

unsafe extern "C" fn math_exp2(x: f64) -> f64 {
    elementary::exp2_64(x)
}

unsafe extern "C" fn math_log(x: f64) -> f64 {
    elementary::log64(x)
}

unsafe extern "C" fn math_log2(x: f64) -> f64 {
    elementary::log2_64(x)
}

unsafe extern "C" fn math_pow(x: f64, y: f64) -> f64 {
    elementary::power64(x, y)
}

unsafe extern "C" fn math_tanh(x: f64) -> f64 {
    elementary::tanh64(x)
}

unsafe extern "C" fn math_cbrt(x: f64) -> f64 {
    elementary::cbrt64(x)
}

thread_local! {
    /// What a plug-in said outside of a call, while this thread loads it.
    static OUTSIDE: RefCell<Vec<(LogLevel, Error)>> = const { RefCell::new(Vec::new()) };
}

/// What plug-ins said on this thread outside of calls since this was asked last.
pub(super) fn said_outside() -> Vec<(LogLevel, Error)> {
    OUTSIDE.take()
}

unsafe extern "C" fn log_write(
    _: *const ptlp_host,
    job: *const ptlp_job,
    level: i32,
    utf8: *const c_char,
) {
    // SAFETY: the contract.
    let (call, text) = unsafe { (call_of(job), said(utf8)) };
    let level = match level {
        ..=PTLP_LOG_DEBUG => LogLevel::Debug,
        PTLP_LOG_INFO => LogLevel::Info,
        PTLP_LOG_WARNING => LogLevel::Warning,
        _ => LogLevel::Error,
    };
    guarded((), || {
        let message = Error::new(ErrorKind::PluginFailed, text);
        match call {
            Some(call) => (call.means.tell)(level, message),
            None => OUTSIDE.with_borrow_mut(|said| said.push((level, message))),
        }
    });
}

/// Something that a plug-in hands from thread to thread.
struct Handed(*mut c_void);

// SAFETY: the contract: a task may be run on any thread.
unsafe impl Sync for Handed {}

unsafe extern "C" fn parallel_run(
    job: *const ptlp_job,
    tasks: u32,
    task: ptlp_task_fn,
    user_data: *mut c_void,
) -> ptlp_status {
    // SAFETY: the contract.
    let (Some(call), Some(task)) = (unsafe { call_of(job) }, task) else {
        return PTLP_E_INVALID_ARGUMENT;
    };
    let user_data = Handed(user_data);
    guarded(PTLP_E_FAILED, || {
        let (user_data, failed) = (&user_data, std::sync::Mutex::new(None));
        let run = |number: usize| {
            let index = u32::try_from(number).unwrap_or(u32::MAX);
            // SAFETY: the contract.
            match unsafe { task(user_data.0, index) } {
                PTLP_OK => Ok(()),
                status => {
                    let mut failed =
                        failed.lock().unwrap_or_else(std::sync::PoisonError::into_inner);
                    if failed.is_none_or(|(earlier, _)| number < earlier) {
                        *failed = Some((number, status));
                    }
                    Err(Error::new(ErrorKind::PluginFailed, "a task failed"))
                }
            }
        };
        let done = call.means.progress.parallel(tasks as usize, &run);
        if tasks > 1 {
            // Between tasks the host asks in the plug-in's place.
            call.note_asked();
        }
        let failed = failed.into_inner().unwrap_or_else(std::sync::PoisonError::into_inner);
        match (failed, done) {
            (Some((_, status)), _) => status,
            (None, Ok(())) => PTLP_OK,
            (None, Err(error)) => error.kind() as ptlp_status,
        }
    })
}

unsafe extern "C" fn scratch_allocate(job: *const ptlp_job, size: usize) -> *mut c_void {
    // SAFETY: the contract.
    let Some(call) = (unsafe { call_of(job) }) else { return ptr::null_mut() };
    guarded(ptr::null_mut(), || {
        call.allocate(size).unwrap_or_else(|error| {
            call.fail(error);
            ptr::null_mut()
        })
    })
}

unsafe extern "C" fn scratch_release(job: *const ptlp_job, memory: *mut c_void) {
    // SAFETY: the contract.
    if let Some(call) = unsafe { call_of(job) } {
        guarded((), || call.release(memory));
    }
}

unsafe extern "C" fn noise_hash(seed: u64, item: u32, part: u32, channel: u32) -> u32 {
    hash::hash(seed, item, part, channel)
}

unsafe extern "C" fn noise_uniform(seed: u64, item: u32, part: u32, channel: u32) -> f32 {
    hash::uniform(seed, item, part, channel)
}

unsafe extern "C" fn noise_elias(index: i32) -> f64 {
    elias::noise64(index)
}

/// The call, and a path that it names.
///
/// # Safety
/// The contract.
unsafe fn path_of<'a>(
    job: *const ptlp_job,
    path: *const c_char,
) -> Result<(&'a Call<'a>, &'a str), ptlp_status> {
    // SAFETY: the contract.
    let Some(call) = (unsafe { call_of(job) }) else { return Err(PTLP_E_INVALID_ARGUMENT) };
    if path.is_null() {
        let error = Error::new(ErrorKind::InvalidArgument, "the path is NULL");
        return Err(call.fail(error));
    }
    // SAFETY: not NULL, and a text of the contract ends with NUL.
    let path = unsafe { CStr::from_ptr(path) }
        .to_str()
        .map_err(|_| call.fail(Error::new(ErrorKind::InvalidArgument, "the path is not UTF-8")))?;
    Ok((call, path))
}

unsafe extern "C" fn file_read(
    job: *const ptlp_job,
    path: *const c_char,
    data: *mut *const c_void,
    size: *mut usize,
) -> ptlp_status {
    // SAFETY: the contract.
    let (call, path) = match unsafe { path_of(job, path) } {
        Ok(found) => found,
        Err(status) => return status,
    };
    guarded(PTLP_E_FAILED, || {
        let Some(files) = call.means.files else { return call.fail(not_now()) };
        if data.is_null() || size.is_null() {
            let error = Error::new(ErrorKind::InvalidArgument, "`data` or `size` is NULL");
            return call.fail(error);
        }
        match files.read(path) {
            Ok(bytes) => {
                // SAFETY: not NULL, and the plug-in's to write; the bytes live as long as the call.
                unsafe {
                    data.write(bytes.as_ptr().cast());
                    size.write(bytes.len());
                }
                call.keep(bytes);
                PTLP_OK
            }
            Err(error) => call.fail(error),
        }
    })
}

fn not_now() -> Error {
    let message = "files are read and written in `prepare`, or in `compute` of the shape WHOLE";
    Error::new(ErrorKind::Unsupported, message)
}

unsafe extern "C" fn file_write(
    job: *const ptlp_job,
    path: *const c_char,
    data: *const c_void,
    size: usize,
) -> ptlp_status {
    // SAFETY: the contract.
    let (call, path) = match unsafe { path_of(job, path) } {
        Ok(found) => found,
        Err(status) => return status,
    };
    guarded(PTLP_E_FAILED, || {
        let Some(files) = call.means.files else { return call.fail(not_now()) };
        if data.is_null() && size > 0 {
            return call.fail(Error::new(ErrorKind::InvalidArgument, "`data` is NULL"));
        }
        let bytes: &[u8] = match size {
            0 => &[],
            // SAFETY: not NULL, and as long as its size says.
            size => unsafe { std::slice::from_raw_parts(data.cast(), size) },
        };
        files.write(path, bytes).map_or_else(|error| call.fail(error), |()| PTLP_OK)
    })
}
