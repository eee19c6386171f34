//! How does a model file become part of a scene, and is the scene still as the file and the text say?

use std::collections::{HashMap, HashSet};
use std::sync::Arc;

use catoptra_core::scene::{Content, Edit, EntityId, MaterialId, Node, Scene, TextureId};
use catoptra_core::{
    Finish, Image, ImageSource, InvalidPart, MeshSource, Placement, Shape, Texture, TextureUse, TriangleMesh,
    Value, Values,
};

use crate::build::Id;
use crate::model::Model;
use crate::state::State;
use crate::words;

/// A model and the path that the text names it by.
#[derive(Debug, Clone)]
pub(crate) struct ModelSource {
    pub(crate) path: String,
    pub(crate) model: Arc<Model>,
}

/// What the text says of one part.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Override {
    /// In place of its own, relative to the group that it lies in.
    pub(crate) placement: Option<Placement>,
    pub(crate) material: Option<MaterialId>,
    pub(crate) removed: bool,
}

/// What the text says of parts, by their names in the file.
pub(crate) type Overrides = HashMap<String, Override>;

/// What a model has become in a scene.
#[derive(Debug, Clone)]
pub(crate) struct Instance {
    name: String,
    root: Option<EntityId>,
    /// By their place in the model.
    materials: Vec<MaterialId>,
    textures: Vec<TextureId>,
    /// What no node of the text stands for.
    own: Vec<Id>,
    /// What those are by the file and the text, with the members of groups.
    before: Vec<(Id, State, Vec<EntityId>)>,
}

/// The name in the scene of something in a model.
pub(crate) fn full_name(model: &str, name: &str) -> String {
    format!("{model}/{name}")
}

/// All that lies in a model, groups before their members.
fn walk(model: &Model) -> impl Iterator<Item = &Node> {
    let mut rest: Vec<&Node> = model.nodes.iter().rev().collect();
    std::iter::from_fn(move || {
        let node = rest.pop()?;
        rest.extend(node.members().iter().rev());
        Some(node)
    })
}

/// Names of all that lies in a model.
pub(crate) fn names(model: &Model) -> Vec<&str> {
    walk(model).map(|node| node.name.as_str()).collect()
}

/// The node of that name.
pub(crate) fn find<'m>(model: &'m Model, name: &str) -> Option<&'m Node> {
    walk(model).find(|node| node.name == name)
}

/// The triangles of a shape, if it is made of them.
fn mesh_of(node: &Node) -> Option<&Arc<TriangleMesh>> {
    match &node.content {
        Content::Shape(Shape::Mesh(mesh), _) => Some(&mesh.source().mesh),
        _ => None,
    }
}

/// The triangles of the shape of that name.
pub(crate) fn mesh_named(model: &Model, name: &str) -> Result<Arc<TriangleMesh>, String> {
    let mut meshes = walk(model).filter_map(|node| Some((node.name.as_str(), mesh_of(node)?)));
    match meshes.find(|(known, _)| *known == name) {
        Some((_, mesh)) => Ok(Arc::clone(mesh)),
        None => {
            let known: Vec<&str> =
                walk(model).filter(|n| mesh_of(n).is_some()).map(|n| n.name.as_str()).collect();
            Err(format!("holds no mesh \"{name}\": {}", words::hint(name, &known, "meshes")))
        }
    }
}

/// The picture of the texture of that name.
pub(crate) fn image_named(model: &Model, name: &str) -> Result<Arc<Image>, String> {
    let found = model.textures.iter().find(|(known, _)| known == name).and_then(|(_, texture)| {
        texture.values().iter().find_map(|(_, value)| match value {
            Value::Image(source) => Some(Arc::clone(&source.image)),
            _ => None,
        })
    });
    found.ok_or_else(|| {
        let known: Vec<&str> = model.textures.iter().map(|(name, _)| name.as_str()).collect();
        format!("holds no picture \"{name}\": {}", words::hint(name, &known, "pictures"))
    })
}

impl Instance {
    /// Adds textures and materials of a model; where one of that name is there, it takes the place of the model's.
    ///
    /// # Errors
    /// What the scene refuses, for people.
    pub(crate) fn add_looks(scene: &mut Scene, name: &str, source: &ModelSource) -> Result<Self, String> {
        let mut instance = Self {
            name: name.to_owned(),
            root: None,
            materials: Vec::new(),
            textures: Vec::new(),
            own: Vec::new(),
            before: Vec::new(),
        };
        for (texture_name, texture) in &source.model.textures {
            instance.add_texture(scene, source, texture_name, texture)?;
        }
        for i in 0..source.model.materials.len() {
            instance.add_material(scene, source, i)?;
        }
        Ok(instance)
    }

    fn add_texture(
        &mut self,
        scene: &mut Scene,
        source: &ModelSource,
        own: &str,
        texture: &Texture,
    ) -> Result<(), String> {
        let name = full_name(&self.name, own);
        if let Some(id) = scene.texture_named(&name) {
            self.textures.push(id);
            return Ok(());
        }
        let path = format!("{}#{own}", source.path);
        let values = texture.values();
        let values = values.iter().fold(Values::new(), |all, (field, value)| {
            let value = match value {
                Value::Image(image) => {
                    Value::Image(ImageSource { path: path.clone(), image: Arc::clone(&image.image) })
                }
                other => other.clone(),
            };
            all.with(field, value)
        });
        let texture = (texture.kind().make)(&values).map_err(|e| e.to_string())?;
        let id = scene.add_texture(&name, texture).map_err(|e| e.to_string())?;
        self.textures.push(id);
        self.own.push(Id::Texture(id));
        Ok(())
    }

    fn add_material(&mut self, scene: &mut Scene, source: &ModelSource, i: usize) -> Result<(), String> {
        let given = &source.model.materials[i];
        let name = full_name(&self.name, &given.name);
        if let Some(id) = scene.material_named(&name) {
            self.materials.push(id);
            return Ok(());
        }
        let material = (given.material.kind().make)(&self.mapped(&given.material.values()))
            .map_err(|e| e.to_string())?;
        let id = scene.add_material(&name, material).map_err(|e| e.to_string())?;
        if !given.finish.is_plain() {
            let finish = (Finish::KIND.make)(&self.mapped(&catoptra_core::Part::values(&given.finish)))
                .map_err(|e| e.to_string())?;
            scene.apply(Edit::Finish(id, finish)).map_err(|e| e.to_string())?;
        }
        self.materials.push(id);
        self.own.push(Id::Material(id));
        Ok(())
    }

    /// Values of the model with the textures of the scene.
    fn mapped(&self, values: &Values) -> Values {
        let texture = |id: TextureId| self.textures.get(id.index() as usize - 1).copied().unwrap_or(id);
        values.iter().fold(Values::new(), |all, (field, value)| {
            let value = match value {
                Value::Texture(id) => Value::Texture(texture(*id)),
                Value::Textured(textured) => {
                    let by = TextureUse { texture: texture(textured.by.texture), ..textured.by };
                    textured.base.clone().textured(by)
                }
                other => other.clone(),
            };
            all.with(field, value)
        })
    }

    /// The name of the model's node.
    pub(crate) fn name(&self) -> &str {
        &self.name
    }

    /// The group that it is in the scene.
    pub(crate) fn root(&self) -> Option<EntityId> {
        self.root
    }

    /// What it holds, to be inserted into the scene.
    ///
    /// # Errors
    /// A shape that the core refuses.
    pub(crate) fn members(&self, source: &ModelSource, parts: &Overrides) -> Result<Vec<Node>, InvalidPart> {
        let mut first = HashMap::new();
        for node in walk(&source.model) {
            if let Some(mesh) = mesh_of(node) {
                first.entry(Arc::as_ptr(mesh)).or_insert(node.name.as_str());
            }
        }
        let making = Making { instance: self, source, parts, first };
        making.nodes(&source.model.nodes)
    }

    /// Finds the entities that came of it.
    pub(crate) fn settle(&mut self, scene: &Scene, root: EntityId) {
        self.root = Some(root);
        let mut groups = vec![root];
        while let Some(group) = groups.pop() {
            for member in scene.children(Some(group)) {
                self.own.push(Id::Entity(member));
                groups.push(member);
            }
        }
    }

    /// Notes what the scene holds of it, once the scene is whole.
    pub(crate) fn note(&mut self, scene: &Scene) {
        let state = |&id: &Id| Some((id, State::of(scene, id)?, members(scene, id)));
        self.before = self.own.iter().filter_map(state).collect();
    }

    /// Whether the text's node still says what the scene holds, but for materials and textures that nodes of their own can
    /// stand for.
    pub(crate) fn is_intact(&self, scene: &Scene) -> bool {
        let Some(root) = self.root.filter(|root| scene.name(*root).as_ref() == Some(&self.name)) else {
            return false;
        };
        let own: HashSet<&Id> = self.own.iter().collect();
        let is_own = |id: &EntityId| own.contains(&Id::Entity(*id));
        let lies_in_root = |id: &EntityId| is_own(id) && scene.parent(*id) == Some(root);
        let now: Vec<EntityId> = scene.children(Some(root)).into_iter().filter(is_own).collect();
        let mut sorted_before: Vec<EntityId> = self.order();
        sorted_before.retain(lies_in_root);
        now == sorted_before
            && self.before.iter().all(|(id, before, group)| match (id, State::of(scene, *id)) {
                (_, None) => false,
                (Id::Entity(_), Some(now)) => now == *before && members(scene, *id) == *group,
                (_, Some(now)) => now.name == before.name,
            })
    }

    /// The entities in the order of the file.
    fn order(&self) -> Vec<EntityId> {
        let entity = |id: &Id| if let Id::Entity(id) = id { Some(*id) } else { None };
        self.own.iter().filter_map(entity).collect()
    }

    /// Names of its materials.
    pub(crate) fn material_names<'a>(&'a self, source: &'a ModelSource) -> impl Iterator<Item = String> + 'a {
        source.model.materials.iter().map(|material| full_name(&self.name, &material.name))
    }
}

fn members(scene: &Scene, id: Id) -> Vec<EntityId> {
    match id {
        Id::Entity(id) => scene.children(Some(id)),
        _ => Vec::new(),
    }
}

/// What nodes of the text need not stand for, because models bring it with them: all that is as it was, and no texture that
/// another material is painted with.
pub(crate) fn hidden(models: &[Instance], scene: &Scene) -> HashSet<Id> {
    let same = |(id, before, _): &&(Id, State, _)| State::of(scene, *id).as_ref() == Some(before);
    let all = models.iter().flat_map(|model| &model.before);
    let mut hidden: HashSet<Id> = all.filter(same).map(|(id, ..)| *id).collect();
    let is_ours = |id: &Id| match id {
        Id::Texture(id) => scene.painted_with(*id).iter().all(|by| hidden.contains(&Id::Material(*by))),
        _ => true,
    };
    let shown: Vec<Id> = hidden.iter().filter(|id| !is_ours(id)).copied().collect();
    shown.iter().for_each(|id| {
        hidden.remove(id);
    });
    hidden
}

/// What is needed to make the nodes of a model those of a scene.
struct Making<'a> {
    instance: &'a Instance,
    source: &'a ModelSource,
    parts: &'a Overrides,
    /// The name of the first shape of every mesh: its others share the path.
    first: HashMap<*const TriangleMesh, &'a str>,
}

impl Making<'_> {
    fn nodes(&self, nodes: &[Node]) -> Result<Vec<Node>, InvalidPart> {
        let kept = |node: &&Node| !self.parts.get(&node.name).is_some_and(|part| part.removed);
        nodes.iter().filter(kept).map(|node| self.node(node)).collect()
    }

    fn node(&self, node: &Node) -> Result<Node, InvalidPart> {
        let part = self.parts.get(&node.name);
        let content = match &node.content {
            Content::Shape(shape, worn) => {
                let own = self.instance.materials.get(worn.index() as usize - 1).copied().unwrap_or(*worn);
                Content::Shape(self.shape(node, shape)?, part.and_then(|p| p.material).unwrap_or(own))
            }
            Content::Group(members) => Content::Group(self.nodes(members)?),
            Content::Solid(operation, members) => Content::Solid(*operation, self.nodes(members)?),
            other => other.clone(),
        };
        let placement = part.and_then(|part| part.placement).unwrap_or(node.placement);
        Ok(Node::new(full_name(&self.instance.name, &node.name), content).placed(placement))
    }

    /// The shape with the path by which scene text names its mesh.
    fn shape(&self, node: &Node, shape: &Shape) -> Result<Shape, InvalidPart> {
        let Some(mesh) = mesh_of(node) else { return Ok(shape.clone()) };
        let name = self.first.get(&Arc::as_ptr(mesh)).copied().unwrap_or(&node.name);
        let path = format!("{}#{name}", self.source.path);
        shape.with("file", Value::Mesh(MeshSource { path, mesh: Arc::clone(mesh) }))
    }
}
