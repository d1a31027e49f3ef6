//! Runs `welter_kit::fuzz::read_medit_volume`.
#![no_main]
libfuzzer_sys::fuzz_target!(|data: &[u8]| welter_kit::fuzz::read_medit_volume(data));
