//! One kernel, compiled for several levels of the CPU and picked at run time.
//!
//! A [`Kernel`] is plain code over slices that the compiler vectorises. [`SimdLevel::run`] calls a
//! copy of it that was compiled for the level. Levels never differ in their results: no level
//! enables fused multiply-add, and the compiler does not reorder floating-point arithmetic.
//!
//! Rejected: hand-written intrinsics per level (one copy per level to keep equal), and compiling
//! the whole crate for a newer CPU (the library must start on any x86-64).
#![allow(
    unsafe_code,
    reason = "calling a function compiled for a CPU feature is unsafe until the feature is proven"
)]

/// Work to be compiled for each level. Implement [`run`](Kernel::run) with `#[inline(always)]`,
/// and everything hot that it calls: only inlined code is compiled for the level.
pub trait Kernel {
    /// What the work gives.
    type Output;
    /// Does the work.
    fn run(self) -> Self::Output;
}

/// A level of SIMD instructions that this CPU has. Values are made by asking the CPU only, so
/// holding one proves that its instructions may be used.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct SimdLevel(Level);

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Level {
    Baseline,
    #[cfg(target_arch = "x86_64")]
    Avx2,
    #[cfg(target_arch = "x86_64")]
    Avx512,
}

impl SimdLevel {
    /// What every CPU of this architecture has.
    pub const BASELINE: Self = Self(Level::Baseline);

    /// The best level of this CPU.
    #[must_use]
    pub fn best() -> Self {
        Self::available().last().copied().unwrap_or(Self::BASELINE)
    }

    /// All levels of this CPU, slowest first.
    #[must_use]
    pub fn available() -> Vec<Self> {
        #[cfg_attr(not(target_arch = "x86_64"), expect(unused_mut, reason = "one level there"))]
        let mut levels = vec![Self::BASELINE];
        #[cfg(target_arch = "x86_64")]
        {
            if is_x86_feature_detected!("avx2") {
                levels.push(Self(Level::Avx2));
            }
            if is_x86_feature_detected!("avx2")
                && is_x86_feature_detected!("avx512f")
                && is_x86_feature_detected!("avx512bw")
                && is_x86_feature_detected!("avx512dq")
                && is_x86_feature_detected!("avx512vl")
            {
                levels.push(Self(Level::Avx512));
            }
        }
        levels
    }

    /// The level's name: `baseline`, `avx2` or `avx512`.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self.0 {
            Level::Baseline => "baseline",
            #[cfg(target_arch = "x86_64")]
            Level::Avx2 => "avx2",
            #[cfg(target_arch = "x86_64")]
            Level::Avx512 => "avx512",
        }
    }

    /// Runs the copy of `kernel` that was compiled for this level.
    #[inline]
    pub fn run<K: Kernel>(self, kernel: K) -> K::Output {
        match self.0 {
            Level::Baseline => kernel.run(),
            #[cfg(target_arch = "x86_64")]
            // SAFETY: a value with `Level::Avx2` is made in `available` only, after the CPU said
            // that it has AVX2.
            Level::Avx2 => unsafe { run_avx2(kernel) },
            #[cfg(target_arch = "x86_64")]
            // SAFETY: a value with `Level::Avx512` is made in `available` only, after the CPU said
            // that it has each feature that `run_avx512` enables.
            Level::Avx512 => unsafe { run_avx512(kernel) },
        }
    }
}

/// Asks for the memory of `values`, to read it soon: for those that lie where a CPU does not look
/// for them by itself. Does nothing where a CPU cannot do that.
#[inline(always)]
pub fn fetch_to_read(values: &[f32]) {
    /// Values of a cache line.
    #[cfg(target_arch = "x86_64")]
    const LINE: usize = 16;
    #[cfg(target_arch = "x86_64")]
    for line in values.chunks(LINE) {
        use std::arch::x86_64::{_MM_HINT_T0, _mm_prefetch};
        // SAFETY: a hint about an address, whatever lies there. It changes nothing.
        unsafe { _mm_prefetch::<_MM_HINT_T0>(line.as_ptr().cast()) };
    }
    #[cfg(not(target_arch = "x86_64"))]
    let _ = values;
}

/// Asks for the memory of `values`, to write it soon. Does nothing where a CPU cannot do that.
#[inline(always)]
pub fn fetch_to_write<T>(values: &[T]) {
    /// Bytes of a cache line.
    #[cfg(target_arch = "x86_64")]
    const LINE: usize = 64;
    #[cfg(target_arch = "x86_64")]
    for line in values.chunks(const { LINE / if size_of::<T>() > 1 { size_of::<T>() } else { 1 } })
    {
        // The intrinsic becomes a prefetch for reading unless the whole crate is compiled for CPUs
        // that have this instruction; those that have not take it for no operation.
        // SAFETY: a hint about an address, whatever lies there. It changes nothing.
        unsafe {
            std::arch::asm!("prefetchw [{}]", in(reg) line.as_ptr(),
                options(nostack, preserves_flags, readonly));
        }
    }
    #[cfg(not(target_arch = "x86_64"))]
    let _ = values;
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx2")]
fn run_avx2<K: Kernel>(kernel: K) -> K::Output {
    kernel.run()
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx2,avx512f,avx512bw,avx512dq,avx512vl")]
fn run_avx512<K: Kernel>(kernel: K) -> K::Output {
    kernel.run()
}
