//! One call into a plug-in: what the plug-in may ask meanwhile, what it said, what it borrowed.

use std::{
    ffi::{CStr, c_char, c_void},
    ptr,
    sync::{
        Arc, Mutex, MutexGuard, PoisonError,
        atomic::{AtomicBool, Ordering},
    },
    time::{Duration, Instant},
};

use ptlib_plugin_abi::*;

use super::{host::guarded, making::Making};
use crate::{
    block::{Context, Files, LogLevel, Progress},
    error::{Error, ErrorKind},
    limits::Limits,
    math::convert::count,
    value::zeros::Zeros,
};

/// A call that takes longer and does not ask whether to stop is reported.
const PATIENCE: Duration = Duration::from_millis(100);

/// What a call may ask of the engine.
#[derive(Clone, Copy)]
pub(super) struct Means<'a> {
    pub(super) progress: &'a dyn Progress,
    /// `None` while rows are written: files are read when a block is prepared.
    pub(super) files: Option<&'a dyn Files>,
    pub(super) limits: &'a Limits,
    pub(super) tell: &'a (dyn Fn(LogLevel, Error) + Sync),
    /// What is made besides images; `None` where nothing is.
    pub(super) making: Option<&'a Making<'a>>,
}

impl<'a> Means<'a> {
    pub(super) fn of(cx: &Context<'a>) -> Self {
        Self {
            progress: cx.progress,
            files: Some(cx.files),
            limits: cx.limits,
            tell: cx.tell,
            making: None,
        }
    }
}

/// One call. The plug-in sees it as a [`ptlp_job`].
pub(super) struct Call<'a> {
    pub(super) means: Means<'a>,
    /// The first thing that it said went wrong.
    fault: Mutex<Option<Error>>,
    /// Whether it ever asked whether to stop.
    has_asked: AtomicBool,
    scratch: Mutex<Scratch>,
    /// The files that it read.
    read: Mutex<Vec<Arc<[u8]>>>,
}

/// What a plug-in borrowed for the time of a call.
#[derive(Default)]
struct Scratch {
    pieces: Vec<Piece>,
    bytes: u64,
}

struct Piece {
    /// Its aligned start, which is how the plug-in names it.
    first: *mut c_void,
    size: u64,
    memory: Zeros,
}

// SAFETY: `first` points into the memory that the piece owns.
unsafe impl Send for Piece {}

fn lock<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}

impl<'a> Call<'a> {
    #[inline]
    pub(super) fn new(means: Means<'a>) -> Self {
        Self {
            means,
            fault: Mutex::new(None),
            has_asked: AtomicBool::new(false),
            scratch: Mutex::new(Scratch { pieces: Vec::new(), bytes: 0 }),
            read: Mutex::new(Vec::new()),
        }
    }

    /// Runs a function of a plug-in.
    ///
    /// # Errors
    /// What it says went wrong.
    #[inline]
    pub(super) fn run(
        &self,
        what: &str,
        function: impl FnOnce(*const ptlp_job) -> ptlp_status,
    ) -> Result<(), Error> {
        let job = ptlp_job {
            struct_size: count(size_of::<ptlp_job>()),
            flags: 0,
            data: ptr::from_ref(self).cast_mut().cast(),
            is_cancelled: Some(is_cancelled),
            report: Some(report),
            set_error: Some(set_error),
            warn: Some(warn),
        };
        // Rows are short, and the time of each would cost some.
        let started = self.means.files.map(|_| Instant::now());
        let status = function(&raw const job);
        if let Some(started) = started {
            self.report_deaf(what, started);
        }
        if status == PTLP_OK { Ok(()) } else { Err(self.error(what, status)) }
    }

    /// Notes that somebody asked whether to stop.
    pub(super) fn note_asked(&self) {
        self.has_asked.store(true, Ordering::Relaxed);
    }

    /// Reports a function that went on for long though nobody looks at the result any more, and
    /// never asked about that: whoever cancels waits for it.
    fn report_deaf(&self, what: &str, started: Instant) {
        let took = started.elapsed();
        let has_asked = self.has_asked.load(Ordering::Relaxed);
        if took <= PATIENCE || has_asked || self.means.progress.check().is_ok() {
            return;
        }
        let took = took.as_millis();
        let message = format!(
            "`{what}` of the plug-in ran for {took} ms and never asked whether to stop: it has \
             to ask `is_cancelled` every millisecond"
        );
        (self.means.tell)(LogLevel::Error, Error::new(ErrorKind::PluginFailed, message));
    }

    /// The error of a status.
    #[cold]
    fn error(&self, what: &str, status: ptlp_status) -> Error {
        if let Err(cancelled) = self.means.progress.check() {
            return cancelled;
        }
        let said = lock(&self.fault).take();
        let kind = kind_of(status);
        let message = match said {
            Some(error) if error.kind() != ErrorKind::PluginFailed => return error,
            Some(error) => error.message().to_owned(),
            None => format!("`{what}` of the plug-in returned {}", name_of(status)),
        };
        match kind {
            ErrorKind::PluginPanic => {
                Error::new(kind, format!("the block has a defect: {message}"))
            }
            ErrorKind::Cancelled => {
                let message = format!("{message}, although nobody asked it to stop");
                Error::new(ErrorKind::PluginFailed, message)
            }
            _ => Error::new(kind, message),
        }
    }

    /// Notes what went wrong, unless something else did before.
    pub(super) fn fail(&self, error: Error) -> ptlp_status {
        let status = error.kind() as ptlp_status;
        lock(&self.fault).get_or_insert(error);
        status
    }

    /// Memory until the call ends.
    pub(super) fn allocate(&self, size: usize) -> Result<*mut c_void, Error> {
        let mut scratch = lock(&self.scratch);
        let limit = self.means.limits.memory_bytes;
        let bytes = scratch.bytes.saturating_add(size as u64);
        if bytes > limit {
            let message = format!("takes {bytes} bytes of scratch memory, allowed {limit}");
            return Err(Error::new(ErrorKind::Limit, message));
        }
        let none =
            || Error::new(ErrorKind::NoMemory, format!("the system has no {size} bytes left"));
        let wanted = Zeros::wanted(size.div_ceil(size_of::<f32>()));
        let memory = Zeros::new(wanted).ok_or_else(none)?;
        let start = memory.aligned_start();
        // The pointer is taken where the memory stays: whoever moves it is its only user.
        let piece =
            scratch.pieces.push_mut(Piece { first: ptr::null_mut(), size: size as u64, memory });
        piece.first = ptr::from_mut(&mut piece.memory.numbers_mut()[start..]).cast();
        let first = piece.first;
        scratch.bytes = bytes;
        Ok(first)
    }

    /// Frees memory of [`allocate`](Self::allocate).
    pub(super) fn release(&self, memory: *mut c_void) {
        let mut scratch = lock(&self.scratch);
        if let Some(place) = scratch.pieces.iter().position(|piece| piece.first == memory) {
            scratch.bytes -= scratch.pieces.swap_remove(place).size;
        }
    }

    /// Keeps the bytes of a file until the call ends.
    pub(super) fn keep(&self, bytes: Arc<[u8]>) {
        lock(&self.read).push(bytes);
    }
}

/// The kind of error that a status stands for.
fn kind_of(status: ptlp_status) -> ErrorKind {
    match status {
        PTLP_E_CANCELLED => ErrorKind::Cancelled,
        PTLP_E_INVALID_ARGUMENT => ErrorKind::InvalidArgument,
        PTLP_E_UNSUPPORTED => ErrorKind::Unsupported,
        PTLP_E_NO_MEMORY => ErrorKind::NoMemory,
        PTLP_E_NOT_FOUND => ErrorKind::NotFound,
        PTLP_E_UNCONNECTED => ErrorKind::Unconnected,
        PTLP_E_OUT_OF_RANGE => ErrorKind::OutOfRange,
        PTLP_E_PARSE => ErrorKind::Parse,
        PTLP_E_IO => ErrorKind::Io,
        PTLP_E_LIMIT => ErrorKind::Limit,
        PTLP_E_DENIED => ErrorKind::Denied,
        PTLP_E_PANIC => ErrorKind::PluginPanic,
        _ => ErrorKind::PluginFailed,
    }
}

fn name_of(status: ptlp_status) -> String {
    match status {
        PTLP_E_CANCELLED => "PTLP_E_CANCELLED".to_owned(),
        PTLP_E_NO_MEMORY => "PTLP_E_NO_MEMORY".to_owned(),
        PTLP_E_PANIC => "PTLP_E_PANIC".to_owned(),
        PTLP_E_FAILED => "PTLP_E_FAILED".to_owned(),
        other => format!("status {other}"),
    }
}

/// The call that a job belongs to.
///
/// # Safety
/// The contract: `job` is NULL or the job of a call that still runs.
pub(super) unsafe fn call_of<'a>(job: *const ptlp_job) -> Option<&'a Call<'a>> {
    if job.is_null() {
        return None;
    }
    // SAFETY: `run` made the job, and its data is the call.
    Some(unsafe { &*(*job).data.cast::<Call<'a>>() })
}

/// A text that a plug-in says.
///
/// # Safety
/// The contract: `text` is NULL or ends with NUL.
pub(super) unsafe fn said(text: *const c_char) -> String {
    if text.is_null() {
        return "nothing (NULL)".to_owned();
    }
    // SAFETY: not NULL, and it ends with NUL.
    let text = unsafe { CStr::from_ptr(text) }.to_string_lossy();
    text.chars().take(MAX_SAID).collect()
}

/// Characters of what a plug-in says.
const MAX_SAID: usize = 2000;

unsafe extern "C" fn is_cancelled(job: *const ptlp_job) -> i32 {
    // SAFETY: the contract.
    let call = unsafe { call_of(job) };
    let is_cancelled = |call: &Call<'_>| {
        call.note_asked();
        call.means.progress.check().is_err()
    };
    guarded(1, || i32::from(call.is_none_or(is_cancelled)))
}

unsafe extern "C" fn report(job: *const ptlp_job, fraction: f64) {
    // SAFETY: the contract.
    let call = unsafe { call_of(job) };
    guarded((), || {
        if let Some(call) = call
            && fraction.is_finite()
        {
            call.means.progress.report(fraction);
        }
    });
}

unsafe extern "C" fn set_error(job: *const ptlp_job, utf8: *const c_char) {
    // SAFETY: the contract.
    let (call, text) = unsafe { (call_of(job), said(utf8)) };
    if let Some(call) = call {
        call.fail(Error::new(ErrorKind::PluginFailed, text));
    }
}

unsafe extern "C" fn warn(job: *const ptlp_job, utf8: *const c_char) {
    // SAFETY: the contract.
    let (call, text) = unsafe { (call_of(job), said(utf8)) };
    guarded((), || {
        if let Some(call) = call {
            (call.means.tell)(LogLevel::Warning, Error::new(ErrorKind::PluginFailed, text));
        }
    });
}
