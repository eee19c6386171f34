//! How is a model file that is given as a scene seen? In a scene made for it, with a camera and light where it has none.

use std::path::Path;

use catoptra_core::Aabb;
use catoptra_core::glam::DVec3;
use catoptra_core::scene::{Role, Scene};

use crate::file::{SceneFile, parse_with};
use crate::read::Files;
use crate::report::SceneTextError;
use crate::watch::Watch;
use crate::write::{number, quoted};

/// Vertical field of view of the added camera, in degrees.
const VIEW: f64 = 30.0;

/// Direction from the model to the added camera: three quarters from the front, slightly above.
const FROM: DVec3 = DVec3::new(0.55, 0.38, 1.0);

/// What stands beside the model in the camera's picture, as a factor.
const MARGIN: f64 = 1.15;

/// Reads a model as a scene.
///
/// # Errors
/// A model that cannot be read, or whose name is no text.
pub(crate) fn load(path: &Path, watch: &Watch) -> Result<(Scene, SceneFile), SceneTextError> {
    let unnamed = || SceneTextError::unusable(path, "has a name that scene text cannot spell".to_owned());
    let file = path.file_name().and_then(|name| name.to_str()).ok_or_else(unnamed)?;
    let name = path.file_stem().and_then(|name| name.to_str()).unwrap_or(file);
    let mut files = Files::new(Some(path.parent().unwrap_or(Path::new("")))).watched(watch);
    if let Err(message) = files.model(file) {
        let prefix = format!("{}", path.display());
        let message = message.strip_prefix(&prefix).unwrap_or(&message).trim_start_matches([':', ' ', ',']);
        return Err(SceneTextError::unusable(path, message.to_owned()));
    }
    let model = format!("model {} {{ file {} }}\n", quoted(name), quoted(file));
    let shown = path.display().to_string();
    let (scene, alone) = parse_with(&model, &shown, files.clone())?;
    let bounds = scene.children(None).into_iter().filter_map(|id| scene.world_bounds(id));
    let bounds = bounds.fold(Aabb::EMPTY, Aabb::union);
    // What shines in a model is mostly a little lamp or a screen on it, and lights nothing to speak of.
    let dark = scene.lights().is_empty();
    let unseen = scene.entities_of(Role::Camera).next().is_none();
    let missing = match (dark, unseen) {
        (true, true) => "has no lights and no camera: a studio and a view were added",
        (true, false) => "has no lights: a studio was added",
        (false, true) => "has no camera: a view was added",
        (false, false) => return Ok((scene, alone)),
    };
    let Some(ball) = Ball::round(&bounds) else {
        return Err(SceneTextError::unusable(path, "holds nothing to be seen".to_owned()));
    };
    let text = [
        if unseen { ball.view() } else { String::new() },
        if dark { ball.studio(bounds.min.y) } else { String::new() },
        model,
    ];
    let (scene, file) = parse_with(&text.concat(), &shown, files)?;
    Ok((scene, file.with_added(Some(format!("{shown} {missing}")))))
}

/// A ball that holds the model.
struct Ball {
    center: DVec3,
    radius: f64,
}

impl Ball {
    fn round(bounds: &Aabb) -> Option<Self> {
        let center = bounds.min.midpoint(bounds.max);
        let radius = 0.5 * (bounds.max - bounds.min).length();
        // A single point is as large as it can be told from its neighbours.
        let radius = radius.max(1e-9 * center.abs().max_element()).max(1e-12);
        (center.is_finite() && radius.is_finite()).then_some(Self { center, radius })
    }

    /// A place in the text: relative to the ball's centre, in radii.
    fn place(&self, x: f64, y: f64, z: f64) -> String {
        words(self.center + DVec3::new(x, y, z) * self.radius)
    }

    /// A camera that has the whole ball in its picture, which may be higher than it is wide by a fourth.
    fn view(&self) -> String {
        let distance = MARGIN / (0.5 * VIEW.to_radians()).sin();
        let eye = FROM.normalize() * distance;
        format!(
            "camera \"view\" {{ eye {}; target {}; fov {} }}\n",
            self.place(eye.x, eye.y, eye.z),
            words(self.center),
            number(VIEW)
        )
    }

    /// A large light from the left above, a weaker one from the right, a sky and a floor at height `low`.
    fn studio(&self, low: f64) -> String {
        let length = |x: f64, y: f64, z: f64| words(DVec3::new(x, y, z) * self.radius);
        let floor = DVec3::new(self.center.x, low - 1e-4 * self.radius, self.center.z);
        format!(
            "settings {{ background 0.32 0.34 0.37 }}\n\
             ambient-light \"sky\" {{ radiance 0.25 }}\n\
             rectangle-light \"key\" {{ corner {}; edge-u {}; edge-v {}; radiance 9; visible #false }}\n\
             rectangle-light \"fill\" {{ corner {}; edge-u {}; edge-v {}; radiance 1.2; visible #false }}\n\
             matte \"floor\" {{ color 0.5 }}\n\
             disk \"floor\" material=\"floor\" {{ center {}; normal 0 1 0; radius {} }}\n",
            self.place(-3.0, 2.6, 1.2),
            length(1.0, 1.2, -1.0),
            length(1.5, 0.0, 1.5),
            self.place(2.2, 0.8, 2.8),
            length(0.0, 1.5, 0.0),
            length(1.2, 0.0, -1.2),
            words(floor),
            number(2.5 * self.radius),
        )
    }
}

fn words(v: DVec3) -> String {
    v.to_array().map(number).join(" ")
}
