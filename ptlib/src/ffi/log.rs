//! The log of an engine.

use std::{
    ffi::c_void,
    sync::{Arc, Mutex, PoisonError},
};

use super::{
    PTL_LOG_DEBUG, PTL_LOG_ERROR, PTL_LOG_INFO, PTL_LOG_WARNING, fault::c_string, handle::Handle,
    ptl_engine, ptl_error, ptl_free_fn, ptl_log_fn, ptl_status,
};
use crate::{
    error::{Error, ErrorKind},
    run::{Engine, LogFn, LogLevel},
};

/// The caller's log, for the messages of this module; the engine has it too.
#[derive(Debug, Default)]
pub(super) struct Log(Mutex<Option<Arc<Sink>>>);

#[derive(Debug)]
struct Sink {
    min_level: LogLevel,
    log: ptl_log_fn,
    user_data: *mut c_void,
    free: ptl_free_fn,
}

// SAFETY: `user_data` is only handed to the caller's functions, which the header asks to work on
// any thread.
unsafe impl Send for Sink {}
// SAFETY: as above.
unsafe impl Sync for Sink {}

impl Drop for Sink {
    fn drop(&mut self) {
        if let Some(free) = self.free {
            // SAFETY: the caller gave this function for this pointer, and this is its only call.
            unsafe { free(self.user_data) };
        }
    }
}

impl Sink {
    fn tell(&self, level: LogLevel, message: &str) {
        if let Some(log) = self.log
            && level >= self.min_level
        {
            let message = c_string(message);
            // SAFETY: the caller's function, with the pointer that it was given for.
            unsafe { log(level as i32, message.as_ptr(), self.user_data) };
        }
    }
}

impl Log {
    /// Tells the caller's function. No lock is held meanwhile: it may call everything.
    pub(super) fn tell(&self, level: LogLevel, message: &str) {
        let sink = self.0.lock().unwrap_or_else(PoisonError::into_inner).clone();
        if let Some(sink) = sink {
            sink.tell(level, message);
        }
    }

    fn replace(&self, engine: &Engine, sink: Option<Arc<Sink>>) {
        let of_engine = sink.clone();
        engine.set_log(of_engine.map(|sink| -> (LogLevel, Arc<LogFn>) {
            (sink.min_level, Arc::new(move |level, message: &str| sink.tell(level, message)))
        }));
        let mut place = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        let old = std::mem::replace(&mut *place, sink);
        // The old sink's `free` may call everything, so it runs without the lock.
        drop(place);
        drop(old);
    }
}

fn level_of(number: i32) -> Result<LogLevel, Error> {
    match number {
        PTL_LOG_DEBUG => Ok(LogLevel::Debug),
        PTL_LOG_INFO => Ok(LogLevel::Info),
        PTL_LOG_WARNING => Ok(LogLevel::Warning),
        PTL_LOG_ERROR => Ok(LogLevel::Error),
        _ => {
            let message =
                format!("`min_level` is {number}, allowed {PTL_LOG_DEBUG}..={PTL_LOG_ERROR}");
            Err(Error::new(ErrorKind::InvalidArgument, message))
        }
    }
}

/// Sets the function that gets the engine's messages of `min_level` (PTL_LOG_...) and above, such
/// as the warnings of graph files that are read; NULL for none. It replaces the one before.
///
/// Ownership: `free_user_data` (may be NULL) is called once, when `user_data` is needed no longer:
///            after the function was replaced, with the last reference to the engine, or at once
///            if `log` is NULL. After an error it is not called.
/// Threads:   any. The function is called on threads that are inside a call that concerns this
///            engine and on those of its jobs, possibly on several at once.
/// Errors:    PTL_E_INVALID_ARGUMENT.
/// Since:     0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn ptl_engine_set_log(
    engine: *mut ptl_engine,
    min_level: i32,
    log: ptl_log_fn,
    user_data: *mut c_void,
    free_user_data: ptl_free_fn,
    error: *mut *mut ptl_error,
) -> ptl_status {
    pt_fn!(error; engine: Handle<ptl_engine> => {
        let min_level = level_of(min_level)?;
        let sink = Sink { min_level, log, user_data, free: free_user_data };
        // Without a function, `user_data` is needed no longer at once.
        engine.log.replace(&engine.engine, log.map(|_| Arc::new(sink)));
        Ok(())
    })
}

#[cfg(test)]
mod tests {
    use std::{
        ffi::c_char,
        ptr::{null, null_mut},
        sync::atomic::{AtomicU32, Ordering},
    };

    use super::*;
    use crate::ffi::{PTL_OK, ptl_engine_create, ptl_engine_release};

    unsafe extern "C" fn ignore(_: i32, _: *const c_char, _: *mut c_void) {}

    unsafe extern "C" fn count(frees: *mut c_void) {
        // SAFETY: the tests give counters that outlive their engines.
        unsafe { &*frees.cast::<AtomicU32>() }.fetch_add(1, Ordering::Relaxed);
    }

    #[test]
    fn every_user_data_is_freed_once() {
        let frees = [const { AtomicU32::new(0) }; 3];
        let counts = || frees.each_ref().map(|count| count.load(Ordering::Relaxed));
        let mut engine = null_mut();
        // SAFETY: live handles, and counters that outlive the engine.
        unsafe {
            assert_eq!(ptl_engine_create(null(), &raw mut engine, null_mut()), PTL_OK);
            let set = |level, log, frees: &AtomicU32| {
                let user_data = std::ptr::from_ref(frees).cast_mut().cast();
                ptl_engine_set_log(engine, level, log, user_data, Some(count), null_mut())
            };
            let [first, second, refused] = &frees;
            assert_eq!(set(PTL_LOG_INFO, Some(ignore), first), PTL_OK);
            assert_eq!(counts(), [0, 0, 0]);
            assert_eq!(set(PTL_LOG_INFO, None, second), PTL_OK);
            assert_eq!(counts(), [1, 1, 0]);
            assert_ne!(set(77, Some(ignore), refused), PTL_OK);
            ptl_engine_release(engine);
        }
        assert_eq!(counts(), [1, 1, 0]);
    }
}
