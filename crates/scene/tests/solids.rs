//! Are solids read and saved whatever closed shapes are among their members, and is it told which mesh is not closed?
#![allow(clippy::unwrap_used, reason = "a test may stop at the first surprise")]

use std::path::Path;

use catoptra_core::glam::DVec3;
use catoptra_core::scene::Edit;
use catoptra_core::{Operation, Placement, Scene, Solid};
use catoptra_scene::{SceneFile, SceneTextError, parse};

const MATERIAL: &str = "matte \"w\" { color 1 }\n";

/// A tetrahedron as an OBJ file, with these of its faces.
fn obj(faces: &str) -> String {
    format!("v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n{faces}")
}

const CLOSED: &str = "f 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n";

fn read(text: &str, faces: &str) -> Result<(Scene, SceneFile), SceneTextError> {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("rock.obj"), obj(faces)).unwrap();
    parse(&format!("{MATERIAL}{text}"), "solids.kdl", Some(folder.path()))
}

const CARVED: &str = "difference \"carved\" {\n    mesh \"rock\" material=\"w\" { file \"rock.obj\" }\n    \
    torus \"groove\" material=\"w\" { major 0.5; minor 0.1 } // all round\n    \
    prism \"notch\" material=\"w\" { point 0 0; point 3 0; point 3 1; point 1 1; point 1 3; point 0 3; height 2 }\n}\n";

fn solid_of(scene: &Scene) -> Solid {
    let [placed] = <[_; 1]>::try_from(scene.world_solids()).unwrap();
    placed.solid
}

#[test]
fn rings_concave_prisms_and_closed_meshes_are_members_and_saved() {
    let (mut scene, mut file) = read(CARVED, CLOSED).unwrap();
    assert_eq!(solid_of(&scene).shapes().len(), 3);
    let [carved, groove] = ["carved", "groove"].map(|name| scene.entity_named(name).unwrap());
    assert_eq!(scene.operation(carved), Some(Operation::Difference));
    file.update(&scene);
    assert_eq!(file.text(), format!("{MATERIAL}{CARVED}"));
    let up = Placement::IDENTITY.moved(DVec3::Y * 0.25).unwrap();
    scene.apply(Edit::Placement(groove, up)).unwrap();
    scene.apply(Edit::Operation(carved, Operation::Union)).unwrap();
    file.update(&scene);
    let text = file.text();
    assert!(text.contains("union \"carved\" {") && text.contains("move 0 0.25 0"), "{text}");
    assert!(text.contains("// all round"), "{text}");
    let (again, _) = read(text.strip_prefix(MATERIAL).unwrap(), CLOSED).unwrap();
    assert_eq!(solid_of(&again), solid_of(&scene));
}

/// Line and column, the message and the hint of the only complaint.
fn refused(text: &str, faces: &str) -> (usize, usize, String, String) {
    let Err(error) = read(text, faces) else { panic!("was read: {text}") };
    let [complaint] = error.complaints() else { panic!("{error}") };
    assert_eq!(error.file(), Path::new("solids.kdl"));
    let hint = complaint.hint().unwrap_or_default().to_owned();
    (complaint.line(), complaint.column(), complaint.message().to_owned(), hint)
}

#[test]
fn a_mesh_that_is_not_closed_is_refused_with_what_to_do() {
    let hole = CLOSED.strip_suffix("f 3 1 4\n").unwrap();
    let (line, column, message, hint) = refused(CARVED, hole);
    assert_eq!((line, column), (3, 10));
    assert_eq!(
        message,
        "\"rock\" cannot be a part of the solid \"carved\": its mesh is not closed, as 3 of its edges are open: \
         that from 0 0 0 to 0 1 0 belongs to one triangle alone"
    );
    assert!(hint.contains("fill its holes"), "{hint}");
    // A face that looks inwards.
    let (.., message, hint) = refused(CARVED, &CLOSED.replace("f 3 1 4", "f 1 3 4"));
    assert!(message.contains("2 triangles that run along it the same way"), "{message}");
    assert!(hint.contains("turn all its faces outwards"), "{hint}");
}

#[test]
fn what_encloses_nothing_is_refused_with_what_to_do() {
    let (line, column, message, hint) = refused(
        "union \"u\" {\n  sphere \"s\" material=\"w\" { radius 1 }\n  disk \"d\" material=\"w\" { radius 1 }\n}",
        "",
    );
    assert_eq!((line, column), (4, 8));
    assert!(message.ends_with("only planes, closed shapes and other solids can"), "{message}");
    assert!(hint.contains("beside the solid"), "{hint}");
}
