//! What a running computation tells, and what can stop it.

use std::{
    sync::{
        Mutex, PoisonError,
        atomic::{AtomicBool, AtomicU64, Ordering},
    },
    time::{Duration, Instant},
};

use super::{Cancel, ProgressFn, ProgressReport, threads::Threads};
use crate::{
    block::Progress,
    error::{Error, ErrorKind},
    graph::BlockId,
};

/// Watches one computation: counts its work, tells the caller, and stops it when asked.
pub(super) struct Monitor<'a> {
    threads: &'a Threads,
    count: usize,
    cancel: Option<Cancel>,
    is_stopped: AtomicBool,
    units_total: u64,
    /// Units of all stages that are done, and of the tasks of the running one.
    units_done: AtomicU64,
    /// What the running block of shape Whole says it has done, in units.
    units_reported: AtomicU64,
    teller: Option<Teller<'a>>,
}

struct Teller<'a> {
    /// The only thread that calls `tell`.
    owner: usize,
    interval: Duration,
    state: Mutex<TellerState<'a>>,
}

struct TellerState<'a> {
    tell: &'a mut ProgressFn<'a>,
    last: Instant,
    stage: u32,
    block: BlockId,
    stage_units: u64,
}

/// A number that no other living thread has: the address of something of its own. (The standard
/// library's thread ids allocate on threads that it did not make, and on the main thread of a
/// foreign program nobody frees that.)
fn this_thread() -> usize {
    thread_local!(static OWN: u8 = const { 0 });
    OWN.with(|own| std::ptr::from_ref(own).addr())
}

impl<'a> Monitor<'a> {
    /// A monitor that tells `tell`, called by the thread that makes it.
    pub(super) fn new(
        threads: &'a Threads,
        count: usize,
        cancel: Option<Cancel>,
        units_total: u64,
        tell: Option<(&'a mut ProgressFn<'a>, Duration, BlockId)>,
    ) -> Self {
        let teller = tell.map(|(tell, interval, block)| Teller {
            owner: this_thread(),
            interval,
            state: Mutex::new(TellerState {
                tell,
                last: Instant::now(),
                stage: 0,
                block,
                stage_units: 0,
            }),
        });
        Self {
            threads,
            count: if count == 0 { threads.count() } else { count.min(threads.count()) },
            cancel,
            is_stopped: AtomicBool::new(false),
            units_total,
            units_done: AtomicU64::new(0),
            units_reported: AtomicU64::new(0),
            teller,
        }
    }

    /// The number of threads that the computation uses.
    pub(super) fn thread_count(&self) -> usize {
        self.count
    }

    /// Stage `stage` of `units` units starts; it makes the output of `block`.
    pub(super) fn start_stage(&self, stage: u32, block: BlockId, units: u64) {
        self.units_reported.store(0, Ordering::Relaxed);
        if let Some(teller) = &self.teller {
            let mut state = teller.state.lock().unwrap_or_else(PoisonError::into_inner);
            (state.stage, state.block, state.stage_units) = (stage, block, units);
        }
    }

    /// `units` more units are done.
    pub(super) fn add_units(&self, units: u64) {
        self.units_reported.store(0, Ordering::Relaxed);
        self.units_done.fetch_add(units, Ordering::Relaxed);
    }

    /// Tells the end, whatever the interval.
    pub(super) fn finish(&self) -> Result<(), Error> {
        self.units_done.store(self.units_total, Ordering::Relaxed);
        self.units_reported.store(0, Ordering::Relaxed);
        self.tell(true);
        self.stopped()
    }

    /// Tells the caller how far it is, if this is the caller's thread and it is time.
    fn tell(&self, is_end: bool) {
        let Some(teller) = &self.teller else { return };
        let has_stopped = self.is_stopped.load(Ordering::Relaxed);
        if has_stopped || this_thread() != teller.owner {
            return;
        }
        // The callback may compute another graph on this thread, but not this one: the lock is
        // free here, and held during the call only by this thread.
        let Ok(mut state) = teller.state.try_lock() else { return };
        if !is_end && state.last.elapsed() < teller.interval {
            return;
        }
        state.last = Instant::now();
        let done =
            self.units_done.load(Ordering::Relaxed) + self.units_reported.load(Ordering::Relaxed);
        let report = ProgressReport {
            units_done: done.min(self.units_total),
            units_total: self.units_total,
            stage: state.stage,
            block: state.block,
        };
        if !(state.tell)(&report) {
            self.is_stopped.store(true, Ordering::Relaxed);
        }
    }

    fn stopped(&self) -> Result<(), Error> {
        if self.is_stopped.load(Ordering::Relaxed)
            || self.cancel.as_ref().is_some_and(Cancel::is_requested)
        {
            return Err(Error::new(ErrorKind::Cancelled, "the computation was cancelled"));
        }
        Ok(())
    }
}

impl Progress for Monitor<'_> {
    fn check(&self) -> Result<(), Error> {
        self.tell(false);
        self.stopped()
    }

    fn parallel(
        &self,
        count: usize,
        task: &(dyn Fn(usize) -> Result<(), Error> + Sync),
    ) -> Result<(), Error> {
        let task = |number| {
            self.stopped()?;
            task(number)
        };
        self.threads.run(self.count, count, &task, &|| self.check())
    }

    fn threads(&self) -> usize {
        self.thread_count()
    }

    fn report(&self, fraction: f64) {
        if let Some(teller) = &self.teller
            && let Ok(state) = teller.state.try_lock()
        {
            #[expect(
                clippy::cast_possible_truncation,
                clippy::cast_sign_loss,
                clippy::cast_precision_loss,
                reason = "units are for display"
            )]
            let units = (fraction.clamp(0.0, 1.0) * state.stage_units as f64) as u64;
            self.units_reported.store(units, Ordering::Relaxed);
        }
        self.tell(false);
    }
}
