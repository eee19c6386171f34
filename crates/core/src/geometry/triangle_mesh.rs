//! The triangles of a mesh: shared corners in `f32`, as files give them.

use std::sync::Arc;

use glam::{DVec2, DVec3};

use super::OpenEdge;
use super::coplanar::lies_in_plane;
use super::doubles::Doubles;
use super::line_tree::LineTree;
use super::parametrization::BARYCENTRIC;
use super::subdivision::{Subdivisions, fitted};
use super::tangents::Tangents;
use super::watertight::Watertight;
use crate::{Aabb, InvalidPart, Ray, Rgb};

/// Triangles over shared corners, with optional normals, texture coordinates and colours per corner.
///
/// Triangles without area are kept (ids stay those of the file) and are never hit. The outer side is that from which corners
/// run anticlockwise; where there are normals it is theirs: a triangle that is wound against the sum of its three is kept
/// with two corners swapped, as files of mirrored things have them.
///
/// ```
/// use std::sync::Arc;
///
/// use catoptra_core::{MeshSource, TriangleMesh, geometry::Mesh};
///
/// let corners = vec![[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]];
/// let square = TriangleMesh::new(corners, vec![[0, 1, 2], [0, 2, 3]], None, None)?;
/// assert!(square.open_edge().is_some(), "it encloses nothing");
/// // A shape for scenes; several share the triangles.
/// let shape = Mesh::new(MeshSource { path: String::new(), mesh: Arc::new(square) });
/// # let _ = shape;
/// # Ok::<(), catoptra_core::InvalidPart>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct TriangleMesh {
    positions: Vec<[f32; 3]>,
    triangles: Vec<[u32; 3]>,
    normals: Option<Vec<[f32; 3]>>,
    uvs: Option<Vec<[f32; 2]>>,
    colors: Option<Vec<[f32; 3]>>,
    given_tangents: Option<Vec<[f32; 4]>>,
    tangents: Tangents,
    offset: DVec3,
    bounds: Aabb,
    watertight: Watertight,
    doubles: Doubles,
    lines: LineTree,
    subdivisions: Subdivisions,
}

impl TriangleMesh {
    /// From corners (metres, in the mesh's own space) and triples of corner numbers.
    ///
    /// # Errors
    /// No triangles, a position that is not finite, a corner number out of range, or normals or texture
    /// coordinates that are not finite or not as many as the positions.
    pub fn new(
        positions: Vec<[f32; 3]>,
        triangles: Vec<[u32; 3]>,
        normals: Option<Vec<[f32; 3]>>,
        uvs: Option<Vec<[f32; 2]>>,
    ) -> Result<Self, InvalidPart> {
        if triangles.is_empty() {
            return Err(InvalidPart::new("triangles", "must be at least one", 0));
        }
        check_finite("positions", &positions, positions.len())?;
        if let Some(index) = triangles.iter().flatten().find(|&&i| i as usize >= positions.len()) {
            let requirement = format!("must name one of the {} corners", positions.len());
            return Err(InvalidPart::new("triangles", requirement, index));
        }
        if let Some(normals) = &normals {
            check_finite("normals", normals, positions.len())?;
        }
        if let Some(uvs) = &uvs {
            check_finite("uvs", uvs, positions.len())?;
        }
        let bounds = Aabb::of(positions.iter().map(|&p| widen(p)));
        let triangles = match &normals {
            Some(normals) => wound_by(normals, &positions, triangles),
            None => triangles,
        };
        Ok(Self {
            positions,
            triangles,
            normals,
            uvs,
            colors: None,
            given_tangents: None,
            tangents: Tangents::default(),
            offset: DVec3::ZERO,
            bounds,
            watertight: Watertight::default(),
            doubles: Doubles::default(),
            lines: LineTree::default(),
            subdivisions: Subdivisions::default(),
        })
    }

    /// With colours (linear Rec. 709), as many as corners; a `vertex-color-texture` shows them.
    ///
    /// # Errors
    /// Colours that are not finite or not as many as the positions.
    pub fn with_colors(self, colors: Vec<[f32; 3]>) -> Result<Self, InvalidPart> {
        check_finite("colors", &colors, self.positions.len())?;
        Ok(Self { colors: Some(colors), ..self })
    }

    /// With tangents, as many as corners: where texture coordinate u grows, and 1 or −1 for the side of the normal and the tangent on
    /// which v does. Without them they are made as `MikkTSpace` does.
    ///
    /// # Errors
    /// Tangents that are not finite or not as many as the positions.
    pub fn with_tangents(self, tangents: Vec<[f32; 4]>) -> Result<Self, InvalidPart> {
        check_finite("tangents", &tangents, self.positions.len())?;
        Ok(Self { given_tangents: Some(tangents), ..self })
    }

    /// The same, round a point: of corners far from zero, `f32` keeps what lies between them and `f64` where they stand.
    #[must_use]
    pub fn with_offset(self, offset: DVec3) -> Self {
        Self { offset, ..self }
    }

    /// Where the origin of the mesh's own space lies before it is placed.
    #[must_use]
    pub fn offset(&self) -> DVec3 {
        self.offset
    }

    /// Colours, as many as corners, linear Rec. 709.
    #[must_use]
    pub fn colors(&self) -> Option<&[[f32; 3]]> {
        self.colors.as_deref()
    }

    /// Corners, metres, in the mesh's own space.
    #[must_use]
    pub fn positions(&self) -> &[[f32; 3]] {
        &self.positions
    }

    /// Corner numbers of every triangle, anticlockwise as seen from outside.
    #[must_use]
    pub fn triangles(&self) -> &[[u32; 3]] {
        &self.triangles
    }

    /// Normals, as many as corners, of any length.
    #[must_use]
    pub fn normals(&self) -> Option<&[[f32; 3]]> {
        self.normals.as_deref()
    }

    /// Texture coordinates, as many as corners.
    #[must_use]
    pub fn uvs(&self) -> Option<&[[f32; 2]]> {
        self.uvs.as_deref()
    }

    /// The box round all corners.
    #[must_use]
    pub fn bounds(&self) -> Aabb {
        self.bounds
    }

    /// The mesh with each triangle cut into four that bulge as its normals say, `levels` times; made once. `None` without
    /// normals, and of levels outside 1 to 5.
    #[must_use]
    pub fn subdivided(&self, levels: u32) -> Option<Arc<Self>> {
        self.subdivisions.of(self, levels)
    }

    /// A mesh of other triangles, whose corners are each made of corners of this one, by weights.
    pub(super) fn remade(
        &self,
        positions: Vec<[f32; 3]>,
        triangles: Vec<[u32; 3]>,
        made_of: &[([u32; 3], [f64; 3])],
    ) -> Self {
        let normals =
            self.normals.as_deref().map(|rows| fitted(&positions, &triangles, &blended(rows, made_of)));
        Self {
            bounds: Aabb::of(positions.iter().map(|&p| widen(p))),
            positions,
            triangles,
            normals,
            uvs: self.uvs.as_deref().map(|rows| blended(rows, made_of)),
            colors: self.colors.as_deref().map(|rows| blended(rows, made_of)),
            given_tangents: None,
            tangents: Tangents::default(),
            offset: self.offset,
            watertight: Watertight::default(),
            doubles: Doubles::default(),
            lines: LineTree::default(),
            subdivisions: Subdivisions::default(),
        }
    }

    /// An edge where the surface is not closed; `None` of a mesh that encloses something. Sorts all
    /// edges when first asked.
    #[must_use]
    pub fn open_edge(&self) -> Option<OpenEdge> {
        self.watertight.open_edge(self)
    }

    /// For each triangle the first that lies in the same place, with the same corners in whatever order; `None` where all differ.
    /// Only the first is met.
    #[must_use]
    pub fn firsts_in_place(&self) -> Option<&[u32]> {
        self.doubles.firsts(self)
    }

    /// Whether a triangle lies exactly in the plane of another, as each does in its own; a ray that leaves the first does not meet
    /// the other. In the plane of a triangle without area, which is never met, lie all.
    #[must_use]
    pub fn lies_in_plane(&self, triangle: u32, of: u32) -> bool {
        let has = |triangle: u32| (triangle as usize) < self.triangles.len();
        triangle == of
            || has(triangle) && has(of) && lies_in_plane(&self.corners(triangle), &self.corners(of))
    }

    /// Shows `visit` each triangle that the line of a ray in the mesh's own space may meet, in any order, until an error.
    pub(super) fn along<E>(&self, ray: &Ray, visit: impl FnMut(u32) -> Result<(), E>) -> Result<(), E> {
        self.lines.along(self, ray, visit)
    }

    /// The corners of a triangle.
    ///
    /// # Panics
    /// A triangle number out of range.
    #[must_use]
    pub fn corners(&self, triangle: u32) -> [DVec3; 3] {
        self.triangles[triangle as usize].map(|i| widen(self.positions[i as usize]))
    }

    /// The normal at a point given by corner weights, not normalised; `None` without normals.
    ///
    /// # Panics
    /// A triangle number out of range.
    #[must_use]
    pub fn normal_at(&self, triangle: u32, weights: [f64; 3]) -> Option<DVec3> {
        let normals = self.normals.as_ref()?;
        let corners = self.triangles[triangle as usize];
        Some((0..3).map(|k| widen(normals[corners[k] as usize]) * weights[k]).sum())
    }

    /// The texture coordinates of a triangle's corners; 0 0, 1 0 and 0 1 in a mesh that has none.
    ///
    /// # Panics
    /// A triangle number out of range.
    #[must_use]
    pub fn corner_uvs(&self, triangle: u32) -> [DVec2; 3] {
        match &self.uvs {
            Some(uvs) => {
                self.triangles[triangle as usize].map(|i| DVec2::from(uvs[i as usize].map(f64::from)))
            }
            None => BARYCENTRIC,
        }
    }

    /// The texture coordinates at a point given by corner weights; zero without any.
    ///
    /// # Panics
    /// A triangle number out of range.
    #[must_use]
    pub fn uv_at(&self, triangle: u32, weights: [f64; 3]) -> DVec2 {
        let Some(uvs) = &self.uvs else { return DVec2::ZERO };
        let corners = self.triangles[triangle as usize];
        let uv = |k: usize| DVec2::from(uvs[corners[k] as usize].map(f64::from));
        (0..3).map(|k| uv(k) * weights[k]).sum()
    }

    /// The colour at a point given by corner weights, no channel below 0; `None` without colours.
    ///
    /// # Panics
    /// A triangle number out of range.
    #[must_use]
    pub fn color_at(&self, triangle: u32, weights: [f64; 3]) -> Option<Rgb> {
        let colors = self.colors.as_ref()?;
        let corners = self.triangles[triangle as usize];
        let sum: DVec3 = (0..3).map(|k| widen(colors[corners[k] as usize]) * weights[k]).sum();
        Some(Rgb::new(sum.x, sum.y, sum.z).map(|v| v.max(0.0)))
    }

    /// Where texture coordinates u and v grow at a point given by corner weights, smoothly from triangle to triangle; not
    /// normalised. `None` without texture coordinates.
    ///
    /// # Panics
    /// A triangle number out of range.
    #[must_use]
    pub fn tangents_at(&self, triangle: u32, weights: [f64; 3]) -> Option<[DVec3; 2]> {
        let of_corners = match &self.given_tangents {
            Some(given) => self.triangles[triangle as usize].map(|i| given[i as usize]),
            None if self.uvs.is_some() => self.tangents.of(self, triangle),
            None => return None,
        };
        let tangent: DVec3 = (0..3).map(|k| widen_tangent(of_corners[k]) * weights[k]).sum();
        let normal = self.normal_at(triangle, weights).unwrap_or_else(|| {
            let [a, b, c] = self.corners(triangle);
            (b - a).cross(c - a)
        });
        Some([tangent, normal.cross(tangent) * f64::from(of_corners[0][3])])
    }
}

/// Triangles with two corners swapped where they are wound against the sum of their corners' normals.
fn wound_by(normals: &[[f32; 3]], positions: &[[f32; 3]], mut triangles: Vec<[u32; 3]>) -> Vec<[u32; 3]> {
    for triangle in &mut triangles {
        let [a, b, c] = triangle.map(|i| widen(positions[i as usize]));
        let outwards: DVec3 = triangle.iter().map(|&i| widen(normals[i as usize])).sum();
        if (b - a).cross(c - a).dot(outwards) < 0.0 {
            triangle.swap(1, 2);
        }
    }
    triangles
}

/// Rows made of others, by weights.
fn blended<const N: usize>(rows: &[[f32; N]], made_of: &[([u32; 3], [f64; 3])]) -> Vec<[f32; N]> {
    let blend = |(corners, weights): &([u32; 3], [f64; 3])| {
        std::array::from_fn(|i| {
            (0..3).map(|k| f64::from(rows[corners[k] as usize][i]) * weights[k]).sum::<f64>() as f32
        })
    };
    made_of.iter().map(blend).collect()
}

/// A position, or another vector, as bits that are the same for equal ones.
pub(super) fn place(position: [f32; 3]) -> [u32; 3] {
    // Adding 0 makes both zeros one.
    position.map(|c| (c + 0.0).to_bits())
}

pub(super) fn widen(p: [f32; 3]) -> DVec3 {
    DVec3::from(p.map(f64::from))
}

fn widen_tangent([x, y, z, _]: [f32; 4]) -> DVec3 {
    widen([x, y, z])
}

fn check_finite<const N: usize>(
    name: &'static str,
    rows: &[[f32; N]],
    corners: usize,
) -> Result<(), InvalidPart> {
    if rows.len() != corners {
        return Err(InvalidPart::new(name, format!("must be as many as the {corners} corners"), rows.len()));
    }
    match rows.iter().position(|row| !row.iter().all(|v| v.is_finite())) {
        Some(at) => Err(InvalidPart::new(name, "must be finite", format!("{:?} at corner {at}", rows[at]))),
        None => Ok(()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const CORNERS: [[f32; 3]; 3] = [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];

    #[test]
    fn bad_meshes_are_refused() {
        let refused = |positions: &[[f32; 3]], triangles: &[[u32; 3]]| {
            TriangleMesh::new(positions.to_vec(), triangles.to_vec(), None, None).unwrap_err().field()
        };
        assert_eq!(refused(&CORNERS, &[]), "triangles");
        assert_eq!(refused(&CORNERS, &[[0, 1, 3]]), "triangles");
        assert_eq!(refused(&[[f32::NAN, 0.0, 0.0], CORNERS[1], CORNERS[2]], &[[0, 1, 2]]), "positions");
        let short = TriangleMesh::new(CORNERS.to_vec(), vec![[0, 1, 2]], Some(vec![[0.0; 3]]), None);
        assert_eq!(short.unwrap_err().field(), "normals");
    }

    #[test]
    fn triangles_wound_against_their_normals_are_turned_round() {
        let wound = |triangle: [u32; 3], normals: [f32; 3]| {
            let normals = normals.map(|z| [0.3, -0.2, z]).to_vec();
            let mesh = TriangleMesh::new(CORNERS.to_vec(), vec![triangle], Some(normals), None).unwrap();
            mesh.triangles()[0]
        };
        assert_eq!(wound([0, 1, 2], [1.0; 3]), [0, 1, 2]);
        assert_eq!(wound([0, 2, 1], [1.0; 3]), [0, 1, 2]);
        assert_eq!(wound([0, 1, 2], [-1.0; 3]), [0, 2, 1]);
        // The sum of the three decides, and where it does not, the winding stays.
        assert_eq!(wound([0, 1, 2], [-1.0, 0.6, 0.6]), [0, 1, 2]);
        assert_eq!(wound([0, 1, 2], [1.0, -0.6, -0.6]), [0, 2, 1]);
        assert_eq!(wound([0, 2, 1], [0.0; 3]), [0, 2, 1]);
    }

    #[test]
    fn tangents_are_those_given_or_follow_the_coordinates() {
        let uvs = [[0.0, 0.0], [0.0, 1.0], [1.0, 0.0]];
        let bare = TriangleMesh::new(CORNERS.to_vec(), vec![[0, 1, 2]], None, None).unwrap();
        assert_eq!(bare.tangents_at(0, [1.0, 0.0, 0.0]), None);
        let mesh = TriangleMesh::new(CORNERS.to_vec(), vec![[0, 1, 2]], None, Some(uvs.to_vec())).unwrap();
        // u grows along y and v along x, which is on the other side than where a corner turned to the left has it.
        let [u, v] = mesh.tangents_at(0, [0.2, 0.3, 0.5]).unwrap();
        assert!((u - DVec3::Y).length() < 1e-6 && (v.normalize() - DVec3::X).length() < 1e-6, "{u} {v}");
        let given = mesh.with_tangents(vec![[1.0, 0.0, 0.0, 1.0]; 3]).unwrap();
        let [u, v] = given.tangents_at(0, [0.2, 0.3, 0.5]).unwrap();
        assert!((u - DVec3::X).length() < 1e-12 && (v.normalize() - DVec3::Y).length() < 1e-12, "{u} {v}");
    }

    #[test]
    fn tangents_are_smooth_over_an_edge() {
        let (bend, uvs) = ([0.0, 1.0, 1.0], vec![[0.0, 0.0], [0.0, 1.0], [1.0, 0.0], [-1.0, 0.0]]);
        let positions = vec![[0.0; 3], [0.0, 1.0, 0.0], [1.0, 0.0, -0.3], [-1.0, 0.0, -0.3]];
        let normals = vec![bend, bend, [0.2, 0.0, 1.0], [-0.2, 0.0, 1.0]];
        let mesh =
            TriangleMesh::new(positions, vec![[0, 2, 1], [0, 1, 3]], Some(normals), Some(uvs)).unwrap();
        let [left, right] = [1, 0].map(|triangle| {
            let at_start = mesh.triangles()[triangle].map(|corner| f64::from(u8::from(corner == 0)));
            mesh.tangents_at(triangle as u32, at_start).unwrap()[0]
        });
        assert!((left - right).length() < 1e-6, "{left} {right}");
        assert!((left - DVec3::X).length() < 1e-6, "{left}");
    }

    #[test]
    fn colours_are_interpolated_and_never_negative() {
        let mesh = TriangleMesh::new(CORNERS.to_vec(), vec![[0, 1, 2]], None, None).unwrap();
        assert_eq!(mesh.color_at(0, [1.0, 0.0, 0.0]), None);
        let mesh = mesh.with_colors(vec![[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]).unwrap();
        assert_eq!(mesh.color_at(0, [0.5, 0.25, 0.25]), Some(Rgb::new(0.5, 0.25, 0.25)));
        assert_eq!(mesh.color_at(0, [1.5, -0.25, -0.25]), Some(Rgb::new(1.5, 0.0, 0.0)));
    }
}
