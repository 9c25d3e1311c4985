//! Computing on a thread of its own.
//!
//! The worker never calls the caller's functions: it leaves its reports in the job, and whoever is
//! inside `ptl_job_wait` passes them on. So callbacks stay on a thread of the caller, as everywhere
//! else, and releasing a job can join its worker from any place, a callback included.

use std::{
    sync::{
        Arc, Condvar, Mutex, MutexGuard, PoisonError,
        atomic::{AtomicBool, Ordering},
    },
    thread::JoinHandle,
    time::{Duration, Instant},
};

use super::{
    PTL_OK, PTL_PENDING,
    call::caught,
    compute::{Request, progress_of},
    handle::{Handle, NewHandle, Opaque, Tagged, tag, tagged},
    image::ImageObject,
    ptl_block, ptl_compute_options, ptl_error, ptl_graph, ptl_image, ptl_progress, ptl_status,
    structs::{In, InOut},
};
use crate::{
    error::{Error, ErrorKind},
    run::{Cancel, ProgressReport},
};

/// A computation on a thread of its own. It has one owner. ptl_job_poll() may run on several
/// threads at once; one thread at a time waits.
#[derive(Debug)]
pub struct ptl_job {
    _opaque: [u8; 0],
}

impl Opaque for ptl_job {
    type Object = JobObject;
    const TAG: u32 = tag(b'j');
    const NAME: &'static str = "ptl_job";
}

pub(super) struct JobObject {
    request: Request,
    cancel: Cancel,
    state: Mutex<State>,
    changed: Condvar,
    worker: Mutex<Option<JoinHandle<()>>>,
    is_waited_for: AtomicBool,
}

#[derive(Default)]
struct State {
    report: Option<ProgressReport>,
    has_news: bool,
    /// The caller's function said so, if only to the last report.
    is_cancelled: bool,
    result: Option<Result<Arc<Tagged<ImageObject>>, Error>>,
}

impl JobObject {
    fn start(request: Request) -> Result<Arc<Tagged<Self>>, Error> {
        let cancel = request.settings.cancel.as_ref().map_or_else(Cancel::new, Cancel::child);
        let job = tagged::<ptl_job>(Self {
            request,
            cancel,
            state: Mutex::default(),
            changed: Condvar::new(),
            worker: Mutex::default(),
            is_waited_for: AtomicBool::new(false),
        });
        let of_worker = Arc::clone(&job);
        let worker = std::thread::Builder::new()
            .name("ptlib-job".to_owned())
            .spawn(move || of_worker.work())
            .map_err(|error| {
                Error::new(ErrorKind::NoMemory, format!("no thread for the job: {error}"))
            })?;
        *job.worker.lock().unwrap_or_else(PoisonError::into_inner) = Some(worker);
        Ok(job)
    }

    fn state(&self) -> MutexGuard<'_, State> {
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }

    fn work(&self) {
        let mut tell = |report: &ProgressReport| {
            let mut state = self.state();
            state.report = Some(*report);
            state.has_news = true;
            self.changed.notify_all();
            true
        };
        let result = caught(|| self.request.image(Some(self.cancel.clone()), Some(&mut tell)));
        let mut state = self.state();
        state.result = Some(result.map(tagged::<ptl_image>));
        self.changed.notify_all();
    }

    /// Waits for the result until `deadline`, and tells the caller's function meanwhile.
    fn wait(&self, deadline: Option<Instant>) -> Result<Option<Arc<Tagged<ImageObject>>>, Error> {
        loop {
            let mut state = self.wait_for_news(deadline);
            let news = state.report.filter(|_| std::mem::take(&mut state.has_news));
            drop(state);
            if let (Some(report), Some(callback)) = (news, self.request.settings.callback)
                && !callback.call(&report)
            {
                self.cancel.request();
                self.state().is_cancelled = true;
            }
            let state = self.state();
            if let Some(result) = &state.result
                && !state.has_news
            {
                if state.is_cancelled {
                    let message = "the computation was cancelled";
                    return Err(Error::new(ErrorKind::Cancelled, message));
                }
                return result.clone().map(Some);
            }
            drop(state);
            if deadline.is_some_and(|deadline| deadline <= Instant::now()) {
                return Ok(None);
            }
        }
    }

    fn wait_for_news(&self, deadline: Option<Instant>) -> MutexGuard<'_, State> {
        let mut state = self.state();
        while state.result.is_none() && !state.has_news {
            state = match deadline {
                None => self.changed.wait(state).unwrap_or_else(PoisonError::into_inner),
                Some(deadline) => {
                    let left = deadline.saturating_duration_since(Instant::now());
                    if left.is_zero() {
                        break;
                    }
                    let waited = self.changed.wait_timeout(state, left);
                    waited.unwrap_or_else(PoisonError::into_inner).0
                }
            };
        }
        state
    }

    /// Cancels the computation and waits for its end.
    fn stop(&self) {
        self.cancel.request();
        let worker = self.worker.lock().unwrap_or_else(PoisonError::into_inner).take();
        if let Some(worker) = worker {
            // Its panics were caught inside.
            let _ = worker.join();
        }
    }
}

/// Starts computing one output of a block on a thread of its own. The graph is copied first: later
/// changes do not affect the job. `options` may be NULL; its callback is called inside
/// ptl_job_wait() only.
///
/// Ownership: `out` receives the job; release it with ptl_job_release(). Of `options`, the cancel
///            request is kept (its reference stays the caller's), and `user_data` must stay valid
///            until the job is released.
/// Threads:   any.
/// Errors:    PTL_E_INVALID_ARGUMENT, PTL_E_UNSUPPORTED, PTL_E_NO_MEMORY; what is wrong with the
///            graph is told by ptl_job_wait(). On error `*out` is NULL.
/// Since:     0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn ptl_graph_compute_start(
    graph: *const ptl_graph,
    block: ptl_block,
    out_port: u32,
    options: *const ptl_compute_options,
    out: *mut *mut ptl_job,
    error: *mut *mut ptl_error,
) -> ptl_status {
    pt_fn!(error; graph: Handle<ptl_graph>, options: In<ptl_compute_options>,
        out: NewHandle<ptl_job> => {
        out.set(JobObject::start(Request::new(&graph, block, out_port, &options.0)?)?);
        Ok(())
    })
}

/// How far a job is, without waiting: PTL_OK if it has ended (well or not: ptl_job_wait() tells),
/// PTL_PENDING if not. `inout` may be NULL.
///
/// Threads: any, several at once.
/// Errors:  PTL_E_INVALID_ARGUMENT. On error `inout` is untouched.
/// Since:   0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn ptl_job_poll(job: *const ptl_job, inout: *mut ptl_progress) -> ptl_status {
    pt_fn!(std::ptr::null_mut(); job: Handle<ptl_job>, inout: Option<InOut<ptl_progress>> => {
        let state = job.state();
        if let Some(inout) = inout {
            inout.set(&match &state.report {
                Some(report) => progress_of(report),
                None => ptl_progress {
                    struct_size: 0,
                    stage: 0,
                    units_done: 0,
                    units_total: 0,
                    fraction: 0.0,
                    block: 0,
                },
            });
        }
        Ok(if state.result.is_some() { PTL_OK } else { PTL_PENDING })
    })
}

/// Waits for a job at most `timeout_ms` milliseconds (negative: as long as it takes) and gives its
/// image. PTL_PENDING if it has not ended; call again. After the end every call gives the same.
///
/// Ownership: `out` receives one reference with each PTL_OK; release it with ptl_image_release().
/// Threads:   one at a time. The callback of the job runs on this thread.
/// Cancel:    as ptl_graph_compute().
/// Errors:    as ptl_graph_compute(), and PTL_E_BUSY if another thread waits. On error, and with
///            PTL_PENDING, `*out` is NULL.
/// Since:     0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn ptl_job_wait(
    job: *mut ptl_job,
    timeout_ms: i64,
    out: *mut *mut ptl_image,
    error: *mut *mut ptl_error,
) -> ptl_status {
    pt_fn!(error; job: Handle<ptl_job>, out: NewHandle<ptl_image> => {
        // The callback may release the job: this reference keeps it until the call returns.
        // SAFETY: handles of this type are only made by `give`.
        let job = unsafe { job.retain() };
        if job.is_waited_for.swap(true, Ordering::Acquire) {
            let message = "another thread waits for the job";
            return Err(Error::new(ErrorKind::Busy, message));
        }
        // A time too far for the clock to tell is as good as none.
        let timeout = u64::try_from(timeout_ms).ok().map(Duration::from_millis);
        let deadline = timeout.and_then(|timeout| Instant::now().checked_add(timeout));
        let waited = caught(|| job.wait(deadline));
        job.is_waited_for.store(false, Ordering::Release);
        Ok(match waited? {
            Some(image) => {
                out.set(image);
                PTL_OK
            }
            None => PTL_PENDING,
        })
    })
}

/// Cancels a job that has not ended, waits for its thread, and frees it; NULL is fine. Images that
/// ptl_job_wait() gave stay valid.
///
/// Threads: any.
/// Since:   0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn ptl_job_release(job: *mut ptl_job) {
    pt_fn!(else (); job: Handle<ptl_job> => {
        // SAFETY: the caller gives up its only reference.
        let job = unsafe { job.take() };
        job.stop();
    });
}
