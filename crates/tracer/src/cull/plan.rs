//! The plan of a part of a picture, made before its light is gathered: which lights reach it, what may occlude them, and
//! which of its mirrors show nothing but a black background.

use catoptra_core::Rgb;

use super::beam::Beam;
use super::candidates::{Candidates, FEW};
use super::darkness::goes_dark;
use super::lamps::LampPlan;
use super::planner::Planner;
use super::point_bounds::PointBounds;
use crate::Snapshot;
use crate::snapshot::LightRow;

/// A plan for a part of a picture, or for a stream of reflected rays.
#[derive(Debug, Default)]
pub(crate) struct TilePlan {
    /// Lights that reach anything that is seen, by their rows.
    pub(crate) reached: Vec<usize>,
    /// For every light, what may stand between it and what is seen.
    pub(crate) occluders: Vec<Candidates>,
    /// For every lamp, whether it is seen and past what.
    pub(crate) lamps: Vec<LampPlan>,
    /// Shapes whose reflections all go into darkness.
    pub(crate) dark: Vec<u32>,
}

impl TilePlan {
    /// Starts anew: every light reaches everything, nothing is known to be dark. Occluders are found by
    /// [`plan_lights`](Self::plan_lights).
    pub(crate) fn start(&mut self, snapshot: &Snapshot) {
        let lights = snapshot.light_rows().len();
        self.occluders.resize_with(lights, Candidates::default);
        self.lamps.resize_with(snapshot.lamps().asked().len(), LampPlan::default);
        self.reached.clear();
        self.reached.extend(0..lights);
        self.dark.clear();
    }

    /// Finds out for every light whether it reaches points that are seen, and what may stand between.
    pub(crate) fn plan_lights(&mut self, planner: &Planner<'_>, points: &[PointBounds]) {
        let Planner { snapshot, skip, outside } = *planner;
        if skip.unreached && snapshot.has_cones() {
            let reaches = |light: &LightRow| points.iter().any(|bounds| bounds.is_reached_by(light));
            self.reached.clear();
            let lights = snapshot.light_rows().iter().enumerate();
            self.reached.extend(lights.filter(|(_, light)| reaches(light)).map(|(i, _)| i));
        }
        for (occluders, light) in self.occluders.iter_mut().zip(snapshot.light_rows()) {
            if skip.shafts {
                occluders.occluders(snapshot.columns(), points, light, outside);
            } else {
                occluders.all(snapshot.columns());
            }
        }
        for (plan, lamp) in self.lamps.iter_mut().zip(snapshot.lamps().asked()) {
            plan.plan(planner, lamp, points);
        }
    }

    /// Finds the shapes that send on all rays of some beams into darkness, of those whose points are known.
    pub(crate) fn plan_darkness(&mut self, planner: &Planner<'_>, beams: &[Beam], points: &[PointBounds]) {
        let Planner { snapshot, skip, outside } = *planner;
        self.dark.clear();
        let columns = snapshot.columns();
        let plain = columns.general_unbounded.is_empty() && columns.bounded.len() <= FEW;
        if !skip.beams || !plain || snapshot.background() != Rgb::BLACK {
            return;
        }
        for bounds in points {
            let material = snapshot.prims()[bounds.prim as usize].material;
            let row = &snapshot.material_rows()[material as usize];
            if row.lobes.mirror && !self.dark.contains(&bounds.prim) {
                self.dark.push(bounds.prim);
            }
        }
        self.dark.retain(|&prim| {
            let own = || points.iter().filter(|bounds| bounds.prim == prim);
            beams.iter().all(|beam| own().all(|bounds| goes_dark(columns, beam, bounds, outside)))
        });
    }
}
