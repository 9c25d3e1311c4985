//! Where the rows of a wanted output go: reduced by the supersampling, then into planes or into
//! the pixels of the caller.

use crate::{
    math::levels::{EightBit, Levels, Precision},
    value::{Format, Image, MAX_PLANES},
};

/// A wanted output on its way out.
pub(super) struct Sink<'a> {
    target: Target<'a>,
    width: usize,
    planes: usize,
    supersampling: u32,
}

enum Target<'a> {
    None,
    Image(Image),
    Pixels { format: Format, pixels: &'a mut [u8], stride: usize },
}

/// The part of a sink that one strip writes.
pub(super) struct SinkStrip<'a> {
    target: StripTarget<'a>,
    width: usize,
    supersampling: u32,
    /// The result row that is being made: sums of the rows so far, one plane after the other.
    sums: Vec<f32>,
}

enum StripTarget<'a> {
    Planes(Vec<&'a mut [f32]>),
    Pixels { format: Format, pixels: &'a mut [u8], stride: usize },
}

impl<'a> Sink<'a> {
    /// Nowhere: what is wanted is a stored value.
    pub(super) fn none() -> Self {
        Self { target: Target::None, width: 0, planes: 0, supersampling: 1 }
    }

    /// Into planes.
    pub(super) fn image(image: Image, supersampling: u32) -> Self {
        let (width, planes) = (image.width() as usize, image.planes());
        Self { target: Target::Image(image), width, planes, supersampling }
    }

    /// Into pixels of the caller: at least rows · `stride` bytes.
    pub(super) fn pixels(
        (format, pixels, stride): (Format, &'a mut [u8], usize),
        width: u32,
        planes: usize,
        supersampling: u32,
    ) -> Self {
        let target = Target::Pixels { format, pixels, stride };
        Self { target, width: width as usize, planes, supersampling }
    }

    /// The finished image, if it went into planes.
    pub(super) fn into_image(self) -> Option<Image> {
        match self.target {
            Target::Image(image) => Some(image),
            Target::None | Target::Pixels { .. } => None,
        }
    }

    /// Parts of `rows` result rows each.
    pub(super) fn split(&mut self, rows: u32) -> Vec<SinkStrip<'_>> {
        let rows = rows as usize;
        let (width, supersampling, planes) = (self.width, self.supersampling, self.planes);
        let strip = |target| SinkStrip {
            target,
            width,
            supersampling,
            sums: vec![0.0; if supersampling > 1 { width * planes } else { 0 }],
        };
        match &mut self.target {
            Target::None => Vec::new(),
            Target::Image(image) => {
                let count = (image.height() as usize).div_ceil(rows);
                let mut parts: Vec<Vec<&mut [f32]>> = (0..count).map(|_| Vec::new()).collect();
                for plane in image.planes_mut() {
                    for (part, chunk) in parts.iter_mut().zip(plane.chunks_mut(width * rows)) {
                        part.push(chunk);
                    }
                }
                parts.into_iter().map(|part| strip(StripTarget::Planes(part))).collect()
            }
            Target::Pixels { format, pixels, stride } => {
                let (format, stride) = (*format, *stride);
                let chunks = pixels.chunks_mut((stride * rows).max(1));
                chunks.map(|pixels| strip(StripTarget::Pixels { format, pixels, stride })).collect()
            }
        }
    }
}

impl SinkStrip<'_> {
    /// Takes row `row` of the strip, before reduction.
    pub(super) fn put(&mut self, precision: Precision, row: u32, planes: &[&[f32]]) {
        let step = self.supersampling;
        if step == 1 {
            self.target.write(row as usize, self.width, planes);
            return;
        }
        let is_first = row.is_multiple_of(step);
        for (sums, plane) in self.sums.chunks_exact_mut(self.width).zip(planes) {
            for (sum, cell) in sums.iter_mut().zip(plane.chunks_exact(step as usize)) {
                let cells = cell.iter().fold(0.0, |total, value| total + value);
                *sum = if is_first { cells } else { *sum + cells };
            }
        }
        if (row + 1).is_multiple_of(step) {
            let area = (step * step) as f32;
            for sum in &mut self.sums {
                let mean = *sum / area;
                // Specification 1.5: the mean of levels is truncated too.
                *sum = if precision == Precision::EightBit { EightBit::store(mean) } else { mean };
            }
            let mut reduced: [&[f32]; MAX_PLANES] = [&[]; _];
            for (reduced, sums) in reduced.iter_mut().zip(self.sums.chunks_exact(self.width)) {
                *reduced = sums;
            }
            self.target.write((row / step) as usize, self.width, &reduced[..planes.len()]);
        }
    }
}

impl StripTarget<'_> {
    fn write(&mut self, row: usize, width: usize, planes: &[&[f32]]) {
        match self {
            Self::Planes(targets) => {
                for (target, plane) in targets.iter_mut().zip(planes) {
                    target[row * width..][..width].copy_from_slice(plane);
                }
            }
            Self::Pixels { format, pixels, stride } => {
                let bytes = width * format.bytes_per_pixel();
                format.write_row(planes, &mut pixels[row * *stride..][..bytes]);
            }
        }
    }
}
