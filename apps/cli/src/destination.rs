//! Can what is asked for be written, and would it overwrite what is read? Told before any work is done.

use std::path::{Path, PathBuf};

use catoptra_scene::atomic;
use miette::{Result, miette};

/// A file that is to be written: the option that asks for it, and where.
pub(crate) type Output<'a> = (&'static str, &'a Path);

/// A file that is read: what it is, and where it lies.
pub(crate) type Input = (&'static str, PathBuf);

/// Refuses files that cannot be written.
pub(crate) fn check_writable(outputs: &[Output<'_>]) -> Result<()> {
    outputs.iter().try_for_each(|(_, path)| {
        atomic::check(path).map_err(|error| miette!("{} cannot be written: {error}", path.display()))
    })
}

/// Refuses a file to be written that is another such file or is read, however the names are spelt and linked.
pub(crate) fn check_apart(outputs: &[Output<'_>], inputs: &[Input]) -> Result<()> {
    let inputs: Vec<_> = inputs.iter().map(|input| (atomic::identity(&input.1), input)).collect();
    let mut before: Vec<(atomic::FileId, &Output<'_>)> = Vec::new();
    for output in outputs {
        let (option, path) = output;
        let Some(file) = atomic::identity(path) else { continue };
        if let Some((_, (what, input))) = inputs.iter().find(|(input, _)| input.as_ref() == Some(&file)) {
            let help = "write to another file";
            return Err(miette!(help = help, "{option} would overwrite {what} {}", input.display()));
        }
        if let Some((_, (other, _))) = before.iter().find(|(other, _)| *other == file) {
            let help = "give each a file of its own";
            return Err(miette!(help = help, "{other} and {option} both write {}", path.display()));
        }
        before.push((file, output));
    }
    Ok(())
}

/// Refuses a folder that is neither there nor can be made, or in which these files cannot be written.
pub(crate) fn check_folder(folder: &Path, names: &[&str]) -> Result<()> {
    let Some(there) = folder.ancestors().find(|there| there.as_os_str().is_empty() || there.exists()) else {
        return Ok(());
    };
    let files: Vec<PathBuf> = if there == folder {
        names.iter().map(|name| folder.join(name)).collect()
    } else {
        let missing = folder.strip_prefix(there).ok().and_then(|rest| rest.components().next());
        missing.map(|part| there.join(part)).into_iter().collect()
    };
    let outputs: Vec<Output<'_>> = files.iter().map(|file| ("--out", file.as_path())).collect();
    check_apart(&outputs, &[])?;
    check_writable(&outputs)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_folder_is_checked_as_far_as_it_is_there() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path();
        check_folder(&path.join("a/b"), &["c"]).unwrap();
        check_folder(path, &["c"]).unwrap();
        std::fs::write(path.join("file"), "").unwrap();
        for (folder, name) in [("file", "c"), ("file/in", "c"), ("", "file/c")] {
            assert!(check_folder(&path.join(folder), &[name]).is_err(), "{folder} {name}");
        }
        assert_eq!(std::fs::read_dir(path).unwrap().count(), 1);
    }

    #[test]
    fn outputs_are_held_against_inputs_and_each_other() {
        let folder = tempfile::tempdir().unwrap();
        let [scene, other] = ["scene", "other"].map(|name| folder.path().join(name));
        std::fs::write(&scene, "").unwrap();
        let inputs = [("the scene", scene.clone())];
        let spelt = folder.path().join("./scene");
        let told = |outputs: &[Output<'_>]| {
            check_apart(outputs, &inputs).map_err(|error| error.to_string()).unwrap_err()
        };
        assert!(told(&[("--stats", &spelt)]).contains("--stats would overwrite the scene"));
        assert!(told(&[("-o", &other), ("--stats", &other)]).contains("-o and --stats both write"));
        check_apart(&[("-o", &other)], &inputs).unwrap();
        check_apart(&[("-o", Path::new("/dev/null")), ("--stats", Path::new("/dev/null"))], &inputs).unwrap();
    }
}
