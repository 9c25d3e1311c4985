//! The registry: every block type that a graph may use.

use std::sync::{Arc, PoisonError, RwLock};

use super::{About, BlockSpec, MAX_INPUTS, MAX_OUTPUT_PLANES, Shape};
use crate::{
    error::{Error, ErrorKind},
    value::Kind,
};

/// Block types that belong together, such as all noises. Made by [`family!`](crate::family!).
#[derive(Debug, Clone, Copy)]
pub struct Family {
    /// The family's name: its folder.
    pub name: &'static str,
    /// Its block types.
    pub blocks: &'static [&'static BlockSpec],
}

/// Declares the block files of a family; the one line that a new block adds elsewhere.
#[macro_export]
macro_rules! family {
    ($name:literal: $($block:ident),+ $(,)?) => {
        $(mod $block;)+
        /// The family's block types.
        pub static FAMILY: $crate::block::Family =
            $crate::block::Family { name: $name, blocks: &[$(&$block::BLOCK),+] };
    };
}

/// Every block type that a graph may use, by id. Types are added, never removed.
#[derive(Debug, Default)]
pub struct Registry {
    entries: RwLock<Vec<Entry>>,
}

#[derive(Debug, Clone, Copy)]
struct Entry {
    spec: &'static BlockSpec,
    family: &'static str,
}

impl Registry {
    /// A registry of the built-in block types.
    #[must_use]
    pub fn builtin() -> Arc<Self> {
        let registry = Self::default();
        for family in crate::blocks::FAMILIES {
            registry.add(family).expect("ids of built-in block types are unique");
        }
        Arc::new(registry)
    }

    /// Adds block types.
    ///
    /// # Errors
    /// [`ErrorKind::InvalidArgument`] if an id is taken, or a block type has more inputs or outputs
    /// than the engine can serve; then none is added.
    pub fn add(&self, family: &Family) -> Result<(), Error> {
        let mut entries = self.entries.write().unwrap_or_else(PoisonError::into_inner);
        for spec in family.blocks {
            check_ports(spec)?;
            let id = spec.about.id;
            if entries.iter().any(|entry| entry.spec.about.id == id) {
                let message = format!("there is a block type \"{id}\" already");
                return Err(Error::new(ErrorKind::InvalidArgument, message));
            }
        }
        entries.extend(family.blocks.iter().map(|spec| Entry { spec, family: family.name }));
        Ok(())
    }

    /// All block types, by family, each family in its order.
    #[must_use]
    pub fn blocks(&self) -> Vec<&'static BlockSpec> {
        let entries = self.entries.read().unwrap_or_else(PoisonError::into_inner);
        entries.iter().map(|entry| entry.spec).collect()
    }

    /// The block type of that id.
    #[must_use]
    pub fn find(&self, id: &str) -> Option<&'static BlockSpec> {
        let entries = self.entries.read().unwrap_or_else(PoisonError::into_inner);
        entries.iter().map(|entry| entry.spec).find(|spec| spec.about.id == id)
    }

    /// The block type of that id.
    ///
    /// # Errors
    /// [`ErrorKind::NotFound`], with the nearest known id as a hint.
    pub fn get(&self, id: &str) -> Result<&'static BlockSpec, Error> {
        self.find(id).ok_or_else(|| {
            let message = format!("there is no block type \"{id}\"");
            let error = Error::new(ErrorKind::NotFound, message);
            match nearest(id, self.blocks().iter().map(|spec| spec.about.id)) {
                Some(known) => error.with_hint(format!("did you mean \"{known}\"?")),
                None => error.with_hint("`ptc list` shows all; it may come from a plug-in"),
            }
        })
    }

    /// The family of the block type of that id.
    #[must_use]
    pub fn family_of(&self, id: &str) -> Option<&'static str> {
        let entries = self.entries.read().unwrap_or_else(PoisonError::into_inner);
        entries.iter().find(|entry| entry.spec.about.id == id).map(|entry| entry.family)
    }
}

/// Whether the engine has room for the inputs and outputs of a block type.
fn check_ports(spec: &BlockSpec) -> Result<(), Error> {
    let About { id, inputs, outputs, .. } = spec.about;
    let images = outputs.iter().filter(|output| output.kind == Kind::Image);
    let planes: usize = images.map(|output| output.planes.at_most()).sum();
    let too_many = |count: usize, what: &str, allowed: usize| {
        let message = format!("block type \"{id}\" has {count} {what}, allowed {allowed}");
        Err(Error::new(ErrorKind::InvalidArgument, message))
    };
    if inputs.len() > MAX_INPUTS {
        too_many(inputs.len(), "inputs", MAX_INPUTS)
    } else if spec.shape() != Shape::Whole && planes > MAX_OUTPUT_PLANES {
        too_many(planes, "planes of outputs", MAX_OUTPUT_PLANES)
    } else {
        Ok(())
    }
}

/// The candidate that `word` is most likely a misspelling of, if it is near enough to be one.
pub(crate) fn nearest<'a>(
    word: &str,
    candidates: impl Iterator<Item = &'a str>,
) -> Option<&'a str> {
    candidates
        .map(|candidate| (edit_distance(word, candidate), candidate))
        .filter(|(distance, candidate)| *distance <= candidate.chars().count().div_ceil(3))
        .min_by_key(|(distance, _)| *distance)
        .map(|(_, candidate)| candidate)
}

/// Levenshtein's distance; words longer than 64 characters are infinitely far.
fn edit_distance(a: &str, b: &str) -> usize {
    let b: Vec<char> = b.chars().collect();
    if a.chars().count() > 64 || b.len() > 64 {
        return usize::MAX;
    }
    let mut row: Vec<usize> = (0..=b.len()).collect();
    for (i, from) in a.chars().enumerate() {
        let mut diagonal = row[0];
        row[0] = i + 1;
        for (j, to) in b.iter().enumerate() {
            let replaced = diagonal + usize::from(from != *to);
            diagonal = row[j + 1];
            row[j + 1] = replaced.min(diagonal + 1).min(row[j] + 1);
        }
    }
    row[b.len()]
}

#[cfg(test)]
mod tests {
    use super::{
        super::{InputPort, OutputPort, Planes, input, output, prelude::*},
        *,
    };

    params! {
        /// None.
        NoParams {}
    }

    struct Nothing;

    impl PointBlock for Nothing {
        type Params = NoParams;

        fn prepare<L: Levels>(_: &NoParams, _: &PrepareContext<'_>) -> Result<Self, Error> {
            Ok(Self)
        }

        fn row<L: Levels>(&self, _: &RowContext<'_>, _: &InputRows<'_>, _: &mut OutputRow<'_>) {}
    }

    #[test]
    fn a_misspelt_id_gets_a_hint() {
        let ids = ["perlin noise", "simple noise", "mix"];
        assert_eq!(nearest("perlin nose", ids.into_iter()), Some("perlin noise"));
        assert_eq!(nearest("teapot", ids.into_iter()), None);
        assert_eq!(edit_distance("kitten", "sitting"), 3);
    }
    #[test]
    fn block_types_with_too_many_ports_are_refused() {
        const IMAGE: OutputPort = output("image", Planes::As(0));
        const fn block(inputs: &'static [InputPort], outputs: &'static [OutputPort]) -> BlockSpec {
            BlockSpec::point::<Nothing>(About { id: "nothing", inputs, outputs, ..About::DEFAULT })
        }
        static FAMILIES: [(Family, &str); 4] = [
            (Family { name: "a", blocks: &[&block(&[], &[IMAGE; 3])] }, "12 planes"),
            (Family { name: "b", blocks: &[&block(&[PORT; 17], &[IMAGE])] }, "17 inputs"),
            (Family { name: "c", blocks: &[&block(&[PORT; 16], &[IMAGE; 2])] }, ""),
            (Family { name: "d", blocks: &[&block(&[], &[IMAGE])] }, "already"),
        ];
        const PORT: InputPort = input("image", Kind::Image);
        let registry = Registry::default();
        for (family, said) in &FAMILIES {
            let message =
                registry.add(family).map_or_else(|error| error.to_string(), |()| "".into());
            assert!(message.contains(said) && message.is_empty() == said.is_empty(), "{message}");
        }
    }
}
