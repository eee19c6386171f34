//! Which shapes, lights and reflections a part of a picture can need at all: pure `f64` geometry that may keep too much,
//! never too little.

mod beam;
mod candidates;
mod darkness;
mod frustum;
mod plan;
mod point_bounds;
#[cfg(test)]
mod properties;

pub(crate) use beam::Beam;
pub(crate) use candidates::Candidates;
pub(crate) use frustum::{Frustum, quarters};
pub(crate) use plan::{Planner, TilePlan};
pub(crate) use point_bounds::PointBounds;
