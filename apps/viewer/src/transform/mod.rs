//! How are selected things moved, turned and scaled by hand? From a key or a handle until it is kept or taken back, as one
//! step to undo: what the pointer and typed numbers ask for is done each time anew to the things as they were.

mod keys;
mod pivot;
mod surface;
mod thing;
mod tidy;

use catoptra_core::glam::DVec3;
use catoptra_core::scene::{EntityId, History};
use catoptra_core::{Aabb, Edit};
use catoptra_raster::{Axis, Constraint, Manipulator, Motion, Projection, Tool};

use crate::arithmetic;
use crate::viewer::Viewer;

pub(crate) use keys::key;
pub(crate) use pivot::manipulator;
pub(crate) use surface::aimed_at;
pub(crate) use tidy::{camera as tidy_camera, light as tidy_light, step_within, turned};

use thing::Thing;

/// The key of the steps that this makes.
const STEP_KEY: u64 = 1 << 63 | 1 << 62;

/// Pixels of a step that Ctrl holds a move to, about.
const PIXELS_PER_STEP: f64 = 24.0;

/// Degrees, and the factor, of the others.
const DEGREES_PER_STEP: f64 = 15.0;
const FACTOR_PER_STEP: f64 = 0.1;

/// What ends it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Ends {
    /// A click or Enter, as it was begun by a key.
    ByClick,
    /// The button that is let go.
    ByRelease,
}

/// Things that are being moved, turned or scaled.
pub(crate) struct Transform {
    manipulator: Manipulator,
    constraint: Constraint,
    /// Whether the axes are those of the active thing.
    local: bool,
    pub(crate) ends: Ends,
    from: (f64, f64),
    to: (f64, f64),
    /// Ctrl is held.
    in_steps: bool,
    /// A number that is typed.
    typed: String,
    things: Vec<Thing>,
    /// The steps before it.
    steps: History,
    /// What the things took up of the world at first; empty where they have no extent.
    bounds: Aabb,
    /// Whether the scene was changed.
    applied: bool,
    /// What is done now.
    motion: Option<Motion>,
}

/// Begins with what is selected, from where the pointer is at `from`.
pub(crate) fn begin(viewer: &mut Viewer, tool: Tool, constraint: Constraint, ends: Ends, from: (f64, f64)) {
    keep(viewer);
    let scene = viewer.document.scene();
    let tops = viewer.selection.tops(scene);
    let things: Vec<Thing> =
        tops.iter().filter(|id| !scene.is_locked(**id)).filter_map(|id| Thing::of(scene, *id)).collect();
    let Some(manipulator) = manipulator(viewer, tool).filter(|_| !things.is_empty()) else {
        let locked = !tops.is_empty();
        return viewer.notify(if locked { "what is selected is locked" } else { "select something first" });
    };
    let bounds =
        things.iter().filter_map(|thing| scene.world_bounds(thing.id())).fold(Aabb::EMPTY, Aabb::union);
    viewer.document.end_step();
    viewer.transform = Some(Transform {
        manipulator,
        constraint,
        local: viewer.settings.local_axes,
        ends,
        from,
        to: from,
        in_steps: false,
        typed: String::new(),
        things,
        steps: viewer.document.steps(),
        bounds,
        applied: false,
        motion: None,
    });
    viewer.stale.panel = true;
}

/// The pointer comes to a pixel, with Ctrl held or not.
pub(crate) fn pull(viewer: &mut Viewer, to: (f64, f64), in_steps: bool) {
    if let Some(transform) = &mut viewer.transform {
        (transform.to, transform.in_steps) = (to, in_steps);
        apply(viewer);
    }
}

/// Ends it and keeps what was done.
pub(crate) fn keep(viewer: &mut Viewer) {
    if viewer.transform.take().is_some() {
        viewer.document.end_step();
        viewer.stale.panel = true;
        viewer.stale.overlay = true;
    }
}

/// Ends it and leaves everything as it was.
pub(crate) fn take_back(viewer: &mut Viewer) {
    if let Some(transform) = viewer.transform.take() {
        if transform.applied {
            viewer.document.come_back_to(transform.steps);
        }
        viewer.stale.panel = true;
        viewer.stale.overlay = true;
    }
}

/// Does anew what pointer, keys and typed numbers ask for.
fn apply(viewer: &mut Viewer) {
    let Some(transform) = &viewer.transform else { return };
    let view = Projection::new(&viewer.camera, viewer.size.0, viewer.size.1);
    let Some(motion) = transform.asked(viewer, &view) else { return };
    let Some(pixel) = view.metres_per_pixel(transform.manipulator.pivot) else { return };
    let scene = viewer.document.scene();
    let edit = |thing: &Thing| thing.edit(scene, &transform.manipulator, motion, pixel);
    let edits: Result<Vec<Edit>, _> = transform.things.iter().map(edit).collect();
    match edits {
        Ok(edits) => {
            viewer.edit_on(Edit::Batch(edits), STEP_KEY);
            if let Some(transform) = &mut viewer.transform {
                transform.applied = true;
                transform.motion = Some(motion);
            }
        }
        Err(refusal) => viewer.notify(refusal.to_string()),
    }
    viewer.stale.panel = true;
}

impl Transform {
    fn asked(&self, viewer: &Viewer, view: &Projection) -> Option<Motion> {
        let manipulator = &self.manipulator;
        if let Some(number) = arithmetic::value(&self.typed) {
            return Some(manipulator.typed(view, self.constraint, number));
        }
        if viewer.settings.on_surfaces
            && (manipulator.tool, self.constraint) == (Tool::Move, Constraint::Free)
            && let Some(by) = surface::placed(viewer, &self.ids(), (self.bounds, manipulator.pivot), self.to)
        {
            let [x, y, z] = manipulator.axes;
            return Some(Motion::Move(DVec3::new(x.dot(by), y.dot(by), z.dot(by))));
        }
        let motion = manipulator.motion(view, self.constraint, (self.from, self.to))?;
        if !self.in_steps {
            return Some(motion);
        }
        let metres = tidy::round_step(view.metres_per_pixel(manipulator.pivot)? * PIXELS_PER_STEP);
        Some(motion.in_steps(metres, DEGREES_PER_STEP.to_radians(), FACTOR_PER_STEP))
    }

    fn ids(&self) -> Vec<EntityId> {
        self.things.iter().map(Thing::id).collect()
    }

    /// Constrains it; asked for the same again, along the axes of the active thing and then of the world.
    fn constrain(&mut self, viewer_axes: [[DVec3; 3]; 2], constraint: Constraint) {
        if self.constraint == constraint {
            self.local = !self.local;
        }
        self.manipulator.axes = viewer_axes[usize::from(self.local)];
        self.constraint = constraint;
    }

    /// What is being done, in words; things may be put onto surfaces.
    pub(crate) fn words(&self, on_surfaces: bool) -> String {
        let whose = if self.local { "own " } else { "" };
        let way = match self.constraint {
            Constraint::Free if on_surfaces && self.manipulator.tool == Tool::Move => {
                " on surfaces".to_owned()
            }
            Constraint::Free => String::new(),
            Constraint::Along(axis) => format!(" along {whose}{}", axis.letter()),
            Constraint::Across(axis) => {
                format!(" in {whose}{}", axis.others().map(Axis::letter).iter().collect::<String>())
            }
        };
        let amount = match (&self.typed, self.motion) {
            (typed, _) if !typed.is_empty() => format!(": {typed}"),
            (_, None) => String::new(),
            (_, Some(Motion::Move(by))) => {
                // Beside the others, a tiny one is but rounding.
                let tail = 1e-6 * by.abs().max_element();
                let shown = |v: f64| crate::panel::short(if v.abs() < tail { 0.0 } else { v });
                format!(": {} m", by.to_array().map(shown).join("  "))
            }
            (_, Some(Motion::Turn { angle, .. })) => format!(": {:.1}°", angle.to_degrees()),
            (_, Some(Motion::Scale(factor))) => format!(": ×{factor:.3}"),
        };
        let verb = match self.manipulator.tool {
            Tool::Move => "Move",
            Tool::Turn => "Turn",
            Tool::Scale => "Scale",
        };
        let keeps = if self.ends == Ends::ByClick { "Click or Enter keeps" } else { "Letting go keeps" };
        format!(
            "{verb}{way}{amount}   X Y Z: axis, with Shift plane. Ctrl: steps. Numbers. {keeps}, Esc takes back."
        )
    }
}

#[cfg(test)]
mod tests;
