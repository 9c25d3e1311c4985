//! Bands of raised ground, and a row of the steps that they make.
//!
//! A band across the rows says directly which pixels of a row are inside. A band across the columns
//! has borders that only rise, or only fall, towards the middle of the image, so its pixels in a
//! row lie between two columns, which are found by inverting the straight lines, and between their
//! mirror images. The row then is a sum of steps.

use crate::block::prelude::*;

/// By how many levels a band raises the ground.
const RISE: f32 = 3.0;

/// Pixels that are summed up together.
pub(in crate::blocks::noise) const PIECE: usize = 1024;

/// A band of a picture whose *lines* it crosses one after the other; *places* are along a line.
pub(in crate::blocks::noise) struct Band {
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
pub(in crate::blocks::noise) struct Steps {
    /// The column of the first pixel, and the columns of the picture.
    first: i64,
    width: i64,
    count: i64,
    steps: [i16; PIECE],
}

impl Band {
    /// The band that comes next in the draws (specification, appendix A).
    pub(in crate::blocks::noise) fn draw(
        draws: &mut elias::Draws,
        lines: i64,
        places: i64,
        lines_are_rows: bool,
    ) -> Self {
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
    pub(in crate::blocks::noise) fn add_line(&self, line: i64, steps: &mut Steps) {
        let line = (line - self.line_shift).rem_euclid(self.lines);
        let line = line.min(self.lines - line);
        let [from, to] = self.borders.map(|border| border.place(line, self.middle()));
        // Q: place 0 is never inside.
        steps.add(from.max(1), to, self.place_shift);
    }

    /// Adds what is inside in a row that is place `place` of each line.
    pub(in crate::blocks::noise) fn add_place(&self, place: i64, steps: &mut Steps) {
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
    /// Level ground: `count` pixels from column `first` on, of a picture of `width` columns.
    pub(in crate::blocks::noise) fn new(first: i64, count: usize, width: u32) -> Self {
        Self { first, width: i64::from(width), count: count as i64, steps: [0; PIECE] }
    }

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
    pub(in crate::blocks::noise) fn sum(&self, out: &mut [f32]) {
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
