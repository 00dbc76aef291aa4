//! Counts of the arithmetic operations of a picture. They are the same on every processor, and a lower bound
//! on the boards' figures, which add loads, stores, branches and slow operations.

use std::mem::MaybeUninit;

use embedded_graphics::pixelcolor::{Rgb888, RgbColor};
use rayline::{PreparedScene, Real, Realtime, Renderer, Sample, Scene, Settings};
use rayline_tests::{Counted, Operations, Screen, operations_of, with_scene};

/// The picture in exact or realtime quality, and the operations of drawing it, without those of preparing the
/// scene.
fn draw<R: Real>(scene: &Scene, settings: Settings, quality: Option<Realtime>) -> (Vec<Rgb888>, Operations) {
    let mut memory = vec![MaybeUninit::uninit(); scene.bytes::<R>()];
    let prepared = PreparedScene::<R>::new(scene, &mut memory).unwrap();
    let renderer = Renderer::new(&prepared, settings).unwrap();
    let mut screen = Screen::new(&renderer);
    let width = settings.width as u16;
    let ((), operations) = operations_of(|| match quality {
        None => renderer.draw(&mut screen, &mut vec![Rgb888::BLACK; width.into()][..]).unwrap(),
        Some(quality) => {
            let mut colors = vec![Rgb888::BLACK; quality.colors(width)];
            let mut samples = vec![Sample::BLANK; quality.samples(width)];
            renderer.draw(&mut screen, quality.lend(&mut colors, &mut samples)).unwrap();
        }
    });
    (screen.picture(), operations)
}

/// Prints a table: `cargo test --release -p rayline-tests operations -- --nocapture`.
#[test]
fn arithmetic_per_pixel_does_not_grow() {
    // Operations of the hand-tuned kernel, and the 3 % more that plain code may take. `prism` may take 4 %:
    // it has a cone and a cylinder, whose discriminant without cancellation takes more operations.
    let most = [
        ("classic", 179.0 * 1.03, 62.0 * 1.03),
        ("whitted", 605.0 * 1.03, 156.0 * 1.03),
        ("flake", 850.0 * 1.03, 699.0 * 1.03),
        ("prism", 1575.0 * 1.04, 575.0 * 1.04),
    ];
    println!(
        "| scene | mode | sums | products | quotients and roots | comparisons | in all |\n\
         |---|---|---:|---:|---:|---:|---:|"
    );
    for (name, exact, realtime) in most {
        with_scene(name, |scene, bounces| {
            let settings = Settings { bounces, ..Settings::new(320, 240) };
            let pixels = f64::from(settings.width * settings.height);
            for (mode, quality, most) in
                [("exact", None, exact), ("realtime", Some(Realtime::new()), realtime)]
            {
                let (picture, operations) = draw::<Counted>(scene, settings, quality);
                assert_eq!(
                    picture,
                    draw::<f32>(scene, settings, quality).0,
                    "{name}: counting changes the picture"
                );
                let per_pixel = |count: u64| count as f64 / pixels;
                let all = per_pixel(operations.all());
                println!(
                    "| {name} | {mode} | {:.1} | {:.1} | {:.1} | {:.1} | {all:.1} |",
                    per_pixel(operations.sums),
                    per_pixel(operations.products),
                    per_pixel(operations.slow),
                    per_pixel(operations.comparisons),
                );
                assert!(all <= most, "{name}, {mode}: {all:.2} operations a pixel, not {most}");
            }
        });
    }
}
