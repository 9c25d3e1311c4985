//! A cellular automaton in which each state eats the one before it, round and round.
//!
//! Specification 2.22. Where enough neighbours of a cell have the state after its own, the cell
//! takes that state. All cells change at once.
//!
//! There are two ways to count. In small neighbourhoods, each neighbour is looked at, many cells at
//! a time: one comparison and one addition of a vector of bytes, whatever the number of states.
//! In large ones, the counts slide, one state after the other: see [`Sliding`]. That takes as long
//! for every size, but for each state. With AVX2, a neighbour costs 0.011 to 0.013 ns a cell, and
//! a state that slides 0.17 ns in squares and up to 0.23 ns in diamonds. So the usual two steps
//! and six states are looked at, the 440 neighbours of the largest square slide for up to 27
//! states.

// Pictured with `simple noise`.
// Pictured: `iterations` `100`, `neighbourhood` `moore`, `neighbourhood size` `1`, `states` `8`,
//   `threshold` `1`.
// Pictured: `iterations` `12`, `neighbourhood` `moore`, `states` `3`, `threshold` `9`.

use super::{
    neighbourhood::{MAX_SIZE, Neighbourhood},
    sliding::Sliding,
};
use crate::block::prelude::*;
use cells::{Grid, Rule, SIDE, value_of_state};

const IMAGE: usize = 0;

/// To slide the counts of one state costs as much as to look at so many neighbours.
const NEIGHBOURS_PER_STATE: usize = 16;

params! {
    /// Parameters of [`BLOCK`].
    Params {
        /// How many times all cells change. 0 shows the states of the picture.
        iterations: int [hard 0..=999999 soft 0..=200] = 30;
        /// Which cells are neighbours.
        neighbourhood: choice [Neighbourhood] = Neighbourhood::VonNeumann;
        /// How far neighbours are away at most. 0 leaves a cell without neighbours.
        size "neighbourhood size": int [hard 0..=10 soft 1..=10 unit "px"] = 2;
        /// How many states a cell has.
        states: int [hard 2..=255 soft 2..=32] = 6;
        /// How many neighbours make a cell take their state. 0 makes all cells go on always.
        threshold: int [hard 0..=9999999 soft 0..=50] = 2;
    }
}

/// The block as everybody else sees it.
pub static BLOCK: BlockSpec = BlockSpec::whole::<CellularAutomatonCyclic>(About {
    id: "cellular automaton cyclic",
    summary: "Cells whose states eat each other in a circle, which makes spirals.",
    inputs: &[input("image", Kind::Image)],
    outputs: &[output("image", Planes::Grey)],
    in_pixels: "the neighbourhood, and how far a pattern grows in an iteration",
    ..About::DEFAULT
});

struct CellularAutomatonCyclic;

impl WholeBlock for CellularAutomatonCyclic {
    type Params = Params;

    fn compute<L: Levels>(params: &Params, cx: &WholeContext<'_>) -> Result<Vec<Value>, Error> {
        let states = convert::clamped_byte(params.states);
        let grid = cx.states_of::<L>(cx.image(IMAGE)?, states, margin(params))?;
        let grid = evolved(params, cx, grid, states)?;
        let picture = cx.picture_of(&grid, |state| value_of_state::<L>(state, states))?;
        Ok(vec![Value::Image(picture)])
    }

    fn scratch_bytes(params: &Params, width: u32, height: u32) -> u64 {
        3 * Grid::bytes(width, height, margin(params))
    }
}

/// Counts that slide lose cells just behind the neighbourhood.
fn margin(params: &Params) -> usize {
    convert::index(params.size.into()).min(MAX_SIZE) + 1
}

/// The grid after all iterations.
fn evolved(params: &Params, cx: &WholeContext<'_>, grid: Grid, states: u8) -> Result<Grid, Error> {
    let neighbours = params.neighbourhood.steps(params.size).count();
    let threshold = match u16::try_from(params.threshold) {
        Ok(threshold) if usize::from(threshold) <= neighbours => threshold,
        _ => return Ok(grid), // Nothing is ever eaten.
    };
    let iterations = params.iterations.unsigned_abs();
    if neighbours > NEIGHBOURS_PER_STATE * usize::from(states) {
        let (shape, reach) = (params.neighbourhood, margin(params) - 1);
        let sliding = Sliding { shape, reach, states, threshold };
        cx.evolve(grid, iterations, |old, new| sliding.generation(cx, old, new))
    } else {
        let scan = Scan::new(params, &grid, states, threshold);
        cx.evolve(grid, iterations, |old, new| cx.generation(old, new, &scan))
    }
}

/// Looks at each neighbour.
struct Scan {
    last: u8,
    threshold: u16,
    /// Offsets of the neighbours in two halves, so that the number of those in each (at most
    /// 230) fits a byte.
    halves: [Vec<isize>; 2],
}

impl Scan {
    fn new(params: &Params, grid: &Grid, states: u8, threshold: u16) -> Self {
        let steps = params.neighbourhood.steps(params.size);
        let (above, below): (Vec<_>, Vec<_>) = steps.partition(|(_, dy)| *dy < 0);
        let offset = |(dx, dy)| grid.offset(dx, dy);
        let halves = [above, below].map(|half| half.into_iter().map(offset).collect());
        Self { last: states - 1, threshold, halves }
    }
}

impl Rule for Scan {
    #[inline(always)]
    fn side(&self, grid: &Grid, x: usize, y: usize) -> [u8; SIDE] {
        let place = grid.place(x, y);
        let mut cells = *grid.side(place, 0);
        let mut after = cells;
        for state in &mut after {
            *state = if *state < self.last { *state + 1 } else { 0 };
        }
        let above = count(grid, place, &self.halves[0], &after);
        let below = count(grid, place, &self.halves[1], &after);
        for i in 0..SIDE {
            let count = u16::from(above[i]) + u16::from(below[i]);
            // All bits or none: nobody can foretell a branch here.
            let is_eaten = u8::from(count >= self.threshold).wrapping_neg();
            cells[i] = (after[i] & is_eaten) | (cells[i] & !is_eaten);
        }
        cells
    }
}

/// How many of the neighbours at `offsets` have the states `wanted`.
#[inline(always)]
fn count(grid: &Grid, place: usize, offsets: &[isize], wanted: &[u8; SIDE]) -> [u8; SIDE] {
    let mut counts = [0_u8; SIDE];
    for offset in offsets {
        let neighbours = grid.side(place, *offset);
        for ((count, neighbour), wanted) in counts.iter_mut().zip(neighbours).zip(wanted) {
            *count = count.wrapping_add(u8::from(neighbour == wanted));
        }
    }
    counts
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::block::testing::{Trial, image_of_levels};

    fn picture(width: u32, height: u32) -> Vec<u8> {
        (0..width * height).map(|i| (i * i * 7 / 3 % 251).to_le_bytes()[0]).collect()
    }

    fn trial_of(levels: &[u8], width: u32) -> Trial {
        let height = u32::try_from(levels.len()).unwrap() / width;
        Trial::of(&BLOCK).size(width, height).input(IMAGE, image_of_levels(width, &[levels]))
    }

    fn trial(width: u32, height: u32) -> Trial {
        trial_of(&picture(width, height), width)
    }

    /// The levels that a plain reading of the specification gives.
    fn naive(
        levels: &[u8],
        width: u32,
        rule: (Neighbourhood, i32, u8, usize),
        iterations: i32,
    ) -> Vec<u8> {
        let (shape, reach, states, threshold) = rule;
        let height = u32::try_from(levels.len()).unwrap() / width;
        let state = |level: &u8| (u32::from(*level) * 93 / 100 * u32::from(states)).div_ceil(255);
        let mut cells: Vec<u32> = levels.iter().map(|level| state(level).max(1) - 1).collect();
        for _ in 0..iterations {
            let next = |i: u32| {
                let own = cells[i as usize];
                let after = (own + 1) % u32::from(states);
                let is_after = |(dx, dy): &(isize, isize)| {
                    let x = convert::wrap(i64::from(i % width) + *dx as i64, width);
                    let y = convert::wrap(i64::from(i / width) + *dy as i64, height);
                    cells[(y * width + x) as usize] == after
                };
                let count = shape.steps(reach).filter(is_after).count();
                if count >= threshold { after } else { own }
            };
            cells = (0..width * height).map(next).collect();
        }
        let level = |state: &u32| (state * 255 / (u32::from(states) - 1)).to_le_bytes()[0];
        cells.iter().map(level).collect()
    }

    fn assert_is_naive(levels: &[u8], width: u32, rule: (Neighbourhood, i32, u8, usize)) {
        let (shape, reach, states, threshold) = rule;
        let trial = trial_of(levels, width)
            .choice("neighbourhood", if shape == Neighbourhood::Moore { 0 } else { 1 })
            .int("neighbourhood size", reach)
            .int("states", states.into())
            .int("threshold", i32::try_from(threshold).unwrap())
            .int("iterations", 2);
        let place = format!("{rule:?}, {} pixels in rows of {width}", levels.len());
        assert_eq!(trial.levels(0), naive(levels, width, rule, 2), "{place}");
        trial.assert_same_bits();
    }

    const SHAPES: [Neighbourhood; 2] = [Neighbourhood::Moore, Neighbourhood::VonNeumann];

    #[test]
    fn counts_are_those_of_a_plain_search() {
        for shape in SHAPES {
            for (reach, states, threshold) in
                [(0, 3, 0), (0, 3, 1), (1, 4, 1), (2, 6, 2), (5, 30, 3), (9, 100, 2), (10, 255, 1)]
            {
                for (width, height) in [(70, 9), (7, 3), (64, 30), (1, 1)] {
                    let levels = picture(width, height);
                    assert_is_naive(&levels, width, (shape, reach, states, threshold));
                }
            }
        }
    }

    /// Few states, so that counts slide, in several bands of rows and of columns, and in grids
    /// that are smaller than the neighbourhood.
    #[test]
    fn counts_that_slide_are_those_of_a_plain_search() {
        let mut number = 1_u32;
        let mut below = |limit: u32| {
            number = number.wrapping_mul(747_796_405).wrapping_add(2_891_336_453);
            (number >> 16) % limit
        };
        for shape in SHAPES {
            for reach in 3..=10 {
                let neighbours = u32::try_from(shape.steps(reach).count()).unwrap();
                let sizes = [(1, 1), (3, 150), (90, 7), (64, 64), (below(80) + 1, below(80) + 1)];
                for (width, height) in sizes {
                    let states = below(neighbours.div_ceil(16).saturating_sub(2).max(1)) + 2;
                    let mean = neighbours / states;
                    let threshold = mean / 2 + below(mean + 2);
                    let states = u8::try_from(states).unwrap();
                    let rule = (shape, reach, states, threshold as usize);
                    assert_is_naive(&picture(width, height), width, rule);
                }
            }
            assert_is_naive(&picture(1030, 3), 1030, (shape, 6, 3, 25));
        }
    }

    #[test]
    fn thresholds_larger_than_a_byte_are_reached_exactly() {
        // Bright pixels, which eat dark ones, all over the picture: five to eight of nine.
        let is_dark = |i: u32| i * i * 7 / 3 % 9 < 1 + i / 300;
        let levels: Vec<u8> = (0..1200).map(|i| if is_dark(i) { 0 } else { 255 }).collect();
        for reach in 8..=10 {
            let square = (2 * reach + 1) * (2 * reach + 1);
            for percent in (56..=96).step_by(2) {
                let threshold = convert::index((square * percent / 100).into()).max(256);
                let rule = (Neighbourhood::Moore, reach, 2, threshold);
                assert_is_naive(&levels, 30, rule);
            }
        }
    }

    #[test]
    fn many_iterations_are_shortened_but_not_changed() {
        let count = |iterations| trial(40, 24).int("iterations", iterations).levels(0);
        let rule = (Neighbourhood::VonNeumann, 2, 6, 2);
        for iterations in [100, 301, 1000] {
            let expected = naive(&picture(40, 24), 40, rule, iterations);
            assert_eq!(count(iterations), expected, "{iterations}");
        }
        count(999_999);
    }

    #[test]
    fn a_threshold_that_nothing_reaches_changes_nothing() {
        let states = trial(50, 20).int("iterations", 0).levels(0);
        let trial = trial(50, 20).choice("neighbourhood", 0).int("neighbourhood size", 10);
        for threshold in [441, 65_536, 9_999_999] {
            assert_eq!(trial.clone().int("threshold", threshold).levels(0), states);
        }
    }

    #[test]
    fn threshold_0_turns_everything() {
        let states = |iterations: i32| {
            trial(50, 20).int("threshold", 0).int("states", 255).int("iterations", iterations)
        };
        assert_eq!(states(255).levels(0), states(0).levels(0));
        assert_eq!(states(999_998).levels(0), states(999_998 % 255).levels(0));
    }
}
