//! What can be wrong with a scene.

use core::fmt;

use crate::limits::{MAX_BLOBS, MAX_COORDINATE, MAX_FACES};
use crate::math::{Real, Vec3};

/// Why a part of a scene was refused.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum Fault {
    /// A baked mesh is for another number system, or for a scene of another extent. Bake the scene again, for this one.
    BakedOtherwise,
    /// A number is NaN or infinite. Replace it.
    NotFinite,
    /// A coordinate, radius or distance is beyond ±[`MAX_COORDINATE`]. Scale the scene down.
    TooFar,
    /// A radius is zero or negative. Give a positive one; a cone needs one of its two.
    RadiusNotPositive,
    /// The hole of a ring is negative, or as large as the ring. Give it 0 or more, and less than the radius.
    HoleTooLarge,
    /// The three corners of a triangle, or two edges of a rectangle, lie on one line. Remove it or move a corner.
    Collinear,
    /// A polygon has fewer than three vertices, or encloses no area. Remove it or add vertices.
    NoArea,
    /// The vertices of a polygon do not lie in one plane. Split it into triangles.
    NotPlanar,
    /// The three axes of an ellipsoid lie in one plane, or a box has no room inside. Give it a thickness.
    NoVolume,
    /// All coefficients of a quadric are zero, but for the last. Give it another.
    NoSurface,
    /// The tube of a torus is as thick as its circle is wide. Make its minor radius smaller than the major one.
    NoHole,
    /// The axes of a box are not at right angles. Turn them, or make it a convex polyhedron.
    NotAtRightAngles,
    /// Where they overlap, the strengths of blobs add up to 1/2 or less: there is no surface. Make them stronger, or add blobs.
    TooWeak,
    /// Metaballs have more than [`MAX_BLOBS`](crate::limits::MAX_BLOBS) blobs. Make several of them.
    TooManyBlobs {
        /// How many they have.
        given: usize,
    },
    /// The planes of a polyhedron enclose nothing, or something without end. Turn their normals outward, and add planes
    /// until it is closed on all sides.
    NotEnclosed,
    /// A polyhedron has more than [`MAX_FACES`] planes. Use fewer, or a mesh.
    TooManyFaces {
        /// How many it has.
        given: usize,
    },
    /// A mesh has no triangle that has an area. Remove it or add triangles.
    NoTriangles,
    /// A triangle of a mesh names a vertex that does not exist. Add it or name another.
    UnknownVertex {
        /// The triangle that names it, by its position in the mesh.
        triangle: usize,
        /// The vertex that was named.
        named: usize,
        /// How many there are.
        vertices: usize,
    },
    /// A mesh has normals, but not one for each vertex. Give as many as vertices, or none.
    NormalCount {
        /// How many normals there are.
        normals: usize,
        /// How many vertices.
        vertices: usize,
    },
    /// A mesh has coordinates for textures, but not one pair for each vertex. Give as many as vertices, or none.
    UvCount {
        /// How many pairs there are.
        uvs: usize,
        /// How many vertices.
        vertices: usize,
    },
    /// The steps of a [`Csg`](crate::shape::Csg) do not leave one solid: an operator finds fewer than two, or the last leaves
    /// more than one. Give each pair of solids one operator after them.
    NotOneSolid,
    /// A part of a [`Csg`](crate::shape::Csg) has no inside. Close it (`capped`), or use a shape that has one.
    NotSolid {
        /// Which of its solids, in the order of the steps, from 0.
        solid: usize,
    },
    /// A [`Csg`](crate::shape::Csg) has more than [`MAX_CSG_SOLIDS`](crate::limits::MAX_CSG_SOLIDS) solids. Make several of it.
    TooManySolids {
        /// How many it has.
        given: usize,
    },
    /// There is no place for an instance. Give it one or more.
    NoPoses,
    /// The size of instances is smaller than [`MIN_SIZE`](crate::limits::MIN_SIZE), zero or negative. It is 1 for that of the model.
    InstanceSize,
    /// A shape that is not of this crate refuses its numbers. Do what it says.
    Own {
        /// What is wrong, and what to do.
        why: &'static str,
    },
    /// A normal, an axis or a direction has length zero. Give it a length; it need not be 1.
    ZeroLength,
    /// A component of a color is negative. Use 0 or more.
    NegativeColor,
    /// A material's color or coefficient is outside 0..=1. Scale it down.
    OutsideUnit,
    /// Reflectance and transmittance add up to more than 1. Lower one of them.
    EnergyAboveOne,
    /// The shininess is negative. Use 0 or more.
    NegativeShininess,
    /// The coefficients of a falloff are negative, or all zero. Use 0 or more, and more for one of them.
    FalloffNegative,
    /// A cone of light is not between 0° and 180°, or dark before it is bright. Give the half angle of the bright part, then that of
    /// all.
    LightCone,
    /// The scene needs code that was left out. Build with this feature of the crate `rayline`.
    WithoutFeature {
        /// The feature.
        feature: &'static str,
    },
    /// The index of refraction is less than 0.001. Air is 1, glass about 1.5.
    IorNotPositive,
    /// The number system that the scene is prepared for has too few digits for something so much smaller than the
    /// scene: in [`Fixed`](crate::math::Fixed), less than 64 units of 2⁻²⁴ where the scene was scaled to 1/2, or to 1/4 with infinite
    /// planes. Enlarge it, leave it out, bring nearer to the origin what extends farther, or prepare the scene for `f32`.
    TooSmall,
    /// The number system that the scene is prepared for ends before this number does: in fixed point, light ends at 59, indices of
    /// refraction, their inverses and the slopes of cones at 7.6; [`Fixed`](crate::math::Fixed) tells all limits. Keep inside, or
    /// prepare the scene for `f32`.
    OutOfRange,
    /// The camera was moved so far away that the number system does not reach there, or so high above an infinite plane that it
    /// would be seen to end before the horizon: [`Fixed`](crate::math::Fixed) tells how far that is. Move it closer, or prepare the
    /// scene anew with it.
    BeyondReach,
    /// The camera's target is where its eye is. Move one of them.
    EyeAtTarget,
    /// The camera looks along its up vector. Turn the up vector away from the line of sight.
    UpAlongView,
    /// The field of view is not between 0.0002° and 179.98°. It is the full vertical angle, in radians.
    FieldOfView,
    /// The units of a pattern are 0, or smaller than 1e-6. Enlarge them.
    PatternSize,
    /// Noise has no octave, or more than [`MAX_OCTAVES`](crate::MAX_OCTAVES). Give it 1 to 8.
    Octaves,
    /// The turbulence of a texture is outside 0..=16. Turn it down.
    Turbulence,
    /// An image has more or fewer pixels than its sides say, or none. Mend one or the other.
    PixelCount {
        /// Numbers in the list of pixels, by its sides.
        needed: usize,
        /// As many as there are.
        given: usize,
    },
    /// A pixel names a color that the palette does not have. Add it or name another.
    PaletteColor {
        /// The color that was named.
        named: usize,
        /// How many there are.
        colors: usize,
    },
    /// An object names a material that does not exist. Add it or name another.
    UnknownMaterial {
        /// The material that was named.
        named: usize,
        /// How many there are.
        materials: usize,
    },
    /// There are more than [`MAX_COUNT`](crate::limits::MAX_COUNT). Use fewer.
    TooMany {
        /// How many there are.
        given: usize,
    },
    /// An array of fixed size is full. Raise its size.
    Full {
        /// There is room for so many.
        room: usize,
    },
    /// The lent memory is too small. Lend as much as [`Scene::bytes`](crate::Scene::bytes) says.
    Memory {
        /// Bytes that the scene needs.
        needed: usize,
        /// Bytes that were lent.
        lent: usize,
    },
}

impl fmt::Display for Fault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::NotFinite => "a number is NaN or infinite; replace it",
            Self::TooFar => "a coordinate, radius or distance is beyond ±1e6; scale the scene down",
            Self::RadiusNotPositive => "the radius is not positive; give one above 0 (a cone needs one of its two)",
            Self::HoleTooLarge => "the hole of a ring is not between 0 and its radius; make it smaller",
            Self::Collinear => "the corners lie on one line; remove the shape or move a corner",
            Self::NoArea => "the polygon has fewer than three vertices or no area; remove it or add vertices",
            Self::NotPlanar => "the vertices do not lie in one plane; split the polygon into triangles",
            Self::NoVolume => "the axes lie in one plane, or the box has no room inside; give it a thickness",
            Self::NoSurface => "the coefficients are zero, but for the last; give it another",
            Self::NoHole => "the torus has no hole; make the minor radius smaller than the major one",
            Self::NotAtRightAngles => "the axes of a box are not at right angles; turn them",
            Self::TooWeak => "the strengths of the blobs add up to 1/2 or less; make them stronger",
            Self::TooManyBlobs { given } => {
                return write!(f, "{given} blobs in one shape are too many; use at most {MAX_BLOBS}");
            }
            Self::NotEnclosed => {
                "the planes enclose no space, or one without end; turn their normals outward, or add planes"
            }
            Self::TooManyFaces { given } => {
                return write!(f, "{given} faces are too many for a polyhedron; use at most {MAX_FACES}");
            }
            Self::BakedOtherwise => {
                "the mesh was baked for another number system or scene; bake the scene for this one"
            }
            Self::NoTriangles => "the mesh has no triangle that has an area; remove it or add triangles",
            Self::UnknownVertex { triangle, named, vertices } => {
                return write!(
                    f,
                    "triangle {triangle} of the mesh names vertex {named}, of {vertices} that are counted from 0; add it \
                     or name another"
                );
            }
            Self::NormalCount { normals, vertices } => {
                return write!(
                    f,
                    "the mesh has {normals} normals and {vertices} vertices; give one for each, or none"
                );
            }
            Self::UvCount { uvs, vertices } => {
                return write!(
                    f,
                    "the mesh has {uvs} pairs of coordinates and {vertices} vertices; give one for each, or none"
                );
            }
            Self::NotOneSolid => "the steps do not leave one solid; give each pair one operator after them",
            Self::NotSolid { solid } => {
                return write!(f, "solid {solid} has no inside; close it, or use a shape that has one");
            }
            Self::TooManySolids { given } => {
                return write!(f, "{given} solids in one are too many; use at most 32");
            }
            Self::NoPoses => "there is no place for an instance; give it one or more",
            Self::InstanceSize => "the size of instances is smaller than 1e-6; it is 1 for that of the model",
            Self::Own { why } => why,
            Self::ZeroLength => "a normal, axis or direction has length zero; give it a length",
            Self::NegativeColor => "a color is negative; use 0 or more",
            Self::OutsideUnit => "a color or coefficient is outside 0 to 1; scale it",
            Self::EnergyAboveOne => "reflectance and transmittance add up to more than 1; lower one of them",
            Self::NegativeShininess => "the shininess is negative; use 0 or more",
            Self::FalloffNegative => {
                "a falloff is negative or all zero; use 0 or more, and more for one of the three"
            }
            Self::LightCone => {
                "a cone of light is not between 0 and 180 degrees, the bright part within all of it; give half angles in \
                 radians: 20 degrees are 0.349"
            }
            Self::WithoutFeature { feature } => {
                return write!(f, "this needs the feature `{feature}` of the crate rayline; build with it");
            }
            Self::IorNotPositive => "the index of refraction is less than 0.001; air is 1, glass about 1.5",
            Self::TooSmall => {
                "too small beside the rest for this number system; enlarge it or prepare for f32"
            }
            Self::OutOfRange => {
                "a number is too large or too small for this number system; in fixed point keep light below 59, \
                 indices of refraction below 7.6, or prepare for f32"
            }
            Self::BeyondReach => {
                "the camera is too far away, or too far from an infinite plane, for this number system; prepare the scene \
                 with it"
            }
            Self::EyeAtTarget => "the eye is at the target; move one of them",
            Self::UpAlongView => "the up vector lies along the line of sight; turn it away",
            Self::FieldOfView => {
                "the vertical field of view is not between 0.0002 and 179.98 degrees (`vertical_fov` is in radians: 45 \
                 degrees are 0.785)"
            },
            Self::PatternSize => "the units of a pattern are smaller than 1e-6; enlarge them",
            Self::Octaves => "the octaves of noise are not 1 to 8; give it so many",
            Self::Turbulence => "a turbulence is outside 0 to 16; turn it down",
            Self::PixelCount { needed, given } => {
                return write!(
                    f,
                    "the image has {given} numbers of pixels, and its sides ask for {needed}, 1 or more; mend one or the other"
                );
            }
            Self::PaletteColor { named, colors } => {
                return write!(
                    f,
                    "a pixel names color {named}, of {colors} that are counted from 0; add it or name another"
                );
            }
            Self::UnknownMaterial { named, materials } => {
                return write!(
                    f,
                    "material {named} does not exist: there are {materials}; add it or name another"
                );
            }
            Self::TooMany { given } => return write!(f, "{given} are too many; use at most 65535"),
            Self::Full { room } => {
                return write!(f, "there is room for {room} of a kind; raise the capacity");
            }
            Self::Memory { needed, lent } => {
                return write!(f, "the scene needs {needed} bytes and {lent} were lent; lend more");
            }
        })
    }
}

impl core::error::Error for Fault {}

/// Refuses what is not finite or too large.
pub(crate) fn check_coordinate(value: f32) -> Result<(), Fault> {
    if !value.is_finite() {
        Err(Fault::NotFinite)
    } else if value.abs() > MAX_COORDINATE {
        Err(Fault::TooFar)
    } else {
        Ok(())
    }
}

/// Refuses what is not a share, 0 to 1.
pub(crate) fn check_share(share: f32) -> Result<(), Fault> {
    check_coordinate(share)?;
    if (0.0..=1.0).contains(&share) { Ok(()) } else { Err(Fault::OutsideUnit) }
}

/// Refuses a point that is not finite or too far out.
pub(crate) fn check_point(point: Vec3) -> Result<(), Fault> {
    [point.x, point.y, point.z].into_iter().try_for_each(check_coordinate)
}

/// The unit vector along a direction that the scene names, or why there is none.
pub(crate) fn check_direction<R: Real>(direction: Vec3) -> Result<Vec3<R>, Fault> {
    check_point(direction)?;
    unit(direction)
}

/// The unit vector along `vector`, or [`Fault::ZeroLength`].
pub(crate) fn unit<R: Real>(vector: Vec3) -> Result<Vec3<R>, Fault> {
    // Scale by the largest component first, so that nothing under- or overflows when squared.
    let magnitude = vector.magnitude();
    if magnitude >= f32::MIN_POSITIVE {
        (vector * (1.0 / magnitude)).to().normalized().ok_or(Fault::ZeroLength)
    } else {
        Err(Fault::ZeroLength)
    }
}

/// Refuses a number that is too large for the number system.
pub(crate) fn check_held<R: Real>(value: R::Setup) -> Result<(), Fault> {
    if R::holds(value) { Ok(()) } else { Err(Fault::OutOfRange) }
}

/// Refuses a radius that is not much larger than the rounding of a point.
pub(crate) fn check_size<R: Real>(radius: R) -> Result<(), Fault> {
    if radius < R::offset(R::ZERO) * R::from_f32(4.0) { Err(Fault::TooSmall) } else { Ok(()) }
}

/// Refuses a radius that is not positive.
pub(crate) fn check_radius(radius: f32) -> Result<(), Fault> {
    check_coordinate(radius)?;
    if radius > 0.0 { Ok(()) } else { Err(Fault::RadiusNotPositive) }
}
