//! Which materials and textures of the text does nothing use?

use catoptra_core::Role;

use super::stage::Stage;
use super::{Finding, Lint};

pub(super) const LINT: Lint = Lint { name: "unused", find };

fn find(stage: &Stage<'_>) -> Vec<Finding> {
    let scene = stage.scene;
    let told = |line: usize, what: &str, name: &str| Finding {
        line: Some(line),
        message: format!("{what} \"{name}\" is used by nothing"),
    };
    let mut found = Vec::new();
    for (id, name, _) in scene.materials().filter(|(id, ..)| scene.wearers(*id).is_empty()) {
        found.extend(stage.file.line_of_material(id).map(|line| told(line, "material", name)));
    }
    let of_lights = |id| {
        let lights = scene.entities_of(Role::Light).filter_map(|light| scene.light(light));
        lights.into_iter().any(|light| light.values().textures().any(|texture| texture == id))
    };
    for (id, name, _) in scene.textures().filter(|(id, ..)| scene.painted_with(*id).is_empty()) {
        let line = stage.file.line_of_texture(id).filter(|_| !of_lights(id));
        found.extend(line.map(|line| told(line, "texture", name)));
    }
    found
}

#[cfg(test)]
mod tests {
    use super::super::tests::findings;
    use super::*;

    #[test]
    fn what_nothing_wears_is_told_with_its_line() {
        let text = "matte \"worn\" { color 1 texture=\"a\" }\nnoise-texture \"a\"\nnoise-texture \"b\"\n\nmatte \"spare\" { color 1 }\n\
            plane \"p\" material=\"worn\"\n";
        let found = findings(&LINT, text);
        assert_eq!(found[0], (Some(5), "material \"spare\" is used by nothing".to_owned()));
        assert_eq!(found[1], (Some(3), "texture \"b\" is used by nothing".to_owned()));
        assert_eq!(found.len(), 2);
    }
}
