//! What does a desktop tell a window? That its close button was pressed (ICCCM 4.2.8.1), and that a file was dropped on
//! it (XDND 5: enter, position, the file's address on demand, drop).

use std::error::Error;
use std::path::Path;
use std::thread::sleep;
use std::time::Instant;

use x11rb::connection::Connection as _;
use x11rb::protocol::Event;
use x11rb::protocol::xproto::{
    ClientMessageEvent, ConnectionExt as _, CreateWindowAux, EventMask, PropMode, SELECTION_NOTIFY_EVENT,
    SelectionNotifyEvent, SelectionRequestEvent, WindowClass,
};
use x11rb::rust_connection::RustConnection;

use crate::programs::LOOK;
use crate::stage::PATIENCE;
use x11rb::wrapper::ConnectionExt as _;

/// A desktop's own connection to the screen.
struct Desktop {
    connection: RustConnection,
    /// A window that nobody sees, from which files are dragged.
    source: u32,
    target: u32,
}

/// Presses the close button of a window.
pub(crate) fn close(display: &str, window: u32) -> Result<(), Box<dyn Error>> {
    let desktop = Desktop::new(display, window)?;
    let protocols = desktop.atom("WM_PROTOCOLS")?;
    let delete = desktop.atom("WM_DELETE_WINDOW")?;
    desktop.tell(protocols, [delete, 0, 0, 0, 0])?;
    desktop.connection.sync()?;
    Ok(())
}

/// Drops a file on a window, and waits until it has taken the file.
pub(crate) fn drop_file(display: &str, window: u32, file: &Path) -> Result<(), Box<dyn Error>> {
    let desktop = Desktop::new(display, window)?;
    let selection = desktop.atom("XdndSelection")?;
    let addresses = desktop.atom("text/uri-list")?;
    desktop.connection.set_selection_owner(desktop.source, selection, x11rb::CURRENT_TIME)?;
    let source = desktop.source;
    desktop.tell(desktop.atom("XdndEnter")?, [source, 5 << 24, addresses, 0, 0])?;
    let copy = desktop.atom("XdndActionCopy")?;
    desktop.tell(desktop.atom("XdndPosition")?, [source, 0, 100 << 16 | 100, 0, copy])?;
    let finished = desktop.atom("XdndFinished")?;
    let begin = Instant::now();
    while begin.elapsed() < PATIENCE {
        let Some(event) = desktop.connection.poll_for_event()? else {
            sleep(LOOK);
            continue;
        };
        match event {
            Event::SelectionRequest(request) => {
                desktop.answer(&request, &format!("file://{}\r\n", file.display()))?;
                desktop.tell(desktop.atom("XdndDrop")?, [source, 0, 0, 0, 0])?;
            }
            Event::ClientMessage(message) if message.type_ == finished => return Ok(()),
            _ => {}
        }
    }
    Err("the window does not take the file".into())
}

impl Desktop {
    fn new(display: &str, target: u32) -> Result<Self, Box<dyn Error>> {
        let (connection, screen) = x11rb::connect(Some(display))?;
        let source = connection.generate_id()?;
        let root = connection.setup().roots[screen].root;
        let nothing = CreateWindowAux::new();
        connection.create_window(0, source, root, 0, 0, 1, 1, 0, WindowClass::INPUT_ONLY, 0, &nothing)?;
        Ok(Self { connection, source, target })
    }

    fn atom(&self, name: &str) -> Result<u32, Box<dyn Error>> {
        Ok(self.connection.intern_atom(false, name.as_bytes())?.reply()?.atom)
    }

    /// Sends the window a message.
    fn tell(&self, kind: u32, data: [u32; 5]) -> Result<(), Box<dyn Error>> {
        let message = ClientMessageEvent::new(32, self.target, kind, data);
        self.connection.send_event(false, self.target, EventMask::NO_EVENT, message)?;
        self.connection.flush()?;
        Ok(())
    }

    /// Gives the window the text that it asks for.
    fn answer(&self, request: &SelectionRequestEvent, text: &str) -> Result<(), Box<dyn Error>> {
        let SelectionRequestEvent { requestor, selection, target, property, time, .. } = *request;
        self.connection.change_property8(PropMode::REPLACE, requestor, property, target, text.as_bytes())?;
        let notice = SelectionNotifyEvent {
            response_type: SELECTION_NOTIFY_EVENT,
            sequence: 0,
            time,
            requestor,
            selection,
            target,
            property,
        };
        self.connection.send_event(false, requestor, EventMask::NO_EVENT, notice)?;
        Ok(())
    }
}
