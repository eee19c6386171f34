//! What is to be traced? A scene file, a camera of it, a backend and threads, ready for frames.

use std::path::PathBuf;
use std::sync::Arc;
use std::time::Instant;

use catoptra_core::{Camera, EntityId, Integrator, Role, Scene};
use catoptra_tracer::{
    Backend, Cancelled, Control, Edges, Film, Filter, Instructions, Pattern, Pool, Reached, Region, Size,
    Snapshot, Stats, Target, Tone, View, render, render_until,
};
use miette::{IntoDiagnostic, Report, Result, WrapErr, miette};

use crate::args::JobArgs;
use crate::console::{detail, warn};
use crate::loaded::Loaded;
use crate::memory;
use crate::names::{find_backend, find_edges, find_filter, find_instructions, find_integrator, find_pattern};
use crate::pool::{milliseconds_since, new_pool};
use crate::suggest::unknown;
use crate::words::thousands;

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

/// What must be there before a scene is read: threads, and room for the picture.
#[derive(Clone)]
pub(crate) struct Resources {
    pub(crate) pool: Arc<Pool>,
    crop: Option<Region>,
}

impl Resources {
    /// Takes them; `beside` are bytes that are needed beside a film.
    pub(crate) fn claim(args: &JobArgs, beside: impl Fn(Size) -> u64) -> Result<Self> {
        let crop = args.crop.map(|crop| check_crop(crop, args.size)).transpose()?;
        let pool = Arc::new(new_pool(args.threads)?);
        let size = crop.map_or(args.size, |crop| crop.size);
        memory::check_room(size, beside(size))?;
        Ok(Self { pool, crop })
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
    /// How far the camera is turned from where it stands in the scene, in words.
    pub(crate) turned: Option<String>,
    pub(crate) snapshot: Arc<Snapshot>,
    /// How long it took to read the scene.
    pub(crate) load_ms: f64,
    /// How long it took to make the snapshot from the scene, trees included.
    pub(crate) build_ms: f64,
    pub(crate) view: View,
    /// How light becomes the bytes of a display.
    pub(crate) tone: Tone,
    /// How sure its pixels are to be, where that says how many samples they get.
    pub(crate) target: Option<Target>,
    /// Edge of the film's tiles, pixels.
    tile: u32,
    pub(crate) backend: &'static dyn Backend,
    pub(crate) pool: Arc<Pool>,
}

impl Job {
    /// Looks at a scene through one of its cameras.
    pub(crate) fn new(
        args: &JobArgs,
        means: Means,
        resources: &Resources,
        loaded: Loaded,
        camera: EntityId,
    ) -> Result<Self> {
        let Loaded { scene, name: scene_name, text: scene_text, inputs, milliseconds: load_ms } = loaded;
        let view = View::of(&scene, placed_camera(&scene, camera)?, args.size);
        let named = args.integrator.as_deref().map(find_integrator).transpose()?;
        let view = View {
            integrator: named.unwrap_or(view.integrator),
            max_depth: args.max_depth.unwrap_or(view.max_depth),
            path_depth: args.max_depth.unwrap_or(view.path_depth),
            clear_shadows: !args.opaque_glass,
            samples: args.samples.unwrap_or(view.samples),
            crop: resources.crop,
            pattern: means.pattern,
            filter: means.filter,
            clamp: args.clamp.unwrap_or(f32::INFINITY),
            edges: means.edges,
            seed: args.seed,
            instructions: means.instructions,
            ..view
        };
        check_grid(&view)?;
        let pool = Arc::clone(&resources.pool);
        let started = Instant::now();
        let snapshot = Arc::new(Snapshot::extract(&scene, &pool));
        let build_ms = milliseconds_since(started);
        detail(&format!("made the snapshot of {scene_name} in {build_ms:.1} ms"));
        warn_of_lamps(&scene, &snapshot);
        let camera_name = scene.name(camera).unwrap_or_default();
        let files = inputs.into_iter().skip(1).map(|(_, path)| path).collect();
        let (tile, backend) = (args.tile, means.backend);
        Ok(Self {
            scene,
            scene_name,
            scene_text,
            files,
            camera_name,
            turned: None,
            snapshot,
            load_ms,
            build_ms,
            view,
            tone: Tone::default(),
            target: None,
            tile,
            backend,
            pool,
        })
    }

    /// Looks through another of the scene's cameras from now on.
    pub(crate) fn look_through(&mut self, camera: EntityId) -> Result<()> {
        self.view.camera = placed_camera(&self.scene, camera)?;
        self.camera_name = self.scene.name(camera).unwrap_or_default();
        self.turned = None;
        Ok(())
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

/// The word for all cameras of a scene.
const ALL: &str = "all";

/// The cameras of that name, in the order of the scene: one, or for `all` every one; without a name, the first.
pub(crate) fn find_cameras(scene: &Scene, name: Option<&str>) -> Result<Vec<EntityId>> {
    let first = scene.main_camera().ok_or_else(|| {
        miette!(
            help = "add one, such as:  camera \"eye\" { eye 0 1 5; target 0 1 0 }",
            "the scene has no camera to look through"
        )
    });
    let Some(name) = name else { return Ok(vec![first?]) };
    let is_camera = |id: &EntityId| scene.role(*id) == Some(Role::Camera);
    if let Some(id) = scene.entity_named(name).filter(is_camera) {
        return Ok(vec![id]);
    }
    let cameras: Vec<EntityId> = scene.walk().into_iter().filter(is_camera).collect();
    if name == ALL {
        first?;
        return Ok(cameras);
    }
    let names: Vec<String> = cameras.iter().filter_map(|id| scene.name(*id)).collect();
    let known: Vec<&str> = names.iter().map(String::as_str).collect();
    Err(unknown("camera", name, &known))
}

/// The camera of that name, or the first.
pub(crate) fn find_camera(scene: &Scene, name: Option<&str>) -> Result<EntityId> {
    match find_cameras(scene, name)?[..] {
        [camera] => Ok(camera),
        _ => Err(miette!(help = "name one of them with --camera", "one camera is looked through at a time")),
    }
}

/// The camera where its groups put it.
pub(crate) fn placed_camera(scene: &Scene, id: EntityId) -> Result<Camera> {
    let missing = || -> Report { miette!("the scene has no camera to look through") };
    let camera = scene.camera(id).ok_or_else(missing)?;
    let placement = scene.world_placement(id).ok_or_else(missing)?;
    camera.placed(&placement).into_diagnostic().wrap_err("the camera cannot stand where its groups put it")
}
