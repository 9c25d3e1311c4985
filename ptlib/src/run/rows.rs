//! A stage row by row: fused blocks, strip by strip on all threads.
//!
//! A strip is some rows of the image, a task of the pool. Inside it, each row (or, where every
//! block of the stage is a Point, each segment of a row) passes through all blocks of the stage
//! before the next one starts: intermediate rows stay in the nearest cache. Values depend neither
//! on strips nor on segments, because a block sees only positions.

use std::{
    ops::Range,
    sync::{
        Mutex, PoisonError,
        atomic::{AtomicU64, Ordering},
    },
};

use super::{
    execute::{Means, guard},
    plan::Sizes,
    sink::{Sink, SinkStrip},
};
use crate::{
    block::{InputRows, MAX_INPUTS, OutputRow, PortRow, Progress, RowContext, RowKernel, Store},
    error::Error,
    math::simd::{self, SimdLevel},
    value::{Image, Plane, Value},
};

/// Pixels of a segment: with some buffers of this length, a chain of blocks stays in a 32 KiB
/// first-level cache.
const SEGMENT: usize = 1024;

/// How many pixels of a row longer than a segment are fetched before it is written.
const FETCHED: usize = SEGMENT / 4;

/// Pixels of a strip: long enough that starting a task costs nothing, short enough that a request
/// to stop is heard soon and that threads finish together.
const STRIP_PIXELS: u32 = 1 << 16;

/// A block fused into a stage.
pub(super) struct Member {
    pub(super) kernel: Box<dyn RowKernel>,
    pub(super) sources: Vec<RowSource>,
    /// How each plane of its outputs is stored.
    pub(super) stores: Vec<Store>,
    /// Whether it writes whole rows only.
    pub(super) needs_whole_rows: bool,
}

/// Where the row at an input comes from.
pub(super) enum RowSource {
    /// Nowhere, or not as a row.
    None,
    /// Another member of the stage.
    Member { member: usize, first_plane: usize, planes: usize },
    /// A stored image.
    Image(Image),
}

/// An output of the root that goes to a sink.
pub(super) struct Handed {
    /// The sink's place.
    pub(super) place: usize,
    pub(super) first_plane: usize,
    pub(super) planes: usize,
}

/// A stage, ready to run.
pub(super) struct StageRows<'a> {
    /// In topological order, the root last.
    pub(super) members: &'a [Member],
    pub(super) sets: BufferSets,
    /// The stored value that is handed over, in a stage without members.
    pub(super) given: Option<&'a Value>,
    pub(super) handed_over: Vec<Handed>,
    pub(super) sizes: Sizes,
    pub(super) units: u64,
}

/// An error, and the member that made it.
type MemberError = (Option<usize>, Error);

/// The part of the outputs that one strip writes.
struct Strip<'a> {
    first_row: u32,
    rows: u32,
    /// The root's planes, if it is stored.
    stored: Vec<&'a mut [f32]>,
    sinks: Vec<SinkStrip<'a>>,
}

impl StageRows<'_> {
    /// Computes all rows into the root's images `stored` (none if it is not stored) and the sinks.
    /// Returns how many numbers of each member were not finite.
    pub(super) fn run(
        &self,
        means: &Means<'_>,
        stored: &mut [Image],
        sinks: &mut [Sink<'_>],
    ) -> Result<Vec<u64>, MemberError> {
        let strange: Vec<AtomicU64> = self.members.iter().map(|_| AtomicU64::new(0)).collect();
        let buffers: Mutex<Vec<Buffers>> = Mutex::new(Vec::new());
        let (step, height) = (self.sizes.supersampling, self.sizes.result.1);
        let at_once = self.handed_over.iter().filter_map(|to| sinks[to.place].rows_at_once()).min();
        let band = at_once.unwrap_or(height);
        for first in (0..height).step_by(band as usize) {
            let result = first..height.min(first + band);
            let working = result.start * step..result.end * step;
            self.run_range(means, &working, (stored, sinks), (&strange, &buffers))?;
            for handed in &self.handed_over {
                sinks[handed.place].deliver(&result).map_err(|error| (None, error))?;
            }
        }
        Ok(strange.into_iter().map(AtomicU64::into_inner).collect())
    }

    /// Computes the rows `range`.
    fn run_range(
        &self,
        means: &Means<'_>,
        range: &Range<u32>,
        (stored, sinks): (&mut [Image], &mut [Sink<'_>]),
        (strange, buffers): (&[AtomicU64], &Mutex<Vec<Buffers>>),
    ) -> Result<(), MemberError> {
        let (width, height) = self.sizes.working();
        let rows = self.strip_rows(means, range);
        let strips = self.split(range, rows, stored, sinks);
        let culprit: Mutex<Option<(u32, usize)>> = Mutex::new(None);
        let progress: &dyn Progress = means.monitor;
        let done = progress.parallel(strips.len(), &|number| {
            let mut strip = strips[number].lock().unwrap_or_else(PoisonError::into_inner);
            let reused = buffers.lock().unwrap_or_else(PoisonError::into_inner).pop();
            let mut own = match reused {
                Some(own) => own,
                None => Buffers::new(self, means, width)?,
            };
            let mut at = None;
            let result = guard(|| self.run_strip(means, &mut strip, &mut own, &mut at, strange));
            if let Err(error) = result {
                let mut culprit = culprit.lock().unwrap_or_else(PoisonError::into_inner);
                if let Some(member) = at
                    && culprit.is_none_or(|(strip_before, _)| strip.first_row < strip_before)
                {
                    *culprit = Some((strip.first_row, member));
                }
                return Err(error);
            }
            means.monitor.add_units(self.units * u64::from(strip.rows) / u64::from(height));
            buffers.lock().unwrap_or_else(PoisonError::into_inner).push(own);
            Ok(())
        });
        let culprit = culprit.into_inner().unwrap_or_else(PoisonError::into_inner);
        done.map_err(|error| (culprit.map(|(_, member)| member), error))
    }

    /// Rows of a strip: a multiple of the supersampling, so that a result row has one maker.
    fn strip_rows(&self, means: &Means<'_>, range: &Range<u32>) -> u32 {
        let (width, height) = (self.sizes.working().0, range.end - range.start);
        let step = self.sizes.supersampling;
        let wanted = match means.strip_rows {
            0 => {
                let threads = u32::try_from(means.monitor.thread_count()).unwrap_or(u32::MAX);
                (STRIP_PIXELS / width).min(height / threads.saturating_mul(4))
            }
            rows => rows,
        };
        wanted.clamp(1, height).next_multiple_of(step)
    }

    fn split<'a>(
        &self,
        range: &Range<u32>,
        rows: u32,
        stored: &'a mut [Image],
        sinks: &'a mut [Sink<'_>],
    ) -> Vec<Mutex<Strip<'a>>> {
        let width = self.sizes.working().0 as usize;
        let mut strips: Vec<Strip<'a>> = range
            .clone()
            .step_by(rows as usize)
            .map(|first_row| Strip {
                first_row,
                rows: rows.min(range.end - first_row),
                stored: Vec::new(),
                sinks: Vec::new(),
            })
            .collect();
        let piece = width * rows as usize;
        for plane in stored.iter_mut().flat_map(Image::planes_mut) {
            let plane = &mut plane[range.start as usize * width..range.end as usize * width];
            for (strip, part) in strips.iter_mut().zip(plane.chunks_mut(piece)) {
                strip.stored.push(part);
            }
        }
        for (place, sink) in sinks.iter_mut().enumerate() {
            if self.handed_over.iter().any(|handed| handed.place == place) {
                let step = self.sizes.supersampling;
                let parts = sink.split(&(range.start / step..range.end / step), rows / step);
                for (strip, part) in strips.iter_mut().zip(parts) {
                    strip.sinks.push(part);
                }
            }
        }
        strips.into_iter().map(Mutex::new).collect()
    }

    fn run_strip(
        &self,
        means: &Means<'_>,
        strip: &mut Strip<'_>,
        buffers: &mut Buffers,
        at: &mut Option<usize>,
        strange: &[AtomicU64],
    ) -> Result<(), Error> {
        let (width, height) = self.sizes.working();
        for row in 0..strip.rows {
            means.monitor.check()?;
            let y = strip.first_row + row;
            let mut x = 0;
            while x < width {
                let len = buffers.segment.min((width - x) as usize);
                let cx = RowContext { x, y, width, height, progress: means.monitor };
                let segment = Segment { cx, len };
                let offset = row as usize * width as usize + x as usize;
                fetch_next(strip, offset, len);
                for (number, strange) in strange.iter().enumerate() {
                    *at = Some(number);
                    let is_root = number + 1 == self.members.len();
                    let target = (is_root && !strip.stored.is_empty())
                        .then_some((strip.stored.as_mut_slice(), offset));
                    let count = self.run_member(means.simd, number, &segment, buffers, target)?;
                    if count > 0 {
                        strange.fetch_add(count, Ordering::Relaxed);
                    }
                }
                *at = None;
                x += u32::try_from(len).unwrap_or(u32::MAX);
            }
            self.hand_over(means, strip, buffers, row);
        }
        Ok(())
    }

    /// Computes one member on one segment, into its buffers or into the stored planes. Returns how
    /// many numbers were not finite.
    fn run_member(
        &self,
        simd: SimdLevel,
        number: usize,
        segment: &Segment<'_>,
        buffers: &mut Buffers,
        target: Option<(&mut [&mut [f32]], usize)>,
    ) -> Result<u64, Error> {
        let member = &self.members[number];
        let set = self.sets.of_member[number];
        let mut own = std::mem::take(&mut buffers.sets[set]);
        let mut out = match target {
            Some((planes, offset)) => {
                let parts = planes.iter_mut().map(|plane| &mut plane[offset..offset + segment.len]);
                OutputRow::new(parts, &member.stores)
            }
            None => {
                let planes = own.iter_mut().take(member.stores.len());
                let parts = planes.map(|plane| &mut plane.data_mut()[..segment.len]);
                OutputRow::new(parts, &member.stores)
            }
        };
        // Most blocks have few inputs, and room for many costs time in each segment.
        let written = if member.sources.len() <= FEW_PORTS {
            self.write::<FEW_PORTS>(member, segment, buffers, &mut out)
        } else {
            self.write::<MAX_INPUTS>(member, segment, buffers, &mut out)
        };
        let strange = written.map(|()| out.finish(simd));
        buffers.sets[set] = own;
        strange
    }

    /// Has a member of at most `PORTS` inputs write its segment.
    fn write<const PORTS: usize>(
        &self,
        member: &Member,
        segment: &Segment<'_>,
        buffers: &Buffers,
        out: &mut OutputRow<'_>,
    ) -> Result<(), Error> {
        let (cx, len) = (&segment.cx, segment.len);
        let mut ports = [PortRow::default(); PORTS];
        for (port, source) in ports.iter_mut().zip(&member.sources) {
            *port = match source {
                RowSource::None => PortRow::default(),
                RowSource::Member { member, first_plane, planes } => {
                    let rows = &buffers.sets[self.sets.of_member[*member]];
                    let rows = &rows[*first_plane..*first_plane + *planes];
                    PortRow::new(rows.iter().map(|plane| &plane.data()[..len]))
                }
                RowSource::Image(image) => PortRow::new(
                    (0..image.planes())
                        .map(|channel| &image.row(channel, cx.y)[cx.x as usize..][..len]),
                ),
            };
        }
        member.kernel.row(cx, &InputRows::new(&ports[..member.sources.len().min(PORTS)]), out)
    }

    /// Gives row `row` of the strip to its sinks.
    fn hand_over(&self, means: &Means<'_>, strip: &mut Strip<'_>, buffers: &Buffers, row: u32) {
        let width = self.sizes.working().0 as usize;
        let start = row as usize * width;
        for (handed, sink) in self.handed_over.iter().zip(&mut strip.sinks) {
            let mut planes: [&[f32]; crate::value::MAX_PLANES] = [&[]; _];
            for (channel, plane) in planes.iter_mut().enumerate().take(handed.planes) {
                *plane = match (self.given, self.members.len().checked_sub(1)) {
                    (Some(Value::Image(image)), _) => image.row(channel, strip.first_row + row),
                    (_, Some(_)) if !strip.stored.is_empty() => {
                        &strip.stored[handed.first_plane + channel][start..start + width]
                    }
                    (_, Some(root)) => {
                        let rows = &buffers.sets[self.sets.of_member[root]];
                        &rows[handed.first_plane + channel].data()[..width]
                    }
                    _ => &[],
                };
            }
            sink.put(means.precision, row, &planes[..handed.planes]);
        }
    }
}

/// Has the part of the stored planes that the next segment writes on its way meanwhile: a long
/// chain of blocks would wait for it, while the memory has nothing to do. Of a long row it is only
/// the beginning: more at a time than a CPU can wait for would hold up the row before it.
fn fetch_next(strip: &Strip<'_>, offset: usize, len: usize) {
    let wanted = if len > SEGMENT { FETCHED } else { len };
    for plane in &strip.stored {
        let next = plane.get(offset + len..).unwrap_or_default();
        simd::fetch_to_write(&next[..next.len().min(wanted)]);
    }
}

/// As many inputs as the blocks have that run often.
const FEW_PORTS: usize = 3;

/// A part of a row.
struct Segment<'a> {
    cx: RowContext<'a>,
    len: usize,
}

/// Which buffers each member of a stage writes. A buffer is written anew as soon as its last reader
/// is done, so that a long chain of blocks needs no more cache than a short one.
#[derive(Debug, PartialEq, Eq)]
pub(super) struct BufferSets {
    /// The set that each member writes.
    of_member: Vec<usize>,
    /// The planes of each set.
    planes: Vec<usize>,
}

impl BufferSets {
    /// Sets for the members of a stage, in topological order.
    pub(super) fn new(members: &[Member]) -> Self {
        let mut last_reader: Vec<usize> = (0..members.len()).collect();
        for (number, member) in members.iter().enumerate() {
            for source in &member.sources {
                if let RowSource::Member { member, .. } = source {
                    last_reader[*member] = number;
                }
            }
        }
        let mut sets = Self { of_member: Vec::new(), planes: Vec::new() };
        let mut free: Vec<usize> = Vec::new();
        for (number, member) in members.iter().enumerate() {
            let set = free.pop().unwrap_or_else(|| {
                sets.planes.push(0);
                sets.planes.len() - 1
            });
            sets.planes[set] = sets.planes[set].max(member.stores.len());
            sets.of_member.push(set);
            let done = (0..=number).filter(|earlier| last_reader[*earlier] == number);
            free.extend(done.map(|earlier| sets.of_member[earlier]));
        }
        sets
    }
}

/// The rows that one thread computes with.
struct Buffers {
    sets: Vec<Vec<Plane>>,
    segment: usize,
}

impl Buffers {
    fn new(stage: &StageRows<'_>, means: &Means<'_>, width: u32) -> Result<Self, Error> {
        let whole_rows = stage.members.iter().any(|member| member.needs_whole_rows)
            || !stage.handed_over.is_empty();
        let segment = if whole_rows { width as usize } else { SEGMENT.min(width as usize) };
        let planes = |count: &usize| {
            (0..*count).map(|_| means.pool.plane(segment)).collect::<Result<_, _>>()
        };
        let sets = stage.sets.planes.iter().map(planes).collect::<Result<_, _>>()?;
        Ok(Self { sets, segment })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    struct Nothing;

    impl RowKernel for Nothing {
        fn row(
            &self,
            _: &RowContext<'_>,
            _: &InputRows<'_>,
            _: &mut OutputRow<'_>,
        ) -> Result<(), Error> {
            Ok(())
        }
    }

    fn member(planes: usize, reads: &[usize]) -> Member {
        let source = |member: &usize| RowSource::Member { member: *member, first_plane: 0, planes };
        Member {
            kernel: Box::new(Nothing),
            sources: reads.iter().map(source).collect(),
            stores: vec![Store::Unit; planes],
            needs_whole_rows: false,
        }
    }

    #[test]
    fn a_chain_needs_two_buffers() {
        let chain = [member(1, &[]), member(3, &[0]), member(1, &[1]), member(1, &[2])];
        let BufferSets { of_member, planes } = BufferSets::new(&chain);
        assert_eq!((of_member, planes), (vec![0, 1, 0, 1], vec![1, 3]));
    }

    #[test]
    fn no_buffer_is_written_while_it_is_read() {
        // 0 is read by 1 and by 4; 2 by nobody.
        let stage = [
            member(1, &[]),
            member(1, &[0]),
            member(1, &[1, 1]),
            member(1, &[]),
            member(1, &[0, 3]),
        ];
        let sets = BufferSets::new(&stage);
        assert_eq!(sets.planes.len(), 3);
        for (number, member) in stage.iter().enumerate() {
            for source in &member.sources {
                let RowSource::Member { member: read, .. } = source else { continue };
                let kept = &sets.of_member[read + 1..=number];
                assert!(!kept.contains(&sets.of_member[*read]), "{number} reads {read}");
            }
        }
    }
}
