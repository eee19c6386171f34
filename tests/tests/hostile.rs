//! Does anything that can be said in a scene, however strange, leave a picture without holes: no panic, no hang, no NaN,
//! and the rest of the scene still drawn?

use catoptra_core::glam::DVec3;
use catoptra_core::{Camera, Field, Material, MaterialId, Rgb, Scene, Shape, Value, Values};
use catoptra_tests::{camera_of, parsed, traced};
use catoptra_tracer::{Film, Moments, Size, View};

const SIZE: Size = Size::new(24, 18);

/// A ball before a wall, under a lamp; what is added to it shall not take it away.
const GOOD: &str = r#"
    camera "eye" { eye 0 1 6; target 0 1 0 }
    phong "red" { diffuse 0.8 0.2 0.1; specular 0.5; reflectiveness 0.2 }
    matte "grey" { color 0.5 0.5 0.5 }
    sphere "ball" material="red" { center 0 1 0; radius 1 }
    plane "wall" material="grey" { point 0 0 -4; normal 0 0.1 1 }
    ambient-light "sky" { radiance 0.1 0.1 0.1 }
    point-light "lamp" { position 3 5 4; intensity 60 60 60 }
"#;

/// Zeros, denormals, the smallest and largest numbers of both precisions, and what is no number.
const NUMBERS: [f64; 22] = [
    0.0,
    -0.0,
    5e-324,
    -1e-310,
    1e-200,
    1e-45,
    1.2e-38,
    -1e-38,
    1e-20,
    1e-7,
    1.0,
    1e7,
    -1e15,
    1e20,
    1e38,
    -1e38,
    3.4e38,
    1e39,
    1e300,
    f64::INFINITY,
    f64::NEG_INFINITY,
    f64::NAN,
];

/// Values of the same sort made of a strange number.
fn strange(like: &Value, number: f64) -> Vec<Value> {
    let vectors = [
        DVec3::splat(number),
        DVec3::new(number, 0.0, 0.0),
        DVec3::new(0.3, number, -0.7),
        DVec3::new(1.0, 2.0, number),
    ];
    match like {
        Value::Number(_) => vec![Value::Number(number)],
        Value::Vector(_) => vectors.map(Value::Vector).into(),
        Value::Color(_) => vec![Value::Color(Rgb::grey(number)), Value::Color(Rgb::new(number, 0.5, 0.0))],
        _ => Vec::new(),
    }
}

/// Every way to make one field of a part strange.
fn variants(values: &Values) -> Vec<(&'static str, Value)> {
    let fields: Vec<(&'static str, Value)> =
        values.iter().map(|(name, value)| (name, value.clone())).collect();
    let of = |(name, value): &(&'static str, Value)| {
        let name = *name;
        NUMBERS
            .into_iter()
            .flat_map(|number| strange(value, number))
            .map(move |value| (name, value))
            .collect::<Vec<_>>()
    };
    fields.iter().flat_map(of).collect()
}

fn picture(scene: &Scene, camera: Camera, backend: &str) -> Film {
    traced(scene, backend, &View::of(scene, camera, SIZE), Film::new(SIZE), 1)
}

/// Every pixel is a number, and both backends see the same surfaces.
#[track_caller]
fn assert_sound(scene: &Scene, camera: &Camera, what: &str) -> Film {
    let [wide, right] = ["wide", "oracle"].map(|backend| picture(scene, camera.clone(), backend));
    for (x, y) in (0..SIZE.height).flat_map(|y| (0..SIZE.width).map(move |x| (x, y))) {
        for film in [&wide, &right] {
            assert!(film.radiance(x, y).iter().all(|light| light.is_finite()), "{what}: light at {x},{y}");
            assert!(film.depth(x, y) > 0.0 || film.depth(x, y) == 0.0, "{what}: depth at {x},{y}");
        }
        assert_eq!(wide.surface(x, y), right.surface(x, y), "{what}: surface at {x},{y}");
    }
    wide
}

/// The ball is still seen in the middle, and it is not black.
#[track_caller]
fn assert_ball(scene: &Scene, film: &Film, what: &str) {
    let (x, y) = (SIZE.width / 2, SIZE.height / 2);
    assert_eq!(film.surface(x, y), scene.entity_named("ball"), "{what}");
    assert!(film.radiance(x, y)[0] > 0.01, "{what}: {:?}", film.radiance(x, y));
}

fn material(scene: &Scene) -> MaterialId {
    scene.material_named("grey").expect("a material")
}

/// One of each kind of shape, before and beside the ball.
const SHAPES: &str = r#"
    matte "grey" { color 0.5 0.5 0.5 }
    sphere "sphere" material="grey" { center -2 2 1; radius 0.5 }
    plane "plane" material="grey" { point 0 -1 0; normal 0.1 1 0 }
    triangle "triangle" material="grey" { a -2 0 1; b -1 0 1; c -1.5 1 0.5 }
    tetrahedron "tetrahedron" material="grey" { a 1 0 1; b 2 0 1; c 1.5 1 1; d 1.5 0.5 2 }
    rectangle "rectangle" material="grey" { corner 1 2 0; edge-u 1 0 0; edge-v 0 1 0 }
    disk "disk" material="grey" { center -2 3 0; normal 0 1 1; radius 0.6 }
    box "box" material="grey" { min 2 0 0; max 3 1 1 }
"#;

#[test]
fn no_shape_leaves_a_hole() {
    let good = parsed(GOOD);
    let (camera, samples) = (camera_of(&good), parsed(SHAPES));
    let (mut made, mut refused) = (0, 0);
    for shape in samples.entities().filter_map(|id| samples.shape(id)) {
        for (field, value) in variants(&shape.values()) {
            let Ok(odd) = shape.with(field, value.clone()) else {
                refused += 1;
                continue;
            };
            made += 1;
            let mut scene = good.clone();
            scene.add_shape("odd", odd, material(&good), None).expect("a shape that was made");
            assert_sound(&scene, &camera, &format!("{} with {field} {value:?}", shape.kind_name()));
        }
    }
    assert!(made > 100 && refused > 100, "{made} made and {refused} refused");
}

#[test]
fn no_light_puts_out_the_others() {
    let good = parsed(GOOD);
    let camera = camera_of(&good);
    let lights = parsed(
        r#"
        point-light "point" { position 1 4 3; intensity 3 3 3 }
        spot-light "spot" { position 1 4 3; direction -1 -3 -3; intensity 3 3 3; inner 20; outer 40 }
        directional-light "sun" { direction -1 -3 -2; irradiance 1 1 1 }
        ambient-light "more" { radiance 0.1 0.1 0.1 }
        "#,
    );
    for light in lights.entities().filter_map(|id| lights.light(id)) {
        for (field, value) in variants(&light.values()) {
            let Ok(odd) = light.with(field, value.clone()) else { continue };
            let mut scene = good.clone();
            scene.add_light("odd", odd, None).expect("a light that was made");
            let what = format!("{} with {field} {value:?}", light.kind_name());
            assert_ball(&scene, &assert_sound(&scene, &camera, &what), &what);
        }
    }
}

#[test]
fn no_material_spoils_what_it_is_not_on() {
    let good = parsed(GOOD);
    let camera = camera_of(&good);
    for kind in Material::KINDS {
        let color = |field: &Field| match field.name {
            "scale" | "range" => Value::Number(2.0),
            _ => Value::Color(Rgb::grey(0.4)),
        };
        let required =
            kind.fields.iter().filter(|field| !field.may_be_missing).map(|field| (field.name, color(field)));
        let values = required.fold(Values::new(), |values, (name, value)| values.with(name, value));
        let plain = (kind.make)(&values).expect("a material");
        for (field, value) in variants(&plain.values()) {
            let Ok(odd) = plain.with(field, value.clone()) else { continue };
            let mut scene = good.clone();
            let odd = scene.add_material("odd", odd).expect("a material that was made");
            let floor = catoptra_core::geometry::Plane::new(DVec3::ZERO, DVec3::Y).expect("a plane");
            scene.add_shape("floor", floor, odd, None).expect("a floor");
            let what = format!("{} with {field} {value:?}", kind.name);
            assert_ball(&scene, &assert_sound(&scene, &camera, &what), &what);
        }
    }
}

#[test]
fn no_camera_sees_anything_but_numbers() {
    let scene = parsed(GOOD);
    let plain = camera_of(&scene);
    let mut made = 0;
    for (field, value) in variants(&catoptra_core::Part::values(&plain)) {
        let values = catoptra_core::Part::values(&plain).with(field, value.clone());
        if let Ok(camera) = (Camera::KIND.make)(&values) {
            made += 1;
            assert_sound(&scene, &camera, &format!("camera with {field} {value:?}"));
        }
    }
    assert!(made > 20, "{made}");
}

#[test]
fn scene_text_with_strange_numbers_is_refused_or_drawn() {
    let numbers =
        ["0", "-0.0", "1e-400", "5e-324", "1e-40", "1e38", "-1e38", "1e39", "1e999", "#nan", "#inf", "#-inf"];
    let (mut drawn, mut refused) = (0, 0);
    for number in numbers {
        for odd in [
            format!("sphere \"odd\" material=\"grey\" {{ center {number} 1 -2; radius 1 }}"),
            format!("sphere \"odd\" material=\"grey\" {{ center 0 1 -2; radius {number} }}"),
            format!("triangle \"odd\" material=\"grey\" {{ a 0 0 0; b {number} 0 0; c 0 {number} 0 }}"),
            format!("box \"odd\" material=\"grey\" {{ min -1 -1 -9; max {number} 0 {number} }}"),
            format!("plane \"odd\" material=\"grey\" {{ point 0 {number} 0; normal 0 {number} 1 }}"),
            format!("point-light \"odd\" {{ position 0 {number} 0; intensity {number} 1 1 }}"),
            format!("group \"odd\" {{ move 0 {number} 0; sphere \"in\" material=\"grey\" {{ radius 1 }} }}"),
            format!(
                "group \"odd\" {{ scale {number}; sphere \"in\" material=\"grey\" {{ center 3 3 3; radius 1 }} }}"
            ),
            format!(
                "group \"odd\" {{ turn {number} 0 {number} 1; box \"in\" material=\"grey\" {{ min 2 2 2; max 3 3 3 }} }}"
            ),
            format!("checker \"odd\" {{ scale {number} }}\nplane \"floor\" material=\"odd\""),
        ] {
            match catoptra_scene::parse(&format!("{GOOD}\n{odd}"), "hostile", None) {
                Ok((scene, _)) => {
                    drawn += 1;
                    assert_sound(&scene, &camera_of(&scene), &odd);
                }
                Err(_) => refused += 1,
            }
        }
    }
    assert!(drawn > 20 && refused > 20, "{drawn} drawn and {refused} refused");
}

#[test]
fn of_coincident_surfaces_the_first_is_seen() {
    let twice = |shape: &str| {
        format!("{GOOD}\n{}\n{}", shape.replace("NAME", "first"), shape.replace("NAME", "second"))
    };
    for shape in [
        "sphere \"NAME\" material=\"grey\" { center 0.3 1 2; radius 1.1 }",
        "rectangle \"NAME\" material=\"grey\" { corner -2 -1 2; edge-u 4 0 1; edge-v 0 4 0 }",
        "box \"NAME\" material=\"grey\" { min -1 0 1; max 1 2 2 }",
        "plane \"NAME\" material=\"grey\" { point 0 0 2; normal 0.2 0.1 1 }",
        "triangle \"NAME\" material=\"grey\" { a -3 -1 2; b 3 -1 2; c 0 4 2.5 }",
    ] {
        let scene = parsed(&twice(shape));
        let film = assert_sound(&scene, &camera_of(&scene), shape);
        let alone = parsed(&format!("{GOOD}\n{}", shape.replace("NAME", "first")));
        let alone = picture(&alone, camera_of(&alone), "wide");
        for (x, y) in (0..SIZE.height).flat_map(|y| (0..SIZE.width).map(move |x| (x, y))) {
            assert_eq!(film.surface(x, y), alone.surface(x, y), "{shape} at {x},{y}");
        }
    }
}

#[test]
fn a_mesh_of_nothing_but_degenerate_triangles_hides_nothing() {
    let positions =
        vec![[0.0, 1.0, 2.0], [1.0, 1.0, 2.0], [2.0, 1.0, 2.0], [0.0, 1.0, 2.0], [1e38, -1e38, 1e38]];
    let triangles = vec![[0, 1, 2], [0, 0, 0], [0, 3, 1], [1, 1, 4], [4, 4, 4]];
    let mesh = catoptra_core::TriangleMesh::new(positions, triangles, None, None).expect("a mesh");
    let source = catoptra_core::MeshSource { path: "flat".to_owned(), mesh: std::sync::Arc::new(mesh) };
    let mut scene = parsed(GOOD);
    let grey = material(&scene);
    let mesh = Shape::from(catoptra_core::geometry::Mesh::new(source));
    scene.add_shape("flat", mesh, grey, None).expect("a shape");
    let film = assert_sound(&scene, &camera_of(&scene), "a flat mesh");
    assert_ball(&scene, &film, "a flat mesh");
}

#[test]
fn a_light_too_bright_for_any_number_is_white_and_not_black() {
    let scene =
        parsed(&format!("{GOOD}\npoint-light \"nova\" {{ position 0 1 1.5; intensity 3e38 3e38 3e38 }}"));
    for backend in ["wide", "scalar", "oracle"] {
        let film = picture(&scene, camera_of(&scene), backend);
        let light = film.radiance(SIZE.width / 2, SIZE.height / 2);
        assert!(light.iter().all(|light| *light > 1e30), "{backend}: {light:?}");
    }
}

#[test]
fn light_past_every_number_is_the_same_by_every_backend_however_many_samples_it_takes() {
    let nova = |i| format!("point-light \"nova {i}\" {{ position 0 1 1.5; intensity 3e38 3e38 3e38 }}");
    let scene = parsed(&format!("{GOOD}\n{}", (0..40).map(nova).collect::<Vec<_>>().join("\n")));
    for samples in [1, 5] {
        let view = View { samples, moments: Moments::Luminance, ..View::of(&scene, camera_of(&scene), SIZE) };
        for backend in ["wide", "scalar", "oracle"] {
            let film = traced(&scene, backend, &view, Film::new(SIZE), 1);
            let (x, y) = (SIZE.width / 2, SIZE.height / 2);
            assert_eq!(film.radiance(x, y), [f32::MAX; 3], "{backend}, {samples} samples");
            assert!(film.standard_error(x, y).is_none_or(f32::is_finite), "{backend}, {samples} samples");
        }
    }
}
