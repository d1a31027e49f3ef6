//! Runs `welter_kit::fuzz::spacetime_collisions`.
#![no_main]
libfuzzer_sys::fuzz_target!(|data: &[u8]| welter_kit::fuzz::spacetime_collisions(data));
