//! Where do pictures go whose names are not given, or that are many, and is nothing written over that is in use?

use std::fs;
use std::path::Path;

use catoptra_scene::image::read_png;

use crate::program::{Ran, assert_refused, catoptra, files, folder};

fn run(folder: &Path, line: &str) -> Ran {
    catoptra(folder, &line.split_whitespace().collect::<Vec<_>>())
}

/// Runs a line that must succeed; what it says on standard error.
#[track_caller]
fn done(folder: &Path, line: &str) -> String {
    let ran = run(folder, line);
    assert_eq!((ran.code, ran.out.as_str()), (0, ""), "{line}\n{}", ran.err);
    ran.err
}

#[track_caller]
fn refused(folder: &Path, line: &str, words: &[&str]) {
    assert_refused(folder, &line.split_whitespace().collect::<Vec<_>>(), words);
}

#[test]
fn a_picture_without_a_name_has_that_of_its_scene_and_spares_what_is_there() {
    let folder = folder();
    let folder = folder.path();
    assert_eq!(done(folder, "render scene.kdl --size 12x9"), "wrote scene.png\n");
    let first = fs::read(folder.join("scene.png")).unwrap();
    refused(folder, "render scene.kdl --size 8x8", &["scene.png is there already", "--force", "--output"]);
    assert_eq!(fs::read(folder.join("scene.png")).unwrap(), first);
    done(folder, "render scene.kdl --size 8x8 --force");
    assert_eq!(read_png(&folder.join("scene.png")).unwrap().width(), 8);
    done(folder, "render scene.kdl --size 8x8 --format exr");
    fs::create_dir(folder.join("in")).unwrap();
    fs::rename(folder.join("scene.kdl"), folder.join("in/room.kdl")).unwrap();
    done(folder, "render in/room.kdl --size 8x8");
    assert_eq!(files(folder), ["in", "room.png", "scene.exr", "scene.png"]);
}

#[test]
fn several_scenes_cameras_and_frames_have_names_of_their_own() {
    let folder = folder();
    let folder = folder.path();
    fs::copy(folder.join("scene.kdl"), folder.join("b.kdl")).unwrap();
    done(folder, "render scene.kdl b.kdl --size 8x6 -q");
    done(folder, "render scene.kdl --camera all --size 8x6");
    done(folder, "render b.kdl --camera all --frames 2 --turn 90 0 1 0 --size 8x6");
    done(folder, "render scene.kdl -o {frame}.{camera}.png --frames 2 --turn 90 0 1 0 --size 8x6");
    let there = [
        "0001.front.png",
        "0002.front.png",
        "b-above-0001.png",
        "b-above-0002.png",
        "b-front-0001.png",
        "b-front-0002.png",
        "b.kdl",
        "b.png",
        "scene-above.png",
        "scene-front.png",
        "scene.kdl",
        "scene.png",
    ];
    assert_eq!(files(folder), there);
    let read = |name: &str| fs::read(folder.join(name)).unwrap();
    assert_eq!(read("scene.png"), read("scene-front.png"));
    assert_eq!(read("scene.png"), read("0001.front.png"));
    assert_ne!(read("scene-above.png"), read("scene-front.png"));
    assert_ne!(read("0001.front.png"), read("0002.front.png"));
}

#[test]
fn a_camera_called_all_is_one() {
    let folder = folder();
    let text = fs::read_to_string(folder.path().join("scene.kdl")).unwrap().replace("above", "all");
    fs::write(folder.path().join("scene.kdl"), text).unwrap();
    done(folder.path(), "render scene.kdl --camera all --size 8x6");
    assert_eq!(files(folder.path()), ["scene.kdl", "scene.png"]);
}

#[test]
fn pictures_that_would_share_a_name_are_refused() {
    let folder = folder();
    let folder = folder.path();
    fs::create_dir(folder.join("in")).unwrap();
    fs::copy(folder.join("scene.kdl"), folder.join("in/scene.kdl")).unwrap();
    refused(folder, "render scene.kdl in/scene.kdl", &["several pictures to scene.png", "{scene}"]);
    refused(
        folder,
        "render scene.kdl --camera all -o a.png",
        &["--output", "several pictures to a.png", "{camera}"],
    );
    refused(folder, "render scene.kdl --camera all -o {camera}.png --stats s.json", &["--stats", "s.json"]);
    refused(folder, "render scene.kdl --camera all --film a.film --samples 2 -o {camera}.png", &["--film"]);
    refused(folder, "render - -", &["standard input"]);
    refused(folder, "render scene.kdl --frames 4", &["--turn"]);
    refused(folder, "render scene.kdl --turn 90 0 1 0", &["--frames"]);
    refused(folder, "render scene.kdl --frames 4 --turn 90 0 0 0", &["axis", "--turn 360 0 1 0"]);
    refused(folder, "render scene.kdl --frames 0 --turn 90 0 1 0", &["1 to 100000"]);
    refused(folder, "render scene.kdl --frames 2 --turn 90 0 inf 0", &["finite number"]);
    refused(folder, "explain scene.kdl --camera all", &["one camera"]);
    refused(folder, "render scene.kdl -o a.png --format gif", &["gif", "png, exr"]);
}

#[test]
fn no_file_of_a_model_is_written_over() {
    let folder = folder();
    let folder = folder.path();
    fs::write(
        folder.join("m.obj"),
        "mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nusemtl w\nf 1/1 2/2 3/3\n",
    )
    .unwrap();
    fs::write(folder.join("m.mtl"), "newmtl w\nKd 1 1 1\nmap_Kd Wood.png\n").unwrap();
    catoptra_scene::image::write_png(&folder.join("wood.png"), 1, 1, &[9; 3]).unwrap();
    let text = "camera \"eye\" { eye 0 1 5; target 0 1 0 }\nmodel \"m\" { file \"m.obj\" }\n";
    fs::write(folder.join("model.kdl"), text).unwrap();
    let before = fs::read(folder.join("wood.png")).unwrap();
    for scene in ["model.kdl", "m.obj"] {
        refused(folder, &format!("render {scene} -o wood.png"), &["--output would overwrite a model's file"]);
        refused(
            folder,
            &format!("render {scene} --stats m.mtl"),
            &["--stats would overwrite a model's file"],
        );
    }
    // The picture of one scene is not to be in use by the next.
    fs::rename(folder.join("model.kdl"), folder.join("other.kdl")).unwrap();
    fs::copy(folder.join("scene.kdl"), folder.join("wood.kdl")).unwrap();
    refused(folder, "render wood.kdl other.kdl --force", &["would overwrite a model's file"]);
    assert_eq!(fs::read(folder.join("wood.png")).unwrap(), before);
}

#[cfg(unix)]
#[test]
fn standard_output_takes_a_picture() {
    use crate::program::shell;
    let folder = folder();
    let path = folder.path();
    done(path, "render scene.kdl -o whole.png --size 20x15");
    let line = "$catoptra render - -o - --size 20x15 < scene.kdl > a.png && cmp a.png whole.png && \
                $catoptra render scene.kdl -o - --layers color,depth --size 20x15 > a.exr && \
                $catoptra render scene.kdl -o - --format exr --size 20x15 | head -c 4 | od -An -tx1 && \
                $catoptra render scene.kdl --camera all -o - --size 20x15 | grep -c IHDR";
    let ran = shell(path, line);
    assert_eq!((ran.code, ran.err.as_str(), ran.out.as_str()), (0, "", " 76 2f 31 01\n2\n"));
    assert!(fs::metadata(path.join("a.exr")).unwrap().len() > 1000);
    let ran = shell(path, "$catoptra render - < scene.kdl");
    assert!(ran.code == 2 && ran.err.contains("--output FILE") && ran.out.is_empty(), "{}", ran.err);
    for more in ["--stats -", "--repeat 1"] {
        let ran = shell(path, &format!("$catoptra render scene.kdl -o - {more}"));
        assert!(ran.code == 2 && ran.err.contains("cannot both go to standard output"), "{}", ran.err);
    }
    let ran = shell(path, "$catoptra render scene.kdl -o - >&-");
    assert!(ran.code == 2 && ran.err.contains("standard output is closed"), "{}", ran.err);
}

#[test]
fn quiet_says_errors_alone_and_verbose_says_how_long_each_stage_takes() {
    let folder = folder();
    let folder = folder.path();
    assert_eq!(done(folder, "render scene.kdl --size 8x8 -q"), "");
    assert_eq!(done(folder, "render scene.kdl -o a.exr --display srgb --size 8x8 --quiet"), "");
    refused(folder, "render scene.kdl --size 8x8 -q", &["is there already"]);
    refused(folder, "render scene.kdl -q -v", &["--quiet", "--verbose"]);
    let told = done(folder, "-v render scene.kdl -o b.png --size 8x8");
    for words in ["read scene.kdl in ", "snapshot of scene.kdl in ", " rays in ", "wrote b.png in "] {
        assert!(told.contains(words), "no `{words}` in\n{told}");
    }
}

#[cfg(unix)]
#[test]
fn a_part_of_a_picture_is_kept_where_that_is_asked_for() {
    use crate::program::shell;
    let folder = folder();
    let path = folder.path();
    if shell(path, "command -v timeout").code != 0 {
        println!("skipped: there is no `timeout` here");
        return;
    }
    let line = |more: &str| {
        format!(
            "timeout --preserve-status -s INT 2 $catoptra render scene.kdl -o a.png --size 1500x1500 --samples 400 \
             --threads 2 {more}"
        )
    };
    let ran = shell(path, &line(""));
    assert_eq!((ran.code, ran.err.as_str()), (130, "interrupted: nothing is written\n"));
    assert_eq!(files(path), ["scene.kdl"]);
    let ran = shell(path, &line("--keep-partial"));
    assert_eq!(ran.code, 130);
    assert!(
        ran.err.contains("interrupted: a.png holds ") && ran.err.contains(" % of the picture"),
        "{}",
        ran.err
    );
    let image = read_png(&path.join("a.png")).unwrap();
    assert_eq!((image.width(), image.height()), (1500, 1500));
    assert!(image.bytes().iter().any(|byte| *byte > 0) && image.pixel(1499, 1499) == Some([0; 3]));
}
