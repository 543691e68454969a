//! Hashes of groups of lanes in WebAssembly, which the part `webassembly` of `.ci/run` compares with those of this machine.

mod hash;

use hash::hash;

linkwright::include_mechanism! {
    #[allow(dead_code)]
    mod four_bar_f64;
}
linkwright::include_mechanism! {
    #[allow(dead_code)]
    mod excavator_f64;
}
linkwright::include_mechanism! {
    #[allow(dead_code)]
    mod four_bar_f32;
}

/// Returns the hash of eight four-bars.
#[unsafe(no_mangle)]
pub extern "C" fn four_bar_f64() -> u64 {
    hash::<four_bar_f64::Loops, 8>()
}

/// Returns the hash of eight excavators.
#[unsafe(no_mangle)]
pub extern "C" fn excavator_f64() -> u64 {
    hash::<excavator_f64::Loops, 8>()
}

/// Returns the hash of sixteen four-bars in f32.
#[unsafe(no_mangle)]
pub extern "C" fn four_bar_f32() -> u64 {
    hash::<four_bar_f32::Loops, 16>()
}
