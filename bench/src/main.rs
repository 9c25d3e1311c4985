//! How fast ptlib is: `cargo run --release -p ptlib-bench -- [FILTER…]`.
//!
//! There are two kinds of rows. *Definitions* (`bench/defs/*.toml`) are work that somebody cares
//! about, with the hash of the result: a wrong answer is no result. *Catalogue* rows come from
//! the registry, one block at its defaults each, so that no block goes unmeasured.
//!
//! Some definitions have *peers*: what other crates take for the same work. `--peers` measures
//! them by turns with ours, in the same process on as many threads, and tells the ratio.
//!
//! A row is run several times in one process after one run that does not count; what is shown is
//! the median and the spread of the middle half. Bias: the machine's other work is in the numbers,
//! memory is warm, and inputs are there already, as in an editor but not as in a first call; the
//! rows marked `process` measure that.
#![expect(clippy::print_stdout, clippy::print_stderr, reason = "a command line program")]

mod cancel;
mod card;
mod catalogue;
mod change;
mod definition;
mod given;
mod measure;
mod options;
mod peers;
mod plugin;
mod process;
mod record;
mod report;
mod series;
mod work;

use std::process::ExitCode;

use ptlib::Cancel;

use crate::{
    definition::Definition,
    options::{Mode, Options},
    report::{PeerRow, Row},
};

/// What a part gives: its failure is a message for the person who ran it.
type Result<T = ()> = std::result::Result<T, Box<dyn std::error::Error>>;

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let done = match arguments.split_first() {
        Some((first, rest)) if first == process::CHILD => process::child(rest).map(|()| true),
        _ => Options::read(&arguments).and_then(|options| run(&options)),
    };
    let written = work::written();
    if written.is_dir()
        && let Err(error) = std::fs::remove_dir_all(&written)
    {
        eprintln!("{}: {error}", written.display());
    }
    match done {
        Ok(true) => ExitCode::SUCCESS,
        Ok(false) => ExitCode::FAILURE,
        Err(error) => {
            eprintln!("{error}");
            ExitCode::FAILURE
        }
    }
}

/// Runs the rows that the options ask for; `false` if a result was wrong.
fn run(options: &Options) -> Result<bool> {
    let definitions = definition::all(&options.filters)?;
    match options.mode {
        Mode::Check => check(&definitions, options),
        Mode::Bless => bless(&definitions, options),
        Mode::Cancel => cancel::measure(&options.filters),
        Mode::Measure => measure(&definitions, options),
        Mode::Peers => measure_peers(&definitions, options),
    }
}

/// Definitions without those that differ from the one before in the number of threads, or in how
/// they are measured, only.
fn of_different_pictures(definitions: &[Definition]) -> impl Iterator<Item = &Definition> {
    let mut before = None;
    definitions.iter().filter(move |definition| {
        let picture = definition.place.map(|place| (&definition.example, place));
        let is_new = picture.is_none() || picture != before;
        before = picture;
        is_new
    })
}

/// Computes everything once, at full size where a hash is known.
fn check(definitions: &[Definition], options: &Options) -> Result<bool> {
    let mut is_right = true;
    for definition in of_different_pictures(definitions) {
        let name = &definition.name;
        if let Some(reason) = definition.missing(options) {
            println!("skipped {name}: {reason}");
            continue;
        }
        let hash = definition.hash_now(options).map_err(|error| error.to_string());
        match hash.and_then(|hash| definition.verdict(&hash)) {
            Ok(()) => println!("right   {name}"),
            Err(message) => {
                is_right = false;
                println!("WRONG   {name}: {message}");
            }
        }
    }
    for entry in catalogue::entries((64, 64), &options.filters)? {
        if let Err(error) = entry.work.run_until(Cancel::new()) {
            is_right = false;
            println!("FAILED  {}: {error}", entry.name);
        }
    }
    Ok(is_right)
}

/// Writes the hashes of the results into the definitions.
fn bless(definitions: &[Definition], options: &Options) -> Result<bool> {
    let known = of_different_pictures(definitions).filter(|it| it.missing(options).is_none());
    for definition in known {
        let hash = definition.hash_now(options)?;
        if definition.verdict(&hash).is_err() {
            definition.write_hash(&hash)?;
            println!("{}: {hash}", definition.name);
        }
    }
    Ok(true)
}

fn measure(definitions: &[Definition], options: &Options) -> Result<bool> {
    let mut is_right = true;
    let mut rows: Vec<Row> = Vec::new();
    println!("{}", report::HEADING);
    let mut add = |row: Row| {
        println!("{row}");
        rows.push(row);
    };
    for definition in definitions {
        if let Some(reason) = definition.missing(options) {
            println!("{:<34} skipped: {reason}", definition.name);
            continue;
        }
        let (row, hash) = definition.measure(options)?;
        match definition.verdict(&hash) {
            Ok(()) => add(row),
            Err(message) => {
                is_right = false;
                println!("{:<34} WRONG: {message}", definition.name);
            }
        }
    }
    for size in [1024, 2048] {
        for entry in catalogue::entries((size, size), &options.filters)? {
            add(entry.measure(options.runs)?);
        }
    }
    if options.records {
        println!("{}", record::write(&rows, &[])?.display());
    }
    Ok(is_right)
}

fn measure_peers(definitions: &[Definition], options: &Options) -> Result<bool> {
    let mut is_right = true;
    let mut rows: Vec<PeerRow> = Vec::new();
    println!("{}", report::PEER_HEADING);
    for definition in definitions.iter().filter(|definition| !definition.peers.is_empty()) {
        let (new, hash) = definition.measure_peers(options)?;
        match definition.verdict(&hash) {
            Ok(()) => {
                new.iter().for_each(|row| println!("{row}"));
                rows.extend(new);
            }
            Err(message) => {
                is_right = false;
                println!("{:<34} WRONG: {message}", definition.name);
            }
        }
    }
    if rows.is_empty() && is_right {
        return Err("no row of that name has peers".into());
    }
    if options.records {
        println!("{}", record::write(&[], &rows)?.display());
    }
    Ok(is_right)
}
