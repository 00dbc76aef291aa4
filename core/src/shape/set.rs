//! The macro that makes one shape out of several.

/// Makes a closed set of shapes: an enum that is itself a shape ([`Geometry`](crate::shape::Geometry)), and a
/// second enum for its prepared form.
///
/// A program that draws a `Scene` of the set contains the code of the shapes in the set and of no others.
/// Shapes of your own join the set like built-in ones, if they have a `const fn const_bytes`: see [the
/// guide](crate::shape::guide).
///
/// ```
/// use rayline::shape::{Plane, Sphere};
/// rayline::shape_set! {
///     /// Balls on a floor.
///     pub enum Balls;
///     /// `Balls`, prepared.
///     pub enum PreparedBalls {
///         /// A ball.
///         Ball(Sphere),
///         /// The floor.
///         Floor(Plane),
///     }
/// }
/// let _scene: Option<rayline::Scene<Balls>> = None;
/// ```
#[macro_export]
macro_rules! shape_set {
    (
        $(#[$set_doc:meta])*
        $vis:vis enum $Set:ident $(<$life:lifetime>)?;
        $(#[$prepared_doc:meta])*
        $prepared_vis:vis enum $Prepared:ident {
            $($(#[$doc:meta])* $Variant:ident($Type:ty)),+ $(,)?
        }
    ) => {
        $(#[$set_doc])*
        #[derive(Clone, Copy, Debug, PartialEq)]
        $vis enum $Set $(<$life>)? {
            $($(#[$doc])* $Variant($Type)),+
        }

        $(#[$prepared_doc])*
        #[derive(Clone, Copy, Debug)]
        $prepared_vis enum $Prepared<$($life: 'm,)? 'm, R: $crate::math::Real> {
            $($(#[$doc])* $Variant(<$Type as $crate::shape::Geometry>::Prepared<'m, R>)),+
        }

        $crate::__read_set! { $Set $(<$life>)? { $($Variant($Type)),+ } }

        impl $(<$life>)? $Set $(<$life>)? {
            /// The bytes of memory that the shape takes, usable in constants: `Geometry::bytes`.
            #[allow(dead_code)]
            $vis const fn const_bytes<R: $crate::math::Real>(&self) -> usize {
                match self {
                    $(Self::$Variant(shape) => shape.const_bytes::<R>()),+
                }
            }
        }

        impl $(<$life>)? $crate::shape::Geometry for $Set $(<$life>)? {
            type Prepared<'m, R: $crate::math::Real> = $Prepared<$($life,)? 'm, R> where Self: 'm;

            const NAMES: &'static [&'static str] = &[$(stringify!($Variant)),+];

            fn bytes<R: $crate::math::Real>(&self) -> usize {
                match self {
                    $(Self::$Variant(shape) => $crate::shape::Geometry::bytes::<R>(shape)),+
                }
            }

            fn is_solid(&self) -> bool {
                match self {
                    $(Self::$Variant(shape) => $crate::shape::Geometry::is_solid(shape)),+
                }
            }

            fn luminaire(&self) -> Option<$crate::shape::Luminaire> {
                match self {
                    $(Self::$Variant(shape) => $crate::shape::Geometry::luminaire(shape)),+
                }
            }

            fn extent(&self) -> $crate::math::Extent {
                match self {
                    $(Self::$Variant(shape) => $crate::shape::Geometry::extent(shape)),+
                }
            }

            fn prepare<'m, R: $crate::math::Real>(
                &self,
                scale: $crate::math::Scale,
                memory: &mut $crate::Arena<'m>,
            ) -> Result<Self::Prepared<'m, R>, $crate::Fault>
            where
                Self: 'm,
            {
                Ok(match self {
                    $(Self::$Variant(shape) => {
                        $Prepared::$Variant($crate::shape::Geometry::prepare(shape, scale, memory)?)
                    }),+
                })
            }
        }

        impl<$($life: 'm,)? 'm, R: $crate::math::Real> $crate::shape::Intersect<R>
            for $Prepared<$($life,)? 'm, R>
        {
            const IS_SMOOTHED: bool = false $(
                || <
                    <$Type as $crate::shape::Geometry>::Prepared<'m, R> as $crate::shape::Intersect<R>
                >::IS_SMOOTHED
            )+;

            // Forced, as in the tests of spheres, planes and polygons: without it `classic` takes 1.12 times
            // the instructions on a Cortex-M4F in exact quality, and 1.06 times in realtime quality.
            #[inline(always)]
            fn intersect(
                &self,
                ray: &$crate::math::Ray<R>,
                range: $crate::math::Interval<R>,
            ) -> Option<R> {
                match self {
                    $(Self::$Variant(shape) => $crate::shape::Intersect::intersect(shape, ray, range)),+
                }
            }

            #[inline(always)]
            fn intersect_four(&self, rays: &$crate::math::FourRays<R>, max: &[R; 4]) -> (u32, [R; 4]) {
                match self {
                    $(Self::$Variant(shape) => $crate::shape::Intersect::intersect_four(shape, rays, max)),+
                }
            }

            fn form(&self) -> $crate::shape::Form<R> {
                match self {
                    $(Self::$Variant(shape) => $crate::shape::Intersect::form(shape)),+
                }
            }

            fn bounds(&self) -> Option<$crate::math::Aabb<R>> {
                match self {
                    $(Self::$Variant(shape) => $crate::shape::Intersect::bounds(shape)),+
                }
            }

            fn spans(&self, ray: &$crate::math::Ray<R>) -> $crate::shape::Spans<R> {
                match self {
                    $(Self::$Variant(shape) => $crate::shape::Intersect::spans(shape, ray)),+
                }
            }

            fn surface(&self, ray: &$crate::math::Ray<R>, t: R) -> $crate::Surface<R> {
                match self {
                    $(Self::$Variant(shape) => $crate::shape::Intersect::surface(shape, ray, t)),+
                }
            }

            fn is_front(&self, ray: &$crate::math::Ray<R>, t: R) -> bool {
                match self {
                    $(Self::$Variant(shape) => $crate::shape::Intersect::is_front(shape, ray, t)),+
                }
            }

            fn is_lifted(&self) -> bool {
                match self {
                    $(Self::$Variant(shape) => $crate::shape::Intersect::is_lifted(shape)),+
                }
            }

            fn is_tinted(&self) -> bool {
                match self {
                    $(Self::$Variant(shape) => $crate::shape::Intersect::is_tinted(shape)),+
                }
            }

            fn tint(&self, surface: &$crate::Surface<R>) -> $crate::LinearRgb<R> {
                match self {
                    $(Self::$Variant(shape) => $crate::shape::Intersect::tint(shape, surface)),+
                }
            }

            fn uv(&self, surface: &$crate::Surface<R>, scale: $crate::math::Scale) -> [R; 2] {
                match self {
                    $(Self::$Variant(shape) => $crate::shape::Intersect::uv(shape, surface, scale)),+
                }
            }
        }

        impl<$($life: 'm,)? 'm, R: $crate::math::Real> $crate::shape::Silhouette<R>
            for $Prepared<$($life,)? 'm, R>
        {
            const HAS_RIMS: bool = false $(
                || <
                    <$Type as $crate::shape::Geometry>::Prepared<'m, R> as $crate::shape::Silhouette<R>
                >::HAS_RIMS
            )+;

            #[inline(never)]
            fn hull(&self, part: usize) -> Option<$crate::shape::Hull<R>> {
                match self {
                    $(Self::$Variant(shape) => $crate::shape::Silhouette::hull(shape, part)),+
                }
            }

            fn hulls(&self) -> usize {
                match self {
                    $(Self::$Variant(shape) => $crate::shape::Silhouette::hulls(shape)),+
                }
            }

            fn tip(&self, number: usize) -> Option<$crate::shape::Tip<R>> {
                match self {
                    $(Self::$Variant(shape) => $crate::shape::Silhouette::tip(shape, number)),+
                }
            }

            fn each_rim(&self, visit: impl FnMut($crate::shape::Rim<R>)) {
                match self {
                    $(Self::$Variant(shape) => $crate::shape::Silhouette::each_rim(shape, visit)),+
                }
            }

            fn normal_beside(
                &self,
                surface: &$crate::Surface<R>,
                step: $crate::Vec3<R>,
            ) -> $crate::Vec3<R> {
                match self {
                    $(Self::$Variant(shape) => {
                        $crate::shape::Silhouette::normal_beside(shape, surface, step)
                    }),+
                }
            }

            fn each_facet(
                &self,
                tessellation: &$crate::shape::Tessellation<R>,
                visit: &mut dyn FnMut(&$crate::shape::Facet<R>),
            ) {
                match self {
                    $(Self::$Variant(shape) => {
                        $crate::shape::Silhouette::each_facet(shape, tessellation, visit)
                    }),+
                }
            }
        }
    };
}

/// Implements `Serialize` and `Read` for a set of shapes: see the module `read`.
#[cfg(feature = "serde")]
#[doc(hidden)]
#[macro_export]
macro_rules! __read_set {
    ($Set:ident $(<$life:lifetime>)? { $($Variant:ident($Type:ty)),+ }) => {
        // A set can be written if all of its shapes can. `for<'any>` postpones the check to where a set is
        // written: without it, a set with a shape that cannot be written would not compile.
        impl $(<$life>)? $crate::read::serde::Serialize for $Set $(<$life>)?
        where
            $(for<'any> $Type: $crate::read::serde::Serialize),+
        {
            fn serialize<W: $crate::read::serde::Serializer>(
                &self,
                serializer: W,
            ) -> Result<W::Ok, W::Error> {
                let mut number = 0;
                $(
                    if let Self::$Variant(shape) = self {
                        let (set, variant) = (stringify!($Set), stringify!($Variant));
                        return serializer.serialize_newtype_variant(set, number, variant, shape);
                    }
                    number += 1;
                )+
                let _ = number;
                Err($crate::read::serde::ser::Error::custom("a set has no other shapes"))
            }
        }

        $crate::__read_set!(@read $Set $(<$life>)? { $($Variant($Type)),+ });
    };
    (@read $Set:ident <$life:lifetime> { $($Variant:ident($Type:ty)),+ }) => {
        $crate::__read_enum!(
            for $life [] $Set as $Set<$life>
            where [$($Type: $crate::read::Read<$life>),+] { $($Variant($Type)),+ }
        );
    };
    (@read $Set:ident { $($Variant:ident($Type:ty)),+ }) => {
        $crate::__read_enum!(
            [] $Set as $Set where [$($Type: $crate::read::Read<'m>),+] { $($Variant($Type)),+ }
        );
    };
}

#[cfg(not(feature = "serde"))]
#[doc(hidden)]
#[macro_export]
macro_rules! __read_set {
    ($($any:tt)*) => {};
}
