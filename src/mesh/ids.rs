//! Typed element numbers, so that a vertex number never indexes a face array.

macro_rules! id {
    ($(#[$doc:meta])* $name:ident) => {
        $(#[$doc])*
        #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
        #[repr(transparent)]
        pub struct $name(pub u32);

        impl $name {
            /// The number as an index.
            #[inline]
            pub fn index(self) -> usize {
                self.0 as usize
            }
        }

        impl From<usize> for $name {
            #[inline]
            fn from(index: usize) -> Self {
                debug_assert!(index <= u32::MAX as usize);
                Self(index as u32)
            }
        }

        impl From<$name> for usize {
            #[inline]
            fn from(id: $name) -> usize {
                id.0 as usize
            }
        }
    };
}
pub(crate) use id;

id!(
    /// A vertex.
    VertexId
);
id!(
    /// A triangle.
    FaceId
);
id!(
    /// A halfedge, and the corner at its start: `3 f + k` goes from corner `k` of face `f` to corner `k + 1 mod 3`.
    HalfedgeId
);

impl FaceId {
    /// Its halfedges, counter-clockwise.
    #[inline]
    pub fn halfedges(self) -> [HalfedgeId; 3] {
        [0, 1, 2].map(|k| HalfedgeId::of(self, k))
    }
}

/// The halfedges that start where `first` does, counter-clockwise from it; `twin` gives the opposite halfedge.
pub fn star(first: HalfedgeId, twin: impl Fn(HalfedgeId) -> HalfedgeId) -> impl Iterator<Item = HalfedgeId> {
    let mut next = Some(first);
    std::iter::from_fn(move || {
        let h = next?;
        let following = twin(h.prev());
        next = (following != first).then_some(following);
        Some(h)
    })
}

impl HalfedgeId {
    /// Halfedge `k` (0, 1 or 2) of a face.
    #[inline]
    pub fn of(face: FaceId, k: usize) -> Self {
        debug_assert!(k < 3);
        Self(face.0 * 3 + k as u32)
    }

    /// The face on its left.
    #[inline]
    pub fn face(self) -> FaceId {
        FaceId(self.0 / 3)
    }

    /// Which halfedge of its face it is: 0, 1 or 2.
    #[inline]
    pub fn corner(self) -> usize {
        (self.0 % 3) as usize
    }

    /// The next halfedge around the face, counter-clockwise.
    #[inline]
    pub fn next(self) -> Self {
        if self.0 % 3 == 2 { Self(self.0 - 2) } else { Self(self.0 + 1) }
    }

    /// The previous halfedge around the face.
    #[inline]
    pub fn prev(self) -> Self {
        if self.0.is_multiple_of(3) { Self(self.0 + 2) } else { Self(self.0 - 1) }
    }
}
