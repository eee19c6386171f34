//! What happens when? Events of the window, finished frames and opened files become changes of the viewer; whatever
//! went stale is asked for once the events are through; then the loop sleeps.

use std::path::PathBuf;
use std::sync::Arc;
use std::time::Instant;

use catoptra_tracer::Pool;
use winit::application::ApplicationHandler;
use winit::event::{StartCause, WindowEvent};
use winit::event_loop::{ActiveEventLoop, ControlFlow, EventLoopProxy};
use winit::keyboard::ModifiersState;
use winit::window::WindowId;

use crate::ball::BallTracing;
use crate::comparison;
use crate::dropped;
use crate::frame_worker::{Finished, FrameWorker};
use crate::guard::Next;
use crate::keeping::Keeper;
use crate::loader::{Opened, Outcome};
use crate::memory::GivingBack;
use crate::options::Options;
use crate::overlays::Overlays;
use crate::pictures;
use crate::recovery::{self, Kept};
use crate::screen::Screen;
use crate::status::Meter;
use crate::tracing::{Frame, PoolTracing};
use crate::viewer::Viewer;
use crate::watch::Watch;

/// What other threads wake the window for.
pub(crate) enum Wake {
    /// A frame was finished.
    Frame,
    /// A file was read.
    Opened(Outcome),
    /// A picture that was dropped was read.
    Picture(dropped::picture::Outcome),
    /// A model that was dropped was read.
    Model(dropped::model::Outcome),
    /// A picture to compare with was read.
    Comparison(comparison::Outcome),
    /// A picture of a material was finished.
    Ball,
    /// A picture went into its file, or did not.
    Made(pictures::Outcome),
    /// Files of the scene were changed.
    Changed(Vec<PathBuf>),
    /// The desktop's own dialog has answered with a file, or with none.
    Chosen(Option<PathBuf>),
    /// A screen reader asks for something.
    #[cfg(feature = "screen-reader")]
    ScreenReader(egui_winit::accesskit_winit::WindowEvent),
    /// Unsaved edits could not be kept.
    NotKept(String),
    /// The viewer is told to end.
    Ended,
}

/// The running viewer.
pub(crate) struct App {
    pub(crate) options: Options,
    pub(crate) viewer: Viewer,
    pub(crate) pool: Arc<Pool>,
    /// Threads that only draw and lay out what the window shows, so that it never waits for what the pool is busy with.
    pub(crate) window_pool: Pool,
    pub(crate) worker: FrameWorker<PoolTracing>,
    /// Traces the picture of a material.
    balls: FrameWorker<BallTracing>,
    pub(crate) screen: Option<Screen>,
    pub(crate) modifiers: ModifiersState,
    /// The frame in the window.
    pub(crate) shown: Option<Finished<Frame>>,
    /// The number of the newest request.
    pub(crate) asked: u64,
    pub(crate) overlays: Overlays,
    pub(crate) meter: Meter,
    pub(crate) last_frame: Option<Instant>,
    pub(crate) status_due: Option<Instant>,
    pub(crate) giving_back: GivingBack,
    pub(crate) shown_title: String,
    /// The window has to be presented as a whole.
    pub(crate) exposed: bool,
    /// Whether the pointer was last seen over the picture.
    pub(crate) over_picture: bool,
    /// Why the viewer had to stop.
    pub(crate) failure: Option<String>,
    /// The scene named at the start is being read; until it is there nothing is traced.
    pub(crate) starting: bool,
    pub(crate) proxy: EventLoopProxy<Wake>,
    pub(crate) ticket: u64,
    /// The revision of the scene when a file was last asked for: edits up to there may go for it.
    pub(crate) wished_at: u64,
    /// The files of the scene.
    pub(crate) watch: Watch,
    /// Unsaved edits of earlier runs, to be offered.
    pub(crate) kept: Vec<Kept>,
    /// Keeps unsaved edits, until the end.
    pub(crate) keeper: Option<Keeper>,
    /// Whether the viewer was told to end.
    pub(crate) ended: bool,
}

impl App {
    /// A viewer that shows `opened` until the file of the options is read.
    pub(crate) fn new(
        options: Options,
        opened: Opened,
        pool: Arc<Pool>,
        (window_pool, balls): (Pool, BallTracing),
        proxy: EventLoopProxy<Wake>,
    ) -> Self {
        let wake = proxy.clone();
        let worker = FrameWorker::start(PoolTracing::new(Arc::clone(&pool)), move || {
            // The loop may have ended; then no one waits for the frame.
            let _ = wake.send_event(Wake::Frame);
        });
        let wake = proxy.clone();
        let balls = FrameWorker::start(balls, move || {
            // As above.
            let _ = wake.send_event(Wake::Ball);
        });
        let wake = proxy.clone();
        let watch = Watch::start(move |changed| wake.send_event(Wake::Changed(changed)).is_ok());
        let (wake, folder) = (proxy.clone(), recovery::folder());
        let kept = folder.as_deref().map(recovery::all).unwrap_or_default();
        let keeper = Keeper::start(folder, move |why| {
            // As above.
            let _ = wake.send_event(Wake::NotKept(why));
        });
        let mut app = Self {
            viewer: Viewer::new(opened),
            pool,
            window_pool,
            worker,
            balls,
            screen: None,
            modifiers: ModifiersState::empty(),
            shown: None,
            asked: 0,
            overlays: Overlays::default(),
            meter: Meter::default(),
            last_frame: None,
            status_due: None,
            giving_back: GivingBack::default(),
            shown_title: String::new(),
            exposed: true,
            over_picture: false,
            failure: None,
            starting: options.file.is_some(),
            proxy,
            ticket: 0,
            wished_at: 0,
            watch,
            kept,
            keeper: Some(keeper),
            ended: false,
            options,
        };
        app.viewer.settings.max_error = app.options.max_error;
        if let Some(file) = app.options.file.clone() {
            app.open(Next::Open(file));
        }
        app
    }

    fn take_ball(&mut self) {
        if let Some(finished) = self.balls.take() {
            self.viewer.preview.put(finished.frame, finished.is_last);
            self.viewer.stale.panel = true;
        }
    }

    /// Follows the scene and asks for a new picture if one is due.
    pub(crate) fn request_if_stale(&mut self) {
        self.viewer.follow_scene();
        let (width, height) = self.viewer.size;
        if self.viewer.stale.trace && width > 0 && height > 0 && !self.starting {
            self.viewer.stale.trace = false;
            self.asked = self.worker.submit(self.viewer.request());
            self.meter.asked();
        }
    }

    /// When the loop has to wake without an event.
    fn next_due(&self) -> Option<Instant> {
        let egui = self.screen.as_ref().and_then(|screen| screen.due);
        let keeping = self.keeper.as_ref().and_then(|keeper| keeper.due(Instant::now()));
        [egui, self.status_due, keeping, self.giving_back.due()].into_iter().flatten().min()
    }

    fn request_redraw(&self) {
        if let Some(screen) = &self.screen {
            screen.window.request_redraw();
        }
    }

    fn fail(&mut self, event_loop: &ActiveEventLoop, why: String) {
        self.failure = Some(why);
        event_loop.exit();
    }
}

impl ApplicationHandler<Wake> for App {
    fn new_events(&mut self, _: &ActiveEventLoop, cause: StartCause) {
        if matches!(cause, StartCause::ResumeTimeReached { .. }) {
            self.request_redraw();
        }
    }

    fn resumed(&mut self, event_loop: &ActiveEventLoop) {
        if self.screen.is_none() {
            match Screen::open(event_loop, self.options.size) {
                Ok(screen) => {
                    let screen = self.screen.insert(screen);
                    #[cfg(feature = "screen-reader")]
                    crate::screen_reader::connect(screen, event_loop, self.proxy.clone());
                    screen.window.request_redraw();
                }
                Err(why) => self.fail(event_loop, why),
            }
        }
    }

    fn user_event(&mut self, event_loop: &ActiveEventLoop, event: Wake) {
        match event {
            Wake::Frame => self.request_redraw(),
            Wake::Opened(outcome) => self.opened(outcome),
            Wake::Picture(outcome) => dropped::picture::put(&mut self.viewer, outcome),
            Wake::Model(outcome) => dropped::model::put(&mut self.viewer, outcome),
            Wake::Comparison(outcome) => {
                let told = self.viewer.comparison.put(outcome, self.viewer.tone());
                self.viewer.notify(told);
                self.viewer.stale.overlay = true;
            }
            Wake::Ball => self.take_ball(),
            Wake::Made(outcome) => {
                self.viewer.picture_made(outcome);
                self.giving_back.expect(Instant::now());
            }
            Wake::Changed(files) => self.files_changed(&files),
            #[cfg(feature = "screen-reader")]
            Wake::ScreenReader(event) => self.screen_reader_asks(event),
            Wake::Chosen(path) => self.viewer.chosen_outside(path),
            Wake::NotKept(why) => {
                self.viewer.failure = Some(format!("unsaved edits cannot be kept: {why}"));
                self.viewer.stale.panel = true;
            }
            Wake::Ended => {
                self.ended = true;
                match self.keep_edits() {
                    Ok(()) => event_loop.exit(),
                    Err(why) => self.fail(event_loop, why),
                }
            }
        }
    }

    fn window_event(&mut self, event_loop: &ActiveEventLoop, _: WindowId, event: WindowEvent) {
        match event {
            WindowEvent::CloseRequested => self.viewer.leave(Next::Close),
            WindowEvent::RedrawRequested => {
                if let Err(why) = self.redraw() {
                    self.fail(event_loop, why);
                }
            }
            event => self.handle(&event),
        }
    }

    fn about_to_wait(&mut self, event_loop: &ActiveEventLoop) {
        match self.viewer.take_next() {
            Some(Next::Close) => {
                // What still has to end does so unseen.
                if let Some(screen) = &self.screen {
                    screen.window.set_visible(false);
                }
                self.viewer.document.settle();
                // There are no edits to be kept any more.
                let _ = self.end_keeping(None);
                return event_loop.exit();
            }
            Some(next) => self.open(next),
            None => {}
        }
        self.offer_kept();
        self.keep_edits_if_due();
        self.giving_back.do_if_due(Instant::now());
        self.do_wanted();
        self.request_if_stale();
        if let Some(sample) = self.viewer.preview.take_due() {
            self.balls.submit(sample);
        }
        self.make_picture_if_wanted();
        if let Some(file) = self.viewer.comparison.take_wanted() {
            let proxy = self.proxy.clone();
            comparison::read(file, move |outcome| {
                // The loop may have ended; then no one waits for the picture.
                let _ = proxy.send_event(Wake::Comparison(outcome));
            });
        }
        if self.viewer.stale.overlay || self.viewer.stale.panel {
            self.request_redraw();
        }
        event_loop.set_control_flow(self.next_due().map_or(ControlFlow::Wait, ControlFlow::WaitUntil));
    }
}
