//! What corners and triangles does a primitive have, as its accessors give them?

use super::topology::{Mode, Topology};
use crate::model::gltf::accessor::{Accessor, Which};
use crate::model::gltf::extensions;
use crate::model::gltf::json::{Primitive, Whole};
use crate::model::gltf::refusal::{Refusal, Within};
use crate::model::gltf::source::Source;
use crate::model::warnings::Warnings;

/// Which accessors a primitive takes its numbers from: what is equal has the same corners.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub(crate) struct Accessors {
    pub(crate) positions: Whole,
    pub(crate) normals: Option<Whole>,
    pub(crate) uvs: Option<Whole>,
    pub(crate) colors: Option<Whole>,
    pub(crate) tangents: Option<Whole>,
    indices: Option<Whole>,
    topology: Topology,
}

/// The corners of a primitive that triangles use, and the triangles.
#[derive(Debug, Clone)]
pub(crate) struct Corners {
    pub(crate) positions: Vec<[f32; 3]>,
    pub(crate) triangles: Vec<[u32; 3]>,
    pub(crate) normals: Option<Vec<[f32; 3]>>,
    /// With v upwards from the lower edge of a picture.
    pub(crate) uvs: Option<Vec<[f32; 2]>>,
    /// Linear Rec. 709.
    pub(crate) colors: Option<Vec<[f32; 3]>>,
    /// With the side of the bitangent.
    pub(crate) tangents: Option<Vec<[f32; 4]>>,
    /// Which rows of the accessors they are; `None` for all.
    chosen: Option<Vec<u32>>,
    /// How many rows the accessors have.
    rows: usize,
}

const POSITION: &str = "POSITION";
/// The mode of a primitive that names none.
const TRIANGLES: u64 = 4;

/// Bytes that a corner takes at most: position, normal, texture coordinates, colour.
const CORNER: usize = size_of::<[f32; 15]>();
const TRIANGLE: usize = size_of::<[u32; 3]>();

/// How the corners of a primitive are joined; `None` where it has no surface.
pub(crate) fn topology(primitive: &Primitive, warnings: &Warnings) -> Result<Option<Topology>, Refusal> {
    let Mode::Triangles(topology) = Mode::of(primitive.mode.map_or(TRIANGLES, |mode| mode.0))? else {
        warnings.add_of_file("points and lines have no surface: they are left out");
        return Ok(None);
    };
    if !primitive.attributes.contains_key(POSITION) {
        warnings.add_of_file("a primitive without positions is left out");
        return Ok(None);
    }
    Ok(Some(topology))
}

impl Accessors {
    /// Those of a primitive, with texture coordinates of that set; `None` where it has no positions.
    pub(crate) fn of(
        primitive: &Primitive,
        topology: Topology,
        uv_set: u64,
        source: &Source<'_>,
    ) -> Result<Option<Self>, Refusal> {
        let Some(&positions) = primitive.attributes.get(POSITION) else { return Ok(None) };
        refuse_packed(primitive, positions, source)?;
        let named = |name: &str| primitive.attributes.get(name).copied();
        let uvs = named(&format!("TEXCOORD_{uv_set}"));
        let (normals, colors, tangents) = (named("NORMAL"), named("COLOR_0"), named("TANGENT"));
        Ok(Some(Self { positions, normals, uvs, colors, tangents, indices: primitive.indices, topology }))
    }
}

/// Refuses what lies in a packed buffer alone.
fn refuse_packed(primitive: &Primitive, positions: Whole, source: &Source<'_>) -> Result<(), Refusal> {
    const DRACO: &str = "KHR_draco_mesh_compression";
    let accessor = source.document.accessors.get(positions.index());
    if primitive.extensions.draco.is_none() || accessor.is_none_or(|accessor| accessor.buffer_view.is_some())
    {
        return Ok(());
    }
    let command = extensions::hint(DRACO).unwrap_or_default();
    Err(Refusal::new(format!(
        "is packed by {DRACO}, which cannot be unpacked here: unpack it first, as by {command}"
    )))
}

impl Corners {
    /// Reads them; `None` where there are no triangles.
    pub(crate) fn read(from: &Accessors, source: &Source<'_>) -> Result<Option<Self>, Refusal> {
        let positions = source.accessor(from.positions).within(|| "attributes.POSITION".to_owned())?;
        let rows = positions.count();
        let mut triangles = triangles(from, rows, source)?;
        if triangles.is_empty() {
            return Ok(None);
        }
        let chosen = chosen(&mut triangles, rows, source)?;
        let count = chosen.as_ref().map_or(rows, Vec::len);
        source.limits.take(count, CORNER)?;
        let mut corners = Self {
            positions: Vec::new(),
            triangles,
            normals: None,
            uvs: None,
            colors: None,
            tangents: None,
            chosen,
            rows,
        };
        corners.positions =
            positions.floats(3, corners.which()).within(|| "attributes.POSITION".to_owned())?;
        corners.refuse_infinite(&corners.positions)?;
        corners.normals = corners.attribute(from.normals, "NORMAL", 3, source)?;
        let uvs: Option<Vec<[f32; 2]>> = corners.attribute(from.uvs, "TEXCOORD", 2, source)?;
        corners.uvs = uvs.map(|uvs| uvs.into_iter().map(|[u, v]| [u, 1.0 - v]).collect());
        let colors: Option<Vec<[f32; 4]>> = corners.attribute(from.colors, "COLOR_0", 3, source)?;
        corners.colors =
            colors.map(|colors| colors.into_iter().map(|c| [c[0], c[1], c[2]].map(|v| v.max(0.0))).collect());
        // Tangents say nothing without normals.
        let tangents = from.tangents.filter(|_| corners.normals.is_some());
        corners.tangents = corners.attribute(tangents, "TANGENT", 4, source)?;
        Ok(Some(corners))
    }

    /// Which rows of accessors the corners are.
    pub(crate) fn which(&self) -> Which<'_> {
        self.chosen.as_ref().map_or(Which::All, |chosen| Which::These(chosen))
    }

    /// The rows of an accessor that stand for the corners.
    pub(crate) fn rows_of<const N: usize>(
        &self,
        accessor: &Accessor<'_>,
        least: usize,
    ) -> Result<Vec<[f32; N]>, Refusal> {
        if accessor.count() != self.rows {
            let message = format!("has {} rows, but there are {} positions", accessor.count(), self.rows);
            return Err(Refusal::new(message));
        }
        accessor.floats(least, self.which())
    }

    /// What an attribute gives, with 0 for what is no number.
    fn attribute<const N: usize>(
        &self,
        index: Option<Whole>,
        name: &str,
        least: usize,
        source: &Source<'_>,
    ) -> Result<Option<Vec<[f32; N]>>, Refusal> {
        let Some(index) = index else { return Ok(None) };
        let read = || self.rows_of::<N>(&source.accessor(index)?, least);
        let mut rows = read().within(|| format!("attributes.{name}"))?;
        let mut are_finite = true;
        for v in rows.as_flattened_mut().iter_mut().filter(|v| !v.is_finite()) {
            *v = 0.0;
            are_finite = false;
        }
        if !are_finite {
            source.warnings.add_of_file(format!("a {name} is no finite number: 0 is taken"));
        }
        Ok(Some(rows))
    }

    fn refuse_infinite(&self, positions: &[[f32; 3]]) -> Result<(), Refusal> {
        let Some(at) = positions.iter().position(|p| !p.iter().all(|v| v.is_finite())) else { return Ok(()) };
        let row = self.chosen.as_ref().map_or(at, |chosen| chosen[at] as usize);
        let message = format!("row {row} must be finite, not {:?}", positions[at]);
        Err(Refusal::new(message)).within(|| "attributes.POSITION".to_owned())
    }
}

/// The triangles, by rows of the positions.
fn triangles(from: &Accessors, rows: usize, source: &Source<'_>) -> Result<Vec<[u32; 3]>, Refusal> {
    let Some(index) = from.indices else {
        source.limits.take(from.topology.count(rows), TRIANGLE)?;
        // Counts of rows fit: accessors have no more.
        return Ok(from.topology.triangles(|i| i as u32, rows));
    };
    let read = || {
        let accessor = source.accessor(index)?;
        source.limits.take(accessor.count(), size_of::<u32>())?;
        source.limits.take(from.topology.count(accessor.count()), TRIANGLE)?;
        let indices = accessor.whole()?;
        match indices.iter().position(|&i| i as usize >= rows) {
            None => Ok(from.topology.triangles(|i| indices[i], indices.len())),
            Some(at) => Err(Refusal::new(format!(
                "number {at} names corner {}, of which there are {rows}",
                indices[at]
            ))),
        }
    };
    read().within(|| "indices".to_owned())
}

/// Which rows triangles use, where they do not use all; the triangles name places among these afterwards. Many files keep
/// the corners of many primitives in one accessor.
fn chosen(triangles: &mut [[u32; 3]], rows: usize, source: &Source<'_>) -> Result<Option<Vec<u32>>, Refusal> {
    let corners = triangles.as_flattened_mut();
    let (Some(&first), Some(&last)) = (corners.iter().min(), corners.iter().max()) else { return Ok(None) };
    let range = (last - first) as usize + 1;
    source.limits.take(range, size_of::<u32>())?;
    let mut places = vec![u32::MAX; range];
    for &corner in &*corners {
        places[(corner - first) as usize] = 0;
    }
    let mut chosen = Vec::new();
    for (row, place) in (first..=last).zip(&mut places) {
        if *place == 0 {
            *place = chosen.len() as u32;
            chosen.push(row);
        }
    }
    if chosen.len() == rows {
        return Ok(None);
    }
    for corner in corners {
        *corner = places[(*corner - first) as usize];
    }
    Ok(Some(chosen))
}
