//! Groups of the surface on the boundary of a volumetric mesh: [`Groups`].

use welter_meshing::DVec3;
use welter_meshing::surface::{ClosedOrientedMesh, TriId};
use welter_meshing::volumetric::Hosts;

/// The name for triangles of no group.
const REST: &str = "surface";

/// The groups of a surface, numbered from 1 on; groups of the same name are one.
#[derive(Debug)]
pub(super) struct Groups {
    pub(super) names: Vec<String>,
    /// The number of each triangle.
    tags: Vec<i32>,
}

impl Groups {
    pub(super) fn of(surface: &ClosedOrientedMesh) -> Self {
        let mut names: Vec<String> = Vec::new();
        let mut tags = vec![0; surface.triangles().len()];
        for group in surface.groups() {
            let tag = tag_of(&mut names, &group.name);
            tags[group.triangles.start as usize..group.triangles.end as usize].fill(tag);
        }
        if tags.contains(&0) {
            let rest = tag_of(&mut names, REST);
            tags.iter_mut().filter(|tag| **tag == 0).for_each(|tag| *tag = rest);
        }
        Self { names, tags }
    }

    /// The group of the triangle nearest to a point among those that pass through a hexahedron; 0 where none does.
    pub(super) fn nearest(
        &self,
        surface: &ClosedOrientedMesh,
        hosts: &Hosts,
        hexahedron: u32,
        point: DVec3,
    ) -> i32 {
        let triangles = hosts.in_hexahedron(hexahedron).iter().map(|pair| pair[1] as usize);
        let mut found: Option<(f64, i32)> = None;
        for triangle in triangles {
            let tag = self.tags[triangle];
            // Distances only where they matter.
            if found.is_some_and(|(_, other)| other == tag) && self.names.len() == 1 {
                break;
            }
            let distance = distance_squared(point, surface.corners(TriId::from_index(triangle)));
            if found.is_none_or(|(least, _)| distance < least) {
                found = Some((distance, tag));
            }
        }
        found.map_or(0, |(_, tag)| tag)
    }
}

fn tag_of(names: &mut Vec<String>, name: &str) -> i32 {
    let known = names.iter().position(|known| known == name);
    let index = known.unwrap_or_else(|| {
        names.push(name.to_owned());
        names.len() - 1
    });
    i32::try_from(index + 1).unwrap_or(i32::MAX)
}

/// Squared distance of a point to a triangle, rounded.
fn distance_squared(p: DVec3, [a, b, c]: [DVec3; 3]) -> f64 {
    let to_edge = |a: DVec3, b: DVec3| {
        let (along, from) = (b - a, p - a);
        let length = along.length_squared();
        let t = if length > 0.0 { (from.dot(along) / length).clamp(0.0, 1.0) } else { 0.0 };
        (from - along * t).length_squared()
    };
    let normal = (b - a).cross(c - a);
    let is_beside = |a: DVec3, b: DVec3| normal.cross(b - a).dot(p - a) >= 0.0;
    let edges = to_edge(a, b).min(to_edge(b, c)).min(to_edge(c, a));
    if normal != DVec3::ZERO && is_beside(a, b) && is_beside(b, c) && is_beside(c, a) {
        let height = normal.dot(p - a);
        edges.min(height * height / normal.length_squared())
    } else {
        edges
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn distances_to_a_triangle() {
        let triangle = [DVec3::ZERO, DVec3::X, DVec3::Y];
        let distance = |x, y, z| distance_squared(DVec3::new(x, y, z), triangle);
        assert_eq!(distance(0.25, 0.25, 2.0), 4.0);
        assert_eq!(distance(-1.0, 0.0, 0.0), 1.0);
        assert_eq!(distance(0.5, -3.0, 0.0), 9.0);
        assert_eq!(distance(1.0, 1.0, 0.0), 0.5);
        let needle = [DVec3::ZERO; 3];
        assert_eq!(distance_squared(DVec3::Z, needle), 1.0);
    }
}
