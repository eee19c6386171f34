//! Is the light at points what theory knows, in scenes of all kinds of lamps and of what stands between?
#![allow(clippy::unwrap_used, reason = "a test may stop at the first surprise")]

use catoptra_core::glam::DVec3;
use catoptra_lab::closed_forms::{closed_forms, closed_rooms};
use catoptra_tests::parsed;
use catoptra_tracer::{Control, Irradiance, Pool, ProbeOptions, Receiver, Snapshot, irradiance_at};

fn measured(scene: &str, at: impl Iterator<Item = (DVec3, DVec3)>) -> Vec<Irradiance> {
    let pool = Pool::new(0).unwrap();
    let snapshot = Snapshot::extract(&parsed(scene), &pool);
    let receivers: Vec<Receiver> = at.map(|(point, normal)| Receiver::new(point, normal).unwrap()).collect();
    irradiance_at(&snapshot, &receivers, &ProbeOptions::default(), &pool, &Control::default()).unwrap()
}

#[test]
fn scenes_of_known_light_are_answered_within_what_is_promised() {
    let (mut points, mut worst) = (0, 0.0_f64);
    for form in closed_forms() {
        let found = measured(&form.scene, form.points.iter().map(|known| (known.point, known.normal)));
        for (known, found) in form.points.iter().zip(found) {
            assert_eq!(found.error.to_array(), [0.0; 3], "{}: {known:?} has a closed form", form.title);
            let found = found.mean.g;
            assert!(known.is_met_by(found, form.radiance), "{}: {known:?}, not {found}", form.title);
            let off = (found - known.irradiance).abs() / form.radiance;
            worst = worst.max(off);
            points += 1;
        }
    }
    assert!(points > 40);
    // Far below what is promised: nothing but rounding of both.
    assert!(worst < 1e-9, "{worst:e} of a radiance");
}

#[test]
fn the_walls_of_a_closed_room_receive_the_power_of_the_lamp() {
    for room in closed_rooms() {
        let points = room.points(2);
        let found = measured(&room.scene, points.iter().map(|(point, normal, _)| (*point, *normal)));
        let sum: f64 = points.iter().zip(found).map(|((.., area), found)| area * found.mean.g).sum();
        assert!((sum / room.power - 1.0).abs() < 1e-8, "{}: {sum} of {}", room.title, room.power);
    }
}
