//! How does a scene look whose surfaces show nothing but their own colours? Lit alike from everywhere, and by nothing else.

use catoptra_core::light::AmbientLight;
use catoptra_core::scene::{Edit, Role, Scene};
use catoptra_core::{Rgb, Values};
use miette::{IntoDiagnostic, Result};

/// The scene with every light and all that shines dark, and light of radiance 1 from everywhere.
pub(super) fn evenly_lit(scene: &Scene) -> Result<Scene> {
    let mut lit = scene.clone();
    for id in scene.entities_of(Role::Light).collect::<Vec<_>>() {
        let Some(light) = scene.light(id) else { continue };
        let kind = light.kind();
        let edit = match (kind.make)(&kind.without_light(&light.values())) {
            Ok(dark) => Edit::Light(id, dark),
            Err(_) => Edit::Remove(id),
        };
        lit.apply(edit).into_diagnostic()?;
    }
    for (id, _, material) in scene.materials() {
        let (kind, values) = (material.kind(), material.values());
        let shown = with_own_color(&kind.without_light(&values));
        if let Some(shown) = (kind.make)(&shown).ok().filter(|shown| shown != material) {
            lit.apply(Edit::Material(id, shown)).into_diagnostic()?;
        }
    }
    let name = lit.free_name("even light");
    lit.add_light(&name, AmbientLight::new(Rgb::WHITE).into_diagnostic()?, None).into_diagnostic()?;
    let dark = scene.settings().with_background(Rgb::BLACK).into_diagnostic()?;
    lit.apply(Edit::Settings(dark)).into_diagnostic()?;
    Ok(lit)
}

/// The same where even light is answered as all other is: some materials have a colour of its own for it.
fn with_own_color(values: &Values) -> Values {
    match (values.get(AMBIENT), values.get(DIFFUSE)) {
        (Some(_), Some(diffuse)) => values.clone().with(AMBIENT, diffuse.clone()),
        _ => values.clone(),
    }
}

/// The fields of such materials for even light and for all other.
const AMBIENT: &str = "ambient";
const DIFFUSE: &str = "diffuse";

#[cfg(test)]
mod tests {
    use catoptra_core::{Material, Value};

    use super::*;

    #[test]
    fn one_light_is_left() {
        let text = "emissive \"glow\" { radiance 2 }\nsphere \"ball\" material=\"glow\" { radius 1 }\n\
            phong \"red\" { ambient 1; diffuse 0.8 0.1 0.1 }\n\
            point-light \"point\" { intensity 1 }\nambient-light \"sky\" { radiance 3 }\n\
            rectangle-light \"panel\" { corner 0 0 0; edge-u 1 0 0; edge-v 0 1 0; radiance 3 }\n";
        let (scene, _) = catoptra_scene::parse(text, "text", None).unwrap();
        let lit = evenly_lit(&scene).unwrap();
        let ambient: Rgb = lit.lights().iter().fold(Rgb::BLACK, |sum, (_, light)| sum + light.ambient());
        assert_eq!(ambient, Rgb::WHITE);
        let glow =
            |material: &Material| material.emission().map_or(0.0, |light| light.radiance.max_channel());
        assert!(lit.materials().all(|(.., material)| glow(material) == 0.0));
        assert_eq!(lit.entities_of(Role::Light).count(), 4);
        let red = lit.material(lit.material_named("red").unwrap()).values();
        assert_eq!(red.get(AMBIENT), Some(&Value::Color(Rgb::new(0.8, 0.1, 0.1))));
    }
}
