//! What callers say about a computation, and what they are told.

use std::{path::PathBuf, time::Duration};

use super::Cancel;
use crate::{
    error::{Error, ErrorKind},
    graph::BlockId,
    limits::Limits,
    math::{levels::Precision, simd::SimdLevel},
    value::Format,
};

/// How an [`Engine`](super::Engine) is made.
#[derive(Debug, Clone)]
pub struct EngineOptions {
    /// The most threads that one computation uses, the caller's included; 0 for one per processor.
    pub threads: u32,
    /// How much memory the results kept for later computations may take, in bytes; 0 keeps none.
    pub cache_bytes: u64,
    /// What graph files may ask for.
    pub limits: Limits,
    /// The SIMD level; results do not depend on it.
    pub simd: SimdLevel,
    /// Folders below which every graph may read files, besides the graph's own folder.
    pub read_folders: Vec<PathBuf>,
    /// Folders below which `save file` may write.
    pub write_folders: Vec<PathBuf>,
}

impl Default for EngineOptions {
    fn default() -> Self {
        Self {
            threads: 0,
            cache_bytes: 256 << 20,
            limits: Limits::default(),
            simd: SimdLevel::best(),
            read_folders: Vec::new(),
            write_folders: Vec::new(),
        }
    }
}

/// How far a computation is.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ProgressReport {
    /// Units of work that are done.
    pub units_done: u64,
    /// All units of work.
    pub units_total: u64,
    /// The stage that runs, from 0.
    pub stage: u32,
    /// The block whose output the stage makes.
    pub block: BlockId,
}

impl ProgressReport {
    /// What is done, 0..1.
    #[must_use]
    pub fn fraction(&self) -> f64 {
        #[expect(clippy::cast_precision_loss, reason = "for display")]
        if self.units_total == 0 { 1.0 } else { self.units_done as f64 / self.units_total as f64 }
    }
}

/// Called with how far a computation is; returning `false` cancels it.
pub type ProgressFn<'a> = dyn FnMut(&ProgressReport) -> bool + Send + 'a;

/// How a computation differs from what the graph and the engine say.
pub struct ComputeOptions<'a> {
    /// The size of the result in pixels, instead of the graph's.
    pub size: Option<(u32, u32)>,
    /// The seed, instead of the graph's; blocks with their own keep it.
    pub seed: Option<u64>,
    /// The supersampling, instead of the graph's.
    pub supersampling: Option<u32>,
    /// The precision, instead of the graph's.
    pub precision: Option<Precision>,
    /// The most threads, the caller's included; 0 for the engine's.
    pub threads: u32,
    /// The most memory at the peak in bytes, instead of the engine's limit.
    pub memory_bytes: Option<u64>,
    /// Go on with a white image where a block fails, as PT Designer did.
    pub keep_going: bool,
    /// A request to stop.
    pub cancel: Option<Cancel>,
    /// Called on the calling thread only.
    pub progress: Option<&'a mut ProgressFn<'a>>,
    /// The least time between two calls of `progress`.
    pub progress_interval: Duration,
    /// Takes the faults that white images stand for, with `keep_going`.
    pub failures: Option<&'a mut Vec<Error>>,
    /// Rows of one task, for tests and measurements: results do not depend on it. 0 lets the
    /// engine choose.
    pub strip_rows: u32,
}

impl Default for ComputeOptions<'_> {
    fn default() -> Self {
        Self {
            size: None,
            seed: None,
            supersampling: None,
            precision: None,
            threads: 0,
            memory_bytes: None,
            keep_going: false,
            cancel: None,
            progress: None,
            progress_interval: Duration::from_millis(50),
            failures: None,
            strip_rows: 0,
        }
    }
}

/// The size of an image that is not computed yet.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct OutputShape {
    /// Width in pixels.
    pub width: u32,
    /// Height in pixels.
    pub height: u32,
    /// 1, 3 or 4.
    pub planes: usize,
}

/// Rows of a result that are done.
#[derive(Debug)]
pub struct Band<'a> {
    /// The number of the first of them in the result, from the top.
    pub first_row: u32,
    /// How many there are.
    pub rows: u32,
    /// Pixels of a row.
    pub width: u32,
    /// The format of a pixel.
    pub format: Format,
    /// The pixels, rows without gaps.
    pub pixels: &'a [u8],
}

impl Band<'_> {
    /// Bytes of a row.
    #[must_use]
    pub fn stride(&self) -> usize {
        self.width as usize * self.format.bytes_per_pixel()
    }
}

/// Called with one band after the other, from the top to the bottom; an error ends the computation.
pub type BandFn<'a> = dyn FnMut(&Band<'_>) -> Result<(), Error> + 'a;

/// How a result is delivered by bands.
pub struct Bands<'a> {
    /// The format of a pixel.
    pub format: Format,
    /// Rows of a band (the last one may have fewer); 0 lets the engine choose.
    pub rows: u32,
    /// Takes the bands, on the calling thread only.
    pub deliver: &'a mut BandFn<'a>,
}

/// Pixels of the caller that a computation writes into.
pub struct PixelsMut<'a> {
    /// The format of a pixel.
    pub format: Format,
    /// The pixels, rows from the top.
    pub pixels: &'a mut [u8],
    /// Bytes from the start of a row to the start of the next one.
    pub stride: usize,
}

impl PixelsMut<'_> {
    /// Whether an image of that size fits.
    ///
    /// # Errors
    /// [`ErrorKind::InvalidArgument`] if the rows are too short for it,
    /// [`ErrorKind::BufferTooSmall`].
    pub fn check(&self, width: u32, height: u32) -> Result<(), Error> {
        let row = width as usize * self.format.bytes_per_pixel();
        if self.stride < row {
            let message = format!("rows of {} bytes are given, {row} needed", self.stride);
            return Err(Error::new(ErrorKind::InvalidArgument, message));
        }
        let needed =
            (height as usize - 1).checked_mul(self.stride).and_then(|bytes| bytes.checked_add(row));
        if needed.is_none_or(|needed| self.pixels.len() < needed) {
            let message = format!(
                "a buffer of {} bytes is given, {} needed for {width} × {height}",
                self.pixels.len(),
                needed.unwrap_or(usize::MAX)
            );
            return Err(Error::new(ErrorKind::BufferTooSmall, message));
        }
        Ok(())
    }
}
