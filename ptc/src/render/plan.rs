//! What a batch will render, and under which names.

use std::{
    collections::HashMap,
    path::{Path, PathBuf},
    time::{Duration, Instant},
};

use ptlib::{BlockId, Engine, Error, ErrorKind, Graph, Reading, io::read_value};

use super::{RenderArguments, arguments::InputFile};
use crate::{
    exit::Fault,
    finding::{Finding, Severity, findings},
    output,
    pattern::Picture,
    plugins::PluginLoader,
    terminal,
};

/// What a batch will render.
pub(super) struct Plan<'a> {
    pub(super) jobs: Vec<Job<'a>>,
    /// How many graphs cannot be rendered.
    pub(super) failed: usize,
}

/// A graph and its pictures.
pub(super) struct Job<'a> {
    pub(super) path: &'a Path,
    pub(super) graph: Graph,
    pub(super) targets: Vec<Target>,
    /// How long reading the graph took.
    pub(super) reading: Duration,
}

/// A picture.
pub(super) struct Target {
    pub(super) block: BlockId,
    pub(super) path: PathBuf,
}

/// Reads all graphs and names their pictures. What is wrong with a graph is shown at once.
pub(super) fn plan<'a>(
    arguments: &'a RenderArguments,
    engine: &Engine,
    mut plugins: PluginLoader<'_>,
) -> Result<Plan<'a>, Fault> {
    let mut plan = Plan { jobs: vec![], failed: 0 };
    for path in &arguments.graphs {
        let (job, findings) = job(arguments, engine, &mut plugins, path);
        let fails = findings.iter().any(|finding| finding.severity == Severity::Error);
        show(&findings, path, arguments);
        plan.failed += usize::from(fails);
        plan.jobs.extend(job.filter(|_| !fails));
    }
    refuse_unknown_formats(&plan)?;
    refuse_collisions(&plan)?;
    Ok(plan)
}

/// What is to be done with a graph file, and what is wrong with it.
fn job<'a>(
    arguments: &RenderArguments,
    engine: &Engine,
    plugins: &mut PluginLoader<'_>,
    path: &'a Path,
) -> (Option<Job<'a>>, Vec<Finding>) {
    let started = Instant::now();
    let Reading { mut graph, warnings } = match plugins.open_graph(path) {
        Ok(reading) => reading,
        Err(error) => return (None, findings(&[], &[error])),
    };
    let reading = started.elapsed();
    let faults: Vec<_> =
        arguments.inputs.iter().filter_map(|input| give(engine, &mut graph, input).err()).collect();
    if !faults.is_empty() {
        return (None, findings(&warnings, &faults));
    }
    match targets(arguments, path, &graph) {
        Ok(targets) => {
            let job = Job { path, graph, targets, reading };
            let mut findings = findings(&warnings, &faults_of(&job, arguments));
            plugins.explain(&job.graph, &mut findings);
            (Some(job), findings)
        }
        Err(error) => (None, findings(&warnings, &[error])),
    }
}

/// Sets an input of a graph.
fn give(engine: &Engine, graph: &mut Graph, input: &InputFile) -> Result<(), Error> {
    let block = graph.find_input(&input.name).ok_or_else(|| no_input(graph, &input.name))?;
    let kind = graph.known(block)?.about.outputs[0].kind;
    let value = read_value(&input.path, kind, engine.limits())?;
    graph.set_input(block, Some(value))
}

fn no_input(graph: &Graph, name: &str) -> Error {
    let message = format!("the graph has no input \"{name}\"");
    let names: Vec<_> = graph.inputs().map(|(_, name)| format!("\"{name}\"")).collect();
    let error = Error::new(ErrorKind::NotFound, message);
    match names.is_empty() {
        true => error.with_hint("it has none"),
        false => error.with_hint(format!("its inputs are {}", names.join(", "))),
    }
}

/// What is wrong with the blocks that will be computed, so far as the graph alone tells.
fn faults_of(job: &Job<'_>, arguments: &RenderArguments) -> Vec<Error> {
    if arguments.goes_on() {
        return vec![];
    }
    let mut wanted: Vec<_> = job.targets.iter().map(|target| target.block).collect();
    if arguments.runs_writers() {
        wanted.extend(job.graph.results().chain(job.graph.writers()));
    }
    wanted.into_iter().filter_map(|block| job.graph.validate(block).err()).collect()
}

fn show(findings: &[Finding], path: &Path, arguments: &RenderArguments) {
    for finding in findings {
        let line = finding.line_of(path);
        match finding.severity {
            Severity::Error => terminal::error(&line),
            Severity::Warning if arguments.quiet => {}
            Severity::Warning => terminal::warning(&line),
        }
    }
}

fn targets(arguments: &RenderArguments, path: &Path, graph: &Graph) -> Result<Vec<Target>, Error> {
    let Some(pattern) = &arguments.output else { return Ok(vec![]) };
    let wanted = wanted(arguments, graph)?;
    let targets = wanted.into_iter().map(|block| {
        let picture = Picture {
            graph: path,
            block: graph.block(block)?.id(),
            size: arguments.size_of(graph),
            seed: arguments.seed.unwrap_or(graph.settings().seed),
        };
        Ok(Target { block, path: pattern.path(&picture) })
    });
    targets.collect()
}

/// The blocks whose outputs are rendered.
fn wanted(arguments: &RenderArguments, graph: &Graph) -> Result<Vec<BlockId>, Error> {
    let main = match &arguments.block {
        Some(id) => graph.find(id).ok_or_else(|| no_block(graph, id)),
        None => graph.main_result(),
    };
    Ok(if arguments.all_results { main.map(|_| graph.results().collect())? } else { vec![main?] })
}

fn no_block(graph: &Graph, id: &str) -> Error {
    let error = Error::new(ErrorKind::NotFound, format!("the graph has no block of id \"{id}\""));
    let results = graph.results().filter_map(|block| graph.block(block).ok());
    let results: Vec<_> = results.map(|block| format!("\"{}\"", block.id())).collect();
    match results.is_empty() {
        true => error,
        false => error.with_hint(format!("its `end` blocks are {}", results.join(", "))),
    }
}

fn refuse_unknown_formats(plan: &Plan<'_>) -> Result<(), Fault> {
    let mut paths = plan.jobs.iter().flat_map(|job| &job.targets).map(|target| &target.path);
    paths.try_for_each(|path| output::check_name(path))
}

fn refuse_collisions(plan: &Plan<'_>) -> Result<(), Fault> {
    let mut taken: HashMap<PathBuf, &Path> = HashMap::new();
    for job in &plan.jobs {
        for target in &job.targets {
            let place = std::path::absolute(&target.path).unwrap_or_else(|_| target.path.clone());
            if let Some(other) = taken.insert(place, job.path) {
                return Err(collision(&target.path, other, job.path));
            }
        }
    }
    Ok(())
}

fn collision(target: &Path, one: &Path, other: &Path) -> Fault {
    let message = if one == other {
        format!("two pictures of {} would be {}", one.display(), target.display())
    } else {
        let (one, other) = (one.display(), other.display());
        format!("the pictures of {one} and {other} would both be {}", target.display())
    };
    Fault::usage(message, "a pattern with {name}, {folder} or {block} tells pictures apart")
}
