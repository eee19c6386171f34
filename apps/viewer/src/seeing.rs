//! How is the scene looked at? How bright, in which light, by which pass, as it is or as it was: all that is of the window,
//! and the file does not know of it.

use std::sync::Arc;

use catoptra_core::scene::{EntityId, Scene};
use catoptra_raster::{OverlayStyle, Tool};
use catoptra_scene::image::false_color::Scale;
use catoptra_tracer::{Backend, Display, Extraction, backends};

use crate::exposure::{self, Exposure};
use crate::input::Mode;
use crate::light_parts::LightParts;
use crate::lighting::{self, Illumination, Lighting};
use crate::parts::USUAL_ERROR;
use crate::pass::{PASSES, Pass};
use crate::refine::USUAL_FRAME;
use crate::viewer::{Stale, Viewer};

/// What is asked for by a key.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum See {
    /// The picture brighter or darker by so many steps.
    Brighter(i8),
    /// An exposure that follows the picture, or stays.
    Automatic,
    /// The next pass.
    NextPass,
    /// The selected lights dark in this window, or shining again.
    Mute,
    /// The selected lights alone in this window, or all again.
    Solo,
    /// The scene as it was before the last edit, as long as the key is held.
    Before,
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
    /// How bright the picture is shown.
    pub(crate) exposure: Exposure,
    /// Whether pixels are marked that are brighter than white.
    pub(crate) marks_clipped: bool,
    /// What is shown of the scene.
    pub(crate) pass: &'static Pass,
    /// Whether light is shown of the selected lights alone, by passes that look at each light.
    pub(crate) lights_alone: bool,
    /// Which overlays are drawn.
    pub(crate) style: OverlayStyle,
    /// Which handles stand about what is selected.
    pub(crate) tool: Option<Tool>,
    /// Whether these go along the axes of the active thing, and not of the world.
    pub(crate) local_axes: bool,
    /// Whether things that are moved freely are put onto surfaces.
    pub(crate) on_surfaces: bool,
    /// What a frame may take while something moves, in milliseconds.
    pub(crate) frame_time: f64,
    /// The standard error of displayed values up to which a picture at rest is refined, where the scene says nothing.
    pub(crate) max_error: f64,
}

impl ViewSettings {
    /// At the start.
    pub(crate) fn usual() -> Self {
        let style = OverlayStyle {
            grid: false,
            axes: false,
            lights: true,
            cones: false,
            selection: true,
            cameras: false,
            ..OverlayStyle::NONE
        };
        Self {
            mode: Mode::Orbit,
            backend: backends()[0],
            display: Display::Srgb,
            exposure: Exposure::default(),
            marks_clipped: false,
            pass: &PASSES[0],
            lights_alone: false,
            style,
            tool: Some(Tool::Move),
            local_axes: false,
            on_surfaces: false,
            frame_time: USUAL_FRAME,
            max_error: USUAL_ERROR,
        }
    }
}

/// What is read off the picture.
#[derive(Debug, Clone, Default, PartialEq)]
pub(crate) struct Readout {
    /// What the pointer points to.
    pub(crate) pointed: Option<String>,
    /// Which colour stands for which number, and the unit of these.
    pub(crate) legend: Option<(Scale, &'static str)>,
    /// The share of pixels that are brighter than white.
    pub(crate) clipped: Option<f64>,
}

/// Does what a key asks for.
pub(crate) fn run(viewer: &mut Viewer, see: See) {
    match see {
        See::Brighter(steps) => {
            viewer.expose(viewer.settings.exposure.stepped(f64::from(steps) * exposure::STEP));
        }
        See::Automatic => expose_automatically(viewer),
        See::NextPass => next_pass(viewer),
        See::Mute => toggle_lights(viewer, Lighting::toggle_mute),
        See::Solo => toggle_lights(viewer, Lighting::toggle_solo),
        See::Before => viewer.show_before(true),
    }
}

fn expose_automatically(viewer: &mut Viewer) {
    let automatic = !viewer.settings.exposure.automatic;
    viewer.expose(Exposure { automatic, ..viewer.settings.exposure });
    // The next frame tells how bright it is.
    viewer.stale.trace |= automatic;
}

fn next_pass(viewer: &mut Viewer) {
    let now = PASSES.iter().position(|pass| pass.name == viewer.settings.pass.name);
    let next = &PASSES[now.map_or(0, |at| (at + 1) % PASSES.len())];
    viewer.show_pass(next);
    viewer.notify(format!("{}: {}", next.name, next.doc));
}

/// Changes which of the selected lights shine; without any, all do again.
fn toggle_lights(viewer: &mut Viewer, toggle: fn(&mut Lighting, &[EntityId])) {
    let lights = viewer.selected_lights();
    if !lights.is_empty() {
        viewer.light(|lighting| toggle(lighting, &lights));
    } else if viewer.lighting.is_plain() {
        viewer.notify("select a light first");
    } else {
        viewer.light(Lighting::clear);
    }
}

impl Viewer {
    /// Shows the picture that bright.
    pub(crate) fn expose(&mut self, exposure: Exposure) {
        if exposure != self.settings.exposure {
            self.settings.exposure = exposure;
            self.stale.overlay = true;
            self.stale.panel = true;
        }
    }

    /// Shows the scene as it was before the last edit, or as it is.
    pub(crate) fn show_before(&mut self, before: bool) {
        if before == self.before.is_some() {
            return;
        }
        self.before = if before { self.document.before_last_edit() } else { None };
        if before && self.before.is_none() {
            return self.notify("nothing was edited yet");
        }
        self.stale = Stale { scene: true, trace: true, overlay: true, panel: true };
    }

    /// Whether the scene is shown as it was before the last edit.
    pub(crate) fn shows_before(&self) -> bool {
        self.before.is_some()
    }

    /// The scene that is shown.
    pub(crate) fn scene_shown(&self) -> &Scene {
        self.before.as_ref().unwrap_or(self.document.scene())
    }

    /// Lights that are selected, and those in selected groups.
    pub(crate) fn selected_lights(&self) -> Vec<EntityId> {
        lighting::lights_in(self.document.scene(), self.selection.ids())
    }

    /// Changes which lights shine.
    pub(crate) fn light(&mut self, change: impl FnOnce(&mut Lighting)) {
        change(&mut self.lighting);
        self.stale.scene = true;
        self.stale.panel = true;
    }

    /// Shows the scene by that pass.
    pub(crate) fn show_pass(&mut self, pass: &'static Pass) {
        let copied_anew = pass.illumination != self.settings.pass.illumination;
        self.settings.pass = pass;
        self.readout = Readout::default();
        self.stale =
            Stale { scene: copied_anew || self.stale.scene, trace: true, overlay: true, panel: true };
    }

    /// Looks at the light of the selected lights alone, or of all.
    pub(crate) fn show_lights_alone(&mut self, alone: bool) {
        self.settings.lights_alone = alone;
        self.stale.scene = true;
    }

    /// Whether each light is looked at by itself.
    pub(crate) fn tells_lights_apart(&self) -> bool {
        self.settings.pass.illumination == Illumination::EachLight
    }

    /// Whether the scene is shown in another light than its own.
    pub(crate) fn is_lit_otherwise(&self) -> bool {
        let is_other = self.settings.pass.illumination != Illumination::Scene;
        is_other || !self.lighting.is_plain() || !lighting::has_lights(self.document.scene())
    }

    /// Copies the scene for the worker, in the light that it is shown in.
    pub(crate) fn copy_scene(&mut self) {
        let scene = self.scene_shown();
        let lit = self.lighting.lit(scene, &self.camera, self.settings.pass.illumination);
        let extraction = Extraction::of(lit.as_ref().unwrap_or(scene));
        let headlight = !lighting::has_lights(scene);
        self.light_parts = match self.settings.pass.illumination {
            Illumination::EachLight => {
                LightParts::of(scene, &self.lighting, &self.selected_lights(), self.settings.lights_alone)
            }
            Illumination::Scene | Illumination::Even => Arc::default(),
        };
        self.headlight = headlight;
        self.extraction = Arc::new(extraction);
        self.stale.trace = true;
    }
}
