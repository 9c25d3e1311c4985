//! What is said about a row.

use std::fmt;

use serde::Serialize;

use crate::measure::Times;

/// One measured row.
#[derive(Debug, Serialize)]
pub(crate) struct Row {
    pub(crate) name: String,
    pub(crate) width: u32,
    pub(crate) height: u32,
    pub(crate) threads: u32,
    pub(crate) precision: &'static str,
    pub(crate) runs: usize,
    pub(crate) median_ms: f64,
    /// The width of the middle half of the runs, as a part of the median.
    pub(crate) spread: f64,
    pub(crate) ns_per_pixel: f64,
    pub(crate) mpixel_per_s: f64,
    /// How much faster than copying the same bytes; below 1 is slower.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) of_memcpy: Option<f64>,
    /// The most memory that the process had, in MiB.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) peak_mib: Option<f64>,
}

/// What a row is about.
pub(crate) struct Subject {
    pub(crate) name: String,
    pub(crate) size: (u32, u32),
    pub(crate) threads: u32,
    pub(crate) precision: &'static str,
}

impl Row {
    pub(crate) fn new(subject: Subject, times: &Times) -> Self {
        let Subject { name, size: (width, height), threads, precision } = subject;
        let pixels = f64::from(width) * f64::from(height);
        let seconds = times.median();
        Self {
            name,
            width,
            height,
            threads,
            precision,
            runs: times.runs(),
            median_ms: rounded(seconds * 1e3),
            spread: rounded(times.spread()),
            ns_per_pixel: rounded(seconds * 1e9 / pixels),
            mpixel_per_s: rounded(pixels / seconds / 1e6),
            of_memcpy: None,
            peak_mib: None,
        }
    }
}

/// Three digits behind the point: more are noise.
pub(crate) fn rounded(value: f64) -> f64 {
    (value * 1e3).round() / 1e3
}

/// The line above the rows.
pub(crate) const HEADING: &str = "\
name                               size      threads precision  median ms spread  ns/pixel   Mpx/s";

impl fmt::Display for Row {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let size = format!("{}x{}", self.width, self.height);
        write!(f, "{:<34} {size:<9} {:>7} {:<9}", self.name, self.threads, self.precision)?;
        let Self { median_ms, ns_per_pixel, mpixel_per_s, .. } = self;
        let percent = self.spread * 100.0;
        write!(f, " {median_ms:>10.2} {percent:>5.1}% {ns_per_pixel:>9.2} {mpixel_per_s:>8.1}")?;
        if let Some(ratio) = self.of_memcpy {
            write!(f, "  {:.0} % of memcpy", ratio * 100.0)?;
        }
        if let Some(peak) = self.peak_mib {
            write!(f, "  peak {peak:.0} MiB")?;
        }
        Ok(())
    }
}
