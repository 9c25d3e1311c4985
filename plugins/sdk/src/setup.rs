//! What a block prepares itself from.

use ptlib_plugin_abi::*;

use crate::{
    BlockError, Gradient, Image, Mesh, Plain, Points, Scratch, Strands,
    job::Job,
    wire::{self, slice},
};

/// What a block prepares itself from.
#[derive(Debug)]
pub struct Setup<'a> {
    setup: &'a ptlp_setup,
    job: Job<'a>,
}

impl<'a> Setup<'a> {
    /// # Safety
    /// The contract, for as long as `'a`.
    pub(crate) unsafe fn new(setup: *const ptlp_setup, job: Job<'a>) -> Self {
        // SAFETY: the caller's promise.
        Self { setup: unsafe { &*setup }, job }
    }

    pub(crate) fn values(&self) -> &'a [&'a ptlp_value] {
        // SAFETY: as many pointers to values as the count says.
        unsafe { slice(self.setup.values.cast(), self.setup.value_count as usize) }
    }

    /// Width of the images to make in pixels, supersampling included.
    #[must_use]
    pub fn width(&self) -> u32 {
        self.setup.width
    }

    /// Height of the images to make in pixels, supersampling included.
    #[must_use]
    pub fn height(&self) -> u32 {
        self.setup.height
    }

    /// The seed of the block in its graph.
    #[must_use]
    pub fn seed(&self) -> u64 {
        self.setup.seed
    }

    /// Whether values are stored as multiples of 1/255. The host does that.
    #[must_use]
    pub fn is_eight_bit(&self) -> bool {
        self.setup.precision == PTLP_PRECISION_8BIT
    }

    fn wire(&self, input: usize) -> Option<&'a ptlp_wire> {
        // SAFETY: as many pointers to wires as the count says.
        let wires: &[&ptlp_wire] =
            unsafe { slice(self.setup.inputs.cast(), self.setup.input_count as usize) };
        wires.get(input).copied()
    }

    /// Whether an input is connected.
    #[must_use]
    pub fn is_connected(&self, input: usize) -> bool {
        self.wire(input).is_some_and(wire::is_connected)
    }

    /// The image at an input, if one is connected. It has pixels if it is read anywhere, else only
    /// its channels are known.
    #[must_use]
    pub fn image(&self, input: usize) -> Option<Image<'a>> {
        wire::image(self.wire(input)?)
    }

    /// The text at an input, if one is connected.
    #[must_use]
    pub fn text(&self, input: usize) -> Option<&'a str> {
        wire::text(self.wire(input)?)
    }

    /// The colour transition at an input, if connected.
    #[must_use]
    pub fn gradient(&self, input: usize) -> Option<Gradient<'a>> {
        wire::gradient(self.wire(input)?)
    }

    /// The mesh at an input, if connected.
    #[must_use]
    pub fn mesh(&self, input: usize) -> Option<Mesh<'a>> {
        wire::mesh(self.wire(input)?)
    }

    /// The points at an input, if connected.
    #[must_use]
    pub fn points(&self, input: usize) -> Option<Points<'a>> {
        wire::points(self.wire(input)?)
    }

    /// The strands at an input, if connected.
    #[must_use]
    pub fn strands(&self, input: usize) -> Option<Strands<'a>> {
        wire::strands(self.wire(input)?)
    }

    /// Memory of zeros until `prepare` returns, which counts against the limit of the host.
    ///
    /// # Errors
    /// If there is none, or the limit is reached.
    pub fn scratch<T: Plain>(&self, len: usize) -> Result<Scratch<'a, T>, BlockError> {
        Scratch::new(self.job, len)
    }

    /// The bytes of the file that a path parameter names.
    ///
    /// # Errors
    /// What the host says: the file is not there, or may not be read.
    pub fn read_file(&self, path: &str) -> Result<Vec<u8>, BlockError> {
        self.job.read_file(path)
    }

    /// Tells the user that something is not as its author meant it.
    pub fn warn(&self, message: &str) {
        self.job.warn(message);
    }

    /// Goes on, or fails because the host asked to stop. Call it every millisecond of work.
    ///
    /// # Errors
    /// [`BlockError::cancelled`].
    pub fn check(&self) -> Result<(), BlockError> {
        if self.job.is_cancelled() { Err(BlockError::cancelled()) } else { Ok(()) }
    }
}
