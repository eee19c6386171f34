//! What does a material look like by itself? A ball of it stands on checkered ground under a lamp, and is traced small, on a
//! thread of its own.

use catoptra_core::scene::{Edit, MaterialId, Scene, TextureId};
use catoptra_core::{Camera, Finish, Material, Part as _, Texture, TextureSource};
use catoptra_tracer::{Control, Display, Film, Pool, Size, Snapshot, View, backends, render};
use egui::ColorImage;

use crate::frame_worker::Tracing;
use crate::refine::{Step, reduced};

/// Width and height of the picture, in pixels.
pub(crate) const SIDE: u32 = 96;

/// What stands round the ball, and the ball with no material of its own yet.
const STAGE: &str = r#"
settings { background 0.3 0.34 0.4; max-depth 8 }
camera "camera" { eye 0 1.7 4.6; target 0 0.94 0; fov 29 }
ambient-light "sky" { radiance 0.3 0.34 0.4 }
rectangle-light "lamp" { corner -3.2 3 2; edge-u 0.9 1.2 -0.9; edge-v 1.4 0 1.4; radiance 9 }
checker "ground" { color 0.55; other 0.2; scale 1.6 }
matte "ball" { color 0.5 }
plane "ground" material="ground"
sphere "ball" material="ball" { center 0 1 0; radius 1 }
"#;

/// Samples a pixel.
const SAMPLES: u32 = 4;

/// All that the look of a material depends on.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Sample {
    material: Material,
    finish: Finish,
    /// The textures that it names, in order.
    textures: Vec<(TextureId, Texture)>,
}

impl Sample {
    /// Of a material of a scene; `None` once it has been removed.
    pub(crate) fn of(scene: &Scene, id: MaterialId) -> Option<Self> {
        let (material, finish) = (scene.find_material(id)?.clone(), scene.finish(id));
        let (of_material, of_finish) = (material.values(), finish.values());
        let mut ids: Vec<TextureId> = of_material.textures().chain(of_finish.textures()).collect();
        ids.sort_unstable();
        ids.dedup();
        let textures = ids.into_iter().filter_map(|id| Some((id, scene.texture(id)?.clone()))).collect();
        Some(Self { material, finish, textures })
    }

    /// Puts it on the ball of a stage.
    fn dress(self, stage: &mut Scene, ball: MaterialId) {
        let add = |(id, texture): (TextureId, Texture)| Edit::AddTexture {
            name: id.to_string(),
            texture,
            id: Some(id),
        };
        let mut edits: Vec<Edit> = self.textures.into_iter().map(add).collect();
        edits.extend([Edit::Material(ball, self.material), Edit::Finish(ball, self.finish)]);
        let dressed = stage.apply(Edit::Batch(edits));
        debug_assert!(dressed.is_ok(), "a material with its textures was refused: {dressed:?}");
    }
}

/// A picture of a material.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Ball {
    pub(crate) sample: Sample,
    pub(crate) image: ColorImage,
}

/// Traces balls.
pub(crate) struct BallTracing {
    pool: Pool,
    stage: Scene,
    ball: MaterialId,
    camera: Camera,
}

impl BallTracing {
    /// On the threads of that pool.
    ///
    /// # Errors
    /// A report of what is wrong with the stage.
    pub(crate) fn new(pool: Pool) -> Result<Self, String> {
        let (stage, _) = catoptra_scene::parse(STAGE, "stage", None).map_err(|e| e.to_string())?;
        let camera = stage.main_camera().and_then(|id| stage.world_camera(id));
        let camera = camera.ok_or_else(|| "the stage has no camera".to_owned())?;
        let ball = stage.material_named("ball").ok_or_else(|| "the stage has no ball".to_owned())?;
        Ok(Self { pool, stage, ball, camera })
    }
}

/// A stage with a ball on it, ready to be traced.
pub(crate) struct Job {
    sample: Sample,
    snapshot: Snapshot,
    view: View,
}

impl Tracing for BallTracing {
    type Request = Sample;
    type Job = Job;
    type Frame = Ball;
    type Spare = Ball;

    fn prepare(&mut self, sample: Sample) -> Job {
        let mut stage = self.stage.clone();
        sample.clone().dress(&mut stage, self.ball);
        let size = Size::new(SIDE, SIDE);
        let view = View::of(&stage, self.camera.clone(), size).with_samples(SAMPLES);
        Job { sample, snapshot: Snapshot::extract(&stage, &self.pool), view }
    }

    fn size(job: &Job) -> (u32, u32) {
        (job.view.size.width, job.view.size.height)
    }

    fn trace(&mut self, job: &Job, step: Step, control: &Control, _: &mut Vec<Ball>) -> Option<Ball> {
        let (width, height) = reduced(job.view.size.width, job.view.size.height, step.divisor);
        let view = View { size: Size { width, height }, ..job.view.clone() };
        let mut film = Film::new(view.size);
        render(backends()[0], &job.snapshot, &view, &mut film, &self.pool, control).ok()?;
        let rgb = Display::Srgb.exposed(0.0).rgb8(&film);
        let image = ColorImage::from_rgb([width as usize, height as usize], &rgb);
        Some(Ball { sample: job.sample.clone(), image })
    }
}

#[cfg(test)]
mod tests {
    use catoptra_core::{Rgb, TextureUse, Value, Values};

    use super::*;

    fn traced(scene: &Scene, id: MaterialId) -> Ball {
        let mut tracing = BallTracing::new(Pool::new(1).unwrap()).unwrap();
        let job = tracing.prepare(Sample::of(scene, id).unwrap());
        tracing.trace(&job, Step::FULL, &Control::default(), &mut Vec::new()).unwrap()
    }

    /// The value of that colour.
    fn color(r: f64, g: f64, b: f64) -> Value {
        Value::Color(Rgb::new(r, g, b))
    }

    fn of_kind(kind: &str, values: &Values) -> (Scene, MaterialId) {
        let mut scene = Scene::new();
        let material = (Material::kind_named(kind).unwrap().make)(values).unwrap();
        let id = scene.add_material("it", material).unwrap();
        (scene, id)
    }

    /// Mean of a channel over the middle of the ball.
    fn middle(ball: &Ball, channel: usize) -> f64 {
        let side = SIDE as usize;
        let (from, to) = (side * 3 / 8, side * 5 / 8);
        let pixels = (from..to).flat_map(|y| (from..to).map(move |x| y * side + x));
        let sum: f64 = pixels.map(|i| f64::from(ball.image.pixels[i].to_array()[channel])).sum();
        sum / ((to - from) * (to - from)) as f64
    }

    #[test]
    fn the_ball_has_the_color_of_the_material() {
        let (scene, id) = of_kind("matte", &Values::new().with("color", color(0.8, 0.1, 0.1)));
        let ball = traced(&scene, id);
        assert!(middle(&ball, 0) > 2.0 * middle(&ball, 1), "{} {}", middle(&ball, 0), middle(&ball, 1));
    }

    #[test]
    fn every_kind_of_material_is_traced() {
        let grey = of_kind("matte", &Values::new().with("color", color(0.5, 0.5, 0.5))).0;
        let old = grey.materials().next().unwrap().2.clone();
        for kind in Material::KINDS {
            let mut scene = Scene::new();
            let id = scene.add_material("it", crate::retype::of_kind(&old, kind).unwrap()).unwrap();
            let ball = traced(&scene, id);
            assert!(middle(&ball, 1) > 8.0, "{} is black: {}", kind.name, middle(&ball, 1));
        }
    }

    #[test]
    fn a_texture_and_a_finish_are_seen_on_it() {
        let white = Values::new().with("color", color(1.0, 1.0, 1.0));
        let (mut scene, id) = of_kind("matte", &white);
        let plain = Sample::of(&scene, id).unwrap();
        let red = Values::new().with("color", color(1.0, 0.0, 0.0));
        let red = red.with("other", color(1.0, 0.0, 0.0));
        // The second texture, so that its id is not the first one of the stage.
        for name in ["a", "b"] {
            let checker = (Texture::kind_named("checker-texture").unwrap().make)(&red).unwrap();
            scene.add_texture(name, checker).unwrap();
        }
        let by = TextureUse::of(scene.texture_named("b").unwrap());
        let painted = scene.material(id).with("color", color(1.0, 1.0, 1.0).textured(by)).unwrap();
        scene.apply(Edit::Material(id, painted)).unwrap();
        assert!(Sample::of(&scene, id).unwrap() != plain);
        let ball = traced(&scene, id);
        assert!(middle(&ball, 0) > 100.0 && middle(&ball, 1) < 10.0);
        let gone = Finish::default().with("opacity", Value::Number(0.0)).unwrap();
        scene.apply(Edit::Finish(id, gone)).unwrap();
        assert!(middle(&traced(&scene, id), 1) > 30.0, "one sees through it");
    }
}
