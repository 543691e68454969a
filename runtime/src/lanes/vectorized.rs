//! Runs code with the widest instruction set of the machine.

/// Runs work with the instruction set that the compiler was told to use.
#[cfg(not(feature = "simd"))]
#[inline(always)]
pub fn vectorized<R>(work: impl FnOnce() -> R) -> R {
    work()
}

/// Runs work with the widest instruction set of the machine. Only code that is inlined into it uses that.
#[cfg(feature = "simd")]
#[inline(always)]
pub fn vectorized<R>(work: impl FnOnce() -> R) -> R {
    use fearless_simd::{Level, Simd, dispatch};

    dispatch!(Level::new(), simd => simd.vectorize(work))
}
