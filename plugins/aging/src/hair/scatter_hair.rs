//! Scatters roots of hairs over a mesh, and gives each the age at which it is lost.
//!
//! Every triangle gets hairs by its area, at random places that depend on the triangle and the
//! hair's number on it alone: more hairs keep the earlier ones, and neither the size of the images
//! nor the number of threads moves any. The age of loss is that of the pixel under the root,
//! without a filter, so that hair which is never lost stays so. Roots come sorted by that age, the
//! last to be lost first: those alive at any age are a prefix.

use ptlib_plugin::{
    prelude::*,
    stream::{DIRECTION, ID, LOSS_AGE, POSITION, RANDOM, TEXCOORD},
};

use super::{
    random,
    scatter::{
        batch::{BATCH, Batch},
        candidates::{self, Amount, Hair},
        ground::Ground,
        lean::{self, Lean},
        order,
    },
    vector::between,
};

const MESH: usize = 0;
const AGES: usize = 1;
const DENSITY: usize = 2;

/// The channel of the random number that a hair keeps.
const KEPT: u32 = 5;

/// Bytes of a hair at the peak: 48 of its point, 12 of its place in the order. (Those of the sort,
/// twice 12, are gone by then.)
const BYTES: u64 = 60;

params! {
    /// Parameters of `scatter hair`.
    Params {
        /// How many hairs the whole mesh would have if hair grew everywhere. Where the image
        /// `loss age` is 0, none grows, so there are fewer. A larger number keeps the earlier hairs.
        hairs: int [hard 0..=67108864 soft 1000..=500000] = 100000;
        /// Hairs on a square unit of the mesh; above 0, it replaces `hairs`, and meshes of any size
        /// are equally hairy. 0 leaves it to `hairs`.
        per_area "per area": float [hard 0.0..=1e12 soft 0.0..=1e6] = 0.0;
        /// How far hairs lean away from the normal of the skin at the most. 0 makes all stand
        /// upright, 90 lets some lie flat.
        spread: float [hard 0.0..=90.0 soft 0.0..=45.0 unit "degrees"] = 10.0;
    }
}

/// The block, prepared.
#[derive(Debug)]
pub struct ScatterHair {
    amount: Amount,
    spread: f64,
    seed: u64,
}

impl Block for ScatterHair {
    type Params = Params;

    const ABOUT: About = About {
        id: c"aging.scatter hair",
        name: c"Scatter hair",
        category: c"hair",
        summary: c"Scatters roots of hairs over a mesh, sorted by the age at which they are lost.",
        inputs: &[
            &input(c"mesh", Kind::Mesh).doc(c"What hair grows on, with texture coordinates."),
            &input(c"loss age", Kind::Image)
                .doc(c"The age at which hair is lost there: 0 never grows, 1 is never lost."),
            &input(c"density", Kind::Image)
                .optional()
                .doc(c"The part of the hairs that stays there, from 0, none, to 1, all."),
        ],
        outputs: &[&output(c"points", Planes::Grey)
            .of_kind(Kind::Points)
            .doc(c"The roots, those that are lost last first.")],
        shape: Shape::Whole,
        uses_seed: true,
        ..About::DEFAULT
    };

    fn prepare(params: &Params, setup: &Setup<'_>) -> Result<Self, BlockError> {
        let amount = if params.per_area > 0.0 {
            Amount::PerArea(params.per_area)
        } else {
            Amount::Hairs(f64::from(params.hairs))
        };
        Ok(Self { amount, spread: params.spread, seed: setup.seed() })
    }

    fn memory(params: &Params, _: u32, _: u32) -> u64 {
        // How many `per area` makes, only the mesh can tell.
        if params.per_area > 0.0 { 0 } else { u64::from(params.hairs.unsigned_abs()) * BYTES }
    }

    fn compute(&self, call: &mut Call<'_>) -> Result<(), BlockError> {
        let (mesh, work) = (call.mesh(MESH)?, call.work());
        let ground = Ground::new(mesh, call.image(AGES)?, call.optional_image(DENSITY))?;
        let seeded = (&ground, self.seed);
        let first = candidates::first_places(seeded, self.amount, work)?;
        let (hairs, count) = candidates::hairs_that_stay(seeded, &first, work)?;
        drop(first);
        if count > candidates::MOST as usize {
            let most = candidates::MOST;
            let message = format!("{count} hairs stay, allowed {most}: lower `hairs`");
            return Err(BlockError::limit(message));
        }
        work.report(0.3);
        let hairs = order::sorted(hairs, count, work)?;
        work.report(0.4);
        self.give(call, &ground, &hairs[..count])
    }
}

impl ScatterHair {
    /// Gives the points of sorted hairs.
    fn give(&self, call: &Call<'_>, ground: &Ground<'_>, hairs: &[Hair]) -> Result<(), BlockError> {
        let (lean, seed) = (Lean::new(self.spread), self.seed);
        let streams = (POSITION, DIRECTION, TEXCOORD, LOSS_AGE, RANDOM, ID);
        let mut points = call.new_points(0, hairs.len(), streams)?;
        points.fill(|first, (positions, directions, texcoords, ages, randoms, ids)| {
            let hairs = &hairs[first..][..positions.len()];
            let mut batch = Batch::new(seed);
            for start in (0..hairs.len()).step_by(BATCH) {
                let some = &hairs[start..hairs.len().min(start + BATCH)];
                batch.fill(some.iter().map(|[_, item, place]| [*item, *place]));
                let [distances, angles, kept] =
                    [lean::DISTANCE, lean::ANGLE, KEPT].map(|channel| batch.bits24(channel));
                let leaning = lean.directions([&distances, &angles], &ground.normals(&batch));
                for (i, (id, weights)) in batch.hairs().enumerate() {
                    let (at, triangle) = (start + i, id[0] as usize);
                    positions[at] = ground.root(triangle, weights);
                    directions[at] = leaning.each_ref().map(|numbers| numbers[i]);
                    texcoords[at] = between(ground.texcoords(triangle), weights).map(math::single);
                    ages[at] = candidates::loss_age(some[i][0]);
                    randoms[at] = math::single(random::unit(kept[i]));
                    ids[at] = id;
                }
            }
            Ok(())
        })?;
        points.finish()
    }
}

#[cfg(test)]
mod tests;
