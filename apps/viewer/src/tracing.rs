//! How does a request become a frame? The scene is frozen, the tracer fills a film, the film is encoded for display. A full
//! film is then refined tile by tile, and stays what tells depths and surfaces.

use std::sync::Arc;

use catoptra_core::Camera;
use catoptra_tracer::{Backend, Control, Extraction, Film, Pool, Size, Snapshot, Tone, View, render};

use crate::canvas::{Pixels, resize};
use crate::draft::{Quality, draft, has_draft};
use crate::frame_worker::{Refined, Tracing};
use crate::latest::Latest;
use crate::light_parts::LightParts;
use crate::parts::{Goal, Parts, Patches, Tracer};
use crate::pass::{Numbers, OwnShapes, Pass, Seen};
use crate::refine::{Step, reduced};

/// All that a picture depends on.
#[derive(Clone)]
pub(crate) struct Request {
    /// The scene.
    pub(crate) extraction: Arc<Extraction>,
    /// The same as it was last frozen, for what need not be made anew.
    pub(crate) latest: Arc<Latest>,
    /// Who traces.
    pub(crate) backend: &'static dyn Backend,
    /// From where, how large when traced in full, and what is shown.
    pub(crate) view: View,
    /// What a frame may take while something moves, in milliseconds.
    pub(crate) frame_time: f64,
    /// How far the full picture is refined.
    pub(crate) goal: Goal,
    /// How radiance becomes colour.
    pub(crate) tone: Tone,
    /// What is shown of the scene.
    pub(crate) pass: &'static Pass,
    /// The shapes of the scene before they are placed, if the pass asks for them.
    pub(crate) own: OwnShapes,
    /// The scene by each of its lights, if the pass asks for that.
    pub(crate) lights: Arc<LightParts>,
}

/// A request with its scene frozen.
pub(crate) struct Job {
    request: Request,
    pub(crate) snapshot: Arc<Snapshot>,
}

/// A traced picture.
pub(crate) struct Frame {
    /// What was traced.
    pub(crate) film: Arc<Film>,
    /// The light of tiles that have been refined since.
    pub(crate) patches: Patches,
    /// The film for display.
    pub(crate) pixels: Pixels,
    /// From where it was seen.
    pub(crate) camera: Camera,
    /// Width and height in pixels that the request asked for.
    pub(crate) size: (u32, u32),
    /// How radiance became colour.
    pub(crate) tone: Tone,
    /// How many rays it took.
    pub(crate) rays: u64,
    /// What it shows of the scene.
    pub(crate) pass: &'static Pass,
    /// The numbers behind its colours, where they are false ones.
    pub(crate) numbers: Option<Numbers>,
}

impl Frame {
    /// Encodes the film anew; a pass with colours of its own keeps them.
    pub(crate) fn encode(&mut self, tone: Tone, pool: &Pool) {
        self.tone = tone;
        if self.pass.paint.is_some() {
            return;
        }
        let Size { width, height } = self.film.size();
        self.pixels.width = width;
        self.pixels.height = height;
        resize(&mut self.pixels.data, width as usize * height as usize, 0);
        tone.encode(&self.film, pool, &mut self.pixels.data);
        self.patches.encode(tone, pool, &mut self.pixels);
    }

    /// Shows what the pass makes of the film; `false` when that was cancelled.
    fn paint(
        &mut self,
        Job { request, snapshot }: &Job,
        view: &View,
        pool: &Pool,
        control: &Control,
    ) -> bool {
        let Some(paint) = self.pass.paint else {
            self.encode(request.tone, pool);
            return true;
        };
        let (film, backend, own, lights) = (&self.film, request.backend, &request.own, &*request.lights);
        let Some(painted) = paint(&Seen { film, snapshot, view, backend, own, lights, pool, control }) else {
            return false;
        };
        let Size { width, height } = self.film.size();
        self.pixels = Pixels { width, height, data: painted.colors };
        self.numbers = painted.numbers;
        true
    }
}

/// Room for a picture, to be filled again.
pub(crate) struct Spare {
    /// Nobody else's.
    film: Option<Film>,
    pixels: Pixels,
}

impl From<Frame> for Spare {
    fn from(Frame { film, pixels, .. }: Frame) -> Self {
        Self { film: Arc::into_inner(film), pixels }
    }
}

/// One of that size, or a new one.
fn room(size: Size, spares: &mut Vec<Spare>) -> (Film, Pixels) {
    let fits = |spare: &Spare| spare.film.as_ref().is_some_and(|film| film.size() == size);
    let spare = spares.iter().position(fits).map(|i| spares.swap_remove(i));
    let (film, pixels) = spare.map(|spare| (spare.film, spare.pixels)).unwrap_or_default();
    (film.unwrap_or_else(|| Film::with_tiles(size, tile_edge(size))), pixels)
}

/// Below this number of pixels a film has small tiles: else few of them hold all the work, and threads wait.
const SMALL: usize = 100_000;

/// The edge of the tiles of a film, in pixels.
fn tile_edge(size: Size) -> u32 {
    if size.pixels() < SMALL { Film::TILE / 4 } else { Film::TILE }
}

/// Traces on a pool of threads.
pub(crate) struct PoolTracing {
    /// The threads.
    pool: Arc<Pool>,
    /// The full picture, and its tiles that are refined.
    resting: Option<(Arc<Film>, Parts)>,
}

impl PoolTracing {
    /// On these threads.
    pub(crate) fn new(pool: Arc<Pool>) -> Self {
        Self { pool, resting: None }
    }

    /// A frame of a film that was traced; `None` when that was cancelled, and then the room is among the spares.
    pub(crate) fn painted(
        &self,
        job: &Job,
        view: &View,
        (film, pixels): (Arc<Film>, Pixels),
        rays: u64,
        (control, spares): (&Control, &mut Vec<Spare>),
    ) -> Option<Frame> {
        let Request { tone, pass, .. } = job.request;
        let mut frame = Frame {
            film,
            patches: Patches::default(),
            pixels,
            camera: view.camera.clone(),
            size: Self::size(job),
            tone,
            rays,
            pass,
            numbers: None,
        };
        if frame.paint(job, view, &self.pool, control) {
            return Some(frame);
        }
        spares.push(frame.into());
        None
    }
}

impl Tracing for PoolTracing {
    type Request = Request;
    type Job = Job;
    type Frame = Frame;
    type Spare = Spare;

    fn prepare(&mut self, request: Request) -> Job {
        self.resting = None;
        let snapshot = request.latest.follow(&request.extraction, &self.pool);
        Job { request, snapshot }
    }

    fn size(job: &Job) -> (u32, u32) {
        (job.request.view.size.width, job.request.view.size.height)
    }

    fn trace(&mut self, job: &Job, step: Step, control: &Control, spares: &mut Vec<Spare>) -> Option<Frame> {
        let Job { request, snapshot } = job;
        let full = Self::size(job);
        let (width, height) = reduced(full.0, full.1, step.divisor);
        let size = Size { width, height };
        let (mut film, pixels) = room(size, spares);
        let view = View { size, ..request.view.clone() };
        let view = if step.quality == Quality::Draft { draft(view) } else { view };
        let traced = render(request.backend, snapshot, &view, &mut film, &self.pool, control);
        let Ok(stats) = traced else {
            spares.push(Spare { film: Some(film), pixels });
            return None;
        };
        let film = Arc::new(film);
        if step.divisor == 1 && Self::is_refined(job) {
            self.resting = Some((Arc::clone(&film), Parts::new(size, step.quality)));
        }
        self.painted(job, &view, (film, pixels), stats.rays.total(), (control, spares))
    }

    fn frame_time(Job { request, .. }: &Job) -> f64 {
        request.frame_time
    }

    fn has_drafts(Job { request, .. }: &Job) -> bool {
        request.pass.paint.is_none() && has_draft(&request.view)
    }

    fn is_refined(Job { request, .. }: &Job) -> bool {
        request.pass.paint.is_none()
    }

    fn refine(&mut self, job: &Job, control: &Control, spares: &mut Vec<Spare>) -> Option<(Frame, Refined)> {
        let Job { request, snapshot } = job;
        let (film, parts) = self.resting.as_mut()?;
        let Request { backend, ref view, goal, tone, pass, .. } = *request;
        let tracer = Tracer { backend, snapshot, view, goal, tone };
        let (refined, rays) = parts.go_on(&tracer, &self.pool, control)?;
        let mut frame = Frame {
            film: Arc::clone(film),
            patches: parts.patches(),
            pixels: spares.pop().map(|spare| spare.pixels).unwrap_or_default(),
            camera: view.camera.clone(),
            size: Self::size(job),
            tone,
            rays,
            pass,
            numbers: None,
        };
        frame.encode(tone, &self.pool);
        if refined.is_done() {
            self.resting = None;
        }
        Some((frame, refined))
    }
}

#[cfg(test)]
mod tests;
