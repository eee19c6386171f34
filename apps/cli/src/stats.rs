//! What did the frames cost? Times and counts as one JSON object.

use std::path::Path;

use catoptra_scene::memory::peak_bytes;
use catoptra_tracer::Reached;
use miette::{IntoDiagnostic, Result};
use serde::Serialize;
use serde_json::{Value, json};

use crate::job::{Frame, Job};
use crate::output::write_file;
use crate::processor;

/// Milliseconds of the timed frames.
pub(crate) struct FrameTimes {
    pub(crate) min: f64,
    pub(crate) median: f64,
    pub(crate) frames: usize,
}

impl FrameTimes {
    /// Of one time per frame; zeros without any. The median of an even number is the mean of the middle two.
    pub(crate) fn of(mut times: Vec<f64>) -> Self {
        times.sort_by(f64::total_cmp);
        let frames = times.len();
        let at = |index: usize| times.get(index).copied().unwrap_or(0.0);
        Self { min: at(0), median: 0.5 * (at(frames.saturating_sub(1) / 2) + at(frames / 2)), frames }
    }
}

/// Milliseconds of what is done for a picture, in order.
#[derive(Debug, Clone, Copy, Default, Serialize)]
pub(crate) struct Stages {
    /// Reading the scene and its files.
    pub(crate) load: f64,
    /// Making the snapshot, with its trees.
    pub(crate) snapshot: f64,
    /// From snapshot to film.
    pub(crate) trace: f64,
    /// Asking for what layers show beside light.
    pub(crate) layers: f64,
    /// Writing the picture.
    pub(crate) write: f64,
}

/// The object that `--stats` writes.
///
/// `frame_ms` is the time from snapshot to film, `build_ms` that from scene to snapshot; counts are of one frame.
fn as_json(job: &Job, (times, stages): (&FrameTimes, &Stages), frame: &Frame) -> Result<Value> {
    let mut object = json!({
        "version": env!("CARGO_PKG_VERSION"),
        "processor": processor::as_json(),
        "scene": job.scene_name,
        "camera": job.camera_name,
        "backend": job.backend.name(),
        "integrator": job.view.integrator.name(),
        "simd": job.backend.level(&job.view),
        "threads": job.pool.threads(),
        "size": job.view.size,
        "crop": job.view.crop,
        "samples": job.view.samples,
        "pattern": job.view.pattern.name(),
        "filter": job.view.filter.name(),
        "edges": job.view.edges.name(),
        "seed": job.view.seed,
        "max_depth": job.view.max_depth,
        "frames": times.frames,
        "frame_ms": { "min": times.min, "median": times.median },
        "build_ms": job.build_ms,
        "stages_ms": stages,
        "turned": job.turned,
        "peak_memory_bytes": peak_bytes(),
    });
    if let (Value::Object(object), Value::Object(counts)) =
        (&mut object, serde_json::to_value(frame.stats).into_diagnostic()?)
    {
        object.extend(counts);
        if let Some(reached) = &frame.reached {
            object.extend([("reached".to_owned(), reached_as_json(job, reached))]);
        }
    }
    Ok(object)
}

/// What a target has come to: the largest standard error of a pixel, and samples a pixel.
fn reached_as_json(job: &Job, reached: &Reached) -> Value {
    json!({
        "max_error": job.target.and_then(|target| target.max_error),
        "error": reached.error,
        "samples": { "min": reached.fewest, "mean": reached.mean, "max": reached.most },
        "pixels_above": reached.unfinished,
    })
}

/// Writes the object, whole or not at all.
pub(crate) fn write_stats(
    path: &Path,
    job: &Job,
    times: (&FrameTimes, &Stages),
    frame: &Frame,
) -> Result<()> {
    let mut text = serde_json::to_string_pretty(&as_json(job, times, frame)?).into_diagnostic()?;
    text.push('\n');
    write_file(path, text.as_bytes())
}

#[cfg(test)]
mod tests {
    use super::FrameTimes;

    #[test]
    fn the_median_lies_in_the_middle() {
        let odd = FrameTimes::of(vec![3.0, 1.0, 9.0]);
        assert_eq!((odd.min, odd.median, odd.frames), (1.0, 3.0, 3));
        assert_eq!(FrameTimes::of(vec![4.0, 1.0, 2.0, 9.0]).median, 3.0);
        assert_eq!(FrameTimes::of(vec![5.0]).median, 5.0);
    }
}
