//! What does the viewer know, and what follows from what a person does? The open scene, the view on it, what is
//! selected and shown; no window, no drawing.

use std::path::PathBuf;
use std::sync::Arc;
use std::time::Instant;

use catoptra_core::scene::{Edit, EntityId, SceneError, Subject, TextureId};
use catoptra_core::{Aabb, Camera, Integrator};
use catoptra_raster::{Overlay, OverlayStyle};
use catoptra_tracer::{Backend, Display, Extraction, Pick, Size, Tone, View, backends, pick};

use crate::browse::Browser;
use crate::camera_control;
use crate::document::Document;
use crate::guard::{Guard, Next};
use crate::input::{Mode, Pointer};
use crate::latest::Latest;
use crate::loader::Opened;
use crate::making::add::Adding;
use crate::naming::Named;
use crate::preview::Preview;
use crate::selection::{Picking, Selection};
use crate::tracing::Request;

/// Samples a pixel where each is one direction that sees the sky or does not: a quarter of the noise of a single one.
const OCCLUSION_SAMPLES: u32 = 16;

/// Paths a pixel: a picture that is noisy and soon there.
const PATH_SAMPLES: u32 = 16;

/// What has to be done again since something changed.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Stale {
    /// The picture has to be traced.
    pub(crate) trace: bool,
    /// The overlays have to be drawn.
    pub(crate) overlay: bool,
    /// The panel has to be shown again.
    pub(crate) panel: bool,
}

/// What is shown over and beside the picture.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Shown {
    /// The panel.
    pub(crate) panel: bool,
    /// The list of keys.
    pub(crate) help: bool,
    /// Any overlay at all.
    pub(crate) overlays: bool,
}

/// How the scene is looked at.
#[derive(Clone)]
pub(crate) struct ViewSettings {
    /// What a plain drag does.
    pub(crate) mode: Mode,
    /// Who traces.
    pub(crate) backend: &'static dyn Backend,
    /// How radiance becomes colour.
    pub(crate) display: Display,
    /// Which overlays are drawn.
    pub(crate) style: OverlayStyle,
}

/// What the window is to do that the viewer cannot do by itself.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) enum Wanted {
    /// Read a model and put it into the scene.
    Model(PathBuf),
    /// Put a text on the clipboard.
    Copy(String),
    /// Paste what is on the clipboard.
    Paste,
}

/// A file that could not be read.
#[derive(Debug, Clone)]
pub(crate) struct Broken {
    /// What is wrong, with its line.
    pub(crate) report: String,
    /// What was to be read.
    pub(crate) source: Next,
}

/// The viewer's state.
pub(crate) struct Viewer {
    pub(crate) document: Document,
    /// The scene as it is now, for the worker to freeze.
    pub(crate) extraction: Arc<Extraction>,
    /// The scene as it was last frozen.
    pub(crate) latest: Arc<Latest>,
    pub(crate) camera: Camera,
    /// The scene's camera that was last looked through.
    pub(crate) through: Option<EntityId>,
    pub(crate) settings: ViewSettings,
    pub(crate) selection: Selection,
    /// The texture whose fields are shown.
    pub(crate) texture: Option<TextureId>,
    /// The picture of a material.
    pub(crate) preview: Preview,
    /// A name that is being typed, and whose it is to be.
    pub(crate) typed_name: Option<(Named, String)>,
    pub(crate) shown: Shown,
    pub(crate) pointer: Pointer,
    /// The size of the picture in pixels.
    pub(crate) size: (u32, u32),
    /// A line for the person, and since when it stands.
    pub(crate) notice: Option<(String, Instant)>,
    /// What is wrong with a file.
    pub(crate) error: Option<Broken>,
    /// What could not be done; it stands until it is done or taken away.
    pub(crate) failure: Option<String>,
    /// What the window is to do.
    pub(crate) wanted: Option<Wanted>,
    /// What is being chosen to be added.
    pub(crate) adding: Option<Adding>,
    /// The field of the name that is being typed is to have the keys.
    pub(crate) names_next: bool,
    /// The way to a file that is wanted.
    pub(crate) browser: Option<Browser>,
    /// What is asked before work is lost.
    pub(crate) guard: Guard,
    /// A picture is to be written as soon as it is finished.
    pub(crate) picture_wanted: bool,
    pub(crate) stale: Stale,
    /// The revision of the scene that has been looked at for changes.
    seen: u64,
}

impl Viewer {
    /// A viewer of that scene.
    pub(crate) fn new(opened: Opened) -> Self {
        let style = OverlayStyle {
            grid: false,
            axes: false,
            lights: true,
            cones: false,
            selection: true,
            cameras: false,
            ..OverlayStyle::NONE
        };
        let seen = opened.document.scene().revision();
        let mut viewer = Self {
            document: opened.document,
            extraction: opened.extraction,
            latest: opened.latest,
            camera: usual_camera(),
            through: None,
            settings: ViewSettings {
                mode: Mode::Orbit,
                backend: backends()[0],
                display: Display::Srgb,
                style,
            },
            selection: Selection::default(),
            texture: None,
            preview: Preview::default(),
            typed_name: None,
            shown: Shown { panel: true, help: false, overlays: true },
            pointer: Pointer::default(),
            size: (0, 0),
            notice: None,
            error: None,
            failure: None,
            browser: None,
            wanted: None,
            adding: None,
            names_next: false,
            guard: Guard::default(),
            picture_wanted: false,
            stale: Stale { trace: true, overlay: true, panel: true },
            seen,
        };
        viewer.adopt(viewer.document.scene().main_camera());
        viewer
    }

    /// Shows another scene from its own camera, or the same file read again from where one looks now; what is switched on
    /// stays.
    pub(crate) fn show(&mut self, opened: Opened) {
        let again = self.document.source().is_some() && self.document.source() == opened.document.source();
        let kept = again.then(|| self.kept_view());
        self.document.settle();
        self.document = opened.document;
        self.extraction = opened.extraction;
        self.latest = opened.latest;
        self.seen = self.document.scene().revision();
        self.selection = Selection::default();
        self.texture = None;
        self.typed_name = None;
        self.error = None;
        self.failure = None;
        self.browser = None;
        self.adding = None;
        self.guard.forget();
        match kept {
            Some((selected, through)) => {
                let scene = self.document.scene();
                self.selection = selected.iter().filter_map(|name| scene.entity_named(name)).collect();
                self.through = through.and_then(|name| scene.entity_named(&name));
            }
            None => self.adopt(self.document.scene().main_camera()),
        }
        self.stale = Stale { trace: true, overlay: true, panel: true };
    }

    /// The names of what is selected and of the camera that was looked through.
    fn kept_view(&self) -> (Vec<String>, Option<String>) {
        let scene = self.document.scene();
        let selected = self.selection.ids().iter().filter_map(|id| scene.name(*id)).collect();
        (selected, self.through.and_then(|id| scene.name(id)))
    }

    /// Tells the person something.
    pub(crate) fn notify(&mut self, text: impl Into<String>) {
        self.notice = Some((text.into(), Instant::now()));
        self.stale.panel = true;
    }

    /// Looks from elsewhere.
    pub(crate) fn look(&mut self, camera: Camera) {
        if camera != self.camera {
            self.camera = camera;
            self.stale.trace = true;
        }
    }

    /// Looks through a camera of the scene; without one, at everything.
    pub(crate) fn adopt(&mut self, id: Option<EntityId>) {
        let scene = self.document.scene();
        let seen = id.and_then(|id| scene.world_camera(id));
        self.through = seen.as_ref().and(id);
        match seen {
            Some(camera) if camera.target_distance().is_none() => self.look(self.aimed(&camera)),
            Some(camera) => self.look(camera),
            None => self.frame(self.everything()),
        }
        self.stale.overlay = true;
    }

    /// A camera that names no target is taken to look at the middle of what it sees in the middle of its picture.
    fn aimed(&self, camera: &Camera) -> Camera {
        let view = View::new(camera.clone(), Size::new(2, 2));
        let Some(hit) = pick(&self.latest.get(), &view, 1.0, 1.0) else { return camera.clone() };
        let bounds = self.document.scene().world_bounds(hit.entity);
        let depth = bounds.map_or(0.0, |bounds| (bounds.centre() - camera.eye()).dot(camera.forward()));
        camera_control::aimed(camera, depth.max(hit.distance))
    }

    /// The box round all bounded shapes.
    pub(crate) fn everything(&self) -> Aabb {
        let shapes = self.document.scene().world_shapes();
        shapes.iter().filter_map(|(shape, _)| shape.part.bounds()).fold(Aabb::EMPTY, Aabb::union)
    }

    /// Moves the camera so that `bounds` is seen; an empty box changes nothing.
    pub(crate) fn frame(&mut self, bounds: Aabb) {
        let aspect = f64::from(self.size.0.max(1)) / f64::from(self.size.1.max(1));
        self.look(camera_control::frame(&self.camera, bounds, aspect));
    }

    /// The tracer's view of the full picture.
    pub(crate) fn view(&self) -> View {
        View::of(self.document.scene(), self.camera.clone(), Size::new(self.size.0, self.size.1))
    }

    /// What the picture shows at a point, in pixels, as far as it is traced: what has been removed since is nothing.
    pub(crate) fn pick(&self, x: f64, y: f64) -> Option<Pick> {
        let hit = pick(&self.latest.get(), &self.view(), x, y);
        hit.filter(|hit| self.document.scene().contains(hit.entity))
    }

    /// What the worker is to trace now.
    pub(crate) fn request(&self) -> Request {
        let view = match self.document.scene().settings().integrator() {
            Integrator::Whitted => self.view().with_samples(1),
            Integrator::Path => self.view().with_samples(PATH_SAMPLES),
            Integrator::Occlusion => self.view().with_samples(OCCLUSION_SAMPLES),
        };
        Request {
            extraction: Arc::clone(&self.extraction),
            latest: Arc::clone(&self.latest),
            backend: self.settings.backend,
            view,
            tone: self.tone(),
        }
    }

    /// How radiance becomes colour: as the panel and the scene say.
    pub(crate) fn tone(&self) -> Tone {
        self.settings.display.exposed(self.document.scene().settings().exposure())
    }

    /// The overlays as seen by `camera` on a picture of that size.
    pub(crate) fn overlay<'a>(&'a self, camera: &'a Camera) -> Overlay<'a> {
        let style = if self.shown.overlays {
            self.settings.style
        } else {
            OverlayStyle { scale: self.settings.style.scale, ..OverlayStyle::NONE }
        };
        let (width, height) = self.size;
        let (scene, selection) = (self.document.scene(), self.selection.ids());
        Overlay { scene, camera, width, height, depth: None, selection, style }
    }

    /// Selects one thing alone, or nothing.
    pub(crate) fn select(&mut self, id: Option<EntityId>) {
        self.select_all(id.into_iter().collect());
    }

    /// Takes in a click on a thing, or on nothing.
    pub(crate) fn click_on(&mut self, id: Option<EntityId>, picking: Picking) {
        match (id, picking) {
            (Some(id), _) => self.select_all(self.selection.picked(id, picking)),
            (None, Picking::Only) => self.select(None),
            (None, Picking::Toggle) => {}
        }
    }

    /// Selects these. Cones are shown from the first spot light on that becomes the active one.
    pub(crate) fn select_all(&mut self, selection: Selection) {
        if self.selection != selection {
            self.finish_name();
            self.selection = selection;
            let light = self.selection.active().and_then(|id| self.document.scene().light(id));
            let is_spot = light.is_some_and(|l| l.position().is_some() && l.direction().is_some());
            self.settings.style.cones |= is_spot;
            self.stale.overlay = true;
            self.stale.panel = true;
        }
    }

    /// Gives the name that is being typed, if any, to whose it is to be.
    pub(crate) fn finish_name(&mut self) {
        let Some((owner, typed)) = self.typed_name.take() else { return };
        if let Some(edit) = owner.renamed(self.document.scene(), typed) {
            self.edit(edit);
        }
    }

    /// Changes the scene as one step to undo; `false` for a refusal, which is told.
    pub(crate) fn edit(&mut self, edit: Edit) -> bool {
        let outcome = self.document.edit(edit);
        let done = outcome.is_ok();
        self.after_edit(outcome);
        done
    }

    /// Changes the scene as a part of the step with that key; a refusal is told.
    pub(crate) fn edit_on(&mut self, edit: Edit, key: u64) {
        let outcome = self.document.edit_on(edit, key);
        self.after_edit(outcome);
    }

    fn after_edit(&mut self, outcome: Result<(), SceneError>) {
        match outcome {
            Ok(()) => self.notice = None,
            Err(refusal) => self.notify(refusal.to_string()),
        }
    }

    /// Brings everything up to what the scene has become; once for all that happened since the last time. The worker
    /// makes the snapshot.
    pub(crate) fn follow_scene(&mut self) {
        let scene = self.document.scene();
        if scene.revision() == self.seen {
            return;
        }
        let changes = scene.changes_since(self.seen);
        let moved = self.through.filter(|id| changes.iter().any(|c| c.subject == Subject::Entity(*id)));
        self.seen = scene.revision();
        self.extraction = Arc::new(Extraction::of(scene));
        self.selection = self.selection.without(|id| !scene.contains(id));
        self.texture = self.texture.filter(|id| scene.find_texture(*id).is_some());
        if moved.is_some() {
            self.adopt(moved);
        }
        self.stale = Stale { trace: true, overlay: true, panel: true };
    }
}

/// Where one looks from before any scene says better.
fn usual_camera() -> Camera {
    use catoptra_core::glam::DVec3;
    Camera::look_at(DVec3::new(4.0, 3.0, 8.0), DVec3::ZERO, DVec3::Y, std::f64::consts::FRAC_PI_4)
        .unwrap_or_else(|_| unreachable!("constants that a camera accepts"))
}
