//! Straight lines: squares of the pen's width, stamped at every pixel or at every few.
//!
//! Stamps that touch each other overlap in nearly all of their pixels. As a colour covers what was
//! there, only their union matters; and in each row of pixels that is one span, because a line
//! never turns back. So a line costs what it covers, not its length times the square of its width.

use super::{Canvas, Pen};
use crate::block::prelude::*;

/// The stamps of a line.
struct Stamps {
    ray: ray::Ray,
    /// The place of the first one on the ray, and how far each is from the one before.
    first: i64,
    period: i64,
    count: i64,
    /// Width and height of each.
    side: i64,
}

impl Stamps {
    /// The top left pixel of stamp number `i`.
    #[inline]
    fn at(&self, i: i64) -> ray::Position {
        let middle = self.ray.at(self.first + i * self.period);
        ray::Position::new(middle.x - self.side / 2, middle.y - self.side / 2)
    }
}

/// Pixels that the effort for one span weighs as much as.
const SPAN: i64 = 16;

/// Draws a line.
pub(super) fn draw(
    canvas: &mut Canvas<'_>,
    segment: &ray::Segment,
    pen: &Pen,
) -> Result<(), Error> {
    let period = pen.gap + 1;
    // Widths are reduced to 0..256 (specification 2.45): 256 px draw nothing.
    let side = pen.width % 256;
    let count = if side == 0 { 0 } else { segment.count / period };
    let stamps = Stamps { ray: segment.ray, first: pen.gap, period, count, side };
    let color = pen.color.map(f32::from);
    if count == 0 {
        Ok(())
    } else if period <= side {
        sweep(canvas, &stamps, color)
    } else {
        (0..count).try_for_each(|i| stamp(canvas, stamps.at(i), side, color))
    }
}

/// Draws stamps that do not touch each other.
fn stamp(
    canvas: &mut Canvas<'_>,
    corner: ray::Position,
    side: i64,
    color: [f32; 3],
) -> Result<(), Error> {
    (0..side).try_for_each(|row| {
        let start = ray::Position::new(corner.x, corner.y + row);
        canvas.cover(start, side, color)
    })
}

/// Draws stamps of which each touches the next, row by row from the top.
fn sweep(canvas: &mut Canvas<'_>, stamps: &Stamps, color: [f32; 3]) -> Result<(), Error> {
    let last = stamps.count - 1;
    let is_upward = stamps.at(last).y < stamps.at(0).y;
    let at = |i: i64| stamps.at(if is_upward { last - i } else { i });
    // The stamps from `first` to before `end` reach the present row.
    let (mut first, mut end) = (0, 0);
    for row in at(0).y..at(last).y + stamps.side {
        first = advance(first, stamps.count, |i| at(i).y + stamps.side <= row);
        end = advance(end, stamps.count, |i| at(i).y <= row);
        let (a, b) = (at(first).x, at(end - 1).x);
        let start = ray::Position::new(a.min(b), row);
        canvas.cover(start, (a - b).abs() + stamps.side, color)?;
    }
    Ok(())
}

/// The first number from `start` on, below `end`, for which `is_before` does not hold; it holds for
/// those before. Takes time in proportion to the logarithm of the distance.
fn advance(start: i64, end: i64, is_before: impl Fn(i64) -> bool) -> i64 {
    let (mut low, mut step) = (start, 1);
    while low + step <= end && is_before(low + step - 1) {
        low += step;
        step *= 2;
    }
    // It holds before `low`; it does not hold at `high`, or that is the end.
    let mut high = end.min(low + step - 1);
    while low < high {
        let middle = low + (high - low) / 2;
        if is_before(middle) {
            low = middle + 1;
        } else {
            high = middle;
        }
    }
    low
}

impl Canvas<'_> {
    /// Covers a span of a row.
    fn cover(&mut self, start: ray::Position, length: i64, color: [f32; 3]) -> Result<(), Error> {
        let length = length.min(i64::from(self.width));
        self.effort.spend((length + SPAN).unsigned_abs())?;
        let width = self.width as usize;
        let left = convert::wrap_near(start.x, self.width) as usize;
        let row = convert::wrap_near(start.y, self.height) as usize * width;
        let right = left + convert::index(length);
        for (plane, level) in self.planes.iter_mut().zip(color) {
            let row = &mut plane[row..row + width];
            row[left..right.min(width)].fill(level);
            row[..right.saturating_sub(width)].fill(level);
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn advancing_finds_where_a_condition_ends() {
        for end in 0..40 {
            for place in 0..=end {
                for start in 0..=place {
                    assert_eq!(advance(start, end, |i| i < place), place, "{start}..{end}");
                }
            }
        }
    }
}
