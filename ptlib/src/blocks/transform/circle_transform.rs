//! Pixels taken from circles around them, each in the direction that its grey level says.
//!
//! Specification 2.19 and 2.0 (JUMP). A jump goes from a pixel to one on a circle around it; its
//! grey level is the angle. With several jumps, each starts where the last one ended.
//!
//! Where a jump ends between pixels, PT Designer truncates toward zero, and it does not wrap
//! positions between jumps. So paths left of column 0 or above row 0 are rounded to the other
//! side than all others, and pictures of many jumps have a seam there; the texture `waves` (20
//! jumps) comes out right only this way. In 8-bit precision that is kept. In float precision all
//! positions are rounded down, and the result tiles.

// Pictured: `radius` `3`, `jumps` `4`.
// Pictured: `radius` `15`.

use std::f64::consts::PI;

use crate::block::prelude::*;

const IMAGE: usize = 0;

params! {
    /// Parameters of [`BLOCK`].
    Params {
        /// The radius of the circles.
        radius: int [hard 0..=100 soft 0..=50 unit "% of the width"] = 5;
        /// How many times a pixel jumps. 0 gives plain white.
        jumps: int [hard 0..=1000 soft 0..=100] = 1;
    }
}

/// The block as everybody else sees it.
pub static BLOCK: BlockSpec = BlockSpec::gather::<CircleTransform>(About {
    id: "circle transform",
    summary: "Takes each pixel from a circle around it, at the angle that its grey level says.",
    inputs: &[input("image", Kind::Image).anywhere()],
    outputs: &[output("image", Planes::As(IMAGE))],
    tiling: Tiling::ExceptInEightBit("several jumps leave a seam at the left and the upper edge"),
    ..About::DEFAULT
});

/// Pixels that jump side by side, so that most of their arithmetic is vectorised.
const PIECE: usize = 64;

/// With as many jumps, a piece takes long enough to ask whether to go on.
const MANY_JUMPS: u32 = 64;

struct CircleTransform {
    image: Image,
    jumps: u32,
    /// In pixels.
    radius: f64,
    /// The jumps of the 256 grey levels, to the right and down.
    by_level: Box<[[f64; 2]; 256]>,
}

/// Positions along one side, with any number of turns, and the turns in pixels.
#[derive(Clone, Copy)]
struct Walk {
    position: [i32; PIECE],
    turns: [i32; PIECE],
}

impl GatherBlock for CircleTransform {
    type Params = Params;

    fn prepare<L: Levels>(params: &Params, cx: &PrepareContext<'_>) -> Result<Self, Error> {
        let radius = (f64::from(params.radius) * 0.01 * f64::from(cx.width)).trunc();
        let mut by_level = Box::new([[0.0; 2]; 256]);
        for (level, jump) in (0..=255_u8).zip(by_level.iter_mut()) {
            let angle = 2.0 * PI * f64::from(level) / 255.0;
            let (right, up) = ray::heading(angle);
            *jump = [radius * right, -radius * up];
        }
        let image = cx.image(IMAGE)?.clone();
        Ok(Self { image, jumps: params.jumps.unsigned_abs(), radius, by_level })
    }

    #[inline(always)]
    fn row<L: Levels>(&self, cx: &RowContext<'_>, _: &InputRows<'_>, out: &mut OutputRow<'_>) {
        if self.jumps == 0 {
            out.iter_mut().for_each(|plane| plane.fill(1.0));
            return;
        }
        let count = out.plane(0).len();
        for start in (0..count).step_by(PIECE) {
            if self.jumps >= MANY_JUMPS && cx.is_stopped() {
                return;
            }
            let end = count.min(start + PIECE);
            let sources = self.sources::<L>(cx, start);
            for (channel, out) in out.iter_mut().enumerate() {
                let plane = self.image.channel(channel);
                for (out, source) in out[start..end].iter_mut().zip(sources) {
                    *out = plane[source];
                }
            }
        }
    }
}

impl CircleTransform {
    /// Where pixels from number `start` of the row on end after all jumps: places in the image.
    #[inline(always)]
    fn sources<L: Levels>(&self, cx: &RowContext<'_>, start: usize) -> [usize; PIECE] {
        let (width, height) = (cx.width.cast_signed(), cx.height.cast_signed());
        // A whole piece jumps, also where the row ends before: further pixels are on other turns.
        let first = (cx.x as usize + start) as i64;
        let mut x = Walk::new(std::array::from_fn(|i| first + i as i64), cx.width);
        let mut y = Walk::new([i64::from(cx.y); PIECE], cx.height);
        let mut places = places(&x, &y, width);
        for _ in 0..self.jumps {
            let jumps = places.map(|place| self.grey(place)).map(|grey| self.jump::<L>(grey));
            x.walk::<L>(&jumps.map(|[right, _]| right), width);
            y.walk::<L>(&jumps.map(|[_, down]| down), height);
            places = self::places(&x, &y, width);
        }
        places
    }

    /// The grey value at a place of the image.
    #[inline(always)]
    fn grey(&self, place: usize) -> f32 {
        if self.image.is_grey() {
            return self.image.channel(0)[place];
        }
        let [red, green, blue] = [0, 1, 2].map(|channel| self.image.channel(channel)[place]);
        (red + green + blue) / 3.0
    }

    /// How far a pixel of that grey value jumps to the right and down.
    #[inline(always)]
    fn jump<L: Levels>(&self, grey: f32) -> [f64; 2] {
        if L::EIGHT_BIT {
            // Levels are whole but for rounding, their means are a third apart.
            return self.by_level[convert::truncate_masked(grey * 255.0 + 0.01, 255)];
        }
        let (right, up) = (elementary::cos_turns(grey), elementary::sin_turns(grey));
        [self.radius * f64::from(right), -self.radius * f64::from(up)]
    }
}

impl Walk {
    /// Positions on the first turn.
    #[inline(always)]
    fn new(positions: [i64; PIECE], length: u32) -> Self {
        let position = positions.map(|position| convert::wrap_near(position, length).cast_signed());
        Self { position, turns: [0; PIECE] }
    }

    /// Goes on by those distances.
    #[inline(always)]
    fn walk<L: Levels>(&mut self, distances: &[f64; PIECE], length: i32) {
        let per_turn = 1.0 / f64::from(length);
        let steps = self.position.iter_mut().zip(&mut self.turns).zip(distances);
        for ((position, turns), distance) in steps {
            let sum = f64::from(*position) + distance;
            *position = if L::EIGHT_BIT { convert::truncate64_to_i32(sum) } else { floor(sum) };
            // In the middle of a pixel, rounding cannot lead to another turn.
            let on_turn = f64::from(*position - *turns) + 0.5;
            *turns += floor(on_turn * per_turn) * length;
        }
    }
}

#[inline(always)]
fn floor(value: f64) -> i32 {
    let toward_zero = convert::truncate64_to_i32(value);
    toward_zero - i32::from(f64::from(toward_zero) > value)
}

/// The places in an image of that width.
#[inline(always)]
fn places(x: &Walk, y: &Walk, width: i32) -> [usize; PIECE] {
    std::array::from_fn(|i| {
        let (x, y) = (x.position[i] - x.turns[i], y.position[i] - y.turns[i]);
        y.cast_unsigned() as usize * width.cast_unsigned() as usize + x.cast_unsigned() as usize
    })
}

#[cfg(test)]
mod tests {
    use std::f64::consts::FRAC_PI_2;

    use super::*;
    use crate::block::testing::{Trial, image_of_levels};

    fn picture(width: u32, height: u32) -> Vec<u8> {
        (0..width * height).map(|i| (i * i % 253).to_le_bytes()[0]).collect()
    }

    fn trial(width: u32, height: u32, radius: i32, jumps: i32) -> Trial {
        let levels = picture(width, height);
        Trial::of(&BLOCK)
            .size(width, height)
            .input(IMAGE, image_of_levels(width, &[&levels]))
            .int("radius", radius)
            .int("jumps", jumps)
    }

    #[test]
    fn jumps_follow_each_other_without_wrapping() {
        let (width, height) = (21, 13);
        let levels = picture(width, height);
        let level = |(x, y): (i64, i64)| {
            let (x, y) = (convert::wrap(x, width), convert::wrap(y, height));
            levels[(y * width + x) as usize]
        };
        let jump = |(x, y): (i64, i64)| {
            let angle = 2.0 * PI * f64::from(level((x, y))) / 255.0;
            let right = 4.0 * elementary::sin64(FRAC_PI_2 + angle);
            let up = 4.0 * elementary::sin64(angle);
            (convert::truncate64(x as f64 + right), convert::truncate64(y as f64 - up))
        };
        for jumps in [1, 2, 3, 4, 7, 50] {
            let out = trial(width, height, 20, jumps).levels(0);
            for (i, found) in (0..i64::from(width * height)).zip(out) {
                let start = (i % i64::from(width), i / i64::from(width));
                let end = (0..jumps).fold(start, |place, _| jump(place));
                assert_eq!(found, level(end), "{jumps} jumps from {start:?}");
            }
        }
    }

    #[test]
    fn in_float_precision_no_place_is_special() {
        let (width, height) = (21, 13);
        let moved = |levels: &[u8]| -> Vec<u8> {
            let from = |i: u32| {
                let x = convert::wrap(i64::from(i % width) - 5, width);
                let y = convert::wrap(i64::from(i / width) - 3, height);
                levels[(y * width + x) as usize]
            };
            (0..width * height).map(from).collect()
        };
        let jumped = |levels: &[u8]| -> Vec<u8> {
            let image = image_of_levels(width, &[levels]);
            let trial = trial(width, height, 20, 9).input(IMAGE, image);
            trial.assert_same_bits();
            let image = trial.image();
            image.channel(0).iter().map(|value| convert::to_byte(*value)).collect()
        };
        let levels = picture(width, height);
        assert_eq!(moved(&jumped(&levels)), jumped(&moved(&levels)));
    }

    #[test]
    fn colours_jump_by_the_floor_of_their_mean() {
        // (0 + 0 + 2)/3 is level 0: to the right by 40 % of 5 px.
        let planes = [[0, 10, 20, 30, 40], [0, 0, 0, 0, 0], [2, 0, 0, 0, 0]];
        let image = image_of_levels(5, &planes.each_ref().map(<[u8; 5]>::as_slice));
        let trial = Trial::of(&BLOCK).size(5, 1).input(IMAGE, image).int("radius", 40);
        assert_eq!(trial.levels(0)[0], 20);
    }

    #[test]
    fn no_jump_is_white_and_radius_0_changes_nothing() {
        assert_eq!(trial(7, 3, 50, 0).levels(0), [255; 21]);
        assert_eq!(trial(7, 3, 0, 100).levels(0), picture(7, 3));
    }

    #[test]
    fn walks_of_many_turns_stay_in_the_picture() {
        for (width, height) in [(3, 2), (40, 1), (1, 9)] {
            trial(width, height, 100, 100).levels(0);
            trial(width, height, 100, 100).assert_same_bits();
        }
    }
}
