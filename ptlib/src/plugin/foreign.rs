//! A block type of a plug-in, as the engine computes it.
//!
//! The engine asks a [`RowFactory`] or a [`WholeFactory`]; [`Foreign`] is both, and turns each
//! question into calls of the plug-in's functions. A computation has an *instance* of its own
//! (`create`, `prepare`), or several where the plug-in says that one serves one thread only.

use std::{
    ffi::c_void,
    ptr,
    sync::{Mutex, MutexGuard, PoisonError},
};

use ptlib_plugin_abi::{ptlp_block, ptlp_tile, ptlp_wire};

use super::{
    call::{Call, Means},
    host::host,
    making::Making,
    setup::Setup,
    wires::{NO_TILE, NO_WIRE, image_wire, to_write},
};
use crate::{
    block::{
        Context, InputRows, LogLevel, MAX_INPUTS, MAX_OUTPUT_PLANES, OutputRow, PrepareContext,
        RowContext, RowFactory, RowKernel, WholeContext, WholeFactory,
    },
    error::{Error, ErrorKind},
    limits::Limits,
    math::{convert::count, levels::Precision},
    params::ParamValue,
    value::{Image, Kind, Value},
};

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

/// Messages that a block may have while it writes rows; of more, the first count.
const MAX_MESSAGES: usize = 100;

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

impl RowFactory for Factory {
    fn prepare(
        &self,
        values: &[ParamValue],
        precision: Precision,
        cx: &PrepareContext<'_>,
    ) -> Result<Box<dyn RowKernel>, Error> {
        let setup = Setup::new(values, precision, cx)?;
        let first = self.0.prepared(&setup, Means::of(cx))?;
        let (shared, idle) = match self.0.threads {
            ThreadMode::Tiles | ThreadMode::Global => (Some(first), vec![]),
            ThreadMode::Instance => (None, vec![first]),
        };
        Ok(Box::new(Rows {
            foreign: self.0,
            shared,
            idle: Mutex::new(idle),
            outputs: cx.planes.outputs.to_vec(),
            limits: *cx.limits,
            messages: Mutex::new(Vec::new()),
            setup,
        }))
    }

    fn is_grey(&self, _: &[ParamValue]) -> Result<bool, Error> {
        Ok(true)
    }

    fn scratch_bytes(
        &self,
        values: &[ParamValue],
        width: u32,
        height: u32,
        _: usize,
    ) -> Result<u64, Error> {
        self.0.memory(values, width, height)
    }
}

/// A prepared block of shape Point or Gather.
struct Rows {
    foreign: &'static Foreign,
    /// What further instances are prepared from; holds the inputs that are read anywhere.
    setup: Setup,
    /// The instance that all threads use.
    shared: Option<Instance>,
    /// Those that no thread uses at the moment, where each thread needs one of its own.
    idle: Mutex<Vec<Instance>>,
    /// The planes of each output.
    outputs: Vec<usize>,
    limits: Limits,
    messages: Mutex<Vec<(LogLevel, Error)>>,
}

/// As many ports as the blocks have that run often: tables for many cost time in each segment.
const FEW_PORTS: usize = 4;
const MANY_PORTS: usize = MAX_INPUTS + MAX_OUTPUT_PLANES;

impl RowKernel for Rows {
    fn row(
        &self,
        cx: &RowContext<'_>,
        inputs: &InputRows<'_>,
        out: &mut OutputRow<'_>,
    ) -> Result<(), Error> {
        let tell = |level, what| {
            let mut messages = lock(&self.messages);
            if messages.len() < MAX_MESSAGES {
                messages.push((level, what));
            }
        };
        let means = Means {
            progress: cx.progress,
            files: None,
            limits: &self.limits,
            tell: &tell,
            making: None,
        };
        let call = Call::new(means);
        if self.setup.inputs().len() + self.outputs.len() <= FEW_PORTS {
            self.write::<FEW_PORTS>(&call, cx, inputs, out)
        } else {
            self.write::<MANY_PORTS>(&call, cx, inputs, out)
        }
    }

    fn messages(&self) -> Vec<(LogLevel, Error)> {
        std::mem::take(&mut lock(&self.messages))
    }
}

impl Rows {
    /// Has at most `PORTS` inputs and outputs written and read.
    #[inline]
    fn write<const PORTS: usize>(
        &self,
        call: &Call<'_>,
        cx: &RowContext<'_>,
        inputs: &InputRows<'_>,
        out: &mut OutputRow<'_>,
    ) -> Result<(), Error> {
        let place = ptlp_tile {
            x: cx.x,
            y: cx.y,
            height: 1,
            image_width: cx.width,
            image_height: cx.height,
            ..NO_TILE
        };
        let mut tiles = [NO_TILE; PORTS];
        let mut wires = [NO_WIRE; PORTS];
        let mut pointers = [ptr::null(); PORTS];
        let input_count = self.setup.inputs().len();
        let mut first_plane = 0;
        for (port, tile) in tiles.iter_mut().enumerate().take(input_count + self.outputs.len()) {
            *tile = match port.checked_sub(input_count) {
                None => row_to_read(place, inputs, port),
                Some(output) => {
                    let planes = self.outputs[output];
                    first_plane += planes;
                    row_to_write(place, out, first_plane - planes, planes)
                }
            };
        }
        for (port, (pointer, wire)) in pointers.iter_mut().zip(&mut wires).enumerate() {
            *pointer = match self.setup.inputs().get(port) {
                Some(whole) if tiles[port].channels == 0 => *whole,
                _ => {
                    *wire = image_wire(&raw const tiles[port]);
                    ptr::from_ref(wire)
                }
            };
        }
        let (inputs, outputs) = pointers.split_at(input_count);
        self.with_instance(call, |instance| instance.compute(call, inputs, outputs))
    }

    #[inline]
    fn with_instance(
        &self,
        call: &Call<'_>,
        run: impl FnOnce(&Instance) -> Result<(), Error>,
    ) -> Result<(), Error> {
        if let Some(shared) = &self.shared {
            return run(shared);
        }
        let idle = lock(&self.idle).pop();
        let own = match idle {
            Some(own) => own,
            None => self.foreign.prepared(&self.setup, call.means)?,
        };
        run(&own)?;
        lock(&self.idle).push(own);
        Ok(())
    }
}

/// A part of a row of an input that comes row by row; of no channels if it does not.
#[inline]
fn row_to_read(place: ptlp_tile, inputs: &InputRows<'_>, port: usize) -> ptlp_tile {
    let channels = inputs.planes(port);
    if channels == 0 {
        return NO_TILE;
    }
    let red = inputs.channel(port, 0);
    let plane = |channel: usize| inputs.channel(port, channel).as_ptr().cast_mut();
    let alpha = if channels == 4 { plane(3) } else { ptr::null_mut() };
    ptlp_tile {
        channels: count(channels),
        width: count(red.len()),
        row_stride: red.len(),
        planes: [plane(0), plane(1), plane(2), alpha],
        ..place
    }
}

/// A part of a row of an output of `count` planes.
#[inline]
fn row_to_write(
    place: ptlp_tile,
    out: &mut OutputRow<'_>,
    first: usize,
    channels: usize,
) -> ptlp_tile {
    let width = out.plane(first).len();
    let mut planes = [ptr::null_mut(); 4];
    for (channel, plane) in planes.iter_mut().enumerate().take(channels) {
        *plane = out.plane(first + channel).as_mut_ptr();
    }
    if channels == 1 {
        (planes[1], planes[2]) = (planes[0], planes[0]);
    }
    ptlp_tile { channels: count(channels), width: count(width), row_stride: width, planes, ..place }
}

impl WholeFactory for Factory {
    fn compute(
        &self,
        values: &[ParamValue],
        precision: Precision,
        cx: &WholeContext<'_>,
    ) -> Result<Vec<Value>, Error> {
        let setup = Setup::new(values, precision, cx)?;
        let instance = self.0.prepared(&setup, Means::of(cx))?;
        let kinds = &self.0.outputs;
        let making = Making::new(kinds, cx.inputs);
        let images = cx.planes.outputs.iter().map(|planes| match planes {
            0 => Ok(None),
            planes => image(cx, *planes).map(Some),
        });
        let mut images = images.collect::<Result<Vec<_>, _>>()?;
        let tile = |image: &mut Option<Image>| image.as_mut().map_or(NO_TILE, to_write);
        let tiles: Vec<_> = images.iter_mut().map(tile).collect();
        let wires = tiles.iter().zip(kinds).map(|(tile, kind)| match kind {
            Kind::Image => image_wire(tile),
            kind => ptlp_wire { kind: *kind as u32, ..NO_WIRE },
        });
        let wires: Vec<_> = wires.collect();
        let pointers: Vec<_> = wires.iter().map(ptr::from_ref).collect();
        let call = Call::new(Means { making: Some(&making), ..Means::of(cx) });
        instance.compute(&call, setup.inputs(), &pointers)?;
        let made = images.into_iter().enumerate().map(|(output, image)| match image {
            Some(image) => Ok(Value::Image(image)),
            None => making.take(output),
        });
        made.collect()
    }

    fn is_grey(&self, _: &[ParamValue]) -> Result<bool, Error> {
        Ok(true)
    }

    fn scratch_bytes(&self, values: &[ParamValue], width: u32, height: u32) -> Result<u64, Error> {
        self.0.memory(values, width, height)
    }
}

/// An image that is not a number where the plug-in leaves it as it is: so that this is noticed, and
/// what was in the memory before is not seen.
fn image(cx: &Context<'_>, planes: usize) -> Result<Image, Error> {
    let mut image = cx.new_image(planes)?;
    image.planes_mut().for_each(|plane| plane.fill(f32::NAN));
    Ok(image)
}
