//! What is there where a ray meets a surface: nothing, something see-through, or a material at a point?

use catoptra_core::glam::DVec3;
use catoptra_core::texture::TexturePoint;
use catoptra_core::{Bsdf, Continuation, Ray, Rgb, Scattered, Sides, SurfacePoint};

use super::{Media, Origin, PathRay};
use crate::Hit;
use crate::integrator::Search;
use crate::integrator::walker::{SurfaceHit, Walker};
use crate::lamps::LitPoint;

/// A point of a surface that scatters light.
pub(crate) struct Vertex<'a> {
    pub(in crate::integrator) surface: SurfaceHit<'a>,
    pub(in crate::integrator) bsdf: Bsdf,
    /// The share of light from behind that it keeps back.
    pub(in crate::integrator) opacity: f64,
    /// What rays that go through it run in.
    pub(in crate::integrator) behind: Media,
}

/// A direction in which light is followed from a point.
#[derive(Debug, Clone, Copy)]
pub(in crate::integrator) struct Way {
    /// Unit vector.
    direction: DVec3,
    is_transmitted: bool,
}

impl From<Continuation> for Way {
    fn from(way: Continuation) -> Self {
        Self { direction: way.direction, is_transmitted: way.is_transmitted }
    }
}

impl From<Scattered> for Way {
    fn from(way: Scattered) -> Self {
        Self { direction: way.direction, is_transmitted: way.is_transmitted }
    }
}

impl Vertex<'_> {
    /// The ray that goes on in a direction, one bounce deeper.
    pub(in crate::integrator) fn on_along(
        &self,
        path: &PathRay,
        way: &Way,
        weight: Rgb,
        origin: Origin,
    ) -> PathRay {
        let media = if way.is_transmitted { &self.behind } else { &path.media };
        PathRay {
            ray: Ray::new(self.surface.point, way.direction),
            leaving: Some(self.surface.hit.surface),
            weight,
            glossy: weight,
            origin,
            depth: path.depth + 1,
            passed: 0,
            media: media.clone(),
            spread: path.spread.after(&path.ray, self.surface.hit.crossing.t, self.widening(origin)),
        }
    }

    /// The ray that goes on as if nothing were there.
    pub(in crate::integrator) fn straight_on(&self, path: PathRay) -> PathRay {
        path.straight_on(&self.surface.hit, self.surface.point)
    }

    /// By how much the cone of rays grows that are chosen among many, radians: the angle that one of them stands for.
    fn widening(&self, origin: Origin) -> f64 {
        match origin {
            Origin::Alone | Origin::Apart => 0.0,
            Origin::Reflected(pdf) | Origin::Transmitted(pdf) => (1.0 / pdf).sqrt().min(1.0),
        }
    }

    /// As lamps see it.
    pub(super) fn lit_point(&self) -> LitPoint {
        LitPoint {
            point: self.surface.point,
            normal: self.surface.shading.normal.into(),
            ground: self.surface.normal,
            surface: Some(self.surface.hit.surface),
        }
    }
}

/// What a ray comes to.
pub(in crate::integrator) enum Met<'a> {
    /// Nothing; the ray with what its media leave of its light.
    Nothing(PathRay),
    /// A surface that is not there: the ray goes straight on.
    Passed(PathRay),
    /// A point, and the ray with what its media leave of its light.
    Surface(Box<Vertex<'a>>, PathRay),
}

impl<'a, S: Search> Walker<'a, S> {
    /// What a ray comes to that meets so and so.
    pub(in crate::integrator) fn arrive(
        &self,
        mut path: PathRay,
        hit: Option<Hit>,
        stochastic: Option<[f64; 2]>,
    ) -> Met<'a> {
        let snapshot = self.frame.snapshot;
        let Some(hit) = hit else {
            path.absorb(path.media.left_after(snapshot, f64::INFINITY));
            return Met::Nothing(path);
        };
        let surface = self.surface_at(hit, path.ray);
        path.absorb(path.media.left_after(snapshot, surface.shading.distance));
        // A solid of several shapes is filled by what its first one is made of.
        let body = snapshot.prims()[hit.surface.prim as usize].body;
        let (prim, front) = (body, surface.shading.front);
        let mut behind = path.media.clone();
        if snapshot.matter().medium_in(&snapshot.prims()[prim as usize]).is_some() {
            let inside = if front {
                behind.enter(prim);
                &behind
            } else {
                // Whoever comes out of it has been inside, if rounding has lost where it went in.
                path.media.enter(prim);
                behind.leave(prim);
                &path.media
            };
            if inside.top(snapshot) != Some(prim) {
                let point = surface.point;
                return Met::Passed(PathRay { media: behind, ..path.straight_on(&hit, point) });
            }
        }
        let outside = if front { &path.media } else { &behind };
        let outside_ior = outside.ior(snapshot);
        let (bsdf, opacity) = self.bsdf_at(&surface, &path, outside_ior, stochastic);
        Met::Surface(Box::new(Vertex { surface, bsdf, opacity, behind }), path)
    }

    /// What light does at a surface, and how opaque that is.
    fn bsdf_at(
        &self,
        surface: &SurfaceHit<'_>,
        path: &PathRay,
        outside_ior: f64,
        stochastic: Option<[f64; 2]>,
    ) -> (Bsdf, f64) {
        let snapshot = self.frame.snapshot;
        let (matter, prim) = (snapshot.matter(), &snapshot.prims()[surface.hit.surface.prim as usize]);
        let row = matter.row(prim);
        let sheet = crate::snapshot::is_a_sheet(&prim.shape);
        let material = row.thin.as_ref().filter(|_| sheet).unwrap_or(surface.material);
        let mut at = SurfacePoint {
            shading: surface.shading,
            geometric: surface.normal,
            outside_ior,
            ..SurfacePoint::flat(surface.shading)
        };
        let Some(own) = matter.own_shape(surface.hit.surface.prim) else {
            return (material.bsdf(&at), 1.0);
        };
        let position = own.to_own.point(surface.point + snapshot.frame());
        let place = own.shape.parametrization(position, surface.hit.surface.facet);
        let facet = surface.hit.surface.facet;
        let smooth = if row.is_directed { own.shape.tangents(position, facet) } else { None };
        let [along_u, along_v] = smooth.unwrap_or([place.along_u, place.along_v]);
        (at.uv, at.tangent) = (place.uv, own.to_world.vector(along_u));
        let spread = path.spread.on_surface(&surface.ray, surface.hit.crossing.t, surface.normal);
        let spread = spread.map(|side| own.to_own.vector(side));
        let point = TexturePoint {
            uv: place.uv,
            position,
            normal: own.to_own.direction(surface.normal),
            color: own.shape.color_at(position, surface.hit.surface.facet),
            footprint: Some(place.footprint(spread)),
            spread: Some(spread),
            stochastic,
        };
        let hidden = row.finish.sides() == Sides::Single && !surface.shading.front;
        let opacity = if hidden { 0.0 } else { row.finish.opacity_at(matter, &point) };
        if let Some(map) = row.finish.normal_map() {
            let normal = at.normal();
            let right =
                (at.tangent - normal * at.tangent.dot(normal)).normalize_or(normal.any_orthonormal_vector());
            // On the side where v grows, which mirrored coordinates turn round.
            let across = normal.cross(right);
            let up = if across.dot(own.to_world.vector(along_v)) < 0.0 { -across } else { across };
            let [x, y, z] = map.normal(matter, &point).to_array();
            let bent = (right * x + up * y + normal * z).normalize_or(normal);
            at.shading.normal = towards_viewer(bent, at.to_viewer(), normal).into();
        }
        let bsdf =
            if row.is_textured { material.resolved(matter, &point).bsdf(&at) } else { material.bsdf(&at) };
        (bsdf, opacity)
    }
}

/// The normal itself where the viewer sees its upper side, else the other one.
fn towards_viewer(bent: DVec3, to_viewer: DVec3, normal: DVec3) -> DVec3 {
    if bent.dot(to_viewer) > 0.0 { bent } else { normal }
}

impl PathRay {
    /// Loses light on its way.
    fn absorb(&mut self, left: Rgb) {
        if left != Rgb::WHITE {
            self.weight = self.weight * left;
            self.glossy = self.glossy * left;
        }
    }
}
