//! What a tile need not look at: shapes that its camera rays cannot see first, and shapes that cannot stand between
//! what it shows and a light.

use catoptra_core::glam::DVec3;
use catoptra_core::{Aabb, Lane};
use fearless_simd::Simd;

use super::packet::Packet;
use super::search::{Best, FEW};
use crate::Tile;
use crate::backend::Frame;
use crate::kernel::PlaneRow;
use crate::lanes::{F, F3, M, splat3};
use crate::numeric::PLAN_MARGIN;
use crate::snapshot::{Ball, Columns, LightRow, Row};

/// Shapes that are looked at: rows of planes, ids of bounded shapes one by one, or those by the tree.
#[derive(Debug, Default)]
pub(super) struct Shapes {
    pub(super) planes: Vec<u32>,
    pub(super) bounded: Vec<u32>,
    pub(super) tree: bool,
    /// Where all points lie, where that is known beforehand: one plane fills the tile.
    pub(super) filled: Option<Place>,
}

impl Shapes {
    /// Every shape that passes the tests.
    fn keep(
        &mut self,
        columns: &Columns,
        plane: impl Fn(usize, &PlaneRow) -> bool,
        ball: impl Fn(u32, &Ball) -> bool,
    ) {
        self.planes.clear();
        self.bounded.clear();
        self.filled = None;
        let planes = columns.planes.iter().enumerate();
        self.planes.extend(planes.filter(|(i, row)| plane(*i, row)).map(|(i, _)| i as u32));
        let balls = columns.bounded.iter().zip(&columns.balls);
        let mut kept = balls.filter(|(prim, around)| ball(**prim, around)).map(|(&prim, _)| prim);
        self.tree = columns.bounded.len() > FEW;
        if self.tree {
            self.tree = kept.next().is_some();
        } else {
            self.bounded.extend(kept);
        }
    }

    /// Whether nothing is looked at.
    pub(super) fn is_empty(&self) -> bool {
        self.planes.is_empty() && self.bounded.is_empty() && !self.tree
    }

    /// Every shape there is.
    pub(super) fn all(&mut self, columns: &Columns) {
        self.keep(columns, |_, _| true, |_, _| true);
    }

    /// Shapes that a camera ray through a tile may see first.
    pub(super) fn seen_through(&mut self, frame: &Frame<'_>, tile: &Tile) {
        let columns = frame.snapshot.columns();
        let window = Window::new(frame, tile);
        // 1 / t of a plane is an affine function of the pixel: what holds at the corners holds between them.
        let nearness: Vec<[f64; 4]> = columns.planes.iter().map(|row| window.nearness(row)).collect();
        let hides = |a: &[f64; 4], b: &[f64; 4]| {
            let margin = PLAN_MARGIN * a.iter().chain(b).fold(0.0, |m, w| w.abs().max(m));
            (0..4).all(|i| a[i] > margin && a[i] > b[i] + margin)
        };
        let visible = |i: usize, _: &PlaneRow| {
            let w = &nearness[i];
            // NaN and infinity, from an eye in the plane, are never left out.
            !(w.iter().all(|w| *w < 0.0) || nearness.iter().any(|other| hides(other, w)))
        };
        self.keep(columns, visible, |_, ball| window.may_show(ball));
        if let ([plane], [], false, []) =
            (&*self.planes, &*self.bounded, self.tree, &*columns.general_unbounded)
        {
            self.filled = window.filled_by(&columns.planes[*plane as usize]);
        }
    }

    /// Shapes that may stand between what has been seen and a light.
    pub(super) fn between(&mut self, columns: &Columns, places: &[Place], light: &LightRow, convex: bool) {
        let crosses = |i: usize, row: &PlaneRow| {
            light.behind[i] != 0.0 && places.iter().any(|place| place.may_lie_beyond(row, light.behind[i]))
        };
        let meets = |prim: u32, ball: &Ball| {
            places.iter().any(|place| {
                let itself =
                    convex && place.prim == prim && matches!(columns.rows[prim as usize], Row::Sphere(_));
                !itself && place.shaft_meets(light, ball)
            })
        };
        self.keep(columns, crosses, meets);
    }
}

/// The camera rays of a tile: those within four directions from the eye.
struct Window {
    eye: DVec3,
    corners: [DVec3; 4],
    /// Inward unit normals of the four sides.
    sides: [DVec3; 4],
}

impl Window {
    fn new(frame: &Frame<'_>, tile: &Tile) -> Self {
        let raster = &frame.raster;
        let corner = |x: u32, y: u32| {
            raster.corner + raster.across * f64::from(tile.x + x) + raster.down * f64::from(tile.y + y)
        };
        let (w, h) = (tile.width, tile.height);
        let corners = [corner(0, 0), corner(w, 0), corner(w, h), corner(0, h)];
        let middle: DVec3 = corners.iter().sum();
        let sides = std::array::from_fn(|i| {
            let side = corners[i].cross(corners[(i + 1) % 4]).normalize_or_zero();
            side * side.dot(middle).signum()
        });
        Self { eye: frame.eye, corners, sides }
    }

    /// 1 / t of a plane along the four corners.
    fn nearness(&self, row: &PlaneRow) -> [f64; 4] {
        let inverse = 1.0 / (row.distance - row.normal.dot(self.eye));
        let (normal, [a, b, c, d]) = (row.normal, &self.corners);
        [
            normal.dot(*a) * inverse,
            normal.dot(*b) * inverse,
            normal.dot(*c) * inverse,
            normal.dot(*d) * inverse,
        ]
    }

    /// Where the points of a plane lie that fills the whole window; `None` where it does not for certain.
    fn filled_by(&self, row: &PlaneRow) -> Option<Place> {
        let nearness = self.nearness(row);
        let margin = PLAN_MARGIN * nearness.iter().fold(0.0, |m, w| w.abs().max(m));
        if !nearness.iter().all(|w| *w > margin && w.is_finite()) {
            return None;
        }
        let points = std::array::from_fn::<_, 4, _>(|i| self.eye + self.corners[i] / nearness[i]);
        Some(Place::new(row.prim, Aabb::of(points)))
    }

    /// Whether a ball may be seen.
    fn may_show(&self, ball: &Ball) -> bool {
        let to_center = ball.center - self.eye;
        let reach = ball.radius + PLAN_MARGIN * (to_center.length() + ball.radius);
        self.sides.iter().all(|side| side.dot(to_center) >= -reach)
    }
}

/// Most shapes whose points are told apart in one tile; the points of others are put together.
const APART: usize = 8;

/// Where the points lie that a tile shows, shape by shape.
pub(super) struct Seen<S: Simd> {
    count: usize,
    prims: [u32; APART],
    low: [F3<S>; APART],
    high: [F3<S>; APART],
    tops: F3<S>,
}

impl<S: Simd> Seen<S> {
    #[inline(always)]
    pub(super) fn nothing(s: S) -> Self {
        let (most, least) = (splat3(s, [f32::MAX; 3]), splat3(s, [f32::MIN; 3]));
        Self { count: 0, prims: [0; APART], low: [most; APART], high: [least; APART], tops: most }
    }

    /// Adds the points that a packet has met.
    #[inline(always)]
    pub(super) fn add(&mut self, packet: &Packet<'_, S>, best: &Best<S>) {
        let hits = best.hits() & packet.live;
        let point = packet.rays.direction.scale_add(best.t, packet.rays.origin);
        let mut left = hits.bits();
        while left != 0 {
            let prim = best.prim.lane(left.trailing_zeros() as usize);
            let mask = hits & best.prim.is(prim);
            self.grow(prim, mask, point);
            left &= !mask.bits();
        }
    }

    #[inline(always)]
    fn grow(&mut self, prim: u32, mask: M<S>, point: F3<S>) {
        let mut at = 0;
        while at < self.count && self.prims[at] != prim {
            at += 1;
        }
        if at == self.count {
            if self.count == APART {
                // The last place takes in what has no place of its own, under no name.
                at = APART - 1;
                self.prims[at] = crate::film::NOTHING;
            } else {
                self.prims[at] = prim;
                self.count += 1;
            }
        }
        let (low, high) = (&mut self.low[at], &mut self.high[at]);
        let (under, over) = (self.tops, F3::new(-self.tops.x, -self.tops.y, -self.tops.z));
        let (p, q) = (F3::select(mask, point, under), F3::select(mask, point, over));
        *low = F3::new(low.x.min(p.x), low.y.min(p.y), low.z.min(p.z));
        *high = F3::new(high.x.max(q.x), high.y.max(q.y), high.z.max(q.z));
    }

    /// Where the points lie, shape by shape.
    pub(super) fn places(&self) -> impl Iterator<Item = Place> + '_ {
        (0..self.count).map(|at| {
            let (low, high) = (&self.low[at], &self.high[at]);
            let min =
                DVec3::new(extreme(low.x, f64::min), extreme(low.y, f64::min), extreme(low.z, f64::min));
            let max =
                DVec3::new(extreme(high.x, f64::max), extreme(high.y, f64::max), extreme(high.z, f64::max));
            Place::new(self.prims[at], Aabb { min, max })
        })
    }
}

fn extreme<S: Simd>(lanes: F<S>, pick: impl Fn(f64, f64) -> f64) -> f64 {
    (1..F::<S>::LANES).fold(f64::from(lanes.lane(0)), |m, lane| pick(m, f64::from(lanes.lane(lane))))
}

/// Where the points lie that a tile shows of one shape.
#[derive(Debug, Clone, Copy)]
pub(super) struct Place {
    prim: u32,
    center: DVec3,
    half: DVec3,
    radius: f64,
}

impl Place {
    fn new(prim: u32, bounds: Aabb) -> Self {
        let center = bounds.centre();
        let margin = PLAN_MARGIN * (center.abs().element_sum() + bounds.size().element_sum());
        let half = bounds.size() / 2.0 + DVec3::splat(margin);
        Self { prim, center, half, radius: half.length() }
    }

    /// Whether a point may lie on the other side of a plane than a light that is `behind` it by so much.
    fn may_lie_beyond(&self, row: &PlaneRow, behind: f64) -> bool {
        if self.prim == row.prim {
            return false;
        }
        let middle = row.distance - row.normal.dot(self.center);
        let spread = row.normal.abs().dot(self.half);
        let least = if behind > 0.0 { middle - spread } else { -middle - spread };
        !(least > PLAN_MARGIN * (row.distance.abs() + self.center.abs().element_sum()))
    }

    /// Whether the ways from the points to a light may meet a ball.
    fn shaft_meets(&self, light: &LightRow, ball: &Ball) -> bool {
        let to_ball = ball.center - self.center;
        let (along, length) = if light.at_infinity {
            (light.place, f64::INFINITY)
        } else {
            let way = light.place - self.center;
            (way.normalize_or_zero(), way.length())
        };
        let reach = (ball.radius + self.radius) * (1.0 + PLAN_MARGIN) + PLAN_MARGIN * to_ball.length();
        let nearest = along * to_ball.dot(along).max(0.0).min(length);
        !((to_ball - nearest).length() > reach)
    }
}
