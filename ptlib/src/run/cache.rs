//! Results kept for later computations.

use std::{
    collections::BTreeMap,
    sync::{Mutex, PoisonError},
};

use super::key::Key;
use crate::value::Value;

/// Results by what they were computed from. When they take more memory than the budget, those that
/// were not used for the longest time go.
#[derive(Debug)]
pub(super) struct Cache {
    budget: u64,
    state: Mutex<State>,
}

#[derive(Debug, Default)]
struct State {
    entries: BTreeMap<Key, Entry>,
    bytes: u64,
    /// Counts uses: the "time" of the last use of an entry.
    uses: u64,
}

#[derive(Debug)]
struct Entry {
    value: Value,
    last_use: u64,
}

impl Cache {
    pub(super) fn new(budget: u64) -> Self {
        Self { budget, state: Mutex::default() }
    }

    /// Whether anything is kept at all.
    pub(super) fn is_on(&self) -> bool {
        self.budget > 0
    }

    /// The bytes that kept results may take.
    pub(super) fn budget(&self) -> u64 {
        self.budget
    }

    /// The result of that key.
    pub(super) fn get(&self, key: &Key) -> Option<Value> {
        let mut state = self.state.lock().unwrap_or_else(PoisonError::into_inner);
        state.uses += 1;
        let now = state.uses;
        let entry = state.entries.get_mut(key)?;
        entry.last_use = now;
        Some(entry.value.clone())
    }

    /// Keeps a result, unless it alone is over the budget.
    pub(super) fn put(&self, key: Key, value: &Value) {
        let bytes = value.bytes();
        if bytes > self.budget {
            return;
        }
        let mut state = self.state.lock().unwrap_or_else(PoisonError::into_inner);
        let state = &mut *state;
        state.uses += 1;
        let entry = Entry { value: value.clone(), last_use: state.uses };
        state.bytes += bytes;
        if let Some(old) = state.entries.insert(key, entry) {
            state.bytes -= old.value.bytes();
        }
        while state.bytes > self.budget {
            let oldest = state.entries.iter().min_by_key(|(_, entry)| entry.last_use);
            let Some(key) = oldest.map(|(key, _)| *key) else { break };
            if let Some(entry) = state.entries.remove(&key) {
                state.bytes -= entry.value.bytes();
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn key(number: u8) -> Key {
        Key::of_bytes(&[number])
    }

    fn text(len: usize) -> Value {
        "x".repeat(len).into()
    }

    #[test]
    fn the_longest_unused_goes_first() {
        let cache = Cache::new(100);
        cache.put(key(1), &text(40));
        cache.put(key(2), &text(40));
        assert!(cache.get(&key(1)).is_some());
        cache.put(key(3), &text(40));
        assert!(cache.get(&key(1)).is_some());
        assert!(cache.get(&key(2)).is_none());
        assert!(cache.get(&key(3)).is_some());
    }

    #[test]
    fn nothing_over_the_budget_is_kept() {
        let cache = Cache::new(100);
        cache.put(key(1), &text(101));
        assert!(cache.get(&key(1)).is_none());
        cache.put(key(2), &text(100));
        cache.put(key(2), &text(10));
        cache.put(key(3), &text(90));
        assert!(cache.get(&key(2)).is_some());
    }
}
