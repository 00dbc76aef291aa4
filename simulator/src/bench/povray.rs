//! Measures Rayline beside POV-Ray, with the same scenes and one thread each.

use std::path::Path;

use bumpalo::Bump;
use cpu_time::ProcessTime;
use rayline::{Settings, Transfer};

use super::times::{Times, milliseconds};
use super::{Bench, BenchError};
use crate::povray::{self, PovrayPicture};
use crate::table::Table;
use crate::{RenderOptions, nff, render};

/// Scenes of spheres, triangles and cylinders, from the Standard Procedural Databases.
const SCENES: [(&str, &str); 3] = [
    ("balls_s3", include_str!("../../../tests/scenes/balls_s3.nff")),
    ("teapot_s2", include_str!("../../../tests/scenes/teapot_s2.nff")),
    ("rings_s1", include_str!("../../../tests/scenes/rings_s1.nff")),
];

pub(super) fn measure(
    bench: &Bench,
    directory: &Path,
    say: &dyn Fn(&str),
) -> Result<Option<String>, BenchError> {
    let side = bench.povray_side;
    let mut table = Table::new(
        1,
        [
            "scene",
            "Rayline, ms",
            "best",
            "POV-Ray, ms",
            "best",
            "its parsing, ms",
            "times as fast",
            "pixels alike",
        ],
    );
    for (name, text) in SCENES {
        let arena = Bump::new();
        let scene = nff::parse(&arena, text).map_err(BenchError::Scene)?.scene;
        let settings = Settings { transfer: Transfer::Linear, ..Settings::new(side, side) };
        let options = RenderOptions { threads: 1, ..RenderOptions::new(settings) };
        let (mut ours, mut theirs, mut parsing) = <(Times, Times, Times)>::default();
        let mut alike = f64::NAN;
        for run in 0..bench.runs {
            say(&format!("{name} beside POV-Ray, {} of {}", run + 1, bench.runs));
            let start = ProcessTime::now();
            let own = render(&scene, &options)?;
            ours.push(start.elapsed().as_secs_f64());
            let povray = povray::render(&scene, &settings, directory, name).map_err(BenchError::Povray)?;
            let Some(povray) = povray else { return Ok(None) };
            theirs.push(seconds(&povray, "Trace Time")?);
            parsing.push(seconds(&povray, "Parse Time")? + seconds(&povray, "Bounding Time")?);
            alike = share_alike(&own.rgb, &povray.rgb);
        }
        table.push([
            name.to_owned(),
            milliseconds(ours.median()),
            milliseconds(ours.best()),
            milliseconds(theirs.median()),
            milliseconds(theirs.best()),
            milliseconds(parsing.median()),
            format!("{:.2}", theirs.median() / ours.median()),
            format!("{:.1} %", alike * 100.0),
        ]);
    }
    Ok(Some(format!(
        "Rayline (f32, exact; preparing and tracing; built for {}) and POV-Ray (tracing alone) at \
         {side}x{side} on one thread each: medians of the processor's time for {} pictures in turn. Pixels \
         are alike where no channel differs by more than 2 of 255.\n\n{table}",
        built_for(),
        bench.runs
    )))
}

/// The processors that this program was built for. It is faster if it may use AVX2.
fn built_for() -> String {
    let arch = std::env::consts::ARCH;
    if cfg!(target_feature = "avx2") { format!("{arch} with AVX2") } else { format!("any {arch}") }
}

fn seconds(picture: &PovrayPicture, step: &'static str) -> Result<f64, BenchError> {
    picture.cpu_seconds(step).ok_or(BenchError::NoTime(step))
}

/// The share of pixels, 0 to 1, whose channels all differ by at most 2 of 255.
fn share_alike(ours: &[u8], theirs: &[u8]) -> f64 {
    let is_alike = |(a, b): (&[u8], &[u8])| a.iter().zip(b).all(|(a, b)| a.abs_diff(*b) <= 2);
    let pixels = ours.chunks_exact(3).zip(theirs.chunks_exact(3));
    pixels.clone().filter(|pixel| is_alike(*pixel)).count() as f64 / pixels.count() as f64
}
