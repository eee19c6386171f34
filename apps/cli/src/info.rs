//! `catoptra info`: what does a scene or a model hold? Nothing is traced.

use std::collections::{BTreeMap, HashSet};
use std::fs::File;
use std::io::Read;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use catoptra_core::scene::{Role, Scene};
use catoptra_core::{Aabb, Shape, Value};
use catoptra_scene::{SceneFile, model, printable};
use clap::Args;
use miette::Result;
use serde_json::json;

use crate::Outcome;
use crate::console::print_answer;
use crate::loaded::read;
use crate::words::{bytes, counted, list};

#[derive(Args)]
pub(crate) struct InfoArgs {
    /// Scene file (.kdl) or model file, or - for standard input
    pub(crate) file: PathBuf,
    /// Answer with a JSON object
    #[arg(long)]
    pub(crate) json: bool,
}

/// Says what a file holds.
pub(crate) fn run(args: &InfoArgs) -> Result<Outcome> {
    let (scene, file) = read(&args.file)?;
    let found = Found::of(&args.file, &scene, &file);
    print_answer(&if args.json { found.as_json() } else { found.as_text() })?;
    Ok(Outcome::Done)
}

struct Texture {
    name: String,
    size: Option<[u32; 2]>,
    /// Of its picture with what is made of it, in bytes.
    memory: Option<usize>,
}

struct Found {
    format: &'static str,
    /// Of all meshes as they are seen, each as often as it is there.
    triangles: u64,
    /// Stored: each mesh once.
    vertices: u64,
    meshes: usize,
    instances: usize,
    shapes: Vec<(&'static str, usize)>,
    bounds: Option<Aabb>,
    materials: Vec<(String, &'static str, Vec<String>)>,
    textures: Vec<Texture>,
    lights: Vec<(&'static str, usize)>,
    cameras: Vec<String>,
    added: Option<String>,
    warnings: Vec<String>,
}

impl Found {
    fn of(path: &Path, scene: &Scene, file: &SceneFile) -> Self {
        let ending = path.extension().map(|e| e.to_string_lossy().to_lowercase()).unwrap_or_default();
        let is_such = |format: &&model::Format| format.endings.contains(&ending.as_str());
        let mut found = Self {
            format: by_content(path)
                .or_else(|| model::FORMATS.iter().find(is_such))
                .map_or("scene", |format| format.name),
            triangles: 0,
            vertices: 0,
            meshes: 0,
            instances: 0,
            shapes: counts(scene.shapes().iter().map(|(_, shape, _)| shape.kind_name())),
            bounds: bounds(scene),
            materials: materials(scene),
            textures: scene.textures().map(|(_, name, texture)| Texture::of(name, texture)).collect(),
            lights: counts(scene.lights().iter().map(|(_, light)| light.kind_name())),
            cameras: scene.entities_of(Role::Camera).filter_map(|id| scene.name(id)).collect(),
            added: file.added().map(str::to_owned),
            warnings: file.warnings(),
        };
        let mut seen = HashSet::new();
        for (_, shape, _) in scene.shapes() {
            let Shape::Mesh(shape) = &shape else { continue };
            let mesh = &shape.source().mesh;
            found.instances += 1;
            found.triangles += mesh.triangles().len() as u64;
            if seen.insert(Arc::as_ptr(mesh)) {
                found.meshes += 1;
                found.vertices += mesh.positions().len() as u64;
            }
        }
        found
    }

    fn as_text(&self) -> String {
        let total = |kinds: &[(&str, usize)]| kinds.iter().map(|(_, count)| *count as u64).sum::<u64>();
        let mut lines = vec![format!("format: {}", self.format)];
        lines.push(format!("{}{}", counted(total(&self.shapes), "shape"), list(&self.shapes)));
        if self.instances > 0 {
            lines.push(format!(
                "{} in {}, stored once and used {}; {} stored",
                counted(self.triangles, "triangle"),
                if self.meshes == 1 { "1 mesh".to_owned() } else { format!("{} meshes", self.meshes) },
                counted(self.instances as u64, "time"),
                if self.vertices == 1 {
                    "1 vertex".to_owned()
                } else {
                    format!("{} vertices", self.vertices)
                },
            ));
        }
        if let Some(bounds) = self.bounds {
            let [x, y, z] = (bounds.max - bounds.min).to_array();
            lines.push(format!("bounds: {} to {} ({x} x {y} x {z} m)", bounds.min, bounds.max));
        }
        lines.push(counted(self.materials.len() as u64, "material"));
        for (name, kind, textures) in &self.materials {
            let painted =
                if textures.is_empty() { String::new() } else { format!(", {}", textures.join(", ")) };
            lines.push(format!("  {name}: {kind}{painted}"));
        }
        lines.push(counted(self.textures.len() as u64, "texture"));
        for texture in &self.textures {
            let size = texture.size.zip(texture.memory).map_or_else(
                || "computed".to_owned(),
                |([w, h], memory)| format!("{w}x{h}, {} of memory", bytes(memory as u64)),
            );
            lines.push(format!("  {}: {size}", texture.name));
        }
        lines.push(format!("{}{}", counted(total(&self.lights), "light"), list(&self.lights)));
        let cameras =
            if self.cameras.is_empty() { String::new() } else { format!(": {}", self.cameras.join(", ")) };
        lines.push(format!("{}{cameras}", counted(self.cameras.len() as u64, "camera")));
        lines.extend(self.added.clone());
        lines.extend(self.warnings.iter().map(|warning| format!("ignored: {warning}")));
        lines.iter().map(|line| format!("{}\n", printable(line))).collect()
    }

    fn as_json(&self) -> String {
        let kinds = |kinds: &[(&'static str, usize)]| kinds.iter().copied().collect::<BTreeMap<_, _>>();
        let materials = self
            .materials
            .iter()
            .map(|(name, kind, textures)| json!({ "name": name, "kind": kind, "textures": textures }));
        let textures =
            self.textures.iter().map(|t| json!({ "name": t.name, "size": t.size, "memory": t.memory }));
        let value = json!({
            "format": self.format,
            "triangles": self.triangles,
            "vertices": self.vertices,
            "meshes": self.meshes,
            "instances": self.instances,
            "shapes": kinds(&self.shapes),
            "bounds": self.bounds.map(|b| [b.min.to_array(), b.max.to_array()]),
            "materials": materials.collect::<Vec<_>>(),
            "textures": textures.collect::<Vec<_>>(),
            "lights": kinds(&self.lights),
            "cameras": self.cameras,
            "added": self.added,
            "warnings": self.warnings,
        });
        format!("{value:#}\n")
    }
}

impl Texture {
    fn of(name: &str, texture: &catoptra_core::Texture) -> Self {
        let values = texture.values();
        let image = values.iter().find_map(|(_, value)| match value {
            Value::Image(source) => Some(&source.image),
            _ => None,
        });
        let size = image.map(|image| [image.width(), image.height()]);
        Self { name: name.to_owned(), size, memory: image.map(|image| image.bytes()) }
    }
}

/// The format of a file that can be no other, whatever its name says.
fn by_content(path: &Path) -> Option<&'static model::Format> {
    if !path.is_file() {
        return None;
    }
    let mut start = Vec::new();
    File::open(path).ok()?.take(8192).read_to_end(&mut start).ok()?;
    model::of_content(&start)
}

fn counts(kinds: impl Iterator<Item = &'static str>) -> Vec<(&'static str, usize)> {
    let mut counts = BTreeMap::new();
    kinds.for_each(|kind| *counts.entry(kind).or_insert(0) += 1);
    counts.into_iter().collect()
}

/// Of all shapes that end somewhere.
fn bounds(scene: &Scene) -> Option<Aabb> {
    let all = scene.entities_of(Role::Shape).filter_map(|id| scene.world_bounds(id));
    let all = all.filter(|bounds| bounds.min.is_finite() && bounds.max.is_finite());
    all.reduce(Aabb::union)
}

/// Names, kinds and textures.
fn materials(scene: &Scene) -> Vec<(String, &'static str, Vec<String>)> {
    let all = scene.materials().map(|(id, name, material)| {
        let finish = catoptra_core::Part::values(&scene.finish(id));
        let values = material.values();
        let used = values.textures().chain(finish.textures());
        let textures = used.filter_map(|id| scene.texture_name(id)).map(str::to_owned).collect();
        (name.to_owned(), material.kind_name(), textures)
    });
    all.collect()
}
