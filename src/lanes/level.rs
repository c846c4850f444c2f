//! Vector instructions: which of them a hot loop is compiled for, and which copy is run.
//!
//! `dispatch!` compiles an expression once for each level and runs the copy for the widest one that
//! the CPU has. No copy fuses or reorders an operation, so all give the same bits; only the speed
//! differs. Whatever the expression calls must be marked `#[inline(always)]`, closures too: what is not
//! inlined is compiled for the baseline and measured up to eight times slower.

use std::sync::atomic::{AtomicU8, Ordering};

#[cfg(any(test, not(any(target_arch = "x86_64", target_arch = "aarch64", target_feature = "simd128"))))]
use fearless_simd::Fallback;
#[cfg(target_arch = "aarch64")]
use fearless_simd::Neon as Baseline;
#[cfg(target_feature = "simd128")]
use fearless_simd::WasmSimd128 as Baseline;
#[cfg(target_arch = "x86_64")]
use fearless_simd::{Avx2, Avx512, Sse2 as Baseline};

#[cfg(not(any(target_arch = "x86_64", target_arch = "aarch64", target_feature = "simd128")))]
type Baseline = Fallback;

/// A set of vector instructions that hot loops are compiled for, narrowest first.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Level {
    /// One number at a time.
    #[cfg(test)]
    Scalar,
    /// What every CPU of the target has: SSE2, NEON, SIMD128 of WebAssembly, or nothing.
    Baseline,
    /// x86-64-v3.
    Avx2,
    /// AVX-512 as Ice Lake and Zen 4 have it.
    Avx512,
}

/// The widest level that may be used.
static LIMIT: AtomicU8 = AtomicU8::new(Level::Avx512 as u8);

impl Level {
    /// The levels that this CPU has, narrowest first.
    pub fn available() -> Vec<Self> {
        let all = [
            #[cfg(test)]
            Self::Scalar,
            Self::Baseline,
            Self::Avx2,
            Self::Avx512,
        ];
        all.into_iter().filter(|&level| Token::up_to(level as u8).level() == level).collect()
    }

    /// From now on, uses no wider level than this one in the whole process. No result depends on it;
    /// it is there to test that, and to measure what a level is worth.
    pub fn limit(self) {
        LIMIT.store(self as u8, Ordering::Relaxed);
    }
}

/// Proof that the CPU has a level.
#[derive(Clone, Copy)]
pub(crate) enum Token {
    #[cfg(target_arch = "x86_64")]
    Avx512(Avx512),
    Narrow(Narrow),
}

/// Proof that the CPU has a level of at most 256 bits.
#[derive(Clone, Copy)]
pub(crate) enum Narrow {
    #[cfg(target_arch = "x86_64")]
    Avx2(Avx2),
    Baseline(Baseline),
    #[cfg(test)]
    Scalar(Fallback),
}

impl Token {
    /// The widest level that the CPU has and [`Level::limit`] allows.
    #[inline]
    pub(crate) fn widest() -> Self {
        Self::up_to(LIMIT.load(Ordering::Relaxed))
    }

    fn up_to(limit: u8) -> Self {
        #[cfg(target_arch = "x86_64")]
        if limit >= Level::Avx512 as u8
            && let Some(avx512) = fearless_simd::Level::new().as_avx512()
        {
            return Self::Avx512(avx512);
        }
        Self::Narrow(Narrow::up_to(limit))
    }

    fn level(self) -> Level {
        match self {
            #[cfg(target_arch = "x86_64")]
            Self::Avx512(_) => Level::Avx512,
            #[cfg(target_arch = "x86_64")]
            Self::Narrow(Narrow::Avx2(_)) => Level::Avx2,
            Self::Narrow(Narrow::Baseline(_)) => Level::Baseline,
            #[cfg(test)]
            Self::Narrow(Narrow::Scalar(_)) => Level::Scalar,
        }
    }
}

impl Narrow {
    /// The widest level of at most 256 bits that the CPU has and [`Level::limit`] allows.
    #[inline]
    pub(crate) fn widest() -> Self {
        Self::up_to(LIMIT.load(Ordering::Relaxed))
    }

    #[cfg_attr(
        not(any(test, target_arch = "x86_64")),
        expect(unused_variables, reason = "the only level of the target is its baseline")
    )]
    fn up_to(limit: u8) -> Self {
        #[cfg(test)]
        if limit == Level::Scalar as u8 {
            return Self::Scalar(Fallback::new());
        }
        #[cfg(target_arch = "x86_64")]
        if limit >= Level::Avx2 as u8
            && let Some(avx2) = fearless_simd::Level::new().as_avx2()
        {
            return Self::Avx2(avx2);
        }
        Self::Baseline(baseline())
    }
}

/// The instructions that every CPU of the target has.
#[inline]
fn baseline() -> Baseline {
    #[cfg(target_arch = "x86_64")]
    let baseline = fearless_simd::Level::baseline().as_sse2().expect("every x86-64 has SSE2");
    #[cfg(target_arch = "aarch64")]
    let baseline = fearless_simd::Level::baseline().as_neon().expect("every AArch64 has NEON");
    #[cfg(target_feature = "simd128")]
    let baseline =
        fearless_simd::Level::baseline().as_wasm_simd128().expect("the target was said to have SIMD128");
    #[cfg(not(any(target_arch = "x86_64", target_arch = "aarch64", target_feature = "simd128")))]
    let baseline = Fallback::new();
    baseline
}

/// `dispatch!(simd => f(simd, …))` evaluates `f` with the widest vectors that the CPU has. `simd` is
/// the token from which vectors are made; its type, and so the vectors' width, differs from copy to copy.
macro_rules! dispatch {
    ($simd:pat => $work:expr) => {
        match $crate::lanes::level::Token::widest() {
            #[cfg(target_arch = "x86_64")]
            $crate::lanes::level::Token::Avx512(token) => {
                $crate::lanes::level::with_token!(token, $simd => $work)
            }
            $crate::lanes::level::Token::Narrow(narrow) => {
                $crate::lanes::level::dispatch_narrow!(narrow, $simd => $work)
            }
        }
    };
}

/// `dispatch_plain!(f(…))` evaluates `f`, whose loops over numbers the compiler turns into vectors by
/// itself, with at most 256 bits: for AVX-512, what it makes of plain loops measured twice as slow as
/// for AVX2.
macro_rules! dispatch_plain {
    ($work:expr) => {{
        let narrow = $crate::lanes::level::Narrow::widest();
        $crate::lanes::level::dispatch_narrow!(narrow, _ => $work)
    }};
}

macro_rules! dispatch_narrow {
    ($narrow:expr, $simd:pat => $work:expr) => {
        match $narrow {
            #[cfg(target_arch = "x86_64")]
            $crate::lanes::level::Narrow::Avx2(token) => {
                $crate::lanes::level::with_token!(token, $simd => $work)
            }
            $crate::lanes::level::Narrow::Baseline(token) => {
                $crate::lanes::level::with_token!(token, $simd => $work)
            }
            #[cfg(test)]
            $crate::lanes::level::Narrow::Scalar(token) => {
                $crate::lanes::level::with_token!(token, $simd => $work)
            }
        }
    };
}

macro_rules! with_token {
    ($token:ident, $simd:pat => $work:expr) => {{
        let $simd = $token;
        fearless_simd::Simd::vectorize(
            $token,
            #[inline(always)]
            || $work,
        )
    }};
}

pub(crate) use {dispatch, dispatch_narrow, dispatch_plain, with_token};

#[cfg(test)]
impl Level {
    /// Calls `f` with each level that the CPU has, widest first, while nothing wider is used. One caller
    /// after the other.
    pub(crate) fn for_each(mut f: impl FnMut(Self)) {
        static ALONE: std::sync::Mutex<()> = std::sync::Mutex::new(());
        let _alone = ALONE.lock();
        let widest = LIMIT.load(Ordering::Relaxed);
        for level in Self::available().into_iter().rev() {
            level.limit();
            f(level);
        }
        LIMIT.store(widest, Ordering::Relaxed);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_limit_chooses_the_copy_and_none_that_the_cpu_lacks() {
        let available = Level::available();
        assert_eq!(available[..2], [Level::Scalar, Level::Baseline]);
        for &level in &available {
            assert_eq!(Token::up_to(level as u8).level(), level);
        }
        let widest = Token::up_to(u8::MAX).level();
        assert_eq!(Some(&widest), available.last());
    }

    #[test]
    fn every_copy_computes() {
        let mut numbers = [1.0, 2.0, 3.0];
        dispatch_plain!(numbers.iter_mut().for_each(|n| *n *= 2.0));
        let sum: f64 = dispatch!(_ => numbers.iter().sum());
        assert_eq!(sum.to_bits(), 12.0_f64.to_bits());
    }
}
