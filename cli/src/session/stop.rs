//! What ends a command before its time: signals, and the limits of `--time-limit` and `--memory-limit`.
//!
//! A command asks [`Stop::check`] between frames, cases or pictures, and ends there: it keeps what is whole and says
//! so. A thread of its own watches for a command that does not come to ask, because a frame is long, a pipe has no
//! reader or a program hangs: after [`GRACE`], or at a second signal, it removes what the process would leave behind
//! and ends it.

use std::io;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::mpsc::channel;
use std::sync::{Arc, OnceLock};
use std::thread;
use std::time::{Duration, Instant};

use signal_hook::consts::{SIGABRT, SIGHUP, SIGINT, SIGQUIT, SIGTERM, SIGXFSZ};
use signal_hook::{flag, low_level};

use super::{leftovers, memory, progress, spawn, ui::Ui};
use drape::error::{Error, Kind, Result};

/// How long a command may take from a first signal to its end.
const GRACE: Duration = Duration::from_millis(1200);

/// The same where memory keeps growing.
const SHORT_GRACE: Duration = Duration::from_millis(200);

/// How often the watching thread looks.
const PERIOD: Duration = Duration::from_millis(20);

/// How long it takes at most to print a message that may have no reader.
const LAST_WORDS: Duration = Duration::from_millis(300);

const RAISE_MEMORY: &str = "raise --memory-limit, or ask for less";

/// The limits of the command line.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Limits {
    /// The longest wall time.
    pub(crate) time: Option<Duration>,
    /// The most memory, in bytes.
    pub(crate) memory: Option<u64>,
}

/// Why a command ends before its time.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Reason {
    Signal(u8),
    Time(Duration),
    Memory { used: u64, limit: u64 },
}

/// Knows whether the command has to end.
pub(crate) struct Stop(Arc<Watched>);

/// What is watched for.
struct Watched {
    /// The signal that arrived last and was not taken yet; 0 for none.
    signal: Arc<AtomicUsize>,
    limits: Limits,
    started: Instant,
    reason: OnceLock<Reason>,
}

impl Stop {
    /// Starts to catch signals and to watch the limits.
    ///
    /// # Errors
    /// [`Kind::Io`] when the system refuses.
    pub(crate) fn install(limits: Limits, ui: Ui) -> Result<Self> {
        let signal = Arc::new(AtomicUsize::new(0));
        catch(&signal).map_err(|e| no_signals(&e))?;
        if limits.memory.is_some() && memory::used().is_none() {
            return Err(Error::new(Kind::Io, "this system does not tell how much memory the program uses")
                .with_help("leave out --memory-limit"));
        }
        let watched = Watched { signal, limits, started: Instant::now(), reason: OnceLock::new() };
        let watched = Arc::new(watched);
        let for_thread = Arc::clone(&watched);
        let start =
            |thread: thread::Builder| thread.name("watch".to_owned()).spawn(move || for_thread.watch(ui));
        let thread = spawn::builder().and_then(start);
        match thread {
            Ok(_) => {}
            Err(e) if limits.memory.is_some() => {
                return Err(Error::new(
                    Kind::Io,
                    format!("cannot start the thread that watches memory: {e}"),
                )
                .with_help("leave out --memory-limit"));
            }
            // Without the thread the second signal ends the process by itself.
            Err(_) => second_ends().map_err(|e| no_signals(&e))?,
        }
        Ok(Self(watched))
    }

    /// Fails once the command has to end; it has written nothing.
    ///
    /// # Errors
    /// [`Kind::Signal`] with the number of the signal; [`Kind::Limit`].
    pub(crate) fn check(&self) -> Result<()> {
        self.0.look().map_or(Ok(()), |reason| Err(reason.error("nothing was written")))
    }

    /// Checks, before long work, that `bytes` bytes for `what` are within the limit of memory.
    ///
    /// # Errors
    /// [`Kind::Limit`].
    pub(crate) fn check_memory(&self, bytes: u64, what: &str) -> Result<()> {
        match self.0.limits.memory {
            Some(limit) if bytes > limit => {
                let message = format!("{what} takes at least {bytes} bytes of memory, {limit} are allowed");
                Err(Error::new(Kind::Limit, message).with_help(RAISE_MEMORY))
            }
            _ => Ok(()),
        }
    }

    /// As [`Stop::check`] for a command that leaves what the next run goes on from: `kept`, such as `finished cases`.
    ///
    /// # Errors
    /// As [`Stop::check`].
    pub(crate) fn check_keeping(&self, kept: &str) -> Result<()> {
        self.0.look().map_or(Ok(()), |reason| {
            let error = reason.error(&format!("the {kept} are kept"));
            Err(error.with_help("run the same command again to do the rest"))
        })
    }
}

impl Watched {
    /// The reason to end, if there is one.
    fn look(&self) -> Option<Reason> {
        if self.reason.get().is_none() {
            let found = self.signalled().or_else(|| self.late());
            found.map(|found| self.reason.get_or_init(|| found));
        }
        self.reason.get().copied()
    }

    fn signalled(&self) -> Option<Reason> {
        let number = self.signal.swap(0, Ordering::Relaxed);
        (number > 0).then(|| Reason::Signal(u8::try_from(number).unwrap_or(u8::MAX)))
    }

    fn late(&self) -> Option<Reason> {
        self.limits.time.filter(|limit| self.started.elapsed() > *limit).map(Reason::Time)
    }

    fn too_large(&self) -> Option<Reason> {
        let limit = self.limits.memory?;
        memory::used().filter(|used| *used > limit).map(|used| Reason::Memory { used, limit })
    }

    /// Ends the process when the command does not do so itself.
    fn watch(&self, ui: Ui) {
        let reason = loop {
            thread::sleep(PERIOD);
            let large = self.too_large();
            large.map(|reason| self.reason.get_or_init(|| reason));
            if let Some(reason) = self.look() {
                break reason;
            }
        };
        let grace = if matches!(reason, Reason::Memory { .. }) { SHORT_GRACE } else { GRACE };
        let noticed = Instant::now();
        while noticed.elapsed() < grace && self.signalled().is_none() {
            thread::sleep(PERIOD);
        }
        let error = reason.error("no file is left incomplete");
        let code = i32::from(error.kind.exit_code());
        last_words(ui, error);
        leftovers::remove();
        low_level::exit(code);
    }
}

/// Prints an error, as far as that can be done in a short time: nobody may read standard error, or the lock on it
/// may be held by a thread that waits for its reader. Nothing is printed behind it: what fails in the command because
/// its files are removed is not told.
fn last_words(ui: Ui, error: Error) {
    let (done, printed) = channel();
    let print = move || {
        ui.error(&error);
        let _silence = io::stderr().lock();
        let _ = done.send(());
        loop {
            thread::park();
        }
    };
    let printer = spawn::builder().and_then(|thread| thread.spawn(print));
    if printer.is_ok() {
        let _ = printed.recv_timeout(LAST_WORDS);
    }
}

impl Reason {
    /// The error of a command that ends so, and what becomes of its files.
    fn error(self, outcome: &str) -> Error {
        let reached = progress::reached().map_or_else(String::new, |reached| format!(" ({reached})"));
        let (kind, message) = match self {
            Self::Signal(number) => (Kind::Signal(number), format!("stopped by signal {number}")),
            Self::Time(limit) => {
                (Kind::Limit, format!("stopped by the time limit of {} s", limit.as_secs_f64()))
            }
            Self::Memory { used, limit } => {
                let message =
                    format!("stopped by the memory limit: {used} bytes are in use, {limit} are allowed");
                (Kind::Limit, message)
            }
        };
        let error = Error::new(kind, format!("{message}; {outcome}{reached}"));
        match self {
            Self::Signal(_) => error,
            Self::Time(_) => error.with_help("raise --time-limit, or ask for less"),
            Self::Memory { .. } => error.with_help(RAISE_MEMORY),
        }
    }
}

fn no_signals(cause: &io::Error) -> Error {
    Error::new(Kind::Io, format!("cannot catch signals: {cause}"))
}

/// The signals that ask a command to end.
const ENDING: [i32; 4] = [SIGINT, SIGTERM, SIGHUP, SIGQUIT];

/// Has the process end with the exit code of [`Kind::Io`] where the standard library aborts, which it does, after a
/// message, when it has no other way to say that memory is short. Where that cannot be had, it aborts.
pub(crate) fn exit_without_memory() {
    let code = i32::from(Kind::Io.exit_code());
    let _ = flag::register_conditional_shutdown(SIGABRT, code, Arc::new(AtomicBool::new(true)));
}

/// Has a file that grows beyond the limit of the system be a failed write. Where that cannot be had, the signal ends the
/// process.
pub(crate) fn fail_writes_beyond_limit() {
    let _ = flag::register(SIGXFSZ, Arc::new(AtomicBool::new(false)));
}

/// Has `signal` hold the number of a signal that arrives.
fn catch(signal: &Arc<AtomicUsize>) -> io::Result<()> {
    for number in ENDING {
        // A command under `nohup` outlives its terminal.
        if number == SIGHUP && ignored(SIGHUP) {
            continue;
        }
        flag::register_usize(number, Arc::clone(signal), usize::try_from(number).unwrap_or_default())?;
    }
    Ok(())
}

fn second_ends() -> io::Result<()> {
    let again = Arc::new(AtomicBool::new(false));
    ENDING.into_iter().try_for_each(|number| {
        // The order matters: the end acts on the flag as earlier signals have set it.
        flag::register_conditional_shutdown(number, 128 + number, Arc::clone(&again))?;
        flag::register(number, Arc::clone(&again)).map(drop)
    })
}

/// Whether the program that started this one has it ignore a signal, as far as the system tells.
fn ignored(signal: i32) -> bool {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let mask = status.lines().find_map(|line| line.strip_prefix("SigIgn:"));
    let mask = mask.and_then(|mask| u64::from_str_radix(mask.trim(), 16).ok());
    mask.is_some_and(|mask| mask >> (signal - 1) & 1 == 1)
}
