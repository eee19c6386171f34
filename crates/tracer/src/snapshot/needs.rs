//! Counts of what a snapshot holds: shapes, materials, lights, triangles.

use std::collections::HashMap;
use std::sync::Arc;

use catoptra_core::texture::{Image, Texture};
use catoptra_core::{EntityId, Light};
use serde::Serialize;

use super::Snapshot;

/// What there is in a snapshot.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct Needs {
    /// Shapes by kind, most first; bodies of lights are among them.
    pub shapes: Vec<(&'static str, usize)>,
    /// Lights by kind, most first; ambient light is not among them.
    pub lights: Vec<(&'static str, usize)>,
    /// Shapes of a material that shines and that light others, by kind, most first; bodies of lights are not among them.
    pub shining_shapes: Vec<(&'static str, usize)>,
    /// Outlines that light from surfaces comes from: faces, triangles, and whole disks and spheres.
    pub outlines: usize,
    /// Whether these are so many that points ask some of them, picked at random.
    pub picks_lamps: bool,
    /// Shapes that shine but light nothing, as they have no end.
    pub endless_lamps: usize,
    /// Shapes that shine and whose outlines are not known: only paths that meet them bring their light.
    pub lamps_met_alone: usize,
    /// Materials by kind, most first.
    pub materials: Vec<(&'static str, usize)>,
    /// Unbounded shapes, which are not in the tree.
    pub unbounded: usize,
    /// Meshes, each counted once however many instances it has.
    pub meshes: usize,
    /// Triangles of those meshes.
    pub triangles: usize,
    /// Bytes of all trees.
    pub tree_bytes: usize,
    /// Shapes that have a SIMD kernel; the others are crossed one ray at a time.
    pub with_kernel: usize,
    /// Textures by kind, most first.
    pub textures: Vec<(&'static str, usize)>,
    /// Bytes of the pictures of textures and of their smaller copies; each counted once.
    pub texture_bytes: usize,
    /// Whether points are shaded one by one in `f64`, as lanes do not know all of the scene's materials and lights.
    pub shades_by_point: bool,
    /// Whether any shape reflects.
    pub reflects: bool,
    /// Lights that throw shadows.
    pub shadowing_lights: usize,
    /// Whether there is ambient light.
    pub ambient: bool,
}

impl Snapshot {
    /// Counts what is in it.
    #[must_use]
    pub fn needs(&self) -> Needs {
        Needs {
            shapes: count(self.prims.iter().map(|p| p.shape.kind_name())),
            lights: count(self.single_lights().map(Light::kind_name)),
            shining_shapes: count(self.shining_shapes()),
            outlines: self.lamps.rows.len(),
            picks_lamps: self.lamps.tree.is_some(),
            endless_lamps: self.lamps.endless.len(),
            lamps_met_alone: self.lamps.met_alone.len(),
            materials: count(self.parts.materials.iter().map(|(_, material)| material.kind_name())),
            unbounded: self.index.unbounded.len(),
            meshes: self.index.meshes.len(),
            triangles: self.index.meshes.iter().map(|m| m.mesh().triangles().len()).sum(),
            tree_bytes: self.index.meshes.iter().map(|m| m.bytes()).sum::<usize>()
                + size_of_val(&self.index.tree.nodes[..])
                + size_of_val(&self.index.tree.order[..]),
            with_kernel: self.prims.len() - self.index.columns.without_kernel(),
            textures: count(self.parts.textures.values().map(Texture::kind_name)),
            texture_bytes: self.texture_bytes(),
            shades_by_point: self.matter.is_needed,
            reflects: self.has_mirrors || self.matter.is_needed,
            shadowing_lights: self.single_lights().filter(|light| light.shadow()).count(),
            ambient: self.ambient.max_channel() > 0.0,
        }
    }

    fn texture_bytes(&self) -> usize {
        let pictures: HashMap<*const Image, usize> = self
            .parts
            .textures
            .values()
            .filter_map(|texture| match texture {
                Texture::ImageTexture(texture) => Some(&texture.source().image),
                _ => None,
            })
            .map(|image| (Arc::as_ptr(image), image.bytes()))
            .collect();
        pictures.values().sum()
    }

    /// All lights but ambient ones.
    fn single_lights(&self) -> impl Iterator<Item = &Light> {
        let lights = self.parts.lights.iter().map(|light| &light.part);
        lights.filter(|light| !matches!(light, Light::AmbientLight(_)))
    }

    /// The kinds of shapes that shine by their material.
    fn shining_shapes(&self) -> impl Iterator<Item = &'static str> {
        let mut prims: Vec<u32> = self.lamps.rows.iter().filter_map(|lamp| lamp.prim).collect();
        prims.dedup();
        let named = self.parts.materials.len() as u32;
        let shapes = prims.into_iter().map(|prim| &self.prims[prim as usize]);
        shapes.filter(move |prim| prim.material < named).map(|prim| prim.shape.kind_name())
    }

    /// How many surfaces light others, where these are so many that every point asks some of them, picked at random.
    #[must_use]
    pub fn picked_lamps(&self) -> Option<usize> {
        self.lamps().tree.as_ref().map(|_| self.lamps().rows.len())
    }

    /// Shapes that shine and light nothing, as they have no end.
    pub fn endless_lamps(&self) -> impl Iterator<Item = EntityId> {
        self.lamps().endless.iter().map(|&prim| self.entities()[prim as usize])
    }

    /// Shapes that shine and whose outlines are not known, as of round ones: only paths that meet them bring their light.
    pub fn lamps_met_alone(&self) -> impl Iterator<Item = EntityId> {
        self.lamps().met_alone.iter().map(|&prim| self.entities()[prim as usize])
    }
}

fn count(names: impl Iterator<Item = &'static str>) -> Vec<(&'static str, usize)> {
    let mut counts: Vec<(&'static str, usize)> = Vec::new();
    for name in names {
        match counts.iter_mut().find(|(n, _)| *n == name) {
            Some(entry) => entry.1 += 1,
            None => counts.push((name, 1)),
        }
    }
    counts.sort_by_key(|&(name, n)| (std::cmp::Reverse(n), name));
    counts
}

#[cfg(test)]
mod tests {
    use catoptra_core::geometry::{Cuboid, Plane, Sphere};
    use catoptra_core::glam::DVec3;
    use catoptra_core::light::{AmbientLight, SphereLight};
    use catoptra_core::material::Emissive;
    use catoptra_core::{Rgb, Scene, Value, Values};

    use super::*;
    use crate::pool::one_thread;

    #[test]
    fn lamps_are_counted_by_kind_and_bodies_have_no_material_of_the_scene() {
        let mut scene = Scene::new();
        let glow = scene.add_material("glow", Emissive::new(Rgb::WHITE).unwrap()).unwrap();
        scene.add_shape("sky", Plane::new(DVec3::Y, DVec3::Y).unwrap(), glow, None).unwrap();
        scene.add_shape("box", Cuboid::new(DVec3::ZERO, DVec3::ONE).unwrap(), glow, None).unwrap();
        scene.add_shape("ball", Sphere::new(DVec3::X * 3.0, 1.0).unwrap(), glow, None).unwrap();
        let values = Values::new()
            .with("center", Value::Vector(DVec3::Y * 4.0))
            .with("radius", Value::Number(0.5))
            .with("radiance", Value::Color(Rgb::WHITE));
        let bulb: SphereLight = catoptra_core::part::make(&values).unwrap();
        scene.add_light("bulb", bulb, None).unwrap();
        scene.add_light("air", AmbientLight::new(Rgb::WHITE).unwrap(), None).unwrap();
        let needs = Snapshot::extract(&scene, one_thread()).needs();
        assert_eq!(needs.lights, [("sphere-light", 1)]);
        assert_eq!(needs.shining_shapes, [("box", 1), ("sphere", 1)]);
        assert_eq!((needs.outlines, needs.endless_lamps, needs.picks_lamps), (8, 1, false));
        assert_eq!((needs.materials, needs.shadowing_lights), (vec![("emissive", 1)], 1));
    }
}
