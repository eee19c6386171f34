//! What do other programs see on the clipboard, and what do they put there (ICCCM 2)? A program of ours asks for the
//! selection or owns it.

use std::error::Error;

use x11rb::connection::Connection as _;
use x11rb::protocol::Event;
use x11rb::protocol::xproto::{
    AtomEnum, ConnectionExt as _, CreateWindowAux, EventMask, PropMode, SELECTION_NOTIFY_EVENT,
    SelectionNotifyEvent, SelectionRequestEvent, WindowClass,
};
use x11rb::rust_connection::RustConnection;
use x11rb::wrapper::ConnectionExt as _;

/// A program's connection to the screen, and a window that nobody sees.
struct Program {
    connection: RustConnection,
    window: u32,
    clipboard: u32,
    text: u32,
}

impl Program {
    fn new(display: &str) -> Result<Self, Box<dyn Error>> {
        let (connection, screen) = x11rb::connect(Some(display))?;
        let window = connection.generate_id()?;
        let root = connection.setup().roots[screen].root;
        connection.create_window(
            0,
            window,
            root,
            0,
            0,
            1,
            1,
            0,
            WindowClass::INPUT_ONLY,
            0,
            &CreateWindowAux::new(),
        )?;
        let atom = |name: &[u8]| connection.intern_atom(false, name).map(x11rb::cookie::Cookie::reply);
        let (clipboard, text) = (atom(b"CLIPBOARD")??.atom, atom(b"UTF8_STRING")??.atom);
        Ok(Self { connection, window, clipboard, text })
    }

    fn answer(&self, request: &SelectionRequestEvent, text: &str) -> Result<(), Box<dyn Error>> {
        let is_text = request.target == self.text;
        if is_text {
            self.connection.change_property8(
                PropMode::REPLACE,
                request.requestor,
                request.property,
                self.text,
                text.as_bytes(),
            )?;
        } else {
            self.connection.change_property32(
                PropMode::REPLACE,
                request.requestor,
                request.property,
                AtomEnum::ATOM,
                &[self.text],
            )?;
        }
        let notify = SelectionNotifyEvent {
            response_type: SELECTION_NOTIFY_EVENT,
            sequence: 0,
            time: request.time,
            requestor: request.requestor,
            selection: request.selection,
            target: request.target,
            property: request.property,
        };
        self.connection.send_event(false, request.requestor, EventMask::NO_EVENT, notify)?;
        self.connection.flush()?;
        Ok(())
    }
}

/// The text on the clipboard.
pub(crate) fn read(display: &str) -> Result<String, Box<dyn Error>> {
    let program = Program::new(display)?;
    let Program { connection, window, clipboard, text } = &program;
    connection.convert_selection(*window, *clipboard, *text, *text, x11rb::CURRENT_TIME)?;
    connection.flush()?;
    loop {
        if let Event::SelectionNotify(event) = connection.wait_for_event()? {
            if event.property == x11rb::NONE {
                return Ok(String::new());
            }
            let reply = connection.get_property(true, *window, *text, AtomEnum::ANY, 0, 1 << 20)?.reply()?;
            return Ok(String::from_utf8_lossy(&reply.value).into_owned());
        }
    }
}

/// Puts a text on the clipboard, for as long as the screen is there.
pub(crate) fn put(display: &str, text: &str) -> Result<(), Box<dyn Error>> {
    let (program, text) = (Program::new(display)?, text.to_owned());
    program.connection.set_selection_owner(program.window, program.clipboard, x11rb::CURRENT_TIME)?;
    program.connection.sync()?;
    std::thread::spawn(move || {
        // It ends with the screen.
        while let Ok(event) = program.connection.wait_for_event() {
            if let Event::SelectionRequest(request) = event
                && program.answer(&request, &text).is_err()
            {
                return;
            }
        }
    });
    Ok(())
}
