//! What does the mouse do?

/// What the mouse does, and keys that go through buttons, for the help: what is done, and what follows.
pub(crate) const OTHERS: &[(&str, &str)] = &[
    ("Click", "select what is under the pointer; once more: the group that holds it"),
    ("Shift or Ctrl click", "select one more, or one less; Shift in the tree: all up to there"),
    ("Left drag", "orbit the camera; turntable: turn the objects"),
    ("Middle drag", "orbit the camera; with Shift pan, with Ctrl zoom"),
    ("Right or Shift drag", "pan"),
    ("W A S D, Q E, right button held", "move the camera ahead, aside, back; down and up"),
    ("Left drag on a handle", "move, turn or scale what is selected; numbers, Ctrl and Esc as with G"),
    ("X Y Z while moving", "along that axis, again: its own; with Shift in a plane"),
    ("Left drag on a mark", "move a light or a camera"),
    ("Left drag on an aim", "aim the selected light at what is under the pointer"),
    ("Left drag on a ring", "change a spot light's cone angle"),
    ("Left drag on a rim", "change the size of the selected lamp: sides, corners too"),
    ("Wheel", "zoom to the pointer; turntable: along the view"),
    ("Ctrl wheel", "the other of the two"),
    ("Drop a scene", "open it; asks about unsaved edits"),
    ("Drop a picture", "make it the texture of the selected shape"),
    ("Drag in the tree", "put rows elsewhere: between others, into a group, out of it"),
    ("Right click in the tree", "what can be done with what is selected"),
    ("Ctrl and +, -, 0", "panel and text larger, smaller, as usual"),
    ("Tab, Enter", "go through a question's buttons, press one"),
];
