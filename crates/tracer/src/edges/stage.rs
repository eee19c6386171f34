//! What does the search for outlines know of a scene? Its bodies, how they look, and the lamps that throw shadows.

use catoptra_core::glam::DVec3;
use catoptra_core::{Light, Material, ShadingPoint, Triple};

use super::body::{Body, Flat, Level};
use super::checker::Grid;
use super::sight::{EVERYWHERE, Sight};
use crate::Snapshot;

/// A light that throws hard shadows, in the snapshot's frame.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Lamp {
    At(DVec3),
    /// Along a unit vector, from infinity.
    Along(DVec3),
}

impl Lamp {
    fn of(light: &Light) -> Option<Self> {
        if !light.shadow() {
            return None;
        }
        light.position().map(Self::At).or_else(|| light.direction().map(Self::Along))
    }
}

/// A body, and how it looks.
#[derive(Debug, Clone)]
pub(crate) struct Subject {
    pub(crate) body: Body,
    /// Whether lamps change its look.
    pub(crate) lit: bool,
    /// What share of light it mirrors, if it does.
    pub(crate) mirror: Option<f64>,
    pub(crate) grid: Option<Grid>,
}

/// A scene.
#[derive(Debug, Default)]
pub(crate) struct Stage {
    pub(crate) subjects: Vec<Subject>,
    pub(crate) lamps: Vec<Lamp>,
}

/// A surface that lies in one plane, and the part of the picture it is seen in.
pub(crate) type Sheet<'a> = (&'a Level, [f64; 4]);

impl Stage {
    pub(crate) fn new(snapshot: &Snapshot) -> Self {
        let subject = |prim: &crate::Prim| {
            let row = &snapshot.material_rows()[prim.material as usize];
            let material = &snapshot.materials()[prim.material as usize];
            Subject {
                body: if prim.member.is_some() { Body::Other(prim.bounds()) } else { Body::of(&prim.shape) },
                lit: row.lobes.is_lit(),
                mirror: material.lobes(&ShadingPoint::HEAD_ON).mirror.map(|mirror| {
                    let Triple { x, y, z } = mirror.tint;
                    f64::max(x, y).max(z)
                }),
                grid: match material {
                    Material::Checker(checker) if row.is_pattern => {
                        Some(Grid::of(checker, snapshot.origin_in_frame()))
                    }
                    _ => None,
                },
            }
        };
        Self {
            subjects: snapshot.prims().iter().map(subject).collect(),
            lamps: snapshot.lights().iter().filter_map(Lamp::of).collect(),
        }
    }

    pub(crate) fn bodies(&self) -> impl Iterator<Item = &Body> + Clone {
        self.subjects.iter().map(|subject| &subject.body)
    }
}

impl Subject {
    /// Its flat surfaces that an eye may see, and where.
    pub(crate) fn sheets(&self, sight: &Sight) -> Vec<Sheet<'_>> {
        match &self.body {
            Body::Plane(level) => vec![(level, EVERYWHERE)],
            Body::Flats { flats, solid, .. } => {
                let faces = |flat: &&Flat| !*solid || flat.level.height(sight.eye) > 0.0;
                let seen = |flat: &Flat| {
                    sight.bounds_of_ball(flat.bounds.centre(), flat.bounds.size().length() / 2.0)
                };
                let sheets = flats.iter().filter(faces);
                sheets.filter_map(|flat| Some((&flat.level, seen(flat)?))).collect()
            }
            _ => Vec::new(),
        }
    }
}
