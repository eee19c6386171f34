//! The list of lights, and the trait that each implements.
//!
//! A light says what would arrive at a point if nothing occluded it; shadows are the tracer's work.
//! A new light is one file here, its `mod` line and its name in the list below.

mod ambient;
mod directional;
mod disk;
mod environment;
mod luminaire;
mod point;
mod profile;
mod rectangle;
mod shining;
mod sphere;
mod spot;

pub use ambient::AmbientLight;
pub use directional::DirectionalLight;
pub use disk::DiskLight;
pub use environment::{Environment, EnvironmentLight, FromAfar};
pub use point::PointLight;
pub use profile::{IntensityProfile, Pole};
pub use rectangle::RectangleLight;
pub use shining::Lamp;
pub use sphere::SphereLight;
pub use spot::SpotLight;

use glam::DVec3;

use crate::{Constant3, Field, FieldKind, Lane, Placement, Rgb, Triple, Value};

/// What would arrive from a light at a point.
#[derive(Debug, Clone, Copy)]
pub struct Arrival<L: Lane> {
    /// Unit vector from the point to the light.
    pub direction: Triple<L>,
    /// The vector from the point to the light; a unit vector for a light at infinity.
    pub to_light: Triple<L>,
    /// 1 over the length of that vector.
    pub inverse_distance: L,
    /// Metres to the light; infinite for a light at infinity.
    pub distance: L,
    /// Irradiance on a surface that faces the light, in parts of the light's [colour](Emitter::color).
    pub strength: L,
    /// Where anything arrives at all; the other members mean nothing elsewhere.
    pub lit: L::Mask,
}

impl<L: Lane> Arrival<L> {
    /// The cosine between a unit normal and the direction to the light.
    #[inline(always)]
    pub fn cosine(&self, normal: Triple<L>) -> L {
        self.to_light.dot(normal) * self.inverse_distance
    }
}

/// What a light provides to the tracer and the editor.
pub trait Emitter {
    /// Whether there are directions in which it does not shine.
    const HAS_CONE: bool = false;

    /// What would arrive at `point`.
    fn arriving<L: Lane>(&self, point: Triple<L>) -> Arrival<L>;

    /// Calls a visitor with this light, or with what it is without something that it lacks; a light that arrives from no one
    /// direction calls none.
    #[inline(always)]
    fn accept(&self, visitor: impl LightVisitor)
    where
        Self: Sized,
    {
        visitor.visit(self);
    }

    /// What [`Arrival::strength`] is given in: W/m² per channel for a light at infinity, W/sr for others.
    fn color(&self) -> &Constant3;

    /// The same light, placed elsewhere.
    #[must_use]
    fn placed(&self, placement: &Placement) -> Self
    where
        Self: Sized;

    /// Radiance that arrives at every point from everywhere, never shadowed.
    fn ambient(&self) -> Rgb {
        Rgb::BLACK
    }

    /// The surface that shines, of a light that is one; it [arrives](Self::arriving) from nowhere else.
    fn lamp(&self) -> Option<Lamp> {
        None
    }

    /// What surrounds the scene, of a light that is that; it [arrives](Self::arriving) from nowhere else.
    fn environment(&self) -> Option<&Environment> {
        None
    }

    /// What a field that stands [instead of](Field::instead_of) another would have to be for the same light; `None` for
    /// other fields. Of a placed light it is what holds for its size in the world.
    fn equivalent(&self, _field: &str) -> Option<Value> {
        None
    }

    /// Its position, if it is a point.
    fn position(&self) -> Option<DVec3> {
        None
    }

    /// The unit vector along which it shines, if there is one.
    fn direction(&self) -> Option<DVec3> {
        None
    }

    /// Whether anything may arrive within `radius` metres of a point: never false where something does.
    fn may_reach(&self, _center: DVec3, _radius: f64) -> bool {
        true
    }

    /// Whether things throw shadows in its light.
    fn shadow(&self) -> bool;
}

/// Work that is compiled once per kind of light; called with one light.
pub trait LightVisitor {
    /// Works with a light of some kind.
    fn visit<E: Emitter>(self, light: &E);
}

crate::part::parts! {
    $ each_light
    /// A light, in its own space until it is [placed](Light::placed).
    pub enum Light {
        /// Parallel light from infinity.
        DirectionalLight,
        /// Light from a point, alike in all directions.
        PointLight,
        /// Light from a point into a cone.
        SpotLight,
        /// Light from everywhere.
        AmbientLight,
        /// Light from a rectangle.
        RectangleLight,
        /// Light from a disk.
        DiskLight,
        /// Light from a sphere.
        SphereLight,
        /// Light from all around, infinitely far away.
        EnvironmentLight,
    }
}

impl Light {
    /// Calls a visitor with the light as its own type.
    #[inline(always)]
    pub fn visit(&self, visitor: impl LightVisitor) {
        each_light!(self, light => light.accept(visitor));
    }

    /// See [`Emitter::arriving`].
    #[inline(always)]
    pub fn arriving<L: Lane>(&self, point: Triple<L>) -> Arrival<L> {
        each_light!(self, light => light.arriving(point))
    }

    /// Irradiance on a surface that faces the light, W/m² per channel, where something arrives.
    #[inline(always)]
    pub fn irradiance<L: Lane>(&self, arrival: &Arrival<L>) -> Triple<L> {
        Triple::of(arrival.strength, self.color()).scale(arrival.strength)
    }

    /// See [`Emitter::color`].
    #[inline(always)]
    #[must_use]
    pub fn color(&self) -> &Constant3 {
        each_light!(self, light => light.color())
    }

    /// See [`Emitter::placed`].
    #[must_use]
    pub fn placed(&self, placement: &Placement) -> Self {
        each_light!(self, light => light.placed(placement).into())
    }

    /// See [`Emitter::ambient`].
    #[must_use]
    pub fn ambient(&self) -> Rgb {
        each_light!(self, light => light.ambient())
    }

    /// See [`Emitter::lamp`].
    #[must_use]
    pub fn lamp(&self) -> Option<Lamp> {
        each_light!(self, light => light.lamp())
    }

    /// See [`Emitter::environment`].
    #[must_use]
    pub fn environment(&self) -> Option<&Environment> {
        each_light!(self, light => light.environment())
    }

    /// See [`Emitter::equivalent`].
    #[must_use]
    pub fn equivalent(&self, field: &str) -> Option<Value> {
        each_light!(self, light => light.equivalent(field))
    }

    /// See [`Emitter::position`].
    #[inline]
    #[must_use]
    pub fn position(&self) -> Option<DVec3> {
        each_light!(self, light => light.position())
    }

    /// See [`Emitter::direction`].
    #[inline]
    #[must_use]
    pub fn direction(&self) -> Option<DVec3> {
        each_light!(self, light => light.direction())
    }

    /// See [`Emitter::HAS_CONE`].
    #[must_use]
    pub fn has_cone(&self) -> bool {
        fn has_cone<E: Emitter>(_: &E) -> bool {
            E::HAS_CONE
        }
        each_light!(self, light => has_cone(light))
    }

    /// See [`Emitter::may_reach`].
    #[must_use]
    pub fn may_reach(&self, center: DVec3, radius: f64) -> bool {
        each_light!(self, light => light.may_reach(center, radius))
    }

    /// See [`Emitter::shadow`].
    #[inline]
    #[must_use]
    pub fn shadow(&self) -> bool {
        each_light!(self, light => light.shadow())
    }
}

const SHADOW: Field =
    Field::required("shadow", FieldKind::Flag, "", "Whether things throw shadows in this light.")
        .or(|| Value::Flag(true));

/// What arrives from any one direction where light comes from many at once: nothing.
#[inline(always)]
fn nothing_arrives<L: Lane>(point: Triple<L>) -> Arrival<L> {
    let zero = Triple::splat(point.x.number(0.0));
    Arrival {
        direction: zero,
        to_light: zero,
        inverse_distance: zero.x,
        distance: zero.x,
        strength: zero.x,
        lit: zero.x.less(zero.x),
    }
}

/// What arrives from a point that shines alike in all directions: the inverse square law.
#[inline(always)]
fn from_point<L: Lane>(position: Triple<L>, point: Triple<L>) -> Arrival<L> {
    let to_light = position - point;
    let distance2 = to_light.dot(to_light);
    let distance = distance2.sqrt();
    let inverse = distance.number(1.0) / distance;
    Arrival {
        direction: to_light.scale(inverse),
        to_light,
        inverse_distance: inverse,
        distance,
        strength: inverse * inverse,
        lit: distance2.number(0.0).less(distance2),
    }
}
