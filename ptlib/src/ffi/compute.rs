//! Computing on the calling thread.

use std::{ffi::c_void, sync::Arc, time::Duration};

use super::{
    PTL_COMPUTE_KEEP_GOING, PTL_COMPUTE_SEED, PTL_FORMAT_AUTO, PTL_PRECISION_DEFAULT,
    argument::Argument,
    engine::EngineObject,
    graph::GraphObject,
    graph_settings::precision_of,
    handle::{Handle, NewHandle, Tagged, tagged},
    image::ImageObject,
    ptl_band, ptl_band_fn, ptl_block, ptl_cancel, ptl_compute_options, ptl_error, ptl_format,
    ptl_graph, ptl_image, ptl_progress, ptl_progress_fn, ptl_status,
    structs::{In, Uninitialised},
};
use crate::{
    error::{Error, ErrorKind},
    graph::{BlockId, Graph},
    math::levels::Precision,
    run::{
        Band, Bands, Cancel, ComputeOptions, OutputShape, PixelsMut, ProgressFn, ProgressReport,
    },
    value::{Format, Value},
};

/// A computation as the caller asked for it, with a graph of its own.
pub(super) struct Request {
    engine: Arc<Tagged<EngineObject>>,
    graph: Graph,
    block: BlockId,
    output: u32,
    pub(super) settings: Settings,
}

/// The caller's options, checked.
pub(super) struct Settings {
    size: Option<(u32, u32)>,
    seed: Option<u64>,
    supersampling: Option<u32>,
    precision: Option<Precision>,
    threads: u32,
    memory_bytes: Option<u64>,
    keep_going: bool,
    format: Option<Format>,
    pub(super) cancel: Option<Cancel>,
    interval: Duration,
    pub(super) callback: Option<Callback>,
}

/// The caller's progress function.
#[derive(Debug, Clone, Copy)]
pub(super) struct Callback {
    function: unsafe extern "C" fn(*const ptl_progress, *mut c_void) -> i32,
    user_data: *mut c_void,
}

// SAFETY: it is called only on threads of the caller that are inside a call that documents this;
// it is merely carried elsewhere.
unsafe impl Send for Callback {}
// SAFETY: as above.
unsafe impl Sync for Callback {}

impl Callback {
    fn of(function: ptl_progress_fn, user_data: *mut c_void) -> Option<Self> {
        function.map(|function| Self { function, user_data })
    }

    /// Tells the caller; `false` to cancel.
    pub(super) fn call(self, report: &ProgressReport) -> bool {
        let progress = progress_of(report);
        // SAFETY: the caller's function, with the pointer that it was given for.
        unsafe { (self.function)(&raw const progress, self.user_data) == 0 }
    }
}

/// The caller's function that takes bands.
#[derive(Debug, Clone, Copy)]
struct BandCallback {
    function: unsafe extern "C" fn(*const ptl_band, *mut c_void) -> i32,
    user_data: *mut c_void,
}

impl BandCallback {
    /// Hands a band over.
    fn call(self, band: &Band<'_>) -> Result<(), Error> {
        let given = ptl_band {
            struct_size: u32::try_from(size_of::<ptl_band>()).unwrap_or_default(),
            first_row: band.first_row,
            rows: band.rows,
            width: band.width,
            format: band.format as ptl_format,
            reserved0: 0,
            row_stride: band.stride(),
            pixels: band.pixels.as_ptr().cast(),
        };
        // SAFETY: the caller's function, with the pointer that it was given for.
        match unsafe { (self.function)(&raw const given, self.user_data) } {
            0 => Ok(()),
            _ => Err(Error::new(
                ErrorKind::Cancelled,
                format!("`on_band` cancelled the computation at row {}", band.first_row),
            )),
        }
    }
}

/// A report as C reads it.
pub(super) fn progress_of(report: &ProgressReport) -> ptl_progress {
    ptl_progress {
        struct_size: u32::try_from(size_of::<ptl_progress>()).unwrap_or_default(),
        stage: report.stage,
        units_done: report.units_done,
        units_total: report.units_total,
        fraction: report.fraction(),
        block: report.block.to_raw(),
    }
}

impl Settings {
    fn of(options: &ptl_compute_options) -> Result<Self, Error> {
        refuse_unknown(options)?;
        fn given<T: PartialEq + Default>(value: T) -> Option<T> {
            (value != T::default()).then_some(value)
        }
        let cancel = if options.cancel.is_null() {
            None
        } else {
            // SAFETY: callers promise that this is a handle.
            let cancel = unsafe { Handle::<ptl_cancel>::receive(options.cancel, "cancel") }?;
            Some(Cancel::clone(&cancel))
        };
        Ok(Self {
            size: size_of_result(options)?,
            seed: (options.flags & PTL_COMPUTE_SEED != 0).then_some(options.seed),
            supersampling: given(options.supersampling),
            precision: match options.precision {
                PTL_PRECISION_DEFAULT => None,
                number => Some(precision_of(number)?),
            },
            threads: options.threads,
            memory_bytes: given(options.memory_limit),
            keep_going: options.flags & PTL_COMPUTE_KEEP_GOING != 0,
            format: format_of(options.format)?,
            cancel,
            interval: match options.progress_interval_ms {
                0 => ComputeOptions::default().progress_interval,
                milliseconds => Duration::from_millis(milliseconds.into()),
            },
            callback: Callback::of(options.progress, options.user_data),
        })
    }

    fn to_options<'a>(
        &self,
        cancel: Option<Cancel>,
        progress: Option<&'a mut ProgressFn<'a>>,
    ) -> ComputeOptions<'a> {
        ComputeOptions {
            size: self.size,
            seed: self.seed,
            supersampling: self.supersampling,
            precision: self.precision,
            threads: self.threads,
            memory_bytes: self.memory_bytes,
            keep_going: self.keep_going,
            cancel,
            progress,
            progress_interval: self.interval,
            ..ComputeOptions::default()
        }
    }
}

fn refuse_unknown(options: &ptl_compute_options) -> Result<(), Error> {
    let unsupported = |field: &str| {
        let message = format!("`options` uses {field}, which this version does not know");
        Err(Error::new(ErrorKind::Unsupported, message).with_hint("set it to 0"))
    };
    if options.flags & !(PTL_COMPUTE_SEED | PTL_COMPUTE_KEEP_GOING) != 0 {
        return unsupported("a bit of `flags`");
    }
    if options.region.iter().any(|number| *number != 0.0) {
        return unsupported("`region`");
    }
    if options.reserved0 != 0 || !options.reserved1.is_null() {
        return unsupported("a reserved field");
    }
    Ok(())
}

fn size_of_result(options: &ptl_compute_options) -> Result<Option<(u32, u32)>, Error> {
    match (options.width, options.height) {
        (0, 0) => Ok(None),
        (0, _) | (_, 0) => {
            let message = format!(
                "`options` has size {} x {}; give both, or 0 for both",
                options.width, options.height
            );
            Err(Error::new(ErrorKind::InvalidArgument, message))
        }
        size => Ok(Some(size)),
    }
}

/// The format of a PTL_FORMAT_... number; `None` for PTL_FORMAT_AUTO.
pub(super) fn format_of(number: ptl_format) -> Result<Option<Format>, Error> {
    if number == PTL_FORMAT_AUTO {
        return Ok(None);
    }
    match Format::ALL.into_iter().find(|format| *format as u32 == number) {
        Some(format) => Ok(Some(format)),
        None => {
            let message = format!("`format` {number:#x} is none of PTL_FORMAT_...");
            Err(Error::new(ErrorKind::InvalidArgument, message))
        }
    }
}

impl Request {
    /// One output of a block.
    pub(super) fn new(
        graph: &GraphObject,
        block: ptl_block,
        output: u32,
        options: &ptl_compute_options,
    ) -> Result<Self, Error> {
        if block == 0 {
            let message = "`block` is 0, which is no block";
            return Err(Error::new(ErrorKind::StaleHandle, message)
                .with_hint("the main result of a graph without a block of type \"end\"?"));
        }
        Ok(Self {
            settings: Settings::of(options)?,
            engine: Arc::clone(&graph.engine),
            graph: graph.snapshot()?,
            block: BlockId::from_raw(block),
            output,
        })
    }

    /// The image.
    pub(super) fn image(
        &self,
        cancel: Option<Cancel>,
        progress: Option<&mut ProgressFn<'_>>,
    ) -> Result<ImageObject, Error> {
        let mut progress = progress.map(|tell| move |report: &ProgressReport| tell(report));
        let progress = progress.as_mut().map(|tell| tell as &mut ProgressFn<'_>);
        let options = self.settings.to_options(cancel, progress);
        let image = self.engine.engine.compute(&self.graph, self.block, self.output, options)?;
        let format = match self.settings.format {
            Some(format) => format,
            None => self.automatic(image.planes())?,
        };
        ImageObject::new(image, format)
    }

    /// The value, whatever its kind.
    pub(super) fn value(&self) -> Result<Value, Error> {
        let mut tell = self.settings.callback.map(teller);
        let tell = tell.as_mut().map(|tell| tell as &mut ProgressFn<'_>);
        let options = self.settings.to_options(self.settings.cancel.clone(), tell);
        self.engine.engine.compute_value(&self.graph, self.block, self.output, options)
    }

    /// PTL_FORMAT_AUTO for an output of that many planes.
    fn automatic(&self, planes: usize) -> Result<Format, Error> {
        let spec = self.graph.known(self.block)?;
        let is_free = spec.about.outputs.get(self.output as usize).is_none_or(|port| port.is_free);
        let precision = self.settings.precision.unwrap_or(self.graph.settings().precision);
        Ok(match (planes, precision == Precision::EightBit && !is_free) {
            (1, true) => Format::Grey8,
            (3, true) => Format::Rgb8,
            (_, true) => Format::Rgba8,
            (1, false) => Format::GreyF32,
            (3, false) => Format::RgbF32,
            (_, false) => Format::RgbaF32,
        })
    }

    /// The size of the result, and the format of its pixels.
    fn shape(&self) -> Result<(OutputShape, Format), Error> {
        let asked = self.settings.to_options(None, None);
        let shape =
            self.engine.engine.output_shape(&self.graph, self.block, self.output, &asked)?;
        let format = match self.settings.format {
            Some(format) => format,
            None => self.automatic(shape.planes)?,
        };
        Ok((shape, format))
    }

    /// Hands the result over band by band.
    fn deliver(&self, rows: u32, to: BandCallback) -> Result<(), Error> {
        let (_, format) = self.shape()?;
        let mut tell = self.settings.callback.map(teller);
        let tell = tell.as_mut().map(|tell| tell as &mut ProgressFn<'_>);
        let options = self.settings.to_options(self.settings.cancel.clone(), tell);
        let mut deliver = |band: &Band<'_>| to.call(band);
        let bands = Bands { format, rows, deliver: &mut deliver };
        self.engine.engine.compute_bands(&self.graph, self.block, self.output, options, bands)
    }

    fn write_into(&self, pixels: &mut [u8], stride: usize) -> Result<(), Error> {
        let (shape, format) = self.shape()?;
        let stride = match stride {
            0 => shape.width as usize * format.bytes_per_pixel(),
            stride => stride,
        };
        let mut tell = self.settings.callback.map(teller);
        let tell = tell.as_mut().map(|tell| tell as &mut ProgressFn<'_>);
        let options = self.settings.to_options(self.settings.cancel.clone(), tell);
        let target = PixelsMut { format, pixels, stride };
        self.engine.engine.compute_into(&self.graph, self.block, self.output, options, target)
    }
}

fn teller(callback: Callback) -> impl FnMut(&ProgressReport) -> bool + Send {
    move |report| callback.call(report)
}

/// Makes all fields 0, which means "as the graph and the engine say", and sets `struct_size`. Call
/// it as PTL_COMPUTE_OPTIONS_INIT(&options), which gives the size that your program was built
/// with.
///
/// Threads: any.
/// Since:   0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn ptl_compute_options_init(
    options: *mut ptl_compute_options,
    struct_size: usize,
) {
    pt_fn!(else (); options: Uninitialised = (options, struct_size) => options.init());
}

/// Computes one output of a block and returns a new image. The graph is copied first (that costs
/// nothing): later changes do not affect this call. `options` may be NULL.
///
/// Ownership: `out` receives one reference; release it with ptl_image_release(). Nothing of
///            `options` is kept.
/// Threads:   any; several computations of one graph may run at once. Callbacks run on the calling
///            thread only.
/// Cancel:    ptl_cancel_request() or a nonzero result of the callback; returns PTL_E_CANCELLED,
///            normally within milliseconds.
/// Errors:    PTL_E_INVALID_ARGUMENT, PTL_E_STALE_HANDLE, PTL_E_NOT_FOUND, PTL_E_UNCONNECTED,
///            PTL_E_TYPE_MISMATCH, PTL_E_OUT_OF_RANGE, PTL_E_LIMIT, PTL_E_NO_MEMORY, PTL_E_DENIED,
///            PTL_E_IO, PTL_E_UNSUPPORTED, PTL_E_CANCELLED, PTL_E_INTERNAL. On error `*out` is
///            NULL.
/// Since:     0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn ptl_graph_compute(
    graph: *const ptl_graph,
    block: ptl_block,
    out_port: u32,
    options: *const ptl_compute_options,
    out: *mut *mut ptl_image,
    error: *mut *mut ptl_error,
) -> ptl_status {
    pt_fn!(error; graph: Handle<ptl_graph>, options: In<ptl_compute_options>,
        out: NewHandle<ptl_image> => {
        let request = Request::new(&graph, block, out_port, &options.0)?;
        let mut tell = request.settings.callback.map(teller);
        let tell = tell.as_mut().map(|tell| tell as &mut ProgressFn<'_>);
        let image = request.image(request.settings.cancel.clone(), tell)?;
        out.set(tagged::<ptl_image>(image));
        Ok(())
    })
}

/// Computes one output of a block into pixels of the caller: `size` bytes, rows of `row_stride`
/// bytes (0: rows without gaps). Of ptl_graph_compute() it differs in that and in needing less
/// memory.
///
/// Ownership: the pixels stay the caller's. Nothing of `options` is kept.
/// Threads:   any; several computations of one graph may run at once. Callbacks run on the calling
///            thread only.
/// Cancel:    as ptl_graph_compute().
/// Errors:    as ptl_graph_compute(), and PTL_E_BUFFER_TOO_SMALL. After an error that comes before
///            anything is computed the pixels are untouched, after others partly written; bytes
///            between rows are never written.
/// Since:     0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn ptl_graph_compute_into(
    graph: *const ptl_graph,
    block: ptl_block,
    out_port: u32,
    options: *const ptl_compute_options,
    pixels: *mut c_void,
    size: usize,
    row_stride: usize,
    error: *mut *mut ptl_error,
) -> ptl_status {
    pt_fn!(error; graph: Handle<ptl_graph>, options: In<ptl_compute_options>,
        pixels: &mut [u8] = (pixels, size) => {
        Request::new(&graph, block, out_port, &options.0)?.write_into(pixels, row_stride)
    })
}

/// Computes one output of a block and hands it to `on_band` in bands of `band_rows` rows (0: as
/// many as serve well; the last band may have fewer), from the top to the bottom. The result is
/// never in memory as a whole, so it may be larger than that: an image of 16384 x 16384 passes
/// through some 10 MiB, unless its blocks have to keep whole images. `options` may be NULL.
///
/// Ownership: pixels are valid during the call of `on_band`. Nothing of `options` is kept.
/// Threads:   any; several computations of one graph may run at once. Callbacks run on the calling
///            thread only.
/// Cancel:    as ptl_graph_compute(), and a nonzero result of `on_band`.
/// Errors:    as ptl_graph_compute(). Bands may have been handed over before; with
///            PTL_COMPUTE_KEEP_GOING, a white image stands for a block from the band on in which it
///            fails.
/// Since:     0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn ptl_graph_compute_bands(
    graph: *const ptl_graph,
    block: ptl_block,
    out_port: u32,
    options: *const ptl_compute_options,
    band_rows: u32,
    on_band: ptl_band_fn,
    user_data: *mut c_void,
    error: *mut *mut ptl_error,
) -> ptl_status {
    pt_fn!(error; graph: Handle<ptl_graph>, options: In<ptl_compute_options> => {
        let Some(function) = on_band else {
            return Err(Error::new(ErrorKind::InvalidArgument, "`on_band` is NULL"));
        };
        let to = BandCallback { function, user_data };
        Request::new(&graph, block, out_port, &options.0)?.deliver(band_rows, to)
    })
}

/// Computes the graph and lets its blocks of type "save file" write their pictures, below the
/// `write_folders` of the engine's options. Nothing happens in a graph without such blocks.
/// `options` may be NULL; its format does not count.
///
/// Ownership: nothing of `options` is kept.
/// Threads:   any. Callbacks run on the calling thread only.
/// Cancel:    as ptl_graph_compute(). Nothing is written before everything is computed.
/// Errors:    as ptl_graph_compute(), PTL_E_DENIED before anything is computed if a file may not
///            be written.
/// Since:     0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn ptl_graph_write_files(
    graph: *const ptl_graph,
    options: *const ptl_compute_options,
    error: *mut *mut ptl_error,
) -> ptl_status {
    pt_fn!(error; graph: Handle<ptl_graph>, options: In<ptl_compute_options> => {
        let settings = Settings::of(&options.0)?;
        let snapshot = graph.snapshot()?;
        if snapshot.writers().next().is_none() {
            return Ok(());
        }
        let mut tell = settings.callback.map(teller);
        let tell = tell.as_mut().map(|tell| tell as &mut ProgressFn<'_>);
        let options = settings.to_options(settings.cancel.clone(), tell);
        graph.engine.engine.compute_all(&snapshot, options).map(drop)
    })
}
