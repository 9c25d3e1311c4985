//! Two substances on a torus of cells.
//!
//! One is fed, the other decays, and where both meet the first becomes the second: u + 2v → 3v. A
//! step of time 1 on cells of size 1 is
//!
//! ```text
//! u' = u + 1.0 ∇²u - u v² + feed (1 - u)
//! v' = v + 0.5 ∇²v + u v² - (feed + kill) v
//! ```
//!
//! with ∇² over nine cells: 0.2 for the four nearest, 0.05 for those at the corners, -1 for the cell.

use ptlib_plugin::{BlockError, Work};

/// How fast each substance spreads.
const SPREAD: [f32; 2] = [1.0, 0.5];

/// So little of the second substance is none. What decays never reaches 0 by itself, and processors
/// are slow with the numbers just above.
const NOTHING: f32 = 1e-20;

/// Rows that one task computes at least, so that starting tasks costs little.
const CELLS_OF_A_TASK: usize = 8192;

/// One number for each cell, or one for all.
#[derive(Debug, Clone)]
pub(crate) enum Rate {
    Everywhere(f32),
    Each(Vec<f32>),
}

/// The substances.
#[derive(Debug)]
pub(crate) struct Grid {
    pub(crate) width: usize,
    pub(crate) height: usize,
    pub(crate) u: Vec<f32>,
    pub(crate) v: Vec<f32>,
    next: [Vec<f32>; 2],
}

/// Some rows that are computed together.
struct Band<'a> {
    first: usize,
    u: &'a mut [f32],
    v: &'a mut [f32],
}

impl Grid {
    /// Only the first substance, everywhere.
    pub(crate) fn new(width: usize, height: usize) -> Self {
        let cells = width * height;
        let all = |value: f32| vec![value; cells];
        Self { width, height, u: all(1.0), v: all(0.0), next: [all(0.0), all(0.0)] }
    }

    /// Lets time go on by 1.
    pub(crate) fn step(
        &mut self,
        feed: &Rate,
        kill: &Rate,
        work: Work<'_>,
    ) -> Result<(), BlockError> {
        let Self { width, height, u, v, next: [next_u, next_v] } = self;
        let (width, height) = (*width, *height);
        let rows = (CELLS_OF_A_TASK / width.max(1)).clamp(1, height);
        let bands = next_u.chunks_mut(rows * width).zip(next_v.chunks_mut(rows * width));
        let bands = bands.enumerate().map(|(i, (u, v))| Band { first: i * rows, u, v });
        let (u, v) = (&*u, &*v);
        work.for_each(bands, |band| {
            for (i, (to_u, to_v)) in
                band.u.chunks_mut(width).zip(band.v.chunks_mut(width)).enumerate()
            {
                let y = band.first + i;
                let lines = [(y + height - 1) % height, y, (y + 1) % height];
                let around = [u, v].map(|from| lines.map(|y| &from[y * width..][..width]));
                let rates = [feed, kill].map(|rate| rate.of_row(y, width));
                react_row(around, rates, [to_u, to_v]);
            }
            Ok(())
        })?;
        std::mem::swap(&mut self.u, &mut self.next[0]);
        std::mem::swap(&mut self.v, &mut self.next[1]);
        Ok(())
    }
}

/// The rate of each cell of a row, or that of all.
#[derive(Clone, Copy)]
enum RowRate<'a> {
    Everywhere(f32),
    Each(&'a [f32]),
}

impl Rate {
    fn of_row(&self, y: usize, width: usize) -> RowRate<'_> {
        match self {
            Self::Everywhere(rate) => RowRate::Everywhere(*rate),
            Self::Each(rates) => RowRate::Each(&rates[y * width..][..width]),
        }
    }
}

impl RowRate<'_> {
    #[inline(always)]
    fn at(self, x: usize) -> f32 {
        match self {
            Self::Everywhere(rate) => rate,
            Self::Each(rates) => rates[x],
        }
    }
}

/// Computes a row; `around` has the row above, the row itself and the row below of each substance.
fn react_row(around: [[&[f32]; 3]; 2], rates: [RowRate<'_>; 2], to: [&mut [f32]; 2]) {
    // Without a choice in the loop, so that it is done for several cells at a time.
    match rates {
        [RowRate::Everywhere(feed), RowRate::Everywhere(kill)] => {
            react(around, |_| feed, |_| kill, to);
        }
        [feed, kill] => react(around, |x| feed.at(x), |x| kill.at(x), to),
    }
}

#[inline(always)]
fn react(
    around: [[&[f32]; 3]; 2],
    feed: impl Fn(usize) -> f32,
    kill: impl Fn(usize) -> f32,
    [to_u, to_v]: [&mut [f32]; 2],
) {
    let width = to_u.len();
    let mut cell = |x: usize, left: usize, right: usize| {
        let [du, dv] = around.map(|rows| laplacian(rows, x, left, right));
        let (u, v) = (around[0][1][x], around[1][1][x]);
        let (feed, kill) = (feed(x), kill(x));
        let reaction = u * v * v;
        to_u[x] = u + SPREAD[0] * du - reaction + feed * (1.0 - u);
        let next = v + SPREAD[1] * dv + reaction - (feed + kill) * v;
        to_v[x] = if next > NOTHING { next } else { 0.0 };
    };
    cell(0, width - 1, 1 % width);
    for x in 1..width.saturating_sub(1) {
        cell(x, x - 1, x + 1);
    }
    if width > 1 {
        cell(width - 1, width - 2, 0);
    }
}

#[inline(always)]
fn laplacian([above, own, below]: [&[f32]; 3], x: usize, left: usize, right: usize) -> f32 {
    let near = above[x] + below[x] + own[left] + own[right];
    let corners = above[left] + above[right] + below[left] + below[right];
    near * 0.2 + corners * 0.05 - own[x]
}
