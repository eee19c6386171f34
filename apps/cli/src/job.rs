//! What is to be traced? A scene file, a camera of it, a backend and threads, ready for frames.

use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::Instant;

use catoptra_core::{Camera, EntityId, Integrator, Role, Scene};
use catoptra_scene::SceneFile;
use catoptra_tracer::{
    Backend, Cancelled, Control, Edges, Film, Filter, Instructions, Pattern, Pool, Reached, Region, Size,
    Snapshot, Stats, Target, View, render, render_until,
};
use miette::{IntoDiagnostic, Report, Result, WrapErr, miette};

use crate::args::{JobArgs, STANDARD};
use crate::console::{say, warn};
use crate::destination::{Input, Output, check_apart};
use crate::memory;
use crate::names::{find_backend, find_edges, find_filter, find_instructions, find_integrator, find_pattern};
use crate::pool::{milliseconds_since, new_pool};
use crate::suggest::unknown;
use crate::words::thousands;
use catoptra_scene::printable;

/// How frames are made, whatever they show: the names that need no scene to be looked up.
#[derive(Clone, Copy)]
pub(crate) struct Means {
    backend: &'static dyn Backend,
    pattern: Pattern,
    filter: Filter,
    edges: Edges,
    instructions: Option<Instructions>,
}

impl Means {
    /// Looks up all names.
    pub(crate) fn of(args: &JobArgs) -> Result<Self> {
        Ok(Self {
            backend: find_backend(&args.backend)?,
            edges: args.edges.as_deref().map(find_edges).transpose()?.unwrap_or_default(),
            pattern: args.pattern.as_deref().map(find_pattern).transpose()?.unwrap_or_default(),
            filter: args.filter.as_deref().map(find_filter).transpose()?.unwrap_or_default(),
            instructions: args.simd.as_deref().map(find_instructions).transpose()?,
        })
    }
}

/// All that frames are made from.
pub(crate) struct Job {
    pub(crate) scene: Scene,
    pub(crate) scene_name: String,
    pub(crate) scene_text: String,
    /// All other files that it was made from.
    pub(crate) files: Vec<PathBuf>,
    pub(crate) camera_name: String,
    pub(crate) snapshot: Arc<Snapshot>,
    /// How long it took to make the snapshot from the scene, trees included.
    pub(crate) build_ms: f64,
    pub(crate) view: View,
    /// How sure its pixels are to be, where that says how many samples they get.
    pub(crate) target: Option<Target>,
    /// Edge of the film's tiles, pixels.
    tile: u32,
    pub(crate) backend: &'static dyn Backend,
    pub(crate) pool: Pool,
}

impl Job {
    /// Reads the scene, from whose meshes these outputs must differ.
    pub(crate) fn new(args: &JobArgs, means: Means, outputs: &[Output<'_>]) -> Result<Self> {
        let crop = args.crop.map(|crop| check_crop(crop, args.size)).transpose()?;
        let pool = new_pool(args.threads)?;
        memory::check_room(crop.map_or(args.size, |crop| crop.size))?;
        let (scene, file) = load(&args.scene)?;
        let camera_id = find_camera(&scene, args.camera.as_deref())?;
        let view = View::of(&scene, placed_camera(&scene, camera_id)?, args.size);
        let named = args.integrator.as_deref().map(find_integrator).transpose()?;
        let view = View {
            integrator: named.unwrap_or(view.integrator),
            max_depth: args.max_depth.unwrap_or(view.max_depth),
            path_depth: args.max_depth.unwrap_or(view.path_depth),
            clear_shadows: !args.opaque_glass,
            samples: args.samples.unwrap_or(view.samples),
            crop,
            pattern: means.pattern,
            filter: means.filter,
            clamp: args.clamp.unwrap_or(f32::INFINITY),
            edges: means.edges,
            seed: args.seed,
            instructions: means.instructions,
            ..view
        };
        check_grid(&view)?;
        let meshes = file.mesh_paths().chain(file.model_paths()).map(|path| ("the mesh", path));
        let profiles = file.profile_paths().map(|path| ("the profile", path));
        let pictures = file.image_paths().map(|path| ("the picture", path));
        let inputs: Vec<Input> = meshes.chain(profiles).chain(pictures).collect();
        check_apart(outputs, &inputs)?;
        let started = Instant::now();
        let snapshot = Arc::new(Snapshot::extract(&scene, &pool));
        let build_ms = milliseconds_since(started);
        warn_of_lamps(&scene, &snapshot);
        let camera_name = scene.name(camera_id).unwrap_or_default();
        let (scene_name, scene_text) = (file_name(&args.scene), file.text());
        let files = inputs.into_iter().map(|(_, path)| path).collect();
        let (tile, backend) = (args.tile, means.backend);
        Ok(Self {
            scene,
            scene_name,
            scene_text,
            files,
            camera_name,
            snapshot,
            build_ms,
            view,
            target: None,
            tile,
            backend,
            pool,
        })
    }

    /// Says which options change nothing.
    pub(crate) fn warn_of_idle(&self, args: &JobArgs) {
        if self.view.samples == 1 && self.target.is_none() {
            let given = [("--pattern", args.pattern.is_some()), ("--filter", args.filter.is_some())];
            for (option, _) in given.iter().filter(|(_, given)| *given) {
                warn(&format!(
                    "{option} changes nothing: the one sample of a pixel lies in its middle (--samples asks for more)"
                ));
            }
            if self.view.camera.lens_radius() > 0.0 {
                warn(
                    "the camera's lens-radius changes nothing: one sample sees through its middle (--samples asks for more)",
                );
            }
        }
        if args.edges.is_some() && self.view.integrator != Integrator::Whitted {
            let integrator = self.view.integrator.name();
            warn(&format!("--edges changes nothing: integrator {integrator} samples them"));
        } else if args.edges.is_some() && self.view.camera.is_orthographic() {
            warn("--edges changes nothing: through an orthographic camera edges are sampled");
        }
        if args.simd.is_some() && args.backend != "wide" {
            warn(&format!("--simd changes nothing: backend {} uses no vector instructions", args.backend));
        }
    }

    /// A film for its frames.
    pub(crate) fn film(&self) -> Result<Film> {
        memory::film(self.view.region(), self.tile, self.target.is_some())
    }

    /// Traces one frame; how long it took from snapshot to film, and what it came to.
    pub(crate) fn frame(&self, film: &mut Film, control: &Control) -> Result<(f64, Frame), Cancelled> {
        let started = Instant::now();
        let (snapshot, view, pool) = (&self.snapshot, &self.view, &self.pool);
        let frame = match &self.target {
            None => {
                let stats = render(self.backend, snapshot, view, film, pool, control)?;
                Frame { stats, reached: None }
            }
            Some(target) => {
                let reached = render_until(self.backend, snapshot, (view, target), film, pool, control)?;
                Frame { stats: reached.stats, reached: Some(reached) }
            }
        };
        Ok((milliseconds_since(started), frame))
    }
}

/// What a frame came to.
pub(crate) struct Frame {
    pub(crate) stats: Stats,
    /// With a target, how near to it.
    pub(crate) reached: Option<Reached>,
}

/// Reads a scene, and says what was added to it or passed over; the meshes of one from standard input lie in the current folder.
pub(crate) fn load(path: &Path) -> Result<(Scene, SceneFile)> {
    let (scene, file) = read(path)?;
    if let Some(added) = file.added() {
        say(&printable(added));
    }
    file.warnings().iter().for_each(|warning| warn(&printable(warning)));
    Ok((scene, file))
}

/// The same without a word about it.
pub(crate) fn read(path: &Path) -> Result<(Scene, SceneFile)> {
    Ok(if path == Path::new(STANDARD) {
        catoptra_scene::load_from(std::io::stdin().lock(), Path::new("<stdin>"), Path::new(""))?
    } else {
        catoptra_scene::load(path)?
    })
}

/// The file that a scene is read from.
pub(crate) fn scene_input(scene: &Path) -> Input {
    let scene = if scene == Path::new(STANDARD) { Path::new("/dev/stdin") } else { scene };
    ("the scene", scene.to_owned())
}

/// Refuses a grid of samples that is no square.
fn check_grid(view: &View) -> Result<()> {
    let side = view.samples.isqrt();
    if view.pattern != Pattern::Grid || side * side == view.samples {
        return Ok(());
    }
    Err(miette!(
        help = "the patterns owen and sobol take any number",
        "--pattern grid takes a square number of samples, not {}: {} or {} is near",
        view.samples,
        side * side,
        (side + 1) * (side + 1)
    ))
}

/// Says which surfaces do not light as one may expect.
fn warn_of_lamps(scene: &Scene, snapshot: &Snapshot) {
    for lamp in snapshot.endless_lamps() {
        let name = scene.name(lamp).unwrap_or_default();
        warn(&format!("\"{name}\" shines but lights nothing: it has no end"));
    }
    for lamp in snapshot.lamps_met_alone() {
        let name = scene.name(lamp).unwrap_or_default();
        warn(&format!("\"{name}\" shines, but only paths (--integrator path) find its light"));
    }
    if let Some(lamps) = snapshot.picked_lamps() {
        let lamps = thousands(lamps as u64);
        warn(&format!(
            "{lamps} surfaces shine, too many to ask each: points ask some, picked at random (--samples makes less noise)"
        ));
    }
}

pub(crate) fn file_name(path: &Path) -> String {
    path.file_name().unwrap_or(path.as_os_str()).to_string_lossy().into_owned()
}

/// A crop that lies within the picture.
fn check_crop(crop: Region, picture: Size) -> Result<Region> {
    if crop.within(picture) == crop {
        return Ok(crop);
    }
    let Size { width, height } = picture;
    Err(miette!(
        help = format!("the picture has {width} columns and {height} rows; --size changes that"),
        "the part {}x{} at {},{} reaches beyond the picture",
        crop.size.width,
        crop.size.height,
        crop.x,
        crop.y
    ))
}

fn find_camera(scene: &Scene, name: Option<&str>) -> Result<EntityId> {
    let Some(name) = name else {
        return scene.main_camera().ok_or_else(|| {
            miette!(
                help = "add one, such as:  camera \"eye\" { eye 0 1 5; target 0 1 0 }",
                "the scene has no camera to look through"
            )
        });
    };
    let cameras: Vec<String> = scene.entities_of(Role::Camera).filter_map(|id| scene.name(id)).collect();
    let known: Vec<&str> = cameras.iter().map(String::as_str).collect();
    let found = scene.entity_named(name).filter(|id| scene.role(*id) == Some(Role::Camera));
    found.ok_or_else(|| unknown("camera", name, &known))
}

/// The camera where its groups put it.
fn placed_camera(scene: &Scene, id: EntityId) -> Result<Camera> {
    let missing = || -> Report { miette!("the scene has no camera to look through") };
    let camera = scene.camera(id).ok_or_else(missing)?;
    let placement = scene.world_placement(id).ok_or_else(missing)?;
    camera.placed(&placement).into_diagnostic().wrap_err("the camera cannot stand where its groups put it")
}
