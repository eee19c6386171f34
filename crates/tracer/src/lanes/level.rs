//! Detects which vector instructions the CPU has, and runs code that is compiled for them.

use fearless_simd::{Level, Simd};

/// Work that any vector instructions can do.
pub(crate) trait Work {
    type Output;

    /// Does it with the instruction set of `s`.
    fn with<S: Simd>(self, s: S) -> Self::Output;
}

/// Does work with the instructions of a level.
pub(crate) fn at_level<W: Work>(level: Level, work: W) -> W::Output {
    #[cfg(target_arch = "x86_64")]
    if let Some(s) = level.as_avx512() {
        with_instructions(s, work)
    } else if let Some(s) = level.as_avx2() {
        with_instructions(s, work)
    } else if let Some(s) = level.as_sse2() {
        with_instructions(s, work)
    } else {
        unreachable!("every x86-64 has SSE2")
    }
    #[cfg(not(target_arch = "x86_64"))]
    fearless_simd::dispatch!(level, s => with_instructions(s, work))
}

/// Lets the compiler use the instructions that `s` proves.
fn with_instructions<S: Simd, W: Work>(s: S, work: W) -> W::Output {
    outlined(
        s,
        #[inline(always)]
        || work.with(s),
    )
}

/// Compiles `work` as a function of its own, with the instructions that `s` proves, rather than into its caller.
///
/// Everything in the SIMD backend is inlined into a few loops per kind of instructions, which is what makes it fast; as
/// one function they would take minutes to compile. Where an uncommon path works on copies of what its caller holds, the
/// common one can keep that in registers.
#[inline(always)]
pub(crate) fn outlined<S: Simd, T>(s: S, work: impl FnOnce() -> T) -> T {
    s.vectorize(work)
}
