//! How does a picture of any size come into its file? On a thread of its own, with threads of its own: the window goes on
//! meanwhile.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use catoptra_scene::image::{write_exr, write_png_rows};
use catoptra_scene::memory;
use catoptra_tracer::{Control, Film, Pool, Scale, Size, Target, render, render_until};

use super::{Format, Wish};
use crate::app::{App, Wake};
use crate::canvas::Pixels;
use crate::frame_worker::Tracing as _;
use crate::tracing::{Frame, Job, PoolTracing, Request};

/// A picture that is to be made, and of what.
pub(crate) struct Order {
    pub(crate) wish: Wish,
    /// What is traced, as large and as fine as is wished for.
    pub(crate) request: Request,
    /// How sure pixels are to be, where the scene says so: then the samples are the most.
    pub(crate) max_error: Option<f64>,
    /// Tells how far it is, and cancels it.
    pub(crate) control: Arc<Control>,
}

/// What became of a picture.
pub(crate) struct Outcome {
    pub(crate) path: PathBuf,
    pub(crate) result: Result<(), Unfinished>,
}

/// Why there is no picture.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) enum Unfinished {
    /// A person gave it up.
    Cancelled,
    /// For people.
    Failed(String),
}

/// What tracing needs beside the film, and writing the picture, in bytes.
const BESIDE: u64 = 16 << 20;

/// Bytes of a pixel beside the film: its colours for display.
const COLORS: u64 = 4;

impl App {
    /// Begins with the picture that is wanted, if one is.
    pub(crate) fn make_picture_if_wanted(&mut self) {
        let Some(order) = self.viewer.take_picture_order() else { return };
        let (proxy, threads) = (self.proxy.clone(), self.pool.threads());
        std::thread::spawn(move || {
            let result = make(&order, threads);
            // The loop may have ended; then no one waits for the picture.
            let _ = proxy.send_event(Wake::Made(Outcome { path: order.wish.path, result }));
        });
    }
}

/// Traces a picture with that many threads and writes it, whole or not at all.
pub(super) fn make(order: &Order, threads: usize) -> Result<(), Unfinished> {
    let failed = |problem: &dyn std::fmt::Display| Unfinished::Failed(problem.to_string());
    let size = order.request.view.size;
    let film = film(size, order.max_error.is_some())?;
    let pool = Arc::new(Pool::new(threads).map_err(|e| failed(&e))?);
    let mut tracing = PoolTracing::new(Arc::clone(&pool));
    let job = tracing.prepare(order.request.clone());
    let frame = trace(order, (&tracing, &job), film, &pool).ok_or(Unfinished::Cancelled)?;
    write(&order.wish.path, &frame).map_err(Unfinished::Failed)
}

/// Room for a picture, if there is as much memory.
fn film(size: Size, judged: bool) -> Result<Film, Unfinished> {
    let film = if judged { Film::judged_bytes_of(size) } else { Film::bytes_of(size) };
    let needed = film + COLORS * size.pixels() as u64 + BESIDE;
    let gib = |bytes: u64| bytes as f64 / f64::from(1 << 30);
    let too_large = |there: &str| {
        let Size { width, height } = size;
        let needed = gib(needed);
        Unfinished::Failed(format!("{width}x{height} pixels need {needed:.1} GiB of memory, and {there}"))
    };
    match memory::free_bytes() {
        Some(free) if free < needed => Err(too_large(&format!("{:.1} are free", gib(free)))),
        _ => Film::try_of_region(size.into(), Film::TILE).map_err(|_| too_large("there is less")),
    }
}

/// The picture; `None` when it was cancelled.
fn trace(order: &Order, (tracing, job): (&PoolTracing, &Job), mut film: Film, pool: &Pool) -> Option<Frame> {
    let (request, control) = (&order.request, &*order.control);
    let (view, snapshot) = (&request.view, &job.snapshot);
    let rays = match order.max_error.filter(|_| view.samples >= Target::LEAST) {
        None => render(request.backend, snapshot, view, &mut film, pool, control).ok()?.rays,
        Some(max_error) => {
            let scale = match Format::of(&order.wish.path) {
                Some(Format::Exr) => Scale::Radiance,
                _ => Scale::Displayed(request.tone),
            };
            let target = Target { max_error: Some(max_error), scale, time: None, most: view.samples };
            let all = (view, &target);
            render_until(request.backend, snapshot, all, &mut film, pool, control).ok()?.stats.rays
        }
    };
    tracing.painted(job, view, (Arc::new(film), Pixels::default()), rays.total(), (control, &mut Vec::new()))
}

fn write(path: &Path, frame: &Frame) -> Result<(), String> {
    let Pixels { width, height, data } = &frame.pixels;
    if Format::of(path) == Some(Format::Exr) {
        return write_exr(path, [*width, *height], |x, y| frame.film.radiance(x, y))
            .map_err(|e| e.to_string());
    }
    let written = write_png_rows(path, *width, *height, |y, row| {
        let pixels = &data[y as usize * *width as usize..];
        for (bytes, pixel) in row.chunks_exact_mut(3).zip(pixels) {
            bytes.copy_from_slice(&pixel.to_be_bytes()[1..]);
        }
    });
    written.map_err(|problem| problem.message().to_owned())
}
