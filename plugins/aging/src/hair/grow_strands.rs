//! Grows a strand from each root: straight along its direction, or drooping.
//!
//! Lengths are in diagonals of the points' bounds, so that a head of any size has the same hair.
//! Each hair's length varies by its id alone.

use std::ops::Range;

use ptlib_plugin::{
    Stream,
    prelude::*,
    simd::{self, Kernel},
    stream::{DIRECTION, ID, LOSS_AGE, POSITION, RADIUS, TEXCOORD},
};

use super::{
    random,
    vector::{length, minus, wide},
};

/// The channel of the random number of a length.
const LENGTH: u32 = 6;

/// Strands whose lengths are taken together.
const BATCH: usize = 128;

/// The most points of all strands, as the library has it.
const MOST: usize = 256 << 20;

params! {
    /// Parameters of `grow strands`.
    Params {
        /// How long hair is, in diagonals of the box around all roots. 0 makes points of all
        /// strands.
        length: float [hard 0.0..=10.0 soft 0.0..=0.3 unit "diagonals"] = 0.05;
        /// How thick hair is at its root, in diagonals of the box around all roots; it ends in a
        /// point.
        thickness: float [hard 0.0..=1.0 soft 0.0..=0.002 unit "diagonals"] = 0.0005;
        /// By which part hairs are shorter at the most. 0 makes all as long, 1 lets some have
        /// almost no length.
        variation: float [hard 0.0..=1.0 soft 0.0..=1.0] = 0.2;
        /// Pieces of a hair. One is enough for straight hair; more let drooping hair bend.
        segments: int [hard 1..=64 soft 1..=16] = 1;
        /// How far the tip of a hair falls, in its lengths. 0 leaves it straight.
        droop: float [hard 0.0..=4.0 soft 0.0..=1.0] = 0.0;
    }
}

/// The block, prepared.
#[derive(Debug)]
pub struct GrowStrands {
    params: Params,
    seed: u64,
}

impl Block for GrowStrands {
    type Params = Params;

    const ABOUT: About = About {
        id: c"aging.grow strands",
        name: c"Grow strands",
        category: c"hair",
        summary: c"Grows a strand of hair from each root.",
        inputs: &[&input(c"points", Kind::Points).doc(c"Roots of hairs, with their directions.")],
        outputs: &[&output(c"strands", Planes::Grey)
            .of_kind(Kind::Strands)
            .doc(c"A strand for each root, with the root's age of loss, colour and id.")],
        shape: Shape::Whole,
        uses_seed: true,
        ..About::DEFAULT
    };

    fn prepare(params: &Params, setup: &Setup<'_>) -> Result<Self, BlockError> {
        Ok(Self { params: params.clone(), seed: setup.seed() })
    }

    fn compute(&self, call: &mut Call<'_>) -> Result<(), BlockError> {
        let roots = call.points(0)?;
        let streams = roots.streams();
        let (from, along) = (roots.positions()?, streams.need(DIRECTION)?);
        let ids = streams.get(ID);
        let [lowest, highest] = roots.bounds().map(wide);
        let growth = self.growth(length(minus(highest, lowest)), roots.count())?;
        let points = StrandPoints::Each(roots.count(), growth.parts.len());
        let color = streams.find(c"color");
        let kept = (streams.get(LOSS_AGE), color, streams.get(TEXCOORD), ids);
        let mut hair = call.new_strands(0, points, (POSITION, RADIUS), kept)?;
        hair.fill(|piece, (positions, radii), _| {
            let points = BATCH * growth.parts.len();
            let batches = positions.chunks_mut(points).zip(radii.chunks_mut(points));
            for (first, points) in (piece.first..).step_by(BATCH).zip(batches) {
                let lengths = self.lengths(growth.length, ids, first..roots.count());
                let strands = points.0.chunks_mut(growth.parts.len());
                let strands = strands.zip(points.1.chunks_mut(growth.parts.len()));
                for ((root, length), strand) in (first..).zip(lengths).zip(strands) {
                    growth.write(from.get(root), along.get(root), length, strand);
                }
            }
            Ok(())
        })?;
        hair.finish()
    }
}

/// What all strands have in common, in the units of the points.
struct Growth {
    length: f32,
    radius: f32,
    droop: f32,
    /// Where the points of a strand lie, 0 at its root and 1 at its tip.
    parts: Vec<f32>,
}

impl Growth {
    /// Writes a strand from a root along a direction.
    #[inline(always)]
    fn write(
        &self,
        root: [f32; 3],
        along: [f32; 3],
        length: f32,
        (positions, radii): (&mut [[f32; 3]], &mut [f32]),
    ) {
        for ((position, radius), part) in positions.iter_mut().zip(radii).zip(&self.parts) {
            let reach = length * part;
            let fall = self.droop * reach * part;
            *position = [
                root[0] + along[0] * reach,
                root[1] + along[1] * reach - fall,
                root[2] + along[2] * reach,
            ];
            *radius = self.radius * (1.0 - part);
        }
    }
}

impl GrowStrands {
    fn growth(&self, diagonal: f64, strands: usize) -> Result<Growth, BlockError> {
        let Params { length, thickness, segments, droop, .. } = self.params;
        let all = strands.saturating_mul(segments.unsigned_abs() as usize + 1);
        if all > MOST {
            return Err(BlockError::limit(format!(
                "{strands} strands of {segments} segments have {all} points, allowed {MOST}: \
                 lower `segments`"
            )));
        }
        Ok(Growth {
            length: math::single(length * diagonal),
            radius: math::single(thickness * diagonal / 2.0),
            droop: math::single(droop),
            parts: (0..=segments)
                .map(|m| math::single(f64::from(m) / f64::from(segments)))
                .collect(),
        })
    }

    /// The lengths of the strands of the first of some roots. Roots without an id are told apart by
    /// their places.
    fn lengths(
        &self,
        longest: f32,
        ids: Option<Stream<'_, [u32; 2]>>,
        roots: Range<usize>,
    ) -> [f32; BATCH] {
        let mut own = [[0; 2]; BATCH];
        for (own, root) in own.iter_mut().zip(roots) {
            let by_place = || [u32::try_from(root).unwrap_or(u32::MAX), 0];
            *own = ids.map_or_else(by_place, |ids| ids.get(root));
        }
        let (seed, variation) = (self.seed, self.params.variation);
        simd::run(Lengths { seed, variation, longest, ids: &own })
    }
}

struct Lengths<'a> {
    seed: u64,
    variation: f64,
    longest: f32,
    ids: &'a [[u32; 2]; BATCH],
}

impl Kernel for Lengths<'_> {
    type Output = [f32; BATCH];

    #[inline(always)]
    fn run(self) -> [f32; BATCH] {
        let mut lengths = [0.0; BATCH];
        for (length, [item, part]) in lengths.iter_mut().zip(self.ids) {
            let shorter = self.variation * random::uniform(self.seed, *item, *part, LENGTH);
            *length = self.longest * math::single(1.0 - shorter);
        }
        lengths
    }
}

#[cfg(test)]
mod tests {
    use ptlib::{
        ErrorKind,
        params::ParamValue,
        value::{Strands, Value},
    };

    use crate::hair::testing::{self, Scene};

    fn grown(points: Value, set: &[(&str, ParamValue)]) -> Result<Value, ptlib::Error> {
        let mut scene = Scene::of_points(points);
        let block = scene.behind("aging.grow strands", scene.source);
        for (name, value) in set {
            scene.graph.set(block, name, value.clone()).unwrap();
        }
        scene.value(block)
    }

    fn points_of(strands: &Strands, strand: usize) -> Vec<[f32; 3]> {
        let first = strands.first_point();
        let positions = strands.point_streams()[0].floats();
        (first[strand]..first[strand + 1])
            .map(|i| positions.at(i as usize).try_into().unwrap())
            .collect()
    }

    #[test]
    fn a_strand_goes_along_its_direction_and_falls() {
        let set = [
            ("length", ParamValue::Float(0.5)),
            ("thickness", ParamValue::Float(0.01)),
            ("variation", ParamValue::Float(0.0)),
            ("segments", ParamValue::Int(2)),
            ("droop", ParamValue::Float(0.5)),
        ];
        // Roots at x = 0 and 1, directions along z: the diagonal is 1.
        let Value::Strands(strands) = grown(testing::points(&[1.0, 0.5]), &set).unwrap() else {
            panic!("strands")
        };
        assert_eq!(&strands.first_point()[..], [0, 3, 6]);
        let expected = [[1.0, 0.0, 0.0], [1.0, -0.0625, 0.25], [1.0, -0.25, 0.5]];
        assert_eq!(points_of(&strands, 1), expected);
        let radii = strands.point_streams()[1].floats();
        assert_eq!([0, 1, 2].map(|i| radii.at(i)[0]), [0.005, 0.0025, 0.0]);
        let ids: Vec<_> = strands.strand_streams().iter().map(ptlib::value::Stream::id).collect();
        assert_eq!(ids, ["loss age", "texcoord", "id"]);
    }

    #[test]
    fn lengths_vary_by_id_and_stay_within_the_variation() {
        let ages: Vec<f32> = (0..500_u16).map(|i| 1.0 - f32::from(i) / 500.0).collect();
        let set = |variation| [("variation", ParamValue::Float(variation))];
        let lengths = |variation: f64, count: usize| {
            let points = testing::points(&ages[..count]);
            let Value::Strands(strands) = grown(points, &set(variation)).unwrap() else {
                panic!("strands")
            };
            let bounds = f64::from(strands.bounds().max[0]);
            let length = |strand| f64::from(points_of(&strands, strand)[1][2]) / bounds / 0.05;
            (0..count).map(length).collect::<Vec<_>>()
        };
        assert!(lengths(0.0, 500).iter().all(|length| (length - 1.0).abs() < 1e-5));
        let all = lengths(0.4, 500);
        assert!(all.iter().all(|length| (0.6 - 1e-5..=1.0 + 1e-5).contains(length)));
        let mean = all.iter().sum::<f64>() / 500.0;
        assert!((mean - 0.8).abs() < 0.02, "{mean}");
        // Fewer hairs: the same lengths.
        let some = lengths(0.4, 100);
        assert!(some.iter().zip(&all).all(|(some, all)| (some - all).abs() < 1e-5));
    }

    #[test]
    fn what_is_missing_is_named_and_none_is_no_fault() {
        let error = grown(testing::bare_points(2), &[]).unwrap_err();
        assert_eq!(error.kind(), ErrorKind::InvalidArgument);
        assert!(error.message().contains("\"direction\""), "{error}");
        let Value::Strands(none) = grown(testing::points(&[]), &[]).unwrap() else {
            panic!("strands")
        };
        assert_eq!((none.count(), none.point_count()), (0, 0));
        // One root: bounds without a size, so strands without a length.
        let Value::Strands(one) = grown(testing::points(&[1.0]), &[]).unwrap() else {
            panic!("strands")
        };
        assert_eq!(points_of(&one, 0), [[0.0; 3]; 2]);
    }

    #[test]
    fn threads_do_not_matter() {
        let ages: Vec<f32> = (0..20_000_u16).rev().map(|i| f32::from(i) / 20_000.0).collect();
        let mut scene = Scene::of_points(testing::points(&ages));
        let block = scene.behind("aging.grow strands", scene.source);
        let first = scene.value_on(block, 1).unwrap();
        for threads in [2, 3, 8] {
            assert_eq!(scene.value_on(block, threads).unwrap().content(), first.content());
        }
    }
}
