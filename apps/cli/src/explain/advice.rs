//! What would make a picture faster? A sentence for each thing that stands out, with the names of what it is about.

use std::collections::HashMap;

use catoptra_core::Shape;

use super::Found;
use crate::surfaces::snapshot_of;
use crate::words::{counted, percent};

/// One kind of advice; nothing where it does not apply.
type Advice = fn(&Found<'_>) -> Option<String>;

/// All kinds.
const ADVICE: &[Advice] =
    &[without_kernel, by_point, sampled_lamps, picked_lamps, endless, shadows, reflections, trees];

/// What is said where nothing stands out.
const NOTHING: &str = "nothing stands out";

/// So many names are told of a list.
const NAMED: usize = 3;

/// All that would help.
pub(super) fn of(found: &Found<'_>) -> Vec<String> {
    let all: Vec<String> = ADVICE.iter().filter_map(|advice| advice(found)).collect();
    if all.is_empty() { vec![NOTHING.to_owned()] } else { all }
}

/// Names in a row: `"a", "b" and 3 more`.
fn names(all: &[String]) -> String {
    let told: Vec<String> = all.iter().take(NAMED).map(|name| format!("\"{name}\"")).collect();
    let more = all.len().saturating_sub(NAMED);
    if more > 0 { format!("{} and {more} more", told.join(", ")) } else { told.join(", ") }
}

fn without_kernel(found: &Found<'_>) -> Option<String> {
    let (job, needs) = (found.job, &found.needs);
    let shapes: usize = needs.shapes.iter().map(|(_, count)| count).sum();
    if needs.with_kernel == shapes || job.backend.name() != "wide" {
        return None;
    }
    // Which kinds have none is asked of one shape of each.
    let mut known: HashMap<&str, bool> = HashMap::new();
    let mut has_kernel = |shape: &Shape| {
        *known.entry(shape.kind_name()).or_insert_with(|| {
            snapshot_of(shape.clone(), &job.pool).is_ok_and(|alone| alone.needs().with_kernel > 0)
        })
    };
    let prims = job.snapshot.prims().iter().zip(job.snapshot.entities().iter());
    let slow: Vec<String> = prims
        .filter(|(prim, _)| !has_kernel(&prim.shape))
        .filter_map(|(_, id)| job.scene.name(*id))
        .collect();
    let which =
        if slow.is_empty() { "parts of solids, or very large or small".to_owned() } else { names(&slow) };
    Some(format!(
        "shapes that are met one ray at a time ({which}): as a mesh they would be met by packets of rays"
    ))
}

fn by_point(found: &Found<'_>) -> Option<String> {
    if !found.needs.shades_by_point || found.job.backend.name() != "wide" {
        return None;
    }
    let scene = &found.job.scene;
    let is_worn = |id| !scene.wearers(id).is_empty();
    let rich = scene.materials().filter(|(id, _, material)| is_worn(*id) && material.needs_bsdf());
    let rich: Vec<String> = rich.map(|(_, name, _)| name.to_owned()).collect();
    let which = if rich.is_empty() {
        "textures, finishes or surroundings".to_owned()
    } else {
        format!("materials such as {}", names(&rich))
    };
    Some(format!(
        "{which} make every point be shaded by itself, in f64: where they are not needed, matte, phong, checker and mirror are \
         shaded in packets"
    ))
}

fn sampled_lamps(found: &Found<'_>) -> Option<String> {
    let lamps = &found.stats.lamps;
    let all = lamps.open + lamps.past_a_ball + lamps.partly + lamps.dark + lamps.sampled;
    (10 * lamps.sampled > all).then(|| {
        format!(
            "{} of the points in a lamp's reach ask for it by rays, as meshes or tori stand before it: boxes, balls and flat shapes have a \
             formula",
            percent(lamps.sampled, all)
        )
    })
}

fn picked_lamps(found: &Found<'_>) -> Option<String> {
    found.needs.picks_lamps.then(|| {
        let lamps = counted(found.needs.outlines as u64, "surface");
        format!("{lamps} that shine are too many to ask each: fewer and larger ones have no noise")
    })
}

fn endless(found: &Found<'_>) -> Option<String> {
    let prims = found.job.snapshot.prims().iter().zip(found.job.snapshot.entities().iter());
    let endless: Vec<String> = prims
        .filter(|(prim, _)| prim.bounds().is_none())
        .filter_map(|(_, id)| found.job.scene.name(*id))
        .collect();
    (endless.len() > 8).then(|| {
        format!(
            "{} have no end and are tested for every ray: rectangles would stand in the tree",
            names(&endless)
        )
    })
}

fn shadows(found: &Found<'_>) -> Option<String> {
    let (rays, lights) = (&found.stats.rays, found.needs.shadowing_lights);
    if lights < 4 || 2 * rays.shadow < rays.total() {
        return None;
    }
    let lights = found.job.scene.world_lights().into_iter().filter(|light| light.part.shadow());
    let lights: Vec<String> = lights.filter_map(|light| found.job.scene.name(light.id)).collect();
    Some(format!(
        "{} of all rays look for what throws shadows: lights such as {} can go without (`shadow #false`) where none is seen",
        percent(rays.shadow, rays.total()),
        names(&lights)
    ))
}

fn reflections(found: &Found<'_>) -> Option<String> {
    let rays = &found.stats.rays;
    (2 * rays.reflection > rays.total()).then(|| {
        format!(
            "{} of all rays are reflected or bent ones: --max-depth makes an end of them sooner",
            percent(rays.reflection, rays.total())
        )
    })
}

fn trees(found: &Found<'_>) -> Option<String> {
    let job = found.job;
    (job.load_ms + job.build_ms > 2.0 * found.frame_ms && found.needs.triangles > 10_000).then(|| {
        "reading and the trees take longer than the frame: several pictures of one scene in one command (--camera all, --frames) \
         share them"
            .to_owned()
    })
}
