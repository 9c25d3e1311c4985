//! `ptc check`: what is wrong with graph files.

use std::{
    io::{self, Write},
    path::{Path, PathBuf},
};

use ptlib::{Error, ErrorKind, Graph};
use serde::Serialize;

use crate::{
    exit::{Exit, Fault},
    finding::{Finding, Severity, findings},
    plugins::{PluginLoader, PluginOptions, engine_for_types},
    terminal::{self, Printable},
};

/// The command's arguments.
#[derive(Debug, clap::Args)]
pub(crate) struct CheckArguments {
    /// Graph files
    #[arg(required = true, value_name = "GRAPH")]
    graphs: Vec<PathBuf>,

    /// Print the faults as JSON: {"files": [{"file", "is_sound", "faults": [...]}]}
    #[arg(long)]
    json: bool,

    #[command(flatten)]
    plugins: PluginOptions,
}

/// What was found in all files: what `--json` prints.
#[derive(Debug, Serialize)]
struct Report {
    files: Vec<FileReport>,
}

#[derive(Debug, Serialize)]
struct FileReport {
    file: String,
    /// Whether the graph can be computed, as far as the file alone tells.
    is_sound: bool,
    faults: Vec<FaultReport>,
}

/// A fault or a warning. What is not known is left out.
#[derive(Debug, Serialize)]
struct FaultReport {
    severity: Severity,
    /// The number of the kind of fault, as in the C interface.
    kind: u32,
    #[serde(skip_serializing_if = "Option::is_none")]
    line: Option<u32>,
    #[serde(skip_serializing_if = "Option::is_none")]
    column: Option<u32>,
    #[serde(skip_serializing_if = "Option::is_none")]
    block: Option<String>,
    #[serde(skip_serializing_if = "Option::is_none")]
    block_type: Option<String>,
    #[serde(skip_serializing_if = "Option::is_none")]
    parameter: Option<String>,
    message: String,
    #[serde(skip_serializing_if = "Option::is_none")]
    hint: Option<String>,
}

/// Runs the command.
pub(crate) fn run(arguments: &CheckArguments) -> Result<Exit, Fault> {
    let engine = engine_for_types();
    let mut plugins = arguments.plugins.load(&engine, true)?;
    let found: Vec<_> =
        arguments.graphs.iter().map(|path| (path.as_path(), check(&mut plugins, path))).collect();
    let mut out = terminal::stdout();
    if arguments.json {
        let files = found.iter().map(|(path, findings)| file_report(path, findings)).collect();
        terminal::write_json(&mut out, &Report { files })?;
    } else {
        for (path, findings) in &found {
            print(&mut out, path, findings)?;
        }
        terminal::note(&summary(&found));
    }
    let is_sound = found.iter().all(|(_, findings)| is_sound(findings));
    Ok(if is_sound { Exit::Success } else { Exit::Failed })
}

/// All that is wrong with a file: what reading it says, and what the graph says of each block that
/// would be computed.
fn check(plugins: &mut PluginLoader<'_>, path: &Path) -> Vec<Finding> {
    match plugins.open_graph(path) {
        Ok(reading) => {
            let mut findings = findings(&reading.warnings, &faults_of(&reading.graph));
            let lacking = |finding: &&mut Finding| lacks_value(&reading.graph, &finding.error);
            for finding in findings.iter_mut().filter(lacking) {
                finding.severity = Severity::Warning;
            }
            findings.extend(nothing_wanted(&reading.graph));
            plugins.explain(&reading.graph, &mut findings);
            findings.sort_by_key(Finding::position_or_last);
            findings
        }
        Err(error) => findings(&[], &[error]),
    }
}

fn faults_of(graph: &Graph) -> Vec<Error> {
    let wanted = graph.results().chain(graph.writers());
    wanted.filter_map(|block| graph.validate(block).err()).collect()
}

/// Whether the fault is a value that somebody may still set: the file is as it should be.
fn lacks_value(graph: &Graph, fault: &Error) -> bool {
    let block = fault.place().handle;
    fault.kind() == ErrorKind::Unconnected
        && graph.inputs().any(|(input, _)| Some(input.to_raw()) == block)
}

/// A graph without results is no fault, but few people mean that.
fn nothing_wanted(graph: &Graph) -> Option<Finding> {
    let writes = graph.writers().next().is_some();
    graph.main_result().err().filter(|_| !writes).map(|error| Finding::warning(&error))
}

fn is_sound(findings: &[Finding]) -> bool {
    findings.iter().all(|finding| finding.severity == Severity::Warning)
}

/// Prints one line a finding, in the form that editors know: `file:line:column: error: message`.
fn print(out: &mut impl Write, path: &Path, findings: &[Finding]) -> io::Result<()> {
    for finding in findings {
        let style = terminal::severity_style(finding.severity);
        let (location, fact) = (finding.location_in(path), finding.fact_of(path));
        let (location, fact) = (Printable(&location), Printable(&fact));
        let word = finding.severity.name();
        writeln!(out, "{location}: {style}{word}:{style:#} {fact}")?;
    }
    Ok(())
}

fn summary(found: &[(&Path, Vec<Finding>)]) -> String {
    let count = |severity| {
        let findings = found.iter().flat_map(|(_, findings)| findings);
        findings.filter(|finding| finding.severity == severity).count()
    };
    let files = terminal::counted(found.len(), "file");
    let errors = terminal::counted(count(Severity::Error), "error");
    let warnings = terminal::counted(count(Severity::Warning), "warning");
    format!("{files} checked: {errors}, {warnings}")
}

fn file_report(path: &Path, findings: &[Finding]) -> FileReport {
    FileReport {
        file: path.display().to_string(),
        is_sound: is_sound(findings),
        faults: findings.iter().map(fault_report).collect(),
    }
}

fn fault_report(finding: &Finding) -> FaultReport {
    let place = finding.error.place();
    FaultReport {
        severity: finding.severity,
        kind: finding.error.kind() as u32,
        line: place.position.map(|(line, _)| line),
        column: place.position.map(|(_, column)| column),
        block: place.block.clone(),
        block_type: place.block_type.clone(),
        parameter: place.parameter.clone(),
        message: finding.error.message().to_owned(),
        hint: finding.hint().map(str::to_owned),
    }
}

#[cfg(test)]
mod tests {
    use ptlib::{Engine, EngineOptions};

    use super::*;

    fn engine() -> Engine {
        Engine::new(EngineOptions { threads: 1, ..Default::default() })
    }

    #[test]
    fn a_block_that_two_results_need_is_reported_once() {
        let mut graph = engine().new_graph();
        let invert = graph.add("invert").unwrap();
        for _ in 0..2 {
            let end = graph.add("end").unwrap();
            graph.connect(invert, 0, end, 0).unwrap();
        }
        let findings = findings(&[], &faults_of(&graph));
        assert_eq!(findings.len(), 1);
        assert!(!is_sound(&findings));
        assert_eq!(nothing_wanted(&graph), None);
    }

    #[test]
    fn a_graph_without_results_is_sound_but_suspicious() {
        let graph = engine().new_graph();
        assert!(faults_of(&graph).is_empty());
        assert_eq!(nothing_wanted(&graph).unwrap().severity, Severity::Warning);
    }

    #[test]
    fn the_summary_counts() {
        let error = ptlib::Error::new(ptlib::ErrorKind::Parse, "no");
        let findings = vec![Finding::error(&error), Finding::error(&error)];
        let found = [(Path::new("a"), findings)];
        assert_eq!(summary(&found), "1 file checked: 2 errors, 0 warnings");
    }
}
