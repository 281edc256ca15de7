//! Work off the UI thread: where only the latest request matters, and where each does.

use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{Receiver, Sender, channel};
use std::sync::{Arc, Condvar, Mutex, PoisonError};

use crate::render::Progress;

/// One piece of work on a thread of its own; it is told to stop when nobody waits for it any more.
#[derive(Debug)]
pub struct Errand<O> {
    progress: Arc<Progress>,
    answer: Receiver<O>,
}

impl<O: Send + 'static> Errand<O> {
    /// Start `work`; the window is woken when it is done.
    pub fn start(ctx: &egui::Context, work: impl FnOnce(&Progress) -> O + Send + 'static) -> Self {
        let (sender, answer) = channel();
        let progress = Arc::<Progress>::default();
        let (theirs, ctx) = (Arc::clone(&progress), ctx.clone());
        std::thread::spawn(move || {
            // Nobody listens where it is not wanted any more.
            if sender.send(work(&theirs)).is_ok() {
                ctx.request_repaint();
            }
        });
        Self { progress, answer }
    }

    /// What came of it, once.
    pub fn poll(&self) -> Option<O> {
        self.answer.try_recv().ok()
    }
}

impl<O> Drop for Errand<O> {
    fn drop(&mut self) {
        self.progress.cancel();
    }
}

/// A thread that answers the latest request, and drops what has been overtaken.
///
/// A request may be answered several times, coarse first. A request that is overtaken while it is being worked on is
/// told so through its cancel flag; what it still answers is newer than what is on show, so it is passed on.
#[derive(Debug)]
pub struct Latest<I, O> {
    inbox: Arc<Inbox<I>>,
    answers: Receiver<Answer<O>>,
    current: Option<Ticket>,
}

/// Whether a request has been overtaken; what its worker looks at.
type Ticket = Arc<AtomicBool>;

#[derive(Debug)]
struct Answer<O> {
    ticket: Ticket,
    /// `None` when the request is done with.
    output: Option<O>,
}

#[derive(Debug)]
struct Inbox<I> {
    slot: Mutex<Slot<I>>,
    changed: Condvar,
}

#[derive(Debug)]
struct Slot<I> {
    request: Option<(Ticket, I)>,
    closed: bool,
}

impl<I: Send + 'static, O: Send + 'static> Latest<I, O> {
    /// Start a thread called `name` that does `work` for each request that is not overtaken: `work(request, cancel,
    /// answer)` may call `answer` any number of times. `wake` is called after each answer, from that thread.
    ///
    /// `None` if the system gives no thread.
    pub fn spawn(
        name: &str,
        wake: impl Fn() + Send + 'static,
        work: impl Fn(I, &AtomicBool, &mut dyn FnMut(O)) + Send + 'static,
    ) -> Option<Self> {
        let inbox =
            Arc::new(Inbox { slot: Mutex::new(Slot { request: None, closed: false }), changed: Condvar::new() });
        let (sender, answers) = channel();
        let theirs = Arc::clone(&inbox);
        std::thread::Builder::new().name(name.to_owned()).spawn(move || serve(&theirs, &sender, &wake, &work)).ok()?;
        Some(Self { inbox, answers, current: None })
    }

    /// Ask for `request` to be worked on instead of whatever was asked for before.
    pub fn submit(&mut self, request: I) {
        let ticket = Ticket::default();
        if let Some(overtaken) = self.current.replace(Arc::clone(&ticket)) {
            overtaken.store(true, Ordering::Relaxed);
        }
        self.inbox.lock().request = Some((ticket, request));
        self.inbox.changed.notify_one();
    }

    /// The newest answer that has not been taken yet.
    pub fn poll(&mut self) -> Option<O> {
        let mut newest = None;
        while let Ok(Answer { ticket, output }) = self.answers.try_recv() {
            let done = output.is_none();
            newest = output.or(newest);
            if done && self.current.as_ref().is_some_and(|current| Arc::ptr_eq(current, &ticket)) {
                self.current = None;
            }
        }
        newest
    }

    /// Whether the current request is still being worked on.
    pub fn is_busy(&self) -> bool {
        self.current.is_some()
    }
}

impl<I, O> Drop for Latest<I, O> {
    fn drop(&mut self) {
        if let Some(current) = &self.current {
            current.store(true, Ordering::Relaxed);
        }
        self.inbox.lock().closed = true;
        self.inbox.changed.notify_one();
    }
}

impl<I> Inbox<I> {
    fn lock(&self) -> std::sync::MutexGuard<'_, Slot<I>> {
        self.slot.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Wait for a request; `None` when there will be no more.
    fn take(&self) -> Option<(Ticket, I)> {
        let mut slot = self.lock();
        loop {
            if slot.closed {
                return None;
            }
            if let Some(request) = slot.request.take() {
                return Some(request);
            }
            slot = self.changed.wait(slot).unwrap_or_else(PoisonError::into_inner);
        }
    }
}

/// Serve requests until the inbox is closed.
fn serve<I, O, W>(inbox: &Inbox<I>, answers: &Sender<Answer<O>>, wake: &dyn Fn(), work: &W)
where
    W: Fn(I, &AtomicBool, &mut dyn FnMut(O)),
{
    while let Some((ticket, request)) = inbox.take() {
        // Nobody listens only when the window is closing; then `take` ends the loop.
        let send = |output| {
            if answers.send(Answer { ticket: Arc::clone(&ticket), output }).is_ok() {
                wake();
            }
        };
        work(request, &ticket, &mut |output| send(Some(output)));
        send(None);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::time::{Duration, Instant};

    /// Poll until the job is done; all that was answered.
    fn drain(job: &mut Latest<u32, u32>) -> Vec<u32> {
        let start = Instant::now();
        let mut seen = Vec::new();
        while job.is_busy() {
            seen.extend(job.poll());
            assert!(start.elapsed() < Duration::from_secs(10), "the worker has not answered");
            std::thread::yield_now();
        }
        seen
    }

    #[test]
    fn an_errand_that_nobody_waits_for_is_told_to_stop() {
        let (sender, stopped) = channel();
        let errand = Errand::start(&egui::Context::default(), move |progress| {
            while !progress.is_cancelled() {
                std::thread::yield_now();
            }
            sender.send(()).expect("the test listens");
        });
        assert_eq!(errand.poll(), None, "it goes on");
        drop(errand);
        stopped.recv_timeout(Duration::from_secs(10)).expect("it stops");
    }

    #[test]
    fn a_request_is_answered_and_wakes_the_window() {
        let woken = Arc::new(AtomicBool::new(false));
        let wake = Arc::clone(&woken);
        let mut job =
            Latest::spawn("double", move || wake.store(true, Ordering::Relaxed), |n: u32, _, answer| answer(2 * n))
                .expect("a thread");
        job.submit(21);
        assert_eq!(drain(&mut job), [42], "the answer");
        assert!(woken.load(Ordering::Relaxed), "the window was not woken");
    }

    #[test]
    fn an_overtaken_request_is_told_so_and_the_latest_has_the_last_word() {
        let mut job = Latest::spawn(
            "patient",
            || (),
            |n: u32, cancel, answer| {
                // The first request never ends by itself.
                while n == 1 && !cancel.load(Ordering::Relaxed) {
                    std::thread::yield_now();
                }
                answer(n);
            },
        )
        .expect("a thread");
        job.submit(1);
        job.submit(2);
        assert_eq!(drain(&mut job).last(), Some(&2), "the latest");
    }
}
