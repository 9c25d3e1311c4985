//! Points.

use std::sync::OnceLock;

use super::{Bounds, ContentHash, Stream, Words, check, content::Content};
use crate::{error::Error, limits::Limits};

/// Points, each with as much data as there are streams: instances, roots of hairs.
///
/// Points that exist keep these rules: they have a stream `position`; every number is finite and
/// in the range that its stream asks for; normals and directions have length 1.
#[derive(Debug)]
pub struct Points {
    count: u32,
    streams: Vec<Stream>,
    bounds: Bounds,
    /// Taken when somebody asks: most values are never compared.
    content: OnceLock<ContentHash>,
}

impl Points {
    /// Points, checked. Streams that break a rule which can be repaired are copied and repaired,
    /// the others are used where they are.
    ///
    /// # Errors
    /// As [`Mesh::new`](super::Mesh::new). A normal without a direction is an error.
    pub fn new(count: u32, mut streams: Vec<Stream>, limits: &Limits) -> Result<Self, Error> {
        Self::check_counts(count, streams.len(), limits)?;
        check::list(&streams, count)?;
        check::numbers(&mut streams, None)?;
        let bounds = check::bounds(&streams, count)?;
        Ok(Self { count, streams, bounds, content: OnceLock::new() })
    }

    /// Whether there may be so many.
    ///
    /// # Errors
    /// [`ErrorKind::Limit`](crate::ErrorKind::Limit).
    pub fn check_counts(points: u32, streams: usize, limits: &Limits) -> Result<(), Error> {
        check::stream_count(streams, limits)?;
        check::count("points", points.into(), limits.points)
    }

    /// How many points.
    #[must_use]
    pub fn count(&self) -> u32 {
        self.count
    }

    /// Their data.
    #[must_use]
    pub fn streams(&self) -> &[Stream] {
        &self.streams
    }

    /// The stream of that id.
    #[must_use]
    pub fn stream(&self, id: &str) -> Option<&Stream> {
        self.streams.iter().find(|stream| stream.id() == id)
    }

    /// The smallest and the largest coordinates.
    #[must_use]
    pub fn bounds(&self) -> Bounds {
        self.bounds
    }

    /// The hash of the content. The first call takes it, which needs a look at everything.
    #[must_use]
    pub fn content(&self) -> &ContentHash {
        self.content.get_or_init(|| {
            let mut content = Content::new("points");
            content.number(u64::from(self.count));
            content.streams(&self.streams);
            content.finish()
        })
    }

    /// All memory of the points.
    pub(super) fn memory(&self) -> impl Iterator<Item = &Words> {
        self.streams.iter().map(Stream::data)
    }
}

#[cfg(test)]
mod tests {
    use super::{super::StreamShape, *};
    use crate::error::ErrorKind;

    fn stream(shape: StreamShape, numbers: &[f32]) -> Stream {
        let words = Words::copy_of(bytemuck::cast_slice(numbers)).unwrap();
        Stream::packed(shape, words).unwrap()
    }

    #[test]
    fn a_normal_without_direction_is_an_error() {
        let position = stream(StreamShape::floats("position", 3), &[0.0; 6]);
        let normals = |numbers: &[f32]| {
            let normal = stream(StreamShape::floats("normal", 3), numbers);
            Points::new(2, vec![position.clone(), normal], &Limits::default())
        };
        let points = normals(&[2.0, 0.0, 0.0, 0.0, 0.0, -0.1]).unwrap();
        let found = points.stream("normal").unwrap().floats();
        assert_eq!((found.at(0), found.at(1)), (&[1.0, 0.0, 0.0][..], &[0.0, 0.0, -1.0][..]));
        let error = normals(&[2.0, 0.0, 0.0, 0.0, 0.0, 0.0]).unwrap_err();
        assert_eq!(error.kind(), ErrorKind::OutOfRange);
        assert!(error.message().contains("element 1 of 2 is 0"), "{error}");
    }

    #[test]
    fn a_constant_position_is_the_bounds() {
        let position = stream(StreamShape::floats("position", 3).constant(), &[1.0, 2.0, 3.0]);
        let points = Points::new(1000, vec![position], &Limits::default()).unwrap();
        assert_eq!(points.bounds(), Bounds { min: [1.0, 2.0, 3.0], max: [1.0, 2.0, 3.0] });
        let limits = Limits { points: 999, ..Limits::default() };
        assert!(Points::new(1000, points.streams().to_vec(), &limits).is_err());
    }
}
