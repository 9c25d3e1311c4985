//! The host's transcendental functions: the same bits on every platform, which those of the
//! platform do not give.

use ptlib_plugin_abi::services::{PTLP_MATH, ptlp_math};

use crate::host::service;

fn table() -> &'static ptlp_math {
    service(PTLP_MATH).expect("mathematics come from the host, inside of its calls")
}

/// The nearest number of single precision.
#[inline(always)]
#[must_use]
#[expect(clippy::cast_possible_truncation, reason = "that is what it is for")]
pub fn single(x: f64) -> f32 {
    x as f32
}

/// Sine of an angle in radians.
///
/// # Panics
/// Outside of a call of the host.
#[must_use]
pub fn sin(x: f64) -> f64 {
    let function = table().sin.expect("the host has it");
    // SAFETY: the contract; it takes any numbers.
    unsafe { function(x) }
}

/// Cosine of an angle in radians.
///
/// # Panics
/// Outside of a call of the host.
#[must_use]
pub fn cos(x: f64) -> f64 {
    let function = table().cos.expect("the host has it");
    // SAFETY: the contract; it takes any numbers.
    unsafe { function(x) }
}

/// Tangent of an angle in radians.
///
/// # Panics
/// Outside of a call of the host.
#[must_use]
pub fn tan(x: f64) -> f64 {
    let function = table().tan.expect("the host has it");
    // SAFETY: the contract; it takes any numbers.
    unsafe { function(x) }
}

/// Angle in radians whose sine is `x`.
///
/// # Panics
/// Outside of a call of the host.
#[must_use]
pub fn asin(x: f64) -> f64 {
    let function = table().asin.expect("the host has it");
    // SAFETY: the contract; it takes any numbers.
    unsafe { function(x) }
}

/// Angle in radians whose cosine is `x`.
///
/// # Panics
/// Outside of a call of the host.
#[must_use]
pub fn acos(x: f64) -> f64 {
    let function = table().acos.expect("the host has it");
    // SAFETY: the contract; it takes any numbers.
    unsafe { function(x) }
}

/// Angle in radians whose tangent is `x`.
///
/// # Panics
/// Outside of a call of the host.
#[must_use]
pub fn atan(x: f64) -> f64 {
    let function = table().atan.expect("the host has it");
    // SAFETY: the contract; it takes any numbers.
    unsafe { function(x) }
}

/// Angle in radians of the point (`x`, `y`).
///
/// # Panics
/// Outside of a call of the host.
#[must_use]
pub fn atan2(y: f64, x: f64) -> f64 {
    let function = table().atan2.expect("the host has it");
    // SAFETY: the contract; it takes any numbers.
    unsafe { function(y, x) }
}

/// e to the power `x`.
///
/// # Panics
/// Outside of a call of the host.
#[must_use]
pub fn exp(x: f64) -> f64 {
    let function = table().exp.expect("the host has it");
    // SAFETY: the contract; it takes any numbers.
    unsafe { function(x) }
}

/// 2 to the power `x`.
///
/// # Panics
/// Outside of a call of the host.
#[must_use]
pub fn exp2(x: f64) -> f64 {
    let function = table().exp2.expect("the host has it");
    // SAFETY: the contract; it takes any numbers.
    unsafe { function(x) }
}

/// Natural logarithm of `x`.
///
/// # Panics
/// Outside of a call of the host.
#[must_use]
pub fn log(x: f64) -> f64 {
    let function = table().log.expect("the host has it");
    // SAFETY: the contract; it takes any numbers.
    unsafe { function(x) }
}

/// Logarithm of `x` to the base 2.
///
/// # Panics
/// Outside of a call of the host.
#[must_use]
pub fn log2(x: f64) -> f64 {
    let function = table().log2.expect("the host has it");
    // SAFETY: the contract; it takes any numbers.
    unsafe { function(x) }
}

/// `x` to the power `y`.
///
/// # Panics
/// Outside of a call of the host.
#[must_use]
pub fn pow(x: f64, y: f64) -> f64 {
    let function = table().pow.expect("the host has it");
    // SAFETY: the contract; it takes any numbers.
    unsafe { function(x, y) }
}

/// Hyperbolic tangent of `x`.
///
/// # Panics
/// Outside of a call of the host.
#[must_use]
pub fn tanh(x: f64) -> f64 {
    let function = table().tanh.expect("the host has it");
    // SAFETY: the contract; it takes any numbers.
    unsafe { function(x) }
}

/// Cube root of `x`.
///
/// # Panics
/// Outside of a call of the host.
#[must_use]
pub fn cbrt(x: f64) -> f64 {
    let function = table().cbrt.expect("the host has it");
    // SAFETY: the contract; it takes any numbers.
    unsafe { function(x) }
}
