//! With which values does a new part begin? One metre large, standing on the origin: scene text that the lists of kinds are
//! looked up in.

use catoptra_core::{Light, Material, Operation, Shape};

/// What the block of a new part holds. A kind that begins well with no values at all needs no line.
const STARTERS: &[(&str, &str)] = &[
    ("sphere", "radius 0.5"),
    ("box", "min -0.5 0 -0.5; max 0.5 1 0.5"),
    ("cylinder", "from 0 0 0; to 0 1 0; radius 0.4"),
    ("cone", "from 0 0 0; to 0 1 0; radius 0.5"),
    ("capsule", "from 0 0.3 0; to 0 0.7 0; radius 0.3"),
    ("torus", "axis 0 1 0; major 0.4; minor 0.12"),
    ("disk", "normal 0 1 0; radius 0.5"),
    ("rectangle", "corner -0.5 0 0.5; edge-u 1 0 0; edge-v 0 0 -1"),
    ("triangle", "a -0.5 0 0; b 0.5 0 0; c 0 0.9 0"),
    ("tetrahedron", "a -0.5 0 0.3; b 0.5 0 0.3; c 0 0 -0.6; d 0 0.8 0"),
    ("polyhedron", "point -0.5 0 -0.5; point 0.5 0 -0.5; point 0.5 0 0.5; point -0.5 0 0.5; point 0 0.8 0"),
    ("platonic", "solid \"icosahedron\"; radius 0.5"),
    (
        "prism",
        "point -0.5 -0.3; point 0.5 -0.3; point 0.5 0; point 0 0; point 0 0.3; point -0.5 0.3; \
        height 0.6",
    ),
    ("point-light", "position 0 0 0; intensity 1"),
    ("spot-light", "position 0 0 0; direction 0 -1 0; intensity 3; inner 25; outer 35"),
    ("directional-light", "direction -1 -2 -1; irradiance 1"),
    ("ambient-light", "radiance 0.2"),
    ("environment-light", "radiance 0.3"),
    ("rectangle-light", "corner -0.5 0 -0.5; edge-u 1 0 0; edge-v 0 0 1; radiance 5"),
    ("disk-light", "center 0 0 0; normal 0 -1 0; radius 0.5; radiance 5"),
    ("sphere-light", "center 0 0 0; radius 0.25; radiance 5"),
    ("matte", "color 0.6"),
    ("phong", "diffuse 0.6; specular 0.4; shininess 40"),
    ("depth", "color 1; range 20"),
    ("metal", "preset \"gold\""),
    ("plastic", "color 0.7 0.1 0.1"),
    ("rubber", "color 0.15"),
    ("emissive", "radiance 3"),
];

fn starter(kind: &str) -> &'static str {
    STARTERS.iter().find(|(name, _)| *name == kind).map_or("", |(_, text)| text)
}

/// A new shape of that kind; `None` where it needs a file.
pub(crate) fn shape(kind: &str) -> Option<Shape> {
    let text = format!("matte \"m\" {{ color 1 }}\n{kind} \"it\" material=\"m\" {{ {} }}", starter(kind));
    let (scene, _) = catoptra_scene::parse(&text, kind, None).ok()?;
    scene.shape(scene.entity_named("it")?)
}

/// A new light of that kind; `None` where it needs a file.
pub(crate) fn light(kind: &str) -> Option<Light> {
    let text = format!("{kind} \"it\" {{ {} }}", starter(kind));
    let (scene, _) = catoptra_scene::parse(&text, kind, None).ok()?;
    scene.light(scene.entity_named("it")?)
}

/// A new material of that kind; `None` where it needs more than there is.
pub(crate) fn material(kind: &str) -> Option<Material> {
    let text = format!("{kind} \"it\" {{ {} }}", starter(kind));
    let (scene, _) = catoptra_scene::parse(&text, kind, None).ok()?;
    scene.material_named("it").map(|id| scene.material(id).clone())
}

/// Something that can be added.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Addable {
    Shape(&'static str),
    Light(&'static str),
    Material(&'static str),
    Camera,
    Group,
    Solid(Operation),
    Model,
}

impl Addable {
    /// All that can be added, by section, as the lists of the core have it. Shapes that need a file come with models.
    pub(crate) fn sections() -> Vec<(&'static str, Vec<Self>)> {
        let shapes = Shape::KINDS.iter().filter(|kind| shape(kind.name).is_some());
        let lights = Light::KINDS.iter().filter(|kind| light(kind.name).is_some());
        let materials = Material::KINDS.iter().filter(|kind| material(kind.name).is_some());
        let mut others = vec![Self::Camera, Self::Group];
        others.extend(Operation::ALL.map(Self::Solid));
        others.push(Self::Model);
        vec![
            ("Shapes", shapes.map(|kind| Self::Shape(kind.name)).collect()),
            ("Lights", lights.map(|kind| Self::Light(kind.name)).collect()),
            ("Materials", materials.map(|kind| Self::Material(kind.name)).collect()),
            ("Others", others),
        ]
    }

    /// What it is called.
    pub(crate) fn name(self) -> &'static str {
        match self {
            Self::Shape(kind) | Self::Light(kind) | Self::Material(kind) => kind,
            Self::Camera => "camera",
            Self::Group => "group",
            Self::Solid(operation) => operation.word(),
            Self::Model => "model file…",
        }
    }

    /// What it is, in a sentence.
    pub(crate) fn doc(self) -> &'static str {
        let told = match self {
            Self::Shape(kind) => Shape::kind_named(kind).map(|kind| kind.doc),
            Self::Light(kind) => Light::kind_named(kind).map(|kind| kind.doc),
            Self::Material(kind) => Material::kind_named(kind).map(|kind| kind.doc),
            Self::Camera => Some("Looks from where you look now."),
            Self::Group => Some("Things that move together: what is selected, if anything is."),
            Self::Solid(_) => Some("One solid of those that are selected."),
            Self::Model => Some("What a PLY, OBJ, STL, glTF or GLB file holds."),
        };
        told.unwrap_or_default()
    }
}

#[cfg(test)]
mod tests {
    use catoptra_core::FieldKind;

    use super::*;

    #[test]
    fn every_kind_that_needs_no_file_can_be_added() {
        let needs_file = |fields: &[catoptra_core::Field]| {
            fields.iter().any(|f| !f.may_be_missing && matches!(f.kind, FieldKind::Mesh | FieldKind::Image))
        };
        for kind in Shape::KINDS {
            assert_eq!(shape(kind.name).is_none(), needs_file(kind.fields), "{}", kind.name);
        }
        for kind in Light::KINDS {
            assert!(light(kind.name).is_some(), "{}", kind.name);
        }
        for kind in Material::KINDS {
            assert!(material(kind.name).is_some(), "{}", kind.name);
        }
    }

    #[test]
    fn new_shapes_are_about_a_metre_large_and_near_the_origin() {
        for kind in Shape::KINDS {
            let Some(bounds) = shape(kind.name).and_then(|shape| shape.bounds()) else { continue };
            let size = bounds.size().max_element();
            assert!((0.5..=1.6).contains(&size), "{}: {size}", kind.name);
            assert!(bounds.centre().length() < 0.8, "{}: {bounds:?}", kind.name);
        }
    }
}
