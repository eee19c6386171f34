//! How a camera is written: its fields, and which of them go together.

use std::f64::consts::PI;

use glam::DVec3;

use super::{Aim, Camera, Extent};
use crate::part::Given;
use crate::{Field, FieldKind, InvalidPart, Part, Value, Values};

const PROJECTION: &str = "projection";
const PROJECTIONS: &[&str] = &["perspective", "orthographic"];
pub(super) const FOV: &str = "fov";
pub(super) const HEIGHT: &str = "height";
pub(super) const LENS_RADIUS: &str = "lens-radius";
pub(super) const FOCUS: &str = "focus";

impl Part for Camera {
    const NAME: &'static str = "camera";
    const DOC: &'static str = "A camera, perspective or orthographic.";
    const FIELDS: &'static [Field] = &[
        Field::required("eye", FieldKind::Point, "m", "Where the camera stands."),
        Field::required("target", FieldKind::Point, "m", "The point it looks at; give this or direction.")
            .optional(),
        Field::required("direction", FieldKind::Direction, "", "The way it looks; give this or target.")
            .optional(),
        Field::required("up", FieldKind::Direction, "", "Roughly upwards in the picture.")
            .or(|| Value::Vector(DVec3::Y)),
        Field::required(FOV, FieldKind::Angle, "°", "Field of view from the lower to the upper edge.")
            .or(|| Value::Number(PI / 4.0)),
        Field::required(
            PROJECTION,
            FieldKind::Choice(PROJECTIONS),
            "",
            "Whether rays run from the eye, or side by side along the view.",
        )
        .or(|| Value::Word(PROJECTIONS[0].to_owned())),
        Field::required(
            HEIGHT,
            FieldKind::Length,
            "m",
            "What an orthographic camera sees from the lower to the upper edge.",
        )
        .optional(),
        Field::required(
            LENS_RADIUS,
            FieldKind::Number,
            "m",
            "Radius of the lens; 0 for a pinhole, which sees all sharp.",
        )
        .or(|| Value::Number(0.0)),
        Field::required(FOCUS, FieldKind::Length, "m", "How far along the view things are sharp.").optional(),
    ];

    fn make(given: &Given<'_>) -> Result<Self, InvalidPart> {
        let aim = match (given.has("target"), given.has("direction")) {
            (true, false) => Aim::Target(given.point("target")?),
            (false, true) => Aim::Direction(given.direction("direction")?),
            (true, true) => {
                return Err(InvalidPart::new("direction", "must not be given beside target", "given"));
            }
            (false, false) => {
                return Err(InvalidPart::new("target", "must be given, or direction", "missing"));
            }
        };
        let focus = given.has(FOCUS).then(|| given.positive(FOCUS)).transpose()?;
        let camera = Self::new(given.point("eye")?, aim, given.direction("up")?, given.number(FOV)?)?;
        let is_orthographic = given.choice(PROJECTION)? == 1;
        let camera = match (is_orthographic, given.has(HEIGHT)) {
            (false, false) => camera,
            (true, _) if given.has(FOV) => {
                let refused = InvalidPart::new(FOV, "must not be given to an orthographic camera", "given");
                return Err(refused.with_hint("give height, in metres, in its place"));
            }
            (true, true) => camera.with_extent(Extent::Height(given.positive(HEIGHT)?))?,
            (true, false) => {
                let refused = InvalidPart::new(HEIGHT, "must be given to an orthographic camera", "missing");
                return Err(refused.with_hint("write how many metres it sees, such as height 5"));
            }
            (false, true) => {
                let refused =
                    InvalidPart::new(HEIGHT, "must stand beside projection \"orthographic\"", "alone");
                return Err(refused.with_hint("write projection \"orthographic\" too, or fov in its place"));
            }
        };
        camera.with_lens(given.not_negative(LENS_RADIUS)?, focus)
    }

    fn values(&self) -> Values {
        let values = Values::new().with("eye", Value::Vector(self.eye));
        let values = match self.aim {
            Aim::Target(target) => values.with("target", Value::Vector(target)),
            Aim::Direction(direction) => values.with("direction", Value::Vector(direction)),
        };
        let values = values.with("up", Value::Vector(self.up_hint));
        let projection = |i: usize| Value::Word(PROJECTIONS[i].to_owned());
        let values = match self.extent {
            Extent::Angle(fov) => values.with(FOV, Value::Number(fov)).with(PROJECTION, projection(0)),
            Extent::Height(height) => {
                values.with(PROJECTION, projection(1)).with(HEIGHT, Value::Number(height))
            }
        };
        let values = values.with(LENS_RADIUS, Value::Number(self.lens_radius));
        match self.focus {
            Some(focus) => values.with(FOCUS, Value::Number(focus)),
            None => values,
        }
    }
}
