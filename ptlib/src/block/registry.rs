//! The registry: every block type that a graph may use.

use std::{
    path::PathBuf,
    sync::{Arc, PoisonError, RwLock},
};

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

/// A loaded plug-in.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct PluginInfo {
    /// Its id: the vendor of its blocks, perhaps followed by a point and a word.
    pub id: String,
    /// What people call it.
    pub name: String,
    /// Who made it.
    pub vendor: String,
    /// Its version.
    pub version: String,
    /// The SPDX expression of its licence.
    pub license: String,
    /// The compiler that built it, if it says so.
    pub built_with: String,
    /// Its file; `None` for one that is linked into the program.
    pub path: Option<PathBuf>,
}

impl PluginInfo {
    /// Its file, or where else it is, for messages.
    #[must_use]
    pub fn place(&self) -> String {
        match &self.path {
            Some(path) => path.display().to_string(),
            None => format!("plug-in \"{}\", which is linked into the program", self.id),
        }
    }
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
    plugin: Option<&'static PluginInfo>,
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
        let blocks = family.blocks.iter();
        self.extend(blocks.map(|spec| Entry { spec, family: family.name, plugin: None }).collect())
    }

    /// Adds the block types of a plug-in, each with the name of its family. Adding the same ones
    /// again changes nothing.
    ///
    /// # Errors
    /// [`ErrorKind::PluginDuplicate`] if another plug-in, or the library, has a block type of the
    /// same id, and as [`add`](Self::add); then none is added.
    pub(crate) fn add_plugin(
        &self,
        plugin: &'static PluginInfo,
        blocks: &[(&'static str, &'static BlockSpec)],
    ) -> Result<(), Error> {
        if self.plugins().iter().any(|known| std::ptr::eq(*known, plugin)) {
            return Ok(());
        }
        let blocks = blocks.iter();
        let entries = blocks.map(|(family, spec)| Entry { spec, family, plugin: Some(plugin) });
        self.extend(entries.collect())
    }

    fn extend(&self, new: Vec<Entry>) -> Result<(), Error> {
        let mut entries = self.entries.write().unwrap_or_else(PoisonError::into_inner);
        for entry in &new {
            check_ports(entry.spec)?;
            let id = entry.spec.about.id;
            if let Some(known) = entries.iter().find(|known| known.spec.about.id == id) {
                return Err(duplicate(known, entry));
            }
        }
        entries.extend(new);
        Ok(())
    }

    /// The plug-ins whose block types it has, in the order in which they came.
    #[must_use]
    pub fn plugins(&self) -> Vec<&'static PluginInfo> {
        let entries = self.entries.read().unwrap_or_else(PoisonError::into_inner);
        let mut plugins: Vec<_> = entries.iter().filter_map(|entry| entry.plugin).collect();
        plugins.dedup_by(|a, b| std::ptr::eq(*a, *b));
        plugins
    }

    /// The plug-in that the block type of that id comes from.
    #[must_use]
    pub fn plugin_of(&self, id: &str) -> Option<&'static PluginInfo> {
        let entries = self.entries.read().unwrap_or_else(PoisonError::into_inner);
        entries.iter().find(|entry| entry.spec.about.id == id)?.plugin
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

/// The error for two block types of one id.
fn duplicate(known: &Entry, new: &Entry) -> Error {
    let id = known.spec.about.id;
    let message = format!("there is a block type \"{id}\" already");
    let (kind, message) = match (known.plugin, new.plugin) {
        (_, None) => (ErrorKind::InvalidArgument, message),
        (None, Some(_)) => (ErrorKind::PluginDuplicate, format!("{message}, built in")),
        (Some(known), Some(new)) => (
            ErrorKind::PluginDuplicate,
            format!("{message}, from {}; {} is not used", known.place(), new.place()),
        ),
    };
    Error::new(kind, message)
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
