//! Does a field of many rows change row by row?

use catoptra_core::scene::Edit;
use catoptra_core::{Rows, Value};
use catoptra_scene::{SceneFile, parse};

use super::{contents, id};

const TEXT: &str = r#"matte "white" { color 1 }
prism "corner" material="white" {
    point 0 0       // here it starts
    point 3.0 0
    point 3 1; point 1 1
    height 2        // high
    point 1 3
    point 0 3
}
polyhedron "cut" material="white" {
    plane 1 0 0 1
    plane -1 0 0 1
    plane 0 1 0 1
    plane 0 -1 0 1
    plane 0 0 1 1
    plane 0 0 -1 1
}
"#;

/// The text once a shape's rows are these.
fn with_rows<const N: usize>(name: &str, field: &'static str, rows: &[[f64; N]]) -> String {
    let (mut scene, mut file) = parse(TEXT, "rows.kdl", None).unwrap();
    let shape = scene.shape(id(&scene, name)).unwrap();
    let shape = shape.with(field, Value::Rows(Rows::of(rows.iter().copied()))).unwrap();
    scene.apply(Edit::Shape(id(&scene, name), shape)).unwrap();
    file.update(&scene);
    let text = file.text();
    let (again, _) =
        parse(&text, "again.kdl", None).unwrap_or_else(|e| panic!("{:?}", miette::Report::new(e)));
    assert_eq!(contents(&again), contents(&scene), "{text}");
    text
}

#[test]
fn rows_are_read_in_their_order_and_written_so() {
    let (scene, _) = parse(TEXT, "rows.kdl", None).unwrap();
    let values = scene.shape(id(&scene, "corner")).unwrap().values();
    let right = [[0.0, 0.0], [3.0, 0.0], [3.0, 1.0], [1.0, 1.0], [1.0, 3.0], [0.0, 3.0]];
    assert_eq!(values.get("point"), Some(&Value::Rows(Rows::of(right))));
    let text = SceneFile::new(&scene).text();
    assert!(text.contains("    point 3 1\n    point 1 1\n"), "{text}");
}

#[test]
fn a_changed_row_changes_alone() {
    let rows = [[0.0, 0.0], [3.0, 0.5], [3.0, 1.0], [1.0, 1.0], [1.0, 3.0], [0.0, 3.0]];
    assert_eq!(with_rows("corner", "point", &rows), TEXT.replace("point 3.0 0", "point 3.0 0.5"));
}

#[test]
fn rows_are_added_at_the_end_and_taken_away_there() {
    let rows = [[0.0, 0.0], [3.0, 0.0], [3.0, 1.0], [1.0, 1.0], [1.0, 3.0], [0.0, 3.0], [-1.0, 1.5]];
    let longer = with_rows("corner", "point", &rows);
    assert_eq!(longer, TEXT.replace("    point 0 3\n", "    point 0 3\n    point -1 1.5\n"));
    assert_eq!(with_rows("corner", "point", &rows[..5]), TEXT.replace("    point 0 3\n", ""));
}

#[test]
fn planes_become_points() {
    let text = with_rows("cut", "point", &[[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]);
    assert!(
        text.ends_with("{\n    point 0 0 0\n    point 1 0 0\n    point 0 1 0\n    point 0 0 1\n}\n"),
        "{text}"
    );
}

#[test]
fn a_row_that_is_too_short_is_told_at_its_place() {
    let error = parse(&TEXT.replace("point 1 1", "point 1"), "rows.kdl", None).unwrap_err();
    let report = format!("{:?}", miette::Report::new(error));
    assert!(report.contains("point takes two numbers, not 1 value"), "{report}");
    let crossing = TEXT.replace("point 1 1", "point 4 -1");
    let error = parse(&crossing, "rows.kdl", None).unwrap_err();
    let report = error.to_string();
    assert!(report.contains("edge 2 from 3 0 to 3 1 that meets edge 4 from 4 -1 to 1 3"), "{report}");
}
