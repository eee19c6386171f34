//! Which overlays are drawn over a traced picture, and what of them stands under the pointer?

use crate::canvas::Canvas;
use crate::depth::DepthField;
use crate::gizmo::GIZMOS;
use crate::grip::{self, Grip};
use crate::layer::Layer;
use crate::manipulator::Constraint;
use crate::projection::Projection;
use crate::sight::Sight;
use crate::stage::Stage;
use crate::style::OverlayStyle;
use catoptra_core::glam::DVec3;
use catoptra_core::scene::{EntityId, Scene};
use catoptra_core::{Camera, InvalidPart, Light};

/// All that is drawn over one traced picture; what it shows can be clicked and dragged where it shows it.
#[derive(Debug, Clone, Copy)]
pub struct Overlay<'a> {
    /// The scene the gizmos speak of.
    pub scene: &'a Scene,
    /// The camera the picture is seen from; it need not be one of the scene's.
    pub camera: &'a Camera,
    /// Width of the picture in pixels; may be zero.
    pub width: u32,
    /// Height of the picture in pixels; may be zero.
    pub height: u32,
    /// How far each pixel sees; without it nothing is hidden.
    pub depth: Option<DepthField<'a>>,
    /// What is selected; members of a selected group count as selected, and ids the scene lacks are passed over.
    pub selection: &'a [EntityId],
    /// What is shown.
    pub style: OverlayStyle,
}

/// Pixels about a mark within which it is clicked, on a display of scale 1.
const MARK_REACH: f64 = 12.0;

impl Overlay<'_> {
    /// Draws the overlay onto `layer`, which takes on the overlay's size and loses what it held.
    ///
    /// In a picture of 1280 x 720 pixels the grid takes about 2 ms, a cone 1 ms (3 ms where it fills the picture),
    /// everything else together half of one.
    pub fn draw(&self, layer: &mut Layer) {
        let stage = self.stage();
        let Some(ground) = layer.begin(self.width, self.height) else { return };
        let mut canvas =
            Canvas::new(Sight { view: &stage.view, depth: self.depth, scale: stage.scale() }, ground);
        for gizmo in GIZMOS.iter().filter(|gizmo| (gizmo.shown)(&self.style)) {
            (gizmo.draw)(&stage, &mut canvas);
            canvas.flush();
        }
    }

    /// The light or camera whose mark stands under the pixel (`x`, `y`): of those within 12 pixels (times the
    /// scale), the nearest in the picture.
    pub fn mark_at(&self, x: f64, y: f64) -> Option<EntityId> {
        let stage = self.stage();
        let stage = &stage;
        let marks =
            GIZMOS.iter().filter(|gizmo| (gizmo.shown)(&self.style)).flat_map(|gizmo| (gizmo.marks)(stage));
        let near = marks.filter_map(|(id, point)| {
            let mark = stage.view.project(point)?;
            let off = (mark.x - x).hypot(mark.y - y);
            (off <= MARK_REACH * f64::from(stage.scale())).then_some((id, off))
        });
        near.min_by(|a, b| a.1.total_cmp(&b.1)).map(|(id, _)| id)
    }

    /// The handle of a light under the pixel (`x`, `y`), within 6 pixels (times the scale); those of selected lights come
    /// before others, nearer ones before farther ones.
    ///
    /// Rings of spot lights can be gripped while their cone is shown; the sides, corners and rims of lights that are surfaces
    /// while lights are shown and the light is selected.
    pub fn grip_at(&self, x: f64, y: f64) -> Option<Grip> {
        let any = self.style.cones || (self.style.lights && !self.selection.is_empty());
        if any { grip::grip_at(&self.stage(), x, y) } else { None }
    }

    /// The gripped light, in its own space, as it is once the pointer has dragged the handle to the pixel (`x`, `y`).
    ///
    /// A ring's point follows the pointer along the meridian it was gripped on. An inner angle is held between
    /// just over zero and the outer one, an outer angle between the inner one and pi (or what it is, if that is
    /// more). A side of a rectangle follows along the edge that it ends, a corner in the rectangle's plane; what is
    /// opposite stays. The rim of a disk follows along its radius, the outline of a sphere passes under the pointer. Lamps
    /// are held at two pixels (times the scale) or more. `None` when the light is gone, has no such handle any more, or is
    /// behind the eye.
    ///
    /// # Errors
    /// A light that core refuses, such as one of more than 3.4e38 metres.
    pub fn drag(&self, grip: Grip, x: f64, y: f64) -> Option<Result<Light, InvalidPart>> {
        grip::drag(&self.stage(), grip, x, y)
    }

    /// A light, in its own space, as it is once it aims at a point of the world; `None` for what aims nowhere, and at the
    /// light itself.
    ///
    /// # Errors
    /// A light that core refuses.
    pub fn aim(&self, light: EntityId, at: DVec3) -> Option<Result<Light, InvalidPart>> {
        let stage = self.stage();
        let placed = stage.lights.iter().find(|placed| placed.id == light)?;
        grip::aimed(&self.scene.light(light)?, placed, &self.scene.world_placement(light)?, at)
    }

    /// From where to where a selected light aims, in the world; `None` for what aims nowhere.
    pub fn aim_line(&self, light: EntityId) -> Option<[DVec3; 2]> {
        let stage = self.stage();
        let placed = stage.lights.iter().find(|placed| placed.id == light)?;
        grip::aim_line(&stage, placed)
    }

    /// The part of the style's manipulator under the pixel (`x`, `y`), if there is any.
    pub fn manipulator_at(&self, x: f64, y: f64) -> Option<Constraint> {
        let view = Projection::new(self.camera, self.width, self.height);
        self.style.manipulator?.handle_at(&view, (x, y), f64::from(self.style.scale()))
    }

    pub(crate) fn stage(&self) -> Stage<'_> {
        let view = Projection::new(self.camera, self.width, self.height);
        Stage::new(self.scene, view, self.style, self.selection)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sample::{self, HEIGHT, WIDTH, lit_by, spot};

    /// Opacity of every pixel, row-major.
    fn alphas(overlay: &Overlay<'_>) -> Vec<u8> {
        let mut layer = Layer::new();
        overlay.draw(&mut layer);
        layer.pixmap().unwrap().pixels().iter().map(|pixel| pixel.alpha()).collect()
    }

    fn sum(alphas: &[u8]) -> u64 {
        alphas.iter().map(|&alpha| u64::from(alpha)).sum()
    }

    const CONES: OverlayStyle = OverlayStyle { cones: true, beams: true, ..OverlayStyle::NONE };
    const AXES: OverlayStyle = OverlayStyle { axes: true, ..OverlayStyle::NONE };

    #[test]
    fn the_ring_of_a_spot_straight_ahead_is_a_circle_of_the_right_radius() {
        // Rings stand 4 m from the apex at (0, 2, 0): the outer one, at 30 degrees, 2 m about the axis.
        let (scene, _) = lit_by(spot(DVec3::new(0.0, 2.0, 0.0), DVec3::NEG_Z, 20.0, 60.0));
        let camera = sample::camera();
        let alphas = alphas(&sample::overlay(&scene, &camera, CONES));
        let depth = 10.0 + 4.0 * 30_f64.to_radians().cos();
        let radius = 0.5 * f64::from(HEIGHT) / 25_f64.to_radians().tan() * 2.0 / depth;
        for step in 0..48 {
            let (sin, cos) = (f64::from(step) * std::f64::consts::TAU / 48.0).sin_cos();
            let at = |radius: f64| {
                let (x, y) = (160.0 + radius * cos, 120.0 + radius * sin);
                alphas[y as usize * WIDTH as usize + x as usize]
            };
            let nearby = at(radius).max(at(radius - 0.7)).max(at(radius + 0.7));
            assert!(nearby > 110, "no ring at step {step}: {nearby}");
            assert_eq!(at(radius + 4.0), 0, "something outside of the ring at step {step}");
            assert!(at(radius - 4.0) < 40, "something inside of the ring at step {step}");
        }
    }

    #[test]
    fn a_hidden_line_is_fainter_and_dashed() {
        let (scene, camera) = (Scene::new(), sample::camera());
        let plain = sample::overlay(&scene, &camera, AXES);
        let metres = vec![1.0; (WIDTH * HEIGHT) as usize];
        let depth = Some(DepthField { width: WIDTH, height: HEIGHT, metres: &metres });
        let (seen, hidden) = (alphas(&plain), alphas(&Overlay { depth, ..plain }));
        assert!(sum(&hidden) > 0 && sum(&hidden) * 3 < sum(&seen), "{} {}", sum(&hidden), sum(&seen));
        // Along the x axis, 2 m below the eye: 171.5 pixels are the first row's share of it.
        let row = |alphas: &[u8]| {
            let strongest = (0..HEIGHT as usize).map(|y| &alphas[y * WIDTH as usize..][..WIDTH as usize]);
            let strongest = strongest.max_by_key(|row| sum(row)).unwrap();
            strongest[165..225].iter().filter(|&&alpha| alpha == 0).count()
        };
        assert_eq!(row(&seen), 0);
        assert!(row(&hidden) > 10, "gaps: {}", row(&hidden));
    }

    #[test]
    fn a_far_surface_hides_nothing() {
        let (scene, camera) = (Scene::new(), sample::camera());
        let plain = sample::overlay(&scene, &camera, AXES);
        let metres = vec![100.0; (WIDTH * HEIGHT) as usize];
        let depth = Some(DepthField { width: WIDTH, height: HEIGHT, metres: &metres });
        assert!(sum(&alphas(&plain)).abs_diff(sum(&alphas(&Overlay { depth, ..plain }))) < 200);
    }

    #[test]
    fn what_is_behind_the_eye_is_not_drawn() {
        let (scene, _) = lit_by(spot(DVec3::new(0.0, 2.0, 20.0), DVec3::Z, 20.0, 60.0));
        let camera = sample::camera();
        let style = OverlayStyle { lights: true, ..CONES };
        assert_eq!(sum(&alphas(&sample::overlay(&scene, &camera, style))), 0);
    }

    #[test]
    fn a_finer_display_doubles_the_width_of_lines() {
        let (scene, camera) = (Scene::new(), sample::camera());
        // Across the y axis, a little over the origin.
        let across = |scale| {
            let alphas = alphas(&sample::overlay(&scene, &camera, OverlayStyle { scale, ..AXES }));
            sum(&alphas[150 * WIDTH as usize..][..WIDTH as usize]) as f64
        };
        let ratio = across(2.0) / across(1.0);
        assert!((ratio - 2.0).abs() < 0.1, "{ratio}");
    }

    #[test]
    fn an_empty_picture_is_drawn_without_a_word() {
        let (scene, camera) = (sample::scene(), sample::camera());
        for (width, height) in [(0, 0), (0, 9), (9, 0), (1, 1)] {
            let overlay =
                Overlay { width, height, ..sample::overlay(&scene, &camera, OverlayStyle::default()) };
            let mut layer = Layer::new();
            overlay.draw(&mut layer);
            layer.blend_over(&mut vec![0; (width * height) as usize]);
            assert!(overlay.mark_at(f64::NAN, 0.0).is_none());
        }
    }

    #[test]
    fn a_cone_around_the_eye_does_not_tint_the_picture() {
        let (scene, _) = lit_by(spot(DVec3::new(0.0, 2.0, 11.0), DVec3::NEG_Z, 100.0, 140.0));
        let camera = sample::camera();
        let alphas = alphas(&sample::overlay(&scene, &camera, CONES));
        assert_eq!(alphas[60 * WIDTH as usize + 60], 0);
    }

    #[test]
    fn a_cone_is_lines_of_what_is_selected_unless_asked() {
        let (scene, light) = lit_by(spot(DVec3::new(0.0, 3.0, 0.0), DVec3::NEG_Y, 20.0, 60.0));
        let camera = sample::camera();
        let covered = |style: OverlayStyle, selection: &[_]| {
            let overlay = Overlay { selection, ..sample::overlay(&scene, &camera, style) };
            let shown = alphas(&overlay).into_iter().filter(|&alpha| alpha > 0).count();
            let grips = (0..HEIGHT).flat_map(|y| (0..WIDTH).map(move |x| (f64::from(x), f64::from(y))));
            (shown, grips.step_by(7).any(|(x, y)| overlay.grip_at(x, y).is_some()))
        };
        let lights = OverlayStyle { lights: true, ..OverlayStyle::NONE };
        let (mark, no_grip) = covered(lights, &[]);
        let (lines, grip) = covered(lights, &[light]);
        let (beam, _) = covered(OverlayStyle { beams: true, ..lights }, &[light]);
        assert!(!no_grip && grip, "the rings are gripped where they are seen");
        assert!(lines > 4 * mark && 2 * beam > 3 * lines, "{mark} {lines} {beam}");
        let (others, _) = covered(OverlayStyle { cones: true, ..lights }, &[]);
        assert!(others > 3 * mark, "all cones are shown when asked: {others}");
    }

    #[test]
    fn the_glow_of_a_cone_follows_its_falloff() {
        // Seen end-on, halfway between the rings: full light is over one level there, half over another.
        let (scene, light) = lit_by(spot(DVec3::new(0.0, 2.0, 0.0), DVec3::NEG_Z, 10.0, 80.0));
        let camera = sample::camera();
        let glow = |falloff: f64| {
            let value = catoptra_core::Value::Number(falloff);
            let bent = scene.light(light).unwrap().with("falloff", value).unwrap();
            let (scene, _) = lit_by(bent);
            let alphas = alphas(&sample::overlay(&scene, &camera, CONES));
            u32::from(alphas[120 * WIDTH as usize + 160 + 30])
        };
        assert!(glow(0.2) > glow(1.0) && glow(1.0) > glow(4.0), "{} {} {}", glow(0.2), glow(1.0), glow(4.0));
    }
}
