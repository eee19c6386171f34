//! The thread pool that pictures are traced on.

use std::sync::OnceLock;

/// Threads that trace; made once and used for many pictures.
///
/// ```
/// use catoptra_tracer::Pool;
///
/// assert_eq!(Pool::new(2)?.threads(), 2);
/// assert!(Pool::shared()?.threads() >= 1);
/// # Ok::<(), catoptra_tracer::NoPool>(())
/// ```
#[derive(Debug)]
pub struct Pool {
    threads: rayon::ThreadPool,
}

/// The system gave no threads; it says why.
#[derive(Debug, thiserror::Error)]
#[error("cannot start tracing threads: {0}")]
pub struct NoPool(String);

impl Pool {
    /// With this many threads; 0 means one for every core.
    ///
    /// # Errors
    /// When the system gives no threads.
    pub fn new(threads: usize) -> Result<Self, NoPool> {
        let threads = rayon::ThreadPoolBuilder::new()
            .num_threads(threads)
            .thread_name(|i| format!("trace-{i}"))
            .build()
            .map_err(|cause| NoPool(cause.to_string()))?;
        Ok(Self { threads })
    }

    /// The pool of whoever names none: a thread for every core, started when it is first asked for, and kept.
    ///
    /// # Errors
    /// When the system gives no threads.
    pub fn shared() -> Result<&'static Self, NoPool> {
        static SHARED: OnceLock<Pool> = OnceLock::new();
        match SHARED.get() {
            Some(pool) => Ok(pool),
            None => {
                let pool = Self::new(0)?;
                Ok(SHARED.get_or_init(|| pool))
            }
        }
    }

    /// How many threads there are.
    #[must_use]
    pub fn threads(&self) -> usize {
        self.threads.current_num_threads()
    }

    /// Runs `work` within the pool, so that its parallel parts use these threads.
    pub fn run<T: Send>(&self, work: impl FnOnce() -> T + Send) -> T {
        self.threads.install(work)
    }
}

/// For tests that build many trees: a pool is made once.
#[cfg(test)]
pub(crate) fn one_thread() -> &'static Pool {
    static POOL: std::sync::LazyLock<Pool> = std::sync::LazyLock::new(|| Pool::new(1).unwrap());
    &POOL
}
