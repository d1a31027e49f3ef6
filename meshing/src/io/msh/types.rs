//! Gmsh's numbers of element types.

use crate::io::CellKind;

/// Gmsh's number of a kind of cell.
pub(super) fn number(kind: CellKind) -> i32 {
    match kind {
        CellKind::Triangle => 2,
        CellKind::Quadrilateral => 3,
        CellKind::Tetrahedron => 4,
        CellKind::Hexahedron => 5,
    }
}

/// What an element of a type is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum ElementType {
    /// A cell that is held.
    Cell(CellKind),
    /// One that is passed over: its number of nodes, and what it is called in the report.
    Other(usize, &'static str),
}

impl ElementType {
    /// The type of a number of Gmsh's, if it is known.
    pub(super) fn of_number(number: i64) -> Option<Self> {
        const HIGHER: &str = "elements of higher order";
        Some(match number {
            2 => Self::Cell(CellKind::Triangle),
            3 => Self::Cell(CellKind::Quadrilateral),
            4 => Self::Cell(CellKind::Tetrahedron),
            5 => Self::Cell(CellKind::Hexahedron),
            1 => Self::Other(2, "line elements"),
            6 => Self::Other(6, "prisms"),
            7 => Self::Other(5, "pyramids"),
            15 => Self::Other(1, "point elements"),
            8 => Self::Other(3, HIGHER),
            9 => Self::Other(6, HIGHER),
            10 | 20 => Self::Other(9, HIGHER),
            11 | 21 => Self::Other(10, HIGHER),
            12 => Self::Other(27, HIGHER),
            13 => Self::Other(18, HIGHER),
            14 => Self::Other(14, HIGHER),
            16 => Self::Other(8, HIGHER),
            17 | 29 => Self::Other(20, HIGHER),
            18 | 23..=24 => Self::Other(15, HIGHER),
            19 => Self::Other(13, HIGHER),
            22 => Self::Other(12, HIGHER),
            25 => Self::Other(21, HIGHER),
            26 => Self::Other(4, HIGHER),
            27 => Self::Other(5, HIGHER),
            28 => Self::Other(6, HIGHER),
            30 => Self::Other(35, HIGHER),
            31 => Self::Other(56, HIGHER),
            36 => Self::Other(16, HIGHER),
            37 => Self::Other(25, HIGHER),
            92 => Self::Other(64, HIGHER),
            93 => Self::Other(125, HIGHER),
            _ => return None,
        })
    }

    /// Number of nodes.
    pub(super) fn nodes(self) -> usize {
        match self {
            Self::Cell(kind) => kind.corners(),
            Self::Other(nodes, _) => nodes,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_of_cells_are_known_both_ways() {
        for kind in CellKind::ALL {
            assert_eq!(ElementType::of_number(i64::from(number(kind))), Some(ElementType::Cell(kind)));
        }
    }
}
