//! Runs `welter_kit::fuzz::in_spheres`.
#![no_main]
libfuzzer_sys::fuzz_target!(|data: &[u8]| welter_kit::fuzz::in_spheres(data));
