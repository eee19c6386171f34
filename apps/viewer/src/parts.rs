//! Which tiles of a picture need more samples? Each is given twice as many again and again, until it is as sure as it has to be
//! or has the most that it may have; those with the fewest come first, so that the whole picture gets better together.
//!
//! A tile is sure when the standard error of what is displayed of each of its pixels is small enough, so an edge that some pixels
//! have missed is found by others beside them. What a tile becomes depends on nothing but itself.

use std::sync::Arc;
use std::time::{Duration, Instant};

use catoptra_core::{Integrator, Rgb, Settings};
use catoptra_tracer::{Backend, Control, Film, Moments, Pool, Region, Size, Snapshot, Tone, View, render};
use rayon::prelude::*;

use crate::canvas::Pixels;
use crate::draft::Quality;
use crate::frame_worker::Refined;

/// Edge of a tile in pixels.
const EDGE: u32 = 16;

/// Samples after which a tile is judged: so many lie evenly in a pixel.
const EVEN: u32 = 4;

/// Pixels of the tiles that grow at a time: each takes some 52 bytes of memory until it is settled. More than a display of 4K
/// has, so that what is usual gets better as a whole.
const GROWING: usize = 10_000_000;

/// For how long tiles are begun before the picture is shown, and how much longer for each of its pixels, as showing it takes
/// long too.
const SLICE: Duration = Duration::from_millis(120);
const SLICE_PER_PIXEL: Duration = Duration::from_nanos(60);

/// When a picture is refined enough.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Goal {
    /// The largest standard error of what is displayed of a pixel, 0..=1.
    pub(crate) max_error: f64,
    /// The most samples a pixel.
    pub(crate) most: u32,
}

/// The standard error that is allowed unless a scene or a person says otherwise: two steps of a display of 8 bits.
pub(crate) const USUAL_ERROR: f64 = 2.0 / 255.0;

impl Goal {
    /// As the scene says, or as `max_error` where it says nothing; and so many samples at most as its integrator can use, or
    /// as the scene asks for if that is more.
    pub(crate) fn of(settings: &Settings, integrator: Integrator, max_error: f64) -> Self {
        let most = match integrator {
            // So many lie so evenly that what they leave of an edge can hardly be seen; an error that takes each to be by
            // chance asks for many times more.
            Integrator::Whitted => 64,
            Integrator::Occlusion | Integrator::Path => 1024,
        };
        Self { max_error: settings.max_error().unwrap_or(max_error), most: settings.samples().max(most) }
    }
}

/// The light of a refined tile.
pub(crate) struct Patch {
    region: Region,
    /// Linear, row-major.
    light: Vec<[f32; 3]>,
}

/// The tiles of a picture that are refined, row by row; none where nothing is yet.
#[derive(Clone, Default)]
pub(crate) struct Patches {
    across: usize,
    tiles: Vec<Option<Arc<Patch>>>,
}

impl Patches {
    /// Draws them into a picture of their size.
    pub(crate) fn encode(&self, tone: Tone, pool: &Pool, Pixels { width, data, .. }: &mut Pixels) {
        let width = *width as usize;
        if self.across == 0 || width == 0 {
            return;
        }
        pool.run(|| {
            let bands = data.par_chunks_mut(width * EDGE as usize);
            bands.zip(self.tiles.par_chunks(self.across)).for_each(|(band, tiles)| {
                tiles.iter().flatten().for_each(|patch| patch.encode(tone, width, band));
            });
        });
    }
}

impl Patch {
    /// Draws it into its rows of a picture.
    fn encode(&self, tone: Tone, width: usize, band: &mut [u32]) {
        let across = self.region.size.width as usize;
        for (light, row) in self.light.chunks_exact(across).zip(band.chunks_exact_mut(width)) {
            for (light, pixel) in light.iter().zip(&mut row[self.region.x as usize..]) {
                let [r, g, b] = light.map(|light| u32::from(tone.byte(light)));
                *pixel = r << 16 | g << 8 | b;
            }
        }
    }
}

/// A tile on its way.
struct Part {
    region: Region,
    /// What it has gathered, while it goes on.
    film: Option<Film>,
    samples: u32,
    settled: bool,
    patch: Option<Arc<Patch>>,
}

impl Part {
    fn pixels(&self) -> u64 {
        self.region.size.pixels() as u64
    }
}

/// Who traces what, and how well.
pub(crate) struct Tracer<'a> {
    /// Who traces.
    pub(crate) backend: &'static dyn Backend,
    /// What is traced.
    pub(crate) snapshot: &'a Snapshot,
    /// The picture as it is seen.
    pub(crate) view: &'a View,
    /// When it is enough.
    pub(crate) goal: Goal,
    /// As what it is displayed.
    pub(crate) tone: Tone,
}

/// All tiles of a picture.
pub(crate) struct Parts {
    across: usize,
    /// What stands where nothing is refined yet.
    before: Quality,
    parts: Vec<Part>,
}

impl Parts {
    /// Of a picture of that size that has been traced so well. A draft first has a sample of each pixel in its place, soon.
    pub(crate) fn new(size: Size, before: Quality) -> Self {
        let starts = |length: u32| (0..length).step_by(EDGE as usize);
        let places = starts(size.height).flat_map(|y| starts(size.width).map(move |x| (x, y)));
        let parts = places.map(|(x, y)| {
            let region = Region::new(x, y, Size::new(EDGE, EDGE)).within(size);
            Part { region, film: None, samples: 0, settled: false, patch: None }
        });
        Self { across: starts(size.width).len(), before, parts: parts.collect() }
    }

    /// Refines for a while. Returns how far it is, and how many rays that took; `None` when it was cancelled.
    pub(crate) fn go_on(
        &mut self,
        tracer: &Tracer<'_>,
        pool: &Pool,
        control: &Control,
    ) -> Option<(Refined, u64)> {
        let pixels = tracer.view.size.pixels();
        let slice = SLICE + SLICE_PER_PIXEL * u32::try_from(pixels).unwrap_or(u32::MAX);
        let first = if self.before == Quality::Draft { 1 } else { EVEN };
        let since = Instant::now();
        let mut rays = 0;
        let before = self.samples();
        while since.elapsed() < slice {
            let mut growing: Vec<&mut Part> = self.parts.iter_mut().filter(|part| !part.settled).collect();
            growing.truncate(GROWING / (EDGE * EDGE) as usize);
            let Some(least) = growing.iter().map(|part| part.samples).min() else { break };
            growing.retain(|part| part.samples == least);
            let end = if least == 0 { first } else { (2 * least).max(EVEN) };
            let traced = pool.run(|| {
                let turns = growing.into_par_iter().with_max_len(1).filter(|_| since.elapsed() < slice);
                turns.map(|part| tracer.grow(part, end, pool, control)).sum::<Option<u64>>()
            });
            rays += traced?;
        }
        Some((self.refined(self.samples() - before), rays))
    }

    /// Samples of all pixels.
    fn samples(&self) -> u64 {
        self.parts.iter().map(|part| part.pixels() * u64::from(part.samples)).sum()
    }

    fn refined(&self, traced: u64) -> Refined {
        let settled = self.parts.iter().filter(|part| part.settled);
        let begun = self.parts.iter().all(|part| part.samples > 0);
        Refined {
            settled: settled.map(Part::pixels).sum(),
            pixels: self.parts.iter().map(Part::pixels).sum(),
            samples: self.parts.iter().map(|part| part.samples).max().unwrap_or(0),
            traced,
            quality: if begun { Quality::Full } else { self.before },
        }
    }

    /// What has been refined so far.
    pub(crate) fn patches(&self) -> Patches {
        Patches { across: self.across, tiles: self.parts.iter().map(|part| part.patch.clone()).collect() }
    }
}

impl Tracer<'_> {
    /// Traces the samples of a tile up to so many; `None` when that was cancelled.
    fn grow(&self, part: &mut Part, end: u32, pool: &Pool, control: &Control) -> Option<u64> {
        let end = end.min(self.goal.most);
        let film = part.film.get_or_insert_with(|| Film::of_region(part.region, EDGE));
        let view = View {
            crop: Some(part.region),
            samples: self.goal.most,
            range: Some(part.samples..end),
            moments: Moments::Luminance,
            ..self.view.clone()
        };
        let stats = render(self.backend, self.snapshot, &view, film, pool, control).ok()?;
        part.samples = end;
        part.patch = Some(Arc::new(Patch { region: part.region, light: film.radiances() }));
        part.settled = end >= self.goal.most || self.is_sure(film);
        if part.settled {
            part.film = None;
        }
        Some(stats.rays.total())
    }

    /// Whether each pixel is sure enough.
    fn is_sure(&self, film: &Film) -> bool {
        let Size { width, height } = film.size();
        let mut pixels = (0..height).flat_map(|y| (0..width).map(move |x| (x, y)));
        pixels.all(|(x, y)| {
            let Some(error) = film.standard_error(x, y) else { return false };
            let [r, g, b] = film.radiance(x, y).map(f64::from);
            let light = Rgb::new(r, g, b).luminance() as f32;
            0.5 * (self.tone.value(light + error) - self.tone.value(light - error)) <= self.goal.max_error
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_a_scene_asks_for_comes_first() {
        let settings = |text: &str| {
            let (scene, _) =
                catoptra_scene::parse(&format!("settings {{ {text} }}\n"), "text", None).unwrap();
            *scene.settings()
        };
        let of = |text, integrator| Goal::of(&settings(text), integrator, 0.5);
        assert_eq!(of("samples 4", Integrator::Whitted), Goal { max_error: 0.5, most: 64 });
        assert_eq!(
            of("samples 4096; max-error 0.25", Integrator::Path),
            Goal { max_error: 0.25, most: 4096 }
        );
    }

    #[test]
    fn tiles_cover_a_picture_once_and_settle_alone() {
        let mut parts = Parts::new(Size::new(40, 17), Quality::Full);
        assert_eq!((parts.across, parts.parts.len()), (3, 6));
        assert_eq!(parts.parts.iter().map(Part::pixels).sum::<u64>(), 40 * 17);
        parts.parts[1].settled = true;
        let Refined { settled, pixels, .. } = parts.refined(0);
        assert_eq!((settled, pixels), (256, 680));
        let draft = Parts::new(Size::new(40, 17), Quality::Draft);
        assert_eq!((draft.refined(0).quality, parts.refined(0).quality), (Quality::Draft, Quality::Full));
    }
}
