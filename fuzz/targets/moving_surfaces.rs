//! Runs `welter_kit::fuzz::moving_surfaces`.
#![no_main]
libfuzzer_sys::fuzz_target!(|data: &[u8]| welter_kit::fuzz::moving_surfaces(data));
