//! Which materials there are, and what a material must answer.
//!
//! A material says how much of arriving light leaves towards the viewer and how much of what it mirrors; it never
//! asks what arrives. A new material is one file here, its `mod` line and its name in the list below.

mod checker;
mod depth;
mod matte;
mod mirror;
mod phong;

pub use checker::Checker;
pub use depth::Depth;
pub use matte::Matte;
pub use mirror::Mirror;
pub use phong::Phong;

use glam::DVec3;

use crate::lane::Constant3;
pub use crate::lobe::ShadingPoint;
use crate::{Coefficient, Field, FieldKind, Lane, Triple, Value};

/// What the integrator asks of a material.
pub trait Surface {
    /// Radiance shown without any light's help.
    #[inline(always)]
    fn own<L: Lane>(&self, at: &ShadingPoint<L>) -> Triple<L> {
        Triple::splat(at.distance.number(0.0))
    }

    /// Radiance shown for each unit of ambient radiance: as a rule, the [albedo](Self::albedo).
    #[inline(always)]
    fn under_ambient<L: Lane>(&self, at: &ShadingPoint<L>) -> Triple<L> {
        self.albedo(at)
    }

    /// Share of arriving light that is sent on alike in all directions (albedo): radiance over irradiance, times π.
    #[inline(always)]
    fn albedo<L: Lane>(&self, at: &ShadingPoint<L>) -> Triple<L> {
        Triple::splat(at.distance.number(0.0))
    }

    /// Whether it sends on more in some directions than in others.
    fn is_glossy(&self) -> bool {
        false
    }

    /// What it sends on more than [`albedo`](Self::albedo) says: radiance for each unit of irradiance (at normal
    /// incidence) from the direction `towards`, a unit vector whose `cosine` to the normal is positive.
    #[inline(always)]
    fn gloss<L: Lane>(&self, at: &ShadingPoint<L>, _towards: Triple<L>, _cosine: L) -> Triple<L> {
        Triple::splat(at.distance.number(0.0))
    }

    /// Whether lights make any difference to it.
    fn answers_light(&self) -> bool {
        true
    }

    /// Share of what is seen that is reflected, 0..=1; the rest is the surface's own look.
    fn reflectiveness(&self) -> Coefficient;

    /// What reflected light is multiplied by, beside the reflectiveness.
    fn reflection_color(&self) -> Constant3 {
        crate::Rgb::WHITE.into()
    }

    /// The same material for positions that are counted from `origin`, a point of the scene.
    #[must_use]
    fn relative_to(&self, _origin: DVec3) -> Self
    where
        Self: Clone,
    {
        self.clone()
    }

    /// Whether its look jumps from one position to the next; only then are positions
    /// [`undecided`](Self::undecided).
    fn is_pattern(&self) -> bool {
        false
    }

    /// Where its look could jump if the position were off by up to `error` metres and the formula by its roundings in
    /// `f32`.
    #[inline(always)]
    fn undecided<L: Lane>(&self, _at: &ShadingPoint<L>, error: L) -> L::Mask {
        error.less(error)
    }

    /// A position that looks the same as this one, and so for certain: far from where the look jumps, and near zero.
    #[inline(always)]
    fn reduced(&self, position: DVec3) -> DVec3 {
        position
    }
}

crate::part::parts! {
    $ each_material
    /// A material.
    pub enum Material {
        /// Lambert.
        Matte,
        /// Blinn–Phong.
        Phong,
        /// Two colours in squares.
        Checker,
        /// Colour that fades with distance.
        Depth,
        /// Perfect reflection.
        Mirror,
    }
}

impl Material {
    /// See [`Surface::own`].
    #[inline(always)]
    pub fn own<L: Lane>(&self, at: &ShadingPoint<L>) -> Triple<L> {
        each_material!(self, material => material.own(at))
    }

    /// See [`Surface::under_ambient`].
    #[inline(always)]
    pub fn under_ambient<L: Lane>(&self, at: &ShadingPoint<L>) -> Triple<L> {
        each_material!(self, material => material.under_ambient(at))
    }

    /// See [`Surface::albedo`].
    #[inline(always)]
    pub fn albedo<L: Lane>(&self, at: &ShadingPoint<L>) -> Triple<L> {
        each_material!(self, material => material.albedo(at))
    }

    /// See [`Surface::is_glossy`].
    #[inline]
    #[must_use]
    pub fn is_glossy(&self) -> bool {
        each_material!(self, material => material.is_glossy())
    }

    /// See [`Surface::gloss`].
    #[inline(always)]
    pub fn gloss<L: Lane>(&self, at: &ShadingPoint<L>, towards: Triple<L>, cosine: L) -> Triple<L> {
        each_material!(self, material => material.gloss(at, towards, cosine))
    }

    /// Radiance shown of itself, under ambient radiance, and of light that gives so much irradiance in all: all but the
    /// [gloss](Self::gloss). Only what the kind of material needs is asked of `at`.
    #[inline(always)]
    pub fn shown<L: Lane>(
        &self,
        at: impl Fn() -> ShadingPoint<L>,
        ambient: Triple<L>,
        irradiance: Triple<L>,
    ) -> Triple<L> {
        each_material!(self, material => {
            let at = &at();
            let own = material.under_ambient(at).times_add(ambient, material.own(at));
            material.albedo(at).scale(ambient.x.of(LAMBERT)).times_add(irradiance, own)
        })
    }

    /// Radiance shown for each unit of irradiance (at normal incidence) from the direction `towards`, a unit vector
    /// whose `cosine` to the normal is positive: the BRDF times the cosine.
    #[inline(always)]
    pub fn under_light<L: Lane>(&self, at: &ShadingPoint<L>, towards: Triple<L>, cosine: L) -> Triple<L> {
        self.albedo(at).scale(cosine * cosine.of(LAMBERT)) + self.gloss(at, towards, cosine)
    }

    /// See [`Surface::answers_light`].
    #[inline]
    #[must_use]
    pub fn answers_light(&self) -> bool {
        each_material!(self, material => material.answers_light())
    }

    /// See [`Surface::reflectiveness`].
    #[inline]
    #[must_use]
    pub fn reflectiveness(&self) -> Coefficient {
        each_material!(self, material => material.reflectiveness())
    }

    /// See [`Surface::reflection_color`].
    #[inline]
    #[must_use]
    pub fn reflection_color(&self) -> Constant3 {
        each_material!(self, material => material.reflection_color())
    }
}

/// Patterns, and where they are.
impl Material {
    /// See [`Surface::relative_to`].
    #[must_use]
    pub fn relative_to(&self, origin: DVec3) -> Self {
        each_material!(self, material => material.relative_to(origin).into())
    }

    /// See [`Surface::is_pattern`].
    #[must_use]
    pub fn is_pattern(&self) -> bool {
        each_material!(self, material => material.is_pattern())
    }

    /// See [`Surface::undecided`].
    #[inline(always)]
    pub fn undecided<L: Lane>(&self, at: &ShadingPoint<L>, error: L) -> L::Mask {
        each_material!(self, material => material.undecided(at, error))
    }

    /// See [`Surface::reduced`].
    #[must_use]
    #[inline(always)]
    pub fn reduced(&self, position: DVec3) -> DVec3 {
        each_material!(self, material => material.reduced(position))
    }
}

const REFLECTIVENESS: Field = Field::required(
    "reflectiveness",
    FieldKind::Fraction,
    "",
    "Share of what is seen that is reflected; the rest is the surface's own look.",
)
.or(|| Value::Number(0.0));

/// 1/π: what a Lambert surface of albedo 1 sends on, per unit of irradiance.
const LAMBERT: Coefficient = Coefficient::new(std::f64::consts::FRAC_1_PI);
