//! The rings of wood, as a pixel sees them.
//!
//! All pixels of the frame around the image that come to the same place are pushed alike, as the
//! noise tiles. So a pixel is the darkest of the rings around copies of the middle, one copy in
//! each repetition of the image. In a square image only the nearest copy reaches it; in others
//! those that may are tried in turn.
//!
//! A ring is a power of a sine, and the darkest has the largest sine: the power is taken once.
//! In 8-bit precision pixels are pushed by whole ones, as PT Designer does. Sines and powers are
//! in single precision there, too; where truncation is near to a level it is done again in double.

use std::f64::consts::PI;

use super::{grain, wood::Params};
use crate::block::prelude::*;

/// Pixels that are computed side by side.
pub(super) const PIECE: usize = 64;

pub(super) struct Rings {
    /// How far white pushes, and how wide the frame is, in pixels.
    push: f64,
    /// The radius of the outermost ring.
    radius: f64,
    middle: [f64; 2],
    size: [f64; 2],
    /// How many copies of the middle may reach a pixel to each side besides the nearest one.
    copies: [i64; 2],
    direction: [f64; 2],
    circles: f64,
    hardness: f32,
    amplitude: f32,
}

/// Where the rings are for some pixels, across and down.
struct Pushed {
    /// The middle of the rings.
    middle: [[f64; PIECE]; 2],
    /// The distance to its nearest copy.
    nearest: [[f64; PIECE]; 2],
}

impl Rings {
    pub(super) fn new<L: Levels>(params: &Params, width: u32, height: u32) -> Self {
        let size = [width, height].map(f64::from);
        let pixels = |length: f64| if L::EIGHT_BIT { length.floor() } else { length };
        let push = pixels(size[0] / 100.0 * f64::from(params.intensity));
        let radius = pixels(size[0].max(size[1]) / 2.0);
        let (right, down) = params.direction.step();
        // A copy further away does not reach the pixel, or is not in the frame.
        let copies = size.map(|size| {
            let by_radius = (radius + size / 2.0) / size;
            convert::truncate64(by_radius.min(2.0 * push / size + 3.0).ceil()) - 1
        });
        Self {
            push,
            radius,
            middle: size.map(|size| pixels(size / 2.0)),
            size,
            copies,
            direction: [right, down].map(|step| f64::from(convert::distance(step))),
            circles: f64::from(params.circles),
            hardness: convert::level(params.hardness.max(1)),
            amplitude: convert::level(params.amplitude),
        }
    }

    /// Whether no noise pushes the rings.
    pub(super) fn are_round(&self) -> bool {
        self.push == 0.0
    }

    /// Turns noise into rings, from (`x`, `y`) on.
    #[inline(always)]
    pub(super) fn draw<L: Levels>(&self, x: u32, y: u32, piece: &mut [f32]) {
        let pushed = self.push::<L>(x, y, piece);
        piece.fill(0.0);
        for copy in self.all_copies() {
            let mut squares = [0.0; PIECE];
            let mut any = false;
            for (i, square) in squares.iter_mut().enumerate() {
                *square = self.square(&pushed, copy, i);
                any |= *square >= 0.0;
            }
            if any {
                self.darken(&squares, piece);
            }
        }
        for level in piece.iter_mut() {
            *level = self.amplitude * elementary::power(*level, self.hardness);
        }
        if L::EIGHT_BIT {
            // More than the error of a square of a sine, grown by the power.
            let near = 1e-3 + 2e-6 * self.amplitude * self.hardness;
            grain::truncate(piece, near, |i| self.exact(&pushed, i));
        }
        for level in piece {
            *level = 1.0 - levels::from_level(*level);
        }
    }

    /// Where the noise of some pixels pushes the rings.
    #[inline(always)]
    fn push<L: Levels>(&self, x: u32, y: u32, noise: &[f32]) -> Pushed {
        let mut pushed = Pushed { middle: [[0.0; PIECE]; 2], nearest: [[0.0; PIECE]; 2] };
        let mut offsets = [0.0; PIECE];
        for (offset, noise) in offsets.iter_mut().zip(noise) {
            let level = f64::from(*noise * 255.0);
            *offset = if L::EIGHT_BIT {
                (self.push * (level + 0.5).floor() / 255.0).trunc()
            } else {
                self.push * level / 255.0
            };
        }
        let first = [f64::from(x), f64::from(y)];
        for axis in [0, 1] {
            let (size, step) = (self.size[axis], if axis == 0 { 1.0 } else { 0.0 });
            let of_pixels =
                pushed.middle[axis].iter_mut().zip(&mut pushed.nearest[axis]).zip(&offsets);
            for (i, ((middle, nearest), offset)) in (0_u8..).zip(of_pixels) {
                *middle = self.middle[axis] + self.direction[axis] * offset;
                let distance = *middle - (first[axis] + f64::from(i) * step);
                *nearest = distance - ((distance + size / 2.0) / size).floor() * size;
            }
        }
        pushed
    }

    /// The copies of the middle that may reach a pixel, counted from the nearest one.
    #[inline(always)]
    fn all_copies(&self) -> impl Iterator<Item = [f64; 2]> {
        let [across, down] = self.copies;
        let count = |copies: i64| (-copies..=copies).map(|i| f64::from(convert::distance(i)));
        count(down).flat_map(move |down| count(across).map(move |across| [across, down]))
    }

    /// The square of the distance from pixel `i` to a copy of the middle; negative if the copy's
    /// rings are too small or outside of the frame there.
    #[inline(always)]
    fn square(&self, pushed: &Pushed, copy: [f64; 2], i: usize) -> f64 {
        let mut square = 0.0;
        let mut is_in_frame = true;
        for axis in [0, 1] {
            let distance = pushed.nearest[axis][i] + copy[axis] * self.size[axis];
            let place = pushed.middle[axis][i] - distance;
            is_in_frame &= (place >= -self.push) & (place < self.size[axis] + self.push);
            square += distance * distance;
        }
        // On the outermost circle itself the sine is 0.
        if is_in_frame & (square < self.radius * self.radius) { square } else { -1.0 }
    }

    /// Raises squares of sines to those at these distances.
    #[inline(always)]
    fn darken(&self, squares: &[f64; PIECE], sines: &mut [f32]) {
        let turns_per_pixel = 0.5 * self.circles / self.radius;
        for (highest, square) in sines.iter_mut().zip(squares) {
            let turns = square.max(0.0).sqrt() * turns_per_pixel;
            let sine = elementary::sin_turns(convert::single(turns - turns.floor()));
            let sine = if *square < 0.0 { 0.0 } else { sine * sine };
            *highest = if sine > *highest { sine } else { *highest };
        }
    }

    /// By how many levels pixel `i` is darkened, in double precision and the order of operations
    /// of the specification.
    fn exact(&self, pushed: &Pushed, i: usize) -> f64 {
        let of_copy = |copy| {
            let square = self.square(pushed, copy, i);
            let sine = elementary::sin64(PI * self.circles * square.sqrt() / self.radius);
            let power = elementary::power64(sine, 2.0 * f64::from(self.hardness));
            if square < 0.0 { 0.0 } else { f64::from(self.amplitude) * power }
        };
        self.all_copies().map(of_copy).fold(0.0, f64::max)
    }
}
