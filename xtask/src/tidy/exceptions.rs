//! The exceptions from the limits, each with its reason: the one place where they are listed.
//!
//! An exception that nothing needs any more is a fault itself.

use super::{Fault, Rule};

/// One permitted fault.
pub(super) struct Exception {
    rule: Rule,
    path: &'static str,
    /// What the fault is about (a function, a macro); empty for every fault of that rule there.
    item: &'static str,
    /// Why the limit is wrong here.
    reason: &'static str,
}

/// All exceptions.
pub(super) const EXCEPTIONS: &[Exception] = &[
    Exception {
        rule: Rule::LineLength,
        path: "ptlib/src/params/declare.rs",
        item: "",
        reason: "a macro pattern is one line, so that it reads like the declaration it matches",
    },
    Exception {
        rule: Rule::LineLength,
        path: "plugins/sdk/src/params.rs",
        item: "",
        reason: "a macro pattern is one line, so that it reads like the declaration it matches",
    },
    Exception {
        rule: Rule::Macro,
        path: "plugins/sdk/src/params.rs",
        item: "param_kind",
        reason: "a part of params!, which would be too long with it",
    },
    Exception {
        rule: Rule::Macro,
        path: "plugins/sdk/src/parts.rs",
        item: "tuple_parts",
        reason: "a trait for tuples of every length, which Rust cannot write one implementation of",
    },
    Exception {
        rule: Rule::Macro,
        path: "plugins/sdk/src/export.rs",
        item: "export_plugin",
        reason: "exports a static of the plug-in's own crate, which no function can",
    },
    Exception {
        rule: Rule::Macro,
        path: "plugins/abi/src/envelope.rs",
        item: "export_root_module",
        reason: "exports a static of the plug-in's own crate, which no function can",
    },
    Exception {
        rule: Rule::Layers,
        path: "ptlib/src/block/registry.rs",
        item: "blocks::FAMILIES",
        reason: "the registry is where the list of built-in blocks enters; nothing else sees it",
    },
    Exception {
        rule: Rule::Macro,
        path: "ptlib/src/block/shapes.rs",
        item: "row_shape",
        reason: "two traits with the same methods, which Rust cannot write one factory over",
    },
    Exception {
        rule: Rule::LineLength,
        path: "ptlib/src/block/shapes.rs",
        item: "",
        reason: "a macro pattern is one line, so that it reads like the call it matches",
    },
    Exception {
        rule: Rule::Parameters,
        path: "ptlib/src/run/nodes.rs",
        item: "resolve_one",
        reason: "the step of a loop, which borrows what the loop collects",
    },
    Exception {
        rule: Rule::Layers,
        path: "ptlib/src/blocks/noise/lattice/mod.rs",
        item: "value",
        reason: "shared by blocks, and built on the resampling that value has for it",
    },
    Exception {
        rule: Rule::Layers,
        path: "ptlib/src/blocks/noise/lattice/octave.rs",
        item: "value",
        reason: "shared by blocks, and built on the resampling that value has for it",
    },
    Exception {
        rule: Rule::Layers,
        path: "ptlib/src/blocks/noise/lattice/blurred.rs",
        item: "math::levels::EightBit",
        reason: "it exists in that precision only, whatever the precision of its caller",
    },
];

/// The faults that no exception permits, and the exceptions that permit nothing.
pub(super) fn apply(faults: Vec<Fault>, exceptions: &[Exception]) -> Vec<Fault> {
    let mut used = vec![false; exceptions.len()];
    let mut rest: Vec<Fault> = faults
        .into_iter()
        .filter(|fault| {
            let found = exceptions.iter().position(|exception| exception.permits(fault));
            if let Some(place) = found {
                used[place] |= !fault.is_soft;
            }
            found.is_none()
        })
        .collect();
    for (exception, _) in exceptions.iter().zip(used).filter(|(_, used)| !used) {
        let message = format!(
            "xtask/src/tidy/exceptions.rs permits {:?} here, which nothing needs ({})",
            exception.rule, exception.reason
        );
        rest.push(Fault::new(Rule::Exceptions, exception.path, 1, exception.item, message));
    }
    rest
}

impl Exception {
    fn permits(&self, fault: &Fault) -> bool {
        let is_about = self.item.is_empty() || self.item == fault.item;
        self.rule == fault.rule && self.path == fault.path && is_about
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const LONG: Exception =
        Exception { rule: Rule::FunctionLength, path: "a.rs", item: "long", reason: "because" };

    fn fault(item: &str) -> Fault {
        Fault::new(Rule::FunctionLength, "a.rs", 7, item, String::new())
    }

    #[test]
    fn an_exception_permits_one_thing() {
        let rest = apply(vec![fault("long"), fault("other")], &[LONG]);
        assert_eq!(rest.len(), 1);
        assert_eq!(rest[0].item, "other");
    }

    #[test]
    fn an_exception_that_nothing_needs_is_a_fault() {
        let rest = apply(vec![fault("other")], &[LONG]);
        assert_eq!(rest[1].rule, Rule::Exceptions);
        assert!(rest[1].message.contains("because"));
    }
}
