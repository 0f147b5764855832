//! A helper that several studies ask in turn: what one has asked ends when another asks.

use crate::app::helper::Helper;
use std::cell::RefCell;
use std::rc::Rc;

/// A share in a helper.
#[derive(Debug, Clone)]
pub struct Lent(Rc<RefCell<Box<dyn Helper>>>);

impl Lent {
    /// Shares of one helper. Who has nothing to ask must not take the answers of the others.
    #[must_use]
    pub fn shares<const N: usize>(helper: Option<Box<dyn Helper>>) -> [Option<Box<dyn Helper>>; N] {
        let lent = helper.map(|helper| Self(Rc::new(RefCell::new(helper))));
        std::array::from_fn(|_| lent.clone().map(|lent| Box::new(lent) as Box<dyn Helper>))
    }
}

impl Helper for Lent {
    fn ask(&mut self, request: Option<&str>) {
        self.0.borrow_mut().ask(request);
    }

    fn take(&mut self) -> Vec<Vec<u8>> {
        self.0.borrow_mut().take()
    }

    fn failure(&self) -> Option<String> {
        self.0.borrow().failure()
    }

    fn replace(&mut self) -> bool {
        self.0.borrow_mut().replace()
    }
}
