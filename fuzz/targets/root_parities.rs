//! Runs `welter_kit::fuzz::root_parities`.
#![no_main]
libfuzzer_sys::fuzz_target!(|data: &[u8]| welter_kit::fuzz::root_parities(data));
