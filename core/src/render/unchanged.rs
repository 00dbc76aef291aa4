//! Lines that look as they did in the picture before, and need not be drawn again.

use super::Renderer;
use super::pixel::Aim;
use crate::math::Real;
use crate::shape::Geometry;

impl<R: Real, S: Geometry> Renderer<'_, '_, R, S> {
    /// Whether line `y` certainly looks as it did when `before` drew it, and need not be drawn again. In
    /// realtime quality, a band of lines is unchanged if all its lines and the line below it are (with smooth
    /// edges, the line above it too), and if no budget of rays ended too early.
    ///
    /// The answer is `true` in two cases. First, nothing has changed: both renderers have the same prepared
    /// scene, at the same address, and the same settings. Second, no object can be seen on that line in
    /// either picture, and the background is the same; if the camera has moved, the background must be
    /// solid. Lines without objects are known with the feature `candidates`, in scenes of up to
    /// [`FEW_OBJECTS`](crate::limits::FEW_OBJECTS) objects. In all other cases the answer is `false`, also
    /// for lines that happen to be the same.
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

    /// Whether rays that meet no object certainly see the same in both pictures.
    fn sees_same_background<T: Geometry>(&self, before: &Renderer<'_, '_, R, T>) -> bool {
        let (now, then) = (&self.scene.background, &before.scene.background);
        now.is_same(then) && (now.solid().is_some() || self.viewport == before.viewport)
    }

    /// Whether certainly no object is seen on a line.
    fn sees_nothing(&self, y: u16) -> bool {
        #[cfg(not(feature = "looks"))]
        let spans = self.outlines.strip((y, y), Aim::Area);
        // The line has contours of what the line below shows.
        #[cfg(feature = "looks")]
        let below = if self.contours.is_some() { y.saturating_add(1) } else { y };
        #[cfg(feature = "looks")]
        let spans = self.outlines.strip((y, below), Aim::Area);
        spans.is_some_and(|mut spans| spans.all(|span| span.start >= span.end || span.start >= self.width))
    }
}
