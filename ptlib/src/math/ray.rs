//! Straight lines of pixels, as PT Designer walks them.
//!
//! Specification 2.0: LP, SEG and JUMP. Angles are in radians, counter-clockwise from +x as seen on
//! the screen, where y points down. Positions are whole numbers without bounds: whoever reads or
//! writes pixels wraps them.

use std::f64::consts::{FRAC_PI_2, PI};

use super::{convert, elementary, tangent};

/// A pixel, perhaps outside of the image.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Position {
    /// To the right.
    pub x: i64,
    /// Down.
    pub y: i64,
}

impl Position {
    /// The position at those coordinates.
    #[must_use]
    pub const fn new(x: i64, y: i64) -> Self {
        Self { x, y }
    }

    /// The position that lies `distance` pixels away at `angle`; coordinates are truncated toward
    /// zero after the addition (specification 2.0, JUMP).
    #[must_use]
    pub fn jump(self, distance: f64, angle: f64) -> Self {
        #[expect(clippy::cast_precision_loss, reason = "positions are far below 2⁵²")]
        let (x, y) = (self.x as f64, self.y as f64);
        let (right, up) = heading(angle);
        Self {
            x: convert::truncate64(x + distance * right),
            y: convert::truncate64(y - distance * up),
        }
    }
}

/// How far a jump over one pixel leads to the right and up (specification 2.0, JUMP). For blocks
/// that make many jumps side by side.
#[inline]
#[must_use]
pub fn heading(angle: f64) -> (f64, f64) {
    (elementary::sin64(FRAC_PI_2 + angle), elementary::sin64(angle))
}

/// The pixels in one direction from a start (specification 2.0, LP). They are counted along the
/// axis that the direction is nearer to, so a diagonal ray is longer than its count.
#[derive(Debug, Clone, Copy)]
pub struct Ray {
    start: Position,
    is_steep: bool,
    /// The steps along the two axes, each 1 or -1.
    right: i64,
    down: i64,
    /// Pixels along the minor axis for one along the major axis.
    slope: f64,
}

impl Ray {
    /// The ray from `start` at `angle`.
    #[must_use]
    pub fn new(start: Position, angle: f64) -> Self {
        let (sine, cosine) = (elementary::sin64(angle), elementary::cos64(angle));
        let tangent = elementary::tan64(angle).abs();
        let is_steep = cosine.abs() <= sine.abs();
        Self {
            start,
            is_steep,
            right: if cosine < 0.0 { -1 } else { 1 },
            down: if sine > 0.0 { -1 } else { 1 },
            slope: if is_steep { 1.0 / tangent } else { tangent },
        }
    }

    /// Pixel number `k` of the ray; number 0 is the start.
    #[inline]
    #[must_use]
    pub fn at(&self, k: i64) -> Position {
        #[expect(clippy::cast_precision_loss, reason = "counts of pixels are far below 2⁵²")]
        let minor = convert::round64(k as f64 * self.slope);
        let (x, y) = if self.is_steep { (minor, k) } else { (k, minor) };
        Position { x: self.start.x + self.right * x, y: self.start.y + self.down * y }
    }
}

/// The straight line between two pixels, both included (specification 2.0, SEG).
#[derive(Debug, Clone, Copy)]
pub struct Segment {
    /// The ray from its first pixel through its last.
    pub ray: Ray,
    /// Its direction, 0 < angle ≤ 2π.
    pub angle: f64,
    /// How many pixels it has, at least 1.
    pub count: i64,
}

impl Segment {
    /// The line from `first` to `last`.
    #[must_use]
    pub fn new(first: Position, last: Position) -> Self {
        let (right, up) = (last.x - first.x, first.y - last.y);
        let (angle, slope) = direction(right, up);
        let ray = Ray {
            start: first,
            is_steep: right.abs() < up.abs(),
            right: if right < 0 { -1 } else { 1 },
            down: if up > 0 { -1 } else { 1 },
            slope,
        };
        Self { ray, angle, count: right.abs().max(up.abs()) + 1 }
    }

    /// Its pixels, from the first to the last.
    pub fn pixels(&self) -> impl Iterator<Item = Position> {
        let ray = self.ray;
        (0..self.count).map(move |k| ray.at(k))
    }
}

/// The angle of a line, 0 < angle ≤ 2π, and its pixels along the minor axis for one along the major
/// axis.
///
/// PT Designer finds the angle by the arc tangent in the first quarter of the turn and turns it to
/// its own; for the slope it turns back and takes the tangent. All of these are rounded, so a slope
/// of 1/2 comes out a little smaller or larger, and a different one in each quarter. Where that
/// decides between two pixels, it is followed to the last bit.
fn direction(right: i64, up: i64) -> (f64, f64) {
    #[expect(clippy::cast_precision_loss, reason = "distances are far below 2⁵²")]
    let (across, along) = (right.abs() as f64, up.abs() as f64);
    if right == 0 || up == 0 {
        let angle = match (right < 0, up > 0, up < 0) {
            (_, true, _) => FRAC_PI_2,
            (_, _, true) => 3.0 * FRAC_PI_2,
            (true, ..) => PI,
            (false, ..) => 2.0 * PI,
        };
        return (angle, 0.0);
    }
    let quotient = along / across;
    // Some pixel lies half-way between two if and only if the longer side, reduced, is even.
    let (longer, shorter) = (right.abs().max(up.abs()), right.abs().min(up.abs()));
    let has_ties = longer.trailing_zeros() > shorter.trailing_zeros();
    let (arc, excess) =
        if has_ties { tangent::arc_tangent(quotient) } else { (libm::atan(quotient), 0.0) };
    let (angle, back) = match (right > 0, up > 0) {
        (true, true) => (arc, arc),
        (false, true) => (PI - arc, PI - (PI - arc)),
        (false, false) => (PI + arc, (PI + arc) - PI),
        (true, false) => (2.0 * PI - arc, 2.0 * PI - (2.0 * PI - arc)),
    };
    let tangent = match has_ties {
        true => tangent::tangent_near(quotient, excess + (back - arc)),
        false => quotient,
    };
    (angle, if along > across { 1.0 / tangent } else { tangent })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn at(x: i64, y: i64) -> Position {
        Position::new(x, y)
    }

    #[test]
    fn rays_count_along_their_major_axis() {
        let start = at(10, 20);
        assert_eq!(Ray::new(start, 0.0).at(5), at(15, 20));
        assert_eq!(Ray::new(start, PI).at(5), at(5, 20));
        assert_eq!(Ray::new(start, FRAC_PI_2).at(5), at(10, 15));
        assert_eq!(Ray::new(start, -FRAC_PI_2).at(5), at(10, 25));
        assert_eq!(Ray::new(start, PI / 4.0).at(5), at(15, 15));
        assert_eq!(Ray::new(start, 5.0 * PI / 4.0).at(5), at(5, 25));
        // tan 30° = 0.577: 3 pixels to the right are 1.73 up.
        assert_eq!(Ray::new(start, PI / 6.0).at(3), at(13, 18));
        assert_eq!(Ray::new(start, PI / 3.0).at(3), at(12, 17));
        assert_eq!(Ray::new(start, 1.0).at(0), start);
    }

    #[test]
    fn segments_have_both_ends() {
        for (first, last, count) in [
            (at(0, 0), at(7, 3), 8),
            (at(0, 0), at(-3, 7), 8),
            (at(5, -2), at(-9, -2), 15),
            (at(4, 4), at(4, 4), 1),
            (at(-3, -5), at(20, -60), 56),
        ] {
            let pixels: Vec<_> = Segment::new(first, last).pixels().collect();
            assert_eq!((pixels[0], pixels[pixels.len() - 1]), (first, last));
            assert_eq!(pixels.len(), count);
            for pair in pixels.windows(2) {
                let step = (pair[1].x - pair[0].x).abs().max((pair[1].y - pair[0].y).abs());
                assert_eq!(step, 1, "{pair:?}");
            }
        }
        assert_eq!(Segment::new(at(0, 0), at(9, 0)).angle, 2.0 * PI);
    }

    /// Which of two pixels is drawn where a line passes half-way between them, as seen in pictures
    /// of PT Designer.
    #[test]
    fn ties_go_where_the_original_draws_them() {
        for (right, up, k, is_farther) in [
            (4, 2, 1, false),
            (4, 2, 3, false),
            (-4, 2, 1, true),
            (-4, -2, 3, true),
            (4, -2, 1, true),
            (-2, -1, 1, true),
            (-1, -2, 1, true),
            (1, -2, 1, true),
            (2, -1, 1, true),
            (6, -1, 3, true),
            (10, 1, 5, true),
            (10, 3, 5, true),
            (7, 8, 4, true),
            (-8, 7, 4, true),
            (-1, 10, 5, false),
            (3, 10, 5, false),
        ] {
            let pixel = Segment::new(at(0, 0), at(right, -up)).ray.at(k);
            let (longer, shorter) = (right.abs().max(up.abs()), right.abs().min(up.abs()));
            let minor = k * shorter / longer + i64::from(is_farther);
            let found = if right.abs() > up.abs() { pixel.y.abs() } else { pixel.x.abs() };
            assert_eq!(found, minor, "({right}, {up}) at {k}");
        }
    }

    #[test]
    fn angles_of_segments_grow_counter_clockwise() {
        for (degrees, right, up) in [
            (45.0, 1, 1),
            (90.0, 0, 5),
            (135.0, -7, 7),
            (180.0, -3, 0),
            (225.0, -2, -2),
            (270.0, 0, -1),
            (315.0, 6, -6),
            (360.0, 1, 0),
            (360.0, 0, 0),
        ] {
            let angle = Segment::new(at(3, 4), at(3 + right, 4 - up)).angle;
            assert!((angle.to_degrees() - degrees).abs() < 1e-9, "({right}, {up}): {angle}");
        }
    }

    #[test]
    fn jumps_truncate_toward_zero() {
        assert_eq!(at(10, 10).jump(5.9, 0.0), at(15, 10));
        assert_eq!(at(-1, 0).jump(0.5, 0.0), at(0, 0));
        assert_eq!(at(3, 0).jump(4.5, PI / 6.0), at(6, -2));
    }
}
