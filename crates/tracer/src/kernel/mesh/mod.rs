//! How rays find triangles of a mesh: many from one point at once, or one against eight boxes and eight triangles.
//!
//! Both pass over what they are certain to miss, in `f32` with bounds. What remains is decided in `f64` with bounds, and
//! by an [`Umpire`] where those do not decide either.

mod bundle;
mod edges;
mod fan;
mod lone;
mod precise;

use catoptra_core::{Ray, Span};

use crate::accel::{Node8, WIDTH};
use crate::lanes::Bits;

pub(crate) use bundle::Lines;
pub(crate) use fan::{Fan, FanRays};
pub(crate) use lone::{Lone, LoneBest};
pub(crate) use precise::LaneCorners;

use precise::{Verdict, depth, meet};

/// Decides for certain what bounds leave open.
pub(crate) trait Umpire {
    /// The ray of a lane in the mesh's own space, and the stretch of it that is asked about.
    fn ray(&mut self, lane: usize) -> Option<(Ray, Span)>;

    /// Whether the ray of a lane meets a triangle before what it has met so far, the triangle `held` or else what it came
    /// with; at which `t` if so.
    fn decide(&mut self, lane: usize, facet: u32, held: Option<u32>) -> Option<f64>;
}

/// What `f64` makes of a triangle that `f32` could not decide about.
enum Settled {
    Not,
    /// At that `t`, in front of all else.
    Nearer(f64),
    /// Only the umpire can tell.
    Open,
}

/// Compares a triangle with the one a ray has met, or with the least `t` at which it may have met anything else.
fn settle(
    next: &[[f32; 3]; 3],
    held: Option<[[f32; 3]; 3]>,
    before: f64,
    (ray, span): (&Ray, Span),
) -> Settled {
    let (t, error) = match meet(next, ray) {
        Verdict::Miss => return Settled::Not,
        Verdict::Open => return Settled::Open,
        Verdict::Hit(t, error) => (t, error),
    };
    if t + error < span.min || t - error > span.max {
        return Settled::Not;
    }
    if !(t - error > span.min && t + error < span.max) {
        return Settled::Open;
    }
    let (low, high) = match held.map(|held| depth(&held, ray)) {
        Some((t, error)) => (t - error, t + error),
        None => (before, f64::INFINITY),
    };
    if t + error < low {
        Settled::Nearer(t)
    } else if t - error > high {
        Settled::Not
    } else {
        Settled::Open
    }
}

/// A child that is still to be visited.
#[derive(Clone, Copy, Default)]
pub(crate) struct Visit {
    /// At most the depth at which rays enter its box.
    near: f32,
    link: u32,
    /// Triangles of a leaf; 0 for a node.
    count: u32,
}

/// Children to be visited, the next one last.
#[derive(Default)]
pub(crate) struct Visits {
    stack: Vec<Visit>,
    /// Nodes and blocks that have been looked at.
    pub(crate) nodes: u64,
    pub(crate) blocks: u64,
}

impl Visits {
    /// The root alone, in room that is kept from ray to ray.
    #[inline(always)]
    fn start(&mut self) {
        self.stack.clear();
        self.stack.push(Visit { near: 0.0, link: 0, count: 0 });
    }

    #[inline(always)]
    fn next(&mut self) -> Option<Visit> {
        self.stack.pop()
    }

    /// Adds some children of a node, entered at `near`, the nearest last.
    #[inline(always)]
    fn add_children(&mut self, node: &Node8, children: u64, near: [f32; WIDTH]) {
        let first = self.stack.len();
        for child in Bits(children) {
            let child = child % WIDTH;
            let (link, count) = (node.link[child], u32::from(node.count[child]));
            self.add(first, Visit { near: near[child], link, count });
        }
    }

    /// Adds a child below the nearer ones of its siblings, which begin at `first`.
    #[inline(always)]
    fn add(&mut self, first: usize, visit: Visit) {
        let mut at = self.stack.len();
        self.stack.push(visit);
        while at > first && self.stack[at - 1].near < visit.near {
            self.stack[at] = self.stack[at - 1];
            at -= 1;
        }
        self.stack[at] = visit;
    }
}
