//! Edge detection: how much brighter it is to the right and below than to the left and above.
//!
//! Specification 2.36 and 2.0 (CONV): over the (2I+1)² square around a pixel, the columns count
//! -1, -2, … -I to the left of it, 0 in its middle, and I, … 2, 1 to the right (the rows likewise
//! from above to below). Everything wraps around, also where the square is larger than the image,
//! so the result tiles.
//!
//! The weights are the same in all rows of the square, so its columns are summed first, and slide
//! ([`box_sum`]). Then Σ (I+1-k)·(column k to the right - column k to the left) is a sum of sums
//! over the nearest column, the nearest two, …: two additions for each k, in integers.

use crate::block::prelude::*;
use box_sum::{FixedPoint, LinePlan, LineSums, SlidingSum, Window};

const IMAGE: usize = 0;

/// PT Designer's weights get out of balance beyond this intensity (specification 2.36, BUG).
const MOST: i32 = 10;

choice! {
    /// Which edges are found.
    Type {
        /// Those between dark on the left and bright on the right.
        Horizontal = "horizontal",
        /// Those between dark above and bright below.
        Vertical = "vertical",
        /// Those of both kinds, added.
        Both = "both",
    }
}

params! {
    /// Parameters of [`BLOCK`].
    Params {
        /// How far around it a pixel looks. A higher intensity shows weaker edges, and all of
        /// them broader; 0 leaves the image as it is, and more than 10 does what 10 does.
        intensity: int [hard 0..=1000 soft 0..=10 unit "px"] = 3;
        /// The direction in which it must become brighter.
        direction "type": choice [Type] = Type::Both;
    }
}

/// The block as everybody else sees it.
pub static BLOCK: BlockSpec = BlockSpec::gather::<EdgeDetection>(About {
    id: "edge detection",
    summary: "Shows where the image becomes brighter, to the right or downwards.",
    inputs: &[input("image", Kind::Image).anywhere()],
    outputs: &[output("image", Planes::As(IMAGE))],
    in_pixels: "intensity",
    ..About::DEFAULT
});

/// Pixels that are computed side by side.
const PIECE: usize = 64;

/// The columns on either side that a piece may read.
const MARGIN: usize = MOST.unsigned_abs() as usize;

enum EdgeDetection {
    Nothing(Image),
    Edges(Edges),
}

struct Edges {
    radius: usize,
    /// Sums of 2I+1 pixels one above the other, if rows are to be looked along.
    columns: Option<LineSums>,
    /// Sums of 2I+1 pixels side by side, if columns are to be looked along.
    rows: Option<LineSums>,
    /// The integer that stands for 1.
    one: i32,
}

impl GatherBlock for EdgeDetection {
    type Params = Params;

    fn prepare<L: Levels>(params: &Params, cx: &PrepareContext<'_>) -> Result<Self, Error> {
        let image = cx.image(IMAGE)?;
        let radius = params.intensity.min(MOST).unsigned_abs();
        if radius == 0 {
            return Ok(Self::Nothing(image.clone()));
        }
        let side = 2 * radius + 1;
        let fixed = FixedPoint::new::<L>(side * radius * (radius + 1));
        let window = Window::around(radius);
        let is = |direction| params.direction == direction || params.direction == Type::Both;
        let plan = LinePlan::new((image.width(), image.height()), 0, [window], fixed);
        let columns = is(Type::Horizontal).then(|| cx.line_sums(&plan, image, image.planes()));
        let sliding = SlidingSum::new([window], image.width());
        let rows = is(Type::Vertical).then(|| cx.row_sums(&sliding, image, fixed));
        Ok(Self::Edges(Edges {
            radius: radius as usize,
            columns: columns.transpose()?,
            rows: rows.transpose()?,
            one: convert::truncate(convert::single(fixed.one())),
        }))
    }

    #[inline(always)]
    fn row<L: Levels>(&self, cx: &RowContext<'_>, _: &InputRows<'_>, out: &mut OutputRow<'_>) {
        for (channel, out) in out.iter_mut().enumerate() {
            match self {
                Self::Nothing(image) => out.copy_from_slice(image.row(channel, cx.y)),
                Self::Edges(edges) => {
                    for (i, out) in out.chunks_mut(PIECE).enumerate() {
                        edges.write(channel, cx, i * PIECE, out);
                    }
                }
            }
        }
    }

    fn scratch_bytes(params: &Params, width: u32, height: u32, planes: usize) -> u64 {
        let images = match params.direction {
            _ if params.intensity == 0 => 0,
            Type::Both => 2,
            _ => 1,
        };
        images * Image::bytes_of(width, height, planes)
    }
}

impl Edges {
    /// Writes a piece of a row, from column `x` on.
    #[inline(always)]
    fn write(&self, channel: usize, cx: &RowContext<'_>, x: usize, out: &mut [f32]) {
        let mut edges = [0; PIECE];
        let mut add = |sums: [i32; PIECE]| {
            for (edge, sum) in edges.iter_mut().zip(sums) {
                *edge += sum.max(0).min(self.one);
            }
        };
        if let Some(columns) = &self.columns {
            let mut near = [0; PIECE + 2 * MARGIN];
            let first = x as i64 - MARGIN as i64;
            ring::copy(columns.row(channel, cx.y).0, first, |sum| sum, &mut near);
            add(self.weigh(|k| &near[MARGIN - k..][..PIECE], |k| &near[MARGIN + k..][..PIECE]));
        }
        if let Some(rows) = &self.rows {
            let row = |y: i64| &rows.row(channel, convert::wrap_near(y, cx.height)).0[x..];
            let y = i64::from(cx.y);
            add(self.weigh(|k| row(y - k as i64), |k| row(y + k as i64)));
        }
        let per_one = 1.0 / convert::level(self.one);
        for (out, edge) in out.iter_mut().zip(edges) {
            *out = convert::level(edge) * per_one;
        }
    }

    /// Σ (I+1-k) · (`after` k - `before` k) over k from 1 to I, for each pixel of a piece.
    #[inline(always)]
    fn weigh<'a>(
        &self,
        before: impl Fn(usize) -> &'a [i32],
        after: impl Fn(usize) -> &'a [i32],
    ) -> [i32; PIECE] {
        let (mut nearest, mut sums) = ([0; PIECE], [0; PIECE]);
        if before(1).len() >= PIECE {
            for k in 1..=self.radius {
                // Of arrays, the compiler knows the length, and keeps these in registers.
                let whole = "all rows have as many columns";
                let before: &[i32; PIECE] = before(k).first_chunk().expect(whole);
                let after: &[i32; PIECE] = after(k).first_chunk().expect(whole);
                for i in 0..PIECE {
                    nearest[i] += after[i] - before[i];
                    sums[i] += nearest[i];
                }
            }
            return sums;
        }
        for k in 1..=self.radius {
            let numbers = nearest.iter_mut().zip(&mut sums).zip(before(k).iter().zip(after(k)));
            for ((nearest, sum), (before, after)) in numbers {
                *nearest += after - before;
                *sum += *nearest;
            }
        }
        sums
    }
}

#[cfg(test)]
mod tests {
    use super::super::tests as naive;
    use super::*;
    use crate::block::testing::{Trial, image_of_levels};

    fn trial(size: (u32, u32), levels: &[&[u8]], radius: i32, direction: u32) -> Trial {
        Trial::of(&BLOCK)
            .size(size.0, size.1)
            .input(IMAGE, image_of_levels(size.0, levels))
            .int("intensity", radius)
            .choice("type", direction)
    }

    #[test]
    fn weights_fall_from_the_middle_outwards() {
        for size in [(1, 1), (7, 5), (4, 9), (130, 3), (64, 30)] {
            let levels = naive::noise(size.0 * size.1);
            for radius in [1, 2, 3, 5, 8, 10] {
                let weight = |k: i64| (k.signum() * (i64::from(radius) + 1 - k.abs())) as f64;
                let square = naive::square(radius);
                let across = naive::convolved(&levels, size, square, |i, _| weight(i));
                let down = naive::convolved(&levels, size, square, |_, j| weight(j));
                let both: Vec<_> =
                    across.iter().zip(&down).map(|(a, b)| a.saturating_add(*b)).collect();
                for (direction, expected) in (0..).zip([&across, &down, &both]) {
                    let found = trial(size, &[&levels], radius, direction).levels(0);
                    assert_eq!(found, *expected, "{size:?}, radius {radius}, {direction}");
                }
            }
        }
    }

    #[test]
    fn a_step_up_to_the_right_is_horizontal() {
        let trial = Trial::of(&BLOCK).int("intensity", 1);
        let levels = |direction| naive::of_the_test_row(&trial.clone().choice("type", direction));
        let expected = [0, 0, 0, 255, 255, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0];
        assert_eq!((levels(0), levels(1), levels(2)), (expected.to_vec(), vec![0; 16], levels(0)));
    }

    #[test]
    fn intensity_0_changes_nothing_and_the_greatest_is_10() {
        let levels = naive::noise(20 * 9);
        assert_eq!(trial((20, 9), &[&levels], 0, 2).levels(0), levels);
        let at = |radius| trial((20, 9), &[&levels], radius, 2).levels(0);
        assert_eq!(at(1000), at(10));
    }

    #[test]
    fn float_precision_gives_weak_edges_too() {
        let mut levels = [100; 64];
        levels[4..8].fill(101);
        let edges = trial((8, 8), &[&levels], 1, 1).image();
        // Below the brighter pixels of row 0 nothing becomes brighter; above them, by 2 of 255.
        let expected = 2.0 / 255.0;
        assert!((edges.row(0, 7)[5] - expected).abs() > 0.0);
        assert_eq!(edges.row(0, 1)[5], 0.0);
    }

    #[test]
    fn rows_are_the_same_bits_at_every_simd_level() {
        let levels = naive::noise(145 * 20);
        trial((145, 20), &[&levels], 7, 2).assert_same_bits();
        trial((145, 20), &[&levels], 7, 2).eight_bit().assert_same_bits();
    }
}
