//! Materials, textures and backgrounds.

use rayline::{
    Background, Brick, Encoding, Ends, Figure, Filter, Fresnel, Gradient, Highlight, Image, LinearRgb, Map,
    Marble, Material, Medium, Noise, Onto, Optics, Panorama, Pixels, Placed, Placement, Sides, Sky, Squares,
    Stripes, Texture, Vec3, Wood,
};

use super::Maker;

impl<'a> Maker<'_, '_, 'a> {
    fn color(&mut self) -> LinearRgb {
        let [r, g, b] = [(); 3].map(|()| self.choices.share());
        LinearRgb::new(r, g, b)
    }

    pub(super) fn material(&mut self) -> Material<'a> {
        let mut material = Material::matte(self.color());
        if self.choices.chance(30) {
            material.color = self.texture();
        }
        match self.choices.below(6) {
            0 => material.reflectance = self.choices.one_of([1.0, 0.5, 0.9]),
            1 => {
                material.transmittance = self.choices.one_of([1.0, 0.5, 0.9]);
                material.ior = self.choices.one_of([1.5, 1.0, 1.33, 0.7, 2.4]);
                material.reflectance = 1.0 - material.transmittance;
            }
            2 => {
                let share = self.choices.share();
                (material.reflectance, material.transmittance) = (share * 0.6, (1.0 - share) * 0.6);
                material.ior = self.choices.within(0.8, 2.0);
            }
            _ => {}
        }
        if self.choices.chance(60) {
            material.ambient = self.choices.share();
            material.specular = self.choices.share();
            material.shininess = self.choices.one_of([10.0, 1.0, 0.0, 50.0, 1000.0, 1e5]);
            material.diffuse = self.choices.share();
        }
        if self.choices.chance(25) {
            material.optics = Some(self.optics(material.transmittance > 0.0));
        }
        if self.choices.chance(8) {
            let colors = [Onto::ReflectionColor, Onto::TransmissionColor, Onto::Emission];
            let onto = if material.optics.is_some() && self.choices.chance(30) {
                self.choices.one_of(colors)
            } else {
                self.choices.one_of([
                    Onto::Diffuse,
                    Onto::Ambient,
                    Onto::Specular,
                    Onto::Reflectance,
                    Onto::Transmittance,
                    Onto::Bump { height: 0.1, step: 0.05 },
                    Onto::Normal { strength: 1.0 },
                ])
            };
            let texture = self.texture();
            material.maps = self.arena.alloc_slice_copy(&[Map { onto, texture }]);
        }
        material
    }

    fn optics(&mut self, is_glass: bool) -> &'a Optics {
        let mut optics = Optics {
            highlight: self.choices.one_of([Highlight::Phong, Highlight::BlinnPhong]),
            fresnel: self.choices.one_of([Fresnel::Exact, Fresnel::Schlick, Fresnel::Constant]),
            ..Optics::PLAIN
        };
        if self.choices.chance(40) {
            optics.reflection_color = self.color();
            optics.transmission_color = self.color();
        }
        if self.choices.chance(40) {
            optics.absorption = self.color();
        }
        if self.choices.chance(20) {
            optics.emission = self.color();
            optics.emission_sides = self.choices.one_of([Sides::Both, Sides::Front]);
        }
        if self.choices.chance(15) {
            optics.outside = Medium { ior: self.choices.within(0.8, 1.6), absorption: self.color() };
        }
        if self.choices.chance(15) {
            optics.gloss = Some(self.choices.one_of([0.0, 3.0, 100.0, 1e5]));
        }
        if self.choices.chance(15) {
            optics.translucency = Some(self.choices.one_of([0.0, 3.0, 100.0, 1e5]));
        }
        if !is_glass && self.choices.chance(20) {
            optics.sides = Sides::Front;
        }
        if self.choices.chance(10) {
            (optics.thin, optics.absorption) = (true, LinearRgb::gray(0.0));
        }
        self.arena.alloc(optics)
    }

    fn texture(&mut self) -> Texture<'a> {
        let (one, other) = (self.color(), self.color());
        let size = self.choices.length().clamp(1e-3, 1e4);
        if self.choices.chance(40) {
            return Texture::checker_xz(one, other, size);
        }
        let octaves = self.choices.between(1, 4) as u8;
        let turbulence = self.choices.within(0.0, 4.0);
        let figure = match self.choices.below(8) {
            0 => Figure::Squares(Squares { even: one, odd: other }),
            1 => Figure::Stripes(Stripes { first: one, second: other, width: self.choices.within(0.1, 0.9) }),
            2 => Figure::Gradient(Gradient { from: one, to: other, ends: self.ends() }),
            3 => Figure::Noise(Noise { low: one, high: other, octaves }),
            4 => Figure::Marble(Marble { stone: one, vein: other, turbulence, octaves }),
            5 => Figure::Wood(Wood { early: one, late: other, turbulence, octaves }),
            6 => Figure::Brick(Brick { brick: one, mortar: other, gap: [0.1, 0.2] }),
            _ => Figure::Image(self.image()),
        };
        let placement = if self.choices.chance(50) { Placement::SURFACE } else { Placement::in_scene(size) };
        Texture::Placed(self.arena.alloc(Placed::new(figure, placement)))
    }

    fn ends(&mut self) -> Ends {
        self.choices.one_of([Ends::Repeat, Ends::Mirror, Ends::Extend])
    }

    fn image(&mut self) -> Image<'a> {
        let texels: Vec<u16> = (0..6).map(|_| self.choices.word() as u16).collect();
        Image {
            width: 3,
            height: 2,
            pixels: Pixels::Rgb565(self.arena.alloc_slice_copy(&texels)),
            encoding: self.choices.one_of([Encoding::Srgb, Encoding::Linear]),
            filter: self.choices.one_of([Filter::Bilinear, Filter::Nearest]),
            ends: self.ends(),
        }
    }

    pub(super) fn background(&mut self) -> Background<'a> {
        let color = self.color();
        match self.choices.below(12) {
            0 => Background::Gradient(self.arena.alloc(Sky::new(color, self.color()))),
            1 => {
                let panorama = Panorama { image: self.image(), rotation: Vec3::ZERO };
                Background::Image(self.arena.alloc(panorama))
            }
            2 => Background::BLACK,
            _ => Background::Solid(color),
        }
    }
}
