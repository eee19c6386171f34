//! Light from all around, infinitely far away: of one radiance, or as a picture tells.

use std::f64::consts::{PI, TAU};
use std::sync::{Arc, OnceLock};

use glam::{DQuat, DVec3};

use super::{Arrival, Emitter, LightVisitor, SHADOW, nothing_arrives};
use crate::part::{Given, ImageSource};
use crate::texture::Image;
use crate::{Constant3, Field, FieldKind, InvalidPart, Lane, Part, Placement, Rgb, Triple, Value, Values};

/// What surrounds a scene. A picture is read as latitude and longitude: its middle lies towards −z, its upper edge towards +y,
/// its right half towards +x. Its numbers are radiances, W/(m²·sr).
#[derive(Debug, Clone, PartialEq)]
pub struct EnvironmentLight {
    radiance: Constant3,
    picture: Option<Picture>,
    scale: f64,
    shadow: bool,
    turned: DQuat,
}

/// A picture of all directions, and how light is spread over it.
#[derive(Debug, Clone)]
struct Picture {
    source: ImageSource,
    /// Made when a direction is chosen for the first time.
    spread: Arc<OnceLock<Spread>>,
}

impl PartialEq for Picture {
    fn eq(&self, other: &Self) -> bool {
        self.source == other.source
    }
}

/// Light that arrives along a direction.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FromAfar {
    /// Unit vector to where it comes from.
    pub direction: DVec3,
    /// W/(m²·sr) per channel.
    pub radiance: Rgb,
    /// How densely directions are chosen there, 1/sr.
    pub pdf: f64,
}

/// What surrounds a scene, as the tracer asks it.
pub type Environment = EnvironmentLight;

impl EnvironmentLight {
    /// Of one radiance, W/(m²·sr) per channel.
    ///
    /// # Errors
    /// A channel that is negative or not finite.
    pub fn new(radiance: Rgb) -> Result<Self, InvalidPart> {
        crate::part::make(&Values::new().with("radiance", Value::Color(radiance)))
    }

    /// The radiance that is seen along a direction of any length.
    #[must_use]
    pub fn radiance(&self, direction: DVec3) -> Rgb {
        match &self.picture {
            None => self.radiance.rgb() * self.scale,
            Some(picture) => {
                let place = place_of(self.turned.inverse() * direction);
                between_pixels(&picture.source.image, place) * self.scale
            }
        }
    }

    /// Whether it is the same in all directions: then none is chosen over another.
    #[must_use]
    pub fn is_even(&self) -> bool {
        self.picture.is_none()
    }

    /// A direction that light comes from, chosen by two numbers in 0..1 as densely as light is spread; even choices stay even.
    #[must_use]
    pub fn sample(&self, [u, v]: [f64; 2]) -> Option<FromAfar> {
        let (own, pdf) = match &self.picture {
            None => {
                let (height, angle) = (1.0 - 2.0 * u, TAU * v);
                let across = (1.0 - height * height).max(0.0).sqrt();
                (DVec3::new(across * angle.cos(), height, across * angle.sin()), 1.0 / (4.0 * PI))
            }
            Some(picture) => picture.spread().sample([u, v])?,
        };
        let direction = self.turned * own;
        Some(FromAfar { direction, radiance: self.radiance(direction), pdf })
    }

    /// How densely [`sample`](Self::sample) chooses directions there, 1/sr.
    #[must_use]
    pub fn pdf(&self, direction: DVec3) -> f64 {
        match &self.picture {
            None => 1.0 / (4.0 * PI),
            Some(picture) => picture.spread().pdf(place_of(self.turned.inverse() * direction)),
        }
    }
}

impl Picture {
    fn spread(&self) -> &Spread {
        self.spread.get_or_init(|| Spread::of(&self.source.image))
    }
}

/// Where in a picture a direction lies, 0..=1 from the left and from the top.
fn place_of(direction: DVec3) -> [f64; 2] {
    let longitude = direction.x.atan2(-direction.z);
    let latitude = direction.y.atan2(direction.x.hypot(direction.z));
    [0.5 + longitude / TAU, 0.5 - latitude / PI]
}

/// The light at a place, from the four pixels round it; the left border is the right one.
fn between_pixels(image: &Image, [u, v]: [f64; 2]) -> Rgb {
    let (width, height) = (image.width(), image.height());
    let x = u * f64::from(width) - 0.5;
    let y = (v * f64::from(height) - 0.5).clamp(0.0, f64::from(height - 1));
    let (left, top) = (x.floor(), y.floor());
    let column = |x: f64| x.rem_euclid(f64::from(width)) as u32;
    let [a, b] = [column(left), column(left + 1.0)];
    let row = |y: u32| {
        let share = x - left;
        image.pixel(a, y).color * (1.0 - share) + image.pixel(b, y).color * share
    };
    let share = y - top;
    row(top as u32) * (1.0 - share) + row((top as u32 + 1).min(height - 1)) * share
}

/// How light is spread over a picture: cells of one or more pixels, row by row.
#[derive(Debug)]
struct Spread {
    columns: usize,
    rows: usize,
    /// The light of each row up to and with each cell, in parts of all light.
    cells: Vec<f64>,
    /// The light of all rows up to and with each.
    sums: Vec<f64>,
}

/// Most cells along a side of the picture.
const MOST_CELLS: u32 = 2048;

impl Spread {
    fn of(image: &Image) -> Self {
        let [columns, rows] = [image.width(), image.height()].map(|side| side.min(MOST_CELLS));
        let mut cells = Vec::with_capacity(columns as usize * rows as usize);
        let mut sums = Vec::with_capacity(rows as usize);
        let mut all = 0.0;
        for row in 0..rows {
            let height = solid_share(row as usize, rows as usize);
            let mut sum = 0.0;
            for column in 0..columns {
                sum += light_in(image, [column, row], [columns, rows]) * height;
                cells.push(sum);
            }
            all += sum;
            sums.push(all);
        }
        let share = if all > 0.0 { 1.0 / all } else { 0.0 };
        cells.iter_mut().chain(&mut sums).for_each(|sum| *sum *= share);
        Self { columns: columns as usize, rows: rows as usize, cells, sums }
    }

    fn row(&self, row: usize) -> &[f64] {
        &self.cells[row * self.columns..(row + 1) * self.columns]
    }

    fn sample(&self, [u, v]: [f64; 2]) -> Option<(DVec3, f64)> {
        let (row, down) = pick(&self.sums, v)?;
        let (column, across) = pick(self.row(row), u)?;
        let place = [(column as f64 + across) / self.columns as f64, (row as f64 + down) / self.rows as f64];
        // Within a row directions are spread evenly over height, so that the density is that of the cell.
        let [top, bottom] = [row, row + 1].map(|edge| (PI * edge as f64 / self.rows as f64).cos());
        let height = top + (bottom - top) * down;
        let wide = (1.0 - height * height).max(0.0).sqrt();
        let longitude = TAU * (place[0] - 0.5);
        let direction = DVec3::new(wide * longitude.sin(), height, -wide * longitude.cos());
        let pdf = self.density(column, row);
        (pdf > 0.0).then_some((direction, pdf))
    }

    fn pdf(&self, [u, v]: [f64; 2]) -> f64 {
        let cell = |share: f64, count: usize| ((share * count as f64) as usize).min(count - 1);
        self.density(cell(u, self.columns), cell(v, self.rows))
    }

    /// Of a cell, 1/sr.
    fn density(&self, column: usize, row: usize) -> f64 {
        let cells = self.row(row);
        let light = cells[column] - if column > 0 { cells[column - 1] } else { 0.0 };
        light / (solid_share(row, self.rows) * TAU / self.columns as f64)
    }
}

/// How much higher the upper edge of a row of cells lies than the lower one, on the unit sphere.
fn solid_share(row: usize, rows: usize) -> f64 {
    let [top, bottom] = [row, row + 1].map(|edge| (PI * edge as f64 / rows as f64).cos());
    top - bottom
}

/// The largest light of the pixels in a cell and of those beside it, which are mixed in at its edges.
fn light_in(image: &Image, [column, row]: [u32; 2], [columns, rows]: [u32; 2]) -> f64 {
    let ends = |at: u32, cells: u32, pixels: u32| {
        let edge = |at: u32| u64::from(at) * u64::from(pixels) / u64::from(cells);
        (edge(at) as i64 - 1, edge(at + 1) as i64 + 1)
    };
    let (left, right) = ends(column, columns, image.width());
    let (top, bottom) = ends(row, rows, image.height());
    let mut most = 0.0_f64;
    for y in top.max(0)..bottom.min(i64::from(image.height())) {
        for x in left..right {
            let x = x.rem_euclid(i64::from(image.width())) as u32;
            most = most.max(image.pixel(x, y as u32).color.luminance());
        }
    }
    most
}

/// Which of growing sums a share of the last one falls into, and how far within it.
fn pick(sums: &[f64], share: f64) -> Option<(usize, f64)> {
    let last = *sums.last()?;
    let place = share * last;
    let at = sums.partition_point(|&sum| sum <= place).min(sums.len() - 1);
    let before = if at > 0 { sums[at - 1] } else { 0.0 };
    let width = sums[at] - before;
    (width > 0.0).then(|| (at, ((place - before) / width).clamp(0.0, 1.0)))
}

impl Part for EnvironmentLight {
    const NAME: &'static str = "environment-light";
    const DOC: &'static str = "Light from all around, infinitely far away: of one radiance, or a picture.";
    const FIELDS: &'static [Field] = &[
        Field::required(
            "radiance",
            FieldKind::Quantity,
            "W/(m²·sr)",
            "Radiance from every direction; give this or file.",
        )
        .instead_of("file"),
        Field::required(
            "file",
            FieldKind::Image,
            "",
            "Picture of all directions by longitude and latitude (EXR, HDR), its middle towards −z.",
        )
        .instead_of("radiance"),
        Field::required("scale", FieldKind::Number, "", "What all of it is multiplied by, at least 0.")
            .or(|| Value::Number(1.0)),
        SHADOW,
    ];

    fn make(given: &Given<'_>) -> Result<Self, InvalidPart> {
        let (radiance, picture) = match (given.has("radiance"), given.has("file")) {
            (true, true) => {
                return Err(InvalidPart::new("file", "must be given alone", "beside radiance"));
            }
            (false, true) => {
                (Rgb::BLACK, Some(Picture { source: given.image("file")?, spread: Arc::default() }))
            }
            (true, false) => (given.quantity("radiance")?, None),
            (false, false) => return Err(InvalidPart::new("radiance", "must be given, or file", "missing")),
        };
        Ok(Self {
            radiance: radiance.into(),
            picture,
            scale: given.not_negative("scale")?,
            shadow: given.flag("shadow")?,
            turned: DQuat::IDENTITY,
        })
    }

    fn values(&self) -> Values {
        let values = match &self.picture {
            Some(picture) => Values::new().with("file", Value::Image(picture.source.clone())),
            None => Values::new().with("radiance", Value::Color(self.radiance.rgb())),
        };
        values.with("scale", Value::Number(self.scale)).with("shadow", Value::Flag(self.shadow))
    }
}

impl Emitter for EnvironmentLight {
    /// Nothing arrives from any one direction.
    #[inline(always)]
    fn arriving<L: Lane>(&self, point: Triple<L>) -> Arrival<L> {
        nothing_arrives(point)
    }

    #[inline(always)]
    fn accept(&self, _: impl LightVisitor) {}

    fn color(&self) -> &Constant3 {
        &self.radiance
    }

    fn placed(&self, placement: &Placement) -> Self {
        Self { turned: placement.rotation() * self.turned, ..self.clone() }
    }

    fn environment(&self) -> Option<&Environment> {
        Some(self)
    }

    fn shadow(&self) -> bool {
        self.shadow
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn picture() -> EnvironmentLight {
        let floats: Vec<f32> =
            (0..32 * 16).flat_map(|i| [(i % 7) as f32, 1.0, ((i / 3) % 5) as f32]).collect();
        let image = Image::from_floats([32, 16], 3, floats, crate::texture::Encoding::Linear).unwrap();
        let source = ImageSource { path: "sky.exr".to_owned(), image: Arc::new(image) };
        let light: EnvironmentLight =
            crate::part::make(&Values::new().with("file", Value::Image(source))).unwrap();
        light.placed(&Placement::IDENTITY.turned(DVec3::ZERO, DVec3::new(1.0, 2.0, 0.5), 0.7).unwrap())
    }

    #[test]
    fn choices_are_as_dense_as_is_said_and_add_up_to_all_light() {
        let (light, side) = (picture(), 400);
        let (mut sum, mut cells) = (Rgb::BLACK, 0.0);
        for i in 0..side * side {
            let u = [(i % side) as f64 + 0.5, (i / side) as f64 + 0.5].map(|u| u / f64::from(side));
            let found = light.sample(u).unwrap();
            assert!((light.pdf(found.direction) / found.pdf - 1.0).abs() < 1e-6, "{found:?}");
            sum += found.radiance * (1.0 / found.pdf);
            cells += 1.0 / found.pdf;
        }
        let count = f64::from(side * side);
        assert!((cells / count / (4.0 * PI) - 1.0).abs() < 2e-3, "{}", cells / count);
        // The same by even directions.
        let mut even = Rgb::BLACK;
        for i in 0..side * side {
            let (u, v) = (
                (f64::from(i % side) + 0.5) / f64::from(side),
                (f64::from(i / side) + 0.5) / f64::from(side),
            );
            let (height, angle) = (1.0 - 2.0 * u, TAU * v);
            let across = (1.0 - height * height).sqrt();
            even +=
                light.radiance(DVec3::new(across * angle.cos(), height, across * angle.sin())) * (4.0 * PI);
        }
        for (a, b) in sum.to_array().into_iter().zip(even.to_array()) {
            assert!((a / b - 1.0).abs() < 5e-3, "{a} {b}");
        }
    }

    #[test]
    fn the_middle_of_the_picture_lies_towards_minus_z_and_its_top_upwards() {
        assert_eq!(place_of(-DVec3::Z), [0.5, 0.5]);
        assert_eq!(place_of(DVec3::X), [0.75, 0.5]);
        assert_eq!(place_of(DVec3::Y)[1], 0.0);
    }
}
