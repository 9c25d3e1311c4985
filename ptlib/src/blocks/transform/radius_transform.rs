//! Pixels taken from circles around them: the grey level is the radius, the position the angle.
//!
//! Specification 2.27 and 2.0 (JUMP). The angle turns once along the width and once down the
//! height, or (**Q**) twice down the height.
//!
//! In 8-bit precision positions are truncated toward zero, as PT Designer does: those that pass the
//! left or the upper edge are rounded to the other side. In float precision all are rounded down.
//! Directions come from single-precision polynomials; in 8-bit precision, positions so near to a
//! whole one that this decides how they are truncated are computed again in double precision.

use std::f64::consts::PI;

use crate::block::prelude::*;

const IMAGE: usize = 0;

params! {
    /// Parameters of [`BLOCK`].
    Params {
        /// How far black pixels are taken from.
        min "radius min": int [hard 0..=65536 soft 0..=200 unit "px"] = 1;
        /// How far white pixels are taken from. The larger one of the two radii counts as this one.
        max "radius max": int [hard 0..=65536 soft 0..=200 unit "px"] = 20;
        /// Whether the direction turns counter-clockwise from pixel to pixel.
        rotate_left "rotate left": bool = true;
        /// Whether the direction turns once along the width and once down the height, so that it
        /// is the same along diagonals. Otherwise it turns twice down the height.
        horizontal: bool = true;
    }
}

/// The block as everybody else sees it.
pub static BLOCK: BlockSpec = BlockSpec::gather::<RadiusTransform>(About {
    id: "radius transform",
    summary: "Takes each pixel from as far away as its grey level says, in turning directions.",
    inputs: &[input("image", Kind::Image).anywhere()],
    outputs: &[output("image", Planes::As(IMAGE))],
    in_pixels: "radius min, radius max",
    ..About::DEFAULT
});

/// Pixels that are computed side by side.
const PIECE: usize = 64;

struct RadiusTransform {
    image: Image,
    /// The radius of black, and what white has more.
    min: f64,
    span: f64,
    rotate_left: bool,
    horizontal: bool,
}

impl GatherBlock for RadiusTransform {
    type Params = Params;

    fn prepare<L: Levels>(params: &Params, cx: &PrepareContext<'_>) -> Result<Self, Error> {
        // BUG of the original: crashes where the minimum is the larger one.
        let (min, max) = (params.min.min(params.max), params.min.max(params.max));
        Ok(Self {
            image: cx.image(IMAGE)?.clone(),
            min: f64::from(min),
            span: f64::from(max - min),
            rotate_left: params.rotate_left,
            horizontal: params.horizontal,
        })
    }

    #[inline(always)]
    fn row<L: Levels>(&self, cx: &RowContext<'_>, _: &InputRows<'_>, out: &mut OutputRow<'_>) {
        let count = out.plane(0).len();
        for start in (0..count).step_by(PIECE) {
            let end = count.min(start + PIECE);
            let sources = self.sources::<L>(cx, cx.x as usize + start, end - start);
            for (channel, out) in out.iter_mut().enumerate() {
                let plane = self.image.channel(channel);
                for (out, source) in out[start..end].iter_mut().zip(sources) {
                    *out = plane[source];
                }
            }
        }
    }
}

impl RadiusTransform {
    /// Where `count` pixels from column `x` on are taken from: places in the image.
    #[inline(always)]
    fn sources<L: Levels>(&self, cx: &RowContext<'_>, x: usize, count: usize) -> [usize; PIECE] {
        let mut radii = [0.0; PIECE];
        self.radii::<L>(x, cx.y, &mut radii[..count]);
        let y = f64::from(cx.y);
        let mut ends = [[0.0; 2]; PIECE];
        for ((end, radius), x) in ends.iter_mut().zip(&radii).zip(x as u64..) {
            let x = x as f64;
            let turns = convert::single(self.turns(cx, x));
            let (right, up) = (elementary::cos_turns(turns), elementary::sin_turns(turns));
            *end = [x + radius * f64::from(right), y - radius * f64::from(up)];
        }
        if L::EIGHT_BIT {
            for ((end, radius), x) in ends[..count].iter_mut().zip(&radii).zip(x as u64..) {
                // More than the error of the polynomials, of their argument, and of a sum.
                let near = radius * 2e-6 + 1e-9;
                if end.iter().any(|end| (end - (end + 0.5).floor()).abs() < near) {
                    let x = x as f64;
                    let (right, up) = ray::heading(self.angle(cx, x));
                    *end = [x + radius * right, y - radius * up];
                }
            }
        }
        let whole =
            |value: f64| convert::truncate64(if L::EIGHT_BIT { value } else { value.floor() });
        ends.map(|[x, y]| {
            let x = convert::wrap_near(whole(x), cx.width) as usize;
            let y = convert::wrap_near(whole(y), cx.height) as usize;
            y * cx.width as usize + x
        })
    }

    /// The radii of the pixels from (`x`, `y`) on.
    #[inline(always)]
    fn radii<L: Levels>(&self, x: usize, y: u32, radii: &mut [f64]) {
        let [red, green, blue] = [0, 1, 2].map(|channel| &self.image.row(channel, y)[x..]);
        for (((radius, red), green), blue) in radii.iter_mut().zip(red).zip(green).zip(blue) {
            let grey = (red + green + blue) / 3.0;
            let grey = if L::EIGHT_BIT {
                // Levels are whole but for rounding, their means are a third apart.
                f64::from((grey * 255.0 + 0.01).floor()) / 255.0
            } else {
                f64::from(grey)
            };
            *radius = self.min + grey * self.span;
        }
    }

    /// The direction at a pixel, in turns.
    #[inline(always)]
    fn turns(&self, cx: &RowContext<'_>, x: f64) -> f64 {
        let turns = self.place(cx, x);
        if self.rotate_left { turns } else { 1.0 - turns }
    }

    /// The direction at a pixel in radians, in the order of operations of the specification.
    #[inline(always)]
    fn angle(&self, cx: &RowContext<'_>, x: f64) -> f64 {
        let angle = 2.0 * PI * self.place(cx, x);
        if self.rotate_left { angle } else { 2.0 * PI - angle }
    }

    /// How far a pixel lies along the turn, 0..1.
    #[inline(always)]
    fn place(&self, cx: &RowContext<'_>, x: f64) -> f64 {
        let down = f64::from(cx.y) / f64::from(cx.height);
        // Q: the position down the image counts always.
        let place = down + if self.horizontal { x / f64::from(cx.width) } else { down };
        if place > 1.0 { place - 1.0 } else { place }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::block::testing::{Trial, image_of_levels};

    fn picture(width: u32, height: u32) -> Vec<u8> {
        (0..width * height).map(|i| (i * i % 253).to_le_bytes()[0]).collect()
    }

    fn trial(width: u32, height: u32, levels: &[u8]) -> Trial {
        let image = image_of_levels(width, &[levels]);
        Trial::of(&BLOCK).size(width, height).input(IMAGE, image)
    }

    #[test]
    fn levels_equal_the_formula() {
        for ((width, height), min, max) in
            [((131, 70), 1, 20), ((40, 64), 3, 30), ((9, 5), 0, 400), ((64, 64), 0, 65_536)]
        {
            let levels = picture(width, height);
            for (left, horizontal) in [(true, true), (true, false), (false, true), (false, false)] {
                let trial = trial(width, height, &levels)
                    .int("radius min", min)
                    .int("radius max", max)
                    .flag("rotate left", left)
                    .flag("horizontal", horizontal);
                trial.assert_same_bits();
                for (i, found) in (0..).zip(trial.levels(0)) {
                    let (x, y) = (i64::from(i % width), i64::from(i / width));
                    let grey = f64::from(levels[i as usize]);
                    let radius = f64::from(min) + grey / 255.0 * f64::from(max - min);
                    let down = y as f64 / f64::from(height);
                    let along = if horizontal { x as f64 / f64::from(width) } else { down };
                    let t = if along + down > 1.0 { along + down - 1.0 } else { along + down };
                    let angle = if left { 2.0 * PI * t } else { 2.0 * PI - 2.0 * PI * t };
                    let end = ray::Position::new(x, y).jump(radius, angle);
                    let (x, y) = (convert::wrap(end.x, width), convert::wrap(end.y, height));
                    assert_eq!(found, levels[(y * width + x) as usize], "{end:?} from {i}");
                }
            }
        }
    }

    #[test]
    fn radii_the_wrong_way_round_are_swapped() {
        let levels = picture(40, 30);
        let trial = trial(40, 30, &levels);
        let swapped = trial.clone().int("radius min", 20).int("radius max", 1);
        assert_eq!(swapped.levels(0), trial.levels(0));
        let none = trial.int("radius min", 0).int("radius max", 0);
        assert_eq!(none.levels(0), levels);
    }

    #[test]
    fn in_float_precision_positions_are_rounded_down_on_all_sides() {
        // Red and green add up to the same grey everywhere, and red is what is looked at.
        let (width, height) = (41, 29);
        let red = picture(width, height);
        let green: Vec<_> = red.iter().map(|level| 255 - level).collect();
        let blue = vec![50; red.len()];
        let image = image_of_levels(width, &[&red, &green, &blue]);
        let trial = Trial::of(&BLOCK).size(width, height).input(IMAGE, image);
        trial.assert_same_bits();
        let image = trial.image();
        let radius = 1.0 + 305.0 / 765.0 * 19.0;
        for (i, found) in (0..).zip(image.channel(0)) {
            let (x, y) = (f64::from(i % width), f64::from(i / width));
            let angle = 2.0 * PI * (x / f64::from(width) + y / f64::from(height));
            let ends =
                [x + radius * elementary::cos64(angle), y - radius * elementary::sin64(angle)];
            let [x, y] = ends.map(|end| convert::truncate64(end.floor()));
            let source = convert::wrap(y, height) * width + convert::wrap(x, width);
            assert_eq!(convert::to_byte(*found), red[source as usize], "from {i}");
        }
    }
}
