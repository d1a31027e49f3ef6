//! Runs `welter_kit::fuzz::vertex_face_collisions`.
#![no_main]
libfuzzer_sys::fuzz_target!(|data: &[u8]| welter_kit::fuzz::vertex_face_collisions(data));
