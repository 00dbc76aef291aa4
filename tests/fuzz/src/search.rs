//! The loop of a search: one execution for each seed.

use core::cell::Cell;
use core::fmt;
use core::sync::atomic::{AtomicU64, Ordering};
use std::fs;
use std::io;
use std::panic::{self, AssertUnwindSafe};
use std::path::{Path, PathBuf};
use std::sync::{Mutex, Once};
use std::time::{Duration, Instant};

use bumpalo::Bump;
use cpu_time::ThreadTime;
use rayline::Scene;

use crate::case::{Case, Number};
use crate::check::{Bench, Finding, Held, write_bytes};
use crate::choices::Choices;
use crate::minimize::Smallest;
use crate::scene_bytes::Corpus;
use crate::structured;

/// Where scenes come from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Target {
    /// The bytes of scenes, changed at random.
    SceneBytes,
    /// Put together from all shapes.
    Structured,
    /// Files of all formats, changed at random.
    #[cfg(feature = "importers")]
    Importers,
}

impl Target {
    /// All of them.
    pub const ALL: &'static [Self] = &[
        Self::SceneBytes,
        Self::Structured,
        #[cfg(feature = "importers")]
        Self::Importers,
    ];

    /// The name in commands and files.
    pub const fn name(self) -> &'static str {
        match self {
            Self::SceneBytes => "scene_bytes",
            Self::Structured => "structured",
            #[cfg(feature = "importers")]
            Self::Importers => "importers",
        }
    }
}

/// When a search ends: at whichever comes first.
#[derive(Clone, Copy, Debug)]
pub struct Until {
    /// After so much time.
    pub time: Duration,
    /// After so many executions.
    pub executions: u64,
    /// After so many findings.
    pub findings: u64,
}

/// Counts of a search.
#[derive(Clone, Copy, Debug, Default)]
pub struct Counts {
    /// Executions that were made: the sum of the next three and of the findings.
    pub executions: u64,
    /// Scenes that were drawn, by number system: `f32`, fixed point, `f64`.
    pub drawn: [u64; 3],
    /// Scenes that were refused when they were prepared.
    pub refused: u64,
    /// Bytes or files that were no scene.
    pub unreadable: u64,
    /// Findings.
    pub findings: u64,
    /// Pictures in realtime quality among those that were drawn.
    pub realtime: u64,
    /// How long it took.
    pub time: Duration,
    /// The thread's own time of all executions but findings.
    pub own_time: Duration,
    /// The thread's own time of the longest execution, and its seed.
    pub slowest: (Duration, u64),
}

impl Counts {
    /// Adds what the same search did next.
    pub fn add(&mut self, next: &Self) {
        self.executions += next.executions;
        self.drawn.iter_mut().zip(next.drawn).for_each(|(sum, next)| *sum += next);
        self.refused += next.refused;
        self.unreadable += next.unreadable;
        self.findings += next.findings;
        self.realtime += next.realtime;
        self.time += next.time;
        self.own_time += next.own_time;
        self.slowest = self.slowest.max(next.slowest);
    }
}

impl fmt::Display for Counts {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self {
            executions,
            drawn: [f32, fixed, f64],
            refused,
            unreadable,
            findings,
            realtime,
            own_time,
            slowest,
            ..
        } = self;
        let per_second = *executions as f64 / own_time.as_secs_f64().max(1e-9);
        write!(
            f,
            "{executions} executions, {per_second:.0} a second of the thread's time: drawn in f32 {f32}, \
             in fixed point {fixed}, in f64 {f64}, in realtime quality too {realtime}, refused {refused}, \
             no scene {unreadable}; slowest {:.0} ms (seed {}); {findings} findings",
            slowest.0.as_secs_f64() * 1e3,
            slowest.1
        )
    }
}

/// A finding and what reproduces it.
#[derive(Clone, Debug)]
pub struct Found {
    /// The target's name.
    pub target: &'static str,
    /// The seed of the execution.
    pub seed: u64,
    /// The broken promise, with the smaller scene.
    pub finding: Finding,
    /// The kinds of shapes and lights in the smaller scene.
    pub contents: String,
    /// The smaller scene and how it is drawn; `None` where an importer failed before there was a scene.
    pub scene: Option<(Vec<u8>, Case)>,
    /// Files that an importer read, with their names.
    pub files: Vec<(String, Vec<u8>)>,
}

impl Found {
    /// Writes the files that reproduce the finding, and tells the first of them.
    ///
    /// # Errors
    /// The system's.
    pub fn write(&self, directory: &Path) -> io::Result<PathBuf> {
        fs::create_dir_all(directory)?;
        let name = format!("{}-{}-{}", self.finding.word(), self.target, self.seed);
        if let Some((bytes, case)) = &self.scene {
            let path = directory.join(format!("{name}-{case}.rayline"));
            fs::write(&path, bytes)?;
            return Ok(path);
        }
        let directory = directory.join(name);
        fs::create_dir_all(&directory)?;
        let mut first = directory.clone();
        for (name, bytes) in self.files.iter().rev() {
            first = directory.join(name);
            fs::write(&first, bytes)?;
        }
        Ok(first)
    }
}

/// The last panic of any thread that searches.
static PANIC: Mutex<String> = Mutex::new(String::new());

impl Bench {
    /// [`Bench::check`], where a panic is a finding.
    ///
    /// # Errors
    /// The promise that was broken.
    pub fn check_caught(&mut self, scene: &Scene<'_>, case: &Case) -> Result<Held, Finding> {
        caught(|| self.check(scene, case))
    }
}

std::thread_local! {
    /// Whether this thread is in [`caught`].
    static SEARCHES: Cell<bool> = const { Cell::new(false) };
}

/// Calls `body`; a panic is a finding. Panics elsewhere are shown as ever.
pub(crate) fn caught<T>(body: impl FnOnce() -> Result<T, Finding>) -> Result<T, Finding> {
    static HOOK: Once = Once::new();
    HOOK.call_once(|| {
        let usual = panic::take_hook();
        panic::set_hook(Box::new(move |information| {
            if !SEARCHES.get() {
                usual(information);
            } else if let Ok(mut heard) = PANIC.lock() {
                *heard = information.to_string().replace('\n', " ");
            }
        }));
    });
    SEARCHES.set(true);
    let result = panic::catch_unwind(AssertUnwindSafe(body));
    SEARCHES.set(false);
    result.unwrap_or_else(|_| {
        let heard = PANIC.lock().map(|heard| heard.clone());
        Err(Finding::Panic(heard.unwrap_or_default()))
    })
}

/// An execution that takes longer is a finding. A busy machine does not count: it is the thread's own time.
const SLOW: Duration = Duration::from_secs(20);

/// A search with one target.
pub struct Search {
    target: Target,
    watch: Watch,
    bench: Bench,
    arena: Bump,
    corpus: Corpus,
    #[cfg(feature = "importers")]
    files: crate::importers::Files,
}

/// The kinds of shapes and lights in a scene, each with how many there are.
pub(crate) fn contents(scene: &Scene<'_>) -> String {
    let kind = |part: String| part.split([' ', '(']).next().unwrap_or_default().to_owned();
    let shapes = scene.objects.iter().map(|object| kind(format!("{:?}", object.shape)));
    let lights = scene.lights.iter().map(|light| kind(format!("{light:?}")));
    let mut kinds: Vec<(String, usize)> = Vec::new();
    for kind in shapes.chain(lights) {
        match kinds.iter_mut().find(|(known, _)| *known == kind) {
            Some((_, count)) => *count += 1,
            None => kinds.push((kind, 1)),
        }
    }
    let all: Vec<_> = kinds.iter().map(|(kind, count)| format!("{count} {kind}")).collect();
    all.join(", ")
}

/// The choices of an execution. Neighboring seeds have nothing in common.
fn choices_of(seed: u64) -> Choices<'static> {
    Choices::from_seed(Choices::from_seed(seed).word())
}

/// How an execution without a finding ended.
enum Outcome {
    NoScene,
    Drawn(Case),
    Refused,
}

impl Search {
    /// A search that changes the built-in scenes, those of the gallery, and the files of `seeds`, if there
    /// are any.
    ///
    /// # Errors
    /// A directory cannot be read or made.
    pub fn new(target: Target, seeds: &[PathBuf]) -> io::Result<Self> {
        let mut search = Self {
            target,
            watch: Watch::new(target.name()),
            bench: Bench::default(),
            arena: Bump::new(),
            corpus: Corpus::new(),
            #[cfg(feature = "importers")]
            files: crate::importers::Files::new()?,
        };
        #[cfg(feature = "importers")]
        if target == Target::SceneBytes {
            search.files.add_scenes_to(&mut search.corpus)?;
        }
        for directory in seeds {
            let mut paths: Vec<_> =
                fs::read_dir(directory)?.filter_map(|entry| Some(entry.ok()?.path())).collect();
            paths.sort();
            for path in paths.iter().filter(|path| path.is_file()) {
                if path.extension().is_some_and(|extension| extension == "rayline") {
                    search.corpus.add_bytes(fs::read(path)?);
                } else {
                    #[cfg(feature = "importers")]
                    search.files.add(path)?;
                }
            }
        }
        Ok(search)
    }

    /// Makes one execution after the other, with seeds from `seed` on. Each finding is made smaller and
    /// handed to `report`.
    pub fn run(&mut self, seed: u64, until: Until, mut report: impl FnMut(&Found)) -> Counts {
        let start = Instant::now();
        let mut counts = Counts::default();
        while start.elapsed() < until.time
            && counts.executions < until.executions
            && counts.findings < until.findings
        {
            let seed = seed.wrapping_add(counts.executions);
            self.watch.begin(seed);
            let before = ThreadTime::now();
            let outcome = self.execute(choices_of(seed));
            let took = before.elapsed();
            let outcome = if took > SLOW { outcome.and(Err(Finding::Slow(took.as_secs()))) } else { outcome };
            counts.executions += 1;
            counts.own_time += took;
            counts.slowest = counts.slowest.max((took, seed));
            match outcome {
                Ok(Outcome::Drawn(case)) => {
                    let number =
                        Number::ALL.iter().zip(&mut counts.drawn).find(|(number, _)| **number == case.number);
                    number.into_iter().for_each(|(_, drawn)| *drawn += 1);
                    counts.realtime += u64::from(case.realtime.is_some());
                }
                Ok(Outcome::Refused) => counts.refused += 1,
                Ok(Outcome::NoScene) => counts.unreadable += 1,
                Err(finding) => {
                    self.watch.begin(u64::MAX);
                    counts.findings += 1;
                    report(&self.found(seed, finding));
                }
            }
        }
        self.watch.begin(u64::MAX);
        counts.time = start.elapsed();
        counts
    }

    /// Makes one execution whose choices are these bytes: for fuzzers that choose them.
    ///
    /// # Errors
    /// The promise that was broken.
    pub fn run_bytes(&mut self, bytes: &[u8]) -> Result<(), Finding> {
        self.execute(Choices::from_bytes(bytes)).map(|_| ())
    }

    /// Makes the scene and the case of one execution and checks them.
    fn execute(&mut self, mut choices: Choices<'_>) -> Result<Outcome, Finding> {
        let Self { bench, .. } = self;
        let mut body = |scene: &Scene<'_>, case: &Case| match bench.check_caught(scene, case)? {
            Held::Drawn => Ok(Outcome::Drawn(*case)),
            Held::Refused => Ok(Outcome::Refused),
        };
        let case = Case::choose(&mut choices);
        self.arena.reset();
        match self.target {
            Target::SceneBytes => match self.corpus.scene(&mut choices) {
                Some(scene) => body(&scene, &case),
                None => Ok(Outcome::NoScene),
            },
            Target::Structured => body(&structured::scene(&mut choices, &self.arena), &case),
            #[cfg(feature = "importers")]
            Target::Importers => {
                self.files.change(&mut choices);
                match caught(|| Ok(self.files.read(&self.arena)))? {
                    Some(scene) => body(&scene, &case),
                    None => Ok(Outcome::NoScene),
                }
            }
        }
    }

    /// Makes the scene of a finding again, and makes it smaller.
    fn found(&mut self, seed: u64, finding: Finding) -> Found {
        let mut choices = choices_of(seed);
        let case = Case::choose(&mut choices);
        let arena = Bump::new();
        let Self { bench, corpus, .. } = self;
        let scene = match self.target {
            Target::SceneBytes => corpus.scene(&mut choices),
            Target::Structured => Some(structured::scene(&mut choices, &arena)),
            #[cfg(feature = "importers")]
            Target::Importers => caught(|| Ok(self.files.read(&arena))).unwrap_or(None),
        };
        let mut found = Found {
            target: self.target.name(),
            seed,
            finding,
            contents: String::new(),
            scene: None,
            files: Vec::new(),
        };
        #[cfg(feature = "importers")]
        if self.target == Target::Importers {
            found.files = self.files.files();
        }
        if let Some(scene) = scene {
            let Smallest { parts, case, finding, .. } =
                Smallest::of(&scene, &case, &found.finding, bench, &arena);
            let mut bytes = Vec::new();
            if write_bytes(&parts.as_scene(), &mut bytes).is_ok() {
                found.scene = Some((bytes, case));
            }
            found.contents = contents(&parts.as_scene());
            found.finding = finding;
        }
        found
    }
}

/// Ends the program where an execution does not end.
struct Watch {
    current: &'static AtomicU64,
}

/// An execution that takes this long does not end.
const ENDLESS: u64 = 600;

impl Watch {
    fn new(target: &'static str) -> Self {
        let current: &'static AtomicU64 = Box::leak(Box::new(AtomicU64::new(u64::MAX)));
        std::thread::spawn(move || {
            let (mut last, mut seconds) = (u64::MAX, 0);
            loop {
                std::thread::sleep(Duration::from_secs(1));
                let seed = current.load(Ordering::Relaxed);
                seconds = if seed == last && seed != u64::MAX { seconds + 1 } else { 0 };
                last = seed;
                if seconds > ENDLESS {
                    eprintln!("{target}: the execution of seed {seed} does not end within {ENDLESS} s");
                    std::process::exit(3);
                }
            }
        });
        Self { current }
    }

    /// An execution begins; `u64::MAX`: none does.
    fn begin(&self, seed: u64) {
        self.current.store(seed, Ordering::Relaxed);
    }
}
