//! The progress bar.

use std::time::{Duration, Instant};

use indicatif::{ProgressBar, ProgressStyle};
use ptlib::run::ProgressReport;

use crate::terminal::{self, Printable};

/// Work that is done sooner shows no bar: it would only flash.
const PATIENCE: Duration = Duration::from_millis(300);

/// A progress bar on standard error. It appears when the work takes long, is gone when this value
/// is, and shows nothing where standard error is no terminal.
pub(crate) struct Progress<'a> {
    title: &'a str,
    since: Instant,
    is_wanted: bool,
    bar: Option<ProgressBar>,
}

impl<'a> Progress<'a> {
    /// A bar for work that began at `since`.
    pub(crate) fn new(title: &'a str, since: Instant, is_wanted: bool) -> Self {
        Self { title, since, is_wanted: is_wanted && terminal::shows_progress(), bar: None }
    }

    /// Shows how far the work is.
    pub(crate) fn show(&mut self, report: &ProgressReport) {
        if !self.is_wanted || self.since.elapsed() < PATIENCE {
            return;
        }
        let bar = self.bar.get_or_insert_with(|| {
            let template = "{msg} [{bar:30}] {percent:>3} %";
            let style = ProgressStyle::with_template(template).expect("a template of our own");
            ProgressBar::new(0)
                .with_style(style.progress_chars("=> "))
                .with_message(Printable(self.title).to_string())
        });
        bar.update(|state| {
            state.set_len(report.units_total);
            state.set_pos(report.units_done);
        });
    }
}

impl Drop for Progress<'_> {
    fn drop(&mut self) {
        if let Some(bar) = &self.bar {
            bar.finish_and_clear();
        }
    }
}
