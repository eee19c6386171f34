//! `catoptra lab trace`: how many rays of a file are traced against a mesh or a scene in a second?

use std::path::{Path, PathBuf};
use std::time::Instant;

use catoptra_core::geometry::Mesh;
use catoptra_core::material::Matte;
use catoptra_core::{Camera, MeshSource, Rgb, Scene, TriangleMesh};
use catoptra_scene::model;
use catoptra_tracer::query::{HitList, RayList, find_nearest, find_occluded};
use catoptra_tracer::{Backend, Pool, Preset, Size, Snapshot, View};
use clap::Args;
use miette::{IntoDiagnostic, Result};

use super::ray_file;
use crate::Outcome;
use crate::console::{check_heard, print_answer};
use crate::loaded::Loaded;
use crate::names::find_backend;
use crate::pool::{milliseconds_since, new_pool};
use crate::suggest::unknown;

#[derive(Args)]
pub(crate) struct TraceArgs {
    /// Mesh file (.ply or .obj), or a scene file (.kdl)
    mesh: PathBuf,
    /// Ray file: u32 count, then origin, tmin, direction and tmax of each ray, all little-endian, f32
    rays: PathBuf,
    /// Ask whether anything is met, rather than what is met first
    #[arg(long)]
    any: bool,
    /// Threads to trace with [default: one per core]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    threads: Option<u16>,
    /// Times that all rays are traced after a warm-up; the tree is built as often, at most five times
    #[arg(long, value_name = "N", default_value_t = 9, value_parser = clap::value_parser!(u32).range(1..=1_000_000))]
    repeat: u32,
    /// Backend to trace with: wide (fast), scalar or oracle (exhaustive)
    #[arg(long, value_name = "NAME", default_value = "wide")]
    backend: String,
    /// How carefully to build the tree: fast, balanced or best
    #[arg(long, value_name = "NAME", default_value = "balanced")]
    preset: String,
}

/// Traces and prints one line of figures.
pub(crate) fn run(args: &TraceArgs) -> Result<Outcome> {
    let backend = find_backend(&args.backend)?;
    let preset = find_preset(&args.preset)?;
    check_heard()?;
    let rays = ray_file::read(&args.rays)?;
    let pool = new_pool(args.threads)?;
    let scene = scene_of(&args.mesh)?;
    let (mut snapshot, mut build_ms) = build(&scene, preset, &pool);
    for _ in 1..args.repeat.min(BUILDS) {
        let (again, ms) = build(&scene, preset, &pool);
        (snapshot, build_ms) = (again, build_ms.min(ms));
    }
    let mut traced = Traced::default();
    let mut times: Vec<f64> =
        (0..=args.repeat).map(|_| traced.once(args.any, backend, &snapshot, &rays, &pool)).skip(1).collect();
    times.sort_by(f64::total_cmp);
    let rate = |ms: f64| rays.len() as f64 / ms * 1e-3;
    let (hits, sum) = traced.sums(args.any);
    let triangles: usize = snapshot.meshes().iter().map(|m| m.mesh().triangles().len()).sum();
    let bytes: usize = snapshot.meshes().iter().map(|m| m.bytes() + mesh_bytes(m.mesh())).sum();
    print_answer(&format!(
        "{} {} {} {} {} threads {}: best {:.2} Mrays/s median {:.2} Mrays/s rays {} hits {hits} sum_t {sum:.9e} \
         {} build {build_ms:.2} ms {:.1} bytes/triangle\n",
        args.mesh.display(),
        args.rays.display(),
        if args.any { "any" } else { "nearest" },
        backend.name(),
        backend.level(&View::new(Camera::default(), Size::new(1, 1))),
        pool.threads(),
        rate(times[0]),
        rate(times[times.len() / 2]),
        rays.len(),
        preset.name(),
        bytes as f64 / triangles.max(1) as f64,
    ))?;
    Ok(Outcome::Done)
}

/// Most times that a tree is built; the least time is told.
const BUILDS: u32 = 5;

/// Builds what is traced; milliseconds that it took.
fn build(scene: &Scene, preset: Preset, pool: &Pool) -> (Snapshot, f64) {
    let started = Instant::now();
    let snapshot = Snapshot::extract_with(scene, preset, pool);
    (snapshot, milliseconds_since(started))
}

fn find_preset(name: &str) -> Result<Preset> {
    let names: Vec<&str> = Preset::ALL.iter().map(|preset| preset.name()).collect();
    Preset::named(name).ok_or_else(|| unknown("preset", name, &names))
}

/// What the rays of a file have met.
#[derive(Default)]
struct Traced {
    hits: HitList,
    occluded: Vec<bool>,
}

impl Traced {
    /// Traces all rays once; milliseconds that it took.
    fn once(
        &mut self,
        any: bool,
        backend: &dyn Backend,
        snapshot: &Snapshot,
        rays: &RayList,
        pool: &Pool,
    ) -> f64 {
        let started = Instant::now();
        if any {
            find_occluded(backend, snapshot, rays, &mut self.occluded, pool);
        } else {
            find_nearest(backend, snapshot, rays, &mut self.hits, pool);
        }
        milliseconds_since(started)
    }

    /// How many rays have met something, and the sum of their `t`.
    fn sums(&self, any: bool) -> (usize, f64) {
        if any {
            return (self.occluded.iter().filter(|&&hit| hit).count(), 0.0);
        }
        let hits = (0..self.hits.len()).filter_map(|at| self.hits.get(at));
        hits.fold((0, 0.0), |(count, sum), (_, t)| (count + 1, sum + t))
    }
}

/// Bytes of a mesh's corners and triangles.
fn mesh_bytes(mesh: &TriangleMesh) -> usize {
    size_of_val(mesh.positions()) + size_of_val(mesh.triangles())
}

/// A scene, or one of one mesh.
fn scene_of(path: &Path) -> Result<Scene> {
    if path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("kdl")) {
        return Ok(Loaded::read(path)?.scene);
    }
    let mesh = model::read_mesh(path)?;
    let mut scene = Scene::new();
    let clay = scene.add_material("clay", Matte::new(Rgb::grey(0.5)).into_diagnostic()?).into_diagnostic()?;
    let source = MeshSource { path: path.display().to_string(), mesh: mesh.into() };
    scene.add_shape("mesh", Mesh::new(source), clay, None).into_diagnostic()?;
    Ok(scene)
}
