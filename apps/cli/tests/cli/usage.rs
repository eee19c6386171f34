//! Do help, version and mistakes on the command line end as scripts expect?

use crate::program::{assert_refused, catoptra, folder};

#[test]
fn help_and_version_are_no_errors() {
    let folder = folder();
    for arguments in [&["--help"][..], &["render", "--help"], &["compare", "--help"], &["explain", "--help"]]
    {
        let ran = catoptra(folder.path(), arguments);
        assert_eq!((ran.code, ran.err.as_str()), (0, ""), "{arguments:?}");
    }
    assert_eq!(
        catoptra(folder.path(), &["--version"]).out,
        concat!("catoptra ", env!("CARGO_PKG_VERSION"), "\n")
    );
}

#[test]
fn shells_and_manual_pages_know_every_command_and_option() {
    let folder = folder();
    let help = catoptra(folder.path(), &["--help"]).out;
    let commands: Vec<&str> = help
        .lines()
        .skip_while(|line| *line != "Commands:")
        .skip(1)
        .take_while(|line| !line.is_empty())
        .filter_map(|line| line.split_whitespace().next())
        .filter(|command| *command != "help")
        .collect();
    assert!(commands.len() >= 12 && commands.contains(&"cast"), "{commands:?}");
    let ran = catoptra(folder.path(), &["man", "pages"]);
    assert_eq!((ran.code, ran.out.as_str(), ran.err.as_str()), (0, "", ""));
    for shell in ["bash", "zsh", "fish", "elvish", "powershell"] {
        let ran = catoptra(folder.path(), &["completions", shell]);
        assert_eq!((ran.code, ran.err.as_str()), (0, ""));
        assert!(commands.iter().all(|command| ran.out.contains(command)), "{shell}");
    }
    for command in commands {
        let page =
            std::fs::read_to_string(folder.path().join(format!("pages/catoptra-{command}.1"))).unwrap();
        let page = page.replace('\\', "");
        let help = catoptra(folder.path(), &[command, "--help"]).out;
        let options = help.split([' ', ',', '\n']).filter(|word| word.starts_with("--") && word.len() > 2);
        for option in options.filter(|option| option.ends_with(|c: char| c.is_ascii_lowercase())) {
            assert!(page.contains(option), "{command}: {option} is not in its page");
        }
    }
    assert_refused(folder.path(), &["completions", "cmd"], &["cmd", "bash"]);
    assert_refused(folder.path(), &["man", "scene.kdl"], &["scene.kdl"]);
}

#[test]
fn mistakes_are_refused() {
    let folder = folder();
    assert_refused(folder.path(), &["rendre"], &["rendre", "render"]);
    assert_refused(folder.path(), &["render"], &["SCENE"]);
    assert_refused(folder.path(), &["render", "scene.kdl", "--sise", "4x4"], &["--sise", "--size"]);
}

#[test]
fn no_command_at_all_shows_the_help_as_an_error() {
    let folder = folder();
    assert_refused(folder.path(), &[], &["render", "explain", "compare"]);
}
