//! The chapter *Closed forms*: scenes of known light, and what `catoptra probe` says of them.

use std::fmt::Write;

use catoptra_lab::closed_forms::{ClosedForm, ClosedRoom, closed_forms, closed_rooms};
use catoptra_tracer::{Control, ProbeOptions, Receiver, Snapshot, irradiance_at};
use miette::{IntoDiagnostic, Result};

use super::{Lab, parsed};

/// Parts of a wall along each side, in rooms whose light is added up: some, and twice as many.
const CELLS: [u32; 2] = [2, 4];

/// The chapter.
pub(super) fn markdown(lab: &Lab) -> Result<String> {
    let mut text = String::from(
        "\n## Closed forms\n\n\
         Irradiance where theory knows it: `catoptra probe` against quadrature over the lamps (`catoptra_lab::closed_forms`), which \
         shares nothing with the contour integrals that answer. Promised is 0.01 %, or a millionth of the lamp's radiance L where \
         little arrives.\n",
    );
    for form in closed_forms() {
        text += &of_form(lab, &form)?;
    }
    text += "\n### All light of a closed room\n\n\
             The irradiance on the walls of a closed black room, added up, is the power of the lamp in it. Each wall is divided into \
             2 x 2 and 4 x 4 parts of 16 x 16 points of a Gauss–Legendre rule; how far the two sums lie apart is the error of the rule. \
             The planes of flat lamps, where light on the walls begins, fall on borders between parts.\n\n\
             | lamp | power, W | sum, W | difference | of the rule |\n|---|--:|--:|--:|--:|\n";
    for room in closed_rooms() {
        text += &of_room(lab, &room)?;
    }
    Ok(text)
}

fn of_form(lab: &Lab, form: &ClosedForm) -> Result<String> {
    let at = form.points.iter().map(|known| (known.point, known.normal));
    let found = measured(lab, &form.scene, at)?;
    let mut text = format!(
        "\n### {}\n\nL = {}\n\n| point | normal | truth | ours | difference, L |\n|---|---|--:|--:|--:|\n",
        form.title,
        (form.radiance * 1e6).round() / 1e6
    );
    for (known, found) in form.points.iter().zip(found) {
        let [p, n] = [known.point, known.normal].map(|v| format!("{} {} {}", v.x, v.y, v.z));
        let off = (found - known.irradiance) / form.radiance;
        let _ = writeln!(text, "| {p} | {n} | {:.9} | {found:.9} | {off:.1e} |", known.irradiance);
    }
    Ok(text)
}

fn of_room(lab: &Lab, room: &ClosedRoom) -> Result<String> {
    let mut sums = [0.0; 2];
    for (sum, cells) in sums.iter_mut().zip(CELLS) {
        let points = room.points(cells);
        let found = measured(lab, &room.scene, points.iter().map(|(point, normal, _)| (*point, *normal)))?;
        *sum = points.iter().zip(found).map(|((.., area), found)| area * found).sum();
    }
    let [off, of_rule] = [sums[1] - room.power, sums[1] - sums[0]].map(|off| off / room.power);
    Ok(format!("| {} | {} | {:.9} | {off:.1e} | {of_rule:.1e} |\n", room.title, room.power, sums[1]))
}

/// The light at points of a scene, in its green channel.
fn measured(
    lab: &Lab,
    scene: &str,
    at: impl Iterator<Item = (catoptra_core::glam::DVec3, catoptra_core::glam::DVec3)>,
) -> Result<Vec<f64>> {
    let receivers: Vec<Receiver> =
        at.map(|(point, normal)| Receiver::new(point, normal)).collect::<Result<_, _>>().into_diagnostic()?;
    let snapshot = Snapshot::extract(&parsed(scene)?, &lab.pool);
    let options = ProbeOptions::default();
    let found = irradiance_at(&snapshot, &receivers, &options, &lab.pool, &Control::default());
    Ok(found.into_diagnostic()?.iter().map(|found| found.mean.g).collect())
}
