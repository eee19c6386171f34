//! The list of integrators, each over any ray search.
//!
//! An integrator says what light arrives along a camera ray. A new one is its name in `catoptra_core`'s list, one file
//! here, its `mod` line and its name in the list below.

mod lamp_sight;
mod matter;
mod occlusion;
mod path;
mod pixels;
mod search;
mod walker;
mod whitted;

use catoptra_core::{Integrator, Rgb};

use crate::{Frame, Hit, Stats, Tile};
pub(crate) use pixels::trace_pixels;
pub(crate) use search::{Exhaustive, Search, Trees};
use walker::{CameraRay, Walker};
pub(crate) use whitted::Receivers;

/// What an integrator implements.
pub(crate) trait Integrate {
    /// The light that arrives along a camera ray, one path at a time in `f64`, and what the ray meets first.
    fn gather<S: Search>(walker: &mut Walker<'_, S>, camera: &CameraRay) -> (Rgb, Option<Hit>);

    /// Traces all pixels of a tile with packets of rays.
    fn trace_tile(frame: &Frame<'_>, tile: &mut Tile) -> Stats;
}

/// Work that is compiled once per integrator.
pub(crate) trait IntegratorVisitor {
    /// The result of the work.
    type Output;

    /// Works with an integrator.
    fn visit<I: Integrate>(self) -> Self::Output;
}

/// Declares the types that implement the integrators, by the names that the enum has for them.
macro_rules! integrators {
    ($($file:ident::$name:ident),+ $(,)?) => {
        /// Calls a visitor with the type that implements an integrator.
        pub(crate) fn visit<V: IntegratorVisitor>(integrator: Integrator, visitor: V) -> V::Output {
            match integrator { $(Integrator::$name => visitor.visit::<$file::$name>()),+ }
        }
    };
}

integrators!(whitted::Whitted, path::Path, occlusion::Occlusion);

/// Traces all pixels of a tile with packets of rays, by the rules of the view's integrator.
pub(crate) fn trace_packets(frame: &Frame<'_>, tile: &mut Tile) -> Stats {
    visit(frame.view.integrator, Packets { frame, tile })
}

struct Packets<'a> {
    frame: &'a Frame<'a>,
    tile: &'a mut Tile,
}

impl IntegratorVisitor for Packets<'_> {
    type Output = Stats;

    fn visit<I: Integrate>(self) -> Stats {
        I::trace_tile(self.frame, self.tile)
    }
}
