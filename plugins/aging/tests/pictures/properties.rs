//! What pictures are looked at for, as numbers.

use ptlib::{ComputeOptions, Engine, EngineOptions, Image, value::Value};

use crate::sheets::{self, CORNER, MIDDLE, SHEETS, SHINY, Scene, Setting, Sheet};

const MASK: Scene<'_> = Scene("hair.xml", "mask");
const LOSS_AGE: Scene<'_> = Scene("hair.xml", "loss age");
const GREYED: Scene<'_> = Scene("hair.xml", "greyed");
const HEAD: Scene<'_> = Scene("hair.xml", "view");
const WRINKLED: Scene<'_> = Scene("parallax.xml", "view");
const MAP: Scene<'_> = Scene("wrinkles.xml", "map");
const NORMALS: Scene<'_> = Scene("wrinkles.xml", "normals");

fn engine() -> Engine {
    sheets::engine(EngineOptions::default()).unwrap()
}

fn seen(engine: &Engine, scene: Scene<'_>, settings: &[Setting<'_>], side: u32) -> Image {
    let options = ComputeOptions { size: Some((side, side)), ..Default::default() };
    scene.render(engine, settings, options).unwrap()
}

#[test]
fn the_hair_line_recedes_and_nothing_fades() {
    let engine = engine();
    for front in ["eight", "octagon", "even"] {
        let front = ("loss age", "front", front);
        let loss = seen(&engine, LOSS_AGE, &[front], 128);
        for (softness, text) in [(0.0, "0"), (0.1, "0.1")] {
            let mut last = vec![1.0; 128 * 128];
            for age in [0.0, 0.2, 0.33, 0.5, 0.66, 0.8, 1.0_f32] {
                let settings =
                    [front, ("mask", "age", &*age.to_string()), ("mask", "softness", text)];
                let mask = seen(&engine, MASK, &settings, 128).channel(0).to_vec();
                for (i, (hair, loss)) in mask.iter().zip(loss.channel(0)).enumerate() {
                    let is_between = *hair > 0.0 && *hair < 1.0;
                    assert!(!is_between || (loss - age).abs() < softness + 1e-6, "{hair} {loss}");
                    assert!(*hair <= 0.5 || last[i] > 0.5, "hair comes back");
                }
                let hairs = |mask: &[f32]| mask.iter().filter(|hair| **hair > 0.5).count();
                assert!(hairs(&mask) < hairs(&last), "{front:?} at {age}");
                last = mask;
            }
            assert!(last.contains(&1.0), "the inner region stays");
        }
    }
}

/// How far a colour is from grey.
fn tint(color: &[f32]) -> f32 {
    color.iter().fold(0.0_f32, |most, part| most.max(*part))
        - color.iter().fold(1.0_f32, |least, part| least.min(*part))
}

#[test]
fn every_hair_is_grey_before_it_is_lost() {
    let engine = engine();
    let tints = |age: f32| -> Vec<[f32; 2]> {
        let (graph, block) = GREYED.graph(&engine, &[("", "age", &*age.to_string())]).unwrap();
        let options = ComputeOptions { size: Some((128, 128)), ..Default::default() };
        let Value::Points(points) = engine.compute_value(&graph, block, 0, options).unwrap() else {
            panic!("no points");
        };
        let floats = |id| points.stream(id).unwrap().floats();
        let colors = floats("color").all().map(tint).collect::<Vec<_>>();
        floats("loss age").all().zip(colors).map(|(age, tint)| [age[0], tint]).collect()
    };
    let young = tints(0.0);
    assert!(young.iter().all(|[_, tint]| *tint > 0.19), "brown");
    let mut last = young;
    for age in [0.2, 0.4, 0.6, 0.8, 1.0] {
        let now = tints(age);
        assert!(now.len() < last.len());
        assert!(now.iter().zip(&last).all(|(now, last)| now[1] <= last[1]), "{age}");
        let lost_soon: Vec<_> = now.iter().filter(|[loss, _]| *loss < age + 0.01).collect();
        assert!(lost_soon.len() > 10 && lost_soon.iter().all(|[_, tint]| *tint < 0.05), "{age}");
        last = now;
    }
}

/// Where hair shines: the mean column of what its highlight adds.
fn shine(engine: &Engine, light: &str) -> f64 {
    let [dull, shiny] = ["0", "0.9"].map(|specular| {
        let settings = [
            ("", "age", "0"),
            ("view", "yaw", "0"),
            ("view", "pitch", "50"),
            ("view", "light yaw", light),
            (SHINY.0, SHINY.1, specular),
        ];
        seen(engine, HEAD, &settings, 128)
    });
    let (mut sum, mut place) = (0.0, 0.0);
    for y in 0..128 {
        for (x, (shiny, dull)) in (0_u32..).zip(shiny.row(0, y).iter().zip(dull.row(0, y))) {
            let weight = f64::from((shiny - dull).max(0.0));
            sum += weight;
            place += weight * f64::from(x);
        }
    }
    assert!(sum > 10.0, "it shines: {sum}");
    place / sum
}

#[test]
fn the_highlight_of_hair_moves_with_the_light() {
    let engine = engine();
    let columns = ["-75", "-45", "-15", "15", "45", "75"].map(|light| shine(&engine, light));
    assert!(columns.is_sorted_by(|a, b| a + 0.5 < *b), "{columns:?}");
    assert!(columns[5] - columns[0] > 10.0, "{columns:?}");
}

/// The share of the sphere that is far from its picture with very many steps.
fn artefacts(engine: &Engine, search: &str, linear: &str, binary: &str) -> f64 {
    let steps = |search, linear, binary| {
        [
            ("view", "search", search),
            ("view", "linear steps", linear),
            ("view", "binary steps", binary),
        ]
    };
    let exact = seen(engine, WRINKLED, &steps("combined", "256", "12"), 256);
    let found = seen(engine, WRINKLED, &steps(search, linear, binary), 256);
    let far = exact.channel(0).iter().zip(found.channel(0)).filter(|(a, b)| (*a - *b).abs() > 0.1);
    let covered = exact.channel(3).iter().filter(|alpha| **alpha > 0.5).count();
    far.count() as f64 / covered as f64
}

#[test]
fn a_combined_search_has_fewer_artefacts_than_others_of_as_many_steps() {
    let engine = engine();
    let combined = artefacts(&engine, "combined", "8", "4");
    let binary = artefacts(&engine, "binary", "1", "12");
    let linear = ["4", "6", "8", "10"].map(|steps| artefacts(&engine, "linear", steps, "0"));
    assert!(linear.is_sorted_by(|a, b| a > b), "{linear:?}");
    assert!(2.0 * combined < binary, "{combined}, binary {binary}");
    assert!(2.0 * combined < linear[3], "{combined}, linear {linear:?}");
}

#[test]
fn a_muscle_across_the_border_is_one_in_the_middle_moved_by_half() {
    let engine = engine();
    for scene in [MAP, NORMALS] {
        let [middle, corner] = [MIDDLE, CORNER].map(|muscle| {
            seen(&engine, scene, &[("map", "gamma", "1"), ("map", "muscles", muscle)], 64)
        });
        let mut covered = 0;
        for channel in 0..middle.planes() {
            for y in 0..64 {
                for x in 0..64_usize {
                    let one = middle.row(channel, y)[x];
                    let other = corner.row(channel, (y + 32) % 64)[(x + 32) % 64];
                    assert!((one - other).abs() < 1e-5, "{channel}: {one} {other} at {x}, {y}");
                    covered += u32::from(one > 0.1);
                }
            }
        }
        assert!(covered > 300, "{covered}");
    }
}

#[test]
fn the_seed_changes_hair_and_noise_and_nothing_else() {
    let engine = engine();
    let changes = |sheet: &&Sheet| {
        let [first, other] = [1, 2].map(|seed| {
            let options =
                ComputeOptions { size: Some((32, 32)), seed: Some(seed), ..Default::default() };
            sheet.scene.render(&engine, sheet.tiles.last().unwrap().1, options).unwrap()
        });
        (0..first.planes()).any(|channel| first.channel(channel) != other.channel(channel))
    };
    let names: Vec<_> = SHEETS.iter().filter(changes).map(|sheet| sheet.name).collect();
    assert_eq!(names, ["fine", "hair", "highlight"]);
}
