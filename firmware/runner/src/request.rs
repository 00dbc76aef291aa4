//! The picture that the user asks for, on any board.

use anyhow::Result;

use crate::board::{Board, EmulatorKind};
use crate::picture::{Mode, Number, Picture, SceneSource, Size};

/// The picture that the user asks for, on any board.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Request {
    pub(crate) scene: SceneSource,
    /// `None`: the board's own size.
    pub(crate) size: Option<Size>,
    /// `None`: the bounces that the scene is designed for.
    pub(crate) bounces: Option<u8>,
    pub(crate) number: Number,
    pub(crate) mode: Mode,
    /// Whether programs leave out the features that only make exact pictures faster.
    pub(crate) small: bool,
    /// Whether lamps with a size light by formulas.
    pub(crate) closed_form: bool,
}

impl Request {
    /// An exact picture in `f32`. `scene` is the name of a built-in scene, or the path of a `.rayline` file.
    pub(crate) fn new(scene: &str) -> Result<Self> {
        Ok(Self {
            scene: SceneSource::open(scene)?,
            size: None,
            bounces: None,
            number: Number::F32,
            mode: Mode::Exact,
            small: false,
            closed_form: false,
        })
    }

    /// The picture that a board renders.
    pub(crate) fn on(&self, board: &Board) -> Picture {
        Picture {
            scene: self.scene,
            size: self.size.unwrap_or(board.size),
            bounces: self.bounces.unwrap_or(self.scene.bounces),
            number: match board.emulator {
                EmulatorKind::Qemu { .. } => self.number,
                EmulatorKind::Rp2040js { .. } => Number::Fixed,
            },
            mode: self.mode,
            small: self.small,
            closed_form: self.closed_form,
        }
    }
}
