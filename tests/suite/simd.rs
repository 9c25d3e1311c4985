//! The same bits at every SIMD level and for every number of threads: of every block, and of every
//! example graph, in both precisions.
//!
//! A level is forced by [`EngineOptions::simd`]. There is none below what every CPU of an
//! architecture has: on x86-64, [`SimdLevel::BASELINE`] is SSE2. Scalar code is what a build makes
//! whose compiler does not vectorise: the profile for development is one. The variable
//! `PTLIB_HASHES` names a file that such a build writes, and that a build for release, which is
//! vectorised, is compared with; `cargo xtask test simd` does both.

use std::{collections::BTreeMap, env, fs, path::PathBuf};

use ptlib::{
    BlockId, ComputeOptions, Engine, EngineOptions, Graph, Precision, math::simd::SimdLevel,
    value::Value,
};

use crate::{golden::hash, picture::folder, specimen::Specimen};

const THREADS: [u32; 4] = [1, 2, 3, 8];

/// What is computed.
struct Case {
    name: String,
    graph: Graph,
    block: BlockId,
}

/// An engine for each level of this CPU, slowest first. None has a cache: all is computed.
fn engines() -> Vec<(&'static str, Engine)> {
    let levels = SimdLevel::available().into_iter();
    let engine = |simd| {
        let options = EngineOptions { cache_bytes: 0, threads: 8, simd, ..Default::default() };
        Engine::new(options)
    };
    levels.map(|simd| (simd.name(), engine(simd))).collect()
}

/// Every block of the registry. Neither side is a multiple of the length of a vector.
fn blocks(engine: &Engine) -> Vec<Case> {
    let specimens = engine.registry().blocks().into_iter().map(|spec| {
        let Specimen { graph, block } = Specimen::new(engine, spec, 83, 31);
        Case { name: spec.about.id.to_owned(), graph, block }
    });
    specimens.collect()
}

/// Every example graph, small.
fn examples(engine: &Engine) -> Vec<Case> {
    let files = fs::read_dir(folder("../examples/graphs")).expect("the examples are there");
    let mut paths: Vec<PathBuf> =
        files.map(|entry| entry.expect("the folder can be read").path()).collect();
    paths.retain(|path| path.extension() == Some("xml".as_ref()));
    paths.sort();
    let cases = paths.iter().map(|path| {
        let mut graph = engine.open_graph(path).unwrap_or_else(|error| panic!("{error}")).graph;
        graph.set_size(93, 61).expect("no side is empty");
        let block = graph.main_result().unwrap_or_else(|error| panic!("{error}"));
        let name = path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
        Case { name, graph, block }
    });
    cases.collect()
}

impl Case {
    fn compute(&self, engine: &Engine, precision: Precision, threads: u32) -> Value {
        let precision = Some(precision);
        let options = ComputeOptions { precision, threads, ..Default::default() };
        let value = engine.compute_value(&self.graph, self.block, 0, options);
        value.unwrap_or_else(|error| panic!("{}: {error}", self.name))
    }
}

/// Computes the cases in every way, and compares the hashes.
fn check(set: &str, cases: fn(&Engine) -> Vec<Case>) {
    let engines = engines();
    let cases: Vec<_> = engines.iter().map(|(_, engine)| cases(engine)).collect();
    let mut hashes = BTreeMap::new();
    for (precision, name) in [(Precision::Float, "float"), (Precision::EightBit, "8 bit")] {
        for (number, case) in cases[0].iter().enumerate() {
            let label = format!("{}, {name}", case.name);
            let expected = hash(&case.compute(&engines[0].1, precision, 1));
            for ((level, engine), cases) in engines.iter().zip(&cases) {
                for threads in THREADS {
                    let found = hash(&cases[number].compute(engine, precision, threads));
                    assert!(found == expected, "{label}: other bits at {level}, {threads} threads");
                }
            }
            hashes.insert(label, expected);
        }
    }
    assert!(hashes.len() > 2, "there is nothing to compare");
    compare_builds(set, &hashes);
}

/// Compares hashes with those of the build that ran before, or writes them for the next one.
fn compare_builds(set: &str, hashes: &BTreeMap<String, String>) {
    let Some(path) = env::var_os("PTLIB_HASHES").map(PathBuf::from) else { return };
    // A file for each set: their tests run at the same time.
    let path = path.with_extension(format!("{set}.txt"));
    let found: String = hashes.iter().map(|(label, hash)| format!("{hash} {label}\n")).collect();
    let Ok(other) = fs::read_to_string(&path) else {
        fs::write(&path, found).expect("the folder can be written");
        return;
    };
    let differing = found.lines().zip(other.lines()).find(|(one, other)| one != other);
    assert!(found == other, "{set}: builds differ, first in {differing:?}");
    println!("{set}: the same bits as the build that wrote {}", path.display());
}

#[test]
fn every_block_gives_the_same_bits_at_every_level_and_number_of_threads() {
    check("blocks", blocks);
}

#[test]
fn every_example_gives_the_same_bits_at_every_level_and_number_of_threads() {
    check("examples", examples);
}

#[test]
fn the_levels_of_this_cpu_are_all_tested() {
    let names: Vec<_> = engines().into_iter().map(|(name, _)| name).collect();
    assert_eq!(names[0], "baseline");
    #[cfg(target_arch = "x86_64")]
    {
        assert_eq!(names.contains(&"avx2"), is_x86_feature_detected!("avx2"));
        let has_avx512 = is_x86_feature_detected!("avx512vl")
            && is_x86_feature_detected!("avx512bw")
            && is_x86_feature_detected!("avx512dq");
        assert_eq!(names.contains(&"avx512"), has_avx512);
    }
}
