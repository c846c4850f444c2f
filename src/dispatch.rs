//! Runs a piece of work with the widest vector instructions that the machine has.
//!
//! The work is compiled twice from the same plain loops, once for the baseline and once for AVX2.
//! Neither copy fuses or reorders an operation, so both give the same bits (a test compares them);
//! only the speed differs. This is the one module with `unsafe`: calling a function that was
//! compiled for AVX2 is sound only on a CPU that has it, which is checked right before the call.
#![expect(unsafe_code, reason = "see the module's first lines")]

/// A piece of work with its input. A trait and not a closure, because only a method marked
/// `#[inline(always)]` is sure to be compiled into the copy for AVX2.
pub(crate) trait Work {
    /// Does the work. Implementations and their hot callees are `#[inline(always)]`.
    fn run(self);
}

/// Tests set it to compare the two copies.
#[cfg(test)]
pub(crate) static BASELINE_ONLY: std::sync::atomic::AtomicBool = std::sync::atomic::AtomicBool::new(false);

/// Runs `work`, compiled for AVX2 where the CPU has it.
#[inline]
pub(crate) fn dispatch(work: impl Work) {
    #[cfg(test)]
    if BASELINE_ONLY.load(std::sync::atomic::Ordering::Relaxed) {
        return work.run();
    }
    #[cfg(target_arch = "x86_64")]
    if std::arch::is_x86_feature_detected!("avx2") {
        // SAFETY: the CPU was just found to have AVX2, the only feature that `avx2` adds.
        unsafe { avx2(work) };
        return;
    }
    work.run();
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx2")]
fn avx2(work: impl Work) {
    work.run();
}
