//! Parallax occlusion: where the ray through a pixel meets a height map.
//!
//! The ray comes from height 1 and goes down to 0. A linear search takes equal steps and stops at
//! the first height that reaches the ray; a binary search then halves the step, down if the ray is
//! above the heights and back if not. The binary search alone may find a crossing behind the first,
//! which shows as a notch; with eight linear steps or more for each wrinkle that the ray passes,
//! the first one is rarely missed.
//!
//! Some rays are searched side by side, so that the loops become vector instructions; each ray has
//! the bits that it has alone.

use ptlib_plugin::choice;

choice! {
    /// How the point that is seen is searched for.
    Search {
        /// Equal steps alone: sees the nearest wrinkle, in terraces.
        Linear = "linear",
        /// Halved steps alone: smooth, but it may see a farther wrinkle through a nearer one.
        Binary = "binary",
        /// Equal steps, then halved ones: the best picture for its time.
        Combined = "combined",
        /// None: normals alone make the relief.
        Off = "off",
    }
}

/// The steps of a search.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Steps {
    linear: u16,
    binary: u16,
}

impl Steps {
    /// None if nothing is searched.
    pub fn new(search: Search, linear: u16, binary: u16) -> Option<Self> {
        match search {
            Search::Linear => Some(Self { linear: linear.max(1), binary: 0 }),
            Search::Binary => Some(Self { linear: 0, binary }),
            Search::Combined => Some(Self { linear: linear.max(1), binary }),
            Search::Off => None,
        }
    }

    /// The heights at which rays meet the map; `height` gives what it has below the rays when they
    /// are at some heights. At most 1/(linear · 2^binary) below the crossing that was found.
    #[inline(always)]
    pub fn search<const N: usize>(self, height: impl Fn(&[f32; N]) -> [f32; N]) -> [f32; N] {
        let (mut low, mut step) = if self.linear == 0 {
            ([0.0; N], 1.0)
        } else {
            (self.first(&height), 1.0 / f32::from(self.linear))
        };
        for _ in 0..self.binary {
            step /= 2.0;
            let middle = low.map(|z| z + step);
            let heights = height(&middle);
            for i in 0..N {
                low[i] = if heights[i] >= middle[i] { middle[i] } else { low[i] };
            }
        }
        low
    }

    /// The first of the equal steps at which the map reaches the ray.
    #[inline(always)]
    fn first<const N: usize>(self, height: &impl Fn(&[f32; N]) -> [f32; N]) -> [f32; N] {
        // Until a ray has met the map, its place is below everything.
        let mut found = [-1.0_f32; N];
        for i in 1..=self.linear {
            let z = 1.0 - f32::from(i) / f32::from(self.linear);
            let heights = height(&[z; N]);
            let mut all = true;
            for i in 0..N {
                let is_first = found[i] < 0.0 && heights[i] >= z;
                found[i] = if is_first { z } else { found[i] };
                all &= found[i] >= 0.0;
            }
            if all {
                break;
            }
        }
        // At height 0 everything is met.
        found.map(|z| z.max(0.0))
    }
}

#[cfg(test)]
mod tests {
    use ptlib_plugin::math;

    use super::*;
    use crate::testing;

    /// Where one ray meets a map, which is a function of u.
    fn meet(steps: Steps, map: impl Fn(f32) -> f32, u: f32, shift: f32) -> f32 {
        steps.search(|z: &[f32; 1]| [map(u - shift * (1.0 - z[0]))])[0]
    }

    fn steps(search: Search, linear: u16, binary: u16) -> Steps {
        Steps::new(search, linear, binary).unwrap()
    }

    #[test]
    fn two_ridges_are_met_as_the_specification_says() {
        let ridges = |u: f32| match u {
            u if (0.50..0.52).contains(&u) => 0.9,
            u if (0.40..0.44).contains(&u) => 0.5,
            _ => 0.0,
        };
        let found =
            |search, linear, binary| meet(steps(search, linear, binary), ridges, 0.553, 0.16);
        assert_eq!(found(Search::Linear, 4, 4), 0.75);
        assert_eq!(found(Search::Linear, 8, 0), 0.75);
        assert_eq!(found(Search::Combined, 8, 4), 0.789_062_5);
        assert_eq!(found(Search::Combined, 4, 4), 0.781_25);
        // These see the far ridge through the near one.
        assert_eq!(found(Search::Binary, 8, 4), 0.25);
        assert!((found(Search::Binary, 8, 12) - 0.293_701).abs() < 1e-6);
        assert!((found(Search::Combined, 6, 6) - 0.291_667).abs() < 1e-6);
    }

    #[test]
    fn flat_skin_keeps_its_level_to_the_bit() {
        for search in [Search::Linear, Search::Binary, Search::Combined] {
            for linear in [1, 3, 7, 8, 255] {
                assert_eq!(meet(steps(search, linear, 9), |_| 0.0, 0.3, 0.2), 0.0);
            }
        }
        assert_eq!(Steps::new(Search::Off, 8, 4), None);
        assert!(meet(steps(Search::Combined, 8, 9), |_| 1.0, 0.3, 0.2) < 1.0, "below the top");
    }

    /// Mean error, and the share of rays that are more than 0.15 off, over 8,192 rays that pass one
    /// wrinkle of |sin πu|.
    fn errors(search: Steps, reference: &[f32]) -> [f64; 2] {
        let wrinkles = |u: f32| math::single(math::sin(std::f64::consts::PI * f64::from(u)).abs());
        let (mut sum, mut far) = (0.0, 0.0);
        for (i, rays) in reference.chunks(8).enumerate() {
            let start: [f32; 8] = std::array::from_fn(|lane| place(8 * i + lane));
            let found = search.search(|z: &[f32; 8]| {
                std::array::from_fn(|lane| wrinkles(start[lane] - (1.0 - z[lane])))
            });
            for (found, expected) in found.iter().zip(rays) {
                let error = f64::from((found - expected).abs());
                sum += error;
                far += f64::from(u8::from(error > 0.15));
            }
        }
        [sum, far].map(|x| x / reference.len() as f64)
    }

    #[expect(clippy::cast_precision_loss, reason = "a small number")]
    fn place(ray: usize) -> f32 {
        (ray as f32 + 0.5) / 8192.0
    }

    /// The first crossing by many small steps, found exactly: z rises along the ray as u falls.
    fn reference() -> Vec<f32> {
        let heights: Vec<f64> = (0..=80_000)
            .map(|i| math::sin(std::f64::consts::PI * f64::from(i) / 40_000.0).abs())
            .collect();
        let ray = |ray: usize| {
            let start = (f64::from(place(ray)) * 40_000.0 + 40_000.0).round();
            let mut z = 1.0;
            for step in 1..=40_000_u32 {
                z = 1.0 - f64::from(step) / 40_000.0;
                let place = start - f64::from(step);
                #[expect(clippy::cast_possible_truncation, reason = "0 to 80,000")]
                #[expect(clippy::cast_sign_loss, reason = "0 to 80,000")]
                if heights[place as usize] >= z {
                    break;
                }
            }
            math::single(z)
        };
        (0..8192).map(ray).collect()
    }

    #[test]
    fn the_findings_about_steps_hold() {
        let _host = testing::engine();
        let reference = reference();
        let error = |search, linear, binary| errors(steps(search, linear, binary), &reference);
        // Mean error in height, and percent of rays that see the wrong wrinkle; 12 reads each.
        let expected = [
            (error(Search::Linear, 12, 0), 0.0476, 0.4),
            (error(Search::Binary, 0, 12), 0.1410, 21.8),
            (error(Search::Combined, 4, 8), 0.0435, 7.1),
            (error(Search::Combined, 6, 6), 0.0196, 3.1),
            (error(Search::Combined, 8, 4), 0.0127, 1.5),
        ];
        for ([mean, share], expected_mean, percent) in expected {
            assert!((mean / expected_mean - 1.0).abs() < 0.1, "{mean}, not {expected_mean}");
            // Half of the last digit that is given counts besides.
            let distance = (share * 100.0 - percent).abs();
            assert!(distance < 0.1 * percent + 0.05, "{}, not {percent}", share * 100.0);
        }
        let means = expected.map(|([mean, _], ..)| mean);
        assert!(means[4] < means[3] && means[3] < means[2] && means[2] < means[0]);
        assert!(means[0] < means[1]);
        let fewer = error(Search::Binary, 0, 8)[1];
        assert!((fewer - expected[1].0[1]).abs() < 0.01, "not a matter of steps: {fewer}");
    }

    #[test]
    fn rays_side_by_side_have_the_bits_that_they_have_alone() {
        let map = |u: f32| (u * 7.3 - (u * 7.3).floor() - 0.5).abs() * 2.0;
        let start: [f32; 8] = std::array::from_fn(|i| 0.1 + 0.11 * place(i * 8000));
        for search in [Search::Linear, Search::Binary, Search::Combined] {
            let search = steps(search, 9, 5);
            let all = search
                .search(|z: &[f32; 8]| std::array::from_fn(|i| map(start[i] - 0.4 * (1.0 - z[i]))));
            assert_eq!(all, start.map(|u| meet(search, map, u, 0.4)));
        }
    }
}
