//! Runs `welter_kit::fuzz::read_off`.
#![no_main]
libfuzzer_sys::fuzz_target!(|data: &[u8]| welter_kit::fuzz::read_off(data));
