//! How far the work is, and Ctrl-C.

use std::sync::Arc;
use std::sync::mpsc::{self, RecvTimeoutError};
use std::thread;
use std::time::Duration;

use indicatif::{ProgressBar, ProgressStyle};

use crate::render::Progress;

/// Time between two looks at how far the work is.
const BAR_INTERVAL: Duration = Duration::from_millis(50);

/// The progress of work that Ctrl-C cancels.
pub(super) fn until_interrupted() -> Result<Arc<Progress>, ctrlc::Error> {
    let progress = Arc::new(Progress::default());
    let on_interrupt = Arc::clone(&progress);
    ctrlc::set_handler(move || on_interrupt.cancel())?;
    Ok(progress)
}

/// Do the work of `total` steps beside a progress bar, which shows only where standard error is a terminal.
pub(super) fn with_bar<T>(total: u64, progress: &Progress, work: impl FnOnce() -> T) -> T {
    let style = ProgressStyle::with_template("{wide_bar} {percent:>3} %  {elapsed}, {eta} left");
    let bar = ProgressBar::new(total).with_style(style.unwrap_or(ProgressStyle::default_bar()));
    let (finished, is_finished) = mpsc::channel::<()>();
    thread::scope(|scope| {
        let bar = &bar;
        scope.spawn(move || {
            while is_finished.recv_timeout(BAR_INTERVAL) == Err(RecvTimeoutError::Timeout) {
                bar.set_position(progress.done());
            }
            bar.finish_and_clear();
        });
        let result = work();
        drop(finished);
        result
    })
}
