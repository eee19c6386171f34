//! How much light do rough surfaces send on in all, and how much do their formulas lose? Tables, computed once when they are first
//! asked for.
//!
//! A microfacet formula counts light that leaves a facet and meets no other. What is shadowed is lost by it, though not by the
//! surface: [`Complement`](super::Complement) gives it back (Kulla and Conty, "Revisiting physically based shading at
//! Imageworks", SIGGRAPH 2017 course), and needs to know how much it is at each angle, to a thousandth.

mod axis;
mod cap;
mod interface;
mod reflection;
mod sheen;

pub(super) use cap::CapPoints;
pub(super) use interface::{Interface, Side, lost_at_interface};
pub(super) use reflection::{kept_by_reflection, lost_by_reflection, mean_lost_by_reflection};
pub(super) use sheen::{most_sheen, sheen_albedo};
