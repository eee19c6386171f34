//! Rays in columns: those of the camera, tile by tile, and queues of those that surfaces send on.

mod batch;
mod camera_rays;
mod find;
mod lane_bounds;
mod queue;

pub(crate) use batch::{Batch, Part};
pub(crate) use camera_rays::{CameraPackets, CameraRays};
pub(crate) use lane_bounds::LaneBounds;
pub(crate) use queue::{Queue, QueuedRays};
