//! The law of resolution independence: in float precision a block none of whose lengths count
//! pixels shows the same composition at every size. One that does not says in `in_pixels` why.

use ptlib::{
    ComputeOptions, Engine, ErrorKind, Image, Precision,
    block::BlockSpec,
    params::{ParamKind, ParamValue},
    value::Value,
};

use crate::specimen::{Specimen, dispensable_inputs, engine};

/// Width and height of the small image.
const SMALL: u32 = 128;
/// How many times as wide and as high the large one is.
const TIMES: u32 = 4;

/// How far two images of the same composition may be apart.
///
/// They are never equal: means soften what is sharp, and points, lines and circles begin on whole
/// pixels. What only adjusts colours differs by 0.003. What has many sharp edges or cusps differs
/// most: points of a Voronoi diagram close to each other on a cross (0.033, correlation 0.960),
/// fault formation noise (0.014, 0.959), a sine that multiplies differences by 15 (0.020, 0.997).
/// Blocks that count pixels are beyond: a blur of 10 px by 0.047, a dither pattern by 0.052, other
/// filters by 0.1, cracks and automata by everything.
const BOUND: Likeness = Likeness { difference: 0.04, correlation: 0.945 };

/// How alike two images of the same size are, in the worst channel.
#[derive(Debug, Clone, Copy)]
struct Likeness {
    /// The mean absolute difference.
    difference: f64,
    /// The correlation of the channel; 1 where both are flat.
    correlation: f64,
}

impl Likeness {
    fn of(a: &[f64], b: &[f64]) -> Self {
        let count = a.len() as f64;
        let mean = |values: &[f64]| values.iter().sum::<f64>() / count;
        let (mean_a, mean_b) = (mean(a), mean(b));
        let pairs = || a.iter().zip(b);
        let covariance = pairs().map(|(a, b)| (a - mean_a) * (b - mean_b)).sum::<f64>() / count;
        let deviation = |values: &[f64], mean: f64| {
            let squares = values.iter().map(|value| (value - mean) * (value - mean));
            (squares.sum::<f64>() / count).sqrt()
        };
        let (deviation_a, deviation_b) = (deviation(a, mean_a), deviation(b, mean_b));
        // A quarter of a level: what is left of a flat image after arithmetic.
        let is_flat = deviation_a.max(deviation_b) < 1e-3;
        Self {
            difference: pairs().map(|(a, b)| (a - b).abs()).sum::<f64>() / count,
            correlation: if is_flat {
                1.0
            } else {
                covariance / (deviation_a * deviation_b).max(1e-12)
            },
        }
    }

    fn worse(self, other: Self) -> Self {
        Self {
            difference: self.difference.max(other.difference),
            correlation: self.correlation.min(other.correlation),
        }
    }

    fn is_within_the_bound(self) -> bool {
        self.difference <= BOUND.difference && self.correlation >= BOUND.correlation
    }
}

/// The specimen with inputs that keep the law themselves: perlin noise without its blur, which
/// counts pixels, and without octaves as fine as the pixels of the small image.
fn specimen(engine: &Engine, spec: &'static BlockSpec) -> Specimen {
    let mut specimen = Specimen::new(engine, spec, SMALL, SMALL).precision(Precision::Float);
    let Specimen { graph, block } = &mut specimen;
    let is_noise = |id| graph.block(id).expect("it is there").type_id() == "perlin noise";
    let noises: Vec<_> =
        graph.blocks().map(|(id, _)| id).filter(|id| id != block && is_noise(*id)).collect();
    for noise in noises {
        graph.set(noise, "smooth", ParamValue::Bool(false)).expect("the block has it");
        graph.set(noise, "frequency", ParamValue::Int(4)).expect("the block has it");
        graph.set(noise, "max iterations", ParamValue::Int(2)).expect("the block has it");
    }
    specimen
}

/// The block at its defaults, without each of its optional inputs, and with each alternative of
/// its choices, all but numbers and texts.
fn cases(engine: &Engine, spec: &'static BlockSpec) -> Vec<(String, Specimen)> {
    let mut cases = vec![("at defaults".to_owned(), specimen(engine, spec))];
    for port in dispensable_inputs(spec) {
        let mut case = specimen(engine, spec);
        case.graph.disconnect(case.block, port).expect("it is declared");
        cases.push((format!("without input {port}"), case));
    }
    for param in spec.params {
        let values: Vec<_> = match param.kind {
            ParamKind::Choice(items) => {
                (0..).zip(items).map(|(i, _)| ParamValue::Choice(i)).collect()
            }
            ParamKind::Bool => [false, true].map(ParamValue::Bool).to_vec(),
            _ => continue,
        };
        for value in values.into_iter().filter(|value| *value != param.default_value()) {
            let what = format!("{} = {value:?}", param.id);
            let mut case = specimen(engine, spec);
            case.graph.set(case.block, param.id, value).expect("it is allowed");
            cases.push((what, case));
        }
    }
    cases
}

/// The image at that size; nothing for other values, and for alternatives that do not go together.
fn image(engine: &Engine, specimen: &Specimen, side: u32) -> Option<Image> {
    let size = Some((side, side));
    let options = ComputeOptions { size, supersampling: Some(1), ..Default::default() };
    match engine.compute_value(&specimen.graph, specimen.block, 0, options) {
        Ok(Value::Image(image)) => Some(image),
        Ok(_) => None,
        Err(error) if error.kind() == ErrorKind::InvalidArgument && error.hint().is_some() => None,
        Err(error) => panic!("{error}"),
    }
}

/// A channel as means of `times` × `times` pixels around the corners that small pixels show.
fn reduced(image: &Image, channel: usize, times: u32) -> Vec<f64> {
    let (width, times) = (image.width() as usize, times as usize);
    let data = image.channel(channel);
    let around = |place: usize| {
        let start = place * times + width - times / 2;
        (start..start + times).map(|place| place % width)
    };
    let mean = |x: usize, y: usize| {
        let cell = around(y).flat_map(|y| around(x).map(move |x| f64::from(data[y * width + x])));
        cell.sum::<f64>() / (times * times) as f64
    };
    let side = width / times;
    (0..side * side).map(|i| mean(i % side, i / side)).collect()
}

/// How alike the small image and the reduced large one are.
fn likeness(engine: &Engine, specimen: &Specimen) -> Option<Likeness> {
    let small = image(engine, specimen, SMALL)?;
    let large = image(engine, specimen, SMALL * TIMES)?;
    assert_eq!(small.planes(), large.planes());
    let channels = (0..small.planes())
        .map(|i| Likeness::of(&reduced(&small, i, 1), &reduced(&large, i, TIMES)));
    channels.reduce(Likeness::worse)
}

/// Whether lengths of the block count pixels, in float precision.
fn counts_pixels(spec: &BlockSpec) -> bool {
    let in_pixels = spec.about.in_pixels;
    !in_pixels.is_empty() && !in_pixels.ends_with("in 8-bit precision")
}

#[test]
fn compositions_do_not_depend_on_the_resolution() {
    let engine = engine();
    let mut faults = Vec::new();
    let mut worst = Likeness { difference: 0.0, correlation: 1.0 };
    for spec in engine.registry().blocks() {
        let id = spec.about.id;
        let found: Vec<_> = cases(&engine, spec)
            .iter()
            .filter_map(|(what, case)| Some((what.clone(), likeness(&engine, case)?)))
            .collect();
        let Some(worst_here) = found.iter().map(|(_, found)| *found).reduce(Likeness::worse) else {
            continue;
        };
        if counts_pixels(spec) {
            let verb = if worst_here.is_within_the_bound() { "would keep" } else { "breaks" };
            println!("{id} {verb} the law, but declares pixels: {worst_here:?}");
            continue;
        }
        println!("{id}: {worst_here:?}");
        worst = worst.worse(worst_here);
        let outside = found.iter().filter(|(_, found)| !found.is_within_the_bound());
        faults.extend(outside.map(|(what, found)| format!("{id}, {what}: {found:?}")));
    }
    println!("worst of all that keep the law: {worst:?}");
    assert!(faults.is_empty(), "not within {BOUND:?}:\n{}", faults.join("\n"));
}
