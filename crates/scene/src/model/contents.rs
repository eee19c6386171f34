//! What does a model file hold, whatever its format?

use std::path::PathBuf;
use std::sync::Arc;

use catoptra_core::geometry::Mesh;
use catoptra_core::material::Matte;
use catoptra_core::scene::{Content, Node};
use catoptra_core::{
    Aabb, Finish, InvalidPart, Material, MaterialId, MeshSource, Placement, Rgb, Texture, TriangleMesh,
};

use super::Place;

/// The contents of a model file as parts of a scene, in metres, right-handed, y up.
///
/// Ids are those that an empty scene would give out: the texture `TextureId` *n* and the material `MaterialId` *n* are the
/// *n*-th of their list, counted from 1. Names are those of the file, made unique; where the file has none, the kind and a
/// number stand for one.
#[derive(Debug, Clone, Default)]
pub struct Model {
    /// Pictures, by name.
    pub textures: Vec<(String, Texture)>,
    /// Materials with their finish; never empty where there is a shape.
    pub materials: Vec<ModelMaterial>,
    /// Shapes, lights, cameras and groups, as the file nests them.
    pub nodes: Vec<Node>,
    /// What of the file is not shown as the file means it, each kind of thing once.
    pub warnings: Vec<Warning>,
    /// Where the other files lie that it names: materials, pictures, buffers.
    pub files: Vec<PathBuf>,
}

/// A material of a model file.
#[derive(Debug, Clone, PartialEq)]
pub struct ModelMaterial {
    /// Unique within the file.
    pub name: String,
    /// What it is made of.
    pub material: Material,
    /// Opacity, sides, bumps.
    pub finish: Finish,
}

/// Something in a file that is passed over.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Warning {
    /// Where it stands first.
    pub place: Place,
    /// What it is, and what is done instead.
    pub message: String,
}

impl Model {
    /// One mesh, of a grey material.
    ///
    /// # Errors
    /// None but what a constant could have.
    pub fn of_mesh(mesh: TriangleMesh) -> Result<Self, InvalidPart> {
        let mut model = Self::default();
        let grey = model.add_material(ModelMaterial::grey()?);
        let source = MeshSource { path: String::new(), mesh: Arc::new(mesh) };
        model.nodes.push(Node::shape("mesh", Mesh::new(source), grey));
        Ok(model)
    }

    /// The box round all of its shapes that end somewhere; nothing where there are none.
    #[must_use]
    pub fn bounds(&self) -> Option<Aabb> {
        fn add(node: &Node, outer: &Placement, all: &mut Option<Aabb>) {
            let placement = node.placement.then(outer);
            if let Content::Shape(shape, _) = &node.content
                && let Some(bounds) = shape.placed(&placement).bounds()
            {
                *all = Some(all.map_or(bounds, |all| all.union(bounds)));
            }
            node.members().iter().for_each(|member| add(member, &placement, all));
        }
        let mut all = None;
        self.nodes.iter().for_each(|node| add(node, &Placement::IDENTITY, &mut all));
        all
    }

    /// Adds a material under its id.
    ///
    /// # Panics
    /// More than 2³² materials.
    pub fn add_material(&mut self, material: ModelMaterial) -> MaterialId {
        self.materials.push(material);
        let number = u32::try_from(self.materials.len()).ok();
        number.and_then(MaterialId::from_index).expect("no file has room for so many materials")
    }
}

impl ModelMaterial {
    /// What shapes wear that have no material: a `matte` of four fifths.
    ///
    /// # Errors
    /// None but what a constant could have.
    pub fn grey() -> Result<Self, InvalidPart> {
        let material = Matte::new(Rgb::grey(0.8))?.into();
        Ok(Self { name: "grey".to_owned(), material, finish: Finish::default() })
    }
}
