//! Is a habit of another language or a slip of the finger one error, at its place, with what to write instead?
#![allow(clippy::unwrap_used, reason = "a test may stop at the first surprise")]

use std::path::Path;

use catoptra_scene::{SceneTextError, parse};

const W: &str = "matte \"w\" { color 1 1 1 }\n";

/// A text after [`W`], line and column of its only complaint, and part of the hint.
struct Slip(&'static str, (usize, usize), &'static str);

/// Slips in the block of a sphere that begins in column 27 of line 2.
const IN_A_SPHERE: &[Slip] = &[
    // A mark between a word and its value
    Slip("radius=1", (2, 27), "write radius 1"),
    Slip("radius = 1", (2, 27), "write radius 1"),
    Slip("radius =1", (2, 27), "write radius 1"),
    Slip("radius: 1", (2, 27), "write radius 1"),
    Slip("radius:1", (2, 27), "write radius 1"),
    Slip("radius := 1", (2, 27), "write radius 1"),
    Slip("radius -> 1", (2, 27), "write radius 1"),
    Slip("radius => 1", (2, 27), "write radius 1"),
    Slip("\"radius\": 1", (2, 27), "write radius 1"),
    Slip("\"radius\": 1,", (2, 27), "write radius 1"),
    Slip("radius(1)", (2, 33), "write radius 1"),
    Slip("radius = .5", (2, 27), "write radius 0.5"),
    Slip("radius =", (2, 27), "write radius and its value"),
    // Numbers
    Slip("radius .5", (2, 34), "write 0.5"),
    Slip("radius +.5", (2, 34), "write +0.5"),
    Slip("radius 5.", (2, 34), "write 5.0"),
    Slip("radius 5.e-1", (2, 34), "write 5.0e-1"),
    Slip("radius 1,5", (2, 34), "write 1.5"),
    Slip("radius 1e5f", (2, 34), "write 1e5"),
    Slip("radius 0.5f", (2, 34), "write 0.5"),
    Slip("radius 1.0d0", (2, 34), "write 1.0e0"),
    Slip("radius 50%", (2, 34), "write 0.5"),
    Slip("radius 30cm", (2, 34), "write 0.3"),
    Slip("radius 1/4", (2, 34), "write 0.25"),
    Slip("radius 1'000", (2, 34), "write 1000"),
    Slip("radius np.float64(0.5)", (2, 34), "write radius 0.5"),
    Slip("radius float(.5)", (2, 34), "write radius 0.5"),
    Slip("radius sqrt(2)", (2, 34), "write the number"),
    Slip("radius nan", (2, 34), "write a value for radius"),
    Slip("radius inf", (2, 34), "write a value for radius"),
    Slip("radius -inf", (2, 34), "write a value for radius"),
    Slip("radius NaN", (2, 34), ""),
    Slip("radius Infinity", (2, 34), ""),
    Slip("radius null", (2, 34), "write a value for radius"),
    Slip("radius true", (2, 34), "write a value for radius"),
    Slip("radius 1..5", (2, 34), "write a number such as 0.5"),
    Slip("radius 1.2.3", (2, 34), "write a number such as 0.5"),
    Slip("radius \"0.5\"", (2, 34), "write 0.5 without quotes"),
    Slip("radius 0.1234567890123456789012345678901234567890123", (2, 34), "write 0.123456789"),
    // Vectors
    Slip("radius 1; center 1, 2, 3", (2, 45), "separate numbers by blanks: write center 1 2 3"),
    Slip("radius 1; center 1,2,3", (2, 45), "separate numbers by blanks: write center 1 2 3"),
    Slip("radius 1; center 0,5 1,5 2,0", (2, 44), "write center 0.5 1.5 2.0"),
    Slip("radius 1; center <1,2,3>", (2, 44), "write center 1 2 3"),
    Slip("radius 1; center <1, 2, 3>", (2, 44), "write center 1 2 3"),
    Slip("radius 1; center [1, 2, 3]", (2, 44), "write center 1 2 3"),
    Slip("radius 1; center (1,2,3)", (2, 44), "write center 1 2 3"),
    Slip("radius 1; center {1, 2, 3}", (2, 44), "write center 1 2 3"),
    Slip("radius 1; center vec3(1, 2, 3)", (2, 44), "write center 1 2 3"),
    Slip("radius 1; center np.array([1, .5, 3.])", (2, 44), "write center 1 0.5 3.0"),
    Slip("radius 1; center [\n  1,\n  2,\n  3,\n]", (2, 44), "write center 1 2 3"),
    Slip("radius 1; center .5 .5 .5", (2, 44), "write center 0.5 0.5 0.5"),
    Slip("radius 1; center x=1 y=.5 z=2", (2, 44), "write center 1 0.5 2"),
    Slip("radius 1; look_at 0 0 0", (2, 37), "what it has"),
    Slip("radius 1; rotate 30 0 1 0", (2, 37), "did you mean \"turn\"?"),
    Slip("radius 1; material \"w\"", (2, 37), "before the block"),
    Slip("radius 1 # big", (2, 36), "write /* big */"),
    // The end of a field
    Slip("center 0 1 0, radius 1", (2, 39), "write center 0 1 0; radius 1"),
    Slip("center 0 1 0 radius 1", (2, 40), "write center 0 1 0 ; radius 1"),
    Slip("radius=1, center=0 1 0", (2, 27), "write radius 1; center 0 1 0"),
    Slip("radius 1,", (2, 35), "write radius 1"),
    Slip("radius 1;; center 0 1 0", (2, 36), "leave it away"),
    Slip("<0, 0, 0>, 1", (2, 27), "write that word before it"),
    Slip("1", (2, 27), "write that word before it"),
];

/// Slips outside of a block, or with a block of their own.
const AFTER_A_MATERIAL: &[Slip] = &[
    // Colours and flags
    Slip("matte \"m\" { color rgb <1,0,0> }", (2, 19), "write color 1 0 0"),
    Slip("matte \"m\" { color rgb(1, 0, 0) }", (2, 19), "write color 1 0 0"),
    Slip("matte \"m\" { color #ff8000 }", (2, 19), "write 1 0.216 0"),
    Slip("matte \"m\" { color 0,5 }", (2, 19), "write 0.5"),
    Slip("point-light \"l\" { intensity 1; shadow false }", (2, 39), "write #false"),
    Slip("point-light \"l\" { intensity 1; shadow #True }", (2, 39), "write #true"),
    Slip("point-light \"l\" { intensity 1; shadow False }", (2, 39), "write #false"),
    Slip("point-light \"l\" { intensity 1; shadow off }", (2, 39), "write #false"),
    Slip("point-light \"l\" { intensity 1; shadow = false }", (2, 32), "write shadow #false"),
    // Quotes
    Slip("sphere 's' material='w' { radius 1 }", (2, 8), "write sphere \"s\" material=\"w\""),
    Slip("sphere 'my ball' material=\"w\" { radius 1 }", (2, 8), "write \"my ball\""),
    Slip("sphere “my ball” material=\"w\" { radius 1 }", (2, 8), "write \"my ball\""),
    Slip("sphere \"s material=\"w\" { radius 1 }", (2, 8), "write \"s\""),
    Slip("sphere \"s\" material=\"w { radius 1 }", (2, 21), "write \"w\""),
    Slip("sphere s\" material=\"w\" { radius 1 }", (2, 8), "write \"s\""),
    Slip("sphere my ball\" material=\"w\" { radius 1 }", (2, 8), "write \"my ball\""),
    Slip("sphere \"s\" material=w\" { radius 1 }", (2, 21), "write \"w\""),
    Slip("sphere 3rd material=\"w\" { radius 1 }", (2, 8), "write \"3rd\""),
    Slip("sphere a/b material=\"w\" { radius 1 }", (2, 8), "write \"a/b\""),
    Slip("sphere nan material=\"w\" { radius 1 }", (2, 8), "write \"nan\""),
    // Braces
    Slip("sphere \"s\" material=\"w\" {\n radius 1\nplane \"p\" material=\"w\"", (2, 25), "close it with }"),
    Slip("group \"g\" {\n plane \"p\" material=\"w\"\nmatte \"m\" { color 1 }", (2, 11), "close it with }"),
    Slip("sphere \"s\" material=\"w\"\n radius 1\n}\nplane \"p\" material=\"w\"", (2, 24), "write {"),
    Slip("sphere \"s\" material=\"w\" radius 1 }", (2, 25), "write {"),
    Slip("sphere \"s\" material=\"w\"\n{\n radius 1\n}", (3, 1), "put the { behind sphere"),
    Slip("sphere \"s\" material=\"w\"; { radius 1 }", (2, 26), "put the { behind sphere"),
    Slip("sphere \"s\" material=\"w\" { radius 1 }}", (2, 37), "leave the } away"),
    Slip("plane \"p\" material=\"w\" { point 0 1 0 } plane \"q\" material=\"w\"", (2, 40), "write ;"),
    Slip("plane \"p\" material=\"w\" plane \"q\" material=\"w\"", (2, 24), "; plane \"q\""),
    Slip("sphere \"s\" material=\"w\" { radius 1 },", (2, 37), "leave it away"),
    // Comments
    Slip("# it's a comment {", (2, 1), "write // it's a comment {"),
    Slip("plane \"p\" material=\"w\" # a \"comment", (2, 24), "write // a \"comment"),
    Slip("-- a comment", (2, 1), "write // a comment"),
    Slip("<!-- a comment -->", (2, 1), "write // a comment"),
    Slip("#declare Red = rgb <1, 0, 0>;", (2, 1), "every value where it is used"),
    Slip("#include \"colors.inc\"", (2, 1), "every value where it is used"),
    Slip("plane \"p\" material=\"w\" */", (2, 24), "leave it away"),
    // Calls and properties
    Slip("sphere(\"s\", radius=1, material=\"w\")", (2, 7), "write sphere \"s\" radius=1 material=\"w\""),
    Slip("sphere \"s\", material=\"w\", radius=1", (2, 11), "write sphere \"s\" material=\"w\" radius=1"),
    Slip("sphere \"s\" material:\"w\" { radius 1 }", (2, 20), "write sphere \"s\" material=\"w\""),
    Slip("sphere \"s\" material=\"w\" radius=.5", (2, 32), "write 0.5"),
    Slip("sphere \"s\" material=\"w\" radius=1 center=[0, 1, 0]", (2, 34), "{ center 0 1 0 }"),
    // Paths
    Slip(
        "mesh \"m\" material=\"w\" { file \"meshes\\m.obj\" }",
        (2, 37),
        "\"meshes/m.obj\" or \"meshes\\\\m.obj\"",
    ),
    Slip("mesh \"m\" material=\"w\" { file \"C:\\Users\\me\\m.obj\" }", (2, 33), "\"C:/Users/me/m.obj\""),
    Slip("mesh \"m\" material=\"w\" { file \"C:\\users\\m.obj\" }", (2, 33), "\"C:/users/m.obj\""),
    Slip("mesh \"m\" material=\"w\" { file \"new\\torus.obj\" }", (2, 30), "write \"new/torus.obj\""),
    Slip("mesh \"m\" material=\"w\" { file \"meshes\\\" }", (2, 30), "write \"meshes/\""),
    Slip("mesh \"m\" material=\"w\" { file meshes/m.obj }", (2, 30), "write \"meshes/m.obj\""),
    Slip("mesh \"m\" material=\"w\" { file 'm.obj' }", (2, 30), "write \"m.obj\""),
    // Characters
    Slip("plane \"p\" material=\"w\"\0", (2, 23), "take it out"),
    Slip("plane \"p\u{1b}[31m\" material=\"w\"", (2, 9), "\\u{1b}"),
    Slip("plane \"p\u{202e}\" material=\"w\"", (2, 9), "\\u{202e}"),
    Slip("\u{feff}plane \"p\" material=\"w\"", (2, 1), "take it out"),
];

fn refused(text: &str) -> SceneTextError {
    match parse(text, "bad.kdl", Some(Path::new("/no/such/folder"))) {
        Ok(_) => panic!("was read:\n{text}"),
        Err(error) => error,
    }
}

/// Every complaint as a line.
fn told(error: &SceneTextError) -> String {
    let line = |c: &catoptra_scene::Complaint| format!("   {c} | {}\n", c.hint().unwrap_or_default());
    error.complaints().iter().map(line).collect()
}

/// What of the slips is told otherwise, in texts made of them.
fn wrong(slips: &[Slip], text: impl Fn(&str) -> String) -> String {
    let mut wrong = String::new();
    for Slip(slip, place, hint) in slips {
        let error = refused(&text(slip));
        let all = error.complaints();
        let right = all.len() == 1
            && (all[0].line(), all[0].column()) == *place
            && all[0].hint().unwrap_or_default().contains(hint);
        if !right {
            wrong += &format!("{slip:?}: expected {place:?} {hint:?}\n{}", told(&error));
        }
    }
    wrong
}

#[test]
fn a_slip_in_a_block_is_one_error_at_its_place() {
    let wrong = wrong(IN_A_SPHERE, |slip| format!("{W}sphere \"s\" material=\"w\" {{ {slip} }}\n"));
    assert!(wrong.is_empty(), "{wrong}");
}

#[test]
fn a_slip_elsewhere_is_one_error_at_its_place() {
    let wrong = wrong(AFTER_A_MATERIAL, |slip| format!("{W}{slip}\n"));
    assert!(wrong.is_empty(), "{wrong}");
}

#[test]
fn a_slip_hides_no_other_error() {
    let mut wrong = String::new();
    for Slip(slip, ..) in AFTER_A_MATERIAL {
        let lines = slip.lines().count();
        let before = "plnae \"a\"\ncamera \"c\" { eye 0 0 4; target 0 0 0; fov 400 }\n";
        let after = "sphere \"z\" material=\"nothing\" { raduis 1 }\n";
        let error = refused(&format!("{W}{before}{slip}\n{after}"));
        let mut found: Vec<_> = error.complaints().iter().map(|c| (c.line(), c.column())).collect();
        found.retain(|(line, _)| *line < 4 || *line >= 4 + lines);
        let last = 4 + lines;
        if found != [(2, 1), (3, 39), (last, 21), (last, 33)] || error.complaints().len() != 5 {
            wrong += &format!("{slip:?}:\n{}", told(&error));
        }
    }
    assert!(wrong.is_empty(), "{wrong}");
}

#[test]
fn slips_of_one_file_are_told_one_by_one() {
    let text = "# A room\ncamera 'eye' { eye = [0, 1, 4]; target 0,0,0; fov 40. }\nmatte \"c\" { color .8 }\n\
                point-light \"l\" { position <3,3,3>; intensity 30; shadow true }\nsphere \"b\" material=\"c\" { radius=1 }\n";
    let error = refused(text);
    let found: Vec<_> = error.complaints().iter().map(|c| (c.line(), c.column())).collect();
    assert_eq!(
        found,
        [(1, 1), (2, 8), (2, 16), (2, 41), (2, 51), (3, 19), (4, 28), (4, 58), (5, 27)],
        "{}",
        told(&error)
    );
}

#[test]
fn a_file_of_another_language_is_one_error() {
    for (text, language) in
        [("{\"camera\": {\"eye\": [0, 1, 4]}}", "JSON"), ("<scene>\n<sphere/>\n</scene>", "XML")]
    {
        let error = refused(text);
        assert_eq!(error.complaints().len(), 1, "{}", told(&error));
        assert!(error.to_string().contains(language), "{error}");
    }
}

#[test]
fn blocks_told_by_their_indentation_are_understood() {
    let error = refused("camera \"c\":\n  eye: [0, 1, 4]\n  target: 0 0 0\n  fov: 400\nplnae \"p\"\n");
    let found: Vec<_> = error.complaints().iter().map(|c| (c.line(), c.column())).collect();
    assert_eq!(found, [(1, 11), (2, 3), (3, 3), (4, 3), (4, 3), (5, 1)], "{}", told(&error));
}

#[test]
fn nothing_in_the_shipped_scenes_is_taken_for_a_slip() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes");
    let mut count = 0;
    for entry in ["seed", "gallery"].iter().flat_map(|name| std::fs::read_dir(folder.join(name)).unwrap()) {
        let path = entry.unwrap().path();
        if path.extension().is_none_or(|ending| ending != "kdl") {
            continue;
        }
        let text = std::fs::read_to_string(&path).unwrap();
        let Err(error) = parse(&format!("{text}\nplnae \"x\"\n"), "bad.kdl", path.parent()) else {
            panic!("was read")
        };
        assert_eq!(error.complaints().len(), 1, "{}: {}", path.display(), told(&error));
        count += 1;
    }
    assert!(count > 10);
}

#[test]
fn what_is_legal_is_no_slip() {
    let text = "matte w { color 1 /* a, b = c: [1] # */ }\n// it's # \"fine\"\n/-sphere \"off\" { radius 1 }\n\
                sphere \"a = b: [1, 2] 'x' # \\\"y\\\" \\\\ {\" material = w \\\n  radius=1 { center 0 -1e3 +0x2; /- move 1 2 3\n }\n\
                sphere #\"C:\\raw\"# material=\"w\" { \"radius\" 1; turn 30 0 1 0 { about 1 2 3 }; }\n\
                group \"\"\"\n  of \"two\"\n  \"\"\" {\n}\nplnae \"x\"\n";
    let error = refused(text);
    assert_eq!(error.complaints().len(), 1, "{}", told(&error));
    assert_eq!(error.line(), Some(text.lines().count()));
}
