//! Where does a path lead, and may something be written there?

use std::ffi::OsString;
use std::fs::{self, File, Metadata, OpenOptions};
use std::io::{self, ErrorKind};
use std::path::{Path, PathBuf};

/// Links that are followed one after another; Linux gives up at as many.
const MOST_LINKS: usize = 40;

/// What a path leads to.
pub(super) enum Place {
    /// A regular file, or a name without a file yet; the path holds no link at its end.
    File { path: PathBuf, old: Option<Metadata> },
    /// What takes bytes as they come.
    Sink(Sink),
}

/// What takes bytes as they come.
pub(super) enum Sink {
    /// A device or a pipe.
    Special(PathBuf),
    /// What the program was started with, such as `/dev/stdout`: its number. It may be a file whose end others write to.
    Descriptor(u32),
}

impl Place {
    /// Follows links to their end, dangling ones too.
    pub(super) fn of(path: &Path) -> io::Result<Self> {
        if path.as_os_str().as_encoded_bytes().last().is_none_or(|&end| std::path::is_separator(end.into())) {
            return Err(io::Error::new(ErrorKind::InvalidInput, "it names no file"));
        }
        let mut path = path.to_owned();
        for _ in 0..=MOST_LINKS {
            if let Some(number) = descriptor(&path) {
                return Ok(Self::Sink(Sink::Descriptor(number)));
            }
            let found = match fs::symlink_metadata(&path) {
                // Whether the folder is missing is told apart later.
                Err(e) if matches!(e.kind(), ErrorKind::NotFound | ErrorKind::NotADirectory) => {
                    return Ok(Self::File { path, old: None });
                }
                found => found?,
            };
            if !found.is_symlink() {
                return Self::at(path, found);
            }
            path = folder_of(&path).join(fs::read_link(&path)?);
        }
        Err(io::Error::other("its links go round in a circle"))
    }

    fn at(path: PathBuf, found: Metadata) -> io::Result<Self> {
        if found.is_dir() {
            return Err(is_folder());
        }
        if found.is_file() {
            return Ok(Self::File { path, old: Some(found) });
        }
        if is_socket(&found) {
            return Err(io::Error::new(ErrorKind::Unsupported, "it is a socket, which takes no file"));
        }
        Ok(Self::Sink(Sink::Special(path)))
    }
}

impl Sink {
    /// Opens it to be written, whatever it holds already.
    pub(super) fn open(&self) -> io::Result<File> {
        match self {
            Self::Special(path) => OpenOptions::new().write(true).open(path),
            Self::Descriptor(number) => open_descriptor(*number),
        }
    }

    /// Tries what can be tried without being noticed at the other end.
    pub(super) fn check(&self) -> io::Result<()> {
        match self {
            Self::Special(path) => may_write(path),
            Self::Descriptor(number) => match fs::metadata(descriptor_path(*number)) {
                Ok(found) if found.is_dir() => Err(is_folder()),
                Ok(_) => Ok(()),
                Err(_) => {
                    Err(io::Error::new(ErrorKind::NotFound, format!("descriptor {number} is not open")))
                }
            },
        }
    }
}

fn is_folder() -> io::Error {
    io::Error::new(ErrorKind::IsADirectory, "it is a folder, not a file")
}

/// The folder that a path lies in.
pub(super) fn folder_of(path: &Path) -> &Path {
    path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."))
}

/// Refuses a file that may not be replaced, or a name in no folder.
pub(super) fn check_file(path: &Path, old: Option<&Metadata>) -> io::Result<()> {
    let folder = folder_of(path);
    let refused = |kind: ErrorKind, why: &str| {
        Err(io::Error::new(kind, format!("the folder {} {why}", folder.display())))
    };
    let around = match fs::metadata(folder) {
        Ok(around) if around.is_dir() => around,
        Ok(_) => return refused(ErrorKind::NotADirectory, "is a file"),
        Err(e) if e.kind() == ErrorKind::NotFound => return refused(e.kind(), "does not exist"),
        Err(e) => return refused(e.kind(), &format!("cannot be used: {e}")),
    };
    let Some(old) = old else { return Ok(()) };
    if old.permissions().readonly() {
        return Err(io::Error::new(ErrorKind::PermissionDenied, "it is there already and read-only"));
    }
    may_write(path)?;
    if is_kept_by_owner(old, &around) {
        let why = "it belongs to somebody else, in a folder where only its owner may replace it";
        return Err(io::Error::new(ErrorKind::PermissionDenied, why));
    }
    Ok(())
}

/// What file a path leads to, told apart from all others however the path is written; `None` for what is no file, and
/// where that cannot be known.
#[must_use]
pub fn identity(path: &Path) -> Option<FileId> {
    match Place::of(path).ok()? {
        Place::File { old: Some(old), path } => Some(FileId::of(&old, &path)),
        Place::File { old: None, path } => {
            let folder = folder_of(&path);
            let found = fs::metadata(folder).ok()?;
            Some(FileId { name: Some(path.file_name()?.to_owned()), ..FileId::of(&found, folder) })
        }
        Place::Sink(Sink::Descriptor(number)) => {
            let path = descriptor_path(number);
            let found = fs::metadata(&path).ok()?;
            found.is_file().then(|| FileId::of(&found, &path))
        }
        Place::Sink(Sink::Special(_)) => None,
    }
}

/// Tells a file from all others. A file that is not there yet is told by its folder and name.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct FileId {
    #[cfg(unix)]
    inode: (u64, u64),
    #[cfg(not(unix))]
    path: Option<PathBuf>,
    /// In that folder.
    name: Option<OsString>,
}

impl FileId {
    #[cfg(unix)]
    fn of(found: &Metadata, _path: &Path) -> Self {
        use std::os::unix::fs::MetadataExt;

        Self { inode: (found.dev(), found.ino()), name: None }
    }

    #[cfg(not(unix))]
    fn of(_found: &Metadata, path: &Path) -> Self {
        Self { path: fs::canonicalize(path).ok(), name: None }
    }
}

/// Whether a path names one of the program's own open descriptors, such as `/dev/stdin` or what a shell writes for
/// `<(...)`.
#[must_use]
pub fn is_descriptor(path: &Path) -> bool {
    matches!(Place::of(path), Ok(Place::Sink(Sink::Descriptor(_))))
}

/// The number of the program's own descriptor that a path names, as Linux does in `/proc`.
fn descriptor(path: &Path) -> Option<u32> {
    let number = path.file_name()?.to_str()?.parse().ok()?;
    let folder = fs::canonicalize(folder_of(path)).ok()?;
    let own = Path::new("/proc").join(std::process::id().to_string());
    (folder.starts_with(own) && folder.ends_with("fd")).then_some(number)
}

fn descriptor_path(number: u32) -> PathBuf {
    Path::new("/proc/self/fd").join(number.to_string())
}

#[cfg(unix)]
fn open_descriptor(number: u32) -> io::Result<File> {
    use std::os::fd::AsFd;

    match number {
        1 => io::stdout().as_fd().try_clone_to_owned().map(File::from),
        2 => io::stderr().as_fd().try_clone_to_owned().map(File::from),
        other => OpenOptions::new().append(true).open(descriptor_path(other)),
    }
}

#[cfg(not(unix))]
fn open_descriptor(number: u32) -> io::Result<File> {
    OpenOptions::new().append(true).open(descriptor_path(number))
}

#[cfg(unix)]
fn may_write(path: &Path) -> io::Result<()> {
    Ok(rustix::fs::access(path, rustix::fs::Access::WRITE_OK)?)
}

#[cfg(not(unix))]
fn may_write(_path: &Path) -> io::Result<()> {
    Ok(())
}

#[cfg(unix)]
fn is_socket(found: &Metadata) -> bool {
    std::os::unix::fs::FileTypeExt::is_socket(&found.file_type())
}

#[cfg(not(unix))]
fn is_socket(_found: &Metadata) -> bool {
    false
}

/// Whether the folder is one like `/tmp`, where a file is moved away or replaced by its owner only.
#[cfg(unix)]
fn is_kept_by_owner(old: &Metadata, folder: &Metadata) -> bool {
    use std::os::unix::fs::MetadataExt;

    let user = rustix::process::geteuid().as_raw();
    folder.mode() & 0o1000 != 0 && ![old.uid(), folder.uid(), 0].contains(&user)
}

#[cfg(not(unix))]
fn is_kept_by_owner(_old: &Metadata, _folder: &Metadata) -> bool {
    false
}
