//! Tests through the engine.

use std::collections::BTreeSet;

use ptlib::{Engine, EngineOptions, ErrorKind, Limits, params::ParamValue, value::Value};

use crate::{
    hair::testing::{Scene, bare_mesh, field, floats, ids, image, interleaved, mesh},
    testing::engine,
};

/// Ages of loss: none in the left quarter, 1 in the right half, between them a slope.
fn ages(x: u32, side: u32) -> f32 {
    let u = f32::from(u16::try_from(x).unwrap()) / f32::from(u16::try_from(side).unwrap());
    if u < 0.25 { 0.0 } else { (u * 2.0).min(1.0) }
}

fn scene(mesh: Value) -> (Scene, ptlib::BlockId) {
    Scene::of_mesh(engine(), mesh, image(64, |x, _| ages(x, 64)))
}

/// Hairs of a mesh where hair grows everywhere.
fn everywhere(mesh: Value, hairs: i32) -> Value {
    let (mut scene, block) = Scene::of_mesh(engine(), mesh, image(64, |_, _| 1.0));
    scene.graph.set(block, "hairs", ParamValue::Int(hairs)).unwrap();
    scene.value(block).unwrap()
}

/// A right triangle, far from others, of legs a and b.
fn triangle(at: f32, a: f32, b: f32) -> [([f32; 3], [f32; 2]); 3] {
    [[at, 0.0, 0.0], [at + a, 0.0, 0.0], [at, b, 0.0]].map(|p| (p, [p[0] - at, p[1]]))
}

fn number(count: usize) -> f64 {
    f64::from(u32::try_from(count).unwrap())
}

#[test]
fn hairs_are_sorted_by_age_and_then_by_id() {
    let (mut scene, block) = scene(field(12, 0.0));
    scene.graph.set(block, "hairs", ParamValue::Int(20_000)).unwrap();
    let points = scene.value(block).unwrap();
    let (found, ids) = (floats(&points, "loss age"), ids(&points));
    let keys: Vec<_> = found.iter().zip(&ids).map(|(age, id)| (-age[0], id)).collect();
    assert!(keys.windows(2).all(|pair| pair[0] < pair[1]));
    // Three quarters have hair, and two thirds of these are never lost.
    let share = number(found.len()) / 20_000.0;
    assert!((share - 0.75).abs() < 4.0 * (0.75 * 0.25 / 20_000.0_f64).sqrt(), "{share}");
    let kept = found.iter().filter(|age| age[0] == 1.0).count();
    assert!((number(kept) / 10_000.0 - 1.0).abs() < 0.04, "{kept}");
    assert_eq!(ids.iter().collect::<BTreeSet<_>>().len(), ids.len());
}

#[test]
fn hairs_at_an_age_are_a_prefix_and_grow_never_more() {
    let (mut scene, block) = scene(field(12, 0.2));
    scene.graph.set(block, "hairs", ParamValue::Int(5000)).unwrap();
    let (all, loss) = {
        let points = scene.value(block).unwrap();
        (ids(&points), floats(&points, "loss age"))
    };
    let left = scene.behind("aging.hair at age", block);
    let mut counts = vec![];
    for age in [0.0, 0.1, 0.51, 0.625, 0.7, 0.99, 1.0] {
        scene.graph.set(left, "age", ParamValue::Float(age)).unwrap();
        let found = ids(&scene.value(left).unwrap());
        assert_eq!(found, all[..found.len()]);
        let expected = loss.iter().filter(|loss| f64::from(loss[0]) >= age).count();
        assert_eq!(found.len(), expected, "{age}");
        counts.push(found.len());
    }
    assert!(counts.is_sorted_by(|a, b| a >= b), "{counts:?}");
    // Those that are never lost are there at every age.
    assert_eq!(counts[6], loss.iter().filter(|loss| loss[0] == 1.0).count());
    assert!(counts[6] > 2000 && counts[0] == all.len());
}

#[test]
fn roots_lie_in_their_triangles_where_hair_grows() {
    let side = 9;
    let (mut scene, block) = scene(field(side, 0.0));
    scene.graph.set(block, "hairs", ParamValue::Int(5000)).unwrap();
    let points = scene.value(block).unwrap();
    let [positions, texcoords, loss] =
        ["position", "texcoord", "loss age"].map(|id| floats(&points, id));
    for (i, [triangle, _]) in ids(&points).into_iter().enumerate() {
        let cell = triangle / 2;
        let [x, y] = [cell % side, cell / side].map(f64::from);
        let [u, v] = [positions[i][0], positions[i][1]].map(|x| f64::from(x) * f64::from(side));
        let [u, v] = [u - x, v - y];
        assert!(u > -1e-5 && v > -1e-5 && u < 1.0 + 1e-5 && v < 1.0 + 1e-5, "{u} {v}");
        // The first triangle of a cell lies below its diagonal.
        let below = if triangle.is_multiple_of(2) { u - v } else { v - u };
        assert!(below > -1e-5, "{triangle}: {u} {v}");
        assert_eq!(positions[i][2], 0.0);
        assert!((positions[i][0] - texcoords[i][0]).abs() < 1e-6);
        let column = (0..64_u32).rfind(|x| f64::from(*x) <= f64::from(texcoords[i][0]) * 64.0);
        let near = column.unwrap().saturating_sub(1)..=column.unwrap() + 1;
        assert!(loss[i][0] > 0.0 && near.into_iter().any(|x| ages(x, 64) == loss[i][0]));
    }
}

#[test]
fn numbers_follow_areas() {
    // Areas 1 and 3.
    let corners = [triangle(0.0, 1.0, 2.0), triangle(10.0, 3.0, 2.0)].concat();
    let points = everywhere(mesh(&corners, &[[0, 1, 2], [3, 4, 5]]), 40_000);
    let of = |triangle| number(ids(&points).iter().filter(|id| id[0] == triangle).count());
    assert_eq!((of(0), of(1)), (10_000.0, 30_000.0));
    // A quarter stays by chance.
    let (mut scene, block) = scene(mesh(&corners, &[[0, 1, 2], [3, 4, 5]]));
    scene.image(block, 2, image(64, |_, _| 0.25));
    scene.graph.set(block, "per area", ParamValue::Float(10_000.0)).unwrap();
    let (thinned, all) = {
        let thinned = scene.value(block).unwrap();
        scene.graph.disconnect(block, 2).unwrap();
        (thinned, scene.value(block).unwrap())
    };
    for triangle in [0, 1] {
        let [thinned, all] = [&thinned, &all]
            .map(|points| number(ids(points).iter().filter(|id| id[0] == triangle).count()));
        let sigma = (all * 0.25 * 0.75).sqrt();
        assert!(all > 5000.0 && (thinned - all * 0.25).abs() < 4.0 * sigma, "{thinned} of {all}");
    }
}

#[test]
fn triangles_too_small_for_a_hair_keep_their_share() {
    // 10,000 triangles of area 1/2, with a fifth of a hair each.
    let corners: Vec<_> = (0..10_000_u16).flat_map(|i| triangle(f32::from(i), 1.0, 1.0)).collect();
    let triangles: Vec<_> = (0..10_000).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect();
    let points = everywhere(mesh(&corners, &triangles), 2000);
    let found = number(ids(&points).len());
    assert!((found - 2000.0).abs() < 4.0 * (10_000.0 * 0.2 * 0.8_f64).sqrt(), "{found}");
}

#[test]
fn places_on_a_triangle_are_even() {
    let points = everywhere(mesh(&triangle(0.0, 1.0, 1.0), &[[0, 1, 2]]), 64_000);
    let mut cells = [0.0_f64; 64];
    for (i, position) in floats(&points, "position").iter().enumerate() {
        let [x, y] = [position[0], position[1]];
        // Every second one is turned into the other half of the square.
        let [x, y] = if i % 2 == 0 { [x, y] } else { [1.0 - x, 1.0 - y] };
        let cell = |x: f32| (0..8_u8).rfind(|cell| x * 8.0 >= f32::from(*cell)).unwrap_or(0);
        cells[usize::from(cell(y) * 8 + cell(x))] += 1.0;
    }
    // The cells of the diagonal get their share from both halves.
    let chi: f64 = cells.iter().map(|n| (n - 1000.0) * (n - 1000.0) / 1000.0).sum();
    assert!(chi < 103.0, "{chi}");
}

#[test]
fn more_hairs_and_other_images_keep_earlier_ones() {
    let (mut scene, block) = scene(field(10, 0.3));
    let hairs = |scene: &mut Scene, hairs: i32| {
        scene.graph.set(block, "hairs", ParamValue::Int(hairs)).unwrap();
        scene.value(block).unwrap()
    };
    let (few, many) = (hairs(&mut scene, 3000), hairs(&mut scene, 8000));
    let of = |points: &Value| {
        let positions = floats(points, "position");
        let of: std::collections::BTreeMap<_, _> = ids(points).into_iter().zip(positions).collect();
        of
    };
    let (few, many) = (of(&few), of(&many));
    assert!(few.len() > 1000 && many.len() > few.len());
    assert!(few.iter().all(|(id, position)| many.get(id) == Some(position)));
    // A larger image with the same edges: the same hairs.
    let size = |scene: &Scene, side| {
        ids(&scene.sized(block, 0, side).unwrap()).into_iter().collect::<BTreeSet<_>>()
    };
    scene.image(block, 1, image(64, |x, _| if x < 32 { 0.0 } else { 0.5 }));
    let small = size(&scene, 64);
    scene.image(block, 1, image(256, |x, _| if x < 128 { 0.0 } else { 0.5 }));
    assert_eq!(size(&scene, 256), small);
    assert!(small.len() > 2000);
}

#[test]
fn directions_lean_no_further_than_the_spread() {
    let (mut scene, block) = scene(field(8, 0.0));
    scene.graph.set(block, "hairs", ParamValue::Int(4000)).unwrap();
    let mut directions = |spread: f64| {
        scene.graph.set(block, "spread", ParamValue::Float(spread)).unwrap();
        floats(&scene.value(block).unwrap(), "direction")
    };
    assert!(directions(0.0).iter().all(|d| d[..] == [0.0, 0.0, 1.0]));
    let leaning = directions(30.0);
    let least = leaning.iter().map(|d| d[2]).fold(1.0, f32::min);
    // cos 30°
    assert!((0.866_02..0.867).contains(&least), "{least}");
    // On all sides: the mean is upright.
    let mean = |axis: usize| leaning.iter().map(|d| f64::from(d[axis])).sum::<f64>() / 3000.0;
    assert!(mean(0).abs() < 0.03 && mean(1).abs() < 0.03);
    assert!(directions(90.0).iter().all(|d| d[2] >= 0.0 && d.iter().all(|x| x.is_finite())));
}

#[test]
fn threads_do_not_matter() {
    let (mut scene, block) = scene(field(80, 0.5));
    scene.graph.set(block, "hairs", ParamValue::Int(30_000)).unwrap();
    let first = scene.value_on(block, 1).unwrap();
    for threads in 2..=8 {
        assert_eq!(scene.value_on(block, threads).unwrap().content(), first.content());
    }
    // One triangle has them all.
    let (mut scene, block) = self::scene(mesh(&triangle(0.0, 1.0, 1.0), &[[0, 1, 2]]));
    scene.graph.set(block, "hairs", ParamValue::Int(50_000)).unwrap();
    let first = scene.value_on(block, 1).unwrap();
    assert_eq!(scene.value_on(block, 3).unwrap().content(), first.content());
}

#[test]
fn vertices_of_a_renderer_give_the_same_hair() {
    let planar = field(9, 0.4);
    let [first, second] = [planar.clone(), interleaved(&planar)].map(|mesh| {
        let (scene, block) = scene(mesh);
        scene.value(block).unwrap().content()
    });
    assert_eq!(first, second);
}

#[test]
fn another_seed_gives_other_hair() {
    let (mut scene, block) = scene(field(8, 0.0));
    let first = scene.value(block).unwrap();
    scene.graph.set_seed(77);
    assert_ne!(scene.value(block).unwrap().content(), first.content());
}

#[test]
fn what_cannot_carry_hair_is_refused() {
    let error = |mesh: Value, set: Option<f64>| {
        let (mut scene, block) = scene(mesh);
        if let Some(per_area) = set {
            scene.graph.set(block, "per area", ParamValue::Float(per_area)).unwrap();
        }
        scene.value(block).unwrap_err()
    };
    let bare = error(bare_mesh(), None);
    assert_eq!(bare.kind(), ErrorKind::InvalidArgument);
    assert!(bare.message().contains("texture coordinates"), "{bare}");
    assert!(bare.message().contains("aging.load mesh"), "{bare}");
    let flat = triangle(0.0, 1.0, 0.0);
    for mesh in [mesh(&[], &[]), mesh(&flat, &[[0, 1, 2]])] {
        assert!(error(mesh, None).message().contains("no area"));
    }
    let many = error(mesh(&triangle(0.0, 2.0, 2.0), &[[0, 1, 2]]), Some(1e12));
    assert_eq!(many.kind(), ErrorKind::Limit);
    assert!(many.message().contains("`per area`"), "{many}");
    assert!(many.message().contains("2000000000000 hairs, allowed 67108864"), "{many}");
    let (mut scene, block) = scene(field(2, 0.0));
    let over = ParamValue::Int((64 << 20) + 1);
    assert!(scene.graph.set(block, "hairs", over).is_err());
}

#[test]
#[allow(unsafe_code, reason = "the tables of the plug-in are given as a pointer")]
fn memory_is_counted_before_it_is_taken() {
    let limits = Limits { memory_bytes: 32 << 20, ..Limits::default() };
    let engine = Engine::new(EngineOptions { limits, ..EngineOptions::default() });
    // SAFETY: the entry is a static of this crate, made by the SDK.
    unsafe { engine.register_plugin(&raw const crate::ptl_plugin_entry_v1) }.unwrap();
    let (mut scene, block) = Scene::of_mesh(engine, field(2, 0.0), image(64, |_, _| 1.0));
    scene.graph.set(block, "hairs", ParamValue::Int(64 << 20)).unwrap();
    let error = scene.value(block).unwrap_err();
    assert_eq!(error.kind(), ErrorKind::Limit, "{error}");
    // Without `hairs`, when the places are known.
    scene.graph.set(block, "per area", ParamValue::Float(1e7)).unwrap();
    let error = scene.value(block).unwrap_err();
    assert_eq!(error.kind(), ErrorKind::Limit, "{error}");
    assert!(error.message().contains("scratch"), "{error}");
}

#[test]
fn what_is_no_age_is_refused_or_no_hair() {
    for (level, is_hairy) in [(2.0, true), (-1.0, false), (f32::NAN, false)] {
        let (mut scene, block) = Scene::of_mesh(engine(), field(2, 0.0), image(64, |_, _| level));
        scene.graph.set(block, "hairs", ParamValue::Int(100)).unwrap();
        if let Ok(points) = scene.value(block) {
            assert_eq!(!ids(&points).is_empty(), is_hairy, "{level}");
            assert!(floats(&points, "loss age").iter().all(|age| age[0] <= 1.0));
        }
    }
}

#[test]
fn no_hair_is_no_fault() {
    assert!(ids(&everywhere(field(3, 0.0), 0)).is_empty());
    let (scene, block) = Scene::of_mesh(engine(), field(3, 0.0), image(64, |_, _| 0.0));
    assert!(ids(&scene.value(block).unwrap()).is_empty());
}

#[test]
fn a_triangle_among_others_without_an_area_has_its_hair() {
    let mut corners = triangle(0.0, 1.0, 1.0).to_vec();
    corners.extend(triangle(5.0, 0.0, 1.0));
    let points = everywhere(mesh(&corners, &[[3, 4, 5], [0, 1, 2], [1, 1, 1]]), 500);
    assert_eq!(ids(&points).iter().filter(|id| id[0] == 1).count(), 500);
}

#[test]
fn texture_coordinates_anywhere_wrap_around() {
    let at = |shift: f32| {
        let corners: Vec<_> = triangle(0.0, 1.0, 1.0)
            .into_iter()
            .map(|(p, [u, v])| (p, [u + shift, v - shift]))
            .collect();
        let (scene, block) = scene(mesh(&corners, &[[0, 1, 2]]));
        floats(&scene.value(block).unwrap(), "loss age").len()
    };
    let [here, there] = [at(0.0), at(-8.0)].map(number);
    assert!((here - there).abs() < 0.01 * here, "{here} {there}");
    assert!(at(1e17) <= 100_000);
}
