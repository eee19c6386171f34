//! How do parts of a scene travel as scene text, from window to window and into editors? With the textures and materials
//! that they need, and with paths that lead to their files from wherever they arrive.

use std::collections::{HashMap, HashSet};
use std::path::{MAIN_SEPARATOR_STR, Path};

use catoptra_core::scene::{
    Content, Edit, EntityId, MaterialId, Node, Scene, SceneError, Subtree, TextureId,
};
use catoptra_core::{
    Finish, ImageSource, InvalidPart, MeshSource, Part, ProfileSource, Texture, Value, Values,
};

use crate::SceneFile;
use crate::file::parse;
use crate::instance::repainted;
use crate::report::SceneTextError;

/// What a pasted text adds to a scene.
#[derive(Debug, Clone)]
pub struct Pasted {
    /// The edit that adds it.
    pub edit: Edit,
    /// What stands at the top of the text, in its order.
    pub ids: Vec<EntityId>,
}

/// A text that cannot be pasted.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum PasteError {
    /// It is no scene text.
    #[error("this is no scene text: {0}")]
    Text(#[from] SceneTextError),
    /// It holds nothing that could be added.
    #[error("there is nothing in this text that could be added")]
    Empty,
    /// The scene refuses what it holds.
    #[error(transparent)]
    Scene(#[from] SceneError),
    /// A part of it is refused.
    #[error(transparent)]
    Part(#[from] InvalidPart),
}

/// The text of these entities and of all that lies in them, at the top and where they stand in the world, with their
/// textures and materials. Paths in the scene start from `folder`; in the text they are whole.
///
/// # Errors
/// What a scene refuses that holds nothing else.
pub fn text_of(scene: &Scene, ids: &[EntityId], folder: &Path) -> Result<String, PasteError> {
    let whole = |path: &str| whole(path, folder);
    let mut nodes = Vec::new();
    for &id in ids {
        let (Some(node), Some(at)) = (scene.node(id), scene.world_placement(id)) else { continue };
        nodes.push(with_paths(node.placed(at), &whole)?);
    }
    let mut worn = Vec::new();
    nodes.iter().for_each(|node| materials_of(node, &mut worn));
    let mut part = Scene::new();
    for (id, name, texture) in scene.textures() {
        if scene.painted_with(id).iter().any(|material| worn.contains(material)) {
            let texture = texture_with_paths(texture, &whole)?;
            part.apply(Edit::AddTexture { name: name.to_owned(), texture, id: Some(id) })?;
        }
    }
    for (id, name, material) in scene.materials().filter(|(id, ..)| worn.contains(id)) {
        let material = material.clone();
        part.apply(Edit::AddMaterial { name: name.to_owned(), material, id: Some(id) })?;
        part.apply(Edit::Finish(id, scene.finish(id)))?;
    }
    for node in nodes {
        part.apply(Edit::insert(Subtree::new(node)))?;
    }
    Ok(SceneFile::new(&part).text())
}

/// What it takes to add all that a text holds, but for settings, at the top of a scene. Textures and materials that the
/// scene has under the same names are shared; all else gets names that are free. Paths in the scene start from `folder`.
///
/// # Errors
/// A text that is no scene, holds nothing, or does not fit.
pub fn paste(scene: &Scene, text: &str, folder: &Path) -> Result<Pasted, PasteError> {
    let (part, _) = parse(text, "pasted text", Some(folder))?;
    // Tried on a copy: the edit has the ids that everything gets there.
    let mut pasting = Pasting { scene: scene.clone(), edits: Vec::new(), materials: HashMap::new() };
    let textures = pasting.add_textures(&part, folder)?;
    pasting.add_materials(&part, &textures)?;
    let (mut ids, mut taken) = (Vec::new(), HashSet::new());
    for root in part.children(None) {
        let Some(node) = part.node(root) else { continue };
        let mut node = with_paths(node, &|path| near(path, folder))?;
        node.each_mut(&mut |node| {
            if let Content::Shape(_, material) = &mut node.content {
                *material = pasting.materials.get(material).copied().unwrap_or(*material);
            }
        });
        let node = pasting.scene.fresh(node, &mut taken);
        let id = pasting.scene.next_entity_id();
        pasting.scene.apply(Edit::insert(Subtree::new(node)))?;
        pasting.edits.extend(pasting.scene.node(id).map(|node| Edit::insert(Subtree::new(node))));
        ids.push(id);
    }
    if pasting.edits.is_empty() {
        return Err(PasteError::Empty);
    }
    Ok(Pasted { edit: Edit::Batch(pasting.edits), ids })
}

/// A scene that a text is being added to.
struct Pasting {
    scene: Scene,
    edits: Vec<Edit>,
    /// What the materials of the text are in the scene.
    materials: HashMap<MaterialId, MaterialId>,
}

impl Pasting {
    fn apply(&mut self, edit: Edit) -> Result<(), SceneError> {
        self.edits.push(edit.clone());
        self.scene.apply(edit).map(|_| ())
    }

    fn add_textures(
        &mut self,
        part: &Scene,
        folder: &Path,
    ) -> Result<HashMap<TextureId, TextureId>, PasteError> {
        let mut known = HashMap::new();
        for (id, name, texture) in part.textures() {
            let texture = texture_with_paths(texture, &|path| near(path, folder))?;
            let same =
                self.scene.texture_named(name).filter(|id| self.scene.find_texture(*id) == Some(&texture));
            let new = same.unwrap_or_else(|| self.scene.next_texture_id());
            if same.is_none() {
                let name = self.scene.free_texture_name(name);
                self.apply(Edit::AddTexture { name, texture, id: Some(new) })?;
            }
            known.insert(id, new);
        }
        Ok(known)
    }

    fn add_materials(
        &mut self,
        part: &Scene,
        textures: &HashMap<TextureId, TextureId>,
    ) -> Result<(), PasteError> {
        let texture = |id: TextureId| textures.get(&id).copied().unwrap_or(id);
        for (id, name, material) in part.materials() {
            let material = (material.kind().make)(&repainted(&material.values(), texture))?;
            let finish = (Finish::KIND.make)(&repainted(&part.finish(id).values(), texture))?;
            let is_same =
                |id: &MaterialId| *self.scene.material(*id) == material && self.scene.finish(*id) == finish;
            let same = self.scene.material_named(name).filter(is_same);
            let new = same.unwrap_or_else(|| self.scene.next_material_id());
            if same.is_none() {
                let name = self.scene.free_material_name(name);
                self.apply(Edit::AddMaterial { name, material, id: Some(new) })?;
                self.apply(Edit::Finish(new, finish))?;
            }
            self.materials.insert(id, new);
        }
        Ok(())
    }
}

fn materials_of(node: &Node, worn: &mut Vec<MaterialId>) {
    if let Content::Shape(_, material) = node.content {
        worn.push(material);
    }
    node.members().iter().for_each(|member| materials_of(member, worn));
}

/// The node with other paths of files, in it and in all that lies in it.
fn with_paths(mut node: Node, path: &impl Fn(&str) -> String) -> Result<Node, InvalidPart> {
    let mut refused = None;
    node.each_mut(&mut |node| {
        let changed = match &node.content {
            Content::Shape(shape, material) => (shape.kind().make)(&values_with_paths(&shape.values(), path))
                .map(|shape| Content::Shape(shape, *material)),
            Content::Light(light) => {
                (light.kind().make)(&values_with_paths(&light.values(), path)).map(Content::Light)
            }
            _ => return,
        };
        match changed {
            Ok(content) => node.content = content,
            Err(error) => refused = Some(error),
        }
    });
    refused.map_or(Ok(node), Err)
}

fn texture_with_paths(texture: &Texture, path: &impl Fn(&str) -> String) -> Result<Texture, InvalidPart> {
    (texture.kind().make)(&values_with_paths(&texture.values(), path))
}

fn values_with_paths(values: &Values, path: &impl Fn(&str) -> String) -> Values {
    values.iter().fold(Values::new(), |all, (field, value)| {
        let value = match value.clone() {
            Value::Mesh(source) => Value::Mesh(MeshSource { path: path(&source.path), ..source }),
            Value::Image(source) => Value::Image(ImageSource { path: path(&source.path), ..source }),
            Value::Profile(source) => Value::Profile(ProfileSource { path: path(&source.path), ..source }),
            other => other,
        };
        all.with(field, value)
    })
}

/// A path that starts from a folder, as it leads there from anywhere.
fn whole(path: &str, folder: &Path) -> String {
    let whole = std::path::absolute(Path::new(".").join(folder).join(path)).ok();
    let spelled = whole.as_deref().and_then(Path::to_str).map(|whole| whole.replace(MAIN_SEPARATOR_STR, "/"));
    spelled.unwrap_or_else(|| path.to_owned())
}

/// A whole path as it is written in a scene of that folder: short where it leads into the folder.
fn near(path: &str, folder: &Path) -> String {
    let folder = std::path::absolute(Path::new(".").join(folder)).ok();
    let inside = folder.and_then(|folder| Path::new(path).strip_prefix(folder).ok().map(Path::to_owned));
    let spelled =
        inside.as_deref().and_then(Path::to_str).map(|inside| inside.replace(MAIN_SEPARATOR_STR, "/"));
    spelled.unwrap_or_else(|| path.to_owned())
}
