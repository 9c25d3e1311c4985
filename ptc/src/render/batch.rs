//! Rendering what was planned.

use std::{
    sync::{Arc, Mutex, PoisonError},
    time::{Duration, Instant},
};

use ptlib::{
    BlockId, Cancel, ComputeOptions, Engine, Error, Graph, Image,
    run::{LogLevel, ProgressReport},
};

use super::{
    RenderArguments,
    plan::{Job, Plan, Target},
};
use crate::{
    exit::{Exit, Fault},
    output,
    progress::Progress,
    terminal,
};

/// Renders all graphs of a plan, one after the other: each uses all threads.
pub(super) fn render(
    arguments: &RenderArguments,
    engine: &Engine,
    plan: &Plan<'_>,
    cancel: &Cancel,
) -> Exit {
    let warnings = Warnings::of(engine);
    let batch = Batch { arguments, engine, cancel, started: Instant::now(), warnings };
    let total = plan.jobs.len() + plan.failed;
    let (mut rendered, mut failed) = (0, plan.failed);
    for (number, job) in plan.jobs.iter().enumerate() {
        let title = match plan.jobs.len() {
            1 => job.path.display().to_string(),
            jobs => format!("{}/{jobs} {}", number + 1, job.path.display()),
        };
        match batch.render(job, &title) {
            Ok(()) => rendered += 1,
            Err(fault) if fault.exit == Exit::Cancelled => {
                terminal::note(&match total {
                    1 => "cancelled".to_owned(),
                    total => format!("cancelled: {rendered} of {total} graphs rendered"),
                });
                return Exit::Cancelled;
            }
            Err(fault) => {
                fault.report();
                failed += 1;
            }
        }
    }
    if total > 1 && !arguments.quiet {
        let graphs = terminal::counted(rendered, "graph");
        terminal::note(&format!("{graphs} rendered, {failed} failed"));
    }
    match (rendered, failed) {
        (_, 0) => Exit::Success,
        (0, _) => Exit::Failed,
        _ => Exit::SomeFailed,
    }
}

/// What all graphs of a batch are rendered with.
struct Batch<'a> {
    arguments: &'a RenderArguments,
    engine: &'a Engine,
    cancel: &'a Cancel,
    started: Instant,
    warnings: Warnings,
}

/// What the engine says while it computes, kept until the progress bar is gone.
struct Warnings(Arc<Mutex<Vec<String>>>);

impl Warnings {
    fn of(engine: &Engine) -> Self {
        let warnings = Arc::new(Mutex::new(Vec::<String>::new()));
        let said = Arc::clone(&warnings);
        engine.set_log(Some((
            LogLevel::Warning,
            Arc::new(move |_, message| {
                let mut said = said.lock().unwrap_or_else(PoisonError::into_inner);
                // Several pictures of one graph may compute the same block.
                if !said.iter().any(|known| known == message) {
                    said.push(message.to_owned());
                }
            }),
        )));
        Self(warnings)
    }

    /// What was said since the last time.
    fn take(&self) -> Vec<String> {
        std::mem::take(&mut *self.0.lock().unwrap_or_else(PoisonError::into_inner))
    }
}

/// The rendering of one graph.
struct Rendering<'a> {
    batch: &'a Batch<'a>,
    job: &'a Job<'a>,
    progress: Progress<'a>,
    computing: Duration,
    saving: Duration,
}

impl Batch<'_> {
    fn render(&self, job: &Job<'_>, title: &str) -> Result<(), Fault> {
        let mut rendering = Rendering {
            batch: self,
            job,
            progress: Progress::new(title, self.started, !self.arguments.quiet),
            computing: Duration::ZERO,
            saving: Duration::ZERO,
        };
        let done = rendering.run();
        rendering.report(done.is_ok() && self.arguments.timing);
        done
    }
}

impl Rendering<'_> {
    fn run(&mut self) -> Result<(), Fault> {
        let results = self.compute_results()?;
        for target in &self.job.targets {
            let done = results.iter().find(|(block, _)| *block == target.block);
            let image = match done {
                Some((_, image)) => image.clone(),
                None => self.compute(|engine, graph, options| {
                    engine.compute(graph, target.block, 0, options)
                })?,
            };
            if self.batch.cancel.is_requested() {
                return Err(Fault::cancelled());
            }
            self.save(&image, target)?;
        }
        Ok(())
    }

    /// All results of the graph at once, where that is wanted: it saves computing what they share
    /// again, and it is how `save file` blocks run.
    fn compute_results(&mut self) -> Result<Vec<(BlockId, Image)>, Fault> {
        let arguments = self.batch.arguments;
        let may_write = arguments.runs_writers();
        let writes = self.job.graph.writers().next().is_some();
        if may_write || arguments.all_results && !writes {
            self.compute(Engine::compute_all)
        } else {
            Ok(vec![])
        }
    }

    fn compute<T>(
        &mut self,
        compute: impl FnOnce(&Engine, &Graph, ComputeOptions<'_>) -> Result<T, Error>,
    ) -> Result<T, Fault> {
        let started = Instant::now();
        let mut show = |report: &ProgressReport| {
            self.progress.show(report);
            true
        };
        let graph = &self.job.graph;
        let mut options = self.batch.arguments.compute_options(graph, self.batch.cancel);
        options.progress = Some(&mut show);
        let computed = compute(self.batch.engine, graph, options);
        self.computing += started.elapsed();
        computed.map_err(|error| Fault::of_file(self.job.path, &error))
    }

    fn save(&mut self, image: &Image, target: &Target) -> Result<(), Fault> {
        let started = Instant::now();
        let saved = output::save(image, &target.path, self.batch.arguments.bit_depth());
        self.saving += started.elapsed();
        saved.map_err(|error| Fault::of_file(self.job.path, &error))
    }

    /// Says what there is to say besides a fault that ended the rendering.
    fn report(self, shows_times: bool) {
        let Self { batch, job, progress, computing, saving } = self;
        // The bar must be gone before the first line.
        drop(progress);
        let warnings = batch.warnings.take();
        if batch.arguments.quiet {
            return;
        }
        for warning in warnings {
            terminal::warning(&format!("{}: {warning}", job.path.display()));
        }
        if shows_times {
            terminal::note(&format!(
                "{}: read in {:.1?}, computed in {computing:.1?}, saved in {saving:.1?}",
                job.path.display(),
                job.reading
            ));
        }
    }
}
