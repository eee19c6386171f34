//! Which picture does a person want in a file: how large, how fine and where? And what is told of it while it is made and
//! after. No window, no drawing.

mod make;
#[cfg(test)]
mod tests;

use std::ffi::OsStr;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use catoptra_core::Integrator;
use catoptra_tracer::{Control, Size, View};

use crate::browse::Purpose;
use crate::free_name::free_name;
use crate::viewer::Viewer;

pub(crate) use make::{Order, Outcome, Unfinished};

/// The largest side of a picture, in pixels.
pub(crate) const LARGEST_SIDE: u32 = 65_535;

/// What a picture is to be like.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Spec {
    /// Pixels across.
    pub(crate) width: u32,
    /// Pixels down.
    pub(crate) height: u32,
    /// Samples a pixel; where the scene says how sure pixels are to be, the most.
    pub(crate) samples: u32,
    /// What its colours are.
    pub(crate) colors: Colors,
}

/// What the colours of a picture are.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Colors {
    /// Light: as it is shown (PNG) or as it is (OpenEXR).
    Light,
    /// They stand for numbers and the like: a sample to a pixel, and no light that an OpenEXR could hold.
    False,
}

/// Kinds of picture files.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Format {
    /// 8 bits a channel, as shown.
    Png,
    /// Linear light, 32 bits.
    Exr,
}

impl Format {
    /// The one that the ending of a name says.
    pub(crate) fn of(path: &Path) -> Option<Self> {
        match path.extension()?.to_str()?.to_lowercase().as_str() {
            "png" => Some(Self::Png),
            "exr" => Some(Self::Exr),
            _ => None,
        }
    }
}

impl Spec {
    /// Why a picture like that cannot go into that file; `None` where it can.
    pub(crate) fn problem(&self, path: &Path) -> Option<String> {
        match (Format::of(path), self.colors) {
            (Some(Format::Png), _) | (Some(Format::Exr), Colors::Light) => None,
            (Some(Format::Exr), Colors::False) => {
                Some("false colours are no light that an .exr could hold: name it .png".to_owned())
            }
            (None, _) => Some("name it .png (8 bits, as shown) or .exr (linear light, 32 bits)".to_owned()),
        }
    }
}

/// A picture that is to be made.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Wish {
    pub(crate) spec: Spec,
    pub(crate) path: PathBuf,
}

/// A picture that is being made.
pub(crate) struct UnderWay {
    pub(crate) path: PathBuf,
    pub(crate) control: Arc<Control>,
}

/// The pictures that a person wants in files; one is made at a time.
#[derive(Default)]
pub(crate) struct Pictures {
    /// What was asked for last.
    last: Option<Wish>,
    /// What is to be begun now.
    wanted: Option<Wish>,
    under_way: Option<UnderWay>,
}

impl Pictures {
    /// The picture that is being made.
    pub(crate) fn under_way(&self) -> Option<&UnderWay> {
        self.under_way.as_ref()
    }

    /// The file of a picture that is being made and has not been given up.
    pub(crate) fn unfinished(&self) -> Option<&Path> {
        let under_way = self.under_way.as_ref().filter(|under_way| !under_way.control.is_cancelled());
        under_way.map(|under_way| under_way.path.as_path())
    }

    /// Gives up the picture that is being made.
    pub(crate) fn cancel(&self) {
        if let Some(under_way) = &self.under_way {
            under_way.control.cancel();
        }
    }

    /// What was asked for of another scene is no more what one would ask for.
    pub(crate) fn forget(&mut self) {
        self.last = None;
    }
}

impl Viewer {
    /// Asks how large and how fine a picture is to be, and where it is to go.
    pub(crate) fn ask_for_picture(&mut self) {
        if self.is_making_picture() {
            return;
        }
        let place = self.picture_place();
        let folder = place.parent().unwrap_or(Path::new(""));
        let name = place.file_name().map(|name| name.to_string_lossy().into_owned()).unwrap_or_default();
        self.browse(Purpose::Picture(self.picture_spec()), folder, name);
    }

    /// Wants one more picture like the last one, or like the one that is seen, beside it under a free name.
    pub(crate) fn picture_again(&mut self) {
        if self.is_making_picture() {
            return;
        }
        let Some(Wish { spec, path }) = &self.pictures.last else {
            return self.want_picture(self.picture_place(), self.picture_spec());
        };
        let name = |part: Option<&OsStr>| part.unwrap_or_default().to_string_lossy().into_owned();
        let folder = path.parent().unwrap_or(Path::new(""));
        let path = free_name(folder, &name(path.file_stem()), &name(path.extension()));
        // What is shown may have changed since.
        let spec = Spec { colors: self.picture_spec().colors, ..*spec };
        match spec.problem(&path) {
            Some(problem) => self.notify(problem),
            None => self.pictures.wanted = Some(Wish { spec, path }),
        }
    }

    /// Wants a picture in that file, whatever stands there.
    pub(crate) fn want_picture(&mut self, path: PathBuf, spec: Spec) {
        let wish = Wish { spec, path };
        self.pictures.last = Some(wish.clone());
        self.pictures.wanted = Some(wish);
    }

    fn is_making_picture(&mut self) -> bool {
        let told = self.pictures.under_way().map(|under_way| {
            format!("{} is still being made: wait for it or cancel it", under_way.path.display())
        });
        told.map(|told| self.notify(told)).is_some()
    }

    /// As the scene asks for, and as many as take the steps from edges or most of the noise from paths.
    fn picture_samples(&self) -> u32 {
        let usual = match self.request().view.integrator {
            Integrator::Whitted => 16,
            Integrator::Occlusion | Integrator::Path => 256,
        };
        self.document.scene().settings().samples().max(usual)
    }

    /// As large as the picture that is seen, and smooth.
    fn picture_spec(&self) -> Spec {
        let (width, height) = (self.size.0.max(1), self.size.1.max(1));
        match self.settings.pass.paint {
            None => Spec { width, height, samples: self.picture_samples(), colors: Colors::Light },
            Some(_) => Spec { width, height, samples: 1, colors: Colors::False },
        }
    }

    /// Beside the scene's file, or among the person's pictures where it has none.
    fn picture_place(&self) -> PathBuf {
        let beside = self.document.source().and_then(Path::parent).map(Path::to_owned);
        let folder = beside.or_else(pictures_folder).unwrap_or_default();
        free_name(&folder, &self.document.name(), "png")
    }

    /// The order to make a picture of what is shown now, once; it counts as under way from then on.
    pub(crate) fn take_picture_order(&mut self) -> Option<Order> {
        let wish = self.pictures.wanted.take()?;
        let Spec { width, height, samples, .. } = wish.spec;
        let mut request = self.request();
        let max_error = self.document.scene().settings().max_error();
        let is_plain = request.pass.paint.is_none() && request.pass.integrator.is_none();
        request.view = View { size: Size::new(width, height), samples, ..request.view };
        let control = Arc::new(Control::default());
        let under_way = UnderWay { path: wish.path.clone(), control: Arc::clone(&control) };
        self.pictures.under_way = Some(under_way);
        self.stale.panel = true;
        Some(Order { wish, request, max_error: max_error.filter(|_| is_plain), control })
    }

    /// Takes in what became of a picture.
    pub(crate) fn picture_made(&mut self, Outcome { path, result }: Outcome) {
        self.pictures.under_way = None;
        self.stale.panel = true;
        let name = path.display();
        match result {
            Ok(()) => {
                self.comparison.typed = name.to_string();
                self.notify(format!("wrote {name}"));
            }
            Err(Unfinished::Cancelled) => self.notify(format!("{name} was cancelled: nothing is written")),
            Err(Unfinished::Failed(problem)) => {
                self.failure = Some(format!("{name} was not written: {problem}"));
            }
        }
    }
}

/// The folder of the person's pictures, or else of all that is theirs.
fn pictures_folder() -> Option<PathBuf> {
    let folders = directories::UserDirs::new()?;
    Some(folders.picture_dir().unwrap_or(folders.home_dir()).to_owned())
}
