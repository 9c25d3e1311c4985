//! Cells around points: distances to the nearest ones, or one shade a cell.
//!
//! Specification 2.1. Distances wrap around, so the diagram tiles wherever its points lie. Where they
//! lie is [`placement`]'s business, [`Cells`] finds the few that matter for a pixel. In 8-bit
//! precision the points of figures may lie beyond the image: see [`shown`].
// Pictured: `type` `cell color`; or `type` `nearest distance`, `metric` `chebyshev`.

use super::super::drawing::walk::Start;
use super::voronoi::{
    Cells, Chebyshev, Euclidean, Measure, Point, Taxicab, Wanted,
    placement::{self, Layout, Places},
    shown,
};
use crate::block::prelude::*;

/// The text of an L-system.
const TEXT: usize = 0;

choice! {
    /// What a pixel shows.
    Shows {
        /// The distance to the nearest point; white from a fifth of the image's size on.
        Distance = "nearest distance",
        /// The distance to the nearest point, divided by that to the second nearest.
        Ratio = "ratio of the two nearest",
        /// One shade for all pixels that have the same nearest point.
        Shade = "cell color",
    }
}

choice! {
    /// How distances are measured.
    Metric {
        /// In a straight line.
        Euclidean = "euclidean",
        /// Along rows and columns.
        Taxicab = "taxicab",
        /// The greater of the distances across and down.
        Chebyshev = "chebyshev",
    }
}

choice! {
    /// Where the points lie.
    Place {
        /// Anywhere, by chance.
        Random = "random",
        /// Along the sides of a square in the middle.
        Square = "square",
        /// Along a circle around the middle.
        Circle = "circle",
        /// Along a cross of horizontal and vertical arms.
        HorizontalCross = "cross horizontal",
        /// Along a cross of diagonal arms.
        DiagonalCross = "cross diagonal",
        /// Where "point positions" says.
        Custom = "custom",
    }
}

params! {
    /// Parameters of [`BLOCK`].
    Params {
        /// What a pixel shows.
        shows "type": choice [Shows] = Shows::Ratio;
        /// How distances are measured.
        metric: choice [Metric] = Metric::Euclidean;
        /// Where the points lie.
        place "point place": choice [Place] = Place::Random;
        /// Side of the square, radius of the circle, or length of the arms of a cross.
        width: int [hard 0..=10000 soft 0..=100 unit "% of the width"] = 75;
        /// The points of the custom placement as x:y,x:y,… with 0:0 the top left corner and 1:1
        /// the bottom right one; at most 255 points.
        positions "point positions": text = "";
        /// How many points: in all (random, circle), on each side including both corners (square),
        /// or on each arm including the middle (crosses).
        count "number of points": int [hard 0..=65536 soft 0..=200] = 15;
        /// Where the turtle of a connected L-system starts, from the left edge.
        initial_x "initial x": float [hard 0.0..=1.0 soft 0.0..=1.0 unit "of the width"] = 0.5;
        /// Where the turtle of a connected L-system starts, from the top edge.
        initial_y "initial y": float [hard 0.0..=1.0 soft 0.0..=1.0 unit "of the height"] = 0.5;
        /// Where the turtle of a connected L-system looks at first: 0 right, 90 up.
        initial_angle "initial angle": int [hard -36000..=36000 soft 0..=360 unit "degrees"] = 90;
    }
}

/// The block as everybody else sees it.
pub static BLOCK: BlockSpec = BlockSpec::point::<Voronoi>(About {
    id: "voronoi diagram",
    summary: "Cells around points that lie anywhere, on a figure, or where a list says.",
    inputs: &[input("l-system", Kind::Text).optional()],
    outputs: &[output("image", Planes::Grey)],
    uses_seed: true,
    tiling: Tiling::ExceptInEightBit(
        "figures that reach far beyond the image leave seams, unless distances \
         are taken in a straight line",
    ),
    in_pixels: "what the shades of cells are made from, in 8-bit precision",
    ..About::DEFAULT
});

struct Voronoi {
    shows: Shows,
    metric: Metric,
    /// `None` without points.
    cells: Option<Cells>,
    /// What a distance in pixels is divided by.
    unit: f32,
}

impl PointBlock for Voronoi {
    type Params = Params;

    fn prepare<L: Levels>(params: &Params, cx: &PrepareContext<'_>) -> Result<Self, Error> {
        let points: Vec<Point> = place(params, !L::EIGHT_BIT, cx)?
            .into_iter()
            .zip(0..)
            .map(|((x, y), i)| {
                // The shade of a place in pixels changes with the resolution, that of a number does
                // not. Far from the numbers of places: a shade must not tell where its point lies.
                let number = i32::wrapping_mul(i, 100_003).wrapping_add(50_021);
                let sum = convert::low_bits((x + y).cast_unsigned());
                let index = if L::EIGHT_BIT { sum } else { number };
                Point::new((x, y), elias::noise(index).abs())
            })
            .collect();
        let nearest = if params.shows == Shows::Ratio { 2 } else { 1 };
        let all_differ = params.place == Place::Random && !cx.is_connected(TEXT);
        let wanted = Wanted { nearest, all_differ };
        let cells = match params.metric {
            _ if points.is_empty() => None,
            Metric::Euclidean => Some(Cells::new::<Euclidean>(&points, wanted, cx)?),
            Metric::Taxicab => Some(Cells::new::<Taxicab>(&points, wanted, cx)?),
            Metric::Chebyshev => Some(Cells::new::<Chebyshev>(&points, wanted, cx)?),
        };
        let unit = 5.0 / convert::pixels(u32::midpoint(cx.width, cx.height));
        Ok(Self { shows: params.shows, metric: params.metric, cells, unit })
    }

    #[inline(always)]
    fn row<L: Levels>(&self, cx: &RowContext<'_>, _: &InputRows<'_>, out: &mut OutputRow<'_>) {
        let out = out.grey();
        let Some(cells) = &self.cells else {
            // Infinitely far from every point.
            out.fill(1.0);
            return;
        };
        match self.metric {
            Metric::Euclidean => self.write::<L, Euclidean>(cells, cx, out),
            Metric::Taxicab => self.write::<L, Taxicab>(cells, cx, out),
            Metric::Chebyshev => self.write::<L, Chebyshev>(cells, cx, out),
        }
    }

    fn scratch_bytes(params: &Params, width: u32, height: u32) -> u64 {
        let points = match params.place {
            Place::Random | Place::Circle => u64::from(params.count.unsigned_abs()),
            Place::Custom => placement::MAX_CUSTOM as u64,
            _ => 4 * u64::from(params.count.unsigned_abs()) + 4,
        };
        // What a text places instead of them is not known here.
        let points = points.max(placement::MAX_FOLLOWED as u64);
        placement::bytes_of(points) + Cells::bytes_of(points, width, height)
    }
}

fn place(params: &Params, is_exact: bool, cx: &PrepareContext<'_>) -> Result<Places, Error> {
    let count = i64::from(params.count);
    // In this order of operations, which decides on which pixel a length ends.
    let length = convert::truncate64(f64::from(params.width) * 0.01 * f64::from(cx.width));
    let layout = Layout { width: cx.width, height: cx.height, length, count, is_exact };
    if cx.is_connected(TEXT) {
        let start = Start { x: params.initial_x, y: params.initial_y, angle: params.initial_angle };
        return layout.followed(cx.text(TEXT)?, start, cx);
    }
    match params.place {
        Place::Random => layout.random(cx),
        Place::Square => Ok(layout.square()),
        Place::Circle => Ok(layout.circle()),
        Place::HorizontalCross => Ok(layout.horizontal_cross()),
        Place::DiagonalCross => Ok(layout.diagonal_cross()),
        Place::Custom => Ok(layout.custom(&params.positions)),
    }
}

impl Voronoi {
    #[inline(always)]
    fn write<L: Levels, M: Measure>(&self, cells: &Cells, cx: &RowContext<'_>, out: &mut [f32]) {
        match self.shows {
            Shows::Distance => cells.nearest::<M>(cx, out, |nearest, _| {
                shown::distances::<L>(nearest.map(|nearest| M::distance(nearest) * self.unit))
            }),
            Shows::Ratio => cells.nearest_two::<M>(cx, out, |nearest, second| {
                shown::ratios::<L>(nearest.map(M::distance), second.map(M::distance))
            }),
            Shows::Shade => cells.nearest::<M>(cx, out, |_, shades| shades),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::block::testing::Trial;

    fn trial(size: (u32, u32), metric: u32, shows: u32) -> Trial {
        Trial::of(&BLOCK).size(size.0, size.1).choice("metric", metric).choice("type", shows)
    }

    #[test]
    fn in_float_precision_points_that_meet_in_a_small_image_move_no_others() {
        let image = |side| {
            let trial = trial((side, side), 0, 2).int("number of points", 300);
            trial.image()
        };
        let (small, large) = (image(64), image(256));
        let places = (0..64).flat_map(|y| (0..64).map(move |x| (x, y)));
        let same = |(x, y): &(u32, u32)| {
            let (a, b) = (small.row(0, *y)[*x as usize], large.row(0, 4 * y)[4 * *x as usize]);
            a == b
        };
        let count = places.filter(same).count();
        // The others are at borders of cells, of which there are many.
        assert!(count > 64 * 64 / 2, "{count} of {} pixels", 64 * 64);
    }

    /// The levels that the specification gives for these points, by looking at all of them.
    fn naive(
        (width, height): (u32, u32),
        points: &[(i64, i64)],
        metric: u32,
        shows: u32,
    ) -> Vec<f64> {
        let around = |a: u32, b: i64, size: u32| {
            let distance = (i64::from(a) - b).abs();
            distance.min(i64::from(size) - distance) as f64
        };
        let pixels = (0..height).flat_map(|y| (0..width).map(move |x| (x, y)));
        pixels
            .map(|(x, y)| {
                let (mut first, mut second, mut shade) = (f64::INFINITY, f64::INFINITY, 1.0);
                for point in points {
                    let (dx, dy) = (around(x, point.0, width), around(y, point.1, height));
                    let distance = match metric {
                        0 => (dx * dx + dy * dy).sqrt(),
                        1 => dx + dy,
                        _ => dx.max(dy),
                    };
                    if distance < first {
                        let sum = convert::low_bits((point.0 + point.1).cast_unsigned());
                        (first, second, shade) = (distance, first, elias::noise64(sum).abs());
                    } else if distance < second {
                        second = distance;
                    }
                }
                let value = match shows {
                    0 => (5.0 * first / f64::from(u32::midpoint(width, height))).min(1.0),
                    1 if points.is_empty() => 1.0,
                    1 if first == 0.0 => 0.0,
                    1 => first / second,
                    _ => shade,
                };
                let is_level = (0.0..=1.0).contains(&value);
                let level = value * 255.0 + if is_level { 1e-3 } else { 1e-9_f64.copysign(value) };
                f64::from(convert::truncate(convert::single(level.trunc())) & 255)
            })
            .collect()
    }

    fn places(layout: &Layout, place: u32) -> Vec<(i64, i64)> {
        match place {
            1 => layout.square(),
            2 => layout.circle(),
            3 => layout.horizontal_cross(),
            _ => layout.diagonal_cross(),
        }
    }

    #[test]
    fn tiles_find_what_looking_at_all_points_finds() {
        let size = (29, 23);
        for (metric, shows, place) in
            (0..3).flat_map(|m| (0..3).flat_map(move |s| (1..5).map(move |p| (m, s, p))))
        {
            // Circles around a tile, arms through one, coinciding points, nothing at all.
            for (count, percent) in [(0, 75), (1, 75), (9, 30), (40, 0), (50, 45), (30, 300)] {
                let length = convert::truncate64(f64::from(percent) * 0.01 * f64::from(size.0));
                let (width, height) = size;
                let layout = Layout { width, height, length, count: count.into(), is_exact: false };
                let expected = naive(size, &places(&layout, place), metric, shows);
                let trial = trial(size, metric, shows).choice("point place", place);
                let trial = trial.int("number of points", count).int("width", percent);
                for (i, (level, expected)) in trial.levels(0).iter().zip(expected).enumerate() {
                    let case = (metric, shows, place, count, percent);
                    assert_eq!(f64::from(*level), expected, "{case:?} at {i}");
                }
            }
        }
    }

    #[test]
    fn random_points_all_differ_and_stay_when_more_are_added() {
        let trial = trial((16, 16), 0, 0);
        let zeros = |count| {
            let levels = trial.clone().int("number of points", count).levels(0);
            levels.iter().map(|level| *level == 0).collect::<Vec<_>>()
        };
        let (few, many) = (zeros(20), zeros(100));
        assert_eq!(few.iter().filter(|is_point| **is_point).count(), 20);
        assert_eq!(many.iter().filter(|is_point| **is_point).count(), 100);
        assert!(few.iter().zip(&many).all(|(few, many)| !few || *many));
        // More points than pixels: every pixel that the hash reaches.
        assert!(zeros(65_536).iter().filter(|is_point| **is_point).count() > 200);
    }

    #[test]
    fn without_points_the_image_is_white_and_with_one_the_ratio_is_black() {
        let custom = trial((8, 8), 0, 1).choice("point place", 5);
        assert_eq!(custom.levels(0), [255; 64]);
        assert_eq!(custom.text("point positions", "0.5:0.5").levels(0), [0; 64]);
    }

    #[test]
    fn rows_are_the_same_bits_however_they_are_asked_for() {
        for metric in 0..3 {
            for shows in 0..3 {
                trial((45, 19), metric, shows).assert_same_bits();
            }
        }
    }

    #[test]
    fn shades_do_not_change_with_the_resolution() {
        let shades = |side: u32| {
            let trial = trial((side, side), 0, 2).choice("point place", 5);
            let image = trial.text("point positions", "0.2:0.2 0.7:0.6").image();
            [image.channel(0)[0], image.row(0, side / 2 + 1)[side as usize / 2 + 1]]
        };
        assert_eq!(shades(16), shades(64));
    }

    #[test]
    fn a_turtle_places_points_where_its_lines_end() {
        let size = (40, 30);
        let text = |text: &str| {
            let value = std::string::String::from(text);
            trial(size, 0, 1).input(TEXT, value).int("initial angle", 0).choice("point place", 5)
        };
        // Without lines there is the start. Moves place nothing; brackets lead back.
        let start = [(20, 15)];
        let lines = [(20, 15), (30, 15), (30, 5)];
        for (commands, points) in
            [("", &start[..]), ("GGx", &start), ("M(10)D[L(90)D]R(180)GR(90)GM(15)R(180)G", &lines)]
        {
            let expected = naive(size, points, 0, 1);
            let levels: Vec<_> = text(commands).levels(0).into_iter().map(f64::from).collect();
            assert_eq!(levels, expected, "{commands}");
        }
        // They wrap around: 35 px to the right of column 20 is column 15.
        let levels: Vec<_> = text("M(35)D").levels(0).into_iter().map(f64::from).collect();
        assert_eq!(levels, naive(size, &[(20, 15), (15, 15)], 0, 1));
    }

    #[test]
    fn a_turtle_places_256_points_at_most() {
        let zeros = |lines: usize| {
            let text = format!("M(1){}", "D".repeat(lines));
            let trial = trial((300, 8), 0, 0).input(TEXT, text).int("initial angle", 0);
            trial.levels(0).iter().filter(|level| **level == 0).count()
        };
        assert_eq!((zeros(254), zeros(255), zeros(290)), (255, 256, 256));
    }
}
