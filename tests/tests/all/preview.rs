//! Tests of previews: scan conversion against ray tracing.

use std::mem::MaybeUninit;

use embedded_graphics::draw_target::DrawTargetExt;
use embedded_graphics::geometry::{Point, Size};
use embedded_graphics::pixelcolor::{Rgb888, RgbColor};
use embedded_graphics::primitives::Rectangle as Area;
use rayline::builtin::{self, CLASSIC, MESH};
use rayline::limits::{MAX_PREVIEW_FACETS, MAX_PREVIEW_SIDE, MAX_SEGMENTS};
use rayline::math::Fixed;
use rayline::shape::{Cuboid, Disc, Mesh, Plane, Shape, Sphere, Triangle};
use rayline::{
    Background, Camera, Checker, DrawError, Encoding, Ends, Figure, Filter, Image, Light, LineError,
    LinearRgb, Material, Object, Pixels, Placed, Placement, PreparedScene, Preview, PreviewError,
    PreviewFacet, PreviewPixel, Real, Renderer, Scene, Settings, Texture, Vec3,
};
use rayline_simulator::{Number, RenderOptions, Visibility};
use rayline_tests::Screen;

const WIDTH: usize = 96;
const HEIGHT: usize = 72;

fn settings() -> Settings {
    Settings { bounces: 0, ..Settings::new(WIDTH as u32, HEIGHT as u32) }
}

fn with_renderer<R: Real, T>(scene: &Scene, settings: Settings, then: impl FnOnce(&Renderer<R>) -> T) -> T {
    let mut memory = vec![MaybeUninit::uninit(); scene.bytes::<R>()];
    let prepared = PreparedScene::new(scene, &mut memory).expect("a legal scene");
    then(&Renderer::new(&prepared, settings).expect("legal settings"))
}

/// Memory for many facets.
fn memory() -> Vec<PreviewFacet> {
    vec![PreviewFacet::BLANK; MAX_PREVIEW_FACETS]
}

/// What the pixels show when they are traced, and by scan conversion.
fn seen(scene: &Scene, number: Number, segments: u16) -> Visibility {
    let options = RenderOptions { number, segments, ..RenderOptions::new(settings()) };
    Visibility::of(scene, &options).expect("a preview")
}

#[test]
fn both_ways_see_the_same_objects_but_at_edges() {
    for builtin::Builtin { name, scene, .. } in builtin::all() {
        for number in [Number::F32, Number::Fixed] {
            let Visibility { traced, differ, differ_inside, .. } = seen(scene, number, MAX_SEGMENTS);
            assert!(traced > 0, "{name}");
            // Of 6912.
            assert!(differ_inside <= 14, "{name}, {number}: {differ_inside} pixels away from edges");
            assert!(differ <= 350, "{name}, {number}: {differ} pixels");
        }
    }
}

#[test]
fn a_mesh_is_seen_where_its_rays_meet_it() {
    let mesh = &Scene { objects: &MESH.objects[..1], ..MESH };
    for scene in [mesh, &MESH] {
        let seen = seen(scene, Number::F32, 6);
        if scene.objects.len() == 1 {
            // A 16th of a pixel decides.
            assert!(seen.differ <= 12, "{seen:?}");
            assert!(seen.scanned > 500, "{seen:?}");
        }
        assert_eq!(seen.differ_inside, 0);
    }
}

/// The picture of a preview.
fn preview<R: Real>(scene: &Scene, settings: Settings, segments: u16) -> Vec<Rgb888> {
    with_renderer::<R, _>(scene, settings, |renderer| {
        let width = renderer.width() as usize;
        let mut screen = Screen::new(renderer);
        let mut facets = memory();
        let mut preview = Preview::new(renderer, segments, &mut facets).expect("a preview");
        let (mut line, mut pixels) = (vec![Rgb888::BLACK; width], vec![PreviewPixel::BLANK; width]);
        renderer.draw(&mut screen, preview.lend(&mut line, &mut pixels)).expect("a picture");
        screen.picture()
    })
}

fn traced<R: Real>(scene: &Scene, settings: Settings) -> Vec<Rgb888> {
    with_renderer::<R, _>(scene, settings, |renderer| {
        let mut pixels = vec![Rgb888::BLACK; (renderer.width() * renderer.height()) as usize];
        renderer.lines(0, &mut pixels, &mut ()).expect("lines");
        pixels
    })
}

/// How many pixels differ by more than this many of 255 levels.
fn off(a: &[Rgb888], b: &[Rgb888], levels: u8) -> usize {
    let channels = |color: &Rgb888| [color.r(), color.g(), color.b()];
    let is_off = |(a, b): &(&Rgb888, &Rgb888)| {
        channels(a).into_iter().zip(channels(b)).any(|(a, b)| a.abs_diff(b) > levels)
    };
    a.iter().zip(b).filter(is_off).count()
}

const CAMERA: Camera = Camera {
    eye: Vec3::new(0.0, 0.0, 5.0),
    target: Vec3::ZERO,
    up: Vec3::new(0.0, 1.0, 0.0),
    vertical_fov: 0.6,
    lens: None,
};

/// A material that shows its color and no lamp.
const fn flat(color: Texture<'_>) -> Material<'_> {
    Material { color, ambient: 1.0, diffuse: 0.0, ..Material::matte(LinearRgb::WHITE) }
}

#[test]
fn light_is_interpolated_between_corners() {
    let scene = Scene {
        camera: CAMERA,
        background: Background::Solid(LinearRgb::new(0.1, 0.2, 0.4)),
        objects: &[Object::new(Shape::Sphere(Sphere::new(Vec3::ZERO, 1.2)), 0)],
        materials: &[Material::matte(LinearRgb::new(0.9, 0.5, 0.3))],
        lights: &[
            Light::Point { position: Vec3::new(4.0, 5.0, 6.0), color: LinearRgb::gray(0.6) },
            Light::Directional { direction: Vec3::new(2.0, -1.0, -1.0), color: LinearRgb::gray(0.3) },
        ],
        motions: &[],
    };
    let exact = traced::<f32>(&scene, settings());
    for (picture, levels, most) in
        [(preview::<f32>(&scene, settings(), 64), 4, 160), (preview::<Fixed>(&scene, settings(), 64), 4, 160)]
    {
        let off = off(&picture, &exact, levels);
        assert!(off <= most, "{off} pixels");
    }
    // Few facets are flat patches of light, but neighbors meet in the same light.
    let coarse = preview::<f32>(&scene, settings(), 8);
    let steps = coarse.windows(2).filter(|pair| off(&pair[..1], &pair[1..], 40) > 0).count();
    assert!(steps <= 2 * HEIGHT, "{steps} edges");
}

#[test]
fn textures_have_the_right_perspective() {
    let checker = Texture::Checker(Checker {
        even: LinearRgb::gray(0.9),
        odd: LinearRgb::gray(0.1),
        cells_per_unit: Vec3::new(1.0, 1.0, 1.0),
    });
    let image = Image {
        width: 2,
        height: 2,
        pixels: Pixels::Rgb888(&[255, 0, 0, 0, 255, 0, 0, 0, 255, 255, 255, 0]),
        encoding: Encoding::Srgb,
        filter: Filter::Bilinear,
        ends: Ends::Extend,
    };
    let placed = Placed::new(Figure::Image(image), Placement::SURFACE);
    let (vertices, uvs): (&[Vec3], &[[f32; 2]]) = (
        &[
            Vec3::new(-2.0, -1.0, 3.5),
            Vec3::new(2.0, -1.0, 3.5),
            Vec3::new(2.0, -1.0, -40.0),
            Vec3::new(-2.0, -1.0, -40.0),
        ],
        &[[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]],
    );
    let floor = Mesh { uvs: Some(uvs), ..Mesh::new(vertices, &[[0, 1, 2], [0, 2, 3]]) };
    for texture in [checker, Texture::Placed(&placed)] {
        let scene = Scene {
            camera: CAMERA,
            background: Background::BLACK,
            objects: &[Object::new(Shape::Mesh(floor), 0)],
            materials: &[flat(texture)],
            lights: &[],
            motions: &[],
        };
        let (exact, shown) = (traced::<f32>(&scene, settings()), preview::<f32>(&scene, settings(), 16));
        assert!(off(&exact, &[Rgb888::BLACK; WIDTH * HEIGHT], 20) > 1000);
        let off = off(&shown, &exact, 2);
        assert!(off <= 40, "{off} pixels");
    }
}

/// The top of each shape is level with the ends of cells: all of it is in one row of them, in both ways.
#[test]
fn textures_do_not_change_on_the_facet() {
    let cells_per_unit = Vec3::new(0.5, 1.0, 0.5);
    let checker = Checker { even: LinearRgb::gray(0.9), odd: LinearRgb::gray(0.1), cells_per_unit };
    let up = Vec3::new(0.0, 1.0, 0.0);
    for shape in [
        Shape::Disc(Disc::new(Vec3::ZERO, up, 9.0)),
        Shape::Plane(Plane::new(Vec3::ZERO, up)),
        Shape::Cuboid(Cuboid::aligned(Vec3::new(-9.0, -1.0, -9.0), Vec3::new(9.0, 0.0, 9.0))),
    ] {
        let scene = Scene {
            camera: Camera { eye: Vec3::new(0.3, 2.0, 6.0), target: Vec3::ZERO, ..CAMERA },
            background: Background::BLACK,
            objects: &[Object::new(shape, 0)],
            materials: &[flat(Texture::Checker(checker))],
            lights: &[],
            motions: &[],
        };
        for (exact, shown) in [
            (traced::<f32>(&scene, settings()), preview::<f32>(&scene, settings(), 16)),
            (traced::<Fixed>(&scene, settings()), preview::<Fixed>(&scene, settings(), 16)),
        ] {
            assert!(off(&exact, &[Rgb888::BLACK; WIDTH * HEIGHT], 20) > 3000, "{shape:?}");
            let off = off(&shown, &exact, 2);
            assert!(off <= 60, "{shape:?}: {off} pixels");
        }
    }
}

#[test]
fn facets_are_clipped_at_all_sides_and_at_the_eye() {
    // A triangle that passes the eye, and reaches far beyond all sides.
    let triangle = Triangle::flat(
        Vec3::new(-90.0, -1.0, 30.0),
        Vec3::new(90.0, -1.0, 30.0),
        Vec3::new(0.0, -1.0, -80.0),
    );
    let room = Cuboid::aligned(Vec3::new(-3.0, -2.0, -6.0), Vec3::new(3.0, 2.0, 6.0));
    for (shape, whole) in [(Shape::Triangle(triangle), false), (Shape::Cuboid(room), true)] {
        let scene = Scene {
            camera: CAMERA,
            background: Background::BLACK,
            objects: &[Object::new(shape, 0)],
            materials: &[flat(Texture::Solid(LinearRgb::WHITE))],
            lights: &[],
            motions: &[],
        };
        for seen in [Number::F32, Number::Fixed].map(|number| seen(&scene, number, 16)) {
            assert!(seen.differ <= 10, "{seen:?}");
            assert_eq!(seen.differ_inside, 0);
            assert_eq!(seen.scanned == seen.pixels, whole);
        }
    }
}

#[test]
fn lines_and_columns_have_the_same_bytes_in_any_order() {
    let whole = preview::<f32>(&CLASSIC, settings(), 16);
    with_renderer::<f32, _>(&CLASSIC, settings(), |renderer| {
        let mut facets = memory();
        let mut preview = Preview::new(renderer, 16, &mut facets).expect("a preview");
        let (mut line, mut pixels) = ([Rgb888::BLACK; WIDTH], [PreviewPixel::BLANK; WIDTH]);
        let mut screen = Screen::new(renderer);
        for y in (0..HEIGHT as u32).rev() {
            let lent = preview.lend(&mut line, &mut pixels);
            renderer.frame(y..y + 1, lent).expect("a line").draw(&mut screen).expect("a picture");
        }
        assert_eq!(screen.picture(), whole);
        // A preview that was scanned before.
        preview.scan(HEIGHT as u16 / 2, &mut pixels);
        let mut screen = Screen::new(renderer);
        renderer.draw(&mut screen, preview.lend(&mut line, &mut pixels)).expect("a picture");
        assert_eq!(screen.picture(), whole);
        let mut after = [PreviewPixel::BLANK; WIDTH];
        preview.scan(HEIGHT as u16 / 2, &mut after);
        preview.scan(0, &mut pixels);
        preview.scan(HEIGHT as u16 / 2, &mut pixels);
        assert_eq!(pixels, after);
        // In steps, one line each.
        let mut screen = Screen::new(renderer);
        let mut frame =
            renderer.frame(0..HEIGHT as u32, preview.lend(&mut line, &mut pixels)).expect("lines");
        let mut steps = 1;
        while !frame.step(&mut screen, 1).expect("a step").is_done() {
            steps += 1;
        }
        assert_eq!((steps, screen.picture()), (HEIGHT, whole.clone()));
        // Only what the display shows is drawn.
        let mut screen = Screen::new(renderer);
        let area = Area::new(Point::new(31, 17), Size::new(40, 30));
        let lent = preview.lend(&mut line, &mut pixels);
        renderer.draw(&mut screen.clipped(&area), lent).expect("a picture");
        for (place, (shown, whole)) in screen.pixels.iter().zip(&whole).enumerate() {
            let point = Point::new((place % WIDTH) as i32, (place / WIDTH) as i32);
            assert_eq!(*shown, area.contains(point).then_some(*whole), "{point}");
        }
    });
}

#[test]
fn what_is_wrong_is_told() {
    with_renderer::<f32, _>(&CLASSIC, settings(), |renderer| {
        let needed = Preview::new(renderer, 16, &mut memory()).expect("a preview").facets();
        assert!(needed > 100);
        let lent = needed - 1;
        let error = Preview::new(renderer, 16, &mut memory()[..lent]).expect_err("too few");
        assert_eq!(error, PreviewError::Facets { needed, lent });
        assert!(error.to_string().contains(&needed.to_string()), "{error}");
        assert!(Preview::new(renderer, 16, &mut memory()[..needed]).is_ok());
        for given in [0, 5, MAX_SEGMENTS + 1] {
            let error = Preview::new(renderer, given, &mut memory()).expect_err("segments");
            assert_eq!(error, PreviewError::Segments { given });
        }
        let mut facets = memory();
        let mut preview = Preview::new(renderer, 16, &mut facets).expect("a preview");
        let (mut line, mut pixels) = ([Rgb888::BLACK; WIDTH], [PreviewPixel::BLANK; WIDTH]);
        let mut screen = Screen::new(renderer);
        let short = LineError::BufferLength { given: WIDTH - 1, width: WIDTH as u32 };
        let lent = preview.lend(&mut line, &mut pixels[1..]);
        assert_eq!(renderer.draw(&mut screen, lent), Err(DrawError::Line(short)));
        let lent = preview.lend(&mut line[1..], &mut pixels);
        assert_eq!(renderer.draw(&mut screen, lent), Err(DrawError::Line(short)));
        with_renderer::<f32, _>(&CLASSIC, Settings::new(WIDTH as u32, 9), |other| {
            let lent = preview.lend(&mut line, &mut pixels);
            assert_eq!(other.draw(&mut screen, lent), Err(DrawError::Line(LineError::OtherPicture)));
        });
        assert!(screen.pixels.iter().all(Option::is_none));
    });
    let side = MAX_PREVIEW_SIDE + 1;
    with_renderer::<f32, _>(&CLASSIC, Settings::new(side.into(), 4), |renderer| {
        let error = Preview::new(renderer, 16, &mut memory()).expect_err("too wide");
        assert_eq!(error, PreviewError::Size { side });
    });
}
