//! The outline of a mosaic tile: four sides that fit the sides of its neighbours.
//!
//! Specification 2.34. A side is a list of points, x along the side clockwise (0..1), y outwards
//! (-0.5..0.5). What its neighbour looks like there follows from the side's transformation, so
//! parts of the user's lists are replaced by images of others.

use crate::block::prelude::*;

choice! {
    /// How the tile on the other side of a border comes from this one.
    Transformation {
        /// It is shifted.
        Shift = "shift",
        /// It is turned by 180 degrees around the middle of the border.
        HalfTurn = "half turn",
        /// It is turned by 90 degrees around an end of the border.
        QuarterTurn = "quarter turn",
        /// It is shifted and flipped.
        Glide = "glide",
    }
}

/// A point of a side.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Point {
    pub(super) x: f64,
    pub(super) y: f64,
}

type Side = Vec<Point>;

/// A side has at most this many points.
const MAX_POINTS: usize = 128;

const CORNER: Point = Point { x: 0.0, y: 0.0 };

/// The outline in the unit square, y upwards, clockwise from the upper left corner. The sides are
/// those at the top, on the right, at the bottom and on the left.
pub(super) fn outline(texts: [&str; 4], transformations: [Transformation; 4]) -> Vec<Point> {
    let own = texts.map(side);
    let mut sides = own.clone();
    for (i, transformation) in transformations.into_iter().enumerate() {
        let opposite = &own[i % 2];
        match transformation {
            Transformation::HalfTurn => sides[i] = symmetric(&own[i]),
            Transformation::Shift if i >= 2 => sides[i] = reversed(opposite),
            Transformation::Glide if i >= 2 => {
                sides[i] = opposite.iter().map(|point| Point { y: -point.y, ..*point }).collect();
            }
            Transformation::QuarterTurn if i % 2 == 0 => sides[i].clone_from(&own[0]),
            Transformation::QuarterTurn => sides[i] = reversed(&own[0]),
            Transformation::Shift | Transformation::Glide => {}
        }
    }
    let [top, right, bottom, left] = sides;
    let placed = |side: Side, place: fn(Point) -> (f64, f64)| {
        side.into_iter().map(place).map(|(x, y)| Point { x, y }).collect::<Vec<_>>()
    };
    [
        placed(top, |Point { x, y }| (x, 1.0 + y)),
        placed(right, |Point { x, y }| (1.0 + y, 1.0 - x)),
        placed(bottom, |Point { x, y }| (1.0 - x, -y)),
        placed(left, |Point { x, y }| (-y, x)),
    ]
    .concat()
}

/// Whether tiles with these transformations and in these numbers fill the plane; otherwise all that
/// contradicts it.
pub(super) fn check(
    transformations: [Transformation; 4],
    across: i32,
    down: i32,
) -> Result<(), Error> {
    let fault = |parameter: String, message: String, hint: &str| {
        Error::new(ErrorKind::InvalidArgument, message).with_hint(hint).at_parameter(parameter)
    };
    let mut faults = Vec::new();
    let mut needs_even = false;
    for (i, transformation) in transformations.into_iter().enumerate() {
        let parameter = format!("transformation {}", i + 1);
        let name = Transformation::ITEMS[transformation as usize].id;
        let (other, hint) = match transformation {
            Transformation::HalfTurn => (None, ""),
            Transformation::Shift | Transformation::Glide => {
                (Some((i + 2) % 4), "opposite sides need the same transformation")
            }
            Transformation::QuarterTurn => {
                (Some((i + 1) % 4), "a quarter turn is possible on all four sides or on none")
            }
        };
        needs_even |= transformation != Transformation::Shift;
        if let Some(other) = other
            && transformations[other] != transformation
        {
            let found = Transformation::ITEMS[transformations[other] as usize].id;
            let message = format!(
                "side {} has \"{name}\", so side {} must have \"{name}\" too, not \"{found}\"",
                i + 1,
                other + 1
            );
            faults.push(fault(parameter, message, hint));
        }
    }
    if across != down {
        let message = format!("{across} tiles across and {down} down the image");
        let hint = "there are as many tiles down the image as across it";
        faults.push(fault("tiles y".into(), message, hint));
    }
    if needs_even && across % 2 != 0 {
        let message = format!("{across} tiles across the image, but turned or flipped ones");
        let hint = "the number has to be even, unless all sides have \"shift\"";
        faults.push(fault("tiles x".into(), message, hint));
    }
    Error::from_faults(faults).map_or(Ok(()), Err)
}

/// The side that a text describes: pairs of numbers. What is no number, and half a pair, end it.
fn side(text: &str) -> Side {
    let mut side = vec![CORNER];
    // BUG of the original: two blanks repeated a number. Here they count as one.
    let number = |word: &str| word.parse().ok().filter(|number: &f64| number.is_finite());
    let mut numbers = text.split_ascii_whitespace().map_while(number);
    while let (Some(x), Some(y)) = (numbers.next(), numbers.next())
        && side.len() < MAX_POINTS
    {
        let x = x.clamp(0.0, 1.0);
        // The corner at the other end begins the next side.
        let x = if x == 1.0 { 0.0 } else { x };
        if side.iter().all(|point| point.x != x) {
            side.push(Point { x, y: y.clamp(-0.5, 0.5) });
        }
    }
    side.sort_by(|a, b| a.x.total_cmp(&b.x));
    side
}

/// The side turned around its middle: walked from the other end, what was outside is inside.
fn reversed(side: &[Point]) -> Side {
    let images = side[1..].iter().rev().map(|point| Point { x: 1.0 - point.x, y: -point.y });
    std::iter::once(CORNER).chain(images).collect()
}

/// The first half of the side and its image, so that turning changes nothing.
fn symmetric(side: &[Point]) -> Side {
    let half: Side = side.iter().copied().take_while(|point| point.x < 0.5).collect();
    let images = reversed(&half);
    half.into_iter().chain(images.into_iter().skip(1)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn pairs(side: &[Point]) -> Vec<(f64, f64)> {
        side.iter().map(|point| (point.x, point.y)).collect()
    }

    #[test]
    fn sides_are_read_as_pairs() {
        assert_eq!(pairs(&side("")), [(0.0, 0.0)]);
        assert_eq!(
            pairs(&side("0.5 0.9  0.25 -3 1 0.2 0.5 0.1 7")),
            [(0.0, 0.0), (0.25, -0.5), (0.5, 0.5)]
        );
        assert_eq!(pairs(&side("0.5 0.25 x 0.75 0.1")), [(0.0, 0.0), (0.5, 0.25)]);
        assert_eq!(pairs(&side("0.5 nan 0.75 0.1")), [(0.0, 0.0)]);
        let many: String = (1..1000).map(|i| format!("0.{i:03} 0 ")).collect();
        assert_eq!(side(&many).len(), MAX_POINTS);
    }

    #[test]
    fn sides_fit_their_neighbours() {
        let texts = ["0.25 0.25 0.75 0.125", "0.5 0.25", "0.1 0.5", "0.9 0.4"];
        let corners = [(0.0, 1.0), (1.0, 1.0), (1.0, 0.0), (0.0, 0.0)];
        let [shift, half, quarter, glide] = [
            Transformation::Shift,
            Transformation::HalfTurn,
            Transformation::QuarterTurn,
            Transformation::Glide,
        ];
        let shifted = pairs(&outline(texts, [shift; 4]));
        // The bottom is the top one unit lower, from right to left; the left is the right shifted.
        let [a, b, c, d] = corners;
        let expected = [
            a,
            (0.25, 1.25),
            (0.75, 1.125),
            b,
            (1.25, 0.5),
            c,
            (0.75, 0.125),
            (0.25, 0.25),
            d,
            (0.25, 0.5),
        ];
        assert_eq!(shifted, expected);
        let turned = pairs(&outline(texts, [half, shift, half, shift]));
        assert_eq!(turned[..3], [a, (0.25, 1.25), (0.75, 0.75)]);
        let turned = pairs(&outline(texts, [quarter; 4]));
        // A quarter turn around the upper right corner brings the top to the right.
        assert_eq!(turned[3..6], [b, (0.875, 0.75), (0.75, 0.25)]);
        let flipped = pairs(&outline(texts, [glide; 4]));
        assert_eq!(flipped[5..8], [c, (0.75, 0.25), (0.25, 0.125)]);
    }
}
