use std::ffi::OsString;
use std::fs;

use super::*;

fn names(folder: &Path) -> Vec<OsString> {
    let mut names: Vec<OsString> =
        fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().file_name()).collect();
    names.sort();
    names
}

fn new(path: &Path) -> io::Result<()> {
    write(path, |out| out.write_all(b"new"))
}

#[test]
fn a_failed_write_leaves_the_old_file_alone() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.txt");
    fs::write(&path, "old").unwrap();
    let failed = write(&path, |out| {
        out.write_all(b"half of the n")?;
        Err(io::Error::other("no room"))
    });
    assert!(failed.is_err());
    assert_eq!(fs::read_to_string(&path).unwrap(), "old");
    assert_eq!(names(folder.path()), ["a.txt"]);
}

#[test]
fn a_place_that_cannot_be_written_is_an_error_and_leaves_nothing() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("taken");
    fs::create_dir(&path).unwrap();
    fs::write(path.join("inside"), "").unwrap();
    assert!(check(&path).is_err() && new(&path).is_err());
    assert_eq!(names(folder.path()), ["taken"]);
    assert!(check(&folder.path().join("none/a.txt")).unwrap_err().to_string().contains("does not exist"));
    assert!(check(&path.join("inside/a.txt")).unwrap_err().to_string().contains("is a file"));
    assert!(check(&folder.path().join("new/")).is_err() && check(Path::new("")).is_err());
}

#[test]
fn a_write_replaces_the_old_file_and_leaves_nothing_beside() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.txt");
    fs::write(&path, "old").unwrap();
    check(&path).unwrap();
    assert_eq!(fs::read_to_string(&path).unwrap(), "old");
    new(&path).unwrap();
    assert_eq!(fs::read_to_string(&path).unwrap(), "new");
    assert_eq!(names(folder.path()), ["a.txt"]);
}

#[test]
fn a_check_leaves_nothing() {
    let folder = tempfile::tempdir().unwrap();
    check(&folder.path().join("a.txt")).unwrap();
    assert!(names(folder.path()).is_empty());
}

#[test]
fn a_file_that_is_read_only_is_refused_even_to_who_may_do_all() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.txt");
    fs::write(&path, "old").unwrap();
    let mut permissions = fs::metadata(&path).unwrap().permissions();
    permissions.set_readonly(true);
    fs::set_permissions(&path, permissions).unwrap();
    assert!(check(&path).unwrap_err().to_string().contains("read-only"));
    assert!(new(&path).is_err());
    assert_eq!(fs::read_to_string(&path).unwrap(), "old");
}

#[test]
fn spellings_of_one_file_have_one_identity() {
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| folder.path().join(name);
    fs::create_dir(at("in")).unwrap();
    fs::write(at("a"), "").unwrap();
    fs::write(at("b"), "").unwrap();
    assert_eq!(identity(&at("a")), identity(&at("in/../a")));
    assert_ne!(identity(&at("a")), identity(&at("b")));
    assert_eq!(identity(&at("none")), identity(&at("./in/../none")));
    assert_ne!(identity(&at("none")), identity(&at("other")));
    assert_eq!(identity(&at("in")), None);
}

#[cfg(unix)]
mod unix {
    use std::os::unix::fs::{MetadataExt, PermissionsExt, symlink};
    use std::os::unix::net::UnixListener;

    use super::*;

    #[test]
    fn names_as_long_as_the_system_takes_are_written() {
        let folder = tempfile::tempdir().unwrap();
        for name in ["a".repeat(255), "木".repeat(85)] {
            let path = folder.path().join(name);
            check(&path).unwrap();
            new(&path).unwrap();
            assert_eq!(fs::read_to_string(&path).unwrap(), "new");
        }
        assert!(check(&folder.path().join("a".repeat(256))).is_err());
        assert_eq!(names(folder.path()).len(), 2);
    }

    #[test]
    fn a_link_stays_one_and_its_target_is_made_or_replaced() {
        let folder = tempfile::tempdir().unwrap();
        let at = |name: &str| folder.path().join(name);
        fs::create_dir(at("in")).unwrap();
        fs::write(at("in/old"), "old").unwrap();
        symlink("in/old", at("to-old")).unwrap();
        symlink("in/none", at("to-none")).unwrap();
        symlink("to-none", at("twice")).unwrap();
        for (link, target) in [("to-old", "in/old"), ("twice", "in/none")] {
            assert_eq!(identity(&at(link)), identity(&at(target)));
            new(&at(link)).unwrap();
            assert!(fs::symlink_metadata(at(link)).unwrap().is_symlink());
            assert_eq!(fs::read_to_string(at(target)).unwrap(), "new");
        }
        symlink("in/deep/none", at("nowhere")).unwrap();
        assert!(check(&at("nowhere")).unwrap_err().to_string().contains("does not exist"));
    }

    #[test]
    fn links_in_a_circle_are_told() {
        let folder = tempfile::tempdir().unwrap();
        symlink("b", folder.path().join("a")).unwrap();
        symlink("a", folder.path().join("b")).unwrap();
        assert!(check(&folder.path().join("a")).unwrap_err().to_string().contains("circle"));
        assert!(new(&folder.path().join("a")).is_err());
        assert_eq!(names(folder.path()), ["a", "b"]);
    }

    #[test]
    fn other_names_of_a_file_keep_the_old_content() {
        let folder = tempfile::tempdir().unwrap();
        let (a, b) = (folder.path().join("a"), folder.path().join("b"));
        fs::write(&a, "old").unwrap();
        fs::hard_link(&a, &b).unwrap();
        assert_eq!(identity(&a), identity(&b));
        new(&a).unwrap();
        assert_eq!([a, b].map(|path| fs::read_to_string(path).unwrap()), ["new", "old"]);
    }

    #[test]
    fn permissions_and_owner_stay() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a");
        fs::write(&path, "old").unwrap();
        // Only the superuser gives files away: others look whether they keep their own.
        let _ = std::os::unix::fs::chown(&path, Some(12345), Some(12345));
        fs::set_permissions(&path, fs::Permissions::from_mode(0o2640)).unwrap();
        let before = fs::metadata(&path).unwrap();
        new(&path).unwrap();
        let after = fs::metadata(&path).unwrap();
        assert_ne!(before.ino(), after.ino());
        assert_eq!(
            (before.mode(), before.uid(), before.gid()),
            (after.mode(), after.uid(), after.gid()),
            "{:o}",
            after.mode()
        );
    }

    #[test]
    fn a_pipe_stays_one_and_its_reader_gets_the_bytes() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("pipe");
        let made = std::process::Command::new("mkfifo").arg(&path).status();
        if !made.is_ok_and(|status| status.success()) {
            println!("skipped: mkfifo is missing");
            return;
        }
        check(&path).unwrap();
        assert!(is_straight(&path) && identity(&path).is_none());
        let from = path.clone();
        let reader = std::thread::spawn(move || fs::read_to_string(from).unwrap());
        new(&path).unwrap();
        assert!(!fs::metadata(&path).unwrap().is_file());
        assert_eq!(reader.join().unwrap(), "new");
        assert_eq!(names(folder.path()), ["pipe"]);
    }

    #[test]
    fn a_socket_is_refused() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("socket");
        let _listener = UnixListener::bind(&path).unwrap();
        assert!(check(&path).unwrap_err().to_string().contains("socket"));
        assert!(new(&path).is_err());
        assert_eq!(names(folder.path()), ["socket"]);
    }

    #[cfg(target_os = "linux")]
    #[test]
    fn an_open_descriptor_gets_the_bytes_at_its_end() {
        use std::os::fd::AsRawFd;

        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("log");
        fs::write(&path, "before ").unwrap();
        let open = fs::OpenOptions::new().append(true).open(&path).unwrap();
        let descriptor = format!("/dev/fd/{}", open.as_raw_fd());
        let descriptor = Path::new(&descriptor);
        assert!(is_descriptor(descriptor) && !is_descriptor(&path));
        assert_eq!(identity(descriptor), identity(&path));
        check(descriptor).unwrap();
        new(descriptor).unwrap();
        assert_eq!(fs::read_to_string(&path).unwrap(), "before new");
        assert!(check(Path::new("/dev/fd/987654")).unwrap_err().to_string().contains("not open"));
    }
}
