//! Whole processes: from their start to their end, as somebody at a command line sees them.

use std::{
    fs,
    path::{Path, PathBuf},
    process::Command,
    time::Instant,
};

use ptlib::{ComputeOptions, Engine, EngineOptions, Precision, io};

use crate::{
    Result,
    measure::Times,
    work::{Settings, Work, precision_name},
};

/// The first argument of a process that computes instead of measuring.
pub(crate) const CHILD: &str = "--compute-once";

/// The times of whole processes, and the most memory that one of them had, in MiB, where the
/// system tells it.
pub(crate) fn measure(graph: &Path, work: &Work, runs: usize) -> Result<(Times, Option<f64>)> {
    let mut peak: Option<f64> = None;
    let Settings { size, threads, precision, supersampling, .. } = work.settings;
    let supersampling = supersampling.unwrap_or(work.graph().settings().supersampling);
    let picture = std::env::temp_dir().join(format!("ptlib-bench-{}.png", std::process::id()));
    let times = Times::of(runs, || {
        let mut child = Command::new(std::env::current_exe()?);
        child.arg(CHILD).arg(graph).arg(&picture);
        child.args([size.0, size.1, supersampling, threads].map(|number| number.to_string()));
        child.arg(precision_name(precision));
        let start = Instant::now();
        let output = child.output()?;
        let time = start.elapsed();
        if !output.status.success() {
            return Err(String::from_utf8_lossy(&output.stderr).into());
        }
        let told = String::from_utf8_lossy(&output.stdout).trim().parse().ok();
        peak = peak.into_iter().chain(told).reduce(f64::max);
        Ok(time)
    })?;
    fs::remove_file(picture)?;
    Ok((times, peak))
}

/// Computes the result of a graph file, saves it, and tells how much memory that took.
pub(crate) fn child(arguments: &[String]) -> Result {
    let [graph, picture, numbers @ .., precision] = arguments else {
        return Err("graph, picture, numbers, precision".into());
    };
    let numbers: Vec<u32> =
        numbers.iter().map(|number| Ok(number.parse::<u32>()?)).collect::<Result<_>>()?;
    let [width, height, supersampling, threads] = numbers[..] else {
        return Err("width, height, supersampling, threads".into());
    };
    let is_float = precision == precision_name(Precision::Float);
    let precision = if is_float { Precision::Float } else { Precision::EightBit };
    let engine = Engine::new(EngineOptions { threads, cache_bytes: 0, ..Default::default() });
    let graph = engine.open_graph(&PathBuf::from(graph))?.graph;
    let options = ComputeOptions {
        size: Some((width, height)),
        supersampling: Some(supersampling),
        precision: Some(precision),
        ..ComputeOptions::default()
    };
    let image = engine.compute(&graph, graph.main_result()?, 0, options)?;
    io::save_image(&image, Path::new(picture), io::BitDepth::Eight)?;
    if let Some(peak) = peak_mib() {
        println!("{peak}");
    }
    Ok(())
}

/// The most memory that this process had, in MiB; `None` where the system does not tell.
fn peak_mib() -> Option<f64> {
    let status = fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find_map(|line| line.strip_prefix("VmHWM:"))?;
    let kib: f64 = line.trim().strip_suffix("kB")?.trim().parse().ok()?;
    Some(kib / 1024.0)
}
