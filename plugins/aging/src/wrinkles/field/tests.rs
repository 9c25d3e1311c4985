#![allow(clippy::disallowed_methods, reason = "the formulas, written with what everybody has")]
#![allow(clippy::approx_constant, reason = "numbers of the specification")]

use std::{collections::VecDeque, f64::consts::PI};

use super::{
    super::grammar::{Limits, parse},
    *,
};

const DEFAULT: Style = Style { is_wave: false, is_smooth: true };
const KINKED: Style = Style { is_wave: false, is_smooth: false };
const WAVE: Style = Style { is_wave: true, is_smooth: true };
const KINKED_WAVE: Style = Style { is_wave: true, is_smooth: false };

const ONE: &str = "! ma=.2;.5 mb=.8;.5 n=3 relwidth=.5 maxangle=1.5 omegalow=.5";
const FOREHEAD: [&str; 2] = [
    "! ma=.423;.727 mb=.439;.640 n=3 relwidth=1 maxangle=1.5 omegalow=.6",
    "! ma=.556;.727 mb=.537;.638 n=3 relwidth=1 maxangle=1.5 omegalow=.6",
];

fn muscles(text: &str) -> Vec<Muscle> {
    parse(text.as_bytes(), &Limits::default()).unwrap()
}

fn field(text: &str, style: Style) -> Field {
    Field::new(&muscles(text), 1.0, style)
}

fn never() -> Result<(), BlockError> {
    Ok(())
}

fn at(field: &Field, u: f64, v: f64) -> f64 {
    f64::from(field.at([u, v], &mut Pace::new(&never)).unwrap())
}

/// The sums of an image.
fn image(field: &Field, width: u32, height: u32) -> Vec<f32> {
    let columns = Columns::new(width, field.proportion);
    let mut sums = vec![0.0; width as usize * height as usize];
    for (row, y) in sums.chunks_mut(width as usize).zip(0_u32..) {
        let v = 1.0 - (f64::from(y) + 0.5) / f64::from(height);
        field.add(&columns.row(v, 0, row.len()), row, &mut Pace::new(&never)).unwrap();
    }
    sums
}

fn step(x: f64) -> f64 {
    x * x * (3.0 - 2.0 * x)
}

/// The formula of the specification: how much is left at a place, and the height. (Behind the start
/// something is left, though no height: the thesis' fill goes there too.)
fn naive(muscle: &Muscle, style: Style, [u, v]: [f64; 2]) -> [f64; 2] {
    let Muscle { from, to, .. } = muscle;
    let across = [to[0] - from[0], to[1] - from[1]];
    let squared = across[0] * across[0] + across[1] * across[1];
    let length = squared.sqrt();
    let place = [u - from[0], v - from[1]];
    let t0 = (place[0] * across[0] + place[1] * across[1]) / squared;
    let t = t0.clamp(0.0, 1.0);
    let away = [place[0] - t * across[0], place[1] - t * across[1]];
    let d = (away[0] * away[0] + away[1] * away[1]).sqrt();
    let a = (1.0 - d / (muscle.width * length)).max(0.0);
    let k = if t0 <= 1.0 {
        1.0
    } else if muscle.max_angle == 1.0 {
        0.0
    } else {
        let angle = ((t0 - 1.0) * length / d).min(1.0).asin();
        (1.0 - angle / ((muscle.max_angle - 1.0) * PI / 2.0)).max(0.0)
    };
    let frequency = muscle.low + (1.0 - muscle.low) * step(a);
    let x = muscle.wrinkles * frequency * t;
    let bulge = (PI * x).sin().abs();
    let profile = if style.is_wave { 0.5 + 0.5 * (PI * (2.0 * x - 0.5)).sin() } else { bulge };
    let fading = if style.is_smooth { step(a) * step(k) } else { a * k };
    [a * k, muscle.amplitude * fading * profile]
}

/// The sum of all muscles at a place, with those of the neighbouring periods.
fn naive_sum(muscles: &[Muscle], style: Style, [u, v]: [f64; 2]) -> f64 {
    let mut sum = 0.0;
    for muscle in muscles {
        for i in -6..=6 {
            for j in -6..=6 {
                sum += naive(muscle, style, [u - f64::from(i), v - f64::from(j)])[1];
            }
        }
    }
    sum
}

fn near(x: f64, expected: f64) {
    assert!((x - expected).abs() < 1e-5, "{x} for {expected}");
}

#[test]
fn one_muscle_has_the_heights_of_the_specification() {
    let [bulge, kinked, wave] = [DEFAULT, KINKED, WAVE].map(|style| field(ONE, style));
    for (u, v, expected) in [
        (0.3, 0.5, [1.0, 1.0, 1.0]),
        (0.25, 0.5, [0.707_107, 0.707_107, 0.5]),
        (0.5, 0.65, [0.191_342, 0.191_342, 0.073_223]),
        (0.3, 0.6, [0.725_437, 0.652_894, 0.710_450]),
        (0.7, 0.4, [0.388_872, 0.349_984, 0.204_148]),
        (0.8, 0.6, [0.696_069, 0.626_462, 0.654_091]),
        (0.85, 0.6, [0.250_233, 0.255_830, 0.249_102]),
        (0.5, 0.79, [0.002_287, 0.023_389, 0.001_605]),
    ] {
        for (field, expected) in [&bulge, &kinked, &wave].into_iter().zip(expected) {
            near(at(field, u, v), expected);
        }
    }
    for (u, v) in [(0.85, 0.5), (0.9, 0.55), (0.15, 0.55), (0.5, 0.81)] {
        assert_eq!([&bulge, &kinked, &wave].map(|field| at(field, u, v)), [0.0; 3]);
    }
    let cut_off = ONE.replace("maxangle=1.5", "maxangle=1");
    assert_eq!(at(&field(&cut_off, DEFAULT), 0.85, 0.6), 0.0);
}

#[test]
fn heights_of_muscles_add() {
    let both = field(&FOREHEAD.join("\n"), DEFAULT);
    let [left, right] = FOREHEAD.map(|muscle| field(muscle, DEFAULT));
    for (u, v, expected) in [
        (0.431, 0.6835, 1.0),
        (0.45, 0.70, 0.005_206),
        (0.48, 0.69, 0.336_414),
        (0.49, 0.68, 0.619_289),
        (0.45, 0.63, 0.001_794),
    ] {
        near(at(&both, u, v), expected);
    }
    near(at(&left, 0.48, 0.69), 0.255_413);
    near(at(&right, 0.48, 0.69), 0.081_002);
    near(at(&left, 0.49, 0.68), 0.272_475);
    near(at(&right, 0.49, 0.68), 0.346_814);
}

#[test]
fn the_greatest_sum_does_not_depend_on_an_image() {
    let other = "! ma=.5;.2 mb=.5;.8 n=2 relwidth=.5 maxangle=1.5 omegalow=.5";
    let both = field(&format!("{ONE}{other}"), DEFAULT);
    for (u, v, expected) in [(0.4, 0.45, 0.670_290), (0.5, 0.35, 1.191_342), (0.5, 0.5, 1.0)] {
        near(at(&both, u, v), expected);
    }
    let greatest = both.greatest(&mut Pace::new(&never)).unwrap();
    near(f64::from(greatest), 1.588_162);
    let of_pixels = image(&both, 64, 64).into_iter().fold(0.0, f32::max);
    near(f64::from(of_pixels), 1.585_300);
    // In an image of other proportions the same texture is looked at.
    for proportion in [0.25, 0.5] {
        let field = Field::new(&muscles(ONE), proportion, DEFAULT);
        near(f64::from(field.greatest(&mut Pace::new(&never)).unwrap()), 1.0);
    }
}

#[test]
fn crests_are_found_on_fibres_that_no_grid_meets() {
    let thin = "! ma=.1003;.2001 mb=.9007;.2001 n=1024 relwidth=.00001 amplitude=3";
    let greatest = field(thin, DEFAULT).greatest(&mut Pace::new(&never)).unwrap();
    near(f64::from(greatest), 3.0);
    let none = field("", DEFAULT);
    assert_eq!(none.greatest(&mut Pace::new(&never)).unwrap(), 0.0);
}

/// Muscles of all kinds, made from a number.
fn many(seed: u32, count: u32) -> String {
    let mut state = seed;
    let mut next = |low: f64, high: f64| {
        state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        low + (high - low) * f64::from(state >> 8) / f64::from(1 << 24)
    };
    let mut text = String::new();
    for number in 0..count {
        let size = if number % 3 == 0 { 0.8 } else { 0.15 };
        let [u, v] = [next(-0.5, 1.5), next(-0.5, 1.5)];
        let [x, y] = match number % 5 {
            0 => [0.0, size],
            1 => [-size, 0.0],
            _ => [next(-size, size), next(-size, size)],
        };
        text += &format!(
            "! ma={u};{v} mb={};{} n={} relwidth={} maxangle={} omegalow={} amplitude={}\n",
            (u + x).clamp(-1.0, 2.0),
            (v + y).clamp(-1.0, 2.0),
            1 + number % 7,
            next(0.05, 1.0),
            if number % 4 == 0 { 1.0 } else { next(1.0, 2.0) },
            next(0.0, 1.0),
            next(0.1, 2.0),
        );
    }
    text
}

#[test]
fn the_map_is_the_formula_at_every_pixel() {
    for (style, seed) in [(DEFAULT, 1), (KINKED, 2), (WAVE, 3), (KINKED_WAVE, 4)] {
        for number in 0..12 {
            let text = many(seed * 100 + number, 1);
            let muscle = muscles(&text);
            let sums = image(&Field::new(&muscle, 1.0, style), 24, 24);
            for (i, sum) in sums.iter().enumerate() {
                let [x, y] = [i % 24, i / 24].map(|place| (place as f64 + 0.5) / 24.0);
                let exact = naive_sum(&muscle, style, [x, 1.0 - y]);
                let error = (f64::from(*sum) - exact).abs();
                assert!(error < 2e-5, "{text} at {x}, {y}: {sum} for {exact}");
            }
        }
    }
}

/// The thesis' way: from the pixel at the middle of the fibre to neighbours, as far as something
/// is left. Returns the pixels that were visited with something left, and their heights.
fn flooded(muscle: &Muscle, size: usize) -> (usize, Vec<f64>) {
    let mut heights = vec![0.0; size * size];
    let mut is_seen = vec![false; size * size];
    let place = |x: usize, y: usize| {
        let [u, down] = [x, y].map(|place| (place as f64 + 0.5) / size as f64);
        naive(muscle, DEFAULT, [u, 1.0 - down])
    };
    let middle = [0, 1].map(|axis| f64::midpoint(muscle.from[axis], muscle.to[axis]));
    let index = |x: f64| {
        let is_left = |column: &usize| *column as f64 + 1.0 <= x * size as f64;
        (0..size).take_while(is_left).count()
    };
    let start = (index(middle[0]), index(1.0 - middle[1]));
    let mut queue = VecDeque::from([start]);
    is_seen[start.1 * size + start.0] = true;
    let mut count = 0;
    while let Some((x, y)) = queue.pop_front() {
        let [left, height] = place(x, y);
        if left <= 0.0 {
            continue;
        }
        count += 1;
        heights[y * size + x] = height;
        let around = [(x.wrapping_sub(1), y), (x + 1, y), (x, y.wrapping_sub(1)), (x, y + 1)];
        for (x, y) in around.into_iter().filter(|(x, y)| *x < size && *y < size) {
            if !is_seen[y * size + x] {
                is_seen[y * size + x] = true;
                queue.push_back((x, y));
            }
        }
    }
    (count, heights)
}

#[test]
fn a_flood_fill_finds_the_same_pixels_and_heights() {
    for (text, counts) in [(FOREHEAD[0], [140, 554]), (FOREHEAD[1], [144, 594])] {
        for (size, count) in [64_u16, 128].into_iter().zip(counts) {
            let (covered, heights) = flooded(&muscles(text)[0], usize::from(size));
            assert_eq!(covered, count, "{text} at {size}");
            let sums = image(&field(text, DEFAULT), size.into(), size.into());
            for (sum, height) in sums.iter().zip(heights) {
                near(f64::from(*sum), height);
                assert_eq!(*sum > 1e-9, height > 1e-9, "{sum} for {height}");
            }
        }
    }
}

#[test]
fn a_thin_muscle_is_not_lost() {
    let thin = "! ma=.2;.31 mb=.8;.69 n=3 relwidth=.008 maxangle=1.5";
    let covered = image(&field(thin, DEFAULT), 64, 64).iter().filter(|sum| **sum > 0.0).count();
    let filled = flooded(&muscles(thin)[0], 64).0;
    assert!(covered > 30 && filled < covered, "{filled} of {covered}");
}

#[test]
fn shared_places_of_two_resolutions_have_the_same_bits() {
    let field = field(&many(9, 40), DEFAULT);
    let [small, large] = [256, 768].map(|size| image(&field, size, size));
    for (i, sum) in small.iter().enumerate() {
        let [x, y] = [i % 256, i / 256];
        let other = large[(3 * y + 1) * 768 + 3 * x + 1];
        assert_eq!(sum.to_bits(), other.to_bits(), "at {x}, {y}");
    }
}

#[test]
fn parts_of_a_row_have_the_bits_of_the_whole() {
    let field = field(&many(17, 60), DEFAULT);
    let columns = Columns::new(97, 1.0);
    let whole = image(&field, 97, 97);
    for (row, y) in whole.chunks(97).zip(0_u32..) {
        let v = 1.0 - (f64::from(y) + 0.5) / 97.0;
        let mut x = 0;
        for len in [1, 2, 7, 30, 1, 41, 15] {
            let mut part = vec![0.0; len];
            field.add(&columns.row(v, x, len), &mut part, &mut Pace::new(&never)).unwrap();
            let bits = |sums: &[f32]| sums.iter().map(|sum| sum.to_bits()).collect::<Vec<_>>();
            assert_eq!(bits(&part), bits(&row[x..x + len]), "row {y} from {x}");
            x += len;
        }
    }
}

#[test]
fn turned_muscles_give_the_turned_image() {
    let both = format!("{ONE} ! ma=.5;.2 mb=.5;.8 n=2 relwidth=.5 maxangle=1.5 omegalow=.5");
    // (u, v) becomes (1 - v, u).
    let both_turned = "! ma=.5;.2 mb=.5;.8 n=3 relwidth=.5 maxangle=1.5 omegalow=.5
        ! ma=.8;.5 mb=.2;.5 n=2 relwidth=.5 maxangle=1.5 omegalow=.5";
    let askew = "! ma=.2;.3 mb=.7;.45 n=3 relwidth=.4 maxangle=1.6 omegalow=.3";
    let askew_turned = "! ma=.7;.2 mb=.55;.7 n=3 relwidth=.4 maxangle=1.6 omegalow=.3";
    // Of fibres askew, roundings differ.
    for (text, turned, error) in [(&both[..], both_turned, 1e-6), (askew, askew_turned, 2e-6)] {
        let [image, turned] = [text, turned].map(|text| image(&field(text, DEFAULT), 120, 120));
        let greatest = image.iter().copied().fold(0.0, f32::max);
        for y in 0..120 {
            for x in 0..120 {
                // Rows go down, and v goes up: the column of the turned image is the row.
                let [one, other] = [image[y * 120 + x], turned[(119 - x) * 120 + y]];
                let difference = (one - other).abs() / greatest;
                assert!(difference < error, "at {x}, {y}: {one} and {other}");
            }
        }
        assert!(greatest > 0.9);
    }
}

#[test]
fn one_among_a_thousand_distant_ones_keeps_its_bits() {
    let one = "! ma=.1;.1 mb=.16;.12 n=4";
    let mut all = one.to_owned();
    for i in 0..999 {
        let [u, v] = [0.3 + 0.01 * f64::from(i % 60), 0.3 + 0.03 * f64::from(i / 60)];
        all += &format!("\n! ma={u};{v} mb={};{v} n=2", u + 0.004);
    }
    let [alone, among] = [one, &all].map(|text| image(&field(text, DEFAULT), 200, 200));
    assert!(among.iter().filter(|sum| **sum > 0.0).count() > 150);
    for (i, (one, other)) in alone.iter().zip(&among).enumerate() {
        if i % 200 < 50 && i / 200 > 150 {
            assert_eq!(one.to_bits(), other.to_bits());
        }
    }
}

#[test]
fn proportions_do_not_distort_wrinkles() {
    // Twice as wide: half of u is as long as it was, so the muscle's picture is the same.
    let wide = "! ma=.1;.5 mb=.4;.5 n=3 relwidth=.5 maxangle=1.5 omegalow=.5";
    let wide = Field::new(&muscles(wide), 2.0, DEFAULT);
    let [square, wide] = [image(&field(ONE, DEFAULT), 64, 64), image(&wide, 128, 64)];
    for (i, sum) in square.iter().enumerate() {
        let other = wide[i / 64 * 128 + i % 64];
        assert!((sum - other).abs() < 1e-6, "pixel {i}: {sum} and {other}");
    }
}

#[test]
fn strange_muscles_and_proportions_give_finite_sums_in_the_end() {
    let muscles = muscles(
        "! ma=-1;-1 mb=2;2 n=1024 relwidth=1 maxangle=2 omegalow=0 amplitude=4
        ! ma=.5;.5 mb=.500002;.5 n=1024 relwidth=.0000011 maxangle=1.0000000001
        ! ma=.5;.5 mb=.5;.500002 n=1 relwidth=1 maxangle=2 amplitude=0
        ! ma=.5;.5 mb=.5;.6 n=1 maxangle=1.000000000000001
        ! ma=0;0 mb=1;0 n=1 amplitude=1e-45",
    );
    for (width, height) in [(33, 31), (300, 1), (1, 300), (1, 1)] {
        let field = Field::new(&muscles, f64::from(width) / f64::from(height), DEFAULT);
        let sums = image(&field, width, height);
        assert!(sums.iter().all(|sum| sum.is_finite() && *sum >= 0.0), "{width}x{height}");
        let greatest = field.at([0.5, 0.5], &mut Pace::new(&never)).unwrap();
        assert!(greatest.is_finite());
    }
}

#[test]
fn a_request_to_stop_is_heard() {
    let field = field(&"! ma=-1;-1 mb=2;2 n=1 relwidth=1".repeat(50), DEFAULT);
    let asked = std::cell::Cell::new(0);
    let check = || {
        asked.set(asked.get() + 1);
        if asked.get() == 3 { Err(BlockError::cancelled()) } else { Ok(()) }
    };
    assert_eq!(field.greatest(&mut Pace::new(&check)), Err(BlockError::cancelled()));
    assert_eq!(asked.get(), 3);
}
