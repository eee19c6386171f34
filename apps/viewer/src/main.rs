//! The viewer: a window that shows a ray-traced scene, to be turned, lit and changed.

mod actions;
mod app;
mod camera_control;
mod canvas;
mod document;
mod egui_paint;
mod events;
mod frame_worker;
mod guard;
mod input;
mod keys;
mod latest;
mod loader;
mod options;
mod outline;
mod panel;
mod redraw;
mod refine;
mod screen;
mod status;
mod tracing;
mod viewer;

use std::process::ExitCode;
use std::sync::Arc;

use catoptra_tracer::Pool;
use clap::Parser as _;
use winit::event_loop::EventLoop;

use app::{App, Wake};
use options::Options;

/// What is told where there is no display.
const NO_DISPLAY: &str = "catoptra-viewer needs a display and found none\n\
    without one, `catoptra render SCENE -o OUT.png` traces a scene into a picture";

fn main() -> ExitCode {
    match run(Options::parse()) {
        Ok(()) => ExitCode::SUCCESS,
        Err(why) => {
            eprintln!("error: {why}");
            ExitCode::from(2)
        }
    }
}

fn run(options: Options) -> Result<(), String> {
    let events =
        EventLoop::<Wake>::with_user_event().build().map_err(|why| format!("{NO_DISPLAY}\n({why})"))?;
    let pool = Arc::new(Pool::new(options.threads).map_err(|e| e.to_string())?);
    let encoder = Pool::new(1).map_err(|e| e.to_string())?;
    let opened = loader::welcome(&pool)?;
    let mut app = App::new(options, opened, pool, encoder, events.create_proxy());
    events.run_app(&mut app).map_err(|e| e.to_string())?;
    app.failure.map_or(Ok(()), Err)
}
