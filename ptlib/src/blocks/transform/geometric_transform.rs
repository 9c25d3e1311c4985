//! A picture turned by right angles, shifted, and mirrored.
//!
//! Specification 2.7. All that together moves a row of the result to a row of the picture or, for
//! a quarter turn, to a column, read forwards or backwards. So a row is copied from one place on,
//! with wrap-around; for quarter turns the picture is first transposed.
//!
//! Square pictures turn around the middle of their first pixel, exactly (PT Designer was off by one
//! there, a **BUG**). Others are cut by a quarter turn, as PT Designer cuts them.

use std::f64::consts::PI;

use crate::block::prelude::*;
use ray::Position;

const IMAGE: usize = 0;

params! {
    /// Parameters of [`BLOCK`].
    Params {
        /// How far to move the turned picture to the right; negative numbers move it to the left.
        shift_x "shift x": float [hard -1000.0..=1000.0 soft -1.0..=1.0 unit "of the width"] = 0.0;
        /// How far to move the turned picture down; negative numbers move it up.
        shift_y "shift y": float [hard -1000.0..=1000.0 soft -1.0..=1.0 unit "of the height"] = 0.0;
        /// Whether to swap left and right, after turning and shifting.
        flip_horizontal "flip horizontal": bool = false;
        /// Whether to swap top and bottom, after turning and shifting.
        flip_vertical "flip vertical": bool = false;
        /// By how much to turn the picture clockwise. Only right angles are possible: others are
        /// rounded towards 0.
        angle: int [hard -3600000..=3600000 soft -270..=270 unit "degrees"] = 0;
    }
}

/// The block as everybody else sees it.
pub static BLOCK: BlockSpec = BlockSpec::gather::<GeometricTransform>(About {
    id: "geometric transform",
    summary: "Turns a picture by right angles, shifts it, and mirrors it.",
    inputs: &[input("image", Kind::Image).anywhere()],
    outputs: &[output("image", Planes::As(IMAGE))],
    tiling: Tiling::Except("a quarter turn cuts a picture that is not square"),
    ..About::DEFAULT
});

struct GeometricTransform {
    /// The picture, or its columns as rows.
    lines: Image,
    /// From a row of the result to a line.
    down: Walk,
    /// From a column of the result to a place in a line.
    across: Walk,
}

/// Where positions along one side of the result come from.
#[derive(Clone, Copy)]
struct Walk {
    /// How far everything is shifted, after turning.
    shift: i64,
    /// Whether the side is flipped, after shifting.
    flips: bool,
    /// Where the turned picture begins, and whether it runs backwards from there.
    start: i64,
    turns_back: bool,
}

/// Neighbours in the result that are neighbours in their line, too.
struct Run {
    first: usize,
    is_forward: bool,
    /// At most this many.
    count: usize,
}

impl GatherBlock for GeometricTransform {
    type Params = Params;

    fn prepare<L: Levels>(params: &Params, cx: &PrepareContext<'_>) -> Result<Self, Error> {
        let image = cx.image(IMAGE)?;
        // Truncated towards 0 first: -75° is none.
        let quarters = (params.angle / 90).rem_euclid(4);
        let pivot = pivot(quarters, cx.width, cx.height);
        let is_upright = quarters % 2 == 0;
        let (top, left) = if is_upright { (pivot.y, pivot.x) } else { (pivot.x, pivot.y) };
        let moved = |share: f64, length: u32| convert::truncate64(share * f64::from(length));
        Ok(Self {
            lines: if is_upright { image.clone() } else { transposed(image, cx)? },
            down: Walk {
                shift: moved(params.shift_y, cx.height),
                flips: params.flip_vertical,
                start: top,
                turns_back: quarters >= 2,
            },
            across: Walk {
                shift: moved(params.shift_x, cx.width),
                flips: params.flip_horizontal,
                start: left,
                turns_back: quarters == 1 || quarters == 2,
            },
        })
    }

    #[inline(always)]
    fn row<L: Levels>(&self, cx: &RowContext<'_>, _: &InputRows<'_>, out: &mut OutputRow<'_>) {
        let lines = &self.lines;
        let line = self.down.run(cx.y, cx.height, lines.height()).first;
        for (channel, mut out) in out.iter_mut().enumerate() {
            let line = &lines.channel(channel)[line * lines.width() as usize..];
            let mut x = cx.x;
            while !out.is_empty() {
                let Run { first, is_forward, count } = self.across.run(x, cx.width, lines.width());
                let count = count.min(out.len());
                let (part, rest) = std::mem::take(&mut out).split_at_mut(count);
                if is_forward {
                    part.copy_from_slice(&line[first..first + count]);
                } else {
                    let backwards = line[first + 1 - count..=first].iter().rev();
                    part.iter_mut().zip(backwards).for_each(|(out, value)| *out = *value);
                }
                out = rest;
                // Not past the end of the row.
                x += u32::try_from(count).unwrap_or(cx.width);
            }
        }
    }

    fn scratch_bytes(params: &Params, width: u32, height: u32, planes: usize) -> u64 {
        if params.angle / 90 % 2 == 0 { 0 } else { Image::bytes_of(width, height, planes) }
    }
}

impl Walk {
    /// Where the pixels from `position` of a side of `length` on come from in a ring of `source`
    /// pixels. The turned picture ends with the side, wherever it stands in its ring.
    #[inline(always)]
    fn run(&self, position: u32, length: u32, source: u32) -> Run {
        let position = i64::from(position);
        let unflipped = if self.flips { -position } else { position };
        let turned = convert::wrap(unflipped - self.shift, length);
        let left = if self.flips { turned + 1 } else { length - turned };
        let turned = i64::from(turned);
        let place = self.start + if self.turns_back { -turned } else { turned };
        let first = convert::wrap(place, source);
        let is_forward = self.flips == self.turns_back;
        let left_in_line = if is_forward { source - first } else { first + 1 };
        Run { first: first as usize, is_forward, count: left.min(left_in_line) as usize }
    }
}

/// The pixel that comes to (0, 0) by so many quarter turns.
fn pivot(quarters: i32, width: u32, height: u32) -> Position {
    if quarters == 0 || width == height {
        return Position::default();
    }
    let middle = Position::new(i64::from(width / 2), i64::from(height / 2));
    let (w, h) = (f64::from(width), f64::from(height));
    let angle = f64::from(quarters * 90 + 135) * PI / 180.0;
    middle.jump((w * w + h * h).sqrt() / 2.0, angle)
}

/// The image with rows and columns exchanged.
fn transposed(image: &Image, cx: &Context<'_>) -> Result<Image, Error> {
    /// A square of pixels whose rows fill cache lines in both images.
    const SIDE: usize = 16;
    let (width, height) = (image.width() as usize, image.height() as usize);
    let mut turned = cx.new_image_sized(image.height(), image.width(), image.planes())?;
    for (channel, plane) in turned.planes_mut().enumerate() {
        let source = image.channel(channel);
        cx.parallel_pieces(plane, height * SIDE, |piece, columns| {
            cx.check()?;
            let left = piece * SIDE;
            let width_left = (width - left).min(SIDE);
            for top in (0..height).step_by(SIDE) {
                let height_left = (height - top).min(SIDE);
                // Through a buffer: rows far apart would push each other out of the cache.
                let mut square = [[0.0; SIDE]; SIDE];
                for (y, row) in source[top * width..].chunks(width).take(SIDE).enumerate() {
                    for (column, value) in square.iter_mut().zip(&row[left..left + width_left]) {
                        column[y] = *value;
                    }
                }
                for (out, column) in columns.chunks_mut(height).zip(&square) {
                    out[top..top + height_left].copy_from_slice(&column[..height_left]);
                }
            }
            Ok(())
        })?;
    }
    Ok(turned)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::block::testing::{Trial, image_of_levels};

    fn picture(width: u32, height: u32) -> Vec<u8> {
        (0..width * height).map(|i| (i * i % 253).to_le_bytes()[0]).collect()
    }

    fn trial(width: u32, height: u32) -> Trial {
        let levels = picture(width, height);
        Trial::of(&BLOCK).size(width, height).input(IMAGE, image_of_levels(width, &[&levels]))
    }

    #[test]
    fn a_quarter_turn_brings_the_second_pixel_below_the_first() {
        let picture = [1, 2, 3, 4, 5, 6, 7, 8, 9];
        let image = image_of_levels(3, &[&picture]);
        let trial = Trial::of(&BLOCK).size(3, 3).input(IMAGE, image);
        // Around the first pixel: what was left of it is above it now, on the other side.
        assert_eq!(trial.clone().int("angle", 90).levels(0), [1, 7, 4, 2, 8, 5, 3, 9, 6]);
        assert_eq!(trial.clone().int("angle", 180).levels(0), [1, 3, 2, 7, 9, 8, 4, 6, 5]);
        assert_eq!(trial.clone().int("angle", 270).levels(0), [1, 4, 7, 3, 6, 9, 2, 5, 8]);
    }

    #[test]
    fn every_combination_equals_the_formulas_one_after_the_other() {
        for ((width, height), angle) in [(17, 17), (40, 33), (5, 64), (1, 9)]
            .into_iter()
            .flat_map(|size| [-75, 0, 100, 180, 270, -90, -450].map(|angle| (size, angle)))
        {
            let (w, h) = (i64::from(width), i64::from(height));
            let levels = picture(width, height);
            let level =
                |x: i64, y: i64| levels[convert::index(y.rem_euclid(h) * w + x.rem_euclid(w))];
            let turns = i64::from(angle / 90).rem_euclid(4);
            let turned = |x: i64, y: i64| {
                let p = pivot(i32::try_from(turns).unwrap(), width, height);
                let (cosine, sine) = [(1, 0), (0, 1), (-1, 0), (0, -1)][convert::index(turns)];
                level(p.x + x * cosine + y * sine, p.y - x * sine + y * cosine)
            };
            for (shift, flips) in [((0.3, -0.7), (false, false)), ((2.0, 0.5), (true, false))]
                .into_iter()
                .chain([((-0.1, 0.0), (false, true)), ((0.0, 0.99), (true, true))])
            {
                let moved = |share: f64, length: i64| convert::truncate64(share * length as f64);
                let trial = trial(width, height)
                    .int("angle", angle)
                    .float("shift x", shift.0)
                    .float("shift y", shift.1)
                    .flag("flip horizontal", flips.0)
                    .flag("flip vertical", flips.1);
                trial.assert_same_bits();
                for (i, found) in (0..).zip(trial.levels(0)) {
                    let (x, y): (i64, i64) = (i % w, i / w);
                    let x = if flips.0 { -x } else { x };
                    let y = if flips.1 { -y } else { y };
                    let expected = turned(
                        (x - moved(shift.0, w)).rem_euclid(w),
                        (y - moved(shift.1, h)).rem_euclid(h),
                    );
                    assert_eq!(found, expected, "{w} × {h}, {angle}°, {shift:?}, at {i}");
                }
            }
        }
    }

    #[test]
    fn four_quarter_turns_change_nothing() {
        let mut image = image_of_levels(33, &[&picture(33, 33)]);
        let before = image.clone();
        for _ in 0..4 {
            let trial = Trial::of(&BLOCK).size(33, 33).input(IMAGE, image);
            image = trial.int("angle", 90).image();
        }
        assert_eq!(image.channel(0), before.channel(0));
    }
}
