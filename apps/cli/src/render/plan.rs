//! Which pictures are asked for? Every scene, through one camera or all, in one frame or many; told and checked before the first
//! is traced.

use std::path::Path;

use catoptra_core::EntityId;
use miette::{Result, miette};

use super::Looks;
use super::names::{Files, Subject, check_single, usual};
use super::turntable::Turntable;
use crate::args::{RenderArgs, STANDARD, STDOUT};
use crate::console::check_heard;
use crate::destination::{Output, check_apart, check_writable};
use crate::job::find_cameras;
use crate::loaded::{Loaded, file_name, scene_input};

/// One picture to be made.
pub(super) struct Shot {
    pub(super) camera: EntityId,
    /// The number of its frame, from 1 up.
    pub(super) frame: Option<u32>,
    pub(super) files: Files,
    /// What it shows, in words.
    pub(super) words: String,
}

/// All pictures of one scene.
pub(super) struct Plan {
    pub(super) loaded: Loaded,
    pub(super) shots: Vec<Shot>,
}

/// Whether a picture is written whose name no option gives.
pub(super) fn writes_usual(args: &RenderArgs) -> bool {
    args.repeat.is_none() && Files::given(args).outputs().is_empty()
}

/// Refuses what cannot end well before a scene is read.
pub(super) fn check(args: &RenderArgs) -> Result<()> {
    let given = Files::given(args).known();
    let outputs = given.outputs();
    let to_stdout = |option: &str| outputs.contains(&(option, Path::new(STDOUT)));
    if to_stdout("--output") && (to_stdout("--stats") || args.repeat.is_some()) {
        let other = if args.repeat.is_some() { "--repeat" } else { "--stats" };
        return Err(miette!(
            help = "give one of them a file",
            "--output and {other} cannot both go to standard output"
        ));
    }
    let prints = args.repeat.is_some() && Files::given(args).outputs().is_empty();
    if prints || outputs.iter().any(|(_, path)| *path == Path::new(STDOUT)) {
        check_heard()?;
    }
    let standard = args.scenes.iter().filter(|scene| *scene == Path::new(STANDARD)).count();
    if standard > 1 {
        return Err(miette!("only one scene can come from standard input"));
    }
    if standard > 0 && writes_usual(args) {
        return Err(miette!(
            help = "give --output FILE for a picture, or -o - for standard output",
            "a scene from standard input has no name that a picture could have"
        ));
    }
    let scenes: Vec<_> = args.scenes.iter().map(|scene| scene_input(scene)).collect();
    check_apart(&outputs, &scenes)?;
    check_writable(&outputs)
}

/// Reads all scenes, and says which pictures of them go where.
pub(super) fn plan(args: &RenderArgs, looks: &Looks, table: Option<&Turntable>) -> Result<Vec<Plan>> {
    let plan = |scene| plan_of(args, looks, table, scene);
    let plans: Vec<Plan> = args.scenes.iter().map(|scene| plan(scene)).collect::<Result<_>>()?;
    let shots = || plans.iter().flat_map(|plan| &plan.shots);
    check_single(&shots().map(|shot| shot.files.clone()).collect::<Vec<_>>())?;
    let inputs: Vec<_> = plans.iter().flat_map(|plan| plan.loaded.inputs.iter().cloned()).collect();
    let outputs: Vec<Output<'_>> = shots().flat_map(|shot| shot.files.outputs()).collect();
    check_apart(&outputs, &inputs)?;
    if writes_usual(args) && !args.picture.force {
        let there =
            outputs.iter().find(|(option, path)| *option == "--output" && path.symlink_metadata().is_ok());
        if let Some((_, path)) = there {
            return Err(miette!(
                help = "--force writes over it, --output FILE gives another name",
                "{} is there already",
                path.display()
            ));
        }
    }
    check_writable(&outputs)?;
    Ok(plans)
}

fn plan_of(args: &RenderArgs, looks: &Looks, table: Option<&Turntable>, path: &Path) -> Result<Plan> {
    let loaded = Loaded::read(path)?;
    let cameras = find_cameras(&loaded.scene, args.job.camera.as_deref())?;
    let mut given = Files::given(args);
    if writes_usual(args) {
        given.picture = Some(usual(cameras.len(), table.is_some(), looks.usual().ending()));
    }
    let stem = Path::new(&loaded.name)
        .file_stem()
        .map_or_else(|| file_name(path), |stem| stem.to_string_lossy().into_owned());
    let mut shots = Vec::new();
    for camera in cameras {
        let name = loaded.scene.name(camera).unwrap_or_default();
        let count = table.map_or(1, |table| table.frames);
        for frame in 1..=count {
            let subject = Subject { scene: &stem, camera: &name, frame: table.map(|_| [frame, count]) };
            let files = given.of(&subject);
            shots.push(Shot { camera, frame: table.map(|_| frame), files, words: subject.words() });
        }
    }
    Ok(Plan { loaded, shots })
}
