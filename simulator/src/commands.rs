//! The commands of `rayline`.

use std::error::Error;
use std::io::{self, IsTerminal, Write};
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use bumpalo::Bump;
use indicatif::{ProgressBar, ProgressStyle};
use rayline::{Integrator, Scene, Settings, builtin};
use rayline_simulator::animation::{Animation, Length};
use rayline_simulator::{
    BOARDS, BakedLight, Bench, Comparison, Convergence, Demand, Demands, FilmFile, Gallery, LightError,
    LightOptions, LightStep, LoadedScene, Number, Orbit, OutputSettings, Pass, PassError, Picture,
    PictureFile, RenderError, RenderOptions, ReportError, SceneFile, Stats, bake_light, check, check_apart,
    check_writable, half_blocks, is_standard_output, on_panel, render_in_passes, render_watched,
    report_pixel, rounding_notes, write_file,
};

use crate::cli::{
    Bake, BakedPart, BenchArgs, CheckArgs, Cli, Command, CompareArgs, Convert, GalleryArgs, Pixel, Record,
    Render, SceneArgs, Window,
};

type Outcome = Result<(), Box<dyn Error>>;

pub(crate) fn run(cli: Cli) -> Outcome {
    match cli.command {
        None => showcase(),
        Some(Command::Render(arguments)) => render(&arguments),
        Some(Command::Record(arguments)) => record(&arguments),
        Some(Command::Scenes) => scenes(),
        Some(Command::Pixel(arguments)) => pixel(&arguments),
        Some(Command::Convert(arguments)) => convert(&arguments),
        Some(Command::Bake(arguments)) => bake(&arguments),
        Some(Command::Check(arguments)) => fit(&arguments),
        Some(Command::Compare(arguments)) => compare(&arguments),
        Some(Command::Gallery(arguments)) => gallery(&arguments),
        Some(Command::Window(arguments)) => window(&arguments),
        Some(Command::Bench(arguments)) => bench(&arguments),
    }
}

/// The scene that `rayline` renders without a command.
const SHOWCASE: &str = "classic";

/// Opens a scene, and prints its notes to standard error: what was added to the file or left out.
fn open<'a>(arguments: &SceneArgs, arena: &'a Bump, quiet: bool) -> Result<LoadedScene<'a>, Box<dyn Error>> {
    let scene = LoadedScene::open_with(&arguments.source, &arguments.options(), arena)?;
    if !quiet {
        print_notes(&scene)?;
    }
    Ok(scene)
}

fn print_notes(scene: &LoadedScene<'_>) -> io::Result<()> {
    scene.notes.iter().try_for_each(|note| writeln!(io::stderr(), "note: {note}"))
}

fn showcase() -> Outcome {
    let arena = Bump::new();
    let scene = LoadedScene::open(Path::new(SHOWCASE), &arena)?;
    let file = PictureFile::new(Path::new("rayline.png"))?;
    let (picture, time) = timed(&scene, &RenderOptions::new(scene.settings), false)?;
    file.write(&picture)?;
    if io::stdout().is_terminal() {
        show(&picture)?;
    }
    say(&file, &picture, time, Report::Output)
}

fn render(arguments: &Render) -> Outcome {
    let arena = Bump::new();
    let scene = open(&arguments.scene, &arena, arguments.quiet)?;
    let own_name = || PathBuf::from(format!("{}.png", scene.name));
    let file = PictureFile::new(&arguments.output.clone().unwrap_or_else(own_name))?;
    let mut outputs = vec![file.path()];
    if let Some(stats) = &arguments.stats {
        check_writable(stats)?;
        outputs.push(stats);
    }
    let report = Report::beside(&outputs, arguments.quiet)?;
    let options = RenderOptions {
        show: arguments.show,
        lines: arguments.lines.clone(),
        threads: arguments.threads.map_or(0, usize::from),
        ..arguments.picture.options(&scene)
    };
    let panel = arguments.picture.panel()?;
    let (picture, time) = if arguments.passes {
        in_passes(&scene, &options, panel.as_ref(), report != Report::Output)?
    } else {
        timed(&scene, &options, arguments.quiet)?
    };
    let shown = panel.map(|panel| on_panel(&picture, &panel)).transpose()?;
    file.write(shown.as_ref().unwrap_or(&picture))?;
    if !arguments.quiet {
        for note in rounding_notes(&scene.scene, options.number) {
            writeln!(io::stderr(), "note: {note}")?;
        }
        if picture.rays.cut_rays > 0 {
            writeln!(
                io::stderr(),
                "note: light was left out {} times, because a pixel may spend {} rays; see --rays-per-pixel",
                picture.rays.cut_rays,
                options.settings.rays_per_pixel
            )?;
        }
    }
    if let Some(stats) = &arguments.stats {
        let mut json = serde_json::to_vec_pretty(&Stats::new(&scene.scene, &picture, time))?;
        json.push(b'\n');
        write_file(stats, &json)?;
    }
    say(&file, &picture, time, report)
}

/// The way of a film through a scene.
enum Way {
    /// The camera goes around once.
    Orbit(Orbit),
    Script(Animation),
}

fn record(arguments: &Record) -> Outcome {
    let arena = Bump::new();
    let scene = open(&arguments.scene, &arena, arguments.quiet)?;
    let own_name = || PathBuf::from(format!("{}.gif", scene.name));
    let file = FilmFile::new(&arguments.output.clone().unwrap_or_else(own_name))?;
    let report = Report::beside(&[file.path()], arguments.quiet)?;
    let (length, way) = match &arguments.script {
        Some(path) => {
            let script = Animation::read(path, &scene)?;
            (script.length(), Way::Script(script))
        }
        None => {
            let orbit = Orbit::around(&scene.scene).map_err(|error| scene.explain(&error))?;
            (Length::new(arguments.seconds, arguments.frames_per_second)?, Way::Orbit(orbit))
        }
    };
    let (options, panel) = (arguments.picture.options(&scene), arguments.picture.panel()?);
    let bar = progress("frame", length.frames().into(), arguments.quiet)?;
    bar.set_message(scene.name.clone());
    let (start, mut size) = (Instant::now(), (0, 0));
    let frame = |number: u32| -> Result<Picture, Box<dyn Error>> {
        let (arena, time) = (Bump::new(), length.time(number));
        let moment = match &way {
            Way::Script(script) => script.scene_at(&scene.scene, time, &arena),
            Way::Orbit(orbit) => {
                let mut orbit = *orbit;
                orbit.turn(core::f64::consts::TAU * f64::from(time / length.seconds()), 0.0);
                Scene { camera: orbit.camera(), ..scene.scene }
            }
        };
        let picture = rayline_simulator::render(&moment, &options)
            .map_err(|error| format!("at {time} seconds: {}", explain(&scene, error)))?;
        let picture = match &panel {
            Some(panel) => on_panel(&picture, panel)?,
            None => picture,
        };
        size = (picture.width, picture.height);
        bar.inc(1);
        Ok(picture)
    };
    let bytes = file.write(length, frame)?;
    bar.finish_and_clear();
    let ((width, height), path) = (size, file.path().display());
    let (frames, time) = (length.frames(), start.elapsed().as_secs_f64());
    report.say(&format!("{path}: {width}x{height}, {frames} frames, {bytes} bytes, in {time:.2} s"))
}

fn scenes() -> Outcome {
    let longest = builtin::ALL.iter().map(|builtin| builtin.name.len()).max().unwrap_or(0);
    for builtin in &builtin::ALL {
        writeln!(io::stdout(), "{:longest$}  {}", builtin.name, builtin.description)?;
    }
    Ok(())
}

fn pixel(arguments: &Pixel) -> Outcome {
    let arena = Bump::new();
    let scene = open(&arguments.scene, &arena, false)?;
    let report = report_pixel(&scene, &arguments.look.options(&scene), arguments.pixel);
    let report = report.map_err(|error| match error {
        ReportError::Render(error) => explain(&scene, error),
        error => error.into(),
    })?;
    Ok(io::stdout().write_all(report.as_bytes())?)
}

fn convert(arguments: &Convert) -> Outcome {
    convert_to(arguments, &SceneFile::new(&arguments.output, arguments.number)?, None)
}

/// Writes a scene in another format, and bakes its light first if `light` is to be baked.
fn convert_to(arguments: &Convert, file: &SceneFile, light: Option<&Bake>) -> Outcome {
    // Refuse to overwrite the source: its names and comments would be lost.
    check_apart(file.path(), &arguments.scene.source)?;
    let arena = Bump::new();
    let mut scene = open(&arguments.scene, &arena, arguments.quiet)?;
    check(&scene.scene).map_err(|error| scene.explain(&error))?;
    let baked = light.map(|light| bake_light_of(&scene, light, &arena)).transpose()?;
    if let Some(baked) = &baked {
        scene.scene = baked.scene;
        // Paths would find the light that is now in textures, too. Their samples are no longer needed.
        if scene.settings.integrator != Integrator::Whitted {
            scene.settings.integrator = Integrator::Whitted;
            scene.settings.sampling.samples = 1;
        }
    }
    let contents = file.contents(&scene.scene, &scene.settings, &arena)?;
    if !arguments.quiet {
        for (path, length) in contents.large_files() {
            writeln!(io::stderr(), "note: {} takes {} MB", path.display(), length / 1_000_000)?;
        }
    }
    let report = Report::beside(&[file.path()], arguments.quiet)?;
    contents.write()?;
    let (path, length) = (file.path().display(), contents.length());
    let beside = match contents.pictures() {
        0 => String::new(),
        1 => " and 1 picture".to_owned(),
        count => format!(" and {count} pictures"),
    };
    if let Some(BakedLight { bytes, texels, .. }) = baked {
        report.say(&format!("light at {texels} places, in {bytes} bytes"))?;
    }
    report.say(&format!("{path}: {length} bytes{beside}; {}", counts(&scene.scene)))
}

/// The numbers of objects, materials and lights in a scene, as text.
fn counts(Scene { objects, materials, lights, .. }: &Scene<'_>) -> String {
    [(objects.len(), "object"), (materials.len(), "material"), (lights.len(), "light")]
        .map(|(count, thing)| format!("{count} {thing}{}", if count == 1 { "" } else { "s" }))
        .join(", ")
}

fn bake(arguments: &Bake) -> Outcome {
    let Convert { output, number, .. } = &arguments.convert;
    if arguments.light.is_none() {
        return convert_to(&arguments.convert, &SceneFile::rust(output, *number)?, None);
    }
    convert_to(&arguments.convert, &SceneFile::new(output, *number)?, Some(arguments))
}

/// Bakes the light of a scene, with a progress bar.
fn bake_light_of<'a>(
    scene: &LoadedScene<'a>,
    arguments: &Bake,
    arena: &'a Bump,
) -> Result<BakedLight<'a>, Box<dyn Error>> {
    let object = |name: &String| {
        scene.object(name).ok_or_else(|| format!("--moving: {} has no object {name}", scene.name))
    };
    let options = LightOptions {
        keep_lamps: arguments.light == Some(BakedPart::Indirect),
        budget: arguments.budget,
        photons: arguments.photons,
        texels: arguments.texels,
        grid: arguments.grid,
        moving: arguments.moving.iter().map(object).collect::<Result<_, _>>()?,
    };
    const PARTS: u64 = 1000;
    let bar = progress("part", PARTS, arguments.convert.quiet)?;
    let baked = bake_light(&scene.scene, &options, arena, &|step, part| {
        bar.set_message(match step {
            LightStep::Photons => "light over mirrors and through glass",
            LightStep::Lamps => "light of lamps",
            LightStep::Surfaces => "light between surfaces",
            LightStep::Space => "light in space",
        });
        bar.set_position((part * PARTS as f64) as u64);
    });
    bar.finish_and_clear();
    baked.map_err(|error| match error {
        LightError::Scene(error) => scene.explain(&error).into(),
        error => error.into(),
    })
}

fn fit(arguments: &CheckArgs) -> Outcome {
    let arena = Bump::new();
    let scene = open(&arguments.scene, &arena, false)?;
    check(&scene.scene).map_err(|error| scene.explain(&error))?;
    let (width, height) = arguments.size;
    let bounces = arguments.bounces.unwrap_or(scene.settings.bounces);
    let settings = Settings { width, height, bounces, ..scene.settings };
    let boards = BOARDS.iter().filter(|board| arguments.board.as_ref().is_none_or(|name| name == board.name));
    const PARTS: u64 = 1000;
    let bar = progress("part", PARTS, false)?;
    let demands = Demands::watched(&scene.scene, boards, settings, &|number, part| {
        bar.set_message(format!("{} in {number}", scene.name));
        bar.set_position((part * PARTS as f64) as u64);
    });
    bar.finish_and_clear();
    let demands = demands.map_err(|error| explain(&scene, error))?;
    let mut out = io::stdout();
    writeln!(out, "{}: {}; {width}x{height}, {bounces} bounces", scene.name, counts(&scene.scene))?;
    if let Some(Demand { step, mean_rays, worst_rays, most_rays, .. }) = demands.0.first() {
        if *step > 1 {
            writeln!(out, "estimated from one pixel of {step} in one line of {step}:")?;
        }
        writeln!(
            out,
            "{mean_rays:.1} rays a pixel, {worst_rays} in the worst pixel; from elsewhere at most {most_rays}\n"
        )?;
    }
    let fits = demands.0.iter().any(Demand::fits);
    write!(out, "{demands}")?;
    for note in
        [Number::F32, Number::Fixed].into_iter().flat_map(|number| rounding_notes(&scene.scene, number))
    {
        writeln!(out, "\nnote: {note}")?;
    }
    if let Some(panel) = arguments.panel.filter(|panel| *panel != arguments.size) {
        writeln!(out, "\n{}", shown_part(arguments.size, panel))?;
    }
    match &arguments.board {
        Some(board) if !fits => Err(format!("{} does not fit {board}", scene.name).into()),
        _ => Ok(()),
    }
}

/// The text that reports how much of a picture a panel of another size shows, and which size fits the panel.
fn shown_part((width, height): (u32, u32), (wide, high): (u32, u32)) -> String {
    let (columns, lines) = (width.min(wide), height.min(high));
    let of = |part: u64, width: u32, height: u32| part * 100 / (u64::from(width) * u64::from(height));
    let shown = u64::from(columns) * u64::from(lines);
    format!(
        "A panel of {wide}x{high} shows {columns}x{lines} pixels of the picture ({} %), which cover {} % of \
         the panel. Use --size {wide}x{high}.",
        of(shown, width, height),
        of(shown, wide, high),
    )
}

fn compare(arguments: &CompareArgs) -> Outcome {
    let arena = Bump::new();
    let scene = open(&arguments.scene, &arena, arguments.quiet)?;
    let own_name = || PathBuf::from(format!("{}-compare.png", scene.name));
    let file = PictureFile::new(&arguments.output.clone().unwrap_or_else(own_name))?;
    if let Some(plot) = &arguments.plot {
        check_writable(plot)?;
    }
    let segments = arguments.segments.segments;
    let options = RenderOptions { segments, ..arguments.look.options(&scene) };
    let bar = progress("picture", Comparison::steps(&scene.scene) as u64, arguments.quiet)?;
    bar.set_message(scene.name.clone());
    let comparison = Comparison::measure(&scene.scene, &options, &|| bar.inc(1));
    bar.finish_and_clear();
    let comparison = comparison.map_err(|error| explain(&scene, error))?;
    file.write(&comparison.picture)?;
    if let Some(plot) = &arguments.plot {
        write_file(plot, comparison.plot().as_bytes())?;
    }
    write!(io::stdout(), "{comparison}")?;
    Ok(())
}

fn gallery(arguments: &GalleryArgs) -> Outcome {
    let gallery = Gallery::new(&arguments.directory)?;
    let count = gallery.files().len();
    let bar = progress("scene", count as u64, false)?;
    let written = gallery.write(&|scene| {
        bar.set_message(scene.to_owned());
        bar.inc(1);
    });
    bar.finish_and_clear();
    written?;
    let page = arguments.directory.join("README.md");
    writeln!(io::stdout(), "{}: {count} scenes", page.display())?;
    Ok(())
}

#[cfg(feature = "window")]
fn window(arguments: &Window) -> Outcome {
    use rayline_simulator::files::STANDARD_INPUT;
    use rayline_simulator::{WindowScene, show_window};

    let source = &arguments.scene.source;
    if source == Path::new(STANDARD_INPUT) {
        return Err("a window reads its file again when it changes, so it needs a file in place of -".into());
    }
    let panel = arguments.picture.panel()?;
    let name = source.file_stem().unwrap_or_default().to_string_lossy();
    let file = PictureFile::new(&PathBuf::from(format!("{name}.png")))?;
    let mut save = |seen: &Scene<'_>, options: &RenderOptions| -> Outcome {
        let start = Instant::now();
        let picture = rayline_simulator::render(seen, options)?;
        // The user gave no name, so choose a name that no file has yet.
        let file = file.untaken();
        file.write(&picture)?;
        say(&file, &picture, start.elapsed(), Report::Output)
    };
    let options = |scene: &LoadedScene<'_>| {
        // Nothing can be done if standard error takes no notes.
        let _ = print_notes(scene);
        arguments.picture.options(scene)
    };
    Ok(show_window(WindowScene {
        source,
        open: arguments.scene.options(),
        options: &options,
        panel,
        save: &mut save,
    })?)
}

#[cfg(not(feature = "window"))]
fn window(arguments: &Window) -> Outcome {
    Err(format!(
        "this build has no window: cargo run --release -p rayline-simulator --features window -- window {}",
        arguments.scene.source.display()
    )
    .into())
}

fn bench(arguments: &BenchArgs) -> Outcome {
    if let Some(plot) = &arguments.convergence {
        return convergence(&arguments.source, plot);
    }
    let bench = match arguments.quick {
        true => Bench::QUICK,
        false => Bench { runs: usize::from(arguments.runs), ..Bench::FULL },
    };
    // Progress is shown if standard error is a terminal.
    let spinner = ProgressBar::new_spinner();
    let say = |what: &str| {
        spinner.set_message(what.to_owned());
        spinner.tick();
    };
    let table = bench.builtin_scenes(&say)?;
    spinner.suspend(|| writeln!(io::stdout(), "{table}"))?;
    let directory = tempfile::tempdir()?;
    let table = bench.beside_povray(directory.path(), &say)?;
    spinner.finish_and_clear();
    match table {
        Some(table) => write!(io::stdout(), "{table}")?,
        None => writeln!(io::stdout(), "POV-Ray is not installed: nothing to compare with.")?,
    }
    Ok(())
}

/// Measures the error of small pictures against the number of samples.
fn convergence(source: &Path, plot: &Path) -> Outcome {
    check_writable(plot)?;
    Report::beside(&[plot], false)?;
    let arena = Bump::new();
    let scene = LoadedScene::open(source, &arena)?;
    print_notes(&scene)?;
    let spinner = ProgressBar::new_spinner().with_message("rendering 4096 samples of each pixel, and fewer");
    spinner.enable_steady_tick(Duration::from_millis(200));
    let settings = Settings { width: 64, height: 48, ..scene.settings };
    let measured = Convergence::measure(&scene.scene, settings).map_err(|error| explain(&scene, error))?;
    spinner.finish_and_clear();
    write_file(plot, measured.plot().as_bytes())?;
    Report::beside(&[plot], false)?.say(measured.table().trim_end())
}

/// A progress bar for so many lines, frames or scenes. It is shown if standard error is a terminal.
fn progress(item: &str, count: u64, quiet: bool) -> Result<ProgressBar, Box<dyn Error>> {
    let bar = if quiet { ProgressBar::hidden() } else { ProgressBar::new(count) };
    let template = format!("{{msg}} {{wide_bar}} {item} {{pos}} of {{len}}, {{eta}} to go");
    bar.set_style(ProgressStyle::with_template(&template)?);
    Ok(bar)
}

/// Renders a picture with a progress bar, and measures the time.
fn timed(
    scene: &LoadedScene<'_>,
    options: &RenderOptions,
    quiet: bool,
) -> Result<(Picture, Duration), Box<dyn Error>> {
    let lines = options.lines.as_ref().map_or(options.settings.height, |lines| lines.end - lines.start);
    let bar = progress("line", lines.into(), quiet)?;
    bar.set_message(scene.name.clone());
    let start = Instant::now();
    let picture = render_watched(&scene.scene, options, &|| bar.inc(1));
    let time = start.elapsed();
    bar.finish_and_clear();
    Ok((picture.map_err(|error| explain(scene, error))?, time))
}

/// Renders in passes. Shows pass 1, 2, 4, 8 and so on, and the last: as a picture on the panel if standard
/// output is a terminal.
fn in_passes(
    scene: &LoadedScene<'_>,
    options: &RenderOptions,
    panel: Option<&OutputSettings>,
    quiet: bool,
) -> Result<(Picture, Duration), Box<dyn Error>> {
    let terminal = console::Term::stdout();
    let pixels = u64::from(options.settings.width) * u64::from(options.settings.height);
    let start = Instant::now();
    let mut rows_shown = 0;
    let picture = render_in_passes(&scene.scene, options, &mut |picture, pass| {
        let Pass { number, most, pixels_refined } = pass;
        if quiet || !(number.is_power_of_two() || pixels_refined == pixels) {
            return Ok(());
        }
        if terminal.is_term() {
            // The next picture takes the place of the last one.
            terminal.clear_last_lines(rows_shown)?;
            let (rows, columns) = terminal.size();
            let shown = panel.map(|panel| on_panel(picture, panel)).transpose().map_err(io::Error::other)?;
            let picture = shown.as_ref().unwrap_or(picture);
            let text = half_blocks(picture, u32::from(columns), u32::from(rows.saturating_sub(3)));
            rows_shown = text.lines().count() + 1;
            terminal.write_str(&text)?;
        }
        let percent = pixels_refined as f64 / pixels.max(1) as f64 * 100.0;
        let line = format!("pass {number} of at most {most}: {percent:.0} % of the pixels are complete");
        terminal.write_line(&line)
    });
    let time = start.elapsed();
    let explained = |error: PassError| match error {
        PassError::Render(error) => explain(scene, error),
        PassError::Show(error) => error.into(),
    };
    Ok((picture.map_err(explained)?, time))
}

/// The error with the line of the scene's file, if the file has lines.
fn explain(scene: &LoadedScene<'_>, error: RenderError) -> Box<dyn Error> {
    match error {
        RenderError::Scene(error) => scene.explain(&error).into(),
        error => error.into(),
    }
}

fn say(file: &PictureFile, picture: &Picture, time: Duration, report: Report) -> Outcome {
    let (Picture { width, height, .. }, rays) = (picture, picture.rays.total());
    let path = file.path().display();
    report.say(&format!("{path}: {width}x{height}, {rays} rays in {:.2} s", time.as_secs_f64()))
}

/// Where a command reports what it has written.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Report {
    /// To standard output.
    Output,
    /// To standard error, because an output is written to standard output.
    Error,
    Nowhere,
}

impl Report {
    /// The report of a command that writes these files.
    fn beside(files: &[&Path], quiet: bool) -> Result<Self, &'static str> {
        match files.iter().filter(|file| is_standard_output(file)).count() {
            2.. => Err("two files cannot be written to standard output; name another one of them"),
            _ if quiet => Ok(Self::Nowhere),
            1 => Ok(Self::Error),
            _ => Ok(Self::Output),
        }
    }

    fn say(self, line: &str) -> Outcome {
        match self {
            Self::Output => writeln!(io::stdout(), "{line}")?,
            Self::Error => writeln!(io::stderr(), "{line}")?,
            Self::Nowhere => {}
        }
        Ok(())
    }
}

/// Shows a picture in the terminal, as large as fits.
fn show(picture: &Picture) -> Outcome {
    let (rows, columns) = console::Term::stdout().size();
    // Leave room for the line below the picture, and for the prompt.
    let text = half_blocks(picture, u32::from(columns), u32::from(rows.saturating_sub(2)));
    Ok(io::stdout().write_all(text.as_bytes())?)
}
