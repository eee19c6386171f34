//! What does an MTL file say of its materials, before pictures are looked up and numbers become a material?

use std::collections::HashMap;

use catoptra_core::Rgb;
use catoptra_core::glam::DVec2;
use catoptra_core::texture::Channel;

use crate::model::error::Place;
use crate::model::names::{name_of, text_of};
use crate::model::text::{Lines, decoded, number, split_word, words};
use crate::model::warnings::Warnings;

/// A material as it is described; what is not described is `None`.
#[derive(Debug, Clone, Default)]
pub(super) struct Described {
    /// Kd: what is scattered.
    pub(super) diffuse: Option<Rgb>,
    /// Ks: what is reflected.
    pub(super) specular: Option<Rgb>,
    /// Ke: what it sends out.
    pub(super) emission: Option<Rgb>,
    /// Tf: what is left of light that goes through.
    pub(super) filter: Option<Rgb>,
    /// Ns: the exponent of its highlights.
    pub(super) exponent: Option<f64>,
    /// Ni: its index of refraction.
    pub(super) ior: Option<f64>,
    /// d: how opaque it is.
    pub(super) dissolve: Option<f64>,
    /// Tr: how clear it is.
    pub(super) transparency: Option<f64>,
    /// illum: by which model it is lit.
    pub(super) illumination: Option<u32>,
    /// Pr.
    pub(super) roughness: Option<f64>,
    /// Pm.
    pub(super) metallic: Option<f64>,
    /// Ps.
    pub(super) sheen: Option<f64>,
    /// Pc.
    pub(super) coat: Option<f64>,
    /// Pcr.
    pub(super) coat_roughness: Option<f64>,
    /// aniso.
    pub(super) anisotropy: Option<f64>,
    /// anisor, in turns.
    pub(super) anisotropy_rotation: Option<f64>,
    pub(super) maps: HashMap<Slot, Map>,
}

/// What a picture is for.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub(super) enum Slot {
    Diffuse,
    Specular,
    Emission,
    Opacity,
    Roughness,
    Metallic,
    Sheen,
    /// Heights, or normals in their place.
    Bump,
    Normal,
}

const SLOTS: &[(&str, Slot)] = &[
    ("map_kd", Slot::Diffuse),
    ("map_ks", Slot::Specular),
    ("map_ke", Slot::Emission),
    ("map_d", Slot::Opacity),
    ("map_pr", Slot::Roughness),
    ("map_pm", Slot::Metallic),
    ("map_ps", Slot::Sheen),
    ("map_bump", Slot::Bump),
    ("bump", Slot::Bump),
    ("norm", Slot::Normal),
    ("map_norm", Slot::Normal),
    ("map_kn", Slot::Normal),
];

/// A picture and how it is laid.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Map {
    pub(super) file: String,
    pub(super) scale: DVec2,
    pub(super) offset: DVec2,
    pub(super) clamp: bool,
    /// -bm: how much bumps count.
    pub(super) strength: f64,
    /// -imfchan: which number of the picture counts, where one does.
    pub(super) channel: Option<Channel>,
    /// -mm: what the picture is multiplied by.
    pub(super) gain: f64,
    pub(super) place: Place,
}

/// Words that say nothing about how a surface looks here.
const SILENT: &[&str] = &["ka", "map_ka", "sharpness", "map_aat"];

/// Materials by their names.
pub(super) type Library = HashMap<Vec<u8>, Described>;

/// Adds the materials of a file to a library; `place` is where it is named, and messages begin with its name. Lines that
/// cannot be understood are passed over.
pub(super) fn read(bytes: &[u8], file: &str, place: Place, library: &mut Library, warnings: &Warnings) {
    let bytes = decoded(bytes);
    let mut lines = Lines::new(&bytes);
    let mut name = None;
    while let Some((line, statement)) = lines.next() {
        let (word, rest) = split_word(statement);
        if word.eq_ignore_ascii_case(b"newmtl") {
            // The first of a name counts.
            name = (!library.contains_key(rest)).then(|| rest.to_owned());
            if let Some(name) = &name {
                library.insert(name.clone(), Described::default());
            }
            continue;
        }
        let Some(material) = name.as_ref().and_then(|name| library.get_mut(name)) else { continue };
        if let Err(message) = material.read(word, rest, place) {
            warnings.add(place, format!("{file}:{line}: {message}: passed over"));
        }
    }
}

impl Described {
    fn read(&mut self, word: &[u8], rest: &[u8], place: Place) -> Result<(), String> {
        let word = name_of(word).to_ascii_lowercase();
        if let Some((_, slot)) = SLOTS.iter().find(|(name, _)| *name == word) {
            let map = Map::read(rest, place)?;
            self.maps.entry(*slot).or_insert(map);
            return Ok(());
        }
        match word.as_str() {
            "kd" => self.diffuse = Some(color(rest)?),
            "ks" => self.specular = Some(color(rest)?),
            "ke" => self.emission = Some(color(rest)?),
            "tf" => self.filter = Some(color(rest)?),
            "ns" => self.exponent = Some(single(rest)?),
            "ni" => self.ior = Some(single(rest)?),
            // A halo makes it more opaque towards the rim.
            "d" => self.dissolve = Some(single(rest.strip_prefix(b"-halo").unwrap_or(rest))?),
            "tr" => self.transparency = Some(single(rest)?),
            "illum" => self.illumination = Some(single(rest)? as u32),
            "pr" => self.roughness = Some(single(rest)?),
            "pm" => self.metallic = Some(single(rest)?),
            "ps" => self.sheen = Some(single(rest)?),
            "pc" => self.coat = Some(single(rest)?),
            "pcr" => self.coat_roughness = Some(single(rest)?),
            "aniso" => self.anisotropy = Some(single(rest)?),
            "anisor" => self.anisotropy_rotation = Some(single(rest)?),
            word if SILENT.contains(&word) => {}
            _ => return Err(format!("\"{word}\" is not understood")),
        }
        Ok(())
    }
}

/// A finite number.
fn finite(word: &[u8]) -> Result<f64, String> {
    let value = number(word)?;
    if value.is_finite() { Ok(value) } else { Err(format!("{value} is no finite number")) }
}

fn single(rest: &[u8]) -> Result<f64, String> {
    words(rest).next().map_or_else(|| Err("a number is missing".to_owned()), finite)
}

/// Red, green and blue; one number stands for all three.
fn color(rest: &[u8]) -> Result<Rgb, String> {
    let mut words = words(rest);
    let first = words.next().ok_or("a colour is missing")?;
    if first == b"spectral" || first == b"xyz" {
        return Err(format!("{} colours are not understood", name_of(first)));
    }
    let red = finite(first)?;
    let [green, blue] = [words.next(), words.next()].map(|word| word.map_or(Ok(red), finite));
    Ok(Rgb::new(red, green?, blue?).map(|v| v.max(0.0)))
}

impl Map {
    /// Reads options and, behind them, the name of a file, which may have spaces.
    fn read(rest: &[u8], place: Place) -> Result<Self, String> {
        let mut map = Self {
            file: String::new(),
            scale: DVec2::ONE,
            offset: DVec2::ZERO,
            clamp: false,
            strength: 1.0,
            channel: None,
            gain: 1.0,
            place,
        };
        let mut rest = rest;
        while rest.starts_with(b"-") {
            let (option, after) = split_word(rest);
            rest = map.read_option(option, after)?;
        }
        map.file = text_of(rest).trim_matches('"').to_owned();
        if map.file.is_empty() { Err("the name of a picture is missing".to_owned()) } else { Ok(map) }
    }

    /// Reads the values of an option and gives back what follows them.
    fn read_option<'a>(&mut self, option: &[u8], rest: &'a [u8]) -> Result<&'a [u8], String> {
        let word = || split_word(rest);
        match option {
            b"-s" | b"-o" | b"-t" => {
                let (values, rest) = up_to_three(rest);
                match option {
                    b"-s" => self.scale = DVec2::new(values[0].unwrap_or(1.0), values[1].unwrap_or(1.0)),
                    b"-o" => self.offset = DVec2::new(values[0].unwrap_or(0.0), values[1].unwrap_or(0.0)),
                    _ => {}
                }
                Ok(rest)
            }
            b"-bm" => {
                let (value, rest) = word();
                self.strength = finite(value)?;
                Ok(rest)
            }
            b"-clamp" => {
                let (value, rest) = word();
                self.clamp = value == b"on";
                Ok(rest)
            }
            b"-imfchan" => {
                let (value, rest) = word();
                self.channel = match value {
                    b"r" => Some(Channel::Red),
                    b"g" => Some(Channel::Green),
                    b"b" => Some(Channel::Blue),
                    b"m" => Some(Channel::Alpha),
                    b"l" => Some(Channel::Luminance),
                    _ => None,
                };
                Ok(rest)
            }
            b"-mm" => {
                let (values, rest) = up_to_three(rest);
                self.gain = values[1].unwrap_or(1.0);
                Ok(rest)
            }
            b"-blendu" | b"-blendv" | b"-cc" | b"-texres" | b"-type" | b"-boost" | b"-colorspace" => {
                Ok(word().1)
            }
            _ => Err(format!("the option {} is not understood", name_of(option))),
        }
    }
}

/// The numbers that stand first, three at most, and what follows them. A number that is all that is left is a file's name.
fn up_to_three(mut rest: &[u8]) -> ([Option<f64>; 3], &[u8]) {
    let mut values = [None; 3];
    for value in &mut values {
        let (word, after) = split_word(rest);
        let Some(found) = finite(word).ok().filter(|_| !after.is_empty()) else { break };
        (*value, rest) = (Some(found), after);
    }
    (values, rest)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn library(text: &[u8]) -> (Library, Vec<String>) {
        let (mut library, warnings) = (Library::new(), Warnings::default());
        read(text, "a.mtl", Place::Line(3), &mut library, &warnings);
        (library, warnings.into_list().into_iter().map(|warning| warning.message).collect())
    }

    #[test]
    fn numbers_and_colours_are_read_and_what_is_wrong_is_told() {
        let text = b"Kd 1 1 1\nnewmtl a b\n\tKd 0.5 0.25 0 # dull\nks .3\nKe spectral x.rfl\nd -halo 0.25\nillum 4\r\nNs x\nPr 0.5\n\
                     newmtl a b\nPr 1\nnewmtl gr\xfcn\nTr 0.75\nwet 1\nPm nan\nPc\n";
        let (library, warnings) = library(text);
        let a = &library[&b"a b"[..]];
        assert_eq!((a.diffuse, a.specular), (Some(Rgb::new(0.5, 0.25, 0.0)), Some(Rgb::grey(0.3))));
        assert_eq!(
            (a.dissolve, a.illumination, a.roughness, a.exponent),
            (Some(0.25), Some(4), Some(0.5), None)
        );
        assert_eq!(library[&b"gr\xfcn"[..]].transparency, Some(0.75));
        let expected = [
            "a.mtl:5: spectral colours are not understood: passed over",
            "a.mtl:8: \"x\" is no number: passed over",
            "a.mtl:14: \"wet\" is not understood: passed over",
            "a.mtl:15: NaN is no finite number: passed over",
            "a.mtl:16: a number is missing: passed over",
        ];
        assert_eq!(warnings, expected);
    }

    #[test]
    fn options_stand_before_names_with_spaces() {
        let map = |text: &str| Map::read(text.as_bytes(), Place::File);
        let plain = map("my wood.png").unwrap();
        assert_eq!((plain.file.as_str(), plain.scale, plain.clamp), ("my wood.png", DVec2::ONE, false));
        let rich =
            map("-s 2 3 1 -o 0.5 -clamp on -bm 0.25 -imfchan m -mm 0 0.5 -blendu off maps\\my wood.png")
                .unwrap();
        assert_eq!(rich.file, "maps\\my wood.png");
        assert_eq!((rich.scale, rich.offset), (DVec2::new(2.0, 3.0), DVec2::new(0.5, 0.0)));
        assert_eq!((rich.clamp, rich.strength, rich.gain), (true, 0.25, 0.5));
        assert_eq!(rich.channel, Some(Channel::Alpha));
        assert_eq!(map("-s 2 2 7").unwrap().file, "7");
        assert_eq!(map("\"a b.png\"").unwrap().file, "a b.png");
        assert!(map("-s 2 2").is_ok_and(|map| map.file == "2"));
        assert!(map("-bm").is_err() && map("").is_err() && map("-x a.png").is_err());
    }
}
