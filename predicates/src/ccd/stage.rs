//! Which stage settles a collision query: [`Stage`].

/// The stage that settled a collision query, in the order in which they are tried.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[repr(u8)]
pub enum Stage {
    /// Coordinates compared: the boxes stay apart along an axis, or all motion is along one.
    Boxes,
    /// A direction along which the primitives stay apart, in rounded arithmetic with a proven bound.
    Direction,
    /// The time step cut into parts that rounded arithmetic with proven bounds can decide.
    Subdivision,
    /// The primitives touch at the beginning or at the end of the step.
    Ends,
    /// The same in double-double numbers, about 106 bits.
    DoubleDouble,
    /// Signs at the roots of polynomials, in exact integers.
    Exact,
    /// None: a coordinate was infinite or not a number, and the answer is "no contact".
    NonFinite,
}

impl Stage {
    /// All stages, in the order in which they are tried.
    pub const ALL: [Self; 7] = [
        Self::Boxes,
        Self::Direction,
        Self::Subdivision,
        Self::Ends,
        Self::DoubleDouble,
        Self::Exact,
        Self::NonFinite,
    ];
}
