//! A worker in the same memory, and a hand on it from outside.

use super::Helper;
use centrode_core::study::remote::Remote;
use std::cell::RefCell;
use std::rc::Rc;

/// Pieces that are made between two looks.
const PIECES: usize = 5;

/// What it does and has done.
#[derive(Debug, Default)]
pub struct Desk {
    /// What it works on.
    pub remote: Option<Remote>,
    /// Requests so far.
    pub asked: usize,
    /// What it had made for a request of the past comes late.
    late: Option<Vec<u8>>,
    /// It fails from now on.
    pub broken: bool,
    /// It answers nonsense from now on.
    pub babbles: bool,
    /// So many others can take its place.
    pub others: usize,
}

/// The worker.
#[derive(Debug, Clone, Default)]
pub struct Near(pub Rc<RefCell<Desk>>);

impl Helper for Near {
    fn ask(&mut self, request: Option<&str>) {
        let mut desk = self.0.borrow_mut();
        desk.asked += usize::from(request.is_some());
        if let Some(mut old) = desk.remote.take() {
            desk.late = Some(old.answer().expect("bytes"));
        }
        desk.remote = request.map(|request| Remote::new(request).expect("a request"));
    }

    fn take(&mut self) -> Vec<Vec<u8>> {
        let mut desk = self.0.borrow_mut();
        let babbles = desk.babbles;
        let mut answers: Vec<_> = desk.late.take().into_iter().collect();
        if let Some(remote) = desk.remote.as_mut() {
            let _ = (0..PIECES).filter(|_| remote.step()).count();
            answers.push(if babbles { vec![0xff; 9] } else { remote.answer().expect("bytes") });
        }
        answers
    }

    fn failure(&self) -> Option<String> {
        self.0.borrow().broken.then(|| "it is gone".into())
    }

    fn replace(&mut self) -> bool {
        let mut desk = self.0.borrow_mut();
        let Some(left) = desk.others.checked_sub(1) else { return false };
        *desk = Desk { others: left, asked: desk.asked, ..Desk::default() };
        true
    }
}
