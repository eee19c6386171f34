//! Who traces while the window stays awake? One thread that takes the newest request, prepares its scene, traces it coarse
//! to fine, gives it more samples then, and leaves each finished frame where the window picks it up.
//!
//! A newer request takes the place of one that still waits. It abandons refinement under way at once; a first, coarse
//! frame is let finish (else a fast hand would never see one) unless it has overrun its time, and so is the preparation,
//! as the next one builds on it. Without a request the thread sleeps.

use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};
use std::thread::JoinHandle;
use std::time::{Duration, Instant};

use catoptra_tracer::Control;

use crate::refine::{Pace, Pass, USUAL_FRAME, reduced};

/// How long a first frame may take before a newer request abandons it.
const OVERDUE: Duration = Duration::from_millis(60);

/// How many used frames are kept to be filled again.
const SPARES: usize = 4;

/// What can trace requests into frames.
pub(crate) trait Tracing: Send + 'static {
    /// What is asked for.
    type Request: Send + 'static;
    /// A request with all that its frames have in common.
    type Job;
    /// What comes of it.
    type Frame: Send + Into<Self::Spare> + 'static;
    /// What of a used frame can be filled again.
    type Spare: Send + 'static;

    /// Does what has to be done once, before the first frame.
    fn prepare(&mut self, request: Self::Request) -> Self::Job;

    /// Width and height in pixels that a request asks for.
    fn size(job: &Self::Job) -> (u32, u32);

    /// Traces with each pixel standing for `divisor` x `divisor`, into one of `spares` if one fits.
    /// `None` when it was cancelled; what it was traced into is then among the spares.
    fn trace(
        &mut self,
        job: &Self::Job,
        divisor: u32,
        control: &Control,
        spares: &mut Vec<Self::Spare>,
    ) -> Option<Self::Frame>;

    /// What the first frame of a request may take from the hand to the eye, in milliseconds.
    fn frame_time(_: &Self::Job) -> f64 {
        USUAL_FRAME
    }

    /// By which passes a full frame is given more samples; none where it has all at once.
    fn passes(_: &Self::Job) -> Vec<Pass> {
        Vec::new()
    }

    /// Traces a pass over the full picture, after all passes before it; `None` when it was cancelled, or where there are no
    /// passes. What is used up goes to the spares.
    fn add(&mut self, _: &Self::Job, _: Pass, _: &Control, _: &mut Vec<Self::Spare>) -> Option<Self::Frame> {
        None
    }
}

/// A frame with what is known about it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Finished<F> {
    /// The frame.
    pub(crate) frame: F,
    /// Which request it answers: the number that [`FrameWorker::submit`] gave.
    pub(crate) generation: u64,
    /// How many pixels each way one pixel of it stands for.
    pub(crate) divisor: u32,
    /// The pass that gave it samples.
    pub(crate) pass: Option<Pass>,
    /// Nothing finer follows.
    pub(crate) is_last: bool,
    /// How long it took.
    pub(crate) took: Duration,
}

struct UnderWay {
    control: Arc<Control>,
    first: bool,
    since: Instant,
}

struct State<T: Tracing> {
    generation: u64,
    waiting: Option<T::Request>,
    preparing: bool,
    under_way: Option<UnderWay>,
    finished: Option<Finished<T::Frame>>,
    spares: Vec<T::Spare>,
    closing: bool,
}

struct Shared<T: Tracing> {
    state: Mutex<State<T>>,
    changed: Condvar,
}

impl<T: Tracing> Shared<T> {
    fn lock(&self) -> MutexGuard<'_, State<T>> {
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

/// The thread, and what it shares with the window. Dropping it abandons the frame under way and waits for the end, but
/// for a preparation, which cannot be abandoned and ends by itself.
pub(crate) struct FrameWorker<T: Tracing> {
    shared: Arc<Shared<T>>,
    thread: Option<JoinHandle<()>>,
}

impl<T: Tracing> FrameWorker<T> {
    /// Starts the thread; `wake` is called on it after each finished frame.
    pub(crate) fn start(tracing: T, wake: impl Fn() + Send + 'static) -> Self {
        let state = State {
            generation: 0,
            waiting: None,
            preparing: false,
            under_way: None,
            finished: None,
            spares: Vec::new(),
            closing: false,
        };
        let shared = Arc::new(Shared { state: Mutex::new(state), changed: Condvar::new() });
        let theirs = Arc::clone(&shared);
        let thread = std::thread::spawn(move || work(&theirs, tracing, &wake));
        Self { shared, thread: Some(thread) }
    }

    /// Asks for a picture instead of all that was asked before; never waits. Returns the request's number.
    pub(crate) fn submit(&self, request: T::Request) -> u64 {
        let mut state = self.shared.lock();
        state.generation += 1;
        state.waiting = Some(request);
        if let Some(frame) = &state.under_way
            && (!frame.first || frame.since.elapsed() > OVERDUE)
        {
            frame.control.cancel();
        }
        self.shared.changed.notify_one();
        state.generation
    }

    /// The newest finished frame that was not taken yet.
    pub(crate) fn take(&self) -> Option<Finished<T::Frame>> {
        self.shared.lock().finished.take()
    }

    /// Gives a used frame back to be filled again; at rest nothing is kept.
    pub(crate) fn give_back(&self, frame: T::Frame) {
        let mut state = self.shared.lock();
        if state.under_way.is_some() || state.waiting.is_some() {
            keep(&mut state.spares, frame.into());
        }
    }
}

impl<T: Tracing> Drop for FrameWorker<T> {
    fn drop(&mut self) {
        let mut state = self.shared.lock();
        state.closing = true;
        if let Some(frame) = &state.under_way {
            frame.control.cancel();
        }
        let preparing = state.preparing;
        drop(state);
        self.shared.changed.notify_one();
        if let Some(thread) = self.thread.take()
            && !preparing
        {
            // A panic there has been reported by its own thread.
            let _ = thread.join();
        }
    }
}

fn keep<S>(spares: &mut Vec<S>, spare: S) {
    if spares.len() == SPARES {
        spares.remove(0);
    }
    spares.push(spare);
}

fn work<T: Tracing>(shared: &Shared<T>, mut tracing: T, wake: &impl Fn()) {
    let mut pace = Pace::default();
    while let Some((generation, request)) = next(shared) {
        let job = tracing.prepare(request);
        let (width, height) = T::size(&job);
        let passes = T::passes(&job);
        let divisors =
            pace.steps((width, height), T::frame_time(&job)).into_iter().map(|divisor| (divisor, None));
        let steps: Vec<_> = divisors.chain(passes.into_iter().map(|pass| (1, Some(pass)))).collect();
        for (i, &(divisor, pass)) in steps.iter().enumerate() {
            let first = i == 0;
            let Some((control, mut spares)) = begin(shared, first) else { break };
            let since = Instant::now();
            let frame = match pass {
                None => tracing.trace(&job, divisor, &control, &mut spares),
                Some(pass) => tracing.add(&job, pass, &control, &mut spares),
            };
            let took = since.elapsed();
            let Some(frame) = frame else {
                if first {
                    pace.overran();
                }
                end(shared, spares, None);
                break;
            };
            if pass.is_none() {
                let (w, h) = reduced(width, height, divisor);
                pace.record(u64::from(w) * u64::from(h), took);
            }
            let is_last = i + 1 == steps.len();
            end(shared, spares, Some(Finished { frame, generation, divisor, pass, is_last, took }));
            wake();
        }
    }
}

/// Waits for a request; `None` at the end.
fn next<T: Tracing>(shared: &Shared<T>) -> Option<(u64, T::Request)> {
    let mut state = shared.lock();
    loop {
        if state.closing {
            return None;
        }
        if let Some(request) = state.waiting.take() {
            state.preparing = true;
            return Some((state.generation, request));
        }
        state = shared.changed.wait(state).unwrap_or_else(PoisonError::into_inner);
    }
}

/// Notes that a frame is begun; `None` if it need not be, since it would only refine what is out of date.
fn begin<T: Tracing>(shared: &Shared<T>, first: bool) -> Option<(Arc<Control>, Vec<T::Spare>)> {
    let mut state = shared.lock();
    state.preparing = false;
    if state.closing || (!first && state.waiting.is_some()) {
        return None;
    }
    let control = Arc::new(Control::default());
    state.under_way = Some(UnderWay { control: Arc::clone(&control), first, since: Instant::now() });
    Some((control, std::mem::take(&mut state.spares)))
}

/// Notes that a frame is done with, and leaves it to be taken. One that was not taken in time is used again; after the last
/// one, with nothing to do, the room is given back.
fn end<T: Tracing>(shared: &Shared<T>, spares: Vec<T::Spare>, finished: Option<Finished<T::Frame>>) {
    let mut state = shared.lock();
    state.under_way = None;
    for spare in spares {
        keep(&mut state.spares, spare);
    }
    if finished.is_some()
        && let Some(missed) = std::mem::replace(&mut state.finished, finished)
    {
        keep(&mut state.spares, missed.frame.into());
    }
    if state.waiting.is_none() && state.finished.as_ref().is_some_and(|finished| finished.is_last) {
        state.spares = Vec::new();
    }
}

#[cfg(test)]
mod tests {
    use std::sync::mpsc::{Receiver, Sender, channel};

    use super::*;

    /// Tells what it begins, and finishes when told or when cancelled.
    struct Steered {
        prepared: Sender<u32>,
        begun: Sender<(u32, u32)>,
        go: Receiver<()>,
    }

    /// A request whose preparation ends when told.
    const SLOW: u32 = 99;

    /// A request that is given more samples.
    const FINE: u32 = 50;

    impl Tracing for Steered {
        type Request = u32;
        type Job = u32;
        type Frame = (u32, u32);
        type Spare = (u32, u32);

        fn prepare(&mut self, request: u32) -> u32 {
            let _ = self.prepared.send(request);
            while request == SLOW && self.go.recv_timeout(Duration::from_millis(1)).is_err() {}
            request
        }

        fn size(_: &u32) -> (u32, u32) {
            (64, 64)
        }

        fn trace(
            &mut self,
            request: &u32,
            divisor: u32,
            control: &Control,
            _: &mut Vec<(u32, u32)>,
        ) -> Option<(u32, u32)> {
            self.wait((*request, divisor), control)
        }

        fn passes(request: &u32) -> Vec<Pass> {
            Pass::all(if *request == FINE { 8 } else { 0 }, 4)
        }

        /// A frame with the number of samples, in hundreds, in the place of the divisor.
        fn add(
            &mut self,
            request: &u32,
            pass: Pass,
            control: &Control,
            _: &mut Vec<(u32, u32)>,
        ) -> Option<(u32, u32)> {
            self.wait((*request, 100 * pass.to), control)
        }
    }

    impl Steered {
        fn wait(&self, frame: (u32, u32), control: &Control) -> Option<(u32, u32)> {
            self.begun.send(frame).ok()?;
            loop {
                if control.is_cancelled() {
                    return None;
                }
                if self.go.recv_timeout(Duration::from_millis(1)).is_ok() {
                    return Some(frame);
                }
            }
        }
    }

    struct Bench {
        worker: FrameWorker<Steered>,
        prepared: Receiver<u32>,
        begun: Receiver<(u32, u32)>,
        go: Sender<()>,
        woken: Receiver<()>,
    }

    impl Bench {
        fn new() -> Self {
            let (prepared_to, prepared) = channel();
            let (begun_to, begun) = channel();
            let (go, go_from) = channel();
            let (woken_to, woken) = channel();
            let worker = FrameWorker::start(
                Steered { prepared: prepared_to, begun: begun_to, go: go_from },
                move || {
                    let _ = woken_to.send(());
                },
            );
            Self { worker, prepared, begun, go, woken }
        }

        fn begun(&self) -> (u32, u32) {
            self.begun.recv_timeout(Duration::from_secs(20)).unwrap()
        }

        fn finish(&self) -> (u32, u32) {
            self.finished().frame
        }

        fn finished(&self) -> Finished<(u32, u32)> {
            self.go.send(()).unwrap();
            self.woken.recv_timeout(Duration::from_secs(20)).unwrap();
            self.worker.take().unwrap()
        }
    }

    #[test]
    fn a_request_is_refined_down_to_single_pixels() {
        let bench = Bench::new();
        bench.worker.submit(7);
        let mut divisors = Vec::new();
        while divisors.last() != Some(&1) {
            let begun = bench.begun();
            assert_eq!(bench.finish(), begun);
            divisors.push(begun.1);
        }
        assert_eq!(divisors, [8, 4, 2, 1]);
    }

    #[test]
    fn a_full_picture_is_given_its_passes_and_only_then_is_at_rest() {
        let bench = Bench::new();
        bench.worker.submit(FINE);
        let mut steps = Vec::new();
        loop {
            bench.begun();
            let Finished { frame, divisor, pass, is_last, .. } = bench.finished();
            assert_eq!(pass.is_some(), frame.1 >= 100);
            steps.push((frame.1, divisor));
            if is_last {
                break;
            }
        }
        assert_eq!(steps, [(8, 8), (4, 4), (2, 2), (1, 1), (400, 1), (800, 1)]);
        assert!(bench.begun.recv_timeout(Duration::from_millis(30)).is_err(), "nothing more is begun");
    }

    #[test]
    fn at_rest_no_room_is_kept() {
        let bench = Bench::new();
        bench.worker.submit(FINE);
        let spares = || bench.worker.shared.lock().spares.len();
        loop {
            bench.begun();
            let finished = bench.finished();
            if finished.is_last {
                bench.worker.give_back(finished.frame);
                break;
            }
        }
        assert_eq!(spares(), 0);
        bench.worker.submit(1);
        bench.begun();
        bench.worker.give_back((7, 7));
        assert_eq!(spares(), 1, "while something is traced it is used again");
    }

    #[test]
    fn a_new_request_abandons_a_pass() {
        let bench = Bench::new();
        bench.worker.submit(FINE);
        while bench.begun().1 < 100 {
            bench.finish();
        }
        bench.worker.submit(2);
        assert_eq!(bench.begun(), (2, 8));
    }

    #[test]
    fn a_new_request_abandons_refinement() {
        let bench = Bench::new();
        bench.worker.submit(1);
        bench.begun();
        bench.finish();
        assert_eq!(bench.begun(), (1, 4));
        bench.worker.submit(2);
        assert_eq!(bench.begun().0, 2);
    }

    #[test]
    fn a_first_frame_in_time_is_let_finish() {
        let bench = Bench::new();
        bench.worker.submit(1);
        bench.begun();
        bench.worker.submit(2);
        assert_eq!(bench.finish().0, 1);
        assert_eq!(bench.begun().0, 2);
    }

    #[test]
    fn the_newest_request_wins() {
        let bench = Bench::new();
        bench.worker.submit(1);
        bench.begun();
        bench.worker.submit(2);
        let newest = bench.worker.submit(3);
        bench.finish();
        assert_eq!(bench.begun().0, 3);
        bench.go.send(()).unwrap();
        bench.woken.recv_timeout(Duration::from_secs(20)).unwrap();
        assert_eq!(bench.worker.take().unwrap().generation, newest);
    }

    #[test]
    fn what_is_being_prepared_is_shown_coarsely_before_what_was_asked_for_meanwhile() {
        let bench = Bench::new();
        bench.worker.submit(SLOW);
        assert_eq!(bench.prepared.recv_timeout(Duration::from_secs(20)), Ok(SLOW));
        bench.worker.submit(1);
        bench.worker.submit(2);
        assert!(bench.worker.take().is_none());
        bench.go.send(()).unwrap();
        assert_eq!(bench.begun(), (SLOW, 8));
        bench.finish();
        assert_eq!(bench.begun().0, 2);
    }

    #[test]
    fn dropping_does_not_wait_for_a_preparation() {
        let Bench { worker, prepared, begun, go, woken: _ } = Bench::new();
        worker.submit(SLOW);
        assert_eq!(prepared.recv_timeout(Duration::from_secs(20)), Ok(SLOW));
        let (dropped_to, dropped) = channel();
        std::thread::spawn(move || {
            drop(worker);
            let _ = dropped_to.send(());
        });
        assert!(dropped.recv_timeout(Duration::from_secs(20)).is_ok(), "the window waits to be closed");
        go.send(()).unwrap();
        assert!(begun.recv_timeout(Duration::from_secs(20)).is_err(), "no frame is begun any more");
    }

    #[test]
    fn nothing_is_begun_without_a_request() {
        let bench = Bench::new();
        assert!(bench.begun.recv_timeout(Duration::from_millis(30)).is_err());
    }

    #[test]
    fn dropping_ends_a_frame_under_way() {
        let bench = Bench::new();
        bench.worker.submit(1);
        bench.begun();
        drop(bench.worker);
        assert!(bench.begun.recv_timeout(Duration::from_secs(20)).is_err());
    }
}
