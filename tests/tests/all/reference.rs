//! Comparisons of the core in `f32` and in `f64` with the textbook renderer and with each other.

use std::path::Path;

use rayline::builtin::WHITTED;
use rayline::{
    Brick, Ends, Figure, Gradient, LinearRgb, Material, Placed, Placement, Scene, Squares, Stripes, Texture,
    Vec3,
};
use rayline_tests::{assert_alike, core_picture, settings, textbook::Textbook, with_scene};

rayline_tests::each_scene!(check);

fn check(name: &str) {
    with_scene(name, |scene, bounces| {
        let settings = settings(bounces);
        let single = core_picture::<f32>(scene, settings);
        let double = core_picture::<f64>(scene, settings);
        let textbook = Textbook::new(scene, settings).picture();
        let directory = Path::new(env!("CARGO_TARGET_TMPDIR"));
        assert_alike(directory, name, ("f32", &single), ("textbook", &textbook));
        assert_alike(directory, name, ("f64", &double), ("textbook", &textbook));
        assert_alike(directory, name, ("f32", &single), ("f64", &double));
    });
}

#[test]
fn plain_figures() {
    let (dark, light) = (LinearRgb::new(0.6, 0.1, 0.1), LinearRgb::gray(0.9));
    let leaning =
        Placement::in_scene(0.4).turned(Vec3::new(0.3, -0.5, 0.7)).at(Vec3::new(0.123, 0.456, 0.789));
    let figures = [
        Figure::Squares(Squares { even: dark, odd: light }),
        Figure::Stripes(Stripes { first: dark, second: light, width: 0.3 }),
        Figure::Gradient(Gradient { from: dark, to: light, ends: Ends::Mirror }),
        Figure::Gradient(Gradient { from: dark, to: light, ends: Ends::Repeat }),
        Figure::Brick(Brick { brick: dark, mortar: light, gap: [0.1, 0.2] }),
    ];
    let placed = figures.map(|figure| Placed::new(figure, leaning));
    for (index, placed) in placed.iter().enumerate() {
        let textured =
            |material: &Material<'static>| Material { color: Texture::Placed(placed), ..*material };
        let materials: Vec<_> = WHITTED.materials.iter().map(textured).collect();
        let scene = Scene { materials: &materials, ..WHITTED };
        let settings = settings(2);
        let single = core_picture::<f32>(&scene, settings);
        let textbook = Textbook::new(&scene, settings).picture();
        let directory = Path::new(env!("CARGO_TARGET_TMPDIR"));
        assert_alike(directory, &format!("figure-{index}"), ("f32", &single), ("textbook", &textbook));
    }
}
