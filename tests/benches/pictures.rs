//! Times of whole pictures on one thread, with the preparation of the scene: `cargo bench -p rayline-tests`.

use criterion::{Criterion, criterion_group, criterion_main};
use rayline::Settings;
use rayline_simulator::{RenderOptions, render};
use rayline_tests::with_scene;

fn pictures(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("160x120, f32, exact");
    group.sample_size(20);
    for name in ["classic", "whitted", "flake", "prism", "balls_s3", "teapot_s2"] {
        with_scene(name, |scene, bounces| {
            let settings = Settings { bounces, ..Settings::new(160, 120) };
            let options = RenderOptions { threads: 1, ..RenderOptions::new(settings) };
            group.bench_function(name, |bencher| bencher.iter(|| render(scene, &options)));
        });
    }
    group.finish();
}

// The items of criterion's macros cannot be documented.
#[allow(missing_docs)]
mod harness {
    use super::*;
    criterion_group!(benches, pictures);
}

criterion_main!(harness::benches);
