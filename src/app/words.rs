//! What the page says: sentences, figures in words, refusals, help.

pub mod help;
pub mod keys;
pub mod link;
pub mod log;
pub mod placed;
pub mod refusal;
pub mod said;
pub mod story;
