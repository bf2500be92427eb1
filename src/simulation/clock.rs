//! Time that this thread has spent computing.

/// Processor time of this thread [s]; where the system does not tell, wall time.
pub(crate) fn thread_seconds() -> f64 {
    cpu_time::ThreadTime::try_now().map_or(0.0, |t| t.as_duration().as_secs_f64())
}
