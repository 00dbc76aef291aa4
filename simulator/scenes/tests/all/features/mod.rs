//! The tables of `docs/formats.md` against the importers and the export: each row has a file here, whose
//! outcome is the one that the row tells.

mod gltf;
mod nff;
mod obj;
mod povray;
mod table;
