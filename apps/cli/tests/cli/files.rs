//! Does the program harm nobody's file: pipes, links, read-only files, what is read, and full disks?

use std::fs;
use std::os::unix::fs::{FileTypeExt, PermissionsExt, symlink};
use std::path::Path;

use crate::program::{assert_refused, catoptra, files, folder, shell};

/// Arguments of a small picture to `output`, and more.
fn render<'a>(output: &'a str, more: &[&'a str]) -> Vec<&'a str> {
    [&["render", "scene.kdl", "-o", output, "--size", "20x15"][..], more].concat()
}

/// Arguments of a picture that would take longer than anyone waits for a refusal.
fn render_for_long(output: &str) -> [&str; 6] {
    ["render", "scene.kdl", "-o", output, "--size", "9000x9000"]
}

fn starts_as_png(path: &Path) -> bool {
    fs::read(path).is_ok_and(|bytes| bytes.starts_with(b"\x89PNG"))
}

/// Whether a line of shell works here, such as one that wants the superuser; said where it does not.
fn can(folder: &Path, line: &str) -> bool {
    let works = shell(folder, line).code == 0;
    if !works {
        println!("skipped: `{line}` does not work here");
    }
    works
}

#[test]
fn a_pipe_stays_one_and_its_reader_gets_the_picture() {
    let folder = folder();
    for name in ["p.png", "p.exr"] {
        let more: &[&str] = if name.ends_with("exr") { &["--reproducible"] } else { &[] };
        let line = format!(
            "more='{}'; mkfifo {name}; cat {name} > got.{name} & $catoptra render scene.kdl -o {name} --size 20x15 $more; \
             code=$?; [ $code = 0 ] && [ -p {name} ] || kill $!; wait; exit $code",
            more.concat()
        );
        let ran = shell(folder.path(), &line);
        assert_eq!((ran.code, ran.err.as_str()), (0, ""), "{name}");
        assert!(fs::metadata(folder.path().join(name)).unwrap().file_type().is_fifo());
        assert_eq!(catoptra(folder.path(), &render(&format!("whole-{name}"), more)).code, 0);
        let [got, whole] = ["got.", "whole-"].map(|prefix| folder.path().join(format!("{prefix}{name}")));
        assert_eq!(fs::read(got).unwrap(), fs::read(whole).unwrap(), "{name}");
    }
}

#[test]
fn a_reader_of_a_pipe_that_goes_is_told_and_nothing_panics() {
    let folder = folder();
    let line = "mkfifo p.exr; head -c 1 p.exr > got & $catoptra render scene.kdl -o p.exr --size 400x300; \
                code=$?; [ -p p.exr ] || kill $!; wait; exit $code";
    let ran = shell(folder.path(), line);
    assert_eq!(ran.code, 2, "{}", ran.err);
    assert!(ran.err.contains("p.exr cannot be written: Broken pipe"), "{}", ran.err);
}

#[test]
fn an_interruption_ends_the_wait_for_a_reader() {
    let folder = folder();
    if !can(folder.path(), "command -v timeout") {
        return;
    }
    let line =
        "mkfifo p.png && timeout --preserve-status -k 20 2 $catoptra render scene.kdl -o p.png --size 20x15";
    assert_eq!(shell(folder.path(), line).code, 130);
}

#[test]
fn a_device_stays_one() {
    let folder = folder();
    if !can(folder.path(), "mknod null.png c 1 3 && mknod full.png c 1 7 && : > null.png") {
        return;
    }
    for arguments in [render("null.png", &["--stats", "null.png"]), render("null.png", &[])] {
        let ran = catoptra(folder.path(), &arguments);
        assert_eq!((ran.code, ran.err.as_str()), (0, ""), "{arguments:?}");
    }
    assert!(fs::metadata(folder.path().join("null.png")).unwrap().file_type().is_char_device());
    symlink("full.png", folder.path().join("full.exr")).unwrap();
    for name in ["full.png", "full.exr"] {
        assert_refused(folder.path(), &render(name, &[]), &[name, "cannot be written", "No space left"]);
    }
}

#[test]
fn standard_output_gets_the_statistics_and_a_log_keeps_what_it_held() {
    let folder = folder();
    let ran = shell(folder.path(), "$catoptra render scene.kdl --stats - --size 20x15");
    assert!(ran.code == 0 && ran.out.starts_with('{') && ran.out.ends_with("}\n"), "{}", ran.err);
    assert_eq!(files(folder.path()), ["scene.kdl"]);
    let run = "$catoptra render scene.kdl --stats /dev/fd/1 --repeat 1 --size 20x15";
    let ran = shell(folder.path(), &format!("{run} | cat"));
    assert!(ran.out.starts_with('{') && ran.out.contains(" over 1 frames"), "{}{}", ran.out, ran.err);
    let ran = shell(folder.path(), &format!("echo before > log; {run} >> log"));
    assert_eq!((ran.code, ran.err.as_str()), (0, ""));
    let log = fs::read_to_string(folder.path().join("log")).unwrap();
    assert!(log.starts_with("before\n{") && log.contains("}\nscene.kdl 20x15"), "{log}");
    let ran = shell(folder.path(), &format!("{run} > log"));
    assert_eq!(ran.code, 0, "{}", ran.err);
    let log = fs::read_to_string(folder.path().join("log")).unwrap();
    assert!(log.starts_with('{') && log.contains("}\nscene.kdl 20x15"), "{log}");
}

#[test]
fn links_stay_links() {
    let folder = folder();
    let at = |name: &str| folder.path().join(name);
    fs::create_dir(at("t")).unwrap();
    fs::write(at("t/a.png"), "old").unwrap();
    for (target, link) in [("t/a.png", "a.png"), ("t/new.png", "new.png"), ("loop.png", "loop.png")] {
        symlink(target, at(link)).unwrap();
    }
    for name in ["a.png", "new.png"] {
        assert_eq!(catoptra(folder.path(), &render(name, &[])).code, 0);
        assert!(fs::symlink_metadata(at(name)).unwrap().is_symlink());
        assert!(starts_as_png(&at("t").join(name)), "{name}");
    }
    assert_refused(folder.path(), &render("loop.png", &[]), &["loop.png cannot be written", "circle"]);
    assert_eq!(files(&at("t")), ["a.png", "new.png"]);
}

#[test]
fn any_legal_name_is_written_and_others_are_told_first() {
    let folder = folder();
    for name in [format!("{}.png", "a".repeat(251)), format!("{}.exr", "木".repeat(83))] {
        let ran = catoptra(folder.path(), &render(&name, &[]));
        assert_eq!((ran.code, ran.err.as_str()), (0, ""), "{name}");
        fs::remove_file(folder.path().join(name)).unwrap();
    }
    let name = format!("{}.png", "a".repeat(252));
    assert_refused(folder.path(), &render_for_long(&name), &["cannot be written", "too long"]);
}

#[test]
fn a_read_only_file_is_refused_first() {
    let folder = folder();
    let path = folder.path().join("a.png");
    fs::write(&path, "precious").unwrap();
    fs::set_permissions(&path, fs::Permissions::from_mode(0o444)).unwrap();
    assert_refused(folder.path(), &render_for_long("a.png"), &["a.png", "read-only"]);
    assert_refused(folder.path(), &["render", "scene.kdl", "--stats", "a.png"], &["a.png", "read-only"]);
    assert_eq!(fs::read(&path).unwrap(), b"precious");
}

#[test]
fn a_folder_that_may_not_be_written_is_told_first() {
    let folder = folder();
    fs::create_dir(folder.path().join("ro")).unwrap();
    fs::set_permissions(folder.path().join("ro"), fs::Permissions::from_mode(0o555)).unwrap();
    fs::set_permissions(folder.path(), fs::Permissions::from_mode(0o755)).unwrap();
    // The superuser may write everywhere, and is somebody else for this.
    let user = "setpriv --reuid 65534 --regid 65534 --clear-groups";
    let prefix = match shell(folder.path(), "touch ro/x && rm ro/x").code {
        0 if can(folder.path(), &format!("{user} test -x $catoptra")) => user,
        0 => return,
        _ => "",
    };
    for output in ["-o ro/a.png", "--stats ro/a.json", "-o ro/a.exr --repeat 2"] {
        let ran =
            shell(folder.path(), &format!("{prefix} $catoptra render scene.kdl {output} --size 9000x9000"));
        assert_eq!(ran.code, 2, "{}", ran.err);
        assert!(ran.err.contains("the folder ro takes no file: Permission denied"), "{}", ran.err);
    }
}

/// A scene with a mesh beside the small scene.
fn with_mesh(folder: &Path) {
    fs::write(folder.join("m.obj"), "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n").expect("a mesh is written");
    let scene = "camera \"eye\" { eye 0 1 5; target 0 1 0 }\nmatte \"w\" { color 1 }\n\
                 mesh \"m\" material=\"w\" { file \"m.obj\" }\n";
    fs::write(folder.join("mesh.kdl"), scene).expect("a scene is written");
}

#[test]
fn what_is_read_is_never_written_over() {
    let folder = folder();
    with_mesh(folder.path());
    symlink("mesh.kdl", folder.path().join("link.json")).unwrap();
    symlink(".", folder.path().join("here")).unwrap();
    fs::hard_link(folder.path().join("m.obj"), folder.path().join("hard.png")).unwrap();
    fs::hard_link(folder.path().join("mesh.kdl"), folder.path().join("hard.json")).unwrap();
    let before = fs::read(folder.path().join("mesh.kdl")).unwrap();
    // What is the matter is not that it is read-only.
    fs::set_permissions(folder.path().join("mesh.kdl"), fs::Permissions::from_mode(0o444)).unwrap();
    for stats in ["mesh.kdl", "./mesh.kdl", "here/here/mesh.kdl", "link.json", "hard.json"] {
        let words = ["--stats would overwrite the scene mesh.kdl"];
        assert_refused(folder.path(), &["render", "mesh.kdl", "--stats", stats], &words);
    }
    for output in ["-o hard.png", "--stats m.obj", "--stats here/m.obj"] {
        let arguments = [&["render", "here/mesh.kdl"][..], &output.split(' ').collect::<Vec<_>>()].concat();
        assert_refused(folder.path(), &arguments, &["would overwrite the mesh"]);
    }
    let ran = shell(folder.path(), "$catoptra render - --stats mesh.kdl < mesh.kdl");
    assert!(ran.code == 2 && ran.err.contains("would overwrite the scene"), "{}", ran.err);
    assert_eq!(fs::read(folder.path().join("mesh.kdl")).unwrap(), before);
}

#[test]
fn two_outputs_are_two_files() {
    let folder = folder();
    symlink(".", folder.path().join("here")).unwrap();
    symlink("o.png", folder.path().join("link.png")).unwrap();
    for stats in ["o.png", "./o.png", "here/o.png", "link.png"] {
        assert_refused(
            folder.path(),
            &render("o.png", &["--stats", stats]),
            &["--output and --stats both write"],
        );
    }
    let ran = catoptra(folder.path(), &render("o.png", &["--stats", "o.json"]));
    assert_eq!((ran.code, ran.err.as_str()), (0, ""));
}

#[test]
fn results_do_not_replace_their_cases() {
    let folder = folder();
    fs::write(folder.path().join("some.cases"), "STRESS 1\n").unwrap();
    let arguments = ["lab", "answer", "some.cases", "./some.cases"];
    assert_refused(folder.path(), &arguments, &["would overwrite the case file"]);
    assert_refused(folder.path(), &["lab", "answer", "some.cases", "no/r"], &["no does not exist"]);
    assert_refused(folder.path(), &["lab", "pareto", "--out", "some.cases/in"], &["some.cases", "is a file"]);
}

#[test]
fn a_limit_on_the_size_of_files_leaves_nothing_behind() {
    let folder = folder();
    fs::write(folder.path().join("a.png"), "old").unwrap();
    for name in ["a.png", "b.exr"] {
        let before = files(folder.path());
        let line = format!("ulimit -f 1; exec $catoptra render scene.kdl -o {name} --size 400x300");
        let ran = shell(folder.path(), &line);
        assert_eq!(ran.code, 2, "{}", ran.err);
        assert!(ran.err.contains(name) && ran.err.contains("File too large"), "{}", ran.err);
        assert_eq!(files(folder.path()), before);
    }
    assert_eq!(fs::read(folder.path().join("a.png")).unwrap(), b"old");
}

#[test]
fn a_full_disk_leaves_nothing_behind() {
    let folder = folder();
    fs::create_dir(folder.path().join("disk")).unwrap();
    let mount = "unshare -m sh -c 'mount -t tmpfs -o size=16k tmpfs disk";
    if !can(folder.path(), &format!("{mount}'")) {
        return;
    }
    for name in ["a.png", "a.exr"] {
        let line = format!(
            "{mount} && echo old > disk/{name} && $catoptra render scene.kdl -o disk/{name} --size 400x300; \
             echo $?; ls -A disk; cat disk/{name}'"
        );
        let ran = shell(folder.path(), &line);
        assert_eq!(ran.out, format!("2\n{name}\nold\n"), "{}", ran.err);
        assert!(ran.err.contains("No space left"), "{}", ran.err);
    }
}

#[test]
fn too_little_memory_is_told_with_what_is_needed() {
    let folder = folder();
    for output in ["-o a.png", "-o a.exr", "--repeat 1"] {
        let line = format!(
            "ulimit -v 1000000; exec $catoptra render scene.kdl {output} --size 16384x8192 --threads 2"
        );
        let ran = shell(folder.path(), &line);
        assert_eq!(ran.code, 2, "{}", ran.err);
        assert!(ran.err.contains("needs 2.5 GiB of memory") && ran.err.contains("--size"), "{}", ran.err);
    }
    assert_eq!(files(folder.path()), ["scene.kdl"]);
}

/// Number of the signal that a program gets which the system cannot map.
const SEGMENTATION: i32 = 11;

#[test]
fn memory_or_threads_that_run_out_end_in_no_crash() {
    let folder = folder();
    with_mesh(folder.path());
    let corners: String = (0..200_000).map(|i| format!("v {i} {} 0\n", i % 7)).collect();
    let faces: String = (1..199_998).map(|i| format!("f {i} {} {}\n", i + 1, i + 2)).collect();
    fs::write(folder.path().join("m.obj"), corners + &faces).unwrap();
    let (mut told, mut has_begun) = (0, false);
    for limit in (20_000..).step_by(6000) {
        let line = format!(
            "ulimit -v {limit}; $catoptra render mesh.kdl -o a.png --size 90x90 --threads 2; exit $?"
        );
        let ran = shell(folder.path(), &line);
        if ran.code == 0 {
            break;
        }
        // Loading the program itself may already be too much: the system's loader says so in words of its own, or ends it.
        if [127, 128 + SEGMENTATION].contains(&ran.code) && !has_begun {
            continue;
        }
        has_begun = true;
        assert_eq!(ran.code, 2, "{limit}: {}", ran.err);
        // Threads want memory too, and come first.
        let is_told = ran.err.contains("memory") || ran.err.contains("--threads");
        assert!(is_told && !ran.err.contains("panicked"), "{limit}: {}", ran.err);
        told += usize::from(ran.err.contains("memory allocation of"));
    }
    assert!(told > 0, "reading the mesh was never too much");
    let ran =
        shell(folder.path(), "ulimit -v 300000; exec $catoptra render scene.kdl -o a.png --threads 1024");
    assert!(ran.code == 2 && ran.err.contains("--threads"), "{}", ran.err);
}
