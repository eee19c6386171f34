//! What a tile need not look at: shapes that its camera rays cannot see first, and shapes that cannot stand between
//! what it shows and a light.

use catoptra_core::Aabb;
use catoptra_core::glam::DVec3;

use super::beam::{Beam, Crosses};
use super::search::FEW;
use super::window::{Sight, Window};
use crate::kernel::PlaneRow;
use crate::numeric::PLAN_MARGIN;
use crate::snapshot::{Ball, Columns, LightRow};

/// Longer lists of bounded shapes are not read through to find out that none matters: a walk down the tree says so sooner.
const MANY: usize = 1024;

/// Shapes that are looked at: rows of planes, ids of bounded shapes one by one, or those by the tree.
#[derive(Debug, Default)]
pub(super) struct Shapes {
    pub(super) planes: Vec<u32>,
    /// How near the candidates' planes are along the corners of the window.
    nearness: Vec<[f64; 4]>,
    /// Places of bounded shapes in the columns' lists.
    near: Vec<u32>,
    pub(super) bounded: Vec<u32>,
    /// Rows of faces that may be seen, of shapes that are not among `bounded`.
    pub(super) faces: Vec<u32>,
    pub(super) tree: bool,
    /// Where all points lie that may be seen, shape by shape; empty where that is not known beforehand.
    pub(super) places: Vec<Place>,
    /// Whether one shape fills the whole window.
    pub(super) filled: bool,
}

impl Shapes {
    fn clear(&mut self) {
        self.planes.clear();
        self.nearness.clear();
        self.near.clear();
        self.bounded.clear();
        self.faces.clear();
        self.places.clear();
        (self.tree, self.filled) = (false, false);
    }

    /// Every shape that passes the tests.
    #[inline]
    fn keep(
        &mut self,
        columns: &Columns,
        plane: impl Fn(usize, &PlaneRow) -> bool,
        ball: impl Fn(u32, &Ball) -> bool,
    ) {
        self.clear();
        for (i, row) in columns.planes.iter().enumerate() {
            if plane(i, row) {
                self.planes.push(i as u32);
            }
        }
        self.keep_balls(columns, 0..columns.bounded.len() as u32, ball);
    }

    /// Adds the bounded shapes of a list that pass a test.
    #[inline]
    fn keep_balls(
        &mut self,
        columns: &Columns,
        among: impl Iterator<Item = u32>,
        ball: impl Fn(u32, &Ball) -> bool,
    ) {
        let few = columns.bounded.len() <= FEW;
        if columns.bounded.len() > MANY {
            self.tree = true;
            return;
        }
        for i in among {
            let prim = columns.bounded[i as usize];
            if !ball(prim, &columns.balls[i as usize]) {
                continue;
            }
            if !few {
                self.tree = true;
                return;
            }
            self.near.push(i);
            self.bounded.push(prim);
        }
    }

    /// Whether nothing is looked at.
    pub(super) fn is_empty(&self) -> bool {
        self.planes.is_empty() && self.bounded.is_empty() && self.faces.is_empty() && !self.tree
    }

    /// Every shape there is.
    pub(super) fn all(&mut self, columns: &Columns) {
        self.keep(columns, |_, _| true, |_, _| true);
    }

    /// Shapes that a ray of some beams may meet. Where all rays stay outside all convex solids, those that leave one do
    /// not meet it again.
    pub(super) fn met_by(&mut self, columns: &Columns, beams: &[Beam], outside: bool) {
        let met = |prim: u32, ball: &Ball| {
            beams.iter().any(|beam| beam.may_meet_shape(columns, prim, ball, outside))
        };
        self.keep(columns, |_, row| beams.iter().any(|beam| beam.may_cross(row)), met);
    }

    /// Shapes among `candidates` that a camera ray through a window may see first. Of solids that are seen from outside,
    /// those are the faces on the eye's side.
    pub(super) fn seen_through(
        &mut self,
        window: &Window,
        columns: &Columns,
        candidates: &Self,
        outside: bool,
    ) {
        self.clear();
        // 1 / t of a plane is an affine function of the pixel: what holds at the corners holds between them.
        let hides = |a: &[f64; 4], b: &[f64; 4]| {
            let margin = PLAN_MARGIN * a.iter().chain(b).fold(0.0, |m, w| w.abs().max(m));
            (0..4).all(|i| a[i] > margin && a[i] > b[i] + margin)
        };
        let rows = candidates.planes.iter().map(|&i| window.nearness(&columns.planes[i as usize]));
        self.nearness.extend(rows);
        for (own, &plane) in self.nearness.iter().zip(&candidates.planes) {
            // NaN and infinity, from an eye in the plane, are never left out.
            let away = own.iter().all(|w| *w < 0.0);
            if !away && !self.nearness.iter().any(|other| hides(other, own)) {
                self.planes.push(plane);
            }
        }
        if columns.bounded.len() > FEW {
            let all = 0..columns.bounded.len() as u32;
            self.keep_balls(columns, all.filter(|_| candidates.tree), |_, ball| window.may_show(ball));
        } else {
            self.keep_balls(columns, candidates.near.iter().copied(), |_, ball| window.may_show(ball));
        }
        let faced = outside && self.keep_faces(window, columns);
        self.find_places(window, columns, faced);
    }

    /// Puts the faces that may be seen of shapes with faces in the place of the shapes; answers whether each fills the
    /// window.
    fn keep_faces(&mut self, window: &Window, columns: &Columns) -> bool {
        let Self { near, bounded, faces, .. } = self;
        let mut all = true;
        near.retain(|&near| {
            let Some(rows) = columns.faces_of(columns.bounded[near as usize]) else { return true };
            let (before, single) = (faces.len(), rows.len() == 1);
            for row in rows {
                let face = &columns.triangles[row as usize];
                let sight = window.sight(face);
                if sight != Sight::Nothing && (single || window.may_face(face)) {
                    faces.push(row);
                    all &= sight == Sight::All;
                }
            }
            faces.len() > before
        });
        bounded.clear();
        let whole = |prim: &u32| columns.faces_of(*prim).is_none();
        bounded.extend(near.iter().map(|&near| columns.bounded[near as usize]).filter(whole));
        all
    }

    /// Finds out where the points lie that may be seen, where shapes do not go on without an end. `faced` says that each
    /// face fills the window.
    fn find_places(&mut self, window: &Window, columns: &Columns, faced: bool) {
        if self.tree || !columns.general_unbounded.is_empty() {
            return;
        }
        for &near in &self.near {
            let (prim, ball) = (columns.bounded[near as usize], &columns.balls[near as usize]);
            let round = columns.is_sphere(prim) && !window.is_within(ball);
            let place =
                if round { window.place_on_ball(prim, ball) } else { Place::new(prim, ball.bounds()) };
            self.filled = self.near.len() == 1
                && ((round && window.filled_by_ball(ball)) || (faced && self.faces.len() == 1));
            if self.filled {
                // Planes behind it are not seen.
                self.planes.retain(|&plane| !window.is_free_of(&columns.planes[plane as usize], &place));
                self.filled = self.planes.is_empty();
            }
            self.places.push(place);
        }
        for &plane in &self.planes {
            let Some(place) = window.place_on(&columns.planes[plane as usize]) else {
                self.places.clear();
                return;
            };
            self.places.push(place);
        }
        self.filled |= self.near.is_empty() && self.planes.len() == 1;
    }

    /// Finds out where the points lie that the rays of some beams may meet; false, and no places, where they may have no
    /// end.
    pub(super) fn find_places_of(&mut self, columns: &Columns, beams: &[Beam]) -> bool {
        self.places.clear();
        if self.tree || !columns.general_unbounded.is_empty() {
            return false;
        }
        let bounds = |(&prim, &near): (&u32, &u32)| Place::new(prim, columns.balls[near as usize].bounds());
        self.places.extend(self.bounded.iter().zip(&self.near).map(bounds));
        for &row in &self.planes {
            for beam in beams {
                match beam.crosses(&columns.planes[row as usize]) {
                    Crosses::Never => {}
                    Crosses::Within(place) => self.places.push(place),
                    Crosses::Anywhere => {
                        self.places.clear();
                        return false;
                    }
                }
            }
        }
        true
    }

    /// Shapes that may stand between what has been seen and a light.
    pub(super) fn between(&mut self, columns: &Columns, places: &[Place], light: &LightRow, outside: bool) {
        let crosses = |i: usize, row: &PlaneRow| {
            light.behind[i] != 0.0 && places.iter().any(|place| place.may_lie_beyond(row, light.behind[i]))
        };
        let meets = |prim: u32, ball: &Ball| {
            let left = outside && columns.is_convex(prim);
            places.iter().any(|place| !(left && place.prim == prim) && place.shaft_meets(light, ball))
        };
        self.keep(columns, crosses, meets);
    }
}

/// Where the points lie that a tile shows of one shape.
#[derive(Debug, Clone, Copy)]
pub(super) struct Place {
    pub(super) prim: u32,
    pub(super) center: DVec3,
    pub(super) half: DVec3,
    radius: f64,
}

impl Place {
    pub(super) fn new(prim: u32, bounds: Aabb) -> Self {
        let center = bounds.centre();
        let margin = PLAN_MARGIN * (center.abs().element_sum() + bounds.size().element_sum());
        let half = bounds.size() / 2.0 + DVec3::splat(margin);
        Self { prim, center, half, radius: half.length() }
    }

    /// Whether a point may lie on the other side of a plane than a light that is `behind` it by so much.
    pub(super) fn may_lie_beyond(&self, row: &PlaneRow, behind: f64) -> bool {
        if self.prim == row.prim {
            return false;
        }
        let middle = row.distance - row.normal.dot(self.center);
        let spread = row.normal.abs().dot(self.half);
        let least = if behind > 0.0 { middle - spread } else { -middle - spread };
        !(least > PLAN_MARGIN * (row.distance.abs() + self.center.abs().element_sum()))
    }

    /// Whether anything may arrive from a light.
    pub(super) fn is_reached_by(&self, light: &LightRow) -> bool {
        light.light.may_reach(self.center, self.radius * (1.0 + PLAN_MARGIN))
    }

    /// Whether the ways from the points to a light may meet a ball.
    fn shaft_meets(&self, light: &LightRow, ball: &Ball) -> bool {
        let to_ball = ball.center - self.center;
        let reach =
            (ball.radius + self.radius) * (1.0 + PLAN_MARGIN) + PLAN_MARGIN * to_ball.abs().element_sum();
        let way = if light.at_infinity { light.place } else { light.place - self.center };
        let most = if light.at_infinity { f64::INFINITY } else { 1.0 };
        let share = (to_ball.dot(way) / way.length_squared()).clamp(0.0, most);
        !((to_ball - way * share).length_squared() > reach * reach)
    }
}
