//! The block: what the grid starts from, how long it runs, and how it becomes a picture.
//!
//! The grid has as many cells as the parameter says, whatever the size of the picture, so that a
//! larger picture shows the same pattern; between the middles of cells it is interpolated by cubic
//! B-splines, which hide the cells.

use ptlib_plugin::{Image, Work, prelude::*};

use crate::grid::{Grid, Rate};

choice! {
    /// Rates whose patterns last. ([`GrayScott`] says where they come from.)
    Preset {
        /// The parameters "feed" and "kill".
        Own = "own",
        /// Branches that grow until they fill everything.
        Coral = "coral",
        /// Spots that divide until they fill everything.
        Spots = "spots",
        /// A maze.
        Maze = "maze",
        /// Holes in a plane.
        Holes = "holes",
        /// Rings and bows that grow, break and never come to rest.
        Loops = "loops",
        /// Worms that end, and spots between them.
        Worms = "worms",
    }
}

impl Preset {
    /// Feed and kill.
    ///
    /// Places in the crescent that Pearson found and R. Munafo mapped in steps of 0.004 and 0.002
    /// ("Reaction-Diffusion by the Gray-Scott Model: Pearson's Parametrization"), chosen so that
    /// drops fill the plane within the default steps, and the pattern is still there after five
    /// times as many. Travelling waves (Munafo's class ξ, such as 0.014 and 0.047) are none of
    /// them: waves that meet destroy each other, until nothing is left.
    fn rates(self, own: [f64; 2]) -> [f64; 2] {
        match self {
            Self::Own => own,
            Self::Coral => [0.0545, 0.062],
            Self::Spots => [0.03, 0.062],
            Self::Maze => [0.029, 0.057],
            Self::Holes => [0.039, 0.058],
            Self::Loops => [0.018, 0.051],
            Self::Worms => [0.034, 0.0618],
        }
    }
}

params! {
    /// Parameters of [`GrayScott`].
    Params {
        /// Rates that make well-known patterns.
        preset: choice [Preset] = Preset::Coral;
        /// How fast the first substance is fed, if the preset is "own".
        feed: float [hard 0.0..=0.1 soft 0.01..=0.08] = 0.0545;
        /// How fast the second substance decays, if the preset is "own".
        kill: float [hard 0.0..=0.1 soft 0.03..=0.07] = 0.062;
        /// How many steps of time are computed.
        steps: int [hard 0..=100000 soft 0..=10000] = 4000;
        /// How many cells lie along the width: more make a finer pattern.
        cells: int [hard 8..=2048 soft 64..=512] = 192;
        /// How many drops of the second substance there are at first.
        drops: int [hard 1..=10000 soft 1..=100] = 24;
    }
}

const FEED_MAP: usize = 0;
const KILL_MAP: usize = 1;

/// Cells from the middle of a drop to its edge.
const RADIUS: i64 = 3;

/// Steps between two reports of progress.
const REPORT: i32 = 32;

/// What the second substance is multiplied by to fill 0..1: it rarely exceeds 0.4.
const SCALE: f32 = 2.5;

/// Gray and Scott's reaction, prepared. Its presets are places in the map of J. E. Pearson ("Complex
/// Patterns in a Simple System", Science 261, 1993) and R. Munafo.
#[derive(Debug)]
pub struct GrayScott {
    params: Params,
    seed: u64,
}

impl Block for GrayScott {
    type Params = Params;

    const ABOUT: About = About {
        id: c"reaction-diffusion.gray-scott",
        name: c"Gray-Scott reaction",
        category: c"automaton",
        summary: c"Patterns of two substances that react and spread: corals, spots, mazes.",
        shape: Shape::Whole,
        inputs: &[
            &input(c"feed map", Kind::Image)
                .optional()
                .doc(c"What the feed rate is multiplied by at each place."),
            &input(c"kill map", Kind::Image)
                .optional()
                .doc(c"What the kill rate is multiplied by at each place."),
        ],
        outputs: &[&output(c"pattern", Planes::Grey), &output(c"food", Planes::Grey)],
        uses_seed: true,
        ..About::DEFAULT
    };

    fn prepare(params: &Params, setup: &Setup<'_>) -> Result<Self, BlockError> {
        Ok(Self { params: params.clone(), seed: setup.seed() })
    }

    fn compute(&self, call: &mut Call<'_>) -> Result<(), BlockError> {
        let (width, height) = {
            let out = call.output(0)?;
            (out.width(), out.height())
        };
        let across = self.params.cells.unsigned_abs();
        let down =
            (u64::from(across) * u64::from(height) / u64::from(width.max(1))).clamp(4, 65_536);
        let down = u32::try_from(down).unwrap_or(across);
        let mut grid = Grid::new(across as usize, down as usize);
        self.drop_in(&mut grid);
        let [feed, kill] = self.params.preset.rates([self.params.feed, self.params.kill]);
        let feed = rate(feed, call.optional_image(FEED_MAP), &grid);
        let kill = rate(kill, call.optional_image(KILL_MAP), &grid);
        let work = call.work();
        for step in 0..self.params.steps {
            work.check()?;
            grid.step(&feed, &kill, work)?;
            if step % REPORT == 0 {
                work.report(f64::from(step) / f64::from(self.params.steps));
            }
        }
        show(&grid, &grid.v, SCALE, call.output(0)?, work)?;
        show(&grid, &grid.u, 1.0, call.output(1)?, work)
    }

    fn memory(params: &Params, width: u32, height: u32) -> u64 {
        let across = u64::from(params.cells.unsigned_abs());
        let down = across * u64::from(height) / u64::from(width.max(1)) + 4;
        // Two substances, the next of both, and two rates.
        across * down * 6 * size_of::<f32>() as u64
    }
}

impl GrayScott {
    /// Puts drops of the second substance into the first.
    fn drop_in(&self, grid: &mut Grid) {
        let (width, height) = (grid.width as i64, grid.height as i64);
        for drop in 0..self.params.drops.unsigned_abs() {
            let place = |axis: u32, length: i64| {
                let unit = f64::from(noise::uniform(self.seed, drop, axis, 0));
                wrap_whole(unit * length as f64, length)
            };
            let (middle_x, middle_y) = (place(0, width), place(1, height));
            for y in -RADIUS..=RADIUS {
                for x in -RADIUS..=RADIUS {
                    if x * x + y * y <= RADIUS * RADIUS {
                        let row = (middle_y + y).rem_euclid(height);
                        let column = (middle_x + x).rem_euclid(width);
                        let cell = usize::try_from(row * width + column).unwrap_or_default();
                        (grid.u[cell], grid.v[cell]) = (0.5, 0.5);
                    }
                }
            }
        }
    }
}

#[expect(clippy::cast_possible_truncation, reason = "a place in the grid")]
fn wrap_whole(place: f64, length: i64) -> i64 {
    (place as i64).rem_euclid(length)
}

/// A rate everywhere, or multiplied by a map at the middle of each cell.
fn rate(rate: f64, map: Option<Image<'_>>, grid: &Grid) -> Rate {
    let rate = math::single(rate);
    let Some(map) = map else { return Rate::Everywhere(rate) };
    let pixel = |cell: usize, cells: usize, pixels: u32| {
        (2 * cell as u64 + 1) * u64::from(pixels) / (2 * cells as u64)
    };
    let mut rates = Vec::with_capacity(grid.width * grid.height);
    for y in 0..grid.height {
        let y = u32::try_from(pixel(y, grid.height, map.height())).unwrap_or_default();
        let rows: Vec<&[f32]> = (0..map.channels().min(3)).map(|c| map.row(c, y)).collect();
        for x in 0..grid.width {
            let x = usize::try_from(pixel(x, grid.width, map.width())).unwrap_or_default();
            let sum: f32 = rows.iter().map(|row| row[x]).sum();
            rates.push(rate * sum / rows.len() as f32);
        }
    }
    Rate::Each(rates)
}

/// For a pixel: the first of four cells around it, and their weights.
fn spline(pixel: u32, pixels: u32, cells: usize) -> ([usize; 4], [f32; 4]) {
    let at = (f64::from(pixel) + 0.5) * cells as f64 / f64::from(pixels) - 0.5;
    let first = at.floor();
    let t = math::single(at - first);
    let count = cells as i64;
    let first = wrap_whole(first + cells as f64, count);
    let cell = |i: i64| usize::try_from((first + i - 1).rem_euclid(count)).unwrap_or_default();
    let s = 1.0 - t;
    let weights = [
        s * s * s / 6.0,
        (4.0 - 6.0 * t * t + 3.0 * t * t * t) / 6.0,
        (4.0 - 6.0 * s * s + 3.0 * s * s * s) / 6.0,
        t * t * t / 6.0,
    ];
    ([cell(0), cell(1), cell(2), cell(3)], weights)
}

/// Writes a substance as a picture.
fn show(
    grid: &Grid,
    substance: &[f32],
    scale: f32,
    out: ptlib_plugin::ImageMut<'_>,
    work: Work<'_>,
) -> Result<(), BlockError> {
    let (width, height) = (out.width(), out.height());
    let columns: Vec<_> = (0..width).map(|x| spline(x, width, grid.width)).collect();
    work.for_each(out.rows(), |mut row| {
        let (lines, weights) = spline(row.y, height, grid.height);
        let line: Vec<f32> = (0..grid.width)
            .map(|x| {
                let samples = lines.map(|y| substance[y * grid.width + x]);
                samples[0] * weights[0]
                    + samples[1] * weights[1]
                    + samples[2] * weights[2]
                    + samples[3] * weights[3]
            })
            .collect();
        for (value, (cells, weights)) in row.channels[0].iter_mut().zip(&columns) {
            let sum = line[cells[0]] * weights[0]
                + line[cells[1]] * weights[1]
                + line[cells[2]] * weights[2]
                + line[cells[3]] * weights[3];
            *value = sum * scale;
        }
        Ok(())
    })
}
