//! The error of a picture against the number of its samples, for each sampler.

use core::fmt::Write as _;

use rayline::{PreparedScene, RayCounts, Renderer, Sampler, Sampling, Scene, Settings};
use rayon::prelude::*;

use crate::picture::memory_for;
use crate::table::Table;
use crate::{RenderError, SAMPLERS};

/// The errors of all samplers.
#[derive(Clone, Debug, PartialEq)]
pub struct Convergence {
    /// For each of [`SAMPLERS`], its root mean square error in linear light with 1, 4, 16, 64 and 256
    /// samples.
    pub errors: Vec<(Sampler, [f64; 5])>,
}

/// The numbers of samples that are measured.
const SAMPLES: [u16; 5] = [1, 4, 16, 64, 256];

/// The colors of the samplers' curves.
const COLORS: [&str; SAMPLERS.len()] = ["#888888", "#b8860b", "#1f77b4", "#2ca02c", "#d62728", "#000000"];

/// The samples of the picture that all others are compared with.
const REFERENCE: u16 = 4096;

impl Convergence {
    /// Renders the scene with several seeds, and compares with 4096 samples.
    ///
    /// # Errors
    /// The scene or its settings are refused.
    pub fn measure(scene: &Scene<'_>, settings: Settings) -> Result<Self, RenderError> {
        let settings = Settings { rays_per_pixel: u32::MAX, ..settings };
        let mut memory = memory_for::<f32>(scene);
        let prepared = PreparedScene::<f32, _>::new(scene, &mut memory).map_err(RenderError::Scene)?;
        let draw = |sampling| lights(&prepared, Settings { sampling, ..settings });
        let other_seed = u32::MAX;
        let reference =
            draw(Sampling { sampler: Sampler::Sobol, seed: other_seed, ..Sampling::new(REFERENCE) })?;
        let mut errors = Vec::new();
        for (_, sampler) in SAMPLERS {
            let mut of_sampler = [0.0; SAMPLES.len()];
            for (error, samples) in of_sampler.iter_mut().zip(SAMPLES) {
                let mut squares = 0.0;
                for seed in 0..SEEDS {
                    let picture = draw(Sampling { sampler, seed, ..Sampling::new(samples) })?;
                    squares += mean_square(&picture, &reference);
                }
                *error = (squares / f64::from(SEEDS)).sqrt();
            }
            errors.push((sampler, of_sampler));
        }
        Ok(Self { errors })
    }

    /// The power of the number of samples with which the error of a sampler changes: the slope of its curve
    /// from 4 to 256 samples.
    pub fn slope(&self, sampler: Sampler) -> f64 {
        let curve = self.errors.iter().find(|(other, _)| *other == sampler);
        // From 4 samples on: a single one lies in the center.
        curve.map_or(f64::NAN, |(_, [_, first, .., last])| (last / first).ln() / 64f64.ln())
    }

    /// The errors as a table in Markdown.
    pub fn table(&self) -> String {
        let [a, b, c, d, e] = SAMPLES.map(|count| format!("{count} samples"));
        let mut table = Table::new(1, ["sampler", &a, &b, &c, &d, &e, "slope"]);
        for ((name, _), (sampler, errors)) in SAMPLERS.iter().zip(&self.errors) {
            let [a, b, c, d, e] = errors.map(|error| format!("{:.3} %", error * 100.0));
            let slope = format!("{:.2}", self.slope(*sampler));
            table.push([(*name).to_owned(), a, b, c, d, e, slope]);
        }
        table.to_string()
    }

    /// The errors as a plot with logarithmic axes, in the format SVG.
    pub fn plot(&self) -> String {
        let (width, height, margin) = (560.0, 360.0, 56.0);
        let all = || self.errors.iter().flat_map(|(_, errors)| errors).copied();
        let (least, most) = (all().fold(f64::MAX, f64::min), all().fold(0.0, f64::max));
        let (low, high) = (least.log10().floor(), most.log10().ceil());
        let last = (SAMPLES.len() - 1) as f64;
        let across = |index: usize| margin + index as f64 / last * (width - 2.5 * margin);
        let down =
            |error: f64| margin / 2.0 + (high - error.log10()) / (high - low) * (height - 1.5 * margin);
        let mut svg = format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width} {height}\" \
             font-family=\"sans-serif\" font-size=\"12\">\n\
             <rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n"
        );
        // Writing into a string cannot fail.
        for (index, count) in SAMPLES.iter().enumerate() {
            let (x, y) = (across(index), height - margin);
            let _ = writeln!(
                svg,
                "<path d=\"M{x:.1} {:.1}V{y:.1}\" stroke=\"#ddd\"/><text x=\"{x:.1}\" y=\"{:.1}\" \
                 text-anchor=\"middle\">{count}</text>",
                margin / 2.0,
                y + 16.0
            );
        }
        for power in low as i32..=high as i32 {
            let y = down(10f64.powi(power));
            let _ = writeln!(
                svg,
                "<path d=\"M{margin} {y:.1}H{:.1}\" stroke=\"#ddd\"/><text x=\"{:.1}\" y=\"{:.1}\" \
                 text-anchor=\"end\">{} %</text>",
                width - 1.5 * margin,
                margin - 6.0,
                y + 4.0,
                10f64.powi(power + 2)
            );
        }
        for ((_, errors), color) in self.errors.iter().zip(COLORS) {
            let points: Vec<String> = errors
                .iter()
                .enumerate()
                .map(|(index, error)| format!("{:.1},{:.1}", across(index), down(*error)))
                .collect();
            let _ = writeln!(
                svg,
                "<polyline points=\"{}\" fill=\"none\" stroke=\"{color}\" stroke-width=\"2\"/>",
                points.join(" ")
            );
        }
        for (number, ((name, _), color)) in SAMPLERS.iter().zip(COLORS).enumerate() {
            let (x, y) = (width - 1.3 * margin, margin + 18.0 * number as f64);
            let _ = writeln!(svg, "<text x=\"{x:.1}\" y=\"{y:.1}\" fill=\"{color}\">{name}</text>");
        }
        let _ = writeln!(
            svg,
            "<text x=\"{:.1}\" y=\"{:.1}\" text-anchor=\"middle\">samples of a pixel</text>\n</svg>",
            width / 2.0 - margin / 4.0,
            height - 14.0
        );
        svg
    }
}

/// The pictures of each sampler and number of samples.
const SEEDS: u32 = 4;

/// The light of all pixels.
fn lights(prepared: &PreparedScene<'_, f32>, settings: Settings) -> Result<Vec<[f64; 3]>, RenderError> {
    let renderer = Renderer::new(prepared, settings).map_err(RenderError::Settings)?;
    let line = |y: u32| {
        let renderer = &renderer;
        (0..renderer.width()).into_par_iter().map(move |x| {
            let (light, _) = renderer.pixel(x as u16, y as u16, &mut RayCounts::default());
            light.channels().map(f64::from)
        })
    };
    Ok((0..renderer.height()).into_par_iter().flat_map(line).collect())
}

fn mean_square(a: &[[f64; 3]], b: &[[f64; 3]]) -> f64 {
    let square = |(a, b): (&f64, &f64)| (a - b).powi(2);
    let sum: f64 = a.as_flattened().iter().zip(b.as_flattened()).map(square).sum();
    sum / a.as_flattened().len() as f64
}
