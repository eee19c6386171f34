//! Counts of what a render did: rays, tests, skipped work.

use catoptra_core::exact;
use serde::Serialize;

/// Rays traced, by kind.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize)]
pub struct Rays {
    /// From the camera.
    pub primary: u64,
    /// From a surface to a light.
    pub shadow: u64,
    /// From a surface to a point of a lamp.
    pub lamp: u64,
    /// From a mirroring surface.
    pub reflection: u64,
    /// From a surface to the sky.
    pub occlusion: u64,
}

/// Tests of rays against things, by kind.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize)]
pub struct Tests {
    /// Against shapes and mesh triangles.
    pub shapes: u64,
    /// Against boxes of a tree.
    pub boxes: u64,
}

/// Rays not traced, by reason.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize)]
pub struct Skipped {
    /// Camera rays: no shape can be seen through their part of the picture.
    pub nothing_seen: u64,
    /// Of those, rays through pixels that were not written, as they showed nothing before.
    pub blank_before: u64,
    /// Shadow rays: their whole part of the picture lies outside the light's cone.
    pub unreached: u64,
    /// Shadow rays: the surface faces away from the light.
    pub facing_away: u64,
    /// Shadow rays: the point lies outside the light's cone.
    pub out_of_cone: u64,
    /// Shadow rays: the light throws no shadows.
    pub shadow_off: u64,
    /// Shadow rays: the material shows no light of its own.
    pub unlit_material: u64,
    /// Shadow rays answered without tracing: nothing lies between the tile's surfaces and the light.
    pub nothing_between: u64,
    /// Reflection rays: nothing but darkness lies where the rays of their stream go.
    pub nothing_ahead: u64,
    /// Reflection rays: the surface reflects nothing.
    pub not_reflective: u64,
    /// Reflection rays: deep enough already.
    pub depth_limit: u64,
    /// Reflection rays: too faint to matter.
    pub weight_cutoff: u64,
    /// Occlusion rays: they would go below the surface, to where a smooth normal leads.
    pub below_surface: u64,
}

/// Points on which a lamp shines, by how its light was found; each lamp is counted for itself.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize)]
pub struct LampStats {
    /// None of it is above the surface, or the lamp shines the other way.
    pub facing_away: u64,
    /// All of it is seen: closed form.
    pub open: u64,
    /// None of it is seen past what stands between: closed form.
    pub dark: u64,
    /// Some of it is seen past one ball, found in vector lanes: closed form.
    pub past_a_ball: u64,
    /// Some of it is seen past other shapes, or several: closed form.
    pub partly: u64,
    /// By rays.
    pub sampled: u64,
}

/// Pixels that are shown by the pieces that outlines part them into.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize)]
pub struct EdgePixels {
    /// Parted by straight cuts, each piece shown through its centroid.
    pub parted: u64,
    /// With outlines that are too many or bend too much for that: quartered until they are not.
    pub quartered: u64,
    /// Sampled, as not all that may end in them is known.
    pub sampled: u64,
    /// Rays through pieces, and samples.
    pub pieces: u64,
}

/// Answers by exact arithmetic, by what was asked.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize)]
pub struct ExactKinds {
    /// On which side of a line an edge passes, or whether points lie in one plane.
    pub sides: u64,
    /// Whether and where a ray meets a surface.
    pub places: u64,
    /// Which of two surfaces comes first.
    pub orders: u64,
}

/// Counts of one render, or of a part of it.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize)]
pub struct Stats {
    /// Rays traced.
    pub rays: Rays,
    /// Tests made.
    pub tests: Tests,
    /// Light of lamps.
    pub lamps: LampStats,
    /// Rays not traced.
    pub skipped: Skipped,
    /// Pixels that outlines cross, where they are shown exactly.
    pub edges: EdgePixels,
    /// Answers that `f32` could not decide and `f64` did.
    pub settled: u64,
    /// Answers that `f64` could not decide and exact arithmetic did.
    pub exact: u64,
    /// What was asked there.
    pub exact_kinds: ExactKinds,
    /// Triangles that rays were seen to meet at one point, in an edge, a corner or a plane that they share: their order
    /// had not to be worked out.
    pub ties: u64,
    /// Radiances that were not finite: what was past every number became the largest, what was no number black.
    pub not_finite: u64,
}

macro_rules! add_fields {
    ($type:ident: $($field:ident),+) => {
        impl std::ops::AddAssign for $type {
            fn add_assign(&mut self, other: Self) {
                $(self.$field += other.$field;)+
            }
        }
    };
}

add_fields!(Rays: primary, shadow, lamp, reflection, occlusion);
add_fields!(Tests: shapes, boxes);
add_fields!(Skipped:
    nothing_seen, blank_before, unreached, facing_away, out_of_cone, shadow_off, unlit_material, nothing_between, nothing_ahead, not_reflective,
    depth_limit, weight_cutoff, below_surface);
add_fields!(LampStats: facing_away, open, dark, past_a_ball, partly, sampled);
add_fields!(EdgePixels: parted, quartered, sampled, pieces);
add_fields!(ExactKinds: sides, places, orders);
add_fields!(Stats: rays, tests, lamps, skipped, edges, settled, exact, exact_kinds, ties, not_finite);

impl Stats {
    /// The counts of some work on this thread, and how many of its questions exact arithmetic has answered, by kind.
    pub(crate) fn with_exact(work: impl FnOnce() -> Self) -> Self {
        let before = exact::answers();
        let mut stats = work();
        let exact::Answers { exact, sides, orders, ties } = exact::answers() - before;
        stats.exact += exact;
        stats.exact_kinds += ExactKinds { sides, orders, places: exact - sides - orders };
        stats.ties += ties;
        stats
    }
}

impl Rays {
    /// All rays traced.
    #[must_use]
    pub const fn total(&self) -> u64 {
        self.primary + self.shadow + self.lamp + self.reflection + self.occlusion
    }
}
