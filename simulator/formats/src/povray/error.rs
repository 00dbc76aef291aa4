//! Errors of writing scenes for POV-Ray.

use core::fmt;

/// The reason why a scene cannot be written for POV-Ray.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum PovrayError {
    /// The background cannot be written. Replace it.
    Background(Lack),
    /// The camera cannot be written. Replace its lens.
    Camera(Lack),
    /// The motions cannot be written. Remove them.
    Motions(Lack),
    /// A light cannot be written. Replace it.
    Light {
        /// The position of the light.
        index: usize,
        /// The reason.
        lack: Lack,
    },
    /// A material cannot be written. Remove the property that the reason names.
    Material {
        /// The position of the material.
        index: usize,
        /// The reason.
        lack: Lack,
    },
    /// The object at this position refers to a material that the scene does not have.
    UnknownMaterial(usize),
    /// The steps of the object at this position do not combine into one solid.
    NotOneSolid(usize),
}

/// A feature that POV-Ray does not have, or has in another form.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Lack {
    /// A flat light with a size: POV-Ray's are as bright from all sides.
    Area,
    /// A lens with blades: POV-Ray's aperture is round.
    Blades,
    /// Bump maps and normal maps: POV-Ray tilts normals by another rule.
    Bumps,
    /// A map of a color of the optics.
    ColorMap,
    /// Light that was baked.
    BakedLight,
    /// A light that falls off with a linear term.
    Falloff,
    /// Mirrored or refracted rays in a lobe.
    Lobes,
    /// Motion blur.
    Motion,
    /// Noise, marble and wood: POV-Ray's noise has other values.
    Noise,
    /// Texture coordinates of a CSG, of instances, of a polyhedron, quadric or implicit surface, or of a mesh
    /// without its own; or of a mesh that has a texture in space as well.
    Place,
    /// A surface that is seen from one side only and throws shadows from both.
    Sides,
    /// A thin sheet with an index of refraction other than 1.
    Thin,
    /// Colors at the vertices of a mesh.
    VertexColors,
    /// An image with another number of pixels than its width times its height.
    Pixels,
    /// Falloff of reflections with distance.
    ReflectionFalloff,
    /// The light of the sky.
    Sky,
    /// Schlick's approximation for a transparent material.
    Schlick,
    /// A transmission color of a surface that is also matte: POV-Ray has one color for both.
    TransmissionColor,
    /// A feature of the core that is newer than this writer.
    New,
}

impl fmt::Display for Lack {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Area => "its flat lights are as bright from all sides",
            Self::Blades => "its aperture is round",
            Self::Bumps => "its bump maps tilt normals by another rule",
            Self::ColorMap => "its finishes have one color of reflection and emission",
            Self::BakedLight => "it holds no baked light: export the scene from before",
            Self::Falloff => "its lights fall off without a linear term",
            Self::Motion => "it blurs nothing that moves",
            Self::Lobes => "its mirrored and refracted rays are sharp",
            Self::Noise => "its noise has other values",
            Self::Place => "texture coordinates on this surface have no formula",
            Self::Pixels => "an image has another number of pixels than its width times its height",
            Self::ReflectionFalloff => "its reflections do not fade with distance",
            Self::Sides => "its surfaces have two sides",
            Self::Sky => "its background gives no light without radiosity",
            Self::Schlick => "Schlick's approximation can be written for opaque surfaces only",
            Self::Thin => "its surfaces bend light, or mirror none of it by Fresnel's equations",
            Self::TransmissionColor => {
                "it has one color for both the diffuse and the transmitted light of a surface"
            }
            Self::VertexColors => "its meshes have whole textures at their vertices, and no factors",
            Self::New => "it is newer than this writer",
        })
    }
}

impl fmt::Display for PovrayError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Motions(lack) => write!(f, "the motions cannot be written for POV-Ray: {lack}"),
            Self::Background(lack) => write!(f, "the background cannot be written for POV-Ray: {lack}"),
            Self::Camera(lack) => write!(f, "the lens cannot be written for POV-Ray: {lack}"),
            Self::Light { index, lack } => write!(f, "light {index} cannot be written for POV-Ray: {lack}"),
            Self::Material { index, lack } => {
                write!(f, "material {index} cannot be written for POV-Ray: {lack}")
            }
            Self::UnknownMaterial(index) => {
                write!(
                    f,
                    "object {index} refers to a material that the scene does not have; add the material"
                )
            }
            Self::NotOneSolid(index) => {
                write!(
                    f,
                    "the steps of object {index} do not combine into one solid; put one operator after each \
                     pair of solids"
                )
            }
        }
    }
}

impl core::error::Error for PovrayError {}
