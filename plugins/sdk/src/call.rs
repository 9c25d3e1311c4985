//! One computation of a block: its inputs and outputs.

use ptlib_plugin_abi::{services::ptlp_values, values::PTL_KIND_IMAGE, *};

use crate::{
    BlockError, Gradient, GradientStop, Image, ImageMut, Mesh, NewMesh, NewPoints, NewStrands,
    Parts, Points, StrandPoints, Strands, Triangles, Work, job::Job, make::Open, wire,
};

/// One call of [`Block::compute`](crate::Block::compute).
#[derive(Debug)]
pub struct Call<'a> {
    job: Job<'a>,
    open: &'a Open,
    inputs: &'a [*const ptlp_wire],
    outputs: &'a [*const ptlp_wire],
}

// SAFETY: wires and what they lead to are only read, but outputs, which `output` hands out to the
// only owner of a `&mut Call`.
unsafe impl Sync for Call<'_> {}

impl<'a> Call<'a> {
    /// # Safety
    /// The contract, for as long as `'a`.
    pub(crate) unsafe fn new(
        (job, open): (Job<'a>, &'a Open),
        inputs: &'a [*const ptlp_wire],
        outputs: &'a [*const ptlp_wire],
    ) -> Self {
        Self { job, open, inputs, outputs }
    }

    fn input(&self, input: usize) -> Option<&'a ptlp_wire> {
        // SAFETY: the contract: there is a wire at each input.
        self.inputs.get(input).and_then(|wire| unsafe { wire.as_ref() })
    }

    /// Whether an input is connected.
    #[must_use]
    pub fn is_connected(&self, input: usize) -> bool {
        self.input(input).is_some_and(wire::is_connected)
    }

    /// The image at an input: the part that belongs to the output, or the whole.
    ///
    /// # Errors
    /// [`BlockError::unconnected`] if there is none.
    #[inline]
    pub fn image(&self, input: usize) -> Result<Image<'a>, BlockError> {
        self.optional_image(input).ok_or_else(|| unconnected("an image", input))
    }

    /// The image at an input, if one is connected.
    #[inline]
    #[must_use]
    pub fn optional_image(&self, input: usize) -> Option<Image<'a>> {
        self.input(input).and_then(wire::image)
    }

    /// The text at an input.
    ///
    /// # Errors
    /// [`BlockError::unconnected`] if there is none.
    pub fn text(&self, input: usize) -> Result<&'a str, BlockError> {
        self.optional_text(input).ok_or_else(|| unconnected("a text", input))
    }

    /// The text at an input, if connected.
    #[must_use]
    pub fn optional_text(&self, input: usize) -> Option<&'a str> {
        self.input(input).and_then(wire::text)
    }

    /// The colour transition at an input.
    ///
    /// # Errors
    /// [`BlockError::unconnected`] if there is none.
    pub fn gradient(&self, input: usize) -> Result<Gradient<'a>, BlockError> {
        self.optional_gradient(input).ok_or_else(|| unconnected("a colour transition", input))
    }

    /// The colour transition at an input, if connected.
    #[must_use]
    pub fn optional_gradient(&self, input: usize) -> Option<Gradient<'a>> {
        self.input(input).and_then(wire::gradient)
    }

    /// The mesh at an input.
    ///
    /// # Errors
    /// [`BlockError::unconnected`] if there is none.
    pub fn mesh(&self, input: usize) -> Result<Mesh<'a>, BlockError> {
        self.optional_mesh(input).ok_or_else(|| unconnected("a mesh", input))
    }

    /// The mesh at an input, if connected.
    #[must_use]
    pub fn optional_mesh(&self, input: usize) -> Option<Mesh<'a>> {
        self.input(input).and_then(wire::mesh)
    }

    /// The points at an input.
    ///
    /// # Errors
    /// [`BlockError::unconnected`] if there are none.
    pub fn points(&self, input: usize) -> Result<Points<'a>, BlockError> {
        self.optional_points(input).ok_or_else(|| unconnected("points", input))
    }

    /// The points at an input, if connected.
    #[must_use]
    pub fn optional_points(&self, input: usize) -> Option<Points<'a>> {
        self.input(input).and_then(wire::points)
    }

    /// The strands at an input.
    ///
    /// # Errors
    /// [`BlockError::unconnected`] if there are none.
    pub fn strands(&self, input: usize) -> Result<Strands<'a>, BlockError> {
        self.optional_strands(input).ok_or_else(|| unconnected("strands", input))
    }

    /// The strands at an input, if connected.
    #[must_use]
    pub fn optional_strands(&self, input: usize) -> Option<Strands<'a>> {
        self.input(input).and_then(wire::strands)
    }

    /// The image to write at an output.
    ///
    /// # Errors
    /// If the output is no image.
    #[inline]
    pub fn output(&mut self, output: usize) -> Result<ImageMut<'_>, BlockError> {
        // SAFETY: the contract: there is a wire at each output.
        let wire = self.outputs.get(output).and_then(|wire| unsafe { wire.as_ref() });
        let wire = wire.filter(|wire| wire.kind == PTL_KIND_IMAGE);
        // SAFETY: the contract: the value of an image's wire is a tile that lives as long.
        let tile = wire.and_then(|wire| unsafe { wire.value.cast::<ptlp_tile>().as_ref() });
        let tile = tile.ok_or_else(|| format!("output {output} is no image"))?;
        // SAFETY: as above; `self` is borrowed, so nobody else has an image of this output.
        Ok(unsafe { ImageMut::new(tile) })
    }

    /// Begins points for an output: their number, and their streams ([`Parts`]), such as
    /// `(POSITION, NORMAL)`. Only in blocks of shape Whole, as everything that is no image.
    ///
    /// # Errors
    /// What the host says: more than it allows, an output of another kind.
    pub fn new_points<P: Parts>(
        &self,
        output: u32,
        count: usize,
        streams: P,
    ) -> Result<NewPoints<'a, P>, BlockError> {
        NewPoints::begin((self.job, self.open), output, count, streams)
    }

    /// Begins a mesh for an output: the number of its vertices, its triangles, and the streams of
    /// the vertices.
    ///
    /// # Errors
    /// As [`new_points`](Self::new_points).
    pub fn new_mesh<P: Parts>(
        &self,
        output: u32,
        vertices: usize,
        triangles: Triangles<'_>,
        streams: P,
    ) -> Result<NewMesh<'a, P>, BlockError> {
        NewMesh::begin((self.job, self.open), output, vertices, triangles, streams)
    }

    /// Begins strands for an output: how many points each has, and the streams of the points and of
    /// the strands.
    ///
    /// # Errors
    /// As [`new_points`](Self::new_points).
    pub fn new_strands<P: Parts, S: Parts>(
        &self,
        output: u32,
        points: StrandPoints<'_>,
        point_streams: P,
        strand_streams: S,
    ) -> Result<NewStrands<'a, P, S>, BlockError> {
        let parts = (point_streams, strand_streams);
        NewStrands::begin((self.job, self.open), output, points, parts)
    }

    /// Gives an output a text.
    ///
    /// # Errors
    /// What the host says: longer than it allows, an output of another kind.
    pub fn give_text(&self, output: u32, text: &str) -> Result<(), BlockError> {
        self.give(output, |values| {
            let give = values.text?;
            // SAFETY: the contract.
            Some(unsafe { give(self.job.as_ptr(), output, text.as_ptr().cast(), text.len()) })
        })
    }

    /// Gives an output a colour transition.
    ///
    /// # Errors
    /// What the host says: a number that is not in 0..1, an output of another kind.
    pub fn give_gradient(&self, output: u32, stops: &[GradientStop]) -> Result<(), BlockError> {
        let count = u32::try_from(stops.len()).map_err(|_| BlockError::limit("too many stops"))?;
        let first = if count == 0 { std::ptr::null() } else { stops.as_ptr() };
        self.give(output, |values| {
            let give = values.gradient?;
            // SAFETY: the contract.
            Some(unsafe { give(self.job.as_ptr(), output, first, count) })
        })
    }

    /// Gives an output the value of an input of the same kind, without a copy. (Not an image.)
    ///
    /// # Errors
    /// What the host says: nothing is there, or it is of another kind.
    pub fn pass(&self, output: u32, input: u32) -> Result<(), BlockError> {
        self.give(output, |values| {
            let pass = values.pass?;
            // SAFETY: the contract.
            Some(unsafe { pass(self.job.as_ptr(), output, input) })
        })
    }

    fn give(
        &self,
        output: u32,
        give: impl FnOnce(&ptlp_values) -> Option<ptlp_status>,
    ) -> Result<(), BlockError> {
        self.open.check(output)?;
        match give(Job::values()?) {
            Some(PTLP_OK) => Ok(()),
            Some(status) => Err(BlockError::of(status)),
            None => Err(BlockError::from("the host makes no such values")),
        }
    }

    /// Both at once: an output to write while the call is asked for progress and threads.
    ///
    /// # Errors
    /// As [`output`](Self::output).
    pub fn output_and_work(
        &mut self,
        output: usize,
    ) -> Result<(ImageMut<'_>, Work<'a>), BlockError> {
        let work = Work { job: self.job };
        Ok((self.output(output)?, work))
    }

    /// What may be asked while an output is written.
    #[must_use]
    pub fn work(&self) -> Work<'a> {
        Work { job: self.job }
    }
}

fn unconnected(what: &str, input: usize) -> BlockError {
    BlockError::unconnected(format!("needs {what} at input {input}"))
}
