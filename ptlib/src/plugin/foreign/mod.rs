//! A block type of a plug-in, as the engine computes it.
//!
//! The engine asks a [`RowFactory`](crate::block::RowFactory) or a
//! [`WholeFactory`](crate::block::WholeFactory); [`Factory`] is both ([`rows`], [`whole`]), and
//! turns each question into calls of the plug-in's functions. A computation has an *instance* of
//! its own (`create`, `prepare`), or several where the plug-in says that one serves one thread only.

mod rows;
mod whole;

use std::{
    ffi::c_void,
    ptr,
    sync::{Mutex, MutexGuard, PoisonError},
};

use ptlib_plugin_abi::{ptlp_block, ptlp_wire};

use super::{
    call::{Call, Means},
    host::host,
    setup::Setup,
};
use crate::{
    error::{Error, ErrorKind},
    params::ParamValue,
    value::Kind,
};

pub(in crate::plugin) use whole::GraphInput;

/// Who may be inside of a block type's functions at a time.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum ThreadMode {
    /// Any number of threads, on one instance.
    Tiles,
    /// One thread on each instance.
    Instance,
    /// One thread in the process.
    Global,
}

/// A block type of a plug-in.
pub(super) struct Foreign {
    table: &'static ptlp_block,
    threads: ThreadMode,
    /// The kinds of its outputs.
    outputs: Vec<Kind>,
    /// Held around every call, in mode [`Global`](ThreadMode::Global).
    global: Mutex<()>,
}

/// What the engine asks: a block type that lives for ever.
pub(super) struct Factory(&'static Foreign);

impl Factory {
    /// Leaks the block type: it is made once in a process.
    pub(super) fn leaked(
        table: &'static ptlp_block,
        threads: ThreadMode,
        outputs: Vec<Kind>,
    ) -> &'static Self {
        let foreign = Foreign { table, threads, outputs, global: Mutex::new(()) };
        Box::leak(Box::new(Self(Box::leak(Box::new(foreign)))))
    }

    pub(super) fn foreign(&self) -> &'static Foreign {
        self.0
    }
}

fn lock<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}

impl Foreign {
    /// Runs something while no other thread is inside, where only one may be.
    #[inline]
    fn alone<T>(&self, run: impl FnOnce() -> T) -> T {
        let _guard = (self.threads == ThreadMode::Global).then(|| lock(&self.global));
        run()
    }

    /// A new instance, prepared.
    fn prepared(&'static self, setup: &Setup, means: Means<'_>) -> Result<Instance, Error> {
        let call = Call::new(means);
        let mut instance = Instance { foreign: self, raw: ptr::null_mut() };
        self.alone(|| {
            if let Some(create) = self.table.create {
                // SAFETY: the contract; the table is a block of its plug-in.
                call.run("create", |_| unsafe {
                    create(self.table, host(), &raw mut instance.raw)
                })?;
            }
            if let Some(prepare) = self.table.prepare {
                // SAFETY: the contract; the instance is new, the setup lives during the call.
                call.run("prepare", |job| unsafe { prepare(instance.raw, job, setup.raw()) })?;
            }
            Ok(())
        })?;
        Ok(instance)
    }

    /// Computes with an instance that is made for it.
    pub(super) fn compute_once(
        &'static self,
        setup: &Setup,
        means: Means<'_>,
        inputs: &[*const ptlp_wire],
        outputs: &[*const ptlp_wire],
    ) -> Result<(), Error> {
        let instance = self.prepared(setup, means)?;
        instance.compute(&Call::new(means), inputs, outputs)
    }

    fn memory(&self, values: &[ParamValue], width: u32, height: u32) -> Result<u64, Error> {
        let Some(memory) = self.table.memory else { return Ok(0) };
        let setup = Setup::without_inputs(values, width, height)?;
        // SAFETY: the contract.
        Ok(self.alone(|| unsafe { memory(self.table, setup.raw()) }))
    }
}

/// What `create` made.
struct Instance {
    foreign: &'static Foreign,
    raw: *mut c_void,
}

// SAFETY: the contract lets an instance be used by one thread after another.
unsafe impl Send for Instance {}
// SAFETY: only blocks of mode TILES share one, which the contract allows them.
unsafe impl Sync for Instance {}

impl Instance {
    #[inline]
    fn compute(
        &self,
        call: &Call<'_>,
        inputs: &[*const ptlp_wire],
        outputs: &[*const ptlp_wire],
    ) -> Result<(), Error> {
        let Some(compute) = self.foreign.table.compute else {
            let message = "a block without `compute` was not refused";
            return Err(Error::new(ErrorKind::Internal, message));
        };
        let (inputs, outputs) = (inputs.as_ptr(), outputs.as_ptr());
        self.foreign.alone(|| {
            // SAFETY: the contract; instance, wires and what they lead to live during the call.
            call.run("compute", |job| unsafe { compute(self.raw, job, inputs, outputs) })
        })
    }
}

impl Drop for Instance {
    fn drop(&mut self) {
        if let Some(destroy) = self.foreign.table.destroy
            && !self.raw.is_null()
        {
            // SAFETY: the contract; nobody uses the instance any more.
            self.foreign.alone(|| unsafe { destroy(self.raw) });
        }
    }
}
