//! How is a thing placed by numbers? Position, three angles and a scale.

use catoptra_core::Placement;
use catoptra_core::glam::{DQuat, DVec3, EulerRot};
use egui::Ui;

use super::number::Pace;
use super::{spoken, widgets};

/// The order in which the three angles are applied.
const ORDER: EulerRot = EulerRot::YXZ;

/// Shows a placement; returns it changed, if it was.
pub(super) fn show(ui: &mut Ui, salt: u64, placement: &Placement) -> Option<Placement> {
    let mut changed = None;
    egui::Grid::new(("placement", salt)).num_columns(2).spacing([8.0, 4.0]).show(ui, |ui| {
        spoken::label(ui, "move").on_hover_text("metres along x, y and z");
        if let Some(to) = widgets::vector(ui, placement.translation(), Pace::Scene) {
            changed = Placement::new(placement.rotation(), to, placement.scale()).ok();
        }
        ui.end_row();
        spoken::label(ui, "turn").on_hover_text("degrees about x, y and z");
        if let Some(degrees) = widgets::vector(ui, degrees(placement.rotation()), Pace::Angle) {
            changed = Placement::new(rotation(degrees), placement.translation(), placement.scale()).ok();
        }
        ui.end_row();
        spoken::label(ui, "scale").on_hover_text("alike in every direction");
        if let Some(scale) = widgets::number(ui, placement.scale(), "", Pace::Value) {
            changed = Placement::new(placement.rotation(), placement.translation(), scale).ok();
        }
        ui.end_row();
    });
    changed
}

/// Degrees about x, y and z that make up a turn.
fn degrees(rotation: DQuat) -> DVec3 {
    let (y, x, z) = rotation.to_euler(ORDER);
    let tidy = |radians: f64| (radians.to_degrees() * 1e9).round() / 1e9 + 0.0;
    DVec3::new(tidy(x), tidy(y), tidy(z))
}

fn rotation(degrees: DVec3) -> DQuat {
    DQuat::from_euler(ORDER, degrees.y.to_radians(), degrees.x.to_radians(), degrees.z.to_radians())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn angles_make_the_turn_they_came_from() {
        for angles in [DVec3::ZERO, DVec3::new(10.0, 20.0, 30.0), DVec3::new(-80.0, 170.0, 5.0)] {
            let back = degrees(rotation(angles));
            assert!((back - angles).length() < 1e-6, "{angles} became {back}");
        }
    }

    #[test]
    fn a_turn_at_the_pole_survives() {
        let turn = rotation(DVec3::new(90.0, 40.0, 0.0));
        let again = rotation(degrees(turn));
        assert!(turn.dot(again).abs() > 1.0 - 1e-9);
    }
}
