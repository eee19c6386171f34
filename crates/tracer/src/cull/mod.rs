//! Which shapes, lights and reflections a part of a picture can need at all: pure `f64` geometry that may keep too much,
//! never too little.

mod beam;
mod candidates;
mod darkness;
mod frustum;
mod lamps;
mod plan;
mod planner;
mod point_bounds;
#[cfg(test)]
mod properties;
mod shaft;

pub(crate) use beam::Beam;
pub(crate) use candidates::Candidates;
pub(crate) use frustum::{Frustum, quarters};
pub(crate) use lamps::{all_blockers, blockers_between, is_few, own_shape};
pub(crate) use plan::TilePlan;
pub(crate) use planner::Planner;
pub(crate) use point_bounds::PointBounds;
pub(crate) use shaft::Shaft;
