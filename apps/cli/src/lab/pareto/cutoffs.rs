//! How many reflections, and down to which weight, for which error of a picture?

use catoptra_lab::{Pair, metric_named};
use catoptra_tracer::{Size, Snapshot, View};
use miette::{IntoDiagnostic, Result, miette};

use super::{Lab, Question, Way, parsed};
use crate::words::counted;

const SIZE: Size = Size::new(320, 240);

/// Reflections followed for the reference.
const DEEP: u32 = 200;

/// Mirrors that see each other: reflections of reflections, losing a third of the light each time.
const MIRRORS: &str = r#"
camera "eye" { eye 0.4 1.3 2.6; target 0 1 0 }
phong "gold" { diffuse 0.5 0.4 0.1; specular 0.6; reflectiveness 0.66 }
checker "tiles" { scale 1; reflectiveness 0.3 }
matte "glass" { color 0.3 0.4 0.5; reflectiveness 0.75 }
sphere "left" material="gold" { center -0.8 0.8 0; radius 0.75 }
sphere "right" material="gold" { center 0.8 0.8 -0.3; radius 0.75 }
plane "floor" material="tiles"
plane "ahead" material="glass" { point 0 0 -3; normal 0 0.05 1 }
plane "behind" material="glass" { point 0 0 3; normal 0.04 0 -1 }
ambient-light "sky" { radiance 0.3 0.3 0.3 }
point-light "lamp" { position 1 5 2; intensity 60 60 60 }
"#;

pub(super) fn ask(lab: &Lab) -> Result<Vec<Question>> {
    let scene = parsed(MIRRORS)?;
    let camera = scene.main_camera().and_then(|id| scene.world_camera(id));
    let camera = camera.ok_or_else(|| miette!("a scene of the lab has no camera"))?;
    let snapshot = Snapshot::extract(&scene, &lab.pool);
    let view = |max_depth, weight_cutoff| View {
        max_depth,
        weight_cutoff,
        ..View::of(&scene, camera.clone(), SIZE)
    };
    let (reference, _) = lab.picture(&snapshot, &view(DEEP, 0.0))?;
    let way = |series: &str, setting: String, view: &View| -> Result<Way> {
        let (picture, time) = lab.picture(&snapshot, view)?;
        let pair = Pair::new(&reference, &picture).into_diagnostic()?;
        let measures = ["rmse", "max-difference", "flip"].into_iter().filter_map(metric_named);
        let errors = measures.map(|metric| (metric.measure)(pair, &Default::default())).collect();
        Ok(Way { series: series.to_owned(), setting, time, errors })
    };
    let mut ways = Vec::new();
    for depth in [0, 1, 2, 3, 4, 5, 7, 10, 15, 25, 50] {
        ways.push(way("depth alone", counted(u64::from(depth), "reflection"), &view(depth, 0.0))?);
    }
    let default = View::of(&scene, camera.clone(), SIZE).weight_cutoff;
    for cutoff in [0.3, 0.1, 0.03, 0.01, 0.003, default, 1e-4, 1e-5] {
        ways.push(way("weight alone", format!("cut-off {cutoff:.5}"), &view(DEEP, cutoff))?);
    }
    let words = format!(
        "A hall of mirrors that keep 30 to 75 % of the light at each reflection, {}x{} pixels, one sample each, against {DEEP} \
         reflections without a cut-off. A weight cut-off of c darkens a pixel by at most c times the brightest radiance cut off; a depth \
         limit has no such bound, so let the weight decide and keep the depth (`--max-depth`) for safety.",
        SIZE.width, SIZE.height
    );
    let errors = &["RMSE", "largest difference", "FLIP"];
    Ok(vec![Question {
        name: "cutoffs",
        title: "Where reflections end",
        words,
        time: "ms a frame",
        errors,
        ways,
    }])
}
