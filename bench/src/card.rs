//! `test card`: an image that is there already, so that another block can be measured alone.
//!
//! [`Work`](crate::work::Work) sees to it that the engine has the card in its cache.

use ptlib::{
    block::{Family, prelude::*},
    params,
};

params! {
    /// Parameters of [`BLOCK`].
    Params {
        /// Whether the card has three planes instead of one.
        is_colour "colour": bool = true;
        /// Which card.
        number: int [hard 0..=1 soft 0..=1] = 0;
    }
}

/// The block that [`FAMILY`] adds to an engine.
static BLOCK: BlockSpec = BlockSpec::whole::<TestCard>(About {
    id: ID,
    summary: "An image that is there already.",
    outputs: &[output("image", Planes::ByParameters)],
    ..About::DEFAULT
});

/// The block's id in graphs.
pub(crate) const ID: &str = "test card";

/// What an engine's registry takes.
pub(crate) static FAMILY: Family = Family { name: "bench", blocks: &[&BLOCK] };

struct TestCard;

impl WholeBlock for TestCard {
    type Params = Params;

    fn compute<L: Levels>(params: &Params, cx: &WholeContext<'_>) -> Result<Vec<Value>, Error> {
        let mut card = cx.new_image(if params.is_colour { 3 } else { 1 })?;
        paint(&mut card, params.number.unsigned_abs());
        Ok(vec![card.into()])
    }

    fn is_grey(params: &Params) -> bool {
        !params.is_colour
    }
}

/// Cells of random grey with a slope inside: edges and smooth parts, as textures have them.
fn paint(card: &mut Image, number: u32) {
    const CELL: u32 = 16;
    let width = card.width() as usize;
    for (plane, values) in (1..).zip(card.planes_mut()) {
        let seed = plane + 10 * number;
        for (y, row) in (0..).zip(values.chunks_exact_mut(width)) {
            for (x, value) in (0..).zip(row) {
                let slope = convert::pixels(x % CELL + y % CELL);
                *value = 0.7 * noise(x / CELL, y / CELL, seed) + 0.01 * slope;
            }
        }
    }
}

/// A number 0..1 that depends on nothing but its arguments.
fn noise(x: u32, y: u32, seed: u32) -> f32 {
    let mut bits = x.wrapping_mul(0x9e37_79b1) ^ y.wrapping_mul(0x85eb_ca77);
    bits = (bits ^ seed.wrapping_mul(0xc2b2_ae3d)).wrapping_mul(0x27d4_eb2f);
    bits ^= bits >> 15;
    convert::pixels(bits >> 16) / 65536.0
}
