//! `catoptra pick`: what does a pixel of a picture show?

use std::path::PathBuf;

use catoptra_core::glam::DVec3;
use catoptra_tracer::{Caster, Size, Snapshot, WorldHit, WorldRay};
use clap::Args;
use miette::{IntoDiagnostic, Result, miette};
use serde_json::{Value, json};

use crate::Outcome;
use crate::args::size;
use crate::console::{check_heard, print_answer};
use crate::job::{find_camera, placed_camera};
use crate::loaded::Loaded;
use crate::numbers::in_full;
use crate::pool::new_pool;
use crate::surfaces::side;

#[derive(Args)]
pub(crate) struct PickArgs {
    /// Scene file (.kdl) or model file, or - for standard input
    scene: PathBuf,
    /// Column of the pixel, from 0 at the left
    x: u32,
    /// Row of the pixel, from 0 at the top
    y: u32,
    /// Size of the picture in pixels
    #[arg(long, value_name = "WxH", default_value = "640x480", value_parser = size)]
    size: Size,
    /// Camera to look through [default: the scene's first]
    #[arg(long, value_name = "NAME")]
    camera: Option<String>,
    /// Answer with a JSON object
    #[arg(long)]
    json: bool,
}

/// Looks through the middle of a pixel, and says what is there.
pub(crate) fn run(args: &PickArgs) -> Result<Outcome> {
    let Size { width, height } = args.size;
    if args.x >= width || args.y >= height {
        return Err(miette!(
            help =
                format!("columns are 0 to {} and rows 0 to {}; --size changes that", width - 1, height - 1),
            "the pixel {} {} lies outside the picture",
            args.x,
            args.y
        ));
    }
    check_heard()?;
    let Loaded { scene, .. } = Loaded::read(&args.scene)?;
    let camera = placed_camera(&scene, find_camera(&scene, args.camera.as_deref())?)?;
    let caster = Caster::of_snapshot(Snapshot::extract(&scene, &new_pool(None)?), &scene);
    let [x, y] = [args.x, args.y].map(|at| f64::from(at) + 0.5);
    let ray = camera.ray(x, y, width, height);
    let met = caster.nearest(&WorldRay::new(ray.origin, ray.direction).into_diagnostic()?);
    let found = met.map(|met| Found {
        name: scene.name(met.entity).unwrap_or_default(),
        kind: kind_of(&scene, &met),
        material: scene
            .material_of(met.entity)
            .map(|id| (scene.material_name(id).to_owned(), scene.material(id).kind_name())),
        normal: met.normal * side(&met, ray.direction),
        depth: met.t * ray.direction.length(),
        met,
    });
    print_answer(&if args.json { as_json(found.as_ref()) } else { as_text(found.as_ref()) })?;
    Ok(Outcome::Done)
}

/// What is known of what a pixel shows.
struct Found {
    name: String,
    kind: &'static str,
    /// Its name and its kind; lights have none.
    material: Option<(String, &'static str)>,
    /// On the side that is seen.
    normal: DVec3,
    /// Metres from where the ray starts.
    depth: f64,
    met: WorldHit,
}

fn kind_of(scene: &catoptra_core::Scene, met: &WorldHit) -> &'static str {
    let shape = scene.shape(met.entity).map(|shape| shape.kind_name());
    shape.or_else(|| scene.light(met.entity).map(|light| light.kind_name())).unwrap_or_default()
}

fn as_text(found: Option<&Found>) -> String {
    let Some(found) = found else { return "nothing\n".to_owned() };
    let numbers = |numbers: &[f64]| numbers.iter().map(|v| in_full(*v)).collect::<Vec<_>>().join(" ");
    let material = found
        .material
        .as_ref()
        .map_or_else(|| "none: it is a light".to_owned(), |(name, kind)| format!("\"{name}\" ({kind})"));
    format!(
        "entity   \"{}\" ({})\nmaterial {material}\npoint    {}\nnormal   {}\ndepth    {}\nfacet    {}\nuv       {}\n",
        found.name,
        found.kind,
        numbers(&found.met.point.to_array()),
        numbers(&found.normal.to_array()),
        in_full(found.depth),
        found.met.triangle,
        numbers(&found.met.uv.to_array()),
    )
}

fn as_json(found: Option<&Found>) -> String {
    let value = found.map_or(Value::Null, |found| {
        json!({
            "entity": found.name,
            "kind": found.kind,
            "material": found.material.as_ref().map(|(name, _)| name),
            "material_kind": found.material.as_ref().map(|(_, kind)| kind),
            "point": found.met.point.to_array(),
            "normal": found.normal.to_array(),
            "depth": found.depth,
            "facet": found.met.triangle,
            "uv": found.met.uv.to_array(),
        })
    });
    format!("{value}\n")
}
