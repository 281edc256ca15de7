//! Working curves out aside, so that the window never waits: coarse first where they are slow, series by series, and given
//! up at once when something newer is asked for.

use std::sync::Arc;
use std::sync::atomic::AtomicBool;
use std::time::{Duration, Instant};

use rayon::{ThreadPool, ThreadPoolBuilder};

use crate::analysis::{Curves, Sampling, Series, methods_for};
use crate::editor::jobs::Latest;
use crate::scene::{Plot, Scene};
use crate::shading::Method;

/// Points on each curve.
const SAMPLES: usize = 241;
/// Points on each curve that is shown first where all of them take long.
const FIRST_SAMPLES: usize = 31;
/// Curves out of date are faint only when nothing new has come for so long: they would flicker while something is dragged.
const BEHIND: Duration = Duration::from_millis(250);
/// Curves that take longer than this are shown one by one, as they come.
const PATIENCE: Duration = Duration::from_millis(40);

/// All that a plot's curves depend on.
#[derive(Clone, Debug)]
pub(super) struct Subject {
    scene: Arc<Scene>,
    pub(super) plot: Plot,
}

/// What has been worked out so far.
#[derive(Clone, Debug)]
pub(super) struct Answer {
    pub(super) subject: Arc<Subject>,
    /// Through few points, with less care.
    coarse: Option<Arc<Curves>>,
    /// As they should be.
    pub(super) fine: Option<Arc<Curves>>,
    /// Nothing will follow.
    is_last: bool,
}

/// What has been asked for and done.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Work {
    /// Requests.
    pub asked: u64,
    /// Requests whose last curve was shown.
    pub finished: u64,
}

/// The curves of the plot on show.
#[derive(Default)]
pub(super) struct Worker {
    thread: Option<Latest<Arc<Subject>, Answer>>,
    asked: Option<Arc<Subject>>,
    /// What has been worked out last.
    latest: Option<Answer>,
    /// What was there before, for the series that are still to come.
    before: Option<Answer>,
    /// When something was asked for or came last.
    moved: Option<Instant>,
    pub(super) work: Work,
}

/// A series on show, and whether it is of an earlier state.
#[derive(Clone, Copy, Debug)]
pub(super) struct Shown<'a> {
    pub(super) curves: &'a Curves,
    pub(super) series: &'a Series,
    pub(super) stale: bool,
}

impl Subject {
    /// Whether the curves of `plot` in `scene` are the same.
    fn is(&self, scene: &Arc<Scene>, plot: &Plot) -> bool {
        let same = |scene: &Scene| self.scene.lights == scene.lights && self.scene.materials == scene.materials;
        self.plot == *plot && (Arc::ptr_eq(&self.scene, scene) || same(scene))
    }
}

impl Answer {
    /// The best curve of a method that there is.
    fn series(&self, method: Method) -> Option<(&Curves, &Series)> {
        [&self.fine, &self.coarse].into_iter().flatten().find_map(|curves| {
            let series = curves.series.iter().find(|series| series.method == method)?;
            Some((&**curves, series))
        })
    }
}

impl Worker {
    /// Whether curves are still being worked out.
    pub(super) fn is_busy(&self) -> bool {
        self.thread.as_ref().is_some_and(Latest::is_busy)
    }

    /// Take what has been worked out, and ask again when what is plotted has changed.
    pub(super) fn update(&mut self, ctx: &egui::Context, scene: &Arc<Scene>, plot: &Plot) {
        if self.thread.is_none() {
            let ctx = ctx.clone();
            let cores = Cores::new();
            let work = move |subject, cancel: &AtomicBool, answer: &mut dyn FnMut(_)| {
                // Cancelled, it has nothing more to say.
                let _ = work(&cores, &subject, cancel, answer);
            };
            self.thread = Latest::spawn("curves", move || ctx.request_repaint(), work);
        }
        let Some(thread) = &mut self.thread else { return };
        match &self.asked {
            Some(asked) if asked.is(scene, plot) => {
                // The next comparison is then one of addresses.
                if !Arc::ptr_eq(&asked.scene, scene) {
                    let renewed = Arc::new(Subject { scene: Arc::clone(scene), plot: plot.clone() });
                    if let Some(latest) = &mut self.latest
                        && Arc::ptr_eq(&latest.subject, asked)
                    {
                        latest.subject = Arc::clone(&renewed);
                    }
                    self.asked = Some(renewed);
                }
            }
            _ => {
                let subject = Arc::new(Subject { scene: Arc::clone(scene), plot: plot.clone() });
                self.asked = Some(Arc::clone(&subject));
                self.work.asked += 1;
                if !thread.is_busy() {
                    self.moved = Some(Instant::now());
                }
                thread.submit(subject);
            }
        }
        if let Some(answer) = thread.poll() {
            self.moved = Some(Instant::now());
            self.work.finished += u64::from(answer.is_last);
            if let Some(latest) = self.latest.take()
                && (latest.is_last || self.before.is_none())
            {
                self.before = Some(latest);
            }
            self.latest = Some(answer);
        }
        let rest = self.moved.and_then(|moved| BEHIND.checked_sub(moved.elapsed()));
        if let Some(rest) = rest.filter(|_| thread.is_busy()) {
            ctx.request_repaint_after(rest);
        }
    }

    /// Whether all curves of the present state are there.
    pub(super) fn is_complete(&self) -> bool {
        let asked = self.asked.as_ref();
        self.latest.as_ref().is_some_and(|latest| {
            latest.is_last && asked.is_some_and(|asked| latest.subject.is(&asked.scene, &asked.plot))
        })
    }

    /// Whether nothing new has come for long.
    fn is_behind(&self) -> bool {
        self.moved.is_none_or(|moved| moved.elapsed() > BEHIND)
    }

    /// The best curve of a method that there is for `plot`.
    pub(super) fn series(&self, plot: &Plot, method: Method) -> Option<Shown<'_>> {
        let fits = |answer: &&Answer| {
            let of = &answer.subject.plot;
            of.name == plot.name
                && of.kind == plot.kind
                && of.quantity == plot.quantity
                && of.normalise == plot.normalise
                && of.range == plot.range
        };
        let answers = [&self.latest, &self.before].into_iter().flatten().filter(fits);
        answers.into_iter().find_map(|answer| {
            let (curves, series) = answer.series(method)?;
            let scene = self.asked.as_ref().map(|asked| &asked.scene);
            let stale = self.is_behind() && scene.is_none_or(|scene| !answer.subject.is(scene, plot));
            Some(Shown { curves, series, stale })
        })
    }

    /// All curves of the present state that are as they should be; none before the first of them.
    pub(super) fn fine(&self) -> Option<&Curves> {
        let (latest, asked) = (self.latest.as_ref()?, self.asked.as_ref()?);
        latest.fine.as_deref().filter(|_| latest.subject.is(&asked.scene, &asked.plot))
    }
}

/// Processors of its own for the curves, all but one: what the window itself computes does not have to wait for them.
struct Cores(Option<ThreadPool>);

impl Cores {
    fn new() -> Self {
        let all = std::thread::available_parallelism().map_or(1, usize::from);
        Self(ThreadPoolBuilder::new().num_threads(all.saturating_sub(1).max(1)).build().ok())
    }

    fn run<T: Send>(&self, work: impl FnOnce() -> T + Send) -> T {
        match &self.0 {
            Some(cores) => cores.install(work),
            None => work(),
        }
    }
}

/// All curves but the slow reference, which follows when these are done.
fn work(cores: &Cores, subject: &Arc<Subject>, cancel: &AtomicBool, answer: &mut dyn FnMut(Answer)) -> Option<()> {
    let Subject { scene, plot } = &**subject;
    let (reference, quick): (Vec<Method>, Vec<Method>) =
        methods_for(scene).into_iter().partition(|method| *method == Method::Reference);
    let mut so_far = Answer { subject: Arc::clone(subject), coarse: None, fine: None, is_last: false };
    let [first, all] = [FIRST_SAMPLES, SAMPLES].map(|samples| Sampling::new(scene, plot, samples));
    let first = first.coarse();
    let start = Instant::now();
    let is_slow = || start.elapsed() > PATIENCE;

    let coarse = cores.run(|| first.exact(cancel))?;
    let mut coarse = sweep(cores, &first, coarse, &quick, cancel, |coarse| {
        if is_slow() {
            so_far.coarse = Some(Arc::new(coarse.clone()));
            answer(so_far.clone());
        }
    })?;
    let fine = cores.run(|| all.exact(cancel))?;
    let fine = sweep(cores, &all, fine, &quick, cancel, |fine| {
        if is_slow() {
            so_far.fine = Some(Arc::new(fine.clone()));
            answer(so_far.clone());
        }
    })?;
    so_far.fine = Some(Arc::new(fine.clone()));
    so_far.is_last = reference.is_empty();
    answer(so_far.clone());
    if so_far.is_last {
        return Some(());
    }
    coarse = sweep(cores, &first, coarse, &reference, cancel, |_| ())?;
    if is_slow() {
        so_far.coarse = Some(Arc::new(coarse));
        answer(so_far.clone());
    }
    let fine = sweep(cores, &all, fine, &reference, cancel, |_| ())?;
    so_far.fine = Some(Arc::new(fine));
    so_far.is_last = true;
    answer(so_far);
    Some(())
}

/// Adds the curves of `methods`, but for those that are there, and shows what there is after each.
fn sweep(
    cores: &Cores,
    sampling: &Sampling,
    mut curves: Curves,
    methods: &[Method],
    cancel: &AtomicBool,
    mut show: impl FnMut(&Curves),
) -> Option<Curves> {
    show(&curves);
    for &method in methods.iter().filter(|method| **method != Method::Exact) {
        curves.series.push(cores.run(|| sampling.series(method, &curves, cancel))?);
        show(&curves);
    }
    Some(curves)
}
