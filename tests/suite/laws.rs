//! Laws that every block of the registry keeps. A new block is tested by them without a word here.

use ptlib::{
    ComputeOptions, Engine, EngineOptions, ErrorKind, Image, Precision,
    block::{BlockSpec, Planes},
    params::{ParamKind, ParamSpec, ParamValue},
    value::{Kind, Value},
};

use crate::specimen::{Specimen, dispensable_inputs, engine};

const PRECISIONS: [Precision; 2] = [Precision::Float, Precision::EightBit];

fn compute(engine: &Engine, specimen: &Specimen, options: ComputeOptions<'_>) -> Value {
    let Specimen { graph, block } = specimen;
    engine.compute_value(graph, *block, 0, options).unwrap_or_else(|error| panic!("{error}"))
}

/// The value, or nothing if the block says that these parameters do not go together, and what
/// would.
fn compute_or_refuse(engine: &Engine, specimen: &Specimen) -> Option<Value> {
    let Specimen { graph, block } = specimen;
    match engine.compute_value(graph, *block, 0, ComputeOptions::default()) {
        Ok(value) => Some(value),
        Err(error) if error.kind() == ErrorKind::InvalidArgument && error.hint().is_some() => None,
        Err(error) => panic!("{error}"),
    }
}

/// The bits of an image; nothing for other values, which no thread or strip can change.
fn bits(value: &Value) -> Vec<u32> {
    let Value::Image(image) = value else { return Vec::new() };
    let channels = (0..image.planes()).flat_map(|channel| image.channel(channel));
    channels.map(|value| value.to_bits()).collect()
}

/// A small generator for the choice of random parameters (Marsaglia, "Xorshift RNGs", 2003).
pub struct Random(pub u64);

impl Random {
    pub fn next(&mut self) -> u64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        self.0
    }

    pub fn unit(&mut self) -> f64 {
        (self.next() >> 11) as f64 / (1_u64 << 53) as f64
    }
}

/// The ends of a parameter's ranges; nothing for texts.
fn extremes(param: &ParamSpec) -> Vec<ParamValue> {
    match param.kind {
        ParamKind::Int { hard, soft } => {
            [hard.min, soft.min, soft.max, hard.max].map(ParamValue::Int).to_vec()
        }
        ParamKind::Float { hard, soft } => {
            [hard.min, soft.min, soft.max, hard.max].map(ParamValue::Float).to_vec()
        }
        ParamKind::Bool => vec![ParamValue::Bool(false), ParamValue::Bool(true)],
        ParamKind::Choice(items) => (0..).zip(items).map(|(i, _)| ParamValue::Choice(i)).collect(),
        ParamKind::Text => ["", ";;; ,,", "1e99 -1e99 nan", "0.5:0.5,0.1:0.2"]
            .map(|text| ParamValue::Text(text.into()))
            .to_vec(),
        ParamKind::Path(_) => vec![],
    }
}

/// A value from the parameter's soft range; the present one for texts.
pub fn random_value(param: &ParamSpec, random: &mut Random) -> Option<ParamValue> {
    Some(match param.kind {
        ParamKind::Int { soft, .. } => {
            let span = f64::from(soft.max) - f64::from(soft.min) + 1.0;
            let offset = (random.unit() * span).floor();
            #[expect(clippy::cast_possible_truncation, reason = "inside the range of an i32")]
            let value = (f64::from(soft.min) + offset) as i32;
            ParamValue::Int(value)
        }
        ParamKind::Float { soft, .. } => {
            ParamValue::Float(soft.min + random.unit() * (soft.max - soft.min))
        }
        ParamKind::Bool => ParamValue::Bool(random.next() & 1 == 1),
        ParamKind::Choice(items) => {
            ParamValue::Choice(u32::try_from(random.next() % items.len() as u64).expect("few"))
        }
        ParamKind::Text | ParamKind::Path(_) => return None,
    })
}

/// Checks that an output is what its declaration says.
pub fn check_output(spec: &BlockSpec, value: &Value, what: &str) {
    let port = &spec.about.outputs[0];
    assert_eq!(value.kind(), port.kind, "{}, {what}", spec.about.id);
    let Value::Image(image) = value else { return };
    match port.planes {
        Planes::Grey => assert_eq!(image.planes(), 1, "{}", spec.about.id),
        Planes::Colour => assert_eq!(image.planes(), 3, "{}", spec.about.id),
        Planes::ColourAlpha => assert_eq!(image.planes(), 4, "{}", spec.about.id),
        _ => assert!([1, 3, 4].contains(&image.planes())),
    }
    for channel in 0..image.planes() {
        for value in image.channel(channel) {
            let fits = value.is_finite() && (port.is_free || (0.0..=1.0).contains(value));
            assert!(fits, "{}, {what}: gives {value}", spec.about.id);
        }
    }
}

#[test]
fn outputs_are_finite_and_in_range_at_every_extreme() {
    let engine = engine();
    for spec in engine.registry().blocks() {
        for precision in PRECISIONS {
            let mut specimen = Specimen::new(&engine, spec, 40, 24).precision(precision);
            let value = compute(&engine, &specimen, ComputeOptions::default());
            check_output(spec, &value, "at defaults");
            for param in spec.params {
                for value in extremes(param) {
                    let what = format!("{} = {value:?}", param.id);
                    specimen.graph.set(specimen.block, param.id, value).expect(&what);
                    if let Some(value) = compute_or_refuse(&engine, &specimen) {
                        check_output(spec, &value, &what);
                    }
                }
                // A path is not reset: its default names no file.
                if !matches!(param.kind, ParamKind::Path(_)) {
                    specimen.graph.reset(specimen.block, param.id).expect("it is declared");
                }
            }
        }
    }
}

#[test]
fn outputs_are_finite_and_in_range_at_random_parameters() {
    let engine = engine();
    let mut random = Random(0x9e37_79b9_7f4a_7c15);
    for spec in engine.registry().blocks() {
        for round in 0..12 {
            let (width, height) = (1 + random.next() % 50, 1 + random.next() % 50);
            let side = |side| u32::try_from(side).expect("small");
            let mut specimen = Specimen::new(&engine, spec, side(width), side(height))
                .precision(PRECISIONS[round % 2]);
            let mut what = format!("{width} × {height}");
            for param in spec.params {
                if let Some(value) = random_value(param, &mut random) {
                    what += &format!(", {} = {value:?}", param.id);
                    specimen.graph.set(specimen.block, param.id, value).expect(&what);
                }
            }
            if let Some(value) = compute_or_refuse(&engine, &specimen) {
                check_output(spec, &value, &what);
            }
        }
    }
}

#[test]
fn same_bits_for_every_thread_count_and_strip() {
    let engine = engine();
    for spec in engine.registry().blocks() {
        for precision in PRECISIONS {
            let specimen = Specimen::new(&engine, spec, 67, 45).precision(precision);
            let image = |threads, strip_rows| {
                let options = ComputeOptions { threads, strip_rows, ..Default::default() };
                bits(&compute(&engine, &specimen, options))
            };
            let reference = image(1, 0);
            for (threads, rows) in [(1, 1), (2, 7), (7, 1), (7, 0), (3, 44)] {
                let what = format!("{}: {threads} threads, {rows} rows", spec.about.id);
                assert!(image(threads, rows) == reference, "{what}");
            }
        }
    }
}

#[test]
fn same_bits_when_rows_are_cut_into_segments() {
    let engine = engine();
    for spec in engine.registry().blocks() {
        // A segment is 1024 pixels; a gather behind the block has it computed in whole rows.
        let mut specimen = Specimen::new(&engine, spec, 2500, 3);
        if spec.about.outputs[0].kind != Kind::Image {
            continue;
        }
        let cut = bits(&compute(&engine, &specimen, ComputeOptions::default()));
        let options = ComputeOptions { keep_going: true, ..Default::default() };
        let mut pixels = vec![0; 2500 * 3 * 12];
        let format = ptlib::Format::RgbF32;
        let target = ptlib::PixelsMut { format, pixels: &mut pixels, stride: 2500 * 12 };
        let Specimen { graph, block } = &mut specimen;
        engine.compute_into(graph, *block, 0, options, target).expect("computed before");
        // Pixels of the caller are made from whole rows, too.
        let (numbers, _) = pixels.as_chunks::<4>();
        let planes = cut.len() / 7500;
        for (i, number) in numbers.iter().enumerate() {
            let (pixel, channel) = (i / 3, i % 3);
            let expected = cut[if planes == 1 { pixel } else { channel * 7500 + pixel }];
            assert_eq!(u32::from_ne_bytes(*number), expected, "{}, pixel {pixel}", spec.about.id);
        }
    }
}

/// The mean absolute difference between two columns (or rows) of an image, worst channel.
fn step(image: &Image, pixel: impl Fn(usize, &[f32]) -> (f32, f32), count: usize) -> f32 {
    let of_channel = |channel| {
        let data = image.channel(channel);
        let sum: f32 = (0..count).map(|i| pixel(i, data)).map(|(a, b)| (a - b).abs()).sum();
        sum / count as f32
    };
    (0..image.planes()).map(of_channel).fold(0.0, f32::max)
}

/// Steps between neighbouring columns; the last one is the step across the wrapped edge.
fn column_steps(image: &Image) -> Vec<f32> {
    let (width, height) = (image.width() as usize, image.height() as usize);
    let column = |x: usize| {
        let pixel =
            |y: usize, data: &[f32]| (data[y * width + x], data[y * width + (x + 1) % width]);
        step(image, pixel, height)
    };
    (0..width).map(column).collect()
}

/// Steps between neighbouring rows; the last one is the step across the wrapped edge.
fn row_steps(image: &Image) -> Vec<f32> {
    let (width, height) = (image.width() as usize, image.height() as usize);
    let row = |y: usize| {
        let pixel =
            |x: usize, data: &[f32]| (data[y * width + x], data[(y + 1) % height * width + x]);
        step(image, pixel, width)
    };
    (0..height).map(row).collect()
}

#[test]
fn outputs_tile() {
    let engine = engine();
    let mut random = Random(0x2545_f491_4f6c_dd1d);
    for spec in engine.registry().blocks() {
        for (precision, seed) in [(Precision::Float, 1), (Precision::EightBit, 2)] {
            let id = spec.about.id;
            if let Some(reason) = spec.about.tiling.exception(precision) {
                println!("{id}, {precision:?}: {reason}");
                continue;
            }
            let specimen = Specimen::new(&engine, spec, 128, 96).precision(precision);
            let mut specimen = specimen.with_moved_inputs();
            specimen.graph.set_seed(seed);
            let mut what = format!("{id}, {precision:?}");
            for _ in 0..8 {
                if let Some(value) = compute_or_refuse(&engine, &specimen) {
                    check_edges(&value, &what);
                }
                what = format!("{id}, {precision:?}");
                for param in spec.params {
                    if let Some(value) = random_value(param, &mut random) {
                        what += &format!(", {} = {value:?}", param.id);
                        specimen.graph.set(specimen.block, param.id, value).expect(&what);
                    }
                }
            }
        }
    }
}

/// Fails if there is a seam where an image meets itself.
fn check_edges(value: &Value, what: &str) {
    let Value::Image(image) = value else { return };
    for (mut steps, edge) in
        [(column_steps(image), "right edge"), (row_steps(image), "bottom edge")]
    {
        let across = steps.pop().expect("no image is empty");
        // No step inside is as large as a seam: the largest one bounds that across.
        let inside = steps.into_iter().fold(0.0, f32::max);
        assert!(
            across <= inside * 1.25 + 1e-6,
            "{what}: steps of {across} across the {edge}, of at most {inside} inside"
        );
    }
}

#[test]
fn the_seed_changes_what_it_is_said_to_change() {
    let engine = engine();
    for spec in engine.registry().blocks() {
        if spec.about.outputs[0].kind != Kind::Image {
            continue;
        }
        let image = |seed| {
            let mut specimen = Specimen::new(&engine, spec, 32, 32);
            // What an input may bring, a block may draw itself.
            for port in dispensable_inputs(spec) {
                specimen.graph.disconnect(specimen.block, port).expect("it is declared");
            }
            specimen.graph.set_block_seed(specimen.block, Some(seed)).expect("it is there");
            bits(&compute(&engine, &specimen, ComputeOptions::default()))
        };
        let differs = image(1) != image(1_000_003);
        assert_eq!(differs, spec.about.uses_seed, "{}", spec.about.id);
    }
}

#[test]
fn a_cached_result_is_the_computed_one() {
    let cached = Engine::new(EngineOptions { cache_bytes: 1 << 28, ..Default::default() });
    let plain = engine();
    for spec in cached.registry().blocks() {
        let specimen = Specimen::new(&cached, spec, 50, 40);
        let image = |engine: &Engine| bits(&compute(engine, &specimen, ComputeOptions::default()));
        let expected = image(&plain);
        assert!(image(&cached) == expected, "{}", spec.about.id);
        assert!(image(&cached) == expected, "{} from the cache", spec.about.id);
    }
}

#[test]
fn files_keep_every_block_and_parameter() {
    let engine = engine();
    for spec in engine.registry().blocks() {
        let mut specimen = Specimen::new(&engine, spec, 20, 30);
        for param in spec.params {
            if let Some(value) = extremes(param).pop() {
                specimen.graph.set(specimen.block, param.id, value).expect("it is in range");
            }
        }
        let written = ptlib::io::write_graph(&specimen.graph);
        let reading = engine.read_graph(written.as_bytes()).unwrap_or_else(|e| panic!("{e}"));
        assert!(reading.warnings.is_empty(), "{}: {:?}", spec.about.id, reading.warnings);
        assert_eq!(ptlib::io::write_graph(&reading.graph), written);
        let id = specimen.graph.block(specimen.block).expect("it is there").id().to_owned();
        let again = reading.graph.find(&id).expect("written above");
        let values = |graph: &ptlib::Graph, block| graph.block(block).unwrap().values().to_vec();
        assert_eq!(
            values(&reading.graph, again),
            values(&specimen.graph, specimen.block),
            "{}",
            spec.about.id
        );
    }
}

#[test]
fn everything_is_described() {
    let is_sentence = |text: &str| text.len() > 8 && text.ends_with(['.', '!', ')']);
    let is_id = |id: &str| {
        let word = |word: &str| {
            !word.is_empty()
                && word.chars().all(|c| c.is_ascii_lowercase() || c.is_ascii_digit() || c == '-')
        };
        id.split(' ').all(word)
    };
    for spec in engine().registry().blocks() {
        let about = &spec.about;
        assert!(is_id(about.id), "id \"{}\"", about.id);
        assert!(is_sentence(about.summary), "{}: \"{}\"", about.id, about.summary);
        assert!(!about.outputs.is_empty(), "{} gives nothing", about.id);
        let ports = about.inputs.iter().map(|port| port.id);
        for id in ports.chain(about.outputs.iter().map(|port| port.id)) {
            assert!(is_id(id), "{}: port \"{id}\"", about.id);
        }
        for param in spec.params {
            assert!(is_id(param.id), "{}: parameter \"{}\"", about.id, param.id);
            assert!(is_sentence(param.doc), "{}: \"{}\"", about.id, param.doc);
            if let ParamKind::Choice(items) = param.kind {
                for item in items {
                    assert!(is_id(item.id), "{}: alternative \"{}\"", about.id, item.id);
                    assert!(is_sentence(item.doc), "{}: \"{}\"", about.id, item.doc);
                }
            }
        }
    }
}
