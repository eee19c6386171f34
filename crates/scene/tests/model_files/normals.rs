//! Where is outside, and what is smooth?

use std::fmt::Write;

use catoptra_core::geometry::{Geometry, Mesh};
use catoptra_core::glam::DVec3;
use catoptra_core::{MeshSource, Ray, Span, TriangleMesh};

use crate::{mesh, model, shape};

/// A ball of latitude and longitude; faces with `against` are wound against the normals, which point outwards.
fn ball(against: bool) -> String {
    let (rows, columns) = (12, 24);
    let mut text = String::new();
    for row in 0..=rows {
        for column in 0..columns {
            let (up, round) = (f64::from(row) / f64::from(rows), f64::from(column) / f64::from(columns));
            let (tilt, turn) = (std::f64::consts::PI * up, std::f64::consts::TAU * round);
            let [x, y, z] = [tilt.sin() * turn.cos(), tilt.cos(), tilt.sin() * turn.sin()];
            writeln!(text, "v {x} {y} {z}\nvn {x} {y} {z}").unwrap();
        }
    }
    for row in 0..rows {
        for column in 0..columns {
            let corner = |row, column| row * columns + column % columns + 1;
            let [a, b] = [corner(row, column), corner(row, column + 1)];
            let [c, d] = [corner(row + 1, column + 1), corner(row + 1, column)];
            let order = if against { [a, d, c, b] } else { [a, b, c, d] };
            let words: Vec<String> = order.iter().map(|i| format!("{i}//{i}")).collect();
            writeln!(text, "f {}", words.join(" ")).unwrap();
        }
    }
    text
}

/// What a ray down onto a ball off its middle sees: the geometric and the shading normal.
fn seen(mesh: TriangleMesh) -> [DVec3; 2] {
    let mesh = Mesh::new(MeshSource { path: String::new(), mesh: mesh.into() });
    let ray = Ray::new(DVec3::new(0.3, 5.0, 0.2), -DVec3::Y);
    let crossing = mesh.cross(&ray, Span::AHEAD, None).unwrap();
    [crossing.normal, crossing.shading_normal]
}

#[test]
fn a_ball_wound_against_its_normals_faces_outwards() {
    for against in [false, true] {
        let [normal, shading] = seen(mesh(ball(against).as_bytes(), "ball.obj"));
        let outwards = DVec3::new(0.3, (1.0_f64 - 0.13).sqrt(), 0.2);
        assert!(normal.dot(outwards) > 0.98, "{normal}");
        assert!(shading.dot(outwards) > 0.9999, "{shading}");
    }
}

#[test]
fn a_face_without_normals_leaves_the_others_smooth() {
    let floor = "v -5 -1 5\nv 5 -1 5\nv 0 -1 -5\n";
    for part in ["", "o floor\n", "usemtl floor\n"] {
        let text = format!("{}{floor}{part}f -3 -2 -1\n", ball(false));
        let all = mesh(text.as_bytes(), "a.obj");
        assert_eq!(seen(all.clone()), seen(mesh(ball(false).as_bytes(), "a.obj")));
        let last = all.triangles().len() as u32 - 1;
        for corner in all.triangles()[last as usize] {
            assert_eq!(all.normals().unwrap()[corner as usize], [0.0, 1.0, 0.0], "{part}");
        }
    }
}

/// Two sides of a roof and its floor, with a smoothing group for each.
fn roof(groups: [&str; 3]) -> Vec<u8> {
    let [left, right, floor] = groups;
    format!(
        "v -1 0 1\nv -1 0 -1\nv 0 1 -1\nv 0 1 1\nv 1 0 1\nv 1 0 -1\ns {left}\nf 1 4 3 2\ns {right}\nf 4 5 6 3\n\
         s {floor}\nf 1 2 6 5\n"
    )
    .into_bytes()
}

/// The normals of the corners at the ridge, by sides: the first two faces.
fn ridge(mesh: &TriangleMesh) -> Vec<[f32; 3]> {
    let at_ridge = |corner: &&u32| mesh.positions()[**corner as usize][1] == 1.0;
    let normals = mesh.normals().unwrap();
    mesh.triangles()[..4].iter().flatten().filter(at_ridge).map(|&corner| normals[corner as usize]).collect()
}

#[test]
fn smoothing_groups_are_smooth_within_and_sharp_between() {
    let smooth = mesh(&roof(["1", "1", "off"]), "a.obj");
    for normal in ridge(&smooth) {
        assert!((DVec3::from(normal.map(f64::from)) - DVec3::Y).length() < 1e-6, "{normal:?}");
    }
    let half = std::f32::consts::FRAC_1_SQRT_2;
    for groups in [["1", "2", "off"], ["1", "off", "0"]] {
        for normal in ridge(&mesh(&roof(groups), "a.obj")) {
            assert!((normal[1] - half).abs() < 1e-6 && (normal[0].abs() - half).abs() < 1e-6, "{normal:?}");
        }
    }
    for groups in [["off", "0", "off"], ["off", "off", ""]] {
        assert_eq!(mesh(&roof(groups), "a.obj").normals(), None);
    }
}

#[test]
fn normals_of_a_file_stand_before_those_of_groups() {
    let text = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvn 0 0.6 0.8\ns 1\nf 1//1 2 3\nf 1 3 4//1\n";
    let mesh = mesh(text.as_bytes(), "a.obj");
    let normals = mesh.normals().unwrap();
    let of = |triangle: usize, corner: usize| normals[mesh.triangles()[triangle][corner] as usize];
    assert_eq!(
        [of(0, 0), of(0, 1), of(1, 0), of(1, 2)],
        [[0.0, 0.6, 0.8], [0.0, 0.0, 1.0], [0.0, 0.0, 1.0], [0.0, 0.6, 0.8]]
    );
}

#[test]
fn normals_of_any_length_count_alike() {
    let text = "v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 0 0 100\nvn 0 3 4\nf 1//1 2//2 3//2\n";
    let read = mesh(text.as_bytes(), "a.obj");
    assert_eq!(read.normals(), Some(&[[0.0, 0.0, 1.0], [0.0, 0.6, 0.8], [0.0, 0.6, 0.8]][..]));
    let flat = model(b"v 0 0 0\nv 1 0 0\nv 0 1 0\nvn nan 0 0\nf 1//1 2//1 3//1\n", "a.obj");
    assert_eq!(shape(&flat.nodes[0]).0.normals(), None);
}
