//! What does a soft shadow cost: in closed form, by rays with what is known as control variate, by rays alone?

use catoptra_lab::Picture;
use catoptra_lab::{Pair, metric_named};
use catoptra_tracer::{Control, render};
use catoptra_tracer::{Film, LampLight, Size, Snapshot, View};
use miette::{IntoDiagnostic, Result, miette};

use super::{Lab, Question, Way, parsed};
use crate::names::find_backend;
use crate::words::counted;

const SIZE: Size = Size::new(160, 160);

/// Rays a pixel that are tried.
const RAYS: [u32; 5] = [4, 16, 64, 256, 1024];

const SCENE: &str = r#"
camera "eye" { eye 0 8 20; target 0 3 0; fov 45 }
matte "grey" { color 0.7 }
plane "ground" material="grey"
sphere "ball" material="grey" { center 0 3 0; radius 3 }
rectangle-light "lamp" { corner -5 12 -5; edge-u 10 0 0; edge-v 0 0 10; radiance 4 }
"#;

pub(super) fn ask(lab: &Lab) -> Result<Vec<Question>> {
    let scene = parsed(SCENE)?;
    let camera = scene.main_camera().and_then(|id| scene.world_camera(id));
    let camera = camera.ok_or_else(|| miette!("a scene of the lab has no camera"))?;
    let snapshot = Snapshot::extract(&scene, &lab.pool);
    let view = View::of(&scene, camera, SIZE);
    let mut film = Film::new(SIZE);
    render(find_backend("oracle")?, &snapshot, &view, &mut film, &lab.pool, &Control::default())
        .into_diagnostic()?;
    let truth = Picture::painted(SIZE.width, SIZE.height, |x, y| film.radiance(x, y)).into_diagnostic()?;
    let mut ways = Vec::new();
    let mut add = |series: &str, setting: String, view: &View| -> Result<()> {
        let (picture, time) = lab.picture(&snapshot, view)?;
        let pair = Pair::new(&truth, &picture).into_diagnostic()?;
        let measures = ["rmse", "flip"].into_iter().filter_map(metric_named);
        let errors = measures.map(|metric| (metric.measure)(pair, &Default::default())).collect();
        ways.push(Way { series: series.to_owned(), setting, time, errors });
        Ok(())
    };
    add("closed form", "no rays".to_owned(), &view)?;
    for (series, lamp_light) in
        [("rays and what is known", LampLight::Rays), ("rays alone", LampLight::PlainRays)]
    {
        for lamp_rays in RAYS {
            let view = View { lamp_light, lamp_rays, ..view.clone() };
            add(series, counted(u64::from(lamp_rays), "ray"), &view)?;
        }
    }
    let words = format!(
        "A ball on the ground under a lamp of ten by ten metres, {}x{} pixels seen through their centres, so that shading alone \
         errs; against the closed form in `f64` by `oracle`. Rays go to points spread evenly over the lamp; what is known is \
         the light of the whole lamp where nothing blocks it.",
        SIZE.width, SIZE.height
    );
    let (name, title) = ("soft-shadow", "Soft shadow");
    Ok(vec![Question { name, title, words, time: "ms a frame", errors: &["RMSE", "FLIP"], ways }])
}
