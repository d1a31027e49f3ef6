//! Runs `welter_kit::fuzz::patch_parity`.
#![no_main]
libfuzzer_sys::fuzz_target!(|data: &[u8]| welter_kit::fuzz::patch_parity(data));
