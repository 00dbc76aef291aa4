//! Measures the built-in scenes in both qualities and all number systems.

use std::time::Instant;

use rayline::Settings;
use rayline::builtin::{ALL, Builtin};

use super::times::{Times, milliseconds};
use super::{Bench, BenchError};
use crate::table::{Table, thousands};
use crate::{Mode, Number, Picture, RenderOptions, render};

pub(super) fn measure(bench: &Bench, say: &dyn Fn(&str)) -> Result<String, BenchError> {
    let threads = std::thread::available_parallelism().map_or(1, usize::from);
    let (one, all) = ("ms, 1 thread".to_owned(), format!("ms, {threads} threads"));
    let mut table = Table::new(3, ["scene", "mode", "number", &one, &all, "rays", "ns a ray", "PSNR, dB"]);
    for scene in &ALL {
        let reference = picture(bench, scene, Mode::Exact, Number::F64, 0)?;
        for mode in [Mode::Exact, Mode::Realtime] {
            for number in [Number::F32, Number::Fixed, Number::F64] {
                say(&format!("{} {mode} {number}", scene.name));
                let (mut alone, mut together) = (Times::default(), Times::default());
                let mut seen = reference.clone();
                for _ in 0..bench.runs {
                    for (times, threads) in [(&mut together, threads), (&mut alone, 1)] {
                        let start = Instant::now();
                        seen = picture(bench, scene, mode, number, threads)?;
                        times.push(start.elapsed().as_secs_f64());
                    }
                }
                let rays = seen.rays.total();
                table.push([
                    scene.name.to_owned(),
                    mode.to_string(),
                    number.to_string(),
                    milliseconds(alone.best()),
                    milliseconds(together.best()),
                    thousands(rays),
                    format!("{:.0}", alone.best() * 1e9 / rays as f64),
                    seen.decibels(&reference),
                ]);
            }
        }
    }
    let (width, height) = bench.size;
    Ok(format!(
        "Built-in scenes at {width}x{height}: the best times of {} pictures each. PSNR is against the exact \
         picture in f64.\n\n{table}",
        bench.runs
    ))
}

fn picture(
    bench: &Bench,
    scene: &Builtin,
    mode: Mode,
    number: Number,
    threads: usize,
) -> Result<Picture, BenchError> {
    let (width, height) = bench.size;
    let settings = Settings { bounces: scene.bounces, ..Settings::new(width, height) };
    let options = RenderOptions { mode, number, threads, ..RenderOptions::new(settings) };
    Ok(render(scene.scene, &options)?)
}
