//! Writes the table of marching cubes: all 256 cases, by the convex-hull rule.
//!
//! The rule \[Bhaniramka04\], with tetrahedra \[Gagniere22\] (1.2.2, 2.5.1, figure 2.13): put a sample in the middle of every edge of the cell whose
//! ends have different signs. The region of a case is the convex hull of its samples and negative corners; the facets of
//! the hull that do not lie on faces of the cell are the surface.
//!
//! Which tetrahedra: the cones from the lowest negative corner over the facets that do not hold it. Samples will not stay in the middle, and flat
//! facets of four and six corners can be cut into triangles in several ways; taken is the first way for which every
//! tetrahedron has a positive volume *wherever the samples are on their edges*. That is decided exactly: the volume is affine in the place of each
//! sample, so over all places it is least where each sample is at one of its two ends, and the ends are integers.
//! In every case there is such a way, or the build fails.

#![allow(clippy::print_stdout, reason = "that is how a build script speaks to cargo")]

#[path = "../src/isosurface/cell.rs"]
mod cell;
mod cube;
mod emit;
mod hull;

fn main() {
    println!("cargo:rerun-if-changed=build");
    println!("cargo:rerun-if-changed=src/isosurface/cell.rs");
    let cases: Vec<cube::Case> = (0..=255).map(cube::Case::of).collect();
    let folder = std::env::var_os("OUT_DIR").expect("cargo tells where to write");
    let path = std::path::Path::new(&folder).join("marching_cubes.rs");
    std::fs::write(&path, emit::tables(&cases)).expect("cargo's folder can be written");
}
