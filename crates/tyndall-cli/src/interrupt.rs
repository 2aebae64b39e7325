//! Ctrl-C and termination: noted in flags that long work looks at, so that it can leave without litter.

use std::fmt;
use std::io;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};

use signal_hook::consts::{SIGINT, SIGTERM};
use signal_hook::flag;

use crate::{Exit, Failure};

/// A request from outside to stop.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Signal {
    /// Ctrl-C.
    Interrupt,
    /// A farm, a service manager or the app wants the program to end.
    Terminate,
}

impl Signal {
    /// The code to end with.
    #[must_use]
    pub fn exit(self) -> Exit {
        match self {
            Self::Interrupt => Exit::Interrupted,
            Self::Terminate => Exit::Resumable,
        }
    }
}

impl fmt::Display for Signal {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Interrupt => "interrupted by Ctrl-C",
            Self::Terminate => "terminated by a signal",
        })
    }
}

/// Whether a signal has come, and which.
#[derive(Clone, Debug, Default)]
pub struct Interrupt {
    came: Arc<AtomicBool>,
    number: Arc<AtomicUsize>,
}

impl Interrupt {
    /// Listens to both signals from now on. A second one ends the program at once.
    ///
    /// # Errors
    /// When the system does not let the program listen.
    pub fn listen() -> io::Result<Self> {
        let interrupt = Self::default();
        for (signal, exit) in [(SIGINT, Exit::Interrupted), (SIGTERM, Exit::Resumable)] {
            // Handlers run in this order: the first signal finds the flag down and raises it, the second finds it up.
            flag::register_conditional_shutdown(signal, i32::from(exit.code()), Arc::clone(&interrupt.came))?;
            flag::register_usize(signal, Arc::clone(&interrupt.number), signal.unsigned_abs() as usize)?;
            flag::register(signal, Arc::clone(&interrupt.came))?;
        }
        Ok(interrupt)
    }

    /// The flag, for writers that stop when it is up.
    #[must_use]
    pub fn flag(&self) -> &AtomicBool {
        &self.came
    }

    /// Fails once a signal has come.
    ///
    /// # Errors
    /// [`Failure::Interrupted`].
    pub fn check(&self) -> Result<(), Failure> {
        if !self.came.load(Ordering::SeqCst) {
            return Ok(());
        }
        let terminated = self.number.load(Ordering::SeqCst) == SIGTERM.unsigned_abs() as usize;
        Err(Failure::Interrupted(if terminated { Signal::Terminate } else { Signal::Interrupt }))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn without_a_signal_work_goes_on() {
        assert!(Interrupt::default().check().is_ok(), "no signal has come");
    }

    #[test]
    fn termination_is_told_from_ctrl_c() {
        for (number, expected) in [(SIGINT, Signal::Interrupt), (SIGTERM, Signal::Terminate)] {
            let interrupt = Interrupt::default();
            interrupt.number.store(number.unsigned_abs() as usize, Ordering::SeqCst);
            interrupt.came.store(true, Ordering::SeqCst);
            let failure = interrupt.check().expect_err("a signal has come");
            assert!(matches!(failure, Failure::Interrupted(signal) if signal == expected), "{failure:?}");
        }
    }
}
