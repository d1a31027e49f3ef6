//! Bodies of the fuzz targets: any bytes in, a panic if an answer is wrong.
//!
//! The targets in `fuzz/` call these under libFuzzer. The tests below run the same bodies on a fixed byte stream and on
//! the inputs stored in `tests/kit/corpus/<body>/`, which holds what a fuzzer once found and seeds worth starting from.

mod collisions;
mod determinants;
mod intersections;
mod isosurfaces;
mod linear;
mod meshes;
mod moved;
mod parities;
mod patches;
mod perturbation;
mod queries;
mod spacetime;
mod time_of_impact;

pub use collisions::{
    check_edge_edge, check_vertex_face, check_vertex_segment, edge_edge_collisions, vertex_face_collisions,
    vertex_segment_collisions,
};
pub use determinants::{in_spheres, orientations};
pub use intersections::{boxes, simplices};
pub use isosurfaces::isosurfaces;
pub use linear::{agrees, linear_systems};
pub use meshes::{read_obj, read_off, read_ply, read_stl, self_intersecting};
pub use moved::moved_grid;
pub use parities::root_parities;
pub use patches::patch_parity;
pub use perturbation::perturbed;
pub use queries::read_queries;
pub use spacetime::spacetime_collisions;
pub use time_of_impact::time_of_impact;

/// A fuzz body: takes any bytes, panics if something is wrong.
pub type Body = fn(&[u8]);

/// Every body with its name, which is also the name of its fuzz target and of its corpus folder.
pub const BODIES: &[(&str, Body)] = &[
    ("boxes", boxes),
    ("edge_edge_collisions", edge_edge_collisions),
    ("in_spheres", in_spheres),
    ("isosurfaces", isosurfaces),
    ("linear_systems", linear_systems),
    ("moved_grid", moved_grid),
    ("orientations", orientations),
    ("patch_parity", patch_parity),
    ("perturbed", perturbed),
    ("read_obj", read_obj),
    ("read_off", read_off),
    ("read_ply", read_ply),
    ("read_queries", read_queries),
    ("read_stl", read_stl),
    ("root_parities", root_parities),
    ("self_intersecting", self_intersecting),
    ("simplices", simplices),
    ("spacetime_collisions", spacetime_collisions),
    ("time_of_impact", time_of_impact),
    ("vertex_face_collisions", vertex_face_collisions),
    ("vertex_segment_collisions", vertex_segment_collisions),
];

#[cfg(test)]
mod tests {
    use super::*;
    use crate::entropy::stream;
    use std::{fs, path::Path};

    /// Runs on the fixed stream for each body.
    const RUNS: u64 = 1200;

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
