//! The engine on blocks made for it: each shape, several outputs, and blocks that misbehave.

use std::{cell::Cell, sync::Mutex, time::Duration};

use super::{
    Band, Bands, Cancel, ComputeOptions, Engine, EngineOptions, LogLevel, PixelsMut, ProgressReport,
};
use crate::{
    block::{Family, prelude::*},
    graph::{BlockId, Graph},
    math::levels::Precision,
    value::Format,
};

params! {
    /// None.
    Nothing {}
}

params! {
    /// How much.
    Amount {
        /// How much.
        amount: float [hard -1e9..=1e9 soft 0.0..=1.0] = 0.0;
    }
}

/// How often this thread prepared `ramp`.
fn prepared() -> usize {
    PREPARED.get()
}

thread_local! {
    // A block is prepared on the thread that computes, and each test has a thread of its own.
    static PREPARED: Cell<usize> = const { Cell::new(0) };
}

/// x/W in one output, y/H in the other.
struct Ramp;
static RAMP: BlockSpec = BlockSpec::point::<Ramp>(About {
    id: "ramp",
    outputs: &[output("x", Planes::Grey), output("colour", Planes::Colour)],
    ..About::DEFAULT
});
impl PointBlock for Ramp {
    type Params = Amount;
    fn prepare<L: Levels>(_: &Amount, _: &PrepareContext<'_>) -> Result<Self, Error> {
        PREPARED.set(PREPARED.get() + 1);
        Ok(Self)
    }
    #[inline(always)]
    fn row<L: Levels>(&self, cx: &RowContext<'_>, _: &InputRows<'_>, out: &mut OutputRow<'_>) {
        for (x, value) in (cx.x..).zip(out.plane(0)) {
            *value = convert::pixels(x) / convert::pixels(cx.width);
        }
        for plane in 1..4 {
            out.plane(plane).fill(convert::pixels(cx.y) / convert::pixels(cx.height));
        }
    }
}

/// Adds its amount to any numbers.
struct Add(f32);
static ADD: BlockSpec = BlockSpec::point::<Add>(About {
    id: "add",
    inputs: &[input("image", Kind::Image)],
    outputs: &[output("image", Planes::As(0)).free()],
    ..About::DEFAULT
});
impl PointBlock for Add {
    type Params = Amount;
    fn prepare<L: Levels>(params: &Amount, _: &PrepareContext<'_>) -> Result<Self, Error> {
        Ok(Self(convert::single(params.amount)))
    }
    #[inline(always)]
    fn row<L: Levels>(&self, _: &RowContext<'_>, inputs: &InputRows<'_>, out: &mut OutputRow<'_>) {
        out.map(inputs, 0, |value| value + self.0);
    }
}

/// The pixel below, minus half the pixel of the second input.
struct Below(Image);
static BELOW: BlockSpec = BlockSpec::gather::<Below>(About {
    id: "below",
    inputs: &[input("image", Kind::Image).anywhere(), input("here", Kind::Image).optional()],
    outputs: &[output("image", Planes::As(0))],
    ..About::DEFAULT
});
impl GatherBlock for Below {
    type Params = Nothing;
    fn prepare<L: Levels>(_: &Nothing, cx: &PrepareContext<'_>) -> Result<Self, Error> {
        Ok(Self(cx.image(0)?.clone()))
    }
    #[inline(always)]
    fn row<L: Levels>(&self, cx: &RowContext<'_>, inputs: &InputRows<'_>, out: &mut OutputRow<'_>) {
        for (channel, out) in out.iter_mut().enumerate() {
            out.copy_from_slice(self.0.row(channel, (cx.y + 1) % cx.height));
            if inputs.is_connected(1) {
                for (out, here) in out.iter_mut().zip(inputs.channel(1, channel)) {
                    *out -= here / 2.0;
                }
            }
        }
    }
}

/// The mean of its input everywhere, computed at once.
struct Mean;
static MEAN: BlockSpec = BlockSpec::whole::<Mean>(About {
    id: "mean",
    inputs: &[input("image", Kind::Image)],
    outputs: &[output("image", Planes::Grey)],
    ..About::DEFAULT
});
impl WholeBlock for Mean {
    type Params = Nothing;
    fn compute<L: Levels>(_: &Nothing, cx: &WholeContext<'_>) -> Result<Vec<Value>, Error> {
        let data = cx.image(0)?.channel(0);
        let mean = data.iter().sum::<f32>() / convert::pixels(cx.width * cx.height);
        let mut image = cx.new_image(1)?;
        image.planes_mut().for_each(|plane| plane.fill(mean));
        Ok(vec![image.into()])
    }
}

/// Misbehaves: 0 panics in a row, 1 panics in prepare, 2 fails, 3 gives strange numbers.
struct Bad(f64);
static BAD: BlockSpec = BlockSpec::point::<Bad>(About {
    id: "bad",
    outputs: &[output("image", Planes::Grey)],
    ..About::DEFAULT
});
impl PointBlock for Bad {
    type Params = Amount;
    fn prepare<L: Levels>(params: &Amount, _: &PrepareContext<'_>) -> Result<Self, Error> {
        assert!(params.amount != 1.0, "as asked");
        if params.amount == 2.0 {
            return Err(Error::new(ErrorKind::Limit, "too much"));
        }
        Ok(Self(params.amount))
    }
    #[inline(always)]
    fn row<L: Levels>(&self, cx: &RowContext<'_>, _: &InputRows<'_>, out: &mut OutputRow<'_>) {
        assert!(self.0 == 3.0 || cx.y < 5, "as asked in row {}", cx.y);
        out.grey().fill(f32::NAN);
    }
}

/// Writes rows until it is asked to stop.
struct Endless;
static ENDLESS: BlockSpec = BlockSpec::point::<Endless>(About {
    id: "endless",
    outputs: &[output("image", Planes::Grey)],
    ..About::DEFAULT
});
impl PointBlock for Endless {
    type Params = Nothing;
    fn prepare<L: Levels>(_: &Nothing, _: &PrepareContext<'_>) -> Result<Self, Error> {
        Ok(Self)
    }
    fn row<L: Levels>(&self, cx: &RowContext<'_>, _: &InputRows<'_>, out: &mut OutputRow<'_>) {
        out.grey().fill(0.25);
        while !cx.is_stopped() {}
    }
}

/// A text, and a block that gives no output although it declares one.
struct Words;
static WORDS: BlockSpec = BlockSpec::whole::<Words>(About {
    id: "words",
    outputs: &[output("text", Planes::Grey).of_kind(Kind::Text)],
    ..About::DEFAULT
});
impl WholeBlock for Words {
    type Params = Amount;
    fn compute<L: Levels>(params: &Amount, cx: &WholeContext<'_>) -> Result<Vec<Value>, Error> {
        cx.warn(Error::new(ErrorKind::Parse, "is strange").at_parameter("amount"));
        Ok(if params.amount == 0.0 { vec![String::from("words").into()] } else { vec![] })
    }
}

static FAMILY: Family =
    Family { name: "tests", blocks: &[&RAMP, &ADD, &BELOW, &MEAN, &BAD, &ENDLESS, &WORDS] };

fn engine(cache_bytes: u64) -> Engine {
    let engine = Engine::new(EngineOptions { threads: 4, cache_bytes, ..Default::default() });
    engine.registry().add(&FAMILY).unwrap();
    engine
}

/// A graph of blocks; each reads those named by (block, output).
fn graph(engine: &Engine, blocks: &[(&str, &[(usize, u32)])]) -> (Graph, Vec<BlockId>) {
    let mut graph = engine.new_graph();
    graph.set_size(13, 9).unwrap();
    let mut ids = Vec::new();
    for (type_id, sources) in blocks {
        let id = graph.add(type_id).unwrap();
        for (port, (block, output)) in (0..).zip(*sources) {
            graph.connect(ids[*block], *output, id, port).unwrap();
        }
        ids.push(id);
    }
    (graph, ids)
}

fn bits(image: &Image) -> Vec<u32> {
    (0..image.planes()).flat_map(|c| image.channel(c)).map(|value| value.to_bits()).collect()
}

/// One stage of everything: shared blocks, both outputs, a gather with a fused input.
const MIXED: &[(&str, &[(usize, u32)])] = &[
    ("ramp", &[]),
    ("add", &[(0, 0)]),
    ("below", &[(0, 1), (1, 0)]),
    ("mean", &[(2, 0)]),
    ("below", &[(2, 0), (3, 0)]),
    ("end", &[(4, 0)]),
];

#[test]
fn fused_blocks_compute_what_they_say() {
    let engine = engine(0);
    let (mut graph, ids) = graph(&engine, MIXED);
    graph.set_float(ids[1], "amount", 0.5).unwrap();
    let image = engine.compute(&graph, ids[2], 0, ComputeOptions::default()).unwrap();
    assert_eq!((image.width(), image.height(), image.planes()), (13, 9, 3));
    // Row 1 of the colour ramp below row 0, minus half of x/W + 0.5.
    let expected = |x: f32, y: f32| (y / 9.0 - (x / 13.0 + 0.5) / 2.0).max(0.0);
    assert_eq!(image.row(1, 7)[5], expected(5.0, 8.0));
    assert_eq!(image.row(2, 8)[0], expected(0.0, 0.0));
}

#[test]
fn same_bits_for_every_number_of_threads_and_strip() {
    let engine = engine(0);
    let (mut graph, ids) = graph(&engine, MIXED);
    for supersampling in [1, 3] {
        graph.set_supersampling(supersampling).unwrap();
        let image = |threads, strip_rows| {
            let options = ComputeOptions { threads, strip_rows, ..Default::default() };
            bits(&engine.compute(&graph, ids[5], 0, options).unwrap())
        };
        let reference = image(1, 0);
        for (threads, rows) in [(1, 1), (2, 2), (4, 1), (3, 5), (4, 100)] {
            assert_eq!(image(threads, rows), reference, "{threads} threads, {rows} rows");
        }
    }
}

#[test]
fn wide_rows_are_cut_into_segments_without_a_trace() {
    let engine = engine(0);
    let (mut graph, ids) = graph(&engine, &[("ramp", &[]), ("add", &[(0, 0)])]);
    graph.set_size(3001, 2).unwrap();
    let image = engine.compute(&graph, ids[1], 0, ComputeOptions::default()).unwrap();
    for x in [0, 1023, 1024, 2048, 3000_u16] {
        assert_eq!(image.row(0, 1)[usize::from(x)], f32::from(x) / 3001.0);
    }
}

#[test]
fn supersampling_averages() {
    let engine = engine(0);
    let (mut graph, ids) = graph(&engine, &[("ramp", &[]), ("end", &[(0, 0)])]);
    graph.set_supersampling(2).unwrap();
    let image = engine.compute(&graph, ids[1], 0, ComputeOptions::default()).unwrap();
    assert_eq!((image.width(), image.height()), (13, 9));
    assert!((image.row(0, 0)[3] - 6.5 / 26.0).abs() < 1e-6);
    graph.set_precision(Precision::EightBit);
    let image = engine.compute(&graph, ids[1], 0, ComputeOptions::default()).unwrap();
    // Columns 6 and 7 of 26: levels 58 and 68.
    assert_eq!(image.row(0, 0)[3], 63.0 / 255.0);
}

#[test]
fn pixels_go_straight_to_the_caller() {
    let engine = engine(0);
    let (mut graph, ids) = graph(&engine, MIXED);
    for supersampling in [1, 2] {
        graph.set_supersampling(supersampling).unwrap();
        for block in [ids[5], ids[3], ids[0]] {
            let image = engine.compute(&graph, block, 0, ComputeOptions::default()).unwrap();
            let expected = image.to_pixels(Format::Rgb16);
            let stride = 13 * 6 + 10;
            let mut pixels = vec![0xaa; stride * 8 + 13 * 6];
            let target = PixelsMut { format: Format::Rgb16, pixels: &mut pixels, stride };
            engine.compute_into(&graph, block, 0, ComputeOptions::default(), target).unwrap();
            for (row, expected) in pixels.chunks(stride).zip(expected.data.chunks(13 * 6)) {
                let (row, padding) = row.split_at(13 * 6);
                assert_eq!(row, expected);
                assert!(padding.iter().all(|byte| *byte == 0xaa));
            }
        }
    }
}

#[test]
fn bands_together_are_the_image() {
    let engine = engine(0);
    let (graph, ids) = graph(&engine, MIXED);
    for supersampling in [1, 2] {
        let options =
            || ComputeOptions { supersampling: Some(supersampling), ..Default::default() };
        for block in [ids[5], ids[3], ids[0]] {
            let expected = engine.compute(&graph, block, 0, options()).unwrap();
            for rows in [1, 4, 9, 100, 0] {
                let mut all: Vec<u8> = Vec::new();
                let mut deliver = |band: &Band<'_>| {
                    assert_eq!(band.stride(), 13 * 6);
                    assert_eq!(band.first_row as usize * band.stride(), all.len());
                    assert!(rows == 0 || band.rows == rows.min(9 - band.first_row));
                    all.extend(band.pixels);
                    Ok(())
                };
                let bands = Bands { format: Format::Rgb16, rows, deliver: &mut deliver };
                engine.compute_bands(&graph, block, 0, options(), bands).unwrap();
                assert_eq!(all, expected.to_pixels(Format::Rgb16).data, "{rows}");
            }
        }
    }
}

#[test]
fn the_taker_of_bands_ends_a_computation_that_no_memory_could_hold() {
    let engine = engine(0);
    let (graph, ids) = graph(&engine, &[("ramp", &[]), ("add", &[(0, 0)]), ("end", &[(1, 0)])]);
    let mut taken = 0;
    let mut deliver = |band: &Band<'_>| {
        taken += band.rows;
        Err(Error::new(ErrorKind::Io, "the disk is full"))
    };
    let bands = Bands { format: Format::RgbaF32, rows: 0, deliver: &mut deliver };
    let options = ComputeOptions {
        size: Some((16_384, 16_384)),
        memory_bytes: Some(64 << 20),
        ..Default::default()
    };
    let error = engine.compute_bands(&graph, ids[2], 0, options, bands).unwrap_err();
    assert_eq!((error.kind(), taken), (ErrorKind::Io, 128));
}

#[test]
fn white_bands_follow_those_that_are_gone() {
    let engine = engine(0);
    let (mut graph, ids) = graph(&engine, &[("bad", &[]), ("end", &[(0, 0)])]);
    graph.set_float(ids[0], "amount", 2.0).unwrap();
    let mut rows = Vec::new();
    let mut deliver = |band: &Band<'_>| {
        rows.push((band.first_row, band.pixels[0]));
        Ok(())
    };
    let bands = Bands { format: Format::Grey8, rows: 4, deliver: &mut deliver };
    let options = ComputeOptions { keep_going: true, ..Default::default() };
    engine.compute_bands(&graph, ids[1], 0, options, bands).unwrap();
    assert_eq!(rows.iter().map(|(first, _)| *first).collect::<Vec<_>>(), [0, 4, 8]);
    assert_eq!(rows[2].1, 255);
}

#[test]
fn a_small_buffer_is_refused() {
    let engine = engine(0);
    let (graph, ids) = graph(&engine, MIXED);
    let into = |len: usize, stride| {
        let mut pixels = vec![0; len];
        let target = PixelsMut { format: Format::Grey8, pixels: &mut pixels, stride };
        engine.compute_into(&graph, ids[5], 0, ComputeOptions::default(), target)
    };
    assert_eq!(into(13 * 9 - 1, 13).unwrap_err().kind(), ErrorKind::BufferTooSmall);
    assert_eq!(into(1000, 12).unwrap_err().kind(), ErrorKind::InvalidArgument);
    assert_eq!(into(1000, usize::MAX).unwrap_err().kind(), ErrorKind::BufferTooSmall);
    into(13 * 9, 13).unwrap();
}

#[test]
fn what_did_not_change_is_not_computed_again() {
    let engine = engine(1 << 20);
    let (mut graph, ids) = graph(&engine, &[("ramp", &[]), ("add", &[(0, 0)]), ("end", &[(1, 0)])]);
    let compute =
        |graph: &Graph| bits(&engine.compute(graph, ids[2], 0, ComputeOptions::default()).unwrap());
    let first = compute(&graph);
    graph.set_float(ids[1], "amount", 0.25).unwrap();
    let second = compute(&graph);
    graph.set_float(ids[1], "amount", 0.0).unwrap();
    assert_eq!(compute(&graph), first);
    assert_ne!(first, second);
    assert_eq!(prepared(), 1);
}

#[test]
fn a_panic_is_an_error_of_its_block() {
    let engine = engine(0);
    let (mut graph, ids) = graph(&engine, &[("bad", &[]), ("add", &[(0, 0)]), ("end", &[(1, 0)])]);
    for amount in [0.0, 1.0, 2.0] {
        graph.set_float(ids[0], "amount", amount).unwrap();
        let error = engine.compute(&graph, ids[2], 0, ComputeOptions::default()).unwrap_err();
        assert_eq!(error.place().handle, Some(ids[0].to_raw()), "{error}");
        assert_eq!(error.place().block_type.as_deref(), Some("bad"));
    }
    let error = engine.compute(&graph, ids[2], 0, ComputeOptions::default()).unwrap_err();
    assert_eq!((error.kind(), error.message()), (ErrorKind::Limit, "too much"));
}

#[test]
fn going_on_puts_white_in_place_of_what_fails() {
    let engine = engine(1 << 20);
    let (mut graph, ids) = graph(&engine, &[("bad", &[]), ("add", &[(0, 0)]), ("end", &[(1, 0)])]);
    graph.set_float(ids[0], "amount", 2.0).unwrap();
    graph.set_float(ids[1], "amount", -0.25).unwrap();
    let mut failures = Vec::new();
    let options =
        ComputeOptions { keep_going: true, failures: Some(&mut failures), ..Default::default() };
    let image = engine.compute(&graph, ids[2], 0, options).unwrap();
    assert!(image.channel(0).iter().all(|value| *value == 0.75));
    assert_eq!(failures.len(), 1);
    assert_eq!(failures[0].message(), "too much");
    assert!(engine.compute(&graph, ids[2], 0, ComputeOptions::default()).is_err());
}

/// Everything that the engine logs from now on.
fn log_of(engine: &Engine) -> Arc<Mutex<Vec<String>>> {
    let told = Arc::new(Mutex::new(Vec::new()));
    let messages = Arc::clone(&told);
    let log = move |_, message: &str| messages.lock().unwrap().push(message.to_owned());
    engine.set_log(Some((LogLevel::Info, Arc::new(log))));
    told
}

#[test]
fn blocks_warn_with_their_place() {
    let engine = engine(0);
    let (graph, ids) = graph(&engine, &[("words", &[])]);
    let told = log_of(&engine);
    engine.compute_value(&graph, ids[0], 0, ComputeOptions::default()).unwrap();
    assert_eq!(*told.lock().unwrap(), ["block 0 (words), parameter \"amount\": is strange"]);
}

#[test]
fn an_empty_text_stands_for_one_that_failed() {
    let engine = engine(0);
    let (mut graph, ids) = graph(&engine, &[("words", &[]), ("l-system", &[])]);
    graph.set_float(ids[0], "amount", 1.0).unwrap();
    // One fails while it computes, the other because its file cannot be read.
    for id in ids {
        assert!(engine.compute_value(&graph, id, 0, ComputeOptions::default()).is_err());
        let options = ComputeOptions { keep_going: true, ..Default::default() };
        let value = engine.compute_value(&graph, id, 0, options).unwrap();
        assert!(matches!(value, Value::Text(text) if text.is_empty()));
    }
}

#[test]
fn strange_numbers_become_black() {
    let engine = engine(0);
    let (mut graph, ids) = graph(&engine, &[("bad", &[])]);
    graph.set_float(ids[0], "amount", 3.0).unwrap();
    let told = log_of(&engine);
    let image = engine.compute(&graph, ids[0], 0, ComputeOptions::default()).unwrap();
    assert!(image.channel(0).iter().all(|value| *value == 0.0));
    let told = told.lock().unwrap();
    assert!(told[0].starts_with("block 0 (bad): gave 117 numbers"), "{told:?}");
}

#[test]
fn outputs_that_a_block_forgets_are_a_defect_of_it() {
    let engine = engine(0);
    let (mut graph, ids) = graph(&engine, &[("words", &[])]);
    let value = engine.compute_value(&graph, ids[0], 0, ComputeOptions::default()).unwrap();
    assert!(matches!(value, Value::Text(text) if &*text == "words"));
    let error = engine.compute(&graph, ids[0], 0, ComputeOptions::default()).unwrap_err();
    assert_eq!(error.kind(), ErrorKind::TypeMismatch);
    graph.set_float(ids[0], "amount", 1.0).unwrap();
    let error = engine.compute_value(&graph, ids[0], 0, ComputeOptions::default()).unwrap_err();
    assert_eq!(error.kind(), ErrorKind::Internal);
}

#[test]
fn a_row_hears_the_request_to_stop_and_is_not_kept() {
    let engine = engine(1 << 20);
    let (graph, ids) = graph(&engine, &[("endless", &[])]);
    // Had anything been kept, the second time would give it.
    for threads in [1, 1, 2, 2] {
        let mut calls = 0;
        let mut stop_soon = |_: &ProgressReport| {
            calls += 1;
            calls < 3
        };
        let options = ComputeOptions {
            threads,
            progress: Some(&mut stop_soon),
            progress_interval: Duration::ZERO,
            ..Default::default()
        };
        let error = engine.compute(&graph, ids[0], 0, options).unwrap_err();
        assert_eq!(error.kind(), ErrorKind::Cancelled);
    }
}

#[test]
fn cancelling_stops_and_progress_is_told_here() {
    let engine = engine(0);
    let (mut graph, ids) = graph(&engine, MIXED);
    graph.set_size(400, 400).unwrap();
    let cancel = Cancel::new();
    cancel.request();
    let options = ComputeOptions { cancel: Some(cancel), ..Default::default() };
    let error = engine.compute(&graph, ids[5], 0, options).unwrap_err();
    assert_eq!(error.kind(), ErrorKind::Cancelled);

    let here = std::thread::current().id();
    let mut reports = Vec::new();
    let mut tell = |report: &super::ProgressReport| {
        assert_eq!(std::thread::current().id(), here);
        reports.push(*report);
        true
    };
    let options = ComputeOptions {
        progress: Some(&mut tell),
        progress_interval: Duration::ZERO,
        ..Default::default()
    };
    engine.compute(&graph, ids[5], 0, options).unwrap();
    assert!(reports.len() > 10);
    assert!(reports.is_sorted_by_key(|report| report.units_done));
    assert_eq!(reports.last().unwrap().fraction(), 1.0);

    let mut count = 0;
    let mut stop = |_: &super::ProgressReport| {
        count += 1;
        count < 3
    };
    let options = ComputeOptions {
        progress: Some(&mut stop),
        progress_interval: Duration::ZERO,
        ..Default::default()
    };
    let error = engine.compute(&graph, ids[5], 0, options).unwrap_err();
    assert_eq!((error.kind(), count), (ErrorKind::Cancelled, 3));
}

#[test]
fn too_much_memory_is_refused_before_anything_is_computed() {
    let engine = engine(0);
    let (graph, ids) = graph(&engine, MIXED);
    // Stored at the peak: the mean, the image that it came from, and the result.
    let options = |bytes| ComputeOptions { memory_bytes: Some(bytes), ..Default::default() };
    let error = engine.compute(&graph, ids[5], 0, options(1000)).unwrap_err();
    assert_eq!(error.kind(), ErrorKind::Limit);
    engine.compute(&graph, ids[5], 0, options(13 * 9 * 4 * 7)).unwrap();
    let options = ComputeOptions { size: Some((60_000, 60_000)), ..Default::default() };
    let error = engine.compute(&graph, ids[5], 0, options).unwrap_err();
    assert!(error.message().contains("MiB"), "{error}");
    let options = ComputeOptions { size: Some((70_000, 1)), ..Default::default() };
    let error = engine.compute(&graph, ids[5], 0, options).unwrap_err();
    assert_eq!(error.kind(), ErrorKind::Limit);
}

#[test]
fn a_long_chain_is_no_recursion() {
    let engine = engine(0);
    let mut graph = engine.new_graph();
    graph.set_size(2, 2).unwrap();
    let mut last = graph.add("ramp").unwrap();
    for _ in 0..2000 {
        let next = graph.add("add").unwrap();
        graph.connect(last, 0, next, 0).unwrap();
        last = next;
    }
    let image = engine.compute(&graph, last, 0, ComputeOptions::default()).unwrap();
    assert_eq!(image.row(0, 0), &[0.0, 0.5]);
}

#[test]
fn all_results_are_computed_together() {
    let engine = engine(0);
    let blocks: &[(&str, &[(usize, u32)])] =
        &[("ramp", &[]), ("add", &[(0, 0)]), ("end", &[(0, 0)]), ("end", &[(1, 0)])];
    let (mut graph, ids) = graph(&engine, blocks);
    for supersampling in [1, 2] {
        graph.set_supersampling(supersampling).unwrap();
        let all = engine.compute_all(&graph, ComputeOptions::default()).unwrap();
        assert_eq!(all.iter().map(|(id, _)| *id).collect::<Vec<_>>(), ids[2..]);
        for (id, image) in &all {
            let alone = engine.compute(&graph, *id, 0, ComputeOptions::default()).unwrap();
            assert_eq!(bits(&alone), bits(image));
        }
    }
    let error = engine.compute_all(&engine.new_graph(), ComputeOptions::default()).unwrap_err();
    assert_eq!(error.kind(), ErrorKind::NotFound);
}
