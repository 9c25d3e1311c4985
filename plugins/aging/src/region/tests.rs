//! The transition through the engine: vectors, symmetries, fronts against slow twins, and masks
//! that nobody draws.

use std::sync::{Arc, Mutex};

use ptlib::{
    Cancel, ComputeOptions, ErrorKind, Image, Precision, params::ParamValue, run::LogLevel,
};

use crate::{skin::trial, testing};

const BLOCK: &str = "aging.hair transition";
const EIGHT: u32 = 0;
const OCTAGON: u32 = 1;
const EVEN: u32 = 2;

/// Masks from rows of letters: `o` is outer, `I` both, `x` inner only.
fn masks(rows: &[&str]) -> [Image; 2] {
    let size = (rows[0].len(), rows.len());
    let size = (u32::try_from(size.0).unwrap(), u32::try_from(size.1).unwrap());
    ["oI", "Ix"].map(|letters| {
        trial::picture(size, 1, |_, x, y| {
            let letter = char::from(rows[y as usize].as_bytes()[x as usize]);
            if letters.contains(letter) { 0.9 } else { 0.1 }
        })
    })
}

fn choices(front: u32, drops: bool) -> [(&'static str, ParamValue); 2] {
    [("front", ParamValue::Choice(front)), ("islands", ParamValue::Choice(u32::from(drops)))]
}

fn transition(masks: &[Image; 2], front: u32) -> Image {
    trial::made(BLOCK, &[Some(&masks[0]), Some(&masks[1])], &choices(front, false))
}

fn assert_near(found: &[f32], expected: &[f32]) {
    let is_near = found.iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-5);
    assert!(is_near && found.len() == expected.len(), "{found:?}, expected {expected:?}");
}

const HEAD: [&str; 8] = [
    "........", ".oooooo.", ".oIIooo.", ".oIIooo.", ".oo..oo.", "......o.", "......o.", "........",
];

/// T of generations, as rows of digits; 0 is a source, and a point is outside.
fn of_generations(rows: &[&str], last: f32) -> Vec<f32> {
    let letters = rows.iter().flat_map(|row| row.chars());
    let loss = |letter: char| letter.to_digit(10).map(|r| (last + 1.0 - r as f32) / (last + 1.0));
    letters.map(|letter| loss(letter).unwrap_or(0.0)).collect()
}

#[test]
fn generations_are_those_of_the_vector() {
    let eight = [
        "........", ".111123.", ".100123.", ".100123.", ".11..23.", "......3.", "......4.",
        "........",
    ];
    let octagon = [
        "........", ".211223.", ".100123.", ".100123.", ".21..23.", "......4.", "......5.",
        "........",
    ];
    let head = masks(&HEAD);
    let found = transition(&head, EIGHT);
    assert_near(found.channel(0), &of_generations(&eight, 4.0));
    assert_near(transition(&head, OCTAGON).channel(0), &of_generations(&octagon, 5.0));
    for (age, expected) in [(0.0, 24), (0.2, 24), (0.25, 23), (0.5, 18), (0.75, 14), (1.0, 4)] {
        let age = [("age", ParamValue::Float(age))];
        let mask = trial::made("aging.hair mask", &[Some(&found)], &age);
        let visible = mask.channel(0).iter().filter(|value| **value == 1.0).count();
        assert_eq!(visible, expected, "{age:?}");
    }
}

#[test]
fn one_row_is_that_of_the_vector() {
    let row = masks(&[".oooIIooooo."]);
    let right = [0.833_333, 0.666_667, 0.5, 0.333_333, 0.166_667, 0.0];
    let even = [&[0.0, 0.25, 0.5, 0.75, 1.0, 1.0], &right[..]].concat();
    assert_near(transition(&row, EVEN).channel(0), &even);
    let eight = [&[0.0, 0.5, 0.666_667, 0.833_333, 1.0, 1.0], &right[..]].concat();
    assert_near(transition(&row, EIGHT).channel(0), &eight);
}

#[test]
fn parts_without_an_inner_region_recede_or_drop() {
    let parts =
        ["oooooo.....", "oooooo.oo..", "oooooo.oo..", "oooooo.....", "oooooo.oII.", "..........."];
    let masks = masks(&parts);
    let found = transition(&masks, EIGHT);
    // The large part has three generations, the small one has one.
    assert_near(&found.row(0, 0)[..6], &[0.25; 6]);
    assert_near(&found.row(0, 2)[..6], &[0.25, 0.5, 0.75, 0.75, 0.5, 0.25]);
    assert_near(&found.row(0, 1)[6..], &[0.0, 0.5, 0.5, 0.0, 0.0]);
    assert_near(&found.row(0, 4)[6..], &[0.0, 0.5, 1.0, 1.0, 0.0]);
    let inputs = [Some(&masks[0]), Some(&masks[1])];
    let dropped = trial::made(BLOCK, &inputs, &choices(EIGHT, true));
    assert_near(&dropped.row(0, 4)[7..], &found.row(0, 4)[7..]);
    assert!((0..4).all(|y| dropped.row(0, y).iter().all(|loss| *loss == 0.0)));
}

#[test]
fn regions_that_are_empty_or_everything() {
    let all = |value| trial::plain((6, 5), &[value]);
    for front in [EIGHT, OCTAGON, EVEN] {
        let same = |outer, inner, expected: f32| {
            let found = transition(&[all(outer), all(inner)], front);
            assert!(found.channel(0).iter().all(|loss| *loss == expected), "{front} {expected}");
        };
        same(0.0, 0.0, 0.0);
        same(0.0, 1.0, 0.0);
        same(1.0, 1.0, 1.0);
        same(1.0, 0.0, 0.5);
        // As the threshold says, and exactly at it.
        same(0.5, 0.49, 0.5);
        let both = masks(&["ooo....", "oooo...", ".oo...o"])[0].clone();
        let found = transition(&[both.clone(), both.clone()], front);
        let expected: Vec<_> =
            both.channel(0).iter().map(|value| f32::from(*value > 0.5)).collect();
        assert_eq!(found.channel(0), expected);
        let nothing = trial::plain((7, 3), &[0.0]);
        let empty = [Some(&both), Some(&nothing)];
        let dropped = trial::made(BLOCK, &empty, &choices(front, true));
        assert!(dropped.channel(0).iter().all(|loss| *loss == 0.0));
        let receding = trial::made(BLOCK, &empty, &choices(front, false));
        assert!(
            receding
                .channel(0)
                .iter()
                .zip(&expected)
                .all(|(loss, hair)| { *loss < 1.0 && (*loss > 0.0) == (*hair == 1.0) })
        );
    }
}

/// An irregular region with a hole and islands, and an inner one.
fn irregular(size: (u32, u32)) -> [Image; 2] {
    let coarse = |x: u32, y: u32| trial::grain(x / 4 + 3, y / 5);
    [
        trial::picture(size, 1, |_, x, y| if coarse(x, y) < 0.7 { 1.0 } else { 0.0 }),
        trial::picture(size, 1, |_, x, y| if coarse(x, y) < 0.05 { 1.0 } else { 0.0 }),
    ]
}

fn map(image: &Image, from: impl Fn(u32, u32) -> (u32, u32)) -> Image {
    trial::picture((image.width(), image.height()), 1, |_, x, y| {
        let (x, y) = from(x, y);
        image.row(0, y % image.height())[(x % image.width()) as usize]
    })
}

#[test]
fn shifted_and_mirrored_masks_give_shifted_and_mirrored_ages() {
    let masks = irregular((61, 53));
    for front in [EIGHT, OCTAGON, EVEN] {
        let loss = transition(&masks, front);
        let shift = |x, y| (x + 40, y + 17);
        let mirror = |x, y| (60 - x, 52 - y);
        let shifted = transition(&[map(&masks[0], shift), map(&masks[1], shift)], front);
        assert!(trial::bits(&shifted) == trial::bits(&map(&loss, shift)), "{front}");
        let mirrored = transition(&[map(&masks[0], mirror), map(&masks[1], mirror)], front);
        assert!(trial::bits(&mirrored) == trial::bits(&map(&loss, mirror)), "{front}");
    }
}

/// Generations by going over the whole image until nothing changes. `None` was not reached.
fn slow_generations([outer, inner]: &[Image; 2], front: u32) -> (Vec<Option<u32>>, u32) {
    let (width, height) = (outer.width(), outer.height());
    let is = |image: &Image, i: usize| image.channel(0)[i] >= 0.5;
    let mut found: Vec<_> =
        (0..outer.channel(0).len()).map(|i| (is(outer, i) && is(inner, i)).then_some(0)).collect();
    let (mut last, mut empty) = (0, 0);
    for generation in 1.. {
        let before = found.clone();
        for i in 0..before.len() {
            let place = u32::try_from(i).unwrap();
            let (x, y) = (place % width, place / width);
            let near = (0..3).flat_map(|dx| (0..3).map(move |dy| (dx, dy))).any(|(dx, dy)| {
                let is_far = dx != 1 && dy != 1 && front == OCTAGON && generation % 2 == 1;
                let (x, y) = ((x + width + dx - 1) % width, (y + height + dy - 1) % height);
                !is_far && before[(y * width + x) as usize].is_some()
            });
            if near && before[i].is_none() && is(outer, i) {
                found[i] = Some(generation);
            }
        }
        if found == before {
            empty += 1;
        } else {
            (last, empty) = (generation, 0);
        }
        if empty == 2 {
            break;
        }
    }
    (found, last)
}

#[test]
fn generations_are_those_of_a_slow_twin() {
    for size in [(1, 9), (9, 1), (2, 2), (5, 3), (47, 31), (64, 64)] {
        let masks = irregular(size);
        for front in [EIGHT, OCTAGON] {
            let (expected, last) = slow_generations(&masks, front);
            let inputs = [Some(&masks[0]), Some(&masks[1])];
            let found = trial::made(BLOCK, &inputs, &choices(front, true));
            let loss = |r: u32| (last as f32 + 1.0 - r as f32) / (last as f32 + 1.0);
            let expected: Vec<_> = expected.iter().map(|r| r.map_or(0.0, loss)).collect();
            assert_near(found.channel(0), &expected);
        }
    }
}

#[test]
fn even_ages_are_those_of_a_slow_twin() {
    for size in [(1, 9), (9, 1), (5, 3), (47, 31), (64, 24)] {
        let masks = irregular(size);
        let loss = transition(&masks, EVEN);
        let is = |image: &Image, x: u32, y: u32| image.row(0, y)[x as usize] >= 0.5;
        let places = || (0..size.0).flat_map(|x| (0..size.1).map(move |y| (x, y)));
        let distance = |from: (u32, u32), is_there: &dyn Fn(u32, u32) -> bool| {
            let around = |a: u32, b: u32, length: u32| a.abs_diff(b).min(length - a.abs_diff(b));
            let squares = places().filter(|(x, y)| is_there(*x, *y)).map(|(x, y)| {
                let [x, y] = [around(x, from.0, size.0), around(y, from.1, size.1)];
                x * x + y * y
            });
            squares.min().map(|square| f64::from(square).sqrt())
        };
        for (x, y) in places() {
            let near = distance((x, y), &|x, y| is(&masks[0], x, y) && is(&masks[1], x, y));
            let far = distance((x, y), &|x, y| !is(&masks[0], x, y));
            let (Some(near), Some(far)) = (near, far) else { continue };
            let found = f64::from(loss.row(0, y)[x as usize]);
            assert!((found - far / (near + far)).abs() < 1e-6, "{size:?}: {x} {y}: {found}");
        }
    }
}

#[test]
fn distances_without_an_outside_or_an_inner_region() {
    let inner = masks(&["Ioooooo", "ooooooo", "ooooooo"]);
    let loss = transition(&inner, EVEN);
    let all = 10.0_f32.sqrt() + 1.0;
    assert_near(loss.row(0, 0), &[0.0, 1.0, 2.0, 3.0, 3.0, 2.0, 1.0].map(|near| 1.0 - near / all));
    assert_near(&loss.row(0, 1)[3..4], &[1.0 - 10.0_f32.sqrt() / all]);
    // Two parts of different widths: each has its own middle.
    let parts = masks(&[".ooo.o", ".ooo.o", ".ooo.o", "......"]);
    let loss = transition(&parts, EVEN);
    assert_near(loss.row(0, 1), &[0.0, 1.0 / 3.0, 2.0 / 3.0, 1.0 / 3.0, 0.0, 0.5]);
}

#[test]
fn threads_do_not_matter_at_any_size() {
    for size in trial::SIZES.into_iter().chain([(130, 97)]) {
        let masks = irregular(size);
        for front in [EIGHT, OCTAGON, EVEN] {
            let inputs = [Some(&masks[0]), Some(&masks[1])];
            trial::same_on_all_threads(BLOCK, &inputs, &choices(front, false));
        }
    }
}

#[test]
fn in_8_bits_all_hair_is_kept() {
    // A way of more generations than there are levels.
    let outer = trial::picture((700, 1), 1, |_, x, _| if x < 699 { 1.0 } else { 0.0 });
    let inner = trial::picture((700, 1), 1, |_, x, _| if x == 0 { 1.0 } else { 0.0 });
    for front in [EIGHT, OCTAGON, EVEN] {
        let options = ComputeOptions { precision: Some(Precision::EightBit), ..Default::default() };
        let inputs = [Some(&outer), Some(&inner)];
        let loss = trial::tried(BLOCK, &inputs, &choices(front, false), options).unwrap();
        let row = loss.row(0, 0);
        assert!(row[..699].iter().all(|loss| *loss >= 1.0 / 256.0) && row[699] == 0.0);
        assert_eq!(row[0], 1.0);
    }
}

#[test]
fn inner_pixels_outside_are_told_with_their_number() {
    let masks = masks(&["xoIx", ".ox."]);
    for front in [EIGHT, EVEN] {
        let engine = testing::engine();
        let told = Arc::new(Mutex::new(Vec::new()));
        let log = Arc::clone(&told);
        let write = move |_, message: &str| log.lock().unwrap().push(message.to_owned());
        engine.set_log(Some((LogLevel::Warning, Arc::new(write))));
        let inputs = [Some(&masks[0]), Some(&masks[1])];
        let (graph, block) = trial::graph(&engine, BLOCK, &inputs, &choices(front, false));
        let options = ComputeOptions { size: Some((4, 2)), ..Default::default() };
        engine.compute(&graph, block, 0, options).unwrap();
        let told = told.lock().unwrap();
        assert!(told.len() == 1 && told[0].contains("3 pixels of `inner`"), "{told:?}");
    }
}

#[test]
fn it_can_be_stopped() {
    let masks = irregular((300, 300));
    for front in [EIGHT, OCTAGON, EVEN] {
        let cancel = Cancel::new();
        cancel.request();
        let options = ComputeOptions { cancel: Some(cancel), ..Default::default() };
        let inputs = [Some(&masks[0]), Some(&masks[1])];
        let error = trial::tried(BLOCK, &inputs, &choices(front, false), options).unwrap_err();
        assert_eq!(error.kind(), ErrorKind::Cancelled);
    }
}

#[test]
fn a_maze_of_thousands_of_generations_ends() {
    // A way one pixel wide that turns at every other row.
    let outer = trial::picture((101, 100), 1, |_, x, y| {
        let turns = if y % 4 == 1 { 99 } else { 0 };
        f32::from(x < 100 && y < 99 && (y % 2 == 0 || x == turns))
    });
    let inner = trial::picture((101, 100), 1, |_, x, y| f32::from(x == 0 && y == 0));
    let loss = transition(&[outer.clone(), inner], EIGHT);
    let least = loss.channel(0).iter().filter(|loss| **loss > 0.0).fold(1.0_f32, |a, b| a.min(*b));
    assert!(least < 1.0 / 4900.0, "{least}");
    let hair = |image: &Image| image.channel(0).iter().filter(|value| **value > 0.0).count();
    assert_eq!(hair(&loss), hair(&outer));
}

#[test]
fn masks_of_a_head_are_read_and_lie_in_each_other() {
    let engine = testing::engine();
    let folder = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("examples/head");
    let [outer, inner] = ["outer-hair.xml", "inner-hair.xml"].map(|name| {
        let reading = engine.read_graph(&std::fs::read(folder.join(name)).unwrap()).unwrap();
        assert!(reading.warnings.is_empty(), "{name}: {:?}", reading.warnings);
        let result = reading.graph.main_result().unwrap();
        let options = ComputeOptions { size: Some((128, 128)), ..Default::default() };
        engine.compute(&reading.graph, result, 0, options).unwrap()
    });
    let share = |image: &Image| {
        let values = image.channel(0);
        values.iter().filter(|value| **value >= 0.5).count() as f32 / values.len() as f32
    };
    let shares = [share(&outer), share(&inner)];
    assert!((0.3..0.6).contains(&shares[0]) && (0.03..0.2).contains(&shares[1]), "{shares:?}");
    assert!(inner.channel(0).iter().zip(outer.channel(0)).all(|(inner, outer)| inner <= outer));
    // The face and the neck are bare; the crown has hair in youth only, the back in age too.
    let at = |x: usize, y: u32| [&outer, &inner].map(|image| image.row(0, y)[x] >= 0.5);
    assert_eq!([at(64, 60), at(64, 127), at(3, 120)], [[false; 2]; 3]);
    assert_eq!([at(64, 10), at(3, 20), at(3, 62)], [[true, false], [true, false], [true, true]]);
}
