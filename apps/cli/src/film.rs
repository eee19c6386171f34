//! `render --film`: samples are kept in a file and gone on with, so that a long render can be interrupted and a picture made
//! better later.

use std::fs::File;
use std::io::{self, BufReader};
use std::path::Path;
use std::time::{Duration, Instant};

use catoptra_core::Settings;
use catoptra_scene::{atomic, printable};
use catoptra_tracer::{Control, Edges, Film, Pattern, Region, Stats, StoredFilmError, View, render};
use crc32fast::Hasher;
use miette::{Report, Result, miette};

use crate::console::say;
use crate::job::{Frame, Job};
use crate::pool::milliseconds_since;
use crate::progress;
use crate::words::counted;

/// How long a pass over the picture should take: what an interruption may cost, and how soon a time that is over is noticed.
const PASS: Duration = Duration::from_secs(2);

/// How often the file is written while samples are added.
const BETWEEN_WRITES: Duration = Duration::from_secs(60);

/// The film of a picture, and the file that it is kept in.
pub(crate) struct KeptFilm<'a> {
    job: &'a Job,
    path: &'a Path,
    label: String,
    /// How many samples a pixel is to have.
    wanted: u32,
    time: Option<Duration>,
    pub(crate) film: Film,
}

impl<'a> KeptFilm<'a> {
    /// The film in a file, or an empty one where there is none.
    ///
    /// # Errors
    /// A film of another picture, a file that is none, and means of rendering that leave nothing to go on with.
    pub(crate) fn open(job: &'a Job, path: &'a Path, time: Option<Duration>) -> Result<Self> {
        check(job, time.is_some())?;
        let label = label(job)?;
        let film = match File::open(path) {
            Err(error) if error.kind() == io::ErrorKind::NotFound => job.film()?,
            Err(error) => return Err(miette!("the film {} cannot be read: {error}", path.display())),
            Ok(file) => Film::read_samples(&label, job.view.region(), &mut BufReader::new(file))
                .map_err(|error| unreadable(path, &label, job.view.region(), error))?,
        };
        let [_, held] = film.fewest_and_most();
        // A time alone says nothing of how many samples are enough.
        let all = if job.view.samples > 1 { job.view.samples } else { Settings::MAX_SAMPLES };
        Ok(Self { job, path, label, wanted: all.max(held), time, film })
    }

    /// Adds samples until there are as many as are asked for or the time is over, and keeps them. `None` where that was
    /// interrupted; what was traced until then is kept too.
    pub(crate) fn go_on(&mut self, control: &Control) -> Result<Option<(f64, Frame)>> {
        let started = Instant::now();
        let [held, _] = self.film.fewest_and_most();
        if held > 0 {
            say(&format!("{} holds {} a pixel", self.path.display(), counted(held.into(), "sample")));
        }
        let (mut stats, mut written, mut step) = (Stats::default(), Instant::now(), 1);
        while let Some(view) = self.next_pass(step) {
            let began = Instant::now();
            let (job, film) = (self.job, &mut self.film);
            let pass = progress::while_showing(control, || {
                render(job.backend, &job.snapshot, &view, film, &job.pool, control)
            });
            let Ok(pass) = pass else {
                self.write()?;
                self.say_what_is_kept();
                return Ok(None);
            };
            stats += pass;
            let took = began.elapsed();
            if self.time.is_some_and(|time| started.elapsed() + took / 2 >= time) {
                break;
            }
            step = if took > PASS { step.div_ceil(2) } else { step.saturating_add(step) };
            if written.elapsed() >= BETWEEN_WRITES {
                self.write()?;
                written = Instant::now();
            }
        }
        self.write()?;
        Ok(Some((milliseconds_since(started), Frame { stats, reached: None })))
    }

    /// The next so many samples; `None` where there are enough.
    fn next_pass(&self, step: u32) -> Option<View> {
        let [fewest, most] = self.film.fewest_and_most();
        let wanted = self.wanted;
        // Tiles that an interrupted pass has reached are ahead of the others, which are to draw level first.
        let end = if fewest < most { most } else { fewest.saturating_add(step).min(wanted) };
        let range = Some(fewest..end);
        (fewest < wanted).then(|| View { range, samples: wanted, ..self.job.view.clone() })
    }

    fn say_what_is_kept(&self) {
        let ([fewest, most], path) = (self.film.fewest_and_most(), self.path.display());
        let samples = if fewest == most { format!("{most}") } else { format!("{fewest} to {most}") };
        say(&format!("interrupted: {path} keeps {samples} samples a pixel, and the same command goes on"));
    }

    fn write(&self) -> Result<()> {
        let written = atomic::write(self.path, |out| self.film.write_samples(&self.label, out));
        written.map_err(|error| miette!("the film {} cannot be written: {error}", self.path.display()))
    }
}

/// What decides the samples of a picture but their number, a line each.
fn label(job: &Job) -> Result<String> {
    let View { size, integrator, seed, .. } = job.view;
    let View { max_depth, path_depth, clear_shadows, occlusion_distance, clamp, .. } = job.view;
    let lines = [
        ("version", env!("CARGO_PKG_VERSION").to_owned()),
        ("scene", digest(job)?),
        ("camera", job.camera_name.clone()),
        ("size", format!("{}x{}", size.width, size.height)),
        ("integrator", integrator.name().to_owned()),
        ("max-depth", format!("{max_depth} {path_depth}")),
        ("opaque-glass", (!clear_shadows).to_string()),
        ("occlusion-distance", occlusion_distance.to_string()),
        ("pattern", job.view.pattern.name().to_owned()),
        ("filter", job.view.filter.name().to_owned()),
        ("clamp", clamp.to_string()),
        ("seed", seed.to_string()),
    ];
    let turned = job.turned.iter().map(|turned| ("turn", turned.clone()));
    Ok(lines
        .into_iter()
        .chain(turned)
        .map(|(name, value)| format!("{name} {}\n", printable(&value)))
        .collect())
}

/// A checksum of the scene's text and of all files that it names, but for those that are not there.
pub(crate) fn digest(job: &Job) -> Result<String> {
    let mut sum = Hasher::new();
    sum.update(job.scene_text.as_bytes());
    for path in &job.files {
        match std::fs::read(path) {
            Ok(bytes) => sum.update(&bytes),
            Err(error) if error.kind() == io::ErrorKind::NotFound => {}
            Err(error) => return Err(miette!("{} cannot be read: {error}", path.display())),
        }
    }
    Ok(format!("{:08x}", sum.finalize()))
}

/// Why no film is read from a file.
fn unreadable(path: &Path, label: &str, region: Region, error: StoredFilmError) -> Report {
    let path = path.display();
    let StoredFilmError::OtherPicture { label: found, region: of } = error else {
        let help = "give --film another name, or remove that file to begin anew";
        return miette!(help = help, "the film {path} cannot be gone on with: {error}");
    };
    let help = "give the options that it was begun with, or --film another name";
    let differing = label.lines().zip(found.lines()).find(|(wanted, found)| wanted != found);
    if let Some((wanted, found)) = differing {
        let (wanted, found) = (printable(wanted), printable(found));
        return miette!(
            help = help,
            "the film {path} is of another picture: {found}, where {wanted} is asked for"
        );
    }
    let part = |Region { x, y, size }: Region| format!("{},{},{},{}", x, y, size.width, size.height);
    let (of, region) = (part(of), part(region));
    miette!(
        help = help,
        "the film {path} is of another part of the picture: {of}, where {region} is asked for"
    )
}

/// Refuses what does not go with a film that is kept.
fn check(job: &Job, timed: bool) -> Result<()> {
    let refused = |what: &str, help: &str| miette!(help = help.to_owned(), "--film does not go with {what}");
    if job.view.edges != Edges::Off {
        return Err(refused(
            "--edges exact",
            "it keeps samples, which exact edges are not: leave one of them away",
        ));
    }
    if job.view.pattern == Pattern::Grid {
        return Err(refused("--pattern grid", "a grid has no samples to add: owen and sobol have"));
    }
    if job.view.samples <= 1 && !timed {
        let help = "say how many with --samples, or how long with --time";
        return Err(refused("one sample a pixel", help));
    }
    Ok(())
}
