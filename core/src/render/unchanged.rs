//! Which lines of a picture are surely those of the picture before.

use super::Renderer;
use crate::math::Real;
use crate::shape::Geometry;

impl<R: Real, S: Geometry> Renderer<'_, '_, R, S> {
    /// Whether line `y` surely looks as it did when `before` drew it, so that it need not be drawn again. In realtime
    /// quality that holds for a band of lines if it does for all of them and the one below.
    ///
    /// True where nothing has changed at all: the very same prepared scene and the same settings; and where none of
    /// the objects can be seen on that line, neither now nor then, before the same background, which must be solid where
    /// the camera has moved. Where objects can be seen, is known with the feature `candidates` and of few objects. Else false, also
    /// for lines that happen to be the same. In realtime quality it holds where no budget of rays ends too early.
    ///
    /// ```
    /// use rayline::builtin::CLASSIC;
    /// use rayline::{PreparedScene, Renderer, Settings, Workspace};
    ///
    /// # fn main() -> Result<(), Box<dyn core::error::Error>> {
    /// let (mut memory, mut other) = (Workspace::<8192>::new(), Workspace::<8192>::new());
    /// let mut moved = CLASSIC;
    /// moved.camera.vertical_fov = 1.0;
    /// let (first, second) =
    ///     (PreparedScene::<f32>::new(&CLASSIC, memory.lend())?, PreparedScene::new(&moved, other.lend())?);
    /// let (before, now) = (
    ///     Renderer::new(&first, Settings::new(160, 120))?,
    ///     Renderer::new(&second, Settings::new(160, 120))?,
    /// );
    /// // The sky above, not the spheres.
    /// assert_eq!(now.is_unchanged(&before, 0), cfg!(feature = "candidates"));
    /// assert!(!now.is_unchanged(&before, 60));
    /// # Ok(())
    /// # }
    /// ```
    pub fn is_unchanged<T: Geometry>(&self, before: &Renderer<'_, '_, R, T>, y: u32) -> bool {
        let Some(line) = u16::try_from(y).ok().filter(|y| *y < self.height) else { return false };
        if self.settings != before.settings {
            return false;
        }
        let is_same_scene = core::ptr::addr_eq(self.scene, before.scene);
        is_same_scene
            || self.sees_same_background(before) && self.sees_nothing(line) && before.sees_nothing(line)
    }

    /// Whether surely both see the same where they see nothing else.
    fn sees_same_background<T: Geometry>(&self, before: &Renderer<'_, '_, R, T>) -> bool {
        let (now, then) = (&self.scene.background, &before.scene.background);
        now.is_same(then) && (now.solid().is_some() || self.viewport == before.viewport)
    }

    /// Whether surely no object is seen on a line.
    fn sees_nothing(&self, y: u16) -> bool {
        let spans = self.outlines.strip(y, y);
        spans.is_some_and(|mut spans| spans.all(|span| span.start >= span.end || span.start >= self.width))
    }
}
