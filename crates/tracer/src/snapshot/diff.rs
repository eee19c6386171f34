//! What differs between two snapshots: the ground for tracing only what has changed.

use std::borrow::Cow;
use std::collections::HashSet;

use catoptra_core::glam::DVec3;
use catoptra_core::{
    Aabb, Camera, EntityId, Finish, Light, Material, MaterialId, Placed, Placement, Rgb, Shape,
};
use itertools::{EitherOrBoth, merge_join_by};

use super::origin::relative;
use super::{Prim, Snapshot};

/// The differences between two snapshots. Values are compared as numbers, so that 0 and −0 are one.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct SnapshotDiff {
    /// Shapes that stand or look otherwise, by age.
    pub shapes: Vec<ShapeDiff>,
    /// Lights that shine otherwise in the world, by age; ambient ones as well.
    pub lights: Vec<PartDiff<EntityId, Light>>,
    /// Materials with other values, by age. A change of name is none.
    pub materials: Vec<PartDiff<MaterialId, Material>>,
    /// Materials that may look different although their values are the same: by their finish, or by a texture. By age.
    pub repainted: Vec<MaterialId>,
    /// Cameras that see otherwise in the world, by age.
    pub cameras: Vec<PartDiff<EntityId, Camera>>,
    /// [`Snapshot::origin`], if it is elsewhere: the last bits of everything may then be others.
    pub origin: Option<Changed<DVec3>>,
    /// [`Snapshot::frame`], if it is elsewhere.
    pub frame: Option<Changed<DVec3>>,
    /// The sum of ambient light.
    pub ambient: Option<Changed<Rgb>>,
    /// The background.
    pub background: Option<Changed<Rgb>>,
    /// How many reflections the scene's settings allow.
    pub max_depth: Option<Changed<u32>>,
}

/// A value that is another one now.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Changed<T> {
    /// In the earlier snapshot.
    pub before: T,
    /// In the later one.
    pub after: T,
}

/// In which of two snapshots something is.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Presence {
    /// Only in the later one.
    Appeared,
    /// Only in the earlier one.
    Disappeared,
    /// In both.
    Stayed,
}

/// A shape that is not the same.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ShapeDiff {
    /// Which.
    pub entity: EntityId,
    /// In which snapshot it is.
    pub presence: Presence,
    /// Whether its form or its placement in the world differs; true for what is in one snapshot only.
    pub shape: bool,
    /// Whether it looks different: it has another material, or its material has other values.
    pub material: bool,
    /// The box in the world round the earlier shape; `None` if that is unbounded, or not there.
    pub before: Option<Aabb>,
    /// The same round the later shape.
    pub after: Option<Aabb>,
}

/// A light, material or camera that is not the same, in world space.
#[derive(Debug, Clone, PartialEq)]
pub struct PartDiff<I, T> {
    /// Which.
    pub id: I,
    /// In the earlier snapshot; `None` where it is not there.
    pub before: Option<T>,
    /// In the later snapshot; `None` where it is not there.
    pub after: Option<T>,
}

impl<I, T> PartDiff<I, T> {
    /// In which snapshot it is.
    #[must_use]
    pub fn presence(&self) -> Presence {
        match (&self.before, &self.after) {
            (None, _) => Presence::Appeared,
            (_, None) => Presence::Disappeared,
            _ => Presence::Stayed,
        }
    }
}

impl SnapshotDiff {
    /// Compares two snapshots, of any scenes: things of the same id count as the same thing.
    #[must_use]
    pub fn between(before: &Snapshot, after: &Snapshot) -> Self {
        let materials = by_id(&before.parts.materials, &after.parts.materials, |(id, part)| (*id, part));
        let repainted = repainted(before, after);
        let changed_materials = materials.iter().map(|m| m.id).chain(repainted.iter().copied()).collect();
        Self {
            shapes: shapes(before, after, &changed_materials),
            repainted,
            lights: by_id(&before.parts.lights, &after.parts.lights, named),
            cameras: by_id(&before.parts.cameras, &after.parts.cameras, named),
            materials,
            origin: changed(before.origin, after.origin),
            frame: changed(before.frame, after.frame),
            ambient: changed(before.ambient, after.ambient),
            background: changed(before.background, after.background),
            max_depth: changed(before.parts.settings.max_depth(), after.parts.settings.max_depth()),
        }
    }

    /// Whether nothing differs.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        *self == Self::default()
    }
}

/// Materials of both with another finish, or with textures where any of these has changed.
fn repainted(before: &Snapshot, after: &Snapshot) -> Vec<MaterialId> {
    let (before, after) = (&before.parts, &after.parts);
    let textures = before.textures != after.textures;
    let finish_before = |id: MaterialId| {
        let at = before.materials.iter().position(|(other, _)| *other == id)?;
        before.finishes.get(at).copied()
    };
    let looks_new = |id: MaterialId, material: &Material, finish: Finish| {
        finish_before(id).is_some_and(|was| was != finish)
            || (textures && (material.is_textured() || !finish.is_plain()))
    };
    let all = after.materials.iter().zip(&after.finishes);
    all.filter(|((id, material), finish)| looks_new(*id, material, **finish))
        .map(|((id, _), _)| *id)
        .collect()
}

fn changed<T: PartialEq>(before: T, after: T) -> Option<Changed<T>> {
    (before != after).then_some(Changed { before, after })
}

fn named<T>(placed: &Placed<T>) -> (EntityId, &T) {
    (placed.id, &placed.part)
}

/// Entries that are in one of two lists only, or have another value in each. Both are sorted by id.
fn by_id<E, I: Ord, T: PartialEq + Clone>(
    before: &[E],
    after: &[E],
    read: impl Fn(&E) -> (I, &T),
) -> Vec<PartDiff<I, T>> {
    let (before, after) = (before.iter().map(&read), after.iter().map(&read));
    merge_join_by(before, after, |a, b| a.0.cmp(&b.0))
        .filter_map(|pair| match pair {
            EitherOrBoth::Both(a, b) if a.1 == b.1 => None,
            EitherOrBoth::Both((id, a), (_, b)) => {
                Some(PartDiff { id, before: Some(a.clone()), after: Some(b.clone()) })
            }
            EitherOrBoth::Left((id, a)) => Some(PartDiff { id, before: Some(a.clone()), after: None }),
            EitherOrBoth::Right((id, b)) => Some(PartDiff { id, before: None, after: Some(b.clone()) }),
        })
        .collect()
}

fn shapes(before: &Snapshot, after: &Snapshot, changed: &HashSet<MaterialId>) -> Vec<ShapeDiff> {
    merge_join_by(Standing::all(before), Standing::all(after), |a, b| a.id().cmp(&b.id()))
        .filter_map(|pair| match pair {
            EitherOrBoth::Both(a, b) => a.against(&b, changed),
            EitherOrBoth::Left(a) => Some(ShapeDiff { before: a.bounds(), ..a.alone(Presence::Disappeared) }),
            EitherOrBoth::Right(b) => Some(ShapeDiff { after: b.bounds(), ..b.alone(Presence::Appeared) }),
        })
        .collect()
}

/// One shape of a snapshot.
struct Standing<'a> {
    snapshot: &'a Snapshot,
    prim: usize,
}

impl<'a> Standing<'a> {
    fn all(snapshot: &'a Snapshot) -> impl Iterator<Item = Self> {
        (0..snapshot.prims.len()).map(move |prim| Self { snapshot, prim })
    }

    fn id(&self) -> EntityId {
        self.snapshot.entities[self.prim]
    }

    /// In the world. Taking a shape into a frame rounds nothing, and neither does taking it back.
    fn shape(&self) -> Cow<'a, Shape> {
        relative(&self.prim().shape, -self.snapshot.frame)
    }

    fn bounds(&self) -> Option<Aabb> {
        match &self.prim().member {
            Some(member) => {
                let moved = Placement::IDENTITY.moved(self.snapshot.frame).unwrap_or_default();
                member.placed(&moved).bounds()
            }
            None => self.shape().bounds(),
        }
    }

    fn prim(&self) -> &'a Prim {
        &self.snapshot.prims[self.prim]
    }

    /// Its material, and what that is called; the body of a light has one without a name.
    fn material(&self) -> (Option<MaterialId>, &'a Material) {
        let (parts, at) = (&self.snapshot.parts, self.snapshot.prims[self.prim].material as usize);
        match parts.materials.get(at) {
            Some((id, material)) => (Some(*id), material),
            None => (None, &parts.bodies[at - parts.materials.len()].material),
        }
    }

    fn alone(&self, presence: Presence) -> ShapeDiff {
        ShapeDiff { entity: self.id(), presence, shape: true, material: true, before: None, after: None }
    }

    /// What differs in a later snapshot, where those materials have other values.
    fn against(&self, later: &Self, changed: &HashSet<MaterialId>) -> Option<ShapeDiff> {
        let touched = |standing: &Self| standing.snapshot.touched[standing.prim];
        let solid = |standing: &Self| standing.prim().member.is_some();
        let shape =
            touched(self) != touched(later) && (solid(self) || solid(later) || self.shape() != later.shape());
        let [(old, was), (new, is)] = [self.material(), later.material()];
        let material = match (old, new) {
            (Some(old), Some(new)) if old == new => changed.contains(&old),
            _ => was != is,
        };
        (shape || material).then(|| ShapeDiff {
            shape,
            material,
            before: self.bounds(),
            after: later.bounds(),
            ..self.alone(Presence::Stayed)
        })
    }
}
