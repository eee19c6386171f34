//! What a part of a picture needs to know of a lamp: whether any of it is lit by it, and what may stand between.

use super::candidates::{Candidates, FEW};
use super::planner::Planner;
use super::point_bounds::PointBounds;
use super::shaft::Shaft;
use catoptra_core::glam::DVec3;

use crate::Snapshot;
use crate::accel::MAX_DEPTH;
use crate::film::NOTHING;
use crate::kernel::PlaneRow;
use crate::snapshot::{Ball, LampRow};

/// How the points of a part of a picture are lit by a lamp.
#[derive(Debug, Default)]
pub(crate) struct LampPlan {
    /// Whether any may be.
    pub(crate) reached: bool,
    /// Shapes that may stand between, by number, each once; where there are few shapes, all of them, and all meshes in any
    /// case, so that how a point's light is found depends on nothing but the point.
    pub(crate) blockers: Vec<u32>,
    /// The same, as rays are traced among them.
    pub(crate) among: Candidates,
}

impl LampPlan {
    /// For some points, relative to the snapshot's origin. `outside` says that every ray stays outside all convex solids.
    pub(crate) fn plan(&mut self, planner: &Planner<'_>, lamp: &LampRow, points: &[PointBounds]) {
        let Planner { snapshot, skip, outside } = *planner;
        self.blockers.clear();
        let lit = |bounds: &&PointBounds| !skip.unreached || may_be_lit(snapshot, lamp, bounds);
        self.reached = points.iter().any(|bounds| lit(&bounds));
        if !self.reached || !lamp.shadow {
            return;
        }
        if !skip.shafts || is_few(snapshot) {
            all_blockers(snapshot, lamp, &mut self.blockers);
            self.among.among(snapshot.columns(), &self.blockers);
            return;
        }
        for bounds in points.iter().filter(lit) {
            blockers_between(snapshot, lamp, bounds, outside, &mut self.blockers);
        }
        let instances = snapshot.columns().instances.iter().map(|instance| instance.prim);
        self.blockers.extend(instances);
        self.blockers.sort_unstable();
        self.blockers.dedup();
        self.among.among(snapshot.columns(), &self.blockers);
    }
}

/// Whether there are so few shapes that points ask all of them about a lamp.
pub(crate) fn is_few(snapshot: &Snapshot) -> bool {
    snapshot.columns().bounded.len() <= FEW
}

/// Every shape that may block a lamp from anywhere.
pub(crate) fn all_blockers(snapshot: &Snapshot, lamp: &LampRow, out: &mut Vec<u32>) {
    out.extend((0..snapshot.prims().len() as u32).filter(|prim| may_block(snapshot, lamp, *prim)));
}

/// Adds the shapes that may block a lamp from some points, in no order and perhaps more than once.
pub(crate) fn blockers_between(
    snapshot: &Snapshot,
    lamp: &LampRow,
    bounds: &PointBounds,
    outside: bool,
    out: &mut Vec<u32>,
) {
    let columns = snapshot.columns();
    let shaft = Shaft::new(bounds, &lamp.ball);
    // Of several shapes together none is known to be the points' own.
    let of_one = bounds.prim != NOTHING;
    let own = (outside && of_one && columns.is_convex(bounds.prim)).then_some(bounds.prim);
    let planes = columns.planes.iter().filter(|row| stands_between(row, bounds, &lamp.ball));
    out.extend(planes.map(|row| row.prim));
    out.extend(&columns.general_unbounded);
    walk(snapshot, &shaft, |prim| {
        if own != Some(prim) && may_block(snapshot, lamp, prim) {
            out.push(prim);
        }
    });
}

/// Whether a shape may block a lamp.
fn may_block(snapshot: &Snapshot, lamp: &LampRow, prim: u32) -> bool {
    own_shape(snapshot, lamp) != Some(prim)
}

/// The shape that a lamp is: it is not in its own way, unless it is a mesh.
pub(crate) fn own_shape(snapshot: &Snapshot, lamp: &LampRow) -> Option<u32> {
    lamp.prim.filter(|&prim| snapshot.prims()[prim as usize].mesh.is_none())
}

/// Whether any point lies on a side to which the lamp shines.
fn may_be_lit(snapshot: &Snapshot, lamp: &LampRow, bounds: &PointBounds) -> bool {
    let Some((on, normal)) = lamp.outline.lit_side() else { return true };
    let above = normal.dot(bounds.center - (on - snapshot.origin_in_frame()));
    let spread = normal.abs().dot(bounds.half);
    !(above + spread < 0.0)
}

/// Whether a plane may stand between some of the points and some of the lamp.
fn stands_between(row: &PlaneRow, bounds: &PointBounds, lamp: &Ball) -> bool {
    if row.prim == bounds.prim {
        return false;
    }
    let margin = bounds.margin(row) + row.distance_error;
    let side = |center: DVec3, spread: f64| {
        let above = row.normal.dot(center) - row.distance;
        (above - spread > margin, above + spread < -margin)
    };
    let points = side(bounds.center, row.normal.abs().dot(bounds.half));
    let shining = side(lamp.center, lamp.radius);
    !((points.0 && shining.0) || (points.1 && shining.1))
}

/// Calls `visit` with all bounded shapes whose boxes a shaft may meet.
fn walk(snapshot: &Snapshot, shaft: &Shaft, mut visit: impl FnMut(u32)) {
    let (tree, columns) = (snapshot.tree(), snapshot.columns());
    if tree.nodes.is_empty() {
        return;
    }
    let mut stack = [0_u32; MAX_DEPTH];
    let (mut depth, mut at) = (0, 0_u32);
    loop {
        let node = &tree.nodes[at as usize];
        if shaft.meets_box(&node.bounds) {
            if node.count == 0 {
                stack[depth] = node.link;
                depth += 1;
                at += 1;
                continue;
            }
            for &item in &tree.order[node.link as usize..][..node.count as usize] {
                if shaft.meets(&columns.balls[item as usize]) {
                    visit(columns.bounded[item as usize]);
                }
            }
        }
        if depth == 0 {
            return;
        }
        depth -= 1;
        at = stack[depth];
    }
}
