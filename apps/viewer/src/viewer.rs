//! What does the viewer know, and what follows from what a person does? The open scene, the view on it, what is
//! selected and shown; no window, no drawing.

use std::path::PathBuf;
use std::sync::Arc;
use std::time::Instant;

use catoptra_core::Camera;
use catoptra_core::scene::{EntityId, Scene, TextureId};
use catoptra_tracer::Extraction;

use crate::browse::Browser;
use crate::comparison::Comparison;
use crate::document::Document;
use crate::fly::Flown;
use crate::guard::{Guard, Next};
use crate::input::Pointer;
use crate::latest::Latest;
use crate::light_parts::LightParts;
use crate::lighting::Lighting;
use crate::loader::Opened;
use crate::making::add::Adding;
use crate::naming::Named;
use crate::pictures::Pictures;
use crate::preview::Preview;
use crate::seeing::{Readout, ViewSettings};
use crate::selection::{Picking, Selection};
use crate::transform::Transform;
use crate::viewpoint::usual_camera;

/// What has to be done again since something changed.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Stale {
    /// The scene has to be copied for the worker.
    pub(crate) scene: bool,
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

/// What the window is to do that the viewer cannot do by itself.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) enum Wanted {
    /// Read a model and put it into the scene.
    Model(PathBuf),
    /// Put a text on the clipboard.
    Copy(String),
    /// Paste what is on the clipboard.
    Paste,
    /// Let the desktop's own dialog ask for the file that is wanted.
    DesktopDialog,
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
    /// As it was when it was last looked at.
    pub(crate) seen_through: Option<Camera>,
    pub(crate) settings: ViewSettings,
    pub(crate) selection: Selection,
    /// The texture whose fields are shown.
    pub(crate) texture: Option<TextureId>,
    /// The picture of a material.
    pub(crate) preview: Preview,
    /// A name that is being typed, and whose it is to be.
    pub(crate) typed_name: Option<(Named, String)>,
    pub(crate) shown: Shown,
    /// Which lights are left dark.
    pub(crate) lighting: Lighting,
    /// The scene by each of its lights, where these are told apart.
    pub(crate) light_parts: Arc<LightParts>,
    /// Whether the scene lacks lights and is lit from the camera.
    pub(crate) headlight: bool,
    /// The scene before the last edit, while that is shown.
    pub(crate) before: Option<Scene>,
    /// The picture that this one is compared with.
    pub(crate) comparison: Comparison,
    /// What stands by the pointer of what it points to, and the colours of numbers.
    pub(crate) readout: Readout,
    pub(crate) pointer: Pointer,
    /// What is being moved, turned or scaled.
    pub(crate) transform: Option<Transform>,
    /// The light or camera that goes along with the view.
    pub(crate) flown: Option<Flown>,
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
    /// The pictures that are wanted in files.
    pub(crate) pictures: Pictures,
    pub(crate) stale: Stale,
    /// The revision of the scene that has been looked at for changes.
    pub(crate) seen: u64,
}

impl Viewer {
    /// A viewer of that scene.
    pub(crate) fn new(opened: Opened) -> Self {
        let seen = opened.document.scene().revision();
        let mut viewer = Self {
            document: opened.document,
            extraction: opened.extraction,
            latest: opened.latest,
            camera: usual_camera(),
            through: None,
            seen_through: None,
            settings: ViewSettings::usual(),
            selection: Selection::default(),
            texture: None,
            preview: Preview::default(),
            typed_name: None,
            shown: Shown { panel: true, help: false, overlays: true },
            lighting: Lighting::default(),
            light_parts: Arc::default(),
            headlight: false,
            before: None,
            comparison: Comparison::default(),
            readout: Readout::default(),
            pointer: Pointer::default(),
            transform: None,
            flown: None,
            size: (0, 0),
            notice: None,
            error: None,
            failure: None,
            browser: None,
            wanted: None,
            adding: None,
            names_next: false,
            guard: Guard::default(),
            pictures: Pictures::default(),
            stale: Stale { scene: false, trace: true, overlay: true, panel: true },
            seen,
        };
        viewer.stale.scene = viewer.is_lit_otherwise();
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
        self.lighting.clear();
        self.before = None;
        self.transform = None;
        self.flown = None;
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
            None => {
                self.pictures.forget();
                self.adopt(self.document.scene().main_camera());
            }
        }
        self.stale = Stale { scene: self.is_lit_otherwise(), trace: true, overlay: true, panel: true };
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

    /// Selects one thing alone, or nothing.
    pub(crate) fn select(&mut self, id: Option<EntityId>) {
        self.select_all(id.into_iter().collect());
    }

    /// Takes in a click on a thing, or on nothing. One more click on what is selected selects what holds it.
    pub(crate) fn click_on(&mut self, id: Option<EntityId>, picking: Picking) {
        match (id, picking) {
            (Some(id), Picking::Only) => self.select(Some(self.clicked(id))),
            (Some(id), Picking::Toggle) => self.select_all(self.selection.toggled(id)),
            (None, Picking::Only) => self.select(None),
            (None, Picking::Toggle) => {}
        }
    }

    /// What a click on a thing means: the thing, or where that or a group round it is all that is selected, the next group
    /// outwards; after the outermost the thing again.
    fn clicked(&self, id: EntityId) -> EntityId {
        let scene = self.document.scene();
        let mut around = std::iter::successors(Some(id), |id| scene.parent(*id));
        match self.selection.ids() {
            [only] if around.any(|id| id == *only) => scene.parent(*only).unwrap_or(id),
            _ => id,
        }
    }

    /// Selects these.
    pub(crate) fn select_all(&mut self, selection: Selection) {
        if self.selection != selection {
            self.finish_name();
            self.selection = selection;
            self.stale.scene |= self.tells_lights_apart();
            self.stale.overlay = true;
            self.stale.panel = true;
        }
    }
}
