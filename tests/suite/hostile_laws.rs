//! The law that no parameters and no inputs bring a block down: whatever they are, a computation
//! ends as a value in range, or as an error that names the reason, and it can be stopped.
//!
//! Time is not measured. What takes long is cancelled, and must then end.

use std::{
    fs,
    io::Write as _,
    path::PathBuf,
    sync::{
        Arc, Mutex,
        mpsc::{self, RecvTimeoutError},
    },
    time::{Duration, Instant},
};

use ptlib::{
    BlockId, Cancel, ComputeOptions, Engine, EngineOptions, Error, ErrorKind, Graph, Limits,
    Precision,
    block::BlockSpec,
    params::{FileUse, ParamKind, ParamSpec, ParamValue},
    run::LogLevel,
    value::{Kind, Value},
};

use crate::{
    laws::{Random, check_output, random_value},
    specimen::Specimen,
};

/// Combinations of parameters and inputs for each block.
const ROUNDS: usize = 120;
const SIZES: [(u32, u32); 6] = [(1, 1), (1, 37), (37, 1), (2, 3), (31, 29), (64, 64)];
/// How long a computation may take before it is cancelled: extremes may ask for hours.
const PATIENCE: Duration = Duration::from_millis(40);
/// How long after that the suite takes it for hanging, and ends with a message instead of never.
const HANGS: Duration = Duration::from_secs(120);

/// Axioms and rules that ask for much, or make no sense.
const GRAMMARS: [&str; 8] = [
    "",
    "t\n\nt -> W(999999999)B(1000)DL(7)D[S(5,0)D]",
    "B(1e300)M(-1e300)I(nan)DDDL(1e99)DR(-1e99)D",
    "M(2147483647)S(3,1)DI(2147483647)DS(4,999999)F(2147483647)DGDP(99999999)D",
    "a\n\na -> aa",
    "a(1)\n\na(x) -> [W(0 - 5)B(x)S(x,x / 0)Da(x * 99999)a(0 - x)]",
    "]]]]]][[[[[[D((((((()\n\n -> \n->->",
    "B(700)W(3)S(1,0)DL(100)S(2,0)DL(100)S(3,0)DL(100)S(4,0)DL(100)S(5,0)DT(1,3)DT(5,-9)D",
];

/// One combination: the block with its inputs, where choices come from, and what they were.
struct Trial<'a> {
    random: &'a mut Random,
    specimen: Specimen,
    what: String,
}

fn pick<'a, T>(random: &mut Random, from: &'a [T]) -> &'a T {
    &from[usize::try_from(random.next() % from.len() as u64).expect("few")]
}

fn grammar_folder() -> PathBuf {
    PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join("hostile grammars")
}

/// Files of [`GRAMMARS`], and their names.
fn write_grammars() -> Vec<String> {
    let folder = grammar_folder();
    fs::create_dir_all(&folder).expect("the target folder can be written");
    let mut paths = Vec::new();
    for (i, grammar) in GRAMMARS.iter().enumerate() {
        let path = folder.join(format!("{i}.txt"));
        fs::write(&path, grammar).expect("the target folder can be written");
        paths.push(path.to_str().expect("a path of the build is a text").to_owned());
    }
    paths
}

/// A text that somebody might want to break a block with.
fn hostile_text(random: &mut Random) -> String {
    const PIECES: &str = "0123456789 .,;:-+eE\n\t()[]xnai∞";
    let pieces: Vec<_> = PIECES.chars().collect();
    match random.next() % 10 {
        0 => String::new(),
        1 => ",;: \n".repeat(5000),
        2 => "9".repeat(5000),
        3 => "0.5:0.5,".repeat(2000),
        4 => "-1e308 1e308 2147483648 -2147483649 18446744073709551616 nan inf 1e-320".to_owned(),
        5 => "٣ ½ 𝟘 \u{202e}é\u{0}\u{1b}\u{feff}ﬁ ,𝟙:𝟚;".repeat(50),
        6 => (0..3000).map(|_| format!("{} ", random.next())).collect(),
        7 => (0..400).map(|_| format!("{:.3} ", random.unit() - 0.4)).collect(),
        8 => (0..300).map(|_| format!("{}, ", random.next() % 300)).collect(),
        _ => (0..500).map(|_| *pick(random, &pieces)).collect(),
    }
}

/// A number of the hard range: one of its ends, or one whose distance from 0 may have any
/// magnitude, for evenly drawn ones are all huge where the range is wide.
fn hard_number(random: &mut Random, min: f64, max: f64) -> f64 {
    match random.next() % 4 {
        0 => min,
        1 => max,
        _ => {
            let sign = if random.next() & 1 == 1 { 1.0 } else { -1.0 };
            let largest = min.abs().max(max.abs());
            let magnitude = f64::from(1_u32 << (random.next() % 32));
            let value = sign * largest * random.unit() / magnitude;
            if (min..=max).contains(&value) { value } else { (-value).clamp(min, max) }
        }
    }
}

fn hostile_value(param: &ParamSpec, grammars: &[String], random: &mut Random) -> ParamValue {
    let soft = random.next() & 1 == 0;
    match param.kind {
        ParamKind::Int { hard, .. } if !soft => {
            let value = hard_number(random, f64::from(hard.min), f64::from(hard.max));
            #[expect(clippy::cast_possible_truncation, reason = "inside the range of an i32")]
            ParamValue::Int(value as i32)
        }
        ParamKind::Float { hard, .. } if !soft => {
            ParamValue::Float(hard_number(random, hard.min, hard.max))
        }
        ParamKind::Text => ParamValue::Text(hostile_text(random).into()),
        ParamKind::Path(FileUse::Read) => {
            let known = ["in/colour.png", "in/tree.txt", "in/stochastic.txt", "../none", ""];
            let path = match random.next() % 8 {
                0..5 => pick(random, grammars).clone(),
                5 | 6 => (*pick(random, &known)).to_owned(),
                _ => hostile_text(random),
            };
            ParamValue::Text(path.into())
        }
        // Nothing is written here.
        ParamKind::Path(FileUse::Write) => ParamValue::Text("".into()),
        _ => random_value(param, random).expect("neither a text nor a path"),
    }
}

impl Trial<'_> {
    fn graph(&mut self) -> &mut Graph {
        &mut self.specimen.graph
    }

    fn set(&mut self, block: BlockId, id: &str, value: ParamValue) {
        // Long texts would bury everything else.
        let mut told = format!("{value:?}");
        if let Some((end, _)) = told.char_indices().nth(160) {
            told.truncate(end);
        }
        self.what += &format!(", {id} = {told}");
        let what = self.what.clone();
        self.graph().set(block, id, value).expect(&what);
    }

    fn set_all(&mut self, block: BlockId, grammars: &[String]) {
        let spec = self.graph().block(block).expect("it is there").spec().expect("it is known");
        for param in spec.params {
            let value = hostile_value(param, grammars, self.random);
            self.set(block, param.id, value);
        }
    }

    /// Something else at some of the inputs: flat or raw pictures of one and of three planes, the
    /// worst texts, or nothing.
    fn disturb_inputs(&mut self, spec: &BlockSpec, grammars: &[String]) {
        for (port, input) in (0..).zip(spec.about.inputs) {
            let (block, choice) = (self.specimen.block, self.random.next() % 16);
            self.what += &format!(", input {port}: {choice}");
            let source = match (input.kind, choice) {
                (_, 0) => None,
                (_, 1..5) if input.is_optional => None,
                (Kind::Image, 1..8) => Some("color fill"),
                (Kind::Image, 8..11) => Some("simple noise"),
                (Kind::Gradient, _) => Some("color transition"),
                (Kind::Text, _) => Some("l-system"),
                _ => continue,
            };
            let Some(source) = source else {
                self.graph().disconnect(block, port).expect("it is declared");
                continue;
            };
            let source = self.graph().add(source).expect("built in");
            self.set_all(source, grammars);
            self.graph().connect(source, 0, block, port).expect("the kinds agree");
        }
    }
}

/// Computes, and asks it to stop when it has taken long. Returns the outcome, and how long it went
/// on after it was asked.
fn compute(engine: &Engine, trial: &Trial<'_>) -> (Result<Value, Error>, Option<Duration>) {
    let (cancel, is_asked) = (Cancel::new(), Mutex::new(None));
    let (done, is_done) = mpsc::channel::<()>();
    let (request, asked, what) = (cancel.clone(), &is_asked, &trial.what);
    let watch = move || {
        if is_done.recv_timeout(PATIENCE) != Err(RecvTimeoutError::Timeout) {
            return;
        }
        *asked.lock().expect("nobody panics") = Some(Instant::now());
        request.request();
        if is_done.recv_timeout(HANGS) == Err(RecvTimeoutError::Timeout) {
            // A panic would wait for the computation.
            writeln!(std::io::stderr(), "cannot be cancelled: {what}").ok();
            std::process::abort();
        }
    };
    std::thread::scope(|scope| {
        let watcher = std::thread::Builder::new().spawn_scoped(scope, watch).expect("a thread");
        let options = ComputeOptions { cancel: Some(cancel), ..Default::default() };
        let Specimen { graph, block } = &trial.specimen;
        let outcome = engine.compute_value(graph, *block, 0, options);
        let ended = Instant::now();
        drop(done);
        watcher.join().expect("it does not panic");
        let asked = *is_asked.lock().expect("nobody panics");
        (outcome, asked.map(|asked| ended.saturating_duration_since(asked)))
    })
}

/// Whether an error says what the caller could change.
fn names_a_reason(error: &Error, was_cancelled: bool) -> bool {
    match error.kind() {
        ErrorKind::Cancelled => was_cancelled,
        ErrorKind::InvalidArgument => error.hint().is_some(),
        ErrorKind::Unconnected
        | ErrorKind::OutOfRange
        | ErrorKind::Parse
        | ErrorKind::Io
        | ErrorKind::Denied
        | ErrorKind::Unsupported
        | ErrorKind::Limit => error.place().block.is_some(),
        _ => false,
    }
}

/// An engine that a few small pictures cannot make take much memory, and that notes what its
/// blocks did wrong although the engine mended it.
fn strict_engine(faults: &Arc<Mutex<Vec<String>>>) -> Engine {
    let engine = Engine::new(EngineOptions {
        threads: 4,
        cache_bytes: 0,
        limits: Limits { memory_bytes: 256 << 20, text_symbols: 1 << 20, ..Limits::default() },
        read_folders: vec![grammar_folder()],
        ..EngineOptions::default()
    });
    let faults = Arc::clone(faults);
    let note = move |_: LogLevel, message: &str| {
        if message.contains("not finite") {
            faults.lock().expect("nobody panics").push(message.to_owned());
        }
    };
    engine.set_log(Some((LogLevel::Warning, Arc::new(note))));
    engine
}

#[test]
fn nothing_brings_a_block_down() {
    let grammars = write_grammars();
    let logged = Arc::new(Mutex::new(Vec::new()));
    let engine = strict_engine(&logged);
    let mut random = Random(0x1b87_3593_cc9e_2d51);
    let (mut faults, mut slowest) = (Vec::new(), (Duration::ZERO, String::new()));
    let mut counts = [0; 3];
    for spec in engine.registry().blocks() {
        for round in 0..ROUNDS {
            let trial = trial(&engine, spec, round, &grammars, &mut random);
            let (outcome, waited) = compute(&engine, &trial);
            if let Some(waited) = waited
                && waited > slowest.0
            {
                slowest = (waited, trial.what.clone());
            }
            match outcome {
                Ok(value) => {
                    counts[0] += 1;
                    check_output(spec, &value, &trial.what);
                }
                Err(error) if names_a_reason(&error, waited.is_some()) => {
                    counts[if error.kind() == ErrorKind::Cancelled { 2 } else { 1 }] += 1;
                }
                Err(error) => faults.push(format!("{}: {:?}, {error}", trial.what, error.kind())),
            }
            let logged = std::mem::take(&mut *logged.lock().expect("nobody panics"));
            faults.extend(logged.iter().map(|message| format!("{}: {message}", trial.what)));
        }
    }
    let [values, errors, cancelled] = counts;
    println!("{values} values, {errors} errors, {cancelled} cancelled");
    println!("longest after it was cancelled: {:?}, {}", slowest.0, slowest.1);
    assert!(faults.is_empty(), "{} faults:\n{}", faults.len(), faults.join("\n"));
}

fn trial<'a>(
    engine: &Engine,
    spec: &'static BlockSpec,
    round: usize,
    grammars: &[String],
    random: &'a mut Random,
) -> Trial<'a> {
    let &(width, height) = pick(random, &SIZES);
    let precision = [Precision::Float, Precision::EightBit][round % 2];
    let specimen = Specimen::new(engine, spec, width, height).precision(precision);
    let what = format!("{}, {width} × {height}, {precision:?}", spec.about.id);
    let supersampling = 1 + u32::from(random.next().is_multiple_of(4));
    let mut trial = Trial { random, specimen, what };
    trial.graph().set_supersampling(supersampling).expect("it is a usual one");
    trial.disturb_inputs(spec, grammars);
    let block = trial.specimen.block;
    trial.set_all(block, grammars);
    trial
}
