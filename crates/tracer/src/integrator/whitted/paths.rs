//! Whitted's integrator, one path at a time in `f64`. As every surface sends on at most
//! one ray, the recursion is a loop that carries the weight of what is still to come.

use catoptra_core::glam::DVec3;
use catoptra_core::{Arrival, Light, Lobes, Material, Ray, Rgb, ShadingPoint, Span, Triple};

use crate::film::NOTHING;
use crate::lanes::storable;
use crate::shade::{MirrorNormals, goes_on, mirror_direction};
use crate::{Frame, Hit, Snapshot, Stats, SurfaceId, Tile};

/// A way of answering what a ray meets.
pub(crate) trait Search {
    /// What a ray meets first.
    fn nearest(&self, snapshot: &Snapshot, ray: &Ray, span: Span, leaving: Option<SurfaceId>) -> Option<Hit>;

    /// Whether a ray meets anything.
    fn occluded(&self, snapshot: &Snapshot, ray: &Ray, span: Span, leaving: Option<SurfaceId>) -> bool;
}

/// Traces every pixel of a tile, one path after another.
pub(crate) fn trace_pixels(search: &impl Search, frame: &Frame<'_>, tile: &mut Tile) -> Stats {
    let mut path = Path { search, frame, stats: Stats::default() };
    let grid = frame.view.grid;
    for (x, y) in (0..tile.height).flat_map(|y| (0..tile.width).map(move |x| (x, y))) {
        let i = tile.index(x, y);
        let mut sum = Rgb::BLACK;
        for (u, v) in (0..grid).flat_map(|v| (0..grid).map(move |u| (u, v))) {
            let [right, down] = frame.view.place(u, v);
            let ray = frame.raster.ray(f64::from(tile.x + x) + right, f64::from(tile.y + y) + down);
            let (light, seen) = path.trace(ray);
            sum += light;
            if (u, v) == (grid / 2, grid / 2) {
                tile.depth[i] =
                    seen.map_or(f32::INFINITY, |hit| (hit.crossing.t * ray.direction.length()) as f32);
                tile.surface[i] = seen.map_or(NOTHING, |hit| hit.place.prim);
            }
        }
        for (column, light) in tile.radiance.iter_mut().zip(sum.to_array()) {
            column[i] = light as f32;
        }
    }
    path.stats.not_finite += finish(tile, grid);
    path.stats
}

/// Divides sums over `grid` x `grid` samples; lights past every number become the largest, what is no number black. How
/// many those were.
fn finish(tile: &mut Tile, grid: u32) -> u64 {
    let share = 1.0 / (grid as f32 * grid as f32);
    let mut not_finite = 0;
    for column in &mut tile.radiance {
        for light in column.iter_mut() {
            let (kept, broken) = storable(f64::from(*light));
            *light = if broken { kept as f32 } else { *light * share };
            not_finite += u64::from(broken);
        }
    }
    not_finite
}

/// Where a ray has met a surface.
struct Meeting<'a> {
    hit: Hit,
    ray: Ray,
    material: &'a Material,
    point: DVec3,
    /// Unit normals on the viewer's side.
    normal: DVec3,
    shading: ShadingPoint<f64>,
}

struct Path<'a, S> {
    search: &'a S,
    frame: &'a Frame<'a>,
    stats: Stats,
}

impl<'a, S: Search> Path<'a, S> {
    /// The light that arrives along a ray from the camera, and what the ray meets first.
    fn trace(&mut self, mut ray: Ray) -> (Rgb, Option<Hit>) {
        let snapshot = self.frame.snapshot;
        let (mut light, mut weight) = (Rgb::BLACK, Triple::splat(1.0));
        let (mut first, mut leaving) = (None, None);
        self.stats.rays.primary += 1;
        for depth in 0.. {
            let Some(hit) = self.search.nearest(snapshot, &ray, Span::AHEAD, leaving) else {
                light += rgb(weight) * snapshot.background();
                break;
            };
            if depth == 0 {
                first = Some(hit);
            }
            let meeting = self.meet(hit, ray);
            let lobes = meeting.material.lobes(&meeting.shading);
            if lobes.share > 0.0 {
                light += rgb(weight) * lobes.share * self.local(&meeting, &lobes);
            }
            let skipped = &mut self.stats.skipped;
            let Some(mirror) = lobes.mirror else {
                skipped.not_reflective += 1;
                break;
            };
            weight = weight.times(mirror.tint);
            if !goes_on(true, weight, depth, self.frame.view, skipped) {
                break;
            }
            self.stats.rays.reflection += 1;
            ray = mirrored(&meeting);
            leaving = Some(hit.place);
        }
        (light, first)
    }

    fn meet(&self, hit: Hit, ray: Ray) -> Meeting<'a> {
        let snapshot = self.frame.snapshot;
        let prim = &snapshot.prims()[hit.place.prim as usize];
        let point = ray.at(hit.crossing.t);
        let side = if hit.crossing.normal.dot(ray.direction) > 0.0 { -1.0 } else { 1.0 };
        let length = ray.direction.length();
        Meeting {
            hit,
            ray,
            material: &snapshot.materials()[prim.material as usize],
            point,
            normal: hit.crossing.normal * side,
            shading: ShadingPoint {
                position: (point - snapshot.origin_in_frame()).into(),
                normal: (hit.crossing.shading_normal * side).into(),
                to_viewer: (ray.direction / -length).into(),
                distance: hit.crossing.t * length,
            },
        }
    }

    /// What the base shows of itself, of ambient light, and of each light that reaches it.
    fn local(&mut self, meeting: &Meeting<'_>, lobes: &Lobes<f64>) -> Rgb {
        let snapshot = self.frame.snapshot;
        let mut light = rgb(lobes.unlit(Triple::of(lobes.share, snapshot.ambient_light())));
        if !lobes.is_lit() {
            self.stats.skipped.unlit_material += snapshot.lights().len() as u64;
            return light;
        }
        for lamp in snapshot.lights() {
            let arrival = lamp.arriving::<f64>(meeting.point.into());
            if let Some(cosine) = self.arrives(meeting, lamp, &arrival) {
                let shown = lobes.evaluate(&meeting.shading, arrival.towards, cosine);
                light += rgb(shown.times(lamp.irradiance(&arrival)));
            }
        }
        light
    }

    /// The cosine under which a light reaches the surface, if it does.
    fn arrives(&mut self, meeting: &Meeting<'_>, lamp: &Light, arrival: &Arrival<f64>) -> Option<f64> {
        if !arrival.lit {
            self.stats.skipped.out_of_cone += 1;
            return None;
        }
        let cosine = arrival.towards.dot(meeting.shading.normal);
        if !(cosine > 0.0 && arrival.towards.dot(meeting.normal.into()) > 0.0) {
            self.stats.skipped.facing_away += 1;
            return None;
        }
        if !lamp.shadow() {
            self.stats.skipped.shadow_off += 1;
            return Some(cosine);
        }
        self.stats.rays.shadow += 1;
        let (ray, span) = shadow_ray(meeting.point, lamp)?;
        let leaving = Some(meeting.hit.place);
        (!self.search.occluded(self.frame.snapshot, &ray, span, leaving)).then_some(cosine)
    }
}

/// The way from a point to a light.
pub(crate) fn shadow_ray(point: DVec3, lamp: &Light) -> Option<(Ray, Span)> {
    match lamp.position() {
        Some(position) => Some((Ray::new(point, position - point), Span::TO_LIGHT)),
        None => lamp.direction().map(|direction| (Ray::new(point, -direction), Span::AHEAD)),
    }
}

fn mirrored(meeting: &Meeting<'_>) -> Ray {
    let normal = meeting.normal.into();
    let normals = MirrorNormals { geometric: normal, shading: Some(meeting.shading.normal), facing: normal };
    let direction = mirror_direction(meeting.ray.direction.into(), &normals);
    Ray::new(meeting.point, direction.into())
}

fn rgb(light: Triple<f64>) -> Rgb {
    Rgb::new(light.x, light.y, light.z)
}
