//! `ptc check-plugin`: whether a plug-in keeps what it promises.
//!
//! Each check runs in a process of its own ([`child`]), so that a crash, a hang or a word on the
//! standard output is that check's fault and the others still run. What is checked is in
//! [`checks`].

mod checks;
mod child;
mod inputs;
mod parameters;

use std::{
    io::Write,
    path::{Path, PathBuf},
    time::Duration,
};

use serde::Serialize;

use crate::{
    exit::{Exit, Fault},
    terminal::{self, Printable},
};

pub(crate) use checks::Check;

/// The command's arguments.
#[derive(Debug, clap::Args)]
pub(crate) struct CheckPluginArguments {
    /// The plug-in
    #[arg(value_name = "PLUGIN")]
    plugin: PathBuf,

    /// Run this check only; may be given several times
    #[arg(long, value_name = "CHECK")]
    only: Vec<Check>,

    /// Seconds that a check may take
    #[arg(long, value_name = "SECONDS", default_value_t = 120)]
    timeout: u64,

    /// Print the results as JSON: {"plugin", "passed", "checks": [{"name", "passed", "faults"}]}
    #[arg(long)]
    json: bool,

    /// Run the check in this process, and write what it finds to this file
    #[arg(long, value_name = "FILE", hide = true, requires = "only")]
    report: Option<PathBuf>,
}

/// What became of all checks: what `--json` prints.
#[derive(Debug, Serialize)]
struct Results {
    plugin: String,
    passed: bool,
    checks: Vec<Outcome>,
}

/// What became of a check.
#[derive(Debug, Serialize)]
struct Outcome {
    name: &'static str,
    passed: bool,
    faults: Vec<String>,
}

/// Runs the command.
pub(crate) fn run(arguments: &CheckPluginArguments) -> Result<Exit, Fault> {
    if let Some(report) = &arguments.report {
        return child::answer(&arguments.plugin, &arguments.only, report);
    }
    let checks = if arguments.only.is_empty() { Check::ALL } else { &arguments.only };
    let timeout = Duration::from_secs(arguments.timeout.max(1));
    let mut outcomes = Vec::new();
    let mut out = terminal::stdout();
    for check in checks {
        let faults = child::ask(&arguments.plugin, *check, timeout)?;
        let outcome = Outcome { name: check.name(), passed: faults.is_empty(), faults };
        if !arguments.json {
            print(&mut out, &arguments.plugin, *check, &outcome)?;
        }
        let is_useless = *check == Check::Load && !outcome.passed;
        outcomes.push(outcome);
        if is_useless {
            terminal::note("a plug-in that cannot be loaded cannot be checked further");
            break;
        }
    }
    let passed = outcomes.iter().all(|outcome| outcome.passed);
    if arguments.json {
        let plugin = arguments.plugin.display().to_string();
        terminal::write_json(&mut out, &Results { plugin, passed, checks: outcomes })?;
    } else {
        let failed = outcomes.iter().filter(|outcome| !outcome.passed).count();
        let done = terminal::counted(outcomes.len(), "check");
        terminal::note(&format!("{done}, {failed} failed"));
    }
    Ok(if passed { Exit::Success } else { Exit::Failed })
}

fn print(
    out: &mut impl Write,
    plugin: &Path,
    check: Check,
    outcome: &Outcome,
) -> Result<(), Fault> {
    if outcome.passed {
        writeln!(out, "{}: ok, {}", check.name(), check.promise())?;
    }
    for fault in &outcome.faults {
        let style = terminal::severity_style(crate::finding::Severity::Error);
        let file = plugin.display().to_string();
        let (file, fault) = (Printable(&file), Printable(fault));
        writeln!(out, "{file}: {style}error:{style:#} {}: {fault}", check.name())?;
    }
    out.flush()?;
    Ok(())
}
