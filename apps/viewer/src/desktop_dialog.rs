//! How is a file chosen by the desktop's own dialog? Through its portal, where that can show one; the dialog in the window stays
//! beneath it.

use std::path::{Path, PathBuf};
use std::sync::OnceLock;

use crate::browse::Purpose;

/// What a portal's description says where it can show dialogs for files.
const CHOOSES_FILES: &str = "org.freedesktop.impl.portal.FileChooser";

/// Whether the desktop can show one; looked up once.
pub(crate) fn is_there() -> bool {
    static THERE: OnceLock<bool> = OnceLock::new();
    *THERE.get_or_init(|| {
        let bus = std::env::var_os("DBUS_SESSION_BUS_ADDRESS").is_some()
            || std::env::var_os("XDG_RUNTIME_DIR")
                .is_some_and(|folder| Path::new(&folder).join("bus").exists());
        let folders = std::env::var_os("XDG_DATA_DIRS").filter(|folders| !folders.is_empty());
        let folders = folders.unwrap_or_else(|| "/usr/local/share:/usr/share".into());
        bus && cfg!(all(unix, not(target_os = "macos"))) && has_portal(std::env::split_paths(&folders))
    })
}

/// Whether one of these folders of data describes a portal that can show dialogs for files.
fn has_portal(folders: impl Iterator<Item = PathBuf>) -> bool {
    let portals =
        folders.filter_map(|folder| std::fs::read_dir(folder.join("xdg-desktop-portal/portals")).ok());
    portals.flatten().filter_map(Result::ok).any(|entry| {
        std::fs::read_to_string(entry.path()).is_ok_and(|description| description.contains(CHOOSES_FILES))
    })
}

/// Asks on a thread of its own, beginning in that folder and with that name; `done` hears there what was chosen, `None` for
/// nothing.
pub(crate) fn ask(
    purpose: &Purpose,
    folder: &Path,
    name: String,
    done: impl FnOnce(Option<PathBuf>) + Send + 'static,
) {
    let (purpose, folder) = (purpose.clone(), folder.to_owned());
    std::thread::spawn(move || done(chosen(&purpose, &folder, name)));
}

#[cfg(all(unix, not(target_os = "macos")))]
fn chosen(purpose: &Purpose, folder: &Path, name: String) -> Option<PathBuf> {
    let endings = purpose.endings();
    let dialog = rfd::FileDialog::new().set_title(purpose.title()).set_directory(folder);
    let dialog = dialog.add_filter(endings.join(", "), &endings);
    match purpose {
        Purpose::Open | Purpose::Model => dialog.pick_file(),
        Purpose::Save(_) | Purpose::Picture(_) => dialog.set_file_name(name).save_file(),
    }
}

#[cfg(not(all(unix, not(target_os = "macos"))))]
fn chosen(_: &Purpose, _: &Path, _: String) -> Option<PathBuf> {
    None
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_portal_counts_that_chooses_files() {
        let folder = tempfile::tempdir().unwrap();
        let (empty, data) = (folder.path().join("empty"), folder.path().join("data"));
        let portals = data.join("xdg-desktop-portal/portals");
        std::fs::create_dir_all(&portals).unwrap();
        let found = || has_portal([empty.clone(), data.clone()].into_iter());
        std::fs::write(portals.join("shots.portal"), "Interfaces=org.freedesktop.impl.portal.Screenshot;\n")
            .unwrap();
        assert!(!found());
        std::fs::write(portals.join("gtk.portal"), format!("[portal]\nInterfaces={CHOOSES_FILES};\n"))
            .unwrap();
        assert!(found());
    }
}
