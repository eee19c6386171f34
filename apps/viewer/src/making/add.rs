//! How do new things come into the scene? One of the list, where the picture shows a place for it.

use catoptra_core::scene::{Edit, EntityId, Node, Subtree};
use catoptra_core::{Light, Placement, Value};

use super::starters::{self, Addable};
use super::{grouping, place, sizing};
use crate::browse::Purpose;
use crate::viewer::Viewer;

/// What is being chosen to be added.
#[derive(Debug, Clone, Default)]
pub(crate) struct Adding {
    /// The point of the picture where it is to go, in pixels; the middle without one.
    pub(crate) at: Option<(f64, f64)>,
    /// What has been typed to find it.
    pub(crate) typed: String,
}

/// Adds something at a point of the picture, as one step to undo.
pub(crate) fn add(viewer: &mut Viewer, what: Addable, at: Option<(f64, f64)>) {
    viewer.finish_name();
    match what {
        Addable::Shape(kind) => add_shape(viewer, kind, at),
        Addable::Light(kind) => add_light(viewer, kind, at),
        Addable::Material(kind) => add_material(viewer, kind),
        Addable::Camera => {
            let camera = viewer.camera.clone();
            let name = viewer.document.scene().free_name("camera");
            insert(viewer, vec![], Node::camera(name, camera));
        }
        Addable::Group => grouping::group(viewer, None),
        Addable::Solid(operation) => grouping::group(viewer, Some(operation)),
        Addable::Model => {
            let folder = viewer.document.folder();
            viewer.browse(Purpose::Model, &folder, String::new());
        }
    }
}

fn add_shape(viewer: &mut Viewer, kind: &'static str, at: Option<(f64, f64)>) {
    let Some(shape) = starters::shape(kind) else { return };
    let spot = place::spot(viewer, at);
    let fields = shape.kind().fields;
    let sized = (shape.kind().make)(&sizing::scaled(fields, &shape.values(), spot.size)).unwrap_or(shape);
    let placement = sized.bounds().map_or(Placement::IDENTITY, |bounds| spot.stand(&bounds));
    let scene = viewer.document.scene();
    let material = scene.next_material_id();
    let name = scene.free_name(kind);
    let add = starters::material("matte").map(|matte| Edit::AddMaterial {
        name: scene.free_material_name(&name),
        material: matte,
        id: Some(material),
    });
    insert(viewer, add.into_iter().collect(), Node::shape(name, sized, material).placed(placement));
}

fn add_light(viewer: &mut Viewer, kind: &'static str, at: Option<(f64, f64)>) {
    let Some(light) = starters::light(kind) else { return };
    let spot = place::spot(viewer, at);
    let has_place = light.position().is_some() || light.lamp().is_some();
    let (light, placement) = if has_place {
        let fields = light.kind().fields;
        let sized = (light.kind().make)(&sizing::scaled(fields, &light.values(), spot.size)).unwrap_or(light);
        (bright(&sized, kind, spot.size), spot.hang())
    } else {
        (light, Placement::IDENTITY)
    };
    let name = viewer.document.scene().free_name(kind);
    insert(viewer, vec![], Node::light(name, light).placed(placement));
}

/// The field of lights that shine from one point, whose brightness falls with the square of the distance.
const INTENSITY: &str = "intensity";

/// How bright a new light is, as an irradiance right below it.
const BRIGHTNESS: f64 = 6.0;

/// As bright below it whatever the size of the scene.
fn bright(light: &Light, kind: &str, size: f64) -> Light {
    let Some(Value::Color(own)) = starters::light(kind).and_then(|l| l.values().get(INTENSITY).cloned())
    else {
        return light.clone();
    };
    light.with(INTENSITY, Value::Color(own * (BRIGHTNESS * size * size))).unwrap_or_else(|_| light.clone())
}

/// Adds a material, and gives it to what is selected.
fn add_material(viewer: &mut Viewer, kind: &'static str) {
    let Some(material) = starters::material(kind) else { return };
    let scene = viewer.document.scene();
    let (id, name) = (scene.next_material_id(), scene.free_material_name(kind));
    let shapes: Vec<EntityId> =
        viewer.selection.ids().iter().copied().filter(|id| scene.material_of(*id).is_some()).collect();
    let mut edits = vec![Edit::AddMaterial { name: name.clone(), material, id: Some(id) }];
    edits.extend(shapes.iter().map(|shape| Edit::MaterialOf(*shape, id)));
    if viewer.edit(Edit::Batch(edits)) && shapes.is_empty() {
        viewer.notify(format!("“{name}” is there for any shape to wear"));
    }
}

/// Inserts a node at the top of the scene, after other edits of the same step, and selects it.
fn insert(viewer: &mut Viewer, mut edits: Vec<Edit>, node: Node) {
    let id = viewer.document.scene().next_entity_id();
    let name = node.name.clone();
    edits.push(Edit::Insert(Box::new(Subtree::new(node.with_id(id)))));
    if viewer.edit(Edit::Batch(edits)) {
        viewer.select(Some(id));
        viewer.notify(format!("added “{name}”"));
    }
}
