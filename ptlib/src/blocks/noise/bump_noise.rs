//! Dark cusps of several sizes, scattered over white.
//!
//! Specification 2.3. Radii halve from one size of bumps to the next. A bump subtracts from what is
//! there, saturating at black; as no amount is negative, that is the same as subtracting their sum.
//! So a row is white minus the bumps that reach it, and rows do not depend on each other.

// Pictured: `bump size from` `0.08`, `bump size to` `0.02`.
// Pictured: `bump size from` `0.3`, `bump size to` `0.03`, `quantity` `2`, `alter amplitude` `yes`.

use std::ops::Range;

use super::bump_sizes::{bumps, exact_bumps, radii};
use crate::block::prelude::*;

params! {
    /// Parameters of [`BLOCK`].
    Params {
        /// Radius of the largest bumps; 1 is the width of the image.
        from "bump size from": float [hard 0.001..=1.0 soft 0.001..=1.0 unit "of the width"] = 0.7;
        /// No bump has a radius below this; 1 is the width of the image.
        to "bump size to": float [hard 0.001..=1.0 soft 0.001..=0.2 unit "of the width"] = 0.001;
        /// How many bumps there are of each size, in rows of touching ones. 0 gives plain white.
        quantity: int [hard 0..=1000 soft 0..=20] = 1;
        /// Whether smaller bumps are less dark.
        alter_amplitude "alter amplitude": bool = false;
    }
}

/// The block as everybody else sees it.
pub static BLOCK: BlockSpec = BlockSpec::point::<BumpNoise>(About {
    id: "bump noise",
    summary: "Dark bumps of several sizes, scattered over white.",
    outputs: &[output("image", Planes::Grey)],
    uses_seed: true,
    ..About::DEFAULT
});

struct BumpNoise {
    sizes: Vec<Size>,
}

/// The bumps of one size.
struct Size {
    radius: i64,
    /// The level that the middle of a bump subtracts.
    depth: f32,
    /// The middles, by row, those of a row in the order in which they were drawn.
    middles: Vec<Middle>,
    /// For each row, the place of its first middle; then the number of middles.
    starts: Vec<usize>,
}

#[derive(Clone, Copy, Default)]
struct Middle {
    x: u32,
    y: u32,
}

impl PointBlock for BumpNoise {
    type Params = Params;

    fn prepare<L: Levels>(params: &Params, cx: &PrepareContext<'_>) -> Result<Self, Error> {
        let mut draws = elias::Draws::from_index(cx.seed32());
        let mut sizes = Vec::new();
        let shares = std::iter::successors(Some(params.from), |share| Some(share / 2.0));
        for (radius, share) in radii(params, cx.width).zip(shares) {
            cx.check()?;
            let most = bumps(params, cx.width, radius);
            // Q: the radius in whole pixels says how many there are. Then other sizes would be
            // drawn elsewhere at another resolution.
            let count = if L::EIGHT_BIT { most } else { exact_bumps(params, share).min(most) };
            let drawn = (0..count).map(|_| {
                let x = draws.next_noise() * f64::from(cx.width);
                let y = draws.next_noise() * f64::from(cx.height);
                Middle {
                    x: convert::wrap(convert::truncate64(x), cx.width),
                    y: convert::wrap(convert::truncate64(y), cx.height),
                }
            });
            let (middles, starts) = by_row(&drawn.collect::<Vec<_>>(), cx.height);
            let share = convert::pixels(radius) / convert::pixels(cx.width);
            let depth = if params.alter_amplitude { L::store(share) * 255.0 } else { 255.0 };
            sizes.push(Size { radius: i64::from(radius), depth, middles, starts });
        }
        Ok(Self { sizes })
    }

    #[inline(always)]
    fn row<L: Levels>(&self, cx: &RowContext<'_>, _: &InputRows<'_>, out: &mut OutputRow<'_>) {
        let out = out.grey();
        out.fill(0.0);
        for size in &self.sizes {
            size.add::<L>(cx, out);
        }
        for value in out {
            *value = levels::from_level(255.0 - *value);
        }
    }

    fn scratch_bytes(params: &Params, width: u32, height: u32) -> u64 {
        let middles = radii(params, width).map(|radius| u64::from(bumps(params, width, radius)));
        let rows = radii(params, width).count() as u64 * (u64::from(height) + 1);
        // Twice the middles: as drawn, and by row.
        2 * middles.sum::<u64>() * size_of::<Middle>() as u64 + rows * size_of::<usize>() as u64
    }
}

/// `drawn` by row, and for each row the place of its first one.
fn by_row(drawn: &[Middle], height: u32) -> (Vec<Middle>, Vec<usize>) {
    let mut starts = vec![0; height as usize + 1];
    for middle in drawn {
        starts[middle.y as usize + 1] += 1;
    }
    for row in 0..height as usize {
        starts[row + 1] += starts[row];
    }
    let mut next = starts.clone();
    let mut middles = vec![Middle::default(); drawn.len()];
    for middle in drawn {
        let place = &mut next[middle.y as usize];
        middles[*place] = *middle;
        *place += 1;
    }
    (middles, starts)
}

impl Size {
    /// Adds to `sums` what the bumps subtract there, in levels.
    #[inline(always)]
    fn add<L: Levels>(&self, cx: &RowContext<'_>, sums: &mut [f32]) {
        let reach = self.radius - 1;
        // Middles in rows y - reach ..= y + reach, which may pass the edges, even several times.
        let mut row = i64::from(cx.y) - reach;
        let mut added = 0_u32;
        while row <= i64::from(cx.y) + reach {
            let first = convert::wrap(row, cx.height);
            let rows = (i64::from(cx.y) + reach + 1 - row).min(i64::from(cx.height - first));
            let last = i64::from(first) + rows;
            let end = convert::wrap(last, cx.height + 1) as usize;
            for middle in &self.middles[self.starts[first as usize]..self.starts[end]] {
                let down = row + i64::from(middle.y - first) - i64::from(cx.y);
                self.add_bump::<L>(cx, middle.x, down, sums);
                added += 1;
                if added.is_multiple_of(64) && cx.is_stopped() {
                    return;
                }
            }
            row += rows;
        }
    }

    /// Adds a bump with its middle in column `x`, `down` rows from here.
    #[inline(always)]
    fn add_bump<L: Levels>(&self, cx: &RowContext<'_>, x: u32, down: i64, sums: &mut [f32]) {
        let (width, left) = (i64::from(cx.width), i64::from(cx.x));
        let right = left + sums.len() as i64;
        let reach = self.half_chord(down);
        let mut middle = i64::from(x);
        // The leftmost copy of the bump that reaches into this part of the row.
        middle -= (middle + reach - left).div_euclid(width) * width;
        while middle - reach < right {
            let from = (middle - reach).max(left);
            let to = (middle + reach + 1).min(right);
            let columns = convert::index(from - left)..convert::index(to - left);
            self.subtract::<L>(from - middle, down, columns, sums);
            middle += width;
        }
    }

    /// How far the bump reaches to both sides, `down` rows from its middle.
    #[inline(always)]
    fn half_chord(&self, down: i64) -> i64 {
        #[expect(clippy::cast_precision_loss, reason = "below 2³², exact")]
        let square = (self.radius * self.radius - down * down) as f64;
        convert::truncate64(square.sqrt()).min(self.radius - 1)
    }

    /// Adds a row of a bump to `sums[columns]`, which starts `across` pixels from the middle.
    #[inline(always)]
    fn subtract<L: Levels>(&self, across: i64, down: i64, columns: Range<usize>, sums: &mut [f32]) {
        let down = convert::distance(down);
        let first = convert::distance(across);
        let turns = 0.25 / convert::distance(self.radius);
        for (i, sum) in (0..).zip(&mut sums[columns]) {
            let across = first + convert::level(i);
            let distance = (across * across + down * down).sqrt();
            let amount = self.depth - self.depth * elementary::sin_quarter(distance * turns);
            *sum += L::store_level(amount.max(0.0));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::block::testing::Trial;

    /// As the specification tells it: bump after bump, all pixels around the middle.
    fn naive(trial: (u32, u32), from: f64, to: f64, quantity: i64, alters: bool) -> Vec<u8> {
        let (width, height) = trial;
        let (w, h) = (i64::from(width), i64::from(height));
        let mut levels = vec![255.0; width as usize * height as usize];
        let mut draws = elias::Draws::from_index(0);
        let mut r = convert::truncate64(from * w as f64);
        while r as f64 >= to * w as f64 {
            let depth = if alters { (r as f64 / w as f64 * 255.0).trunc() } else { 255.0 };
            for _ in 0..w / r * quantity {
                let x = convert::truncate64(draws.next_noise() * w as f64);
                let y = convert::truncate64(draws.next_noise() * h as f64);
                for (i, j) in (1 - r..r).flat_map(|i| (1 - r..r).map(move |j| (i, j))) {
                    let d = ((i * i + j * j) as f64).sqrt();
                    if d > r as f64 {
                        continue;
                    }
                    let angle = std::f64::consts::PI * d / (2 * r) as f64;
                    let amount = (depth - depth * elementary::sin64(angle)).trunc();
                    let place = (y + j).rem_euclid(h) * w + (x + i).rem_euclid(w);
                    let level: &mut f64 = &mut levels[convert::index(place)];
                    *level = (*level - amount).max(0.0);
                }
            }
            r /= 2;
        }
        levels.into_iter().map(|level| convert::to_byte(convert::single(level / 255.0))).collect()
    }

    #[test]
    fn rows_equal_bumps_that_are_subtracted_one_by_one() {
        for (size, from, to, quantity, alters) in [
            ((40, 30), 0.7, 0.01, 1, false),
            ((40, 30), 0.3, 0.02, 3, true),
            // Bumps that are taller than the image pass its edges more than once.
            ((64, 5), 1.0, 0.1, 2, true),
            ((5, 64), 1.0, 0.1, 1, false),
            ((1, 1), 1.0, 0.001, 1, false),
        ] {
            let trial = Trial::of(&BLOCK).size(size.0, size.1);
            let trial = trial.float("bump size from", from).float("bump size to", to);
            let trial = trial.int("quantity", quantity).flag("alter amplitude", alters);
            let expected = naive(size, from, to, i64::from(quantity), alters);
            for (i, (level, expected)) in trial.levels(0).into_iter().zip(expected).enumerate() {
                assert!(level.abs_diff(expected) <= 1, "{size:?}: {level}, {expected} at {i}");
            }
            trial.assert_same_bits();
        }
    }

    #[test]
    fn in_float_precision_there_are_as_many_at_every_resolution() {
        let params = Params { from: 0.7, to: 0.001, quantity: 1, alter_amplitude: false };
        let counts = |width| radii(&params, width).map(move |radius| (radius, width / radius));
        let shares = std::iter::successors(Some(params.from), |share| Some(share / 2.0));
        let exact: Vec<_> = shares.map(|share| exact_bumps(&params, share)).take(8).collect();
        assert_eq!(exact, [1, 2, 5, 11, 22, 45, 91, 182]);
        // Whole-numbered radii give more the smaller they are: 5 pixels instead of 5.6.
        assert!(counts(64).eq([(44, 1), (22, 2), (11, 5), (5, 12), (2, 32), (1, 64)]));
        for width in [1, 7, 64, 1000, 65_536] {
            assert!(counts(width).zip(&exact).all(|((_, most), exact)| *exact <= most), "{width}");
        }
    }

    #[test]
    fn nothing_to_draw_gives_white() {
        for trial in [
            Trial::of(&BLOCK).int("quantity", 0),
            Trial::of(&BLOCK).float("bump size from", 0.1).float("bump size to", 0.2),
        ] {
            assert!(trial.image().channel(0).iter().all(|value| *value == 1.0));
        }
    }

    #[test]
    fn another_seed_scatters_other_bumps() {
        let trial = Trial::of(&BLOCK);
        assert_ne!(trial.levels(0), trial.seed(1).levels(0));
    }
}
