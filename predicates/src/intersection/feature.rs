//! Features of primitives (vertex, edge, interior) and where two primitives touch: [`Contact`].

/// The part of a segment on which a point lies.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum SegmentFeature {
    /// End 0 or 1.
    Vertex(u8),
    /// Strictly between the ends.
    Interior,
}

/// The part of a triangle on which a point lies.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum TriangleFeature {
    /// Vertex 0, 1 or 2.
    Vertex(u8),
    /// Strictly between the ends of edge `i`, which joins the vertices `i` and `(i + 1) % 3`.
    Edge(u8),
    /// Strictly inside.
    Interior,
}

/// A point common to two primitives, named by the feature of each on which it lies.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Contact<A, B> {
    /// Feature of the first operand.
    pub a: A,
    /// Feature of the second operand.
    pub b: B,
}

impl<A, B> Contact<A, B> {
    pub(super) fn new(a: A, b: B) -> Self {
        Self { a, b }
    }

    /// The same point, told to the operands in the other order.
    pub fn swapped(self) -> Contact<B, A> {
        Contact { a: self.b, b: self.a }
    }
}

impl TriangleFeature {
    /// The smallest feature whose closure contains both: that of the open segment between their points.
    #[must_use]
    pub fn join(self, other: Self) -> Self {
        // By the set of vertices; edge `i` is the one without vertex `i + 2`.
        match self.vertices() | other.vertices() {
            0b001 => Self::Vertex(0),
            0b010 => Self::Vertex(1),
            0b100 => Self::Vertex(2),
            0b011 => Self::Edge(0),
            0b110 => Self::Edge(1),
            0b101 => Self::Edge(2),
            _ => Self::Interior,
        }
    }

    /// The vertices of the feature's closure, one bit each.
    fn vertices(self) -> u8 {
        match self {
            Self::Vertex(i) => 1 << i,
            Self::Edge(i) => 1 << i | 1 << ((i + 1) % 3),
            Self::Interior => 0b111,
        }
    }

    /// The feature of a point of the closed triangle that lies on the lines of the marked edges and of no other.
    /// A point of a proper triangle is never on all three.
    pub(super) fn on_edges(on: [bool; 3]) -> Self {
        match on {
            [false, false, false] => Self::Interior,
            [true, false, false] => Self::Edge(0),
            [false, true, false] => Self::Edge(1),
            [false, false, true] => Self::Edge(2),
            [true, true, _] => Self::Vertex(1),
            [false, true, true] => Self::Vertex(2),
            [true, false, true] => Self::Vertex(0),
        }
    }

    /// The feature of a triangle on which a point of its edge `edge` lies.
    pub(super) fn of_edge_point(edge: usize, at: SegmentFeature) -> Self {
        match at {
            SegmentFeature::Interior => Self::Edge(edge as u8),
            SegmentFeature::Vertex(end) => Self::Vertex((edge as u8 + end) % 3),
        }
    }
}
