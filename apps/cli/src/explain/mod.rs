//! `catoptra explain`: what does a scene need, what runs for it, what takes how long, and which work was skipped as it could not
//! matter?

mod advice;
mod needs;
mod reasons;
mod slow;

use catoptra_core::Light;
use catoptra_tracer::{EdgePixels, Edges, ExactKinds, Needs, Stats};
use miette::Result;
use serde_json::{Map, Value, json};

use crate::args::ExplainArgs;
use crate::console::{check_heard, print_answer};
use crate::job::{Job, Means, Resources, find_camera};
use crate::loaded::Loaded;
use crate::processor;
use crate::words::{counted, percent, thousands};
use crate::{Outcome, interrupt, progress};
use reasons::{
    LAMP_CLASSES, LampClass, NO_OCCLUSION_RAY, NO_PRIMARY_RAY, NO_REFLECTION_RAY, NO_SHADOW_RAY, Reason,
};
use slow::Slow;

/// Traces one frame to count its work, and says what was found.
pub(crate) fn run(args: &ExplainArgs) -> Result<Outcome> {
    let means = Means::of(&args.job)?;
    check_heard()?;
    let resources = Resources::claim(&args.job, |_| 0)?;
    let loaded = Loaded::read(&args.scene)?;
    let camera = find_camera(&loaded.scene, args.job.camera.as_deref())?;
    let mut job = Job::new(&args.job, means, &resources, loaded, camera)?;
    // A frame tells the same of the work for a sample as many do.
    job.view.samples = args.job.samples.unwrap_or(1);
    job.warn_of_idle(&args.job);
    let control = interrupt::control();
    let mut film = job.film()?;
    let Ok((frame_ms, frame)) = progress::while_showing(&control, || job.frame(&mut film, &control)) else {
        return Ok(Outcome::Interrupted);
    };
    let Ok(slow) = Slow::measured(&job, frame_ms, &control) else { return Ok(Outcome::Interrupted) };
    let found = Found {
        needs: job.snapshot.needs(),
        ambient: ambient_lights(&job),
        job: &job,
        stats: frame.stats,
        frame_ms,
        slow,
    };
    print_answer(&if args.json { format!("{}\n", found.as_json()) } else { found.as_text() })?;
    Ok(Outcome::Done)
}

fn ambient_lights(job: &Job) -> usize {
    let lights = job.scene.entities().filter_map(|id| job.scene.light(id));
    lights.filter(|light| matches!(light, Light::AmbientLight(_))).count()
}

/// What is known of a scene after a frame.
struct Found<'a> {
    job: &'a Job,
    needs: Needs,
    ambient: usize,
    stats: Stats,
    /// How long the frame took.
    frame_ms: f64,
    slow: Slow,
}

impl Found<'_> {
    fn as_json(&self) -> Value {
        let needs = &self.needs;
        json!({
            "scene": self.job.scene_name,
            "camera": self.job.camera_name,
            "size": self.job.view.size,
            "crop": self.job.view.crop,
            "samples": self.job.view.samples,
            "pattern": self.job.view.pattern.name(),
            "filter": self.job.view.filter.name(),
            "edges": self.job.view.edges.name(),
            "seed": self.job.view.seed,
            "integrator": self.job.view.integrator.name(),
            "max_depth": self.job.view.max_depth,
            "backend": self.job.backend.name(),
            "simd": self.job.backend.level(&self.job.view),
            "threads": self.job.pool.threads(),
            "shapes": by_kind(&needs.shapes),
            "materials": by_kind(&needs.materials),
            "lights": by_kind(&needs.lights),
            "shining_shapes": by_kind(&needs.shining_shapes),
            "lamp_outlines": needs.outlines,
            "lamps_picked": needs.picks_lamps,
            "endless_lamps": needs.endless_lamps,
            "lamps_met_alone": needs.lamps_met_alone,
            "ambient_lights": self.ambient,
            "shadowing_lights": needs.shadowing_lights,
            "shapes_without_end": needs.unbounded,
            "shapes_with_kernel": needs.with_kernel,
            "meshes": needs.meshes,
            "triangles": needs.triangles,
            "tree_bytes": needs.tree_bytes,
            "texture_bytes": needs.texture_bytes,
            "shades_by_point": needs.shades_by_point,
            "reflects": needs.reflects,
            "counts": self.stats,
            "version": env!("CARGO_PKG_VERSION"),
            "processor": processor::as_json(),
            "stages_ms": { "load": self.job.load_ms, "snapshot": self.job.build_ms, "trace": self.frame_ms },
            "slow": self.slow.as_json(),
            "advice": advice::of(self),
        })
    }

    fn as_text(&self) -> String {
        let (job, size) = (self.job, self.job.view.size);
        let samples = counted(u64::from(job.view.samples), "sample");
        format!(
            "{} through camera \"{}\" at {}x{}, {samples} a pixel\n\n\
             The scene holds\n{}\nWhat runs\n{}\nWhat takes how long\n{}\nOne frame traced\n{}\nIt did not trace\n{}\n\
             {}How sure it is\n{}\nWhat would help\n{}",
            job.scene_name,
            job.camera_name,
            size.width,
            size.height,
            lines(&self.holdings()),
            lines(&self.runs()),
            lines(&self.times()),
            lines(&self.traced()),
            lines(&self.skipped()),
            self.lamplight(),
            lines(&self.certainty()),
            lines(&advice::of(self)),
        )
    }

    /// Milliseconds of each stage, and what of the picture takes most of the last.
    fn times(&self) -> Vec<String> {
        let stages = [
            ("reading the scene", self.job.load_ms),
            ("making the snapshot", self.job.build_ms),
            ("tracing the frame", self.frame_ms),
        ];
        let mut lines: Vec<String> =
            stages.iter().map(|(what, ms)| format!("{ms:>10.2} ms  {what}")).collect();
        lines.extend(self.slow.as_lines());
        lines
    }

    fn traced(&self) -> Vec<String> {
        let (rays, tests) = (&self.stats.rays, &self.stats.tests);
        let each = |count: u64| format!("{:.1} a ray", count as f64 / rays.total().max(1) as f64);
        let mut lines = vec![
            counted(rays.primary, "primary ray"),
            counted(rays.shadow, "shadow ray"),
            format!("{} to points of lamps", counted(rays.lamp, "ray")),
            counted(rays.reflection, "reflection ray"),
            counted(rays.occlusion, "occlusion ray"),
            format!("{} against shapes and triangles, {}", counted(tests.shapes, "test"), each(tests.shapes)),
            format!("{} against boxes of trees, {}", counted(tests.boxes, "test"), each(tests.boxes)),
        ];
        lines.extend(self.edges());
        lines
    }

    /// How pixels were shown that outlines cross.
    fn edges(&self) -> Option<String> {
        let EdgePixels { parted, quartered, sampled, pieces } = self.stats.edges;
        (self.job.view.edges == Edges::Exact).then(|| {
            format!(
                "{} that outlines cross, by {}: {} parted by lines, {} quartered, {} sampled",
                counted(parted + quartered + sampled, "pixel"),
                counted(pieces, "ray"),
                thousands(parted),
                thousands(quartered),
                thousands(sampled)
            )
        })
    }

    fn skipped(&self) -> Vec<String> {
        let rays = &self.stats.rays;
        let mut lines = self.skipped_of("primary ray", rays.primary, NO_PRIMARY_RAY);
        lines.extend(self.skipped_of("shadow ray", rays.shadow, NO_SHADOW_RAY));
        lines.extend(self.skipped_of("reflection ray", rays.reflection, NO_REFLECTION_RAY));
        lines.extend(self.skipped_of("occlusion ray", rays.occlusion, NO_OCCLUSION_RAY));
        lines
    }

    fn skipped_of(&self, what: &str, traced: u64, reasons: &[Reason]) -> Vec<String> {
        let counts = reasons.iter().map(|(words, count)| (*words, count(&self.stats.skipped)));
        let counts: Vec<(&str, u64)> = counts.filter(|(_, count)| *count > 0).collect();
        let skipped: u64 = counts.iter().map(|(_, count)| count).sum();
        let possible = skipped + traced;
        let share = percent(skipped, possible);
        let mut lines =
            vec![format!("{} of {} possible ({share})", counted(skipped, what), thousands(possible))];
        for (words, count) in counts {
            lines.push(format!("  {:>12} ({:>6})  {words}", thousands(count), percent(count, possible)));
        }
        lines
    }

    /// How light from surfaces was found; nothing where there is none.
    fn lamplight(&self) -> String {
        let outlines = self.needs.outlines as u64;
        if outlines == 0 {
            return String::new();
        }
        let of_lamps = |class: &LampClass| (class.0, class.1(&self.stats.lamps));
        let counts: Vec<(&str, u64)> =
            LAMP_CLASSES.iter().map(of_lamps).filter(|(_, count)| *count > 0).collect();
        let asked: u64 = counts.iter().map(|(_, count)| count).sum();
        let whom = match outlines {
            1 => "a lamp".to_owned(),
            _ if self.needs.picks_lamps => format!("some of {} lamps, picked at random", thousands(outlines)),
            _ => format!("each of {} lamps and faces of lamps", thousands(outlines)),
        };
        let mut text = vec![format!("{} asked {whom}", counted(asked, "point"))];
        for (words, count) in counts {
            text.push(format!("  {:>12} ({:>6})  {words}", thousands(count), percent(count, asked)));
        }
        format!("Light from surfaces\n{}\n", lines(&text))
    }

    fn certainty(&self) -> Vec<String> {
        let stats = &self.stats;
        let rate = |count: u64| {
            format!("{:.1} of a million tests", count as f64 * 1e6 / stats.tests.shapes.max(1) as f64)
        };
        let ExactKinds { sides, places, orders } = stats.exact_kinds;
        let (settled, exact) = (counted(stats.settled, "answer"), counted(stats.exact, "answer"));
        vec![
            format!("{settled} f32 could not decide, and f64 did: {}", rate(stats.settled)),
            format!("{exact} f64 could not decide, and exact arithmetic did: {}", rate(stats.exact)),
            format!("  {:>12}  on which side of a ray an edge passes", thousands(sides)),
            format!("  {:>12}  where a surface is met, if it is", thousands(places)),
            format!("  {:>12}  which of two surfaces comes first", thousands(orders)),
            format!(
                "{} of triangles that rays meet at one point, seen by their corners and planes",
                counted(stats.ties, "tie")
            ),
            format!(
                "{} not finite, put to the largest number or to black",
                counted(stats.not_finite, "colour")
            ),
        ]
    }
}

fn lines(lines: &[String]) -> String {
    lines.iter().map(|line| format!("  {line}\n")).collect()
}

fn all_counted(kinds: &[(&str, usize)], what: &str) -> String {
    counted(kinds.iter().map(|(_, count)| *count as u64).sum(), what)
}

fn by_kind(kinds: &[(&str, usize)]) -> Map<String, Value> {
    kinds.iter().map(|(name, count)| ((*name).to_owned(), json!(count))).collect()
}
