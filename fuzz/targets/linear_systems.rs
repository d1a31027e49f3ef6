//! Runs `welter_kit::fuzz::linear_systems`.
#![no_main]
libfuzzer_sys::fuzz_target!(|data: &[u8]| welter_kit::fuzz::linear_systems(data));
