//! How fast is it going? Figures of the last frames, as a line of text.

use std::collections::VecDeque;
use std::time::{Duration, Instant};

use catoptra_core::Scene;
use catoptra_tracer::Snapshot;

use crate::draft::Quality;
use crate::frame_worker::Refined;
use crate::refine::Step;

/// How far back frames are counted.
const WINDOW: Duration = Duration::from_secs(1);

/// After this long without a frame nothing moves.
pub(crate) const REST: Duration = Duration::from_millis(400);

/// What is told of one finished frame.
#[derive(Debug, Clone, Copy)]
pub(crate) struct FrameFigures {
    /// How long tracing and encoding took.
    pub(crate) took: Duration,
    /// Rays traced.
    pub(crate) rays: u64,
    /// Width and height of the film in pixels.
    pub(crate) size: (u32, u32),
    /// How fine it is.
    pub(crate) step: Step,
    /// How far it is refined, once it is.
    pub(crate) refined: Option<Refined>,
    /// Nothing finer follows.
    pub(crate) is_last: bool,
}

impl FrameFigures {
    /// The line for a log: milliseconds, rays, size, divisor or share of the picture that is settled, and whether it is the
    /// last for now.
    pub(crate) fn log_line(&self) -> String {
        let step = match (self.refined, self.step.quality) {
            (Some(refined), _) => format!("1/1 settled {}% samples {}", refined.percent(), refined.samples),
            (None, Quality::Full) => format!("1/{}", self.step.divisor),
            (None, Quality::Draft) => format!("1/{} draft", self.step.divisor),
        };
        format!(
            "frame {:.2} ms {} rays {}x{} {step}{}",
            milliseconds(self.took),
            self.rays,
            self.size.0,
            self.size.1,
            if self.is_last { " at rest" } else { "" }
        )
    }
}

/// The last frames.
#[derive(Debug, Clone, Default)]
pub(crate) struct Meter {
    ends: VecDeque<Instant>,
    last: Option<FrameFigures>,
}

impl Meter {
    /// Takes in a frame finished at `now`.
    pub(crate) fn record(&mut self, figures: FrameFigures, now: Instant) {
        self.last = Some(figures);
        self.ends.push_back(now);
        self.forget(now);
    }

    /// Notes that another picture was asked for: the last one is not at rest any more.
    pub(crate) fn asked(&mut self) {
        if let Some(last) = &mut self.last {
            last.is_last = false;
            last.refined = None;
        }
    }

    /// The line to show at `now`: frame time, frames and rays per second, size, threads.
    pub(crate) fn line(&mut self, threads: usize, now: Instant) -> String {
        self.forget(now);
        let Some(last) = self.last else { return "tracing the first frame".to_owned() };
        let seconds = last.took.as_secs_f64().max(1e-9);
        format!(
            "{:.1} ms  ·  {}  ·  {}  ·  {}x{}{}  ·  {threads} {}",
            milliseconds(last.took),
            self.rate(now),
            ray_rate(last.rays as f64 / seconds),
            last.size.0,
            last.size.1,
            if last.step.divisor > 1 { format!(" (1/{})", last.step.divisor) } else { String::new() },
            if threads == 1 { "thread" } else { "threads" },
        )
    }

    /// Frames per second while it moves, else how far it is refined.
    fn rate(&self, now: Instant) -> String {
        let last = self.last.map(|last| (last.is_last, last.refined));
        match (last, self.ends.front(), self.ends.back()) {
            (Some((true, _)), ..) => "at rest".to_owned(),
            (Some((false, Some(refined))), ..) => {
                format!("refining, {} % settled, sample {}", refined.percent(), refined.samples)
            }
            (_, Some(first), Some(last)) if now.duration_since(*last) < REST && last > first => {
                let seconds = last.duration_since(*first).as_secs_f64();
                format!("{:.0} fps", (self.ends.len() - 1) as f64 / seconds)
            }
            _ => "refining".to_owned(),
        }
    }

    fn forget(&mut self, now: Instant) {
        while self.ends.front().is_some_and(|end| now.duration_since(*end) > WINDOW) {
            self.ends.pop_front();
        }
    }
}

/// What surfaces do not light as one may expect.
pub(crate) fn lamp_notes(scene: &Scene, snapshot: &Snapshot) -> Vec<String> {
    let names = snapshot.endless_lamps().filter_map(|lamp| scene.name(lamp));
    let endless = names.map(|name| format!("{name} has no end and lights nothing"));
    let names = snapshot.lamps_met_alone().filter_map(|lamp| scene.name(lamp));
    let met = names.map(|name| format!("only paths find the light of {name}"));
    let picked = snapshot.picked_lamps().map(|lamps| format!("{lamps} lamps, some picked at random"));
    endless.chain(met).chain(picked).collect()
}

fn milliseconds(duration: Duration) -> f64 {
    1e3 * duration.as_secs_f64()
}

fn ray_rate(rays_per_second: f64) -> String {
    if rays_per_second >= 1e6 {
        format!("{:.1} Mrays/s", rays_per_second / 1e6)
    } else {
        format!("{:.0} krays/s", rays_per_second / 1e3)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const FRAME: FrameFigures = FrameFigures {
        took: Duration::from_millis(10),
        rays: 500_000,
        size: (640, 360),
        step: Step { divisor: 2, quality: Quality::Full },
        refined: None,
        is_last: false,
    };

    #[test]
    fn the_line_tells_time_rate_rays_size_and_threads() {
        let mut meter = Meter::default();
        let start = Instant::now();
        for i in 0..=20 {
            meter.record(FRAME, start + Duration::from_millis(20 * i));
        }
        let line = meter.line(2, start + Duration::from_millis(400));
        assert_eq!(line, "10.0 ms  ·  50 fps  ·  50.0 Mrays/s  ·  640x360 (1/2)  ·  2 threads");
    }

    #[test]
    fn it_is_at_rest_only_when_nothing_finer_follows() {
        let mut meter = Meter::default();
        let (start, later) = (Instant::now(), Duration::from_secs(5));
        let refined =
            |settled| Some(Refined { settled, pixels: 1000, samples: 16, traced: 0, quality: Quality::Full });
        let full = FrameFigures { step: Step::FULL, ..FRAME };
        for (frame, told) in [
            (FRAME, "refining"),
            (full, "refining"),
            (FrameFigures { refined: refined(999), ..full }, "refining, 99 % settled, sample 16"),
            (FrameFigures { refined: refined(1000), is_last: true, ..full }, "at rest"),
        ] {
            meter.record(frame, start);
            assert_eq!(meter.rate(start + later), told);
        }
        meter.asked();
        assert_eq!(meter.rate(start + later), "refining");
    }

    #[test]
    fn only_the_last_second_counts() {
        let mut meter = Meter::default();
        let start = Instant::now();
        for i in 0..100 {
            meter.record(FRAME, start + Duration::from_millis(100 * i));
        }
        assert!(meter.ends.len() <= 11);
        assert!(meter.line(1, start + Duration::from_millis(9900)).contains("10 fps"));
    }

    #[test]
    fn a_plane_that_glows_is_told() {
        let text = "emissive \"glow\" { radiance 1 }\nplane \"ground\" material=\"glow\"\n\
            sphere \"ball\" material=\"glow\" { radius 1 }\n";
        let (scene, _) = catoptra_scene::parse(text, "text", None).unwrap();
        let snapshot = Snapshot::extract(&scene, &catoptra_tracer::Pool::new(1).unwrap());
        assert_eq!(lamp_notes(&scene, &snapshot), ["ground has no end and lights nothing"]);
    }

    #[test]
    fn a_log_line_is_one_line() {
        assert_eq!(FRAME.log_line(), "frame 10.00 ms 500000 rays 640x360 1/2");
        let draft = FrameFigures { step: Step { divisor: 2, quality: Quality::Draft }, ..FRAME };
        assert_eq!(draft.log_line(), "frame 10.00 ms 500000 rays 640x360 1/2 draft");
        let refined = Some(Refined { settled: 9, pixels: 9, samples: 64, traced: 0, quality: Quality::Full });
        let last = FrameFigures { refined, is_last: true, ..FRAME };
        assert_eq!(last.log_line(), "frame 10.00 ms 500000 rays 640x360 1/1 settled 100% samples 64 at rest");
    }
}
