//! What POV-Ray cannot be told.

use core::fmt;

/// A part of a scene that POV-Ray cannot be told.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum PovrayError {
    /// The background. Replace it.
    Background(Lack),
    /// The light at this position. Replace it.
    Light {
        /// Its position.
        index: usize,
        /// Why.
        lack: Lack,
    },
    /// The material at this position. Leave out what is named.
    Material {
        /// Its position.
        index: usize,
        /// Why.
        lack: Lack,
    },
    /// The object at this position names a material that the scene does not have.
    UnknownMaterial(usize),
    /// The object at this position has steps that do not leave one solid.
    NotOneSolid(usize),
}

/// What POV-Ray has not, or has in another form.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Lack {
    /// Bumps of textures: POV-Ray tilts normals by another rule.
    Bumps,
    /// A light that falls off with a linear term, or a constant below 1.
    Falloff,
    /// Noise, and so marble and wood: POV-Ray's has other values.
    Noise,
    /// Places on the surface of a solid out of solids, of instances, of a polyhedron, quadric or implicit surface, or of a mesh without
    /// coordinates of its own; or of a mesh that has a texture in space as well.
    Place,
    /// Reflections that fade with distance.
    ReflectionFalloff,
    /// Schlick's shares for what lets light through.
    Schlick,
    /// A color of what comes through, where the surface is matte as well: POV-Ray has one color for both.
    TransmissionColor,
    /// Something that was added to the core since.
    New,
}

impl fmt::Display for Lack {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Bumps => "it tilts bumpy surfaces by another rule",
            Self::Falloff => "its lights fall off as 1 / (1 + (d / distance)²) alone",
            Self::Noise => "its noise has other values",
            Self::Place => "places on this surface have no formula",
            Self::ReflectionFalloff => "its reflections do not fade with distance",
            Self::Schlick => "Schlick's shares are written for opaque surfaces alone",
            Self::TransmissionColor => {
                "it has one color for what a surface scatters and what it lets through"
            }
            Self::New => "it is newer than this writer",
        })
    }
}

impl fmt::Display for PovrayError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Background(lack) => write!(f, "the background cannot be written for POV-Ray: {lack}"),
            Self::Light { index, lack } => write!(f, "light {index} cannot be written for POV-Ray: {lack}"),
            Self::Material { index, lack } => {
                write!(f, "material {index} cannot be written for POV-Ray: {lack}")
            }
            Self::UnknownMaterial(index) => {
                write!(f, "object {index} names a material that the scene does not have")
            }
            Self::NotOneSolid(index) => {
                write!(f, "object {index} has steps that do not leave one solid; give each pair an operator")
            }
        }
    }
}

impl core::error::Error for PovrayError {}
