#![no_main]

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| {
    let _ = linkwright_fuzz::expressions::run(bytes);
});
