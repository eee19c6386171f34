//! How a scene comes from a file, a stream or a text.

use std::fs::{File, Metadata};
use std::io::{IsTerminal, Read};
use std::path::Path;
use std::sync::Arc;

use catoptra_core::scene::Scene;
use catoptra_core::{Cancelled, Control};

use super::{SceneFile, Wording};
use crate::build::{self, Built};
use crate::read::{self, Files, LONGEST};
use crate::report::{Complaints, SceneTextError};
use crate::slip::{self, Mended};
use crate::watch::Watch;
use crate::{atomic, bare, foreign, model};

/// Reads a scene file, or a model file as a scene of its own: with a view of it and light where it has none, and with no
/// path, so that it is not saved over the model. Meshes and profiles are looked for relative to its folder; for what lies in none, such as a pipe or
/// `/dev/stdin`, relative to the current one.
///
/// ```no_run
/// let (scene, file) = catoptra_scene::load("scene.kdl".as_ref())?;
/// println!("{} things", scene.entities().len());
/// # let _ = file; // It keeps the text, for whoever saves the scene again.
/// # Ok::<(), catoptra_scene::SceneTextError>(())
/// ```
///
/// # Errors
/// A file that cannot be read or is no valid scene, with all that is wrong in it.
pub fn load(path: &Path) -> Result<(Scene, SceneFile), SceneTextError> {
    load_watched(path, &Watch::default())
}

/// As [`load`], telling `control` which share of the text is read with the meshes, models and pictures that it names; a cancelled
/// one stops before the next file.
///
/// # Errors
/// As for [`load`], and [`LoadError::Cancelled`] when `control` said so.
pub fn load_unless_cancelled(path: &Path, control: &Arc<Control>) -> Result<(Scene, SceneFile), LoadError> {
    let loaded = load_watched(path, &Watch::by(control));
    control.check()?;
    let (scene, mut file) = loaded?;
    file.files.watch = Watch::default();
    Ok((scene, file))
}

/// Why there is no scene.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum LoadError {
    /// The file is no scene.
    #[error(transparent)]
    Scene(#[from] SceneTextError),
    /// It was asked to stop.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
}

fn load_watched(path: &Path, watch: &Watch) -> Result<(Scene, SceneFile), SceneTextError> {
    let unreadable = |cause| SceneTextError::unreadable(path, &cause);
    let found = std::fs::metadata(path).map_err(unreadable)?;
    if found.is_dir() {
        return Err(SceneTextError::unusable(path, "is a folder, not a scene".to_owned()));
    }
    let input = File::open(path).map_err(unreadable)?;
    if is_device(&found) && !input.is_terminal() {
        return Err(SceneTextError::unusable(path, "is a device, not a scene".to_owned()));
    }
    let is_named_scene = path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("kdl"));
    let is_model = model::is_named_so(path) || (!is_named_scene && model::begins_as_one(path));
    if found.is_file() && is_model {
        return bare::load(path, watch);
    }
    let lies_in_folder = found.is_file() && !atomic::is_descriptor(path);
    let base = path.parent().filter(|_| lies_in_folder).unwrap_or(Path::new(""));
    let (scene, mut file) = load_from_watched(input, path, base, watch)?;
    file.path = Some(path.to_owned());
    file.stored.clone_from(&file.now.text);
    Ok((scene, file))
}

/// Reads a scene to the end of `input`, which `name` stands for in messages; `base` is the folder at which relative
/// paths start.
///
/// # Errors
/// As for [`load`].
pub fn load_from(input: impl Read, name: &Path, base: &Path) -> Result<(Scene, SceneFile), SceneTextError> {
    load_from_watched(input, name, base, &Watch::default())
}

fn load_from_watched(
    input: impl Read,
    name: &Path,
    base: &Path,
    watch: &Watch,
) -> Result<(Scene, SceneFile), SceneTextError> {
    let mut bytes = Vec::new();
    let read = input.take(LONGEST as u64 + 1).read_to_end(&mut bytes);
    read.map_err(|cause| SceneTextError::unreadable(name, &cause))?;
    if let Some((message, help)) = foreign::told(name, &bytes) {
        return Err(SceneTextError::unusable(name, message).with_help(help));
    }
    if bytes.len() > LONGEST {
        let message = format!("is longer than {} MiB, too long for scene text", LONGEST >> 20);
        return Err(SceneTextError::unusable(name, message));
    }
    let name = name.display().to_string();
    let text = String::from_utf8(bytes).map_err(|e| not_utf8(&e, &name))?;
    parse_with(&text, &name, Files::new(Some(base)).watched(watch))
}

#[cfg(unix)]
fn is_device(found: &Metadata) -> bool {
    use std::os::unix::fs::FileTypeExt;

    found.file_type().is_char_device() || found.file_type().is_block_device()
}

#[cfg(not(unix))]
fn is_device(_found: &Metadata) -> bool {
    false
}

/// Reads scene text that `name` stands for in messages; `base` is the folder at which relative paths start.
///
/// # Errors
/// Text that is no valid scene, with all that is wrong in it.
///
/// ```
/// let text = r#"
/// matte "red" { color 0.8 0.1 0.1 }
/// sphere "ball" material="red" { radius 1 }
/// "#;
/// let (scene, _) = catoptra_scene::parse(text, "example", None)?;
/// assert!(scene.entity_named("ball").is_some());
///
/// // What is wrong is told with its place and what to write instead.
/// let error = catoptra_scene::parse("spere \"ball\"", "example", None).err().ok_or("no error")?;
/// assert!(error.to_string().contains("spere"));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn parse(text: &str, name: &str, base: Option<&Path>) -> Result<(Scene, SceneFile), SceneTextError> {
    parse_with(text, name, Files::new(base))
}

/// The same with files that may be known.
pub(crate) fn parse_with(
    text: &str,
    name: &str,
    mut files: Files,
) -> Result<(Scene, SceneFile), SceneTextError> {
    let mended = slip::mend(text);
    let mut complaints = Complaints::new();
    if mended.as_ref().is_none_or(Mended::is_doubtful) {
        let outline = read::read(text, None, &mut files, &mut complaints);
        let Built { scene, ids, models, repeats } = build::build(&outline, &mut complaints);
        if complaints.count() == 0 {
            let text = text.to_owned();
            let wording = Wording { text, outline, ids, models, resting: Vec::new(), repeats };
            let file = SceneFile::of(wording, files);
            return Ok((scene, file));
        }
    }
    if let Some(mended) = mended {
        complaints = without_slips(&mended, &mut files);
    }
    Err(complaints.into_error(name, text))
}

/// All that is wrong with a text: its slips, and what is found behind them.
fn without_slips(mended: &Mended, files: &mut Files) -> Complaints {
    let (mut slips, mut behind) = (Complaints::new(), Complaints::new());
    mended.tell(&mut slips);
    if mended.is_to_be_read() {
        let outline = read::read(&mended.text, None, files, &mut behind);
        build::build(&outline, &mut behind);
        slips.take_over(behind, |at| mended.place(at));
    }
    slips
}

fn not_utf8(error: &std::string::FromUtf8Error, name: &str) -> SceneTextError {
    let valid = error.utf8_error().valid_up_to();
    let text = String::from_utf8_lossy(error.as_bytes());
    let mut complaints = Complaints::new();
    let message = format!("byte {valid} of the file is no UTF-8 text");
    complaints.add_with(valid..valid + 3, message, "save the file as UTF-8");
    complaints.into_error(name, &text)
}
