//! The handles of a run, and what every call is checked for.

use std::sync::atomic::{AtomicU32, Ordering};

use ptlib::ffi::*;

use super::input::Input;

/// More references of one type are released at once.
const CAPACITY: usize = 6;

/// A type whose handles are released.
pub(crate) trait Owned {
    const RELEASE: unsafe extern "C" fn(*mut Self);
}

impl Owned for ptl_engine {
    const RELEASE: unsafe extern "C" fn(*mut Self) = ptl_engine_release;
}

impl Owned for ptl_graph {
    const RELEASE: unsafe extern "C" fn(*mut Self) = ptl_graph_release;
}

impl Owned for ptl_image {
    const RELEASE: unsafe extern "C" fn(*mut Self) = ptl_image_release;
}

impl Owned for ptl_job {
    const RELEASE: unsafe extern "C" fn(*mut Self) = ptl_job_release;
}

impl Owned for ptl_cancel {
    const RELEASE: unsafe extern "C" fn(*mut Self) = ptl_cancel_release;
}

impl Owned for ptl_error {
    const RELEASE: unsafe extern "C" fn(*mut Self) = ptl_error_release;
}

impl Owned for ptl_bytes {
    const RELEASE: unsafe extern "C" fn(*mut Self) = ptl_bytes_release;
}

/// References, each an element of its own.
pub(crate) struct Table<T: Owned>(Vec<*mut T>);

impl<T: Owned> Table<T> {
    /// Takes a reference over; NULL is none.
    pub(crate) fn keep(&mut self, handle: *mut T) {
        if handle.is_null() {
            return;
        }
        if self.0.len() == CAPACITY {
            let oldest = self.0.remove(0);
            // SAFETY: it was in the table, so it is a reference, and it is there no longer.
            unsafe { T::RELEASE(oldest) };
        }
        self.0.push(handle);
    }

    /// Any live handle; NULL if there is none.
    pub(crate) fn any(&self, input: &mut Input<'_>) -> *mut T {
        if self.0.is_empty() { std::ptr::null_mut() } else { input.of(&self.0) }
    }

    /// Any reference, which is the caller's now.
    pub(crate) fn take(&mut self, input: &mut Input<'_>) -> *mut T {
        match self.0.len() {
            0 => std::ptr::null_mut(),
            count => self.0.swap_remove(input.below(count)),
        }
    }

    /// Releases any reference, or NULL.
    pub(crate) fn release_any(&mut self, input: &mut Input<'_>) {
        let handle = self.take(input);
        // SAFETY: NULL, or a reference that is no longer in the table.
        unsafe { T::RELEASE(handle) };
    }
}

impl<T: Owned> Drop for Table<T> {
    fn drop(&mut self) {
        for handle in self.0.drain(..) {
            // SAFETY: a reference that nobody uses any more.
            unsafe { T::RELEASE(handle) };
        }
    }
}

/// A log's `user_data`: how often it was given back.
#[derive(Default)]
pub(crate) struct LogUse(pub(crate) AtomicU32);

impl Drop for LogUse {
    fn drop(&mut self) {
        let times = self.0.load(Ordering::SeqCst);
        assert_eq!(times, 1, "`free_user_data` is called once");
    }
}

/// Everything that lives during a run. What comes first is released first: engines before what is
/// made by them, and what callbacks are given last.
pub(crate) struct Session<'a> {
    pub(crate) input: Input<'a>,
    pub(crate) engines: Table<ptl_engine>,
    pub(crate) graphs: Table<ptl_graph>,
    pub(crate) cancels: Table<ptl_cancel>,
    pub(crate) jobs: Table<ptl_job>,
    pub(crate) images: Table<ptl_image>,
    pub(crate) errors: Table<ptl_error>,
    pub(crate) bytes: Table<ptl_bytes>,
    /// Blocks of any graph that were seen, removed ones included.
    pub(crate) blocks: Vec<ptl_block>,
    pub(crate) log_uses: Vec<Box<LogUse>>,
}

impl<'a> Session<'a> {
    pub(crate) fn new(input: Input<'a>) -> Self {
        Self {
            input,
            engines: Table(Vec::new()),
            graphs: Table(Vec::new()),
            cancels: Table(Vec::new()),
            jobs: Table(Vec::new()),
            images: Table(Vec::new()),
            errors: Table(Vec::new()),
            bytes: Table(Vec::new()),
            blocks: Vec::new(),
            log_uses: Vec::new(),
        }
    }

    /// A handle for an argument of type `T`, whose handles are `right`: sometimes NULL, sometimes
    /// a live handle of another type.
    fn argument<T: Owned>(&mut self, right: fn(&Self) -> &Table<T>) -> *mut T {
        match self.input.byte() {
            249 => self.engines.any(&mut self.input).cast(),
            250 => self.graphs.any(&mut self.input).cast(),
            251 => self.cancels.any(&mut self.input).cast(),
            252 => self.jobs.any(&mut self.input).cast(),
            253 => self.images.any(&mut self.input).cast(),
            254 => self.errors.any(&mut self.input).cast(),
            255 => std::ptr::null_mut(),
            byte => match right(self).0.as_slice() {
                [] => std::ptr::null_mut(),
                handles => handles[usize::from(byte) % handles.len()],
            },
        }
    }

    pub(crate) fn engine(&mut self) -> *mut ptl_engine {
        self.argument(|session| &session.engines)
    }

    pub(crate) fn graph(&mut self) -> *mut ptl_graph {
        self.argument(|session| &session.graphs)
    }

    pub(crate) fn cancel(&mut self) -> *mut ptl_cancel {
        self.argument(|session| &session.cancels)
    }

    pub(crate) fn job(&mut self) -> *mut ptl_job {
        self.argument(|session| &session.jobs)
    }

    pub(crate) fn image(&mut self) -> *mut ptl_image {
        self.argument(|session| &session.images)
    }

    pub(crate) fn error(&mut self) -> *mut ptl_error {
        self.argument(|session| &session.errors)
    }

    pub(crate) fn a_bytes(&mut self) -> *mut ptl_bytes {
        self.argument(|session| &session.bytes)
    }

    /// A block of any graph, removed, forged or none.
    pub(crate) fn block(&mut self) -> ptl_block {
        match self.input.byte() {
            250..=252 => self.input.raw(),
            253 => self.blocks.last().map_or(0, |block| block ^ 1 << 32),
            254 => u64::MAX,
            255 => 0,
            byte => match self.blocks.as_slice() {
                [] => 0,
                blocks => blocks[usize::from(byte) % blocks.len()],
            },
        }
    }

    /// Remembers a block.
    pub(crate) fn saw(&mut self, block: ptl_block) {
        if block != 0 && self.blocks.len() < 64 {
            self.blocks.push(block);
        }
    }

    /// Makes a call, with a place for its error or without, and checks that status and error
    /// agree.
    pub(crate) fn call(
        &mut self,
        call: impl FnOnce(&mut Self, *mut *mut ptl_error) -> ptl_status,
    ) -> ptl_status {
        if self.input.once_in(8) {
            let status = call(self, std::ptr::null_mut());
            assert_ne!(status, PTL_E_INTERNAL, "a defect");
            return status;
        }
        // What is there before does not count.
        let mut error = std::ptr::dangling_mut();
        let status = call(self, &raw mut error);
        assert_eq!(error.is_null(), matches!(status, PTL_OK | PTL_PENDING), "status {status}");
        if !error.is_null() {
            // SAFETY: a new error, and its texts live as long.
            let (of_error, message) = unsafe {
                (ptl_error_status(error), std::ffi::CStr::from_ptr(ptl_error_message(error)))
            };
            assert_eq!(of_error, status);
            assert!(!message.is_empty() && message.to_str().is_ok(), "{message:?}");
            assert_ne!(status, PTL_E_INTERNAL, "{message:?}");
        }
        self.errors.keep(error);
        status
    }

    /// Makes a call that gives a new handle, or gives it no place for that.
    pub(crate) fn call_for<T: Owned>(
        &mut self,
        call: impl FnOnce(*mut *mut T, *mut *mut ptl_error) -> ptl_status,
    ) -> *mut T {
        if self.input.once_in(32) {
            let status = self.call(|_, error| call(std::ptr::null_mut(), error));
            assert_ne!(status, PTL_OK, "there was no place for the handle");
            return std::ptr::null_mut();
        }
        let mut out = std::ptr::dangling_mut();
        let status = self.call(|_, error| call(&raw mut out, error));
        assert_eq!(out.is_null(), status != PTL_OK, "status {status}");
        out
    }
}
