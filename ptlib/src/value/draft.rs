//! A mesh, points or strands while somebody writes them.
//!
//! The memory is ours from the start, so that what a plug-in makes is never copied, and a plug-in
//! that fails has nothing to free. Parts that are as in another value are shared with it.

use std::sync::Arc;

use super::{
    BufferPool, Kind, Mesh, Points, StrandParts, Strands, Stream, StreamShape, Value, Words,
    WordsMut, words::check_bytes,
};
use crate::{
    error::{Error, ErrorKind},
    limits::Limits,
};

/// A stream to be written, or one that exists already.
#[derive(Debug, Clone)]
pub enum StreamPlan {
    /// New memory, zeros at first.
    New(StreamShape),
    /// A stream of another value, shared: as many of its first elements as are needed.
    Shared(Stream),
}

/// Whole numbers to be written, or some that exist already.
#[derive(Debug, Clone)]
pub enum WordsPlan {
    /// So many new ones, zeros at first.
    New(u32),
    /// Those of another value, shared.
    Shared(Words),
}

/// How much memory a draft may take, and where it comes from.
#[derive(Debug, Clone, Copy)]
pub struct MemorySource<'a> {
    limits: &'a Limits,
    pool: Option<&'a Arc<BufferPool>>,
}

impl<'a> From<&'a Limits> for MemorySource<'a> {
    fn from(limits: &'a Limits) -> Self {
        Self { limits, pool: None }
    }
}

impl<'a> From<(&'a Limits, &'a Arc<BufferPool>)> for MemorySource<'a> {
    fn from((limits, pool): (&'a Limits, &'a Arc<BufferPool>)) -> Self {
        Self { limits, pool: Some(pool) }
    }
}

impl MemorySource<'_> {
    fn words(self, len: usize) -> Result<WordsMut, Error> {
        match self.pool {
            Some(pool) => WordsMut::of_pool(len, pool),
            None => WordsMut::zeroed(len),
        }
    }
}

/// A mesh, points or strands while somebody writes them.
#[derive(Debug)]
pub struct Draft {
    kind: Kind,
    /// Elements of `streams`: vertices or points.
    count: u32,
    /// Indices of a mesh, first points of strands.
    numbers: Part<Words>,
    streams: Vec<Part<Stream>>,
    strand_streams: Vec<Part<Stream>>,
}

#[derive(Debug)]
enum Part<T> {
    New(WordsMut, Option<StreamShape>),
    Shared(T),
}

impl Draft {
    /// A mesh of so many vertices.
    ///
    /// # Errors
    /// [`ErrorKind::Limit`] before anything is allocated, [`ErrorKind::InvalidArgument`],
    /// [`ErrorKind::NoMemory`].
    pub fn mesh<'a>(
        vertex_count: u32,
        indices: WordsPlan,
        streams: Vec<StreamPlan>,
        means: impl Into<MemorySource<'a>>,
    ) -> Result<Self, Error> {
        let means = means.into();
        Mesh::check_counts(vertex_count, indices.len(), streams.len(), means.limits)?;
        let lists = [(vertex_count, streams), (0, vec![])];
        Self::allocate(Kind::Mesh, indices, lists, means)
    }

    /// So many points.
    ///
    /// # Errors
    /// As [`mesh`](Self::mesh).
    pub fn points<'a>(
        count: u32,
        streams: Vec<StreamPlan>,
        means: impl Into<MemorySource<'a>>,
    ) -> Result<Self, Error> {
        let means = means.into();
        Points::check_counts(count, streams.len(), means.limits)?;
        Self::allocate(Kind::Points, WordsPlan::New(0), [(count, streams), (0, vec![])], means)
    }

    /// Strands of so many points together; `first_point` has one entry more than strands.
    ///
    /// # Errors
    /// As [`mesh`](Self::mesh).
    pub fn strands<'a>(
        point_count: u32,
        first_point: WordsPlan,
        point_streams: Vec<StreamPlan>,
        strand_streams: Vec<StreamPlan>,
        means: impl Into<MemorySource<'a>>,
    ) -> Result<Self, Error> {
        let means = means.into();
        let streams = point_streams.len() + strand_streams.len();
        let strand_count = u32::try_from(first_point.len().saturating_sub(1)).unwrap_or(u32::MAX);
        Strands::check_counts(strand_count, point_count, streams, means.limits)?;
        let lists = [(point_count, point_streams), (strand_count, strand_streams)];
        Self::allocate(Kind::Strands, first_point, lists, means)
    }

    fn allocate(
        kind: Kind,
        numbers: WordsPlan,
        lists: [(u32, Vec<StreamPlan>); 2],
        means: MemorySource<'_>,
    ) -> Result<Self, Error> {
        let mut words = match &numbers {
            WordsPlan::New(count) => u64::from(*count),
            WordsPlan::Shared(_) => 0,
        };
        for (count, streams) in &lists {
            for stream in streams {
                if let StreamPlan::New(shape) = stream {
                    shape.check()?;
                    words = words.saturating_add(shape.packed_words(*count) as u64);
                }
            }
        }
        check_bytes(words.saturating_mul(size_of::<u32>() as u64), means.limits)?;
        let numbers = match numbers {
            WordsPlan::New(count) => Part::New(means.words(count as usize)?, None),
            WordsPlan::Shared(words) => Part::Shared(words),
        };
        let count = lists[0].0;
        let [streams, strand_streams] = lists.map(|(count, streams)| parts(count, streams, means));
        Ok(Self { kind, count, numbers, streams: streams?, strand_streams: strand_streams? })
    }

    /// What is made.
    #[must_use]
    pub fn kind(&self) -> Kind {
        self.kind
    }

    /// The indices of a mesh or the first points of strands, to write; `None` if they are shared,
    /// and for points.
    pub fn numbers_mut(&mut self) -> Option<&mut [u32]> {
        if self.kind == Kind::Points { None } else { self.numbers.words_mut() }
    }

    /// The elements of a stream of vertices or points, without gaps, to write; `None` if the
    /// stream is shared or does not exist.
    pub fn stream_mut(&mut self, place: usize) -> Option<&mut [u32]> {
        self.streams.get_mut(place)?.words_mut()
    }

    /// The same for a stream of strands.
    pub fn strand_stream_mut(&mut self, place: usize) -> Option<&mut [u32]> {
        self.strand_streams.get_mut(place)?.words_mut()
    }

    /// The value, checked. It never changes from now on.
    ///
    /// # Errors
    /// As [`Mesh::new`].
    pub fn finish(self, limits: &Limits) -> Result<Value, Error> {
        let numbers = match self.numbers {
            Part::New(words, _) => words.freeze(),
            Part::Shared(words) => words,
        };
        let streams = frozen(self.streams)?;
        let value = match self.kind {
            Kind::Mesh => Value::Mesh(Arc::new(Mesh::new(self.count, numbers, streams, limits)?)),
            Kind::Points => Value::Points(Arc::new(Points::new(self.count, streams, limits)?)),
            Kind::Strands => {
                let parts = StrandParts {
                    point_count: self.count,
                    first_point: numbers,
                    point_streams: streams,
                    strand_streams: frozen(self.strand_streams)?,
                };
                Value::Strands(Arc::new(Strands::new(parts, limits)?))
            }
            Kind::Image | Kind::Gradient | Kind::Text => {
                return Err(Error::new(ErrorKind::Internal, "a draft has streams"));
            }
        };
        Ok(value)
    }
}

impl WordsPlan {
    fn len(&self) -> usize {
        match self {
            Self::New(count) => *count as usize,
            Self::Shared(words) => words.len(),
        }
    }
}

impl<T> Part<T> {
    fn words_mut(&mut self) -> Option<&mut [u32]> {
        match self {
            Self::New(words, _) => Some(words.words_mut()),
            Self::Shared(_) => None,
        }
    }
}

fn parts(
    count: u32,
    streams: Vec<StreamPlan>,
    means: MemorySource<'_>,
) -> Result<Vec<Part<Stream>>, Error> {
    let part = |stream| match stream {
        StreamPlan::New(shape) => {
            Ok(Part::New(means.words(shape.packed_words(count))?, Some(shape)))
        }
        StreamPlan::Shared(stream) => Ok(Part::Shared(stream.beginning(count))),
    };
    streams.into_iter().map(part).collect()
}

fn frozen(parts: Vec<Part<Stream>>) -> Result<Vec<Stream>, Error> {
    let stream = |part| match part {
        Part::New(words, Some(shape)) => Stream::packed(shape, words.freeze()),
        Part::Shared(stream) => Ok(stream),
        Part::New(_, None) => Err(Error::new(ErrorKind::Internal, "a stream without a shape")),
    };
    parts.into_iter().map(stream).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn limits() -> Limits {
        Limits::default()
    }

    #[test]
    fn a_mesh_is_written_and_frozen_in_place() {
        let plan = vec![
            StreamPlan::New(StreamShape::floats("position", 3)),
            StreamPlan::New(StreamShape::floats("radius", 1).constant()),
        ];
        let mut draft = Draft::mesh(3, WordsPlan::New(3), plan, &limits()).unwrap();
        draft.numbers_mut().unwrap().copy_from_slice(&[2, 1, 0]);
        let positions = draft.stream_mut(0).unwrap();
        assert_eq!(positions, [0; 9]);
        positions[8] = 5.0_f32.to_bits();
        let address = positions.as_ptr();
        assert_eq!(draft.stream_mut(1).unwrap().len(), 1);
        assert!(draft.stream_mut(2).is_none() && draft.strand_stream_mut(0).is_none());
        let Value::Mesh(mesh) = draft.finish(&limits()).unwrap() else { panic!("a mesh") };
        assert_eq!(mesh.streams()[0].data().as_ptr(), address);
        assert_eq!((mesh.bounds().max, &mesh.indices()[..]), ([0.0, 0.0, 5.0], &[2, 1, 0][..]));
    }

    #[test]
    fn what_is_shared_is_not_copied() {
        let plan = vec![StreamPlan::New(StreamShape::floats("position", 3))];
        let draft = Draft::points(2, plan, &limits()).unwrap();
        let Value::Points(points) = draft.finish(&limits()).unwrap() else { panic!("points") };
        let position = points.streams()[0].clone();
        let plan = vec![
            StreamPlan::Shared(position.clone()),
            StreamPlan::New(StreamShape::floats("random", 1)),
        ];
        let mut draft = Draft::points(2, plan.clone(), &limits()).unwrap();
        assert!(draft.stream_mut(0).is_none() && draft.stream_mut(1).is_some());
        let Value::Points(more) = draft.finish(&limits()).unwrap() else { panic!("points") };
        assert_eq!(more.streams()[0].data().as_ptr(), position.data().as_ptr());
        let wrong = Draft::points(3, plan, &limits()).unwrap().finish(&limits()).unwrap_err();
        assert!(wrong.message().contains("2 elements, 3 are needed"), "{wrong}");
    }

    #[test]
    fn the_beginning_of_a_stream_is_shared_too() {
        let plan = vec![StreamPlan::New(StreamShape::floats("position", 3))];
        let mut draft = Draft::points(3, plan, &limits()).unwrap();
        draft.stream_mut(0).unwrap().copy_from_slice(&[1, 2, 3, 4, 5, 6, 7, 8, 9].map(|n| {
            let number: u16 = n;
            f32::from(number).to_bits()
        }));
        let Value::Points(points) = draft.finish(&limits()).unwrap() else { panic!("points") };
        let plan = vec![StreamPlan::Shared(points.streams()[0].clone())];
        let draft = Draft::points(2, plan, &limits()).unwrap();
        let Value::Points(fewer) = draft.finish(&limits()).unwrap() else { panic!("points") };
        assert_eq!(fewer.streams()[0].data().as_ptr(), points.streams()[0].data().as_ptr());
        assert_eq!((fewer.count(), fewer.bounds().max), (2, [4.0, 5.0, 6.0]));
        assert_ne!(fewer.content(), points.content());
        let copied = Stream::packed(
            StreamShape::floats("position", 3),
            Words::copy_of(&points.streams()[0].data()[..6]).unwrap(),
        );
        let copied = Points::new(2, vec![copied.unwrap()], &limits()).unwrap();
        assert_eq!(fewer.content(), copied.content());
    }

    #[test]
    fn a_draft_of_strands_is_checked_when_it_is_finished() {
        let plan = vec![StreamPlan::New(StreamShape::floats("position", 3))];
        let strand = vec![StreamPlan::New(StreamShape::floats("radius", 1))];
        let draft = |first_point| {
            Draft::strands(4, first_point, plan.clone(), strand.clone(), &limits()).unwrap()
        };
        let first_point = Words::copy_of(&[0, 2, 4]).unwrap();
        let mut good = draft(WordsPlan::Shared(first_point));
        assert_eq!(good.strand_stream_mut(0).unwrap().len(), 2);
        assert_eq!(good.finish(&limits()).unwrap().kind(), Kind::Strands);
        let error = draft(WordsPlan::New(3)).finish(&limits()).unwrap_err();
        assert!(error.message().contains("end at 0, allowed 4"), "{error}");
    }

    #[test]
    fn nothing_over_the_limits_is_allocated() {
        let plan = || vec![StreamPlan::New(StreamShape::floats("position", 3))];
        let limits = Limits { memory_bytes: 1 << 20, ..limits() };
        let error = Draft::points(1 << 20, plan(), &limits).unwrap_err();
        assert_eq!(error.to_string(), "the value takes 12 MiB, allowed 1 MiB");
        let error = Draft::mesh(u32::MAX, WordsPlan::New(0), plan(), &limits).unwrap_err();
        assert_eq!(error.kind(), ErrorKind::Limit);
    }
}
