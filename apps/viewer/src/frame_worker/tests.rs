//! Does the worker do what is asked last, and rest when all is done?

use std::sync::mpsc::{Receiver, Sender, channel};

use super::*;

/// Tells what it begins, and finishes when told or when cancelled.
struct Steered {
    prepared: Sender<u32>,
    begun: Sender<(u32, u32)>,
    go: Receiver<()>,
    /// Pixels that are settled.
    settled: u32,
}

/// A request whose preparation ends when told.
const SLOW: u32 = 99;

/// A request that is refined.
const FINE: u32 = 50;

impl Tracing for Steered {
    type Request = u32;
    type Job = u32;
    type Frame = (u32, u32);
    type Spare = (u32, u32);

    fn prepare(&mut self, request: u32) -> u32 {
        self.settled = 0;
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
        step: Step,
        control: &Control,
        _: &mut Vec<(u32, u32)>,
    ) -> Option<(u32, u32)> {
        self.wait((*request, step.divisor), control)
    }

    fn is_refined(request: &u32) -> bool {
        *request == FINE
    }

    /// A frame with the number of settled pixels, in hundreds, in the place of the divisor.
    fn refine(
        &mut self,
        request: &u32,
        control: &Control,
        _: &mut Vec<(u32, u32)>,
    ) -> Option<((u32, u32), Refined)> {
        self.settled += 1;
        let frame = self.wait((*request, 100 * self.settled), control)?;
        let settled = u64::from(self.settled);
        Some((frame, Refined { settled, pixels: 2, samples: 4, traced: 0, quality: Quality::Full }))
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
            Steered { prepared: prepared_to, begun: begun_to, go: go_from, settled: 0 },
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
fn a_full_picture_is_refined_and_only_then_is_at_rest() {
    let bench = Bench::new();
    bench.worker.submit(FINE);
    let mut steps = Vec::new();
    loop {
        bench.begun();
        let Finished { frame, step, refined, is_last, .. } = bench.finished();
        assert_eq!(refined.is_some(), frame.1 >= 100);
        steps.push((frame.1, step.divisor));
        if is_last {
            break;
        }
    }
    assert_eq!(steps, [(8, 8), (4, 4), (2, 2), (1, 1), (100, 1), (200, 1)]);
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
fn a_new_request_abandons_what_is_being_refined() {
    let bench = Bench::new();
    bench.worker.submit(FINE);
    while bench.begun().1 < 100 {
        bench.finish();
    }
    bench.worker.submit(2);
    assert_eq!(bench.begun().0, 2);
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
