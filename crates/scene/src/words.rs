//! Which known word did somebody mean who wrote an unknown one?

/// The known word nearest to `written`, if one is near enough to be meant: at most a third of its letters differ
/// (a swapped pair counts as one), or it is the same but for case, or a part of it. The first of equally near ones;
/// `None` for nothing written and for more than 64 bytes, which no slip of the finger makes.
pub fn nearest<'a>(written: &str, known: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    let lower = written.to_lowercase();
    let distance = |word: &str| {
        let word = word.to_lowercase();
        if written.chars().count() >= 3 && (word.contains(&lower) || lower.contains(&word)) {
            return 1;
        }
        strsim::damerau_levenshtein(&lower, &word)
    };
    // A text much longer than any word was no slip of the finger, and would be slow to compare.
    if written.is_empty() || written.len() > 64 {
        return None;
    }
    let near = known.into_iter().map(|word| (distance(word), word)).min_by_key(|(d, _)| *d)?;
    (near.0 <= (near.1.chars().count() / 3).max(1)).then_some(near.1)
}

/// What other programs call things, and what scene text calls them.
#[cfg(feature = "text")]
const SYNONYMS: &[(&str, &[&str])] = &[
    ("location", &["eye", "position", "center"]),
    ("position", &["eye", "center"]),
    ("from", &["eye"]),
    ("lookat", &["target"]),
    ("at", &["target"]),
    ("to", &["target"]),
    ("angle", &["fov"]),
    ("rotate", &["turn"]),
    ("rotation", &["turn"]),
    ("translate", &["move"]),
    ("translation", &["move"]),
    ("origin", &["center", "point"]),
    ("colour", &["color"]),
    ("rgb", &["color"]),
    ("albedo", &["color", "diffuse"]),
    ("diffuse", &["color"]),
    ("pigment", &["color"]),
    ("power", &["intensity", "irradiance", "radiance"]),
    ("watts", &["power", "intensity", "irradiance"]),
    ("flux", &["power", "intensity", "irradiance"]),
    ("energy", &["intensity", "irradiance", "power", "radiance"]),
    ("strength", &["intensity", "irradiance", "radiance"]),
    ("intensity", &["irradiance", "radiance"]),
    ("path", &["file"]),
    ("filename", &["file"]),
    ("lightsource", &["point-light"]),
    ("light", &["point-light"]),
    ("sun", &["directional-light"]),
    ("arealight", &["rectangle-light", "emissive"]),
    ("area", &["rectangle-light"]),
    ("quadlight", &["rectangle-light"]),
    ("rectlight", &["rectangle-light"]),
    ("rectarealight", &["rectangle-light"]),
    ("squarelight", &["rectangle-light"]),
    ("panellight", &["rectangle-light"]),
    ("softbox", &["rectangle-light"]),
    ("disclight", &["disk-light"]),
    ("circlelight", &["disk-light"]),
    ("roundlight", &["disk-light"]),
    ("balllight", &["sphere-light"]),
    ("bulb", &["sphere-light", "point-light"]),
    ("emission", &["emissive", "radiance"]),
    ("emitter", &["emissive"]),
    ("emit", &["emissive", "radiance"]),
    ("diffuselight", &["emissive"]),
    ("glow", &["emissive"]),
    ("luminous", &["emissive"]),
    ("doublesided", &["two-sided"]),
    ("bothsides", &["two-sided"]),
    ("cube", &["box"]),
    ("cuboid", &["box"]),
    ("ball", &["sphere"]),
    ("quad", &["rectangle"]),
    ("floor", &["plane"]),
    ("object", &["mesh"]),
    ("lambert", &["matte"]),
    ("metal", &["mirror"]),
    ("array", &["repeat"]),
    ("loop", &["repeat"]),
    ("copies", &["repeat", "count"]),
    ("times", &["count"]),
];

/// The known word for what other programs call `written`.
#[cfg(feature = "text")]
fn synonym<'a>(written: &str, known: &[&'a str]) -> Option<&'a str> {
    let plain: String = written.chars().filter(|c| !"-_ ".contains(*c)).collect::<String>().to_lowercase();
    let (_, meant) = SYNONYMS.iter().find(|(word, _)| *word == plain)?;
    meant.iter().find_map(|meant| known.iter().find(|word| *word == meant)).copied()
}

/// "did you mean …?" where a word is near, else the list of what there is.
#[cfg(feature = "text")]
pub(crate) fn hint(written: &str, known: &[&str], what: &str) -> String {
    match synonym(written, known).or_else(|| nearest(written, known.iter().copied())) {
        Some(word) => format!("did you mean \"{word}\"?"),
        None if known.is_empty() => format!("there are no {what}"),
        None if known.len() > 40 => format!("there are {} {what}, none of them near to that", known.len()),
        None => format!("{what}: {}", known.join(", ")),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const KNOWN: [&str; 4] = ["sphere", "plane", "point-light", "spot-light"];

    #[test]
    fn a_slip_of_the_finger_finds_its_word() {
        assert_eq!(nearest("shpere", KNOWN), Some("sphere"));
        assert_eq!(nearest("Plane", KNOWN), Some("plane"));
        assert_eq!(nearest("spotlight", KNOWN), Some("spot-light"));
        assert_eq!(nearest("point", KNOWN), Some("point-light"));
        assert_eq!(nearest("orcale", ["wide", "scalar", "oracle"]), Some("oracle"));
        assert_eq!(nearest("frnt", ["front"]), Some("front"));
        assert_eq!(nearest("sgrb", ["linear", "srgb", "filmic"]), Some("srgb"));
    }

    #[test]
    fn words_of_other_programs_find_theirs() {
        let camera = ["eye", "target", "fov", "move", "turn"];
        for (word, meant) in
            [("look_at", "target"), ("Location", "eye"), ("angle", "fov"), ("rotate", "turn")]
        {
            assert_eq!(hint(word, &camera, "fields"), format!("did you mean \"{meant}\"?"));
        }
        let lights = ["point-light", "rectangle-light", "disk-light", "sphere-light", "emissive", "sphere"];
        for (word, meant) in [
            ("area-light", "rectangle-light"),
            ("quad_light", "rectangle-light"),
            ("RectAreaLight", "rectangle-light"),
            ("disc light", "disk-light"),
            ("ball light", "sphere-light"),
            ("diffuse_light", "emissive"),
            ("emission", "emissive"),
        ] {
            assert_eq!(hint(word, &lights, "words"), format!("did you mean \"{meant}\"?"));
        }
        let fields = ["corner", "edge-u", "edge-v", "radiance", "power", "two-sided", "visible", "shadow"];
        for (word, meant) in [("watts", "power"), ("emission", "radiance"), ("double-sided", "two-sided")] {
            assert_eq!(hint(word, &fields, "fields"), format!("did you mean \"{meant}\"?"));
        }
        assert_eq!(hint("light_source", &KNOWN, "words"), "did you mean \"point-light\"?");
    }

    #[test]
    fn another_word_finds_none() {
        assert_eq!(nearest("torus", KNOWN), None);
        assert_eq!(nearest("", KNOWN), None);
    }
}
