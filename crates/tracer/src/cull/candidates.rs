//! Which shapes a search must try: those that camera rays of a part of a picture may see first, those that reflected rays
//! may meet, and those that may stand between what is seen and a light.

use super::beam::{Beam, Crosses};
use super::frustum::{Coverage, Frustum};
use super::point_bounds::PointBounds;
use crate::kernel::PlaneRow;
use crate::numeric::PLAN_MARGIN;
use crate::snapshot::{Ball, Columns, LightRow};

/// Up to this many shapes are tested one by one; more are searched by the tree.
pub(super) const FEW: usize = 4;

/// Longer lists of bounded shapes are not read through to find out that none matters: a walk down the tree says so
/// sooner.
const MANY: usize = 1024;

/// Shapes to be tried: rows of planes, ids of bounded shapes one by one, or all of those by the tree.
#[derive(Debug, Default)]
pub(crate) struct Candidates {
    pub(crate) planes: Vec<u32>,
    /// 1 / t of the candidates' planes along the corners of the frustum.
    inverse_t: Vec<[f64; 4]>,
    /// Places of bounded shapes in the columns' lists.
    near: Vec<u32>,
    pub(crate) bounded: Vec<u32>,
    /// Rows of faces that may be seen, of shapes that are not among `bounded`.
    pub(crate) faces: Vec<u32>,
    pub(crate) tree: bool,
    /// Where all points lie that may be seen, shape by shape; empty where that is not known beforehand.
    pub(crate) points: Vec<PointBounds>,
    /// Whether one shape fills the whole frustum.
    pub(crate) filled: bool,
}

impl Candidates {
    fn clear(&mut self) {
        self.planes.clear();
        self.inverse_t.clear();
        self.near.clear();
        self.bounded.clear();
        self.faces.clear();
        self.points.clear();
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

    /// True if the candidate set is empty.
    pub(crate) fn is_empty(&self) -> bool {
        self.planes.is_empty() && self.bounded.is_empty() && self.faces.is_empty() && !self.tree
    }

    /// Whether there are meshes among them, or may be.
    pub(crate) fn hold_meshes(&self, columns: &Columns) -> bool {
        (self.tree && !columns.instances.is_empty())
            || self.bounded.iter().any(|&prim| columns.instance(prim).is_some())
    }

    /// Every shape there is.
    pub(crate) fn all(&mut self, columns: &Columns) {
        self.keep(columns, |_, _| true, |_, _| true);
    }

    /// Those of the given shapes.
    pub(crate) fn among(&mut self, columns: &Columns, prims: &[u32]) {
        self.keep(columns, |_, row| prims.contains(&row.prim), |prim, _| prims.contains(&prim));
    }

    /// Keeps the shapes that a ray of some beams may meet. Where all rays stay outside all convex solids, those that
    /// leave one do not meet it again.
    pub(crate) fn reachable(&mut self, columns: &Columns, beams: &[Beam], outside: bool) {
        let met = |prim: u32, ball: &Ball| {
            beams.iter().any(|beam| beam.may_meet_shape(columns, prim, ball, outside))
        };
        self.keep(columns, |_, row| beams.iter().any(|beam| beam.may_cross(row)), met);
    }

    /// Keeps those of `candidates` that a camera ray through a frustum may see first. Of solids that are seen from
    /// outside, those are the faces on the eye's side.
    pub(crate) fn visible_through(
        &mut self,
        frustum: &Frustum,
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
        let rows = candidates.planes.iter().map(|&i| frustum.inverse_t(&columns.planes[i as usize]));
        self.inverse_t.extend(rows);
        for (own, &plane) in self.inverse_t.iter().zip(&candidates.planes) {
            // NaN and infinity, from an eye in the plane, are never left out.
            let away = own.iter().all(|w| *w < 0.0);
            if !away && !self.inverse_t.iter().any(|other| hides(other, own)) {
                self.planes.push(plane);
            }
        }
        if columns.bounded.len() > FEW {
            let all = 0..columns.bounded.len() as u32;
            self.keep_balls(columns, all.filter(|_| candidates.tree), |_, ball| frustum.may_show(ball));
        } else {
            self.keep_balls(columns, candidates.near.iter().copied(), |_, ball| frustum.may_show(ball));
        }
        let faced = outside && self.keep_faces(frustum, columns);
        self.find_points(frustum, columns, faced);
    }

    /// Replaces shapes with faces by those of their faces that may be seen; answers whether each fills the
    /// frustum.
    fn keep_faces(&mut self, frustum: &Frustum, columns: &Columns) -> bool {
        let Self { near, bounded, faces, .. } = self;
        let mut all = true;
        near.retain(|&near| {
            let Some(rows) = columns.faces_of(columns.bounded[near as usize]) else { return true };
            let (before, single) = (faces.len(), rows.len() == 1);
            for row in rows {
                let face = &columns.triangles[row as usize];
                let coverage = frustum.coverage(face);
                if coverage != Coverage::Nothing && (single || frustum.may_face(face)) {
                    faces.push(row);
                    all &= coverage == Coverage::All;
                }
            }
            faces.len() > before
        });
        bounded.clear();
        let whole = |prim: &u32| columns.faces_of(*prim).is_none();
        bounded.extend(near.iter().map(|&near| columns.bounded[near as usize]).filter(whole));
        all
    }

    /// Finds bounds of the points that may be seen, where those are bounded. `faced` says that each face fills the
    /// frustum.
    fn find_points(&mut self, frustum: &Frustum, columns: &Columns, faced: bool) {
        if self.tree || !columns.general_unbounded.is_empty() {
            return;
        }
        for &near in &self.near {
            let (prim, ball) = (columns.bounded[near as usize], &columns.balls[near as usize]);
            let round = columns.is_sphere(prim) && !frustum.is_within(ball);
            let visible = if round {
                frustum.bounds_on_ball(prim, ball)
            } else {
                PointBounds::new(prim, ball.bounds())
            };
            self.filled = self.near.len() == 1
                && ((round && frustum.filled_by_ball(ball)) || (faced && self.faces.len() == 1));
            if self.filled {
                // Planes behind it are not seen.
                self.planes.retain(|&plane| !frustum.is_free_of(&columns.planes[plane as usize], &visible));
                self.filled = self.planes.is_empty();
            }
            self.points.push(visible);
        }
        for &plane in &self.planes {
            let Some(visible) = frustum.bounds_on(&columns.planes[plane as usize]) else {
                self.points.clear();
                return;
            };
            self.points.push(visible);
        }
        self.filled |= self.near.is_empty() && self.planes.len() == 1;
    }

    /// Finds out where the points lie that the rays of some beams may meet; false, and no points, where they may have no
    /// end.
    pub(crate) fn find_points_of(&mut self, columns: &Columns, beams: &[Beam]) -> bool {
        self.points.clear();
        if self.tree || !columns.general_unbounded.is_empty() {
            return false;
        }
        let bounds =
            |(&prim, &near): (&u32, &u32)| PointBounds::new(prim, columns.balls[near as usize].bounds());
        self.points.extend(self.bounded.iter().zip(&self.near).map(bounds));
        for &row in &self.planes {
            for beam in beams {
                match beam.crosses(&columns.planes[row as usize]) {
                    Crosses::Never => {}
                    Crosses::Within(visible) => self.points.push(visible),
                    Crosses::Anywhere => {
                        self.points.clear();
                        return false;
                    }
                }
            }
        }
        true
    }

    /// Keeps the shapes that may stand between what has been seen and a light.
    pub(crate) fn occluders(
        &mut self,
        columns: &Columns,
        points: &[PointBounds],
        light: &LightRow,
        outside: bool,
    ) {
        let crosses = |i: usize, row: &PlaneRow| {
            light.behind[i] != 0.0
                && points.iter().any(|visible| visible.may_lie_beyond(row, light.behind[i]))
        };
        let meets = |prim: u32, ball: &Ball| {
            let passes_by = outside && columns.is_convex(prim);
            points
                .iter()
                .any(|visible| !(passes_by && visible.prim == prim) && visible.shaft_meets(light, ball))
        };
        self.keep(columns, crosses, meets);
    }
}
