//! The reasons why a scene is refused, and checks that several modules share.

use core::fmt;

use crate::limits::{MAX_BLOBS, MAX_COORDINATE, MAX_FACES};
use crate::math::{Real, Vec3};

/// Why a part of a scene was refused.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[non_exhaustive]
pub enum Fault {
    /// A baked mesh was made for another number system, or for a scene of another extent. Bake the scene
    /// again.
    BakedOtherwise,
    /// A number is NaN or infinite. Replace it.
    NotFinite,
    /// A coordinate, radius or distance is beyond ±[`MAX_COORDINATE`]. Scale the scene down.
    TooFar,
    /// A number other than a length, such as an angle, a direction or a color, is beyond ±[`MAX_COORDINATE`].
    /// Use a smaller number.
    TooLarge {
        /// The number.
        given: f32,
    },
    /// A radius is zero or negative. Give it a positive value. One of a cone's two radii may be zero.
    RadiusNotPositive,
    /// The radius of a ring's hole is negative, or as large as the ring's own radius. Use 0 or more, and less
    /// than the radius.
    HoleTooLarge,
    /// The three corners of a triangle lie on one line, or the two edges of a rectangle are parallel. Move a
    /// corner, turn an edge, or remove the shape.
    Collinear,
    /// A polygon has fewer than three vertices, or all of them lie on one line. Remove it or add vertices.
    NoArea,
    /// The vertices of a polygon do not lie in one plane. Split it into triangles.
    NotPlanar,
    /// The three axes of an ellipsoid lie in one plane, or a box has no volume. Make all three extents
    /// positive, with `min` below `max`.
    NoVolume,
    /// All coefficients of a quadric but the constant one are zero. Set another coefficient.
    NoSurface,
    /// The minor radius of a torus, that of its tube, is not smaller than the major one. Make it smaller.
    NoHole,
    /// The axes of a box are not at right angles. Turn them, or use a convex polyhedron.
    NotAtRightAngles,
    /// The strengths of overlapping blobs add up to 1/2 or less, so that there is no surface. Make them
    /// stronger, or add blobs.
    TooWeak,
    /// Metaballs have more than [`MAX_BLOBS`] blobs. Distribute them over several objects.
    TooManyBlobs {
        /// The number of blobs.
        given: usize,
    },
    /// The planes of a polyhedron enclose no space, or an unbounded one. Turn their normals outward, and add
    /// planes until the polyhedron is closed on all sides.
    NotEnclosed,
    /// A polyhedron has more than [`MAX_FACES`] planes. Use fewer, or a mesh.
    TooManyFaces {
        /// The number of planes.
        given: usize,
    },
    /// A mesh has no triangle with an area. Remove the mesh or add triangles.
    NoTriangles,
    /// A triangle of a mesh refers to a vertex that does not exist. Add the vertex or correct the number.
    UnknownVertex {
        /// The position of the triangle in the mesh.
        triangle: usize,
        /// The number of the vertex that the triangle refers to.
        named: usize,
        /// How many vertices the mesh has.
        vertices: usize,
    },
    /// A mesh has normals, but not one for each vertex. Give one for each vertex, or none.
    NormalCount {
        /// How many normals the mesh has.
        normals: usize,
        /// How many vertices it has.
        vertices: usize,
    },
    /// A mesh has texture coordinates, but not one pair for each vertex. Give one pair for each vertex, or
    /// none.
    UvCount {
        /// How many pairs of texture coordinates the mesh has.
        uvs: usize,
        /// How many vertices it has.
        vertices: usize,
    },
    /// A mesh has colors, but not one for each vertex. Give one for each vertex, or none.
    ColorCount {
        /// How many colors the mesh has.
        colors: usize,
        /// How many vertices it has.
        vertices: usize,
    },
    /// The steps of a [`Csg`](crate::shape::Csg) do not combine into one solid: an operator has fewer than
    /// two solids before it, or solids are left at the end. Put one operator after each pair of solids.
    NotOneSolid,
    /// A part of a [`Csg`](crate::shape::Csg) has no inside. Close it (`capped`), or use a closed shape.
    NotSolid {
        /// The number of the solid in the order of the steps, counted from 0.
        solid: usize,
    },
    /// A [`Csg`](crate::shape::Csg) has more than [`MAX_CSG_SOLIDS`](crate::limits::MAX_CSG_SOLIDS) solids.
    /// Divide it into several objects.
    TooManySolids {
        /// The number of solids.
        given: usize,
    },
    /// There is no place for an instance. Give it one or more.
    NoPoses,
    /// The size of instances is below [`MIN_SIZE`](crate::limits::MIN_SIZE). Use a larger one; 1 is the size
    /// of the model.
    InstanceSize,
    /// A shape from outside of this crate refused its numbers. Its text says what to do.
    Own {
        /// The text of the shape: what is wrong, and what to do.
        why: &'static str,
    },
    /// A normal, an axis or a direction has length zero. Use any other length. The axis of a cylinder or cone
    /// goes from its base to its top: move one of the two.
    ZeroLength,
    /// A component of a light, of a background or of an absorption is negative. Use 0 or more.
    NegativeColor {
        /// The component.
        given: f32,
    },
    /// A coefficient is outside 0..=1. Scale it: for a color in 256 levels, divide each component by 255.
    OutsideUnit {
        /// The coefficient.
        coefficient: Coefficient,
        /// Its value.
        given: f32,
    },
    /// Reflectance and transmittance add up to more than 1. Lower one of them.
    EnergyAboveOne,
    /// The shininess is negative. Use 0 or more.
    NegativeShininess,
    /// The exponent of [`Optics::gloss`](crate::Optics::gloss) or
    /// [`Optics::translucency`](crate::Optics::translucency) is negative. Use 0 or more.
    NegativeExponent,
    /// The object of a [`Light::Object`](crate::Light::Object) does not exist. Name one of the scene.
    UnknownObject {
        /// The position of the object.
        named: usize,
        /// The number of objects.
        objects: usize,
    },
    /// The object of a [`Light::Object`](crate::Light::Object) is no sphere, disc without a hole or
    /// rectangle. Use one of these.
    NoLuminaire,
    /// The object of a [`Light::Object`](crate::Light::Object) has a material that emits no light. Give its
    /// [`Optics::emission`](crate::Optics::emission) a color.
    NoEmission,
    /// The radius of a [`Lens`](crate::Lens) is not more than 0 or is above its distance of focus, or the
    /// lens has 1, 2 or more than 16 blades. Use a smaller radius, and 0 or 3 to 16 blades.
    Lens,
    /// A [`Spin`](crate::Spin) has more than 10 turns while the shutter is open. Use a smaller angle.
    TooManyTurns,
    /// An object or the camera has several [`Motion`](crate::Motion)s. Write one, with `by` and `spin`.
    MovesTwice,
    /// Several lights are the sky. Write one.
    TwoSkies,
    /// A coefficient of a falloff is negative or above 1e6, or all are zero. Use 0 to 1e6, and more than 0
    /// for one of them. [`Falloff::inverse_square`](crate::Falloff::inverse_square) takes a distance from
    /// 0.001 to 1e19.
    Falloff,
    /// The angles of a [`LightCone`](crate::LightCone) are not 0 ≤ `bright` ≤ `dark` ≤ π with `dark` above 0.
    /// Both are radians from the axis of the cone.
    LightCone,
    /// The angle `dark` of a [`LightCone`](crate::LightCone) is below 1e-4 radians (0.006°), which is too
    /// narrow for the precision of unit vectors. Widen the cone.
    LightConeTooNarrow,
    /// The scene needs code that this build leaves out. Build the crate `rayline` with this feature.
    WithoutFeature {
        /// The name of the cargo feature.
        feature: &'static str,
    },
    /// The index of refraction is less than 0.001. Air is 1, glass about 1.5.
    IorNotPositive,
    /// A part of the scene is too small for the precision of the number system: in
    /// [`Fixed`](crate::math::Fixed), less than 64 units of 2⁻²⁴ after the scene was scaled to 1/2, or to 1/4
    /// with infinite planes. Enlarge the part, remove it, move the farthest objects nearer to the origin, or
    /// prepare the scene for `f32`.
    TooSmall,
    /// A number is out of the range of the number system. In fixed point the limit is 59 for light, strengths
    /// of blobs, ratios of an ellipsoid's axes, texture coordinates and slopes of bumps; it is 7.6 for
    /// indices of refraction, slopes of cones, and the inverses of both. [`Fixed`](crate::math::Fixed) lists
    /// all limits. Stay within them, or prepare the scene for `f32`.
    OutOfRange,
    /// The camera was moved out of the range of the number system, or so high above an infinite plane that
    /// the plane would visibly end before the horizon. [`Fixed`](crate::math::Fixed) lists the distances.
    /// Move the camera closer, or prepare the scene again with this camera.
    BeyondReach,
    /// The camera's eye and target are the same point. Move one of them.
    EyeAtTarget,
    /// The camera looks along its up vector. Turn the up vector away from the line of sight.
    UpAlongView,
    /// The vertical field of view is not between 0.0002° and 179.98°. It is the full angle, in radians.
    FieldOfView,
    /// The unit of a pattern or the cell of a checker is smaller than 1e-6, or 0. Enlarge it;
    /// [`Checker::cells_per_unit`](crate::Checker::cells_per_unit) is the inverse of the size of a cell.
    PatternSize,
    /// A [`Map`](crate::Map) changes a color of [`Optics`](crate::Optics), but the material has none. Give it
    /// optics.
    MapWithoutOptics,
    /// A transparent material is seen from one side only. Light that enters a body must leave it at a back:
    /// leave out [`Optics::sides`](crate::Optics::sides).
    OneSidedGlass,
    /// A transparent material is on a mesh with a smooth terminator. Refracted rays must leave the triangles
    /// themselves: leave out [`Mesh::smooth_terminator`](crate::shape::Mesh::smooth_terminator).
    TerminatorOnGlass,
    /// A mesh without normals has a smooth terminator. Give it normals, or leave out
    /// [`Mesh::smooth_terminator`](crate::shape::Mesh::smooth_terminator).
    TerminatorWithoutNormals,
    /// A thin material absorbs light behind its surface, where it has no inside. Leave out
    /// [`Optics::absorption`](crate::Optics::absorption), and give the color to
    /// [`Optics::transmission_color`](crate::Optics::transmission_color).
    ThinAbsorbs,
    /// The step of a bump map is 0 or negative. Use the width of the pattern's finest detail.
    BumpStep,
    /// The number of noise octaves is 0 or above [`MAX_OCTAVES`](crate::MAX_OCTAVES). Use 1 to 8.
    Octaves,
    /// The turbulence of a texture is outside 0..=16. Use 0 to 16.
    Turbulence,
    /// The list of an image's pixels does not fit its width and height, or is empty. Correct one of them.
    PixelCount {
        /// The numbers that the list must have for this width and height.
        needed: usize,
        /// The numbers that it has.
        given: usize,
    },
    /// A figure of images for the parts of a surface has none. Add an image.
    NoImage,
    /// The list of an irradiance volume does not have as many points as its grid, or is empty. Correct one of
    /// them.
    PointCount {
        /// The points that the grid has.
        needed: usize,
        /// The points that the list has.
        given: usize,
    },
    /// An irradiance volume is placed on a surface, or turned. Place it in the scene, without a rotation.
    TurnedVolume,
    /// A pixel refers to a color that the palette does not have. Add the color or correct the number.
    PaletteColor {
        /// The number of the color, counted from 0.
        named: usize,
        /// How many colors the palette has.
        colors: usize,
    },
    /// An object refers to a material that does not exist. Add the material or correct the number.
    UnknownMaterial {
        /// The number of the material, counted from 0.
        named: usize,
        /// How many materials the scene has.
        materials: usize,
    },
    /// The scene has more than [`MAX_COUNT`](crate::limits::MAX_COUNT) objects, materials or lights. Use
    /// fewer.
    TooMany {
        /// How many objects, materials or lights the scene has.
        given: usize,
    },
    /// An array of fixed size is full. Raise its capacity.
    Full {
        /// The capacity of the array, in elements.
        room: usize,
    },
    /// The lent memory is too small. Lend as many bytes as [`Scene::bytes`](crate::Scene::bytes) computes.
    Memory {
        /// Bytes that the scene needs.
        needed: usize,
        /// Bytes that were lent.
        lent: usize,
    },
}

impl fmt::Display for Fault {
    // A table of messages.
    #[allow(clippy::too_many_lines)]
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::NotFinite => "a number is NaN or infinite; replace it",
            Self::TooFar => "a coordinate, radius or distance is beyond ±1e6; scale the scene down",
            Self::TooLarge { given } => {
                return write!(f, "a number is {given:e}, beyond ±1e6; use a smaller one");
            }
            Self::RadiusNotPositive => {
                "the radius is not positive; use one above 0 (one radius of a cone may be 0)"
            }
            Self::HoleTooLarge => {
                "the hole of a ring is not between 0 and the ring's radius; make it smaller"
            }
            Self::Collinear => {
                "the corners lie on one line, or two edges are parallel; move a corner, turn an edge, or \
                 remove the shape"
            }
            Self::NoArea => {
                "the polygon has fewer than three vertices, or all of them lie on one line; remove it or add \
                 vertices"
            }
            Self::NotPlanar => "the vertices do not lie in one plane; split the polygon into triangles",
            Self::NoVolume => {
                "the axes lie in one plane, or the box has no volume; give it a thickness, with `min` below \
                 `max`"
            }
            Self::NoSurface => "all coefficients of the quadric but the last are zero; set another one",
            Self::NoHole => "the torus has no hole; make its minor radius smaller than its major one",
            Self::NotAtRightAngles => "the axes of a box are not at right angles; turn them",
            Self::TooWeak => "the strengths of the blobs add up to 1/2 or less; make them stronger",
            Self::TooManyBlobs { given } => {
                return write!(f, "the metaballs have {given} blobs; use at most {MAX_BLOBS}");
            }
            Self::NotEnclosed => {
                "the planes enclose no space, or an unbounded one; turn their normals outward, or add planes"
            }
            Self::TooManyFaces { given } => {
                return write!(f, "the polyhedron has {given} faces; use at most {MAX_FACES}");
            }
            Self::BakedOtherwise => {
                "the mesh was baked for another number system or scene; bake the scene for this one"
            }
            Self::NoTriangles => "the mesh has no triangle with an area; remove the mesh or add triangles",
            Self::UnknownVertex { triangle, named, vertices } => {
                return write!(
                    f,
                    "triangle {triangle} refers to vertex {named}, but the mesh has {vertices} vertices, \
                     counted from 0; correct the number or add the vertex"
                );
            }
            Self::NormalCount { normals, vertices } => {
                return write!(
                    f,
                    "the mesh has {normals} normals for {vertices} vertices; give one for each vertex, or \
                     none"
                );
            }
            Self::UvCount { uvs, vertices } => {
                return write!(
                    f,
                    "the mesh has {uvs} texture coordinates for {vertices} vertices; give one pair for each \
                     vertex, or none"
                );
            }
            Self::ColorCount { colors, vertices } => {
                return write!(
                    f,
                    "the mesh has {colors} colors for {vertices} vertices; give one for each vertex, or none"
                );
            }
            Self::NotOneSolid => {
                "the steps do not combine into one solid; put one operator after each pair of solids"
            }
            Self::NotSolid { solid } => {
                return write!(f, "solid {solid} has no inside; close it (`capped`), or use a closed shape");
            }
            Self::TooManySolids { given } => {
                return write!(f, "the solid is made of {given} solids; use at most 32");
            }
            Self::NoPoses => "the instances have no pose; give at least one",
            Self::InstanceSize => {
                "the size of the instances is less than 1e-6; use a larger one (1 is the size of the model)"
            }
            Self::Own { why } => why,
            Self::ZeroLength => {
                "a normal, axis or direction has length zero; use any other length (the axis of a cylinder \
                 or cone goes from base to top)"
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
            Self::NegativeExponent => {
                "the exponent of `gloss` or `translucency` is negative; use 0 or more, or none for sharp rays"
            }
            Self::UnknownObject { named, objects } => {
                return write!(f, "there is no object {named}: the scene has {objects}, counted from 0");
            }
            Self::NoLuminaire => {
                "the object of a light is no sphere, disc without a hole or rectangle; use one of these"
            }
            Self::NoEmission => {
                "the object of a light has a material that emits no light; give its `emission` a color"
            }
            Self::Lens => {
                "the radius of a lens is not more than 0 or is above its `focus`, or it has 1, 2 or more \
                 than 16 blades; use a smaller radius, and 0 or 3 to 16 blades"
            }
            Self::TooManyTurns => {
                "a spin has more than 10 turns while the shutter is open; use a smaller angle"
            }
            Self::MovesTwice => {
                "an object or the camera has several motions; write one, with both `by` and `spin`"
            }
            Self::TwoSkies => "several lights are the sky; write one",
            Self::Falloff => {
                "a coefficient of a falloff is not within 0 to 1e6, or all are 0; use more than 0 for one of \
                 the three, and give `inverse_square` a distance from 0.001 to 1e19"
            }
            Self::LightCone => {
                "the angles of a light cone are not 0 <= `bright` <= `dark` <= 180 degrees, with `dark` \
                 above 0; give angles from its axis in radians: 20 degrees are 0.349"
            }
            Self::LightConeTooNarrow => {
                "the angle `dark` of a light cone is below 1e-4 radians (0.006 degrees); widen the cone \
                 (angles are in radians)"
            }
            Self::WithoutFeature { feature } => {
                return write!(
                    f,
                    "the scene needs the feature `{feature}` of the crate rayline; add it to `features` in \
                     Cargo.toml"
                );
            }
            Self::IorNotPositive => "the index of refraction is less than 0.001; air is 1, glass about 1.5",
            Self::TooSmall => {
                "it is too small beside the rest of the scene for this number system; enlarge it or prepare \
                 for f32"
            }
            Self::OutOfRange => {
                "a number is too large or too small for this number system; in fixed point keep light, \
                 strengths of blobs, ratios of an ellipsoid's axes, coordinates of textures and slopes of \
                 bumps below 59, indices of refraction and slopes of cones below 7.6, or prepare for f32"
            }
            Self::BeyondReach => {
                "the camera is too far away, or too far from an infinite plane, for this number system; \
                 prepare the scene again with this camera"
            }
            Self::EyeAtTarget => "the camera's eye and target are the same point; move one of them",
            Self::UpAlongView => {
                "the camera's up vector lies along the line of sight; turn it away from there"
            }
            Self::FieldOfView => {
                "the vertical field of view is not between 0.0002 and 179.98 degrees; give `vertical_fov` in \
                 radians: 45 degrees are 0.785"
            }
            Self::PatternSize => {
                "the units of a pattern or the cells of a checker are smaller than 1e-6; enlarge them \
                 (`cells_per_unit` is the inverse of their size)"
            }
            Self::MapWithoutOptics => {
                "a map changes a color of the optics, but the material has none; give it optics"
            }
            Self::OneSidedGlass => {
                "a transparent material is seen from one side only, but light must leave it at a back; leave \
                 out `sides`"
            }
            Self::TerminatorOnGlass => {
                "a transparent material is on a mesh with a smooth terminator, but refracted rays must leave \
                 the triangles themselves; leave out `smooth_terminator`"
            }
            Self::TerminatorWithoutNormals => {
                "a mesh without normals has a smooth terminator; give it normals, or leave out \
                 `smooth_terminator`"
            }
            Self::ThinAbsorbs => {
                "a thin material absorbs light behind its surface, where it has no inside; leave out \
                 `absorption`, and give its color to `transmission_color`"
            }
            Self::BumpStep => "the step of a bump map is not above 0; use the width of the finest detail",
            Self::Octaves => "the number of noise octaves is outside 1 to 8; use 1 to 8",
            Self::Turbulence => "a turbulence is outside 0 to 16; use 0 to 16",
            Self::PixelCount { needed, given } => {
                return write!(
                    f,
                    "the image has {given} numbers for its pixels, but its width and height need {needed} \
                     (at least 1); correct one of them"
                );
            }
            Self::NoImage => "a figure of images for parts has no image; add one",
            Self::PointCount { needed, given } => {
                return write!(
                    f,
                    "the irradiance volume has light for {given} points, but its grid has {needed} (at least \
                     1); correct one of them"
                );
            }
            Self::TurnedVolume => {
                "an irradiance volume is on a surface, or turned; place it in the scene, without a rotation"
            }
            Self::PaletteColor { named, colors } => {
                return write!(
                    f,
                    "a pixel refers to color {named}, but the palette has {colors} colors, counted from 0; \
                     correct the number or add the color"
                );
            }
            Self::UnknownMaterial { named, materials } => {
                return write!(
                    f,
                    "there is no material {named}: the scene has {materials} materials, counted from 0; \
                     correct the number or add the material"
                );
            }
            Self::TooMany { given } => return write!(f, "the scene has {given} of them; use at most 65535"),
            Self::Full { room } => {
                return write!(f, "the array is full: its capacity is {room}; raise it");
            }
            Self::Memory { needed, lent } => {
                return write!(
                    f,
                    "the scene needs {needed} bytes of memory, but {lent} were lent; lend more"
                );
            }
        })
    }
}

impl core::error::Error for Fault {}

/// A coefficient that must lie in 0..=1.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
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
    /// The name of its field.
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

/// The part of a compound shape that was refused.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Inner {
    /// The solid of this number.
    Solid(usize),
    /// The model of [instances](crate::shape::Instances).
    Model,
}

/// Refuses a number that is not finite.
pub(crate) fn check_finite(value: f32) -> Result<(), Fault> {
    if value.is_finite() { Ok(()) } else { Err(Fault::NotFinite) }
}

/// Refuses a length that is not finite or too large.
pub(crate) fn check_coordinate(value: f32) -> Result<(), Fault> {
    check_finite(value)?;
    if value.abs() > MAX_COORDINATE { Err(Fault::TooFar) } else { Ok(()) }
}

/// Refuses a number other than a length that is not finite or too large.
pub(crate) fn check_number(given: f32) -> Result<(), Fault> {
    check_finite(given)?;
    if given.abs() > MAX_COORDINATE { Err(Fault::TooLarge { given }) } else { Ok(()) }
}

/// Refuses a coefficient outside 0..=1.
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

/// The unit vector along a direction of the description, or the reason why there is none.
pub(crate) fn check_direction<R: Real>(direction: Vec3) -> Result<Vec3<R>, Fault> {
    check_numbers(direction)?;
    unit(direction)
}

/// The unit vector along `vector`, or [`Fault::ZeroLength`].
pub(crate) fn unit<R: Real>(vector: Vec3) -> Result<Vec3<R>, Fault> {
    // Scale by the largest component first, so that no square underflows or overflows.
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

/// Refuses a radius that is not much larger than the rounding error of a point.
pub(crate) fn check_size<R: Real>(radius: R) -> Result<(), Fault> {
    if radius < R::offset(R::ZERO) * R::from_f32(4.0) { Err(Fault::TooSmall) } else { Ok(()) }
}

/// Refuses a radius that is not positive.
pub(crate) fn check_radius(radius: f32) -> Result<(), Fault> {
    check_coordinate(radius)?;
    if radius > 0.0 { Ok(()) } else { Err(Fault::RadiusNotPositive) }
}
