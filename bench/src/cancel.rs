//! How long a computation goes on after it was asked to stop.
//!
//! Every block, with each of its parameters at either end of what is allowed, on one thread and on
//! a picture that is as wide as pictures get: a computation looks at requests between rows, so wide
//! rows are the worst. A stop within [`GOAL`] feels immediate.

use std::{
    thread,
    time::{Duration, Instant},
};

use ptlib::{
    Cancel, ErrorKind,
    params::{ParamKind, ParamSpec, ParamValue},
};

use crate::{
    Result,
    catalogue::{self, Entry},
};

/// What a person takes for at once.
const GOAL: Duration = Duration::from_millis(50);

/// When the request comes: some computations are in the middle of preparing, some in their rows.
const DELAYS: [Duration; 3] =
    [Duration::from_millis(2), Duration::from_millis(20), Duration::from_millis(90)];

const SIZE: (u32, u32) = (65_536, 256);

/// Shows the longest wait of each block; `false` if one is over the goal.
pub(crate) fn measure(filters: &[String]) -> Result<bool> {
    let mut is_fast = true;
    println!("{:<34} {:<9} longest wait, and with what", "name", "precision");
    for mut entry in catalogue::entries(SIZE, filters)? {
        let (wait, with) = longest(&mut entry)?;
        is_fast &= wait <= GOAL;
        let precision = crate::work::precision_name(entry.work.settings.precision);
        let milliseconds = wait.as_secs_f64() * 1e3;
        println!("{:<34} {precision:<9} {milliseconds:>7.1} ms  {with}", entry.name);
    }
    Ok(is_fast)
}

fn longest(entry: &mut Entry) -> Result<(Duration, String)> {
    let spec = entry.work.spec()?;
    let mut longest = (Duration::ZERO, "defaults".to_owned());
    let mut look = |entry: &mut Entry, with: &str| -> Result {
        for delay in DELAYS {
            if let Some(wait) = wait(entry, delay)?
                && wait > longest.0
            {
                longest = (wait, with.to_owned());
            }
        }
        Ok(())
    };
    look(entry, "defaults")?;
    for param in spec.params {
        for value in ends(param) {
            entry.work.set(param.id, &value)?;
            look(entry, &format!("{} = {value:?}", param.id))?;
        }
        if !matches!(param.kind, ParamKind::Path(_)) {
            entry.work.set(param.id, &param.default_value())?;
        }
    }
    Ok(longest)
}

/// From the request to the end; `None` if the computation ended before.
fn wait(entry: &mut Entry, delay: Duration) -> Result<Option<Duration>> {
    entry.work.warm_up()?;
    let cancel = Cancel::new();
    let request = cancel.clone();
    let requested = thread::spawn(move || {
        thread::sleep(delay);
        request.request();
        Instant::now()
    });
    let outcome = entry.work.run_until(cancel);
    let end = Instant::now();
    let requested = requested.join().map_err(|_| "the clock stopped")?;
    match outcome {
        Ok(()) => Ok(None),
        Err(error) if error.kind() == ErrorKind::Cancelled => Ok(Some(end - requested)),
        // Some parameters do not go together.
        Err(error) if error.kind() == ErrorKind::InvalidArgument => Ok(None),
        Err(error) => Err(error.into()),
    }
}

fn ends(param: &ParamSpec) -> Vec<ParamValue> {
    match param.kind {
        ParamKind::Int { hard, .. } => [hard.min, hard.max].map(ParamValue::Int).to_vec(),
        ParamKind::Float { hard, .. } => [hard.min, hard.max].map(ParamValue::Float).to_vec(),
        ParamKind::Bool => [false, true].map(ParamValue::Bool).to_vec(),
        ParamKind::Choice(items) => (0..).zip(items).map(|(i, _)| ParamValue::Choice(i)).collect(),
        ParamKind::Text | ParamKind::Path(_) => Vec::new(),
    }
}
