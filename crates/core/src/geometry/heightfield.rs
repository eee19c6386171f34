//! Ground whose heights a grey picture gives.
//!
//! Its triangles are a mesh like one from a file, made once for a picture and its sizes, and met as such.

use std::sync::{Arc, Mutex, PoisonError, Weak};

use glam::{DVec2, DVec3};

use super::{FacetRoot, Geometry, Mesh, Parametrization, TriangleMesh};
use crate::exact::{Located, Number, Verdict};
use crate::part::Given;
use crate::{
    Aabb, Crossing, Field, FieldKind, Image, ImageSource, InvalidPart, MeshSource, Part, Placement, Ray,
    Span, Value, Values,
};

/// A corner for each pixel, two triangles between each four; the picture lies flat round the origin as seen from above, its
/// upper border towards −z. Facets are triangles: those of the first row from the left, then the next row's.
#[derive(Debug, Clone, PartialEq)]
pub struct Heightfield {
    picture: ImageSource,
    sizes: Sizes,
    mesh: Mesh,
}

/// How large it is, and how it looks.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Sizes {
    size: DVec2,
    height: f64,
    smooth: bool,
}

/// The most pixels of a picture, 2048 x 2048: as triangles they and the tree over them take about a gigabyte.
const MOST_PIXELS: u64 = 1 << 22;

impl Heightfield {
    /// Over `size` metres in x and z, as high as `height` metres where the picture is white and 0 where it is black;
    /// `smooth` shades it as if it had no edges.
    ///
    /// # Errors
    /// A picture with fewer than two pixels in a row or column or with more than 2²² in all, or sizes that are not positive
    /// and finite.
    pub fn new(picture: ImageSource, size: DVec2, height: f64, smooth: bool) -> Result<Self, InvalidPart> {
        let values = Values::new().with("file", Value::Image(picture)).with("size", Value::Pair(size));
        let values = values.with("height", Value::Number(height));
        crate::part::make(&values.with("smooth", Value::Flag(smooth)))
    }

    /// The triangles.
    #[must_use]
    pub fn mesh(&self) -> &Mesh {
        &self.mesh
    }
}

impl Part for Heightfield {
    const NAME: &'static str = "heightfield";
    const DOC: &'static str = "Ground whose heights a grey picture gives.";
    const FIELDS: &'static [Field] = &[
        Field::required("file", FieldKind::Image, "", "A grey picture, relative to the scene's folder."),
        Field::required("size", FieldKind::Pair, "m", "How far it reaches along x and z."),
        Field::required("height", FieldKind::Length, "m", "How high it is where the picture is white."),
        Field::required("smooth", FieldKind::Flag, "", "Whether its edges are shaded away.")
            .or(|| Value::Flag(true)),
    ];

    fn make(given: &Given<'_>) -> Result<Self, InvalidPart> {
        let picture = given.image("file")?;
        let [width, height] = [picture.image.width(), picture.image.height()];
        if width < 2 || height < 2 || u64::from(width) * u64::from(height) > MOST_PIXELS {
            let requirement = "must be a picture of at least 2 x 2 pixels and at most 2^22";
            return Err(InvalidPart::new("file", requirement, format!("one of {width} x {height}")));
        }
        let size = given.positive_pair("size")?;
        let sizes = Sizes { size, height: given.positive("height")?, smooth: given.flag("smooth")? };
        let mesh = MeshSource { path: picture.path.clone(), mesh: mesh_of(&picture.image, sizes)? };
        Ok(Self { picture, sizes, mesh: Mesh::new(mesh) })
    }

    fn values(&self) -> Values {
        Values::new()
            .with("file", Value::Image(self.picture.clone()))
            .with("size", Value::Pair(self.sizes.size))
            .with("height", Value::Number(self.sizes.height))
            .with("smooth", Value::Flag(self.sizes.smooth))
    }
}

/// The meshes that are in use, with what they were made of.
static KNOWN: Mutex<Vec<Known>> = Mutex::new(Vec::new());

type Known = (Weak<Image>, Sizes, Weak<TriangleMesh>);

/// The mesh of a picture: the one that is there already, where there is one.
fn mesh_of(picture: &Arc<Image>, sizes: Sizes) -> Result<Arc<TriangleMesh>, InvalidPart> {
    let mut known = KNOWN.lock().unwrap_or_else(PoisonError::into_inner);
    known.retain(|(_, _, mesh)| mesh.strong_count() > 0);
    let is_it = |(image, of, _): &&Known| {
        *of == sizes && image.upgrade().is_some_and(|image| Arc::ptr_eq(&image, picture))
    };
    if let Some(mesh) = known.iter().find(is_it).and_then(|(_, _, mesh)| mesh.upgrade()) {
        return Ok(mesh);
    }
    let mesh = Arc::new(build(picture, sizes)?);
    known.push((Arc::downgrade(picture), sizes, Arc::downgrade(&mesh)));
    Ok(mesh)
}

fn build(picture: &Image, Sizes { size, height, smooth }: Sizes) -> Result<TriangleMesh, InvalidPart> {
    let (columns, rows) = (picture.width(), picture.height());
    let share = |i: u32, count: u32| f64::from(i) / f64::from(count - 1);
    let heights: Vec<f64> = (0..rows)
        .flat_map(|row| (0..columns).map(move |column| picture.plain_pixel(column, row).luminance() * height))
        .collect();
    let at = |column: u32, row: u32| heights[(row * columns + column) as usize];
    let each = || (0..rows).flat_map(move |row| (0..columns).map(move |column| (column, row)));
    let positions = each().map(|(column, row)| {
        let place = (DVec2::new(share(column, columns), share(row, rows)) - 0.5) * size;
        [place.x as f32, at(column, row) as f32, place.y as f32]
    });
    let uvs = each().map(|(column, row)| [share(column, columns) as f32, 1.0 - share(row, rows) as f32]);
    let step = size / DVec2::new(f64::from(columns - 1), f64::from(rows - 1));
    // By the neighbours on both sides, where there are two.
    let normal = |(column, row): (u32, u32)| {
        let [left, right] = [column.saturating_sub(1), (column + 1).min(columns - 1)];
        let [above, below] = [row.saturating_sub(1), (row + 1).min(rows - 1)];
        let along_x = (at(right, row) - at(left, row)) / (step.x * f64::from(right - left));
        let along_z = (at(column, below) - at(column, above)) / (step.y * f64::from(below - above));
        DVec3::new(-along_x, 1.0, -along_z).normalize().to_array().map(|c| c as f32)
    };
    let triangles = (0..rows - 1).flat_map(|row| {
        (0..columns - 1).flat_map(move |column| {
            let corner = |right: u32, down: u32| (row + down) * columns + column + right;
            [[corner(0, 0), corner(0, 1), corner(1, 1)], [corner(0, 0), corner(1, 1), corner(1, 0)]]
        })
    });
    let normals = smooth.then(|| each().map(normal).collect());
    TriangleMesh::new(positions.collect(), triangles.collect(), normals, Some(uvs.collect()))
}

impl Geometry for Heightfield {
    fn pieces(&self) -> u32 {
        self.mesh.pieces()
    }

    fn own_ray(&self, ray: &Ray) -> Ray {
        self.mesh.own_ray(ray)
    }

    fn nearest_root<N: Number>(
        &self,
        triangle: u32,
        own: &Ray,
        span: Span,
        leaving: Option<u32>,
    ) -> Verdict<Option<FacetRoot<N>>> {
        self.mesh.nearest_root(triangle, own, span, leaving)
    }

    fn crossing(&self, own: &Ray, at: Located, triangle: u32) -> Option<Crossing> {
        self.mesh.crossing(own, at, triangle)
    }

    fn bounds(&self) -> Option<Aabb> {
        self.mesh.bounds()
    }

    fn placed(&self, placement: &Placement) -> Self {
        Self { mesh: self.mesh.placed(placement), ..self.clone() }
    }

    fn parametrization(&self, point: DVec3, triangle: u32) -> Parametrization {
        self.mesh.parametrization(point, triangle)
    }

    fn is_closed(&self) -> bool {
        false
    }

    fn as_mesh(&self) -> Option<&Mesh> {
        Some(&self.mesh)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// 3 x 2 pixels: 0, 51 and 102 above, 153, 204 and 255 below.
    fn slope(smooth: bool) -> Heightfield {
        let image = Arc::new(Image::from_bytes([3, 2], 1, vec![0, 51, 102, 153, 204, 255]).unwrap());
        let picture = ImageSource { path: "slope.png".into(), image };
        Heightfield::new(picture, DVec2::new(4.0, 2.0), 10.0, smooth).unwrap()
    }

    #[test]
    fn white_is_high_and_the_upper_border_is_far() {
        let down = |x: f64, z: f64| {
            let hit = slope(false).cross(&Ray::new(DVec3::new(x, 20.0, z), DVec3::NEG_Y), Span::AHEAD, None);
            hit.map(|hit| (20.0 - hit.t) as f32)
        };
        // A plane: 1 m higher for each metre to the right, 3 m for each to the front.
        for (x, z) in [(-2.0, -1.0), (0.5, 0.25), (2.0, 1.0), (-1.5, 0.9)] {
            assert!((down(x, z).unwrap() - (2.0 + x + 3.0 * (z + 1.0)) as f32).abs() < 1e-5, "{x} {z}");
        }
        assert_eq!((down(2.1, 0.0), down(0.0, -1.1)), (None, None));
    }

    #[test]
    fn normals_point_up_and_texture_coordinates_follow_the_picture() {
        let right = DVec3::new(-1.0, 1.0, -3.0).normalize();
        for smooth in [false, true] {
            let hit =
                slope(smooth).cross(&Ray::new(DVec3::new(1.0, 20.0, -0.5), DVec3::NEG_Y), Span::AHEAD, None);
            let hit = hit.unwrap();
            assert!(hit.normal.distance(right) < 1e-6 && hit.shading_normal.distance(right) < 1e-6);
            assert!(hit.uv.distance(DVec2::new(0.75, 0.75)) < 1e-6);
        }
    }

    #[test]
    fn the_same_picture_at_the_same_size_has_one_mesh() {
        let one = slope(true);
        let again = (crate::Shape::from(one.clone())).with("height", Value::Number(10.0)).unwrap();
        let mesh = |shape: &crate::Shape| Arc::clone(&shape.as_mesh().unwrap().source().mesh);
        assert!(Arc::ptr_eq(&mesh(&again), &one.mesh.source().mesh));
        let higher = again.with("height", Value::Number(11.0)).unwrap();
        assert!(!Arc::ptr_eq(&mesh(&higher), &one.mesh.source().mesh));
    }

    #[test]
    fn a_picture_of_one_row_is_refused() {
        let image = Arc::new(Image::from_bytes([3, 1], 1, vec![0; 3]).unwrap());
        let picture = ImageSource { path: String::new(), image };
        let refused = Heightfield::new(picture, DVec2::ONE, 1.0, true).unwrap_err();
        assert_eq!(refused.field(), "file");
    }
}
