//! A check in a process of its own: how it is asked, and how it answers.

use std::{
    env, fs,
    io::Read,
    path::{Path, PathBuf},
    process::{Child, Command, ExitStatus, Stdio},
    thread,
    time::{Duration, Instant},
};

use super::checks::{Check, run};
use crate::exit::{Exit, Fault};

/// The most of what a plug-in prints that is shown.
const SHOWN: usize = 200;

/// Has a process run a check; what it found.
pub(super) fn ask(plugin: &Path, check: Check, timeout: Duration) -> Result<Vec<String>, Fault> {
    let report = report_file(check);
    let mut command = Command::new(env::current_exe()?);
    command.arg("check-plugin").arg(plugin).args(["--only", check.name()]);
    command.arg("--report").arg(&report);
    command.stdin(Stdio::null()).stdout(Stdio::piped()).stderr(Stdio::piped());
    let mut child = command.spawn()?;
    let stdout = child.stdout.take().map(|pipe| thread::spawn(move || read(pipe)));
    let stderr = child.stderr.take().map(|pipe| thread::spawn(move || read(pipe)));
    let status = wait(&mut child, timeout)?;
    let text = |reader: Option<thread::JoinHandle<String>>| {
        reader.and_then(|reader| reader.join().ok()).unwrap_or_default()
    };
    let (printed, said) = (text(stdout), text(stderr));
    let answer = fs::read_to_string(&report).ok();
    let _ = fs::remove_file(&report);
    let mut faults: Vec<String> = match (status, answer) {
        (Some(status), Some(answer)) if status.success() => serde_json::from_str(&answer)
            .unwrap_or_else(|error| vec![format!("no report: {error}")]),
        (None, _) => {
            vec![format!("did not end within {} s, and was ended", timeout.as_secs())]
        }
        (Some(status), _) => vec![format!("the process {}{}", ended(status), last_words(&said))],
    };
    if !printed.is_empty() {
        faults.push(format!(
            "wrote to the standard output, which belongs to the program: {:?}",
            shortened(&printed)
        ));
    }
    Ok(faults)
}

fn report_file(check: Check) -> PathBuf {
    let name = format!("ptc-check-{}-{}.json", std::process::id(), check.name());
    env::temp_dir().join(name)
}

fn read(mut pipe: impl Read) -> String {
    let mut bytes = Vec::new();
    let _ = pipe.read_to_end(&mut bytes);
    String::from_utf8_lossy(&bytes).into_owned()
}

/// Waits for a process; `None` if it had to be ended.
fn wait(child: &mut Child, timeout: Duration) -> Result<Option<ExitStatus>, Fault> {
    let deadline = Instant::now() + timeout;
    loop {
        if let Some(status) = child.try_wait()? {
            return Ok(Some(status));
        }
        if Instant::now() >= deadline {
            child.kill()?;
            child.wait()?;
            return Ok(None);
        }
        thread::sleep(Duration::from_millis(5));
    }
}

/// How a process ended that should have ended well.
fn ended(status: ExitStatus) -> String {
    #[cfg(unix)]
    {
        use std::os::unix::process::ExitStatusExt as _;
        if let Some(signal) = status.signal() {
            let name = match signal {
                4 => " (illegal instruction)",
                6 => " (it aborted: a panic or exception left a function?)",
                7 => " (bus error)",
                8 => " (arithmetic)",
                11 => " (invalid memory)",
                _ => "",
            };
            return format!("was ended by signal {signal}{name}");
        }
    }
    format!("ended by itself with {status}: plug-ins never do that")
}

fn last_words(said: &str) -> String {
    match said.trim() {
        "" => String::new(),
        said => format!("; it said {:?}", shortened(said)),
    }
}

fn shortened(text: &str) -> String {
    let characters = text.chars().count();
    let start = characters.saturating_sub(SHOWN);
    text.chars().skip(start).collect()
}

/// Runs checks in this process, and writes what they find to a file.
pub(super) fn answer(plugin: &Path, checks: &[Check], report: &Path) -> Result<Exit, Fault> {
    let faults: Vec<String> = checks.iter().flat_map(|check| run(*check, plugin)).collect();
    fs::write(report, serde_json::to_string(&faults).map_err(std::io::Error::from)?)?;
    Ok(Exit::Success)
}
