//! How a scene and its text are held together: loading, following edits, saving.

use std::fs::{File, Metadata};
use std::io::{IsTerminal, Read};
use std::path::{Path, PathBuf};

use catoptra_core::scene::Scene;

use crate::atomic;
use crate::build::{self, Id};
use crate::disk::{self, OnDisk};
use crate::instance::{self, Instance};
use crate::outline::{Outline, Sort};
use crate::printable;
use crate::read::{self, Files, LONGEST};
use crate::report::{Complaints, SceneTextError};
use crate::slip::{self, Mended};
use crate::write::{self, Splice};
use crate::{bare, foreign, model};

/// The text of a scene, kept so that saving changes only what has changed.
///
/// Belongs to the [`Scene`] it was loaded with (or made for), whose ids it remembers.
#[derive(Debug, Clone)]
pub struct SceneFile {
    path: Option<PathBuf>,
    /// What the file at `path` held when it was read or written last.
    stored: String,
    text: String,
    outline: Outline,
    /// What every item of the outline stands for.
    ids: Vec<Id>,
    files: Files,
    /// What came from model files and is as they and the text say.
    models: Vec<Instance>,
    added: Option<String>,
}

/// A scene that could not be saved; what was on the disk before is there still.
#[derive(Debug, thiserror::Error, miette::Diagnostic)]
#[error("{}: cannot be written: {cause}", printable(&path.to_string_lossy()))]
#[diagnostic(code(catoptra::save))]
pub struct SaveError {
    path: PathBuf,
    cause: std::io::Error,
}

/// Reads a scene file, or a model file as a scene of its own: with a view of it and light where it has none, and with no
/// path, so that it is not saved over the model. Meshes and profiles are looked for relative to its folder; for what lies in none, such as a pipe or
/// `/dev/stdin`, relative to the current one.
///
/// # Errors
/// A file that cannot be read or is no valid scene, with all that is wrong in it.
pub fn load(path: &Path) -> Result<(Scene, SceneFile), SceneTextError> {
    let unreadable = |cause| SceneTextError::unreadable(path, &cause);
    let found = std::fs::metadata(path).map_err(unreadable)?;
    if found.is_dir() {
        return Err(SceneTextError::unusable(path, "is a folder, not a scene".to_owned()));
    }
    let input = File::open(path).map_err(unreadable)?;
    if is_device(&found) && !input.is_terminal() {
        return Err(SceneTextError::unusable(path, "is a device, not a scene".to_owned()));
    }
    if found.is_file() && model::is_named_so(path) {
        return bare::load(path);
    }
    let lies_in_folder = found.is_file() && !atomic::is_descriptor(path);
    let base = path.parent().filter(|_| lies_in_folder).unwrap_or(Path::new(""));
    let (scene, mut file) = load_from(input, path, base)?;
    file.path = Some(path.to_owned());
    file.stored.clone_from(&file.text);
    Ok((scene, file))
}

/// Reads a scene to the end of `input`, which `name` stands for in messages; `base` is the folder at which relative
/// paths start.
///
/// # Errors
/// As for [`load`].
pub fn load_from(input: impl Read, name: &Path, base: &Path) -> Result<(Scene, SceneFile), SceneTextError> {
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
    parse(&text, &name, Some(base))
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
        let (scene, ids, models) = build::build(&outline, &mut complaints);
        if complaints.count() == 0 {
            let text = text.to_owned();
            let file = SceneFile {
                path: None,
                stored: String::new(),
                text,
                outline,
                ids,
                files,
                models,
                added: None,
            };
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

impl SceneFile {
    /// The same with a line about what was added to a model.
    pub(crate) fn with_added(self, added: Option<String>) -> Self {
        Self { added, ..self }
    }

    /// Text for a scene that has none yet.
    #[must_use]
    pub fn new(scene: &Scene) -> Self {
        let mut file = Self {
            path: None,
            stored: String::new(),
            text: String::new(),
            outline: Outline::default(),
            ids: Vec::new(),
            files: Files::new(None),
            models: Vec::new(),
            added: None,
        };
        file.update(scene);
        file
    }

    /// The file it was loaded from or saved to last.
    #[must_use]
    pub fn path(&self) -> Option<&Path> {
        self.path.as_deref()
    }

    /// Whether that file still holds what was read from it or written to it last: to be asked before it is saved to
    /// again, since [`Self::save`] replaces whatever stands there.
    #[must_use]
    pub fn on_disk(&self) -> OnDisk {
        self.path.as_deref().map_or(OnDisk::Missing, |path| disk::compare(path, self.stored.as_bytes()))
    }

    /// Where the meshes lie that it names.
    pub fn mesh_paths(&self) -> impl Iterator<Item = PathBuf> {
        self.files.mesh_paths()
    }

    /// Where the models lie that it names.
    pub fn model_paths(&self) -> impl Iterator<Item = PathBuf> {
        self.files.model_paths()
    }

    /// What of the models is not shown as their files mean it: a line for each.
    #[must_use]
    pub fn warnings(&self) -> Vec<String> {
        self.files.warnings()
    }

    /// One line about what was added to a model that was loaded as a scene, if anything was.
    #[must_use]
    pub fn added(&self) -> Option<&str> {
        self.added.as_deref()
    }

    /// Where the intensity profiles lie that it names.
    pub fn profile_paths(&self) -> impl Iterator<Item = PathBuf> {
        self.files.profile_paths()
    }

    /// Where the pictures lie that it names.
    pub fn image_paths(&self) -> impl Iterator<Item = PathBuf> {
        self.files.image_paths()
    }

    /// The text, as of the last [`Self::update`].
    #[must_use]
    pub fn text(&self) -> String {
        self.text.clone()
    }

    /// Makes the text say what the scene holds, changing only what has changed. Comments, order, blank lines and the
    /// spelling of numbers that did not change stay; a node goes with its line and the comment behind it.
    pub fn update(&mut self, scene: &Scene) {
        self.know_files(scene);
        self.write_out_models(scene);
        if self.follow(scene).is_none() {
            // No text that we wrote ourselves could be read again: begin anew rather than lose an edit.
            self.text.clear();
            self.outline = Outline::default();
            self.ids.clear();
            self.models.clear();
            let _ = self.follow(scene);
        }
    }

    /// Updates the text and writes it to `path`, whole or not at all.
    ///
    /// Paths of meshes and profiles are written as they are in the scene: saved to another folder, the scene needs them
    /// there.
    ///
    /// # Errors
    /// A file that cannot be written.
    pub fn save(&mut self, scene: &Scene, path: &Path) -> Result<(), SaveError> {
        self.update(scene);
        atomic::write(path, |out| std::io::Write::write_all(out, self.text.as_bytes()))
            .map_err(|cause| SaveError { path: path.to_owned(), cause })?;
        self.path = Some(path.to_owned());
        self.stored.clone_from(&self.text);
        Ok(())
    }

    /// A changed text is read again, but the files that it names are not.
    fn know_files(&mut self, scene: &Scene) {
        for id in scene.entities() {
            let values = match (scene.shape(id), scene.light(id)) {
                (Some(shape), _) if shape.as_mesh().is_some() => shape.values(),
                (_, Some(light)) => light.values(),
                _ => continue,
            };
            values.iter().for_each(|(_, value)| self.files.know(value));
        }
        for (_, _, texture) in scene.textures() {
            texture.values().iter().for_each(|(_, value)| self.files.know(value));
        }
    }

    /// Takes the nodes of models out that are no longer as the text and their files say: what they hold is then written like
    /// everything else.
    fn write_out_models(&mut self, scene: &Scene) {
        self.models.retain(|model| model.is_intact(scene));
        let mut splices: Vec<Splice> = Vec::new();
        for (item, id) in self.outline.items.iter().zip(&self.ids) {
            let inside = splices.last().is_some_and(|s| s.range.contains(&item.span.start));
            let is_kept = self.models.iter().any(|model| model.root().map(Id::Entity) == Some(*id));
            if matches!(item.sort, Sort::Model) && !is_kept && !inside {
                splices.push(Splice::new(write::whole_node(&self.text, &item.span), ""));
            }
        }
        let _ = self.splice(scene, splices);
        let ids = &self.ids;
        self.models.retain(|model| model.root().is_some_and(|root| ids.contains(&Id::Entity(root))));
    }

    fn follow(&mut self, scene: &Scene) -> Option<()> {
        self.splice(scene, write::edit(&self.text, &self.outline, &self.ids, scene))?;
        // Every call settles at least one node.
        let hidden = instance::hidden(&self.models, scene);
        for _ in 0..=self.ids.len() + scene.entities().len() + 2 {
            let splices = write::arrange(&self.text, &self.outline, &self.ids, scene, &hidden);
            if splices.is_empty() {
                break;
            }
            self.splice(scene, splices)?;
        }
        self.splice(scene, write::remove(&self.text, &self.outline, &self.ids, scene))
    }

    /// Changes the text and reads it again; `None` if it does not say then what it should.
    fn splice(&mut self, scene: &Scene, splices: Vec<Splice>) -> Option<()> {
        if splices.is_empty() {
            return Some(());
        }
        let starts: Vec<usize> = self.outline.items.iter().map(|item| item.span.start).collect();
        let (text, moved, new) = write::apply(&self.text, splices, &starts);
        let mut complaints = Complaints::new();
        let names = scene.textures().map(|(id, name, _)| (name.to_owned(), id)).collect();
        let outline = read::read(&text, Some(names), &mut self.files, &mut complaints);
        if complaints.count() > 0 {
            return None;
        }
        let mut kept = moved.iter().zip(&self.ids).filter_map(|(at, id)| at.map(|at| (at, *id))).peekable();
        let mut new = new.into_iter();
        let mut ids = Vec::with_capacity(outline.items.len());
        for item in &outline.items {
            ids.push(match kept.next_if(|(at, _)| *at == item.span.start) {
                Some((_, id)) => id,
                None => new.next()?,
            });
        }
        if kept.next().is_some() || new.next().is_some() {
            return None;
        }
        (self.text, self.outline, self.ids) = (text, outline, ids);
        Some(())
    }
}
