//! How is something moved from where it stands?

use glam::DVec3;

use super::{Edit, EntityId, Scene, SceneError};

impl Scene {
    /// Moves an entity by so many metres along the axes of its group (of the world, outside of any), and answers with the
    /// edit that takes it back. One [`Edit::Placement`]; turn and scale stay.
    ///
    /// ```
    /// use catoptra_core::{Rgb, Scene, geometry::Sphere, glam::DVec3, material::Matte};
    ///
    /// # fn main() -> Result<(), Box<dyn std::error::Error>> {
    /// let mut scene = Scene::new();
    /// let clay = scene.add_material("clay", Matte::new(Rgb::grey(0.5))?)?;
    /// let ball = scene.add_shape("ball", Sphere::new(DVec3::ZERO, 1.0)?, clay, None)?;
    /// let back = scene.move_by(ball, DVec3::Y * 2.0)?;
    /// assert_eq!(scene.world_placement(ball).map(|at| at.translation()), Some(DVec3::Y * 2.0));
    /// scene.apply(back)?;
    /// assert_eq!(scene.world_placement(ball).map(|at| at.translation()), Some(DVec3::ZERO));
    /// # Ok(())
    /// # }
    /// ```
    ///
    /// # Errors
    /// An entity that is not there, a move that is not finite or leads past every number.
    pub fn move_by(&mut self, id: EntityId, by: DVec3) -> Result<Edit, SceneError> {
        let placement = self.placement(id).ok_or(SceneError::UnknownEntity(id))?;
        self.apply(Edit::Placement(id, placement.moved(by)?))
    }
}

#[cfg(test)]
mod tests {
    use super::super::fixture::Room;
    use super::*;

    #[test]
    fn a_move_that_leads_nowhere_changes_nothing() {
        let mut r = Room::new();
        let before = r.scene.revision();
        for by in [DVec3::NAN, DVec3::INFINITY] {
            assert!(matches!(r.scene.move_by(r.ball, by), Err(SceneError::Placement(_))));
        }
        assert_eq!(r.scene.revision(), before);
        let ball = r.ball;
        r.scene.apply(Edit::Remove(ball)).unwrap();
        assert_eq!(r.scene.move_by(ball, DVec3::X), Err(SceneError::UnknownEntity(ball)));
    }

    #[test]
    fn moves_add_up() {
        let mut r = Room::new();
        let start = r.scene.placement(r.ball).unwrap().translation();
        r.scene.move_by(r.ball, DVec3::X).unwrap();
        r.scene.move_by(r.ball, DVec3::Y).unwrap();
        assert_eq!(r.scene.placement(r.ball).unwrap().translation(), start + DVec3::X + DVec3::Y);
    }
}
