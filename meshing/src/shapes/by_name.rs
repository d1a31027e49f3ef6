//! The shapes by name, as the command offers them: [`by_name`], [`NAMES`].

use super::*;
use crate::surface::ClosedOrientedMesh;

/// A built-in shape and what is known of it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct NamedShape {
    /// Its name.
    pub name: &'static str,
    /// What it is, in one line.
    pub description: &'static str,
    /// Number of components.
    pub components: usize,
    /// Genus of each component.
    pub genus: usize,
    /// Whether triangles intersect in more than the vertices and edges they share.
    pub self_intersecting: bool,
}

const fn shape(
    name: &'static str,
    [components, genus]: [usize; 2],
    self_intersecting: bool,
    description: &'static str,
) -> NamedShape {
    NamedShape { name, description, components, genus, self_intersecting }
}

/// Every shape that [`by_name`] knows.
pub const NAMES: &[NamedShape] = &[
    shape("sphere", [1, 0], false, "geodesic icosahedron of radius 1"),
    shape("two-spheres", [2, 0], false, "two balls of radius 0.2 at a distance of 0.5"),
    shape("torus", [1, 1], false, "torus of radii 1 and 0.4"),
    shape("box", [1, 0], false, "cube of side 2"),
    shape("dumbbell", [1, 0], false, "two balls joined by a thin neck"),
    shape("two-boxes", [2, 0], true, "two cubes whose corners overlap"),
    shape("nested-boxes", [2, 0], false, "a cube in a cube, both oriented outward: winding number 2 inside"),
    shape("box-with-void", [2, 0], false, "a cube in a cube, the inner oriented inward: a hollow"),
    shape("coincident-boxes", [2, 0], true, "two cubes with a common face that each has its own copy of"),
    shape("ring-overlap", [1, 0], true, "a tube bent into a ring whose ends overlap"),
    shape("helix-overlap", [1, 0], true, "a coil whose neighbouring turns overlap"),
    shape("trefoil-overlap", [1, 1], true, "a tube along a flat trefoil knot, overlapping at its crossings"),
    shape("figure-eight", [1, 1], true, "a tube along a figure eight that crosses itself"),
    shape("moebius", [1, 1], false, "a Moebius band of thickness"),
    shape(
        "double-moebius",
        [1, 1],
        true,
        "a Moebius band of thickness that goes twice round and crosses itself",
    ),
    shape("gyroid", [1, 13], false, "a labyrinth of a gyroid, cut by a ball of radius 1"),
    shape("text", [4, 0], false, "a word drawn by a round pen"),
];

/// A shape of [`NAMES`] with its default parameters; `size` replaces the default edge length, which is absolute.
///
/// ```
/// use welter_meshing::shapes::{ShapeError, by_name};
/// assert!(by_name("torus", Some(0.2))?.triangles().len() < by_name("torus", None)?.triangles().len());
/// let error = by_name("tours", None).unwrap_err();
/// assert_eq!(error.to_string(), "no shape is called \"tours\"; did you mean \"torus\"?");
/// # Ok::<(), ShapeError>(())
/// ```
///
/// # Errors
/// [`ShapeError`] for an unknown name, and for a size that is no length or too small.
pub fn by_name(name: &str, size: Option<f64>) -> Result<ClosedOrientedMesh, ShapeError> {
    macro_rules! sized {
        ($generator:ident, $parameters:expr) => {{
            let mut parameters = $parameters;
            parameters.edge_length = size.unwrap_or(parameters.edge_length);
            $generator(&parameters)
        }};
    }
    match name {
        "sphere" => sized!(sphere, Sphere::default()),
        "two-spheres" => sized!(two_spheres, TwoSpheres::default()),
        "torus" => sized!(torus, Torus::default()),
        "box" => sized!(box_, Box_::default()),
        "dumbbell" => sized!(dumbbell, Dumbbell::default()),
        "two-boxes" => sized!(two_boxes, BoxPair::overlapping()),
        "nested-boxes" => sized!(nested_boxes, BoxPair::nested()),
        "box-with-void" => sized!(nested_boxes, BoxPair { second_reversed: true, ..BoxPair::nested() }),
        "coincident-boxes" => sized!(coincident_boxes, BoxPair::coincident()),
        "ring-overlap" => sized!(ring_overlap, RingOverlap::default()),
        "helix-overlap" => sized!(helix_overlap, HelixOverlap::default()),
        "trefoil-overlap" => sized!(trefoil_overlap, TrefoilOverlap::default()),
        "figure-eight" => sized!(figure_eight, FigureEight::default()),
        "moebius" => sized!(moebius, Moebius::default()),
        "double-moebius" => sized!(double_moebius, Moebius::default()),
        "gyroid" => sized!(gyroid_ball, GyroidBall::default()),
        "text" => sized!(text_surface, TextSurface::default()),
        _ => Err(ShapeError::UnknownName { name: name.to_owned(), nearest: nearest(name) }),
    }
}

/// The name with the fewest edits to `name`, if those are few.
fn nearest(name: &str) -> Option<&'static str> {
    let typed: Vec<char> = name.chars().take(40).flat_map(char::to_lowercase).collect();
    let (edits, nearest) = NAMES.iter().map(|shape| (edit_distance(&typed, shape.name), shape.name)).min()?;
    (edits <= nearest.len() / 3 + 1).then_some(nearest)
}

/// Insertions, deletions and substitutions from one to the other.
fn edit_distance(a: &[char], b: &str) -> usize {
    let mut row: Vec<usize> = (0..=a.len()).collect();
    for (j, cb) in b.chars().enumerate() {
        let mut diagonal = row[0];
        row[0] = j + 1;
        for (i, &ca) in a.iter().enumerate() {
            let substituted = diagonal + usize::from(ca != cb);
            diagonal = row[i + 1];
            row[i + 1] = substituted.min(diagonal + 1).min(row[i] + 1);
        }
    }
    row[a.len()]
}
