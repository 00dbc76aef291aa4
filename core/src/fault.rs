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
    /// A number that is no length, such as an angle, a direction or a color, is beyond ±[`MAX_COORDINATE`]. Use a smaller one.
    TooLarge {
        /// The number.
        given: f32,
    },
    /// A radius is zero or negative. Give a positive one; a cone needs one of its two.
    RadiusNotPositive,
    /// The hole of a ring is negative, or as large as the ring. Give it 0 or more, and less than the radius.
    HoleTooLarge,
    /// The three corners of a triangle lie on one line, or two edges of a rectangle have one direction. Move a corner, turn an edge, or
    /// remove the shape.
    Collinear,
    /// A polygon has fewer than three vertices, or all of them lie on one line. Remove it or add vertices.
    NoArea,
    /// The vertices of a polygon do not lie in one plane. Split it into triangles.
    NotPlanar,
    /// The three axes of an ellipsoid lie in one plane, or a box has no room inside. Give it a thickness, and `min` below `max`.
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
    /// A normal, an axis or a direction has length zero. Give it a length; it need not be 1. That of a cylinder or cone goes from its
    /// base to its top: move one of them.
    ZeroLength,
    /// A component of light, of a background or of what a medium absorbs is negative. Use 0 or more.
    NegativeColor {
        /// The component.
        given: f32,
    },
    /// A coefficient is outside 0..=1. Scale it: of a color that counts to 255, say, divide each component by that.
    OutsideUnit {
        /// Which it is.
        coefficient: Coefficient,
        /// The number that it has.
        given: f32,
    },
    /// Reflectance and transmittance add up to more than 1. Lower one of them.
    EnergyAboveOne,
    /// The shininess is negative. Use 0 or more.
    NegativeShininess,
    /// A coefficient of a falloff is negative or beyond 1e6, or all are zero. Use 0 to 1e6, and more than 0 for one of them; give
    /// [`Falloff::inverse_square`](crate::Falloff::inverse_square) a distance from 0.001 to 1e19.
    Falloff,
    /// A cone of light is not between 0° and 180°, or dark before it is bright. Give the half angle of the bright part, then that of
    /// all.
    LightCone,
    /// A cone of light is dark beyond less than 1e-4 radians, 0.006°: directions have too few digits for what lies within. Widen it.
    LightConeTooNarrow,
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
    /// The number system that the scene is prepared for ends before this number does: in fixed point, light ends at 59, and so do the
    /// strengths of blobs, what is longer of an ellipsoid's axes over what is shorter, the coordinates of textures and the slopes of bumps;
    /// indices of refraction and the slopes of cones end at 7.6, and so do their inverses. [`Fixed`](crate::math::Fixed) tells all
    /// limits. Keep inside, or prepare the scene for `f32`.
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
    /// The units of a pattern or the cells of a checker are 0, or smaller than 1e-6. Enlarge them;
    /// [`Checker::cells_per_unit`](crate::Checker::cells_per_unit) is 1 over their size.
    PatternSize,
    /// The step of a bump is 0 or negative. Give it the width of the pattern's finest detail.
    BumpStep,
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
            Self::TooLarge { given } => {
                return write!(f, "a number is {given:e}, beyond ±1e6; use a smaller one");
            }
            Self::RadiusNotPositive => "the radius is not positive; give one above 0 (a cone needs one of its two)",
            Self::HoleTooLarge => "the hole of a ring is not between 0 and its radius; make it smaller",
            Self::Collinear => {
                "the corners lie on one line, or two edges have one direction; move a corner, turn an edge, or remove the \
                 shape"
            }
            Self::NoArea => {
                "the polygon has fewer than three vertices, or all on one line; remove it or add vertices"
            }
            Self::NotPlanar => "the vertices do not lie in one plane; split the polygon into triangles",
            Self::NoVolume => {
                "the axes lie in one plane, or the box has no room inside; give it a thickness, with `min` below `max`"
            }
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
            Self::InstanceSize => "the size of instances is less than 1e-6; give it 1 for that of the model",
            Self::Own { why } => why,
            Self::ZeroLength => {
                "a normal, axis or direction has length zero; give it a length (that of a cylinder or cone goes from base to \
                 top)"
            }
            Self::NegativeColor { given } => {
                return write!(f, "a component of a color, or of an absorption, is {given:?}; use 0 or more");
            }
            Self::OutsideUnit { coefficient, given } => {
                let (of, scale) = match coefficient.is_color() {
                    true => ("a component of ", " (of 255 levels, divide by 255)"),
                    false => ("", ""),
                };
                let name = coefficient.name();
                return write!(f, "{of}`{name}` is {given:?}, outside 0 to 1; scale it{scale}");
            }
            Self::EnergyAboveOne => "reflectance and transmittance add up to more than 1; lower one of them",
            Self::NegativeShininess => "the shininess is negative; use 0 or more",
            Self::Falloff => {
                "a coefficient of a falloff is not within 0 to 1e6, or all are 0; use more than 0 for one of the three, and give \
                 `inverse_square` a distance from 0.001 to 1e19"
            }
            Self::LightCone => {
                "a cone of light is not between 0 and 180 degrees, the bright part within all of it; give half angles in \
                 radians: 20 degrees are 0.349"
            }
            Self::LightConeTooNarrow => {
                "a cone of light is narrower than 1e-4 radians (0.006 degrees); widen it (angles are in radians)"
            }
            Self::WithoutFeature { feature } => {
                return write!(f, "this needs the feature `{feature}` of the crate rayline; build with it");
            }
            Self::IorNotPositive => "the index of refraction is less than 0.001; air is 1, glass about 1.5",
            Self::TooSmall => {
                "it is too small beside the rest of the scene for this number system; enlarge it or prepare for f32"
            }
            Self::OutOfRange => {
                "a number is too large or too small for this number system; in fixed point keep light, strengths of blobs, \
                 ratios of an ellipsoid's axes, coordinates of textures and slopes of bumps below 59, indices of refraction \
                 and slopes of cones below 7.6, or prepare for f32"
            }
            Self::BeyondReach => {
                "the camera is too far away, or too far from an infinite plane, for this number system; prepare the scene \
                 with it"
            }
            Self::EyeAtTarget => "the eye is at the target; move one of them",
            Self::UpAlongView => "the up vector lies along the line of sight; turn it away",
            Self::FieldOfView => {
                "the vertical field of view is not between 0.0002 and 179.98 degrees; give `vertical_fov` in radians: 45 \
                 degrees are 0.785"
            },
            Self::PatternSize => {
                "the units of a pattern or the cells of a checker are smaller than 1e-6; enlarge them (`cells_per_unit` is 1 \
                 over their size)"
            }
            Self::BumpStep => "the step of a bump is not above 0; give it the width of the finest detail",
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
                    "there is no material {named}, of {materials} that are counted from 0; add it or name another"
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

/// A coefficient from 0 to 1.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Coefficient {
    /// [`Material::color`](crate::Material::color), or a color of a texture.
    Color,
    /// [`Material::ambient`](crate::Material::ambient).
    Ambient,
    /// [`Material::diffuse`](crate::Material::diffuse).
    Diffuse,
    /// [`Material::specular`](crate::Material::specular).
    Specular,
    /// [`Material::reflectance`](crate::Material::reflectance).
    Reflectance,
    /// [`Material::transmittance`](crate::Material::transmittance).
    Transmittance,
    /// [`Optics::reflection_color`](crate::Optics::reflection_color).
    ReflectionColor,
    /// [`Optics::transmission_color`](crate::Optics::transmission_color).
    TransmissionColor,
    /// [`Stripes::width`](crate::Stripes::width).
    Width,
    /// [`Brick::gap`](crate::Brick::gap).
    Gap,
}

impl Coefficient {
    /// What its field is called.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Color => "color",
            Self::Ambient => "ambient",
            Self::Diffuse => "diffuse",
            Self::Specular => "specular",
            Self::Reflectance => "reflectance",
            Self::Transmittance => "transmittance",
            Self::ReflectionColor => "reflection_color",
            Self::TransmissionColor => "transmission_color",
            Self::Width => "width",
            Self::Gap => "gap",
        }
    }

    const fn is_color(self) -> bool {
        matches!(self, Self::Color | Self::ReflectionColor | Self::TransmissionColor)
    }
}

/// What is wrong lies in one of the shapes that a shape is made of.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Inner {
    /// In this one of its solids.
    Solid(usize),
    /// In what it shows in several places.
    Model,
}

/// Refuses what is not finite.
pub(crate) fn check_finite(value: f32) -> Result<(), Fault> {
    if value.is_finite() { Ok(()) } else { Err(Fault::NotFinite) }
}

/// Refuses a length that is not finite or too large.
pub(crate) fn check_coordinate(value: f32) -> Result<(), Fault> {
    check_finite(value)?;
    if value.abs() > MAX_COORDINATE { Err(Fault::TooFar) } else { Ok(()) }
}

/// Refuses what is no length, and not finite or too large.
pub(crate) fn check_number(given: f32) -> Result<(), Fault> {
    check_finite(given)?;
    if given.abs() > MAX_COORDINATE { Err(Fault::TooLarge { given }) } else { Ok(()) }
}

/// Refuses what is not a share, 0 to 1.
pub(crate) fn check_share(coefficient: Coefficient, given: f32) -> Result<(), Fault> {
    check_finite(given)?;
    if (0.0..=1.0).contains(&given) { Ok(()) } else { Err(Fault::OutsideUnit { coefficient, given }) }
}

/// Refuses a point that is not finite or too far out.
pub(crate) fn check_point(point: Vec3) -> Result<(), Fault> {
    [point.x, point.y, point.z].into_iter().try_for_each(check_coordinate)
}

/// Refuses angles or a direction that are not finite or too large.
pub(crate) fn check_numbers(numbers: Vec3) -> Result<(), Fault> {
    [numbers.x, numbers.y, numbers.z].into_iter().try_for_each(check_number)
}

/// The unit vector along a direction that the scene names, or why there is none.
pub(crate) fn check_direction<R: Real>(direction: Vec3) -> Result<Vec3<R>, Fault> {
    check_numbers(direction)?;
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
    if R::fits(value) { Ok(()) } else { Err(Fault::OutOfRange) }
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
