//! The hairs that are left at an age.
//!
//! What `scatter hair` gives is sorted, so that they are the first so many, and nothing is copied: the
//! output shares the beginning of each stream. Points in another order are filtered, in their order.

use std::ffi::CStr;

use ptlib_plugin::{
    AnyStream, Element, Points, Scratch, Stream, Streams,
    prelude::*,
    stream::{DIRECTION, ID, LOSS_AGE, POSITION, RANDOM, TEXCOORD},
};

/// Points of one task while they are counted.
const POINTS_OF_A_TASK: usize = 16384;

/// Streams whose elements have a type that is known; others are copied as bits.
const SLICES: [&CStr; 6] = [c"position", c"direction", c"texcoord", c"loss age", c"random", c"id"];

params! {
    /// Parameters of `hair at age`.
    Params {
        /// The age: hairs that are lost before it are gone. 0 keeps all, 1 keeps those that are
        /// never lost.
        age: float [hard 0.0..=1.0 soft 0.0..=1.0] = 0.5;
    }
}

/// The block, prepared.
#[derive(Debug)]
pub struct HairAtAge {
    age: f32,
}

impl Block for HairAtAge {
    type Params = Params;

    const ABOUT: About = About {
        id: c"aging.hair at age",
        name: c"Hair at age",
        category: c"hair",
        summary: c"Keeps the hairs that are not lost before an age.",
        inputs: &[&input(c"points", Kind::Points)
            .doc(c"Roots of hairs, each with the age at which it is lost.")],
        outputs: &[&output(c"points", Planes::Grey)
            .of_kind(Kind::Points)
            .doc(c"Those that are left, in their order.")],
        shape: Shape::Whole,
        ..About::DEFAULT
    };

    fn prepare(params: &Params, _: &Setup<'_>) -> Result<Self, BlockError> {
        Ok(Self { age: math::single(params.age) })
    }

    fn compute(&self, call: &mut Call<'_>) -> Result<(), BlockError> {
        let (points, work) = (call.points(0)?, call.work());
        let ages = points.streams().need(LOSS_AGE)?;
        let counts = self.counts(ages, work)?;
        let count = counts.iter().map(|count| *count as usize).sum();
        if count == ages.len() {
            return call.pass(0, 0);
        }
        if self.is_prefix(ages, &counts, count) {
            // The first so many of each stream, shared.
            return call.new_points(0, count, points.streams())?.finish();
        }
        copy(call, points, &self.places(ages, count, work)?)
    }
}

impl HairAtAge {
    /// How many are left of each task's.
    fn counts<'a>(
        &self,
        ages: Stream<'_, f32>,
        work: Work<'a>,
    ) -> Result<Scratch<'a, u32>, BlockError> {
        let mut counts = work.scratch::<u32>(ages.len().div_ceil(POINTS_OF_A_TASK))?;
        let age = self.age;
        work.for_each(counts.iter_mut().enumerate(), |(task, count)| {
            let first = task * POINTS_OF_A_TASK;
            let last = (first + POINTS_OF_A_TASK).min(ages.len());
            *count = match ages.as_slice() {
                Some(ages) => ages[first..last].iter().map(|loss| u32::from(*loss >= age)).sum(),
                None => (first..last).map(|i| u32::from(ages.get(i) >= age)).sum(),
            };
            Ok(())
        })?;
        Ok(counts)
    }

    /// Whether those that are left are the first `count`: all of the tasks before the one where
    /// they end, and none of those behind, so that only this one is looked at again.
    fn is_prefix(&self, ages: Stream<'_, f32>, counts: &[u32], count: usize) -> bool {
        let (full, rest) = (count / POINTS_OF_A_TASK, count % POINTS_OF_A_TASK);
        let are_full = counts[..full].iter().all(|left| *left as usize == POINTS_OF_A_TASK);
        let is_first = counts.get(full).is_none_or(|left| *left as usize == rest);
        let first = full * POINTS_OF_A_TASK;
        are_full && is_first && (first..count).all(|point| ages.get(point) >= self.age)
    }

    /// The places of those that are left, where these are not the first so many.
    fn places<'a>(
        &self,
        ages: Stream<'_, f32>,
        count: usize,
        work: Work<'a>,
    ) -> Result<Scratch<'a, u32>, BlockError> {
        let mut places = work.scratch::<u32>(count)?;
        let left = (0_u32..).zip(ages.iter()).filter(|(_, loss)| *loss >= self.age);
        for (place, (i, _)) in places.iter_mut().zip(left) {
            *place = i;
        }
        Ok(places)
    }
}

/// A stream with an element for each point, whose elements have a type that is known.
fn own<'a, T: Element>(
    streams: Streams<'a>,
    id: StreamId<T>,
    name: &CStr,
) -> (Option<StreamId<T>>, Option<Stream<'a, T>>) {
    let stream = streams.find(name).filter(|stream| !stream.is_constant());
    let stream = stream.and_then(AnyStream::typed::<T>);
    (stream.map(|_| id), stream)
}

/// Takes the elements at places.
fn take<T: Element>(out: Option<&mut [T]>, stream: Option<Stream<'_, T>>, places: &[u32]) {
    if let (Some(out), Some(stream)) = (out, stream) {
        out.iter_mut().zip(places).for_each(|(out, i)| *out = stream.get(*i as usize));
    }
}

/// Gives the points at places.
fn copy(call: &Call<'_>, points: Points<'_>, places: &[u32]) -> Result<(), BlockError> {
    let streams = points.streams();
    let (position, positions) = own(streams, POSITION, SLICES[0]);
    let (direction, directions) = own(streams, DIRECTION, SLICES[1]);
    let (texcoord, texcoords) = own(streams, TEXCOORD, SLICES[2]);
    let (loss_age, loss_ages) = own(streams, LOSS_AGE, SLICES[3]);
    let (random, randoms) = own(streams, RANDOM, SLICES[4]);
    let (id, ids) = own(streams, ID, SLICES[5]);
    let (constant, varying): (Vec<_>, Vec<_>) = streams.iter().partition(AnyStream::is_constant);
    let others: Vec<_> =
        varying.into_iter().filter(|stream| !SLICES.contains(&stream.id())).collect();
    let like: Vec<_> = others.iter().map(|stream| stream.like()).collect();
    let known = (position, direction, texcoord, loss_age, random, id);
    let mut left = call.new_points(0, places.len(), (known, like, constant))?;
    left.fill(|first, ((position, direction, texcoord, loss_age, random, id), like, _)| {
        let places = &places[first..];
        take(position, positions, places);
        take(direction, directions, places);
        take(texcoord, texcoords, places);
        take(loss_age, loss_ages, places);
        take(random, randoms, places);
        take(id, ids, places);
        for (mut out, stream) in like.into_iter().zip(&others) {
            for (i, place) in (0..out.count()).zip(places) {
                out.element(i).copy_from_slice(stream.bits(*place as usize));
            }
        }
        Ok(())
    })?;
    left.finish()
}

#[cfg(test)]
mod tests {
    use ptlib::{ErrorKind, params::ParamValue, value::Value};

    use crate::hair::testing::{self, Scene, floats};

    fn at(points: Value, age: f64) -> Result<Value, ptlib::Error> {
        let mut scene = Scene::of_points(points);
        let block = scene.behind("aging.hair at age", scene.source);
        scene.graph.set(block, "age", ParamValue::Float(age)).unwrap();
        scene.value(block)
    }

    fn randoms(points: &Value) -> Vec<f32> {
        floats(points, "random").into_iter().flatten().collect()
    }

    #[test]
    fn a_sorted_input_gives_its_prefix() {
        let points = testing::points(&[1.0, 1.0, 0.75, 0.5, 0.5, 0.25]);
        let lengths = [0.0, 0.25, 0.26, 0.5, 0.7, 0.75, 0.8, 1.0]
            .map(|age| randoms(&at(points.clone(), age).unwrap()));
        let all = randoms(&points);
        for (found, count) in lengths.iter().zip([6, 6, 5, 5, 3, 3, 2, 2]) {
            assert_eq!(found, &all[..count]);
        }
    }

    #[test]
    fn another_order_is_filtered_and_all_streams_go_along() {
        let points = testing::points(&[0.2, 0.9, 0.1, 0.8]);
        let left = at(points.clone(), 0.5).unwrap();
        let all = randoms(&points);
        assert_eq!(randoms(&left), [all[1], all[3]]);
        let Value::Points(left) = &left else { panic!("points") };
        let Value::Points(points) = &points else { panic!("points") };
        assert_eq!(left.streams().len(), points.streams().len());
        for stream in points.streams() {
            let found = left.stream(stream.id()).unwrap();
            assert_eq!(found.words().at(0), stream.words().at(1), "{}", stream.id());
            assert_eq!(found.words().at(1), stream.words().at(3), "{}", stream.id());
        }
    }

    #[test]
    fn all_are_passed_on_and_none_is_no_fault() {
        let points = testing::points(&[0.4, 0.3]);
        assert_eq!(at(points.clone(), 0.3).unwrap().content(), points.content());
        assert!(randoms(&at(points, 0.5).unwrap()).is_empty());
        assert!(randoms(&at(testing::points(&[]), 0.5).unwrap()).is_empty());
    }

    #[test]
    fn one_age_serves_all() {
        let points = testing::equal_points(5, 0.5);
        assert_eq!(at(points.clone(), 0.5).unwrap().content(), points.content());
        let none = at(points, 0.6).unwrap();
        let Value::Points(points) = &none else { panic!("points") };
        assert_eq!((points.count(), points.streams().len()), (0, 4));
        assert_eq!(points.stream("radius").unwrap().floats().at(0), [0.5]);
    }

    #[test]
    fn points_without_an_age_of_loss_are_refused() {
        let error = at(testing::bare_points(3), 0.5).unwrap_err();
        assert_eq!(error.kind(), ErrorKind::InvalidArgument);
        assert!(error.message().contains("\"loss age\""), "{error}");
    }

    #[test]
    fn threads_do_not_matter() {
        let ages: Vec<f32> = (0..40_000_u16).rev().map(|i| f32::from(i) / 40_000.0).collect();
        let mut scene = Scene::of_points(testing::points(&ages));
        let block = scene.behind("aging.hair at age", scene.source);
        let first = scene.value_on(block, 1).unwrap();
        assert_eq!(floats(&first, "random").len(), 20_000);
        for threads in [2, 3, 8] {
            assert_eq!(scene.value_on(block, threads).unwrap().content(), first.content());
        }
    }
}
