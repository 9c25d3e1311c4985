//! Times, and what to say about several of them.

use std::time::{Duration, Instant};

use crate::Result;

/// A row stops early after this long, but not before three runs.
const PATIENCE: Duration = Duration::from_secs(3);

/// The times of the runs of one row.
#[derive(Debug, Clone)]
pub(crate) struct Times(Vec<Duration>);

/// The times of two kinds of work that were done by turns.
#[derive(Debug)]
pub(crate) struct Pairs {
    pub(crate) ours: Times,
    pub(crate) theirs: Times,
    /// How many times as long as ours theirs took, turn by turn, in order of size.
    ratios: Vec<f64>,
}

impl Pairs {
    /// The middle ratio. What else the machine does hits both sides of one, so it says more than
    /// the ratio of the medians.
    pub(crate) fn ratio(&self) -> f64 {
        quantile(&self.ratios, 1, 2)
    }

    /// The width of the middle half of the ratios, as a part of the median.
    pub(crate) fn spread(&self) -> f64 {
        (quantile(&self.ratios, 3, 4) - quantile(&self.ratios, 1, 4)) / self.ratio()
    }
}

/// The number that `part`/`of` of sorted numbers do not exceed.
fn quantile(sorted: &[f64], part: usize, of: usize) -> f64 {
    sorted.get((sorted.len().max(1) - 1) * part / of).copied().unwrap_or(f64::NAN)
}

impl Times {
    /// Runs work at most `runs` times, after one run that does not count. The work measures
    /// itself, so that it can get ready first.
    pub(crate) fn of(runs: usize, work: impl FnMut() -> Result<Duration>) -> Result<Self> {
        Ok(Self::by_turns(runs, work, || Ok(Duration::ZERO))?.ours)
    }

    /// Runs two kinds of work by turns, so that what else the machine does hits both.
    pub(crate) fn by_turns(
        runs: usize,
        mut work: impl FnMut() -> Result<Duration>,
        mut other: impl FnMut() -> Result<Duration>,
    ) -> Result<Pairs> {
        work()?;
        other()?;
        let mut times = (Vec::with_capacity(runs), Vec::with_capacity(runs));
        let begin = Instant::now();
        while times.0.len() < runs.max(1) && (times.0.len() < 3 || begin.elapsed() < PATIENCE) {
            times.0.push(work()?);
            times.1.push(other()?);
        }
        let ratio = |(ours, theirs): (&Duration, &Duration)| theirs.div_duration_f64(*ours);
        let mut ratios: Vec<f64> = times.0.iter().zip(&times.1).map(ratio).collect();
        ratios.sort_by(f64::total_cmp);
        Ok(Pairs { ours: Self::new(times.0), theirs: Self::new(times.1), ratios })
    }

    fn new(mut times: Vec<Duration>) -> Self {
        times.sort();
        Self(times)
    }

    pub(crate) fn runs(&self) -> usize {
        self.0.len()
    }

    /// The middle time, in seconds.
    pub(crate) fn median(&self) -> f64 {
        self.quantile(1, 2)
    }

    /// The width of the middle half, as a part of the median.
    pub(crate) fn spread(&self) -> f64 {
        (self.quantile(3, 4) - self.quantile(1, 4)) / self.median()
    }

    /// The time that `part`/`of` of the runs did not exceed.
    fn quantile(&self, part: usize, of: usize) -> f64 {
        let place = (self.0.len() - 1) * part / of;
        self.0[place].as_secs_f64()
    }
}

/// How long something takes.
pub(crate) fn timed(work: impl FnOnce() -> Result) -> Result<Duration> {
    let start = Instant::now();
    work()?;
    Ok(start.elapsed())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_slow_run_moves_neither_median_nor_spread() {
        let times = [40, 10, 12, 11, 900].map(Duration::from_millis);
        let times = Times::new(times.to_vec());
        assert_eq!(times.median(), 0.012);
        assert!((times.spread() - 29.0 / 12.0).abs() < 1e-9);
    }

    #[test]
    fn the_first_of_five_runs_does_not_count() {
        let mut calls = 0;
        let times = Times::of(4, || {
            calls += 1;
            Ok(Duration::from_millis(calls))
        });
        assert_eq!(times.unwrap().median(), 0.003);
        assert_eq!(calls, 5);
    }

    #[test]
    fn ratios_are_taken_turn_by_turn() {
        // The machine becomes ten times slower in between: no ratio changes.
        let mut ours = [1, 10, 10, 100, 100].into_iter().map(Duration::from_millis);
        let mut theirs = [9, 20, 21, 190, 200].into_iter().map(Duration::from_millis);
        let next = |times: &mut dyn Iterator<Item = Duration>| Ok(times.next().unwrap());
        let pairs = Times::by_turns(4, || next(&mut ours), || next(&mut theirs)).unwrap();
        assert!((pairs.ratio() - 2.0).abs() < 1e-9, "{pairs:?}");
        assert!(pairs.spread() < 0.1);
    }
}
