//! Numbers: the only home of transcendental functions, hashes, random numbers, rounding and SIMD
//! dispatch.
//!
//! Everything here gives the same bits on every platform. IEEE addition, multiplication, division,
//! square root and rounding do that by themselves; the rest is computed by the polynomials of
//! [`elementary`] (in `f32`, made to be vectorised) or by the `libm` crate (in `f64`, for numbers
//! that are computed once). Nothing is ever fused or reordered.

pub mod convert;
pub mod decimal;
pub mod elementary;
pub mod elias;
pub mod hash;
pub mod levels;
pub mod ray;
pub mod simd;
mod tangent;
