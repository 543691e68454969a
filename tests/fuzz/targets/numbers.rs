#![no_main]

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| linkwright_fuzz::numbers::run(bytes));
