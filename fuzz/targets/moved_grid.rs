//! Runs `welter_kit::fuzz::moved_grid`.
#![no_main]
libfuzzer_sys::fuzz_target!(|data: &[u8]| welter_kit::fuzz::moved_grid(data));
