//! Surfaces whose components were turned inside out by mistake: [`outward`].

use crate::spatial::{Winding, WindingNumbers};
use crate::surface::measure::inside_out_components;
use crate::surface::{ClosedOrientedMesh, Topology, TriId, TriMesh, TriangleSoup};
use crate::{Cancelled, Monitor};

/// Turns each component of negative volume that is no wall of a void: the other components do not contain it whole.
///
/// Returns the surface, its triangles and vertices in their order, and the components that were turned, as indices into
/// [`Topology::components`]. A component with a vertex around which the others do not wind, or the other way, is not contained; that is decided exactly.
///
/// ```
/// use welter_meshing::{Monitor, shapes, volumetric::outward};
/// let ball = shapes::by_name("sphere", None)?.reversed();
/// assert_eq!(outward(&ball, &Monitor::none())?.1, [0]);
/// // The wall of a void stays as it is.
/// let hollow = shapes::by_name("box-with-void", None)?;
/// assert_eq!(outward(&hollow, &Monitor::none())?.1, []);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// [`Cancelled`] by the monitor.
pub fn outward(
    surface: &ClosedOrientedMesh,
    monitor: &Monitor<'_>,
) -> Result<(ClosedOrientedMesh, Vec<usize>), Cancelled> {
    let topology = Topology::of(surface);
    let mut turned = Vec::new();
    for component in inside_out_components(surface, &topology) {
        monitor.check()?;
        let others = without(surface, &topology, component);
        let numbers = WindingNumbers::new(&others);
        let ids = topology.component_triangles(component);
        let outside = ids.iter().flat_map(|t| surface.corners(*t)).any(|p| match numbers.at(p) {
            Winding::Number(number) => number < 1,
            Winding::OnSurface { .. } | Winding::NotFinite => false,
        });
        if outside {
            turned.push(component);
        }
    }
    let mut soup = surface.to_soup();
    for (t, triangle) in soup.triangles.iter_mut().enumerate() {
        if turned.binary_search(&topology.component_of(TriId::from_index(t))).is_ok() {
            triangle.swap(1, 2);
        }
    }
    Ok((closed(soup), turned))
}

/// The surface without a component.
fn without(surface: &ClosedOrientedMesh, topology: &Topology, component: usize) -> ClosedOrientedMesh {
    let mut soup = TriangleSoup { positions: surface.positions().to_vec(), ..TriangleSoup::default() };
    let ids = (0..surface.triangles().len()).map(TriId::from_index);
    let others = ids.filter(|&t| topology.component_of(t) != component);
    soup.triangles = others.map(|t| surface.triangles()[t.index()].map(|v| v.0)).collect();
    closed(soup)
}

/// Whole components of a closed oriented mesh, some of them turned, are one.
fn closed(soup: TriangleSoup) -> ClosedOrientedMesh {
    let mesh = TriMesh::new(soup).expect("the positions and indices are those of a mesh");
    ClosedOrientedMesh::by_construction(mesh)
}
