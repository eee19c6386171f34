//! What is traced and what is drawn of all that the viewer knows?

use std::sync::Arc;

use catoptra_core::{Camera, Integrator};
use catoptra_raster::{Manipulator, Overlay, OverlayStyle};
use catoptra_tracer::{Tone, View};

use crate::parts::Goal;
use crate::pass;
use crate::tracing::Request;
use crate::transform::{self, Ends};
use crate::viewer::Viewer;

/// Samples a pixel where each is one direction that sees the sky or does not: a quarter of the noise of a single one.
const OCCLUSION_SAMPLES: u32 = 16;

impl Viewer {
    /// What the worker is to trace now.
    pub(crate) fn request(&self) -> Request {
        let pass = self.settings.pass;
        let integrator = pass.integrator.unwrap_or(self.document.scene().settings().integrator());
        let samples = match integrator {
            Integrator::Whitted | Integrator::Path => 1,
            Integrator::Occlusion => OCCLUSION_SAMPLES,
        };
        let goal = Goal::of(self.document.scene().settings(), integrator, self.settings.max_error);
        let view = View { integrator, ..self.view().with_samples(samples) };
        let own = if pass.paint.is_some() { pass::own_shapes(self.scene_shown()) } else { Arc::default() };
        Request {
            extraction: Arc::clone(&self.extraction),
            latest: Arc::clone(&self.latest),
            backend: self.settings.backend,
            view,
            frame_time: self.settings.frame_time,
            goal,
            tone: self.tone(),
            pass,
            own,
            lights: Arc::clone(&self.light_parts),
        }
    }

    /// How radiance becomes colour: as the panel and the scene say.
    pub(crate) fn tone(&self) -> Tone {
        let scene = self.document.scene().settings().exposure();
        self.settings.display.exposed(scene + self.settings.exposure.stops)
    }

    /// The handles about what is selected; none while keys move it.
    fn manipulator(&self) -> Option<Manipulator> {
        let by_keys = self.transform.as_ref().is_some_and(|transform| transform.ends == Ends::ByClick);
        self.settings.tool.filter(|_| !by_keys).and_then(|tool| transform::manipulator(self, tool))
    }

    /// The overlays as seen by `camera` on a picture of that size.
    pub(crate) fn overlay<'a>(&'a self, camera: &'a Camera) -> Overlay<'a> {
        let style = if self.shown.overlays {
            OverlayStyle { manipulator: self.manipulator(), ..self.settings.style }
        } else {
            OverlayStyle { scale: self.settings.style.scale, ..OverlayStyle::NONE }
        };
        let (width, height) = self.size;
        let (scene, selection) = (self.document.scene(), self.selection.ids());
        Overlay { scene, camera, width, height, depth: None, selection, style }
    }
}
