//! A cellular automaton that plays rock, paper, scissors.
//!
//! Specification 2.21. In each iteration each cell draws one of its neighbours (appendix A: one
//! number for each cell and iteration). If the cell is empty, the neighbour spreads to it, but not
//! more than nine cells far from where it last won; else the two fight, and the cell may become
//! what the neighbour is. Cells of the same state do not fight. All cells change at once.
//!
//! A cell's state and how far it has spread make one byte, and what becomes of any two of them is
//! a table.

use super::neighbourhood::{MAX_SIZE, Neighbourhood};
use crate::block::prelude::*;
use cells::{Grid, Rule, SIDE, value_of_state};

const IMAGE: usize = 0;

/// Distances 0..=9 from where a state last won.
const DISTANCES: u8 = 10;

/// Every so many iterations, a look whether anything can change any more.
const LOOK_EVERY: u32 = 32;

params! {
    /// Parameters of [`BLOCK`].
    Params {
        /// How many times all cells play. 0 shows the states of the picture.
        iterations: int [hard 0..=999999 soft 0..=100] = 50;
        /// Which cells are neighbours.
        neighbourhood: choice [Neighbourhood] = Neighbourhood::Moore;
        /// How far neighbours are away at most. 0 leaves a cell without neighbours.
        size "neighbourhood size": int [hard 0..=10 soft 1..=10 unit "px"] = 5;
        /// How many states play against each other. One more state, the lightest, is empty.
        players: int [hard 0..=25 soft 1..=25] = 3;
    }
}

/// The block as everybody else sees it.
pub static BLOCK: BlockSpec = BlockSpec::whole::<CellularAutomatonRps>(About {
    id: "cellular automaton rps",
    summary: "Cells that play rock, paper, scissors with random neighbours.",
    inputs: &[input("image", Kind::Image)],
    outputs: &[output("image", Planes::Grey)],
    uses_seed: true,
    in_pixels: "the neighbourhood, and how far a pattern grows in an iteration",
    ..About::DEFAULT
});

struct CellularAutomatonRps;

impl WholeBlock for CellularAutomatonRps {
    type Params = Params;

    fn compute<L: Levels>(params: &Params, cx: &WholeContext<'_>) -> Result<Vec<Value>, Error> {
        let players = convert::clamped_byte(params.players);
        let mut grid = cx.states_of::<L>(cx.image(IMAGE)?, players + 1, margin(params))?;
        // From states to states with distance 0: the empty one has no distance, and is the last.
        grid = grid.map(|state| state * DISTANCES);
        let steps = params.neighbourhood.steps(params.size);
        let mut game = Game {
            cells: usize::from(players * DISTANCES) + 1,
            outcomes: outcomes(players),
            offsets: steps.map(|(dx, dy)| grid.offset(dx, dy)).collect(),
            first: cx.seed32(),
            width: cx.width,
        };
        let iterations = params.iterations.unsigned_abs();
        let mut next = grid.clone();
        for i in 0..iterations {
            if i % LOOK_EVERY == 0 && game.is_over(&grid, cx.height) {
                break;
            }
            cx.generation(&grid, &mut next, &game)?;
            std::mem::swap(&mut grid, &mut next);
            let draws = u64::from(cx.width) * u64::from(cx.height);
            game.first = game.first.wrapping_add(convert::low_bits(draws));
            cx.report(f64::from(i) / f64::from(iterations));
            cx.check()?;
        }
        let value = |cell| value_of_state::<L>(cell / DISTANCES, players + 1);
        Ok(vec![Value::Image(cx.picture_of(&grid, value)?)])
    }

    fn scratch_bytes(params: &Params, width: u32, height: u32) -> u64 {
        2 * Grid::bytes(width, height, margin(params))
    }
}

fn margin(params: &Params) -> usize {
    convert::index(params.size.into()).min(MAX_SIZE)
}

struct Game {
    /// How many different cells there are.
    cells: usize,
    /// For each cell and neighbour, what the cell becomes.
    outcomes: Vec<u8>,
    /// Offsets of the neighbours, in the order in which they are numbered.
    offsets: Vec<isize>,
    /// The index of the iteration's first draw.
    first: i32,
    width: u32,
}

impl Rule for Game {
    #[inline(always)]
    fn side(&self, grid: &Grid, x: usize, y: usize) -> [u8; SIDE] {
        let place = grid.place(x, y);
        let mut cells = *grid.side(place, 0);
        let Some(last) = self.offsets.len().checked_sub(1) else { return cells };
        let last = u16::try_from(last).unwrap_or(u16::MAX);
        let pixel = y as u64 * u64::from(self.width) + x as u64;
        let mut index = self.first.wrapping_add(convert::low_bits(pixel));
        let mut drawn = [0; SIDE];
        for number in &mut drawn {
            *number = elias::integer(index, last);
            index = index.wrapping_add(1);
        }
        for (i, (cell, number)) in cells.iter_mut().zip(drawn).enumerate() {
            let offset = self.offsets[convert::index(number.into())];
            let neighbour = grid.cells()[(place + i).wrapping_add_signed(offset)];
            *cell = self.outcomes[usize::from(*cell) * self.cells + usize::from(neighbour)];
        }
        cells
    }
}

impl Game {
    /// Whether no two cells of a grid can change each other, wherever they are.
    fn is_over(&self, grid: &Grid, height: u32) -> bool {
        let mut is_there = [false; 256];
        for cell in (0..height as usize).flat_map(|y| grid.row(y)) {
            is_there[usize::from(*cell)] = true;
        }
        let there: Vec<u8> = (0..=255).filter(|cell| is_there[usize::from(*cell)]).collect();
        there.iter().all(|cell| {
            let outcomes = &self.outcomes[usize::from(*cell) * self.cells..];
            there.iter().all(|neighbour| outcomes[usize::from(*neighbour)] == *cell)
        })
    }
}

/// What each cell becomes beside each neighbour, cell by cell.
fn outcomes(players: u8) -> Vec<u8> {
    let empty = players * DISTANCES;
    let outcome = |cell: u8, neighbour: u8| {
        if neighbour == empty {
            return cell;
        }
        if cell == empty {
            let is_far = neighbour % DISTANCES == DISTANCES - 1;
            return if is_far { empty } else { neighbour + 1 };
        }
        let (own, other) = (cell / DISTANCES, neighbour / DISTANCES);
        let higher_wins = own.abs_diff(other) > players / 2;
        let winner = if higher_wins { own.max(other) } else { own.min(other) };
        // The distance of a winner starts anew (Q).
        if own != other && winner == other { other * DISTANCES } else { cell }
    };
    let pairs = (0..=empty).flat_map(|cell| (0..=empty).map(move |neighbour| (cell, neighbour)));
    pairs.map(|(cell, neighbour)| outcome(cell, neighbour)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::block::testing::{Trial, image_of_levels};

    fn picture(width: u32, height: u32) -> Vec<u8> {
        (0..width * height).map(|i| (i * i * 7 / 3).to_le_bytes()[0] | 1).collect()
    }

    fn trial(width: u32, height: u32) -> Trial {
        let levels = picture(width, height);
        Trial::of(&BLOCK).size(width, height).input(IMAGE, image_of_levels(width, &[&levels]))
    }

    /// A cell as the specification describes it.
    #[derive(Clone, Copy, PartialEq)]
    struct Cell {
        state: u32,
        level: u32,
    }

    /// The levels that a plain reading of the specification gives.
    fn naive(
        (width, height): (u32, u32),
        (shape, size): (Neighbourhood, i32),
        players: u32,
        (seed, iterations): (i32, i32),
    ) -> Vec<u8> {
        let state = |level: &u8| {
            let luma = f64::from(*level) * 0.229 + f64::from(*level) * 0.587;
            let luma = convert::truncate64(luma + f64::from(*level) * 0.114);
            (u32::try_from(luma).unwrap() * (players + 1)).div_ceil(255).max(1) - 1
        };
        let start = picture(width, height);
        let mut cells: Vec<Cell> =
            start.iter().map(|level| Cell { state: state(level), level: 0 }).collect();
        let steps: Vec<_> = shape.steps(size).collect();
        let mut draws = elias::Draws::from_index(seed);
        for _ in 0..iterations {
            let mut next = cells.clone();
            for (i, next) in (0..).zip(&mut next) {
                let drawn = draws.next_integer(0, steps.len() as i64 - 1);
                let (dx, dy) = steps[convert::index(drawn)];
                let x = convert::wrap(i64::from(i % width) + dx as i64, width);
                let y = convert::wrap(i64::from(i / width) + dy as i64, height);
                let (own, other) = (cells[i as usize], cells[(y * width + x) as usize]);
                if own.state == players {
                    if other.state != players && other.level < 9 {
                        *next = Cell { level: other.level + 1, ..other };
                    }
                } else if other.state != players && other.state != own.state {
                    let higher_wins = own.state.abs_diff(other.state) > players / 2;
                    if (other.state > own.state) == higher_wins {
                        *next = Cell { level: 0, ..other };
                    }
                }
            }
            cells = next;
        }
        let level = |cell: &Cell| (cell.state * 255 / players).to_le_bytes()[0];
        cells.iter().map(level).collect()
    }

    #[test]
    fn plays_as_a_plain_reading_does() {
        for (shape, number) in [(Neighbourhood::Moore, 0), (Neighbourhood::VonNeumann, 1)] {
            for (size, players, seed) in [(1, 1, 0), (5, 3, 7), (2, 4, -9), (10, 25, 3)] {
                for (width, height) in [(70, 9), (7, 3), (64, 20), (1, 1)] {
                    let trial = trial(width, height)
                        .seed(i64::from(seed).cast_unsigned())
                        .choice("neighbourhood", number)
                        .int("neighbourhood size", size)
                        .int("players", players)
                        .int("iterations", 30);
                    let players = players.unsigned_abs();
                    let expected = naive((width, height), (shape, size), players, (seed, 30));
                    assert_eq!(trial.levels(0), expected, "{shape:?} {size} in {width}×{height}");
                    trial.assert_same_bits();
                }
            }
        }
    }

    #[test]
    fn states_spread_nine_cells_far() {
        // One cell of state 0 in an empty picture.
        let mut levels = [255; 41 * 41];
        levels[20 * 41 + 20] = 0;
        let trial = Trial::of(&BLOCK)
            .size(41, 41)
            .input(IMAGE, image_of_levels(41, &[&levels]))
            .int("neighbourhood size", 1)
            .int("iterations", 2000);
        let grown = trial.levels(0);
        let black = |x: usize, y: usize| grown[y * 41 + x] == 0;
        assert!(grown.iter().filter(|level| **level == 0).count() > 7 * 7);
        for (x, y) in (0..41).flat_map(|y| (0..41).map(move |x| (x, y))) {
            let distance = x.max(40 - x).max(y).max(40 - y) - 20;
            assert!(distance <= 9 || !black(x, y), "{x},{y}");
        }
    }

    #[test]
    fn a_game_that_is_over_ends() {
        // Small enough that one state wins soon; a million iterations would take minutes.
        let end = trial(12, 9).int("iterations", 999_999).levels(0);
        assert!(end.iter().all(|level| *level == end[0]));
        let alone = trial(12, 9).int("neighbourhood size", 0).int("iterations", 40);
        assert_eq!(alone.levels(0), trial(12, 9).int("iterations", 0).levels(0));
        assert_eq!(trial(12, 9).int("players", 0).levels(0), [0; 108]);
    }
}
