//! Which files does each picture go to? Names with `{scene}`, `{camera}` and `{frame}` in them stand for many.

use std::path::{Path, PathBuf};

use catoptra_scene::atomic::is_straight;
use miette::{Result, miette};

use crate::args::RenderArgs;
use crate::destination::Output;

/// What a picture shows.
#[derive(Debug, Clone, Copy)]
pub(super) struct Subject<'a> {
    /// The name of the scene's file, without its ending.
    pub(super) scene: &'a str,
    pub(super) camera: &'a str,
    /// The number of the frame from 1 up, and how many there are.
    pub(super) frame: Option<[u32; 2]>,
}

/// Digits of the number of a frame, at least.
const DIGITS: usize = 4;

impl Subject<'_> {
    /// A name with what stands for the places in it.
    fn named(&self, template: &Path) -> PathBuf {
        let Some(text) = template.to_str() else { return template.to_owned() };
        let [number, count] = self.frame.unwrap_or([1, 1]);
        let digits = DIGITS.max(count.to_string().len());
        let text = text.replace("{frame}", &format!("{number:0digits$}"));
        text.replace("{camera}", &plain(self.camera)).replace("{scene}", &plain(self.scene)).into()
    }

    /// A line to tell it from the others by.
    pub(super) fn words(&self) -> String {
        let frame =
            self.frame.map_or_else(String::new, |[number, count]| format!(", frame {number} of {count}"));
        format!("{} through \"{}\"{frame}", self.scene, self.camera)
    }
}

/// A name as a part of a file's: without what parts folders and what cannot be seen.
fn plain(name: &str) -> String {
    let plain = |c: char| if std::path::is_separator(c) || c.is_control() || c == ':' { '-' } else { c };
    name.chars().map(plain).collect()
}

/// The files that one picture goes to.
#[derive(Debug, Clone, Default)]
pub(super) struct Files {
    pub(super) picture: Option<PathBuf>,
    pub(super) stats: Option<PathBuf>,
    pub(super) film: Option<PathBuf>,
}

impl Files {
    /// Files by the names that options give, which may have places in them.
    pub(super) fn given(args: &RenderArgs) -> Self {
        Self { picture: args.picture.output.clone(), stats: args.stats.clone(), film: args.film.clone() }
    }

    /// The files of one picture.
    pub(super) fn of(&self, subject: &Subject<'_>) -> Self {
        let named = |path: &Option<PathBuf>| path.as_deref().map(|path| subject.named(path));
        Self { picture: named(&self.picture), stats: named(&self.stats), film: named(&self.film) }
    }

    /// The files, with the options that ask for them.
    pub(super) fn outputs(&self) -> Vec<Output<'_>> {
        let named = [("--output", &self.picture), ("--stats", &self.stats), ("--film", &self.film)];
        named.into_iter().filter_map(|(option, path)| Some((option, path.as_deref()?))).collect()
    }

    /// Those whose names have no places in them, and so are known before a scene is read.
    pub(super) fn known(&self) -> Self {
        let known = |path: &Option<PathBuf>| path.clone().filter(|path| !has_places(path));
        Self { picture: known(&self.picture), stats: known(&self.stats), film: known(&self.film) }
    }
}

fn has_places(path: &Path) -> bool {
    let text = path.to_string_lossy();
    ["{scene}", "{camera}", "{frame}"].iter().any(|place| text.contains(place))
}

/// The name of a picture for which none is given.
pub(super) fn usual(cameras: usize, frames: bool, ending: &str) -> PathBuf {
    let camera = if cameras > 1 { "-{camera}" } else { "" };
    let frame = if frames { "-{frame}" } else { "" };
    format!("{{scene}}{camera}{frame}.{ending}").into()
}

/// Refuses a file that is written for several pictures; what takes bytes as they come takes them one after another.
pub(super) fn check_single(all: &[Files]) -> Result<()> {
    let mut seen = std::collections::HashSet::new();
    for (option, path) in all.iter().flat_map(Files::outputs) {
        if !seen.insert((option, path)) && !is_straight(path) {
            return Err(miette!(
                help =
                    "put {{scene}}, {{camera}} or {{frame}} into the name, such as -o \"shot-{{frame}}.png\"",
                "{option} would write several pictures to {}",
                path.display()
            ));
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn places_are_filled() {
        let subject = Subject { scene: "room", camera: "lamp/eye", frame: Some([7, 120]) };
        let named = |template: &str| subject.named(Path::new(template)).display().to_string();
        assert_eq!(named("out/{scene}-{camera}.{frame}.exr"), "out/room-lamp-eye.0007.exr");
        assert_eq!(named("{other}.png"), "{other}.png");
        assert_eq!(usual(2, true, "png"), Path::new("{scene}-{camera}-{frame}.png"));
        let many = Subject { frame: Some([7, 12_000]), ..subject };
        assert_eq!(many.named(Path::new("{frame}")), Path::new("00007"));
    }

    #[test]
    fn two_pictures_need_two_names() {
        let files = |name: &str| Files { picture: Some(name.into()), ..Files::default() };
        check_single(&[files("a.png"), files("b.png")]).unwrap();
        check_single(&[files("/dev/null"), files("/dev/null")]).unwrap();
        assert!(check_single(&[files("a.png"), files("a.png")]).is_err());
    }
}
