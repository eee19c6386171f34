//! Which things take most of the time of a frame? Its tiles are traced one by one, and each tile's time is shared out among what
//! its pixels show.

use std::collections::HashMap;
use std::time::Instant;

use catoptra_core::EntityId;
use catoptra_tracer::{Cancelled, Control, Film, Region, Size, View, render};
use serde_json::{Value, json};

use crate::job::Job;
use crate::pool::milliseconds_since;
use crate::words::percent;

/// Edge of a tile, pixels: as small as times can still be told.
const TILE: u32 = 32;

/// Frames that would take longer, tile by tile, are not measured so: milliseconds.
const PATIENCE: f64 = 20_000.0;

/// So many things are named.
const NAMED: usize = 5;

/// What is seen, and what that takes.
pub(super) struct Slow {
    /// The most expensive first.
    things: Vec<Thing>,
    pixels: u64,
    milliseconds: f64,
}

/// A thing, or nothing at all, that pixels show.
struct Thing {
    name: Option<String>,
    milliseconds: f64,
    pixels: u64,
}

impl Slow {
    /// Traces a frame once more, tile by tile; empty where that would take too long.
    pub(super) fn measured(job: &Job, frame_ms: f64, control: &Control) -> Result<Self, Cancelled> {
        let mut costs: HashMap<Option<EntityId>, (f64, u64)> = HashMap::new();
        let (region, threads) = (job.view.region(), job.pool.threads() as f64);
        let (mut milliseconds, mut pixels) = (0.0, 0);
        if frame_ms * threads <= PATIENCE {
            for (x, y) in starts(region.size) {
                let size = Size::new(TILE.min(region.size.width - x), TILE.min(region.size.height - y));
                let part = Region::new(region.x + x, region.y + y, size);
                let view = View { crop: Some(part), ..job.view.clone() };
                let mut film = Film::of_region(part, TILE);
                let started = Instant::now();
                render(job.backend, &job.snapshot, &view, &mut film, &job.pool, control)?;
                let took = milliseconds_since(started);
                let each = took / size.pixels() as f64;
                for (x, y) in (0..size.height).flat_map(|y| (0..size.width).map(move |x| (x, y))) {
                    let cost = costs.entry(film.surface(x, y)).or_default();
                    *cost = (cost.0 + each, cost.1 + 1);
                }
                milliseconds += took;
                pixels += size.pixels() as u64;
            }
        }
        let named = |id: EntityId| job.scene.name(id).unwrap_or_default();
        let mut things: Vec<Thing> = costs
            .into_iter()
            .map(|(id, (milliseconds, pixels))| Thing { name: id.map(named), milliseconds, pixels })
            .collect();
        things.sort_by(|a, b| b.milliseconds.total_cmp(&a.milliseconds).then_with(|| a.name.cmp(&b.name)));
        Ok(Self { things, pixels, milliseconds })
    }

    /// A line for each of the most expensive.
    pub(super) fn as_lines(&self) -> Vec<String> {
        let line = |thing: &Thing| {
            let name = thing.name.as_ref().map_or_else(|| "nothing".to_owned(), |name| format!("\"{name}\""));
            let share = 100.0 * thing.milliseconds / self.milliseconds.max(f64::MIN_POSITIVE);
            format!(
                "{share:>10.1} %   of that where {name} is seen, on {} of the pixels",
                percent(thing.pixels, self.pixels)
            )
        };
        self.things.iter().take(NAMED).map(line).collect()
    }

    /// An object for each thing: what it takes of a frame that is traced tile by tile.
    pub(super) fn as_json(&self) -> Value {
        let object = |thing: &Thing| json!({ "entity": thing.name, "milliseconds": thing.milliseconds, "pixels": thing.pixels });
        self.things.iter().map(object).collect()
    }
}

/// The upper left corners of all tiles.
fn starts(size: Size) -> impl Iterator<Item = (u32, u32)> {
    let starts = |length: u32| (0..length).step_by(TILE as usize);
    starts(size.height).flat_map(move |y| starts(size.width).map(move |x| (x, y)))
}
