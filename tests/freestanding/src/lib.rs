//! Static library of hand-written and generated mechanisms that links only without panic paths and allocations.
//!
//! The panic handler calls the symbol `PANIC_PATH`, which is never defined. After `cargo build --release` the
//! library's symbols tell: `nm` must list neither ` U PANIC_PATH` nor an allocator (`__rust_alloc`, `__rdl_alloc`).
//! All inputs come from the caller, so that the compiler cannot evaluate a solve and drop it.
#![no_std]

#[cfg(feature = "generated")]
mod by_hand;
#[cfg(feature = "generated")]
mod forces;
#[cfg(feature = "generated")]
mod given;
#[cfg(feature = "generated")]
mod mechanisms;
#[cfg(feature = "generated")]
mod tables;

unsafe extern "C" {
    #[allow(non_snake_case, reason = "The name is what nm is searched for.")]
    fn PANIC_PATH() -> !;
}

#[panic_handler]
fn panic(_: &core::panic::PanicInfo<'_>) -> ! {
    // SAFETY: the symbol is never defined, so a library that still contains this call does not link.
    unsafe { PANIC_PATH() }
}

/// Index that only the caller knows: a panic path that no optimizer removes.
#[cfg(feature = "planted")]
#[unsafe(no_mangle)]
pub extern "C" fn planted(values: &[f64; 4], index: usize) -> f64 {
    values[index]
}
