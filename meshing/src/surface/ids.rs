//! Index newtypes: a vertex cannot be taken for a triangle.

macro_rules! id {
    ($(#[$doc:meta])* $name:ident) => {
        $(#[$doc])*
        #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
        #[repr(transparent)]
        pub struct $name(pub u32);

        impl $name {
            /// The id as an index into an attribute array.
            #[inline]
            #[must_use]
            pub fn index(self) -> usize {
                self.0 as usize
            }

            /// The id of an index.
            ///
            /// # Panics
            /// If `index` does not fit 32 bits; the mesh types refuse meshes of that size.
            #[inline]
            #[must_use]
            pub fn from_index(index: usize) -> Self {
                Self(u32::try_from(index).expect("meshes have fewer than 2^32 elements"))
            }
        }
    };
}

id! {
    /// A vertex of a mesh.
    VertexId
}
id! {
    /// An edge of a mesh.
    EdgeId
}
id! {
    /// A triangle of a mesh.
    TriId
}
