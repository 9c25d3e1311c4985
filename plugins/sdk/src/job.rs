//! The job of a call: what the host may be asked while it waits for a block.

use std::{
    ffi::{CStr, CString, c_void},
    marker::PhantomData,
    sync::{Mutex, PoisonError},
};

use ptlib_plugin_abi::{services::*, *};

use crate::{BlockError, host};

/// The job of a call; none while the host only asks for numbers.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Job<'a> {
    job: *const ptlp_job,
    during: PhantomData<&'a ptlp_job>,
}

// SAFETY: the contract: the functions of a job may be called from any thread.
unsafe impl Send for Job<'_> {}
// SAFETY: as above.
unsafe impl Sync for Job<'_> {}

impl Job<'_> {
    /// # Safety
    /// The contract, for as long as the result lives.
    pub(crate) unsafe fn new(job: *const ptlp_job) -> Self {
        Self { job, during: PhantomData }
    }

    pub(crate) fn none() -> Self {
        Self { job: std::ptr::null(), during: PhantomData }
    }

    pub(crate) fn as_ptr(&self) -> *const ptlp_job {
        self.job
    }

    fn table(&self) -> Option<&ptlp_job> {
        // SAFETY: NULL, or a job that lives as long as `self`.
        unsafe { self.job.as_ref() }
    }

    pub(crate) fn set_error(&self, message: &CStr) {
        if let Some(set_error) = self.table().and_then(|job| job.set_error) {
            // SAFETY: the contract.
            unsafe { set_error(self.job, message.as_ptr()) };
        }
    }

    pub(crate) fn is_cancelled(&self) -> bool {
        let is_cancelled = self.table().and_then(|job| job.is_cancelled);
        // SAFETY: the contract.
        is_cancelled.is_some_and(|is_cancelled| unsafe { is_cancelled(self.job) } != 0)
    }

    pub(crate) fn report(&self, fraction: f64) {
        if let Some(report) = self.table().and_then(|job| job.report) {
            // SAFETY: the contract.
            unsafe { report(self.job, fraction) };
        }
    }

    pub(crate) fn warn(&self, message: &str) {
        let message = CString::new(message.replace('\0', " ")).unwrap_or_default();
        if let Some(warn) = self.table().and_then(|job| job.warn) {
            // SAFETY: the contract.
            unsafe { warn(self.job, message.as_ptr()) };
        }
    }

    /// The service that makes values.
    pub(crate) fn values() -> Result<&'static ptlp_values, BlockError> {
        let values = host::service::<ptlp_values>(PTLP_VALUES);
        values.ok_or_else(|| BlockError::from("the host makes no values but images"))
    }

    pub(crate) fn read_file(&self, path: &str) -> Result<Vec<u8>, BlockError> {
        let path = CString::new(path)
            .map_err(|_| BlockError::invalid(format!("the path {path:?} has a NUL")))?;
        let read = host::service::<ptlp_file>(PTLP_FILE).and_then(|file| file.read);
        let read = read.ok_or_else(|| BlockError::from("the host reads no files"))?;
        let (mut data, mut size) = (std::ptr::null::<c_void>(), 0_usize);
        // SAFETY: the contract; places for both results.
        let status = unsafe { read(self.job, path.as_ptr(), &raw mut data, &raw mut size) };
        if status != PTLP_OK {
            return Err(BlockError::of(status));
        }
        if size == 0 {
            return Ok(vec![]);
        }
        // SAFETY: the host gives that many bytes, until the call returns.
        Ok(unsafe { std::slice::from_raw_parts(data.cast::<u8>(), size) }.to_vec())
    }

    pub(crate) fn write_file(&self, path: &str, bytes: &[u8]) -> Result<(), BlockError> {
        let path = CString::new(path)
            .map_err(|_| BlockError::invalid(format!("the path {path:?} has a NUL")))?;
        let write = host::service::<ptlp_file>(PTLP_FILE).and_then(|file| file.write);
        let write = write.ok_or_else(|| BlockError::from("the host writes no files"))?;
        // SAFETY: the contract.
        let status = unsafe { write(self.job, path.as_ptr(), bytes.as_ptr().cast(), bytes.len()) };
        if status == PTLP_OK { Ok(()) } else { Err(BlockError::of(status)) }
    }

    pub(crate) fn parallel(
        &self,
        count: usize,
        task: &(dyn Fn(usize) -> Result<(), BlockError> + Sync),
    ) -> Result<(), BlockError> {
        struct Tasks<'t> {
            task: &'t (dyn Fn(usize) -> Result<(), BlockError> + Sync),
            failed: Mutex<Option<(usize, BlockError)>>,
        }
        unsafe extern "C" fn run(tasks: *mut c_void, index: u32) -> ptlp_status {
            // SAFETY: what `parallel` gave, which waits for all tasks.
            let tasks = unsafe { &*tasks.cast::<Tasks<'_>>() };
            let index = index as usize;
            let run = std::panic::AssertUnwindSafe(|| (tasks.task)(index));
            let error = match std::panic::catch_unwind(run) {
                Ok(Ok(())) => return PTLP_OK,
                Ok(Err(error)) => error,
                Err(_) => BlockError::new(PTLP_E_PANIC, "a task panicked"),
            };
            let status = error.status;
            let mut failed = tasks.failed.lock().unwrap_or_else(PoisonError::into_inner);
            if failed.as_ref().is_none_or(|(earlier, _)| index < *earlier) {
                *failed = Some((index, error));
            }
            status
        }
        let count = u32::try_from(count).map_err(|_| BlockError::limit("too many tasks"))?;
        let parallel = host::service::<ptlp_parallel>(PTLP_PARALLEL).and_then(|table| table.run);
        let Some(parallel) = parallel else { return (0..count as usize).try_for_each(task) };
        let tasks = Tasks { task, failed: Mutex::new(None) };
        let data = std::ptr::from_ref(&tasks).cast_mut().cast();
        // SAFETY: the contract; the tasks live until all of them are done.
        let status = unsafe { parallel(self.job, count, Some(run), data) };
        match tasks.failed.into_inner().unwrap_or_else(PoisonError::into_inner) {
            Some((_, error)) => Err(error),
            None if status == PTLP_OK => Ok(()),
            None => Err(BlockError::of(status)),
        }
    }
}
