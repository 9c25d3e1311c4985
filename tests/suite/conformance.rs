//! Graph files of PT Designer and the pictures that they must give.
//!
//! `tests/conformance/` has one graph a case with its picture beside it, made for this project.
//! Textures that others made with PT Designer lie outside of the repository and are compared where
//! that folder exists.

use std::{
    collections::BTreeSet,
    path::{Path, PathBuf},
};

use ptlib::{ComputeOptions, Engine, EngineOptions};

use crate::picture::{Levels, folder};

/// Block types of PT Designer that are not there yet. A case that needs one is pending.
const PENDING: &[&str] = &[
    "adjust hsl",
    "adjust rgb",
    "cellular automaton cyclic",
    "cellular automaton general",
    "cellular automaton rps",
    "convolution",
    "dither",
    "edge detection",
    "emboss",
    "fault formation noise",
    "geometric transform",
    "grayscale",
    "marble",
    "mix channels",
    "radius transform",
    "replace colors",
    "sharpen",
    "sine transform",
    "square mosaic",
    "substrate",
    "wood",
];

/// How near a picture must be.
struct Tolerance {
    /// Mean absolute difference in levels.
    mean: f64,
    /// Samples may be this many levels away …
    step: u8,
    /// … except for this share of them.
    far: f64,
}

#[test]
fn block_cases_are_faithful() {
    let tolerance = Tolerance { mean: 1.0, step: 3, far: 0.01 };
    let cases = graphs(&folder("conformance"));
    assert!(cases.len() >= 103, "only {} cases are left", cases.len());
    compare(&cases, &tolerance);
}

#[test]
fn published_textures_are_faithful() {
    let textures = folder("../../shared/conformance/textures");
    if !textures.is_dir() {
        println!("skipped: there are no published textures beside the repository");
        return;
    }
    compare(&graphs(&textures), &Tolerance { mean: 2.0, step: 8, far: 0.03 });
}

#[test]
fn no_block_is_pending_that_is_there() {
    let engine = Engine::new(EngineOptions::default());
    for id in PENDING {
        assert!(engine.registry().find(id).is_none(), "\"{id}\" is there: it is pending no more");
    }
}

fn graphs(folder: &Path) -> Vec<PathBuf> {
    let entries = std::fs::read_dir(folder).unwrap_or_else(|e| panic!("{}: {e}", folder.display()));
    let paths = entries.map(|entry| entry.expect("the folder can be read").path());
    let mut graphs: Vec<_> =
        paths.filter(|path| path.extension() == Some("xml".as_ref())).collect();
    graphs.sort();
    graphs
}

fn compare(cases: &[PathBuf], tolerance: &Tolerance) {
    let engine = Engine::new(EngineOptions::default());
    let mut faults = Vec::new();
    let mut pending = Vec::new();
    for path in cases {
        let name = path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
        match compare_one(&engine, path, tolerance) {
            Ok(missing) if missing.is_empty() => {}
            Ok(missing) => pending.push(format!("{name} ({})", missing.join(", "))),
            Err(fault) => faults.push(format!("{name}: {fault}")),
        }
    }
    println!("{} faithful", cases.len() - pending.len() - faults.len());
    println!("{} pending: {}", pending.len(), pending.join("; "));
    assert!(faults.is_empty(), "{} of {}:\n{}", faults.len(), cases.len(), faults.join("\n"));
}

/// Compares one case. Returns the pending block types that it needs.
fn compare_one(engine: &Engine, path: &Path, tolerance: &Tolerance) -> Result<Vec<String>, String> {
    let graph = engine.open_graph(path).map_err(|error| error.to_string())?.graph;
    let unknown: BTreeSet<String> = graph
        .blocks()
        .filter(|(_, block)| block.spec().is_none())
        .map(|(_, block)| block.type_id().to_owned())
        .collect();
    if let Some(stranger) = unknown.iter().find(|id| !PENDING.contains(&id.as_str())) {
        return Err(format!("there is no block type \"{stranger}\""));
    }
    if !unknown.is_empty() {
        return Ok(unknown.into_iter().collect());
    }
    let result = graph.main_result().map_err(|error| error.to_string())?;
    let image = engine
        .compute(&graph, result, 0, ComputeOptions::default())
        .map_err(|error| error.to_string())?;
    let expected = Levels::read(&path.with_extension("png"));
    let found = Levels::of(&image);
    let difference = found.difference(&expected, tolerance.step);
    if difference.mean <= tolerance.mean && difference.far <= tolerance.far {
        return Ok(Vec::new());
    }
    let name = path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
    let written = found.write(&format!("{name}-found"));
    found.contrast(&expected).write(&format!("{name}-difference"));
    Err(format!(
        "off by {:.2} levels in the mean, {:.2} % by more than {}; see {}",
        difference.mean,
        difference.far * 100.0,
        tolerance.step,
        written.display()
    ))
}
