//! The interface without a browser: widgets found by their names, moved, and looked at.

#![allow(clippy::disallowed_methods, clippy::disallowed_types, reason = "stored pictures are files")]

mod captions;
mod chain;
mod challenges;
mod contact;
mod detectors;
mod embed;
mod gallery;
mod keyboard;
mod lesson;
mod links;
mod logs;
mod painted;
mod pictures;
mod saving;
mod stages;
mod support;
mod theory;
mod touch;
mod tuning;
mod ui;
mod views;
