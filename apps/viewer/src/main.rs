//! The viewer: a window that shows a ray-traced scene, to be turned, lit and changed.

mod actions;
#[cfg(test)]
mod any_order;
mod app;
mod arithmetic;
mod ball;
mod browse;
mod camera_control;
mod canvas;
mod clipped;
mod comparison;
mod deeds;
mod desktop_dialog;
mod difference;
mod document;
mod draft;
mod dropped;
mod editing;
mod egui_paint;
mod egui_textures;
mod events;
mod exposure;
mod fit;
mod fly;
mod frame_worker;
mod framing;
mod free_name;
mod gestures;
mod guard;
mod icon;
mod input;
mod keeping;
mod keys;
mod latest;
mod light_parts;
mod lighting;
mod loader;
mod making;
mod memory;
mod naming;
mod opening;
mod options;
mod outline;
mod overlays;
mod panel;
mod parts;
mod pass;
mod pictures;
mod preview;
mod recent;
mod recovery;
mod redraw;
mod refine;
mod retype;
mod saving;
mod screen;
#[cfg(feature = "screen-reader")]
mod screen_reader;
mod seeing;
mod selection;
mod shown;
mod status;
mod tracing;
mod transform;
mod turns;
mod viewer;
mod viewpoint;
mod views;
mod walk;
mod watch;

use std::io::Write as _;
use std::process::ExitCode;
use std::sync::Arc;

use catoptra_tracer::Pool;
use clap::Parser as _;
use mimalloc::MiMalloc;
use winit::event_loop::EventLoop;

use app::{App, Wake};
use options::Options;

/// Films are many small columns that several threads ask for: this allocator gives their memory back to the system after a
/// large picture, where that of the C library keeps a gigabyte.
#[global_allocator]
static ALLOCATOR: MiMalloc = MiMalloc;

/// What is told where there is no display.
const NO_DISPLAY: &str = "catoptra-viewer needs a display and found none\n\
    without one, `catoptra render SCENE -o OUT.png` traces a scene into a picture";

/// The exit code of a viewer that was told to end.
const INTERRUPTED: u8 = 130;

fn main() -> ExitCode {
    match run(Options::parse()) {
        Ok(code) => code,
        Err(why) => {
            // It is no further error if nobody hears it.
            let _ = writeln!(std::io::stderr(), "error: {why}");
            ExitCode::from(2)
        }
    }
}

/// What the window library says, without the place in its own source that it names.
fn reason(said: &str) -> &str {
    let after_place = said.split_once(".rs:").and_then(|(_, rest)| rest.split_once(": "));
    after_place.map_or(said, |(_, reason)| reason)
}

fn run(options: Options) -> Result<ExitCode, String> {
    let events = EventLoop::<Wake>::with_user_event()
        .build()
        .map_err(|why| format!("{NO_DISPLAY}\n({})", reason(&why.to_string())))?;
    let pool = Arc::new(Pool::new(options.threads.map_or(0, usize::from)).map_err(|e| e.to_string())?);
    let window_pool = Pool::new(pool.threads()).map_err(|e| e.to_string())?;
    let balls = ball::BallTracing::new(Pool::new(1).map_err(|e| e.to_string())?)?;
    let opened = loader::welcome(&pool)?;
    let proxy = events.create_proxy();
    let told = ctrlc::set_handler(move || {
        // The loop may have ended; then there is nothing to end.
        let _ = proxy.send_event(Wake::Ended);
    });
    told.map_err(|why| format!("the viewer cannot hear when it is to end: {why}"))?;
    let mut app = App::new(options, opened, pool, (window_pool, balls), events.create_proxy());
    events.run_app(&mut app).map_err(|e| e.to_string())?;
    let code = if app.ended { ExitCode::from(INTERRUPTED) } else { ExitCode::SUCCESS };
    app.failure.map_or(Ok(code), Err)
}

#[cfg(test)]
mod tests {
    use super::reason;

    #[test]
    fn a_reason_names_no_source_file() {
        assert_eq!(reason("os error at /build/x11/mod.rs:788: no X server: none"), "no X server: none");
        assert_eq!(reason("no X server"), "no X server");
    }
}
