//! How are parts added one by one, with their new id in return?

use super::{Edit, EntityId, MaterialId, Node, Scene, SceneError, Subtree};
use crate::{Camera, Light, Material, Shape};

/// Adding parts: each is one [`Edit`].
impl Scene {
    /// Adds a material.
    ///
    /// # Errors
    /// A name that is empty or that another material has.
    pub fn add_material(
        &mut self,
        name: &str,
        material: impl Into<Material>,
    ) -> Result<MaterialId, SceneError> {
        let id = self.next_material_id();
        self.apply(Edit::AddMaterial { name: name.to_owned(), material: material.into(), id: None })?;
        Ok(id)
    }

    /// Adds a shape of `material`, as the last member of `parent` or at the top.
    ///
    /// # Errors
    /// A name that is empty or taken, a material or parent that is not there, a parent that is no group.
    pub fn add_shape(
        &mut self,
        name: &str,
        shape: impl Into<Shape>,
        material: MaterialId,
        parent: Option<EntityId>,
    ) -> Result<EntityId, SceneError> {
        self.add(Node::shape(name, shape, material), parent)
    }

    /// Adds a light as the last member of `parent` or at the top.
    ///
    /// # Errors
    /// A name that is empty or taken, a parent that is not there or is no group.
    pub fn add_light(
        &mut self,
        name: &str,
        light: impl Into<Light>,
        parent: Option<EntityId>,
    ) -> Result<EntityId, SceneError> {
        self.add(Node::light(name, light), parent)
    }

    /// Adds a camera as the last member of `parent` or at the top.
    ///
    /// # Errors
    /// A name that is empty or taken, a parent that is not there or is no group.
    pub fn add_camera(
        &mut self,
        name: &str,
        camera: Camera,
        parent: Option<EntityId>,
    ) -> Result<EntityId, SceneError> {
        self.add(Node::camera(name, camera), parent)
    }

    /// Adds an empty group as the last member of `parent` or at the top.
    ///
    /// # Errors
    /// A name that is empty or taken, a parent that is not there or is no group.
    pub fn add_group(&mut self, name: &str, parent: Option<EntityId>) -> Result<EntityId, SceneError> {
        self.add(Node::group(name, Vec::new()), parent)
    }

    fn add(&mut self, node: Node, parent: Option<EntityId>) -> Result<EntityId, SceneError> {
        let id = self.next_entity_id();
        self.apply(Edit::insert(Subtree { node, parent, index: None }))?;
        Ok(id)
    }
}
