//! Textures of light: what was computed at texels, as images and materials.

use bumpalo::Bump;
use rayline::shape::Mesh;
use rayline::{
    Encoding, Ends, Figure, Filter, Image, Map, Material, Onto, Pixels, Placed, Placement, Texture,
};
use rayline_formats::srgb;

use super::lattice::{Lattice, Texel};
use super::{Light, LightOptions, LightTexels};

/// A surface of this light, before tone curves, is surely white on displays.
const WHITEST: f64 = 4.0;

/// The light at texels. A texel that cannot be seen takes the mean light of the texels around it, so that
/// interpolation brings no darkness from inside of bodies.
fn light(lattice: &Lattice, options: &LightOptions) -> Vec<Light> {
    let (width, height) = (lattice.width, lattice.height);
    let known = |texel: &Texel| (texel.area > 0.0).then(|| arriving(texel, options));
    let mut light: Vec<_> = lattice.texels.iter().map(known).collect();
    while light.iter().any(Option::is_none) && light.iter().any(Option::is_some) {
        let before = light.clone();
        for (index, texel) in light.iter_mut().enumerate().filter(|(_, texel)| texel.is_none()) {
            let (column, line) = (index % width, index / width);
            let (columns, lines) = (column.saturating_sub(1)..=column + 1, line.saturating_sub(1)..=line + 1);
            let around = lines.filter(|line| *line < height).flat_map(|line| {
                columns.clone().filter(|column| *column < width).map(move |column| line * width + column)
            });
            let known: Vec<_> = around.filter_map(|index| before[index]).collect();
            if !known.is_empty() {
                let sum = known.iter().fold(Light::BLACK, |sum, light| sum + *light);
                *texel = Some(sum * (1.0 / known.len() as f64));
            }
        }
    }
    light.into_iter().map(|light| light.unwrap_or(Light::BLACK)).collect()
}

/// The light that the device looks up.
fn arriving(texel: &Texel, options: &LightOptions) -> Light {
    if options.keep_lamps { texel.sent_by_surfaces() } else { texel.arriving() }
}

fn brightest<'l>(light: impl IntoIterator<Item = &'l Light>) -> f64 {
    light.into_iter().fold(0.0, |most: f64, Light { r, g, b }| most.max(*r).max(*g).max(*b))
}

/// The brightest light that is stored, for texels whose brightest light is `light`. Where the texels hold
/// caustics, light far beyond the white of a display is cut off, so that codes are left for dark places.
fn most_stored<'t>(
    light: f64,
    texels: impl Iterator<Item = &'t Texel> + Clone,
    options: &LightOptions,
) -> f64 {
    let caustic = brightest(texels.clone().map(|texel| &texel.caustic));
    if !(caustic > 0.0) {
        return light;
    }
    let reflectance = brightest(texels.clone().map(|texel| &texel.reflectance));
    let others: Vec<_> = texels.map(|texel| arriving(texel, options) + texel.caustic * -1.0).collect();
    let enough = if reflectance > 0.0 { WHITEST / reflectance } else { f64::INFINITY };
    light.min(brightest(&others).max(enough))
}

/// The code of sRGB for light, as a share of the brightest.
fn code_of(light: f64, most: f64) -> u8 {
    if most > 0.0 { srgb::code((light / most).min(1.0) as f32) } else { 0 }
}

/// The map of an object's light, from the lattices of its faces.
pub(super) fn map<'a>(
    faces: &[&Lattice],
    placement: Placement,
    options: &LightOptions,
    arena: &'a Bump,
) -> Map<'a> {
    let light: Vec<_> = faces.iter().map(|lattice| light(lattice, options)).collect();
    let texels = faces.iter().flat_map(|lattice| &lattice.texels);
    let most = most_stored(brightest(light.iter().flatten()), texels, options);
    let image = |lattice: &Lattice, light: &[Light]| {
        // Images begin with the upper line.
        let lines = light.chunks(lattice.width).rev().flatten();
        let codes = lines.map(|Light { r, g, b }| [r, g, b].map(|channel| code_of(*channel, most)));
        let pixels = match options.texels {
            LightTexels::Rgb888 => {
                Pixels::Rgb888(arena.alloc_slice_copy(&codes.flatten().collect::<Vec<_>>()))
            }
            LightTexels::Rgb565 => {
                let level = |code: u8, most: u16| (u16::from(code) * most + 127) / 255;
                let packed = codes.map(|[r, g, b]| level(r, 31) << 11 | level(g, 63) << 5 | level(b, 31));
                Pixels::Rgb565(arena.alloc_slice_copy(&packed.collect::<Vec<_>>()))
            }
        };
        let (width, height) = (lattice.width as u16, lattice.height as u16);
        let (encoding, filter, ends) = (Encoding::Srgb, Filter::Bilinear, Ends::Extend);
        Image { width, height, pixels, encoding, filter, ends }
    };
    let images: Vec<_> = faces.iter().zip(&light).map(|(lattice, light)| image(lattice, light)).collect();
    let figure = match images.as_slice() {
        [image] => Figure::Image(*image),
        images => Figure::Parts(arena.alloc_slice_copy(images)),
    };
    let texture = Texture::Placed(arena.alloc(Placed::new(figure, placement)));
    Map { onto: Onto::AmbientLight { most: most as f32 }, texture }
}

/// The mesh with its light in the colors of its vertices, and the light that white stands for.
pub(super) fn lit_mesh<'a>(
    mesh: &Mesh<'a>,
    texels: &[Texel],
    options: &LightOptions,
    arena: &'a Bump,
) -> (Mesh<'a>, f32) {
    let light: Vec<_> = texels.iter().map(|texel| arriving(texel, options)).collect();
    let most = most_stored(brightest(&light), texels.iter(), options);
    let colors = light.iter().enumerate().map(|(index, Light { r, g, b })| {
        let own = mesh.colors.and_then(|colors| colors.get(index)).copied().unwrap_or([255; 3]);
        let share = |channel: f64, own: u8| code_of(channel * f64::from(srgb::light(own)), most);
        [share(*r, own[0]), share(*g, own[1]), share(*b, own[2])]
    });
    (Mesh { colors: Some(arena.alloc_slice_fill_iter(colors)), ..*mesh }, most as f32)
}

/// A material that scatters the light of a map in place of what it scattered before.
pub(super) fn lit<'a>(
    material: &Material<'a>,
    map: Map<'a>,
    options: &LightOptions,
    arena: &'a Bump,
) -> Material<'a> {
    let mut maps = Vec::new();
    for own in material.maps {
        match own.onto {
            // Leave out a map of ambient light: the new map replaces this light.
            Onto::Ambient => {}
            Onto::Diffuse => {
                maps.push(Map { onto: Onto::Ambient, ..*own });
                if options.keep_lamps {
                    maps.push(*own);
                }
            }
            _ => maps.push(*own),
        }
    }
    maps.push(map);
    let diffuse = if options.keep_lamps { material.diffuse } else { 0.0 };
    Material { ambient: material.diffuse, diffuse, maps: arena.alloc_slice_copy(&maps), ..*material }
}
