//! Does a frustum keep all that camera rays meet, and is what fills it all that they meet?

use catoptra_core::glam::DVec3;
use catoptra_core::{Ray, Span};

use super::super::{Candidates, Frustum, quarters};
use super::parts::{one_in, one_of};
use super::stage::Stage;
use super::{depth_in, holds, narrowed};
use crate::random::Random;
use crate::{Frame, Hit, Region, Size, Snapshot};

/// Counts of what was tested, so that rare cases are known to occur.
#[derive(Debug, Default)]
struct Tally {
    hits: u32,
    /// Within a hundredth of a frustum's sides.
    at_border: u32,
    /// Of shapes that no other ray of the region met, but one.
    barely: u32,
    filled: u32,
    /// Frusta that one shape takes up for all rays tried but a few.
    nearly_filled: u32,
    empty: u32,
    in_faces: u32,
    /// Points near the border of their bounds, of spheres and planes.
    near_bounds: u32,
    by_tree: u32,
    from_within: u32,
    hidden_planes: u32,
}

/// A part of a picture, and what may be seen there.
struct Look<'a> {
    frame: &'a Frame<'a>,
    snapshot: &'a Snapshot,
    region: Region,
    seen: &'a Candidates,
    tally: &'a mut Tally,
}

impl Look<'_> {
    /// What a ray through a place meets, which must be among what may be seen.
    fn meet(&mut self, [x, y]: [f64; 2]) -> Option<Hit> {
        let ray = self.frame.raster.ray(x, y);
        let hit = self.snapshot.nearest_in_frame(&ray, Span::AHEAD, None);
        if let Some(hit) = &hit {
            let Region { x: left, y: top, size } = self.region;
            let off = |x: f64, from: u32, length: u32| {
                let share = (x - f64::from(from)) / f64::from(length);
                share.min(1.0 - share)
            };
            let border = off(x, left, size.width).min(off(y, top, size.height));
            self.tally.hits += 1;
            self.tally.at_border += u32::from(border < 0.01);
            self.check(&ray, hit);
        } else {
            assert!(!self.seen.filled, "a ray passes by what fills a frustum: {:?}", self.what(&ray));
        }
        hit
    }

    fn check(&mut self, ray: &Ray, hit: &Hit) {
        let prim = hit.surface.prim;
        let point = ray.at(hit.crossing.t) - self.snapshot.origin_in_frame();
        let held = holds(self.seen, self.snapshot, hit.surface) || self.is_on_face(prim, point);
        assert!(held, "{hit:?} is not among the candidates: {}", self.what(ray));
        assert!(
            !self.seen.is_empty() || !self.snapshot.columns().general_unbounded.is_empty(),
            "{}",
            self.what(ray)
        );
        let in_faces = self.seen.faces.iter().any(|&row| self.prim_of_face(row) == prim);
        self.tally.in_faces += u32::from(in_faces);
        if self.seen.points.is_empty() {
            assert!(!self.seen.filled, "{}", self.what(ray));
            return;
        }
        for point in [point, narrowed(point)] {
            let own = self.seen.points.iter().filter(|bounds| bounds.prim == prim);
            let depth = own.map(|bounds| depth_in(bounds, point)).fold(f64::INFINITY, f64::min);
            assert!(
                depth <= 1.0,
                "{depth} half sizes from the middle of its bounds: {hit:?} {}",
                self.what(ray)
            );
            self.tally.near_bounds += u32::from(depth > 0.97);
        }
        if self.seen.filled {
            let filler = match (&self.seen.planes[..], &self.seen.faces[..], &self.seen.bounded[..]) {
                ([row], [], []) => self.snapshot.columns().planes[*row as usize].prim,
                ([], [row], []) => self.prim_of_face(*row),
                ([], [], [prim]) => *prim,
                _ => panic!("more than one shape fills a frustum: {}", self.what(ray)),
            };
            assert_eq!(prim, filler, "{hit:?} before what fills a frustum: {}", self.what(ray));
        }
    }

    /// Whether a point lies on the edge of a face that is among the candidates, where faces are met in one place.
    fn is_on_face(&self, prim: u32, point: DVec3) -> bool {
        self.seen.faces.iter().filter(|&&row| self.prim_of_face(row) == prim).any(|&row| {
            let face = &self.snapshot.columns().triangles[row as usize];
            let [a, b, c] = face.corners();
            let slack = 1e-6 * [a, b, c, point].map(DVec3::length).iter().sum::<f64>();
            let off = face.plane.normal.dot(point) - face.plane.distance;
            let turn = (b - a).cross(c - a).dot(face.plane.normal).signum();
            let inside = |from: DVec3, to: DVec3| {
                let inwards = face.plane.normal.cross(to - from).normalize() * turn;
                inwards.dot(point - from) >= -slack
            };
            off.abs() <= slack && inside(a, b) && inside(b, c) && inside(c, a)
        })
    }

    fn prim_of_face(&self, row: u32) -> u32 {
        self.snapshot.columns().triangles[row as usize].plane.prim
    }

    fn what(&self, ray: &Ray) -> String {
        format!("{ray:?} {:?} {:#?} of {:#?}", self.region, self.seen, self.snapshot.prims())
    }

    /// Rays through the whole region, and aimed at what is met by a hair.
    fn shoot(&mut self, stage: &mut Stage<'_>) {
        let places = stage.places(self.frame, &self.region).into_iter();
        let met: Vec<Option<u32>> = places.map(|at| self.meet(at).map(|hit| hit.surface.prim)).collect();
        let count = |prim: Option<u32>| met.iter().filter(|&&other| other == prim).count();
        self.tally.barely += u32::from(met.iter().any(|prim| prim.is_some() && count(*prim) == 1));
        let most = met.iter().filter(|prim| prim.is_some()).map(|&prim| count(prim)).max().unwrap_or(0);
        self.tally.filled += u32::from(self.seen.filled);
        self.tally.nearly_filled += u32::from(most < met.len() && most + 3 >= met.len());
        self.tally.empty += u32::from(self.seen.is_empty());
        self.tally.by_tree += u32::from(self.seen.tree);
    }
}

/// Looks at a scene through smaller and smaller parts of a picture.
fn look_around(stage: &mut Stage<'_>, tally: &mut Tally) {
    let snapshot = stage.snapshot(&[], false);
    let view = stage.stand.view.clone();
    let frame = Frame::new(&snapshot, &view);
    let mut before = Candidates::default();
    before.all(snapshot.columns());
    tally.from_within += u32::from(!frame.outside_solids);
    for region in stage.stand.regions.clone() {
        let mut seen = Candidates::default();
        let frustum = Frustum::new(&frame, &region);
        seen.visible_through(&frustum, snapshot.columns(), &before, frame.outside_solids);
        tally.hidden_planes += u32::from(seen.planes.len() < before.planes.len() && !seen.planes.is_empty());
        let mut look = Look { frame: &frame, snapshot: &snapshot, region, seen: &seen, tally };
        look.shoot(stage);
        before = seen;
    }
}

#[test]
fn what_camera_rays_meet_is_among_the_candidates() {
    let mut tally = Tally::default();
    let mut random = Random(11);
    for _ in 0..11_000 {
        look_around(&mut Stage::new(&mut random, 8), &mut tally);
    }
    assert!(tally.hits > 200_000 && tally.at_border > 200_000 && tally.barely > 500, "{tally:?}");
    assert!(tally.filled > 900 && tally.nearly_filled > 350 && tally.empty > 1_000, "{tally:?}");
    assert!(tally.in_faces > 15_000 && tally.near_bounds > 40_000 && tally.by_tree > 2_000, "{tally:?}");
    assert!(tally.from_within > 250 && tally.hidden_planes > 150, "{tally:?}");
}

#[test]
fn what_fills_a_frustum_is_all_that_camera_rays_meet() {
    let mut tally = Tally::default();
    let mut random = Random(20);
    for _ in 0..4_000 {
        let mut stage = Stage::new(&mut random, 1);
        if !one_in(stage.random, 8) {
            stage.shapes.clear();
        }
        let region = *one_of(stage.random, &stage.stand.regions);
        stage.stand.regions = vec![region];
        let cover = stage.cover(&region);
        stage.shapes.extend(cover);
        look_around(&mut stage, &mut tally);
    }
    assert!(tally.filled > 250 && tally.nearly_filled > 350 && tally.in_faces > 10_000, "{tally:?}");
    assert!(tally.near_bounds > 10_000 && tally.hidden_planes > 45, "{tally:?}");
}

#[test]
fn quarters_are_whole_blocks_and_leave_nothing_out() {
    let mut random = Random(5);
    for _ in 0..200 {
        let mut number = |most: u64| (random.bits() % most) as u32;
        let region = Region::new(number(9), number(9), Size::new(1 + number(40), 1 + number(40)));
        let parts: Vec<Region> = quarters(region).collect();
        let holders = |x: u32, y: u32| {
            let within = |from: u32, length: u32, at: u32| (from..from + length).contains(&at);
            let holds =
                |part: &&Region| within(part.x, part.size.width, x) && within(part.y, part.size.height, y);
            parts.iter().filter(holds).count()
        };
        for (x, y) in (0..60).flat_map(|x| (0..60).map(move |y| (x, y))) {
            let inside = (region.x..region.x + region.size.width).contains(&x)
                && (region.y..region.y + region.size.height).contains(&y);
            assert_eq!(holders(x, y), usize::from(inside), "{region:?} {parts:?}");
        }
        for part in parts {
            assert!((part.x - region.x).is_multiple_of(4) && (part.y - region.y).is_multiple_of(4));
        }
    }
}
