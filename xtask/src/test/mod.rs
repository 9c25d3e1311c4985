//! `cargo xtask test`: the one command that checks everything.
//!
//! It runs the [`steps`] one after the other, goes on after a failure, and ends with a line of
//! the form `12 passed, 0 failed, 1 skipped`. A step whose tool is not installed is skipped, and
//! the summary says how to install it; with `--strict` that is a failure. Tests that need a tool
//! follow the same rule by the environment variable `PTLIB_TEST_STRICT`.

mod aging_plugin;
mod c_programs;
mod csharp;
mod steps;

use std::{
    io::{self, Write as _},
    process::ExitCode,
    time::{Duration, Instant},
};

use self::steps::{STEPS, Step};
use crate::{Result, process::MissingTool};

const USAGE: &str = "usage: cargo xtask test [--strict] [--quick] [--list] [STEP…]";

/// How the tests are run.
#[derive(Debug, Default)]
struct Options {
    is_strict: bool,
    is_quick: bool,
    lists: bool,
    names: Vec<String>,
}

/// How a step ended.
#[derive(Debug, PartialEq, Eq)]
enum Outcome {
    Passed,
    Failed(String),
    Skipped(String),
}

/// What became of a step.
struct Record {
    name: &'static str,
    outcome: Outcome,
    time: Duration,
}

/// The command. That a step failed is no error of it: the last line of the summary told it.
pub(crate) fn run(arguments: &[String]) -> Result<ExitCode> {
    let options = read(arguments)?;
    if options.lists {
        for step in STEPS {
            println!("{:<12} {}", step.name, step.about);
        }
        return Ok(ExitCode::SUCCESS);
    }
    let mut records: Vec<Record> = Vec::new();
    for step in select(STEPS, &options) {
        println!("\n=== {}: {}", step.name, step.about);
        io::stdout().flush()?;
        let start = Instant::now();
        let outcome = match missing_need(step, &records) {
            Some(need) => Outcome::Skipped(format!("it needs `{need}`, which did not pass")),
            None => outcome((step.run)(options.is_strict), options.is_strict),
        };
        let record = Record { name: step.name, outcome, time: start.elapsed() };
        println!("{}", line(&record));
        records.push(record);
    }
    summary(&records)
}

fn read(arguments: &[String]) -> Result<Options> {
    let mut options = Options::default();
    for argument in arguments {
        match argument.as_str() {
            "--strict" => options.is_strict = true,
            "--quick" => options.is_quick = true,
            "--list" => options.lists = true,
            name if STEPS.iter().any(|step| step.name == name) => {
                options.names.push(name.to_owned());
            }
            other => {
                let known: Vec<_> = STEPS.iter().map(|step| step.name).collect();
                return Err(
                    format!("{USAGE}\nno step \"{other}\", but {}", known.join(", ")).into()
                );
            }
        }
    }
    Ok(options)
}

/// The steps to run, in their order: those that were named and what they need, or all.
fn select<'a>(steps: &'a [Step], options: &Options) -> Vec<&'a Step> {
    let is_named = |step: &Step| options.names.iter().any(|name| name == step.name);
    let is_needed =
        |step: &Step| steps.iter().any(|other| is_named(other) && other.needs.contains(&step.name));
    let is_wanted = |step: &&Step| {
        if options.names.is_empty() {
            step.is_quick || !options.is_quick
        } else {
            is_named(step) || is_needed(step)
        }
    };
    steps.iter().filter(is_wanted).collect()
}

/// The first step that `step` needs and that did not pass.
fn missing_need(step: &Step, records: &[Record]) -> Option<&'static str> {
    let passed = |need: &str| {
        records.iter().any(|done| done.name == need && done.outcome == Outcome::Passed)
    };
    step.needs.iter().copied().find(|need| !passed(need))
}

fn outcome(done: Result, is_strict: bool) -> Outcome {
    match done {
        Ok(()) => Outcome::Passed,
        Err(error) if error.is::<MissingTool>() && !is_strict => {
            Outcome::Skipped(error.to_string())
        }
        Err(error) => Outcome::Failed(error.to_string()),
    }
}

fn line(record: &Record) -> String {
    let Record { name, outcome, time } = record;
    let (word, detail) = match outcome {
        Outcome::Passed => ("passed", String::new()),
        Outcome::Failed(why) => ("FAILED", format!(": {why}")),
        Outcome::Skipped(why) => ("skipped", format!(": {why}")),
    };
    format!("{word:<8} {name:<12} {:>7.1} s{detail}", time.as_secs_f64())
}

/// Shows how all steps ended, and whether one failed.
fn summary(records: &[Record]) -> Result<ExitCode> {
    let total: Duration = records.iter().map(|record| record.time).sum();
    println!("\n=== summary ({:.0} s)", total.as_secs_f64());
    for record in records {
        // The whole story stands above, where the step ran.
        println!("{}", line(record).lines().next().unwrap_or(""));
    }
    let counts = Counts::of(records);
    println!("{} passed, {} failed, {} skipped", counts.passed, counts.failed, counts.skipped);
    io::stdout().flush()?;
    Ok(if counts.failed == 0 { ExitCode::SUCCESS } else { ExitCode::FAILURE })
}

#[derive(Debug, Default, PartialEq, Eq)]
struct Counts {
    passed: usize,
    failed: usize,
    skipped: usize,
}

impl Counts {
    fn of(records: &[Record]) -> Self {
        let mut counts = Self::default();
        for record in records {
            match record.outcome {
                Outcome::Passed => counts.passed += 1,
                Outcome::Failed(_) => counts.failed += 1,
                Outcome::Skipped(_) => counts.skipped += 1,
            }
        }
        counts
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const fn step(name: &'static str, is_quick: bool, needs: &'static [&'static str]) -> Step {
        Step { name, about: "", is_quick, needs, run: |_| Ok(()) }
    }

    const SOME: &[Step] = &[step("a", true, &[]), step("b", false, &[]), step("c", false, &["b"])];

    fn names(options: &Options) -> Vec<&str> {
        select(SOME, options).iter().map(|step| step.name).collect()
    }

    #[test]
    fn named_steps_bring_what_they_need() {
        let options = Options { names: vec!["c".to_owned()], ..Options::default() };
        assert_eq!(names(&options), ["b", "c"]);
        assert_eq!(names(&Options { is_quick: true, ..Options::default() }), ["a"]);
        assert_eq!(names(&Options::default()), ["a", "b", "c"]);
    }

    #[test]
    fn a_step_is_skipped_if_what_it_needs_failed() {
        let record = |outcome| [Record { name: "b", outcome, time: Duration::ZERO }];
        let failed = record(Outcome::Failed("x".to_owned()));
        assert_eq!(missing_need(&SOME[2], &failed), Some("b"));
        assert_eq!(missing_need(&SOME[2], &record(Outcome::Passed)), None);
    }

    #[test]
    fn a_missing_tool_fails_only_a_strict_run() {
        let missing = || Err(MissingTool { name: "valgrind", install: "buy one" }.into());
        assert!(matches!(outcome(missing(), false), Outcome::Skipped(_)));
        assert!(matches!(outcome(missing(), true), Outcome::Failed(_)));
        assert!(matches!(outcome(Err("x".into()), false), Outcome::Failed(_)));
    }

    #[test]
    fn every_outcome_counts() {
        let outcomes = [
            Outcome::Passed,
            Outcome::Failed("x".to_owned()),
            Outcome::Skipped("y".to_owned()),
            Outcome::Passed,
        ];
        let records = outcomes.map(|outcome| Record {
            name: "a",
            outcome,
            time: Duration::from_millis(1500),
        });
        assert_eq!(Counts::of(&records), Counts { passed: 2, failed: 1, skipped: 1 });
        assert_eq!(line(&records[1]), "FAILED   a                1.5 s: x");
    }

    #[test]
    fn an_unknown_step_is_refused() {
        assert!(read(&["no-such".to_owned()]).unwrap_err().to_string().contains("tidy"));
        assert!(read(&["tidy".to_owned(), "--strict".to_owned()]).unwrap().is_strict);
    }

    #[test]
    fn steps_need_earlier_ones() {
        for (place, step) in STEPS.iter().enumerate() {
            for need in step.needs {
                assert!(STEPS[..place].iter().any(|other| other.name == *need), "{}", step.name);
            }
        }
    }
}
