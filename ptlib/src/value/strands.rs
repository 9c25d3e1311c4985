//! Strands: polylines.

use std::sync::OnceLock;

use super::{Bounds, ContentHash, Stream, Words, check, content::Content};
use crate::{
    error::{Error, ErrorKind},
    limits::Limits,
};

/// Polylines such as hairs: strand `i` has the points from `first_point[i]` to before
/// `first_point[i + 1]`, at least two.
///
/// Strands that exist keep these rules: their points have a stream `position`; every number is
/// finite and in the range that its stream asks for; normals and directions have length 1.
#[derive(Debug)]
pub struct Strands {
    point_count: u32,
    first_point: Words,
    point_streams: Vec<Stream>,
    strand_streams: Vec<Stream>,
    bounds: Bounds,
    /// Taken when somebody asks: most values are never compared.
    content: OnceLock<ContentHash>,
}

/// What strands are made from.
#[derive(Debug)]
pub struct StrandParts {
    /// Points of all strands together.
    pub point_count: u32,
    /// One entry more than strands; none or one for no strands.
    pub first_point: Words,
    /// The data of the points.
    pub point_streams: Vec<Stream>,
    /// The data of the strands.
    pub strand_streams: Vec<Stream>,
}

impl Strands {
    /// Strands, checked. Streams that break a rule which can be repaired are copied and repaired,
    /// the others are used where they are.
    ///
    /// # Errors
    /// As [`Mesh::new`](super::Mesh::new). A normal without a direction is an error.
    pub fn new(parts: StrandParts, limits: &Limits) -> Result<Self, Error> {
        let StrandParts { point_count, mut first_point, mut point_streams, mut strand_streams } =
            parts;
        if first_point.is_empty() {
            first_point = Words::copy_of(&[0])?;
        }
        let strand_count = u32::try_from(first_point.len() - 1).unwrap_or(u32::MAX);
        let streams = point_streams.len() + strand_streams.len();
        Self::check_counts(strand_count, point_count, streams, limits)?;
        check_first_points(&first_point, point_count)?;
        check::list(&point_streams, point_count)?;
        check::list(&strand_streams, strand_count)?;
        check::numbers(&mut point_streams, None)?;
        check::numbers(&mut strand_streams, None)?;
        let bounds = check::bounds(&point_streams, point_count)?;
        let content = OnceLock::new();
        Ok(Self { point_count, first_point, point_streams, strand_streams, bounds, content })
    }

    /// Whether there may be so many.
    ///
    /// # Errors
    /// [`ErrorKind::Limit`].
    pub fn check_counts(
        strands: u32,
        points: u32,
        streams: usize,
        limits: &Limits,
    ) -> Result<(), Error> {
        check::stream_count(streams, limits)?;
        check::count("strands", strands.into(), limits.strands)?;
        check::count("points of strands", points.into(), limits.strand_points)
    }

    /// How many strands.
    #[must_use]
    pub fn count(&self) -> u32 {
        u32::try_from(self.first_point.len() - 1).unwrap_or(u32::MAX)
    }

    /// Points of all strands together.
    #[must_use]
    pub fn point_count(&self) -> u32 {
        self.point_count
    }

    /// The first point of each strand, and the number of points: one entry more than strands.
    #[must_use]
    pub fn first_point(&self) -> &Words {
        &self.first_point
    }

    /// The data of the points.
    #[must_use]
    pub fn point_streams(&self) -> &[Stream] {
        &self.point_streams
    }

    /// The data of the strands.
    #[must_use]
    pub fn strand_streams(&self) -> &[Stream] {
        &self.strand_streams
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
            let mut content = Content::new("strands");
            content.number(u64::from(self.point_count));
            content.words(&self.first_point);
            content.streams(&self.point_streams);
            content.streams(&self.strand_streams);
            content.finish()
        })
    }

    /// All memory of the strands.
    pub(super) fn memory(&self) -> impl Iterator<Item = &Words> {
        let streams = self.point_streams.iter().chain(&self.strand_streams);
        std::iter::once(&self.first_point).chain(streams.map(Stream::data))
    }
}

/// Whether the list starts at 0, gives each strand two points or more, and ends with the points.
fn check_first_points(first_point: &[u32], point_count: u32) -> Result<(), Error> {
    let wrong = |what: String| Err(Error::new(ErrorKind::InvalidArgument, what));
    let (first, last) = (first_point[0], first_point[first_point.len() - 1]);
    if first != 0 {
        return wrong(format!("the first points start at {first}, allowed 0"));
    }
    let pairs = || first_point.windows(2).enumerate();
    // Without an end before the last one, so that many are looked at at a time; who breaks a rule,
    // is only asked if somebody does.
    let (starts, ends) = (&first_point[..first_point.len() - 1], &first_point[1..]);
    let long = |all: bool, (start, end): (&u32, &u32)| all & (*end >= start.saturating_add(2));
    if last == point_count && starts.iter().zip(ends).fold(true, long) {
        return Ok(());
    }
    let falling = pairs().filter(|(_, pair)| pair[1] < pair[0]).map(|(i, pair)| (i + 1, pair[1]));
    let (what, noun, entries) = ("the first points", ("entry", "entries"), first_point.len());
    check::refuse(what, noun, entries, "no less than the entry before", falling)?;
    if last != point_count {
        return wrong(format!("the first points end at {last}, allowed {point_count}"));
    }
    let short = pairs().filter(|(_, pair)| pair[1] - pair[0] < 2);
    let short = short.map(|(i, pair)| (i, format!("{} points long", pair[1] - pair[0])));
    let (noun, strands) = (("strand", "strands"), first_point.len() - 1);
    check::refuse(what, noun, strands, "2 points or more", short)
}

#[cfg(test)]
mod tests {
    use super::{super::StreamShape, *};

    fn strands(first_point: &[u32], point_count: u32) -> Result<Strands, Error> {
        let zeros = Words::copy_of(&vec![0; 3 * point_count as usize]).unwrap();
        let position = Stream::packed(StreamShape::floats("position", 3), zeros).unwrap();
        let parts = StrandParts {
            point_count,
            first_point: Words::copy_of(first_point).unwrap(),
            point_streams: vec![position],
            strand_streams: vec![],
        };
        Strands::new(parts, &Limits::default())
    }

    fn message(first_point: &[u32], point_count: u32) -> String {
        strands(first_point, point_count).unwrap_err().to_string()
    }

    #[test]
    fn every_strand_has_its_points() {
        let made = strands(&[0, 2, 7], 7).unwrap();
        assert_eq!((made.count(), made.point_count()), (2, 7));
        assert_eq!(strands(&[], 0).unwrap().count(), 0);
        assert_eq!(strands(&[0], 0).unwrap().first_point()[..], [0]);
    }

    #[test]
    fn lists_of_first_points_that_make_no_sense_are_refused() {
        assert_eq!(message(&[1, 7], 7), "the first points start at 1, allowed 0");
        assert_eq!(
            message(&[0, 4, 2, 6, 5, 7], 7),
            "the first points: entry 2 of 6 is 2, allowed no less than the entry before; 2 such \
             entries"
        );
        assert_eq!(message(&[0, 6], 7), "the first points end at 6, allowed 7");
        assert_eq!(message(&[0], 7), "the first points end at 0, allowed 7");
        assert_eq!(
            message(&[0, 2, 3, 5, 5, 7], 7),
            "the first points: strand 1 of 5 is 1 points long, allowed 2 points or more; 2 such \
             strands"
        );
    }

    #[test]
    fn counts_have_limits() {
        let limits = Limits { strand_points: 6, strands: 2, streams: 3, ..Limits::default() };
        assert!(Strands::check_counts(2, 6, 3, &limits).is_ok());
        assert!(Strands::check_counts(3, 6, 3, &limits).is_err());
        assert!(Strands::check_counts(2, 7, 3, &limits).is_err());
        assert!(Strands::check_counts(2, 6, 4, &limits).is_err());
    }
}
