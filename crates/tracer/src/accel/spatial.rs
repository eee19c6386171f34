//! Spatial splits: nodes are split by cutting space, so that a triangle across the cut goes to both sides.
//!
//! Stich, Friedrich and Dietrich, "Spatial Splits in Bounding Volume Hierarchies", HPG 2009. Each side keeps a box round
//! that part of a triangle that lies there, never too small ([`halves`]), so a ray finds every point of it in some leaf.

use catoptra_core::TriangleMesh;
use rayon::prelude::*;

use super::Box32;
use super::bins::{Item, weight};
use super::clip::halves;

/// Slices along an axis.
const SLICES: usize = 32;

/// Parallel planes that cut a box into slices as thick as each other.
#[derive(Clone, Copy)]
struct Planes {
    axis: usize,
    low: f32,
    step: f32,
}

impl Planes {
    /// `None` where the box is flat, or too large for `f32`.
    fn across(around: &Box32, axis: usize) -> Option<Self> {
        let step = (around.max[axis] - around.min[axis]) / SLICES as f32;
        (step > 0.0 && step.is_finite()).then_some(Self { axis, low: around.min[axis], step })
    }

    /// Where a slice begins; not before where the one before it does.
    fn start_of(&self, slice: usize) -> f32 {
        self.low + self.step * slice as f32
    }

    /// The first slice and the last that a box reaches into. It lies past the planes up to the first and before those
    /// after the last; a box in a plane lies past it.
    fn slices(&self, bounds: &Box32) -> (usize, usize) {
        let (low, high) = (bounds.min[self.axis], bounds.max[self.axis]);
        let near = |v: f32| (((v - self.low) / self.step) as usize).min(SLICES - 1);
        let (mut first, mut last) = (near(low), near(high));
        // The quotients may be off by a rounding; the planes are what counts.
        while first > 0 && self.start_of(first) > low {
            first -= 1;
        }
        while first + 1 < SLICES && self.start_of(first + 1) <= low {
            first += 1;
        }
        while last > first && self.start_of(last) >= high {
            last -= 1;
        }
        while last + 1 < SLICES && self.start_of(last + 1) < high {
            last += 1;
        }
        (first, last.max(first))
    }
}

/// What reaches into each slice.
#[derive(Clone)]
struct Slices {
    around: [Box32; SLICES],
    /// How many triangles reach into this slice, but none before it.
    entering: [usize; SLICES],
    /// How many reach into none after it.
    leaving: [usize; SLICES],
}

impl Slices {
    const NONE: Self = Self { around: [Box32::EMPTY; SLICES], entering: [0; SLICES], leaving: [0; SLICES] };

    fn add(&mut self, planes: &Planes, mesh: &TriangleMesh, item: &Item) {
        let mut rest = item.bounds();
        let (first, last) = planes.slices(&rest);
        self.entering[first] += 1;
        self.leaving[last] += 1;
        if first < last {
            let corners = mesh.corners(item.id());
            for slice in first..last {
                let [before, past] = halves(&corners, &rest, planes.axis, planes.start_of(slice + 1));
                self.around[slice] = self.around[slice].union(&before);
                rest = past;
            }
        }
        self.around[last] = self.around[last].union(&rest);
    }

    fn with(mut self, o: &Self) -> Self {
        for slice in 0..SLICES {
            self.around[slice] = self.around[slice].union(&o.around[slice]);
            self.entering[slice] += o.entering[slice];
            self.leaving[slice] += o.leaving[slice];
        }
        self
    }
}

/// A plane that cuts a set, with what would stand on either side.
#[derive(Clone, Copy)]
pub(super) struct Cut {
    planes: Planes,
    slice: usize,
    around: [Box32; 2],
    counts: [usize; 2],
    /// Surface areas times weights, of both parts.
    pub(super) cost: f32,
}

/// The cheapest cut of triangles in a box that adds at most `room` triangles; threads share out the triangles in
/// stretches of `stretch`.
pub(super) fn cheapest_cut(
    mesh: &TriangleMesh,
    items: &[Item],
    around: &Box32,
    room: usize,
    stretch: usize,
) -> Option<Cut> {
    let mut best: Option<Cut> = None;
    for planes in (0..3).filter_map(|axis| Planes::across(around, axis)) {
        let of_stretch = |items: &[Item]| {
            let mut slices = Slices::NONE;
            for item in items {
                slices.add(&planes, mesh, item);
            }
            slices
        };
        let slices = if items.len() <= stretch {
            of_stretch(items)
        } else {
            items.par_chunks(stretch).map(of_stretch).reduce(|| Slices::NONE, |a, b| a.with(&b))
        };
        sweep(&planes, &slices, items.len() + room, &mut best);
    }
    best
}

/// Weighs the cuts between slices, from both ends.
fn sweep(planes: &Planes, slices: &Slices, most: usize, best: &mut Option<Cut>) {
    let mut others = [(Box32::EMPTY, 0); SLICES];
    let (mut around, mut count) = (Box32::EMPTY, 0);
    for slice in (1..SLICES).rev() {
        (around, count) = (around.union(&slices.around[slice]), count + slices.leaving[slice]);
        others[slice] = (around, count);
    }
    (around, count) = (Box32::EMPTY, 0);
    for (slice, (other, past)) in others.into_iter().enumerate().skip(1) {
        (around, count) = (around.union(&slices.around[slice - 1]), count + slices.entering[slice - 1]);
        let cost = around.half_area() * weight(count) + other.half_area() * weight(past);
        let fits = count != 0 && past != 0 && count + past <= most;
        if fits && cost < best.map_or(f32::INFINITY, |best| best.cost) {
            let (around, counts) = ([around, other], [count, past]);
            *best = Some(Cut { planes: *planes, slice, around, counts, cost });
        }
    }
}

impl Cut {
    /// The triangles before the plane and those past it; a triangle across the plane goes to one side as a whole where
    /// that is cheaper.
    pub(super) fn share_out(&self, mesh: &TriangleMesh, items: &[Item]) -> [Vec<Item>; 2] {
        let mut parts = self.counts.map(Vec::with_capacity);
        for item in items {
            let (first, last) = self.planes.slices(&item.bounds());
            match (first < self.slice, last >= self.slice) {
                (true, true) => {
                    let sides = self.sides(mesh, item);
                    for (part, side) in parts.iter_mut().zip(sides) {
                        part.extend(side);
                    }
                }
                (before, _) => parts[usize::from(!before)].push(*item),
            }
        }
        parts
    }

    /// The parts of a triangle across the plane on either side.
    fn sides(&self, mesh: &TriangleMesh, item: &Item) -> [Option<Item>; 2] {
        let bounds = item.bounds();
        let start = self.planes.start_of(self.slice);
        let [before, past] = halves(&mesh.corners(item.id()), &bounds, self.planes.axis, start);
        let whole = [[Some(*item), None], [None, Some(*item)]];
        let areas = self.around.map(|b| b.half_area());
        let counts = self.counts.map(|count| count as f32);
        let alone = |side: usize| {
            let other = 1 - side;
            self.around[side].union(&bounds).half_area() * counts[side] + areas[other] * (counts[other] - 1.0)
        };
        let (in_first, in_second) = (alone(0), alone(1));
        if in_first.min(in_second) <= self.cost {
            return whole[usize::from(in_second < in_first)];
        }
        match (before.is_empty(), past.is_empty()) {
            (false, false) => [Some(item.within(&before)), Some(item.within(&past))],
            (true, false) => [None, Some(item.within(&past))],
            (false, true) => [Some(item.within(&before)), None],
            (true, true) => whole[0],
        }
    }
}
