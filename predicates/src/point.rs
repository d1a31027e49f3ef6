//! What a predicate accepts as a point: [`Point`].

/// A point of `N`-dimensional space whose coordinates lift exactly to `f64`.
///
/// Implemented for `[f64; N]` and `[f32; N]`, for references to points and, behind the features `glam` and
/// `mint`, for the points and vectors of those libraries. An `f32` lifts without rounding, so a predicate on
/// `f32` points is exact too.
pub trait Point<const N: usize>: Copy {
    /// The coordinates, unchanged in value.
    fn coords(self) -> [f64; N];
}

impl<const N: usize> Point<N> for [f64; N] {
    #[inline]
    fn coords(self) -> [f64; N] {
        self
    }
}

impl<const N: usize> Point<N> for [f32; N] {
    #[inline]
    fn coords(self) -> [f64; N] {
        self.map(f64::from)
    }
}

impl<const N: usize, P: Point<N>> Point<N> for &P {
    #[inline]
    fn coords(self) -> [f64; N] {
        (*self).coords()
    }
}

#[cfg(any(feature = "glam", feature = "mint"))]
macro_rules! impl_point {
    ($($name:path, $n:literal, $($field:ident)+;)*) => {$(
        impl Point<$n> for $name {
            #[inline]
            fn coords(self) -> [f64; $n] {
                [$(f64::from(self.$field)),+]
            }
        }
    )*};
}

#[cfg(feature = "glam")]
impl_point! {
    glam::DVec2, 2, x y;
    glam::DVec3, 3, x y z;
    glam::DVec4, 4, x y z w;
    glam::Vec2, 2, x y;
    glam::Vec3, 3, x y z;
    glam::Vec3A, 3, x y z;
    glam::Vec4, 4, x y z w;
}

#[cfg(feature = "mint")]
impl_point! {
    mint::Point2<f64>, 2, x y;
    mint::Point3<f64>, 3, x y z;
    mint::Vector2<f64>, 2, x y;
    mint::Vector3<f64>, 3, x y z;
    mint::Vector4<f64>, 4, x y z w;
    mint::Point2<f32>, 2, x y;
    mint::Point3<f32>, 3, x y z;
    mint::Vector2<f32>, 2, x y;
    mint::Vector3<f32>, 3, x y z;
    mint::Vector4<f32>, 4, x y z w;
}
