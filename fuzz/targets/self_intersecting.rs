//! Runs `welter_kit::fuzz::self_intersecting`.
#![no_main]
libfuzzer_sys::fuzz_target!(|data: &[u8]| welter_kit::fuzz::self_intersecting(data));
