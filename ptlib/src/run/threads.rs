//! The engine's own threads.
//!
//! One pool an engine, made at the first computation that wants more than one thread, never the
//! process-wide one. The thread that asked for the computation always works too: so progress is
//! told on it, and many computations on one engine can never wait for each other.

use std::{
    fmt,
    sync::{
        Mutex, OnceLock, PoisonError,
        atomic::{AtomicBool, AtomicUsize, Ordering},
    },
    thread::JoinHandle,
};

use crate::error::Error;

/// The threads of an engine.
pub(super) struct Threads {
    count: usize,
    pool: OnceLock<Option<Pool>>,
}

struct Pool {
    /// `None` only while dropping.
    rayon: Option<rayon_core::ThreadPool>,
    handles: Mutex<Vec<JoinHandle<()>>>,
}

impl Threads {
    /// `count` threads, the caller of a computation included; 0 for one per processor.
    pub(super) fn new(count: u32) -> Self {
        let count = match count {
            0 => std::thread::available_parallelism().map_or(1, usize::from),
            count => count as usize,
        };
        Self { count: count.min(rayon_core::max_num_threads()), pool: OnceLock::new() }
    }

    /// The number of threads that a computation may use, the caller's included.
    pub(super) fn count(&self) -> usize {
        self.count
    }

    /// Runs `task` for 0..`tasks` on at most `threads` threads and waits for all. Between its
    /// tasks, the calling thread runs `between`. Tasks start in order and after an error none
    /// starts any more, so the error of the lowest failing task is returned on every run.
    pub(super) fn run(
        &self,
        threads: usize,
        tasks: usize,
        task: &(dyn Fn(usize) -> Result<(), Error> + Sync),
        between: &dyn Fn() -> Result<(), Error>,
    ) -> Result<(), Error> {
        let next = AtomicUsize::new(0);
        let failed = AtomicBool::new(false);
        let failure: Mutex<Option<(usize, Error)>> = Mutex::new(None);
        let fail = |number: usize, error: Error| {
            failed.store(true, Ordering::Relaxed);
            let mut failure = failure.lock().unwrap_or_else(PoisonError::into_inner);
            if failure.as_ref().is_none_or(|(earlier, _)| number < *earlier) {
                *failure = Some((number, error));
            }
        };
        let step = || {
            if failed.load(Ordering::Relaxed) {
                return false;
            }
            let number = next.fetch_add(1, Ordering::Relaxed);
            if number >= tasks {
                return false;
            }
            if let Err(error) = task(number) {
                fail(number, error);
            }
            true
        };
        let work_here = || {
            while step() {
                if let Err(error) = between() {
                    fail(usize::MAX, error);
                }
            }
        };
        let helpers = threads.min(self.count).min(tasks).saturating_sub(1);
        match self.pool(helpers) {
            Some(rayon) => rayon.in_place_scope(|scope| {
                for _ in 0..helpers {
                    scope.spawn(|_| while step() {});
                }
                work_here();
            }),
            None => work_here(),
        }
        match failure.into_inner().unwrap_or_else(PoisonError::into_inner) {
            Some((_, error)) => Err(error),
            None => Ok(()),
        }
    }

    /// The pool, if `helpers` threads are wanted. A system that gives no threads leaves the work to
    /// the calling one.
    fn pool(&self, helpers: usize) -> Option<&rayon_core::ThreadPool> {
        if helpers == 0 {
            return None;
        }
        self.pool.get_or_init(|| Pool::new(self.count - 1)).as_ref()?.rayon.as_ref()
    }
}

impl Pool {
    fn new(count: usize) -> Option<Self> {
        let handles = Mutex::new(Vec::new());
        let rayon = rayon_core::ThreadPoolBuilder::new()
            .num_threads(count)
            .spawn_handler(|thread| {
                let builder = std::thread::Builder::new().name(format!("ptlib-{}", thread.index()));
                let handle = builder.spawn(|| thread.run())?;
                handles.lock().unwrap_or_else(PoisonError::into_inner).push(handle);
                Ok(())
            })
            .build()
            .ok()?;
        Some(Self { rayon: Some(rayon), handles })
    }
}

impl Drop for Pool {
    /// Waits for the threads: an unloaded library must not leave any behind.
    fn drop(&mut self) {
        self.rayon = None;
        for handle in self.handles.get_mut().unwrap_or_else(PoisonError::into_inner).drain(..) {
            // A thread that panicked has nothing left to clean up.
            let _ = handle.join();
        }
    }
}

impl fmt::Debug for Threads {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "Threads({})", self.count)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::error::ErrorKind;

    #[test]
    fn every_task_runs_once() {
        for threads in [1, 2, 7] {
            let counts: Vec<AtomicUsize> = (0..1000).map(|_| AtomicUsize::new(0)).collect();
            let count = |i: usize| {
                counts[i].fetch_add(1, Ordering::Relaxed);
                Ok(())
            };
            Threads::new(threads).run(7, counts.len(), &count, &|| Ok(())).unwrap();
            assert!(counts.iter().all(|count| count.load(Ordering::Relaxed) == 1));
        }
    }

    #[test]
    fn the_error_of_the_lowest_task_is_returned() {
        let threads = Threads::new(4);
        for _ in 0..50 {
            let task = |i: usize| match i {
                13 | 17 | 90 => Err(Error::new(ErrorKind::Internal, i.to_string())),
                _ => Ok(()),
            };
            let error = threads.run(4, 100, &task, &|| Ok(())).unwrap_err();
            assert_eq!(error.message(), "13");
        }
    }

    #[test]
    fn between_tasks_runs_on_the_calling_thread_and_may_stop() {
        let here = std::thread::current().id();
        let stop = || {
            assert_eq!(std::thread::current().id(), here);
            Err(Error::new(ErrorKind::Cancelled, "stop"))
        };
        let error = Threads::new(1).run(1, 10, &|_| Ok(()), &stop).unwrap_err();
        assert_eq!(error.kind(), ErrorKind::Cancelled);
    }
}
