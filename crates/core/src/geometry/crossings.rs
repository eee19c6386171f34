//! Where does a line run inside a closed surface of triangles, convex or not?
//!
//! The line comes in or goes out wherever it crosses a triangle, and how often it has come in more than gone out tells whether
//! it is inside. A line through an edge or a corner must count once for all triangles there: so it is counted as if it
//! stood beside its place, moved along one axis by a step smaller than any number, and along another by a far smaller one
//! (Edelsbrunner and Mücke, "Simulation of Simplicity", ACM Transactions on Graphics 9, 1990). Of these steps only signs are
//! needed, which are exact. A triangle that the line runs along is never crossed, and as of convex shapes what the line
//! runs along is inside.

use std::cmp::Ordering;

use glam::DVec3;
use smallvec::SmallVec;

use super::triangle::{area, passes_by};
use crate::Ray;
use crate::exact::{Number, Root, Vector, Verdict};
use crate::solid::{End, Passage};

/// What a line meets of a surface, in order.
pub(super) struct Crossings<'a, N> {
    ray: &'a Ray,
    /// Along which the line is moved: with its direction they span all space.
    axes: [usize; 2],
    met: SmallVec<[Met<N>; 8]>,
}

/// A place on a line.
struct Met<N> {
    root: Root<N>,
    facet: u32,
    what: What,
}

/// What happens there.
#[derive(Clone, Copy)]
enum What {
    /// The line meets a triangle, running inwards or outwards; of those that share the place one or none counts.
    Crosses { inwards: bool, counts: bool },
    /// The line begins to run along a triangle.
    Joins,
    /// It does so no more.
    Parts,
}

impl<'a, N: Number> Crossings<'a, N> {
    /// Of nothing so far.
    pub(super) fn new(ray: &'a Ray) -> Self {
        let size = ray.direction.abs();
        let along = (0..3).max_by(|&i, &j| size[i].total_cmp(&size[j])).unwrap_or(0);
        Self { ray, axes: [(along + 1) % 3, (along + 2) % 3], met: SmallVec::new() }
    }

    /// Adds a triangle, wound anticlockwise as seen from outside.
    ///
    /// # Errors
    /// When such numbers cannot decide.
    pub(super) fn add(&mut self, corners: &[DVec3; 3], facet: u32) -> Verdict<()> {
        if passes_by(corners, self.ray) {
            return Ok(());
        }
        let (origin, direction) = (Vector::<N>::of(self.ray.origin), Vector::of(self.ray.direction));
        let from = corners.map(|p| Vector::of(p).minus(&origin));
        let edges = [(0, 1), (1, 2), (2, 0)];
        let volumes = edges.map(|(i, j)| from[i].cross(&from[j]).dot(&direction).sign());
        if volumes.contains(&Ok(Ordering::Less)) && volumes.contains(&Ok(Ordering::Greater)) {
            return Ok(());
        }
        let normal = area::<N>(corners);
        let slope = normal.dot(&direction);
        let Some(root) = Root::ratio(&normal.dot(&from[0]), &slope)? else {
            for volume in volumes {
                if volume?.is_ne() {
                    return Ok(());
                }
            }
            return self.add_along(&from, &normal, &direction, facet);
        };
        let way = slope.sign()?;
        let mut counts = true;
        for (volume, (i, j)) in volumes.into_iter().zip(edges) {
            let side = match volume? {
                Ordering::Equal => self.side_beside(&[corners[i], corners[j]], &direction)?,
                side => side,
            };
            counts &= side == way;
        }
        self.insert(Met { root, facet, what: What::Crosses { inwards: way.is_lt(), counts } })
    }

    /// On which side of an edge that the line meets it runs once it is moved.
    fn side_beside(&self, [p, q]: &[DVec3; 2], direction: &Vector<N>) -> Verdict<Ordering> {
        let changes = Vector::of(*p).minus(&Vector::of(*q)).cross(direction);
        let changes = [&changes.x, &changes.y, &changes.z];
        let first = changes[self.axes[0]].sign()?;
        Ok(if first.is_eq() { changes[self.axes[1]].sign()? } else { first })
    }

    /// Adds the stretch of a line that runs within the plane of a triangle, whose corners are seen from the ray's origin.
    fn add_along(
        &mut self,
        from: &[Vector<N>; 3],
        normal: &Vector<N>,
        direction: &Vector<N>,
        facet: u32,
    ) -> Verdict<()> {
        let length2 = direction.squared();
        // How far each corner lies beside the line, and how far along it.
        let beside = [0, 1, 2].map(|i| normal.dot(&from[i].cross(direction)));
        let along = [0, 1, 2].map(|i| from[i].dot(direction));
        let mut places: SmallVec<[Root<N>; 3]> = SmallVec::new();
        for (i, j) in [(0, 1), (1, 2), (2, 0)] {
            let (start, end) = (beside[i].sign()?, beside[j].sign()?);
            if start.is_eq() {
                places.extend(Root::ratio(&along[i], &length2)?);
            } else if end == start.reverse() {
                let weighed = beside[i].times(&along[j]).minus(&beside[j].times(&along[i]));
                places.extend(Root::ratio(&weighed, &beside[i].minus(&beside[j]).times(&length2))?);
            }
        }
        let Some(mut low) = places.pop() else { return Ok(()) };
        let mut high = low.clone();
        for place in places {
            if place.compare(&low)?.is_lt() {
                low = place;
            } else if place.compare(&high)?.is_gt() {
                high = place;
            }
        }
        if low.compare(&high)?.is_eq() {
            return Ok(());
        }
        self.insert(Met { root: low, facet, what: What::Joins })?;
        self.insert(Met { root: high, facet, what: What::Parts })
    }

    fn insert(&mut self, met: Met<N>) -> Verdict<()> {
        let (mut low, mut high) = (0, self.met.len());
        while low < high {
            let middle = usize::midpoint(low, high);
            if self.met[middle].root.compare(&met.root)?.is_gt() {
                high = middle;
            } else {
                low = middle + 1;
            }
        }
        self.met.insert(low, met);
        Ok(())
    }

    /// Where the line runs inside the surface, of which all triangles have been added that it may meet.
    ///
    /// # Errors
    /// When such numbers cannot decide.
    pub(super) fn passage(&self) -> Verdict<Passage<N>> {
        let (mut passage, mut is_inside) = (Passage::by(), false);
        let (mut turns, mut runs_along) = (0_i32, 0_i32);
        let mut rest = self.met.as_slice();
        while let Some(first) = rest.first() {
            let mut count = 1;
            while count < rest.len() && rest[count].root.compare(&first.root)?.is_eq() {
                count += 1;
            }
            let (here, later) = rest.split_at(count);
            rest = later;
            let turn: i32 = here.iter().map(|met| met.what.turn()).sum();
            turns += turn;
            runs_along += here.iter().map(|met| met.what.along()).sum::<i32>();
            let was_inside = std::mem::replace(&mut is_inside, turns != 0 || runs_along > 0);
            if is_inside == was_inside {
                continue;
            }
            let inwards = if turn == 0 { is_inside } else { turn > 0 };
            let facets = here.iter().map(|met| (met.what.rank(inwards), met.facet));
            let facet = facets.min().map_or(first.facet, |(_, facet)| facet);
            passage.ends.push(End { root: first.root.clone(), facet });
        }
        Ok(passage)
    }
}

impl What {
    /// How often the line comes in, less how often it goes out.
    fn turn(self) -> i32 {
        match self {
            Self::Crosses { inwards, counts: true } => {
                if inwards {
                    1
                } else {
                    -1
                }
            }
            _ => 0,
        }
    }

    /// How many triangles more the line runs along.
    fn along(self) -> i32 {
        match self {
            Self::Crosses { .. } => 0,
            Self::Joins => 1,
            Self::Parts => -1,
        }
    }

    /// How well a triangle stands for a place where the line turns inwards or outwards, best first.
    fn rank(self, turns_inwards: bool) -> u32 {
        match self {
            Self::Crosses { inwards, counts } if inwards == turns_inwards => u32::from(!counts),
            Self::Crosses { .. } => 2,
            Self::Joins | Self::Parts => 3,
        }
    }
}
