//! What the streams of a value may contain: checked once, at the border, before anybody sees it.
//!
//! An error names the stream, the first offender, and how many there are: programs hand over
//! millions of elements, and "invalid mesh" would help nobody.

use std::fmt::Display;

use super::{Bounds, Scalar, Stream, Words};
use crate::{
    error::{Error, ErrorKind},
    limits::Limits,
};

/// The largest coordinate: its square is still far from the largest `f32`.
const LARGEST: f32 = 1e18;

/// Shorter vectors have no direction.
const SHORTEST: f64 = 1e-6;

/// Vectors whose length differs from 1 by less are of length 1: they were normalised by somebody
/// who computes as we do, and stay where they are.
const UNIT: f64 = 1e-5;

/// What is counted in a message: one and several of it.
pub(super) type Noun = (&'static str, &'static str);

/// Makes the normals of all elements from the stream of their positions.
pub(super) type Recompute<'a> = dyn Fn(&Stream) -> Vec<[f64; 3]> + 'a;

const ELEMENTS: Noun = ("element", "elements");

/// The error of the places that break a rule, if there are any.
pub(super) fn refuse<V: Display>(
    subject: &str,
    (one, several): Noun,
    total: usize,
    allowed: &str,
    mut offenders: impl Iterator<Item = (usize, V)>,
) -> Result<(), Error> {
    let Some((first, value)) = offenders.next() else { return Ok(()) };
    let count = offenders.count() + 1;
    let such = if count == 1 { one } else { several };
    let message = format!(
        "{subject}: {one} {first} of {total} is {value}, allowed {allowed}; {count} such {such}"
    );
    Err(Error::new(ErrorKind::OutOfRange, message))
}

/// Whether a count is within its limit.
pub(super) fn count(what: &str, count: u64, limit: u32) -> Result<(), Error> {
    if count <= u64::from(limit) {
        return Ok(());
    }
    Err(Error::new(ErrorKind::Limit, format!("{count} {what} are given, allowed {limit}")))
}

/// Whether every index is below `limit`.
pub(super) fn indices(indices: &Words, limit: u32) -> Result<(), Error> {
    // The largest is found many at a time; who it is, only if it is too large.
    if indices.iter().copied().max().is_none_or(|largest| largest < limit) {
        return Ok(());
    }
    let offenders = indices.iter().copied().enumerate().filter(|(_, index)| *index >= limit);
    let noun = ("index", "indices");
    refuse("the indices", noun, indices.len(), &format!("below {limit}"), offenders)
}

/// Whether the ids of streams are unique, their number is allowed, and each has `elements`
/// elements.
pub(super) fn list(streams: &[Stream], elements: u32) -> Result<(), Error> {
    for (i, stream) in streams.iter().enumerate() {
        let shape = stream.shape();
        if streams[..i].iter().any(|other| other.id() == stream.id()) {
            return Err(shape.wrong("is given twice, allowed once"));
        }
        let needed = shape.elements(elements);
        if stream.elements() != needed {
            let message = format!("has {} elements, {needed} are needed", stream.elements());
            return Err(shape.wrong(&message));
        }
    }
    Ok(())
}

/// Whether a value may have so many streams.
pub(super) fn stream_count(streams: usize, limits: &Limits) -> Result<(), Error> {
    count("streams", streams as u64, limits.streams)
}

/// The bounds of the stream `position`.
pub(super) fn bounds(streams: &[Stream], elements: u32) -> Result<Bounds, Error> {
    let Some(positions) = streams.iter().find(|stream| stream.id() == "position") else {
        let error = Error::new(ErrorKind::InvalidArgument, "there is no stream \"position\"");
        return Err(error.with_hint("every mesh, points and strands have one, of 3 floats"));
    };
    if elements == 0 {
        return Ok(Bounds::default());
    }
    let mut bounds = Bounds { min: [f32::INFINITY; 3], max: [f32::NEG_INFINITY; 3] };
    match positions.without_gaps() {
        Some(numbers) => bounds_of(numbers, &mut bounds),
        None => {
            let all = positions.floats().all();
            all.for_each(|position| include(position, &mut bounds.min, &mut bounds.max));
        }
    }
    Ok(bounds)
}

/// Takes positions without gaps into the bounds: several at a time, of which each has bounds of its
/// own until the end.
fn bounds_of(numbers: &[f32], bounds: &mut Bounds) {
    /// Numbers of eight positions.
    const SOME: usize = 24;
    let (pieces, rest) = numbers.as_chunks::<SOME>();
    let (mut lowest, mut highest) = ([f32::INFINITY; SOME], [f32::NEG_INFINITY; SOME]);
    pieces.iter().for_each(|piece| include(piece, &mut lowest, &mut highest));
    let ends = lowest.chunks(3).chain(highest.chunks(3));
    let ends = ends.take(if pieces.is_empty() { 0 } else { usize::MAX });
    for position in ends.chain(rest.chunks(3)) {
        include(position, &mut bounds.min, &mut bounds.max);
    }
}

/// Takes finite numbers into the bounds of each.
#[inline(always)]
fn include(numbers: &[f32], min: &mut [f32], max: &mut [f32]) {
    for ((min, max), number) in min.iter_mut().zip(max).zip(numbers) {
        // Unlike `f32::min`, one instruction for several numbers.
        *min = if *number < *min { *number } else { *min };
        *max = if *number > *max { *number } else { *max };
    }
}

/// Checks the numbers of each stream; what is normalised in other ways is copied and made so.
/// `recompute` gives the normal of an element whose own has no direction, where that is possible.
pub(super) fn numbers(
    streams: &mut [Stream],
    recompute: Option<&Recompute<'_>>,
) -> Result<(), Error> {
    let is_new = |stream: &&Stream| !stream.is_checked();
    for stream in streams.iter().filter(is_new) {
        if stream.shape().scalar != Scalar::F32 {
            continue;
        }
        let allowed = format!("finite numbers from -{LARGEST:e} to {LARGEST:e}");
        // Not a number is not within either.
        numbers_within(stream, &allowed, |number| number.abs() <= LARGEST)?;
        if matches!(stream.id(), "loss age" | "color" | "random") {
            numbers_within(stream, "0 to 1", |number| (0.0..=1.0).contains(&number))?;
        }
    }
    let positions = streams.iter().find(|stream| stream.id() == "position").cloned();
    for stream in streams.iter_mut().filter(|stream| !stream.is_checked()) {
        match stream.id() {
            "normal" => {
                let recompute = recompute.zip(positions.as_ref());
                make_unit(stream, || recompute.map(|(recompute, positions)| recompute(positions)))?;
            }
            "direction" => make_unit(stream, || None)?,
            "tangent" => make_signs(stream)?,
            _ => {}
        }
        stream.note_checked();
    }
    Ok(())
}

/// Refuses the elements of which a number is not allowed.
fn numbers_within(
    stream: &Stream,
    allowed: &str,
    is_allowed: impl Fn(f32) -> bool,
) -> Result<(), Error> {
    // Without an end before the last one, so that many are looked at at a time.
    let all = |numbers: &[f32]| numbers.iter().fold(true, |all, number| all & is_allowed(*number));
    if stream.without_gaps().is_some_and(all) {
        return Ok(());
    }
    let offenders = stream.floats().all().enumerate().filter_map(|(i, element)| {
        element.iter().find(|number| !is_allowed(**number)).map(|number| (i, *number))
    });
    refuse(&subject(stream), ELEMENTS, stream.elements(), allowed, offenders)
}

fn subject(stream: &Stream) -> String {
    format!("stream \"{}\"", stream.id())
}

fn length(vector: &[f32]) -> f64 {
    vector.iter().map(|number| f64::from(*number) * f64::from(*number)).sum::<f64>().sqrt()
}

/// Makes every vector one of length 1. Those without a direction become those of `others`, which
/// takes long and is asked only for them, or an error.
fn make_unit(
    stream: &mut Stream,
    others: impl FnOnce() -> Option<Vec<[f64; 3]>>,
) -> Result<(), Error> {
    if stream.without_gaps().is_some_and(are_units) {
        return Ok(());
    }
    let mut is_changed = false;
    let mut too_short = 0_usize;
    for element in stream.floats().all() {
        let length = length(element);
        is_changed |= (length - 1.0).abs() > UNIT;
        too_short += usize::from(length < SHORTEST);
    }
    if !is_changed {
        return Ok(());
    }
    let others = if too_short > 0 { others() } else { None };
    if too_short > 0 && others.is_none() {
        let lengths = stream.floats().all().map(length).enumerate();
        let offenders = lengths.filter(|(_, length)| *length < SHORTEST);
        let subject = format!("{} (length)", subject(stream));
        return refuse(&subject, ELEMENTS, stream.elements(), "from 1e-6 on", offenders);
    }
    *stream = stream.changed(|i, vector| {
        let own = [vector[0], vector[1], vector[2]].map(f64::from);
        let other = others.as_ref().and_then(|others| others.get(i));
        let unit = match other {
            Some(other) if length(vector) < SHORTEST => *other,
            _ => unit_of(own).unwrap_or([0.0, 0.0, 1.0]),
        };
        vector.copy_from_slice(&unit.map(single));
    })?;
    Ok(())
}

/// Whether vectors of three numbers have length 1: their squares tell that faster. A few that do may
/// be taken for some that do not.
fn are_units(numbers: &[f32]) -> bool {
    numbers.as_chunks().0.iter().fold(true, |all, vector: &[f32; 3]| {
        let [x, y, z] = vector.map(f64::from);
        all & ((x * x + y * y + z * z - 1.0).abs() <= UNIT)
    })
}

/// The vector of length 1 in that direction; `None` if it has none.
pub(super) fn unit_of(vector: [f64; 3]) -> Option<[f64; 3]> {
    let length = vector.iter().map(|number| number * number).sum::<f64>().sqrt();
    (length > 0.0).then(|| vector.map(|number| number / length))
}

fn single(number: f64) -> f32 {
    crate::math::convert::single(number)
}

/// Makes the last number of each tangent +1 or -1: its sign, 0 counts as +1.
fn make_signs(stream: &mut Stream) -> Result<(), Error> {
    let sign = |number: f32| if number < 0.0 { -1.0 } else { 1.0 };
    if stream.floats().all().all(|tangent| tangent[3].abs().to_bits() == 1.0_f32.to_bits()) {
        return Ok(());
    }
    *stream = stream.changed(|_, tangent| tangent[3] = sign(tangent[3]))?;
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bounds_are_those_of_all_positions() {
        for count in [1_u16, 7, 8, 9, 16, 100] {
            let number = |i: u16| f32::from(i.wrapping_mul(40_503) % 1000) - 400.0;
            let numbers: Vec<f32> = (0..3 * count).map(number).collect();
            let mut bounds = Bounds { min: [f32::INFINITY; 3], max: [f32::NEG_INFINITY; 3] };
            bounds_of(&numbers, &mut bounds);
            for axis in 0..3 {
                let along = || numbers.iter().skip(axis).step_by(3).copied();
                assert_eq!(along().reduce(f32::min), Some(bounds.min[axis]), "{count}");
                assert_eq!(along().reduce(f32::max), Some(bounds.max[axis]), "{count}");
            }
        }
    }
}
