//! `catoptra cast`: what do rays of a file meet in a scene?

use std::path::{Path, PathBuf};

use catoptra_core::glam::DVec3;
use catoptra_core::{EntityId, Ray, Scene};
use catoptra_tracer::query::{HitList, RayList, find_nearest, find_occluded};
use catoptra_tracer::{
    Backend, Caster, Control, InvalidRay, InvalidRays, Pool, Preset, RayColumns, Snapshot, WorldHit, WorldRay,
};
use clap::Args;
use miette::{IntoDiagnostic, Result, miette};

use crate::Outcome;
use crate::args::STANDARD;
use crate::console::{check_heard, print_answer};
use crate::loaded::Loaded;
use crate::names::find_backend;
use crate::numbers::in_full;
use crate::pool::new_pool;
use crate::rows::{Form, Rows};
use crate::suggest::unknown;

#[derive(Args)]
pub(crate) struct CastArgs {
    /// Scene file (.kdl) or model file, or - for standard input
    scene: PathBuf,
    /// File with a ray a line, `x y z dx dy dz [tmin [tmax]]`, or - for standard input; blank lines and those that begin with #
    /// pass through
    rays: PathBuf,
    /// Ask whether a ray meets anything: 1 or 0 a line
    #[arg(long, conflicts_with = "all")]
    any: bool,
    /// All that a ray meets, in order: lines that begin with the number of the ray, counted from 1
    #[arg(long)]
    all: bool,
    /// Leave out a thing of the scene, as if all rays started on it
    #[arg(long, value_name = "NAME")]
    without: Option<String>,
    /// Backend to trace with: wide (fast), scalar or oracle (exhaustive)
    #[arg(long, value_name = "NAME", default_value = "wide", conflicts_with_all = ["all", "without"])]
    backend: String,
    /// Threads to trace with [default: one per core]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    threads: Option<u16>,
}

/// A ray, and the stretch of it that counts, in lengths of its direction.
type Stretch = (Ray, [f64; 2]);

/// A ray of a file.
const RAY: Form<Stretch> = Form {
    numbers: [6, 8],
    finite: 6,
    says: "six to eight numbers",
    help: "a line is a start, a direction of any length and a stretch, in lengths of the direction, with spaces between: \
           x y z dx dy dz [tmin [tmax]]",
    make: |numbers| {
        let ray = Ray::new(DVec3::from_slice(numbers), DVec3::from_slice(&numbers[3..]));
        if ray.direction == DVec3::ZERO {
            return Err((3, "the direction must not be zero".to_owned()));
        }
        let end = |at: usize, usual: f64| numbers.get(at).copied().unwrap_or(usual);
        let ends = [end(6, 0.0), end(7, f64::INFINITY)];
        if ends[0] > ends[1] {
            return Err((7, "the stretch ends before it begins".to_owned()));
        }
        Ok((ray, ends))
    },
};

/// Asks and prints.
pub(crate) fn run(args: &CastArgs) -> Result<Outcome> {
    let backend = find_backend(&args.backend)?;
    if args.scene == Path::new(STANDARD) && args.rays == Path::new(STANDARD) {
        return Err(miette!(
            help = "give one of them as a file",
            "the scene and the rays cannot both come from standard input"
        ));
    }
    check_heard()?;
    let rays = Rows::read(&args.rays, &RAY)?;
    let pool = new_pool(args.threads)?;
    let Loaded { scene, .. } = Loaded::read(&args.scene)?;
    let caster =
        Caster::from_scene_with(&scene, Preset::default(), &pool, &Control::default()).into_diagnostic()?;
    let without = args.without.as_deref().map(|name| find_thing(&scene, &caster, name)).transpose()?;
    let caster = Answers { backend, scene: &scene, caster: &caster, without, pool: &pool };
    print_answer(&match (args.any, args.all) {
        (true, _) => rays.answered(caster.any(&rays)?),
        (false, true) => rays.answered(caster.all(&rays)?),
        (false, false) => rays.answered(caster.nearest(&rays)?),
    })?;
    Ok(Outcome::Done)
}

/// What rays can meet that has such a name.
fn find_thing(scene: &Scene, caster: &Caster, name: &str) -> Result<EntityId> {
    let things = caster.snapshot().entities();
    if let Some(id) = scene.entity_named(name).filter(|id| things.contains(id)) {
        return Ok(id);
    }
    let names: Vec<String> = things.iter().filter_map(|id| scene.name(*id)).collect();
    let known: Vec<&str> = names.iter().map(String::as_str).collect();
    Err(unknown("thing that rays can meet", name, &known))
}

/// Who answers.
struct Answers<'a> {
    backend: &'static dyn Backend,
    scene: &'a Scene,
    caster: &'a Caster,
    /// What no ray meets.
    without: Option<EntityId>,
    pool: &'a Pool,
}

/// What stands for no hit.
const MISS: &str = "miss";

impl Answers<'_> {
    fn snapshot(&self) -> &Snapshot {
        self.caster.snapshot()
    }

    /// What each ray meets first.
    fn nearest(&self, rays: &Rows<Stretch>) -> Result<Vec<String>> {
        if let Some(entity) = self.without {
            let columns = Columns::leaving(entity, rays);
            let rays = columns.rays().into_diagnostic()?;
            let hits = self.caster.nearest_many(&rays, self.pool).into_diagnostic()?;
            return Ok(hits.iter().map(|met| self.words_or_miss(met.as_ref())).collect());
        }
        let (list, mut hits) = (list(rays), HitList::default());
        find_nearest(self.backend, self.snapshot(), &list, &mut hits, self.pool);
        let line = |(at, (ray, _)): (usize, &Stretch)| {
            let met = hits.get(at).and_then(|(surface, t)| {
                self.caster.hit_on(&WorldRay::new(ray.origin, ray.direction).ok()?, surface, t)
            });
            self.words_or_miss(met.as_ref())
        };
        Ok(rays.iter().enumerate().map(line).collect())
    }

    /// Whether each ray meets anything.
    fn any(&self, rays: &Rows<Stretch>) -> Result<Vec<String>> {
        let met = if let Some(entity) = self.without {
            let columns = Columns::leaving(entity, rays);
            self.caster.any_many(&columns.rays().into_diagnostic()?, self.pool).into_diagnostic()?
        } else {
            let (list, mut met) = (list(rays), Vec::new());
            find_occluded(self.backend, self.snapshot(), &list, &mut met, self.pool);
            met.truncate(list.len());
            met
        };
        Ok(met.iter().map(|met| u8::from(*met).to_string()).collect())
    }

    /// All that each ray meets.
    fn all(&self, rays: &Rows<Stretch>) -> Result<Vec<String>> {
        let lines = |(at, (ray, ends)): (usize, &Stretch)| {
            let number = at + 1;
            let ray = WorldRay::new(ray.origin, ray.direction)?.within(*ends)?;
            let ray = self.without.map_or(ray, |entity| ray.leaving_entity(entity));
            let lines: Vec<String> =
                self.caster.all(&ray).iter().map(|hit| format!("{number} {}", self.words(hit))).collect();
            Ok(if lines.is_empty() { format!("{number} {MISS}") } else { lines.join("\n") })
        };
        rays.iter().enumerate().map(lines).collect::<Result<_, InvalidRay>>().into_diagnostic()
    }

    fn words_or_miss(&self, met: Option<&WorldHit>) -> String {
        met.map_or_else(|| MISS.to_owned(), |met| self.words(met))
    }

    /// `t entity triangle px py pz nx ny nz`.
    fn words(&self, met: &WorldHit) -> String {
        let name = self.scene.name(met.entity).unwrap_or_default();
        let numbers = [met.point, met.normal].map(|vector| vector.to_array());
        let numbers: Vec<String> = numbers.as_flattened().iter().map(|v| in_full(*v)).collect();
        format!("{} {} {} {}", in_full(met.t), one_word(&name), met.triangle, numbers.join(" "))
    }
}

/// Rays side by side, all of which leave one thing.
struct Columns {
    origins: Vec<DVec3>,
    directions: Vec<DVec3>,
    ends: Vec<[f64; 2]>,
    left: Vec<Option<EntityId>>,
}

impl Columns {
    fn leaving(entity: EntityId, rays: &Rows<Stretch>) -> Self {
        Self {
            origins: rays.iter().map(|(ray, _)| ray.origin).collect(),
            directions: rays.iter().map(|(ray, _)| ray.direction).collect(),
            ends: rays.iter().map(|(_, ends)| *ends).collect(),
            left: rays.iter().map(|_| Some(entity)).collect(),
        }
    }

    fn rays(&self) -> Result<RayColumns<'_>, InvalidRays> {
        RayColumns::new(&self.origins, &self.directions)?.within(&self.ends)?.leaving_entities(&self.left)
    }
}

fn list(rays: &Rows<Stretch>) -> RayList {
    let mut list = RayList::new();
    rays.iter().for_each(|(ray, ends)| list.push(ray, *ends, None));
    list
}

/// A name as a word without blanks: in quotes, as JSON has them, where it has blanks or quotes itself.
fn one_word(name: &str) -> String {
    let is_plain = |c: char| !c.is_whitespace() && !c.is_control() && c != '"';
    if !name.is_empty() && name.chars().all(is_plain) {
        return name.to_owned();
    }
    serde_json::Value::from(name).to_string()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_wrong_with_a_ray_is_told_with_its_place() {
        let fault = |text: &str| {
            Rows::parse(text.as_bytes(), "r", &RAY).err().map_or_else(String::new, |error| error.to_string())
        };
        assert_eq!(fault("0 0 0 0 0 1\n0 0 0 0 0 1 2\n0 0 0 0 0 1 2 inf\n# no\n"), "");
        assert_eq!(fault("0 0 0 0 1"), "r:1:10: six to eight numbers are a line, and this one has 5");
        assert_eq!(fault("0 0 0 0 0 1 0 1 7"), "r:1:17: six to eight numbers are a line, and this one has 9");
        assert_eq!(fault("0 0 0 0 0 0"), "r:1:7: the direction must not be zero");
        assert_eq!(fault("0 0 0 0 0 1 3 2"), "r:1:15: the stretch ends before it begins");
        assert_eq!(fault("0 0 inf 0 0 1"), "r:1:5: `inf` is not finite");
        assert_eq!(fault("0 0 0 0 0 1 NaN"), "r:1:13: `NaN` is not finite");
    }

    #[test]
    fn names_are_one_word() {
        assert_eq!(["ball", "a b", "", "\"x\""].map(one_word), ["ball", "\"a b\"", "\"\"", "\"\\\"x\\\"\""]);
    }
}
