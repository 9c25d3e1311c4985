//! A loop, compiled for several levels of the CPU and picked at run time.
//!
//! A plug-in is compiled for any CPU of its architecture, which computes few numbers at once. A
//! [`Kernel`] is plain code over slices; [`run`] calls a copy of it that was compiled for what this
//! CPU has. Copies never differ in their results: none has fused multiply-add, and the compiler
//! does not reorder floating-point arithmetic.

/// Work to be compiled for each level. Write [`run`](Kernel::run) with `#[inline(always)]`, and
/// everything hot that it calls: only inlined code is compiled for the level.
pub trait Kernel {
    /// What the work gives.
    type Output;
    /// Does the work.
    fn run(self) -> Self::Output;
}

/// Does the work with the best instructions of this CPU.
#[inline]
pub fn run<K: Kernel>(kernel: K) -> K::Output {
    #[cfg(target_arch = "x86_64")]
    {
        if has_avx512() {
            // SAFETY: the CPU said that it has each feature that the function enables.
            return unsafe { run_avx512(kernel) };
        }
        if is_x86_feature_detected!("avx2") {
            // SAFETY: the CPU said that it has AVX2.
            return unsafe { run_avx2(kernel) };
        }
    }
    kernel.run()
}

#[cfg(target_arch = "x86_64")]
fn has_avx512() -> bool {
    is_x86_feature_detected!("avx2")
        && is_x86_feature_detected!("avx512f")
        && is_x86_feature_detected!("avx512bw")
        && is_x86_feature_detected!("avx512dq")
        && is_x86_feature_detected!("avx512vl")
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

#[cfg(test)]
mod tests {
    use super::*;

    struct Slopes<'a>(&'a [f32], &'a mut [f32]);

    impl Kernel for Slopes<'_> {
        type Output = ();

        #[inline(always)]
        fn run(self) {
            for (out, x) in self.1.iter_mut().zip(self.0) {
                // A fused multiply-add would round once where this rounds twice.
                *out = 1.0 / (*x * *x + 1.1).sqrt() * 0.7 + *x;
            }
        }
    }

    #[test]
    fn levels_do_not_matter() {
        let numbers: Vec<f32> = (0..1000_u16).map(|i| f32::from(i).sqrt() - 15.0).collect();
        let [mut plain, mut best] = [vec![0.0; 1000], vec![0.0; 1000]];
        Slopes(&numbers, &mut plain).run();
        run(Slopes(&numbers, &mut best));
        let bits = |numbers: &[f32]| numbers.iter().map(|x| x.to_bits()).collect::<Vec<_>>();
        assert_eq!(bits(&plain), bits(&best));
        #[cfg(target_arch = "x86_64")]
        if is_x86_feature_detected!("avx2") {
            // SAFETY: the CPU said that it has AVX2.
            unsafe { run_avx2(Slopes(&numbers, &mut best)) };
            assert_eq!(bits(&plain), bits(&best));
        }
    }
}
