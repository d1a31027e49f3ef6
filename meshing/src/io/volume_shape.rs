//! What can be asked of a volumetric mesh from a file: its connected parts, its boundary, its tags.

use std::collections::BTreeMap;

use super::{CellKind, VolumeData};
use crate::surface::TriangleSoup;
use crate::surface::topology::union_find::UnionFind;

/// The sides of a hexahedron, each counterclockwise from outside; bit `k` of a corner is its coordinate along axis `k`.
const SIDES_OF_HEXAHEDRON: [[usize; 4]; 6] =
    [[0, 4, 6, 2], [1, 3, 7, 5], [0, 1, 5, 4], [2, 6, 7, 3], [0, 2, 3, 1], [4, 5, 7, 6]];
/// The sides of a tetrahedron of positive volume, each counterclockwise from outside.
const SIDES_OF_TETRAHEDRON: [[usize; 3]; 4] = [[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]];

/// The cells of a tag.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct TaggedCells {
    /// Name of the field that holds the tag.
    pub field: String,
    /// Dimension of the cells: 3 or 2.
    pub dimension: usize,
    /// The tag.
    pub tag: i64,
    /// The name of the group, if it has one.
    pub name: Option<String>,
    /// Number of cells; 0 for a group that has none.
    pub cells: usize,
}

impl VolumeData {
    /// Kind and corners of each cell, in their order.
    fn cells(&self) -> impl Iterator<Item = (CellKind, &[u32])> {
        let hexahedra = self.hexahedra.iter().map(|cell| (CellKind::Hexahedron, &cell[..]));
        let tetrahedra = self.tetrahedra.iter().map(|cell| (CellKind::Tetrahedron, &cell[..]));
        let quadrilaterals = self.quadrilaterals.iter().map(|cell| (CellKind::Quadrilateral, &cell[..]));
        let triangles = self.triangles.iter().map(|cell| (CellKind::Triangle, &cell[..]));
        hexahedra.chain(tetrahedra).chain(quadrilaterals).chain(triangles)
    }

    /// Number of connected parts, of cells that share vertices; vertices without cells are none.
    ///
    /// # Panics
    /// If a corner is out of range, which readers refuse.
    ///
    /// ```
    /// use welter_meshing::{DVec3, io::VolumeData};
    /// let mesh = VolumeData {
    ///     positions: vec![DVec3::ZERO; 9],
    ///     triangles: vec![[0, 1, 2], [3, 4, 5], [5, 6, 7]],
    ///     ..VolumeData::default()
    /// };
    /// assert_eq!(mesh.part_count(), 2);
    /// ```
    #[must_use]
    pub fn part_count(&self) -> usize {
        let mut sets = UnionFind::new(self.positions.len());
        let mut used = vec![false; self.positions.len()];
        for (_, corners) in self.cells() {
            corners.iter().for_each(|&corner| used[corner as usize] = true);
            corners.windows(2).for_each(|pair| sets.unite(pair[0], pair[1]));
        }
        (0..used.len()).filter(|&vertex| used[vertex] && sets.root(vertex as u32) == vertex as u32).count()
    }

    /// The sides of hexahedra and tetrahedra that no other has, turned outward, as triangles; of a mesh without either, its
    /// quadrilaterals and triangles. Vertices are those of the boundary alone, in their order; triangles with a repeated corner are
    /// left out.
    ///
    /// Method: sides sorted by their corners, a number of times odd. Complexity: O(n log n).
    ///
    /// # Panics
    /// If a corner is out of range, which readers refuse.
    ///
    /// ```
    /// use welter_meshing::{DVec3, io::VolumeData};
    /// let mesh = VolumeData {
    ///     positions: vec![DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::Z, -DVec3::Z],
    ///     tetrahedra: vec![[0, 1, 2, 3], [0, 2, 1, 4]],
    ///     ..VolumeData::default()
    /// };
    /// assert_eq!(mesh.boundary().triangles.len(), 6);
    /// ```
    #[must_use]
    pub fn boundary(&self) -> TriangleSoup {
        let mut sides: Vec<([u32; 4], [u32; 4])> = Vec::new();
        // A triangle has its last corner twice, and the largest number in its key.
        let mut push = |corners: [u32; 4], is_triangle: bool| {
            let mut key = corners;
            if is_triangle {
                key[3] = u32::MAX;
            }
            key.sort_unstable();
            sides.push((key, corners));
        };
        for cell in &self.hexahedra {
            SIDES_OF_HEXAHEDRON.iter().for_each(|side| push(side.map(|corner| cell[corner]), false));
        }
        for cell in &self.tetrahedra {
            SIDES_OF_TETRAHEDRON
                .iter()
                .for_each(|&[a, b, c]| push([cell[a], cell[b], cell[c], cell[c]], true));
        }
        if sides.is_empty() {
            return self.triangulated(
                self.quadrilaterals
                    .iter()
                    .copied()
                    .chain(self.triangles.iter().map(|&[a, b, c]| [a, b, c, c])),
            );
        }
        // Stable, so that the first of several with the same corners stays.
        sides.sort_by_key(|side| side.0);
        let odd = sides.chunk_by(|a, b| a.0 == b.0).filter(|same| same.len() % 2 == 1);
        self.triangulated(odd.map(|same| same[0].1))
    }

    /// Sides as triangles, where a triangle has its last corner twice.
    fn triangulated(&self, sides: impl Iterator<Item = [u32; 4]>) -> TriangleSoup {
        let mut triangles: Vec<[u32; 3]> = Vec::new();
        for [a, b, c, d] in sides {
            let halves = [[a, b, c], [c, d, a]];
            triangles.extend(halves.into_iter().filter(|[a, b, c]| a != b && b != c && c != a));
        }
        let mut used: Vec<u32> = triangles.as_flattened().to_vec();
        used.sort_unstable();
        used.dedup();
        let number = |vertex: u32| used.binary_search(&vertex).unwrap_or(0) as u32; // all are there
        let triangles = triangles.iter().map(|corners| corners.map(number)).collect();
        let positions = used.iter().map(|&vertex| self.positions[vertex as usize]).collect();
        TriangleSoup { positions, triangles, ..TriangleSoup::default() }
    }

    /// How many cells have each tag of the fields of integers that `is_tag` picks or that groups name, and the names of the groups.
    /// Tag 0 stands for none, unless a group has it.
    ///
    /// ```
    /// use welter_meshing::{DVec3, io::{DataField, VolumeData}};
    /// let mesh = VolumeData {
    ///     positions: vec![DVec3::ZERO; 3],
    ///     triangles: vec![[0, 1, 2]; 3],
    ///     cell_fields: vec![DataField::new("body", 1, vec![7, 0, 7])],
    ///     ..VolumeData::default()
    /// };
    /// let tagged = mesh.tagged_cells(|field| field == "body");
    /// assert_eq!((tagged.len(), tagged[0].tag, tagged[0].cells), (1, 7, 2));
    /// ```
    #[must_use]
    pub fn tagged_cells(&self, is_tag: impl Fn(&str) -> bool) -> Vec<TaggedCells> {
        let mut found: BTreeMap<(&str, usize, i64), (Option<&str>, usize)> = BTreeMap::new();
        for group in &self.groups {
            let key = (&*group.field, group.dimension, i64::from(group.tag));
            found.entry(key).or_default().0.get_or_insert(&group.name);
        }
        let named = |name: &str| self.groups.iter().any(|group| group.field == name);
        let fields = self.cell_fields.iter().filter(|field| {
            field.components == 1 && field.values.is_integer() && (is_tag(&field.name) || named(&field.name))
        });
        for field in fields {
            for (place, (kind, _)) in self.cells().enumerate() {
                let Some(tag) = field.values.integer(place) else { continue };
                let key = (&*field.name, kind.dimension(), tag);
                match found.get_mut(&key) {
                    Some(known) => known.1 += 1,
                    None if tag != 0 => _ = found.insert(key, (None, 1)),
                    None => {}
                }
            }
        }
        let tagged = found.into_iter().map(|((field, dimension, tag), (name, cells))| TaggedCells {
            field: field.to_owned(),
            dimension,
            tag,
            name: name.map(str::to_owned),
            cells,
        });
        tagged.collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::DVec3;
    use crate::io::{CellGroup, DataField};

    /// Six times the volume that triangles enclose.
    fn enclosed(soup: &TriangleSoup) -> f64 {
        let corners = |triangle: &[u32; 3]| triangle.map(|v| soup.positions[v as usize]);
        soup.triangles.iter().map(corners).map(|[a, b, c]| a.dot(b.cross(c))).sum()
    }

    #[test]
    fn boundaries_enclose_their_cells() {
        let corner = |c: u32| DVec3::new(f64::from(c & 1), f64::from(c >> 1 & 1), f64::from(c >> 2));
        let mut mesh = VolumeData {
            positions: (0..8).map(corner).collect(),
            hexahedra: vec![[0, 1, 2, 3, 4, 5, 6, 7]],
            ..VolumeData::default()
        };
        assert_eq!((mesh.boundary().triangles.len(), enclosed(&mesh.boundary())), (12, 6.0));
        // Another beside it, and faces of the boundary, which count for nothing.
        mesh.positions.extend((0..4).map(|k| corner(2 * k + 1) + DVec3::X));
        mesh.hexahedra.push([1, 8, 3, 9, 5, 10, 7, 11]);
        mesh.quadrilaterals.push([0, 4, 6, 2]);
        assert_eq!((mesh.boundary().triangles.len(), enclosed(&mesh.boundary())), (20, 12.0));
        assert_eq!(mesh.part_count(), 1);
        let tetrahedron = VolumeData {
            positions: vec![DVec3::ZERO, DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::Z],
            tetrahedra: vec![[1, 2, 3, 4]],
            ..VolumeData::default()
        };
        assert_eq!((tetrahedron.boundary().positions.len(), enclosed(&tetrahedron.boundary())), (4, 1.0));
    }

    #[test]
    fn plane_cells_are_their_own_boundary() {
        let mesh = VolumeData {
            positions: vec![DVec3::ZERO; 6],
            quadrilaterals: vec![[1, 2, 3, 4], [1, 1, 2, 3]],
            triangles: vec![[3, 4, 5]],
            ..VolumeData::default()
        };
        assert_eq!(mesh.boundary().triangles, [[0, 1, 2], [2, 3, 0], [1, 2, 0], [2, 3, 4]]);
        assert_eq!(mesh.part_count(), 1);
    }

    #[test]
    fn cells_of_tags_are_counted_by_dimension() {
        let group = |name: &str, dimension, tag| CellGroup {
            name: name.to_owned(),
            field: "a".to_owned(),
            dimension,
            tag,
        };
        let mesh = VolumeData {
            positions: vec![DVec3::ZERO; 4],
            tetrahedra: vec![[0, 1, 2, 3]],
            triangles: vec![[0, 1, 2]; 3],
            cell_fields: vec![DataField::new("a", 1, vec![1, 1, 2, 2]), DataField::new("b", 1, vec![5; 4])],
            groups: vec![group("in", 2, 1), group("none", 3, 9)],
            ..VolumeData::default()
        };
        let of = |is_tag: fn(&str) -> bool| -> Vec<_> {
            let tagged = mesh.tagged_cells(is_tag).into_iter();
            tagged.map(|t| (t.field, t.dimension, t.tag, t.name, t.cells)).collect()
        };
        let cells = |dimension, tag, name: Option<&str>, count| {
            ("a".to_owned(), dimension, tag, name.map(str::to_owned), count)
        };
        let expected = [
            cells(2, 1, Some("in"), 1),
            cells(2, 2, None, 2),
            cells(3, 1, None, 1),
            cells(3, 9, Some("none"), 0),
        ];
        assert_eq!(of(|_| false), expected);
        assert_eq!(of(|name| name == "b").len(), 6);
    }
}
