//! What the engine has to say and nobody asked for.

use std::{
    fmt,
    sync::{Arc, PoisonError, RwLock},
};

pub use crate::block::LogLevel;

/// Takes messages; called on any thread.
pub type LogFn = dyn Fn(LogLevel, &str) + Send + Sync;

/// Where messages go.
#[derive(Default)]
pub(super) struct Log(RwLock<Option<(LogLevel, Arc<LogFn>)>>);

impl Log {
    /// Sends messages of at least `level` to `log`, or nowhere.
    pub(super) fn set(&self, log: Option<(LogLevel, Arc<LogFn>)>) {
        *self.0.write().unwrap_or_else(PoisonError::into_inner) = log;
    }

    /// Tells a message. The receiver may set another receiver meanwhile.
    pub(super) fn tell(&self, level: LogLevel, message: &str) {
        let receiver = self.0.read().unwrap_or_else(PoisonError::into_inner).clone();
        if let Some((least, log)) = receiver
            && level >= least
        {
            log(level, message);
        }
    }
}

impl fmt::Debug for Log {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("Log")
    }
}
