//! What a block may read, write and ask while the host calls it.

use std::{
    ffi::{CStr, CString, c_void},
    marker::PhantomData,
    sync::{Mutex, PoisonError},
};

use ptlib_plugin_abi::{services::*, values::*, *};

use crate::{BlockError, Image, ImageMut, host};

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

    fn is_cancelled(&self) -> bool {
        let is_cancelled = self.table().and_then(|job| job.is_cancelled);
        // SAFETY: the contract.
        is_cancelled.is_some_and(|is_cancelled| unsafe { is_cancelled(self.job) } != 0)
    }

    fn report(&self, fraction: f64) {
        if let Some(report) = self.table().and_then(|job| job.report) {
            // SAFETY: the contract.
            unsafe { report(self.job, fraction) };
        }
    }

    fn warn(&self, message: &str) {
        let message = CString::new(message.replace('\0', " ")).unwrap_or_default();
        if let Some(warn) = self.table().and_then(|job| job.warn) {
            // SAFETY: the contract.
            unsafe { warn(self.job, message.as_ptr()) };
        }
    }

    fn read_file(&self, path: &str) -> Result<Vec<u8>, BlockError> {
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

    fn write_file(&self, path: &str, bytes: &[u8]) -> Result<(), BlockError> {
        let path = CString::new(path)
            .map_err(|_| BlockError::invalid(format!("the path {path:?} has a NUL")))?;
        let write = host::service::<ptlp_file>(PTLP_FILE).and_then(|file| file.write);
        let write = write.ok_or_else(|| BlockError::from("the host writes no files"))?;
        // SAFETY: the contract.
        let status = unsafe { write(self.job, path.as_ptr(), bytes.as_ptr().cast(), bytes.len()) };
        if status == PTLP_OK { Ok(()) } else { Err(BlockError::of(status)) }
    }

    fn parallel(
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

/// What a block prepares itself from.
#[derive(Debug)]
pub struct Setup<'a> {
    setup: &'a ptlp_setup,
    job: Job<'a>,
}

impl<'a> Setup<'a> {
    /// # Safety
    /// The contract, for as long as `'a`.
    pub(crate) unsafe fn new(setup: *const ptlp_setup, job: Job<'a>) -> Self {
        // SAFETY: the caller's promise.
        Self { setup: unsafe { &*setup }, job }
    }

    pub(crate) fn values(&self) -> &'a [&'a ptlp_value] {
        // SAFETY: as many pointers to values as the count says.
        unsafe { slice(self.setup.values.cast(), self.setup.value_count as usize) }
    }

    /// Width of the images to make in pixels, supersampling included.
    #[must_use]
    pub fn width(&self) -> u32 {
        self.setup.width
    }

    /// Height of the images to make in pixels, supersampling included.
    #[must_use]
    pub fn height(&self) -> u32 {
        self.setup.height
    }

    /// The seed of the block in its graph.
    #[must_use]
    pub fn seed(&self) -> u64 {
        self.setup.seed
    }

    /// Whether values are stored as multiples of 1/255. The host does that.
    #[must_use]
    pub fn is_eight_bit(&self) -> bool {
        self.setup.precision == PTLP_PRECISION_8BIT
    }

    fn wire(&self, input: usize) -> Option<&'a ptlp_wire> {
        // SAFETY: as many pointers to wires as the count says.
        let wires: &[&ptlp_wire] =
            unsafe { slice(self.setup.inputs.cast(), self.setup.input_count as usize) };
        wires.get(input).copied()
    }

    /// Whether an input is connected.
    #[must_use]
    pub fn is_connected(&self, input: usize) -> bool {
        self.wire(input).is_some_and(|wire| wire.kind != PTL_KIND_NONE)
    }

    /// The image at an input, if one is connected. It has pixels if it is read anywhere, else only
    /// its channels are known.
    #[must_use]
    pub fn image(&self, input: usize) -> Option<Image<'a>> {
        image(self.wire(input)?)
    }

    /// The text at an input, if one is connected.
    #[must_use]
    pub fn text(&self, input: usize) -> Option<&'a str> {
        text(self.wire(input)?)
    }

    /// The bytes of the file that a path parameter names.
    ///
    /// # Errors
    /// What the host says: the file is not there, or may not be read.
    pub fn read_file(&self, path: &str) -> Result<Vec<u8>, BlockError> {
        self.job.read_file(path)
    }

    /// Tells the user that something is not as its author meant it.
    pub fn warn(&self, message: &str) {
        self.job.warn(message);
    }

    /// Goes on, or fails because the host asked to stop. Call it every millisecond of work.
    ///
    /// # Errors
    /// [`BlockError::cancelled`].
    pub fn check(&self) -> Result<(), BlockError> {
        if self.job.is_cancelled() { Err(BlockError::cancelled()) } else { Ok(()) }
    }
}

/// # Safety
/// `first` is NULL, or leads to `count` values for as long as `'a`.
unsafe fn slice<'a, T>(first: *const T, count: usize) -> &'a [T] {
    if first.is_null() || count == 0 {
        return &[];
    }
    // SAFETY: the caller's promise.
    unsafe { std::slice::from_raw_parts(first, count) }
}

fn image<'a>(wire: &'a ptlp_wire) -> Option<Image<'a>> {
    if wire.kind != PTL_KIND_IMAGE {
        return None;
    }
    // SAFETY: the contract: the value of an image's wire is a tile that lives as long.
    let tile: &'a ptlp_tile = unsafe { wire.value.cast::<ptlp_tile>().as_ref() }?;
    // SAFETY: as above.
    Some(unsafe { Image::new(tile) })
}

fn text(wire: &ptlp_wire) -> Option<&str> {
    if wire.kind != PTL_KIND_TEXT {
        return None;
    }
    // SAFETY: the contract: the value of a text's wire is its data, which lives as long.
    let text = unsafe { wire.value.cast::<ptl_text_data>().as_ref() }?;
    // SAFETY: as above.
    let bytes = unsafe { slice(text.text.cast::<u8>(), text.size) };
    std::str::from_utf8(bytes).ok()
}

/// One call of [`Block::compute`](crate::Block::compute).
#[derive(Debug)]
pub struct Call<'a> {
    job: Job<'a>,
    inputs: &'a [*const ptlp_wire],
    outputs: &'a [*const ptlp_wire],
}

// SAFETY: wires and what they lead to are only read, but outputs, which `output` hands out to the
// only owner of a `&mut Call`.
unsafe impl Sync for Call<'_> {}

impl<'a> Call<'a> {
    /// # Safety
    /// The contract, for as long as `'a`.
    pub(crate) unsafe fn new(
        job: Job<'a>,
        inputs: &'a [*const ptlp_wire],
        outputs: &'a [*const ptlp_wire],
    ) -> Self {
        Self { job, inputs, outputs }
    }

    fn input(&self, input: usize) -> Option<&'a ptlp_wire> {
        // SAFETY: the contract: there is a wire at each input.
        self.inputs.get(input).and_then(|wire| unsafe { wire.as_ref() })
    }

    /// Whether an input is connected.
    #[must_use]
    pub fn is_connected(&self, input: usize) -> bool {
        self.input(input).is_some_and(|wire| wire.kind != PTL_KIND_NONE)
    }

    /// The image at an input: the part that belongs to the output, or the whole.
    ///
    /// # Errors
    /// [`BlockError::unconnected`] if there is none.
    #[inline]
    pub fn image(&self, input: usize) -> Result<Image<'a>, BlockError> {
        self.optional_image(input)
            .ok_or_else(|| BlockError::unconnected(format!("needs an image at input {input}")))
    }

    /// The image at an input, if one is connected.
    #[inline]
    #[must_use]
    pub fn optional_image(&self, input: usize) -> Option<Image<'a>> {
        self.input(input).and_then(image)
    }

    /// The text at an input.
    ///
    /// # Errors
    /// [`BlockError::unconnected`] if there is none.
    pub fn text(&self, input: usize) -> Result<&'a str, BlockError> {
        self.input(input)
            .and_then(text)
            .ok_or_else(|| BlockError::unconnected(format!("needs a text at input {input}")))
    }

    /// The image to write at an output.
    ///
    /// # Errors
    /// If the output is no image.
    #[inline]
    pub fn output(&mut self, output: usize) -> Result<ImageMut<'_>, BlockError> {
        // SAFETY: the contract: there is a wire at each output.
        let wire = self.outputs.get(output).and_then(|wire| unsafe { wire.as_ref() });
        let wire = wire.filter(|wire| wire.kind == PTL_KIND_IMAGE);
        // SAFETY: the contract: the value of an image's wire is a tile that lives as long.
        let tile = wire.and_then(|wire| unsafe { wire.value.cast::<ptlp_tile>().as_ref() });
        let tile = tile.ok_or_else(|| format!("output {output} is no image"))?;
        // SAFETY: as above; `self` is borrowed, so nobody else has an image of this output.
        Ok(unsafe { ImageMut::new(tile) })
    }

    /// Both at once: an output to write while the call is asked for progress and threads.
    ///
    /// # Errors
    /// As [`output`](Self::output).
    pub fn output_and_work(
        &mut self,
        output: usize,
    ) -> Result<(ImageMut<'_>, Work<'a>), BlockError> {
        let work = Work { job: self.job };
        Ok((self.output(output)?, work))
    }

    /// What may be asked while an output is written.
    #[must_use]
    pub fn work(&self) -> Work<'a> {
        Work { job: self.job }
    }
}

/// What a block may ask of the host while it works.
#[derive(Debug, Clone, Copy)]
pub struct Work<'a> {
    job: Job<'a>,
}

impl Work<'_> {
    /// Goes on, or fails because the host asked to stop. Call it every millisecond of work.
    ///
    /// # Errors
    /// [`BlockError::cancelled`].
    pub fn check(&self) -> Result<(), BlockError> {
        if self.job.is_cancelled() { Err(BlockError::cancelled()) } else { Ok(()) }
    }

    /// Tells which part of the work is done, 0 to 1. Of use in blocks of shape Whole.
    pub fn report(&self, fraction: f64) {
        self.job.report(fraction);
    }

    /// Tells the user that something is not as its author meant it.
    pub fn warn(&self, message: &str) {
        self.job.warn(message);
    }

    /// Runs `task` for 0 to before `count` on all threads of the computation, in any order, and
    /// waits for all. After an error no further task starts.
    ///
    /// # Errors
    /// That of the task of the lowest number, or [`BlockError::cancelled`].
    pub fn parallel(
        &self,
        count: usize,
        task: impl Fn(usize) -> Result<(), BlockError> + Sync,
    ) -> Result<(), BlockError> {
        self.job.parallel(count, &task)
    }

    /// Runs `task` for each of `items` on all threads of the computation.
    ///
    /// # Errors
    /// As [`parallel`](Self::parallel).
    pub fn for_each<T: Send>(
        &self,
        items: impl IntoIterator<Item = T>,
        task: impl Fn(T) -> Result<(), BlockError> + Sync,
    ) -> Result<(), BlockError> {
        let items: Vec<_> = items.into_iter().map(|item| Mutex::new(Some(item))).collect();
        self.parallel(items.len(), |number| {
            // Each number is run once, so the lock is free.
            let item = items[number].lock().unwrap_or_else(PoisonError::into_inner).take();
            item.map_or(Ok(()), &task)
        })
    }

    /// The bytes of the file that a path parameter names. Only in blocks of shape Whole.
    ///
    /// # Errors
    /// What the host says: the file is not there, or may not be read.
    pub fn read_file(&self, path: &str) -> Result<Vec<u8>, BlockError> {
        self.job.read_file(path)
    }

    /// Writes a file below a folder that the caller opened for that. Only in blocks of shape Whole.
    ///
    /// # Errors
    /// What the host says: it may not be written, or cannot.
    pub fn write_file(&self, path: &str, bytes: &[u8]) -> Result<(), BlockError> {
        self.job.write_file(path, bytes)
    }
}
