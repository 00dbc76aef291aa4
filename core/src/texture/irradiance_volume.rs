//! Light from all around, at the points of a grid in space: an irradiance volume (Greger, Shirley, Hubbard
//! and Greenberg, "The Irradiance Volume", 1998).

use super::blend;
use super::placement::{Placement, Space};
use crate::color::LinearRgb;
use crate::fault::Fault;
use crate::math::{LatticeCoordinate, Real, Vec3};

/// Light that arrives from all around, at the points of a grid in space and in any direction: for things that
/// move in light that was computed before.
///
/// Its [`Placement`] is in the scene and not turned: its origin is the first point of the grid, and its size
/// is the distance of neighboring points. Between points, light is interpolated; beyond the grid, it is that
/// of the nearest point on its border.
///
/// At each point, the light on a surface with the unit normal n is `mean + n.x · x + n.y · y + n.z · z`:
/// spherical harmonics of the first order, multiplied by those of the cosine (Ramamoorthi and Hanrahan, "An
/// Efficient Representation for Irradiance Environment Maps", 2001).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct IrradianceVolume<'a> {
    /// The number of points along x, y and z: 1 or more.
    pub counts: [u8; 3],
    /// Red, green and blue of `mean`, then of `x`, `y` and `z`, each as its share of 32767: for all points,
    /// along x first, then along y.
    pub light: &'a [[i16; 12]],
}

#[cfg(feature = "serde")]
crate::read::read_struct!([] IrradianceVolume as IrradianceVolume<'m> { counts, light });

impl IrradianceVolume<'_> {
    /// Refuses a wrong number of points, and a placement on a surface or turned.
    pub(super) fn check(&self, placement: &Placement) -> Result<(), Fault> {
        let [x, y, z] = self.counts.map(usize::from);
        let (needed, given) = (x.saturating_mul(y).saturating_mul(z), self.light.len());
        if given != needed || given == 0 {
            return Err(Fault::PointCount { needed, given });
        }
        if placement.space != Space::Scene || placement.rotation != Vec3::ZERO {
            return Err(Fault::TurnedVolume);
        }
        Ok(())
    }

    /// The light on a surface with this unit normal, at a place in units of the grid.
    pub(super) fn color<R: Real>(&self, at: [LatticeCoordinate<R>; 3], normal: Vec3<R>) -> LinearRgb<R> {
        let [(x, across), (y, up), (z, along)] = [0, 1, 2].map(|axis| self.between(at, axis));
        let row = |y, z| {
            let [first, second] = x.map(|x| self.point([x, y, z], normal));
            blend(first, second, across)
        };
        let plane = |z| {
            let [lower, upper] = y.map(|y| row(y, z));
            blend(lower, upper, up)
        };
        let [near, far] = z.map(plane);
        let LinearRgb { r, g, b } = blend(near, far, along);
        // Where light comes from one side alone, the other side is darker than black.
        LinearRgb::new(r.larger(R::ZERO), g.larger(R::ZERO), b.larger(R::ZERO))
    }

    /// The points before and behind a coordinate, and the share of the one behind.
    fn between<R: Real>(&self, at: [LatticeCoordinate<R>; 3], axis: usize) -> ([usize; 2], R) {
        let count = self.counts.get(axis).copied().unwrap_or(1);
        let last = usize::from(count.saturating_sub(1));
        let Some(LatticeCoordinate { index, within }) = at.get(axis).copied() else {
            return ([0; 2], R::ZERO);
        };
        match usize::try_from(index) {
            Err(_) => ([0; 2], R::ZERO),
            Ok(index) if index >= last => ([last; 2], R::ZERO),
            Ok(index) => ([index, index.wrapping_add(1)], within),
        }
    }

    /// The light at a point of the grid; black where the list ends before it.
    fn point<R: Real>(&self, [x, y, z]: [usize; 3], normal: Vec3<R>) -> LinearRgb<R> {
        let [columns, rows, _] = self.counts.map(usize::from);
        let index = z.wrapping_mul(rows).wrapping_add(y).wrapping_mul(columns).wrapping_add(x);
        let Some(light) = self.light.get(index) else { return LinearRgb::BLACK };
        let share = |value: i16| {
            let share = R::from_fraction(value.unsigned_abs().wrapping_mul(2));
            if value < 0 { -share } else { share }
        };
        let [r, g, b, rx, gx, bx, ry, gy, by, rz, gz, bz] = light.map(share);
        LinearRgb::new(
            r + normal.dot(Vec3::new(rx, ry, rz)),
            g + normal.dot(Vec3::new(gx, gy, gz)),
            b + normal.dot(Vec3::new(bx, by, bz)),
        )
    }
}

#[cfg(all(test, feature = "textures"))]
mod tests {
    use super::super::{
        Encoding, Ends, Figure, Filter, Image, Map, Onto, Pixels, Placed, PreparedMaps, Texture,
    };
    use super::*;
    use crate::arena::{Arena, Workspace};
    use crate::math::{Fixed, Scale};
    use crate::surface::Surface;

    const HALF: i16 = 16_384;
    /// Dark at x = 1; at x = 3 a half from everywhere, and a half more from above.
    const LIGHT: [[i16; 12]; 2] = [[0; 12], [HALF, HALF, HALF, 0, 0, 0, HALF, HALF, HALF, 0, 0, 0]];
    const VOLUME: IrradianceVolume = IrradianceVolume { counts: [2, 1, 1], light: &LIGHT };
    const PLACEMENT: Placement =
        Placement::in_scene(1.0).stretched(Vec3::new(2.0, 1.0, 1.0)).at(Vec3::new(1.0, 0.0, 0.0));

    /// The light of a map of a figure on a surface at x that faces up or down.
    fn light<R: Real>(figure: Figure<'_>, placement: Placement, x: f32, up: f32, part: u32) -> Option<f32> {
        let placed = Placed::new(figure, placement);
        let maps = [Map { onto: Onto::AmbientLight { most: 2.0 }, texture: Texture::Placed(&placed) }];
        let mut memory = Workspace::<4096>::new();
        let maps: PreparedMaps<'_, R> =
            Map::prepare_all(&maps, Scale::ONE, &mut Arena::new(memory.lend())).unwrap();
        let normal = Vec3::new(R::ZERO, R::from_f32(up), R::ZERO);
        let point = Vec3::new(R::from_f32(x), R::ZERO, R::ZERO);
        let surface = Surface { point, normal, shading_normal: normal, magnitude: R::ONE, part };
        maps.shares(&surface, |_| [R::ZERO, R::ZERO]).ambient_light.map(|light| light.g.to_f32())
    }

    fn assert_lit<R: Real>() {
        let volume = Figure::IrradianceVolume(VOLUME);
        for (x, up, expected) in [
            (3.0, 1.0, 2.0),
            (3.0, -1.0, 0.0),
            (2.0, 1.0, 1.0),
            (1.5, 1.0, 0.5),
            (1.0, 1.0, 0.0),
            // Beyond the grid.
            (-7.0, 1.0, 0.0),
            (9.0, 1.0, 2.0),
        ] {
            let light = light::<R>(volume, PLACEMENT, x, up, 0).unwrap();
            assert!((light - expected).abs() < 1e-4, "{light}, not {expected}, at {x}");
        }
        let image = |codes: &'static [u8]| {
            let (encoding, filter) = (Encoding::Linear, Filter::Bilinear);
            Image { width: 1, height: 1, pixels: Pixels::Rgb888(codes), encoding, filter, ends: Ends::Extend }
        };
        let images = [image(&[0; 3]), image(&[51; 3]), image(&[255; 3])];
        for (part, expected) in [(0, 0.0), (1, 0.4), (2, 2.0), (7, 2.0)] {
            let light = light::<R>(Figure::Parts(&images), Placement::SURFACE, 0.0, 1.0, part).unwrap();
            assert!((light - expected).abs() < 1e-4, "{light}, not {expected}, on part {part}");
        }
    }

    #[test]
    fn light_is_found_between_points_and_on_parts() {
        assert_lit::<f32>();
        assert_lit::<f64>();
        assert_lit::<Fixed>();
    }

    #[test]
    fn bad_volumes_are_refused() {
        let refusal = |volume: IrradianceVolume<'_>, placement| volume.check(&placement).err();
        assert_eq!(refusal(VOLUME, PLACEMENT), None);
        let counts = [3, 1, 1];
        let fault = Some(Fault::PointCount { needed: 3, given: 2 });
        assert_eq!(refusal(IrradianceVolume { counts, ..VOLUME }, PLACEMENT), fault);
        let none = IrradianceVolume { counts: [0; 3], light: &[] };
        assert_eq!(refusal(none, PLACEMENT), Some(Fault::PointCount { needed: 0, given: 0 }));
        assert_eq!(refusal(VOLUME, Placement::SURFACE), Some(Fault::TurnedVolume));
        let turned = PLACEMENT.turned(Vec3::new(0.0, 1.0, 0.0));
        assert_eq!(refusal(VOLUME, turned), Some(Fault::TurnedVolume));
    }
}
