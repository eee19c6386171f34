//! Which faces does a PLY file have?

use super::body::Body;
use super::header::{Element, Property};
use super::vertices::{BLUE, Found, GREEN, RED, unit_of};
use crate::model::error::{Fault, Place};
use crate::model::mesh::Cutter;
use crate::model::warnings::Warnings;

/// Spellings of the list of a face's corners.
const CORNERS: &[&str] = &["vertex_indices", "vertex_index", "vertex_indexes"];

/// Faces as triangles, or whole where more is known of them than their corners, or the vertices come later.
#[derive(Debug, Default)]
pub(super) struct Faces {
    pub(super) triangles: Vec<[u32; 3]>,
    pub(super) whole: Whole,
    cutter: Cutter,
    pieces: Vec<[u32; 3]>,
}

/// Faces with what each has of its own.
#[derive(Debug, Default)]
pub(super) struct Whole {
    pub(super) corners: Vec<u32>,
    /// For each face where its corners end.
    pub(super) ends: Vec<usize>,
    /// For each corner, where faces have texture coordinates.
    pub(super) uvs: Vec<[f32; 2]>,
    /// For each face, where faces have colours; as the file writes them.
    pub(super) colors: Vec<[f32; 3]>,
    /// For each face, where faces name pictures.
    pub(super) pictures: Vec<i64>,
}

/// Which properties of faces are in use, by their places in the row.
struct Plan {
    corners: usize,
    uvs: Option<usize>,
    colors: Option<[usize; 3]>,
    picture: Option<usize>,
}

impl Plan {
    /// Corners alone.
    const PLAIN: Self = Self { corners: 0, uvs: None, colors: None, picture: None };

    fn of(element: &Element) -> Result<Self, Fault> {
        let place = |names: &[&str], is_list: bool| {
            let fits = |p: &Property| p.list.is_some() == is_list && names.contains(&p.name.as_str());
            element.properties.iter().position(fits)
        };
        let Some(corners) = place(CORNERS, true) else {
            let message = "the faces lack a list property vertex_indices";
            return Err(Fault::new(Place::Line(element.line), message));
        };
        let colors = [RED, GREEN, BLUE].map(|names| place(names, false));
        let [red, green, blue] = colors;
        Ok(Self {
            corners,
            uvs: place(&["texcoord", "texture_uv"], true),
            colors: red.zip(green).zip(blue).map(|((red, green), blue)| [red, green, blue]),
            picture: place(&["texnumber"], false),
        })
    }

    fn is_plain(&self) -> bool {
        self.uvs.is_none() && self.colors.is_none() && self.picture.is_none()
    }
}

impl Faces {
    /// Reads polygons. `count` is how many vertices there are or will be; `found`, those that have been read.
    pub(super) fn read<B: Body>(
        &mut self,
        element: &Element,
        body: &mut B,
        found: Option<&Found>,
        count: usize,
        warnings: &Warnings,
    ) -> Result<(), Fault> {
        let plan = Plan::of(element)?;
        let plain = found.filter(|_| plan.is_plain());
        self.triangles.reserve(if plain.is_some() { element.count } else { 0 });
        let (mut row, mut corners) = (Row::default(), Vec::new());
        for _ in 0..element.count {
            let place = body.begin_row()?;
            row.read(element, body, &plan)?;
            check_range(&row.corners, count, place)?;
            if row.corners.len() < 3 {
                warnings.add(place, "faces of fewer than three corners are left out");
                continue;
            }
            corners.clear();
            corners.extend(row.corners.iter().map(|&corner| corner as u32));
            match plain {
                Some(found) => self.add_triangles(&corners, found)?,
                None => self.whole.add(&corners, &row, &plan),
            }
        }
        Ok(())
    }

    fn add_triangles(&mut self, corners: &[u32], found: &Found) -> Result<(), Fault> {
        found.check(corners)?;
        if let &[a, b, c] = corners {
            self.triangles.push([a, b, c]);
            return Ok(());
        }
        let pieces = cut(&mut self.cutter, &mut self.pieces, corners, found);
        self.triangles.extend(pieces.iter().map(|piece| piece.map(|i| corners[i as usize])));
        Ok(())
    }

    /// Reads strips: each corner after the second makes a triangle with the two before it, and a negative one begins anew.
    pub(super) fn read_strips<B: Body>(
        &mut self,
        element: &Element,
        body: &mut B,
        found: Option<&Found>,
        count: usize,
    ) -> Result<(), Fault> {
        let plan = Plan::of(element)?;
        let mut row = Row::default();
        for _ in 0..element.count {
            let place = body.begin_row()?;
            row.read(element, body, &plan)?;
            for strip in row.corners.split(|&corner| corner < 0.0 || corner == f64::from(u32::MAX)) {
                check_range(strip, count, place)?;
                for (i, three) in strip.windows(3).enumerate() {
                    let [a, b, c] = [0, 1, 2].map(|k| three[k] as u32);
                    let triangle = if i % 2 == 0 { [a, b, c] } else { [b, a, c] };
                    if a == b || b == c || c == a {
                        continue;
                    }
                    match found {
                        Some(found) => self.add_triangles(&triangle, found)?,
                        None => self.whole.add(&triangle, &Row::default(), &Plan::PLAIN),
                    }
                }
            }
        }
        Ok(())
    }
}

/// Cuts a face whose corners are places.
pub(super) fn cut<'a>(
    cutter: &mut Cutter,
    pieces: &'a mut Vec<[u32; 3]>,
    corners: &[u32],
    found: &Found,
) -> &'a [[u32; 3]] {
    let outline: Vec<_> = corners.iter().map(|&corner| found.vertices.positions.at(corner)).collect();
    pieces.clear();
    cutter.cut(&outline, pieces);
    pieces
}

fn check_range(corners: &[f64], count: usize, place: Place) -> Result<(), Fault> {
    // Casts saturate, so only whole numbers of the range come back as they were.
    let is_vertex = |&corner: &f64| f64::from(corner as u32) == corner && (corner as usize) < count;
    match corners.iter().find(|corner| !is_vertex(corner)) {
        None => Ok(()),
        Some(bad) => {
            let message = format!("a face refers to vertex {bad}, but there are {count} (from 0)");
            Err(Fault::new(place, message))
        }
    }
}

/// What a row says.
#[derive(Default)]
struct Row {
    corners: Vec<f64>,
    uvs: Vec<f64>,
    color: [f32; 3],
    picture: i64,
}

impl Row {
    #[inline]
    fn read<B: Body>(&mut self, element: &Element, body: &mut B, plan: &Plan) -> Result<(), Fault> {
        for (i, property) in element.properties.iter().enumerate() {
            let channel = plan.colors.and_then(|places| places.iter().position(|&place| place == i));
            match property.list {
                Some(count) if i == plan.corners => body.list(count, property.sort, &mut self.corners)?,
                Some(count) if plan.uvs == Some(i) => body.list(count, property.sort, &mut self.uvs)?,
                None if plan.picture == Some(i) => self.picture = body.scalar(property.sort)? as i64,
                None if channel.is_some() => {
                    let share = body.scalar(property.sort)? / unit_of(property.sort);
                    channel.into_iter().for_each(|channel| self.color[channel] = share as f32);
                }
                _ => body.pass(property)?,
            }
        }
        Ok(())
    }
}

impl Whole {
    fn add(&mut self, corners: &[u32], row: &Row, plan: &Plan) {
        // What other faces lack has been filled in for them.
        let before = self.corners.len();
        if plan.uvs.is_some() {
            self.uvs.resize(before, [f32::NAN; 2]);
            let uv = |i: usize| {
                row.uvs.get(2 * i..2 * i + 2).map_or([f32::NAN; 2], |uv| [uv[0] as f32, uv[1] as f32])
            };
            self.uvs.extend((0..corners.len()).map(uv));
        }
        if plan.colors.is_some() {
            self.colors.resize(self.ends.len(), [1.0; 3]);
            self.colors.push(row.color);
        }
        if plan.picture.is_some() {
            self.pictures.resize(self.ends.len(), 0);
            self.pictures.push(row.picture);
        }
        self.corners.extend_from_slice(corners);
        self.ends.push(self.corners.len());
    }
}
