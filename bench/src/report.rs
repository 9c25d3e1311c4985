//! What is said about a row.

use std::fmt;

use serde::{Deserialize, Serialize};

use crate::{
    measure::{Pairs, Times},
    peers::Peer,
};

/// One measured row.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub(crate) struct Row {
    pub(crate) name: String,
    pub(crate) width: u32,
    pub(crate) height: u32,
    pub(crate) threads: u32,
    pub(crate) precision: String,
    pub(crate) runs: usize,
    pub(crate) median_ms: f64,
    /// The width of the middle half of the runs, as a part of the median.
    pub(crate) spread: f64,
    pub(crate) ns_per_pixel: f64,
    pub(crate) mpixel_per_s: f64,
    /// How much faster than copying the same bytes; below 1 is slower.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(crate) of_memcpy: Option<f64>,
    /// The most memory that the process had, in MiB.
    #[serde(default, skip_serializing_if = "Option::is_none")]
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
            precision: precision.to_owned(),
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

/// A row of ours and a peer, measured by turns.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub(crate) struct PeerRow {
    /// The row of ours.
    pub(crate) name: String,
    pub(crate) width: u32,
    pub(crate) height: u32,
    pub(crate) threads: u32,
    pub(crate) precision: String,
    /// The crate and its version.
    pub(crate) peer: String,
    /// What the peer does, and in what it differs.
    pub(crate) does: String,
    pub(crate) runs: usize,
    pub(crate) ours_ms: f64,
    pub(crate) theirs_ms: f64,
    /// How many times as long as ours theirs took: below 1, the peer is ahead.
    pub(crate) ratio: f64,
    /// The width of the middle half of the ratios, as a part of their median.
    pub(crate) spread: f64,
}

impl PeerRow {
    pub(crate) fn new(subject: Subject, peer: &Peer, pairs: &Pairs) -> Self {
        let Subject { name, size: (width, height), threads, precision } = subject;
        Self {
            name,
            width,
            height,
            threads,
            precision: precision.to_owned(),
            peer: peer.release(),
            does: peer.does.to_owned(),
            runs: pairs.ours.runs(),
            ours_ms: rounded(pairs.ours.median() * 1e3),
            theirs_ms: rounded(pairs.theirs.median() * 1e3),
            ratio: rounded(pairs.ratio()),
            spread: rounded(pairs.spread()),
        }
    }
}

/// The line above rows of peers.
pub(crate) const PEER_HEADING: &str = "\
name                               peer                    ours ms  theirs ms   ratio spread";

impl fmt::Display for PeerRow {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { name, peer, ours_ms, theirs_ms, ratio, .. } = self;
        let percent = self.spread * 100.0;
        write!(f, "{name:<34} {peer:<20} {ours_ms:>10.2} {theirs_ms:>10.2}")?;
        write!(f, " {ratio:>7.2} {percent:>5.1}%")
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
