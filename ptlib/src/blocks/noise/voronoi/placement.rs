//! Where the points of a Voronoi diagram lie (specification 2.1, "Points").

use std::collections::HashSet;

use super::super::super::drawing::walk::{Start, Walk};
use crate::block::prelude::*;

/// The most points of a custom placement.
pub(in crate::blocks::noise) const MAX_CUSTOM: usize = 255;

/// The most points that a turtle places, its start included.
pub(in crate::blocks::noise) const MAX_FOLLOWED: usize = 256;

/// The most memory of the placement of `points` points, in bytes.
pub(in crate::blocks::noise) fn bytes_of(points: u64) -> u64 {
    // The points, and the set of places that are taken at its lowest load.
    points * 64
}

/// Which pixels have a point.
enum Taken {
    /// One bit for each pixel, where that is little memory.
    Bits {
        words: Vec<u64>,
        width: i64,
    },
    Places(HashSet<(i64, i64)>),
}

impl Taken {
    /// None, with room for `count` points.
    fn new(width: u32, height: u32, count: usize) -> Self {
        let words = (width as usize * height as usize).div_ceil(64);
        if words <= 4 * count {
            Self::Bits { words: vec![0; words], width: width.into() }
        } else {
            Self::Places(HashSet::with_capacity(count))
        }
    }

    /// Takes a pixel; returns whether it had no point.
    fn insert(&mut self, (x, y): (i64, i64)) -> bool {
        match self {
            Self::Bits { words, width } => {
                let place = convert::index(y * *width + x);
                let (word, bit) = (&mut words[place / 64], 1 << (place % 64));
                let is_new = *word & bit == 0;
                *word |= bit;
                is_new
            }
            Self::Places(places) => places.insert((x, y)),
        }
    }
}

/// What placements are made from.
#[derive(Debug, Clone, Copy)]
pub(in crate::blocks::noise) struct Layout {
    /// Size of the image.
    pub(in crate::blocks::noise) width: u32,
    /// Size of the image.
    pub(in crate::blocks::noise) height: u32,
    /// The length that the user gave, in pixels.
    pub(in crate::blocks::noise) length: i64,
    /// The number of points that the user gave.
    pub(in crate::blocks::noise) count: i64,
    /// Whether the places are those of float precision: what lies beyond the image comes back on
    /// the other side, and nothing but the place itself is rounded to pixels, so that points lie
    /// alike at every resolution.
    pub(in crate::blocks::noise) is_exact: bool,
}

pub(in crate::blocks::noise) type Places = Vec<(i64, i64)>;

impl Layout {
    fn wrapped(&self, x: i64, y: i64) -> (i64, i64) {
        (convert::wrap(x, self.width).into(), convert::wrap(y, self.height).into())
    }

    /// The place of a point of a figure.
    fn place(&self, x: i64, y: i64) -> (i64, i64) {
        if self.is_exact { self.wrapped(x, y) } else { (x, y) }
    }

    /// A length that is not negative, in whole pixels.
    fn whole(&self, length: f64) -> i64 {
        convert::truncate64(if self.is_exact { length + 0.5 } else { length })
    }

    fn middle(&self) -> (i64, i64) {
        (i64::from(self.width / 2), i64::from(self.height / 2))
    }

    /// Places that all differ.
    pub(in crate::blocks::noise) fn random(&self, cx: &Context<'_>) -> Result<Places, Error> {
        let count = convert::index(self.count).min(self.width as usize * self.height as usize);
        let mut taken = Taken::new(self.width, self.height, count);
        let mut places = Vec::with_capacity(count);
        let mut next_seed = cx.seed32();
        // A hash need not reach every pixel of a small image, so there is an end to trying.
        let mut tries = 16 * count + 4096;
        for i in (0_i32..).take(count) {
            cx.check()?;
            let mut seed = next_seed;
            loop {
                let x = elias::noise64(i.wrapping_add(seed.wrapping_mul(2))).abs();
                let y = elias::noise64(i.wrapping_mul(10).wrapping_add(seed)).abs();
                let x = convert::truncate64(x * f64::from(self.width));
                let y = convert::truncate64(y * f64::from(self.height));
                let place = self.wrapped(x, y);
                if taken.insert(place) {
                    places.push(place);
                    break;
                }
                if tries == 0 {
                    return Ok(places);
                }
                tries -= 1;
                seed = seed.wrapping_add(1);
                // The next seed stays for the points that follow (specification, appendix A). But
                // whether two points meet depends on the resolution.
                next_seed = if self.is_exact { next_seed } else { seed };
            }
        }
        Ok(places)
    }

    /// Along the sides of a square around the middle.
    pub(in crate::blocks::noise) fn square(&self) -> Places {
        let steps = self.count.max(2) - 1;
        let (x, y) = self.middle();
        let half = self.length / 2;
        let (left, right, top, bottom) = (x - half, x + half, y - half, y + half);
        let corners = [(left, top), (right, top), (right, bottom), (left, bottom)];
        let between = (1..steps).flat_map(|i| {
            let along = i * self.length / steps;
            [
                (left + along, top),
                (right, top + along),
                (right - along, bottom),
                (left, bottom - along),
            ]
        });
        corners.into_iter().chain(between).map(|(x, y)| self.place(x, y)).collect()
    }

    /// Along a circle around the middle, counter-clockwise from the right.
    pub(in crate::blocks::noise) fn circle(&self) -> Places {
        let (x, y) = self.middle();
        let count = self.count.max(0);
        let place = |i: i64| {
            // The quarter of the turn, and the rest of the way into it.
            let (quarter, rest) = (4 * i / count, 4 * i % count);
            #[expect(clippy::cast_precision_loss, reason = "lengths and counts below 2⁵³")]
            let (radius, part) = (self.length as f64, rest as f64 / count as f64);
            let b = radius * elementary::sin64(part * std::f64::consts::FRAC_PI_2);
            // Q: the whole-numbered `b` moves `a` by many pixels where the circle is steep.
            let a = if self.is_exact {
                radius * elementary::sin64((1.0 - part) * std::f64::consts::FRAC_PI_2)
            } else {
                (radius * radius - b.trunc() * b.trunc()).sqrt()
            };
            let (a, b) = (self.whole(a), self.whole(b));
            let (across, down) = match quarter {
                0 => (a, -b),
                1 => (-b, -a),
                2 => (-a, b),
                _ => (b, a),
            };
            self.place(x + across, y + down)
        };
        (0..count).map(place).collect()
    }

    /// Along horizontal and vertical arms from the middle.
    pub(in crate::blocks::noise) fn horizontal_cross(&self) -> Places {
        let steps = self.count.max(2) - 1;
        // Q: whole steps, so that an arm may be shorter by almost as many pixels as it has steps.
        let step = self.length / steps;
        let along = |i| if self.is_exact { self.length * i / steps } else { step * i };
        self.cross(along, [(-1, 0), (1, 0), (0, 1), (0, -1)])
    }

    /// Along diagonal arms from the middle.
    pub(in crate::blocks::noise) fn diagonal_cross(&self) -> Places {
        let steps = self.count.max(2) - 1;
        let step = self.length / steps;
        #[expect(clippy::cast_precision_loss, reason = "lengths below 2⁵³")]
        let step = if self.is_exact {
            (0.5_f64).sqrt() * self.length as f64 / steps as f64
        } else {
            ((step * step / 2) as f64).sqrt()
        };
        #[expect(clippy::cast_precision_loss, reason = "counts below 2⁵³")]
        let along = |i: i64| self.whole(step * i as f64);
        self.cross(along, [(-1, -1), (1, 1), (-1, 1), (1, -1)])
    }

    fn cross(&self, along: impl Fn(i64) -> i64, arms: [(i64, i64); 4]) -> Places {
        let (x, y) = self.middle();
        let mut places = vec![self.place(x, y)];
        for i in 1..self.count.max(2) {
            let along = along(i);
            places
                .extend(arms.map(|(right, down)| self.place(x + right * along, y + down * along)));
        }
        places
    }

    /// Where the turtle of a text starts, and where its lines end.
    pub(in crate::blocks::noise) fn followed(
        &self,
        text: &str,
        start: Start,
        cx: &Context<'_>,
    ) -> Result<Places, Error> {
        let mut walk = Walk::new(text, start, cx);
        // BUG: the original does not wrap them, which is wrong beyond one period.
        let wrapped = |at: ray::Position| self.wrapped(at.x, at.y);
        let mut places = vec![wrapped(walk.position())];
        while places.len() < MAX_FOLLOWED
            && let Some(line) = walk.next_line(cx)?
        {
            places.push(wrapped(line.to));
        }
        Ok(places)
    }

    /// Where a list `x:y,x:y,…` says. The separators may be any characters; the list ends where
    /// it stops making sense.
    pub(in crate::blocks::noise) fn custom(&self, mut list: &str) -> Places {
        let mut places = Vec::new();
        while places.len() < MAX_CUSTOM {
            let Some((x, rest)) = decimal::prefix(list) else { break };
            let Some((y, rest)) = decimal::prefix(after_separator(rest)) else { break };
            list = after_separator(rest);
            let x = convert::truncate64(x * f64::from(self.width - 1));
            let y = convert::truncate64(y * f64::from(self.height - 1));
            places.push(self.wrapped(x, y));
        }
        places
    }
}

/// What follows the first character that is not blank.
fn after_separator(text: &str) -> &str {
    let mut rest = text.trim_start().chars();
    rest.next();
    rest.as_str()
}

#[cfg(test)]
mod tests {
    use super::*;

    const LAYOUT: Layout = Layout { width: 100, height: 60, length: 20, count: 3, is_exact: true };

    #[test]
    fn a_square_has_points_on_each_side() {
        let corners = [(40, 20), (60, 20), (60, 40), (40, 40)];
        let halfway = [(50, 20), (60, 30), (50, 40), (40, 30)];
        assert_eq!(LAYOUT.square(), [corners, halfway].concat());
        assert_eq!(Layout { count: 0, ..LAYOUT }.square(), corners);
    }

    #[test]
    fn a_circle_has_its_points_at_equal_angles() {
        let circle = Layout { count: 4, ..LAYOUT }.circle();
        assert_eq!(circle, [(70, 30), (50, 10), (30, 30), (50, 50)]);
        // 60°: b = ⌊20 · sin 60°⌋ = 17, a = ⌊√(20² - 17²)⌋ = 10.
        assert_eq!(Layout { count: 6, ..LAYOUT }.circle()[1], (60, 13));
        // 67.5°: b = 18.478, a = 7.654; in 8-bit precision ⌊√(20² - 18²)⌋ = 8.
        assert_eq!(Layout { count: 16, ..LAYOUT }.circle()[3], (58, 12));
        // 82.5°: b = 19.829, a = 2.611; in 8-bit precision ⌊√(20² - 19²)⌋ = 6.
        let many = Layout { count: 48, ..LAYOUT };
        assert_eq!(many.circle()[11], (53, 10));
        assert_eq!(Layout { is_exact: false, ..many }.circle()[11], (56, 11));
        assert!(Layout { count: 0, ..LAYOUT }.circle().is_empty());
    }

    #[test]
    fn crosses_have_four_arms() {
        let arms = [(40, 30), (60, 30), (50, 40), (50, 20)];
        let cross = LAYOUT.horizontal_cross();
        assert_eq!((cross[0], &cross[1..5], cross.len()), ((50, 30), &arms[..], 9));
        // The step is √⌊10²/2⌋ = 7.07.
        let cross = LAYOUT.diagonal_cross();
        assert_eq!(cross[1..5], [(43, 23), (57, 37), (43, 37), (57, 23)]);
        assert_eq!(cross[5..], [(36, 16), (64, 44), (36, 44), (64, 16)]);
    }

    #[test]
    fn in_float_precision_arms_are_as_long_as_the_user_says() {
        let exact = Layout { length: 48, count: 15, ..LAYOUT };
        let whole_steps = Layout { is_exact: false, ..exact };
        assert_eq!(exact.horizontal_cross()[4 * 14 - 2], (98, 30));
        assert_eq!(whole_steps.horizontal_cross()[4 * 14 - 2], (92, 30));
        assert_eq!(exact.diagonal_cross()[4 * 14 - 2], (84, 4));
        // The step is √⌊3²/2⌋ = 2.
        assert_eq!(whole_steps.diagonal_cross()[4 * 14 - 2], (78, 58));
    }

    #[test]
    fn points_beyond_the_edges_come_back_on_the_other_side() {
        let cross = Layout { length: 70, count: 2, ..LAYOUT }.horizontal_cross();
        assert_eq!(cross[1..], [(80, 30), (20, 30), (50, 40), (50, 20)]);
        let cross = Layout { length: 70, count: 2, is_exact: false, ..LAYOUT }.horizontal_cross();
        assert_eq!(cross[1..], [(-20, 30), (120, 30), (50, 100), (50, -40)]);
    }

    #[test]
    fn custom_points_are_read_leniently() {
        let places = |list| LAYOUT.custom(list);
        assert_eq!(places("0:0,1:1,0.5:0.5,"), [(0, 0), (99, 59), (49, 29)]);
        assert_eq!(places(" .5 ; 5e-1 / -1:2"), [(49, 29), (1, 58)]);
        assert_eq!(places(""), []);
        assert_eq!(places("0.5"), []);
        assert_eq!(places("0:0,x:1"), [(0, 0)]);
        assert_eq!(places("0:0é1:é"), [(0, 0)]);
        assert_eq!(places(&"0:0,".repeat(300)).len(), MAX_CUSTOM);
    }
}
