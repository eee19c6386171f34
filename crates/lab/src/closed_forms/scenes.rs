//! The scenes of known light, one function each.

use std::f64::consts::PI;

use catoptra_core::glam::DVec3;

use super::sweep::{Between, Flat, as_disk, irradiance};
use super::{ClosedForm, KnownLight, swept};

/// All of them.
pub(super) fn all() -> Vec<ClosedForm> {
    let mut forms = vec![lamp_in_a_room(), bright_floor(), bright_wall(), disk_behind_disk(), window()];
    forms.extend(balls_under_a_lamp());
    forms.extend(shining_balls());
    forms.extend(coincident_edges());
    forms
}

const fn v(x: f64, y: f64, z: f64) -> DVec3 {
    DVec3::new(x, y, z)
}

const BLACK: &str = "matte \"black\" { color 0 }\n";

/// The walls, floor and ceiling of a room 4 x 3 x 4, without those that are left out.
pub(super) fn room(without: &[&str]) -> String {
    let walls = [
        ("floor", "corner 0 0 0; edge-u 0 0 4; edge-v 4 0 0"),
        ("ceiling", "corner 0 3 0; edge-u 4 0 0; edge-v 0 0 4"),
        ("front", "corner 0 0 0; edge-u 4 0 0; edge-v 0 3 0"),
        ("back", "corner 0 0 4; edge-u 4 0 0; edge-v 0 3 0"),
        ("left", "corner 0 0 0; edge-u 0 0 4; edge-v 0 3 0"),
        ("right", "corner 4 0 0; edge-u 0 0 4; edge-v 0 3 0"),
    ];
    let wall =
        |(name, place): (&str, &str)| format!("rectangle \"{name}\" material=\"black\" {{ {place} }}\n");
    let walls = walls.into_iter().filter(|(name, _)| !without.contains(name)).map(wall);
    format!("{BLACK}{}", walls.collect::<String>())
}

fn parallelogram(corner: DVec3, u: DVec3, v: DVec3) -> Flat {
    Flat::Parallelogram(corner, [u, v])
}

/// A lamp as it is written in a scene.
fn written(lamp: &Flat, radiance: f64) -> String {
    let vector = |v: DVec3| format!("{} {} {}", v.x, v.y, v.z);
    match lamp {
        Flat::Parallelogram(corner, [u, v]) => format!(
            "rectangle-light \"lamp\" {{ corner {}; edge-u {}; edge-v {}; radiance {radiance} }}\n",
            vector(*corner),
            vector(*u),
            vector(*v)
        ),
        Flat::Disk(center, normal, radius) => format!(
            "disk-light \"lamp\" {{ center {}; normal {}; radius {radius}; radiance {radiance} }}\n",
            vector(*center),
            vector(*normal)
        ),
    }
}

fn lamp_in_a_room() -> ClosedForm {
    let lamp = parallelogram(v(1.5, 3.0, 1.5), v(1.0, 0.0, 0.0), v(0.0, 0.0, 1.0));
    let wall = [2.75, 2.25, 1.75, 1.25, 0.75, 0.25].map(|y| (v(2.0, y, 0.0), DVec3::Z));
    let floor = [0.25, 0.75, 1.25, 1.75].map(|z| (v(2.0, 0.0, z), DVec3::Y));
    swept(
        "A lamp flush with the ceiling of a black room (CIE 171, 5.3)",
        room(&[]) + &written(&lamp, 1000.0),
        1000.0,
        |_| lamp,
        &[],
        &[&wall[..], &floor].concat(),
    )
}

fn bright_floor() -> ClosedForm {
    let lamp = parallelogram(DVec3::ZERO, v(0.0, 0.0, 4.0), v(4.0, 0.0, 0.0));
    let wall = [0.75, 1.25, 1.75, 2.25, 2.75].map(|y| (v(2.0, y, 0.0), DVec3::Z));
    let ceiling = [0.25, 0.75, 1.25, 1.75].map(|z| (v(2.0, 3.0, z), DVec3::NEG_Y));
    swept(
        "A floor that shines, its edge on the horizon of a wall (CIE 171, 5.6)",
        room(&["floor"]) + &written(&lamp, 1.0 / PI),
        1.0 / PI,
        |_| lamp,
        &[],
        &[&wall[..], &ceiling].concat(),
    )
}

fn bright_wall() -> ClosedForm {
    let lamp = parallelogram(v(0.0, 0.0, 4.0), v(0.0, 3.0, 0.0), v(4.0, 0.0, 0.0));
    let [low, high] = [v(0.0, 0.0, 2.5), v(4.0, 1.0, 2.7)];
    let at = [2.75, 2.25, 1.75, 1.25, 0.75, 0.25].map(|y| (v(2.0, y, 0.0), DVec3::Z));
    swept(
        "A wall that shines past a box between two walls (CIE 171, 5.7)",
        room(&["back"])
            + &written(&lamp, 1.0 / PI)
            + "box \"box\" material=\"black\" { min 0 0 2.5; max 4 1 2.7 }\n",
        1.0 / PI,
        |_| lamp,
        &faces(low, high),
        &at,
    )
}

/// The faces of a box.
fn faces(low: DVec3, high: DVec3) -> Vec<Between> {
    let face = |axis: usize, upper: bool| {
        let corner = |a: bool, b: bool| {
            let mut p = if upper { high } else { low };
            let [i, j] = [(axis + 1) % 3, (axis + 2) % 3];
            p[i] = if a { high[i] } else { low[i] };
            p[j] = if b { high[j] } else { low[j] };
            p
        };
        Between::Polygon(vec![
            corner(false, false),
            corner(true, false),
            corner(true, true),
            corner(false, true),
        ])
    };
    (0..3).flat_map(|axis| [face(axis, false), face(axis, true)]).collect()
}

const GROUND: &str = "plane \"floor\" material=\"black\"\n";

/// Balls as they are written, and as they stand between.
fn balls(list: &[(DVec3, f64)]) -> (String, Vec<Between>) {
    let text = |(i, (c, radius)): (usize, &(DVec3, f64))| {
        format!(
            "sphere \"ball {i}\" material=\"black\" {{ center {} {} {}; radius {radius} }}\n",
            c.x, c.y, c.z
        )
    };
    let between = list.iter().map(|(center, radius)| Between::Ball(*center, *radius));
    (list.iter().enumerate().map(text).collect(), between.collect())
}

fn on_the_floor(places: &[[f64; 2]]) -> Vec<(DVec3, DVec3)> {
    places.iter().map(|[x, z]| (v(*x, 0.0, *z), DVec3::Y)).collect()
}

fn balls_under_a_lamp() -> Vec<ClosedForm> {
    let lamp = parallelogram(v(-5.0, 12.0, -5.0), v(10.0, 0.0, 0.0), v(0.0, 0.0, 10.0));
    let scene = |more: &str| format!("{BLACK}{GROUND}{}{more}", written(&lamp, 4.0));
    let large = (v(0.0, 3.0, 0.0), 3.0);
    let (one, before) = balls(&[large]);
    let (three, all) = balls(&[large, (v(2.5, 6.0, 1.0), 1.5), (v(-1.0, 7.0, 2.0), 1.0)]);
    let (small, mut mixed) = balls(&[(v(1.0, 8.0, 1.0), 1.2)]);
    let square = "rectangle \"square\" material=\"black\" { corner -2 5 -2; edge-u 4 0 0; edge-v 0 0 4 }\n";
    mixed.push(Between::Polygon(
        [[-2.0, -2.0], [2.0, -2.0], [2.0, 2.0], [-2.0, 2.0]].map(|[x, z]| v(x, 5.0, z)).to_vec(),
    ));
    let places = [[4.0, 0.0], [4.0, 4.0], [7.0, 0.0], [9.0, -3.0], [2.0, 0.0]];
    vec![
        swept("A ball before a lamp", scene(&one), 4.0, |_| lamp, &before, &on_the_floor(&places)),
        swept(
            "Three balls before a lamp",
            scene(&three),
            4.0,
            |_| lamp,
            &all,
            &on_the_floor(&[[4.0, 4.0], [-3.0, 3.5], [5.0, -1.0], [2.0, 0.0]]),
        ),
        swept(
            "A square and a ball before a lamp",
            scene(&(square.to_owned() + &small)),
            4.0,
            |_| lamp,
            &mixed,
            &on_the_floor(&[[0.0, 0.0], [3.0, 0.0], [3.0, 3.0], [5.0, 1.0]]),
        ),
    ]
}

fn shining_balls() -> Vec<ClosedForm> {
    let (center, radius) = (v(0.0, 2.0, 0.0), 0.5);
    let lamp = "sphere-light \"lamp\" { center 0 2 0; radius 0.5; radiance 1 }\n";
    let mut at = on_the_floor(&[[0.0, 0.0], [1.0, 0.0], [3.0, 0.0]]);
    at.push((v(-2.0, 2.3, 0.0), DVec3::Y));
    let (ball, before) = balls(&[(v(0.4, 1.0, 0.0), 0.4)]);
    let below = on_the_floor(&[[0.0, 0.0], [-0.5, 0.0], [0.3, 0.3], [0.9, 0.0]]);
    let seen = |point| as_disk(point, center, radius);
    vec![
        swept("A ball that shines", format!("{BLACK}{GROUND}{lamp}"), 1.0, seen, &[], &at),
        swept(
            "A lamp that is a ball, behind a ball",
            format!("{BLACK}{GROUND}{lamp}{ball}"),
            1.0,
            seen,
            &before,
            &below,
        ),
    ]
}

fn disk_behind_disk() -> ClosedForm {
    let lamp = Flat::Disk(v(0.0, 3.0, 0.0), DVec3::NEG_Y, 2.0);
    let disk = "disk \"disk\" material=\"black\" { center 0 1.5 0; normal 0 1 0; radius 0.5 }\n";
    let mut form = swept(
        "A disk behind a disk, on the axis and beside it",
        format!("{BLACK}{GROUND}{}{disk}", written(&lamp, 1.0)),
        1.0,
        |_| lamp,
        &[Between::Disk(v(0.0, 1.5, 0.0), DVec3::Y, 0.5)],
        &on_the_floor(&[[0.0, 0.0], [0.4, 0.0], [1.0, 0.5], [1.7, 0.0], [3.5, 0.0]]),
    );
    // On the axis: π (sin² of half the lamp's angle less that of the disk's).
    form.points[0].irradiance = PI * (4.0 / 13.0 - 0.25 / 2.5);
    form
}

fn window() -> ClosedForm {
    let opening = parallelogram(v(0.0, 0.8, 1.0), v(0.0, 1.5, 0.0), v(0.0, 0.0, 2.0));
    let at = [0.5, 1.5, 2.5, 3.5].map(|x| (v(x, 0.0, 1.3), DVec3::Y));
    let wall = (v(4.0, 1.0, 0.7), DVec3::NEG_X);
    let frame = [
        "corner 0 0 0; edge-u 0 0 4; edge-v 0 0.8 0",
        "corner 0 2.3 0; edge-u 0 0 4; edge-v 0 0.7 0",
        "corner 0 0.8 0; edge-u 0 0 1; edge-v 0 1.5 0",
        "corner 0 0.8 3; edge-u 0 0 1; edge-v 0 1.5 0",
    ];
    let piece =
        |(i, place): (usize, &&str)| format!("rectangle \"frame {i}\" material=\"black\" {{ {place} }}\n");
    let frame: String = frame.iter().enumerate().map(piece).collect();
    swept(
        "An even sky through a window, as a lamp in the opening",
        room(&["left"]) + &written(&opening, 2000.0) + &frame,
        2000.0,
        |_| opening,
        &[],
        &[&at[..], &[wall]].concat(),
    )
}

/// Blockers half way to a lamp, with edges that look like its own.
fn coincident_edges() -> Vec<ClosedForm> {
    let (point, lamp) =
        (v(0.3, 0.0, 0.2), parallelogram(v(-1.0, 3.0, -1.0), v(2.0, 0.0, 0.0), v(0.0, 0.0, 2.0)));
    let piece = |name: &str, x: f64, width: f64| {
        format!(
            "rectangle \"{name}\" material=\"black\" {{ corner {x} 1.5 -0.4; edge-u {width} 0 0; edge-v 0 0 1 }}\n"
        )
    };
    let half = vec![[-0.35, -0.4], [0.15, -0.4], [0.15, 0.6], [-0.35, 0.6]];
    let half = Between::Polygon(half.into_iter().map(|[x, z]| v(x, 1.5, z)).collect());
    let seen = |between: &[Between]| irradiance(point, DVec3::Y, &lamp, between);
    let [open, past_half] = [seen(&[]), seen(&[half])];
    let form = |title, blockers: String, irradiance| ClosedForm {
        title,
        scene: format!("{BLACK}{}{blockers}", written(&lamp, 1.0)),
        radiance: 1.0,
        points: vec![KnownLight { point, normal: DVec3::Y, irradiance }],
    };
    vec![
        form(
            "Two halves that share an edge cover a lamp",
            piece("a", -0.35, 0.5) + &piece("b", 0.15, 0.5),
            0.0,
        ),
        form("A half of a lamp covered twice", piece("a", -0.35, 0.5) + &piece("b", -0.35, 0.5), past_half),
        form("A lamp covered by its own outline", piece("a", -0.35, 1.0), 0.0),
        form("A neighbour that shares a lamp's edge", piece("a", 0.65, 1.0), open),
    ]
}
