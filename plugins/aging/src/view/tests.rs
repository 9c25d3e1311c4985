//! The block through the engine.

use ptlib::{Cancel, ComputeOptions, ErrorKind, Image, value::Value};

use crate::view::trial::{self, Trial};

const COLOR: u32 = 1;
const NORMALS: u32 = 2;
const FINE: u32 = 3;
const MASK: u32 = 4;
const HAIR: u32 = 5;

/// A head with everything.
fn head(side: u32) -> Trial {
    let mut trial = Trial::sphere(side, 2000);
    let fine = |u: f64, v: f64| {
        let part = |x: f64| (x * 32.0).fract() - 0.5;
        (0.5 - part(u) * part(u) - part(v) * part(v)).max(0.0)
    };
    trial
        .give(
            "image input",
            COLOR,
            trial::picture(64, |u, v| {
                [0.5 + 0.4 * u, 0.4 + 0.3 * v, 0.5, 1.0].map(ptlib_plugin::math::single)
            }),
        )
        .give("image input", NORMALS, trial::normals(128, 0.02, trial::forehead))
        .give("image input", FINE, trial::normals(128, 0.004, fine))
        .give("image input", MASK, trial::picture(16, |u, _| [ptlib_plugin::math::single(u); 4]))
        .float("depth", 0.02);
    trial
}

fn grey(level: f32) -> Value {
    trial::picture(8, |_, _| [level, level, level, 1.0])
}

/// Where a picture is brightest: the mean column and row, by how much brighter than the rest it is.
fn brightest(image: &Image) -> [f64; 2] {
    let most = image.channel(0).iter().fold(0.0_f32, |most, value| most.max(*value));
    let (mut sum, mut place) = (0.0, [0.0; 2]);
    for y in 0..image.height() {
        for (x, value) in (0_u32..).zip(image.row(0, y)) {
            let weight = f64::from((value / most - 0.8).max(0.0));
            sum += weight;
            place[0] += weight * f64::from(x);
            place[1] += weight * f64::from(y);
        }
    }
    place.map(|place| place / sum)
}

#[test]
fn threads_do_not_matter() {
    let mut trial = head(200);
    trial.give("strands input", HAIR, trial::hair(3000, 3, 0.3, 0.5));
    let first = trial.bits();
    for threads in [2, 3, 8] {
        trial.threads = threads;
        assert!(trial.bits() == first, "{threads}");
    }
}

#[test]
fn age_0_is_a_picture_without_search_bit_for_bit() {
    let mut trial = head(160);
    let with = trial.bits();
    trial.float("age", 0.0);
    let young = trial.bits();
    assert!(with != young, "wrinkles are seen");
    trial.float("age", 1.0).choice("search", 3);
    assert!(trial.bits() == young, "search off");
    trial.choice("search", 2).float("depth", 0.0);
    assert!(trial.bits() == young, "depth 0");
    trial.float("depth", 0.02).give("image input", MASK, grey(0.0));
    assert!(trial.bits() == young, "black mask");
}

#[test]
fn flat_skin_stays_where_its_level_is() {
    let mut trial = Trial::sphere(96, 2000);
    let color =
        trial::picture(96, |u, v| [u, v, (u * 9.0).fract(), 1.0].map(ptlib_plugin::math::single));
    trial.give("image input", COLOR, color).choice("search", 3);
    trial.give("image input", NORMALS, trial::normals(32, 0.01, |_, _| 0.0));
    let without = trial.bits();
    for search in 0..3 {
        trial.choice("search", search);
        assert!(trial.bits() == without, "{search}");
    }
    trial.float("level", 1.0);
    assert!(trial.bits() != without, "flat skin lies below the mesh");
}

#[test]
fn a_sphere_is_as_large_as_the_camera_sees_it() {
    let image = Trial::sphere(200, 20_000).image();
    let alpha = image.channel(3);
    assert!(alpha.iter().all(|alpha| *alpha == 0.0 || *alpha == 1.0));
    // 3 radii of √3 away, an angle of 35°: tan asin(1/3√3) · 100 / tan 17.5°.
    let radius = 0.196_116 * 100.0 / 0.315_299;
    let area = f64::from(alpha.iter().sum::<f32>());
    assert!((area / (std::f64::consts::PI * radius * radius) - 1.0).abs() < 0.01, "{area}");
}

/// A square across the middle that looks at the camera.
fn wall(side: u32) -> Trial {
    let mut trial = Trial::new(side);
    let corners = [[-1.0, -1.0, 0.0], [1.0, -1.0, 0.0], [1.0, 1.0, 0.0], [-1.0, 1.0, 0.0]];
    trial.give("mesh input", 0, trial::plain_mesh(&corners, &[0, 1, 2, 0, 2, 3]));
    trial.float("light yaw", 60.0).float("light pitch", 0.0).float("distance", 22.0);
    trial.float("field of view", 5.0);
    trial
}

fn middle(trial: &Trial) -> [f32; 3] {
    let image = trial.image();
    let half = image.width() / 2;
    [0, 1, 2].map(|channel| image.row(channel, half)[half as usize])
}

fn near(found: [f32; 3], expected: [f32; 3], tolerance: f32) {
    let is_near = found.iter().zip(expected).all(|(a, b)| (a - b).abs() < tolerance);
    assert!(is_near, "{found:?}, not {expected:?}");
}

#[test]
fn light_is_that_of_the_formula() {
    let mut trial = wall(32);
    trial.give("image input", COLOR, trial::picture(8, |_, _| [0.5, 0.4, 0.3, 1.0]));
    // 0.2 + 0.8 cos 60° = 0.6, and 0.2 cos²⁰ 30°.
    let mirrored = 0.2 * 0.056_313_5;
    near(middle(&trial), [0.3, 0.24, 0.18].map(|x| x + mirrored), 1e-3);
    trial.float("specular", 0.0);
    near(middle(&trial), [0.3, 0.24, 0.18], 1e-5);
    trial.float("light yaw", 120.0);
    near(middle(&trial), [0.1, 0.08, 0.06], 1e-5);
}

#[test]
fn normals_lean_to_the_light_in_either_packing() {
    // Leaning to the right by 60° and by nothing else: it faces the light.
    let sine = 0.75_f64.sqrt();
    let mut images = vec![];
    for (range, blue) in [(0, 0.5), (1, 0.75)] {
        let normal = [sine / 2.0 + 0.5, 0.5, blue, 0.0].map(ptlib_plugin::math::single);
        let mut trial = wall(32);
        trial.give("image input", NORMALS, trial::picture(8, |_, _| normal));
        trial.give("image input", COLOR, grey(0.5));
        trial.choice("z range", range).float("specular", 0.0);
        images.push(middle(&trial));
        near(middle(&trial), [0.5; 3], 1e-4);
    }
    // Leaning upwards, to a light from above; the other axis leans it away.
    let normal = [0.5, sine / 2.0 + 0.5, 0.5, 0.0].map(ptlib_plugin::math::single);
    let mut trial = wall(32);
    trial.give("image input", NORMALS, trial::picture(8, |_, _| normal));
    trial.give("image input", COLOR, grey(0.5)).float("specular", 0.0);
    trial.float("light yaw", 0.0).float("light pitch", 60.0);
    near(middle(&trial), [0.5; 3], 1e-4);
    trial.choice("y axis", 1);
    near(middle(&trial), [0.1; 3], 1e-4);
}

#[test]
fn fine_detail_leans_alone_and_with_wrinkles() {
    // Leaning to the right by 30°: alone it is 30° from the light, twice it faces it.
    let lean = || {
        let normal = [0.75, 0.5, 0.75_f64.sqrt(), 0.0].map(ptlib_plugin::math::single);
        trial::picture(8, |_, _| normal)
    };
    let mut trial = wall(32);
    trial.give("image input", FINE, lean()).give("image input", COLOR, grey(0.5));
    trial.float("specular", 0.0);
    near(middle(&trial), [0.5 * (0.2 + 0.8 * 0.866_025); 3], 1e-3);
    trial.give("image input", NORMALS, lean());
    near(middle(&trial), [0.5; 3], 1e-3);
}

#[test]
fn a_slanted_look_sees_ridges_before_what_is_behind_them() {
    // A wall seen from the right at 60°; the right half is high. At the rim the high part hides
    // some of the low one: the colour of the high part reaches farther left than it lies.
    let mut trial = wall(128);
    let step = |u: f64, _: f64| f64::from(u8::from((0.25..0.5).contains(&u)));
    trial.give("image input", NORMALS, trial::normals(128, 0.0, step));
    trial.give(
        "image input",
        COLOR,
        trial::picture(128, |u, v| [ptlib_plugin::math::single(step(u, v)), 0.5, 0.5, 1.0]),
    );
    trial.float("yaw", 60.0).float("ambient", 1.0).float("specular", 0.0).float("depth", 0.1);
    trial.int("linear steps", 32);
    let width = |trial: &Trial| trial.image().row(0, 64).iter().sum::<f32>();
    let with = width(&trial);
    trial.choice("search", 3);
    let without = width(&trial);
    // The side of the ridge is seen as wide as k = 0.1 · sin 60°; between two pixels of the texture
    // its colour fades as its height does, so it counts half.
    let expected = 0.0866 / 2.0 * without / 0.25;
    assert!((with - without - expected).abs() < 0.3 * expected, "{with} {without} {expected}");
}

#[test]
fn the_highlight_of_hair_moves_with_the_light() {
    let mut trial = Trial::sphere(128, 2000);
    trial.give("strands input", HAIR, trial::hair(20_000, 4, 0.35, 1.0)).float("hair width", 0.01);
    trial.float("k specular", 1.0).float("k diffuse", 0.0).float("pitch", 60.0);
    trial.float("ambient", 0.0).float("specular", 0.0).give("image input", COLOR, grey(0.0));
    let [left, right] = [-60.0, 60.0].map(|yaw| {
        trial.float("light yaw", yaw);
        brightest(&trial.image())
    });
    assert!(left[0] + 10.0 < right[0], "{left:?} {right:?}");
}

#[test]
fn hair_fades_when_it_is_thin_and_hides_behind_the_head() {
    let mut trial = wall(64);
    let line = |z: f32| vec![[-0.8, 0.03, z], [0.8, 0.03, z]];
    trial.give("image input", COLOR, grey(0.0));
    let colors = [[1.0; 3]];
    trial.float("k diffuse", 1.0).float("k ambient red", 0.0).float("hair width", 0.5 / 64.0);
    trial.float("specular", 0.0).float("ambient", 0.0);
    let red = |trial: &mut Trial, z| {
        trial.give("strands input", HAIR, trial::strands(&[line(z)], Some(&colors)));
        let image = trial.image();
        (20..44).map(|y| image.row(0, y)[32]).sum::<f32>()
    };
    let thin = red(&mut trial, 0.1);
    assert!(red(&mut trial, -0.1) < 1e-3, "behind");
    trial.float("hair width", 1.0 / 64.0);
    let whole = red(&mut trial, 0.1);
    assert!(whole > 0.3 && (thin / whole - 0.5).abs() < 0.05, "{thin} of {whole}");
    trial.float("hair width", 0.0);
    assert!(red(&mut trial, 0.1) < 1e-3, "no width");
}

#[test]
fn what_is_missing_is_named_with_the_block_that_makes_it() {
    let corners = [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
    let mut trial = Trial::new(16);
    trial.give("mesh input", 0, trial::bare_mesh(&corners, &[0, 1, 2]));
    let fails = |trial: &Trial, words: [&str; 2]| {
        let error = trial.try_image().unwrap_err();
        assert!(words.iter().all(|word| error.to_string().contains(word)), "{error}");
    };
    fails(&trial, ["normals", "aging.mesh frames"]);
    let mut trial = Trial::new(16);
    trial.give("mesh input", 0, trial::normal_mesh(&corners, &[0, 1, 2]));
    assert_eq!(trial.image().width(), 16, "normals suffice without images");
    trial.give("image input", COLOR, grey(0.5));
    fails(&trial, ["texture coordinates", "mesh input"]);
    trial.give("image input", NORMALS, grey(0.5));
    fails(&trial, ["tangents", "aging.mesh frames"]);
    let mut trial = Trial::sphere(16, 100);
    let grey = trial.graph.add("color fill").unwrap();
    trial.graph.connect(grey, 0, trial.view, NORMALS).unwrap();
    fails(&trial, ["heights", "aging.height to normal"]);
}

/// The picture of a mesh, which has to be there, with numbers from 0 to 1.
fn survives(mesh: Value, hair: Option<Value>) -> f32 {
    let mut trial = Trial::new(96);
    trial.give("mesh input", 0, mesh).give("image input", COLOR, grey(0.5));
    trial.give("image input", NORMALS, trial::normals(16, 0.01, |u, _| u));
    if let Some(hair) = hair {
        trial.give("strands input", HAIR, hair);
    }
    let mut covered = 0.0;
    for (distance, angle, parallax) in [(1.0, 120.0, 0), (3.0, 35.0, 1)] {
        trial.float("distance", distance).float("field of view", angle);
        let image = trial.choice("parallax", parallax).image();
        let mut numbers = (0..4).flat_map(|channel| image.channel(channel));
        assert!(numbers.all(|number| (0.0..=1.0).contains(number)));
        covered += image.channel(3).iter().sum::<f32>();
    }
    covered
}

#[test]
fn hostile_meshes_are_drawn_or_not_but_never_harm() {
    let e = 1e18_f32;
    let far = [[-e, -e, -e], [e, -e, e], [e, e, -e], [0.0, 0.0, 0.0], [1e-18, 0.0, 0.0]];
    assert!(survives(trial::plain_mesh(&far, &[0, 1, 2, 0, 3, 4, 1, 2, 4, 2, 1, 0]), None) > 0.0);
    let tiny = far.map(|corner| corner.map(|x| x / e * 1e-38));
    assert!(survives(trial::plain_mesh(&tiny, &[0, 1, 2]), None) > 0.0);
    // No triangles (for which nothing has to be there), no area, one point.
    assert_eq!(survives(trial::bare_mesh(&[], &[]), None), 0.0);
    assert_eq!(survives(trial::bare_mesh(&[[0.0; 3], [1.0; 3]], &[]), None), 0.0);
    assert_eq!(survives(trial::plain_mesh(&[], &[]), None), 0.0);
    let point = [[3.0; 3]; 3];
    assert_eq!(survives(trial::plain_mesh(&point, &[0, 1, 2, 0, 0, 0, 1, 1, 2]), None), 0.0);
    // Many triangles in few pixels, and many that fill the picture.
    let corners = [[-1.0, -1.0, 0.0], [1.0, -1.0, 0.0], [0.0, 1.0, 0.0], [1e-3, 0.0, 0.0]];
    let many: Vec<u32> = [0, 3, 3, 3, 3, 1].repeat(50_000);
    assert_eq!(survives(trial::plain_mesh(&corners, &many), None), 0.0);
    let full = [0, 1, 2].repeat(2000);
    assert!(survives(trial::plain_mesh(&corners, &full), None) > 0.0);
}

#[test]
fn hostile_hair_is_drawn_or_not_but_never_harms() {
    let e = 1e18_f32;
    let ends = [
        vec![[-e, 0.0, 0.0], [e, 0.0, 0.0]],
        vec![[0.0; 3], [0.0; 3], [0.0; 3]],
        vec![[0.0, 0.0, e], [0.0, 0.1, -e], [e, e, e]],
        vec![[0.1, 0.0, 0.0], [0.1, 1e-38, 0.0], [0.1, 0.2, 0.0]],
    ];
    let corners = [[-1.0, -1.0, 0.0], [1.0, -1.0, 0.0], [0.0, 1.0, 0.0]];
    let mesh = trial::plain_mesh(&corners, &[0, 1, 2]);
    assert!(survives(mesh, Some(trial::strands(&ends, None))) > 0.0);
    let nothing = trial::plain_mesh(&[], &[]);
    assert!(survives(nothing, Some(trial::strands(&ends[3..], None))) > 0.0, "hair alone");
}

#[test]
fn work_can_be_stopped() {
    let mut trial = Trial::sphere(64, 2000);
    trial.give("strands input", HAIR, trial::hair(2000, 4, 0.3, 0.0));
    let cancel = Cancel::new();
    cancel.request();
    let options = ComputeOptions { cancel: Some(cancel), ..Default::default() };
    let error = trial.engine.compute(&trial.graph, trial.view, 0, options).unwrap_err();
    assert_eq!(error.kind(), ErrorKind::Cancelled);
}
