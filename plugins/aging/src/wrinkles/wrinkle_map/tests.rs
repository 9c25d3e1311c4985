use std::fs;

use ptlib::{
    Cancel, ComputeOptions, Engine, EngineOptions, Error, ErrorKind, Image, Precision,
    params::ParamValue, value::Value,
};

use super::*;
use crate::testing;

const TWO: &str = "! ma=.2;.5 mb=.8;.5 n=3 relwidth=.5 maxangle=1.5 omegalow=.5\n\
    ! ma=.5;.2 mb=.5;.8 n=2 relwidth=.5 maxangle=1.5 omegalow=.5";

/// The map of an engine with some parameters.
fn map(
    engine: &Engine,
    params: &[(&str, ParamValue)],
    options: ComputeOptions<'_>,
) -> Result<Image, Error> {
    let mut graph = engine.new_graph();
    graph.set_precision(Precision::Float);
    let block = graph.add("aging.wrinkle map")?;
    for (id, value) in params {
        graph.set(block, id, value.clone())?;
    }
    engine.compute(&graph, block, 0, options)
}

#[allow(unsafe_code, reason = "the tables of the plug-in are given as a pointer")]
fn engine_with(options: EngineOptions) -> Engine {
    let engine = Engine::new(options);
    // SAFETY: the entry is a static of this crate, made by the SDK.
    unsafe { engine.register_plugin(&raw const crate::ptl_plugin_entry_v1) }.unwrap();
    engine
}

fn size(width: u32, height: u32) -> ComputeOptions<'static> {
    ComputeOptions { size: Some((width, height)), ..Default::default() }
}

fn muscles(text: &str) -> (&'static str, ParamValue) {
    ("muscles", ParamValue::Text(text.into()))
}

fn bits(image: &Image) -> Vec<u32> {
    image.channel(0).iter().map(|value| value.to_bits()).collect()
}

/// The bits of the map of some muscles.
fn bits_of(text: &str) -> Vec<u32> {
    bits(&map(&testing::engine(), &[muscles(text)], size(48, 48)).unwrap())
}

#[test]
fn sums_become_heights_as_in_the_specification() {
    let sums = [0.670_290, 1.191_342, 1.0, 0.0, 1.588_162, 1.6];
    let heights = |gamma| {
        let mut heights = sums;
        finish(&mut heights, 1.588_162, gamma);
        heights
    };
    let lifted = [0.708_186, 0.891_367, 0.831_079, 0.0, 1.0, 1.0];
    let plain = [0.422_054, 0.750_139, 0.629_659, 0.0, 1.0, 1.0];
    for (gamma, expected) in [(0.4, lifted), (1.0, plain)] {
        for (height, expected) in heights(gamma).into_iter().zip(expected) {
            assert!((height - expected).abs() < 2e-6, "{height} for {expected}");
        }
    }
    let mut flat = sums;
    finish(&mut flat, 0.0, 0.4);
    assert_eq!(flat, [0.0; 6]);
}

#[test]
fn all_parameters_count() {
    let engine = testing::engine();
    let image = |params: &[(&'static str, ParamValue)]| {
        let params: Vec<_> = params.iter().cloned().chain([muscles(TWO)]).collect();
        map(&engine, &params, size(64, 64)).unwrap()
    };
    let read = parse(TWO.as_bytes(), &Limits::default()).unwrap();
    let expected = |style: Style, top: f32, gamma: f32, is_up: bool| {
        let field = Field::new(&read, 1.0, style);
        let (columns, mut sums) = (Columns::new(64, 1.0), vec![0.0; 64 * 64]);
        for (row, y) in sums.chunks_mut(64).zip(0_u32..) {
            let down = (f64::from(y) + 0.5) / 64.0;
            let v = if is_up { 1.0 - down } else { down };
            field.add(&columns.row(v, 0, 64), row, &mut Pace::new(&|| Ok(()))).unwrap();
            finish(row, top, gamma);
        }
        sums.iter().map(|value| value.to_bits()).collect::<Vec<_>>()
    };
    let style = Style { is_wave: false, is_smooth: true };
    let check = || Ok(());
    let field = Field::new(&read, 1.0, style);
    let top = field.greatest(&mut Pace::new(&check)).unwrap();
    let [choice, float] = [ParamValue::Choice(1), ParamValue::Float(0.75)];
    let none = ("normalise", choice.clone());
    assert_eq!(bits(&image(&[])), expected(style, top, 0.4, true));
    assert_eq!(bits(&image(&[("v axis", choice.clone())])), expected(style, top, 0.4, false));
    assert_eq!(bits(&image(&[("gamma", float)])), expected(style, top, 0.75, true));
    assert_eq!(bits(&image(std::slice::from_ref(&none))), expected(style, 1.0, 0.4, true));
    let wave = Style { is_wave: true, ..style };
    assert_eq!(bits(&image(&[("profile", choice), none.clone()])), expected(wave, 1.0, 0.4, true));
    let kinked = Style { is_smooth: false, ..style };
    let smooth = ("smooth", ParamValue::Bool(false));
    assert_eq!(bits(&image(&[smooth, none])), expected(kinked, 1.0, 0.4, true));
}

#[test]
fn the_default_is_a_picture_that_tiles() {
    let image = map(&testing::engine(), &[], size(64, 64)).unwrap();
    let values = image.channel(0);
    assert!(values.iter().any(|value| *value > 0.95) && values.contains(&0.0));
    // Across the border of the image, and of the texture.
    let across = "! ma=.9;.95 mb=1.1;1.05 n=2 relwidth=1 maxangle=2";
    let shifted = "! ma=.4;.45 mb=.6;.55 n=2 relwidth=1 maxangle=2";
    let gamma = ("gamma", ParamValue::Float(1.0));
    let [across, shifted] = [across, shifted].map(|text| {
        map(&testing::engine(), &[muscles(text), gamma.clone()], size(64, 64)).unwrap()
    });
    for y in 0..64 {
        for x in 0..64_usize {
            let other = shifted.row(0, (y + 32) % 64)[(x + 32) % 64];
            let one = across.row(0, y)[x];
            assert!((one - other).abs() < 1e-5, "at {x}, {y}: {one} and {other}");
        }
    }
}

#[test]
fn order_layout_case_and_comments_do_not_change_a_bit() {
    let expected = bits_of(TWO);
    let mut lines: Vec<&str> = TWO.lines().collect();
    lines.reverse();
    for text in [
        lines.join("\r\n"),
        lines.join("   # the other\r"),
        TWO.to_uppercase(),
        TWO.replace('!', "\n\t!\n").replace('=', " =\t").replace(';', " ; "),
        format!("\u{feff}# two\n\n{TWO}\n#"),
    ] {
        assert_eq!(bits_of(&text), expected, "{text:?}");
    }
}

#[test]
fn threads_and_strips_do_not_change_a_bit() {
    let engine = testing::engine();
    // Wider than the piece of a row that the engine asks for at a time.
    let image = |threads, strip_rows| {
        let options = ComputeOptions { threads, strip_rows, ..size(1300, 90) };
        bits(&map(&engine, &[muscles(TWO)], options).unwrap())
    };
    let expected = image(1, 0);
    for (threads, strip_rows) in [(2, 0), (3, 1), (8, 7), (2, 90)] {
        assert_eq!(image(threads, strip_rows), expected, "{threads} threads, {strip_rows} rows");
    }
}

#[test]
fn the_input_comes_before_the_file_and_the_file_before_the_parameter() {
    let folder = std::env::temp_dir().join(format!("ptlib-aging-muscles-{}", std::process::id()));
    fs::create_dir_all(&folder).unwrap();
    let file = |name: &str, text: &[u8]| fs::write(folder.join(name), text).unwrap();
    let [one, two] = [TWO.lines().next().unwrap(), TWO.lines().nth(1).unwrap()];
    file("two.txt", format!("# \u{159}\n{two}").as_bytes());
    file("latin.txt", &[b"# \xe8\xf8\r\n", two.as_bytes()].concat());
    file("bad.txt", b"\xff\xfe!");
    let options =
        EngineOptions { cache_bytes: 0, read_folders: vec![folder.clone()], ..Default::default() };
    let engine = engine_with(options);
    let path = |name: &str| ("path", ParamValue::Text(folder.join(name).to_str().unwrap().into()));
    let image = |name| map(&engine, &[muscles(one), path(name)], size(48, 48));
    assert_eq!(bits(&image("two.txt").unwrap()), bits_of(two));
    assert_eq!(bits(&image("latin.txt").unwrap()), bits_of(two));
    let error = image("bad.txt").unwrap_err();
    assert_eq!(error.kind(), ErrorKind::Parse);
    assert!(error.to_string().contains("bad.txt\": 4 faults: 1:1: "), "{error}");
    assert!(image("none.txt").unwrap_err().to_string().contains("none.txt"));

    let mut graph = engine.new_graph();
    graph.set_precision(Precision::Float);
    let [text, block] = ["text input", "aging.wrinkle map"].map(|id| graph.add(id).unwrap());
    graph.set_input(text, Some(Value::from(TWO.to_owned()))).unwrap();
    graph.connect(text, 0, block, 0).unwrap();
    let (id, value) = path("bad.txt");
    graph.set(block, id, value).unwrap();
    assert_eq!(bits(&engine.compute(&graph, block, 0, size(48, 48)).unwrap()), bits_of(TWO));
    graph.set_input(text, Some(Value::from("! n=1".to_owned()))).unwrap();
    let error = engine.compute(&graph, block, 0, size(48, 48)).unwrap_err().to_string();
    assert!(
        error.contains("input \"text\": 2 faults: 1:1: the muscle has no `ma`; 1:1: "),
        "{error}"
    );
    fs::remove_dir_all(folder).unwrap();
}

#[test]
fn faults_name_the_block_and_all_places() {
    let engine = testing::engine();
    let error = map(&engine, &[muscles("n=2\n! ma=0,5;1 mb=1;1 n=2")], size(8, 8)).unwrap_err();
    assert_eq!(error.kind(), ErrorKind::Parse);
    let message = error.to_string();
    let faults = "\"muscles\": 2 faults: 1:1: `n` stands before the first `!`; 2:6: the value of \
                  `ma` is `0,5`, allowed is a number (use a point, not a comma) -1 to 2";
    assert!(message.contains("aging.wrinkle map") && message.contains(faults), "{message}");
    let error = map(&engine, &[muscles(&"x".repeat(5000))], size(8, 8)).unwrap_err();
    assert_eq!(error.kind(), ErrorKind::Limit);
}

#[test]
fn the_example_is_a_face() {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/examples/head/wrinkles.txt");
    let text = fs::read_to_string(path).unwrap();
    assert!(parse(text.as_bytes(), &Limits::default()).unwrap().len() > 30);
    let image = map(&testing::engine(), &[muscles(&text)], size(64, 64)).unwrap();
    let at = |u: f64, v: f64| {
        let index =
            |place: f64| (0..64).take_while(|i| f64::from(*i) + 1.0 <= place * 64.0).count();
        image.channel(0)[index(1.0 - v) * 64 + index(u)]
    };
    // Forehead, crow's feet, folds, neck; not the eyes, the back of the head, the top.
    for [u, v] in [[0.43, 0.67], [0.36, 0.55], [0.64, 0.55], [0.42, 0.43], [0.5, 0.13]] {
        assert!(at(u, v) > 0.2, "{u}, {v}");
    }
    for [u, v] in [[0.43, 0.57], [0.57, 0.57], [0.05, 0.5], [0.95, 0.5], [0.5, 0.9]] {
        assert_eq!(at(u, v), 0.0, "{u}, {v}");
    }
}

#[test]
fn no_muscle_is_flat_skin() {
    for normalise in [0, 1] {
        let choice = ("normalise", ParamValue::Choice(normalise));
        for text in ["", "# none", "! ma=0;0 mb=1;1 n=1 amplitude=0"] {
            let image = map(&testing::engine(), &[muscles(text), choice.clone()], size(9, 7));
            assert!(bits(&image.unwrap()).iter().all(|bits| *bits == 0));
        }
    }
}

#[test]
fn a_thousand_muscles_as_large_as_can_be_are_stopped_on_request() {
    let text = "! ma=-1;-1 mb=2;2 n=1024 relwidth=1 maxangle=2\n".repeat(1000);
    for normalise in [0, 1] {
        let cancel = Cancel::new();
        let asked = cancel.clone();
        let stopper = std::thread::spawn(move || {
            std::thread::sleep(std::time::Duration::from_millis(30));
            asked.request();
        });
        let options = ComputeOptions { cancel: Some(cancel), ..size(4096, 4096) };
        let choice = ("normalise", ParamValue::Choice(normalise));
        let error = map(&testing::engine(), &[muscles(&text), choice], options).unwrap_err();
        assert_eq!(error.kind(), ErrorKind::Cancelled);
        stopper.join().unwrap();
    }
}
