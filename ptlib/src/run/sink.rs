//! Where the rows of a wanted output go: reduced by the supersampling, then into planes, into the
//! pixels of the caller, or to the caller band by band.

use std::ops::Range;

use super::options::{Band, BandFn, Bands};
use crate::{
    error::{Error, ErrorKind},
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
    Bands(BandTarget<'a>),
}

struct BandTarget<'a> {
    format: Format,
    /// Rows of a band.
    rows: u32,
    /// The band that is being made.
    pixels: Vec<u8>,
    deliver: &'a mut BandFn<'a>,
    /// Rows that have been delivered. They are not delivered again if all rows are made anew.
    delivered: u32,
}

/// Pixels of a band, if the engine chooses: enough for the threads to share.
const BAND_PIXELS: u32 = 1 << 21;

/// Rows of a band of a result of that size.
pub(super) fn band_rows(bands: &Bands<'_>, (width, height): (u32, u32)) -> u32 {
    let rows = if bands.rows == 0 { BAND_PIXELS / width } else { bands.rows };
    rows.clamp(1, height)
}

/// The memory that bands of a result of that size take.
pub(super) fn band_bytes(bands: &Bands<'_>, size: (u32, u32)) -> u64 {
    let row = u64::from(size.0) * bands.format.bytes_per_pixel() as u64;
    row * u64::from(band_rows(bands, size))
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

    /// To the caller, band by band.
    pub(super) fn bands(
        bands: Bands<'a>,
        size: (u32, u32),
        planes: usize,
        supersampling: u32,
    ) -> Result<Self, Error> {
        let bytes = usize::try_from(band_bytes(&bands, size)).unwrap_or(usize::MAX);
        let mut pixels = Vec::new();
        pixels.try_reserve_exact(bytes).map_err(|_| {
            Error::new(ErrorKind::NoMemory, format!("a band of {bytes} bytes finds no memory"))
        })?;
        pixels.resize(bytes, 0);
        let rows = band_rows(&bands, size);
        let Bands { format, deliver, .. } = bands;
        let target = Target::Bands(BandTarget { format, rows, pixels, deliver, delivered: 0 });
        Ok(Self { target, width: size.0 as usize, planes, supersampling })
    }

    /// The finished image, if it went into planes.
    pub(super) fn into_image(self) -> Option<Image> {
        match self.target {
            Target::Image(image) => Some(image),
            Target::None | Target::Pixels { .. } | Target::Bands(_) => None,
        }
    }

    /// How many result rows are made before they are delivered; `None`: all.
    pub(super) fn rows_at_once(&self) -> Option<u32> {
        match &self.target {
            Target::Bands(target) => Some(target.rows),
            _ => None,
        }
    }

    /// Delivers result rows that have been made, if they go to somebody who waits for them.
    pub(super) fn deliver(&mut self, rows: &Range<u32>) -> Result<(), Error> {
        let width = u32::try_from(self.width).unwrap_or(u32::MAX);
        match &mut self.target {
            Target::Bands(target) if rows.end > target.delivered => {
                target.delivered = rows.end;
                let (first_row, format) = (rows.start, target.format);
                let bytes = self.width * rows.len() * format.bytes_per_pixel();
                let pixels = &target.pixels[..bytes];
                let rows = rows.end - rows.start;
                (target.deliver)(&Band { first_row, rows, width, format, pixels })
            }
            _ => Ok(()),
        }
    }

    /// The result rows `range`, in parts of `rows` rows each.
    pub(super) fn split(&mut self, range: &Range<u32>, rows: u32) -> Vec<SinkStrip<'_>> {
        let rows = rows as usize;
        let range = range.start as usize..range.end as usize;
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
                let count = range.len().div_ceil(rows);
                let mut parts: Vec<Vec<&mut [f32]>> = (0..count).map(|_| Vec::new()).collect();
                for plane in image.planes_mut() {
                    let plane = &mut plane[range.start * width..range.end * width];
                    for (part, chunk) in parts.iter_mut().zip(plane.chunks_mut(width * rows)) {
                        part.push(chunk);
                    }
                }
                parts.into_iter().map(|part| strip(StripTarget::Planes(part))).collect()
            }
            Target::Pixels { format, pixels, stride } => {
                let (format, stride) = (*format, *stride);
                // The last row may be shorter than the others.
                let end = pixels.len().min(range.end * stride);
                let chunks = pixels[range.start * stride..end].chunks_mut((stride * rows).max(1));
                chunks.map(|pixels| strip(StripTarget::Pixels { format, pixels, stride })).collect()
            }
            Target::Bands(BandTarget { format, pixels, .. }) => {
                let format = *format;
                let stride = width * format.bytes_per_pixel();
                let chunks = pixels[..range.len() * stride].chunks_mut(stride * rows);
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
