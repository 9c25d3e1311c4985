//! A block of a plug-in that writes rows: of shape Point or Gather.

use std::{ptr, sync::Mutex};

use ptlib_plugin_abi::ptlp_tile;

use super::{
    super::{
        call::{Call, Means},
        setup::Setup,
        wires::{NO_TILE, NO_WIRE, image_wire},
    },
    Factory, Foreign, Instance, ThreadMode, lock,
};
use crate::{
    block::{
        InputRows, LogLevel, MAX_INPUTS, MAX_OUTPUT_PLANES, OutputRow, PrepareContext, RowContext,
        RowFactory, RowKernel,
    },
    error::Error,
    limits::Limits,
    math::{convert::count, levels::Precision},
    params::ParamValue,
};

/// Messages that a block may have while it writes rows; of more, the first count.
const MAX_MESSAGES: usize = 100;

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
