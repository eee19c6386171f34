//! How does a request become a frame? The tracer fills a film, the film is encoded for display.

use std::sync::Arc;

use catoptra_core::Camera;
use catoptra_tracer::{Backend, Control, Display, Film, Pool, Size, Snapshot, View, render};

use crate::canvas::Pixels;
use crate::frame_worker::Tracing;
use crate::refine::reduced;

/// All that a picture depends on.
#[derive(Clone)]
pub(crate) struct Request {
    /// The scene.
    pub(crate) snapshot: Arc<Snapshot>,
    /// Who traces.
    pub(crate) backend: &'static dyn Backend,
    /// From where, how large when traced in full, and what is shown.
    pub(crate) view: View,
    /// How radiance becomes colour.
    pub(crate) display: Display,
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
    pub(crate) display: Display,
    /// How many rays it took.
    pub(crate) rays: u64,
}

impl Frame {
    /// Encodes the film anew.
    pub(crate) fn encode(&mut self, display: Display, pool: &Pool) {
        let Size { width, height } = self.film.size();
        self.pixels.width = width;
        self.pixels.height = height;
        self.pixels.data.resize(width as usize * height as usize, 0);
        display.encode(&self.film, pool, &mut self.pixels.data);
        self.display = display;
    }
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
    pub(crate) pool: Arc<Pool>,
}

impl Tracing for PoolTracing {
    type Request = Request;
    type Frame = Frame;

    fn size(request: &Request) -> (u32, u32) {
        (request.view.size.width, request.view.size.height)
    }

    fn trace(
        &mut self,
        request: &Request,
        divisor: u32,
        control: &Control,
        spares: &mut Vec<Frame>,
    ) -> Option<Frame> {
        let full = Self::size(request);
        let (width, height) = reduced(full.0, full.1, divisor);
        let size = Size { width, height };
        let spare = spares.iter().position(|s| s.film.size() == size).map(|i| spares.swap_remove(i));
        let (mut film, pixels) = match spare {
            Some(spare) => (spare.film, spare.pixels),
            None => (Film::with_tiles(size, tile_edge(size)), Pixels::default()),
        };
        let view = View { size, ..request.view.clone() };
        let stats = render(request.backend, &request.snapshot, &view, &mut film, &self.pool, control).ok()?;
        let rays = stats.rays.total();
        let mut frame =
            Frame { film, pixels, camera: view.camera, size: full, display: request.display, rays };
        frame.encode(request.display, &self.pool);
        Some(frame)
    }
}
