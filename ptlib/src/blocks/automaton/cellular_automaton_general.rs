//! A cellular automaton with any rules over the eight cells around a cell, such as the game of
//! life.
//!
//! Specification 2.23. Cells are alive (dark) or dead, more and more so with time (up to white).
//! Which of the eight neighbours are alive is a number 0..255; the rule of that number says what
//! becomes of a cell. All cells change at once.

// Pictured with `bump noise`: `bump size from` `0.01`.
// Pictured: `rules` `0,1,1,0,1,0,0,0,1,0,0,0,0,0,0,0,1`.
// Pictured: `iterations` `30`, `rules` `0,1,1,2,0,0,0,0,1,0,0,0,0,0,0,0,1`, `states` `12`.

use crate::block::prelude::*;
use cells::{Grid, Rule, SIDE, value_of_state};

const IMAGE: usize = 0;

/// Cells look at those beside them.
const MARGIN: usize = 1;

params! {
    /// Parameters of [`BLOCK`].
    Params {
        /// How many times all cells change. 0 shows the states of the picture.
        iterations: int [hard 0..=999999 soft 0..=200] = 20;
        /// What happens for each set of living neighbours: 256 numbers separated by commas, 0 for
        /// nothing, 1 for birth, any other for death and ageing. Missing ones are 0. The place of a
        /// number in the list is the sum over the living neighbours: above left 1, above 2, above
        /// right 4, left 8, right 16, below left 32, below 64, below right 128.
        rules: text = "";
        /// How many states a cell has: alive, and dead of several ages.
        states: int [hard 2..=255 soft 2..=32] = 2;
    }
}

/// The block as everybody else sees it.
pub static BLOCK: BlockSpec = BlockSpec::whole::<CellularAutomatonGeneral>(About {
    id: "cellular automaton general",
    summary: "Cells that live and die as 256 rules say, for each set of living neighbours.",
    inputs: &[input("image", Kind::Image)],
    outputs: &[output("image", Planes::Grey)],
    in_pixels: "the cells, and how far a pattern grows in an iteration",
    ..About::DEFAULT
});

struct CellularAutomatonGeneral;

impl WholeBlock for CellularAutomatonGeneral {
    type Params = Params;

    fn compute<L: Levels>(params: &Params, cx: &WholeContext<'_>) -> Result<Vec<Value>, Error> {
        let states = convert::clamped_byte(params.states);
        let grid = cx.states_of::<L>(cx.image(IMAGE)?, states, MARGIN)?;
        // BUG of the specification, fixed: missing rules are 0.
        let mut rules = [0; 256];
        for (rule, number) in rules.iter_mut().zip(byte_list::parse(&params.rules)) {
            *rule = number;
        }
        let life = Life { rules, oldest: states - 1, around: around(&grid) };
        let iterations = params.iterations.unsigned_abs();
        let grid = cx.evolve(grid, iterations, |old, new| cx.generation(old, new, &life))?;
        let picture = cx.picture_of(&grid, |state| value_of_state::<L>(state, states))?;
        Ok(vec![Value::Image(picture)])
    }

    fn scratch_bytes(_: &Params, width: u32, height: u32) -> u64 {
        3 * Grid::bytes(width, height, MARGIN)
    }
}

/// The eight neighbours, in the order of their bits.
fn around(grid: &Grid) -> [isize; 8] {
    [(-1, -1), (0, -1), (1, -1), (-1, 0), (1, 0), (-1, 1), (0, 1), (1, 1)]
        .map(|(dx, dy)| grid.offset(dx, dy))
}

struct Life {
    rules: [u8; 256],
    oldest: u8,
    /// Offsets of the neighbours, by bit.
    around: [isize; 8],
}

impl Rule for Life {
    #[inline(always)]
    fn side(&self, grid: &Grid, x: usize, y: usize) -> [u8; SIDE] {
        let place = grid.place(x, y);
        let mut sets = [0_u8; SIDE];
        for (bit, offset) in self.around.into_iter().enumerate() {
            let neighbours = grid.side(place, offset);
            for (set, neighbour) in sets.iter_mut().zip(neighbours) {
                *set |= u8::from(*neighbour == 0) << bit;
            }
        }
        let mut rules = sets;
        for rule in &mut rules {
            *rule = self.rules[usize::from(*rule)];
        }
        let mut cells = *grid.side(place, 0);
        for (cell, rule) in cells.iter_mut().zip(rules) {
            // Dead cells go on ageing (Q).
            let older = if *cell < self.oldest { *cell + 1 } else { self.oldest };
            let changed = if rule == 1 { 0 } else { older };
            *cell = if rule == 0 { *cell } else { changed };
        }
        cells
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::block::testing::{Trial, image_of_levels};

    /// Rules by the number of living neighbours.
    fn by_count(rule: impl Fn(u32) -> i32) -> String {
        (0..256_u32).map(|set| format!("{},", rule(set.count_ones()))).collect()
    }

    fn life() -> String {
        by_count(|alive| match alive {
            2 => 0,
            3 => 1,
            _ => -1,
        })
    }

    fn trial(width: u32, levels: &[u8], rules: &str, states: i32, iterations: i32) -> Trial {
        let height = u32::try_from(levels.len()).unwrap() / width;
        Trial::of(&BLOCK)
            .size(width, height)
            .input(IMAGE, image_of_levels(width, &[levels]))
            .text("rules", rules)
            .int("states", states)
            .int("iterations", iterations)
    }

    /// Black where there is a `#`.
    fn drawn(rows: &[&str]) -> Vec<u8> {
        let cells = rows.iter().flat_map(|row| row.bytes());
        cells.map(|cell| if cell == b'#' { 0 } else { 255 }).collect()
    }

    #[test]
    fn a_glider_glides_and_comes_back() {
        let start = drawn(&[".#....", "..#...", "###...", "......", "......", "......"]);
        let moved = drawn(&["......", "..#...", "...#..", ".###..", "......", "......"]);
        assert_eq!(trial(6, &start, &life(), 2, 4).levels(0), moved);
        assert_eq!(trial(6, &start, &life(), 2, 24).levels(0), start);
        assert_eq!(trial(6, &start, &life(), 2, 24 * 40_000 + 4).levels(0), moved);
        trial(6, &start, &life(), 2, 13).assert_same_bits();
    }

    #[test]
    fn dead_cells_age_and_rules_that_are_missing_keep() {
        // A lone living cell among dead ones of the middle age.
        let mut lone = [128; 16];
        lone[5] = 0;
        let kept = trial(4, &lone, "", 5, 3).levels(0);
        assert_eq!((kept[5], kept[0]), (0, 127));
        let ageing = by_count(|_| 2);
        let aged = |iterations| trial(4, &lone, &ageing, 5, iterations).levels(0);
        assert_eq!((aged(1)[5], aged(1)[0]), (63, 191));
        assert_eq!((aged(3)[5], aged(3)[0]), (191, 255));
        assert_eq!(aged(999_999), [255; 16]);
    }

    #[test]
    fn each_neighbour_has_its_bit() {
        let steps = [(-1, -1), (0, -1), (1, -1), (-1, 0), (1, 0), (-1, 1), (0, 1), (1, 1)];
        for (bit, (dx, dy)) in steps.into_iter().enumerate() {
            // Born exactly where the only living neighbour is the one of that bit.
            let rules: String =
                (0..256).map(|set| if set == 1 << bit { "1," } else { "3," }).collect();
            let mut start = [255_u8; 63];
            start[0] = 0;
            let born = trial(9, &start, &rules, 2, 1).levels(0);
            let place = convert::wrap(-dy, 7) * 9 + convert::wrap(-dx, 9);
            let expected: Vec<u8> = (0..63).map(|i| if i == place { 0 } else { 255 }).collect();
            assert_eq!(born, expected, "bit {bit}");
        }
    }

    #[test]
    fn pictures_smaller_than_a_neighbourhood_wrap() {
        for (width, height) in [(1, 1), (1, 5), (2, 1), (3, 2)] {
            let levels = vec![0; width as usize * height];
            let crowd = by_count(|alive| if alive == 8 { -1 } else { 0 });
            let dead = trial(width, &levels, &crowd, 3, 1).levels(0);
            assert_eq!(dead, vec![127; levels.len()]);
        }
    }
}
