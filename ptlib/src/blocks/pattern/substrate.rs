//! Substrate: cracks that grow, branch, and end where they meet, with the areas between them
//! coloured.
//!
//! Specification 2.14; the idea is Jared Tarbell's "Substrate" (2003). [`cracks`] lets them grow.
//! An area is the region of its first pixel; its colour comes from where that pixel lies, relative
//! to the size of the image, so that the same seed is coloured alike at each resolution. There are
//! at most [`COLORS`] such places, so the canvas has a byte a pixel, and the colours come last.
//!
//! Where borders are removed, every pixel of a border takes the colour of its left neighbour. In
//! 8-bit precision column 0 looks around the edge before that row was done, as PT Designer does,
//! and so may stay black; in float precision it takes the colour that its neighbour has in the end.

use super::cracks::{self, BLACK, WHITE};
use crate::block::prelude::*;

choice! {
    /// What is done with the areas between the cracks.
    Fill {
        /// They stay white.
        None = "none",
        /// They are coloured, and the cracks are left.
        KeepBorders = "keep borders",
        /// They are coloured, and cover the cracks.
        NoBorders = "no borders",
    }
}

params! {
    /// Parameters of [`BLOCK`].
    Params {
        /// For how many phases cracks branch off from others, if "iterate" is on; in each they do
        /// so at shorter distances. 0 leaves the first four cracks.
        iterations "number of iterations": int [hard 0..=999999 soft 0..=20] = 10;
        /// How many cracks there are, if "iterate" is off. 0 gives plain white.
        lines "number of lines": int [hard 0..=9999 soft 0..=500] = 10;
        /// What is done with the areas between the cracks.
        fill "fill type": choice [Fill] = Fill::KeepBorders;
        /// Whether areas are grey instead of coloured.
        grayscale: bool = false;
        /// Whether four cracks branch; otherwise there are many that do not.
        iterate: bool = true;
    }
}

/// The block as everybody else sees it.
pub static BLOCK: BlockSpec = BlockSpec::whole::<Substrate>(About {
    id: "substrate",
    summary: "Cracks that grow until they meet, with coloured areas between them.",
    outputs: &[output("image", Planes::ByParameters)],
    uses_seed: true,
    tiling: Tiling::ExceptInEightBit(
        "cracks along the left edge may stay black where all others are covered",
    ),
    in_pixels: "the width of the cracks, and their growth, so that other areas come about",
    ..About::DEFAULT
});

/// Colours of areas: their first pixels lie in a hundred columns and a hundred rows, and the sum of
/// the two counts.
const COLORS: u8 = 199;

struct Substrate;

impl WholeBlock for Substrate {
    type Params = Params;

    fn compute<L: Levels>(params: &Params, cx: &WholeContext<'_>) -> Result<Vec<Value>, Error> {
        let [lines, phases] =
            if params.iterate { [4, params.iterations] } else { [params.lines, 0] }
                .map(i32::unsigned_abs);
        let mut pixels = cracks::grow(&cracks::Settings { lines, phases }, cx)?;
        cx.report(0.3);
        if params.fill != Fill::None {
            color_areas(&mut pixels, cx)?;
        }
        cx.report(0.7);
        let is_grey = Self::is_grey(params);
        let palettes = [0, 1, 2].map(|channel| palette(if is_grey { 0 } else { channel }));
        if params.fill == Fill::NoBorders {
            let is_black =
                |number: u8| palettes.iter().all(|levels| levels[usize::from(number)] == 0.0);
            remove_borders::<L>(&mut pixels, is_black, cx)?;
        }
        let width = cx.width as usize;
        let mut image = cx.new_image(if is_grey { 1 } else { 3 })?;
        for (levels, plane) in palettes.iter().zip(image.planes_mut()) {
            cx.parallel_pieces(plane, width, |y, out| {
                for (out, pixel) in out.iter_mut().zip(&pixels[y * width..]) {
                    *out = levels[usize::from(*pixel)];
                }
                cx.check()
            })?;
        }
        Ok(vec![image.into()])
    }

    fn is_grey(params: &Params) -> bool {
        params.grayscale || params.fill == Fill::None
    }

    fn scratch_bytes(_: &Params, width: u32, height: u32) -> u64 {
        // The canvas; cracks and waiting runs are far fewer than its pixels.
        u64::from(width) * u64::from(height) * 2
    }
}

/// Gives each white area the number of its colour, from 1 on.
fn color_areas(pixels: &mut [u8], cx: &WholeContext<'_>) -> Result<(), Error> {
    let (width, height) = (cx.width as usize, cx.height as usize);
    let mut canvas = fill::Canvas::new(pixels, cx.width);
    for y in 0..height {
        cx.check()?;
        let mut x = 0;
        while let Some(distance) = first_white(&canvas.pixels()[y * width..][x..width]) {
            x += distance;
            let number = 100 * x / width + 100 * y / height;
            let color = u8::try_from(number + 1).unwrap_or(COLORS);
            canvas.fill(y * width + x, color, || cx.check())?;
        }
    }
    Ok(())
}

/// How far the first white pixel is. Mostly there is none: whole pieces are looked at first.
fn first_white(pixels: &[u8]) -> Option<usize> {
    let piece = pixels.chunks(256).position(|piece| piece.contains(&WHITE))?;
    let start = 256 * piece;
    Some(start + pixels[start..].iter().position(|pixel| *pixel == WHITE)?)
}

/// Gives every black pixel what its left neighbour has then.
fn remove_borders<L: Levels>(
    pixels: &mut [u8],
    is_black: impl Fn(u8) -> bool + Sync,
    cx: &WholeContext<'_>,
) -> Result<(), Error> {
    cx.parallel_pieces(pixels, cx.width as usize, |_, row| {
        let last = row.last().copied().unwrap_or(BLACK);
        let mut left = if L::EIGHT_BIT {
            last
        } else {
            row.iter().rev().copied().find(|pixel| !is_black(*pixel)).unwrap_or(last)
        };
        for pixel in row {
            if is_black(*pixel) {
                *pixel = left;
            }
            left = *pixel;
        }
        cx.check()
    })
}

/// The values of all numbers of a canvas in one channel.
fn palette(channel: i32) -> [f32; 256] {
    let mut palette = [1.0; 256];
    palette[usize::from(BLACK)] = 0.0;
    for (number, value) in (0..i32::from(COLORS)).zip(&mut palette[1..]) {
        let level = elias::Draws::from_index(number + channel).next_integer(0, 254);
        *value = levels::from_level(convert::distance(level));
    }
    palette
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::block::testing::Trial;

    /// Steps 1 to 3 as the specification tells them, without forgetting anything. Gives which
    /// pixels are black.
    fn naive(trial: (u32, u32, i32), lines: usize, phases: u32, iterates: bool) -> Vec<bool> {
        struct Line(ray::Position, f64, i64, bool);
        let (width, height, seed) = trial;
        let mut draws = elias::Draws::from_index(32 * seed);
        let mut lines: Vec<Line> = (0..lines)
            .map(|_| {
                let x = draws.next_integer(0, i64::from(width));
                let y = draws.next_integer(0, i64::from(height));
                let angle = std::f64::consts::PI + std::f64::consts::PI * draws.next_noise();
                Line(ray::Position::new(x, y), angle, 0, true)
            })
            .collect();
        draws.next_noise();
        let mut black = vec![false; (width * height) as usize];
        let (mut g, mut phase, mut step_of_phase, mut limit) = (width / 4, 0, 0, width / 4 * 2 + 1);
        loop {
            let mut drew = false;
            for i in 0..lines.len() {
                let Line(start, angle, length, lives) = lines[i];
                if !lives {
                    continue;
                }
                let p = ray::Ray::new(start, angle).at(length);
                let bears = iterates && phase < phases && g > 0;
                if bears && length != 0 && length % i64::from(g) == 0 {
                    let side = if draws.next_noise() > 0.0 { 1.0 } else { -1.0 };
                    draws.next_noise();
                    lines.push(Line(p, angle + side * std::f64::consts::FRAC_PI_2, 1, true));
                }
                let place = convert::wrap(p.y, height) * width + convert::wrap(p.x, width);
                let pixel = &mut black[place as usize];
                lines[i].2 += i64::from(!*pixel);
                lines[i].3 = !*pixel;
                drew |= !*pixel;
                *pixel = true;
            }
            if !drew {
                return black;
            }
            step_of_phase += 1;
            if step_of_phase == limit {
                (phase, step_of_phase) = (phase + 1, 0);
                g = g * 6 / 10;
                limit = 2 * g;
            }
        }
    }

    #[test]
    fn cracks_grow_as_the_specification_tells() {
        for (width, height, seed) in
            [(64, 64, 0_u8), (97, 40, 3), (40, 97, 5), (3, 5, 1), (1, 1, 2)]
        {
            let trial =
                Trial::of(&BLOCK).size(width, height).seed(u64::from(seed)).choice("fill type", 0);
            let size = (width, height, i32::from(seed));
            for phases in [0, 1, 3, 10] {
                let image = trial.clone().int("number of iterations", phases).image();
                let black: Vec<_> = image.channel(0).iter().map(|value| *value == 0.0).collect();
                let phases = phases.unsigned_abs();
                assert_eq!(black, naive(size, 4, phases, true), "{width} × {height}, {phases}");
            }
            let image = trial.flag("iterate", false).int("number of lines", 30).image();
            let black: Vec<_> = image.channel(0).iter().map(|value| *value == 0.0).collect();
            assert_eq!(black, naive(size, 30, 0, false), "{width} × {height}, lines");
        }
    }

    #[test]
    fn areas_have_one_colour_each_and_none_is_left() {
        let trial = Trial::of(&BLOCK).size(80, 60);
        let kept = trial.image();
        assert_eq!(kept.planes(), 3);
        let at = |i: usize| [0, 1, 2].map(|channel| kept.channel(channel)[i]);
        for i in 0..80 * 60 {
            assert_ne!(at(i), [1.0; 3]);
            let below = (i + 80) % (80 * 60);
            let is_border = [at(i), at(below)].contains(&[0.0; 3]);
            assert!(is_border || at(i) == at(below), "pixel {i}");
        }
        // In float precision no border stays, but for rows that are nothing else.
        let removed = trial.choice("fill type", 2).image();
        let black = |i: &usize| [0, 1, 2].iter().all(|c| removed.channel(*c)[*i] == 0.0);
        assert_eq!((0..80 * 60).filter(black).count() % 80, 0);
    }

    #[test]
    fn extremes_end() {
        let trial = Trial::of(&BLOCK).size(60, 50).int("number of iterations", 999_999);
        trial.image();
        let trial =
            trial.flag("iterate", false).int("number of lines", 9999).choice("fill type", 2);
        trial.levels(0);
        assert_eq!(trial.int("number of lines", 0).choice("fill type", 0).levels(0), [255; 3000]);
    }
}
