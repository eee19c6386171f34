//! Which file does a person mean? A folder and what lies in it, a name that is typed, and what the file is for.

use std::path::{Path, PathBuf};

use crate::guard::Next;
use crate::pictures::Spec;

/// What a file is wanted for.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) enum Purpose {
    /// To be opened.
    Open,
    /// To be written; then comes this.
    Save(Option<Next>),
    /// To be put into the scene, as a model.
    Model,
    /// To hold a picture like that.
    Picture(Spec),
}

impl Purpose {
    /// What a person is asked for.
    pub(crate) fn title(&self) -> &'static str {
        match self {
            Self::Open => "Open a scene or a model",
            Self::Save(_) => "Save the scene as",
            Self::Model => "Put a model into the scene",
            Self::Picture(_) => "Write the picture",
        }
    }

    /// How the names of files end that fit.
    pub(crate) fn endings(&self) -> Vec<&'static str> {
        let models = catoptra_scene::model::endings();
        match self {
            Self::Open => std::iter::once("kdl").chain(models).collect(),
            Self::Save(_) => vec!["kdl"],
            Self::Model => models.collect(),
            Self::Picture(_) => vec!["png", "exr"],
        }
    }

    /// The ending that a name gets which has none, where the file is to be written.
    fn ending(&self) -> Option<&'static str> {
        match self {
            Self::Save(_) => Some("kdl"),
            Self::Picture(_) => Some("png"),
            Self::Open | Self::Model => None,
        }
    }
}

/// One line of a folder.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Entry {
    pub(crate) name: String,
    pub(crate) is_folder: bool,
}

/// A person's way to a file.
#[derive(Debug, Clone)]
pub(crate) struct Browser {
    pub(crate) purpose: Purpose,
    pub(crate) folder: PathBuf,
    /// A name or a path.
    pub(crate) typed: String,
    pub(crate) entries: Vec<Entry>,
    /// Why nothing came of what was chosen.
    pub(crate) problem: Option<String>,
    /// A file that is there already, to be replaced if that is chosen again.
    pub(crate) replaces: Option<PathBuf>,
    /// The desktop's own dialog stands over this one.
    pub(crate) waits: bool,
}

impl Browser {
    /// In that folder, with a name to begin with.
    pub(crate) fn new(purpose: Purpose, folder: &Path, typed: String) -> Self {
        let (entries, problem, replaces) = (Vec::new(), None, None);
        let folder_there = PathBuf::new();
        let mut browser =
            Self { purpose, folder: folder_there, typed, entries, problem, replaces, waits: false };
        browser.go(folder);
        browser
    }

    /// Goes to a folder; one that cannot be read is told and left.
    pub(crate) fn go(&mut self, folder: &Path) {
        self.replaces = None;
        let there = std::path::absolute(Path::new(".").join(folder)).and_then(|folder| {
            let entries = entries(&folder, &self.purpose)?;
            Ok((folder, entries))
        });
        match there {
            Ok((folder, entries)) => {
                (self.folder, self.entries, self.problem) = (folder, entries, None);
            }
            Err(why) => self.problem = Some(format!("{}: {why}", folder.display())),
        }
    }

    /// Goes to the folder that this one lies in.
    pub(crate) fn go_up(&mut self) {
        if let Some(outer) = self.folder.parent().map(Path::to_owned) {
            self.go(&outer);
        }
    }

    /// Chooses what the desktop's dialog has answered, which has asked already whether a file is to be replaced.
    pub(crate) fn choose_whole(&mut self, path: PathBuf) -> Option<PathBuf> {
        self.typed = path.to_string_lossy().into_owned();
        self.replaces = Some(path);
        self.choose()
    }

    /// Chooses what was typed: a folder is gone to, a file is answered with. A file that would be replaced must be chosen
    /// twice.
    pub(crate) fn choose(&mut self) -> Option<PathBuf> {
        let typed = self.typed.trim();
        if typed.is_empty() {
            return None;
        }
        let mut path = self.folder.join(from_home(typed));
        if path.is_dir() {
            self.typed.clear();
            self.go(&path);
            return None;
        }
        let Some(ending) = self.purpose.ending() else {
            if path.is_file() {
                return Some(path);
            }
            self.problem = Some(format!("there is no file “{typed}”"));
            return None;
        };
        if path.extension().is_none() {
            path.set_extension(ending);
        }
        if let Purpose::Picture(spec) = &self.purpose
            && let Some(problem) = spec.problem(&path)
        {
            self.problem = Some(problem);
            return None;
        }
        if path.exists() && self.replaces.as_ref() != Some(&path) {
            self.problem = Some(format!("{} is there already", path.display()));
            self.replaces = Some(path);
            return None;
        }
        Some(path)
    }
}

/// What lies in a folder and can be chosen: folders first, then files, by name.
fn entries(folder: &Path, purpose: &Purpose) -> std::io::Result<Vec<Entry>> {
    let found = std::fs::read_dir(folder)?.filter_map(Result::ok).map(|entry| {
        let is_folder = entry.path().is_dir();
        Entry { name: entry.file_name().to_string_lossy().into_owned(), is_folder }
    });
    let shown =
        |entry: &Entry| !entry.name.starts_with('.') && (entry.is_folder || fits(&entry.name, purpose));
    let mut entries: Vec<Entry> = found.filter(shown).collect();
    entries.sort_by_key(|entry| (!entry.is_folder, entry.name.to_lowercase()));
    Ok(entries)
}

fn fits(name: &str, purpose: &Purpose) -> bool {
    let ending = Path::new(name).extension().unwrap_or_default();
    purpose.endings().iter().any(|fitting| ending.eq_ignore_ascii_case(fitting))
}

/// `~` at the start is the person's own folder.
fn from_home(typed: &str) -> PathBuf {
    let home = || Some(directories::BaseDirs::new()?.home_dir().to_owned());
    match typed.strip_prefix('~') {
        Some("") => home().unwrap_or_else(|| typed.into()),
        Some(rest) if rest.starts_with('/') => {
            home().map_or_else(|| typed.into(), |home| home.join(&rest[1..]))
        }
        _ => typed.into(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn names(browser: &Browser) -> Vec<&str> {
        browser.entries.iter().map(|entry| entry.name.as_str()).collect()
    }

    fn folder() -> tempfile::TempDir {
        let folder = tempfile::tempdir().unwrap();
        for name in ["b.kdl", "A.kdl", "c.obj", "d.txt", ".hidden.kdl"] {
            std::fs::write(folder.path().join(name), "").unwrap();
        }
        std::fs::create_dir(folder.path().join("inner")).unwrap();
        folder
    }

    #[test]
    fn folders_come_first_and_only_what_fits_is_listed() {
        let folder = folder();
        let at = |purpose| Browser::new(purpose, folder.path(), String::new());
        assert_eq!(names(&at(Purpose::Open)), ["inner", "A.kdl", "b.kdl", "c.obj"]);
        assert_eq!(names(&at(Purpose::Save(None))), ["inner", "A.kdl", "b.kdl"]);
        assert_eq!(names(&at(Purpose::Model)), ["inner", "c.obj"]);
    }

    #[test]
    fn a_folder_is_gone_to_and_a_file_is_answered_with() {
        let folder = folder();
        let mut browser = Browser::new(Purpose::Open, folder.path(), "inner".to_owned());
        assert_eq!(browser.choose(), None);
        assert_eq!((names(&browser), browser.typed.as_str()), (Vec::new(), ""));
        browser.go_up();
        browser.typed = "none.kdl".to_owned();
        assert_eq!((browser.choose(), browser.problem.is_some()), (None, true));
        browser.typed = folder.path().join("A.kdl").display().to_string();
        assert_eq!(browser.choose(), Some(folder.path().join("A.kdl")));
        browser.go(Path::new("/no such folder"));
        assert!(browser.problem.is_some() && browser.folder.ends_with(folder.path().file_name().unwrap()));
    }

    #[test]
    fn what_the_desktop_asked_about_is_not_asked_about_again() {
        let folder = folder();
        let mut browser = Browser::new(Purpose::Save(None), folder.path(), "new".to_owned());
        let there = folder.path().join("A.kdl");
        assert_eq!(browser.choose_whole(there.clone()), Some(there.clone()));
        assert_eq!(browser.choose_whole(there.with_extension("")), None, "with an ending it is another");
        assert!(browser.problem.is_some());
    }

    #[test]
    fn a_file_is_replaced_only_when_chosen_twice() {
        let folder = folder();
        let mut browser = Browser::new(Purpose::Save(None), folder.path(), "new".to_owned());
        assert_eq!(browser.choose(), Some(folder.path().join("new.kdl")));
        browser.typed = "A".to_owned();
        assert_eq!(browser.choose(), None);
        assert!(browser.problem.is_some());
        browser.typed = "b.kdl".to_owned();
        assert_eq!(browser.choose(), None, "that is another");
        assert_eq!(browser.choose(), Some(folder.path().join("b.kdl")));
    }
}
