//! The error of a picture against the number of its samples, for each sampler.

use rayline::{PreparedScene, RayCounts, Renderer, Sampler, Sampling, Scene, Settings};
use rayon::prelude::*;

use crate::picture::memory_for;
use crate::plot::{Curve, Plot, svg};
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
        let names = SAMPLERS.iter().map(|(name, _)| *name);
        let values = self.errors.iter().map(|(_, errors)| errors.to_vec());
        svg(&[Plot {
            across: "samples of a pixel",
            ticks: SAMPLES.map(|count| (f64::from(count), count.to_string())).to_vec(),
            power: &|power| format!("{} %", 10f64.powi(power + 2)),
            curves: (names.zip(COLORS).zip(values))
                .map(|((name, color), values)| Curve { name, color, values })
                .collect(),
        }])
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
