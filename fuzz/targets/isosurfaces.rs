//! Runs `welter_kit::fuzz::isosurfaces`.
#![no_main]
libfuzzer_sys::fuzz_target!(|data: &[u8]| welter_kit::fuzz::isosurfaces(data));
