//! Fault formation: two hundred bands with straight, slanted borders, each raising the ground a
//! little.
//!
//! Specification 2.4. A band's borders run straight to the middle of the image and back, so it
//! tiles; then the whole band is shifted around the edges. Half of the bands cross the rows, the
//! others the columns.
//!
//! PT Designer adds band after band to the image. Here a row asks each band which of its pixels are
//! inside ([`Band`]). As no band lowers the ground, saturating once is the same as saturating after
//! each band.

use super::fault::{Band, PIECE, Steps};
use crate::block::prelude::*;

params! {
    /// The block has no parameters.
    Params {}
}

/// The block as everybody else sees it.
pub static BLOCK: BlockSpec = BlockSpec::point::<FaultFormation>(About {
    id: "fault formation noise",
    summary: "Rough ground: straight faults, each of which raised a part of it.",
    outputs: &[output("image", Planes::Grey)],
    uses_seed: true,
    ..About::DEFAULT
});

/// Bands of each kind.
const BANDS: i32 = 100;

struct FaultFormation {
    /// Their lines are rows.
    across_rows: Vec<Band>,
    /// Their lines are columns.
    across_columns: Vec<Band>,
}

impl PointBlock for FaultFormation {
    type Params = Params;

    fn prepare<L: Levels>(_: &Params, cx: &PrepareContext<'_>) -> Result<Self, Error> {
        let mut draws = elias::Draws::from_index(cx.seed32());
        let (width, height) = (i64::from(cx.width), i64::from(cx.height));
        let mut bands = Self { across_rows: Vec::new(), across_columns: Vec::new() };
        for _ in 0..BANDS {
            bands.across_rows.push(Band::draw(&mut draws, height, width, true));
            bands.across_columns.push(Band::draw(&mut draws, width, height, false));
        }
        Ok(bands)
    }

    #[inline(always)]
    fn row<L: Levels>(&self, cx: &RowContext<'_>, _: &InputRows<'_>, out: &mut OutputRow<'_>) {
        let mut first = i64::from(cx.x);
        for piece in out.grey().chunks_mut(PIECE) {
            let mut steps = Steps::new(first, piece.len(), cx.width);
            for band in &self.across_rows {
                band.add_line(i64::from(cx.y), &mut steps);
            }
            for band in &self.across_columns {
                band.add_place(i64::from(cx.y), &mut steps);
            }
            steps.sum(piece);
            first += PIECE as i64;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::block::testing::Trial;

    /// As the specification tells it: mask after mask.
    fn naive(width: i64, height: i64, seed: i32) -> Vec<u8> {
        let mut levels = vec![0_u8; convert::index(width * height)];
        let mut draws = elias::Draws::from_index(seed);
        for round in 0..200 {
            let along_x = round % 2 == 0;
            let (places, lines) = if along_x { (width, height) } else { (height, width) };
            let a1 = draws.next_integer(0, places);
            let a2 = draws.next_integer(a1, places);
            let b1 = draws.next_integer(0, places);
            let b2 = draws.next_integer(b1, places);
            let (shift_x, shift_y) = (draws.next_integer(0, width), draws.next_integer(0, height));
            let mut is_inside = vec![false; levels.len()];
            for i in 0..=lines / 2 {
                let t = if lines / 2 == 0 { 0.0 } else { i as f64 / (lines / 2) as f64 };
                let between = |a: i64, b: i64| convert::truncate64(a as f64 + (b - a) as f64 * t);
                for place in between(a1, b1).max(1)..between(a2, b2) {
                    for line in [i, (lines - i) % lines] {
                        let (x, y) = if along_x { (place, line) } else { (line, place) };
                        is_inside[convert::index(y * width + x)] = true;
                    }
                }
            }
            for (x, y) in (0..height).flat_map(|y| (0..width).map(move |x| (x, y))) {
                if is_inside[convert::index(y * width + x)] {
                    let (x, y) = ((x + shift_x) % width, (y + shift_y) % height);
                    let level = &mut levels[convert::index(y * width + x)];
                    *level = level.saturating_add(3);
                }
            }
        }
        levels
    }

    #[test]
    fn rows_equal_bands_that_are_added_one_by_one() {
        for (width, height, seed) in
            [(64, 64, 0), (97, 40, 4), (40, 97, -7), (1, 1, 1), (1, 30, 2), (30, 1, 3), (2, 3, 4)]
        {
            let trial =
                Trial::of(&BLOCK).size(width, height).seed(u64::from(i32::cast_unsigned(seed)));
            let expected = naive(i64::from(width), i64::from(height), seed);
            assert_eq!(trial.levels(0), expected, "{width} × {height}, seed {seed}");
            trial.assert_same_bits();
        }
    }

    #[test]
    fn long_rows_are_made_in_pieces() {
        let trial = Trial::of(&BLOCK).size(2500, 3);
        assert_eq!(trial.levels(0), naive(2500, 3, 0));
    }
}
