//! Rays against the triangles of a mesh: bundles of rays through one point or side by side, or single rays, each against eight boxes
//! and eight triangles at a time.
//!
//! Both skip what they miss for certain, in `f32` with error bounds. The rest is decided in `f64` with error bounds, and
//! by an [`ExactResolver`] where those do not decide either.

mod accept;
mod bundle;
mod bundled_rays;
mod common;
mod common_direction;
mod common_origin;
mod edges;
#[cfg(test)]
mod error_bounds_tests;
mod packets;
mod planes;
mod precise;
mod ray_bundle;
mod ray_setup;
mod single_ray;

use catoptra_core::{Ray, Span};
use fearless_simd::prelude::*;
use fearless_simd::{Simd, f32x8};

use crate::accel::{MAX_DEPTH, Node8, Planes, WIDTH, WideTree};
use crate::numeric::CERTAIN;

pub(crate) use bundle::{AnyBundle, Bundle};
pub(crate) use bundled_rays::BundledRays;
pub(crate) use common_direction::Starts;
pub(crate) use precise::LaneTriangles;
pub(crate) use ray_bundle::{Lines, RayBundle, Reach};
pub(crate) use ray_setup::{RaySetup, StartingRays};
pub(crate) use single_ray::ClosestHit;

use precise::{Verdict, crossing, depth, intersect};

/// As [`bound`](super::bound), of eight triangles.
#[inline(always)]
fn bound_eight<S: Simd>(s: S, error: f32x8<S>) -> f32x8<S> {
    if CERTAIN { error } else { f32x8::splat(s, 0.0) }
}

/// Decides exactly what error bounds leave open.
pub(crate) trait ExactResolver {
    /// The ray of a lane in the mesh's own space, and the span of it that is searched.
    fn ray(&mut self, lane: usize) -> Option<(Ray, Span)>;

    /// Whether rays that leave a triangle leave another with it, as both lie in one plane. Their starts are rounded and stand
    /// beside that plane by what `f64` may tell from zero, but `f32` never does: only what it leaves open is asked.
    fn leaves(&self, left: u32, facet: u32) -> bool;

    /// The `t` at which the ray of a lane meets a triangle, if that lies before its nearest hit so far: the triangle
    /// `held`, or else the hit it came with.
    fn decide(&mut self, lane: usize, facet: u32, held: Option<u32>) -> Option<f64>;
}

/// The decision in `f64` about a triangle that `f32` has left open.
enum Decision {
    NotNearer,
    /// It is the nearest hit, at that `t`.
    Nearer(f64),
    /// Only exact arithmetic can decide.
    Open,
}

/// Whether a ray passes within the edges of a triangle.
#[derive(Clone, Copy)]
enum Edges {
    /// The ray passes within all of them.
    Inside,
    Open,
}

/// A ray and a triangle that may be its nearest hit.
struct RayTriangle<'a> {
    ray: &'a Ray,
    /// The span that counts.
    span: Span,
    corners: &'a [[f32; 3]; 3],
    edges: Edges,
}

/// Decides in `f64` whether a triangle is nearer than the one that a ray has met (`held`), or than the least `t` at which
/// it may have met anything else (`before`).
fn decide(test: &RayTriangle<'_>, held: Option<[[f32; 3]; 3]>, before: f64) -> Decision {
    let RayTriangle { ray, span, corners, edges } = *test;
    let verdict = match edges {
        Edges::Inside => crossing(corners, ray),
        Edges::Open => intersect(corners, ray),
    };
    let (t, error) = match verdict {
        Verdict::Miss => return Decision::NotNearer,
        Verdict::Open => return Decision::Open,
        Verdict::Hit(t, error) => (t, error),
    };
    if t + error < span.min || t - error > span.max {
        return Decision::NotNearer;
    }
    if !(t - error > span.min && t + error < span.max) {
        return Decision::Open;
    }
    let (low, high) = match held.map(|held| depth(&held, ray)) {
        Some((t, error)) => (t - error, t + error),
        None => (before, f64::INFINITY),
    };
    if t + error < low {
        Decision::Nearer(t)
    } else if t - error > high {
        Decision::NotNearer
    } else {
        Decision::Open
    }
}

/// The most packets of rays that walk a tree together.
pub(crate) const GROUP: usize = 16;

/// A child that is still to be visited.
#[derive(Clone, Copy, Default)]
struct Visit {
    /// At most the depth at which rays enter its box.
    near: f32,
    link: u32,
    /// Triangles of a leaf; 0 for a node.
    count: u32,
    /// Which packets of a group may enter it, bit by bit.
    packets: u32,
}

impl Visit {
    /// Of a child that is entered at that depth at least; prefetches it.
    #[inline(always)]
    fn ahead(tree: &WideTree, node: &Node8, child: usize, near: &[f32; WIDTH]) -> Self {
        let child = child % WIDTH;
        let (link, count) = (node.link[child], u32::from(node.count[child]));
        tree.prefetch(link, count);
        Self { near: near[child], link, count, packets: 1 }
    }

    /// The blocks that hold a leaf's triangles.
    #[inline(always)]
    fn blocks<'a>(&self, tree: &'a WideTree) -> impl Iterator<Item = LeafBlock<'a>> + use<'a> {
        let first = self.link as usize;
        let mut own = ((1_u64 << (self.count % u64::BITS)) - 1) << (first % WIDTH);
        (first / WIDTH..).map_while(move |block| {
            let here = own & ((1 << WIDTH) - 1);
            own >>= WIDTH;
            (here != 0).then_some(LeafBlock { tree, block, own: here })
        })
    }
}

/// A block of a tree, and which of its triangles belong to a leaf.
#[derive(Clone, Copy)]
pub(crate) struct LeafBlock<'a> {
    tree: &'a WideTree,
    block: usize,
    /// The leaf's triangles, bit by bit.
    own: u64,
}

impl LeafBlock<'_> {
    /// The slot of one of its triangles in the tree's blocks.
    #[inline(always)]
    fn slot(&self, at: usize) -> u32 {
        (self.block * WIDTH + at) as u32
    }
}

/// Capacity of the stack of children still to visit: fewer than eight for each of [`MAX_DEPTH`] levels; a power of two.
const ROOM: usize = 512;
const _: () = assert!(ROOM > MAX_DEPTH * (WIDTH - 1));

/// The stack and counters of walks, kept from walk to walk.
#[derive(Default)]
pub(crate) struct Visits {
    stack: Vec<Visit>,
    /// Nodes and blocks that have been looked at.
    pub(crate) nodes: u64,
    pub(crate) blocks: u64,
    /// Whether triangles in one plane are each held against a ray, even where their planes are numbered.
    pub(crate) one_by_one: bool,
}

/// A tree to be walked, with the stack and counters for that.
pub(crate) struct TreeWalk<'a> {
    pub(crate) tree: &'a WideTree,
    pub(crate) visits: &'a mut Visits,
}

impl Visits {
    /// The numbers of a tree's planes that walks go by, if any.
    #[inline(always)]
    fn planes_of<'a>(&self, tree: &'a WideTree) -> Option<&'a Planes> {
        tree.planes.known().filter(|_| !self.one_by_one)
    }

    /// An empty stack of children to be visited.
    #[inline(always)]
    fn start(&mut self) -> Option<Waiting<'_>> {
        if self.stack.is_empty() {
            self.stack.resize(ROOM, Visit::default());
        }
        let stack = self.stack.first_chunk_mut()?;
        Some(Waiting { stack, depth: 0, nodes: &mut self.nodes, blocks: &mut self.blocks })
    }
}

/// Children to be visited, the next one last.
struct Waiting<'a> {
    stack: &'a mut [Visit; ROOM],
    depth: usize,
    nodes: &'a mut u64,
    blocks: &'a mut u64,
}

impl Waiting<'_> {
    #[inline(always)]
    fn push(&mut self, visit: Visit) {
        self.stack[self.depth % ROOM] = visit;
        self.depth += 1;
    }

    /// The next child that is entered up to a depth.
    #[inline(always)]
    fn pop(&mut self, far: f32) -> Option<Visit> {
        while self.depth > 0 {
            self.depth -= 1;
            let visit = self.stack[self.depth % ROOM];
            if visit.near <= far {
                return Some(visit);
            }
        }
        None
    }

    /// Adds a child below the nearer ones of its siblings, which begin at `first`.
    #[inline(always)]
    fn insert(&mut self, first: usize, visit: Visit) {
        let mut at = self.depth;
        while at > first && self.stack[(at - 1) % ROOM].near < visit.near {
            self.stack[at % ROOM] = self.stack[(at - 1) % ROOM];
            at -= 1;
        }
        self.stack[at % ROOM] = visit;
        self.depth += 1;
    }
}
