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
mod moving;
#[cfg(test)]
mod mutate;
mod parities;
mod patches;
mod perturbation;
mod queries;
mod spacetime;
mod time_of_impact;
mod trickle;
mod volumes;

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
pub use moving::moving_surfaces;
pub use parities::root_parities;
pub use patches::patch_parity;
pub use perturbation::perturbed;
pub use queries::read_queries;
pub use spacetime::spacetime_collisions;
pub use time_of_impact::time_of_impact;
pub use volumes::{read_medit_volume, read_msh_volume, read_vtu_volume};

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
    ("moving_surfaces", moving_surfaces),
    ("orientations", orientations),
    ("patch_parity", patch_parity),
    ("perturbed", perturbed),
    ("read_medit_volume", read_medit_volume),
    ("read_msh_volume", read_msh_volume),
    ("read_obj", read_obj),
    ("read_off", read_off),
    ("read_ply", read_ply),
    ("read_queries", read_queries),
    ("read_stl", read_stl),
    ("read_vtu_volume", read_vtu_volume),
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
    use std::fs;
    use std::path::{Path, PathBuf};

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

    /// Runs on changed inputs for each reader; a variable asks for more.
    const MUTANTS: u64 = 1500;

    /// A stored input and its file.
    type Stored = (PathBuf, Vec<u8>);

    /// The stored inputs of each body that has any, by name of the file.
    fn corpus() -> Vec<(String, Body, Vec<Stored>)> {
        let corpus = Path::new(env!("CARGO_MANIFEST_DIR")).join("kit/corpus");
        let mut found = Vec::new();
        for folder in fs::read_dir(corpus).unwrap().map(Result::unwrap) {
            let name = folder.file_name().into_string().unwrap();
            let (_, body) =
                BODIES.iter().find(|(known, _)| *known == name).expect("a folder is named after a body");
            let mut files: Vec<PathBuf> =
                fs::read_dir(folder.path()).unwrap().map(|file| file.unwrap().path()).collect();
            files.sort();
            assert!(!files.is_empty(), "{name} has no stored input");
            found.push((
                name,
                *body,
                files.into_iter().map(|file| (file.clone(), fs::read(file).unwrap())).collect(),
            ));
        }
        found
    }

    #[test]
    fn bodies_hold_on_the_stored_inputs() {
        for (name, body, inputs) in corpus() {
            for (file, bytes) in inputs {
                let outcome = std::panic::catch_unwind(|| body(&bytes));
                assert!(outcome.is_ok(), "{name} fails on {}", file.display());
            }
        }
    }

    #[test]
    fn readers_hold_on_changed_inputs() {
        let runs = std::env::var("WELTER_MUTANTS").map_or(MUTANTS, |text| text.parse().unwrap());
        for (name, body, inputs) in corpus().into_iter().filter(|(name, ..)| name.starts_with("read_")) {
            for seed in 0..runs {
                let [(file, input), (_, other)] =
                    [seed, seed / 7].map(|k| &inputs[usize::try_from(k).expect("small") % inputs.len()]);
                let bytes = mutate::mutated(input, other, seed);
                let outcome = std::panic::catch_unwind(|| body(&bytes));
                assert!(outcome.is_ok(), "{name} fails on {} changed by {seed}", file.display());
            }
        }
    }
}
