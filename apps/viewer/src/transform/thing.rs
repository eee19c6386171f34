//! What becomes of one thing that is moved, turned or scaled? Lights, cameras and simple shapes that move change their own
//! fields, as one would write them; all else its placement.

use catoptra_core::scene::{Edit, EntityId, Role, Scene};
use catoptra_core::{Camera, FieldKind, InvalidPart, Light, Placement, Shape, Value, Values};
use catoptra_raster::{Manipulator, Motion};

use super::tidy;

/// A thing as it was.
pub(super) struct Thing {
    id: EntityId,
    before: Before,
    placement: Placement,
    /// From its group's space to the world.
    group: Placement,
}

enum Before {
    Light(Light),
    Camera(Camera),
    Shape(Shape),
    Group,
}

impl Thing {
    /// As it is now.
    pub(super) fn of(scene: &Scene, id: EntityId) -> Option<Self> {
        let before = match scene.role(id)? {
            Role::Light => Before::Light(scene.light(id)?),
            Role::Camera => Before::Camera(scene.camera(id)?),
            Role::Shape => Before::Shape(scene.shape(id)?),
            Role::Group => Before::Group,
        };
        let group = scene.parent(id).and_then(|group| scene.world_placement(group)).unwrap_or_default();
        Some(Self { id, before, placement: scene.placement(id)?, group })
    }

    pub(super) fn id(&self) -> EntityId {
        self.id
    }

    /// The edit that does a motion to it as it was, with numbers rounded to what a pixel of so many metres can tell.
    ///
    /// # Errors
    /// What the thing refuses.
    pub(super) fn edit(
        &self,
        scene: &Scene,
        manipulator: &Manipulator,
        motion: Motion,
        pixel: f64,
    ) -> Result<Edit, InvalidPart> {
        let world = self.placement.then(&self.group);
        let own = motion.within(manipulator, &world)?;
        let step = tidy::step_within(pixel, &world);
        match &self.before {
            Before::Light(light) => Ok(Edit::Light(self.id, tidy::light(light, &light.placed(&own), step)?)),
            Before::Camera(camera) => {
                Ok(Edit::Camera(self.id, tidy::camera(camera, &camera.placed(&own)?, step)?))
            }
            Before::Shape(shape) if scene.operation(self.id).is_none() => {
                match moved_by_fields(shape, motion, &own) {
                    Some(after) => {
                        let kind = shape.kind();
                        let values = tidy::rounded(kind.fields, &shape.values(), &after, step);
                        Ok(Edit::Shape(self.id, (kind.make)(&values)?))
                    }
                    None => self.placed(manipulator, motion, pixel),
                }
            }
            Before::Shape(_) | Before::Group => self.placed(manipulator, motion, pixel),
        }
    }

    fn placed(&self, manipulator: &Manipulator, motion: Motion, pixel: f64) -> Result<Edit, InvalidPart> {
        let after = self.placement.then(&motion.within(manipulator, &self.group)?);
        let step = tidy::step_within(pixel, &self.group);
        Ok(Edit::Placement(self.id, tidy::placement(&self.placement, &after, step)?))
    }
}

/// The values of a shape that is moved, where its points alone tell where it is.
fn moved_by_fields(shape: &Shape, motion: Motion, own: &Placement) -> Option<Values> {
    let Motion::Move(_) = motion else { return None };
    let tells_more = |kind: FieldKind| {
        matches!(kind, FieldKind::Rows(_) | FieldKind::Mesh | FieldKind::Image | FieldKind::Pair)
    };
    let fields = shape.kind().fields;
    if fields.iter().any(|field| tells_more(field.kind)) {
        return None;
    }
    let points = fields.iter().filter(|field| field.kind == FieldKind::Point);
    let mut values = shape.values();
    let mut moves = false;
    for field in points {
        if let Some(Value::Vector(at)) = values.get(field.name) {
            let to = *at + own.translation();
            values.set(field.name, Value::Vector(to));
            moves = true;
        }
    }
    moves.then_some(values)
}

#[cfg(test)]
mod tests {
    use super::*;
    use catoptra_core::glam::DVec3;

    #[test]
    fn shapes_that_are_moved_by_their_points_go_where_they_would_be_placed() {
        let by = DVec3::new(0.5, -0.25, 2.0);
        let own = Placement::IDENTITY.moved(by).unwrap();
        let text = "sphere { center 1 2 3; radius 1 }\nbox { min 0 0 0; max 1 2 3 }\n\
            cylinder { from 0 0 0; to 0 1 0; radius 0.2 }\ntriangle { a 0 0 0; b 1 0 0; c 0 1 0 }\n\
            rectangle { corner 0 0 0; edge-u 1 0 0; edge-v 0 1 0 }\nplatonic { solid \"cube\"; radius 1 }\n\
            torus { major 1; minor 0.2 }\ndisk { center 0 1 0; radius 1 }\n";
        let mut moved = 0;
        for line in text.lines() {
            let (kind, fields) = line.split_once(' ').unwrap();
            let text = format!("matte \"m\" {{ color 1 }}\n{kind} \"it\" material=\"m\" {fields}\n");
            let (scene, _) = catoptra_scene::parse(&text, "text", None).unwrap_or_else(|e| panic!("{e:?}"));
            let shape = scene.shape(scene.entity_named("it").unwrap()).unwrap();
            let after = moved_by_fields(&shape, Motion::Move(by), &own).unwrap();
            let after: Shape = (shape.kind().make)(&after).unwrap();
            let (is, wanted) = (after.bounds().unwrap(), shape.placed(&own).bounds().unwrap());
            assert!((is.min - wanted.min).length() + (is.max - wanted.max).length() < 1e-12, "{line}");
            moved += 1;
        }
        assert_eq!(moved, 8);
    }
}
