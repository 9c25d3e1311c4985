//! Meshes, points, strands and colour transitions at inputs.

use std::{ffi::CStr, ops::Range};

use ptlib_plugin_abi::values::*;

use crate::{
    AnyStream, BlockError, Element, Stream, StreamId,
    stream::{NORMAL, POSITION, TEXCOORD},
    wire::slice,
};

/// A colour at a position, 0 to 1, of a colour transition.
pub use ptlib_plugin_abi::values::ptl_gradient_stop as GradientStop;

/// The streams of one list, with their number of elements.
#[derive(Debug, Clone, Copy)]
pub struct Streams<'a> {
    streams: &'a [&'a ptl_stream],
    len: usize,
}

// SAFETY: the contract: inputs are only read while they live.
unsafe impl Send for Streams<'_> {}
// SAFETY: as above.
unsafe impl Sync for Streams<'_> {}

impl<'a> Streams<'a> {
    /// # Safety
    /// The contract, for as long as `'a`.
    unsafe fn new(streams: *const *const ptl_stream, count: u32, len: u32) -> Self {
        // SAFETY: as many pointers to streams as the count says.
        Self { streams: unsafe { slice(streams.cast(), count as usize) }, len: len as usize }
    }

    /// All of them.
    pub fn iter(&self) -> impl ExactSizeIterator<Item = AnyStream<'a>> + Clone + 'a {
        let len = self.len;
        // SAFETY: the contract.
        self.streams.iter().map(move |stream| unsafe { AnyStream::new(stream, len) })
    }

    /// The one of that id, whatever it holds.
    #[must_use]
    pub fn find(&self, id: &CStr) -> Option<AnyStream<'a>> {
        self.iter().find(|stream| stream.id() == id)
    }

    /// The one of that id, if it holds elements of that type.
    #[must_use]
    pub fn get<T: Element>(&self, id: StreamId<T>) -> Option<Stream<'a, T>> {
        self.find(id.id)?.typed()
    }

    /// The one of that id, which the block cannot do without.
    ///
    /// # Errors
    /// If there is none, or it holds something else.
    pub fn need<T: Element>(&self, id: StreamId<T>) -> Result<Stream<'a, T>, BlockError> {
        self.get(id).ok_or_else(|| {
            let name = id.id.to_string_lossy();
            let numbers = if T::TYPE == PTL_STREAM_F32 { "floats" } else { "whole numbers" };
            let wanted = format!("a stream \"{name}\" of {} {numbers}", T::COMPONENTS);
            BlockError::invalid(match self.find(id.id) {
                Some(other) => format!(
                    "needs {wanted}; that of the input has {} numbers of another type or count",
                    other.components()
                ),
                None => format!("needs {wanted}, which the input does not have"),
            })
        })
    }
}

/// Triangles at an input. The library has checked them: indices lead to vertices, all numbers are
/// finite, normals have length 1.
#[derive(Debug, Clone, Copy)]
pub struct Mesh<'a>(pub(crate) &'a ptl_mesh_data);

// SAFETY: the contract: inputs are only read while they live.
unsafe impl Send for Mesh<'_> {}
// SAFETY: as above.
unsafe impl Sync for Mesh<'_> {}

impl<'a> Mesh<'a> {
    /// How many vertices.
    #[must_use]
    pub fn vertex_count(&self) -> usize {
        self.0.vertex_count as usize
    }

    /// The numbers of the three vertices of each triangle.
    #[must_use]
    pub fn triangles(&self) -> &'a [[u32; 3]] {
        // SAFETY: the contract: as many indices as the count says, a multiple of 3.
        unsafe { slice(self.0.indices.cast(), self.0.index_count as usize / 3) }
    }

    /// The streams of the vertices.
    #[must_use]
    pub fn streams(&self) -> Streams<'a> {
        // SAFETY: the contract.
        unsafe { Streams::new(self.0.streams, self.0.stream_count, self.0.vertex_count) }
    }

    /// Where the vertices are.
    ///
    /// # Errors
    /// If the host breaks the contract: every mesh has positions.
    pub fn positions(&self) -> Result<Stream<'a, [f32; 3]>, BlockError> {
        self.streams().need(POSITION)
    }

    /// The normals of the vertices, of length 1, if it has any.
    #[must_use]
    pub fn normals(&self) -> Option<Stream<'a, [f32; 3]>> {
        self.streams().get(NORMAL)
    }

    /// The texture coordinates of the vertices, if it has any; the second points up.
    #[must_use]
    pub fn texcoords(&self) -> Option<Stream<'a, [f32; 2]>> {
        self.streams().get(TEXCOORD)
    }

    /// The smallest and the largest coordinates.
    #[must_use]
    pub fn bounds(&self) -> [[f32; 3]; 2] {
        [self.0.bounds_min, self.0.bounds_max]
    }
}

/// Points at an input, checked by the library.
#[derive(Debug, Clone, Copy)]
pub struct Points<'a>(pub(crate) &'a ptl_points_data);

// SAFETY: the contract: inputs are only read while they live.
unsafe impl Send for Points<'_> {}
// SAFETY: as above.
unsafe impl Sync for Points<'_> {}

impl<'a> Points<'a> {
    /// How many points.
    #[must_use]
    pub fn count(&self) -> usize {
        self.0.point_count as usize
    }

    /// The streams of the points.
    #[must_use]
    pub fn streams(&self) -> Streams<'a> {
        // SAFETY: the contract.
        unsafe { Streams::new(self.0.streams, self.0.stream_count, self.0.point_count) }
    }

    /// Where the points are.
    ///
    /// # Errors
    /// If the host breaks the contract: all points have positions.
    pub fn positions(&self) -> Result<Stream<'a, [f32; 3]>, BlockError> {
        self.streams().need(POSITION)
    }

    /// The smallest and the largest coordinates.
    #[must_use]
    pub fn bounds(&self) -> [[f32; 3]; 2] {
        [self.0.bounds_min, self.0.bounds_max]
    }
}

/// Polylines at an input, such as hairs, checked by the library.
#[derive(Debug, Clone, Copy)]
pub struct Strands<'a>(pub(crate) &'a ptl_strands_data);

// SAFETY: the contract: inputs are only read while they live.
unsafe impl Send for Strands<'_> {}
// SAFETY: as above.
unsafe impl Sync for Strands<'_> {}

impl<'a> Strands<'a> {
    /// How many strands.
    #[must_use]
    pub fn count(&self) -> usize {
        self.0.strand_count as usize
    }

    /// Points of all strands together.
    #[must_use]
    pub fn point_count(&self) -> usize {
        self.0.point_count as usize
    }

    /// The first point of each strand, and behind the last one the number of points: one entry
    /// more than strands (none if there are none).
    #[must_use]
    pub fn first_points(&self) -> &'a [u32] {
        // SAFETY: the contract: one entry more than strands, or NULL.
        unsafe { slice(self.0.first_point, self.count() + 1) }
    }

    /// The points of a strand, at least two.
    ///
    /// # Panics
    /// If there is no such strand.
    #[inline]
    #[must_use]
    pub fn points(&self, strand: usize) -> Range<usize> {
        let first = self.first_points();
        first[strand] as usize..first[strand + 1] as usize
    }

    /// The streams of the points.
    #[must_use]
    pub fn point_streams(&self) -> Streams<'a> {
        let Self(data) = self;
        // SAFETY: the contract.
        unsafe { Streams::new(data.point_streams, data.point_stream_count, data.point_count) }
    }

    /// The streams of the strands.
    #[must_use]
    pub fn strand_streams(&self) -> Streams<'a> {
        let Self(data) = self;
        // SAFETY: the contract.
        unsafe { Streams::new(data.strand_streams, data.strand_stream_count, data.strand_count) }
    }

    /// Where the points are.
    ///
    /// # Errors
    /// If the host breaks the contract: all points have positions.
    pub fn positions(&self) -> Result<Stream<'a, [f32; 3]>, BlockError> {
        self.point_streams().need(POSITION)
    }

    /// The smallest and the largest coordinates.
    #[must_use]
    pub fn bounds(&self) -> [[f32; 3]; 2] {
        [self.0.bounds_min, self.0.bounds_max]
    }
}

/// A colour transition at an input.
#[derive(Debug, Clone, Copy)]
pub struct Gradient<'a> {
    stops: &'a [GradientStop],
}

/// The colour of a transition without stops: middle grey.
const GREY: f32 = 128.0 / 255.0;

impl<'a> Gradient<'a> {
    /// # Safety
    /// The contract, for as long as `'a`.
    pub(crate) unsafe fn new(data: &'a ptl_gradient_data) -> Self {
        // SAFETY: as many stops as the count says.
        Self { stops: unsafe { slice(data.stops, data.stop_count as usize) } }
    }

    /// The stops, by rising position.
    #[must_use]
    pub fn stops(&self) -> &'a [GradientStop] {
        self.stops
    }

    /// The colour at a position: constant before the first stop and after the last, linear between.
    #[must_use]
    pub fn color_at(&self, position: f32) -> [f32; 3] {
        let after = self.stops.partition_point(|stop| stop.position <= position);
        match (after.checked_sub(1).map(|i| self.stops[i]), self.stops.get(after)) {
            (None, None) => [GREY; 3],
            (Some(stop), None) => stop.color,
            (None, Some(stop)) => stop.color,
            (Some(a), Some(b)) => {
                let t = (position - a.position) / (b.position - a.position);
                std::array::from_fn(|c| a.color[c] * (1.0 - t) + b.color[c] * t)
            }
        }
    }
}
