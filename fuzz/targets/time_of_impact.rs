//! Runs `welter_kit::fuzz::time_of_impact`.
#![no_main]
libfuzzer_sys::fuzz_target!(|data: &[u8]| welter_kit::fuzz::time_of_impact(data));
