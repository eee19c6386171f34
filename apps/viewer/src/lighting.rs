//! Which lights shine in the window? Mute and solo leave lights dark, a headlight stands in for those that a scene lacks: all
//! that is of the window, and the file does not know of it.

use std::collections::BTreeSet;
use std::f64::consts::PI;

use catoptra_core::light::{AmbientLight, DirectionalLight};
use catoptra_core::scene::{Edit, EntityId, MaterialId, Role, Scene, SceneError};
use catoptra_core::{Camera, Rgb, Value, Values};

/// What the headlight sends onto what faces it, W/m²: white surfaces are shown a little below white.
const HEADLIGHT: f64 = 0.9 * PI;

/// Which light falls on what is shown.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(crate) enum Illumination {
    /// That of the scene.
    #[default]
    Scene,
    /// That of the scene, of which each light is also looked at by itself.
    EachLight,
    /// The same from everywhere, and none else: surfaces show their own colours.
    Even,
}

/// Which lights are left dark.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub(crate) struct Lighting {
    muted: BTreeSet<EntityId>,
    solo: BTreeSet<EntityId>,
}

impl Lighting {
    /// Whether a light is left dark.
    pub(crate) fn is_dark(&self, id: EntityId) -> bool {
        self.muted.contains(&id) || !(self.solo.is_empty() || self.solo.contains(&id))
    }

    /// Whether a light is muted by name.
    pub(crate) fn is_muted(&self, id: EntityId) -> bool {
        self.muted.contains(&id)
    }

    /// Whether a light is one of those that shine alone.
    pub(crate) fn is_solo(&self, id: EntityId) -> bool {
        self.solo.contains(&id)
    }

    /// Whether any light is left dark, or may be.
    pub(crate) fn is_plain(&self) -> bool {
        self.muted.is_empty() && self.solo.is_empty()
    }

    /// Mutes lights; if all of them are muted, they shine again.
    pub(crate) fn toggle_mute(&mut self, lights: &[EntityId]) {
        toggle(&mut self.muted, lights);
    }

    /// Lets lights shine alone, beside others that do; if all of them do, they do so no more.
    pub(crate) fn toggle_solo(&mut self, lights: &[EntityId]) {
        toggle(&mut self.solo, lights);
    }

    /// All lights shine.
    pub(crate) fn clear(&mut self) {
        *self = Self::default();
    }

    /// Forgets lights that the scene has no more.
    pub(crate) fn keep_lights_of(&mut self, scene: &Scene) {
        self.muted.retain(|id| scene.contains(*id));
        self.solo.retain(|id| scene.contains(*id));
    }

    /// What is told of it; nothing where all lights shine.
    pub(crate) fn words(&self, scene: &Scene) -> Option<String> {
        let names = |ids: &BTreeSet<EntityId>| {
            ids.iter().filter_map(|id| scene.name(*id)).collect::<Vec<_>>().join(", ")
        };
        match (self.solo.is_empty(), self.muted.is_empty()) {
            (true, true) => None,
            (true, false) => Some(format!("Muted, in this window alone: {}.", names(&self.muted))),
            (false, true) => Some(format!("Only {} shines, in this window alone.", names(&self.solo))),
            (false, false) => Some(format!(
                "Only {} shines, and {} is muted, in this window alone.",
                names(&self.solo),
                names(&self.muted)
            )),
        }
    }

    /// The scene as it is to be traced; `None` where that is as it is.
    pub(crate) fn lit(&self, scene: &Scene, camera: &Camera, illumination: Illumination) -> Option<Scene> {
        let outcome = match illumination {
            Illumination::Even => evenly_lit(scene),
            Illumination::Scene | Illumination::EachLight if !has_lights(scene) => {
                with_headlight(scene, camera)
            }
            Illumination::Scene | Illumination::EachLight if self.is_plain() => return None,
            Illumination::Scene | Illumination::EachLight => darkened(scene, |id| self.is_dark(id)),
        };
        // A scene that refuses is shown as it is.
        outcome.ok()
    }
}

fn toggle(set: &mut BTreeSet<EntityId>, ids: &[EntityId]) {
    if ids.iter().all(|id| set.contains(id)) {
        set.retain(|id| !ids.contains(id));
    } else {
        set.extend(ids);
    }
}

/// Whether an entity is a light, or a shape that shines.
pub(crate) fn shines(scene: &Scene, id: EntityId) -> bool {
    scene.role(id) == Some(Role::Light) || emitter(scene, id).is_some()
}

/// The lights among entities and what lies in them.
pub(crate) fn lights_in(scene: &Scene, ids: &[EntityId]) -> Vec<EntityId> {
    let within = |id: &EntityId| ids.iter().any(|outer| scene.lies_in(*id, *outer));
    scene.entities().filter(within).filter(|id| shines(scene, *id)).collect()
}

/// Whether anything in the scene gives light. What asks for none counts as lit: the share of the sky that is seen.
pub(crate) fn has_lights(scene: &Scene) -> bool {
    scene.settings().integrator() == catoptra_core::Integrator::Occlusion
        || scene.entities().any(|id| shines(scene, id) && !scene.is_hidden(id))
}

/// The material of a shape that shines.
fn emitter(scene: &Scene, id: EntityId) -> Option<MaterialId> {
    let material = scene.material_of(id)?;
    scene.material(material).emission().is_some().then_some(material)
}

/// The scene with the lights dark that `is_dark` says yes to.
///
/// # Errors
/// What a scene refuses.
pub(crate) fn darkened(scene: &Scene, is_dark: impl Fn(EntityId) -> bool) -> Result<Scene, SceneError> {
    let mut lit = scene.clone();
    for id in scene.entities().filter(|id| is_dark(*id)) {
        if let Some(light) = scene.light(id) {
            let kind = light.kind();
            let edit = match (kind.make)(&kind.without_light(&light.values())) {
                Ok(dark) => Edit::Light(id, dark),
                Err(_) => Edit::Remove(id),
            };
            lit.apply(edit)?;
        } else if let Some(material) = emitter(scene, id) {
            let shining = scene.material(material);
            let kind = shining.kind();
            let Ok(dark) = (kind.make)(&kind.without_light(&shining.values())) else { continue };
            let name = lit.free_material_name(scene.material_name(material));
            let dark = lit.add_material(&name, dark)?;
            lit.apply(Edit::MaterialOf(id, dark))?;
        }
    }
    Ok(lit)
}

fn with_headlight(scene: &Scene, camera: &Camera) -> Result<Scene, SceneError> {
    let mut lit = scene.clone();
    let values = Values::new()
        .with("direction", Value::Vector(camera.forward()))
        .with("irradiance", Value::Color(Rgb::grey(HEADLIGHT)))
        .with("shadow", Value::Flag(false));
    if let Ok(light) = catoptra_core::part::make::<DirectionalLight>(&values) {
        let name = lit.free_name("headlight");
        lit.add_light(&name, light, None)?;
    }
    Ok(lit)
}

fn evenly_lit(scene: &Scene) -> Result<Scene, SceneError> {
    let mut lit = darkened(scene, |_| true)?;
    if let Ok(light) = AmbientLight::new(Rgb::WHITE) {
        let name = lit.free_name("even light");
        lit.add_light(&name, light, None)?;
    }
    Ok(lit)
}

#[cfg(test)]
mod tests {
    use super::*;
    use catoptra_core::FieldKind;
    use catoptra_core::glam::DVec3;

    const TEXT: &str = "matte \"white\" { color 1 }\nemissive \"glow\" { radiance 2 }\n\
        sphere \"lit\" material=\"glow\" { radius 1 }\nsphere \"other\" material=\"glow\" { radius 1 }\n\
        sphere \"ball\" material=\"white\" { radius 1 }\n\
        point-light \"point\" { intensity 1 }\nspot-light \"spot\" { direction 0 -1 0; intensity 1; inner 10; outer 20 }\n\
        directional-light \"sun\" { direction 0 -1 0; irradiance 1 }\nambient-light \"sky\" { radiance 1 }\n\
        environment-light \"all round\" { radiance 1 }\ndisk-light \"given by power\" { radius 1; power 5 }\n\
        rectangle-light \"panel\" { corner 0 0 0; edge-u 1 0 0; edge-v 0 1 0; radiance 3 }\n";

    fn scene(text: &str) -> Scene {
        catoptra_scene::parse(text, "text", None).unwrap().0
    }

    fn camera() -> Camera {
        Camera::look_at(DVec3::Z * 5.0, DVec3::ZERO, DVec3::Y, 1.0).unwrap()
    }

    /// The light of its own that a thing gives, in one number.
    fn power(scene: &Scene, name: &str) -> f64 {
        let id = scene.entity_named(name).unwrap();
        let Some(light) = scene.light(id) else {
            let emission = scene.material(scene.material_of(id).unwrap()).values();
            let Some(Value::Color(radiance)) = emission.get("radiance") else { panic!("{emission:?}") };
            return radiance.max_channel();
        };
        let values = light.values();
        let quantities = light.kind().fields.iter().filter(|field| field.kind == FieldKind::Quantity);
        let amounts = quantities.filter_map(|field| match values.get(field.name) {
            Some(Value::Color(color)) => Some(color.max_channel()),
            _ => None,
        });
        amounts.fold(0.0, f64::max)
    }

    const LIGHTS: [&str; 9] =
        ["lit", "other", "point", "spot", "sun", "sky", "all round", "given by power", "panel"];

    #[test]
    fn what_is_muted_is_dark_and_nothing_else_whatever_shines() {
        let scene = scene(TEXT);
        for muted in LIGHTS {
            let mut lighting = Lighting::default();
            lighting.toggle_mute(&[scene.entity_named(muted).unwrap()]);
            let lit = lighting.lit(&scene, &camera(), Illumination::Scene).unwrap();
            for name in LIGHTS {
                let wanted = if name == muted { 0.0 } else { power(&scene, name) };
                assert_eq!(power(&lit, name), wanted, "{name} while {muted} is muted");
            }
            assert!(lit.revision() != scene.revision(), "its snapshot is another one");
        }
    }

    #[test]
    fn what_is_solo_shines_alone_until_all_do_again() {
        let scene = scene(TEXT);
        let (spot, sky) = (scene.entity_named("spot").unwrap(), scene.entity_named("sky").unwrap());
        let mut lighting = Lighting::default();
        lighting.toggle_solo(&[spot]);
        lighting.toggle_solo(&[sky]);
        let lit = lighting.lit(&scene, &camera(), Illumination::Scene).unwrap();
        let shining = LIGHTS.iter().filter(|name| power(&lit, name) > 0.0);
        assert_eq!(shining.collect::<Vec<_>>(), [&"spot", &"sky"]);
        assert!(lighting.words(&scene).is_some_and(|words| words.contains("spot, sky")));
        lighting.toggle_solo(&[spot, sky]);
        assert!(lighting.is_plain() && lighting.lit(&scene, &camera(), Illumination::Scene).is_none());
    }

    #[test]
    fn a_scene_without_lights_is_lit_from_the_camera() {
        let dark = scene("matte \"m\" { color 1 }\nsphere \"ball\" material=\"m\" { radius 1 }\n");
        let lit = Lighting::default().lit(&dark, &camera(), Illumination::Scene).unwrap();
        let lights = lit.world_lights();
        assert_eq!(lights.len(), 1);
        assert_eq!(lights[0].part.direction(), Some(camera().forward()));
        assert!(!has_lights(&dark) && has_lights(&lit));
        let mut hidden = scene("point-light \"lamp\" { intensity 1 }\n");
        let lamp = hidden.entity_named("lamp").unwrap();
        assert!(has_lights(&hidden));
        hidden.apply(Edit::Flags(lamp, catoptra_core::Flags { hidden: true, locked: false })).unwrap();
        assert!(!has_lights(&hidden), "what is hidden gives no light");
    }

    #[test]
    fn even_light_comes_from_one_light_alone() {
        let scene = scene(TEXT);
        let lit = Lighting::default().lit(&scene, &camera(), Illumination::Even).unwrap();
        assert!(LIGHTS.iter().all(|name| power(&lit, name) == 0.0));
        assert_eq!(power(&lit, "even light"), 1.0);
    }
}
