//! The list of passes: what a picture can show of a scene instead of how it looks.
//!
//! A new pass is one new file here and one line in [`PASSES`].

mod albedo;
mod depth;
mod entity;
mod false_color;
mod irradiance;
mod normal;
mod picture;
mod uv;
mod work;

use std::collections::HashMap;
use std::sync::Arc;

use catoptra_core::scene::{EntityId, Scene};
use catoptra_core::{Integrator, Placement, Shape};
use catoptra_scene::image::false_color::Scale;
use catoptra_tracer::{Backend, Control, Film, Hit, Pool, Snapshot, View};

use crate::light_parts::LightParts;
use crate::lighting::Illumination;

/// One way to show a scene.
pub(crate) struct Pass {
    /// Its name in the panel.
    pub(crate) name: &'static str,
    /// What it shows, in a sentence.
    pub(crate) doc: &'static str,
    /// Which light falls on the scene.
    pub(crate) illumination: Illumination,
    /// What it is traced by, with a single ray to a pixel; without, as the scene's settings say.
    pub(crate) integrator: Option<Integrator>,
    /// Its colours; without, those of the light on the film, by exposure and display transform.
    pub(crate) paint: Option<fn(&Seen<'_>) -> Option<Painted>>,
}

/// All passes; the first is the picture itself.
pub(crate) const PASSES: &[Pass] = &[
    picture::PASS,
    albedo::PASS,
    normal::PASS,
    depth::PASS,
    uv::PASS,
    entity::PASS,
    irradiance::PASS,
    work::TESTS,
    work::SETTLED,
    work::TIME,
];

/// What a pass may look at.
pub(crate) struct Seen<'a> {
    /// The traced film.
    pub(crate) film: &'a Film,
    /// What was traced.
    pub(crate) snapshot: &'a Snapshot,
    /// The view of the film, of its size.
    pub(crate) view: &'a View,
    /// Who traces.
    pub(crate) backend: &'static dyn Backend,
    /// All shapes as they are before they are placed.
    pub(crate) own: &'a OwnShapes,
    /// The scene by each of its lights, where the pass looks at these.
    pub(crate) lights: &'a LightParts,
    /// The threads to work on.
    pub(crate) pool: &'a Pool,
    /// Says when nobody wants the answer any more; a pass then answers `None`.
    pub(crate) control: &'a Control,
}

/// What a pass makes of a film.
pub(crate) struct Painted {
    /// 0x00RRGGBB, as many as the film has pixels.
    pub(crate) colors: Vec<u32>,
    /// The numbers that the colours stand for.
    pub(crate) numbers: Option<Numbers>,
}

/// The numbers behind false colours.
pub(crate) struct Numbers {
    /// As many as the film has pixels; NaN where there is nothing.
    pub(crate) values: Vec<f32>,
    /// Which colour stands for which.
    pub(crate) scale: Scale,
    /// What they are given in.
    pub(crate) unit: &'static str,
    /// The share of each light, by its name: as many numbers as the film has pixels.
    pub(crate) shares: Vec<(String, Vec<f32>)>,
}

/// The shares of so many lights are told at the most.
const TOLD: usize = 8;

impl Numbers {
    /// What is told of a pixel of a thing of that name: its number, and of single lights what each gives, most first.
    pub(crate) fn words(&self, pixel: usize, name: &str) -> String {
        let number = |value: f32| crate::panel::short(f64::from(value));
        let told = format!("{} {}  ·  {name}", number(self.values[pixel]), self.unit);
        let mut shares: Vec<(&str, f32)> =
            self.shares.iter().map(|(light, values)| (light.as_str(), values[pixel])).collect();
        shares.sort_by(|a, b| b.1.total_cmp(&a.1));
        let sum: f32 = shares.iter().map(|(_, value)| value).sum();
        let line = |(light, value): &(&str, f32)| {
            let percent = if sum > 0.0 { 100.0 * value / sum } else { 0.0 };
            format!("{light}: {} ({percent:.0} %)", number(*value))
        };
        let lines = shares.iter().take(TOLD).map(line);
        std::iter::once(told).chain(lines).collect::<Vec<_>>().join("\n")
    }
}

/// Shapes in their own spaces, and the ways there out of the world.
pub(crate) type OwnShapes = Arc<HashMap<EntityId, (Shape, Placement)>>;

/// The shapes of a scene before they are placed, and the lamps that are bodies.
pub(crate) fn own_shapes(scene: &Scene) -> OwnShapes {
    let shape = |id| scene.shape(id).or_else(|| Some(scene.light(id)?.lamp()?.shape));
    let own = |id| Some((id, (shape(id)?, scene.world_placement(id)?.inverse())));
    Arc::new(scene.entities().filter_map(own).collect())
}

impl Seen<'_> {
    /// The middle of each pixel of the film, row by row from the top left.
    fn pixels(&self) -> impl Iterator<Item = (u32, u32)> + use<> {
        let size = self.film.size();
        (0..size.height).flat_map(move |y| (0..size.width).map(move |x| (x, y)))
    }

    /// What `of` says of each pixel, row by row, found on all threads; `None` when it was cancelled.
    fn map<T: Send>(&self, of: impl Fn(u32, u32) -> T + Sync) -> Option<Vec<T>> {
        use rayon::prelude::*;
        let size = self.film.size();
        let row = |y: u32| -> Option<Vec<T>> {
            (!self.control.is_cancelled()).then(|| (0..size.width).map(|x| of(x, y)).collect())
        };
        let rows: Option<Vec<Vec<T>>> = self.pool.run(|| (0..size.height).into_par_iter().map(row).collect());
        Some(rows?.into_iter().flatten().collect())
    }

    /// What is met through the middle of a pixel.
    fn hit(&self, x: u32, y: u32) -> Option<Met> {
        let size = self.film.size();
        let (across, down) = (f64::from(x) + 0.5, f64::from(y) + 0.5);
        let ray = self.view.camera.ray(across, down, size.width, size.height);
        let hit =
            self.snapshot.nearest_in_frame(&self.snapshot.own_ray(&ray), catoptra_core::Span::AHEAD, None)?;
        let leans_away = hit.crossing.normal.dot(ray.direction) > 0.0;
        let side = if leans_away { -1.0 } else { 1.0 };
        let entity = self.snapshot.entities()[hit.surface.prim as usize];
        Some(Met { entity, point: ray.at(hit.crossing.t), side, hit })
    }
}

/// What a ray through a pixel meets.
struct Met {
    entity: EntityId,
    /// In the world.
    point: catoptra_core::glam::DVec3,
    /// -1 where it is the back that is seen, else 1.
    side: f64,
    hit: Hit,
}

/// Red, green and blue, each 0 to 1, as 0x00RRGGBB.
fn packed(color: [f64; 3]) -> u32 {
    let [r, g, b] = color.map(|v| (v.clamp(0.0, 1.0) * 255.0).round() as u32);
    r << 16 | g << 8 | b
}

/// What stands for no surface at all.
const NOTHING: u32 = 0x0012_1418;

#[cfg(test)]
mod tests;
