//! How a scene is drawn in one execution, and how that is written in the name of a file.

use core::fmt;
use core::str::FromStr;

use rayline::{
    AreaLights, Contours, Edges, Gooch, Grid, Integrator, Look, Realtime, Sampling, Settings, Tones,
};

use crate::choices::Choices;

/// The number system that a scene is drawn in.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Number {
    /// `f32`
    F32,
    /// [`rayline::math::Fixed`]
    Fixed,
    /// `f64`
    F64,
}

impl Number {
    /// All of them.
    pub const ALL: [Self; 3] = [Self::F32, Self::Fixed, Self::F64];

    const fn name(self) -> &'static str {
        match self {
            Self::F32 => "f32",
            Self::Fixed => "fixed",
            Self::F64 => "f64",
        }
    }
}

/// In which portions the exact picture is drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Portions {
    /// All lines in one call.
    All,
    /// One call for each line.
    Lines,
    /// In steps of so many rays, into a buffer of so many lines.
    Steps {
        /// The budget of a step.
        rays: u32,
        /// Lines of the buffer.
        lines: u32,
    },
    /// Pixel by pixel, in passes of one sample each.
    Passes,
}

/// How a scene is drawn in one execution.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Case {
    /// The number system.
    pub number: Number,
    /// Size, bounces, rays per pixel, cutoff and samples per pixel; the rest is as in [`Settings::new`].
    pub settings: Settings,
    /// In which portions the exact picture is drawn.
    pub portions: Portions,
    /// The realtime quality that is drawn too, if one is.
    pub realtime: Option<Realtime>,
}

impl Case {
    /// Chooses a small picture.
    pub fn choose(choices: &mut Choices<'_>) -> Self {
        let number = choices.one_of([
            Number::F32,
            Number::Fixed,
            Number::F32,
            Number::Fixed,
            Number::F32,
            Number::Fixed,
            Number::F64,
        ]);
        let bounces = choices.one_of([0, 1, 2, 3, 6, 16]);
        let rays_per_pixel = choices.one_of([512, 64, 4096, 64, 7, 64, 512, 1]);
        // With many bounces and many rays, a pixel may take as long as a picture.
        let is_long = bounces > 3 && rays_per_pixel > 64;
        let [width, height] = match choices.below(12) {
            _ if is_long => [choices.between(1, 4), choices.between(1, 3)],
            0 => [choices.between(1, 40), choices.between(1, 4)],
            1 => [choices.between(1, 3), choices.between(1, 30)],
            _ => [choices.between(7, 20), choices.between(7, 16)],
        };
        let samples = if choices.chance(4) { choices.between(2, 3) as u32 } else { 1 };
        let settings = Settings {
            bounces,
            rays_per_pixel,
            cutoff: choices.one_of([0.0, 1.0 / 256.0, 0.1]),
            sampling: Sampling::new(samples.min(rays_per_pixel) as u16),
            integrator: if choices.chance(12) { Integrator::PathTracing } else { Integrator::Whitted },
            area_lights: choices.one_of([AreaLights::Sampled, AreaLights::ClosedForm]),
            ..Settings::new(width as u32, height as u32)
        };
        let integrator = settings.integrator;
        let portions = match choices.below(8) {
            0..=3 => Portions::All,
            4..=5 => Portions::Lines,
            6 => Portions::Passes,
            _ => Portions::Steps {
                rays: choices.one_of([0, 1, 7, 50, 1000]),
                lines: choices.between(1, height.min(9)) as u32,
            },
        };
        let realtime = choices.chance(25).then(|| Realtime {
            grid: choices.one_of([Grid::Two, Grid::Four, Grid::Eight]),
            threshold: choices.one_of([2500, 5000, 0, 200, 65_535]),
            budget_rays: if choices.chance(70) { u32::MAX } else { choices.between(0, 2000) as u32 },
            edges: choices.one_of([Edges::Stepped, Edges::Smooth]),
        });
        let look = choose_look(choices, integrator);
        Self { number, settings: Settings { look, ..settings }, portions, realtime }
    }
}

/// Chooses a look: as a photograph most of the time.
fn choose_look(choices: &mut Choices<'_>, integrator: Integrator) -> Look {
    if !choices.chance(15) {
        return Look::PHOTO;
    }
    let contours = choices.chance(60).then_some(Contours::NEW);
    let steps = choices.one_of([4, 2, 16]);
    let tones = match integrator {
        Integrator::Whitted => {
            choices.one_of([Tones::Light, Tones::Toon { steps }, Tones::Gooch(Gooch::NEW)])
        }
        _ => Tones::Light,
    };
    Look { tones, contours }
}

/// As in `f32-16x10-b2-r4096-c256-lines`: number system, size, bounces, rays per pixel, the cutoff's
/// reciprocal, `s` and samples per pixel where they are several, `paths` where paths are traced, `closed`
/// where wide lights are found in closed form, `toon` with the steps, `gooch` and `contours` of a look,
/// portions, `g` with grid, threshold and budget of realtime
/// quality, and `smooth` if its edges are.
impl fmt::Display for Case {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Settings { width, height, bounces, rays_per_pixel, cutoff, sampling, .. } = self.settings;
        let per_cutoff = if cutoff > 0.0 { (1.0 / cutoff).round() } else { 0.0 };
        let name = self.number.name();
        write!(f, "{name}-{width}x{height}-b{bounces}-r{rays_per_pixel}-c{per_cutoff}")?;
        if sampling.samples > 1 {
            write!(f, "-s{}", sampling.samples)?;
        }
        if self.settings.integrator == Integrator::PathTracing {
            write!(f, "-paths")?;
        }
        if self.settings.area_lights == AreaLights::ClosedForm {
            write!(f, "-closed")?;
        }
        match self.settings.look.tones {
            Tones::Toon { steps } => write!(f, "-toon{steps}")?,
            Tones::Gooch(_) => write!(f, "-gooch")?,
            _ => {}
        }
        if self.settings.look.contours.is_some() {
            write!(f, "-contours")?;
        }
        match self.portions {
            Portions::All => {}
            Portions::Lines => write!(f, "-lines")?,
            Portions::Passes => write!(f, "-passes")?,
            Portions::Steps { rays, lines } => write!(f, "-steps{rays}x{lines}")?,
        }
        if let Some(Realtime { grid, threshold, budget_rays, edges }) = self.realtime {
            write!(f, "-g{}x{threshold}x{budget_rays}", grid.pixels())?;
            if edges == Edges::Smooth {
                write!(f, "-smooth")?;
            }
        }
        Ok(())
    }
}

/// Finds the case in the name of a file. Parts with other meanings may stand before the number system.
impl FromStr for Case {
    type Err = String;

    fn from_str(name: &str) -> Result<Self, String> {
        let mut parts =
            name.split('-').skip_while(|part| Number::ALL.iter().all(|number| number.name() != *part));
        let missing = || format!("`{name}` names no number system and size");
        let number =
            parts.next().and_then(|part| Number::ALL.into_iter().find(|number| number.name() == part));
        let size = parts.next().and_then(|part| part.split_once('x'));
        let (number, (width, height)) = (number.ok_or_else(missing)?, size.ok_or_else(missing)?);
        let read =
            |digits: &str| digits.parse::<u32>().map_err(|_| format!("`{digits}` in `{name}` is no number"));
        let read_pair = |digits: &str| {
            let (first, second) = digits.split_once('x').ok_or_else(|| format!("`{digits}` has no `x`"))?;
            Ok::<_, String>((read(first)?, read(second)?))
        };
        let settings = Settings { cutoff: 0.0, ..Settings::new(read(width)?, read(height)?) };
        let mut case = Self { number, settings, portions: Portions::All, realtime: None };
        for part in parts {
            let Some((kind, digits)) = part.split_at_checked(1) else { continue };
            if part == "closed" {
                case.settings.area_lights = AreaLights::ClosedForm;
            } else if part == "paths" {
                case.settings.integrator = Integrator::PathTracing;
            } else if part == "gooch" {
                case.settings.look.tones = Tones::Gooch(Gooch::NEW);
            } else if part == "contours" {
                case.settings.look.contours = Some(Contours::NEW);
            } else if let Some(steps) = part.strip_prefix("toon") {
                case.settings.look.tones = Tones::Toon { steps: read(steps)? as u8 };
            } else if part == "smooth" {
                case.realtime = case.realtime.map(Realtime::smooth);
            } else if part == "lines" {
                case.portions = Portions::Lines;
            } else if part == "passes" {
                case.portions = Portions::Passes;
            } else if let Some(digits) = part.strip_prefix("steps") {
                let (rays, lines) = read_pair(digits)?;
                case.portions = Portions::Steps { rays, lines };
            } else if !digits.starts_with(|c: char| c.is_ascii_digit()) {
                continue;
            } else if kind == "g" {
                let (grid, rest) = digits.split_once('x').ok_or_else(|| format!("`{digits}` has no `x`"))?;
                let (threshold, budget_rays) = read_pair(rest)?;
                let grid = match read(grid)? {
                    2 => Grid::Two,
                    4 => Grid::Four,
                    _ => Grid::Eight,
                };
                let (threshold, edges) = (threshold as u16, Edges::Stepped);
                case.realtime = Some(Realtime { grid, threshold, budget_rays, edges });
            } else {
                let number = read(digits)?;
                match kind {
                    "b" => case.settings.bounces = number as u8,
                    "r" => case.settings.rays_per_pixel = number,
                    "c" if number > 0 => case.settings.cutoff = 1.0 / number as f32,
                    "s" => case.settings.sampling.samples = number as u16,
                    _ => {}
                }
            }
        }
        Ok(case)
    }
}
