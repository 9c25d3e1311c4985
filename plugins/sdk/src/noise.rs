//! The host's random numbers: by place, not by order, and the same in every plug-in.

use ptlib_plugin_abi::services::{PTLP_NOISE, ptlp_noise};

use crate::host::service;

fn table() -> &'static ptlp_noise {
    service(PTLP_NOISE).expect("noise comes from the host, inside of its calls")
}

/// 32 random bits of a seed and three numbers, such as an item, a part of it and a channel.
///
/// # Panics
/// Outside of a call of the host.
#[must_use]
pub fn hash(seed: u64, item: u32, part: u32, channel: u32) -> u32 {
    let hash = table().hash.expect("the host has it");
    // SAFETY: the contract; it takes any numbers.
    unsafe { hash(seed, item, part, channel) }
}

/// A number of [0, 1): the upper 24 bits of [`hash`].
///
/// # Panics
/// Outside of a call of the host.
#[must_use]
pub fn uniform(seed: u64, item: u32, part: u32, channel: u32) -> f32 {
    let uniform = table().uniform.expect("the host has it");
    // SAFETY: the contract; it takes any numbers.
    unsafe { uniform(seed, item, part, channel) }
}

/// The noise that the blocks of PT Designer draw from, uniform on (-1, 1].
///
/// # Panics
/// Outside of a call of the host.
#[must_use]
pub fn elias(index: i32) -> f64 {
    let elias = table().elias.expect("the host has it");
    // SAFETY: the contract; it takes any number.
    unsafe { elias(index) }
}
