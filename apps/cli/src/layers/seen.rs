//! What layers are made from: the film, and what else is asked of the scene for them.

use std::sync::Arc;

use catoptra_core::Integrator;
use catoptra_scene::image::{Channel, Numbers, Samples};
use catoptra_tracer::{Caster, Control, Film, Size, Snapshot, View, WorldHit, render};
use miette::Result;
use serde_json::{Map, Value, json};

use super::even_light::evenly_lit;
use super::{Layer, Need, need};
use crate::job::Job;
use crate::memory;
use crate::surfaces::Surfaces;

/// All that layers are made from.
pub(crate) struct Seen<'a> {
    pub(super) job: &'a Job,
    pub(super) film: &'a Film,
    pub(super) surfaces: Option<Surfaces<'a>>,
    caster: Caster,
    /// The same picture in even light.
    pub(super) even: Option<Film>,
}

/// Bytes that layers take beside a film.
pub(crate) fn bytes_of(layers: &[&Layer], size: Size) -> u64 {
    let surfaces = if need(layers, Need::Surfaces) { Surfaces::bytes_of(size) } else { 0 };
    surfaces + if need(layers, Need::EvenLight) { Film::bytes_of(size) } else { 0 }
}

impl<'a> Seen<'a> {
    /// Asks for what the layers need; `None` where that was interrupted.
    pub(crate) fn of(
        job: &'a Job,
        film: &'a Film,
        layers: &[&Layer],
        control: &Control,
    ) -> Result<Option<Self>> {
        let surfaces = need(layers, Need::Surfaces)
            .then(|| Surfaces::seen(job.backend, &job.snapshot, &job.view, &job.pool))
            .transpose()?;
        let even = if need(layers, Need::EvenLight) {
            let Some(even) = in_even_light(job, control)? else { return Ok(None) };
            Some(even)
        } else {
            None
        };
        let caster = Caster::of_snapshot(Arc::clone(&job.snapshot), &job.scene);
        Ok(Some(Self { job, film, surfaces, caster, even }))
    }

    /// What the ray through the middle of a pixel meets.
    pub(super) fn met(&self, x: u32, y: u32) -> Option<WorldHit> {
        self.surfaces.as_ref()?.met(&self.caster, x, y)
    }

    /// What the numbers of the ids stand for: an object of names for each channel.
    pub(crate) fn manifest(&self) -> Option<Value> {
        let (surfaces, scene) = (self.surfaces.as_ref()?, &self.job.scene);
        let (mut entities, mut materials) = (Map::new(), Map::new());
        for id in surfaces.entities() {
            entities.insert(id.index().to_string(), json!(scene.name(id).unwrap_or_default()));
            if let Some(material) = scene.material_of(id) {
                materials.insert(material.index().to_string(), json!(scene.material_name(material)));
            }
        }
        Some(json!({ "id.entity": entities, "id.material": materials }))
    }
}

/// A channel of floating point numbers.
pub(super) fn float<'a>(name: &str, number: impl Fn(u32, u32) -> f32 + Sync + 'a) -> Channel<'a> {
    Channel { name: name.to_owned(), samples: Samples::Float(Box::new(number) as Numbers<'a, f32>) }
}

/// A channel of whole numbers.
pub(super) fn whole<'a>(name: &str, number: impl Fn(u32, u32) -> u32 + Sync + 'a) -> Channel<'a> {
    Channel { name: name.to_owned(), samples: Samples::Whole(Box::new(number) as Numbers<'a, u32>) }
}

/// The same picture where light of radiance 1 comes from everywhere, and none else: surfaces show their own colours.
fn in_even_light(job: &Job, control: &Control) -> Result<Option<Film>> {
    let scene = evenly_lit(&job.scene)?;
    let snapshot = Snapshot::extract(&scene, &job.pool);
    let view = View { integrator: Integrator::Whitted, max_depth: 0, range: None, ..job.view.clone() };
    let mut film = memory::film(view.region(), Film::TILE, false)?;
    let traced = render(job.backend, &snapshot, &view, &mut film, &job.pool, control);
    Ok(traced.ok().map(|_| film))
}
