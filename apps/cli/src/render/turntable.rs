//! Where does a camera stand in each frame of a turntable?

use catoptra_core::glam::DVec3;
use catoptra_core::scene::{Role, Scene};
use catoptra_core::{Aabb, Aim, Camera, Placement};
use miette::{IntoDiagnostic, Result, miette};

/// A turn of the camera over so many frames.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Turntable {
    pub(super) frames: u32,
    degrees: f64,
    axis: DVec3,
}

impl Turntable {
    /// By so many degrees about an axis x, y, z; refused without an axis.
    pub(super) fn new(frames: u32, turn: &[f64]) -> Result<Self> {
        let [degrees, x, y, z] = *turn else { return Err(miette!("--turn takes four numbers")) };
        let axis = DVec3::new(x, y, z);
        if axis.try_normalize().is_none() {
            return Err(miette!(
                help = "write degrees and an axis, such as --turn 360 0 1 0",
                "the axis of --turn has no direction"
            ));
        }
        Ok(Self { frames, degrees, axis })
    }

    /// How far the camera is turned in a frame, counted from 1, degrees. The first is where it stands.
    pub(super) fn degrees(&self, frame: u32) -> f64 {
        self.degrees * f64::from(frame - 1) / f64::from(self.frames)
    }

    /// That in words.
    pub(super) fn words(&self, frame: u32) -> String {
        format!("{} degrees about {} {} {}", self.degrees(frame), self.axis.x, self.axis.y, self.axis.z)
    }

    /// The camera of a frame.
    pub(super) fn camera(&self, camera: &Camera, about: DVec3, frame: u32) -> Result<Camera> {
        let turned = Placement::IDENTITY.turned(about, self.axis, self.degrees(frame).to_radians());
        camera.placed(&turned.into_diagnostic()?).into_diagnostic()
    }
}

/// What a camera turns about: what it looks at, or else the middle of all that ends somewhere, or else a point before it.
pub(super) fn middle_of(scene: &Scene, camera: &Camera) -> DVec3 {
    if let Aim::Target(target) = camera.aim() {
        return target;
    }
    let bounds = scene.entities_of(Role::Shape).filter_map(|id| scene.world_bounds(id));
    let all = bounds.filter(|b| b.min.is_finite() && b.max.is_finite()).reduce(Aabb::union);
    all.map_or_else(|| camera.eye() + camera.forward(), |all| all.centre())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_whole_turn_is_a_loop_and_keeps_the_distance() {
        let camera = Camera::look_at(DVec3::new(0.0, 1.0, 4.0), DVec3::Y, DVec3::Y, 0.8).unwrap();
        let table = Turntable::new(4, &[360.0, 0.0, 2.0, 0.0]).unwrap();
        let eye = |frame| table.camera(&camera, DVec3::Y, frame).unwrap().eye();
        assert_eq!(eye(1), camera.eye());
        assert!(eye(2).distance(DVec3::new(4.0, 1.0, 0.0)) < 1e-12, "{}", eye(2));
        assert!(eye(5).distance(camera.eye()) < 1e-12);
        assert!(Turntable::new(4, &[360.0, 0.0, 0.0, 0.0]).is_err());
    }

    #[test]
    fn a_camera_without_a_target_turns_about_what_there_is() {
        let text = "camera \"c\" { eye 0 0 9; direction 0 0 -1 }\nmatte \"m\" { color 1 }\n\
            sphere \"s\" material=\"m\" { center 3 4 5; radius 1 }\nplane \"p\" material=\"m\"\n";
        let (scene, _) = catoptra_scene::parse(text, "text", None).unwrap();
        let camera = scene.world_camera(scene.main_camera().unwrap()).unwrap();
        assert_eq!(middle_of(&scene, &camera), DVec3::new(3.0, 4.0, 5.0));
    }
}
