//! From a [`Block`] to the table that the host reads: the functions in it catch panics, so that
//! none leaves the plug-in.

use std::{
    any::Any,
    ffi::{CStr, CString, c_void},
    panic::{AssertUnwindSafe, catch_unwind},
    ptr,
    sync::atomic::{AtomicBool, Ordering},
};

use ptlib_plugin_abi::*;

use crate::{
    About, Block, BlockError, Call, GraphInput, ParamSet, Setup, block::optional, host, job::Job,
    make::Open, private::count,
};

/// What the host holds as an instance.
struct Slot<B> {
    /// Set by `prepare`.
    block: Option<B>,
    /// Whether a panic has left it half-changed.
    is_poisoned: AtomicBool,
}

/// The table of a block type.
#[must_use]
pub const fn table<B: Block>() -> ptlp_block {
    ptlp_block {
        create: Some(create::<B>),
        destroy: Some(destroy::<B>),
        prepare: Some(prepare::<B>),
        compute: Some(compute::<B>),
        memory: Some(memory::<B>),
        ..described(&B::ABOUT, B::Params::TABLE)
    }
}

/// The table of an input of graphs.
#[must_use]
pub const fn graph_input<I: GraphInput>() -> ptlp_block {
    let mut block = described(&I::ABOUT, I::Params::TABLE);
    block.flags |= PTLP_BLOCK_GRAPH_INPUT;
    block.shape = PTLP_SHAPE_WHOLE;
    block
}

/// The table of a block type without functions.
const fn described(about: &About, params: &'static [&'static ptlp_param]) -> ptlp_block {
    let seed = if about.uses_seed { PTLP_BLOCK_USES_SEED } else { 0 };
    let varies = if about.varies { PTLP_BLOCK_NOT_DETERMINISTIC } else { 0 };
    ptlp_block {
        struct_size: count(size_of::<ptlp_block>()),
        version: about.version,
        shape: about.shape as u32,
        thread_mode: about.threads as u32,
        flags: seed | varies,
        input_count: count(about.inputs.len()),
        output_count: count(about.outputs.len()),
        param_count: count(params.len()),
        id: about.id.as_ptr(),
        name: optional(about.name),
        category: optional(about.category),
        doc: optional(about.summary),
        tiling_exception: optional(about.tiling_exception),
        in_pixels: optional(about.in_pixels),
        inputs: about.inputs.as_ptr().cast(),
        outputs: about.outputs.as_ptr().cast(),
        params: params.as_ptr().cast(),
        user_data: ptr::null_mut(),
        create: None,
        destroy: None,
        prepare: None,
        compute: None,
        memory: None,
    }
}

unsafe extern "C" fn create<B: Block>(
    _: *const ptlp_block,
    from: *const ptlp_host,
    instance: *mut *mut c_void,
) -> ptlp_status {
    host::set(from);
    let slot = Box::new(Slot::<B> { block: None, is_poisoned: AtomicBool::new(false) });
    // SAFETY: the host gives a place for the instance.
    unsafe { instance.write(Box::into_raw(slot).cast()) };
    PTLP_OK
}

unsafe extern "C" fn destroy<B: Block>(instance: *mut c_void) {
    // SAFETY: the host gives back what `create` made, once.
    let slot = unsafe { Box::from_raw(instance.cast::<Slot<B>>()) };
    let _ = catch_unwind(AssertUnwindSafe(|| drop(slot)));
}

unsafe extern "C" fn prepare<B: Block>(
    instance: *mut c_void,
    job: *const ptlp_job,
    setup: *const ptlp_setup,
) -> ptlp_status {
    // SAFETY: the host calls this before it shares the instance with other threads; job and setup
    // live during the call.
    let (slot, job, setup) = unsafe {
        (&mut *instance.cast::<Slot<B>>(), Job::new(job), Setup::new(setup, Job::new(job)))
    };
    guarded::<B>(&job, None, || {
        slot.block = Some(B::prepare(&B::Params::read(setup.values()), &setup)?);
        Ok(())
    })
}

unsafe extern "C" fn compute<B: Block>(
    instance: *mut c_void,
    job: *const ptlp_job,
    inputs: *const *const ptlp_wire,
    outputs: *const *const ptlp_wire,
) -> ptlp_status {
    let open = Open::default();
    // SAFETY: `prepare` is done, so nobody changes the slot; job and wires live during the call,
    // and there are as many as the description says.
    let (slot, job, mut call) = unsafe {
        let about = &B::ABOUT;
        let (inputs, outputs) = (
            std::slice::from_raw_parts(not_null(inputs), about.inputs.len()),
            std::slice::from_raw_parts(not_null(outputs), about.outputs.len()),
        );
        let slot = &*instance.cast::<Slot<B>>();
        (slot, Job::new(job), Call::new((Job::new(job), &open), inputs, outputs))
    };
    guarded::<B>(&job, Some(&slot.is_poisoned), || match &slot.block {
        Some(block) => block.compute(&mut call),
        None => Err(BlockError::from("`compute` came before `prepare`")),
    })
}

/// A slice of nothing needs a pointer, too.
fn not_null<T>(pointer: *const T) -> *const T {
    if pointer.is_null() { ptr::dangling() } else { pointer }
}

unsafe extern "C" fn memory<B: Block>(_: *const ptlp_block, setup: *const ptlp_setup) -> u64 {
    let ask = || {
        // SAFETY: the setup lives during the call.
        let setup = unsafe { Setup::new(setup, Job::none()) };
        B::memory(&B::Params::read(setup.values()), setup.width(), setup.height())
    };
    catch_unwind(AssertUnwindSafe(ask)).unwrap_or(0)
}

/// Runs a function of a block, tells the host what went wrong, and stops panics.
fn guarded<B: Block>(
    job: &Job<'_>,
    poisoned: Option<&AtomicBool>,
    run: impl FnOnce() -> Result<(), BlockError>,
) -> ptlp_status {
    if poisoned.is_some_and(|poisoned| poisoned.load(Ordering::Relaxed)) {
        job.set_error(&said::<B>("panicked before"));
        return PTLP_E_PANIC;
    }
    match catch_unwind(AssertUnwindSafe(run)) {
        Ok(Ok(())) => PTLP_OK,
        Ok(Err(error)) => {
            if let Some(message) = &error.message {
                job.set_error(message);
            }
            error.status
        }
        Err(panic) => {
            if let Some(poisoned) = poisoned {
                poisoned.store(true, Ordering::Relaxed);
            }
            job.set_error(&said::<B>(&format!("panicked: {}", text_of(&*panic))));
            PTLP_E_PANIC
        }
    }
}

fn said<B: Block>(what: &str) -> CString {
    let id: &CStr = B::ABOUT.id;
    let text = format!("\"{}\" {what}", id.to_string_lossy()).replace('\0', " ");
    CString::new(text).unwrap_or_default()
}

fn text_of(panic: &(dyn Any + Send)) -> &str {
    match (panic.downcast_ref::<&str>(), panic.downcast_ref::<String>()) {
        (Some(text), _) => text,
        (_, Some(text)) => text,
        _ => "without a message",
    }
}
