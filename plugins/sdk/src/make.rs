//! Meshes, points and strands that a block makes.
//!
//! Their memory is the host's from the start: zeros, which the block writes through slices, on as
//! many threads as it likes. [`finish`](NewPoints::finish) hands them over, and the host checks
//! them. One that is dropped before is gone.

use std::{
    ops::Range,
    ptr,
    sync::{Mutex, PoisonError},
};

use ptlib_plugin_abi::{values::*, *};

use crate::{
    BlockError, Mesh, Parts, Split, Strands, Work, job::Job, parts::Made, private::count,
    wire::slice,
};

/// Elements of one task: enough to make starting it cheap, few enough for all threads to have some.
const ELEMENTS_OF_A_TASK: usize = 4096;

/// The outputs that somebody writes.
#[derive(Debug, Default)]
pub(crate) struct Open(Mutex<Vec<u32>>);

impl Open {
    fn change<R>(&self, change: impl FnOnce(&mut Vec<u32>) -> R) -> R {
        change(&mut self.0.lock().unwrap_or_else(PoisonError::into_inner))
    }

    /// That nobody writes an output: what is begun there would be gone.
    pub(crate) fn check(&self, output: u32) -> Result<(), BlockError> {
        if self.change(|outputs| outputs.contains(&output)) {
            let message = format!("output {output} is begun already, and not finished");
            return Err(BlockError::invalid(message));
        }
        Ok(())
    }
}

/// Whoever may write an output.
#[derive(Debug)]
pub(crate) struct Token<'a> {
    job: Job<'a>,
    open: &'a Open,
    output: u32,
}

impl<'a> Token<'a> {
    /// Begins an output with a function of the host.
    pub(crate) fn begin(
        (job, open): (Job<'a>, &'a Open),
        output: u32,
        begin: impl FnOnce(*const ptlp_job) -> ptlp_status,
    ) -> Result<Self, BlockError> {
        open.check(output)?;
        match begin(job.as_ptr()) {
            PTLP_OK => {
                open.change(|outputs| outputs.push(output));
                Ok(Self { job, open, output })
            }
            status => Err(BlockError::of(status)),
        }
    }

    fn finish(self) -> Result<(), BlockError> {
        let finish = Job::values()?.finish.ok_or_else(missing)?;
        // SAFETY: the contract.
        match unsafe { finish(self.job.as_ptr(), self.output) } {
            PTLP_OK => Ok(()),
            status => Err(BlockError::of(status)),
        }
    }
}

impl Drop for Token<'_> {
    fn drop(&mut self) {
        self.open.change(|outputs| outputs.retain(|output| *output != self.output));
    }
}

/// What is said of a host without a function.
fn missing() -> BlockError {
    BlockError::from("the host makes no such values")
}

/// The number of elements as the contract has it.
fn number(elements: usize, what: &str) -> Result<u32, BlockError> {
    u32::try_from(elements)
        .map_err(|_| BlockError::limit(format!("makes {elements} {what}, allowed {}", u32::MAX)))
}

/// The streams that parts ask for, and the pointers to them.
fn plan(parts: &impl Parts) -> Vec<ptl_stream> {
    let mut streams = Vec::new();
    parts.plan(&mut streams);
    streams
}

/// Where a list of pointers starts; NULL for an empty one.
fn list(pointers: &[*const ptl_stream]) -> *const *const ptl_stream {
    if pointers.is_empty() { ptr::null() } else { pointers.as_ptr() }
}

fn pointers(streams: &[ptl_stream]) -> Vec<*const ptl_stream> {
    streams.iter().map(ptr::from_ref).collect()
}

/// The streams that the host made, with constants written.
///
/// # Safety
/// The contract: `streams` is what the host made of these parts.
unsafe fn made(
    parts: &impl Parts,
    streams: *const *const ptl_stream,
    stream_count: usize,
    elements: usize,
) -> Vec<Made> {
    // SAFETY: as many pointers as were given.
    let streams: &[&ptl_stream] = unsafe { slice(streams.cast(), stream_count) };
    // SAFETY: the caller's promise.
    let made: Vec<_> =
        streams.iter().map(|stream| unsafe { Made::new(stream, elements) }).collect();
    // SAFETY: nobody has a slice of them yet.
    drop(unsafe { parts.take(&mut made.iter()) });
    made
}

/// Slices of `elements` together, cut into pieces for tasks: the first element of each.
fn pieces<S: Split>(mut slices: S, elements: usize) -> Vec<(usize, S)> {
    let mut pieces = Vec::with_capacity(elements.div_ceil(ELEMENTS_OF_A_TASK));
    let mut first = 0;
    while first < elements {
        let (piece, others) = slices.split(ELEMENTS_OF_A_TASK.min(elements - first));
        pieces.push((first, piece));
        slices = others;
        first += ELEMENTS_OF_A_TASK;
    }
    pieces
}

/// Points that a block makes: [`Call::new_points`](crate::Call::new_points).
#[derive(Debug)]
#[must_use = "points that are not finished are gone"]
pub struct NewPoints<'a, P> {
    token: Token<'a>,
    parts: P,
    count: usize,
    made: Vec<Made>,
}

impl<'a, P: Parts> NewPoints<'a, P> {
    pub(crate) fn begin(
        call: (Job<'a>, &'a Open),
        output: u32,
        points: usize,
        parts: P,
    ) -> Result<Self, BlockError> {
        let begin = Job::values()?.points_begin.ok_or_else(missing)?;
        let streams = plan(&parts);
        let pointers = pointers(&streams);
        let mut data = ptl_points_data {
            struct_size: count(size_of::<ptl_points_data>()),
            flags: 0,
            point_count: number(points, "points")?,
            stream_count: count(streams.len()),
            streams: list(&pointers),
            bounds_min: [0.0; 3],
            bounds_max: [0.0; 3],
        };
        // SAFETY: the contract; the lists live until the call returns.
        let token = Token::begin(call, output, |job| unsafe { begin(job, output, &raw mut data) })?;
        // SAFETY: what the host made of them.
        let made = unsafe { made(&parts, data.streams, streams.len(), points) };
        Ok(Self { token, parts, count: points, made })
    }

    /// The slices to write, zeros at first.
    pub fn streams(&mut self) -> P::Out<'_> {
        // SAFETY: `self` is borrowed, and the only way to them.
        unsafe { self.parts.take(&mut self.made.iter()) }
    }

    /// Lets `task` write the points in pieces, on all threads: it gets the number of the first
    /// point of a piece, and the slices from there on.
    ///
    /// # Errors
    /// That of the first piece that has one.
    pub fn fill<'b>(
        &'b mut self,
        task: impl Fn(usize, P::Out<'b>) -> Result<(), BlockError> + Sync,
    ) -> Result<(), BlockError> {
        let (work, count) = (Work { job: self.token.job }, self.count);
        let pieces = pieces(self.streams(), count);
        work.for_each(pieces, |(first, slices)| task(first, slices))
    }

    /// Hands the points over.
    ///
    /// # Errors
    /// What the host finds wrong with them, such as a number that is not finite.
    pub fn finish(self) -> Result<(), BlockError> {
        self.token.finish()
    }
}

/// The triangles of a new mesh.
#[derive(Debug, Clone, Copy)]
pub enum Triangles<'a> {
    /// So many, to be written.
    New(usize),
    /// Those of an input, shared.
    Of(Mesh<'a>),
}

/// A mesh that a block makes: [`Call::new_mesh`](crate::Call::new_mesh).
#[derive(Debug)]
#[must_use = "a mesh that is not finished is gone"]
pub struct NewMesh<'a, P> {
    vertices: NewPoints<'a, P>,
    triangles: Made,
}

impl<'a, P: Parts> NewMesh<'a, P> {
    pub(crate) fn begin(
        call: (Job<'a>, &'a Open),
        output: u32,
        vertices: usize,
        triangles: Triangles<'_>,
        parts: P,
    ) -> Result<Self, BlockError> {
        let begin = Job::values()?.mesh_begin.ok_or_else(missing)?;
        let streams = plan(&parts);
        let pointers = pointers(&streams);
        let (indices, shared, new) = match triangles {
            Triangles::New(new) => (number(new.saturating_mul(3), "indices")?, ptr::null(), new),
            Triangles::Of(mesh) => (mesh.0.index_count, mesh.0.indices, 0),
        };
        let mut data = ptl_mesh_data {
            struct_size: count(size_of::<ptl_mesh_data>()),
            flags: 0,
            vertex_count: number(vertices, "vertices")?,
            index_count: indices,
            indices: shared,
            streams: list(&pointers),
            stream_count: count(streams.len()),
            reserved0: 0,
            bounds_min: [0.0; 3],
            bounds_max: [0.0; 3],
        };
        // SAFETY: the contract; the lists live until the call returns.
        let token = Token::begin(call, output, |job| unsafe { begin(job, output, &raw mut data) })?;
        // SAFETY: what the host made of them.
        let made = unsafe { made(&parts, data.streams, streams.len(), vertices) };
        // SAFETY: as many triangles, which nobody else writes; none, if they are shared.
        let triangles = unsafe { Made::of(data.indices.cast_mut(), new) };
        Ok(Self { vertices: NewPoints { token, parts, count: vertices, made }, triangles })
    }

    /// The slices of the vertices to write, zeros at first.
    pub fn streams(&mut self) -> P::Out<'_> {
        self.vertices.streams()
    }

    /// The numbers of the three vertices of each triangle, to write; empty if they are shared.
    pub fn triangles(&mut self) -> &mut [[u32; 3]] {
        // SAFETY: `self` is borrowed, and the only way to them.
        unsafe { self.triangles.slice(1) }
    }

    /// Lets `task` write the vertices in pieces, as [`NewPoints::fill`].
    ///
    /// # Errors
    /// That of the first piece that has one.
    pub fn fill<'b>(
        &'b mut self,
        task: impl Fn(usize, P::Out<'b>) -> Result<(), BlockError> + Sync,
    ) -> Result<(), BlockError> {
        self.vertices.fill(task)
    }

    /// Hands the mesh over.
    ///
    /// # Errors
    /// What the host finds wrong with it, such as an index that leads to no vertex.
    pub fn finish(self) -> Result<(), BlockError> {
        self.vertices.finish()
    }
}

/// How many points each of the new strands has.
#[derive(Debug, Clone, Copy)]
pub enum StrandPoints<'s> {
    /// So many strands, and points of each of them: at least 2.
    Each(usize, usize),
    /// One number for each strand, at least 2.
    Counts(&'s [u32]),
    /// As the strands of an input.
    Of(Strands<'s>),
}

impl StrandPoints<'_> {
    /// The first point of each strand, and the number of all points.
    fn first_points(self) -> Result<Vec<u32>, BlockError> {
        let mut first = vec![0];
        let mut sum = 0_u32;
        let too_many = || BlockError::limit("makes more points of strands than can be counted");
        let mut add = |points: u32| {
            sum = sum.checked_add(points).ok_or_else(too_many)?;
            first.push(sum);
            Ok::<(), BlockError>(())
        };
        match self {
            Self::Each(strands, points) => {
                let step = number(points, "points of a strand")?;
                let all = strands.checked_mul(points).ok_or_else(too_many)?;
                number(all.max(strands), "points of strands")?;
                first.extend((0..strands).scan(0, |sum: &mut u32, _| {
                    *sum += step;
                    Some(*sum)
                }));
            }
            Self::Counts(counts) => counts.iter().try_for_each(|points| add(*points))?,
            Self::Of(strands) => {
                first = strands.first_points().to_vec();
                first.resize(strands.count() + 1, 0);
            }
        }
        Ok(first)
    }
}

/// Strands that a block makes: [`Call::new_strands`](crate::Call::new_strands).
#[derive(Debug)]
#[must_use = "strands that are not finished are gone"]
pub struct NewStrands<'a, P, S> {
    token: Token<'a>,
    parts: (P, S),
    first_points: Vec<u32>,
    made: [Vec<Made>; 2],
}

/// Some of the strands, which one task writes.
#[derive(Debug, Clone, Copy)]
pub struct Piece<'s> {
    /// The number of the first of them.
    pub first: usize,
    first_points: &'s [u32],
}

impl Piece<'_> {
    /// How many strands.
    #[must_use]
    pub fn count(&self) -> usize {
        self.first_points.len() - 1
    }

    /// Where the points of a strand of the piece are in its slices.
    ///
    /// # Panics
    /// If the piece has no such strand.
    #[inline]
    #[must_use]
    pub fn points(&self, strand: usize) -> Range<usize> {
        let start = self.first_points[0];
        let place = |strand: usize| (self.first_points[strand] - start) as usize;
        place(strand)..place(strand + 1)
    }
}

impl<'a, P: Parts, S: Parts> NewStrands<'a, P, S> {
    pub(crate) fn begin(
        call: (Job<'a>, &'a Open),
        output: u32,
        points: StrandPoints<'_>,
        parts: (P, S),
    ) -> Result<Self, BlockError> {
        let begin = Job::values()?.strands_begin.ok_or_else(missing)?;
        let first_points = points.first_points()?;
        let strands = first_points.len() - 1;
        let point_count = first_points[strands];
        let planned = [plan(&parts.0), plan(&parts.1)];
        let lists = planned.each_ref().map(|streams| pointers(streams));
        let mut data = ptl_strands_data {
            struct_size: count(size_of::<ptl_strands_data>()),
            flags: 0,
            strand_count: number(strands, "strands")?,
            point_count,
            first_point: ptr::null(),
            point_streams: list(&lists[0]),
            strand_streams: list(&lists[1]),
            point_stream_count: count(planned[0].len()),
            strand_stream_count: count(planned[1].len()),
            bounds_min: [0.0; 3],
            bounds_max: [0.0; 3],
        };
        // SAFETY: the contract; the lists live until the call returns.
        let token = Token::begin(call, output, |job| unsafe { begin(job, output, &raw mut data) })?;
        // SAFETY: what the host made: one entry more than strands, and the streams.
        let made = unsafe {
            let first = Made::of(data.first_point.cast_mut(), first_points.len());
            first.slice(1).copy_from_slice(&first_points);
            [
                made(&parts.0, data.point_streams, planned[0].len(), point_count as usize),
                made(&parts.1, data.strand_streams, planned[1].len(), strands),
            ]
        };
        Ok(Self { token, parts, first_points, made })
    }

    /// The slices of the points and of the strands to write, zeros at first.
    pub fn streams(&mut self) -> (P::Out<'_>, S::Out<'_>) {
        let [points, strands] = &self.made;
        // SAFETY: `self` is borrowed, and the only way to them.
        unsafe { (self.parts.0.take(&mut points.iter()), self.parts.1.take(&mut strands.iter())) }
    }

    /// Lets `task` write the strands in pieces, on all threads: it gets a piece, and the slices of
    /// its points and strands.
    ///
    /// # Errors
    /// That of the first piece that has one.
    pub fn fill<'b>(
        &'b mut self,
        task: impl Fn(Piece<'b>, P::Out<'b>, S::Out<'b>) -> Result<(), BlockError> + Sync,
    ) -> Result<(), BlockError> {
        let work = Work { job: self.token.job };
        let [made_points, made_strands] = &self.made;
        // SAFETY: `self` is borrowed for as long as the slices live, and the only way to them.
        let (mut points, strands) = unsafe {
            let points = self.parts.0.take(&mut made_points.iter());
            (points, self.parts.1.take(&mut made_strands.iter()))
        };
        let mut tasks = Vec::new();
        for (first, of_strands) in pieces(strands, self.first_points.len() - 1) {
            let last = (first + ELEMENTS_OF_A_TASK).min(self.first_points.len() - 1);
            let piece = Piece { first, first_points: &self.first_points[first..=last] };
            let (of_points, others) = points.split(piece.points(piece.count() - 1).end);
            points = others;
            tasks.push((piece, of_points, of_strands));
        }
        work.for_each(tasks, |(piece, points, strands)| task(piece, points, strands))
    }

    /// Hands the strands over.
    ///
    /// # Errors
    /// What the host finds wrong with them, such as a strand of one point.
    pub fn finish(self) -> Result<(), BlockError> {
        self.token.finish()
    }
}
