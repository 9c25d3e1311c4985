//! What a check of plug-ins does beside computing graphs: it calls a block with rectangles that the
//! engine never asks for, in memory that shows every sample which is written wrongly or not at all.

use std::{
    ffi::{CStr, c_char, c_int},
    hint::black_box,
    ptr,
};

use ptlib_plugin_abi::{ptlp_tile, ptlp_wire};

use super::{
    call::Means,
    foreign::Foreign,
    load::foreign_of,
    setup::Setup,
    wires::{NO_TILE, Wires, image_wire},
};
use crate::{
    block::{Access, BlockSpec, Planes, Progress, Shape},
    error::Error,
    limits::Limits,
    math::{convert::count, levels::Precision},
    params::ParamValue,
    value::{Image, Value},
};

/// Samples around each rectangle that must stay as they are.
const GUARD: usize = 5;

/// What every sample holds before: a number that no arithmetic gives.
const UNTOUCHED: u32 = 0x7fc0_dead;

/// Widths and heights of the rectangles that an image is cut into; the rest of the image is one
/// more.
const CUTS: [u32; 4] = [1, 3, 2, 7];

/// A rectangle of an image.
#[derive(Debug, Clone, Copy)]
struct Rectangle {
    x: u32,
    y: u32,
    width: u32,
    height: u32,
}

/// Calls a block of shape Point or Gather with the whole image as one rectangle, and with many
/// small ones, and says what it did wrong: samples around a rectangle that were written, samples in
/// it that were not, inputs that were changed, and rectangles that differ from the same part of the
/// whole. Blocks of shape Whole are not called.
///
/// # Errors
/// What the block says.
pub fn probe(
    spec: &'static BlockSpec,
    values: &[ParamValue],
    inputs: &[Option<Image>],
    (width, height): (u32, u32),
) -> Result<Vec<String>, Error> {
    let Some(foreign) = foreign_of(spec).filter(|_| spec.shape() != Shape::Whole) else {
        return Ok(vec![]);
    };
    let probe = Probe { spec, foreign, inputs, width, height };
    let before: Vec<_> = inputs.iter().flatten().map(samples).collect();
    let mut faults = Vec::new();
    let all = Rectangle { x: 0, y: 0, width, height };
    let whole = probe.compute(values, all, &mut faults)?;
    for (x, part_width) in cut(width) {
        for (y, part_height) in cut(height) {
            let part = Rectangle { x, y, width: part_width, height: part_height };
            let outputs = probe.compute(values, part, &mut faults)?;
            probe.compare(&whole, &outputs, part, &mut faults);
        }
    }
    if before != inputs.iter().flatten().map(samples).collect::<Vec<_>>() {
        faults.push("changed the samples of an input".to_owned());
    }
    faults.dedup();
    Ok(faults)
}

/// The bits of all samples of an image.
fn samples(image: &Image) -> Vec<u32> {
    (0..image.planes()).flat_map(|c| image.channel(c)).map(|sample| sample.to_bits()).collect()
}

/// Starts and lengths of parts.
fn cut(length: u32) -> Vec<(u32, u32)> {
    let mut parts = Vec::new();
    let mut start = 0;
    for part in CUTS {
        let part = part.min(length - start);
        if part > 0 {
            parts.push((start, part));
            start += part;
        }
    }
    if start < length {
        parts.push((start, length - start));
    }
    parts
}

struct Probe<'a> {
    spec: &'static BlockSpec,
    foreign: &'static Foreign,
    inputs: &'a [Option<Image>],
    width: u32,
    height: u32,
}

/// A plane with guards around it.
struct Guarded {
    samples: Vec<f32>,
    stride: usize,
    rectangle: Rectangle,
}

impl Guarded {
    fn new(rectangle: Rectangle) -> Self {
        let stride = rectangle.width as usize + 2 * GUARD;
        let rows = rectangle.height as usize + 2 * GUARD;
        let samples = vec![f32::from_bits(UNTOUCHED); stride * rows];
        Self { samples, stride, rectangle }
    }

    fn start(&mut self) -> *mut f32 {
        self.samples[GUARD * self.stride + GUARD..].as_mut_ptr()
    }

    /// The sample at a column and a row of the rectangle, as bits.
    fn at(&self, x: usize, y: usize) -> u32 {
        self.samples[(y + GUARD) * self.stride + GUARD + x].to_bits()
    }

    /// What was written where it should not, and was not where it should.
    fn faults(&self, faults: &mut Vec<String>) {
        let (width, height) = (self.rectangle.width as usize, self.rectangle.height as usize);
        for (place, sample) in self.samples.iter().enumerate() {
            let (x, y) = (place % self.stride, place / self.stride);
            let is_inside =
                (GUARD..GUARD + width).contains(&x) && (GUARD..GUARD + height).contains(&y);
            let is_untouched = sample.to_bits() == UNTOUCHED;
            if is_inside == is_untouched {
                let what = if is_inside { "left a sample unwritten" } else { "wrote outside" };
                let Rectangle { x, y, .. } = self.rectangle;
                let fault = format!("{what} of the rectangle {width} × {height} at ({x}, {y})");
                return faults.push(fault);
            }
        }
    }
}

/// One thread that nobody stops.
struct Undisturbed;

impl Progress for Undisturbed {
    fn check(&self) -> Result<(), Error> {
        Ok(())
    }

    fn parallel(
        &self,
        count: usize,
        task: &(dyn Fn(usize) -> Result<(), Error> + Sync),
    ) -> Result<(), Error> {
        (0..count).try_for_each(task)
    }

    fn report(&self, _: f64) {}
}

impl Probe<'_> {
    /// Has a rectangle of each output written; one list of planes for each.
    fn compute(
        &self,
        values: &[ParamValue],
        part: Rectangle,
        faults: &mut Vec<String>,
    ) -> Result<Vec<Vec<Guarded>>, Error> {
        let limits = Limits::default();
        let means = Means {
            progress: &Undisturbed,
            files: None,
            limits: &limits,
            tell: &|_, _| (),
            making: None,
        };
        let whole = |port: usize| {
            let image = self.inputs.get(port)?.clone()?;
            (self.spec.access(port) == Access::Anywhere).then_some(Value::Image(image))
        };
        let whole: Vec<_> = (0..self.inputs.len()).map(whole).collect();
        let planes: Vec<_> =
            self.inputs.iter().map(|i| i.as_ref().map_or(0, Image::planes)).collect();
        let wires = Wires::of_inputs(&whole, &planes, (self.width, self.height));
        let size = (self.width, self.height);
        let setup = Setup::with(values, Precision::Float, size, 1, wires)?;
        let mut outputs: Vec<Vec<Guarded>> = self
            .spec
            .about
            .outputs
            .iter()
            .map(|port| (0..channels(port.planes, &planes)).map(|_| Guarded::new(part)).collect())
            .collect();
        let in_tiles: Vec<_> = self.inputs.iter().map(|image| self.to_read(image, part)).collect();
        let out_tiles: Vec<_> =
            outputs.iter_mut().map(|planes| self.to_write(planes, part)).collect();
        let in_wires: Vec<ptlp_wire> = in_tiles.iter().map(|tile| image_wire(tile)).collect();
        let out_wires: Vec<ptlp_wire> = out_tiles.iter().map(|tile| image_wire(tile)).collect();
        let pointers = in_wires.iter().enumerate().map(|(port, wire)| {
            let is_row = whole[port].is_none() && self.inputs[port].is_some();
            if is_row { ptr::from_ref(wire) } else { setup.inputs()[port] }
        });
        let pointers: Vec<_> = pointers.collect();
        let targets: Vec<_> = out_wires.iter().map(ptr::from_ref).collect();
        self.foreign.compute_once(&setup, means, &pointers, &targets)?;
        outputs.iter().flatten().for_each(|plane| plane.faults(faults));
        Ok(outputs)
    }

    fn place(&self, part: Rectangle) -> ptlp_tile {
        ptlp_tile {
            x: part.x,
            y: part.y,
            width: part.width,
            height: part.height,
            image_width: self.width,
            image_height: self.height,
            ..NO_TILE
        }
    }

    fn to_read(&self, image: &Option<Image>, part: Rectangle) -> ptlp_tile {
        let Some(image) = image else { return NO_TILE };
        let start = part.y as usize * self.width as usize + part.x as usize;
        let plane = |channel: usize| {
            let is_there = channel < image.planes() || (image.is_grey() && channel < 3);
            if is_there {
                image.channel(channel)[start..].as_ptr().cast_mut()
            } else {
                ptr::null_mut()
            }
        };
        ptlp_tile {
            channels: count(image.planes()),
            row_stride: self.width as usize,
            planes: std::array::from_fn(plane),
            ..self.place(part)
        }
    }

    fn to_write(&self, outputs: &mut [Guarded], part: Rectangle) -> ptlp_tile {
        let channels = count(outputs.len());
        let stride = outputs.first().map_or(0, |plane| plane.stride);
        let mut planes = [ptr::null_mut(); 4];
        for (place, output) in planes.iter_mut().zip(outputs.iter_mut()) {
            *place = output.start();
        }
        if channels == 1 {
            (planes[1], planes[2]) = (planes[0], planes[0]);
        }
        ptlp_tile { channels, row_stride: stride, planes, ..self.place(part) }
    }

    fn compare(
        &self,
        whole: &[Vec<Guarded>],
        outputs: &[Vec<Guarded>],
        part: Rectangle,
        faults: &mut Vec<String>,
    ) {
        let planes = whole.iter().flatten().zip(outputs.iter().flatten());
        for (whole, own) in planes {
            let differs = |(x, y): &(u32, u32)| {
                let (x, y) = (*x as usize, *y as usize);
                whole.at(part.x as usize + x, part.y as usize + y) != own.at(x, y)
            };
            let all = (0..part.height).flat_map(|y| (0..part.width).map(move |x| (x, y)));
            if let Some((x, y)) = all.into_iter().find(differs) {
                faults.push(format!(
                    "gives another value at ({}, {}) in the rectangle {} × {} at ({}, {}) than in \
                     the whole image",
                    part.x + x,
                    part.y + y,
                    part.width,
                    part.height,
                    part.x,
                    part.y
                ));
                return;
            }
        }
    }
}

/// The planes of an output of a plug-in.
fn channels(planes: Planes, inputs: &[usize]) -> usize {
    let found = match planes {
        Planes::Grey | Planes::ByParameters => 1,
        Planes::Colour => 3,
        Planes::ColourAlpha => 4,
        Planes::As(port) => inputs.get(port).copied().unwrap_or(1),
        Planes::Most(ports) => ports.iter().map(|port| inputs[*port]).max().unwrap_or(1),
    };
    found.max(1)
}

/// What of the process plug-ins must leave as it is: the locale, and how this thread rounds.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Environment {
    /// The locale of C functions.
    pub locale: String,
    /// How sums are rounded, and whether the smallest numbers are kept, as results of such sums.
    pub arithmetic: [u32; 4],
}

impl Environment {
    /// That of now.
    #[must_use]
    pub fn now() -> Self {
        let (one, tiny) = (black_box(1.0_f32), black_box(f32::MIN_POSITIVE));
        let (small, half) = (black_box(3e-8_f32), black_box(0.5_f32));
        let results = [one + small, -one - small, tiny * half, one + small * half];
        Self { locale: locale(), arithmetic: results.map(f32::to_bits) }
    }
}

fn locale() -> String {
    unsafe extern "C" {
        fn setlocale(category: c_int, locale: *const c_char) -> *mut c_char;
    }
    // `LC_ALL` of glibc and musl; elsewhere it is 0.
    let all = if cfg!(target_os = "linux") { 6 } else { 0 };
    // SAFETY: asked for with NULL, it only gives the name of the locale.
    let name = unsafe { setlocale(all, ptr::null()) };
    if name.is_null() {
        return String::new();
    }
    // SAFETY: not NULL, and a text of C.
    unsafe { CStr::from_ptr(name) }.to_string_lossy().into_owned()
}
