//! Graph files of PT Designer and the pictures that they must give.
//!
//! `tests/conformance/` has one graph a case with its picture beside it, made for this project.
//! Textures that others made with PT Designer lie outside of the repository and are compared where
//! that folder exists.

use std::path::{Path, PathBuf};

use ptlib::{ComputeOptions, Engine, EngineOptions};

use crate::picture::{Levels, folder};

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
    for path in cases {
        if let Err(fault) = compare_one(&engine, path, tolerance) {
            faults.push(format!("{}: {fault}", path.display()));
        }
    }
    assert!(faults.is_empty(), "{} of {}:\n{}", faults.len(), cases.len(), faults.join("\n"));
}

/// Compares one case.
fn compare_one(engine: &Engine, path: &Path, tolerance: &Tolerance) -> Result<(), String> {
    let graph = engine.open_graph(path).map_err(|error| error.to_string())?.graph;
    let result = graph.main_result().map_err(|error| error.to_string())?;
    let image = engine
        .compute(&graph, result, 0, ComputeOptions::default())
        .map_err(|error| error.to_string())?;
    let expected = Levels::read(&path.with_extension("png"));
    let found = Levels::of(&image);
    let difference = found.difference(&expected, tolerance.step);
    let name = path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
    println!("{name}: off by {:.4} levels in the mean", difference.mean);
    if difference.mean <= tolerance.mean && difference.far <= tolerance.far {
        return Ok(());
    }
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
