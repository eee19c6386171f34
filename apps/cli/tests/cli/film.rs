//! Are samples kept, and gone on with as if nothing had been between?

use std::path::Path;

use crate::program::{Ran, assert_refused, catoptra, folder};

fn run(folder: &Path, line: &str) -> Ran {
    catoptra(folder, &line.split(' ').collect::<Vec<_>>())
}

fn picture(folder: &Path, line: &str) -> Vec<u8> {
    let ran = run(folder, &format!("{line} -o a.exr --reproducible"));
    assert_eq!(ran.code, 0, "{line} {}", ran.err);
    std::fs::read(folder.join("a.exr")).expect("a picture")
}

const LINE: &str = "render scene.kdl --size 41x30 --integrator path";

#[test]
fn a_film_goes_on_to_the_bits_of_all_samples_at_once() {
    let folder = folder();
    let folder = folder.path();
    let first = picture(folder, &format!("{LINE} --samples 5 --film a.film"));
    assert_eq!(first, picture(folder, &format!("{LINE} --samples 5")));
    let ran = run(folder, &format!("{LINE} --samples 12 --film a.film -o a.exr --reproducible"));
    assert!(ran.code == 0 && ran.err.contains("a.film holds 5 samples a pixel"), "{}", ran.err);
    assert_eq!(
        std::fs::read(folder.join("a.exr")).unwrap(),
        picture(folder, &format!("{LINE} --samples 12"))
    );
    // There are enough already: the picture is that of all that there are.
    let again = picture(folder, &format!("{LINE} --samples 3 --film a.film"));
    assert_eq!(again, picture(folder, &format!("{LINE} --samples 12")));
}

#[test]
fn a_time_is_enough_for_a_film() {
    let folder = folder();
    let ran = run(folder.path(), &format!("{LINE} --time 0.05 --film a.film"));
    assert_eq!(ran.code, 0, "{}", ran.err);
    let ran = run(folder.path(), &format!("{LINE} --time 0.05 --film a.film"));
    assert!(ran.code == 0 && ran.err.contains("a.film holds"), "{}", ran.err);
}

#[test]
fn films_of_other_pictures_and_other_files_are_left_alone() {
    let folder = folder();
    let folder = folder.path();
    assert_eq!(run(folder, &format!("{LINE} --samples 2 --film a.film")).code, 0);
    let kept = std::fs::read(folder.join("a.film")).unwrap();
    let refused = |options: &str, words: &[&str]| {
        let line = format!("{LINE} --samples 2 --film a.film {options}");
        assert_refused(folder, &line.split(' ').collect::<Vec<_>>(), words);
        assert_eq!(std::fs::read(folder.join("a.film")).unwrap(), kept, "{options}");
    };
    refused("--seed 1", &["another picture", "seed 0", "seed 1"]);
    refused("--crop 1,2,8,8", &["another part", "0,0,41,30", "1,2,8,8"]);
    refused("--filter tent", &["filter box"]);
    refused("--max-error 0.1", &["--film"]);
    let scene = std::fs::read_to_string(folder.join("scene.kdl")).unwrap();
    std::fs::write(folder.join("scene.kdl"), format!("{scene}\n// changed")).unwrap();
    refused("--seed 0", &["another picture", "scene"]);
    std::fs::write(folder.join("junk"), "no film").unwrap();
    let junk = format!("{LINE} --samples 2 --film junk");
    assert_refused(folder, &junk.split(' ').collect::<Vec<_>>(), &["junk", "no film of this program"]);
    let grid = format!("{LINE} --samples 4 --pattern grid --film a.film");
    assert_refused(folder, &grid.split(' ').collect::<Vec<_>>(), &["does not go with --pattern grid"]);
    let one = format!("{LINE} --film b.film");
    assert_refused(folder, &one.split(' ').collect::<Vec<_>>(), &["--samples", "--time"]);
}

#[cfg(unix)]
#[test]
fn an_interrupted_film_goes_on_to_the_same_bits() {
    use crate::program::shell;
    let folder = folder();
    let folder = folder.path();
    if shell(folder, "command -v timeout").code != 0 {
        println!("skipped: there is no `timeout` here");
        return;
    }
    let line = "render scene.kdl --size 160x120 --integrator path --samples 64";
    let whole = picture(folder, line);
    let mut interruptions = 0;
    loop {
        let ran = shell(
            folder,
            &format!(
                "timeout --preserve-status -s INT 0.4 $catoptra {line} --film a.film -o b.exr --reproducible"
            ),
        );
        match ran.code {
            0 => break,
            130 => interruptions += 1,
            code => panic!("code {code}: {}", ran.err),
        }
        assert!(interruptions < 500, "{}", ran.err);
        assert!(!folder.join("b.exr").exists());
    }
    println!("{interruptions} interruptions");
    assert_eq!(std::fs::read(folder.join("b.exr")).unwrap(), whole);
}
