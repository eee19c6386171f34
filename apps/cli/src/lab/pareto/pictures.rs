//! How many samples a pixel, in which pattern, for which error of a picture?

use catoptra_core::Scene;
use catoptra_lab::{Pair, metric_named};
use catoptra_tracer::{Edges, Pattern, Size, Snapshot, View};
use miette::{IntoDiagnostic, Result, miette};

use super::{EXACT, Lab, Question, Way, parsed};
use crate::words::counted;

const SIZE: Size = Size::new(160, 120);

/// Samples along each axis of a pixel that are tried.
const GRIDS: [u32; 8] = [1, 2, 3, 4, 6, 8, 12, 16];

/// Samples along each axis of the reference: 5,184 of them, no multiple of what is tried but 1 to 4, 6, 8 and 12, whose
/// points are not among its own.
const REFERENCE: u32 = 72;

const EDGES: &str = r#"
camera "eye" { eye 0 0 5; target 0 0 0; fov 45 }
matte "white" { color 1 1 1 }
rectangle "tilted" material="white" { corner -1.6 -0.4 0; edge-u 2.9 0.31 0; edge-v -0.155 1.45 0 }
triangle "thin" material="white" { a -2 -1.5 0.1; b 2.2 -1.31 0.1; c 2.2 -1.27 0.1 }
disk "disk" material="white" { center 1.7 1.1 0.2; normal 0.2 0.1 1; radius 0.5 }
ambient-light "sky" { radiance 1 1 1 }
"#;

const CHECKER: &str = r#"
camera "eye" { eye 0.3 1.5 0.2; target 0.1 1 -6 }
checker "tiles" { scale 1 }
plane "floor" material="tiles"
ambient-light "sky" { radiance 1 1 1 }
"#;

const REFLECTIONS: &str = r#"
camera "eye" { eye 0 1.8 6; target 0 0.9 0 }
mirror "chrome" { color 0.9 0.9 0.9 }
checker "tiles" { scale 1; reflectiveness 0.2 }
sphere "left" material="chrome" { center -1.1 1 0; radius 1 }
sphere "right" material="chrome" { center 1.1 1 -0.4; radius 1 }
plane "floor" material="tiles"
plane "wall" material="tiles" { point 0 0 -5; normal 0 0.2 1 }
ambient-light "sky" { radiance 0.2 0.2 0.2 }
point-light "lamp" { position 3 6 5; intensity 90 90 90 }
"#;

pub(super) fn ask(lab: &Lab) -> Result<Vec<Question>> {
    let about = |name, title, text: &str, what: &str| -> Result<Question> {
        let words = format!(
            "{what} One picture of {}x{} pixels by `wide`, against a reference of {} samples a pixel. \
             `--samples`, `--pattern` and `--edges exact` choose.",
            SIZE.width,
            SIZE.height,
            REFERENCE * REFERENCE
        );
        let ways = ways(lab, &parsed(text)?)?;
        Ok(Question { name, title, words, time: "ms a frame", errors: &["RMSE", "FLIP"], ways })
    };
    Ok(vec![
        about("edges", "Edges", EDGES, "White shapes on black, some edges nearly along the pixels.")?,
        about(
            "checker",
            "Checker to the horizon",
            CHECKER,
            "Squares of a metre, seen from 1.5 m above them.",
        )?,
        about(
            "reflections",
            "Reflections",
            REFLECTIONS,
            "Two chrome balls between checkered walls, with shadows.",
        )?,
    ])
}

fn ways(lab: &Lab, scene: &Scene) -> Result<Vec<Way>> {
    let camera = scene.main_camera().and_then(|id| scene.world_camera(id));
    let camera = camera.ok_or_else(|| miette!("a scene of the lab has no camera"))?;
    let snapshot = Snapshot::extract(scene, &lab.pool);
    let view = |pattern, grid: u32| {
        let samples = grid * grid;
        View { pattern, samples, ..View::of(scene, camera.clone(), SIZE) }
    };
    let (reference, _) = lab.picture(&snapshot, &view(Pattern::Grid, REFERENCE))?;
    let mut ways = Vec::new();
    let mut add = |series: &str, grid: u32, view: &View| -> Result<()> {
        let (picture, time) = lab.picture(&snapshot, view)?;
        let pair = Pair::new(&reference, &picture).into_diagnostic()?;
        let measures = ["rmse", "flip"].into_iter().filter_map(metric_named);
        let errors = measures.map(|metric| (metric.measure)(pair, &Default::default())).collect();
        let setting = counted(u64::from(grid * grid), "sample");
        ways.push(Way { series: series.to_owned(), setting, time, errors });
        Ok(())
    };
    for &pattern in Pattern::ALL {
        for grid in GRIDS {
            add(pattern.name(), grid, &view(pattern, grid))?;
        }
    }
    add(EXACT, 1, &View { edges: Edges::Exact, ..view(Pattern::Grid, 1) })?;
    Ok(ways)
}
