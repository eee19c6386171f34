//! What do shapes of OBJ files wear?

use std::path::Path;

use catoptra_core::glam::DVec2;
use catoptra_core::texture::Channel;
use catoptra_core::{Rgb, Texture, Value};
use catoptra_scene::image::write_png;
use catoptra_scene::model::{Model, ModelMaterial, read, read_mesh};

use crate::{model, shape, warnings};

const TRIANGLE: &str = "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\n";

/// A folder with `a.obj`, one triangle of the material `m`, and a library of what that is.
struct Bench(tempfile::TempDir);

impl Bench {
    fn new(mtl: &str) -> Self {
        let bench = Self(tempfile::tempdir().unwrap());
        bench.put("a.obj", format!("mtllib a.mtl\n{TRIANGLE}usemtl m\nf 1/1 2/1 3/1\n").as_bytes());
        bench.put("a.mtl", format!("newmtl m\n{mtl}").as_bytes());
        bench
    }

    fn path(&self) -> &Path {
        self.0.path()
    }

    fn put(&self, name: &str, bytes: &[u8]) {
        std::fs::write(self.path().join(name), bytes).unwrap();
    }

    /// A picture of two pixels.
    fn picture(&self, name: &str, pixels: [[u8; 3]; 2]) {
        write_png(&self.path().join(name), 2, 1, pixels.as_flattened()).unwrap();
    }

    fn read(&self) -> Model {
        read(&self.path().join("a.obj")).unwrap_or_else(|e| panic!("{e}"))
    }
}

fn worn(model: &Model) -> &ModelMaterial {
    &model.materials[shape(&model.nodes[0]).1.index() as usize - 1]
}

fn material(mtl: &str) -> ModelMaterial {
    let model = Bench::new(mtl).read();
    assert_eq!(warnings(&model), Vec::<&str>::new(), "{mtl}");
    worn(&model).clone()
}

fn number(material: &ModelMaterial, field: &str) -> f64 {
    match material.material.values().get(field).cloned().map(Value::untextured) {
        Some(Value::Number(number)) => number,
        other => panic!("{field} is {other:?}"),
    }
}

fn color(material: &ModelMaterial, field: &str) -> Rgb {
    match material.material.values().get(field).cloned().map(Value::untextured) {
        Some(Value::Color(color)) => color,
        other => panic!("{field} is {other:?}"),
    }
}

fn near(a: f64, b: f64) -> bool {
    (a - b).abs() < 1e-9
}

#[test]
fn what_only_scatters_is_matte() {
    for mtl in [
        "Kd 0.5 0.25 0",
        "Kd 0.5 0.25 0\nKs 0 0 0\nNs 10\nillum 2",
        "Kd 0.5 0.25 0\nKs 1 1 1\nillum 1",
        "Kd 0.5 0.25 0\nd 1\nTr 0\nKe 0 0 0",
    ] {
        let material = material(mtl);
        assert_eq!((material.material.kind_name(), material.name.as_str()), ("matte", "m"), "{mtl}");
        assert_eq!(color(&material, "color"), Rgb::new(0.5, 0.25, 0.0));
        assert!(material.finish.is_plain());
    }
    assert_eq!(color(&material(""), "color"), Rgb::grey(0.8));
    assert_eq!(color(&material("Kd 0.3"), "color"), Rgb::grey(0.3));
}

#[test]
fn highlights_become_a_surface_of_that_roughness() {
    let shiny = material("Kd 0.5 0 0\nKs 0.25 0.25 0.125\nNs 198\nNi 1.4\nillum 2");
    assert_eq!(shiny.material.kind_name(), "principled");
    // α² = 2 / (198 + 2) = 0.01, and roughness is √α.
    assert!(near(number(&shiny, "roughness"), 0.1_f64.sqrt()));
    assert_eq!(
        (number(&shiny, "specular"), number(&shiny, "ior"), number(&shiny, "metallic")),
        (0.5, 1.4, 0.0)
    );
    assert_eq!(
        (color(&shiny, "base-color"), color(&shiny, "specular-color")),
        (Rgb::new(0.5, 0.0, 0.0), Rgb::new(1.0, 1.0, 0.5))
    );
    assert_eq!(number(&material("Ks 1 1 1\nNi 1"), "ior"), 1.5, "an index of 1 is one that nobody set");
}

#[test]
fn models_of_lighting_with_reflections_are_part_metal() {
    let mirror = material("Kd 0 0 0\nKs 0.9 0.9 0.9\nillum 5");
    assert_eq!((number(&mirror, "metallic"), number(&mirror, "roughness")), (1.0, 0.0));
    assert_eq!(color(&mirror, "base-color"), Rgb::grey(0.9));
    // A quarter scattered and a half mirrored of three quarters.
    let mixed = material("Kd 0.25 0.25 0.25\nKs 0.5 0.5 0.5\nillum 3\nNs 100");
    assert!(near(number(&mixed, "metallic"), 2.0 / 3.0));
    assert_eq!(color(&mixed, "base-color"), Rgb::grey(0.75));
}

#[test]
fn clear_matter_is_solid_and_what_dissolves_is_a_veil() {
    let glass = material("Kd 0 0 0\nKs 0.1 0.1 0.1\nTf 0.9 1 0.9\nNi 1.52\nillum 7");
    assert_eq!(
        (number(&glass, "transmission"), number(&glass, "ior"), number(&glass, "roughness")),
        (1.0, 1.52, 0.0)
    );
    assert_eq!(color(&glass, "base-color"), Rgb::new(0.9, 1.0, 0.9));
    assert!(glass.finish.is_plain());
    let part = material("Kd 1 0 0\nd 0.25\nillum 6");
    assert_eq!(
        (number(&part, "transmission"), color(&part, "base-color")),
        (0.75, Rgb::new(1.0, 0.75, 0.75))
    );
    let solid = material("Kd 1 0 0\nd 1\nillum 7");
    assert_eq!(solid.material.kind_name(), "matte", "nothing says that it is clear");
    for mtl in ["d 0.25", "Tr 0.75", "d 0.25\nTr 0.25", "d 0.25\nillum 4", "d -halo 0.25"] {
        let veil = material(mtl);
        assert_eq!((veil.finish.opacity().base(), veil.material.kind_name()), (0.25, "matte"), "{mtl}");
    }
    let model = Bench::new("Tr 1").read();
    assert_eq!(worn(&model).finish.opacity().base(), 1.0);
    assert!(warnings(&model)[0].contains("would not be seen"));
    assert_eq!(material("d 0").finish.opacity().base(), 0.0);
}

#[test]
fn what_shines_more_than_it_scatters_is_a_lamp() {
    let lamp = material("Kd 0.8 0.8 0.8\nKe 17 12 4");
    assert_eq!(
        (lamp.material.kind_name(), color(&lamp, "radiance")),
        ("emissive", Rgb::new(17.0, 12.0, 4.0))
    );
    assert_eq!(lamp.material.values().get("two-sided"), Some(&Value::Flag(true)));
    let glow = material("Kd 0.8 0.8 0.8\nKe 0.1 0.1 0.4");
    assert_eq!(
        (glow.material.kind_name(), color(&glow, "emission")),
        ("principled", Rgb::new(0.1, 0.1, 0.4))
    );
    assert_eq!(number(&glow, "specular"), 0.0);
}

#[test]
fn physically_based_words_are_taken_as_they_are() {
    let pbr = material(
        "Kd 0.5 0.5 0.5\nPr 0.3\nPm 0.6\nPs 0.1\nPc 0.7\nPcr 0.2\naniso 0.4\nanisor 0.25\nNs 900\nillum 3\nKs 1 1 1",
    );
    let fields = ["roughness", "metallic", "sheen", "coat", "coat-roughness", "anisotropy"];
    assert_eq!(fields.map(|field| number(&pbr, field)), [0.3, 0.6, 0.1, 0.7, 0.2, 0.4]);
    assert!(near(number(&pbr, "anisotropy-rotation"), std::f64::consts::FRAC_PI_2));
    assert_eq!(color(&pbr, "base-color"), Rgb::grey(0.5));
    assert_eq!(number(&material("Pm 1"), "roughness"), 0.5);
}

/// The texture that a value names, and how it is used.
fn texture(model: &Model, value: Option<Value>) -> (&Texture, Option<Channel>) {
    match value {
        Some(Value::Textured(textured)) => {
            (&model.textures[textured.by.texture.index() as usize - 1].1, textured.by.channel)
        }
        Some(Value::Texture(id)) => (&model.textures[id.index() as usize - 1].1, None),
        other => panic!("no texture: {other:?}"),
    }
}

fn word(texture: &Texture, field: &str) -> String {
    match texture.values().get(field) {
        Some(Value::Word(word)) => word.clone(),
        other => panic!("{field} is {other:?}"),
    }
}

#[test]
fn pictures_are_laid_as_their_options_say() {
    let bench = Bench::new(
        "Kd 0 0 0\nmap_Kd -s 2 3 -o 0.5 0.25 -clamp on maps\\My Wood.png\nmap_Ke glow.png\nmap_Pr -imfchan g rough.png\nmap_Pm rough.png\n",
    );
    std::fs::create_dir(bench.path().join("Maps")).unwrap();
    for name in ["Maps/my wood.PNG", "glow.png", "rough.png"] {
        bench.picture(name, [[255, 0, 0], [0, 0, 255]]);
    }
    let model = bench.read();
    assert_eq!(warnings(&model), Vec::<&str>::new());
    let values = worn(&model).material.values();
    // White light from a picture outshines what is scattered, unless that is white too.
    assert_eq!(worn(&model).material.kind_name(), "principled");
    let (wood, _) = texture(&model, values.get("base-color").cloned());
    assert_eq!(color(worn(&model), "base-color"), Rgb::WHITE, "black under a picture stands for none");
    assert_eq!(wood.values().get("scale"), Some(&Value::Pair(DVec2::new(2.0, 3.0))));
    assert_eq!(wood.values().get("offset"), Some(&Value::Pair(DVec2::new(0.5, 0.25))));
    assert_eq!((word(wood, "wrap"), word(wood, "color-space")), ("clamp".into(), "auto".into()));
    let (glow, _) = texture(&model, values.get("emission").cloned());
    assert_eq!((color(worn(&model), "emission"), word(glow, "wrap")), (Rgb::WHITE, "repeat".into()));
    let (rough, channel) = texture(&model, values.get("roughness").cloned());
    assert_eq!((word(rough, "color-space"), channel), ("linear".into(), Some(Channel::Green)));
    let (metal, channel) = texture(&model, values.get("metallic").cloned());
    assert!(std::ptr::eq(metal, rough), "the same picture laid alike is one texture");
    assert_eq!((channel, number(worn(&model), "metallic")), (Some(Channel::Red), 1.0));
    assert_eq!(model.textures.len(), 3);
    let bench = Bench::new("Kd 1 1 1\nmap_Kd -mm 0 0.5 a.png\n");
    bench.picture("a.png", [[255, 0, 0], [0, 0, 255]]);
    assert_eq!(color(worn(&bench.read()), "color"), Rgb::grey(0.5));
}

#[test]
fn pictures_cut_out_and_bend_normals() {
    let bench = Bench::new("map_d hole.png\nmap_bump -bm 0.5 height.png\n");
    bench.picture("hole.png", [[255; 3], [0; 3]]);
    bench.picture("height.png", [[255; 3], [0; 3]]);
    let model = bench.read();
    let finish = worn(&model).finish;
    let by = finish.opacity().texture().unwrap();
    assert_eq!((by.texture.index(), by.channel), (1, Some(Channel::Luminance)));
    let map = finish.normal_map().unwrap();
    assert_eq!((map.texture.index(), map.strength), (2, 0.5));
    let bench = Bench::new("bump -bm -2 normals.png\n");
    bench.picture("normals.png", [[128, 128, 255]; 2]);
    let model = bench.read();
    let map = worn(&model).finish.normal_map().unwrap();
    let at = catoptra_core::TexturePoint::at_uv(DVec2::new(0.25, 0.5));
    let outwards = model.textures[map.texture.index() as usize - 1].1.color(&at);
    assert!((outwards.b - 1.0).abs() < 1e-6, "a picture of normals stays what it is: {outwards:?}");
}

#[test]
fn what_is_missing_is_told_and_does_without() {
    let bench = Bench::new("Kd 1 0 0\nmap_Kd none.png\nmap_d a.obj\nrefl -type sphere sky.png\nKs 2 x 0\n");
    let model = bench.read();
    let told = warnings(&model);
    assert_eq!(told.len(), 4, "{told:?}");
    assert!(told[0].contains("a.mtl:5: \"refl\" is not understood"), "{told:?}");
    assert!(told[1].contains("a.mtl:6: \"x\" is no number"), "{told:?}");
    assert!(told[2].contains("the picture none.png is not shown: none.png is not there"), "{told:?}");
    assert!(told[3].contains("the picture a.obj is not shown") && told[3].contains("no picture"), "{told:?}");
    assert_eq!(color(worn(&model), "color"), Rgb::new(1.0, 0.0, 0.0));
    std::fs::remove_file(bench.path().join("a.mtl")).unwrap();
    let model = bench.read();
    let told = warnings(&model);
    assert!(told[0].contains("materials are missing: a.mtl is not there"), "{told:?}");
    assert!(told[1].contains("the material m is not described"), "{told:?}");
    assert_eq!((worn(&model).name.as_str(), color(worn(&model), "color")), ("m", Rgb::grey(0.8)));
    // Whoever wants triangles alone is not troubled with any of it.
    bench.put("a.mtl", b"newmtl m\nmap_Kd a.obj\n");
    assert_eq!(read_mesh(&bench.path().join("a.obj")).unwrap().triangles().len(), 1);
}

#[test]
fn libraries_have_names_in_any_encoding_and_with_spaces() {
    let bench = Bench::new("");
    bench.put("my lib.mtl", b"\xef\xbb\xbfnewmtl gr\xfcn\rKd 0 1 0\r");
    bench.put("b.mtl", b"newmtl m\nKd 0 0 1\n");
    bench.put(
        "a.obj",
        &[
            b"mtllib my lib.mtl\nmtllib a.mtl b.mtl\n",
            TRIANGLE.as_bytes(),
            b"usemtl gr\xfcn\nf 1 2 3\nusemtl m\nf 1 2 3\n",
        ]
        .concat(),
    );
    let model = bench.read();
    let found: Vec<(&str, Rgb)> =
        model.materials.iter().map(|m| (m.name.as_str(), color(m, "color"))).collect();
    assert_eq!(found, [("grün", Rgb::new(0.0, 1.0, 0.0)), ("m", Rgb::grey(0.8))]);
}

#[test]
fn colours_of_corners_go_under_those_of_materials() {
    let bench = Bench::new("Kd 0.5 0.5 0.5\n");
    bench.put("a.obj", b"mtllib a.mtl\nv 0 0 0 1 0 0\nv 1 0 0 1 0 0\nv 0 1 0 1 0 0\nusemtl m\nf 1 2 3\n");
    let model = bench.read();
    assert_eq!(color(worn(&model), "color"), Rgb::grey(0.5));
    let (texture, _) = texture(&model, worn(&model).material.values().get("color").cloned());
    assert_eq!(texture.kind_name(), "vertex-color-texture");
}

#[test]
fn wild_numbers_make_some_material() {
    let wild = ["1e300", "-1e300", "1e-300", "-0", "1e39", "9", "0.5"];
    for value in wild {
        let words = [
            "Kd", "Ks", "Ke", "Tf", "Ns", "Ni", "d", "Tr", "illum", "Pr", "Pm", "Ps", "Pc", "Pcr", "aniso",
            "anisor",
        ];
        for illumination in 0..10 {
            let mtl: String = words.iter().map(|word| format!("{word} {value}\n")).collect();
            let model = Bench::new(&format!("{mtl}illum {illumination}\n")).read();
            assert_eq!(model.nodes.len(), 1);
        }
    }
}

#[test]
fn a_file_without_a_folder_is_told_of_what_it_lacks() {
    let model = model(format!("mtllib a.mtl\n{TRIANGLE}usemtl m\nf 1 2 3\n").as_bytes(), "a.obj");
    assert!(
        warnings(&model)[0].contains("a.mtl cannot be found: there is no folder"),
        "{:?}",
        warnings(&model)
    );
}
