//! Golden pictures: every block at its defaults, 64 × 64, in both precisions.
//!
//! `tests/golden/NAME.png` is for people; `tests/golden/hashes.txt` has the hash of the bits of the
//! `f32` planes, which must never change. `PTLIB_BLESS=1` rewrites both: look at the pictures
//! before you commit them.

use std::{collections::BTreeMap, fs, path::PathBuf};

use ptlib::{ComputeOptions, Engine, Image, Precision, block::BlockSpec, value::Value};

use crate::{
    picture::{Levels, folder},
    specimen::{Specimen, engine},
};

#[test]
fn every_block_gives_the_golden_bits() {
    let engine = engine();
    let golden = read_hashes();
    let bless = std::env::var_os("PTLIB_BLESS").is_some();
    let mut found = BTreeMap::new();
    let mut faults = Vec::new();
    for spec in engine.registry().blocks() {
        for (precision, name) in [(Precision::Float, "float"), (Precision::EightBit, "8 bit")] {
            let label = format!("{}, {name}", spec.about.id);
            let value = compute(&engine, spec, precision);
            let hash = hash(&value);
            if let Value::Image(image) = &value
                && precision == Precision::Float
            {
                faults.extend(check_picture(spec, image, bless));
            }
            match golden.get(&label) {
                Some(golden) if *golden == hash => {}
                Some(_) => faults.push(format!("{label}: other bits")),
                None => faults.push(format!("{label}: no golden hash")),
            }
            found.insert(label, hash);
        }
    }
    if bless {
        let lines: Vec<_> = found.iter().map(|(label, hash)| format!("{hash} {label}")).collect();
        fs::write(hashes(), lines.join("\n") + "\n").expect("the repository can be written");
    } else {
        assert!(faults.is_empty(), "{} faults:\n{}", faults.len(), faults.join("\n"));
        assert_eq!(found.len(), golden.len(), "hashes of blocks that are gone");
    }
}

fn compute(engine: &Engine, spec: &'static BlockSpec, precision: Precision) -> Value {
    let Specimen { graph, block } = Specimen::new(engine, spec, 64, 64).precision(precision);
    engine
        .compute_value(&graph, block, 0, ComputeOptions::default())
        .unwrap_or_else(|error| panic!("{error}"))
}

/// Compares (or rewrites) the picture for people. Returns what is wrong.
fn check_picture(spec: &BlockSpec, image: &Image, bless: bool) -> Option<String> {
    let path = folder("golden").join(format!("{}.png", spec.about.id));
    let found = Levels::of(image);
    if bless {
        fs::create_dir_all(folder("golden")).expect("the repository can be written");
        fs::copy(found.write(spec.about.id), &path).expect("the repository can be written");
        return None;
    }
    if !path.exists() {
        return Some(format!("{}: no golden picture", spec.about.id));
    }
    let golden = Levels::read(&path);
    if golden.samples == found.samples {
        return None;
    }
    let written = found.write(&format!("{}-found", spec.about.id));
    found.contrast(&golden).write(&format!("{}-difference", spec.about.id));
    Some(format!("{}: another picture, see {}", spec.about.id, written.display()))
}

/// The hash of a value's bits.
pub(crate) fn hash(value: &Value) -> String {
    let mut hasher = blake3::Hasher::new();
    match value {
        Value::Image(image) => {
            for channel in 0..image.planes() {
                for number in image.channel(channel) {
                    hasher.update(&number.to_bits().to_le_bytes());
                }
            }
        }
        Value::Gradient(gradient) => {
            for stop in gradient.stops() {
                for number in std::iter::once(stop.position).chain(stop.color) {
                    hasher.update(&number.to_bits().to_le_bytes());
                }
            }
        }
        Value::Text(text) => {
            hasher.update(text.as_bytes());
        }
        other => {
            hasher.update(other.content().as_bytes());
        }
    }
    hasher.finalize().to_hex()[..32].to_owned()
}

fn hashes() -> PathBuf {
    folder("golden/hashes.txt")
}

fn read_hashes() -> BTreeMap<String, String> {
    let text = fs::read_to_string(hashes()).unwrap_or_default();
    let pair = |line: &str| line.split_once(' ').map(|(hash, label)| (label.into(), hash.into()));
    text.lines().filter_map(pair).collect()
}
