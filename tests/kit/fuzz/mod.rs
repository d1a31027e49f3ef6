//! Bodies of the fuzz targets: any bytes in, a panic if an answer is wrong.
//!
//! The targets in `fuzz/` call these under libFuzzer. The tests below run the same bodies on a fixed byte stream and on
//! the inputs stored in `tests/kit/corpus/<body>/`, which holds what a fuzzer once found and seeds worth starting from.

mod determinants;

pub use determinants::{in_spheres, orientations};

/// A fuzz body: takes any bytes, panics if something is wrong.
pub type Body = fn(&[u8]);

/// Every body with its name, which is also the name of its fuzz target and of its corpus folder.
pub const BODIES: &[(&str, Body)] = &[("in_spheres", in_spheres), ("orientations", orientations)];

#[cfg(test)]
mod tests {
    use super::*;
    use crate::entropy::stream;
    use std::{fs, path::Path};

    /// Runs on the fixed stream for each body.
    const RUNS: u64 = 3000;

    #[test]
    fn bodies_hold_on_a_fixed_stream() {
        for (name, body) in BODIES {
            for seed in 0..RUNS {
                // Short and empty inputs too: generators must end when bytes run out.
                let length = usize::try_from(seed % 61).expect("small") * 12;
                let bytes = stream(seed, length);
                let outcome = std::panic::catch_unwind(|| body(&bytes));
                assert!(outcome.is_ok(), "{name} fails on stream({seed}, {length})");
            }
        }
    }

    #[test]
    fn bodies_hold_on_the_stored_inputs() {
        let corpus = Path::new(env!("CARGO_MANIFEST_DIR")).join("kit/corpus");
        for folder in fs::read_dir(corpus).unwrap().map(Result::unwrap) {
            let name = folder.file_name().into_string().unwrap();
            let (_, body) =
                BODIES.iter().find(|(known, _)| *known == name).expect("a folder is named after a body");
            let inputs: Vec<_> = fs::read_dir(folder.path()).unwrap().map(Result::unwrap).collect();
            assert!(!inputs.is_empty(), "{name} has no stored input");
            for input in inputs {
                let bytes = fs::read(input.path()).unwrap();
                let outcome = std::panic::catch_unwind(|| body(&bytes));
                assert!(outcome.is_ok(), "{name} fails on {}", input.path().display());
            }
        }
    }
}
