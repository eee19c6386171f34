//! Does a picture that is asked for in one line come, and say why not?
#![allow(clippy::unwrap_used, reason = "a test may stop at the first surprise")]

use catoptra_core::glam::DVec3;
use catoptra_core::{Camera, Scene};
use catoptra_tracer::{Cancelled, Control, Render, RenderError, Size};

#[test]
fn without_a_camera_there_is_no_picture() {
    let scene = Scene::new();
    assert!(matches!(Render::new(&scene).run(), Err(RenderError::NoCamera)));
    let camera = Camera::look_at(DVec3::Z, DVec3::ZERO, DVec3::Y, 0.8).unwrap();
    let film = Render::new(&scene).camera(camera).size(8, 6).run().unwrap();
    assert_eq!((film.size(), film.samples(3, 3)), (Size::new(8, 6), 1));
}

#[test]
fn a_cancelled_render_says_so_until_its_control_is_reset() {
    let (scene, control) = (Scene::new(), Control::default());
    let camera = Camera::look_at(DVec3::Z, DVec3::ZERO, DVec3::Y, 0.8).unwrap();
    let job = Render::new(&scene).camera(camera).size(8, 6).control(&control);
    control.cancel();
    assert!(matches!(job.clone().run(), Err(RenderError::Cancelled(Cancelled))));
    control.reset();
    assert!(job.run().is_ok());
    assert_eq!(control.progress(), 1.0);
}
