//! Fault formation: two hundred bands with straight, slanted borders, each raising the ground a
//! little.
//!
//! Specification 2.4. A band's borders run straight to the middle of the image and back, so it
//! tiles; then the whole band is shifted around the edges. Half of the bands cross the rows, the
//! others the columns.
//!
//! PT Designer adds band after band to the image. Here a row asks each band which of its pixels
//! are inside: a band across the rows says so directly. A band across the columns has borders that
//! only rise, or only fall, towards the middle, so those pixels lie between two columns, which are
//! found by inverting the straight line, and between their mirror images. The row then is a sum of
//! steps. As no band lowers the ground, saturating once is the same as saturating after each band.

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

/// By how many levels a band raises the ground.
const RISE: f32 = 3.0;

/// Pixels that are summed up together.
const PIECE: usize = 1024;

struct FaultFormation {
    /// Their lines are rows.
    across_rows: Vec<Band>,
    /// Their lines are columns.
    across_columns: Vec<Band>,
}

/// A band of a picture whose *lines* it crosses one after the other; *places* are along a line.
struct Band {
    /// The first place inside and the first one behind.
    borders: [Border; 2],
    /// Lines and places in the picture.
    lines: i64,
    places: i64,
    /// By how much the picture is shifted afterwards, around its edges.
    line_shift: i64,
    place_shift: i64,
}

/// A border runs straight from line 0 to the middle line.
#[derive(Clone, Copy)]
struct Border {
    /// Its place in line 0.
    start: f64,
    /// By how much its place in the middle line is further.
    slant: f64,
}

/// A part of a row as the changes from pixel to pixel.
struct Steps {
    /// The column of the first pixel, and the columns of the picture.
    first: i64,
    width: i64,
    count: i64,
    steps: [i16; PIECE],
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
    fn row<L: Levels>(&self, cx: &RowContext, _: &InputRows<'_>, out: &mut OutputRow<'_>) {
        let mut first = i64::from(cx.x);
        for piece in out.grey().chunks_mut(PIECE) {
            let (width, count) = (i64::from(cx.width), piece.len() as i64);
            let mut steps = Steps { first, width, count, steps: [0; PIECE] };
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

impl Band {
    fn draw(draws: &mut elias::Draws, lines: i64, places: i64, lines_are_rows: bool) -> Self {
        let mut pair = || {
            let near = draws.next_integer(0, places);
            [near, draws.next_integer(near, places)]
        };
        let (starts, ends) = (pair(), pair());
        let border = |i: usize| {
            let [start, end] = [starts[i], ends[i]].map(whole);
            Border { start, slant: end - start }
        };
        let borders = [border(0), border(1)];
        let (place_shift, line_shift) = if lines_are_rows {
            (draws.next_integer(0, places), draws.next_integer(0, lines))
        } else {
            let line_shift = draws.next_integer(0, lines);
            (draws.next_integer(0, places), line_shift)
        };
        Self { borders, lines, places, line_shift, place_shift }
    }

    /// The middle line; those behind it are mirrored.
    fn middle(&self) -> i64 {
        self.lines / 2
    }

    /// Adds what is inside in a row that is line `line`.
    fn add_line(&self, line: i64, steps: &mut Steps) {
        let line = (line - self.line_shift).rem_euclid(self.lines);
        let line = line.min(self.lines - line);
        let [from, to] = self.borders.map(|border| border.place(line, self.middle()));
        // Q: place 0 is never inside.
        steps.add(from.max(1), to, self.place_shift);
    }

    /// Adds what is inside in a row that is place `place` of each line.
    fn add_place(&self, place: i64, steps: &mut Steps) {
        let place = (place - self.place_shift).rem_euclid(self.places);
        if place == 0 {
            return;
        }
        let (mut from, mut to) = (0, self.middle() + 1);
        for (border, begins) in self.borders.into_iter().zip([true, false]) {
            let passed = border.passes(place, self.middle());
            // A rising border begins the band in the lines before, ends it in those behind.
            if begins == (border.slant >= 0.0) {
                to = to.min(passed);
            } else {
                from = from.max(passed);
            }
        }
        steps.add(from, to, self.line_shift);
        let mirrored_from = (self.lines - to + 1).max(self.middle() + 1);
        steps.add(mirrored_from, (self.lines - from + 1).min(self.lines), self.line_shift);
    }
}

impl Border {
    /// Where it is in a line from 0 to the middle one.
    fn place(self, line: i64, middle: i64) -> i64 {
        let share = whole(line) / whole(middle.max(1));
        convert::truncate64(self.start + self.slant * share)
    }

    /// The first line in which it is on the other side of the pixel at `place` than before; the
    /// line behind the middle if there is none.
    fn passes(self, place: i64, middle: i64) -> i64 {
        let has_passed = |line| (self.place(line, middle) > place) == (self.slant >= 0.0);
        let share = (whole(place + 1) - self.start) / self.slant;
        // Off by a line at most, as the place is rounded.
        let mut line = convert::truncate64(share * whole(middle)).clamp(0, middle + 1);
        while line > 0 && has_passed(line - 1) {
            line -= 1;
        }
        while line <= middle && !has_passed(line) {
            line += 1;
        }
        line
    }
}

impl Steps {
    /// Raises columns `from`..`to` of the picture that is then shifted around its edges.
    fn add(&mut self, from: i64, to: i64, shift: i64) {
        if from < to {
            let start = (from + shift).rem_euclid(self.width);
            let end = start + to - from;
            self.add_here(start, end.min(self.width));
            self.add_here(0, end - self.width);
        }
    }

    fn add_here(&mut self, from: i64, to: i64) {
        let (from, to) = ((from - self.first).max(0), (to - self.first).min(self.count));
        if from < to {
            self.steps[convert::index(from)] += 1;
            if let Some(step) = self.steps.get_mut(convert::index(to)) {
                *step -= 1;
            }
        }
    }

    /// The heights.
    #[inline(always)]
    fn sum(&self, out: &mut [f32]) {
        let mut height = 0;
        for (out, step) in out.iter_mut().zip(&self.steps) {
            height += i32::from(*step);
            *out = levels::from_level((convert::level(height) * RISE).min(255.0));
        }
    }
}

/// A place as a number, exactly.
fn whole(place: i64) -> f64 {
    #[expect(clippy::cast_precision_loss, reason = "places are far below 2⁵²")]
    let place = place as f64;
    place
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
                let between = |a: i64, b: i64| {
                    convert::truncate64(a as f64 + (b - a) as f64 * t)
                };
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
            let trial = Trial::of(&BLOCK)
                .size(width, height)
                .seed(u64::from(i32::cast_unsigned(seed)));
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
