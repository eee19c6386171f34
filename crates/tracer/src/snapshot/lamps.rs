//! Which surfaces light others, and the outlines of all that may stand in their way.

use std::collections::HashMap;

use catoptra_core::contour::{self, Blocker};
use catoptra_core::glam::DVec3;
use catoptra_core::{Constant3, Emission, Lamp, Shape};

use super::lamp_tree::LampTree;
use super::{Ball, Prim};

/// A surface of one outline that shines: a light, or a piece of one.
#[derive(Debug, Clone)]
pub(crate) struct LampRow {
    /// In the snapshot's frame.
    pub(crate) outline: contour::Lamp,
    /// W/(m²·sr) per channel.
    pub(crate) radiance: Constant3,
    /// The shape that it is a piece of; none for a light that is not seen.
    pub(crate) prim: Option<u32>,
    /// Whether things throw shadows in its light.
    pub(crate) shadow: bool,
    /// A ball round it, relative to the snapshot's origin.
    pub(crate) ball: Ball,
    /// What it is like if it is flat and has straight edges.
    pub(crate) flat: Option<FlatLamp>,
    /// Its unit normal if it is flat, on its lit side or on either.
    pub(crate) normal: Option<DVec3>,
    pub(crate) two_sided: bool,
    /// Square metres on each side.
    pub(crate) area: f64,
}

/// A flat lamp with straight edges, relative to the snapshot's origin.
#[derive(Debug, Clone, Copy)]
pub(crate) struct FlatLamp {
    corners: [DVec3; 4],
    count: usize,
    /// Unit normal on its lit side, from where the corners run counter-clockwise.
    pub(crate) normal: DVec3,
}

impl FlatLamp {
    /// Three or four.
    #[inline(always)]
    pub(crate) fn corners(&self) -> &[DVec3] {
        &self.corners[..self.count]
    }
}

/// Up to so many lamps every point asks each of them; of more it asks some, picked at random.
pub(crate) const MOST_LAMPS: usize = 1000;

/// Points of paths ask up to so many lamps one by one, and of more some that a tree picks.
const MOST_LAMPS_OF_PATHS: usize = 64;

/// How a material shines.
#[derive(Debug, Clone, Copy)]
pub(super) struct Shining {
    pub(super) emission: Emission,
    /// Whether things throw shadows in its light.
    pub(super) shadow: bool,
}

/// All lamps of a snapshot.
#[derive(Debug, Default)]
pub(crate) struct Lamps {
    pub(crate) rows: Vec<LampRow>,
    /// The outlines of all shapes that may block their light, in the snapshot's frame; none of a mesh, or where there is
    /// no lamp.
    pub(crate) blockers: Vec<Option<Blocker>>,
    /// Picks some of them, where they are too many to ask each.
    pub(crate) tree: Option<LampTree>,
    /// Picks some of them for paths, which ask less of each point, where the other does not.
    tree_of_paths: Option<LampTree>,
    /// Shapes that shine but light nothing, as they have no end.
    pub(crate) endless: Vec<u32>,
    /// Shapes that shine and whose outlines are not known: only paths that meet them bring their light.
    pub(crate) met_alone: Vec<u32>,
    /// Square metres of each shape that lights others, one side of it.
    pub(crate) areas: HashMap<u32, f64>,
}

/// The outline of a shape that may block light; none of a part of a solid.
fn blocker_of(prim: &Prim) -> Option<Blocker> {
    if prim.member.is_some() { None } else { Blocker::of(&prim.shape) }
}

impl Lamps {
    /// Of shapes whose materials have lights of their own, and of lights that are no bodies; `origin` is the snapshot's, in its frame.
    pub(super) fn new(
        prims: &[Prim],
        shining: impl Fn(u32) -> Option<Shining>,
        unseen: &[Lamp],
        origin: DVec3,
    ) -> Self {
        let mut lamps = Self::default();
        for (prim, id) in prims.iter().zip(0..) {
            if let Some(shining) = shining(prim.material) {
                if prim.member.is_some() {
                    lamps.met_alone.push(id);
                    continue;
                }
                lamps.add(&prim.shape, shining, Some(id), origin);
            }
        }
        for lamp in unseen {
            lamps.add(&lamp.shape, Shining { emission: lamp.emission, shadow: lamp.shadow }, None, origin);
        }
        for row in &lamps.rows {
            if let Some(prim) = row.prim {
                *lamps.areas.entry(prim).or_default() += row.area;
            }
        }
        let count = lamps.rows.len();
        if count > MOST_LAMPS {
            lamps.tree = Some(lamps.new_tree());
        } else if count > 0 {
            lamps.blockers = prims.iter().map(blocker_of).collect();
            lamps.tree_of_paths = (count > MOST_LAMPS_OF_PATHS).then(|| lamps.new_tree());
        }
        lamps
    }

    fn new_tree(&self) -> LampTree {
        let power = |row: &LampRow| (row.ball, row.radiance.rgb().luminance() * row.outline.area());
        LampTree::new(&self.rows.iter().map(power).collect::<Vec<_>>())
    }

    /// What picks the lamps that points of paths ask, if these do not ask all.
    pub(crate) fn tree_of_paths(&self) -> Option<&LampTree> {
        self.tree.as_ref().or(self.tree_of_paths.as_ref())
    }

    /// Those that every point asks: all, or none where they are so many that some are picked.
    pub(crate) fn asked(&self) -> &[LampRow] {
        if self.tree.is_some() { &[] } else { &self.rows }
    }

    fn add(
        &mut self,
        shape: &Shape,
        Shining { emission, shadow }: Shining,
        prim: Option<u32>,
        origin: DVec3,
    ) {
        if !(emission.radiance.max_channel() > 0.0) {
            return;
        }
        let radiance = emission.radiance.into();
        let before = self.rows.len();
        for outline in contour::Lamp::pieces_of(shape) {
            let outline = outline.with_two_sides(emission.two_sided);
            let (center, radius) = outline.ball();
            let ball = Ball { center: center - origin, radius };
            let flat = outline.corners().map(|(corners, normal)| {
                let mut placed = [corners[0] - origin; 4];
                placed.iter_mut().zip(corners).for_each(|(placed, corner)| *placed = *corner - origin);
                FlatLamp { corners: placed, count: corners.len(), normal }
            });
            let (normal, two_sided) = (outline.normal(), emission.two_sided && outline.normal().is_some());
            let area = outline.area() / if two_sided { 2.0 } else { 1.0 };
            self.rows.push(LampRow { outline, radiance, prim, shadow, ball, flat, normal, two_sided, area });
        }
        if let (true, Some(prim)) = (self.rows.len() == before, prim) {
            let list = if shape.bounds().is_some() { &mut self.met_alone } else { &mut self.endless };
            list.push(prim);
        }
    }
}
