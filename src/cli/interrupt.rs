//! What an interrupt does: files that are not complete go, and the command ends with exit code 130.

#[cfg(not(unix))]
mod elsewhere;
#[cfg(unix)]
mod unix;

use super::output::INTERRUPTED;
#[cfg(not(unix))]
use elsewhere as system;
use std::collections::BTreeSet;
use std::fs::{self, File};
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::process;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Mutex, MutexGuard, PoisonError};
use tempfile::NamedTempFile;
#[cfg(unix)]
use unix as system;

/// Files that are not complete. Whoever makes one, completes one or clears up holds the lock, so that an interrupt finds
/// either the file under its name or the part to remove.
static PARTS: Mutex<BTreeSet<PathBuf>> = Mutex::new(BTreeSet::new());
/// Whether the first interrupt is only noted.
static DEFERRED: AtomicBool = AtomicBool::new(false);
/// Whether one was noted.
static NOTED: AtomicBool = AtomicBool::new(false);

fn parts() -> MutexGuard<'static, BTreeSet<PathBuf>> {
    PARTS.lock().unwrap_or_else(PoisonError::into_inner)
}

/// From now on an interrupt (SIGINT, SIGTERM, SIGHUP or Ctrl-C) clears up and ends the process. A hangup that whoever started
/// it has it ignore, as `nohup` does, stays ignored.
pub fn listen() {
    if let Err(error) = system::on_interrupt(heard) {
        // With standard error closed as well, nothing can be said.
        let _ = writeln!(io::stderr(), "centrode: an interrupt may leave a part of a file behind: {error}");
    }
}

/// From now on the first interrupt is only noted: the work looks at [`noted`], stops and reports what it has.
pub fn defer() {
    DEFERRED.store(true, Ordering::SeqCst);
}

/// Whether an interrupt asks the work to stop.
pub fn noted() -> bool {
    NOTED.load(Ordering::Relaxed)
}

/// In a thread of its own.
fn heard() {
    // Asked twice, it does not even finish what it writes.
    if DEFERRED.load(Ordering::SeqCst) && !NOTED.swap(true, Ordering::SeqCst) {
        return;
    }
    // Held to the end: nothing is begun or completed any more.
    let parts = parts();
    for part in parts.iter() {
        // That it cannot be removed changes nothing.
        let _ = fs::remove_file(part);
    }
    let _ = writeln!(io::stderr(), "centrode: interrupted");
    process::exit(INTERRUPTED.into());
}

/// A file on its way, beside the one that it becomes. Dropped or interrupted, it is removed.
#[derive(Debug)]
pub struct Part {
    /// None once it is complete.
    file: Option<NamedTempFile>,
}

impl Part {
    /// Begins what is to become `target`. It has the mode of the file that it replaces, or that of any new file.
    pub fn beside(target: &Path) -> io::Result<Self> {
        let folder = target.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
        let mut name = target.file_name().unwrap_or_default().to_owned();
        name.push(".");
        let mut builder = tempfile::Builder::new();
        builder.prefix(&name).suffix(".part");
        let replaced = fs::metadata(target).ok().map(|meta| meta.permissions());
        let usual = system::usual_permissions();
        if let Some(permissions) = &usual {
            builder.permissions(permissions.clone());
        }
        let mut parts = parts();
        let file = builder.tempfile_in(folder).map_err(|error| bare(&error))?;
        parts.insert(file.path().to_owned());
        drop(parts);
        let part = Self { file: Some(file) };
        if let (Some(permissions), Some(file)) = (replaced, &part.file) {
            file.as_file().set_permissions(permissions)?;
        }
        Ok(part)
    }

    /// Puts the file in the place of `target`.
    pub fn complete(mut self, target: &Path) -> io::Result<()> {
        let mut parts = parts();
        let Some(file) = self.file.take() else { return Ok(()) };
        parts.remove(file.path());
        file.persist(target).map(drop).map_err(|refused| refused.error)
    }

    /// The file itself.
    fn file(&mut self) -> io::Result<&mut File> {
        let file = self.file.as_mut().map(NamedTempFile::as_file_mut);
        file.ok_or_else(|| io::Error::other("the file is complete already"))
    }
}

impl Write for Part {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.file()?.write(bytes)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.file()?.flush()
    }
}

impl Drop for Part {
    fn drop(&mut self) {
        if let Some(file) = self.file.take() {
            let mut parts = parts();
            parts.remove(file.path());
            // Half a file is worse than none; that it cannot be removed changes nothing.
            drop(file);
        }
    }
}

/// The error without the name of the part, which nobody asked for.
fn bare(error: &io::Error) -> io::Error {
    error.raw_os_error().map_or_else(|| error.kind().into(), io::Error::from_raw_os_error)
}
