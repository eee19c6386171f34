//! The thread pool that pictures are traced on.

/// Threads that trace; made once and used for many pictures.
#[derive(Debug)]
pub struct Pool {
    threads: rayon::ThreadPool,
}

/// The system gave no threads.
#[derive(Debug, thiserror::Error)]
#[error("cannot start tracing threads: {0}")]
pub struct NoPool(#[from] rayon::ThreadPoolBuildError);

impl Pool {
    /// With this many threads; 0 means one for every core.
    ///
    /// # Errors
    /// When the system gives no threads.
    pub fn new(threads: usize) -> Result<Self, NoPool> {
        let threads = rayon::ThreadPoolBuilder::new()
            .num_threads(threads)
            .thread_name(|i| format!("trace-{i}"))
            .build()?;
        Ok(Self { threads })
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
