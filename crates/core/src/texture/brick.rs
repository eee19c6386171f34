//! Bricks in rows, with mortar between; on average over what a pixel shows.

use glam::DVec2;

use super::transform::{Flat, Transform};
use super::{Pattern, Texel, TexturePoint, mixed};
use crate::part::Given;
use crate::{Field, FieldKind, InvalidPart, Part, Rgb, Value, Values};

/// A wall of bricks, with half of the mortar's width on each side of each. Row `i` is moved along by `i · row_offset` bricks.
#[derive(Debug, Clone, PartialEq)]
pub struct BrickTexture {
    color: Rgb,
    mortar: Rgb,
    size: DVec2,
    mortar_width: f64,
    row_offset: f64,
    transform: Transform,
}

impl BrickTexture {
    /// Bricks of a colour and a size (width and height, in texture coordinates), mortar between; [`with`](Part::with)
    /// sets its `mortar-width`, `row-offset`, `mapping`, `scale`, `offset` and `turn`.
    ///
    /// # Errors
    /// A channel outside 0..=1, a size that is not positive.
    pub fn new(color: Rgb, mortar: Rgb, size: DVec2) -> Result<Self, InvalidPart> {
        let colors = Values::new().with("color", Value::Color(color)).with("mortar", Value::Color(mortar));
        crate::part::make(&colors.with("size", Value::Pair(size)))
    }
}

impl Part for BrickTexture {
    const NAME: &'static str = "brick-texture";
    const DOC: &'static str = "Bricks in rows, with mortar between.";
    const FIELDS: &'static [Field] = &[
        Field::required("color", FieldKind::Color, "", "Colour of the bricks.")
            .or(|| Value::Color(Rgb::new(0.45, 0.12, 0.07))),
        Field::required("mortar", FieldKind::Color, "", "Colour of the mortar.")
            .or(|| Value::Color(Rgb::grey(0.6))),
        Field::required("size", FieldKind::Pair, "", "Width and height of a brick.")
            .or(|| Value::Pair(DVec2::new(0.24, 0.065))),
        Field::required("mortar-width", FieldKind::Number, "", "Width of the mortar between bricks.")
            .or(|| Value::Number(0.01)),
        Field::required("row-offset", FieldKind::Fraction, "", "How far each row is moved, in bricks.")
            .or(|| Value::Number(0.5)),
        Transform::MAPPING,
        Transform::SCALE,
        Transform::OFFSET,
        Transform::TURN,
    ];

    fn make(given: &Given<'_>) -> Result<Self, InvalidPart> {
        Ok(Self {
            color: given.color("color")?,
            mortar: given.color("mortar")?,
            size: given.positive_pair("size")?,
            mortar_width: given.not_negative("mortar-width")?,
            row_offset: given.fraction("row-offset")?,
            transform: Transform::given(given)?,
        })
    }

    fn values(&self) -> Values {
        let own = Values::new()
            .with("color", Value::Color(self.color))
            .with("mortar", Value::Color(self.mortar))
            .with("size", Value::Pair(self.size))
            .with("mortar-width", Value::Number(self.mortar_width))
            .with("row-offset", Value::Number(self.row_offset));
        self.transform.values(own)
    }
}

impl Pattern for BrickTexture {
    fn texel(&self, at: &TexturePoint) -> Texel {
        let Flat { uv, footprint } = self.transform.flat(at);
        let pitch = self.pitch();
        let place = uv / pitch;
        let brick = match footprint {
            Some(sides) => self.mean(place, sides.map(|side| side / pitch)),
            None => self.within(place),
        };
        // Also where the point is none.
        let brick = if brick.is_finite() { brick.clamp(0.0, 1.0) } else { 0.5 };
        Texel::opaque(mixed(self.mortar, self.color, brick))
    }
}

/// The most pieces that a long footprint is cut into.
const MOST_PIECES: f64 = 16.0;

/// Over more rows the mean over all rows is taken.
const MOST_ROWS: f64 = 32.0;

impl BrickTexture {
    /// Width and height of a brick with its mortar.
    fn pitch(&self) -> DVec2 {
        self.size + DVec2::splat(self.mortar_width)
    }

    /// Mortar's share of that.
    fn gap(&self) -> DVec2 {
        DVec2::splat(self.mortar_width) / self.pitch()
    }

    /// 1 on a brick, 0 on mortar; in bricks and rows.
    fn within(&self, place: DVec2) -> f64 {
        let row = place.y.floor();
        let (along, up) = ((place.x - self.moved(row)).rem_euclid(1.0), place.y - row);
        let half = self.gap() / 2.0;
        let inside = |v: f64, half: f64| v >= half && v < 1.0 - half;
        f64::from(inside(along, half.x) && inside(up, half.y))
    }

    /// How far a row is moved, in bricks; the same for rows that are moved alike, however far away.
    fn moved(&self, row: f64) -> f64 {
        (row * self.row_offset).rem_euclid(1.0)
    }

    /// The share of bricks in a parallelogram round a place: the longer side is cut into pieces about as long as the shorter
    /// one, and the share in the box round each piece is exact.
    fn mean(&self, place: DVec2, [a, b]: [DVec2; 2]) -> f64 {
        let (long, short) = if a.length_squared() < b.length_squared() { (b, a) } else { (a, b) };
        let pieces = (long.length() / short.length().max(f64::MIN_POSITIVE)).ceil().clamp(1.0, MOST_PIECES);
        let half = (long / pieces).abs() / 2.0 + short.abs() / 2.0;
        let piece = |i: f64| self.mean_in_box(place + long * ((i + 0.5) / pieces - 0.5), half);
        (0..pieces as u32).map(|i| piece(f64::from(i))).sum::<f64>() / pieces
    }

    /// The share of bricks in a box of this half size round a place.
    fn mean_in_box(&self, place: DVec2, half: DVec2) -> f64 {
        let (low, high) = (place.y - half.y, place.y + half.y);
        let (first, last) = (low.floor(), high.floor());
        let gap = self.gap();
        if !(last - first <= MOST_ROWS) {
            return (1.0 - gap.x) * (1.0 - gap.y);
        }
        let (mut share, mut height) = (0.0, 0.0);
        for step in 0..=(last - first) as u32 {
            let row = first + f64::from(step);
            let inside = [low.max(row), high.min(row + 1.0)].map(|v| v - row);
            let up = overlap(inside, gap.y);
            share += up * covered(place.x - self.moved(row), half.x, gap.x);
            height += inside[1] - inside[0];
        }
        // A box without a height is a line along a row.
        if height > 0.0 { share / height } else { self.along(place, half.x) }
    }

    /// The share of bricks on a line along a row.
    fn along(&self, place: DVec2, half: f64) -> f64 {
        let row = place.y.floor();
        let (up, gap) = (place.y - row, self.gap());
        let inside = up >= gap.y / 2.0 && up < 1.0 - gap.y / 2.0;
        if inside { covered(place.x - self.moved(row), half, gap.x) } else { 0.0 }
    }
}

/// How much of a stretch within 0..1 lies between the two halves of a gap.
fn overlap([low, high]: [f64; 2], gap: f64) -> f64 {
    (high.min(1.0 - gap / 2.0) - low.max(gap / 2.0)).max(0.0)
}

/// The share of a stretch round `at`, whose half length is `half`, that bricks of length 1 cover, with a gap at each whole
/// number.
fn covered(at: f64, half: f64, gap: f64) -> f64 {
    if !(half > 0.0) {
        let along = at.rem_euclid(1.0);
        return f64::from(along >= gap / 2.0 && along < 1.0 - gap / 2.0);
    }
    let up_to = |v: f64| {
        let whole = v.floor();
        whole * (1.0 - gap) + overlap([0.0, v - whole], gap)
    };
    let from = (at - half).rem_euclid(1.0);
    (up_to(from + 2.0 * half) - up_to(from)) / (2.0 * half)
}
