//! How does a request become a frame? The scene is frozen, the tracer fills a film, the film is encoded for display.

use std::sync::Arc;

use catoptra_core::Camera;
use catoptra_tracer::{Backend, Control, Extraction, Film, Pool, Size, Snapshot, Tone, View, render};

use crate::canvas::{Pixels, resize};
use crate::frame_worker::Tracing;
use crate::latest::Latest;
use crate::light_parts::LightParts;
use crate::pass::{Numbers, OwnShapes, Pass, Seen};
use crate::refine::{Batch, reduced};

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
    /// Samples a pixel that the full picture is to have in the end.
    pub(crate) at_rest: u32,
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
    pub(crate) film: Film,
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
    film: Film,
    pixels: Pixels,
}

impl From<Frame> for Spare {
    fn from(Frame { film, pixels, .. }: Frame) -> Self {
        Self { film, pixels }
    }
}

/// One of that size, or a new one.
fn room(size: Size, spares: &mut Vec<Spare>) -> Spare {
    let fitting = spares.iter().position(|spare| spare.film.size() == size);
    fitting
        .map(|i| spares.swap_remove(i))
        .unwrap_or_else(|| Spare { film: Film::with_tiles(size, tile_edge(size)), pixels: Pixels::default() })
}

/// Below this number of pixels a film has small tiles: else few of them hold all the work, and threads wait.
const SMALL: usize = 100_000;

/// The edge of the tiles of a film, in pixels.
fn tile_edge(size: Size) -> u32 {
    if size.pixels() < SMALL { Film::TILE / 4 } else { Film::TILE }
}

/// The batches in which samples are added to a full picture.
const BATCHES: u32 = 16;

/// Pixels of the largest picture that samples are added to, a little more than of a display of 4K: a film beside the shown
/// one is kept for that, of 20 bytes a pixel.
const LARGEST: usize = 10_000_000;

/// Samples of the smallest batch: so many lie evenly in a pixel.
const LEAST_BATCH: u32 = 4;

/// Traces on a pool of threads.
pub(crate) struct PoolTracing {
    /// The threads.
    pool: Arc<Pool>,
    /// The full picture to which samples are being added.
    growing: Option<Film>,
}

impl PoolTracing {
    /// On these threads.
    pub(crate) fn new(pool: Arc<Pool>) -> Self {
        Self { pool, growing: None }
    }

    /// A frame of a film that was traced; `None` when that was cancelled, and then the room is among the spares.
    pub(crate) fn painted(
        &self,
        job: &Job,
        view: &View,
        (film, pixels): (Film, Pixels),
        rays: u64,
        (control, spares): (&Control, &mut Vec<Spare>),
    ) -> Option<Frame> {
        let request = &job.request;
        let size = (request.view.size.width, request.view.size.height);
        let (camera, tone, pass) = (view.camera.clone(), request.tone, request.pass);
        let mut frame = Frame { film, pixels, camera, size, tone, rays, pass, numbers: None };
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
        let snapshot = request.latest.follow(&request.extraction, &self.pool);
        Job { request, snapshot }
    }

    fn size(job: &Job) -> (u32, u32) {
        (job.request.view.size.width, job.request.view.size.height)
    }

    fn trace(
        &mut self,
        job: &Job,
        divisor: u32,
        control: &Control,
        spares: &mut Vec<Spare>,
    ) -> Option<Frame> {
        let Job { request, snapshot } = job;
        let full = (request.view.size.width, request.view.size.height);
        let (width, height) = reduced(full.0, full.1, divisor);
        let size = Size { width, height };
        let Spare { mut film, pixels } = room(size, spares);
        let view = View { size, ..request.view.clone() };
        let traced = render(request.backend, snapshot, &view, &mut film, &self.pool, control);
        let Ok(stats) = traced else {
            spares.push(Spare { film, pixels });
            return None;
        };
        self.painted(job, &view, (film, pixels), stats.rays.total(), (control, spares))
    }

    fn frame_time(Job { request, .. }: &Job) -> f64 {
        request.frame_time
    }

    fn batches(Job { request, .. }: &Job) -> Vec<Batch> {
        let refined = request.view.size.pixels() <= LARGEST && request.pass.paint.is_none();
        let of = if refined { request.at_rest } else { 0 };
        Batch::all(of, of.div_ceil(BATCHES).max(LEAST_BATCH))
    }

    fn add(&mut self, job: &Job, batch: Batch, control: &Control, spares: &mut Vec<Spare>) -> Option<Frame> {
        let Job { request, snapshot } = job;
        let growing = self.growing.take().filter(|_| batch.from > 0);
        let mut film = growing.unwrap_or_else(|| room(request.view.size, spares).film);
        let view = View { samples: batch.of, range: Some(batch.range()), ..request.view.clone() };
        let traced = render(request.backend, snapshot, &view, &mut film, &self.pool, control);
        let pixels = spares.pop().map(|spare| spare.pixels).unwrap_or_default();
        let Ok(stats) = traced else {
            spares.push(Spare { film, pixels });
            return None;
        };
        if !batch.is_last() {
            self.growing = Some(film.clone());
        }
        self.painted(job, &view, (film, pixels), stats.rays.total(), (control, spares))
    }
}

#[cfg(test)]
mod tests;
