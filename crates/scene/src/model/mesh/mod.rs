//! How do the polygons of a file become triangle meshes, whatever the format?

mod compact;
mod corners;
mod cut;
mod ears;
mod positions;
mod smooth;
mod turn;
mod weld;

pub(in crate::model) use compact::Vertices;
pub(in crate::model) use cut::{Cutter, normal_of};
pub(in crate::model) use positions::{Positions, is_place};
pub(in crate::model) use smooth::Smoothing;
pub(in crate::model) use weld::{Corner, NONE, Tables, weld};
