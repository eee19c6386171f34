//! Two matte colours in squares, by position.

use glam::DVec3;

use super::footprint::{Footprint, mean_sign};
use super::{MirrorShare, Surface};
use crate::numeric::{PATTERN_ERROR, PATTERN_SHIFT};
use crate::part::Given;
use crate::texture::{Paint, TexturePoint, TextureSource};
use crate::{
    Coefficient, Field, FieldKind, InvalidPart, Lane, Lobes, Part, Rgb, ShadingPoint, Triple, Value, Values,
};

/// Matte; `color` where `|⌊x·scale⌋ + ⌊z·scale⌋|` is odd, `other` where it is even. On any shape, by position.
#[derive(Debug, Clone, PartialEq)]
pub struct Checker {
    color: Paint,
    other: Paint,
    scale: Coefficient,
    /// Cell numbers along x and z at the origin that positions are relative to, less a multiple of two.
    phase: [Coefficient; 2],
    mirror: MirrorShare,
}

impl Checker {
    /// With two albedos and the number of squares per metre.
    ///
    /// # Errors
    /// A channel outside 0..=1, a scale that is not positive.
    pub fn new(color: Rgb, other: Rgb, scale: f64) -> Result<Self, InvalidPart> {
        crate::part::make(
            &Values::new()
                .with("color", Value::Color(color))
                .with("other", Value::Color(other))
                .with("scale", Value::Number(scale)),
        )
    }

    /// Squares per metre, and the cell numbers along x and z at the origin that positions are relative to, less a multiple of
    /// two.
    #[must_use]
    pub fn grid(&self) -> (f64, [f64; 2]) {
        (self.scale.wide, self.phase.map(|phase| phase.wide))
    }

    /// In how many cells from the pattern's corner a point lies, along x and z.
    #[inline(always)]
    fn cells<L: Lane>(&self, at: &ShadingPoint<L>) -> [L; 2] {
        let scale = at.distance.of(self.scale);
        let [x, z] = self.phase;
        [at.position.x.mul_add(scale, at.distance.of(x)), at.position.z.mul_add(scale, at.distance.of(z))]
    }
}

impl Part for Checker {
    const NAME: &'static str = "checker";
    const DOC: &'static str = "Two matte colours in squares, by position over the ground.";
    const FIELDS: &'static [Field] = &[
        Field::required("color", FieldKind::Color, "", "Albedo of the odd squares.")
            .or(|| Value::Color(Rgb::WHITE)),
        Field::required("other", FieldKind::Color, "", "Albedo of the even squares.")
            .or(|| Value::Color(Rgb::BLACK)),
        Field::required("scale", FieldKind::Length, "1/m", "Squares per metre.").or(|| Value::Number(1.0)),
        MirrorShare::FIELD,
    ];

    fn make(given: &Given<'_>) -> Result<Self, InvalidPart> {
        Ok(Self {
            color: given.paint("color")?,
            other: given.paint("other")?,
            scale: Coefficient::new(given.positive("scale")?),
            phase: [Coefficient::new(PATTERN_SHIFT); 2],
            mirror: MirrorShare::given(given, Rgb::WHITE.into())?,
        })
    }

    fn values(&self) -> Values {
        Values::new()
            .with("color", self.color.value())
            .with("other", self.other.value())
            .with("scale", Value::Number(self.scale.wide))
            .with("reflectiveness", self.mirror.value())
    }
}

impl Surface for Checker {
    #[inline(always)]
    fn lobes<L: Lane>(&self, at: &ShadingPoint<L>) -> Lobes<L> {
        let [x, z] = self.cells(at);
        let cell = x.floor() + z.floor();
        let half = cell * cell.number(0.5);
        let odd = cell.number(0.25).less(half - half.floor());
        let albedo =
            Triple::select(odd, Triple::of(cell, self.color.base()), Triple::of(cell, self.other.base()));
        self.mirror.over(Lobes::matte(albedo))
    }

    #[inline(always)]
    fn mean_lobes<L: Lane>(&self, at: &ShadingPoint<L>, footprint: &Footprint<L>) -> Lobes<L> {
        let [x, z] = footprint.coordinates(at, self.cells(at), at.distance.of(self.scale));
        let half = at.distance.number(0.5);
        let odd = half - half * mean_sign(&x, &z);
        let (color, other) = (Triple::of(odd, self.color.base()), Triple::of(odd, self.other.base()));
        self.mirror.over(Lobes::matte(color.scale_add(odd, other.scale(at.distance.number(1.0) - odd))))
    }

    fn relative_to(&self, origin: DVec3) -> Self {
        let phase = |along: f64, phase: Coefficient| {
            Coefficient::new(along.mul_add(self.scale.wide, phase.wide).rem_euclid(2.0))
        };
        let [x, z] = self.phase;
        Self { phase: [phase(origin.x, x), phase(origin.z, z)], ..self.clone() }
    }

    fn is_pattern(&self) -> bool {
        true
    }

    #[inline(always)]
    fn undecided<L: Lane>(&self, at: &ShadingPoint<L>, error: L) -> L::Mask {
        let error = error * at.distance.of(self.scale);
        let [x, z] = self.cells(at);
        is_near_edge(x, error) | is_near_edge(z, error)
    }

    #[inline(always)]
    fn reduced(&self, position: DVec3) -> DVec3 {
        let middle = |along: f64, phase: Coefficient| {
            let cell = along.mul_add(self.scale.wide, phase.wide).floor();
            // The rest of a division by 2, exactly, and without a call.
            let parity = cell - 2.0 * (0.5 * cell).floor();
            (parity + 0.5 - phase.wide) / self.scale.wide
        };
        let [x, z] = self.phase;
        DVec3::new(middle(position.x, x), position.y, middle(position.z, z))
    }

    fn is_textured(&self) -> bool {
        self.color.is_textured() || self.other.is_textured() || self.mirror.is_textured()
    }

    fn resolved(&self, textures: &impl TextureSource, at: &TexturePoint) -> Self {
        Self {
            color: self.color.resolved(textures, at),
            other: self.other.resolved(textures, at),
            mirror: self.mirror.resolved(textures, at),
            ..self.clone()
        }
    }
}

/// Where a place in cells may lie on the other side of a cell's edge, if it is off by `error`.
#[inline(always)]
fn is_near_edge<L: Lane>(cell: L, error: L) -> L::Mask {
    let (half, one) = (cell.number(0.5), cell.number(1.0));
    let from_edge = half - (cell - cell.floor() - half).abs();
    let least = (cell.abs() + one + one).mul_add(cell.number(PATTERN_ERROR), error);
    // NaN is near an edge.
    !least.less(from_edge)
}
