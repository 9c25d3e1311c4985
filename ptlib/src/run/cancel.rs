//! Asking a computation to stop.

use std::sync::{
    Arc,
    atomic::{AtomicBool, Ordering},
};

/// A request to stop that any thread can make. Clones are the same request.
#[derive(Debug, Clone, Default)]
pub struct Cancel(Arc<Request>);

#[derive(Debug, Default)]
struct Request {
    is_made: AtomicBool,
    parent: Option<Cancel>,
}

impl Cancel {
    /// A request that nobody has made yet.
    #[must_use]
    pub fn new() -> Self {
        Self::default()
    }

    /// A request of its own that also counts as made once this one is: for a part of the work that
    /// can be stopped alone.
    #[must_use]
    pub fn child(&self) -> Self {
        Self(Arc::new(Request { is_made: AtomicBool::new(false), parent: Some(self.clone()) }))
    }

    /// Asks every computation that was given this request to stop. It stays asked.
    pub fn request(&self) {
        self.0.is_made.store(true, Ordering::Relaxed);
    }

    /// Whether somebody asked.
    #[inline]
    #[must_use]
    pub fn is_requested(&self) -> bool {
        self.0.is_made.load(Ordering::Relaxed)
            || self.0.parent.as_ref().is_some_and(Self::is_requested)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_child_follows_its_parent_and_not_the_other_way() {
        let parent = Cancel::new();
        let (one, other) = (parent.child(), parent.child());
        one.request();
        assert!(one.is_requested() && one.clone().is_requested());
        assert!(!parent.is_requested() && !other.is_requested());
        parent.request();
        assert!(other.is_requested());
    }
}
