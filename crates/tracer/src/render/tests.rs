//! What does a film hold after a render that was cancelled half way?

use catoptra_core::geometry::Sphere;
use catoptra_core::glam::DVec3;
use catoptra_core::material::Depth;
use catoptra_core::{Camera, Edit, EntityId, Rgb, Scene};

use super::*;
use crate::backend::sealed::Sealed;
use crate::{Size, backends};

/// Traces as another backend does, and asks to stop after every tile.
struct Impatient<'a> {
    backend: &'a dyn Backend,
    control: &'a Control,
}

impl Sealed for Impatient<'_> {}

impl Backend for Impatient<'_> {
    fn name(&self) -> &'static str {
        "impatient"
    }

    fn doc(&self) -> &'static str {
        "stops after a tile"
    }

    fn trace(&self, frame: &Frame<'_>, tile: &mut Tile) -> Stats {
        self.control.cancel();
        self.backend.trace(frame, tile)
    }
}

const SIZE: Size = Size::new(64, 48);

/// Six balls, each in a colour of its own, that fill the picture from left to right.
fn balls() -> (Scene, Vec<EntityId>) {
    let mut scene = Scene::new();
    let mut ball = |number: u32| {
        let color = Rgb::new(0.1, 0.1 * f64::from(number), 0.3);
        let name = format!("ball {number}");
        let own = scene.add_material(&name, Depth::new(color, 99.0).unwrap()).unwrap();
        let center = DVec3::new(0.3 * f64::from(number) - 0.75, 0.0, -4.0);
        scene.add_shape(&name, Sphere::new(center, 0.9).unwrap(), own, None).unwrap()
    };
    let ids = (0..6).map(&mut ball).collect();
    (scene, ids)
}

fn view() -> View {
    View::new(Camera::look_at(DVec3::ZERO, -DVec3::Z, DVec3::Y, 0.3).unwrap(), SIZE)
}

/// What each pixel shows: its light by its bits, and its surface.
fn pixels(film: &Film) -> Vec<([u32; 3], Option<EntityId>)> {
    let places = (0..SIZE.height).flat_map(|y| (0..SIZE.width).map(move |x| (x, y)));
    places.map(|(x, y)| (film.radiance(x, y).map(f32::to_bits), film.surface(x, y))).collect()
}

#[test]
fn no_pixel_names_a_surface_that_it_does_not_show() {
    let pool = Pool::new(1).unwrap();
    let (mut scene, ids) = balls();
    let earlier = Snapshot::extract(&scene, &pool);
    // All shapes after the first are numbered anew.
    scene.apply(Edit::Remove(ids[0])).unwrap();
    let later = Snapshot::extract(&scene, &pool);
    for backend in backends() {
        let whole = |snapshot: &Snapshot| {
            let mut film = Film::with_tiles(SIZE, 8);
            render(*backend, snapshot, &view(), &mut film, &pool, &Control::default()).unwrap();
            film
        };
        let mut film = whole(&earlier);
        let (before, after) = (pixels(&film), pixels(&whole(&later)));
        let control = Control::default();
        let impatient = Impatient { backend: *backend, control: &control };
        assert_eq!(render(&impatient, &later, &view(), &mut film, &pool, &control), Err(Cancelled));
        let mixed = pixels(&film);
        for (i, pixel) in mixed.iter().enumerate() {
            assert!(*pixel == before[i] || *pixel == after[i], "pixel {i} by {}: {pixel:?}", backend.name());
        }
        assert!(mixed != before && mixed != after, "{} stopped half way", backend.name());
    }
}
