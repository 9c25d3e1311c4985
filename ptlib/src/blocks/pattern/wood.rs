//! Wood: rings around the middle that noise pushes away.
//!
//! Specification 2.17. PT Designer draws the rings into a frame around the image too, as wide as
//! the noise pushes at most, and lets the frame come back in at the opposite edges; where several
//! rings meet, the darkest wins. [`Rings`] finds them from the pixel's side.

// Pictured: `circles` `2`, `intensity` `8`, `hardness` `3`.
// Pictured: `circles` `9`, `hardness` `3`, `intensity` `40`, `direction` `down`.

use super::{
    super::noise::lattice::LatticeNoise,
    grain::{self, Direction},
    rings::{PIECE, Rings},
};
use crate::block::prelude::*;

const NOISE: usize = 0;

params! {
    /// Parameters of [`BLOCK`].
    Params {
        /// How many rings there are. 0 gives plain white.
        circles: int [hard 0..=999999 soft 0..=50] = 4;
        /// How thin the rings are; 0 is as 1.
        hardness: int [hard 0..=99999 soft 0..=50] = 8;
        /// How far white noise pushes the rings. 0 leaves them round.
        intensity: int [hard 0..=999999 soft 0..=100 unit "% of the width"] = 20;
        /// How dark the rings are, in levels of 255. 0 gives plain white.
        amplitude: int [hard 0..=255 soft 0..=128] = 127;
        /// The direction in which the noise pushes.
        direction: choice [Direction] = Direction::Right;
    }
}

/// The block as everybody else sees it.
pub static BLOCK: BlockSpec = BlockSpec::point::<Wood>(About {
    id: "wood",
    summary: "Dark rings, distorted by noise.",
    inputs: &[input("noise", Kind::Image).optional()],
    outputs: &[output("image", Planes::Grey)],
    uses_seed: true,
    ..About::DEFAULT
});

struct Wood {
    /// What pushes the rings, unless an input does or nothing shall.
    noise: Option<LatticeNoise>,
    rings: Rings,
}

impl PointBlock for Wood {
    type Params = Params;

    fn prepare<L: Levels>(params: &Params, cx: &PrepareContext<'_>) -> Result<Self, Error> {
        let rings = Rings::new::<L>(params, cx.width, cx.height);
        let noise = if cx.is_connected(NOISE) || rings.are_round() {
            None
        } else {
            Some(LatticeNoise::new::<L>(&grain::noise(), cx.seed32(), cx)?)
        };
        Ok(Self { noise, rings })
    }

    #[inline(always)]
    fn row<L: Levels>(&self, cx: &RowContext<'_>, inputs: &InputRows<'_>, out: &mut OutputRow<'_>) {
        let out = out.grey();
        if let Some(noise) = &self.noise {
            noise.write_row::<L>(cx, out);
        } else if self.rings.are_round() {
            out.fill(0.0);
        } else {
            out.copy_from_slice(inputs.channel(NOISE, 0));
        }
        for (piece, x) in out.chunks_mut(PIECE).zip((cx.x..).step_by(PIECE)) {
            self.rings.draw::<L>(x, cx.y, piece);
        }
    }

    fn scratch_bytes(_: &Params, width: u32, height: u32) -> u64 {
        grain::noise().scratch_bytes(width, height)
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::PI;

    use super::*;
    use crate::block::testing::{Trial, image_of_levels};

    fn noise(count: u32) -> Vec<u8> {
        (0..count).map(|i| (i * i % 251).to_le_bytes()[0]).collect()
    }

    struct Case {
        size: (u32, u32),
        circles: i32,
        hardness: i32,
        intensity: i32,
        direction: u32,
    }

    impl Case {
        fn trial(&self) -> Trial {
            let (width, height) = self.size;
            Trial::of(&BLOCK)
                .size(width, height)
                .input(NOISE, image_of_levels(width, &[&noise(width * height)]))
                .int("circles", self.circles)
                .int("hardness", self.hardness)
                .int("intensity", self.intensity)
                .choice("direction", self.direction)
        }

        /// As the specification tells it: every pixel of the frame is drawn.
        fn naive(&self) -> Vec<u8> {
            let (w, h) = (i64::from(self.size.0), i64::from(self.size.1));
            let noise = noise(self.size.0 * self.size.1);
            let j = w * i64::from(self.intensity) / 100;
            let radius = (w.max(h) / 2) as f64;
            let exponent = f64::from(if self.hardness == 0 { 2 } else { 2 * self.hardness });
            let mut levels = vec![255_u8; noise.len()];
            for (x, y) in (-j..h + j).flat_map(|y| (-j..w + j).map(move |x| (x, y))) {
                let place = convert::index(y.rem_euclid(h) * w + x.rem_euclid(w));
                let o = j * i64::from(noise[place]) / 255;
                let dx = w / 2 - x + [o, 0, o, -o][self.direction as usize];
                let dy = h / 2 - y + [0, o, o, o][self.direction as usize];
                let d = ((dx * dx + dy * dy) as f64).sqrt();
                if d <= radius && radius > 0.0 {
                    let sine = elementary::sin64(PI * f64::from(self.circles) * d / radius);
                    let amount = 127.0 * elementary::power64(sine, exponent);
                    let level = 255 - u8::try_from(convert::truncate64(amount)).unwrap();
                    levels[place] = levels[place].min(level);
                }
            }
            levels
        }
    }

    #[test]
    fn levels_are_those_of_the_specification() {
        let black = image_of_levels(64, &[&[0; 64 * 64]]);
        let trial = Trial::of(&BLOCK).size(64, 64).input(NOISE, black);
        let levels = trial.int("circles", 2).int("hardness", 1).levels(0);
        let found: Vec<_> = levels[32 * 64..].iter().step_by(4).take(9).copied().collect();
        assert_eq!(found, [255, 192, 128, 192, 255, 192, 128, 192, 255]);
    }

    #[test]
    fn gathered_levels_equal_scattered_ones() {
        let case = |size, circles, hardness, intensity, direction| Case {
            size,
            circles,
            hardness,
            intensity,
            direction,
        };
        for case in [
            case((64, 64), 4, 8, 20, 0),
            case((65, 64), 7, 0, 12, 1),
            case((97, 40), 4, 2, 35, 2),
            case((40, 97), 5, 3, 250, 3),
            case((63, 63), 3, 1, 0, 2),
            case((90, 20), 3, 30, 5, 0),
            case((20, 90), 6, 1, 100, 1),
            case((1, 1), 2, 1, 300, 0),
            case((2, 30), 2, 1, 50, 3),
            case((100, 1), 2, 2, 10, 2),
            case((50, 50), 40, 99_999, 20, 0),
        ] {
            let levels = case.trial().levels(0);
            for (i, (level, expected)) in levels.iter().zip(case.naive()).enumerate() {
                assert_eq!(
                    *level, expected,
                    "{:?}, direction {}, at {i}",
                    case.size, case.direction
                );
            }
            case.trial().assert_same_bits();
            case.trial().eight_bit().assert_same_bits();
        }
    }

    #[test]
    fn float_precision_stays_near() {
        // Pushed by nothing, the two differ by truncation only.
        let trial = Trial::of(&BLOCK).size(64, 64).int("intensity", 0);
        let levels = trial.levels(0);
        for (value, level) in trial.image().channel(0).iter().zip(levels) {
            let difference = value * 255.0 - f32::from(level);
            assert!((-1.01..0.01).contains(&difference), "{difference}");
        }
    }

    #[test]
    fn extremes_are_harmless() {
        for id in ["circles", "intensity"] {
            Trial::of(&BLOCK).size(40, 24).int(id, 999_999).image();
            Trial::of(&BLOCK).size(24, 40).int(id, 999_999).levels(0);
        }
        assert_eq!(Trial::of(&BLOCK).int("circles", 0).levels(0), [255; 64 * 64]);
        let seeded = Trial::of(&BLOCK).seed(5);
        assert_ne!(Trial::of(&BLOCK).levels(0), seeded.levels(0));
    }
}
