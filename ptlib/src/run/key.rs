//! Keys of results: a hash of everything that a result depends on.

use std::sync::atomic::{AtomicU64, Ordering};

use crate::{
    block::BlockSpec,
    math::levels::Precision,
    params::{ParamKind, ParamValue},
};

/// What a result depends on, as 256 bits. The hash is cryptographic: graph files are untrusted, and
/// two results with one key would show one in place of the other.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Key([u8; 32]);

/// Collects what a result depends on. Every part is written with its length, so that no two
/// different lists give the same bytes.
pub(super) struct KeyBuilder(blake3::Hasher);

impl Key {
    /// The key of a block's result without its inputs and files.
    pub(super) fn of_block(
        spec: &BlockSpec,
        values: &[ParamValue],
        seed: u64,
        (width, height): (u32, u32),
        precision: Precision,
    ) -> KeyBuilder {
        let mut builder = KeyBuilder(blake3::Hasher::new());
        builder.bytes(spec.about.id.as_bytes());
        builder.number(if spec.about.uses_seed { seed } else { 0 });
        builder.number(u64::from(width) << 32 | u64::from(height));
        builder.number(u64::from(precision == Precision::Float));
        for (spec, value) in spec.params.iter().zip(values) {
            // A path counts by the contents of its file.
            if !matches!(spec.kind, ParamKind::Path(_)) {
                builder.value(value);
            }
        }
        builder
    }

    /// The key of a block that cannot be computed: nothing is kept under it.
    pub(super) fn of_failure(handle: u64) -> Self {
        let mut builder = KeyBuilder(blake3::Hasher::new());
        builder.bytes(b"failure");
        builder.number(handle);
        builder.finish()
    }

    #[cfg(test)]
    pub(super) fn of_bytes(bytes: &[u8]) -> Self {
        let mut builder = KeyBuilder(blake3::Hasher::new());
        builder.bytes(bytes);
        builder.finish()
    }

    /// The key of output `output` of the block of this key, reduced `supersampling` times.
    pub(super) fn of_output(&self, output: usize, supersampling: u32) -> Self {
        let mut builder = KeyBuilder(blake3::Hasher::new());
        builder.key(Some(self));
        builder.number(output as u64);
        builder.number(u64::from(supersampling));
        builder.finish()
    }
}

impl KeyBuilder {
    fn number(&mut self, number: u64) {
        self.0.update(&number.to_le_bytes());
    }

    /// Makes the key another one than any before it.
    pub(super) fn never_again(&mut self) {
        static NEXT: AtomicU64 = AtomicU64::new(0);
        self.bytes(b"never again");
        self.number(NEXT.fetch_add(1, Ordering::Relaxed));
    }

    pub(super) fn bytes(&mut self, bytes: &[u8]) {
        self.number(bytes.len() as u64);
        self.0.update(bytes);
    }

    /// The key of an input, or that there is none.
    pub(super) fn key(&mut self, key: Option<&Key>) {
        match key {
            Some(key) => self.bytes(&key.0),
            None => self.number(0),
        }
    }

    fn value(&mut self, value: &ParamValue) {
        match value {
            ParamValue::Int(value) => self.bytes(&value.to_le_bytes()),
            ParamValue::Float(value) => self.number(value.to_bits()),
            ParamValue::Bool(value) => self.number(u64::from(*value)),
            ParamValue::Choice(value) => self.number(u64::from(*value)),
            ParamValue::Text(text) => self.bytes(text.as_bytes()),
        }
    }

    pub(super) fn finish(self) -> Key {
        Key(*self.0.finalize().as_bytes())
    }
}
