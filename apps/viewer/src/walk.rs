//! Which keys move the camera while the right button is held? W and S ahead and back, A and D aside, Q and E down and up.

use winit::keyboard::Key;

use crate::input::Button;
use crate::viewer::Viewer;
use crate::{camera_control, gestures};

/// How far a key goes, and again with each repeat, as a share of the distance to what is looked at.
const STEP: f64 = 0.05;

/// Takes in a key that goes down; `false` if it moves nothing.
pub(crate) fn key(viewer: &mut Viewer, key: &Key) -> bool {
    let Key::Character(letter) = key else { return false };
    if !viewer.pointer.holds(Button::Right) {
        return false;
    }
    let aside = |right: f64, up: f64| camera_control::step(&viewer.camera, right * STEP, up * STEP);
    let camera = match letter.to_lowercase().as_str() {
        "w" => gestures::ahead(viewer, STEP),
        "s" => gestures::ahead(viewer, -STEP),
        "a" => aside(-1.0, 0.0),
        "d" => aside(1.0, 0.0),
        "q" => aside(0.0, -1.0),
        "e" => aside(0.0, 1.0),
        _ => return false,
    };
    viewer.look(camera);
    true
}

#[cfg(test)]
mod tests {
    use catoptra_core::glam::DVec3;
    use catoptra_tracer::Pool;

    use super::*;
    use crate::input::{Held, Mode};
    use crate::loader;

    #[test]
    fn letters_move_the_camera_while_the_right_button_is_held_and_not_else() {
        let mut viewer = Viewer::new(loader::welcome(&Pool::new(1).unwrap()).unwrap());
        viewer.size = (640, 360);
        let pressed = |letter: &str| Key::Character(letter.into());
        assert!(!key(&mut viewer, &pressed("w")));
        viewer.pointer.press(Button::Right, Held::default(), Mode::Orbit, None);
        for (letter, back) in [("w", "s"), ("D", "a"), ("e", "q")] {
            let home = viewer.camera.eye();
            assert!(key(&mut viewer, &pressed(letter)));
            let way: DVec3 = viewer.camera.eye() - home;
            let forward = way.normalize().dot(viewer.camera.forward());
            assert!(if letter == "w" { forward > 0.999 } else { forward.abs() < 1e-9 }, "{letter}: {way}");
            assert!(key(&mut viewer, &pressed(back)));
            // Steps are shares of a distance that has changed.
            assert!((viewer.camera.eye() - home).length() < 0.1 * way.length(), "{back}");
        }
        assert!(!key(&mut viewer, &pressed("x")));
    }
}
