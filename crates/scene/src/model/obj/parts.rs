//! Which shapes do the faces of an OBJ file make up: one for each object or group and each material of it.

use std::collections::{HashMap, HashSet};
use std::ops::Range;

use catoptra_core::glam::DVec3;
use catoptra_core::{InvalidPart, TriangleMesh};

use super::tables::{self, Run, State, Tables, line_of_vertex};
use crate::model::colors::linear;
use crate::model::error::{Fault, Place};
use crate::model::mesh::{self, Corner, Cutter, NONE, Positions, Smoothing, is_place, normal_of, weld};
use crate::model::warnings::Warnings;

/// A file of more parts is cut by material alone.
const MOST: usize = 10_000;

/// A shape: what its faces are called and made of, as rows of the tables of names.
#[derive(Debug)]
pub(super) struct Part {
    /// Row of objects, or of groups where those tell more apart; `None` where parts are not told apart by name.
    pub(super) name: Option<(Named, u32)>,
    pub(super) material: u32,
    pub(super) mesh: TriangleMesh,
}

/// By which statement parts are told apart.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub(super) enum Named {
    Object,
    Group,
}

/// The parts of a file, in the order of their first faces. Takes the positions out of the tables.
///
/// # Errors
/// Corners that are nowhere.
pub(super) fn parts_of(tables: &mut Tables, bytes: &[u8], warnings: &Warnings) -> Result<Vec<Part>, Fault> {
    check(tables, bytes, warnings)?;
    let positions = Positions::Wide(std::mem::take(&mut tables.positions));
    let named = by_what(&tables.runs);
    let key = |state: State| {
        let name = match named {
            Named::Object => state.object,
            Named::Group => state.group,
        };
        (Some((named, name)), state.material)
    };
    let mut sorted = sorted_by(&tables.runs, key);
    if sorted.len() > MOST {
        warnings
            .add(Place::File, format!("{} parts are too many: all of one material are one", sorted.len()));
        sorted = sorted_by(&tables.runs, |state| (None, state.material));
    }
    let mut builder = Builder::new(tables, positions);
    let mut parts = Vec::new();
    for ((name, material), runs) in sorted {
        let mesh = builder.mesh(&runs).map_err(|e| Fault::new(Place::File, e))?;
        parts.push(Part { name, material, mesh });
    }
    Ok(parts)
}

/// By objects, unless groups tell more apart than one.
fn by_what(runs: &[Run]) -> Named {
    let objects: HashSet<u32> = runs.iter().map(|run| run.state.object).collect();
    if objects.len() > 1 || objects.iter().any(|&row| row > 0) && runs.iter().all(|run| run.state.group == 0)
    {
        Named::Object
    } else {
        Named::Group
    }
}

/// Runs of faces, each with the state that holds in it.
type Runs = Vec<(Range<usize>, State)>;

fn sorted_by<K: std::hash::Hash + Eq + Copy>(runs: &[Run], key: impl Fn(State) -> K) -> Vec<(K, Runs)> {
    let (mut places, mut sorted): (HashMap<K, usize>, Vec<(K, Runs)>) = (HashMap::new(), Vec::new());
    let mut start = 0;
    for run in runs {
        let key = key(run.state);
        let place = *places.entry(key).or_insert(sorted.len());
        if place == sorted.len() {
            sorted.push((key, Vec::new()));
        }
        sorted[place].1.push((start..run.end, run.state));
        start = run.end;
    }
    sorted
}

/// Refuses faces whose corners are not there or nowhere, and notes what else they lack.
fn check(tables: &Tables, bytes: &[u8], warnings: &Warnings) -> Result<(), Fault> {
    let count = tables.positions.len();
    let mut start = 0;
    for face in &tables.faces {
        for &[position, uv, normal] in &tables.corners[start..face.end] {
            let place = Place::Line(face.line);
            let Some(&point) = tables.positions.get(position as usize) else {
                let vertex = u64::from(position) + 1;
                let message = format!("a face refers to vertex {vertex}, but there are {count}");
                return Err(Fault::new(place, message));
            };
            if !is_place(point.into()) {
                let message = "coordinates must be finite numbers where a face uses them";
                return Err(Fault::new(line_of_vertex(bytes, position), message));
            }
            if uv != NONE && uv as usize >= tables.uvs.len() {
                warnings.add(place, "faces refer to texture coordinates that are not there: they have none");
            }
            if normal != NONE && normal as usize >= tables.normals.len() {
                warnings
                    .add(place, "faces refer to normals that are not there: those of the faces are taken");
            }
        }
        start = face.end;
    }
    Ok(())
}

/// Makes meshes of runs of faces.
struct Builder<'a> {
    tables: &'a Tables,
    positions: Positions,
    colors: Vec<[f32; 3]>,
    origin: DVec3,
    /// Those of the file, then those of corners in smoothing groups, then those of faces.
    normals: Vec<[f32; 3]>,
    smoothing: Smoothing,
    /// Where the normals of smoothing groups begin.
    smooth: u32,
    cutter: Cutter,
    // Of the face at hand: its triangles, where its corners are, and what they have.
    pieces: Vec<[u32; 3]>,
    outline: Vec<DVec3>,
    rows: Vec<Corner>,
}

impl<'a> Builder<'a> {
    fn new(tables: &'a Tables, positions: Positions) -> Self {
        let origin = positions.origin(tables.corners.iter().map(|&[position, ..]| position));
        // Corners without a colour among others are white.
        let color = |color: &[f32; 3]| color.map(|v| if v.is_nan() { f32::INFINITY } else { v });
        let colors = linear(tables.colors.iter().map(color).collect());
        let mut builder = Self {
            tables,
            positions,
            colors,
            origin,
            normals: tables.normals.iter().map(|&normal| unit(normal)).collect(),
            smoothing: Smoothing::default(),
            smooth: tables.normals.len() as u32,
            cutter: Cutter::default(),
            pieces: Vec::new(),
            outline: Vec::new(),
            rows: Vec::new(),
        };
        builder.smooth_groups();
        builder
    }

    /// The corners of a face.
    fn corners(&self, face: usize) -> &'a [tables::Corner] {
        let start = if face == 0 { 0 } else { self.tables.faces[face - 1].end };
        &self.tables.corners[start..self.tables.faces[face].end]
    }

    /// Whether a row of normals has a direction.
    fn is_normal(&self, row: u32) -> bool {
        self.normals.get(row as usize).is_some_and(|&normal| normal != [0.0; 3])
    }

    /// Where corners are, in memory that is used again.
    fn outline(&self, corners: &[tables::Corner], mut outline: Vec<DVec3>) -> Vec<DVec3> {
        outline.clear();
        outline.extend(corners.iter().map(|&[position, ..]| self.positions.at(position)));
        outline
    }

    /// Adds the normals of corners that lack them where their faces are smooth.
    fn smooth_groups(&mut self) {
        let mut start = 0;
        for run in &self.tables.runs {
            let faces = std::mem::replace(&mut start, run.end)..run.end;
            if run.state.smoothing == 0 {
                continue;
            }
            for face in faces {
                let corners = self.corners(face);
                if corners.iter().all(|&[.., normal]| self.is_normal(normal)) {
                    continue;
                }
                let outline = self.outline(corners, Vec::new());
                let numbers: Vec<u32> = corners.iter().map(|&[position, ..]| position).collect();
                self.smoothing.add(&numbers, &outline, run.state.smoothing);
            }
        }
        self.normals.extend(self.smoothing.normals());
    }

    fn mesh(&mut self, runs: &Runs) -> Result<TriangleMesh, InvalidPart> {
        let mut faces = runs.iter().flat_map(|(faces, state)| faces.clone().map(move |face| (face, state)));
        let has_normal = |&[.., normal]: &tables::Corner| self.is_normal(normal);
        let is_smooth =
            faces.any(|(face, state)| state.smoothing > 0 || self.corners(face).iter().any(has_normal));
        let own = self.normals.len();
        let count =
            |faces: &Range<usize>| faces.clone().map(|face| self.corners(face).len() - 2).sum::<usize>();
        let mut triangles = Vec::with_capacity(runs.iter().map(|(faces, _)| count(faces)).sum());
        for (faces, state) in runs {
            for face in faces.clone() {
                self.add_face(face, is_smooth.then_some(state.smoothing), &mut triangles);
            }
        }
        let tables = mesh::Tables {
            positions: &self.positions,
            origin: self.origin,
            normals: &self.normals,
            uvs: &self.tables.uvs,
            colors: &self.colors,
        };
        let mesh = weld(&tables, &triangles);
        self.normals.truncate(own);
        mesh
    }

    /// Adds the triangles of a face, whose corners have normals where its part is smooth.
    fn add_face(&mut self, face: usize, smoothing: Option<u32>, triangles: &mut Vec<[Corner; 3]>) {
        let corners = self.corners(face);
        let outline = std::mem::take(&mut self.outline);
        let outline = self.outline(corners, outline);
        self.pieces.clear();
        self.cutter.cut(&outline, &mut self.pieces);
        let (mut rows, mut flat) = (std::mem::take(&mut self.rows), NONE);
        rows.clear();
        for &[position, uv, normal] in corners {
            let normal = match smoothing.map(|group| self.normal_row(position, normal, group)) {
                None => NONE,
                Some(Some(row)) => row,
                Some(None) => {
                    if flat == NONE {
                        flat = self.normals.len() as u32;
                        self.normals.push(normal_of(&outline).as_vec3().to_array());
                    }
                    flat
                }
            };
            let has_uv = self.tables.uvs.get(uv as usize).is_some_and(|uv| uv.iter().all(|v| v.is_finite()));
            rows.push(Corner {
                position,
                normal,
                uv: if has_uv { uv } else { NONE },
                color: if self.colors.is_empty() { NONE } else { position },
            });
        }
        triangles.extend(self.pieces.iter().map(|piece| piece.map(|i| rows[i as usize])));
        (self.outline, self.rows) = (outline, rows);
    }

    /// The row of a corner's normal, its own or that of its smoothing group; `None` where it has that of the face.
    fn normal_row(&self, position: u32, own: u32, group: u32) -> Option<u32> {
        if self.is_normal(own) {
            return Some(own);
        }
        let smooth = self.smoothing.find(position, group).map(|row| self.smooth + row);
        smooth.filter(|&row| self.is_normal(row))
    }
}

/// A normal of about unit length; zero where it has no direction.
fn unit(normal: [f32; 3]) -> [f32; 3] {
    let wide = DVec3::from(normal.map(f64::from));
    if (wide.length_squared() - 1.0).abs() < 1e-3 {
        return normal;
    }
    if wide.is_finite() { wide.normalize_or_zero().as_vec3().to_array() } else { [0.0; 3] }
}
