//! Runs a piece of work with the widest vector instructions that the machine has.
//!
//! The work is compiled twice from the same plain loops, once for the baseline and once for AVX2.
//! Neither copy fuses or reorders an operation, so both give the same bits (a test compares them);
//! only the speed differs. This is the one module with `unsafe`: calling a function that was
//! compiled for AVX2 is sound only on a CPU that has it, which is checked right before the call.
#![expect(unsafe_code, reason = "see the module's first lines")]

/// Calls `work`, compiled for AVX2 where the CPU has it.
///
/// Only what is inlined into `work` is compiled twice: mark hot callees `#[inline(always)]`.
#[inline]
pub(crate) fn dispatch<R>(work: impl FnOnce() -> R) -> R {
    #[cfg(target_arch = "x86_64")]
    if std::arch::is_x86_feature_detected!("avx2") {
        // SAFETY: the CPU was just found to have AVX2, the only feature that `avx2` adds.
        return unsafe { avx2(work) };
    }
    work()
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx2")]
fn avx2<R>(work: impl FnOnce() -> R) -> R {
    work()
}
