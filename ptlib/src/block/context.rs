//! What a block may know and ask of the engine while it computes.

use std::sync::Arc;

use crate::{
    error::{Error, ErrorKind},
    limits::Limits,
    math::simd::SimdLevel,
    value::{BufferPool, Gradient, Image, Mesh, Points, Strands, Value},
};

/// Where a row (or a part of one) lies.
#[derive(Clone, Copy)]
pub struct RowContext<'a> {
    /// Column of the first pixel.
    pub x: u32,
    /// Row.
    pub y: u32,
    /// Width of the whole image in pixels, supersampling included.
    pub width: u32,
    /// Height of the whole image in pixels, supersampling included.
    pub height: u32,
    pub(crate) progress: &'a dyn Progress,
}

impl RowContext<'_> {
    /// Whether the computation is asked to stop: then nobody looks at what is written any more. The
    /// engine asks before each row; only rows that may take more than a millisecond need to.
    #[must_use]
    pub fn is_stopped(&self) -> bool {
        self.progress.check().is_err()
    }
}

/// The files that a block's path parameters name, as the caller's file policy lets them be read.
pub trait Files: Send + Sync {
    /// The bytes of the file that a path parameter names.
    ///
    /// # Errors
    /// [`ErrorKind::Denied`], [`ErrorKind::Io`] or [`ErrorKind::Limit`].
    fn read(&self, path: &str) -> Result<Arc<[u8]>, Error>;

    /// The picture of the file that a path parameter names, without alpha, values k/255 (or
    /// k/65535 of a file with 16 bits, any finite numbers of one with floating-point pixels).
    ///
    /// # Errors
    /// As [`read`](Self::read), and [`ErrorKind::Parse`] if it is no picture.
    fn read_image(&self, path: &str, pool: &Arc<BufferPool>) -> Result<Image, Error>;

    /// Writes a whole file below a folder that the caller opened for writing.
    ///
    /// # Errors
    /// [`ErrorKind::Denied`] or [`ErrorKind::Io`].
    fn write(&self, path: &str, bytes: &[u8]) -> Result<(), Error>;
}

/// Tells the caller how far a computation is, and whether to go on.
pub trait Progress: Send + Sync {
    /// Goes on, or fails with [`ErrorKind::Cancelled`]. Cheap: call it at least once per
    /// millisecond of work.
    ///
    /// # Errors
    /// [`ErrorKind::Cancelled`].
    fn check(&self) -> Result<(), Error>;

    /// Runs `task` for 0..`count` on the threads of the computation, in any order, and waits for
    /// all of them. After an error no further task starts; of several errors, that of the lowest
    /// task is returned.
    ///
    /// # Errors
    /// What a task returns, or [`ErrorKind::Cancelled`].
    fn parallel(
        &self,
        count: usize,
        task: &(dyn Fn(usize) -> Result<(), Error> + Sync),
    ) -> Result<(), Error>;

    /// How many threads [`parallel`](Self::parallel) runs tasks on, for those who cut work into as
    /// many tasks. No result may depend on it.
    fn threads(&self) -> usize {
        1
    }

    /// Tells that `fraction` (0..1) of the block's work is done. Only for blocks of shape Whole.
    fn report(&self, fraction: f64);
}

/// How much a message matters. The numbers are those of the C ABI.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum LogLevel {
    /// For people who look for a fault of the engine.
    Debug = 1,
    /// Worth knowing.
    Info = 2,
    /// Somebody should look at it: a result is not what the graph's author meant.
    Warning = 3,
    /// Something failed that no caller waits for.
    Error = 4,
}

/// The planes of a block's inputs and outputs.
#[derive(Debug, Clone, Copy)]
pub(crate) struct PlaneCounts<'a> {
    /// For each input; 0 if it is not connected or no image.
    pub(crate) inputs: &'a [usize],
    /// For each output; 0 if it is no image.
    pub(crate) outputs: &'a [usize],
}

/// What every block may know and ask.
#[derive(Clone, Copy)]
pub struct Context<'a> {
    /// Width of the image to make in pixels, supersampling included.
    pub width: u32,
    /// Height of the image to make in pixels, supersampling included.
    pub height: u32,
    /// The seed of the block.
    pub seed: u64,
    /// The SIMD level to run kernels at.
    pub simd: SimdLevel,
    pub(crate) inputs: &'a [Option<Value>],
    /// For each input, whether it is there: as a value above, or as rows.
    pub(crate) connected: &'a [bool],
    /// What the caller of the graph set, if the block is an input of the graph.
    pub(crate) given: Option<&'a Value>,
    pub(crate) pool: &'a Arc<BufferPool>,
    pub(crate) files: &'a dyn Files,
    pub(crate) progress: &'a dyn Progress,
    pub(crate) limits: &'a Limits,
    pub(crate) planes: PlaneCounts<'a>,
    pub(crate) tell: &'a (dyn Fn(LogLevel, Error) + Sync),
}

/// What a block of shape Point or Gather prepares itself from.
pub type PrepareContext<'a> = Context<'a>;

/// What a block of shape Whole computes from.
pub type WholeContext<'a> = Context<'a>;

impl<'a> Context<'a> {
    /// The seed as the 32-bit number that the blocks of PT Designer draw from.
    #[must_use]
    pub fn seed32(&self) -> i32 {
        crate::math::convert::low_bits(self.seed)
    }

    /// The place of row `y` of the image to make, for code that writes rows.
    #[must_use]
    pub fn row(&self, y: u32) -> RowContext<'a> {
        RowContext { x: 0, y, width: self.width, height: self.height, progress: self.progress }
    }

    /// Whether input `port` is connected, also one that only comes row by row.
    #[must_use]
    pub fn is_connected(&self, port: usize) -> bool {
        self.connected.get(port).is_some_and(|is_connected| *is_connected)
    }

    /// The whole image at input `port`.
    ///
    /// # Errors
    /// [`ErrorKind::Unconnected`] if there is none.
    pub fn image(&self, port: usize) -> Result<&'a Image, Error> {
        match self.inputs.get(port) {
            Some(Some(Value::Image(image))) => Ok(image),
            _ => Err(self.missing(port, "an image")),
        }
    }

    /// The gradient at input `port`.
    ///
    /// # Errors
    /// [`ErrorKind::Unconnected`] if there is none.
    pub fn gradient(&self, port: usize) -> Result<&'a Gradient, Error> {
        match self.inputs.get(port) {
            Some(Some(Value::Gradient(gradient))) => Ok(gradient),
            _ => Err(self.missing(port, "a gradient")),
        }
    }

    /// The text at input `port`.
    ///
    /// # Errors
    /// [`ErrorKind::Unconnected`] if there is none.
    pub fn text(&self, port: usize) -> Result<&'a str, Error> {
        match self.inputs.get(port) {
            Some(Some(Value::Text(text))) => Ok(text),
            _ => Err(self.missing(port, "a text")),
        }
    }

    /// The points at input `port`.
    ///
    /// # Errors
    /// [`ErrorKind::Unconnected`] if there are none.
    pub fn points(&self, port: usize) -> Result<&'a Points, Error> {
        match self.inputs.get(port) {
            Some(Some(Value::Points(points))) => Ok(points),
            _ => Err(self.missing(port, "points")),
        }
    }

    /// The mesh at input `port`.
    ///
    /// # Errors
    /// [`ErrorKind::Unconnected`] if there is none.
    pub fn mesh(&self, port: usize) -> Result<&'a Mesh, Error> {
        match self.inputs.get(port) {
            Some(Some(Value::Mesh(mesh))) => Ok(mesh),
            _ => Err(self.missing(port, "a mesh")),
        }
    }

    /// The strands at input `port`.
    ///
    /// # Errors
    /// [`ErrorKind::Unconnected`] if there are none.
    pub fn strands(&self, port: usize) -> Result<&'a Strands, Error> {
        match self.inputs.get(port) {
            Some(Some(Value::Strands(strands))) => Ok(strands),
            _ => Err(self.missing(port, "strands")),
        }
    }

    /// The value that the caller of the graph set, for a block of role
    /// [`Input`](super::Role::Input).
    #[must_use]
    pub fn given(&self) -> Option<&'a Value> {
        self.given
    }

    /// The value that the caller of the graph set, otherwise that at input `port`.
    ///
    /// # Errors
    /// [`ErrorKind::Unconnected`] if there is neither.
    pub fn given_or(&self, port: usize) -> Result<&'a Value, Error> {
        let connected = || self.inputs.get(port)?.as_ref();
        self.given.or_else(connected).ok_or_else(|| self.missing(port, "a value"))
    }

    fn missing(&self, port: usize, what: &str) -> Error {
        Error::new(ErrorKind::Unconnected, format!("needs {what} at input {port}"))
    }

    /// A new image of the size to make, with **unspecified contents**.
    ///
    /// # Errors
    /// [`ErrorKind::NoMemory`].
    pub fn new_image(&self, planes: usize) -> Result<Image, Error> {
        Image::new(self.pool, self.width, self.height, planes)
    }

    /// A new image of any size, with **unspecified contents**. Announce its memory: see
    /// [`WholeBlock::scratch_bytes`](super::WholeBlock::scratch_bytes).
    ///
    /// # Errors
    /// [`ErrorKind::NoMemory`].
    pub fn new_image_sized(&self, width: u32, height: u32, planes: usize) -> Result<Image, Error> {
        Image::new(self.pool, width, height, planes)
    }

    /// The bytes of the file that a path parameter names.
    ///
    /// # Errors
    /// [`ErrorKind::Denied`], [`ErrorKind::Io`] or [`ErrorKind::Limit`].
    pub fn read_file(&self, path: &str) -> Result<Arc<[u8]>, Error> {
        self.files.read(path)
    }

    /// The picture of the file that a path parameter names: see [`Files::read_image`].
    ///
    /// # Errors
    /// As [`read_file`](Self::read_file), and [`ErrorKind::Parse`] if it is no picture.
    pub fn read_image(&self, path: &str) -> Result<Image, Error> {
        self.files.read_image(path, self.pool)
    }

    /// How many symbols the text of an L-system may have. Everything whose time or memory depends
    /// on such a text is bounded by a multiple of it.
    #[must_use]
    pub fn max_text_symbols(&self) -> u64 {
        u64::from(self.limits.text_symbols)
    }

    /// Tells the user that something is not as its author meant it, though the block goes on. The
    /// engine adds which block it is. For few messages: whoever reads a file of a stranger counts
    /// them.
    pub fn warn(&self, what: Error) {
        (self.tell)(LogLevel::Warning, what);
    }

    /// Goes on, or fails with [`ErrorKind::Cancelled`]: see [`Progress::check`].
    ///
    /// # Errors
    /// [`ErrorKind::Cancelled`].
    pub fn check(&self) -> Result<(), Error> {
        self.progress.check()
    }

    /// Tells that `fraction` (0..1) of the work of a block of shape Whole is done.
    pub fn report(&self, fraction: f64) {
        self.progress.report(fraction);
    }

    /// Runs `task` for 0..`count` on all threads: see [`Progress::parallel`].
    ///
    /// # Errors
    /// What a task returns, or [`ErrorKind::Cancelled`].
    pub fn parallel(
        &self,
        count: usize,
        task: impl Fn(usize) -> Result<(), Error> + Sync,
    ) -> Result<(), Error> {
        self.progress.parallel(count, &task)
    }

    /// Splits `data` into pieces of `piece` values (the last may be shorter) and runs `task` for
    /// each on all threads, with the piece's number.
    ///
    /// # Errors
    /// What a task returns, or [`ErrorKind::Cancelled`].
    pub fn parallel_pieces<T: Send>(
        &self,
        data: &mut [T],
        piece: usize,
        task: impl Fn(usize, &mut [T]) -> Result<(), Error> + Sync,
    ) -> Result<(), Error> {
        let pieces: Vec<_> = data.chunks_mut(piece.max(1)).map(std::sync::Mutex::new).collect();
        self.parallel(pieces.len(), |i| {
            // Each number is run once, so the lock is free; it only proves that to the compiler.
            let mut piece = pieces[i].lock().unwrap_or_else(std::sync::PoisonError::into_inner);
            task(i, &mut piece)
        })
    }
}
