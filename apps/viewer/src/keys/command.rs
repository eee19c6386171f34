//! What can a person ask for by a key or from a menu?

use catoptra_raster::Tool;

use crate::seeing::See;
use crate::views::Side;

/// What a key asks for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Command {
    /// Show or hide the list of keys.
    Help,
    /// Show or hide the panel.
    Panel,
    /// Move the camera so that everything is seen.
    FrameAll,
    /// Move the camera so that the selected thing is seen.
    FrameSelected,
    /// Go back to the scene's camera.
    ResetCamera,
    /// Look through the scene's next camera.
    NextCamera,
    /// Look at the same target from a side.
    Look(Side),
    /// Look with parallel rays, or with perspective again.
    OtherProjection,
    /// Move the camera in its own plane: steps to the right and up.
    Step(i8, i8),
    /// Change between orbiting the camera and turning the objects.
    ToggleMode,
    /// Show or hide all overlays.
    ToggleOverlays,
    /// Select nothing, close what is open.
    Escape,
    /// Take what is selected out of the scene.
    Delete,
    /// Choose something to be added.
    Add,
    /// Make one more of what is selected.
    Duplicate,
    /// Take what is selected to the clipboard.
    Cut,
    /// Put what is selected on the clipboard.
    Copy,
    /// Put into the scene what is on the clipboard.
    Paste,
    /// Give the selected thing another name.
    Rename,
    /// Make a group of what is selected.
    Group,
    /// Take the members out of the selected groups.
    Ungroup,
    /// Hide what is selected, or show it again.
    Hide,
    /// Show all that is hidden.
    ShowAll,
    /// Lock what is selected, or unlock it.
    Lock,
    /// Select all that stands at the top of the scene.
    SelectAll,
    /// Take the last edit back.
    Undo,
    /// Make the last edit that was taken back again.
    Redo,
    /// Write the scene.
    Save,
    /// Write the scene to another file.
    SaveAs,
    /// Begin a new scene.
    New,
    /// Open a file.
    Open,
    /// Read the open file again.
    Reload,
    /// Ask for a picture in a file.
    Picture,
    /// Write one more picture like the last.
    PictureAgain,
    /// Look at the scene otherwise.
    See(See),
    /// Move, turn or scale what is selected with the pointer.
    Transform(Tool),
    /// Show the next handles about what is selected.
    NextTool,
    /// Put things onto surfaces as they are moved, or no more.
    OnSurfaces,
    /// Look through the selected light or camera, which then goes along, or end that.
    Fly,
    /// Close the window.
    Quit,
}

impl Command {
    /// Whether it is meant even while something is being typed.
    pub(crate) fn is_everywhere(self) -> bool {
        matches!(
            self,
            Self::Save | Self::SaveAs | Self::New | Self::Open | Self::Reload | Self::Quit | Self::Help
        )
    }
}
